//! A curve through data: written once over any scalar, fitted, with errors.

use stillpoint_solver::{Mask, Options, Parameters, Residual, Scalar, solve};

struct Decay<'a>(&'a [(f64, f64)]);

impl<D: Scalar> Residual<D> for Decay<'_> {
    fn residuals(&self, b: &[D], out: &mut Vec<D>) {
        out.extend(self.0.iter().map(|&(t, y)| b[0] * (-b[1] * t).exp() - y));
    }
}

fn main() -> Result<(), stillpoint_solver::Error> {
    let data = [
        (0.0, 2.03),
        (0.5, 1.55),
        (1.0, 1.24),
        (1.5, 0.93),
        (2.0, 0.75),
    ];
    let mut start = Parameters::new();
    start.push("amplitude", "V", 1.0);
    start.push("rate", "1/s", 1.0);
    let fit = solve(&Decay(&data), &start, &Mask::all(2), &Options::default())?;
    print!("{fit}");
    assert!((fit.parameters.values()[1] - 0.5).abs() < 0.05);
    Ok(())
}
