//! Bounds, an order and a linear constraint, by name; multipliers of those that hold.

use stillpoint_solver::{Constraints, DualNum, Jet, Mask, Options, Parameters, from_fn, solve};

fn main() -> Result<(), stillpoint_solver::Error> {
    let data = [(0.0, 3.1), (1.0, 1.3), (2.0, 0.7), (3.0, 0.3), (4.0, 0.2)];
    let two_rates = from_fn(|x: &[Jet], out: &mut Vec<Jet>| {
        out.extend(
            data.iter()
                .map(|&(t, y)| x[0] * (-x[1] * t).exp() + x[2] * (-x[3] * t).exp() - y),
        );
    });
    let mut start = Parameters::new();
    for (name, value) in [("a", 1.0), ("slow", 0.2), ("b", 1.0), ("fast", 2.0)] {
        start.push(name, "", value);
    }
    let constraints = Constraints::new()
        .bound("slow", 0.1, f64::INFINITY)
        .order("slow", "fast")
        .equal(&[("a", 1.0), ("b", 1.0)], 3.0);
    constraints.project(&mut start, &Mask::all(4))?;
    let fit = solve(
        &two_rates,
        &start,
        &Mask::all(4),
        &Options {
            constraints,
            ..Options::default()
        },
    )?;
    print!("{fit}");
    assert!(fit.infeasibility < 1e-12);
    Ok(())
}
