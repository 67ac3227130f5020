//! Levels of noise by restricted likelihood.

use std::cell::Cell;

use faer::Mat;

use super::mixed::{At, Mixed, Slopes};
use super::weights::Component;
use crate::methods::joint::blocks::columns::Columns;
use crate::methods::joint::noise::bias::Within;

findings::tuning! {
    /// Newton steps at most: usual ones are ten.
    STEPS: usize = 40;

    /// Products that all steps of one search may take together.
    MOST_WORK: f64 = 2e9;
    /// Its fewest steps.
    FEWEST_STEPS: f64 = 40.0;

    /// A relative change of every variance below this ends the search.
    SETTLED: f64 = 1e-3;

    /// A log-likelihood that rises by less than this has settled too: variances are then within a seventieth of their standard errors.
    NOTHING: f64 = 1e-4;

    /// A likelihood that will stay so many times [`WORTH_IT`] below another is not worked out further, ...
    FAR: f64 = 10.0;
    /// ... were the way ahead so many times what a Newton step promises.
    AHEAD: f64 = 20.0;

    /// Share by which the diagonal of the information is larger in a step.
    HELD_UP: f64 = 1e-3;

    /// Twice the gain in log-likelihood below which a variance is taken for zero: 5 % of recordings without
    /// it pass by chance, the variance being at the edge of what it can be (½ χ²₀ + ½ χ²₁).
    WORTH_IT: f64 = 2.7;
}

/// The likelihood of what is left of the residuals when the parameters have had their share.
#[derive(Clone, Debug)]
pub struct Restricted {
    mixed: Mixed,
    /// Independent numbers whose variances depend on the same components.
    pub within: Vec<Within>,
    /// Number of evaluations of the likelihood so far.
    pub evaluations: Cell<usize>,
}

/// The likelihood at some variances.
struct Measured {
    log_likelihood: f64,
    at: At,
    /// Variances of the independent numbers.
    own: Vec<f64>,
}

impl Restricted {
    /// Builds the likelihood from residuals `r` (`m`), Jacobian `J` (`m × n`) and components of noise, all whitened by
    /// the white noise.
    pub fn new(residuals: &[f64], jacobian: &Columns, components: &[&Component]) -> Self {
        Self {
            mixed: Mixed::new(residuals, jacobian, components),
            within: Vec::new(),
            evaluations: Cell::new(0),
        }
    }

    /// Numbers that one evaluation handles, in rows times columns squared.
    pub fn work(&self) -> f64 {
        self.mixed.work()
    }

    /// The variances that maximise the likelihood, those that are not worth it at zero; `kept` ones are
    /// kept whatever they are worth. The search begins at the variances `from`.
    pub fn variances(&self, kept: &[bool], from: &[f64]) -> Vec<f64> {
        let mut active = vec![true; self.mixed.components()];
        let mut from = from.to_vec();
        let left = Cell::new(self.most_steps());
        loop {
            let (theta, whole) = self.maximise(&active, &from, &left, None);
            from.clone_from(&theta);
            for (on, value) in active.iter_mut().zip(&theta) {
                *on &= *value > 0.0;
            }
            let gains = (0..theta.len())
                .filter(|&c| active[c] && !kept[c])
                .map(|c| {
                    let mut without = active.clone();
                    without[c] = false;
                    (
                        c,
                        2.0 * (whole - self.maximise(&without, &theta, &left, Some(whole)).1),
                    )
                });
            match gains.min_by(|a, b| a.1.total_cmp(&b.1)) {
                Some((c, gain)) if gain < WORTH_IT.get() => {
                    active[c] = false;
                    from[c] = 0.0;
                }
                _ => return theta,
            }
        }
    }

    fn most_steps(&self) -> usize {
        (MOST_WORK.get() / self.mixed.work().max(1.0)).max(FEWEST_STEPS.get()) as usize
    }

    /// The highest `log L` over all variances, up to a constant.
    pub fn highest(&self) -> f64 {
        let count = self.mixed.components();
        let steps = Cell::new(self.most_steps());
        self.maximise(&vec![true; count], &vec![0.0; count], &steps, None)
            .1
    }

    /// `log L` at these variances, up to a constant.
    #[cfg(test)]
    pub(crate) fn log_likelihood(&self, theta: &[f64]) -> Option<f64> {
        Some(self.measure(theta, f64::NEG_INFINITY)?.log_likelihood)
    }

    /// Newton steps by the average information (Gilmour, Thompson & Cullis 1995), in no more than the steps that are left, over the
    /// active components from the variances `from`, zero for the others; variances and log-likelihood. Where that will stay far
    /// below `whole`, how far is not worked out.
    fn maximise(
        &self,
        active: &[bool],
        from: &[f64],
        left: &Cell<usize>,
        whole: Option<f64>,
    ) -> (Vec<f64>, f64) {
        let start = from.iter().zip(active);
        let mut theta: Vec<f64> = start.map(|(&t, &on)| if on { t } else { 0.0 }).collect();
        let mut at = match self.measure(&theta, f64::NEG_INFINITY) {
            Some(at) => at,
            None => return (theta, f64::NEG_INFINITY),
        };
        for _ in 0..STEPS.get().min(left.get()) {
            left.set(left.get() - 1);
            let slopes = self.slopes(&at, &theta, active);
            let Some(step) = slopes.step(&theta, active) else {
                break;
            };
            let ahead: f64 = step.iter().zip(&slopes.score).map(|(a, b)| a * b).sum();
            let is_far = |whole: f64| {
                2.0 * (whole - at.log_likelihood) - AHEAD.get() * ahead > FAR.get() * WORTH_IT.get()
            };
            if whole.is_some_and(is_far) {
                break;
            }
            let mut factor = 1.0;
            let mut next = None;
            while factor > 1e-3 {
                let tried: Vec<f64> = theta
                    .iter()
                    .zip(&step)
                    .map(|(t, s)| (t + factor * s).max(0.0))
                    .collect();
                if let Some(measured) = self.measure(&tried, at.log_likelihood) {
                    next = Some((tried, measured));
                    break;
                }
                factor *= 0.3;
            }
            let Some((tried, measured)) = next else { break };
            let pairs = tried.iter().zip(&theta);
            let moved = pairs
                .clone()
                .any(|(a, b)| (a - b).abs() > SETTLED.get() * a.max(*b));
            let gained = measured.log_likelihood - at.log_likelihood;
            theta = tried;
            at = measured;
            if !moved || gained < NOTHING.get() {
                break;
            }
        }
        (theta, at.log_likelihood)
    }

    /// The log-likelihood; `None` where it is below `least`.
    fn measure(&self, theta: &[f64], least: f64) -> Option<Measured> {
        self.evaluations.set(self.evaluations.get() + 1);
        let at = self.mixed.at(theta)?;
        let own: Vec<f64> = self.within.iter().map(|w| w.variance(theta)).collect();
        let within = self.within.iter().zip(&own);
        let within: f64 = within.map(|(w, v)| v.ln() + w.square / v).sum();
        let log_likelihood = at.log_likelihood - 0.5 * within;
        (log_likelihood >= least).then_some(Measured {
            log_likelihood,
            at,
            own,
        })
    }

    /// Derivatives of the log-likelihood, which the last point of a search is not asked for: half of the work.
    fn slopes(&self, at: &Measured, theta: &[f64], active: &[bool]) -> Slopes {
        let mut slopes = self.mixed.slopes(&at.at, theta, active);
        slopes.add_independent(&self.within, &at.own, active);
        slopes
    }
}

impl Slopes {
    /// Adds the part of independent numbers with these variances.
    fn add_independent(&mut self, within: &[Within], variances: &[f64], active: &[bool]) {
        let count = active.len();
        for (w, v) in within.iter().zip(variances) {
            for i in (0..count).filter(|&i| active[i]) {
                let share = w.by_component[i] / v;
                self.score[i] += 0.5 * share * (w.square / v - 1.0);
                for j in (0..count).filter(|&j| active[j]) {
                    self.information[i][j] += 0.5 * share * w.by_component[j] / v * (w.square / v);
                }
            }
        }
    }

    /// `I⁻¹ s` over the components that are active and not held at zero by their score.
    fn step(&self, theta: &[f64], active: &[bool]) -> Option<Vec<f64>> {
        let free: Vec<usize> = (0..theta.len())
            .filter(|&c| active[c] && (theta[c] > 0.0 || self.score[c] > 0.0))
            .collect();
        if free.is_empty() {
            return None;
        }
        // Components that do nearly the same to the data leave the information all but singular.
        let matrix = nalgebra::DMatrix::from_fn(free.len(), free.len(), |i, j| {
            let held_up = if i == j { 1.0 + HELD_UP.get() } else { 1.0 };
            held_up * self.information[free[i]][free[j]]
        });
        let right = nalgebra::DVector::from_fn(free.len(), |i, _| self.score[free[i]]);
        let solution = matrix.cholesky()?.solve(&right);
        let mut step = vec![0.0; theta.len()];
        for (k, &c) in free.iter().enumerate() {
            step[c] = solution[k];
        }
        Some(step)
    }
}

/// An orthonormal basis (`m × (m − n)`) of what is orthogonal to the columns of `J`.
pub fn left_null_space(jacobian: &Mat<f64>) -> Mat<f64> {
    let (m, n) = (jacobian.nrows(), jacobian.ncols());
    let q = jacobian.qr().compute_Q();
    q.as_ref().subcols(n.min(m), m.saturating_sub(n)).to_owned()
}

#[cfg(test)]
pub(crate) mod tests;
