//! Names of parameters in words.

use sensor::{BasePart, base_part};

/// `gyro.s_x (the gyroscope's scale factor on x)`; a name that is none of a base model stays alone.
pub(super) fn with_words(name: &str) -> String {
    match in_words(name) {
        Some(words) => format!("{name} ({words})"),
        None => name.to_owned(),
    }
}

fn in_words(name: &str) -> Option<String> {
    let (sensor, part) = base_part(name)?;
    let (_, axes) = name.split_once('_')?;
    let (what, count) = match part {
        BasePart::ScaleFactor => ("scale factor on", 1),
        BasePart::Bias => ("bias on", 1),
        BasePart::Misalignment => ("misalignment", 2),
    };
    let are_axes = axes.len() == count && axes.chars().all(|axis| "xyz".contains(axis));
    are_axes.then(|| format!("the {}'s {what} {axes}", sensor.name()))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn parameters_of_base_models_are_said_in_words_and_others_stay() {
        let expected = "gyro.s_x (the gyroscope's scale factor on x)";
        assert_eq!(with_words("gyro.s_x"), expected);
        let expected = "accel.alpha_yz (the accelerometer's misalignment yz)";
        assert_eq!(with_words("accel.alpha_yz"), expected);
        for other in ["accel_quadratic.k_x", "gyro.g_xy", "CAL_ACC0_XOFF", "s_x"] {
            assert_eq!(with_words(other), other);
        }
    }
}
