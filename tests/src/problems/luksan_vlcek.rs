//! Lukšan and Vlček, "Sparse and partially separable test problems for unconstrained and equality
//! constrained optimization", 1999: sums of squares, of twenty parameters (Cragg and Levy: ten,
//! the size for which CUTEst gives a minimum).

use solver::lit;

use super::Case;
use super::case::residuals;

residuals!(/// Chained Rosenbrock function.
ChainedRosenbrock, |x, out| {
    for pair in x.windows(2) {
        out.push((pair[0] * pair[0] - pair[1]) * 10.0);
        out.push(pair[0] - lit::<D>(1.0));
    }
});
residuals!(/// Chained Wood function.
ChainedWood, |x, out| {
    for x in x.windows(4).step_by(2) {
        out.push((x[0] * x[0] - x[1]) * 10.0);
        out.push(x[0] - lit::<D>(1.0));
        out.push((x[2] * x[2] - x[3]) * 90f64.sqrt());
        out.push(x[2] - lit::<D>(1.0));
        out.push((x[1] + x[3] - lit::<D>(2.0)) * 10f64.sqrt());
        out.push((x[1] - x[3]) / 10f64.sqrt());
    }
});
residuals!(/// Chained Powell singular function.
ChainedPowell, |x, out| {
    for x in x.windows(4).step_by(2) {
        out.push(x[0] + x[1] * 10.0);
        out.push((x[2] - x[3]) * 5f64.sqrt());
        out.push((x[1] - x[2] * 2.0).powi(2));
        out.push((x[0] - x[3]).powi(2) * 10f64.sqrt());
    }
});
residuals!(/// Chained Cragg and Levy function as CUTEst codes it (CRAGGLVY).
ChainedCraggLevy, |x, out| {
    for x in x.windows(4).step_by(2) {
        out.push((x[0].exp() - x[1]).powi(2));
        out.push((x[1] - x[2]).powi(3) * 10.0);
        let d = x[2] - x[3];
        out.push((d.tan() + d).powi(2));
        out.push(x[0].powi(4));
        out.push(x[3] - lit::<D>(1.0));
    }
});

/// Four chains.
pub fn all() -> Vec<Case> {
    let start = |pattern: &[f64]| {
        pattern
            .iter()
            .copied()
            .cycle()
            .take(20)
            .collect::<Vec<f64>>()
    };
    let mut wood = [-2.0, 0.0].repeat(10);
    wood[..4].copy_from_slice(&[-3.0, -1.0, -3.0, -1.0]);
    let mut cragg = vec![2.0; 10];
    cragg[0] = 1.0;
    vec![
        Case::new(
            "LV chained Rosenbrock",
            ChainedRosenbrock,
            &start(&[-1.2, 1.0]),
            &[0.0],
        ),
        Case::new("LV chained Wood", ChainedWood, &wood, &[0.0]),
        Case::new(
            "LV chained Powell",
            ChainedPowell,
            &start(&[3.0, -1.0, 0.0, 1.0]),
            &[0.0],
        ),
        Case::new("CRAGGLVY", ChainedCraggLevy, &cragg, &[1.886_566]),
    ]
}
