//! Sums of squares from CUTEst: Gould, Orban and Toint, "CUTEst: a constrained and unconstrained
//! testing environment with safe threads", 2015.

use solver::lit;

use super::Case;
use super::case::residuals;

residuals!(/// ENGVAL2.
Engval2, |x, out| {
    let planar = x[0] * x[0] + x[1] * x[1];
    out.push(planar + x[2] * x[2] - lit::<D>(1.0));
    out.push(planar + (x[2] - lit::<D>(2.0)).powi(2) - lit::<D>(1.0));
    out.push(x[0] + x[1] + x[2] - lit::<D>(1.0));
    out.push(x[0] + x[1] - x[2] + 1.0);
    out.push(x[0].powi(3) + x[1] * x[1] * 3.0 + (x[2] * 5.0 - x[0] + 1.0).powi(2) - lit::<D>(36.0));
});
residuals!(/// SINEVAL.
Sineval, |x, out| {
    out.push((x[1] - x[0].sin()) * 100.0);
    out.push(x[0] / 2.0);
});
residuals!(/// HIMMELBC, Himmelblau's function.
Himmelblau, |x, out| {
    out.push(x[0] * x[0] + x[1] - lit::<D>(11.0));
    out.push(x[0] + x[1] * x[1] - lit::<D>(7.0));
});
residuals!(/// HATFLDA and HATFLDB.
HatfieldA, |x, out| {
    out.push(x[0] - lit::<D>(1.0));
    for pair in x.windows(2) {
        out.push(pair[0] - pair[1].sqrt());
    }
});
residuals!(/// HATFLDC.
HatfieldC, |x, out| {
    let n = x.len();
    out.push(x[0] - lit::<D>(1.0));
    for i in 1..n - 1 {
        out.push(x[i + 1] - x[i] * x[i]);
    }
    out.push(x[n - 1] - lit::<D>(1.0));
});

/// Without constraints.
pub fn unconstrained() -> Vec<Case> {
    vec![
        Case::new("ENGVAL2", Engval2, &[1.0, 2.0, 0.0], &[0.0]),
        Case::new("SINEVAL", Sineval, &[4.712389, -1.0], &[0.0]),
        Case::new("HIMMELBC", Himmelblau, &[1.0, 1.0], &[0.0]),
    ]
}

/// With bounds.
pub fn bounded() -> Vec<Case> {
    let free = [f64::INFINITY; 4];
    vec![
        Case::new("HATFLDA", HatfieldA, &[0.1; 4], &[0.0]).bounded(&[1e-7; 4], &free),
        Case::new("HATFLDB", HatfieldA, &[0.1; 4], &[5.572_809_000_084e-3]).bounded(
            &[1e-7; 4],
            &[f64::INFINITY, 0.8, f64::INFINITY, f64::INFINITY],
        ),
        Case::new("HATFLDC", HatfieldC, &[0.9; 25], &[0.0]).bounded(&[0.0; 25], &[10.0; 25]),
    ]
}
