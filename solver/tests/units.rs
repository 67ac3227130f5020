//! The result does not depend on the units of the parameters.

#![allow(clippy::unwrap_used)]

use std::cell::RefCell;
use std::ops::ControlFlow;

use stillpoint_solver::{
    Damping, LinearSolver, Mask, Options, Parameters, Residual, Scalar, Variant, lit,
    solve_observed,
};

/// An exponential and a line, in units `u`: the parameters are `u · x`.
struct InUnits([f64; 4]);

impl<D: Scalar> Residual<D> for InUnits {
    fn residuals(&self, x: &[D], out: &mut Vec<D>) {
        let p: Vec<D> = x.iter().zip(self.0).map(|(&x, u)| x / u).collect();
        for i in 0..25 {
            let t = 0.2 * f64::from(i);
            let y = 2.0 * (-0.7 * t).exp() - 0.5 * t + 0.3 + 0.1 * (37.0 * t).sin();
            let model = p[0] * (-p[1] * t).exp() + p[2] * t + p[3];
            out.push(model - lit::<D>(y));
        }
    }
}

/// All iterates, in the units of the problem.
fn iterates(units: [f64; 4], options: &Options) -> Vec<Vec<f64>> {
    let start = [1.0, 0.2, 0.1, 0.1]
        .iter()
        .zip(units)
        .map(|(x, u)| x * u)
        .collect::<Vec<_>>();
    let seen = RefCell::new(Vec::new());
    let mut watch = |_: &stillpoint_solver::Iteration, x: &[f64]| {
        seen.borrow_mut().push(
            x.iter()
                .zip(units)
                .map(|(x, u)| x / u)
                .collect::<Vec<f64>>(),
        );
        ControlFlow::Continue(())
    };
    let report = solve_observed(
        &InUnits(units),
        &Parameters::unnamed(&start),
        &Mask::all(4),
        options,
        &mut watch,
    )
    .unwrap();
    assert!(
        report.termination.converged(),
        "{options:?}: {:?}",
        report.termination
    );
    seen.into_inner()
}

#[test]
fn scaling_a_parameter_leaves_the_iterates_where_they_were() {
    let lm = |damping, geodesic| Variant::LevenbergMarquardt { damping, geodesic };
    let variants = [
        lm(Damping::DelayedGratification, true),
        lm(Damping::Marquardt, false),
        lm(Damping::Nielsen, true),
        Variant::Dogleg,
        Variant::GaussNewton,
    ];
    for variant in variants {
        let options = Options {
            variant,
            linear_solver: LinearSolver::Qr,
            ..Options::default()
        };
        let reference = iterates([1.0; 4], &options);
        for k in 0..4 {
            for factor in [1e6, 1e-6] {
                let mut units = [1.0; 4];
                units[k] = factor;
                let scaled = iterates(units, &options);
                assert_eq!(scaled.len(), reference.len(), "{variant:?}");
                for (a, b) in scaled.iter().flatten().zip(reference.iter().flatten()) {
                    assert!(
                        (a - b).abs() <= 1e-9 * b.abs(),
                        "{variant:?} x{k} · {factor:e}: {a} {b}"
                    );
                }
            }
        }
    }
}
