//! Static intervals and turns of one or more recordings, with what a calibration leaves of each.

use calib::calibration::Triad;
use calib::intervals::{Detector, Segmentation, StaticInterval, Turn, is_of};
use calib::methods::joint::{JointFit, Scope};
use calib::{Calibration, Misfit, Misfits, Recording, misfits};

use super::direction;
use crate::report::ReportTable;
use crate::show;

/// Letters of a recording's name in a picture.
const LETTERS: usize = 18;

/// Everything that pages show of recordings.
#[derive(Debug)]
pub struct Session<'a> {
    /// The recordings, as they were cut.
    pub parts: Vec<Part<'a>>,
    /// All static intervals.
    pub rests: Vec<Rest>,
    /// All turns.
    pub turns: Vec<Moved>,
}

/// A recording.
#[derive(Debug)]
pub struct Part<'a> {
    /// A name that no other has, short enough for a legend.
    pub name: String,
    /// Itself.
    pub recording: &'a Recording,
    /// Segmentation into static intervals and turns.
    pub segmentation: &'a Segmentation,
    /// Number of its first static interval, counted through all recordings from 1.
    pub first: usize,
}

/// A static interval.
#[derive(Clone, Debug)]
pub struct Rest {
    /// Its number through all recordings.
    pub key: String,
    /// Index of the recording.
    pub part: usize,
    /// Begin and end, s.
    pub span: (f64, f64),
    /// Unit vector of specific force in the axes of the device.
    pub up: Option<[f64; 3]>,
    /// Mean temperature, °C.
    pub temperature: Option<f64>,
    /// Norm less gravity of the raw readings, mm/s².
    pub raw: Option<f64>,
    /// The same calibrated.
    pub left: Option<f64>,
    /// Standard deviation of the mean by white noise, mm/s².
    pub std: Option<f64>,
    /// True where the fit found it disturbed.
    pub is_disturbed: bool,
}

/// A turn.
#[derive(Clone, Debug)]
pub struct Moved {
    /// `t` and the number of the static interval before it.
    pub key: String,
    /// Index of the recording.
    pub part: usize,
    /// Begin and end, s.
    pub span: (f64, f64),
    /// Largest rate, °/s; of raw counts none.
    pub rate: Option<f64>,
    /// Angle by which the predicted direction of gravity misses, raw readings, °.
    pub raw: Option<f64>,
    /// The same calibrated.
    pub left: Option<f64>,
    /// Why it was not used.
    pub fault: Option<String>,
    /// True where the fit found it disturbed.
    pub is_disturbed: bool,
}

impl<'a> Session<'a> {
    /// Measures every recording under its own biases; without a calibration only the raw readings.
    ///
    /// # Errors
    /// As [`misfits`].
    pub fn of(
        cut: impl Iterator<Item = (&'a Recording, &'a Segmentation)>,
        calibration: Option<&Calibration>,
        gravity: f64,
    ) -> Result<Self, calib::Error> {
        let cut: Vec<_> = cut.collect();
        let names = short_names(&cut.iter().map(|(r, _)| r.name.as_str()).collect::<Vec<_>>());
        let mut session = Self {
            parts: Vec::new(),
            rests: Vec::new(),
            turns: Vec::new(),
        };
        for ((recording, segmentation), name) in cut.into_iter().zip(names) {
            let part = Part {
                name,
                recording,
                segmentation,
                first: session.rests.len() + 1,
            };
            session.add(part, calibration, gravity)?;
        }
        Ok(session)
    }

    fn add(
        &mut self,
        part: Part<'a>,
        calibration: Option<&Calibration>,
        gravity: f64,
    ) -> Result<(), calib::Error> {
        let Part {
            recording,
            segmentation,
            first,
            ..
        } = part;
        let measure = |c| misfits(recording, segmentation, c, gravity);
        let own = calibration.map(|c| with_own_bias(c, &recording.name));
        let left = own.as_ref().map(|own| measure(Some(own))).transpose()?;
        let si = calibration.is_none_or(in_si);
        let raw = si.then(|| measure(None)).transpose()?;
        let number = self.parts.len();
        let triad = own.as_ref().and_then(|own| own.accelerometer.as_ref());
        for (k, rest) in segmentation.statics.iter().enumerate() {
            self.rests.push(Rest {
                key: (first + k).to_string(),
                part: number,
                span: (rest.span.from, rest.span.to),
                up: up(rest, triad),
                temperature: rest.temperature,
                raw: at(&raw, |m| &m.rests, k).map(|v| 1e3 * v),
                left: at(&left, |m| &m.rests, k).map(|v| 1e3 * v),
                std: std(rest, triad),
                is_disturbed: false,
            });
        }
        let gyroscope = own.as_ref().and_then(|own| own.gyroscope.as_ref());
        for turn in &segmentation.turns {
            self.turns.push(Moved {
                key: format!("t{}", first + turn.from),
                part: number,
                span: (turn.span.from, turn.span.to),
                rate: (si || gyroscope.is_some())
                    .then(|| largest_rate(recording, turn, gyroscope))
                    .flatten(),
                raw: at(&raw, |m| &m.turns, turn.from),
                left: at(&left, |m| &m.turns, turn.from),
                fault: turn.fault.as_ref().map(ToString::to_string),
                is_disturbed: false,
            });
        }
        self.parts.push(part);
        Ok(())
    }

    /// Marks what the fit of these recordings found disturbed.
    pub fn mark(&mut self, fit: &JointFit) {
        for found in &fit.flagged {
            // A long recording is fitted in parts.
            let name = &fit.data.sources[found.recording].name;
            let mut parts = self.parts.iter();
            let Some(part) = parts.find(|part| is_of(name, &part.recording.name)) else {
                continue;
            };
            let key = part.first + found.interval;
            if let Some(rest) = self.rests.get_mut(key - 1)
                && found.fault.opens_force
            {
                rest.is_disturbed = true;
            }
            let turn = format!("t{key}");
            if let Some(turn) = self.turns.iter_mut().find(|own| own.key == turn)
                && found.fault.scope == Scope::Turn
            {
                turn.is_disturbed = true;
            }
        }
    }

    /// Upward directions.
    pub fn directions(&self) -> Vec<[f64; 3]> {
        self.rests.iter().filter_map(|rest| rest.up).collect()
    }

    /// The table that points in pictures refer to; with notes where there are any.
    pub fn table(&self) -> ReportTable {
        let has_notes = self.parts.len() > 1 || self.turns.iter().any(|turn| turn.fault.is_some());
        let columns = if has_notes { 8 } else { 7 };
        let header = [
            "interval",
            "from, s",
            "to, s",
            "up",
            "raw, mm/s² (turn: °)",
            "left",
            "std error",
            "note",
        ];
        let mut table = ReportTable::new(header.into_iter().take(columns));
        let mut turns = self.turns.iter().peekable();
        for rest in &self.rests {
            let number = |v: Option<f64>| v.map_or(String::new(), |v| format!("{v:+.2}"));
            let cells = [
                format!("static {}", rest.key),
                format!("{:.2}", rest.span.0),
                format!("{:.2}", rest.span.1),
                rest.up.as_ref().map_or(String::new(), direction::words),
                number(rest.raw),
                number(rest.left),
                rest.std.map_or(String::new(), |v| format!("{v:.3}")),
                self.of_several(rest.part),
            ];
            table.keyed(&rest.key, cells.into_iter().take(columns));
            if let Some(turn) = turns.next_if(|turn| turn.key[1..] == rest.key) {
                let number = |v: Option<f64>| v.map_or(String::new(), |v| format!("{v:.3}"));
                let note = turn
                    .fault
                    .as_ref()
                    .map(|fault| format!("not used: {fault}"));
                let cells = [
                    format!("turn {}", rest.key),
                    format!("{:.2}", turn.span.0),
                    format!("{:.2}", turn.span.1),
                    String::new(),
                    number(turn.raw),
                    number(turn.left),
                    String::new(),
                    note.unwrap_or_else(|| self.of_several(turn.part)),
                ];
                table.keyed(&turn.key, cells.into_iter().take(columns));
            }
        }
        table
    }

    fn of_several(&self, part: usize) -> String {
        let several = self.parts.len() > 1;
        self.parts
            .get(part)
            .filter(|_| several)
            .map_or(String::new(), |part| part.name.clone())
    }
}

/// Recordings as they are cut, without those that cannot be.
pub fn all_cut<'a>(
    recordings: &'a [Recording],
    detector: &Detector,
    choose_multiplier: bool,
    gravity: f64,
) -> Vec<(&'a Recording, Segmentation)> {
    let cut = |recording: &'a Recording| {
        let choice = calib::methods::cut(recording, detector, choose_multiplier, gravity).ok()?;
        Some((recording, choice.segmentation))
    };
    recordings.iter().filter_map(cut).collect()
}

fn at(all: &Option<Misfits>, of: fn(&Misfits) -> &Vec<Misfit>, index: usize) -> Option<f64> {
    let all = of(all.as_ref()?);
    all.iter().find(|m| m.index == index).map(|m| m.value)
}

fn up(rest: &StaticInterval, triad: Option<&Triad>) -> Option<[f64; 3]> {
    let mean = rest.accelerometer?.mean;
    let force = triad.map_or(mean, |triad| triad.base().correct(&mean));
    let up: [f64; 3] = (force / force.norm()).into();
    up.iter().all(|c| c.is_finite()).then_some(up)
}

fn std(rest: &StaticInterval, triad: Option<&Triad>) -> Option<f64> {
    let scale = triad.map_or(1.0, |triad| triad.base().scale());
    Some(1e3 * scale * rest.accelerometer.as_ref()?.white_of_mean())
}

/// The largest rate in a turn, °/s.
fn largest_rate(recording: &Recording, turn: &Turn, triad: Option<&Triad>) -> Option<f64> {
    let base = triad.map(Triad::base);
    let values = recording
        .gyroscope
        .as_ref()?
        .values
        .get(turn.samples.clone())?;
    let rates = values.iter().map(|w| match &base {
        Some(base) => base.correct(w).norm(),
        None => w.norm(),
    });
    let largest = rates.fold(0.0, f64::max);
    (largest > 0.0).then(|| largest.to_degrees())
}

/// The calibration with the biases that hold in one of its recordings.
fn with_own_bias(calibration: &Calibration, recording: &str) -> Calibration {
    let mut own = calibration.clone();
    for triad in [&mut own.accelerometer, &mut own.gyroscope] {
        let Some(triad) = triad else { continue };
        if let Some(own) = triad.bias_in(recording) {
            triad.bias = own.bias;
        }
    }
    own
}

/// Returns true if the readings are in SI units, judged by scale factors near one.
pub fn in_si(calibration: &Calibration) -> bool {
    let near_one = |triad: &Triad| (0..3).all(|k| (0.5..2.0).contains(&triad.t[k][k].abs()));
    [&calibration.accelerometer, &calibration.gyroscope]
        .into_iter()
        .flatten()
        .all(near_one)
}

/// Names without folders and endings; where two are the same with the folder before them, and if these are too with numbers.
pub fn short_names(names: &[&str]) -> Vec<String> {
    let stems: Vec<String> = names.iter().map(|name| ending(name, 1)).collect();
    let mut all: Vec<String> = Vec::new();
    for (name, stem) in names.iter().zip(&stems) {
        let is_alone = stems.iter().filter(|other| *other == stem).count() < 2;
        let short = match is_alone {
            true => stem.clone(),
            false => ending(name, 2),
        };
        let numbered = (2..).map(|k| format!("{short} ({k})"));
        let free = std::iter::once(short.clone())
            .chain(numbered)
            .find(|n| !all.contains(n));
        all.push(free.unwrap_or(short));
    }
    all
}

/// The last parts of a path without the ending of the file, in letters that fit into a table.
fn ending(name: &str, parts: usize) -> String {
    let path = name.trim_end_matches(['/', '\\']);
    let folders: Vec<&str> = path
        .split(['/', '\\'])
        .filter(|part| !part.is_empty())
        .collect();
    let Some((last, before)) = folders.split_last() else {
        return cut(&show::name(name));
    };
    // A recording of several in a file has its number behind the ending.
    let (file, number) = last
        .split_once('#')
        .map_or((*last, ""), |(file, n)| (file, n));
    let plain = file.strip_suffix(".gz").unwrap_or(file);
    let stem = plain.rsplit_once('.').map_or(plain, |(stem, _)| stem);
    let stem = if stem.is_empty() { file } else { stem };
    let number = if number.is_empty() {
        String::new()
    } else {
        format!("#{number}")
    };
    let before = before.iter().rev().take(parts - 1).rev();
    let folders: String = before.map(|part| cut(&show::name(part)) + "/").collect();
    folders + &cut(&show::name(stem)) + &number
}

/// At most [`LETTERS`] of a name.
fn cut(name: &str) -> String {
    let letters: Vec<char> = name.chars().collect();
    if letters.len() <= LETTERS {
        return name.to_owned();
    }
    let (head, tail) = (
        &letters[..LETTERS / 2],
        &letters[letters.len() - LETTERS / 2 + 1..],
    );
    head.iter().chain(['…'].iter()).chain(tail).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn recordings_of_one_name_are_told_apart() {
        let names = short_names(&[
            "a/run.csv",
            "b/run.csv",
            "session/",
            "a_very_long_name_of_a_recording.csv",
        ]);
        assert_eq!(names, ["a/run", "b/run", "session", "a_very_lo…ecording"]);
        assert_eq!(short_names(&["run.csv", "run.csv"]), ["run", "run (2)"]);
        assert_eq!(short_names(&["r.csv#1", "r.csv#2"]), ["r#1", "r#2"]);
    }
}
