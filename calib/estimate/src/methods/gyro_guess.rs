//! The unit and the axes of a gyroscope, from the turns: the signed permutation of axes and the common
//! scale at which they carry gravity best.

use nalgebra::{DMatrix, DVector, Matrix3, Rotation3, Vector3};
use sensor::{Base, Model, Sensor};
use solver::Problem;

use crate::kernel::TurnProblem;
use crate::residuals::{Integrator, PropagatedGravity, TurnData};
use crate::truth::RawUnit;

findings::tuning! {
    /// Turns predicted this well, rms of the chord, need no other unit or axes.
    PREDICTED: f64 = 0.5;

    /// Ratio of neighbouring scales tried with the axes as they are named.
    SCALE_STEP: f64 = 1.01;
    /// The same with any axes.
    COARSE_STEP: f64 = 1.03;

    /// Turns looked at when many scales are tried.
    FEW_TURNS: usize = 8;
    /// So many of those scales all turns are asked about.
    PROMISING: usize = 12;

    /// Fine steps on either side of a scale found by few turns that all turns are asked about.
    NEAR: i32 = 8;

    /// Samples averaged into one while many scales are tried.
    AVERAGED: usize = 8;

    /// Permutations from which any other mounting is looked for.
    STARTS: usize = 8;
    /// Steps of that search at most.
    STEPS: usize = 15;
    /// The longest of them, rad.
    LONGEST: f64 = 0.5;

    /// Step of the differences in place of derivatives, rad.
    SMALL: f64 = 1e-4;

    /// Turns from which on such a mounting is believed.
    ENOUGH_TURNS: usize = 6;
    /// Rms of the turns' chords below which it is.
    TURNED: f64 = 0.25;
}

/// Smallest and largest angle of the longest turn that a first guess of the scale reaches for, rad.
const TURN_ANGLES: (f64, f64) = (0.3, 60.0);

/// Starting point of a gyroscope's fit.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct GyroGuess {
    /// Common scale; the bias is taken off already.
    pub unit: RawUnit,
    /// Body axes (rows) by sensor axes (columns): the identity, or how the sensor is mounted.
    pub axes: Matrix3<f64>,
}

/// The guess for turns whose bias has been taken off.
pub fn gyroscope_guess(turns: &[TurnData]) -> GyroGuess {
    let named = Matrix3::identity();
    let guess = |scale: f64, axes: Matrix3<f64>| GyroGuess {
        unit: RawUnit {
            scale,
            zero: Vector3::zeros(),
        },
        axes,
    };
    let longest = turns.iter().map(travel).fold(0.0, f64::max);
    let model = Model::base(Sensor::Gyroscope);
    let all = plain(&model, turns);
    if longest <= 0.0 || misfit(&all, 1.0, &named) < PREDICTED.get() {
        return guess(1.0, named);
    }
    let all_axes = signed_permutations();
    // Readings in SI units turn the device by an angle that a hand makes; counts do not.
    let in_si = (TURN_ANGLES.0..TURN_ANGLES.1).contains(&longest);
    let tried = all_axes.iter().filter(|_| in_si);
    let mounted = least(tried.map(|axes| (misfit(&all, 1.0, axes), *axes)));
    if let Some((_, axes)) = mounted.filter(|(value, _)| *value < PREDICTED.get()) {
        return guess(1.0, axes);
    }
    if in_si
        && turns.len() >= ENOUGH_TURNS.get()
        && let Some(axes) = turned(&all, &all_axes)
    {
        return guess(1.0, axes);
    }
    let fine = scales(longest, SCALE_STEP.get());
    let thin: Vec<TurnData> = turns.iter().take(FEW_TURNS.get()).map(thinned).collect();
    let few = plain(&model, &thin);
    let scaled = least(promising(&few, &fine).map(|s| (misfit(&all, s, &named), s)));
    if let Some((_, scale)) = scaled.filter(|(value, _)| *value < PREDICTED.get()) {
        return guess(scale, named);
    }
    let coarse = scales(longest, COARSE_STEP.get());
    let both = all_axes.iter().flat_map(|axes| {
        let (tried, few) = (coarse.iter(), &few);
        tried.map(move |&s| (misfit(few, s, axes), (s, *axes)))
    });
    let both = least(both).and_then(|(_, (scale, axes))| {
        // Averaged turns lack half a block at either end, so their scale is a little too large.
        let near = (-NEAR.get()..=NEAR.get()).map(|k| scale * SCALE_STEP.get().powi(k));
        least(near.map(|s| (misfit(&all, s, &axes), s))).map(|(value, s)| (value, s, axes))
    });
    match (both, scaled) {
        (Some((value, scale, axes)), Some((plain, _))) if value < 0.5 * plain => guess(scale, axes),
        (_, Some((_, scale))) => guess(scale, named),
        _ => guess(1.0, named),
    }
}

/// The sensor's axes turned by any angle, from the permutations that miss least by a few steps of Gauss and Newton; `None` where none of
/// them is right.
fn turned(turns: &TurnProblem<'_>, all_axes: &[Matrix3<f64>]) -> Option<Matrix3<f64>> {
    let mut starts: Vec<(f64, Matrix3<f64>)> = all_axes
        .iter()
        .map(|axes| (misfit(turns, 1.0, axes), *axes))
        .collect();
    starts.sort_by(|a, b| a.0.total_cmp(&b.0));
    let nearest = starts.into_iter().take(STARTS.get());
    let (value, axes) = least(nearest.map(|(_, axes)| improved(turns, axes)))?;
    (value < TURNED.get()).then_some(axes)
}

/// The axes turned so that the turns miss least, by Gauss–Newton on the angle `δ` of `exp(δ) axes`, and by how much they miss then.
fn improved(turns: &TurnProblem<'_>, mut axes: Matrix3<f64>) -> (f64, Matrix3<f64>) {
    let mut value = misfit(turns, 1.0, &axes);
    for _ in 0..STEPS.get() {
        let rows = chords(turns, &axes);
        let column = |axis: usize| {
            let by = Rotation3::new(Vector3::ith(axis, SMALL.get()));
            (chords(turns, &(by * axes)) - &rows) / SMALL.get()
        };
        let jacobian = DMatrix::from_columns(&[column(0), column(1), column(2)]);
        let Some(step) = (jacobian.transpose() * &jacobian)
            .cholesky()
            .map(|normal| normal.solve(&(jacobian.transpose() * &rows)))
        else {
            break;
        };
        let step = Vector3::new(-step[0], -step[1], -step[2]);
        let step = step * (LONGEST.get() / step.norm().max(LONGEST.get()));
        let halved = (0..4).map(|halvings| step * 0.5f64.powi(halvings));
        let tried = halved.map(|step| Rotation3::new(step) * axes);
        let better = tried
            .map(|axes| (misfit(turns, 1.0, &axes), axes))
            .find(|(tried, _)| *tried < value);
        let Some(better) = better else { break };
        (value, axes) = better;
    }
    (value, axes)
}

/// What the turns miss of gravity with a sensor of this matrix.
fn chords(turns: &TurnProblem<'_>, matrix: &Matrix3<f64>) -> DVector<f64> {
    let base = Base {
        t: *matrix,
        bias: Vector3::zeros(),
    };
    let mut rows = Vec::new();
    turns.values(&base.parameters(), &mut rows);
    DVector::from_vec(rows)
}

/// A turn with its samples averaged some at a time: enough to look for a scale, at a fraction of the cost.
fn thinned(turn: &TurnData) -> TurnData {
    let blocks = turn
        .t
        .chunks(AVERAGED.get())
        .zip(turn.readings.chunks(AVERAGED.get()));
    let (t, readings) = blocks
        .map(|(t, w)| {
            let count = t.len() as f64;
            (
                t.iter().sum::<f64>() / count,
                w.iter().sum::<Vector3<f64>>() / count,
            )
        })
        .unzip();
    TurnData {
        t,
        readings,
        rest: Vec::new(),
        ..*turn
    }
}

/// The scales at which few turns carry gravity best, with the axes as they are named.
fn promising(few: &TurnProblem<'_>, scales: &[f64]) -> impl Iterator<Item = f64> {
    let named = Matrix3::identity();
    let mut tried: Vec<(f64, f64)> = scales
        .iter()
        .map(|&s| (misfit(few, s, &named), s))
        .collect();
    tried.sort_by(|a, b| a.0.total_cmp(&b.0));
    tried.into_iter().take(PROMISING.get()).map(|(_, s)| s)
}

/// The entry with the smallest misfit.
fn least<T>(tried: impl Iterator<Item = (f64, T)>) -> Option<(f64, T)> {
    tried.min_by(|a, b| a.0.total_cmp(&b.0))
}

/// Turns as the base model sees them.
fn plain<'a>(model: &'a Model, turns: &'a [TurnData]) -> TurnProblem<'a> {
    TurnProblem::new(PropagatedGravity {
        model,
        turns,
        integrator: Integrator::Exponential,
        sigma: 1.0,
    })
}

/// Root mean square chord by which the turns miss gravity.
fn misfit(turns: &TurnProblem<'_>, scale: f64, axes: &Matrix3<f64>) -> f64 {
    let rows = chords(turns, &(axes * scale));
    (rows.norm_squared() * 3.0 / rows.len() as f64).sqrt()
}

/// The length by which each turn misses gravity for a perfect sensor of a scale.
pub(super) fn perfect_chords(turns: &[TurnData], scale: f64) -> Vec<f64> {
    let model = Model::base(Sensor::Gyroscope);
    let rows = chords(&plain(&model, turns), &(Matrix3::identity() * scale));
    rows.as_slice()
        .chunks_exact(3)
        .map(|r| Vector3::new(r[0], r[1], r[2]).norm())
        .collect()
}

/// The scales at which the longest turn covers [`TURN_ANGLES`].
fn scales(longest: f64, ratio: f64) -> Vec<f64> {
    let first = TURN_ANGLES.0 / longest;
    std::iter::successors(Some(first), |s| Some(s * ratio))
        .take_while(|s| s * longest < TURN_ANGLES.1)
        .collect()
}

/// The 48 ways to name three axes and their senses.
fn signed_permutations() -> Vec<Matrix3<f64>> {
    let orders = [
        [0, 1, 2],
        [0, 2, 1],
        [1, 0, 2],
        [1, 2, 0],
        [2, 0, 1],
        [2, 1, 0],
    ];
    let mut all = Vec::with_capacity(48);
    for order in orders {
        for signs in 0..8u8 {
            let mut axes = Matrix3::zeros();
            for (row, column) in order.into_iter().enumerate() {
                axes[(row, column)] = if signs >> row & 1 == 0 { 1.0 } else { -1.0 };
            }
            all.push(axes);
        }
    }
    all
}

/// `∫ |reading| dt` over a turn.
fn travel(turn: &TurnData) -> f64 {
    turn.t
        .windows(2)
        .zip(&turn.readings)
        .map(|(t, w)| (t[1] - t[0]) * w.norm())
        .sum()
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Turns about changing axes with the readings that sensor axes `mount · ω / scale` give.
    fn turns(mount: &Matrix3<f64>, scale: f64) -> Vec<TurnData> {
        let t: Vec<f64> = (0..200).map(|k| 0.01 * f64::from(k)).collect();
        (0..9)
            .map(|k| {
                let phase = f64::from(k);
                let axis =
                    Vector3::new(phase.sin(), (2.0 * phase).cos(), (3.0 * phase).sin() + 0.3);
                let truth: Vec<_> = t
                    .iter()
                    .map(|&t| axis * (1.0 + (3.0 * t + phase).sin()))
                    .collect();
                let before =
                    Vector3::new((0.7 * phase).cos(), (0.7 * phase).sin(), 0.4).normalize();
                let mut turn = TurnData {
                    t: t.clone(),
                    readings: truth,
                    rest: Vec::new(),
                    before,
                    after: before,
                };
                let p = Base::identity().parameters();
                turn.after = turn.propagated(
                    &Model::base(Sensor::Gyroscope),
                    Integrator::Exponential,
                    &p[..],
                );
                let mounted = turn.readings.iter().map(|w| mount * w / scale);
                turn.readings = mounted.collect();
                turn
            })
            .collect()
    }

    #[test]
    fn swapped_and_flipped_axes_are_found_in_si_units_and_in_counts() {
        let mount = Matrix3::new(0.0, -1.0, 0.0, 1.0, 0.0, 0.0, 0.0, 0.0, -1.0);
        for scale in [1.0, 1.2e-3] {
            let guess = gyroscope_guess(&turns(&mount, scale));
            assert_eq!(guess.axes, mount.transpose());
            assert!(
                (guess.unit.scale / scale - 1.0).abs() < 0.02,
                "{}",
                guess.unit.scale
            );
        }
    }

    #[test]
    fn a_sensor_that_is_turned_by_any_angle_is_found() {
        for (angle, axis) in [(135.0, 0), (73.0, 1), (157.0, 2), (100.0, 1)] {
            let axis = Vector3::new(0.4, 0.2, 0.1) + Vector3::ith(axis, 0.9);
            let mount = Rotation3::new(axis.normalize() * f64::to_radians(angle));
            let turns = turns(mount.matrix(), 1.0);
            let guess = gyroscope_guess(&turns);
            let model = Model::base(Sensor::Gyroscope);
            let left = misfit(&plain(&model, &turns), 1.0, &guess.axes);
            assert!(left < PREDICTED.get(), "{angle}: {left}");
        }
    }

    #[test]
    fn degrees_per_second_show_their_scale() {
        let guess = gyroscope_guess(&turns(&Matrix3::identity(), 1f64.to_radians()));
        assert_eq!(guess.axes, Matrix3::identity());
        assert!((guess.unit.scale.to_degrees() - 1.0).abs() < 0.02);
    }
}
