//! The fit into the calibration.

use findings::{Finding, Kind, OptionName, Remedy};
use nalgebra::{DMatrix, DVector};
use sensor::{Base, Model, Sensor};

use super::inertial::Inertial;
use super::missing::Missing;
use super::units::Units;
use crate::calibrate::assemble;
use crate::calibration::{Calibration, MagneticField, RecordingBias, RecordingField, Triad};
use crate::methods::Fitted;
use crate::methods::magnetic::{Field, MagneticFit, OwnBias};

findings::tuning! {
    /// Turns and headings that disagree by chance in fewer cases than this do not correct the gyroscope.
    CONTRADICTION: f64 = 1e-3;

    /// One that differs by more than so many times the noise of an interval's mean is worth a remark.
    EVIDENT: f64 = 3.0;

    /// A field that differs by more than this share of itself from place to place is worth a warning.
    UNEVEN: f64 = 0.02;
}

/// Magnetometer fit and the context to write it into a calibration.
pub struct Written<'a> {
    pub fit: &'a MagneticFit,
    pub model: &'a Model,
    pub inertial: &'a Inertial,
    /// Names of the recordings with a magnetometer.
    pub recordings: &'a [&'a str],
    /// True if these are the parts of one recording, of which the last counts.
    pub is_divided: bool,
    pub units: Units,
    pub strength_given: bool,
    /// An effect that the readings go with and the model lacks.
    pub missing: Option<Missing>,
    /// True if the magnetometer also corrects accelerometer and gyroscope.
    pub updates_others: bool,
}

/// Adds the magnetometer to a calibration.
pub fn write(calibration: &mut Calibration, written: &Written<'_>) {
    let fit = written.fit;
    calibration.warnings.extend(warnings(written));
    let update = written.updates_others && fit.turns_p_value > CONTRADICTION.get();
    let root = written.inertial.root();
    let mut between = DMatrix::zeros(fit.model.values.len(), root.nrows());
    if update {
        let shift = root * DVector::from_column_slice(&fit.errors.values);
        let covariance = root * &fit.errors.covariance * root.transpose();
        between = &fit.between * root.transpose();
        let moved = calibration.parameter_values() + shift;
        calibration.write_parameters(&moved, &covariance);
    }
    let fitted = fitted(fit, written.model);
    calibration.magnetometer = Some(triad(written, &fitted));
    calibration.magnetic_field = Some(field(written));
    let effects = assemble::effect_values(written.model, &fitted);
    calibration.effects.extend(effects);
    append(calibration, &fitted, &between);
}

/// Names and covariance of the magnetometer's parameters after those of the others; `between` is their covariance with
/// those (own × others).
fn append(calibration: &mut Calibration, own: &Fitted, between: &DMatrix<f64>) {
    for (k, row) in calibration.covariance.iter_mut().enumerate() {
        row.extend(between.column(k).iter());
    }
    for (i, row) in own.covariance.iter().enumerate() {
        let others = between.row(i).iter().copied().collect::<Vec<f64>>();
        calibration
            .covariance
            .push([&others, row.as_slice()].concat());
    }
    calibration.parameters.extend_from_slice(&own.free);
}

fn triad(written: &Written<'_>, fitted: &Fitted) -> Triad {
    let fit = written.fit;
    let mut triad = Triad {
        residual_rms: fit.residual_rms,
        reduced_chi2: Some(fit.reduced_chi2),
        static_intervals: Some(fit.placements.iter().filter(|p| p.is_used).count()),
        dynamic_intervals: (fit.turns > 0).then_some(fit.turns),
        ..assemble::triad(Sensor::Magnetometer, fitted)
    };
    if fit.biases.len() > 1 && !written.is_divided {
        triad.state_biases(own_biases(written));
    }
    triad
}

/// The fit as those of the other sensors are written down.
pub fn fitted(fit: &MagneticFit, model: &Model) -> Fitted {
    let own = &fit.model;
    let mut parameters = model.parameters();
    parameters.values_mut().copy_from_slice(&own.values);
    let row = |i: usize| own.covariance.row(i).iter().copied().collect();
    Fitted {
        free: parameters.names().to_vec(),
        parameters,
        covariance: (0..own.covariance.nrows()).map(row).collect(),
        rank: fit.rank,
        condition: 1.0,
        unobservable: Vec::new(),
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
    let Units { reading, field } = written.units;
    MagneticField {
        unit: field.in_files().into(),
        reading_unit: (reading != field).then(|| reading.in_files().into()),
        strength_given: written.strength_given,
        unevenness: unevenness(written.fit),
        last,
        recordings: match all.len() > 1 && !written.is_divided {
            true => all,
            false => Vec::new(),
        },
    }
}

/// By how much the field differs per axis from place to place, in its own unit.
fn unevenness(fit: &MagneticFit) -> f64 {
    fit.unevenness * Base::from_parameters(&fit.model.values).scale()
}

fn warnings(written: &Written<'_>) -> Vec<Finding> {
    let fit = written.fit;
    let unit = written.units.reading.in_words();
    let of = |kind| Finding::of(kind).of_sensor(Sensor::Magnetometer);
    let mut all = Vec::new();
    for (place, size) in &fit.disturbed {
        let placement = &fit.placements[*place];
        all.push(
            of(Kind::FIELD_DISTURBED)
                .in_recording(written.recordings[placement.recording].to_string())
                .at_interval(placement.interval)
                .between(placement.span.from, placement.span.to)
                .number("size", *size, unit),
        );
    }
    let strength = fit
        .fields
        .iter()
        .map(|f| f.strength)
        .fold(f64::INFINITY, f64::min);
    let share = unevenness(fit) / strength;
    let noise = fit.residual_rms / fit.reduced_chi2.sqrt();
    let kind = match share > UNEVEN.get() {
        true => Some(Kind::FIELD_UNEVEN),
        false if fit.unevenness > EVIDENT.get() * noise => Some(Kind::FIELD_LITTLE_UNEVEN),
        false => None,
    };
    all.extend(kind.map(|kind| {
        of(kind)
            .number("size", fit.unevenness, unit)
            .number("share", share, "share")
            .number("noise", noise, unit)
    }));
    all.extend(written.missing.as_ref().map(|missing| {
        let names: Vec<&str> = missing.effects.iter().map(|own| own.name()).collect();
        of(Kind::MAGNETIC_EFFECT)
            .detail("effect", names.join(" and "))
            .detail("p", format!("{:.0e}", missing.p_value))
            .only_remedies([Remedy::set_to(OptionName::Effects, names.join(","))])
    }));
    if written.updates_others && fit.turns_p_value <= CONTRADICTION.get() {
        all.push(of(Kind::HEADING_DISAGREES).detail("p", format!("{:.0e}", fit.turns_p_value)));
    }
    all
}
