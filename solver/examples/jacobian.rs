//! A Jacobian of one's own: two closures over plain slices, checked against differences.

use stillpoint_solver::{
    Mask, Options, Parameters, check_derivatives, from_fn_with_jacobian, solve,
};

fn main() -> Result<(), stillpoint_solver::Error> {
    let valley = from_fn_with_jacobian(
        |x, r| r.extend([10.0 * (x[1] - x[0] * x[0]), 1.0 - x[0]]),
        |x, j| j.extend([-20.0 * x[0], 10.0, -1.0, 0.0]), // row by row
    );
    let start = Parameters::unnamed(&[-1.2, 1.0]);
    assert!(check_derivatives(&valley, &start, 1e-6).is_empty());
    let fit = solve(&valley, &start, &Mask::all(2), &Options::default())?;
    print!("{fit}");
    assert!((fit.parameters.values()[1] - 1.0).abs() < 1e-12);
    Ok(())
}
