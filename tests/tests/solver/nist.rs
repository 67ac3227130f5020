//! The default solver on NIST's nonlinear regression problems.

use solver::{Mask, Options, Report, solve};
use stillpoint_tests::needed_data::needed;
use stillpoint_tests::problems::nist::Regression;

/// The problems; the test is to end where their files are missing.
fn problems() -> Option<Vec<Regression>> {
    let folder = needed("nist")?;
    Some(Regression::all(&folder).unwrap())
}

fn fit(problem: &Regression, start: usize) -> Report {
    let start = problem.start(start);
    solve(
        problem,
        &start,
        &Mask::all(start.len()),
        &Options::default(),
    )
    .unwrap()
}

#[test]
fn every_problem_agrees_with_the_certified_values_to_ten_digits_from_both_starts() {
    let Some(problems) = problems() else { return };
    let mut jacobians = 0;
    for problem in &problems {
        for start in [1, 2] {
            let report = fit(problem, start);
            let (digits, reason) = (
                problem.digits(report.parameters.values()),
                report.termination,
            );
            assert!(
                digits >= 10.0 && reason.converged(),
                "{} {start}: {digits:.1} {reason:?}",
                problem.data.name
            );
            jacobians += report.jacobian_evaluations;
        }
    }
    println!("{jacobians} Jacobians");
    assert!(jacobians <= 2500, "{jacobians} Jacobian evaluations");
}

#[test]
fn the_certified_values_are_left_where_they_are() {
    for problem in problems().iter().flatten() {
        let digits = problem.digits(fit(problem, 3).parameters.values());
        assert!(digits >= 9.0, "{}: {digits:.1}", problem.data.name);
    }
}

#[test]
fn standard_errors_and_sums_of_squares_are_the_certified_ones() {
    for problem in problems()
        .iter()
        .flatten()
        .filter(|p| p.data.name != "Lanczos1")
    {
        let report = fit(problem, 2);
        // Certified to eleven digits; a sum of squares of 1e-11 (Lanczos2) is known to fewer.
        assert!(
            (2.0 * report.cost / problem.data.sum_of_squares - 1.0).abs() < 1e-8,
            "{}",
            problem.data.name
        );
        let sigma = report.reduced_chi2().unwrap().sqrt();
        for (k, certified) in problem.data.deviations.iter().enumerate() {
            let relative = report.uncertainty.standard_error(k, sigma) / certified - 1.0;
            assert!(
                relative.abs() < 1e-6,
                "{} b{}: {relative:e}",
                problem.data.name,
                k + 1
            );
        }
    }
}
