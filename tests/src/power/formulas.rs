//! Formulas that no effect of the catalogue has.

use calib::effect_file::parse_effects;
use calib::simulate::Spec;
use sensor::Sensor;

/// One term, with its size for a likelihood ratio of some hundreds.
pub struct Hidden {
    /// Its name as a kind of session.
    pub name: &'static str,
    /// The sensor.
    pub sensor: Sensor,
    /// The axis that reads it.
    axis: &'static str,
    /// What is multiplied, as expressions and equations have it.
    pub product: &'static str,
    unit: &'static str,
    typical: f64,
}

const fn of_force(
    name: &'static str,
    axis: &'static str,
    product: &'static str,
    unit: &'static str,
    typical: f64,
) -> Hidden {
    Hidden {
        name,
        sensor: Sensor::Accelerometer,
        axis,
        product,
        unit,
        typical,
    }
}

const fn of_rate(
    name: &'static str,
    axis: &'static str,
    product: &'static str,
    unit: &'static str,
    typical: f64,
) -> Hidden {
    Hidden {
        sensor: Sensor::Gyroscope,
        ..of_force(name, axis, product, unit, typical)
    }
}

/// Ten of second and third order, four of a size or a history.
pub const FORMULAS: [Hidden; 14] = [
    of_rate("rate fy fz", "x", "fy * fz", "rad/s/(m/s^2)^2", 5e-6),
    of_rate("rate fx fz", "y", "fx * fz", "rad/s/(m/s^2)^2", 5e-6),
    of_rate("rate fx^3", "z", "fx^3", "rad/s/(m/s^2)^3", 5e-7),
    of_rate("rate fx^2 fy", "x", "fx^2 * fy", "rad/s/(m/s^2)^3", 5e-7),
    of_rate("rate wx fy", "z", "fy * wx", "1/(m/s^2)", 2e-4),
    of_rate("rate wx wy", "z", "wx * wy", "1/(rad/s)", 1e-3),
    of_rate("rate wz wz", "x", "wz^2", "1/(rad/s)", 1e-3),
    of_force("force fx fy^2", "z", "fx * fy^2", "1/(m/s^2)^2", 2e-5),
    of_force("force fx fy", "x", "fx * fy", "1/(m/s^2)", 2e-4),
    of_force("force fz^2 fy", "x", "fy * fz^2", "1/(m/s^2)^2", 2e-5),
    of_rate("rate abs(fy)", "z", "abs(fy)", "rad/s/(m/s^2)", 2e-5),
    of_rate("rate changez", "x", "changez", "rad/s", 1e-4),
    of_rate("rate turny", "y", "turny", "rad/s", 1e-4),
    of_force("force abs(fy)", "z", "abs(fy)", "", 1e-3),
];

/// Names of the kinds.
pub const NAMES: [&str; FORMULAS.len()] = {
    let mut names = [""; FORMULAS.len()];
    let mut k = 0;
    while k < FORMULAS.len() {
        names[k] = FORMULAS[k].name;
        k += 1;
    }
    names
};

impl Hidden {
    /// That of a kind of session.
    pub fn named(name: &str) -> Option<&'static Self> {
        FORMULAS.iter().find(|hidden| hidden.name == name)
    }

    /// The session with it, so many times its size.
    pub fn put_into(&self, mut spec: Spec, size: f64) -> Option<Spec> {
        let (name, sensor) = match self.sensor {
            Sensor::Accelerometer => ("accel_hidden", "accelerometer"),
            _ => ("gyro_hidden", "gyroscope"),
        };
        let definition = format!(
            "[[definitions]]\nname = \"{name}\"\nsensor = \"{sensor}\"\n{} = \"k * {}\"\nparameters = [{{ name = \"k\", unit = \
             \"{}\", typical = {:e} }}]\n",
            self.axis, self.product, self.unit, self.typical
        );
        let effects = parse_effects(&definition, "hidden.toml").ok()?;
        spec.definitions = vec![effects.first()?.definition()?.clone()];
        let own = spec.effects.entry(name.into()).or_default();
        own.insert("k".into(), size * self.typical);
        Some(spec)
    }

    /// Whether an equation, or one of what would do as well, is this one alone.
    pub fn is(&self, equation: &str, alternatives: &[String]) -> bool {
        let letter = match self.sensor {
            Sensor::Accelerometer => "A",
            _ => "W",
        };
        let own = |equation: &str| {
            let head = format!("{letter}_{} += ", self.axis);
            let tail = format!(" * {}", self.product);
            equation.starts_with(&head) && equation.ends_with(&tail) && !equation.contains(" + ")
        };
        own(equation) || alternatives.iter().any(|other| own(other))
    }
}
