//! `sensor_msgs/Imu` and `sensor_msgs/MagneticField` in JSON, as MCAP files of other programs than ROS have them.

use serde_json::Value;

/// The content of a message.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Said {
    /// Stamp, ns.
    pub stamp: i64,
    /// Specific force, or magnetic field.
    pub first: Option<[f64; 3]>,
    /// Angular rate.
    pub second: Option<[f64; 3]>,
}

const NANO: i64 = 1_000_000_000;

/// The message in `bytes`; `None` where it is damaged or has no stamp.
pub(super) fn said(bytes: &[u8]) -> Option<Said> {
    let message: Value = serde_json::from_slice(bytes).ok()?;
    let stamps = ["/header/stamp", "/timestamp", "/stamp"];
    let stamp = stamps.iter().find_map(|path| message.pointer(path))?;
    let part = |names: &[&str]| {
        let mut values = names.iter().filter_map(|name| stamp.get(name));
        values.next()?.as_i64()
    };
    let seconds = part(&["sec", "secs", "seconds"])?;
    let nanoseconds = part(&["nanosec", "nsec", "nsecs", "nanos"])?;
    let vector = |name: &str| {
        let covariance = message.get(format!("{name}_covariance"));
        // A first entry of -1 says that the sensor does not measure it.
        let missing = covariance.and_then(|all| all.get(0)?.as_f64()) == Some(-1.0);
        let vector = message.get(name).filter(|_| !missing)?;
        let axis = |name: &str| vector.get(name)?.as_f64();
        Some([axis("x")?, axis("y")?, axis("z")?])
    };
    Some(Said {
        stamp: seconds.checked_mul(NANO)?.checked_add(nanoseconds)?,
        first: vector("linear_acceleration").or_else(|| vector("magnetic_field")),
        second: vector("angular_velocity"),
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_message_in_json_says_what_its_twin_in_cdr_does() {
        let message = br#"{"header":{"stamp":{"sec":7,"nanosec":5},"frame_id":"imu"},
            "angular_velocity":{"x":0.1,"y":0.2,"z":0.3},"angular_velocity_covariance":[0,0,0],
            "linear_acceleration":{"x":1,"y":2,"z":9.8}}"#;
        let expected = Said {
            stamp: 7_000_000_005,
            first: Some([1.0, 2.0, 9.8]),
            second: Some([0.1, 0.2, 0.3]),
        };
        assert_eq!(said(message), Some(expected));
        let message = br#"{"timestamp":{"sec":7,"nsec":5},"angular_velocity_covariance":[-1],
            "angular_velocity":{"x":0,"y":0,"z":0}}"#;
        assert_eq!(
            said(message).map(|said| (said.stamp, said.second)),
            Some((7_000_000_005, None))
        );
        assert_eq!(
            said(b"{}")
                .or_else(|| said(b"[1]"))
                .or_else(|| said(b"\x00")),
            None
        );
    }
}
