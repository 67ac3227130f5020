//! The disagreement that an effect explains, point by point, before and after it is in the model.

use estimate::calibration::EffectParameter;
use estimate::methods::joint::BiasNoise;
use faer::Mat;
use nalgebra::{Matrix3, Vector3};
use sensor::{EffectRef, Kinematics, Quantity, Sensor};

use super::discovery::Discovery;
use super::family::Claim;
use super::findings::EffectFinding;
use super::gap::channel::Channel;
use super::gap::sequence::whitening_at;
use super::search::Name;
use super::state::State;

/// Plot data of one named effect: residuals with and without it.
#[derive(Clone, Debug)]
pub struct Picture {
    /// The effect.
    pub effect: String,
    /// The channel that the points are of.
    pub channel: Channel,
    /// Covariate of the effect's error; `None` where no single number per static interval describes it.
    pub covariate: Option<Covariate>,
    /// The points: one per chunk of a rest of the norm, three of the rate, two per turn of the direction.
    pub points: Vec<Point>,
}

/// Quantity that an error depends on.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Covariate {
    /// In words.
    pub name: String,
    /// Its unit.
    pub unit: &'static str,
}

/// One residual, *measured − predicted*, in m/s² (norm of specific force), rad/s (rate) or rad (direction).
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Point {
    /// Place of the chunk, or of the turn, among all.
    pub place: usize,
    /// The axis of a rate, or the coordinate of a direction; 0 of a norm.
    pub axis: usize,
    /// Without the effect in the model.
    pub before: f64,
    /// With it and everything else named.
    pub after: f64,
    /// Contribution of the effect that the other parameters cannot absorb.
    pub predicted: f64,
    /// Standard deviation of the white noise.
    pub std: f64,
    /// The covariate, in its unit.
    pub covariate: Option<f64>,
}

/// One picture for every effect in the findings, in their order, of the channel that it lives in; where that is the
/// direction through turns and the effect shows at rest, a second of the readings at rest.
pub fn pictures(discovery: &Discovery) -> Vec<Picture> {
    let search = &discovery.search;
    let written = |name: &Name| {
        let effect = name.claim.effect()?;
        let mut all = discovery.findings.effects.iter();
        all.find(|finding| finding.name == effect.name())
    };
    let each = search.names.iter();
    each.filter_map(|name| Some(of_effect(name, written(name)?, &search.last)))
        .flatten()
        .collect()
}

fn of_effect(name: &Name, finding: &EffectFinding, last: &State) -> Vec<Picture> {
    let without = &name.without;
    let noise = last.noise;
    let rows = [
        left(without, noise, residuals(without)),
        left(last, noise, residuals(last)),
        left(without, noise, name.predicted()),
    ];
    let goes_with = GoesWith::of(&name.claim, &finding.parameters);
    let goes_with = goes_with.as_ref();
    let mut channels = vec![finding.channel];
    if finding.channel == Channel::Direction && goes_with.is_some() {
        channels.push(match name.claim.sensor() {
            Sensor::Accelerometer => Channel::StaticNorm,
            Sensor::Gyroscope | Sensor::Magnetometer => Channel::StaticRate,
        });
    }
    channels
        .into_iter()
        .map(|channel| Picture {
            effect: finding.name.clone(),
            channel,
            covariate: goes_with
                .filter(|_| channel != Channel::Direction)
                .map(|w| w.in_words(channel)),
            points: of_channel(without, &rows, channel, goes_with),
        })
        .collect()
}

pub(crate) fn residuals(state: &State) -> Mat<f64> {
    let r = &state.fit.white_residuals;
    Mat::from_fn(r.len(), 1, |i, _| r[i])
}

/// Computes the residual of a white-whitened column (`m × 1`) after a fit of the model's parameters under the noise of the
/// final model, in the unit of the rows.
///
/// Not under the noise of the model itself: where an effect is missing it is taken for a walk of the bias, and
/// a large walk lets the residual go where it likes.
pub(crate) fn left(state: &State, noise: BiasNoise, column: Mat<f64>) -> Mat<f64> {
    let fit = &state.fit;
    let whitening = whitening_at(state, noise);
    let whole = whitening.finish_column(column.col_as_slice(0));
    let jacobian = whitening.finish_columns(fit.white_jacobian.clone());
    let mut left = column;
    if let Some(taken) = jacobian.least_squares(&whole) {
        let explained = fit.white_jacobian.times(&taken);
        left.col_mut(0)
            .iter_mut()
            .zip(explained)
            .for_each(|(v, by)| *v -= by);
    }
    fit.whitening.white.restore(left.as_mut());
    left
}

/// The points of a channel, from what is left of its rows before, after, and of what is predicted.
pub(crate) fn points(state: &State, rows: &[Mat<f64>; 3], channel: Channel) -> Vec<Point> {
    of_channel(state, rows, channel, None)
}

fn of_channel(
    state: &State,
    rows: &[Mat<f64>; 3],
    channel: Channel,
    goes_with: Option<&GoesWith>,
) -> Vec<Point> {
    match channel {
        Channel::StaticNorm => of_norm(state, rows, goes_with),
        Channel::StaticRate => of_rate(state, rows, goes_with),
        Channel::Direction => of_turns(state, rows),
        // The joint fit has no rows of it.
        Channel::MovingForce => Vec::new(),
    }
}

/// Computes `−uᵀ T r` of each chunk of a static interval: the excess of the norm over gravity, m/s².
fn of_norm(state: &State, rows: &[Mat<f64>; 3], goes_with: Option<&GoesWith>) -> Vec<Point> {
    let means = state.sensitivities.means.iter();
    means
        .filter(|mean| mean.sensor == Sensor::Accelerometer)
        .map(|mean| {
            let u = mean.truth.specific_force.normalize();
            let along = -(corrected(&mean.by_error).transpose() * u);
            let [before, after, predicted] = each(rows, mean.row, &along);
            Point {
                place: mean.chunk,
                axis: 0,
                before,
                after,
                predicted,
                std: std_along(state, mean.row, &along),
                covariate: goes_with.map(|w| w.at(&mean.truth, w.axis)),
            }
        })
        .collect()
}

/// Computes `−(T r)_i` of each chunk of a static interval and each axis, rad/s.
fn of_rate(state: &State, rows: &[Mat<f64>; 3], goes_with: Option<&GoesWith>) -> Vec<Point> {
    let means = state.sensitivities.means.iter();
    means
        .filter(|mean| mean.sensor == Sensor::Gyroscope)
        .flat_map(|mean| {
            let t = corrected(&mean.by_error);
            (0..3).map(move |axis| {
                let along = -t.row(axis).transpose();
                let [before, after, predicted] = each(rows, mean.row, &along);
                Point {
                    place: mean.chunk,
                    axis,
                    before,
                    after,
                    predicted,
                    std: std_along(state, mean.row, &along),
                    covariate: goes_with.map(|w| w.at(&mean.truth, axis)),
                }
            })
        })
        .collect()
}

/// Computes `−r` of each turn in both coordinates, rad.
fn of_turns(state: &State, rows: &[Mat<f64>; 3]) -> Vec<Point> {
    let turns = state.sensitivities.turns.iter();
    turns
        .flat_map(|turn| {
            (0..2).map(|axis| {
                let row = turn.row + axis;
                let [before, after, predicted] = [0, 1, 2].map(|k| -rows[k][(row, 0)]);
                Point {
                    place: turn.turn,
                    axis,
                    before,
                    after,
                    predicted,
                    std: state.fit.whitening.white.std(row),
                    covariate: None,
                }
            })
        })
        .collect()
}

/// `T` of `∂r/∂e = T⁻¹`.
fn corrected(by_error: &Matrix3<f64>) -> Matrix3<f64> {
    sensor::inverse(by_error).unwrap_or_else(Matrix3::identity)
}

fn each(rows: &[Mat<f64>; 3], row: usize, along: &Vector3<f64>) -> [f64; 3] {
    [0, 1, 2].map(|k| (0..3).map(|i| along[i] * rows[k][(row + i, 0)]).sum())
}

fn std_along(state: &State, row: usize, along: &Vector3<f64>) -> f64 {
    let white = &state.fit.whitening.white;
    let squares = (0..3).map(|i| (along[i] * white.std(row + i)).powi(2));
    squares.sum::<f64>().sqrt()
}

/// The covariate of an effect.
#[derive(Clone, Debug)]
struct GoesWith {
    kind: Kind,
    /// The axis whose coefficient is most evident.
    axis: usize,
    /// Per axis, the direction along which specific force matters (g-sensitivity).
    directions: [Vector3<f64>; 3],
}

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Kind {
    Time,
    Temperature,
    Force,
    ForceAlong,
    Product,
    LastChange,
    Vibration,
    TemperatureRate,
    Warming,
    SinceTurn,
}

/// Quantities that an effect may need with the covariate to plot for each; the first that applies is used.
const TELLING: [(Quantity, Kind); 7] = [
    (Quantity::Temperature, Kind::Temperature),
    (Quantity::TemperatureRate, Kind::TemperatureRate),
    (Quantity::Warming, Kind::Warming),
    (Quantity::SinceTurn, Kind::SinceTurn),
    (Quantity::Time, Kind::Time),
    (Quantity::LastChange, Kind::LastChange),
    (Quantity::Vibration, Kind::Vibration),
];

fn kind_of(effect: &EffectRef) -> Option<Kind> {
    let needs = effect.needs();
    let telling = TELLING
        .iter()
        .find(|(quantity, _)| needs.contains(quantity));
    if let Some((_, kind)) = telling {
        return Some(*kind);
    }
    (needs == [Quantity::SpecificForce]).then(|| of_force(effect))
}

/// Returns the dependence of an error on specific force: on that along its axis, on a product of those across it, or on
/// that along any direction.
fn of_force(effect: &EffectRef) -> Kind {
    let params = effect.params();
    let p: Vec<f64> = (0..params.len())
        .map(|k| match params[k].nominal {
            0.0 => effect.typical_of(k),
            nominal => nominal,
        })
        .collect();
    let error = |f: Vector3<f64>| effect.error_f64(&Kinematics::at_rest(f), &p);
    let alone = error(Vector3::x() * 5.0);
    match (alone.x == 0.0, alone.y == 0.0) {
        (true, _) => Kind::Product,
        (false, true) => Kind::Force,
        (false, false) => Kind::ForceAlong,
    }
}

impl GoesWith {
    fn of(claim: &Claim, parameters: &[EffectParameter]) -> Option<Self> {
        let Claim::Effect(effect) = claim else {
            return None;
        };
        let kind = kind_of(effect)?;
        let evidence = |p: &EffectParameter| p.std.map_or(0.0, |s| (p.value / s).abs());
        let axis = (0..parameters.len().min(3))
            .max_by(|&a, &b| evidence(&parameters[a]).total_cmp(&evidence(&parameters[b])))?;
        let directions = [0, 1, 2].map(|i| {
            let value = |j: usize| parameters.get(3 * i + j).map_or(0.0, |p| p.value);
            Vector3::from_fn(|j, _| value(j))
                .try_normalize(0.0)
                .unwrap_or_else(Vector3::zeros)
        });
        Some(Self {
            kind,
            axis,
            directions,
        })
    }

    fn at(&self, truth: &Kinematics<f64>, axis: usize) -> f64 {
        let f = &truth.specific_force;
        match self.kind {
            Kind::Time => truth.time,
            Kind::Temperature => truth.temperature,
            Kind::Force => f[axis],
            Kind::ForceAlong => self.directions[axis].dot(f),
            Kind::Product => f[(axis + 1) % 3] * f[(axis + 2) % 3],
            Kind::LastChange => truth.last_change[axis],
            Kind::Vibration => truth.vibration[axis],
            Kind::TemperatureRate => truth.temperature_rate,
            Kind::Warming => truth.warming,
            Kind::SinceTurn => truth.since_turn.middle(),
        }
    }

    fn in_words(&self, channel: Channel) -> Covariate {
        let axis = match channel {
            Channel::StaticNorm => ["x", "y", "z"][self.axis],
            _ => "the axis",
        };
        let (name, unit) = match self.kind {
            Kind::Time => ("time since the start".into(), "s"),
            Kind::Temperature => ("temperature".into(), "°C"),
            Kind::Force => (format!("specific force along {axis}"), "m/s²"),
            Kind::ForceAlong => (
                "specific force along the sensitive direction".into(),
                "m/s²",
            ),
            Kind::Product => (
                format!("product of the specific forces across {axis}"),
                "(m/s²)²",
            ),
            Kind::LastChange => (
                format!("sign of the last change of specific force along {axis}"),
                "",
            ),
            Kind::TemperatureRate => ("derivative of the temperature".into(), "K/s"),
            Kind::Warming => ("sign of the last change of temperature".into(), ""),
            Kind::SinceTurn => ("time since the last turn".into(), "s"),
            Kind::Vibration => (
                format!("mean square of the vibration along {axis}"),
                "(m/s²)²",
            ),
        };
        Covariate { name, unit }
    }
}

#[cfg(test)]
mod tests {
    use simulate::Spec;

    use super::*;
    use crate::{Request, discover};

    /// Mean square of residuals over their noise.
    fn over_noise(points: &[Point], of: fn(&Point) -> f64) -> f64 {
        let squares = points.iter().map(|p| (of(p) / p.std).powi(2));
        squares.sum::<f64>() / points.len() as f64
    }

    #[test]
    fn points_lie_on_what_the_effect_predicts_before_and_on_zero_after() {
        for (effect, size, channel) in [
            ("gyro_g_sensitivity", 1.0, Channel::StaticRate),
            ("accel_cross_axis", 3.0, Channel::StaticNorm),
        ] {
            let session = Spec::hand_held(5).with_effect(effect, size).run().unwrap();
            let request = Request::new(session.truth.spec.gravity);
            let discovery = discover(&[session.recording], &request).unwrap();
            let all = pictures(&discovery);
            let picture = all.iter().find(|p| p.channel == channel).unwrap();
            assert_eq!(picture.effect, effect);
            assert!(picture.covariate.is_some());
            let product: f64 = picture.points.iter().map(|p| p.predicted * p.before).sum();
            let square: f64 = picture.points.iter().map(|p| p.predicted.powi(2)).sum();
            // The slope of before on predicted: noise moves it by the square root of the statistic.
            let slope = product / square;
            assert!((slope - 1.0).abs() < 0.1, "{effect}: {slope}");
            let before = over_noise(&picture.points, |p| p.before);
            let after = over_noise(&picture.points, |p| p.after);
            // Of a hundred points the mean scatters by 0.14 around 1, less what the parameters took.
            assert!(before > 1.5 && after < 1.5, "{effect}: {before} {after}");
        }
    }
}
