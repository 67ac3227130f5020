//! The crate factrs: Levenberg–Marquardt over its sparse Cholesky factorisation. It eliminates no
//! blocks one by one and holds no variable: a prior holds the first pose or camera.

use std::error::Error;

use factrs::core::{Graph, LevenMarquardt, PriorResidual, Values};
use factrs::linalg::{Const, ForwardProp, Numeric, VectorX, vectorx};
use factrs::optimizers::{LevenParams, OptError, OptObserver};
use factrs::residuals::Residual2;
use factrs::traits::Optimizer;
use factrs::utils::load_g20;
use factrs::variables::VectorVar;
use factrs::{assign_symbols, fac};

use crate::{Outcome, bal, processor_seconds};

type Camera = VectorVar<9>;
type Point = VectorVar<3>;

assign_symbols!(C: Camera; P: Point);

#[derive(Clone, Debug)]
struct Reprojection([f64; 2]);

#[factrs::mark]
impl Residual2 for Reprojection {
    type Differ = ForwardProp<Const<12>>;
    type V1 = Camera;
    type V2 = Point;
    type DimIn = Const<12>;
    type DimOut = Const<2>;

    fn residual2<T: Numeric>(&self, c: VectorVar<9, T>, x: VectorVar<3, T>) -> VectorX<T> {
        let (w, v) = ([c[0], c[1], c[2]], [x[0], x[1], x[2]]);
        let one = T::from(1.0);
        let angle = (w[0] * w[0] + w[1] * w[1] + w[2] * w[2]).sqrt();
        let (sine, cosine) = angle.sin_cos();
        let inverse = one / angle;
        let a = sine * inverse;
        let dot = w[0] * v[0] + w[1] * v[1] + w[2] * v[2];
        let b = (one - cosine) * dot * inverse * inverse;
        let p = [
            v[0] * cosine + (w[1] * v[2] - w[2] * v[1]) * a + w[0] * b + c[3],
            v[1] * cosine + (w[2] * v[0] - w[0] * v[2]) * a + w[1] * b + c[4],
            v[2] * cosine + (w[0] * v[1] - w[1] * v[0]) * a + w[2] * b + c[5],
        ];
        let inverse = -one / p[2];
        let (u, v) = (p[0] * inverse, p[1] * inverse);
        let n = u * u + v * v;
        let scale = c[6] * (one + n * (c[7] + c[8] * n));
        vectorx![
            scale * u - T::from(self.0[0]),
            scale * v - T::from(self.0[1])
        ]
    }
}

/// Counts steps.
struct Count(std::rc::Rc<std::cell::Cell<usize>>);

impl OptObserver for Count {
    fn on_step(&self, _: &Values, _: i64) {
        self.0.set(self.0.get() + 1);
    }
}

fn run(graph: Graph, values: Values, begin: f64) -> Outcome {
    let mut params = LevenParams::default();
    params.base.max_iterations = 200;
    params.base.error_tol_relative = 1e-10;
    params.base.error_tol_absolute = 0.0;
    let start = graph.error(&values);
    let mut solver = LevenMarquardt::new(params, graph);
    let steps = std::rc::Rc::new(std::cell::Cell::new(0));
    solver.observers_mut().add(Count(steps.clone()));
    let (ended, ending) = match solver.optimize(values) {
        Ok(values) => (Some(values), "converged"),
        Err(OptError::MaxIterations(values)) => (Some(values), "max_iterations"),
        Err(OptError::FailedToStep) => (None, "failed_to_step"),
        Err(OptError::InvalidSystem) => (None, "invalid_system"),
    };
    let seconds = processor_seconds() - begin;
    Outcome {
        start,
        cost: ended.map_or(f64::NAN, |values| solver.error(&values)),
        steps: steps.get(),
        seconds,
        ending: ending.into(),
    }
}

/// A bundle adjustment by dual numbers: a factor's Jacobian is forward mode or numerical.
pub fn bundle(file: &str, fixed: bool) -> Result<Outcome, Box<dyn Error>> {
    let bundle = bal::read(file)?;
    let begin = processor_seconds();
    let (mut graph, mut values) = (Graph::new(), Values::new());
    for (k, c) in bundle.cameras.iter().enumerate() {
        values.insert(C(k as u32), VectorVar(c.vector()));
    }
    for (k, p) in bundle.points.iter().enumerate() {
        values.insert(P(k as u32), VectorVar(p.vector()));
    }
    for &(c, p, seen) in &bundle.seen {
        let factor = fac![Reprojection(seen), (C(c as u32), P(p as u32)), 1.0 as std];
        graph.add_factor(factor);
    }
    if fixed {
        let prior = PriorResidual::new(VectorVar(bundle.cameras[0].vector()));
        graph.add_factor(fac![prior, C(0), 1e-6 as std]);
    }
    Ok(run(graph, values, begin))
}

/// A pose graph as the crate itself reads and builds it: its time begins after that.
pub fn poses(file: &str) -> Outcome {
    let (graph, values) = load_g20(file);
    run(graph, values, processor_seconds())
}

/// A vector of the crate.
trait ToVector<const N: usize> {
    fn vector(&self) -> factrs::linalg::Vector<N>;
}

impl<const N: usize> ToVector<N> for [f64; N] {
    fn vector(&self) -> factrs::linalg::Vector<N> {
        factrs::linalg::Vector::<N>::from_column_slice(self)
    }
}
