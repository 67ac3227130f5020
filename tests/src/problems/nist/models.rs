//! The 27 models, as the files print them.

use std::f64::consts::PI;

use solver::{Scalar, lit};

/// A regression function `y = f(x; b)`.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[allow(missing_docs)]
pub enum Model {
    Bennett5,
    ExponentialRise,
    Chwirut,
    Power,
    Enso,
    Eckerle4,
    Gauss,
    CubicOverCubic,
    QuadraticOverQuadratic,
    Lanczos,
    Mgh09,
    Mgh10,
    Mgh17,
    Misra1b,
    Misra1c,
    Misra1d,
    Nelson,
    Rat42,
    Rat43,
    Roszman1,
}

impl Model {
    /// File name and model of every problem.
    pub const ALL: [(&'static str, Self); 27] = [
        ("Bennett5", Self::Bennett5),
        ("BoxBOD", Self::ExponentialRise),
        ("Chwirut1", Self::Chwirut),
        ("Chwirut2", Self::Chwirut),
        ("DanWood", Self::Power),
        ("ENSO", Self::Enso),
        ("Eckerle4", Self::Eckerle4),
        ("Gauss1", Self::Gauss),
        ("Gauss2", Self::Gauss),
        ("Gauss3", Self::Gauss),
        ("Hahn1", Self::CubicOverCubic),
        ("Kirby2", Self::QuadraticOverQuadratic),
        ("Lanczos1", Self::Lanczos),
        ("Lanczos2", Self::Lanczos),
        ("Lanczos3", Self::Lanczos),
        ("MGH09", Self::Mgh09),
        ("MGH10", Self::Mgh10),
        ("MGH17", Self::Mgh17),
        ("Misra1a", Self::ExponentialRise),
        ("Misra1b", Self::Misra1b),
        ("Misra1c", Self::Misra1c),
        ("Misra1d", Self::Misra1d),
        ("Nelson", Self::Nelson),
        ("Rat42", Self::Rat42),
        ("Rat43", Self::Rat43),
        ("Roszman1", Self::Roszman1),
        ("Thurber", Self::CubicOverCubic),
    ];

    /// `f(x; b)`; for Nelson the logarithm of the response.
    pub fn predict<D: Scalar>(self, b: &[D], predictors: &[f64]) -> D {
        let x = predictors[0];
        let one = lit::<D>(1.0);
        match self {
            Self::Bennett5 => b[0] * (-(b[1] + x).ln() / b[2]).exp(),
            Self::ExponentialRise => b[0] * (one - (-b[1] * x).exp()),
            Self::Chwirut => (-b[0] * x).exp() / (b[1] + b[2] * x),
            Self::Power => b[0] * (b[1] * x.ln()).exp(),
            Self::Enso => enso(b, x),
            Self::Eckerle4 => b[0] / b[1] * (((-b[2] + x) / b[1]).powi(2) * -0.5).exp(),
            Self::Gauss => b[0] * (-b[1] * x).exp() + peak(&b[2..5], x) + peak(&b[5..8], x),
            Self::CubicOverCubic => {
                let top = b[0] + b[1] * x + b[2] * x.powi(2) + b[3] * x.powi(3);
                top / (one + b[4] * x + b[5] * x.powi(2) + b[6] * x.powi(3))
            }
            Self::QuadraticOverQuadratic => {
                (b[0] + b[1] * x + b[2] * x.powi(2)) / (one + b[3] * x + b[4] * x.powi(2))
            }
            Self::Lanczos => {
                b[0] * (-b[1] * x).exp() + b[2] * (-b[3] * x).exp() + b[4] * (-b[5] * x).exp()
            }
            Self::Mgh09 => b[0] * (b[1] * x + x * x) / (b[2] * x + b[3] + x * x),
            Self::Mgh10 => b[0] * (b[1] / (b[2] + x)).exp(),
            Self::Mgh17 => b[0] + b[1] * (-b[3] * x).exp() + b[2] * (-b[4] * x).exp(),
            Self::Misra1b => b[0] * (one - (one + b[1] * x * 0.5).powi(-2)),
            Self::Misra1c => b[0] * (one - (one + b[1] * x * 2.0).sqrt().recip()),
            Self::Misra1d => b[0] * b[1] * x / (one + b[1] * x),
            Self::Nelson => b[0] - b[1] * x * (-b[2] * predictors[1]).exp(),
            Self::Rat42 => b[0] / (one + (b[1] - b[2] * x).exp()),
            Self::Rat43 => b[0] * (-(one + (b[1] - b[2] * x).exp()).ln() / b[3]).exp(),
            Self::Roszman1 => b[0] - b[1] * x - (b[2] / (-b[3] + x)).atan() / PI,
        }
    }
}

/// `a · exp(−((x − m) / w)²)`.
fn peak<D: Scalar>(b: &[D], x: f64) -> D {
    b[0] * (-((-b[1] + x) / b[2]).powi(2)).exp()
}

/// A year's cycle and two of unknown period.
fn enso<D: Scalar>(b: &[D], x: f64) -> D {
    let year = 2.0 * PI * x / 12.0;
    let first = b[3].recip() * (2.0 * PI * x);
    let second = b[6].recip() * (2.0 * PI * x);
    b[0] + b[1] * year.cos()
        + b[2] * year.sin()
        + b[4] * first.cos()
        + b[5] * first.sin()
        + b[7] * second.cos()
        + b[8] * second.sin()
}
