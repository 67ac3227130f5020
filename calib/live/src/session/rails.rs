//! A gyroscope at the end of its range, as it happens.

use nalgebra::Vector3;

findings::tuning! {
    /// So many equal readings in a row are a rail, not a peak.
    RUN: usize = 4;
    /// Slower readings are equal for other reasons, rad/s.
    FAST: f64 = 2.0;
}

/// Runs of equal readings on each axis.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct Rails {
    last: Vector3<f64>,
    runs: [usize; 3],
}

impl Rails {
    /// The axis that is at its rail with this reading; `unit` is that of the reading in rad/s.
    pub(crate) fn look_at(&mut self, reading: &Vector3<f64>, unit: f64) -> Option<usize> {
        for axis in 0..3 {
            let same =
                reading[axis] == self.last[axis] && (reading[axis] * unit).abs() > FAST.get();
            self.runs[axis] = if same { self.runs[axis] + 1 } else { 1 };
        }
        self.last = *reading;
        self.runs.iter().position(|run| *run >= RUN.get())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn equal_readings_are_a_rail_only_where_they_are_fast() {
        let mut rails = Rails::default();
        let mut look = |x: f64| {
            (0..4)
                .filter_map(|_| rails.look_at(&Vector3::new(0.0, x, 0.0), 1.0))
                .last()
        };
        assert_eq!(
            [look(0.01), look(4.36), look(-4.36)],
            [None, Some(1), Some(1)]
        );
    }
}
