//! A problem of a collection.

use solver::{Constraints, Error, Mask, Options, Parameters, Problem, Report, solve};

/// A sum of squares with its start and the minima known.
pub struct Case {
    /// Name in its collection.
    pub name: String,
    /// The residuals.
    pub problem: Box<dyn Problem + Send + Sync>,
    /// The published start.
    pub start: Vec<f64>,
    /// Known minima of `Σ r²`, the best first.
    pub minima: Vec<f64>,
    /// Lower bounds; empty if there are none.
    pub lower: Vec<f64>,
    /// Upper bounds; empty if there are none.
    pub upper: Vec<f64>,
    /// Linear constraints: coefficients of all parameters, lower and upper limit.
    pub linear: Vec<(Vec<f64>, f64, f64)>,
}

impl Case {
    /// A problem without constraints.
    pub fn new(
        name: &str,
        problem: impl Problem + Send + Sync + 'static,
        start: &[f64],
        minima: &[f64],
    ) -> Self {
        Self {
            name: name.to_owned(),
            problem: Box::new(problem),
            start: start.to_vec(),
            minima: minima.to_vec(),
            lower: Vec::new(),
            upper: Vec::new(),
            linear: Vec::new(),
        }
    }

    /// With bounds on every parameter, infinite where there is none.
    pub fn bounded(mut self, lower: &[f64], upper: &[f64]) -> Self {
        self.lower = lower.to_vec();
        self.upper = upper.to_vec();
        self
    }

    /// With `lower ≤ a · x ≤ upper` as well.
    pub fn linear(mut self, a: &[f64], lower: f64, upper: f64) -> Self {
        self.linear.push((a.to_vec(), lower, upper));
        self
    }

    /// The start as parameters `x0, x1, …`, multiplied by `factor`.
    pub fn parameters(&self, factor: f64) -> Parameters {
        Parameters::unnamed(&self.start.iter().map(|x| factor * x).collect::<Vec<_>>())
    }

    /// The default from the published start, moved to where the constraints hold.
    ///
    /// # Errors
    /// Constraints that cannot hold, and what the solver refuses.
    pub fn solved(&self) -> Result<Report, Error> {
        let options = Options {
            constraints: self.constraints(),
            ..Options::default()
        };
        let (mut start, mask) = (self.parameters(1.0), self.mask());
        options.constraints.project(&mut start, &mask)?;
        solve(&*self.problem, &start, &mask, &options)
    }

    /// All parameters free.
    pub fn mask(&self) -> Mask {
        Mask::all(self.start.len())
    }

    /// The bounds and linear constraints in the solver's terms.
    pub fn constraints(&self) -> Constraints {
        let parameters = self.parameters(1.0);
        let mut constraints = Constraints::new().bounds(&parameters, &self.lower, &self.upper);
        for (a, lower, upper) in &self.linear {
            let names = parameters
                .names()
                .iter()
                .map(String::as_str)
                .zip(a.iter().copied());
            let terms: Vec<(&str, f64)> = names.filter(|(_, c)| *c != 0.0).collect();
            constraints = constraints.linear(&terms, *lower, *upper);
        }
        constraints
    }

    /// How far `x` is from first-order optimality under the bounds: for each parameter the least of
    /// `|∂cost/∂xₖ|`, the same relative to `‖Jₖ‖ ‖r‖`, and the distance to the bound that its
    /// gradient pushes it to, relative to `1 + |bound|`; the largest of these. Linear constraints are
    /// not looked at.
    pub fn optimality(&self, x: &[f64]) -> f64 {
        let free: Vec<usize> = (0..x.len()).collect();
        let mut r = Vec::new();
        let jacobian = self.problem.linearize(x, &free, &mut r);
        let size = r.iter().map(|v| v * v).sum::<f64>().sqrt();
        let each = free.into_iter().map(|k| {
            let column = || (0..r.len()).map(|i| jacobian[(i, k)]);
            let gradient: f64 = column().zip(&r).map(|(j, r)| j * r).sum();
            if gradient == 0.0 {
                return 0.0;
            }
            let norm = column().map(|j| j * j).sum::<f64>().sqrt();
            let bound = if gradient > 0.0 {
                self.lower.get(k)
            } else {
                self.upper.get(k)
            };
            let room = bound.map_or(f64::INFINITY, |bound| {
                (x[k] - bound).abs() / (1.0 + bound.abs())
            });
            let room = if room.is_nan() { f64::INFINITY } else { room };
            gradient.abs().min(gradient.abs() / (norm * size)).min(room)
        });
        each.fold(0.0, f64::max)
    }

    /// Whether a sum of squares is one of the known minima, relative to it (absolutely below 1).
    pub fn is_minimum(&self, sum_of_squares: f64, tolerance: f64) -> bool {
        self.minima
            .iter()
            .any(|m| (sum_of_squares - m).abs() <= tolerance * if *m > 0.0 { *m } else { 1.0 })
    }
}

impl std::fmt::Debug for Case {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.debug_struct("Case")
            .field("name", &self.name)
            .field("start", &self.start)
            .finish_non_exhaustive()
    }
}

/// Defines a unit struct with its residuals over any scalar `D`.
macro_rules! residuals {
    ($(#[$doc:meta])* $name:ident, |$x:ident, $out:ident| $body:block) => {
        $(#[$doc])*
        #[derive(Clone, Copy, Debug)]
        pub struct $name;

        impl<D: solver::Scalar> solver::Residual<D> for $name {
            fn residuals(&self, $x: &[D], $out: &mut Vec<D>) $body
        }
    };
}

pub(crate) use residuals;
