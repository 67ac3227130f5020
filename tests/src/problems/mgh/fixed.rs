//! Problems 1 to 19, of fixed size.

use solver::{Residual, Scalar, lit};

use crate::problems::Case;
use crate::problems::case::residuals;

residuals!(/// 1.
Rosenbrock, |x, out| {
    out.push((x[1] - x[0] * x[0]) * 10.0);
    out.push(lit::<D>(1.0) - x[0]);
});
residuals!(/// 2.
FreudensteinRoth, |x, out| {
    out.push(x[0] + ((lit::<D>(5.0) - x[1]) * x[1] - lit::<D>(2.0)) * x[1] - lit::<D>(13.0));
    out.push(x[0] + ((x[1] + 1.0) * x[1] - lit::<D>(14.0)) * x[1] - lit::<D>(29.0));
});
residuals!(/// 3.
PowellBadlyScaled, |x, out| {
    out.push(x[0] * x[1] * 1e4 - lit::<D>(1.0));
    out.push((-x[0]).exp() + (-x[1]).exp() - lit::<D>(1.0001));
});
residuals!(/// 4.
BrownBadlyScaled, |x, out| {
    out.push(x[0] - lit::<D>(1e6));
    out.push(x[1] - lit::<D>(2e-6));
    out.push(x[0] * x[1] - lit::<D>(2.0));
});
residuals!(/// 5.
Beale, |x, out| {
    for (i, y) in [1.5, 2.25, 2.625].into_iter().enumerate() {
        out.push(lit::<D>(y) - x[0] * (lit::<D>(1.0) - x[1].powi(i as i32 + 1)));
    }
});
residuals!(/// 6.
JennrichSampson, |x, out| {
    for i in 1..=10 {
        let i = f64::from(i);
        out.push(lit::<D>(2.0 + 2.0 * i) - ((x[0] * i).exp() + (x[1] * i).exp()));
    }
});
residuals!(/// 7.
HelicalValley, |x, out| {
    let half_turn = if x[0].re() > 0.0 { 0.0 } else { 0.5 };
    let theta = (x[1] / x[0]).atan() / (2.0 * std::f64::consts::PI) + half_turn;
    out.push((x[2] - theta * 10.0) * 10.0);
    out.push(((x[0] * x[0] + x[1] * x[1]).sqrt() - lit::<D>(1.0)) * 10.0);
    out.push(x[2]);
});
residuals!(/// 8.
Bard, |x, out| {
    for (i, y) in BARD.into_iter().enumerate() {
        let u = i as f64 + 1.0;
        let v = 16.0 - u;
        out.push(lit::<D>(y) - (x[0] + (x[1] * v + x[2] * u.min(v)).recip() * u));
    }
});
residuals!(/// 9.
Gaussian, |x, out| {
    for (i, y) in GAUSSIAN.into_iter().enumerate() {
        let t = (7.0 - i as f64) / 2.0;
        let d = -x[2] + t;
        out.push(x[0] * (-x[1] * d * d / 2.0).exp() - lit::<D>(y));
    }
});
residuals!(/// 10.
Meyer, |x, out| {
    for (i, y) in MEYER.into_iter().enumerate() {
        let t = 50.0 + 5.0 * i as f64;
        out.push(x[0] * (x[1] / (x[2] + t)).exp() - lit::<D>(y));
    }
});
/// 11 with `m` residuals; its "y m i x2" is a misprint of "y - x2" (Hock and Schittkowski, 25).
#[derive(Clone, Copy, Debug)]
pub struct Gulf(pub u32);

impl<D: Scalar> Residual<D> for Gulf {
    fn residuals(&self, x: &[D], out: &mut Vec<D>) {
        for i in 1..=self.0 {
            let t = f64::from(i) / 100.0;
            let y = 25.0 + (-50.0 * t.ln()).powf(2.0 / 3.0);
            let size = (-x[1] + y).abs();
            out.push((-(size.ln() * x[2]).exp() / x[0]).exp() - lit::<D>(t));
        }
    }
}

/// 12 with `m` residuals.
#[derive(Clone, Copy, Debug)]
pub struct Box3(pub u32);

impl<D: Scalar> Residual<D> for Box3 {
    fn residuals(&self, x: &[D], out: &mut Vec<D>) {
        for i in 1..=self.0 {
            let t = 0.1 * f64::from(i);
            let drift = x[2] * ((-t).exp() - (-10.0 * t).exp());
            out.push((-x[0] * t).exp() - (-x[1] * t).exp() - drift);
        }
    }
}

residuals!(/// 13.
PowellSingular, |x, out| {
    out.push(x[0] + x[1] * 10.0);
    out.push((x[2] - x[3]) * 5f64.sqrt());
    out.push((x[1] - x[2] * 2.0).powi(2));
    out.push((x[0] - x[3]).powi(2) * 10f64.sqrt());
});
residuals!(/// 14.
Wood, |x, out| {
    out.push((x[1] - x[0] * x[0]) * 10.0);
    out.push(lit::<D>(1.0) - x[0]);
    out.push((x[3] - x[2] * x[2]) * 90f64.sqrt());
    out.push(lit::<D>(1.0) - x[2]);
    out.push((x[1] + x[3] - lit::<D>(2.0)) * 10f64.sqrt());
    out.push((x[1] - x[3]) / 10f64.sqrt());
});
residuals!(/// 15.
KowalikOsborne, |x, out| {
    for [y, u] in KOWALIK {
        out.push(lit::<D>(y) - x[0] * (x[1] * u + u * u) / (x[2] * u + x[3] + u * u));
    }
});
residuals!(/// 16.
BrownDennis, |x, out| {
    for i in 1..=20 {
        let t = f64::from(i) / 5.0;
        out.push((x[0] + x[1] * t - lit::<D>(t.exp())).powi(2)
            + (x[2] + x[3] * t.sin() - lit::<D>(t.cos())).powi(2));
    }
});
residuals!(/// 17.
Osborne1, |x, out| {
    for (i, y) in OSBORNE_1.into_iter().enumerate() {
        let t = 10.0 * i as f64;
        out.push(lit::<D>(y) - (x[0] + x[1] * (-x[3] * t).exp() + x[2] * (-x[4] * t).exp()));
    }
});
residuals!(/// 18.
BiggsExp6, |x, out| {
    for i in 1..=13 {
        let t = 0.1 * f64::from(i);
        let y = (-t).exp() - 5.0 * (-10.0 * t).exp() + 3.0 * (-4.0 * t).exp();
        let model = x[2] * (-x[0] * t).exp() - x[3] * (-x[1] * t).exp() + x[5] * (-x[4] * t).exp();
        out.push(model - lit::<D>(y));
    }
});
residuals!(/// 19.
Osborne2, |x, out| {
    for (i, y) in OSBORNE_2.into_iter().enumerate() {
        let t = i as f64 / 10.0;
        let peak = |k: usize| x[k] * (-(-x[k + 7] + t).powi(2) * x[k + 4]).exp();
        out.push(lit::<D>(y) - (x[0] * (-x[4] * t).exp() + peak(1) + peak(2) + peak(3)));
    }
});

/// Problems 1 to 19 with their standard starts.
pub fn nineteen() -> Vec<Case> {
    vec![
        Case::new("MGH01 Rosenbrock", Rosenbrock, &[-1.2, 1.0], &[0.0]),
        Case::new(
            "MGH02 Freudenstein-Roth",
            FreudensteinRoth,
            &[0.5, -2.0],
            &[0.0, 48.984_253_679],
        ),
        Case::new(
            "MGH03 Powell badly scaled",
            PowellBadlyScaled,
            &[0.0, 1.0],
            &[0.0],
        ),
        Case::new(
            "MGH04 Brown badly scaled",
            BrownBadlyScaled,
            &[1.0, 1.0],
            &[0.0],
        ),
        Case::new("MGH05 Beale", Beale, &[1.0, 1.0], &[0.0]),
        Case::new(
            "MGH06 Jennrich-Sampson",
            JennrichSampson,
            &[0.3, 0.4],
            &[124.362_182_355_615],
        ),
        Case::new(
            "MGH07 helical valley",
            HelicalValley,
            &[-1.0, 0.0, 0.0],
            &[0.0],
        ),
        // The second minimum lies at infinity in the last two parameters.
        Case::new(
            "MGH08 Bard",
            Bard,
            &[1.0, 1.0, 1.0],
            &[8.214_877_306_578_97e-3, 17.428_692_8],
        ),
        Case::new(
            "MGH09 Gaussian",
            Gaussian,
            &[0.4, 1.0, 0.0],
            &[1.127_932_769_618_7e-8],
        ),
        Case::new(
            "MGH10 Meyer",
            Meyer,
            &[0.02, 4000.0, 250.0],
            &[87.945_855_170_86],
        ),
        Case::new("MGH11 Gulf", Gulf(99), &[5.0, 2.5, 0.15], &[0.0]),
        Case::new("MGH12 Box", Box3(10), &[0.0, 10.0, 20.0], &[0.0]),
        Case::new(
            "MGH13 Powell singular",
            PowellSingular,
            &[3.0, -1.0, 0.0, 1.0],
            &[0.0],
        ),
        Case::new("MGH14 Wood", Wood, &[-3.0, -1.0, -3.0, -1.0], &[0.0]),
        // The second minimum lies at infinity in the first parameter.
        Case::new(
            "MGH15 Kowalik-Osborne",
            KowalikOsborne,
            &[0.25, 0.39, 0.415, 0.39],
            &[3.075_056_038_492e-4, 1.027_34e-3],
        ),
        Case::new(
            "MGH16 Brown-Dennis",
            BrownDennis,
            &[25.0, 5.0, -5.0, -1.0],
            &[85_822.201_626_356],
        ),
        Case::new(
            "MGH17 Osborne 1",
            Osborne1,
            &[0.5, 1.5, -1.0, 0.01, 0.02],
            &[5.464_894_697_482e-5],
        ),
        Case::new(
            "MGH18 Biggs EXP6",
            BiggsExp6,
            &[1.0, 2.0, 1.0, 1.0, 1.0, 1.0],
            &[0.0, 5.655_649_925e-3],
        ),
        Case::new(
            "MGH19 Osborne 2",
            Osborne2,
            &[1.3, 0.65, 0.65, 0.7, 0.6, 3.0, 5.0, 7.0, 2.0, 4.5, 5.5],
            &[4.013_773_629_355e-2],
        ),
    ]
}

const BARD: [f64; 15] = [
    0.14, 0.18, 0.22, 0.25, 0.29, 0.32, 0.35, 0.39, 0.37, 0.58, 0.73, 0.96, 1.34, 2.10, 4.39,
];
const GAUSSIAN: [f64; 15] = [
    0.0009, 0.0044, 0.0175, 0.0540, 0.1295, 0.2420, 0.3521, 0.3989, 0.3521, 0.2420, 0.1295, 0.0540,
    0.0175, 0.0044, 0.0009,
];
const MEYER: [f64; 16] = [
    34780.0, 28610.0, 23650.0, 19630.0, 16370.0, 13720.0, 11540.0, 9744.0, 8261.0, 7030.0, 6005.0,
    5147.0, 4427.0, 3820.0, 3307.0, 2872.0,
];
const KOWALIK: [[f64; 2]; 11] = [
    [0.1957, 4.0],
    [0.1947, 2.0],
    [0.1735, 1.0],
    [0.1600, 0.5],
    [0.0844, 0.25],
    [0.0627, 0.167],
    [0.0456, 0.125],
    [0.0342, 0.1],
    [0.0323, 0.0833],
    [0.0235, 0.0714],
    [0.0246, 0.0625],
];
const OSBORNE_1: [f64; 33] = [
    0.844, 0.908, 0.932, 0.936, 0.925, 0.908, 0.881, 0.850, 0.818, 0.784, 0.751, 0.718, 0.685,
    0.658, 0.628, 0.603, 0.580, 0.558, 0.538, 0.522, 0.506, 0.490, 0.478, 0.467, 0.457, 0.448,
    0.438, 0.431, 0.424, 0.420, 0.414, 0.411, 0.406,
];
const OSBORNE_2: [f64; 65] = [
    1.366, 1.191, 1.112, 1.013, 0.991, 0.885, 0.831, 0.847, 0.786, 0.725, 0.746, 0.679, 0.608,
    0.655, 0.616, 0.606, 0.602, 0.626, 0.651, 0.724, 0.649, 0.649, 0.694, 0.644, 0.624, 0.661,
    0.612, 0.558, 0.533, 0.495, 0.500, 0.423, 0.395, 0.375, 0.372, 0.391, 0.396, 0.405, 0.428,
    0.429, 0.523, 0.562, 0.607, 0.653, 0.672, 0.708, 0.633, 0.668, 0.645, 0.632, 0.591, 0.559,
    0.597, 0.625, 0.739, 0.710, 0.729, 0.720, 0.636, 0.581, 0.428, 0.292, 0.162, 0.098, 0.054,
];
