//! The fit into the calibration.

use nalgebra::DMatrix;
use sensor::{AnyEffect, Base, Model, PLACES, Sensor, base_names};

use super::inertial::Inertial;
use crate::calibration::{
    Calibration, EffectParameter, EffectValues, MagneticField, Outside, RecordingBias,
    RecordingField, Triad, effect_named,
};
use crate::methods::magnetic::{Field, MagneticFit, OwnBias};
use crate::recording::FieldUnit;

/// Turns and headings that disagree by chance in fewer cases than this do not correct the gyroscope.
const CONTRADICTION: f64 = 1e-3;

/// Inclinations and latitudes beyond this have a sign that cannot be mistaken, degrees: the magnetic equator is nowhere
/// farther from the other.
const PLAIN: f64 = 25.0;

/// A field that differs by more than this share of itself from place to place is worth a warning.
const UNEVEN: f64 = 0.02;

/// What to write.
pub struct Written<'a> {
    pub fit: &'a MagneticFit,
    pub model: &'a Model,
    pub inertial: &'a Inertial,
    /// Names of the recordings with a magnetometer.
    pub recordings: &'a [&'a str],
    pub unit: Option<FieldUnit>,
    pub strength_given: bool,
    /// Latitude, degrees north, if it is known.
    pub latitude: Option<f64>,
    /// An effect that the readings go with and the model lacks, and the probability of so much by chance.
    pub missing: Option<(&'static dyn AnyEffect, f64)>,
    /// Whether accelerometer and gyroscope are corrected by what the magnetometer says.
    pub updates_others: bool,
}

/// Adds the magnetometer to a calibration.
pub fn write(calibration: &mut Calibration, written: &Written<'_>) {
    let fit = written.fit;
    calibration.warnings.extend(warnings(written));
    let update = written.updates_others && fit.turns_p_value > CONTRADICTION;
    let root = written.inertial.root();
    let mut between = DMatrix::zeros(fit.model.values.len(), root.nrows());
    if update {
        let shift = root * nalgebra::DVector::from_column_slice(&fit.errors.values);
        let covariance = root * &fit.errors.covariance * root.transpose();
        between = &fit.between * root.transpose();
        let shift: Vec<f64> = shift.iter().copied().collect();
        calibration.move_by(written.inertial.names(), &shift, &covariance);
    }
    calibration.magnetometer = Some(triad(written));
    calibration.magnetic_field = Some(field(written));
    calibration.effects.extend(effects(written));
    append(calibration, written, &between);
}

/// Names and covariance of the magnetometer's parameters after those of the others.
fn append(calibration: &mut Calibration, written: &Written<'_>, between: &DMatrix<f64>) {
    let (own, names) = (&written.fit.model.covariance, written.model.parameters());
    for (k, row) in calibration.covariance.iter_mut().enumerate() {
        row.extend((0..own.nrows()).map(|i| between[(i, k)]));
    }
    for i in 0..own.nrows() {
        let others = (0..between.ncols()).map(|k| between[(i, k)]);
        let row = others.chain((0..own.ncols()).map(|j| own[(i, j)]));
        calibration.covariance.push(row.collect());
    }
    calibration.parameters.extend(names.names().iter().cloned());
}

fn triad(written: &Written<'_>) -> Triad {
    let fit = written.fit;
    let base = Base::from_parameters(&fit.model.values);
    let std = |k: usize| Some(fit.model.covariance[(k, k)].max(0.0).sqrt());
    let mut t_std = [[None; 3]; 3];
    for (k, (i, j)) in PLACES.into_iter().enumerate() {
        t_std[i][j] = std(k);
    }
    Triad {
        model: Sensor::Magnetometer.equation().into(),
        t: std::array::from_fn(|i| std::array::from_fn(|j| base.t[(i, j)])),
        bias: base.bias.into(),
        t_std,
        bias_std: [9, 10, 11].map(std),
        bias_time: None,
        residual_rms: fit.residual_rms,
        reduced_chi2: Some(fit.reduced_chi2),
        static_intervals: Some(fit.placements.iter().filter(|p| p.is_used).count()),
        dynamic_intervals: (fit.turns > 0).then_some(fit.turns),
        rank: fit.rank,
        condition: 1.0,
        unobservable: Vec::new(),
        units: None,
        recordings: if fit.biases.len() > 1 {
            own_biases(written)
        } else {
            Vec::new()
        },
    }
}

fn own_biases(written: &Written<'_>) -> Vec<RecordingBias> {
    let all = written.recordings.iter().zip(&written.fit.biases);
    let of = |(name, own): (&&str, &OwnBias)| RecordingBias {
        recording: (*name).to_owned(),
        bias: own.value,
        bias_std: own.std.map(Some),
    };
    all.map(of).collect()
}

fn field(written: &Written<'_>) -> MagneticField {
    let of = |(name, field): (&&str, &Field)| RecordingField {
        recording: (*name).to_owned(),
        strength: field.strength,
        strength_std: field.strength_std,
        inclination: field.inclination.to_degrees(),
        inclination_std: field.inclination_std.to_degrees(),
    };
    let all: Vec<RecordingField> = written
        .recordings
        .iter()
        .zip(&written.fit.fields)
        .map(of)
        .collect();
    let last = all[all.len() - 1].clone();
    MagneticField {
        unit: if written.unit.is_some() || written.strength_given {
            "uT"
        } else {
            "reading"
        }
        .into(),
        strength_given: written.strength_given,
        unevenness: written.fit.unevenness,
        last,
        recordings: if all.len() > 1 { all } else { Vec::new() },
    }
}

fn effects<'a>(written: &'a Written<'_>) -> impl Iterator<Item = EffectValues> + 'a {
    let fit = written.fit;
    let mut next = base_names(Sensor::Magnetometer).len();
    written.model.effects().iter().map(move |effect| {
        let first = next;
        next += effect.params().len();
        let parameters = effect
            .params()
            .iter()
            .zip(first..)
            .map(|(p, k)| EffectParameter {
                name: p.name.into(),
                value: fit.model.values[k],
                std: Some(fit.model.covariance[(k, k)].max(0.0).sqrt()),
                unit: p.unit.into(),
            });
        EffectValues {
            name: effect.name().into(),
            definition: effect.definition().cloned(),
            parameters: parameters.collect(),
            outside: effect_named(effect.name())
                .is_none()
                .then_some(Outside(*effect)),
        }
    })
}

/// Says where the field points to the other hemisphere: a sign is wrong.
fn wrong_hemisphere(fit: &MagneticFit, latitude: f64) -> Option<String> {
    let inclination = fit.fields.last()?.inclination.to_degrees();
    let plain = latitude.abs() > PLAIN && inclination.abs() > PLAIN;
    (plain && inclination * latitude < 0.0).then(|| {
        format!(
            "the magnetic field points {:.0}° {} the horizontal, at a latitude of {latitude}°: the signs of an odd number of the \
             magnetometer's axes, or of all of the accelerometer's, are wrong; headings by the corrected field may be turned",
            inclination.abs(),
            if inclination < 0.0 { "above" } else { "below" }
        )
    })
}

/// Two significant digits.
fn short(v: f64) -> String {
    let decimals = (1.0 - v.abs().max(1e-12).log10().floor()).clamp(0.0, 12.0) as usize;
    format!("{v:.decimals$}")
}

fn warnings(written: &Written<'_>) -> Vec<String> {
    let fit = written.fit;
    let unit = if written.unit.is_some() {
        "µT"
    } else {
        "units of its readings"
    };
    let mut all = Vec::new();
    for (place, size) in &fit.disturbed {
        let placement = &fit.placements[*place];
        all.push(format!(
            "{}: in static interval {} (t = {:.2} to {:.2} s) the magnetic field is off by {} {unit} from that of the others, \
             as near iron, a magnet or a current; the magnetometer's reading there is not used",
            written.recordings[placement.recording],
            placement.interval + 1,
            placement.span.from,
            placement.span.to,
            short(*size)
        ));
    }
    let strength = fit
        .fields
        .iter()
        .map(|f| f.strength)
        .fold(f64::INFINITY, f64::min);
    if fit.unevenness > UNEVEN * strength {
        all.push(format!(
            "the magnetic field differs by {} {unit} per axis from one static interval to the next ({:.0} % of it; the \
             magnetometer's noise explains {}), as near iron or currents, or where the magnetometer has an effect that the \
             model lacks. Its errors are enlarged to it; record outdoors, away from steel",
            short(fit.unevenness),
            100.0 * fit.unevenness / strength,
            short(fit.residual_rms / fit.reduced_chi2.sqrt())
        ));
    }
    all.extend(
        written
            .latitude
            .and_then(|latitude| wrong_hemisphere(fit, latitude)),
    );
    all.extend(written.missing.map(|(effect, p)| {
        format!(
            "the readings of the magnetometer go with {} (p = {p:.0e}), which the model lacks: its errors do not cover that; \
             calibrate with --effects {}",
            effect.name(),
            effect.name()
        )
    }));
    if written.updates_others && fit.turns_p_value <= CONTRADICTION {
        all.push(format!(
            "magnetometer and gyroscope disagree about the heading after turns by more than noise (p = {:.0e}): the gyroscope is \
             left as its turns alone show it",
            fit.turns_p_value
        ));
    }
    all
}
