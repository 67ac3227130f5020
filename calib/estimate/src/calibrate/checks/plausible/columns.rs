//! The columns of a sensor as settings name them.

use findings::{OptionName, Remedy};
use recording::{AccelUnit, GyroUnit, Recording};
use sensor::Sensor;

use super::axes::SignedAxes;

/// The columns that the axes of a sensor come from.
#[derive(Clone, Debug)]
pub(super) struct Columns {
    /// Names of the axes' roles: `ax`, …
    pub roles: [&'static str; 3],
    /// Names of the columns in the file.
    names: [String; 3],
    /// The unit of the file in SI units; `None` for counts, and where nobody says.
    unit: Option<f64>,
    /// True for counts by what the file or the user says.
    counts: bool,
}

impl Columns {
    /// Builds it from the first recording, whose columns hold for all recordings of a call.
    pub fn of(recordings: &[&Recording], sensor: Sensor) -> Self {
        let roles = match sensor {
            Sensor::Accelerometer => ["ax", "ay", "az"],
            Sensor::Gyroscope => ["gx", "gy", "gz"],
            Sensor::Magnetometer => ["mx", "my", "mz"],
        };
        let first = recordings.first();
        let described = first.and_then(|recording| recording.description.of(sensor));
        let field = first.and_then(|recording| recording.magnetometer.as_ref());
        let columns = match (sensor, field) {
            (Sensor::Magnetometer, Some(field)) => Some(&field.columns),
            _ => described.map(|described| &described.columns),
        };
        let name = |role: &str| {
            let found = columns.into_iter().flatten().find(|(own, _)| *own == role);
            found
                .map(|(_, name)| name.clone())
                .filter(|name| !name.is_empty() && !name.contains(['\'', ',', '"']))
                .unwrap_or_else(|| role.to_owned())
        };
        let unit = described.map(|described| described.unit);
        let scale = match sensor {
            Sensor::Gyroscope => unit
                .and_then(|unit| unit.parse::<GyroUnit>().ok())
                .map(GyroUnit::scale),
            _ => unit
                .and_then(|unit| unit.parse::<AccelUnit>().ok())
                .map(AccelUnit::scale),
        };
        let counts = unit == Some("counts");
        Self {
            roles,
            names: roles.map(name),
            unit: scale.filter(|_| !counts),
            counts,
        }
    }

    /// The same of readings that a calibration has corrected.
    pub fn of_corrected(self) -> Self {
        Self {
            unit: self.unit.or(Some(1.0)),
            counts: false,
            ..self
        }
    }

    /// True for readings in SI units by what the file or the user says; where nobody does, `otherwise`.
    pub fn is_si(&self, otherwise: bool) -> bool {
        match (self.unit, self.counts) {
            (Some(_), _) => true,
            (None, true) => false,
            (None, false) => otherwise,
        }
    }

    /// `az=az*0.5`: axes times their factors.
    pub fn scaled(&self, factors: &[(usize, f64)]) -> Remedy {
        let entry = |&(axis, factor): &(usize, f64)| {
            format!(
                "{}={}*{}",
                self.roles[axis],
                self.names[axis],
                short(factor)
            )
        };
        let entries: Vec<String> = factors.iter().map(entry).collect();
        Remedy::set_to(OptionName::Columns, entries.join(","))
    }

    /// `az=az+9.80665`: an axis and a constant in SI units.
    pub fn shifted(&self, axis: usize, by: f64) -> Remedy {
        let by = by / self.unit.unwrap_or(1.0);
        let sign = if by < 0.0 { "" } else { "+" };
        let shifted = format!(
            "{}={}{sign}{}",
            self.roles[axis],
            self.names[axis],
            short(by)
        );
        Remedy::set_to(OptionName::Columns, shifted)
    }

    /// `gx,gz` to flip, or the columns `gx=gy,gy=gx`: the axes as `axes` takes them.
    pub fn turned(&self, axes: &SignedAxes) -> Remedy {
        if axes.is_in_order() {
            let flipped: Vec<&str> = axes.flipped().map(|axis| self.roles[axis]).collect();
            return Remedy::set_to(OptionName::Flip, flipped.join(","));
        }
        Remedy::set_to(OptionName::Columns, self.rearranged(axes).join(","))
    }

    /// `gx=gy`, … of the axes that `axes` changes.
    pub fn rearranged(&self, axes: &SignedAxes) -> Vec<String> {
        let changed = (0..3).filter(|&row| axes.of(row) != (row, false));
        let entry = |row: usize| {
            let (of, negative) = axes.of(row);
            let sign = if negative { "-" } else { "" };
            format!("{}={sign}{}", self.roles[row], self.names[of])
        };
        changed.map(entry).collect()
    }
}

/// Six significant digits, without trailing zeros.
fn short(value: f64) -> String {
    let decimals = (5.0 - value.abs().max(1e-12).log10().floor()).clamp(0.0, 12.0) as usize;
    let text = format!("{value:.decimals$}");
    match text.contains('.') {
        true => text.trim_end_matches('0').trim_end_matches('.').to_owned(),
        false => text,
    }
}
