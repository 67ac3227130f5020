//! The variables of a file: which are a sensor's, and their samples.

use super::element::Raw;
use super::loose::Loose;
use super::named_after::quantity;
use super::object_table::TIMETABLE;
use super::objects::Objects;
use super::value::{Value, Variable};
use crate::shown::shown;
use crate::stream::Recorder;
use crate::{Content, Error, Limits, Quantity, Wanted};
use findings::{Finding, Kind};

/// Nanoseconds in a millisecond.
const MILLI: f64 = 1e6;
/// Milliseconds from 1970 that nanoseconds in 64 bits reach.
const LATEST: f64 = 9e12;

/// The variables read so far.
pub(super) struct Variables {
    recorder: Recorder,
    /// Variables that are no sensor's, with what they are.
    others: Vec<String>,
    /// Variables that are a sensor's once the time is known, which is one of them.
    loose: Loose,
}

/// Words in the names of variables that are of neither sensor.
const OTHERS: [&str; 12] = [
    "orient", "position", "angle", "quat", "euler", "rpy", "gps", "lat", "lon", "press", "temp",
    "bias",
];
/// Fewer numbers are no recording.
const SHORT: usize = 150;

/// True for a variable that is not read and may be a sensor's: called like one, or a table of three columns and more.
fn may_be_sensor(name: &str, value: &Value<'_>, class: Option<&str>) -> bool {
    let lower = name.to_lowercase();
    let quantity = quantity(name);
    if quantity == Some(Quantity::MagneticField) || OTHERS.iter().any(|word| lower.contains(word)) {
        return false;
    }
    match value {
        Value::Numbers { dims, real, .. } => {
            let narrow = dims
                .iter()
                .min()
                .is_some_and(|width| (3..=10).contains(width));
            dims.len() == 2 && narrow && real.len() >= SHORT
        }
        Value::Text(_) => false,
        _ => quantity.is_some() || class == Some("timetable"),
    }
}

impl Variables {
    pub fn new(wanted: &Wanted, limits: Limits) -> Self {
        Self {
            recorder: Recorder::new(wanted, limits),
            others: Vec::new(),
            loose: Loose::default(),
        }
    }

    /// Notes why reading ended before the file did.
    pub fn cut(&mut self, why: Finding) {
        self.recorder.content.cut = Some(why);
    }

    /// Takes the samples of a variable; of a structure those of its fields, as if they stood beside each other.
    ///
    /// # Errors
    /// Damage, or more samples than the limit.
    pub fn add(&mut self, variable: &Variable<'_>, objects: Option<&Objects>) -> Result<(), Error> {
        let Variable { name, class, value } = variable;
        self.take(name, class.as_deref(), value, objects)
    }

    fn take(
        &mut self,
        name: &str,
        class: Option<&str>,
        value: &Value<'_>,
        objects: Option<&Objects>,
    ) -> Result<(), Error> {
        if let (Value::Structure(fields), None) = (value, class) {
            return fields
                .iter()
                .try_for_each(|(field, value)| self.take(field, None, value, objects));
        }
        let what = match class {
            Some(class) => format!("object of class {class}"),
            None => value.described(),
        };
        let read = match (value, objects, quantity(name)) {
            (Value::Object(_), Some(objects), Some(quantity)) => {
                self.timetable(name, value, objects, quantity)?
            }
            (Value::Numbers { dims, real, .. }, _, _) => self.matrix(name, dims, *real)?,
            _ => false,
        };
        let kept = match value {
            Value::Numbers { dims, real, .. } if !read => self.loose.keep(name, dims, *real),
            _ => false,
        };
        if !read && !kept && may_be_sensor(name, value, class) {
            self.recorder.content.unclear.push(name.to_owned());
        }
        let unread = class.filter(|class| !read && *class != "timetable");
        if let Some(class) = unread {
            let unread = Finding::of(Kind::VARIABLE_NOT_READ)
                .detail("variable", shown(name))
                .detail("class", shown(class));
            self.recorder.content.warnings.push(unread);
        }
        self.others
            .extend((!read).then(|| format!("{name} ({what})")));
        Ok(())
    }

    /// A timetable with the variables X, Y and Z.
    fn timetable(
        &mut self,
        name: &str,
        value: &Value<'_>,
        objects: &Objects,
        quantity: Quantity,
    ) -> Result<bool, Error> {
        let Some(table) = objects.property(value, TIMETABLE)? else {
            return Ok(false);
        };
        let names: Vec<&str> = table
            .field("varNames")
            .map(Value::cells)
            .unwrap_or_default()
            .iter()
            .map(|name| match name {
                Value::Text(name) => name.as_str(),
                _ => "",
            })
            .collect();
        let data = table.field("data").map(Value::cells).unwrap_or_default();
        let axis = |axis: &str| {
            let at = names
                .iter()
                .position(|name| name.eq_ignore_ascii_case(axis))?;
            Some(data.get(at)?.numbers()?.0)
        };
        let (Some(x), Some(y), Some(z)) = (axis("X"), axis("Y"), axis("Z")) else {
            return Ok(false);
        };
        let times = table.field("rowTimes");
        let times = times.map(|times| Stamps::values(times, objects));
        let times = times.transpose()?.flatten();
        let Some(stamps) = times.as_ref().and_then(Stamps::of) else {
            let found = Finding::of(Kind::ROW_TIMES_UNKNOWN);
            return Err(Error::refused(found.detail("variable", shown(name))));
        };
        let stream = match quantity {
            // MATLAB Mobile's own unit.
            Quantity::MagneticField => self.recorder.field(name, 0, "µT"),
            _ => self.recorder.stream(name, 0, quantity),
        };
        let Some(stream) = stream else {
            return Ok(true);
        };
        let rows = x.len();
        if y.len() != rows || z.len() != rows || stamps.len() != rows {
            let lengths = [rows, y.len(), z.len(), stamps.len()].map(|length| length.to_string());
            let found = Finding::of(Kind::COLUMNS_UNEQUAL).detail("name", shown(name));
            return Err(Error::refused(found.detail("listed", lengths.join(", "))));
        }
        self.recorder.reserve(stream, rows);
        let first = self.recorder.at(stream).stamps.len();
        let mut whole = 0;
        for row in 0..rows {
            let value = (x.get(row), y.get(row), z.get(row), stamps.get(row));
            if let (Some(x), Some(y), Some(z), Some(stamp)) = value {
                whole += usize::from((stamp - rounded(stamp)).abs() <= DAYS_IN_DOUBLE);
                self.recorder.push(stream, stamp, [x, y, z])?;
            }
        }
        if whole == rows {
            let stamps = self.recorder.at(stream).stamps.iter_mut().skip(first);
            stamps.for_each(|stamp| *stamp = rounded(*stamp));
        }
        Ok(true)
    }

    /// A matrix with the columns, or rows, t, x, y, z of the sensor that it is named after, or t and both sensors.
    fn matrix(&mut self, name: &str, dims: &[usize], numbers: Raw<'_>) -> Result<bool, Error> {
        let [height, width] = *dims else {
            return Ok(false);
        };
        let lies = width > height && matches!(height, 4 | 7);
        let (rows, columns) = if lies {
            (width, height)
        } else {
            (height, width)
        };
        if rows < 2 || numbers.len() != rows.saturating_mul(columns) {
            return Ok(false);
        }
        let sensors: &[(Quantity, usize)] = match (columns, quantity(name)) {
            (4, Some(quantity)) => &[(quantity, 1)],
            (7, _) => &[(Quantity::SpecificForce, 1), (Quantity::AngularRate, 4)],
            _ => return Ok(false),
        };
        let at = |row: usize, column: usize| match lies {
            true => numbers.get(row * columns + column),
            false => numbers.get(column * rows + row),
        };
        let increases = (1..rows).all(|row| at(row - 1, 0) < at(row, 0));
        if !increases {
            return Ok(false);
        }
        for (quantity, first) in sensors {
            let Some(stream) = self.recorder.stream(name, 0, *quantity) else {
                continue;
            };
            self.recorder.at(stream).in_si = false;
            self.recorder.reserve(stream, rows);
            for row in 0..rows {
                let values = (
                    at(row, 0),
                    at(row, *first),
                    at(row, first + 1),
                    at(row, first + 2),
                );
                if let (Some(t), Some(x), Some(y), Some(z)) = values {
                    self.recorder
                        .push(stream, (t * 1e9).round() as i64, [x, y, z])?;
                }
            }
        }
        Ok(true)
    }

    /// Ends the reading and returns the content found.
    ///
    /// # Errors
    /// More samples than the limit.
    pub fn finish(mut self) -> Result<Content, Error> {
        let content = &self.recorder.content;
        if content.streams.is_empty() {
            let loose = std::mem::take(&mut self.loose);
            loose.join(&mut self.recorder)?;
        } else {
            let unread = self.loose.names();
            let unread = unread.filter(|name| may_be_named(name));
            self.recorder.content.unclear.extend(unread);
        }
        if self.recorder.content.streams.is_empty() {
            let unknown = Finding::of(Kind::VARIABLES_UNKNOWN);
            self.recorder.content.warnings.push(unknown);
        }
        self.recorder.content.listed = self.others;
        Ok(self.recorder.finish())
    }
}

/// True for the name of an accelerometer or a gyroscope.
fn may_be_named(name: &str) -> bool {
    matches!(
        quantity(name),
        Some(Quantity::SpecificForce | Quantity::AngularRate)
    )
}

/// Tolerance around a whole millisecond, ns, for dates that were stored as a double of days, as MATLAB Mobile does: half of
/// 2⁻³³ days at today's dates, and rounding.
const DAYS_IN_DOUBLE: i64 = 6_000;

/// A stamp to whole milliseconds, ns.
fn rounded(stamp: i64) -> i64 {
    stamp
        .saturating_add(500_000)
        .div_euclid(1_000_000)
        .saturating_mul(1_000_000)
}

/// Row times: datetimes as milliseconds since 1970 with a correction in the imaginary part, or durations in
/// milliseconds.
struct Stamps<'v> {
    real: Raw<'v>,
    imaginary: Option<Raw<'v>>,
}

impl<'v> Stamps<'v> {
    /// The numbers that these row times consist of.
    fn values<'o>(times: &Value<'_>, objects: &'o Objects) -> Result<Option<Value<'o>>, Error> {
        match objects.property(times, "data")? {
            Some(data) => Ok(Some(data)),
            None => objects.property(times, "millis"),
        }
    }

    fn of(values: &'v Value<'_>) -> Option<Self> {
        let (real, imaginary) = values.numbers()?;
        Some(Self { real, imaginary })
    }

    fn len(&self) -> usize {
        self.real.len()
    }

    /// A stamp, ns. Whole milliseconds are counted apart: a double holds those of this century to 0.2 µs only.
    fn get(&self, row: usize) -> Option<i64> {
        let milliseconds = self.real.get(row)?;
        let correction = self
            .imaginary
            .and_then(|imaginary| imaginary.get(row))
            .unwrap_or(0.0);
        if milliseconds.abs() >= LATEST {
            return None;
        }
        let whole = milliseconds as i64;
        let rest = (milliseconds - whole as f64) * MILLI + correction * MILLI;
        // To the nearest one: `round` is a call into the C library.
        let nearest = (rest + 0.5_f64.copysign(rest)) as i64;
        let stamp = || whole.saturating_mul(1_000_000).saturating_add(nearest);
        rest.is_finite().then(stamp)
    }
}
