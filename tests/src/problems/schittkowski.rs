//! Hock and Schittkowski, "Test Examples for Nonlinear Programming Codes", 1981 (HS), and
//! Schittkowski, "More Test Examples for Nonlinear Programming Codes", 1987 (TP): those that are
//! sums of squares.

use solver::{Scalar, lit};

use super::Case;
use super::case::residuals;

/// `α (x₂ − x₁ᵏ)² + (1 − x₁)²`.
#[derive(Clone, Copy, Debug)]
struct Valley {
    alpha: f64,
    power: i32,
}

impl<D: Scalar> solver::Residual<D> for Valley {
    fn residuals(&self, x: &[D], out: &mut Vec<D>) {
        out.push((x[1] - x[0].powi(self.power)) * self.alpha.sqrt());
        out.push(lit::<D>(1.0) - x[0]);
    }
}

residuals!(/// TP 201.
Tp201, |x, out| {
    out.push((x[0] - lit::<D>(5.0)) * 2.0);
    out.push(x[1] - lit::<D>(6.0));
});
residuals!(/// TP 206.
Tp206, |x, out| {
    out.push(x[1] - x[0] * x[0]);
    out.push((lit::<D>(1.0) - x[0]) * 10.0);
});
residuals!(/// TP 212.
Tp212, |x, out| {
    let sum = (x[0] + x[1]) * 4.0;
    let cubic = (x[0] - x[1]) * ((x[0] - lit::<D>(2.0)).powi(2) + x[1] * x[1] - lit::<D>(1.0));
    out.push(sum);
    out.push(sum + cubic);
});
residuals!(/// TP 267.
Tp267, |x, out| {
    for i in 1..=11 {
        let z = 0.1 * f64::from(i);
        let y = (-z).exp() - 5.0 * (-10.0 * z).exp() + 3.0 * (-4.0 * z).exp();
        let model = x[2] * (-x[0] * z).exp() - x[3] * (-x[1] * z).exp() + (-x[4] * z).exp() * 3.0;
        out.push(model - lit::<D>(y));
    }
});
residuals!(/// HS 25.
Hs25, |x, out| {
    for i in 1..=99 {
        let t = f64::from(i) / 100.0;
        let u = 25.0 + (-50.0 * t.ln()).powf(2.0 / 3.0);
        out.push((-((-x[1] + u).ln() * x[2]).exp() / x[0]).exp() - lit::<D>(t));
    }
});
residuals!(/// HS 38 and TP 257.
Colville, |x, out| {
    out.push((x[1] - x[0] * x[0]) * 10.0);
    out.push(lit::<D>(1.0) - x[0]);
    out.push((x[3] - x[2] * x[2]) * 90f64.sqrt());
    out.push(lit::<D>(1.0) - x[2]);
    out.push((x[1] + x[3] - lit::<D>(2.0)) * 10f64.sqrt());
    out.push((x[1] - x[3]) / 10f64.sqrt());
});
residuals!(/// TP 242.
Tp242, |x, out| {
    for i in 1..=10 {
        let t = 0.1 * f64::from(i);
        let drift = x[2] * ((-t).exp() - (-10.0 * t).exp());
        out.push((-x[0] * t).exp() - (-x[1] * t).exp() - drift);
    }
});
residuals!(/// TP 244.
Tp244, |x, out| {
    for i in 1..=10 {
        let z = 0.1 * f64::from(i);
        let y = (-z).exp() - 5.0 * (-10.0 * z).exp();
        out.push((-x[0] * z).exp() - x[2] * (-x[1] * z).exp() - lit::<D>(y));
    }
});
residuals!(/// HS 21 without its constant.
Hs21, |x, out| {
    out.push(x[0] * 0.1);
    out.push(x[1]);
});
residuals!(/// HS 28.
Hs28, |x, out| {
    out.push(x[0] + x[1]);
    out.push(x[1] + x[2]);
});
residuals!(/// HS 48.
Hs48, |x, out| {
    out.push(x[0] - lit::<D>(1.0));
    out.push(x[1] - x[2]);
    out.push(x[3] - x[4]);
});
residuals!(/// HS 49.
Hs49, |x, out| {
    out.push(x[0] - x[1]);
    out.push(x[2] - lit::<D>(1.0));
    out.push((x[3] - lit::<D>(1.0)).powi(2));
    out.push((x[4] - lit::<D>(1.0)).powi(3));
});
residuals!(/// HS 50.
Hs50, |x, out| {
    out.push(x[0] - x[1]);
    out.push(x[1] - x[2]);
    out.push((x[2] - x[3]).powi(2));
    out.push(x[3] - x[4]);
});
residuals!(/// HS 51 and 53.
Hs51, |x, out| {
    out.push(x[0] - x[1]);
    out.push(x[1] + x[2] - lit::<D>(2.0));
    out.push(x[3] - lit::<D>(1.0));
    out.push(x[4] - lit::<D>(1.0));
});
residuals!(/// HS 52.
Hs52, |x, out| {
    out.push(x[0] * 4.0 - x[1]);
    out.push(x[1] + x[2] - lit::<D>(2.0));
    out.push(x[3] - lit::<D>(1.0));
    out.push(x[4] - lit::<D>(1.0));
});

/// Without constraints.
pub fn unconstrained() -> Vec<Case> {
    let valley = |alpha: f64, power: i32| Valley { alpha, power };
    vec![
        Case::new("TP201", Tp201, &[8.0, 9.0], &[0.0]),
        Case::new("TP206", Tp206, &[-1.2, 1.0], &[0.0]),
        Case::new("TP207", valley(1.0, 2), &[-1.2, 1.0], &[0.0]),
        Case::new("TP209", valley(1e4, 2), &[-1.2, 1.0], &[0.0]),
        Case::new("TP210", valley(1e6, 2), &[-1.2, 1.0], &[0.0]),
        Case::new("TP211", valley(100.0, 3), &[-1.2, 1.0], &[0.0]),
        Case::new("TP212", Tp212, &[2.0, -2.0], &[0.0]),
        Case::new("TP267", Tp267, &[2.0; 5], &[0.0]),
    ]
}

/// With bounds.
pub fn bounded() -> Vec<Case> {
    const FREE: f64 = f64::INFINITY;
    let rosenbrock = Valley {
        alpha: 100.0,
        power: 2,
    };
    // HS 2: x₂ = 3/2 and x₁ the largest and the smallest root of 200 x₁³ − 299 x₁ − 1 = 0.
    let hs2 = [0.050_426_187_9, 4.941_229_318];
    vec![
        Case::new("HS1", rosenbrock, &[-2.0, 1.0], &[0.0]).bounded(&[-FREE, -1.5], &[FREE; 2]),
        Case::new("HS2", rosenbrock, &[-2.0, 1.5], &hs2).bounded(&[-FREE, 1.5], &[FREE; 2]),
        Case::new("HS25", Hs25, &[100.0, 12.5, 3.0], &[0.0])
            .bounded(&[0.1, 0.0, 0.0], &[100.0, 25.6, 5.0]),
        Case::new("HS38", Colville, &[-3.0, -1.0, -3.0, -1.0], &[0.0])
            .bounded(&[-10.0; 4], &[10.0; 4]),
        Case::new("TP229", rosenbrock, &[-1.2, 1.0], &[0.0]).bounded(&[-2.0; 2], &[2.0; 2]),
        Case::new("TP242", Tp242, &[2.5, 10.0, 10.0], &[0.0]).bounded(&[0.0; 3], &[10.0; 3]),
        Case::new("TP244", Tp244, &[1.0, 2.0, 1.0], &[0.0]).bounded(&[0.0; 3], &[10.0; 3]),
        Case::new("TP257", Colville, &[0.0; 4], &[0.0]).bounded(&[0.0; 4], &[FREE; 4]),
    ]
}

/// With linear constraints. The published starts of 21, 52 and 53 do not meet them.
pub fn linear() -> Vec<Case> {
    const FREE: f64 = f64::INFINITY;
    let chain = |case: Case, first: f64| {
        case.linear(&[1.0, 3.0, 0.0, 0.0, 0.0], first, first)
            .linear(&[0.0, 0.0, 1.0, 1.0, -2.0], 0.0, 0.0)
            .linear(&[0.0, 1.0, 0.0, 0.0, -1.0], 0.0, 0.0)
    };
    vec![
        Case::new("HS21", Hs21, &[-1.0, -1.0], &[0.04])
            .bounded(&[2.0, -50.0], &[50.0, 50.0])
            .linear(&[10.0, -1.0], 10.0, FREE),
        Case::new("HS28", Hs28, &[-4.0, 1.0, 1.0], &[0.0]).linear(&[1.0, 2.0, 3.0], 1.0, 1.0),
        Case::new("HS48", Hs48, &[3.0, 5.0, -3.0, 2.0, -2.0], &[0.0])
            .linear(&[1.0; 5], 5.0, 5.0)
            .linear(&[0.0, 0.0, 1.0, -2.0, -2.0], -3.0, -3.0),
        Case::new("HS49", Hs49, &[10.0, 7.0, 2.0, -3.0, 0.8], &[0.0])
            .linear(&[1.0, 1.0, 1.0, 4.0, 0.0], 7.0, 7.0)
            .linear(&[0.0, 0.0, 1.0, 0.0, 5.0], 6.0, 6.0),
        Case::new("HS50", Hs50, &[35.0, -31.0, 11.0, 5.0, -5.0], &[0.0])
            .linear(&[1.0, 2.0, 3.0, 0.0, 0.0], 6.0, 6.0)
            .linear(&[0.0, 1.0, 2.0, 3.0, 0.0], 6.0, 6.0)
            .linear(&[0.0, 0.0, 1.0, 2.0, 3.0], 6.0, 6.0),
        chain(
            Case::new("HS51", Hs51, &[2.5, 0.5, 2.0, -1.0, 0.5], &[0.0]),
            4.0,
        ),
        chain(Case::new("HS52", Hs52, &[2.0; 5], &[1859.0 / 349.0]), 0.0),
        chain(
            Case::new("HS53", Hs51, &[2.0; 5], &[176.0 / 43.0]).bounded(&[-10.0; 5], &[10.0; 5]),
            0.0,
        ),
    ]
}
