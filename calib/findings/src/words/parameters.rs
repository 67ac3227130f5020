//! Names of parameters in words.

/// `gyro.s_x (the gyroscope's scale factor on x)`; a name that is none of a base model stays alone.
pub(super) fn with_words(name: &str) -> String {
    match in_words(name) {
        Some(words) => format!("{name} ({words})"),
        None => name.to_owned(),
    }
}

fn in_words(name: &str) -> Option<String> {
    let (sensor, parameter) = name.split_once('.')?;
    let sensor = match sensor {
        "accel" => "accelerometer",
        "gyro" => "gyroscope",
        "mag" => "magnetometer",
        _ => return None,
    };
    let (kind, axes) = parameter.split_once('_')?;
    if axes.is_empty() || !axes.chars().all(|axis| "xyz".contains(axis)) {
        return None;
    }
    let what = match (kind, axes.len()) {
        ("s", 1) => "scale factor on",
        ("b", 1) => "bias on",
        ("alpha" | "beta" | "gamma", 2) => "misalignment",
        _ => return None,
    };
    Some(format!("the {sensor}'s {what} {axes}"))
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
