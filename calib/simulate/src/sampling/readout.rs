//! From a reading to what is written down: range and resolution.

use nalgebra::Vector3;

/// Range and resolution of one sensor.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(crate) struct Readout {
    /// Largest reading in either direction, if there is one.
    pub range: Option<f64>,
    /// Least significant bit; 0 for none.
    pub step: f64,
    /// Write counts, not units.
    pub counts: bool,
    /// Readings closer to zero than this are zero.
    pub dead_zone: f64,
}

/// Count of a 16-bit converter for zero.
pub(crate) const ZERO_COUNT: f64 = 32768.0;
/// Its largest count.
const LAST_COUNT: f64 = 65535.0;

impl Readout {
    /// Silences the dead zone, clips, rounds to whole steps and, where counts are wanted, adds the zero.
    pub fn read(&self, value: Vector3<f64>) -> Vector3<f64> {
        value.map(|v| {
            let v = if v.abs() < self.dead_zone { 0.0 } else { v };
            let v = self.range.map_or(v, |range| v.clamp(-range, range));
            if self.counts {
                ((v / self.step).round() + ZERO_COUNT).clamp(0.0, LAST_COUNT)
            } else if self.step > 0.0 {
                (v / self.step).round() * self.step
            } else {
                v
            }
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_dead_zone_is_silent_and_leaves_the_remainder_alone() {
        let readout = Readout {
            dead_zone: 0.1,
            ..Readout::default()
        };
        let value = Vector3::new(0.09, -0.09, 0.11);
        assert_eq!(readout.read(value), Vector3::new(0.0, 0.0, 0.11));
    }

    #[test]
    fn readings_are_clipped_rounded_and_counted() {
        let value = Vector3::new(0.26, -7.0, 3.0);
        let units = Readout {
            range: Some(4.0),
            step: 0.5,
            ..Readout::default()
        };
        assert_eq!(units.read(value), Vector3::new(0.5, -4.0, 3.0));
        let counts = Readout {
            counts: true,
            ..units
        };
        assert_eq!(counts.read(value), Vector3::new(32769.0, 32760.0, 32774.0));
    }
}
