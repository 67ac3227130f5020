//! The default solver on NIST's nonlinear regression problems.

use solver::{Mask, Options, solve};
use stillpoint_tests::problems::nist::{Regression, default_folder};

#[test]
fn tmp_table() {
    let problems = Regression::all(&default_folder()).unwrap();
    let variants = if std::env::var("ALLV").is_ok() { solver::Variant::all() } else { vec![Default::default()] };
    for variant in variants {
        let options = Options { variant, ..Default::default() };
        let mut total = 0;
        let mut counts = [0; 5];
        let mut trials = 0;
        for start in 1..=3 {
            for p in &problems {
                let s = p.start(start);
                let report = solve(p, &s, &Mask::all(s.len()), &options).unwrap();
                let d = p.digits(report.parameters.values());
                if std::env::var("V").is_ok() || d < 9.0 && std::env::var("ALLV").is_err() || start==3 && d<9.0 {
                println!("{} {start}: {d:.1} {:?} it {} jac {}", p.data.name, report.termination, report.iterations.len(), report.jacobian_evaluations);
                }
                if start < 3 {
                    total += report.jacobian_evaluations;
                    trials += report.iterations.len();
                    for (c, t) in counts.iter_mut().zip([4.0, 6.0, 8.0, 9.0, 10.0]) { if d >= t { *c += 1; } }
                }
            }
        }
        println!("{}: {counts:?} jac {total} trials {trials}", variant.name());
    }
}
