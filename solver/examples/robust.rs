//! Outliers: a loss whose scale is estimated, from a far start by graduation; then a loss of one's own.

use stillpoint_solver::{
    Jet, Loss, LossFunction, LossScale, Mask, Options, Parameters, from_fn, solve,
};

/// Fair's loss, `ρ(s) = 2 (√s − ln(1 + √s))`, with its two derivatives.
#[derive(Debug)]
struct Fair;

impl LossFunction for Fair {
    fn at(&self, s: f64) -> [f64; 3] {
        let root = s.sqrt().max(1e-150);
        let below = 1.0 + root;
        [
            2.0 * (root - root.ln_1p()),
            1.0 / below,
            -0.5 / (root * below * below),
        ]
    }
}

fn main() -> Result<(), stillpoint_solver::Error> {
    let noise =
        |i: usize| 0.01 * ((7 * i) % 5) as f64 - 0.02 + if i.is_multiple_of(4) { 3.0 } else { 0.0 };
    let line = from_fn(|x: &[Jet], out: &mut Vec<Jet>| {
        out.extend((0..40).map(|i| x[0] + x[1] * i as f64 - (1.0 + 0.5 * i as f64 + noise(i))));
    });
    let start = Parameters::unnamed(&[100.0, -30.0]);
    for loss in [
        Loss::Tukey(LossScale::Estimated(4.685)),
        Loss::own(&Fair, LossScale::Given(0.02)),
    ] {
        let fit = solve(
            &line,
            &start,
            &Mask::all(2),
            &Options {
                loss,
                graduated: true,
                ..Options::default()
            },
        )?;
        print!("{loss:?}\n{fit}");
        assert!((fit.parameters.values()[1] - 0.5).abs() < 0.01);
    }
    Ok(())
}
