//! Readings of a sensor of one dimension beside the others, on their own clock.

use super::stream::is_before;

/// Readings of a sensor of one dimension, with what it should have read where somebody knows.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct ScalarStream {
    /// Name of the sensor.
    pub name: String,
    /// Time stamps, s, on the clock of the recording.
    pub t: Vec<f64>,
    /// Readings, in the sensor's unit.
    pub values: Vec<f64>,
    /// The true signal at each stamp; empty where nobody knows it.
    pub truth: Vec<f64>,
}

impl ScalarStream {
    /// Means of the readings and of the true signal from `from` to `to`, s; `None` without readings there or without a truth.
    pub fn means(&self, from: f64, to: f64) -> Option<[f64; 2]> {
        let first = self.t.partition_point(|&t| is_before(t, from));
        let end = self.t.partition_point(|&t| is_before(t, to));
        let mean = |values: &[f64]| {
            let own = values.get(first..end).filter(|own| !own.is_empty())?;
            Some(own.iter().sum::<f64>() / own.len() as f64)
        };
        Some([mean(&self.values)?, mean(&self.truth)?])
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn means_are_those_of_the_samples_within() {
        let own = ScalarStream {
            name: "barometer".into(),
            t: vec![0.0, 1.0, 2.0],
            values: vec![1.0, 3.0, 9.0],
            truth: vec![1.0, 1.0, 4.0],
        };
        assert_eq!(own.means(0.0, 2.0), Some([2.0, 1.0]));
        assert_eq!(own.means(5.0, 6.0), None);
        let unknown = ScalarStream {
            truth: Vec::new(),
            ..own
        };
        assert_eq!(unknown.means(0.0, 1.0), None);
    }
}
