//! Readings of a sensor of one dimension beside the others, on their own clock.

use findings::{Finding, Kind};

use super::Recording;
use super::arrays::{check, goes_back};
use super::stream::is_before;
use crate::Error;
use crate::source::place::in_file;

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

impl Recording {
    /// The readings of a sensor of one dimension.
    pub fn scalar(&self, name: &str) -> Option<&ScalarStream> {
        self.scalars.iter().find(|own| own.name == name)
    }

    /// The same with the readings of a sensor of one dimension beside the others: `t` (s, `n`), readings (`n`) and the true signal at
    /// these stamps (`n`), or none.
    ///
    /// # Errors
    /// [`Error::Input`] for arrays of different lengths, a number that is not finite, time that does not go on, readings of which none lies
    /// within the recording, and a name that the recording has already.
    ///
    /// # Examples
    /// ```
    /// use stillpoint_recording::Recording;
    ///
    /// let recording = Recording::default().with_scalar("barometer", &[0.0, 0.1], &[101_300.0, 101_302.0], &[])?;
    /// assert_eq!(recording.scalars[0].values[1], 101_302.0);
    /// assert!(recording.with_scalar("barometer", &[0.0], &[0.0], &[]).is_err());
    /// # Ok::<(), stillpoint_recording::Error>(())
    /// ```
    pub fn with_scalar(
        mut self,
        name: &str,
        t: &[f64],
        readings: &[f64],
        truth: &[f64],
    ) -> Result<Self, Error> {
        if self.scalar(name).is_some() {
            let taken = Finding::of(Kind::NameTaken).detail("name", name);
            return Err(in_file(&self.name, taken));
        }
        let arrays = [("readings", readings), ("truth", truth)];
        let arrays = arrays.map(|(array, values)| (array, values.len()));
        let wrong = arrays
            .into_iter()
            .find(|(array, len)| *len != t.len() && (*array == "readings" || *len > 0));
        if let Some((array, len)) = wrong {
            let lengths = Finding::of(Kind::ArrayLengths)
                .detail("array", array)
                .count("rows", len)
                .count("stamps", t.len());
            return Err(in_file(name, lengths));
        }
        for (array, values, column) in [("t", t, 1), ("readings", readings, 2), ("truth", truth, 3)]
        {
            for (k, &value) in values.iter().enumerate() {
                check(name, k, array, value, column)?;
            }
        }
        let (start, end) = (self.start(), self.end());
        if start < end && !t.iter().any(|t| (start..=end).contains(t)) {
            let outside = Finding::of(Kind::ScalarOutside)
                .detail("name", name)
                .number("from", start, "s")
                .number("to", end, "s");
            return Err(in_file(&self.name, outside));
        }
        if let Some(k) = t.windows(2).position(|pair| pair[1] <= pair[0]) {
            return Err(goes_back(name, k as u64 + 2, t[k], t[k + 1]));
        }
        self.scalars.push(ScalarStream {
            name: name.to_owned(),
            t: t.to_vec(),
            values: readings.to_vec(),
            truth: truth.to_vec(),
        });
        Ok(self)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn with(t: &[f64], readings: &[f64], truth: &[f64]) -> Result<Recording, Error> {
        Recording::default().with_scalar("barometer", t, readings, truth)
    }

    #[test]
    fn means_are_those_of_the_samples_within() {
        let recording = with(&[0.0, 1.0, 2.0], &[1.0, 3.0, 9.0], &[1.0, 1.0, 4.0]).unwrap();
        let own = &recording.scalars[0];
        assert_eq!(own.means(0.0, 2.0), Some([2.0, 1.0]));
        assert_eq!(own.means(5.0, 6.0), None);
        let unknown = with(&[0.0], &[1.0], &[]).unwrap();
        assert_eq!(unknown.scalars[0].means(0.0, 1.0), None);
    }

    #[test]
    fn arrays_that_do_not_fit_are_refused_with_their_row() {
        let said = |t: &[f64], readings: &[f64], truth: &[f64]| {
            with(t, readings, truth).unwrap_err().to_string()
        };
        let short = said(&[0.0, 1.0], &[1.0], &[]);
        assert!(short.contains("readings has 1 row, t has 2"), "{short}");
        let back = said(&[0.0, 0.0], &[1.0, 1.0], &[]);
        assert!(back.starts_with("barometer:2"), "{back}");
        let infinite = said(&[0.0], &[f64::INFINITY], &[]);
        assert!(infinite.starts_with("barometer:1:2"), "{infinite}");
        let truth = said(&[0.0, 1.0], &[1.0, 1.0], &[1.0]);
        assert!(truth.contains("truth has 1 row"), "{truth}");
    }
}
