//! Curves through data: M. Palmer's (CUTEst's PALMER family), and textbook data with their sources.

#![expect(
    clippy::approx_constant,
    reason = "the angles of the data are published with six digits"
)]

use solver::{Residual, Scalar, lit};

use crate::problems::Case;
use crate::problems::case::residuals;

/// Even polynomials in the angle, with `b / (c + x²)` if there are two parameters more than `terms`:
/// PALMER1A, 1C, 1D.
#[derive(Clone, Copy, Debug)]
struct Palmer1 {
    terms: usize,
}

impl<D: Scalar> Residual<D> for Palmer1 {
    fn residuals(&self, a: &[D], out: &mut Vec<D>) {
        for (x, y) in PALMER1 {
            let square = x * x;
            let (mut sum, mut power) = (lit::<D>(0.0), 1.0);
            for coefficient in &a[..self.terms] {
                sum += *coefficient * power;
                power *= square;
            }
            if let [b, c] = a[self.terms..] {
                sum += b / (c + square);
            }
            out.push(sum - lit::<D>(y));
        }
    }
}

/// Even Chebyshev polynomials (PALMER5C) or even powers (PALMER5D).
#[derive(Clone, Copy, Debug)]
struct Palmer5 {
    chebyshev: bool,
}

impl<D: Scalar> Residual<D> for Palmer5 {
    fn residuals(&self, a: &[D], out: &mut Vec<D>) {
        for (x, y) in PALMER5 {
            let sum = a.iter().enumerate().map(|(k, c)| {
                let basis = if self.chebyshev {
                    let angle: f64 = (x / 1.570_796f64).clamp(-1.0, 1.0).acos();
                    (2.0 * k as f64 * angle).cos()
                } else {
                    x.powi(2 * k as i32)
                };
                *c * basis
            });
            out.push(sum.fold(lit::<D>(0.0), |s, t| s + t) - lit::<D>(y));
        }
    }
}

residuals!(/// GROWTH: `a x^(b + c ln x)`.
Growth, |p, out| {
    for (x, y) in GROWTH {
        let log = f64::ln(x);
        out.push(p[0] * ((p[1] + p[2] * log) * log).exp() - lit::<D>(y));
    }
});
residuals!(/// HIMMELBF.
HimmelblauF, |x, out| {
    for (a, b) in HIMMELBF {
        let top = x[0] * x[0] + x[1] * x[1] * a + x[2] * x[2] * (a * a);
        let below = (x[3] * x[3] * a + 1.0) * b;
        out.push((top / below - lit::<D>(1.0)) * 100.0);
    }
});
residuals!(/// DEVGLA1: de Villiers and Glasser, 1981, first function.
Devgla1, |x, out| {
    for i in 0..24 {
        let t = 0.1 * f64::from(i);
        let y = 60.137 * 1.371f64.powf(t) * (3.112 * t + 1.761).sin();
        out.push(x[0] * (x[1].ln() * t).exp() * (x[2] * t + x[3]).sin() - lit::<D>(y));
    }
});
residuals!(/// DEVGLA2: de Villiers and Glasser, 1981, second function.
Devgla2, |x, out| {
    for i in 0..16 {
        let t = 0.1 * f64::from(i);
        let wave = (3.012 * t + (2.13 * t).sin()).tanh() * (t * 0.507f64.exp()).cos();
        let y = 53.81 * 1.27f64.powf(t) * wave;
        let model = (x[2] * t + (x[3] * t).sin()).tanh() * (x[4].exp() * t).cos();
        out.push(x[0] * (x[1].ln() * t).exp() * model - lit::<D>(y));
    }
});
residuals!(/// Puromycin, treated cells: Bates and Watts, "Nonlinear Regression Analysis", 1988, table A1.3.
PuromycinTreated, |p, out| {
    let y = [76.0, 47.0, 97.0, 107.0, 123.0, 139.0, 159.0, 152.0, 191.0, 201.0, 207.0, 200.0];
    for (x, y) in DOSES.into_iter().zip(y) {
        out.push(p[0] * x / (p[1] + x) - lit::<D>(y));
    }
});
residuals!(/// Puromycin, untreated cells: the same.
PuromycinUntreated, |p, out| {
    let y = [67.0, 51.0, 84.0, 86.0, 98.0, 115.0, 131.0, 124.0, 144.0, 158.0, 160.0];
    for (x, y) in DOSES.into_iter().zip(y) {
        out.push(p[0] * x / (p[1] + x) - lit::<D>(y));
    }
});
residuals!(/// Biochemical oxygen demand: Bates and Watts, 1988, table A1.4.
OxygenDemand, |p, out| {
    let data = [(1.0, 8.3), (2.0, 10.3), (3.0, 19.0), (4.0, 16.0), (5.0, 15.6), (7.0, 19.8)];
    for (t, y) in data {
        out.push(p[0] * (lit::<D>(1.0) - (-p[1] * t).exp()) - lit::<D>(y));
    }
});
residuals!(/// A circle: Gander, Golub and Strebel, "Least-squares fitting of circles and ellipses", 1994.
Circle, |p, out| {
    for (x, y) in [(1.0, 7.0), (2.0, 6.0), (5.0, 8.0), (7.0, 7.0), (9.0, 5.0), (3.0, 7.0)] {
        let (dx, dy) = (p[0] - lit::<D>(x), p[1] - lit::<D>(y));
        out.push((dx * dx + dy * dy).sqrt() - p[2]);
    }
});
residuals!(/// A linear system with Hilbert's matrix, condition 1e10.
Hilbert, |x, out| {
    for i in 0..x.len() {
        let row = x.iter().enumerate().map(|(k, x)| (*x - lit::<D>(1.0)) / ((i + k + 1) as f64));
        out.push(row.fold(lit::<D>(0.0), |s, t| s + t));
    }
});

const DOSES: [f64; 12] = [
    0.02, 0.02, 0.06, 0.06, 0.11, 0.11, 0.22, 0.22, 0.56, 0.56, 1.1, 1.1,
];

const GROWTH: [(f64, f64); 12] = [
    (8.0, 8.0),
    (9.0, 8.4305),
    (10.0, 9.5294),
    (11.0, 10.4627),
    (12.0, 12.0),
    (13.0, 13.0205),
    (14.0, 14.5949),
    (15.0, 16.1078),
    (16.0, 18.0596),
    (18.0, 20.4569),
    (20.0, 24.25),
    (25.0, 32.9863),
];

const HIMMELBF: [(f64, f64); 7] = [
    (0.0, 7.391),
    (0.000428, 11.18),
    (0.001, 16.44),
    (0.00161, 16.2),
    (0.00209, 22.2),
    (0.00348, 24.02),
    (0.00525, 31.32),
];

const PALMER1: [(f64, f64); 35] = [
    (-1.788963, 78.596218),
    (-1.745329, 65.77963),
    (-1.658063, 43.96947),
    (-1.570796, 27.038816),
    (-1.483530, 14.6126),
    (-1.396263, 6.2614),
    (-1.308997, 1.538330),
    (-1.218612, 0.0),
    (-1.134464, 1.188045),
    (-1.047198, 4.6841),
    (-0.872665, 16.9321),
    (-0.698132, 33.6988),
    (-0.523599, 52.3664),
    (-0.349066, 70.1630),
    (-0.174533, 83.4221),
    (0.0, 88.3995),
    (1.788963, 78.596218),
    (1.745329, 65.77963),
    (1.658063, 43.96947),
    (1.570796, 27.038816),
    (1.483530, 14.6126),
    (1.396263, 6.2614),
    (1.308997, 1.538330),
    (1.218612, 0.0),
    (1.134464, 1.188045),
    (1.047198, 4.6841),
    (0.872665, 16.9321),
    (0.698132, 33.6988),
    (0.523599, 52.3664),
    (0.349066, 70.1630),
    (0.174533, 83.4221),
    (-1.8762289, 108.18086),
    (-1.8325957, 92.733676),
    (1.8762289, 108.18086),
    (1.8325957, 92.733676),
];

const PALMER5: [(f64, f64); 12] = [
    (0.0, 83.57418),
    (1.570796, 81.007654),
    (1.396263, 18.983286),
    (1.308997, 8.051067),
    (1.221730, 2.044762),
    (1.125835, 0.0),
    (1.047198, 1.170451),
    (0.872665, 10.479881),
    (0.698132, 25.785001),
    (0.523599, 44.126844),
    (0.349066, 62.822177),
    (0.174533, 77.719674),
];

/// Fourteen curves.
pub fn curves() -> Vec<Case> {
    let free = f64::INFINITY;
    let palmer1a = Case::new("PALMER1A", Palmer1 { terms: 4 }, &[1.0; 6], &[]);
    vec![
        palmer1a.bounded(&[-free, -free, -free, -free, 1e-5, 1e-5], &[free; 6]),
        Case::new("PALMER1C", Palmer1 { terms: 8 }, &[1.0; 8], &[]),
        Case::new("PALMER1D", Palmer1 { terms: 7 }, &[1.0; 7], &[]),
        Case::new("PALMER5C", Palmer5 { chebyshev: true }, &[1.0; 6], &[]),
        Case::new("PALMER5D", Palmer5 { chebyshev: false }, &[1.0; 4], &[]),
        Case::new("GROWTH", Growth, &[100.0, 0.0, 0.0], &[]),
        Case::new("HIMMELBF", HimmelblauF, &[2.7, 90.0, 1500.0, 10.0], &[]),
        Case::new("DEVGLA1", Devgla1, &[2.0; 4], &[]),
        Case::new("DEVGLA2", Devgla2, &[20.0, 2.0, 2.0, 2.0, 0.2], &[]),
        Case::new("Puromycin treated", PuromycinTreated, &[100.0, 0.5], &[]),
        Case::new(
            "Puromycin untreated",
            PuromycinUntreated,
            &[100.0, 0.5],
            &[],
        ),
        Case::new("Oxygen demand", OxygenDemand, &[20.0, 0.24], &[]),
        Case::new("Circle", Circle, &[0.0, 0.0, 1.0], &[]),
        Case::new("Hilbert 8", Hilbert, &[0.0; 8], &[]),
    ]
}
