//! Formulas that no effect of the catalogue has.

use calib::effect_file::parse_effects;
use calib::simulate::Spec;
use sensor::Sensor;

/// One form on one axis or on all, with its size for a likelihood ratio of some hundreds.
pub struct Hidden {
    /// Its name as a kind of session.
    pub name: &'static str,
    /// The sensor.
    pub sensor: Sensor,
    /// The axes that read it.
    axes: &'static str,
    /// What is multiplied on the first of them, as expressions and equations have it; the others have the axes that follow.
    product: &'static str,
    unit: &'static str,
    typical: f64,
}

const fn of_force(
    name: &'static str,
    axes: &'static str,
    product: &'static str,
    unit: &'static str,
    typical: f64,
) -> Hidden {
    Hidden {
        name,
        sensor: Sensor::Accelerometer,
        axes,
        product,
        unit,
        typical,
    }
}

const fn of_rate(
    name: &'static str,
    axes: &'static str,
    product: &'static str,
    unit: &'static str,
    typical: f64,
) -> Hidden {
    Hidden {
        sensor: Sensor::Gyroscope,
        ..of_force(name, axes, product, unit, typical)
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

/// Twenty that every axis has, each with a coefficient of its own.
pub const ON_ALL_AXES: [Hidden; 20] = [
    of_rate("rates w f", "xyz", "fx * wx", "1/(m/s^2)", 2e-4),
    of_rate("rates w f'", "xyz", "fy * wx", "1/(m/s^2)", 2e-4),
    of_rate("rates w' f", "xyz", "fx * wy", "1/(m/s^2)", 2e-4),
    of_rate("rates w w'", "xyz", "wx * wy", "1/(rad/s)", 1e-3),
    of_rate("rates w'^2", "xyz", "wy^2", "1/(rad/s)", 1e-3),
    of_rate("rates abs(w')", "xyz", "abs(wy)", "", 1e-3),
    of_rate("rates w abs(w)", "xyz", "wx * abs(wx)", "1/(rad/s)", 1e-3),
    of_rate("rates w^2 f", "xyz", "fx * wx^2", "1/(rad/s)/(m/s^2)", 1e-4),
    of_rate("rates alpha f", "xyz", "fx * alphax", "s/(m/s^2)", 1e-4),
    of_rate("rates f f'", "xyz", "fx * fy", "rad/s/(m/s^2)^2", 5e-6),
    of_rate("rates f^3", "xyz", "fx^3", "rad/s/(m/s^2)^3", 5e-7),
    of_rate("rates f'^3", "xyz", "fy^3", "rad/s/(m/s^2)^3", 5e-7),
    of_rate("rates abs(f)", "xyz", "abs(fx)", "rad/s/(m/s^2)", 2e-5),
    of_rate("rates change", "xyz", "changex", "rad/s/(m/s^2)", 1e-5),
    of_force("forces f^4", "xyz", "fx^4", "1/(m/s^2)^3", 2e-6),
    of_force("forces f'^2", "xyz", "fy^2", "1/(m/s^2)", 2e-4),
    of_force("forces f'^3", "xyz", "fy^3", "1/(m/s^2)^2", 2e-5),
    of_force("forces f^2 f'", "xyz", "fx^2 * fy", "1/(m/s^2)^2", 2e-5),
    of_force("forces abs(f')", "xyz", "abs(fy)", "", 1e-3),
    of_force("forces f abs(f)", "xyz", "fx * abs(fx)", "1/(m/s^2)", 2e-4),
];

/// Coefficients on the axes, as shares of the size: they begin at another axis in every third session.
const SHARES: [f64; 3] = [1.0, -0.6, 1.4];

/// Names of the kinds.
pub const NAMES: [&str; FORMULAS.len()] = names(&FORMULAS);

/// Names of the kinds that every axis has.
pub const NAMES_ON_ALL_AXES: [&str; ON_ALL_AXES.len()] = names(&ON_ALL_AXES);

const fn names<const N: usize>(all: &[Hidden; N]) -> [&'static str; N] {
    let mut names = [""; N];
    let mut k = 0;
    while k < N {
        names[k] = all[k].name;
        k += 1;
    }
    names
}

impl Hidden {
    /// That of a kind of session.
    pub fn named(name: &str) -> Option<&'static Self> {
        let mut all = FORMULAS.iter().chain(&ON_ALL_AXES);
        all.find(|hidden| hidden.name == name)
    }

    /// The axes with what each of them reads.
    fn terms(&self) -> impl Iterator<Item = (char, String)> {
        let axes = self.axes.chars().enumerate();
        axes.map(|(by, axis)| (axis, turned(self.product, by)))
    }

    /// The session with it, so many times its size.
    pub fn put_into(&self, mut spec: Spec, size: f64) -> Option<Spec> {
        let (name, sensor) = match self.sensor {
            Sensor::Accelerometer => ("accel_hidden", "accelerometer"),
            _ => ("gyro_hidden", "gyroscope"),
        };
        let (mut terms, mut parameters) = (String::new(), Vec::new());
        for (axis, product) in self.terms() {
            terms += &format!("{axis} = \"k{axis} * {product}\"\n");
            parameters.push(format!(
                "{{ name = \"k{axis}\", unit = \"{}\", typical = {:e} }}",
                self.unit, self.typical
            ));
        }
        let definition = format!(
            "[[definitions]]\nname = \"{name}\"\nsensor = \"{sensor}\"\n{terms}parameters = [{}]\n",
            parameters.join(", ")
        );
        let effects = parse_effects(&definition, "hidden.toml").ok()?;
        spec.definitions = vec![effects.first()?.definition()?.clone()];
        let first = (spec.seed % SHARES.len() as u64) as usize;
        let own = spec.effects.entry(name.into()).or_default();
        for (k, (axis, _)) in self.terms().enumerate() {
            let share = match self.axes.len() {
                1 => 1.0,
                _ => SHARES[(first + k) % SHARES.len()],
            };
            own.insert(format!("k{axis}"), size * share * self.typical);
        }
        Some(spec)
    }

    /// Whether an equation, or one of what would do as well, has terms of this one alone.
    pub fn is(&self, equation: &str, alternatives: &[String]) -> bool {
        let letter = match self.sensor {
            Sensor::Accelerometer => "A",
            _ => "W",
        };
        let terms: Vec<(String, String)> = self
            .terms()
            .map(|(axis, product)| (format!("{letter}_{axis} += "), sorted(&product)))
            .collect();
        let is_own = |term: &str| {
            terms.iter().any(|(head, product)| {
                let coefficient = term.strip_prefix(head.as_str());
                let own = coefficient.and_then(|term| term.split_once(" * "));
                own.is_some_and(|(_, own)| !own.contains(" + ") && sorted(own) == *product)
            })
        };
        equation.split(", ").all(is_own) || alternatives.iter().any(|other| is_own(other))
    }
}

/// The factors of a product in the order of their letters.
fn sorted(product: &str) -> String {
    let mut factors: Vec<&str> = product.split(" * ").collect();
    factors.sort_unstable();
    factors.join(" * ")
}

/// The product of the axis that comes so many places later: x, y, z, and x again.
fn turned(product: &str, by: usize) -> String {
    let axes = ['x', 'y', 'z'];
    let place = |c: char| axes.iter().position(|axis| *axis == c);
    let later = |c| place(c).map_or(c, |k| axes[(k + by) % axes.len()]);
    product.chars().map(later).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_form_goes_with_the_axes_and_is_told_in_any_order_of_its_factors() {
        assert_eq!(turned("fy * abs(wz)", 1), "fz * abs(wx)");
        let hidden = Hidden::named("rates w f'").unwrap();
        assert!(hidden.is("W_x += x_fy_wx * fy * wx, W_y += y_fz_wy * wy * fz", &[]));
        assert!(!hidden.is("W_y += y_fy_wy * fy * wy", &[]));
    }
}
