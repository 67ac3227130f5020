//! Variables of a recording whose time is one of them: `t`, `acc` (N × 3) and `gyro`, or `t` and `ax` to `gz`.

use super::element::Raw;
use super::named_after::quantity;
use crate::stream::Recorder;
use crate::{Error, Quantity};

/// Variables kept: a time and nine axes, and some that turn out to be none.
const MOST: usize = 16;
/// Fewer numbers are no recording.
const SHORT: usize = 150;
/// Names of a time variable.
const TIMES: [&str; 8] = [
    "t",
    "time",
    "ts",
    "timestamp",
    "times",
    "seconds",
    "timestamps",
    "tout",
];
/// Names of the axes of each sensor without the letter of the axis.
const ACCEL: [&str; 4] = ["a", "acc", "accel", "accelerometer"];
const GYRO: [&str; 5] = ["g", "w", "gyr", "gyro", "gyroscope"];

/// The variables, in the order of the file.
#[derive(Default)]
pub(super) struct Loose(Vec<Kept>);

/// One of them, a column or three.
struct Kept {
    name: String,
    columns: Vec<Vec<f64>>,
}

impl Loose {
    /// Keeps a variable that may be one of them; false for any other.
    pub fn keep(&mut self, name: &str, dims: &[usize], numbers: Raw<'_>) -> bool {
        let [height, width] = *dims else { return false };
        if numbers.len() != height.saturating_mul(width) || self.0.len() == MOST {
            return false;
        }
        let rows = height.max(width);
        let count = height.min(width);
        let wanted = match count {
            1 => is_time(name) || axis(name).is_some(),
            3 => quantity(name).is_some_and(|quantity| quantity != Quantity::MagneticField),
            _ => false,
        };
        if !wanted || rows < SHORT {
            return false;
        }
        let at = |row: usize, column: usize| match width > height {
            true => numbers.get(row * count + column),
            false => numbers.get(column * rows + row),
        };
        let column = |column| (0..rows).filter_map(|row| at(row, column)).collect();
        self.0.push(Kept {
            name: name.to_owned(),
            columns: (0..count).map(column).collect(),
        });
        true
    }

    /// Returns the names of the variables.
    pub fn names(self) -> impl Iterator<Item = String> {
        self.0.into_iter().map(|kept| kept.name)
    }

    /// The streams that they make together; none without a time that goes up and is as long. What has become a stream is
    /// let go of before the next.
    ///
    /// # Errors
    /// More samples than the limit.
    pub fn join(mut self, recorder: &mut Recorder) -> Result<(), Error> {
        let goes_up = |kept: &Kept| kept.columns[0].windows(2).all(|pair| pair[0] < pair[1]);
        let is_clock = |kept: &Kept| is_time(&kept.name) && goes_up(kept);
        let Some(at) = self.0.iter().position(is_clock) else {
            // Without one nobody can tell: what is called like a sensor is asked about.
            let sensors = self.0.iter().filter(|kept| kept.columns.len() == 3);
            recorder
                .content
                .unclear
                .extend(sensors.map(|kept| kept.name.clone()));
            return Ok(());
        };
        let time = self.0.remove(at).columns.remove(0);
        self.0
            .retain(|kept| kept.columns.iter().all(|c| c.len() == time.len()));
        for wanted in [Quantity::SpecificForce, Quantity::AngularRate] {
            let is_whole =
                |kept: &Kept| kept.columns.len() == 3 && quantity(&kept.name) == Some(wanted);
            let (whole, others): (Vec<Kept>, Vec<Kept>) =
                std::mem::take(&mut self.0).into_iter().partition(is_whole);
            self.0 = others;
            // Of several nobody knows which.
            if whole.len() > 1 {
                let names = whole.into_iter().map(|kept| kept.name);
                recorder.content.unclear.extend(names);
                continue;
            }
            let is_axis = |kept: &Kept| axis(&kept.name).is_some_and(|(of, _)| of == wanted);
            let (axes, others) = std::mem::take(&mut self.0).into_iter().partition(is_axis);
            self.0 = others;
            let taken = whole.into_iter().next().or_else(|| triad(axes));
            let Some(Kept { name, columns }) = taken else {
                continue;
            };
            let Some(stream) = recorder.stream(&name, 0, wanted) else {
                continue;
            };
            recorder.at(stream).in_si = false;
            recorder.reserve(stream, time.len());
            for (row, t) in time.iter().enumerate() {
                let value = [0, 1, 2].map(|axis| columns[axis][row]);
                recorder.push(stream, (t * 1e9).round() as i64, value)?;
            }
        }
        Ok(())
    }
}

/// The columns of the three axes as one variable; the first of several for an axis.
fn triad(mut axes: Vec<Kept>) -> Option<Kept> {
    let mut of_axis = |letter: usize| {
        let is_it = |kept: &Kept| axis(&kept.name).is_some_and(|(_, axis)| axis == letter);
        let at = axes.iter().position(is_it)?;
        Some(axes.remove(at))
    };
    let three = [of_axis(0)?, of_axis(1)?, of_axis(2)?];
    let name = three.each_ref().map(|kept| kept.name.as_str()).join(", ");
    let columns = three.into_iter().flat_map(|kept| kept.columns).collect();
    Some(Kept { name, columns })
}

fn is_time(name: &str) -> bool {
    TIMES.contains(&name.to_lowercase().as_str())
}

/// The sensor and axis that a vector is called after: `ax`, `gyro_z`.
fn axis(name: &str) -> Option<(Quantity, usize)> {
    let word: String = name
        .chars()
        .filter(|c| *c != '_')
        .collect::<String>()
        .to_lowercase();
    let letter = word.chars().next_back()?;
    let axis = "xyz".find(letter)?;
    let stem = &word[..word.len() - 1];
    if ACCEL.contains(&stem) {
        Some((Quantity::SpecificForce, axis))
    } else if GYRO.contains(&stem) {
        Some((Quantity::AngularRate, axis))
    } else {
        None
    }
}
