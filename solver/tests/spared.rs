//! What is evaluated no more often than it pays.
#![allow(clippy::unwrap_used)]

use stillpoint_solver::{Mask, Options, Parameters, Residual, Scalar, solve};

const INSTANTS: usize = 20;

/// `y = a e^(−b t)`.
struct Decay([f64; INSTANTS]);

impl<D: Scalar> Residual<D> for Decay {
    fn residuals(&self, x: &[D], out: &mut Vec<D>) {
        for (k, y) in self.0.iter().enumerate() {
            out.push(x[0] * (-x[1] * (0.2 * k as f64)).exp() - *y);
        }
    }
}

/// Twenty for every start, as `benches/peers/decays.py` makes them.
fn decays(next: &mut impl FnMut() -> f64) -> Vec<Decay> {
    let mut one = || {
        let (a, b) = (2.0 + next(), 0.8 + next());
        Decay(std::array::from_fn(|k| {
            a * (-b * 0.2 * k as f64).exp() + 0.05 * next()
        }))
    };
    (0..20).map(|_| one()).collect()
}

fn numbers() -> impl FnMut() -> f64 {
    let mut state = 1u64;
    move || {
        state = state
            .wrapping_mul(6_364_136_223_846_793_005)
            .wrapping_add(1);
        (state >> 11) as f64 / (1u64 << 53) as f64 - 0.5
    }
}

/// Starts, and the Jacobians of twenty fits by scipy 1.17.1's `least_squares` (trf, its own tolerances, which end where the cost falls by
/// less than 1e-8 of itself): printed by `benches/peers/decays.py`.
const TRF: [([f64; 2], usize); 4] = [
    ([1.0, 1.0], 134),
    ([5.0, 3.0], 144),
    ([1.0, 0.0], 128),
    ([0.1, 5.0], 132),
];

#[test]
fn twenty_decays_take_no_more_jacobians_than_scipys_trf_to_the_same_tolerance() {
    // The cost is offset² of itself above the minimum.
    let options = Options {
        gradient_tolerance: 1e-4,
        last_digits: false,
        ..Options::default()
    };
    let (mut ours, mut theirs) = (0, 0);
    let mut next = numbers();
    for (start, jacobians) in TRF {
        let start = Parameters::unnamed(&start);
        for decay in decays(&mut next) {
            let report = solve(&decay, &start, &Mask::all(2), &options).unwrap();
            let exact = solve(&decay, &start, &Mask::all(2), &Options::default()).unwrap();
            assert!(report.termination.converged(), "{report}");
            assert!(report.cost <= exact.cost * (1.0 + 2e-8), "{report}{exact}");
            assert!(report.evaluations.jacobians < exact.evaluations.jacobians);
            ours += report.evaluations.jacobians;
        }
        theirs += jacobians;
    }
    println!("{ours} Jacobians, trf {theirs}");
    assert!(ours <= theirs, "{ours} Jacobians, trf {theirs}");
}

#[test]
fn whole_hessians_take_no_more_second_derivatives_than_a_slow_run_is_worth() {
    /// Rosenbrock's valley chained through twenty numbers: whole Hessians are 210 second derivatives each.
    struct Chain;
    impl<D: Scalar> Residual<D> for Chain {
        fn residuals(&self, x: &[D], out: &mut Vec<D>) {
            for pair in x.windows(2) {
                out.extend([(pair[0] * pair[0] - pair[1]) * 10.0, pair[0] - 1.0]);
            }
        }
    }
    let start: Vec<f64> = (0..20)
        .map(|k| if k % 2 == 0 { -1.2 } else { 1.0 })
        .collect();
    let start = Parameters::unnamed(&start);
    let report = solve(&Chain, &start, &Mask::all(20), &Options::default()).unwrap();
    assert!(
        report.termination.converged() && report.cost < 1e-20,
        "{report}"
    );
    let taken = report
        .iterations
        .iter()
        .filter(|step| step.accepted)
        .count();
    assert!(taken > 30, "{report}");
    // Four a step taken, and one for every step bent.
    let most = 4 * taken + report.iterations.len();
    let last = 210;
    assert!(
        report.evaluations.second_derivatives <= most + last,
        "{report}"
    );
}
