//! The likelihood station by station against dense matrices, and how its work grows.

pub(crate) mod dense;

use rand::SeedableRng;
use rand_distr::{Distribution, StandardNormal};
use recording::intervals::{Detector, segment};
use simulate::Spec;

use self::dense::Dense;
use super::*;
use crate::methods::joint::blocks::covariance::Covariance;
use crate::methods::joint::blocks::groups::RowGroups;
use crate::methods::joint::noise::chain::{Chain, Link};
use crate::methods::joint::noise::stations::Stations;
use crate::methods::joint::noise::weights::{ComponentKind, Form};
use crate::methods::joint::{JointFit, JointRequest, fit_joint};

#[test]
fn the_left_null_space_is_orthogonal_to_every_column() {
    let j = Mat::from_fn(7, 3, |i, k| ((i * 5 + k * 3) % 11) as f64 - 4.0);
    let null = left_null_space(&j);
    assert_eq!((null.nrows(), null.ncols()), (7, 4));
    assert!((null.transpose() * &j).norm_max() < 1e-13);
    assert!((null.transpose() * &null - Mat::<f64>::identity(4, 4)).norm_max() < 1e-14);
}

/// `count` normal numbers of unit variance.
fn normal(seed: u64, count: usize) -> Vec<f64> {
    let mut random = rand_chacha::ChaCha8Rng::seed_from_u64(seed);
    (0..count)
        .map(|_| StandardNormal.sample(&mut random))
        .collect()
}

/// The only variance of residuals with an unknown mean, by a component that is passed from row to row.
fn only_variance(residuals: &[f64], chain: impl Fn(&Stations) -> Chain) -> f64 {
    let groups = RowGroups::whole(residuals.len());
    let component = Component {
        kind: ComponentKind::TurnScatter,
        covariance: Covariance::none(residuals.len()),
        form: Form::Passed(chain(&Stations::single(&groups))),
    };
    let mean = Columns::cut(&Mat::full(residuals.len(), 1, 1.0), &groups);
    let restricted = Restricted::new(residuals, &mean, &[&component]);
    restricted.variances(&[false], &[0.0])[0]
}

#[test]
fn the_variance_of_independent_residuals_has_its_closed_form() {
    // One component C = I with 1 + θ = Σ (z − z̄)²/(q − 1) at the maximum.
    let z: Vec<f64> = normal(5, 300).iter().map(|v| 2.0 * v).collect();
    let mean = z.iter().sum::<f64>() / 300.0;
    let closed = z.iter().map(|v| (v - mean).powi(2)).sum::<f64>() / 299.0 - 1.0;
    let identity = Covariance::of_blocks(
        300,
        (0..300).map(|k| (vec![k], Mat::identity(1, 1))).collect(),
    );
    let found = only_variance(&z, |stations| Chain::of_each(stations, &identity));
    assert!((found / closed - 1.0).abs() < 2e-3, "{found} {closed}");
}

#[test]
fn a_component_that_is_not_there_is_left_out() {
    let one = |value: f64| nalgebra::DMatrix::from_element(1, 1, value);
    let link = |row: usize| {
        let square = (row + 1) as f64;
        let link = Link {
            own: one(square),
            gives: one(1.0),
            takes: one(square),
            keeps: vec![1.0],
        };
        (row, link)
    };
    let walk = |stations: &Stations| Chain::of_links(stations, 1, (0..200).map(link));
    assert_eq!(only_variance(&normal(6, 200), walk), 0.0);
}

#[test]
fn recordings_by_themselves_have_the_likelihood_of_all_rows_together() {
    let r = normal(7, 60);
    let whole = Mat::from_fn(60, 6, |i, k| {
        let value = ((i * 7 + k * 5 + i * k) % 11) as f64 - 5.0;
        if k < 2 || i / 30 == k / 4 { value } else { 0.0 }
    });
    let walk = Mat::from_fn(30, 30, |i, j| 0.1 * (i.min(j) + 1) as f64);
    let blocks = [0, 30].map(|first| ((first..first + 30).collect(), walk.clone()));
    let walk = Covariance::of_blocks(60, blocks.into());
    let scatter = Covariance::of_blocks(60, vec![((5..35).collect(), Mat::identity(30, 30))]);
    let groups = RowGroups::new((0..60).map(|i| i / 30).collect());
    let change = |groups: &RowGroups, all: &[&Covariance], theta: &[f64]| {
        let dense = Dense::new(&r, &Columns::cut(&whole, groups), all);
        let nothing = vec![0.0; theta.len()];
        dense.log_likelihood(theta).unwrap() - dense.log_likelihood(&nothing).unwrap()
    };
    for (all, theta) in [
        (&[&walk][..], &[0.7][..]),
        (&[&walk, &scatter], &[0.7, 0.0]),
        (&[&walk, &scatter], &[0.2, 1.3]),
    ] {
        let [apart, one] = [&groups, &RowGroups::whole(60)].map(|g| change(g, all, theta));
        assert!((apart - one).abs() < 1e-10, "{apart} {one}");
    }
}

/// The device of all recordings.
const DEVICE: [(&str, f64); 15] = [
    ("accel.s_x", 1.01),
    ("accel.s_y", 0.995),
    ("accel.s_z", 1.004),
    ("accel.alpha_yz", 3e-3),
    ("accel.alpha_zy", -2e-3),
    ("accel.alpha_zx", 1e-3),
    ("accel.b_x", 0.1),
    ("accel.b_y", -0.15),
    ("accel.b_z", 0.2),
    ("gyro.s_x", 1.005),
    ("gyro.s_y", 0.99),
    ("gyro.s_z", 1.01),
    ("gyro.b_x", 2e-3),
    ("gyro.b_y", -3e-3),
    ("gyro.b_z", 4e-3),
];

/// Recordings of a gyroscope that feels the specific force, fitted without that.
fn fit(recordings: u64, placements: usize) -> JointFit {
    let of = |seed: u64| {
        let mut spec = Spec::hand_held(seed);
        spec.motion = simulate::Motion::HandHeld(simulate::HandHeld {
            placements: Some(placements),
            ..simulate::HandHeld::default()
        });
        spec.accelerometer.random_walk = 1e-4;
        spec.parameters
            .extend(DEVICE.map(|(name, value)| (name.to_owned(), value)));
        let effect = spec.effects.entry("gyro_g_sensitivity".into()).or_default();
        effect.extend([("xx", 3e-4), ("yz", -1.5e-4)].map(|(k, v)| (k.to_owned(), v)));
        let recording = spec.run().unwrap().recording;
        let segmentation = segment(&recording, &Detector::default()).unwrap();
        (recording, segmentation)
    };
    let all: Vec<_> = (1..=recordings).map(of).collect();
    let pairs = all.iter().map(|(r, s)| (r, s)).collect();
    fit_joint(&JointRequest::new(pairs, 9.80665)).unwrap()
}

#[test]
fn what_is_passed_on_is_the_covariance() {
    let fit = fit(2, 12);
    let all = fit
        .components
        .iter()
        .chain(&fit.flickering().0)
        .cloned()
        .collect::<Vec<_>>();
    assert!(
        all.iter().any(|c| c.form.chain().is_none()),
        "no pattern was allowed for"
    );
    for component in all {
        let Some(chain) = component.form.chain() else {
            continue;
        };
        let (passed, whole) = (chain.to_dense(), component.covariance.to_dense());
        let most = whole.norm_max();
        for i in 0..whole.nrows() {
            for k in 0..whole.ncols() {
                let error = passed[(i, k)] - whole[(i, k)];
                assert!(error.abs() < 1e-9 * most, "{:?} {i} {k}", component.kind);
            }
        }
    }
}

#[test]
fn the_likelihood_and_its_slopes_are_those_of_dense_matrices() {
    let fit = fit(2, 12);
    let (flickering, _) = fit.flickering();
    let flicker = flickering.iter().filter(|c| c.kind.is_flicker()).take(4);
    let all: Vec<&Component> = fit.components.iter().chain(flicker).collect();
    let covariances: Vec<Covariance> = all
        .iter()
        .map(|c| match &c.form {
            Form::Passed(_) => c.covariance.clone(),
            Form::Columns(columns) => Covariance::of_columns(columns),
        })
        .collect();
    let covariances: Vec<&Covariance> = covariances.iter().collect();
    let (r, j) = (&fit.white_residuals, &fit.white_jacobian);
    let (quick, dense) = (Restricted::new(r, j, &all), Dense::new(r, j, &covariances));
    // As much of every component as makes the largest diagonal one or a hundredth.
    let sizes = |by: f64| -> Vec<f64> {
        let largest = covariances
            .iter()
            .map(|c| c.diagonal().fold(1e-300, f64::max));
        largest
            .enumerate()
            .map(|(k, d)| by / (1.0 + k as f64) / d)
            .collect()
    };
    let none = vec![0.0; all.len()];
    let constant = quick.log_likelihood(&none).unwrap() - dense.log_likelihood(&none).unwrap();
    let active = vec![true; all.len()];
    for theta in [sizes(0.01), sizes(1.0), sizes(100.0)] {
        let at = quick.measure(&theta, f64::NEG_INFINITY).unwrap();
        let exact = dense.log_likelihood(&theta).unwrap();
        let error = at.log_likelihood - exact - constant;
        // Errors of columns are not quite zero where they are zero.
        assert!(
            error.abs() < 1e-3 * (1.0 + exact.abs()).sqrt(),
            "{error} of {exact}"
        );
        let slopes = quick.slopes(&at, &theta, &active);
        let (score, information) = dense.derivatives(&theta, &active);
        for i in 0..all.len() {
            let scale = information[i][i].sqrt();
            let error = slopes.score[i] - score[i];
            assert!(
                error.abs() < 1e-4 * (scale + score[i].abs()),
                "{:?}",
                all[i].kind
            );
            for k in 0..all.len() {
                let scale = scale * information[k][k].sqrt();
                let error = slopes.information[i][k] - information[i][k];
                assert!(
                    error.abs() < 1e-5 * scale,
                    "{:?} {:?}",
                    all[i].kind,
                    all[k].kind
                );
            }
        }
    }
}

#[test]
fn work_grows_with_the_recordings_and_no_faster() {
    let work = |recordings: u64| {
        let fit = fit(recordings, 12);
        let all: Vec<&Component> = fit.components.iter().collect();
        assert!(
            all.iter().any(|c| c.form.chain().is_none()),
            "no pattern was allowed for"
        );
        // Rows that are factored together are those of one recording.
        assert_eq!(fit.whitening.groups().iter().len(), recordings as usize);
        let quick = Restricted::new(&fit.white_residuals, &fit.white_jacobian, &all);
        let none = vec![0.0; all.len()];
        let kept: Vec<bool> = all.iter().map(|c| c.kind.is_noise()).collect();
        quick.variances(&kept, &none);
        (quick.evaluations.get() as f64, quick.work())
    };
    let (two, eight) = (work(2), work(8));
    assert!(
        eight.0 <= 1.5 * two.0 + 10.0,
        "{} and {} evaluations",
        two.0,
        eight.0
    );
    assert!(eight.1 <= 4.4 * two.1, "{} and {} products", two.1, eight.1);
}
