//! Chains: Lukšan, "Hybrid methods in large sparse nonlinear least squares", 1996 (LUKSAN…), and chained
//! problems of CUTEst: Gould, Orban and Toint, 2015.

use solver::lit;

use crate::problems::Case;
use crate::problems::case::residuals;

residuals!(/// LUKSAN11, chained serpentine.
Serpentine, |x, out| {
    for p in x.windows(2) {
        out.push(p[0] * 20.0 / (p[0] * p[0] + 1.0) - p[1] * 10.0);
        out.push(p[0] - lit::<D>(1.0));
    }
});
residuals!(/// LUKSAN12, chained and modified HS47.
Hs47, |x, out| {
    for x in x.windows(5).step_by(3) {
        out.push((x[0] * x[0] - x[1]) * 10.0);
        out.push(x[2] - lit::<D>(1.0));
        out.push((x[3] - lit::<D>(1.0)).powi(2));
        out.push((x[4] - lit::<D>(1.0)).powi(3));
        out.push(x[3] * x[0] * x[0] + (x[3] - x[4]).sin() - lit::<D>(10.0));
        out.push(x[1] + x[2].powi(4) * x[3] * x[3] - lit::<D>(20.0));
    }
});
residuals!(/// LUKSAN13, chained and modified HS48.
Hs48, |x, out| {
    for x in x.windows(5).step_by(3) {
        out.push((x[0] * x[0] - x[1]) * 10.0);
        out.push((x[1] * x[1] - x[2]) * 10.0);
        out.push((x[2] - x[3]).powi(2));
        out.push((x[3] - x[4]).powi(2));
        out.push(x[0] + x[1] * x[1] + x[2] - lit::<D>(30.0));
        out.push(x[1] - x[2] * x[2] + x[3] - lit::<D>(10.0));
        out.push(x[0] * x[4] - lit::<D>(10.0));
    }
});
residuals!(/// LUKSAN14, chained and modified HS53.
Hs53, |x, out| {
    for x in x.windows(5).step_by(3) {
        out.push((x[0] * x[0] - x[1]) * 10.0);
        out.push(x[1] + x[2] - lit::<D>(2.0));
        out.push(x[3] - lit::<D>(1.0));
        out.push(x[4] - lit::<D>(1.0));
        out.push(x[0] + x[1] * 3.0);
        out.push(x[2] + x[3] - x[4] * 2.0);
        out.push((x[1] * x[1] - x[4]) * 10.0);
    }
});
residuals!(/// LUKSAN21, modified discrete boundary value.
BoundaryValue, |x, out| {
    let n = x.len();
    let h = 1.0 / (n as f64 + 1.0);
    for i in 0..n {
        let left = if i > 0 { x[i - 1] } else { lit::<D>(0.0) };
        let right = if i + 1 < n { x[i + 1] } else { lit::<D>(0.0) };
        let bent = (x[i] + (h * (i as f64 + 1.0) + 1.0)).powi(3) * (0.5 * h * h);
        out.push(x[i] * 2.0 - left - right + bent + 1.0);
    }
});
residuals!(/// CUBE.
Cube, |x, out| {
    out.push(x[0] - lit::<D>(1.0));
    for p in x.windows(2) {
        out.push((p[1] - p[0].powi(3)) * 10.0);
    }
});
residuals!(/// EXTROSNB with its root where the Jacobian is singular.
ExtendedRosenbrock, |x, out| {
    out.push(x[0]);
    for p in x.windows(2) {
        out.push((p[1] * p[1] - p[0]) * 10.0);
    }
});
residuals!(/// CHNROSNB.
ChainedRosenbrock, |x, out| {
    for (p, a) in x.windows(2).zip(ALPHA) {
        out.push((p[0] - p[1] * p[1]) * (4.0 * a));
        out.push(p[1] - lit::<D>(1.0));
    }
});
residuals!(/// ERRINROS.
ErrorInRosenbrock, |x, out| {
    for (p, a) in x.windows(2).zip(ALPHA) {
        out.push(p[0] - p[1] * p[1] * (16.0 * a * a));
        out.push(p[1] - lit::<D>(1.0));
    }
});
residuals!(/// OSCIPATH: Nesterov's Chebyshev–Rosenbrock function.
OscillatingPath, |x, out| {
    out.push((x[0] - lit::<D>(1.0)) * 0.5);
    for p in x.windows(2) {
        out.push(p[1] - p[0] * p[0] * 2.0 + 1.0);
    }
});
residuals!(/// BDQRTIC.
Bdqrtic, |x, out| {
    let last = x[x.len() - 1];
    for x in x.windows(5) {
        out.push(lit::<D>(3.0) - x[0] * 4.0);
        let inner = x[0] * x[0] + x[1] * x[1] * 2.0 + x[2] * x[2] * 3.0 + x[3] * x[3] * 4.0;
        out.push(inner + last * last * 5.0);
    }
});
residuals!(/// ARWHDNE.
Arrowhead, |x, out| {
    let last = x[x.len() - 1];
    for x in &x[..x.len() - 1] {
        out.push(*x * *x + last * last);
        out.push(lit::<D>(3.0) - *x * 4.0);
    }
});
residuals!(/// NONDIA.
Nondiagonal, |x, out| {
    out.push(x[0] - lit::<D>(1.0));
    for y in &x[1..] {
        out.push((x[0] - *y * *y) * 10.0);
    }
});
residuals!(/// LIARWHD.
Liarwhd, |x, out| {
    for y in x {
        out.push((*y * *y - x[0]) * 2.0);
        out.push(*y - lit::<D>(1.0));
    }
});
residuals!(/// TQUARTIC.
Tquartic, |x, out| {
    out.push(x[0] - lit::<D>(1.0));
    for y in &x[1..] {
        out.push(x[0] * x[0] - *y * *y);
    }
});
residuals!(/// FREURONE: chained Freudenstein and Roth.
FreudensteinRoth, |x, out| {
    for p in x.windows(2) {
        let y = p[1];
        out.push(p[0] + ((lit::<D>(5.0) - y) * y - lit::<D>(2.0)) * y - lit::<D>(13.0));
        out.push(p[0] + ((y + 1.0) * y - lit::<D>(14.0)) * y - lit::<D>(29.0));
    }
});
residuals!(/// 10FOLDTR: a root of multiplicity ten.
TenFold, |x, out| {
    let n = x.len();
    let mut sum = lit::<D>(0.0);
    for (i, y) in x.iter().enumerate() {
        sum += *y;
        let power = [5, 2, 1][(n - 1 - i).min(2)];
        out.push(sum.powi(power));
    }
});

const ALPHA: [f64; 9] = [1.25, 1.4, 2.4, 1.4, 1.75, 1.2, 2.25, 1.2, 1.0];

/// Seventeen chains.
pub fn chains() -> Vec<Case> {
    let ones = |n: usize, value: f64| vec![value; n];
    let h = 1.0 / 21.0;
    let arc: Vec<f64> = (1..=20)
        .map(|i| f64::from(i) * h * (f64::from(i) * h - 1.0))
        .collect();
    let pattern = |a: f64, b: f64, n: usize| [a, b].repeat(n / 2);
    let mut path = ones(5, 1.0);
    path[0] = -1.0;
    vec![
        Case::new("LUKSAN11", Serpentine, &ones(20, -0.8), &[]),
        Case::new("LUKSAN12", Hs47, &ones(20, -1.0), &[]),
        Case::new("LUKSAN12 98", Hs47, &ones(98, -1.0), &[]),
        Case::new("LUKSAN13", Hs48, &ones(20, -1.0), &[]),
        Case::new("LUKSAN14", Hs53, &ones(20, -1.0), &[]),
        Case::new("LUKSAN21", BoundaryValue, &arc, &[]),
        Case::new("CUBE", Cube, &[-1.2, 1.0, -1.2, 1.0, -1.2], &[]),
        Case::new("EXTROSNB", ExtendedRosenbrock, &ones(10, -1.0), &[]),
        Case::new("CHNROSNB", ChainedRosenbrock, &ones(10, -1.0), &[]),
        Case::new("ERRINROS", ErrorInRosenbrock, &ones(10, -1.0), &[]),
        Case::new("OSCIPATH", OscillatingPath, &path, &[]),
        Case::new("BDQRTIC", Bdqrtic, &ones(10, 1.0), &[]),
        Case::new("ARWHDNE", Arrowhead, &ones(10, 1.0), &[]),
        Case::new("NONDIA", Nondiagonal, &ones(10, -1.0), &[]),
        Case::new("LIARWHD", Liarwhd, &ones(10, 4.0), &[]),
        Case::new("TQUARTIC", Tquartic, &ones(10, 0.1), &[]),
        Case::new("FREURONE", FreudensteinRoth, &pattern(0.5, -2.0, 10), &[]),
        Case::new("10FOLDTR", TenFold, &ones(10, 10.0), &[]),
    ]
}
