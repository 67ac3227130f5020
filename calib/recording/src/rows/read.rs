//! A text into its table.

use findings::{Finding, Kind, OptionName, Remedy};
use sensor::Sensor;

use crate::Error;
use crate::clock::Clock;
use crate::devices;
use crate::header::affine::Affine;
use crate::header::questions::said_rate::said_rate;
use crate::header::sniff::Start;
use crate::header::suggest::entry;
use crate::header::unnamed::with_temperature;
use crate::recording::options::{ReadOptions, Role};
use crate::recording::{memory, with_gravity};
use crate::rows::Rows;
use crate::rows::table::Table;
use crate::shown::shown_list;
use crate::source::Input;
use crate::source::batches::Batches;
use crate::source::on_disk::Unchanged;
use crate::source::place::at_line;
use crate::units::rests;

impl Table {
    /// Reads all of `input`; `only` is the one sensor in it, if that is known, and `origin` the
    /// first stamp of the recording's other file.
    pub fn read(
        mut input: Input,
        only: Option<Sensor>,
        origin: Option<i64>,
        options: &ReadOptions,
    ) -> Result<Self, Error> {
        let start = Start::look(&input.name, &input.head, only, options)?;
        if start.layout.time.is_none() && options.rate.is_none() {
            return Err(no_time(&input, &start));
        }
        let mut table = Self {
            name: input.name.clone(),
            stated: start.layout.stated,
            strange: start.layout.strange.clone(),
            unused: start.layout.unused(),
            unclear: start.unclear.clone(),
            names: start.layout.names.clone(),
            by_names: options.columns.0.is_empty(),
            roles: start.layout.roles(),
            has_time: start.layout.time.is_some(),
            time_affine: start.layout.affine_of(Role::Time),
            plain_time: start
                .layout
                .time
                .and_then(|i| start.layout.names.get(i))
                .is_some_and(|n| n == "t"),
            clock: Clock::new(origin, options),
            warnings: std::mem::take(&mut input.warnings),
            ..Self::default()
        };
        table.warnings.extend(
            start
                .warnings
                .iter()
                .map(|finding| finding.clone().in_recording(&input.name)),
        );
        let unchanged = input.unchanged.take();
        let sensors = [start.layout.accel, start.layout.gyro, start.layout.field];
        let sensors = sensors.iter().flatten().count() as u64;
        if let Some(size) = unchanged.as_ref().map(Unchanged::size) {
            let rows = rows_in(&input.head, size).min(options.max_rows);
            memory::room_to_read(&input.name, rows, sensors)?;
        }
        let batches = Batches::new(input.into_reader(), options.max_bytes);
        Rows::new(&mut table, &start, options).read(batches)?;
        unchanged.map_or(Ok(()), |file| file.check())?;
        devices::choose(&mut table, options)?;
        apply(&mut table, &start.layout.affine);
        if let Some(split) = &start.layout.gravity {
            with_gravity::of_columns(&mut table, split)?;
        }
        if start.undecided {
            table.decide_roles(&start)?;
        } else if start.told_by_norm && rests::at_one_reading(&table.accel.values) {
            let found = Finding::of(Kind::NO_HEADER_NO_FORCE)
                .count("width", start.layout.width)
                .only_remedies([as_taken(&start)]);
            return Err(at_line(&table.name, start.after + 1, found));
        }
        memory::room_to_work(&table.name, table.accel.t.len() + table.gyro.t.len())?;
        Ok(table)
    }

    /// Tells the two sensors of a text without a header apart.
    fn decide_roles(&mut self, start: &Start) -> Result<(), Error> {
        // Of those with a device before the axes nothing is to spare.
        let last = start.layout.width.saturating_sub(1);
        let may_be_slow = start.layout.unread() == 0 || !start.layout.is_read(last);
        if start.layout.width >= 8
            && may_be_slow
            && let Some(slow) = self.slow_column()
        {
            // With a device among the columns they are not those that the line below names.
            if start.layout.width > 8 || !(0..7).all(|column| start.layout.is_read(column)) {
                return Err(self.unknown_columns(start));
            }
            let columns = with_temperature(slow);
            let found = Finding::of(Kind::NO_HEADER_SLOW)
                .count("width", start.layout.width)
                .count("slow", slow)
                .only_remedies([Remedy::such_as(OptionName::Columns, columns)]);
            return Err(at_line(&self.name, start.after + 1, found));
        }
        let triads = [&self.accel.values[..], &self.gyro.values[..]];
        let by_rests = rests::accelerometer(triads);
        let by_norm = start.told_by_norm.then_some(0);
        match by_rests.or(by_norm) {
            Some(0) => {}
            Some(_) => {
                std::mem::swap(&mut self.accel, &mut self.gyro);
                for (role, _) in &mut self.roles {
                    *role = match *role {
                        Role::Accel(axis) => Role::Gyro(axis),
                        Role::Gyro(axis) => Role::Accel(axis),
                        other => other,
                    };
                }
            }
            None => return Err(self.unknown_columns(start)),
        }
        self.roles
            .sort_by_key(|(_, column)| column.parse::<usize>().unwrap_or(0));
        let taken: Vec<String> = self
            .roles
            .iter()
            .map(|(role, column)| format!("{}={column}", role.name()))
            .collect();
        let mut told = Finding::of(Kind::COLUMNS_BY_READINGS)
            .in_recording(&self.name)
            .detail("columns", taken.join(","));
        if by_rests.is_some() {
            told = told.detail("turning", "ax, ay, az");
        }
        self.warnings.push(told);
        Ok(())
    }

    /// Builds the error that nothing tells the columns apart.
    fn unknown_columns(&self, start: &Start) -> Error {
        let found = Finding::of(Kind::NO_HEADER_UNDECIDED)
            .count("width", start.layout.width)
            .only_remedies([as_taken(start)]);
        at_line(&self.name, start.after + 1, found)
    }

    /// The column, numbered from 1, of eight without names that is no axis: it keeps within a small part of the range of
    /// those beside it, or far from zero, as a temperature does.
    fn slow_column(&self) -> Option<usize> {
        const SMALL: f64 = 0.02;
        const FAR: f64 = 2.0;
        for (samples, first) in [(&self.accel, 2), (&self.gyro, 5)] {
            let of_axis = |axis: usize| {
                let column = || samples.values.iter().map(move |value| value[axis]);
                let (low, high) = (
                    column().fold(f64::MAX, f64::min),
                    column().fold(f64::MIN, f64::max),
                );
                (high - low, low.abs().min(high.abs()), low * high > 0.0)
            };
            let axes = [0, 1, 2].map(of_axis);
            let largest = axes.iter().map(|(range, ..)| *range).fold(0.0, f64::max);
            let is_slow = |(range, level, one_sided): &(f64, f64, bool)| {
                *range < SMALL * largest || (*one_sided && *level > FAR * range)
            };
            if let Some(axis) = axes.iter().position(is_slow) {
                return Some(first + axis);
            }
        }
        None
    }
}

/// The columns of a text without a header as they were taken, as an example to be checked.
fn as_taken(start: &Start) -> Remedy {
    let layout = &start.layout;
    let time = layout.time.into_iter().map(|at| (Role::Time, at));
    let of = |sensor: Sensor, triad: Option<[usize; 3]>| {
        let columns = triad.into_iter().flatten().enumerate();
        columns.map(move |(axis, at)| (Role::axis(sensor, axis), at))
    };
    let accel = of(Sensor::Accelerometer, layout.accel);
    let gyro = of(Sensor::Gyroscope, layout.gyro);
    let entries: Vec<String> = time
        .chain(accel)
        .chain(gyro)
        .map(|(role, at)| format!("{}={}", role.name(), at + 1))
        .collect();
    Remedy::such_as(OptionName::Columns, entries.join(","))
}

/// Builds the error about a text without stamps, with the columns that may be stamps.
fn no_time(input: &Input, start: &Start) -> Error {
    let names = &start.layout.names;
    let likely = start.layout.times.iter().map(|&at| &names[at]);
    let first = start.layout.times.first();
    let column = first.or(start.rising.as_ref());
    let called = |at: usize| match names.is_empty() {
        true => (at + 1).to_string(),
        false => entry(names, at),
    };
    let column = column.map(|&at| (OptionName::Columns, format!("t={}", called(at))));
    let none = Finding::of(Kind::NO_TIME).in_file(&input.name);
    let none = match said_rate(&input.head) {
        Some(rate) => none
            .number("said", rate, "Hz")
            .only_remedies([Remedy::set_to(OptionName::Rate, rate.to_string())]),
        None => {
            let rate = (OptionName::Rate, "100".to_owned());
            none.only_remedies([Remedy::examples(std::iter::once(rate).chain(column))])
        }
    };
    Error::usage(match first {
        Some(_) => none.detail("likely", shown_list(likely)),
        None => none,
    })
}

/// About how many rows a text of `size` bytes has that begins with `head`. Of one that is compressed fewer.
fn rows_in(head: &[u8], size: u64) -> u64 {
    let lines = memchr::memchr_iter(b'\n', head).count() as u64;
    match lines {
        0 => 0,
        _ => size / (head.len() as u64).div_ceil(lines),
    }
}

/// Makes of the columns what the user asked for.
fn apply(table: &mut Table, affines: &[(Role, Affine)]) {
    for (role, Affine { scale, offset }) in affines {
        let change = |value: &mut f64| *value = scale * *value + offset;
        if let Some((sensor, axis)) = role.reading() {
            let values = table.samples_mut(sensor).values.iter_mut();
            values.for_each(|value| change(&mut value[axis]));
        } else if *role == Role::Temperature {
            table.temperature.iter_mut().for_each(change);
        }
        // Stamps are changed when their wraps are undone.
    }
}
