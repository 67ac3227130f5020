//! Dennis and Schnabel, "Numerical Methods for Unconstrained Optimization and Nonlinear
//! Equations", 1983: the examples that CUTEst holds as DENSCHNA to DENSCHNF.

use solver::lit;

use super::Case;
use super::case::residuals;

residuals!(/// DENSCHNA.
A, |x, out| {
    out.push(x[0] * x[0]);
    out.push(x[0] + x[1]);
    out.push(x[1].exp() - lit::<D>(1.0));
});
residuals!(/// DENSCHNB.
B, |x, out| {
    let d = x[0] - lit::<D>(2.0);
    out.push(d);
    out.push(d * x[1]);
    out.push(x[1] + 1.0);
});
residuals!(/// DENSCHNC.
C, |x, out| {
    out.push(x[0] * x[0] + x[1] * x[1] - lit::<D>(2.0));
    out.push((x[0] - lit::<D>(1.0)).exp() + x[1].powi(3) - lit::<D>(2.0));
});
residuals!(/// DENSCHND.
DNamed, |x, out| {
    out.push(x[0] * x[0] + x[1].powi(3) - x[2].powi(4));
    out.push(x[0] * x[1] * x[2] * 2.0);
    out.push(x[0] * x[1] * 2.0 - x[1] * x[2] * 3.0 + x[0] * x[2]);
});
residuals!(/// DENSCHNE.
E, |x, out| {
    out.push(x[0]);
    out.push(x[1] + x[1] * x[1]);
    out.push(x[2].exp() - lit::<D>(1.0));
});
residuals!(/// DENSCHNF.
F, |x, out| {
    out.push((x[0] + x[1]).powi(2) * 2.0 + (x[0] - x[1]).powi(2) - lit::<D>(8.0));
    out.push(x[0] * x[0] * 5.0 + (x[1] - lit::<D>(3.0)).powi(2) - lit::<D>(9.0));
});

/// The six, each with minimum zero; DENSCHNE has a second where its last parameter runs to `-∞`.
pub fn all() -> Vec<Case> {
    vec![
        Case::new("DENSCHNA", A, &[1.0, 1.0], &[0.0]),
        Case::new("DENSCHNB", B, &[1.0, 1.0], &[0.0]),
        Case::new("DENSCHNC", C, &[2.0, 3.0], &[0.0]),
        Case::new("DENSCHND", DNamed, &[10.0, 10.0, 10.0], &[0.0]),
        Case::new("DENSCHNE", E, &[2.0, 3.0, -8.0], &[0.0, 1.0]),
        Case::new("DENSCHNF", F, &[2.0, 0.0], &[0.0]),
    ]
}
