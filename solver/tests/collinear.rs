//! Endings where columns of the Jacobian are nearly one, though the residuals tell their parameters apart.
#![allow(clippy::unwrap_used)]

use stillpoint_solver::{
    Damping, Mask, Options, Parameters, Report, Residual, Scalar, Variant, solve,
};

/// `x₀ e^(−x₁ a) + x₂ c + x₃ cos(x₄ b) + sin(x₅ c) + x₆ a b + x₇ + x₈ b²`: where `x₅` is small the columns of `x₂` and `x₅` are both `c`.
struct Sum(Vec<[f64; 4]>);

fn sum<D: Scalar>(x: &[D], a: f64, b: f64, c: f64) -> D {
    let (decay, wave) = ((-x[1] * a).exp(), (x[4] * b).cos());
    x[0] * decay
        + x[2] * c
        + x[3] * wave
        + (x[5] * c).sin()
        + x[6] * (a * b)
        + x[7]
        + x[8] * (b * b)
}

impl<D: Scalar> Residual<D> for Sum {
    fn residuals(&self, x: &[D], out: &mut Vec<D>) {
        out.extend(self.0.iter().map(|&[a, b, c, y]| sum(x, a, b, c) - y));
    }
}

/// Numbers between −½ and ½.
fn numbers(seed: u64) -> impl FnMut() -> f64 {
    let mut state = seed.wrapping_mul(77).wrapping_add(5);
    let mut next = move || {
        state = state
            .wrapping_mul(6_364_136_223_846_793_005)
            .wrapping_add(1_442_695_040_888_963_407);
        (state >> 11) as f64 / (1u64 << 53) as f64 - 0.5
    };
    (0..5).for_each(|_| {
        next();
    });
    next
}

/// Rows with errors of up to 0.005, `|c| ≤ 0.1`.
fn data(seed: u64, rows: usize) -> Sum {
    let mut next = numbers(seed);
    let middle = [1.0, 0.5, 0.3, 0.7, 0.9, 2.0, 0.4, 1.0, 0.8];
    let truth: Vec<f64> = (0..9)
        .map(|k| middle[k] + next() * if k == 5 { 2.0 } else { 1.0 })
        .collect();
    let places: Vec<[f64; 3]> = (0..rows)
        .map(|_| [2.0 * (next() + 0.5), 3.0 * (next() + 0.5), 0.2 * next()])
        .collect();
    let row = |[a, b, c]: [f64; 3]| [a, b, c, sum(&truth, a, b, c) + 0.01 * next()];
    Sum(places.into_iter().map(row).collect())
}

fn fit(problem: &Sum, variant: Variant) -> Report {
    let mut start = [1.0; 9];
    start[5] = 0.01;
    let options = Options {
        variant,
        ..Options::default()
    };
    solve(
        problem,
        &Parameters::unnamed(&start),
        &Mask::all(9),
        &options,
    )
    .unwrap()
}

#[test]
fn no_run_ends_above_its_neighbour_where_two_columns_are_nearly_one() {
    let marquardt = Variant::LevenbergMarquardt {
        damping: Damping::Marquardt,
        geodesic: false,
    };
    for seed in 0..6 {
        let problem = data(seed, 200);
        let (own, other) = (fit(&problem, Variant::default()), fit(&problem, marquardt));
        assert!(own.termination.converged(), "{seed}: {own}");
        assert!(
            own.cost <= other.cost * (1.0 + 1e-6),
            "{seed}: {own}{other}"
        );
    }
}

#[test]
fn a_flat_place_of_the_third_order_is_left_downhill() {
    /// `x₀ c + sin(x₁ c)` of data `0.5 c + c³/6`: at `x₁ = 0` the cost is `(x₁³ + 1)²` times something, least at −1.
    struct Cubic;
    impl<D: Scalar> Residual<D> for Cubic {
        fn residuals(&self, x: &[D], out: &mut Vec<D>) {
            for k in -10..=10 {
                let c = 0.1 * f64::from(k);
                out.push(x[0] * c + (x[1] * c).sin() - (0.5 * c + c.powi(3) / 6.0));
            }
        }
    }
    for start in [[0.7, 0.0], [0.2, 0.5], [0.0, 1.5]] {
        let start = Parameters::unnamed(&start);
        let report = solve(&Cubic, &start, &Mask::all(2), &Options::default()).unwrap();
        assert!(report.termination.converged(), "{report}");
        assert!(
            (report.parameters.values()[1] + 1.0).abs() < 0.1,
            "{report}"
        );
    }
}

#[test]
fn two_parameters_that_only_add_up_stay_where_they_are() {
    struct Same;
    impl<D: Scalar> Residual<D> for Same {
        fn residuals(&self, x: &[D], out: &mut Vec<D>) {
            out.extend([1.0, 2.5, 4.0].map(|y| x[0] + x[1] - y));
        }
    }
    let start = Parameters::unnamed(&[1.0, 0.5]);
    let report = solve(&Same, &start, &Mask::all(2), &Options::default()).unwrap();
    assert!(report.termination.converged(), "{report}");
    assert_eq!(report.rank, 1);
    let [a, b] = [0, 1].map(|k| report.parameters.values()[k]);
    assert!(
        (a + b - 2.5).abs() < 1e-9 && (a - b - 0.5).abs() < 1e-9,
        "{report}"
    );
}
