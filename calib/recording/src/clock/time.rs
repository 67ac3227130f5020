//! From stamps in the file's unit to seconds.

use super::nominal::ticked;
use crate::Error;
use crate::header::affine::Affine;
use crate::header::names::{is_of_ticks, per_second, says_unknown_unit};
use crate::recording::options::{ReadOptions, Role};
use crate::rows::table::Table;
use crate::shown::{figure, shown, significant};
use crate::source::place::in_file;
use crate::units::{CLOCKS, TimeUnit};
use findings::{Finding, Findings, Kind, OptionName, Remedy};

/// Rates that a unit in the file may mean, Hz.
const POSSIBLE: std::ops::RangeInclusive<f64> = 0.2..=60_000.0;

/// Units that clocks of devices count in.
const COUNTED: [TimeUnit; 4] = [
    TimeUnit::Seconds,
    TimeUnit::Milliseconds,
    TimeUnit::Microseconds,
    TimeUnit::Nanoseconds,
];

/// Years from which tenths of microseconds are counted: Windows' and .NET's.
const YEARS_OF_TENTHS: [f64; 2] = [1601.0, 1.0];

/// A mean Gregorian year, s.
const SECONDS_OF_A_YEAR: f64 = 31_556_952.0;

/// Clocks of processors without a unit, per second: that of Apple's `mach_absolute_time`, and the 4.5 MHz of DJI's logs.
const PROCESSORS: [f64; 2] = [24e6, 4.5e6];

/// Rates of most recordings, Hz: of two units the one with such a rate is meant.
const USUAL: std::ops::Range<f64> = 20.0..2000.0;

/// Rates of stamps that are called ticks, Hz.
const TICKED: std::ops::Range<f64> = 5.0..2000.0;

/// Units that people convert stamps to, and no clock counts in.
const LONG: [TimeUnit; 3] = [TimeUnit::Days, TimeUnit::Hours, TimeUnit::Minutes];

findings::tuning! {
    /// A recording of turns is no shorter, s.
    SHORTEST: f64 = 10.0;
}

fn is_usual(unit: &TimeUnit, step: f64) -> bool {
    USUAL.contains(&(unit.per_second() / step))
}

/// True for stamps that would be those of a few seconds of a very fast sensor, and in minutes or hours those of a usual recording.
/// What is called `t` is in seconds.
fn may_be_minutes(table: &Table, step: f64) -> bool {
    let span = |t: &Vec<f64>| Some(t.last()? - t.first()?);
    let spans = [&table.accel.t, &table.gyro.t].into_iter().filter_map(span);
    let is_short = spans.fold(0.0, f64::max) < SHORTEST.get();
    let is_fast = 1.0 / step >= USUAL.end;
    !table.plain_time && is_fast && is_short && LONG.iter().any(|unit| is_usual(unit, step))
}

/// Turns the stamps of every table, on one clock and in one unit, into seconds; returns the stamp at zero, ns.
pub(crate) fn to_seconds(
    tables: &mut [Table],
    options: &ReadOptions,
    warnings: &mut Findings,
) -> Result<i128, Error> {
    let Some(first) = tables.first() else {
        return Ok(0);
    };
    let origin = first.clock.origin.unwrap_or(0);
    let scale = checked(first)?.scale;
    let first = unit(first, options, warnings)?;
    let zero = nanoseconds(origin, scale / first.per_second());
    for table in tables {
        if let Some(line) = table.clock.wraps.first() {
            let count = table.clock.wraps.len();
            warnings.push(
                Finding::of(Kind::COUNTER_WRAPS)
                    .in_recording(&table.name)
                    .count("count", count)
                    .count("line", *line as usize),
            );
        }
        // Each sensor's stamps may have a unit of their own.
        let own = table
            .stated
            .time
            .filter(|_| options.time_unit.is_none() && !table.clock.dates);
        let own = match own {
            None if is_of_another_unit(table, first, origin) => {
                Some(unit(table, options, warnings)?)
            }
            own => own,
        };
        let per_second = own
            .filter(|_| table.time_affine.is_none())
            .unwrap_or(first)
            .per_second();
        let Affine { scale, offset } = checked(table)?;
        let change = |t: f64| match scale {
            1.0 => (t + offset) / per_second,
            _ => (scale * t + offset) / per_second,
        };
        if (scale, offset, per_second) != (1.0, 0.0, 1.0) {
            let columns = table.stamps_mut().into_iter();
            columns.flatten().for_each(|t| *t = change(*t));
        }
    }
    Ok(zero)
}

/// True if the stamps of `table` would be of no sensor in the unit of the first: a file of seconds beside one of milliseconds.
fn is_of_another_unit(table: &Table, first: TimeUnit, origin: i64) -> bool {
    let rate = usual_step(table).map(|step| first.per_second() / step);
    let is_plain = !table.clock.dates && table.time_affine.is_none() && origin == 0;
    is_plain && rate.is_some_and(|rate| !POSSIBLE.contains(&rate))
}

/// An origin as nanoseconds where it is in units of `seconds`; to the last digit for whole nanoseconds and powers of ten of them.
fn nanoseconds(origin: i64, seconds: f64) -> i128 {
    let (times, parts) = (1e9 * seconds, 1e-9 / seconds);
    let is_whole = |value: f64| value >= 1.0 && (value - value.round()).abs() < 1e-9 * value;
    let origin = i128::from(origin);
    if is_whole(times) {
        origin * times.round() as i128
    } else if is_whole(parts) {
        origin / parts.round() as i128
    } else {
        (origin as f64 * times) as i128
    }
}

/// Returns the user's scale and offset for the stamps of a table; the identity if none is given.
fn checked(table: &Table) -> Result<Affine, Error> {
    let same = Affine {
        scale: 1.0,
        offset: 0.0,
    };
    let Some(affine) = table.time_affine else {
        return Ok(same);
    };
    let of = |kind: Kind| Finding::of(kind).in_file(&table.name);
    if table.clock.dates {
        return Err(Error::usage(of(Kind::EXPRESSION_OF_DATES)));
    }
    if affine.scale <= 0.0 {
        let backwards = of(Kind::EXPRESSION_BACKWARDS);
        return Err(Error::usage(
            backwards.detail("factor", figure(affine.scale)),
        ));
    }
    Ok(affine)
}

/// The unit of stamps that the user has made of a column: seconds, unless it is given.
fn of_expression(table: &Table, options: &ReadOptions, scale: f64) -> Result<TimeUnit, Error> {
    let unit = options.time_unit.unwrap_or(TimeUnit::Seconds);
    let rate = usual_step(table).map(|step| unit.per_second() / (scale * step));
    match rate.filter(|rate| scale > 0.0 && !POSSIBLE.contains(rate)) {
        None => Ok(unit),
        Some(rate) => Err(Error::usage(
            Finding::of(Kind::EXPRESSION_UNIT)
                .in_file(&table.name)
                .detail("unit", unit.name())
                .detail("rate", significant(rate, 6)),
        )),
    }
}

/// The unit that was given, or stated, or follows from an epoch or from the rate.
fn unit(table: &Table, options: &ReadOptions, warnings: &mut Findings) -> Result<TimeUnit, Error> {
    if table.clock.dates {
        return Ok(TimeUnit::Nanoseconds);
    }
    if let Some(affine) = table.time_affine {
        return of_expression(table, options, affine.scale);
    }
    if let Some(unit) = options.time_unit {
        return Ok(unit);
    }
    let step = usual_step(table);
    if let Some(unit) = table.stated.time {
        return possible_as_stated(table, unit, step);
    }
    refuse_unknown(table)?;
    let Some(step) = step else {
        return Ok(TimeUnit::Seconds);
    };
    // A counter of microseconds looks like seconds of this century after half an hour: its rate tells.
    let of_epoch = table.clock.origin.and_then(of_epoch);
    if let Some(unit) = of_epoch.filter(|unit| is_plausible(*unit, step)) {
        if unit != TimeUnit::Seconds {
            let year = year_of(table.clock.origin.unwrap_or_default(), unit);
            warnings.push(decided(table, unit).number("year", year, "count"));
        }
        return Ok(unit);
    }
    if step == 1.0 {
        // Whole seconds, which several rows share.
        let rate = rows_per_stamp(table);
        if rate >= SHARED.get() {
            let seconds = decided(table, TimeUnit::Seconds);
            warnings.push(seconds.number("rate", rate.round(), "Hz"));
            return Ok(TimeUnit::Seconds);
        }
        return unit_of_ones(table, warnings);
    }
    unit_by_rate(table, step, warnings)
}

/// Returns true for a unit in which a step makes 1 Hz to 10 kHz.
fn is_plausible(unit: TimeUnit, step: f64) -> bool {
    (1.0..=10_000.0).contains(&(unit.per_second() / step))
}

/// The unit that a table states, unless no sensor has the rate that it makes.
fn possible_as_stated(table: &Table, unit: TimeUnit, step: Option<f64>) -> Result<TimeUnit, Error> {
    let rate = |step: f64| unit.per_second() / step;
    let Some(step) = step.filter(|step| !POSSIBLE.contains(&rate(*step))) else {
        return Ok(unit);
    };
    // Another in which the rate is one of a sensor.
    let usual = |unit: &&TimeUnit| (10.0..=2000.0).contains(&(unit.per_second() / step));
    let mut others = TimeUnit::ALL.iter();
    let other = others.find(usual).unwrap_or(&TimeUnit::Seconds);
    let found = Finding::of(Kind::TIME_UNIT_STATED)
        .detail("unit", unit.name())
        .detail("rate", significant(rate(step), 6))
        .only_remedies([Remedy::such_as(OptionName::TimeUnit, other.name())]);
    Err(in_file(&table.name, found))
}

/// Refuses a time whose name says that it has a unit of its own.
fn refuse_unknown(table: &Table) -> Result<(), Error> {
    let mut columns = table.roles.iter();
    let unknown = |(role, name): &&(Role, String)| *role == Role::Time && says_unknown_unit(name);
    let Some((_, column)) = columns.find(unknown) else {
        return Ok(());
    };
    let found = Finding::of(Kind::TIME_UNIT_OPEN).detail("column", shown(column));
    // Any unit that the option takes would be another.
    let count = per_second(column).map_or_else(|| "100".to_owned(), |count| count.to_string());
    let scaled = Remedy::such_as(OptionName::Columns, format!("t={column}/{count}"));
    Err(in_file(&table.name, found.only_remedies([scaled])))
}

/// The column of time that is called after ticks of a counter.
fn ticks_of(table: &Table) -> Option<&str> {
    let is_ticks = |(role, name): &&(Role, String)| *role == Role::Time && is_of_ticks(name);
    let column = table.roles.iter().find(is_ticks);
    column.map(|(_, name)| name.as_str())
}

/// The one unit in which the rate is that of a sensor.
fn unit_by_rate(table: &Table, step: f64, warnings: &mut Findings) -> Result<TimeUnit, Error> {
    let is_open = may_be_minutes(table, step);
    if is_plausible(TimeUnit::Seconds, step) && !is_open {
        return Ok(TimeUnit::Seconds);
    }
    // Of a packet with one stamp every sample is one.
    let step = step / rows_per_stamp(table);
    match fitting(ticks_of(table).is_some(), step)[..] {
        [unit] if !is_open => {
            let rate = (unit.per_second() / step).round();
            let told = decided(table, unit).number("rate", rate, "Hz");
            let ticked = ticked(&table.longer().t).filter(|_| unit == TimeUnit::Milliseconds);
            warnings.push(match ticked {
                Some(rate) => told.number("rate_in_ticks", rate, "Hz"),
                None => told,
            });
            Ok(unit)
        }
        // Seconds by contract, unless no sensor has that rate.
        [] if table.plain_time && POSSIBLE.contains(&(1.0 / step)) => Ok(TimeUnit::Seconds),
        _ => Err(rate_is_open(table, step)),
    }
}

/// The units in which a step makes a rate that may be; of a counter of ticks, any rate may.
fn fitting(is_of_ticks: bool, step: f64) -> Vec<TimeUnit> {
    let within = |rates: std::ops::Range<f64>| {
        // Nobody counts ticks of a nanosecond: those of a processor's clock would be taken for such.
        let fits = |unit: &TimeUnit| {
            let may_be = !is_of_ticks || *unit != TimeUnit::Nanoseconds;
            may_be && rates.contains(&(unit.per_second() / step))
        };
        COUNTED.into_iter().filter(fits).collect::<Vec<_>>()
    };
    // The rate of a counter is anything: one that makes an unusual rate has another.
    let possible = if is_of_ticks { TICKED } else { 1.0..10_000.0 };
    let mut fitted = within(possible);
    if fitted.len() > 1 {
        fitted = within(USUAL);
    }
    // A counter that is called after its ticks may count those of Windows.
    let tenths = TimeUnit::TenthMicroseconds;
    let is_slow = |unit: &TimeUnit| unit.per_second() / step < USUAL.start;
    if is_of_ticks && fitted.iter().all(is_slow) && is_usual(&tenths, step) {
        fitted = vec![tenths];
    }
    fitted
}

/// The refusal of stamps whose step no unit or several explain, with what they may be.
fn rate_is_open(table: &Table, step: f64) -> Error {
    let found = Finding::of(Kind::TIME_UNIT_OPEN).detail("step", significant(step, 6));
    if let Some(column) = ticks_of(table) {
        let scaled = Remedy::such_as(OptionName::Columns, format!("t={column}/32768"));
        return in_file(&table.name, found.only_remedies([scaled]));
    }
    // Days since 1900, or since the year 0, or the part of a day.
    let samples = [&table.accel, &table.gyro];
    let first = samples.into_iter().find_map(|samples| samples.t.first());
    let is_days =
        first.is_some_and(|first| (1e4..1e6).contains(first) || (0.0..1.0).contains(first));
    let days = Some(TimeUnit::Days).filter(|days| is_days && is_plausible(*days, step));
    let is_time = |(role, _): &&(Role, String)| *role == Role::Time;
    let name = table.roles.iter().find(is_time).map(|(_, name)| name);
    let mut clocks = CLOCKS.into_iter().chain(PROCESSORS);
    let clock = clocks.find(|clock| USUAL.contains(&(clock / step)));
    let counted = clock
        .zip(name)
        .map(|(clock, name)| (OptionName::Columns, format!("t={name}/{clock}")))
        .into_iter();
    let long = LONG.iter().find(|unit| is_usual(unit, step));
    let unit = |unit: TimeUnit| (OptionName::TimeUnit, unit.name().to_owned());
    let tenths = TimeUnit::TenthMicroseconds;
    let remedy = match long.copied().or(days) {
        Some(likely) => Remedy::examples([unit(likely)]),
        // Of several clocks that make a usual rate nobody but the user knows which it is.
        None if is_usual(&tenths, step) => {
            Remedy::examples([unit(tenths)].into_iter().chain(counted))
        }
        None => Remedy::examples(counted.chain([unit(TimeUnit::Milliseconds)])),
    };
    in_file(&table.name, found.only_remedies([remedy]))
}

findings::tuning! {
    /// Rows with one stamp, on average, from which stamps that go up by 1 are seconds: in milliseconds the rate would be that of no
    /// recording by hand.
    SHARED: f64 = 5.0;
}

/// The unit of stamps that go up by 1: milliseconds, seconds by contract, or none where they count the rows.
fn unit_of_ones(table: &Table, warnings: &mut Findings) -> Result<TimeUnit, Error> {
    let t = &table.longer().t;
    let from_the_start = t.first().is_some_and(|first| (0.0..=1.0).contains(first))
        && table.clock.origin.is_none_or(|origin| origin == 0);
    let every_row = t.windows(2).all(|pair| pair[1] - pair[0] == 1.0);
    if !(from_the_start && every_row) {
        let unit = TimeUnit::Milliseconds;
        warnings.push(decided(table, unit).number("rate", unit.per_second(), "Hz"));
        return Ok(unit);
    }
    if table.plain_time {
        warnings.push(Finding::of(Kind::STAMPS_COUNT_ROWS).in_recording(&table.name));
        return Ok(TimeUnit::Seconds);
    }
    Err(in_file(&table.name, Finding::of(Kind::STAMPS_BY_ONE)))
}

fn decided(table: &Table, unit: TimeUnit) -> Finding {
    Finding::of(Kind::TIME_UNIT_TOLD)
        .in_recording(&table.name)
        .detail("unit", unit.name())
}

/// Years in which a recording may have been made.
const YEARS: std::ops::Range<f64> = 2001.0..2100.0;

/// Their seconds since 1970.
pub(crate) const SINCE_1970: std::ops::Range<f64> = 978_307_200.0..4_102_444_800.0;

/// The unit in which `stamp` lies between 2001 and 2100.
fn of_epoch(stamp: i64) -> Option<TimeUnit> {
    let is_one = |unit: &TimeUnit| SINCE_1970.contains(&(stamp as f64 / unit.per_second()));
    let tenths = TimeUnit::TenthMicroseconds;
    let since_1970 = TimeUnit::ALL.into_iter().find(is_one);
    since_1970.or_else(|| year_of_tenths(stamp).map(|_| tenths))
}

/// The year of a stamp in an epoch that it lies in.
fn year_of(stamp: i64, unit: TimeUnit) -> f64 {
    let since_1970 = || 1970.0 + (stamp as f64 / unit.per_second() / SECONDS_OF_A_YEAR).floor();
    let tenths = year_of_tenths(stamp).filter(|_| unit == TimeUnit::TenthMicroseconds);
    tenths.unwrap_or_else(since_1970)
}

/// The year of tenths of microseconds since one of the years that they are counted from.
fn year_of_tenths(stamp: i64) -> Option<f64> {
    let years = stamp as f64 / TimeUnit::TenthMicroseconds.per_second() / SECONDS_OF_A_YEAR;
    let mut possible = YEARS_OF_TENTHS.iter().map(|from| (from + years).floor());
    possible.find(|year| YEARS.contains(year))
}

/// The usual step of the sensor with more samples.
fn usual_step(table: &Table) -> Option<f64> {
    crate::clock::even::usual_step(&table.longer().t)
}

/// Returns the number of samples that share a stamp, on average, of the sensor with more of them.
fn rows_per_stamp(table: &Table) -> f64 {
    let samples = table.longer();
    let stamps = samples.t.len().max(1) as f64;
    1.0 + samples.other_twins().count() as f64 / stamps
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::Recording;

    /// A recording of 1200 samples of 100 Hz that arrive eight at a time, 10 µs apart, in a unit that the file does not say.
    fn in_bursts(per_second: f64) -> Recording {
        let mut text = "t,ax,ay,az,gx,gy,gz\n".to_owned();
        for k in 0..1200_u32 {
            let arrived = 0.01 * f64::from(k / 8 * 8) + 1e-5 * f64::from(k % 8);
            let noise = |seed: u32| f64::from(k * k * seed % 101) * 1e-4;
            let [x, y, z] = [31, 37, 41].map(noise);
            let (stamp, up) = (arrived * per_second, 9.8 + z);
            text += &format!("{stamp:.6},{x},{y},{up},{y},{z},{x}\n");
        }
        Recording::from_bytes("bursts.csv", text.as_bytes(), &Default::default()).unwrap()
    }

    #[test]
    fn epochs_are_told_with_their_year() {
        for (stamp, unit, year) in [
            (1_690_000_000, TimeUnit::Seconds, 2023.0),
            (1_690_000_000_000, TimeUnit::Milliseconds, 2023.0),
            (1_690_000_000_000_000_000, TimeUnit::Nanoseconds, 2023.0),
            // 22 July 2023 of Windows and of .NET.
            (133_344_736_000_000_000, TimeUnit::TenthMicroseconds, 2023.0),
            (638_255_968_000_000_000, TimeUnit::TenthMicroseconds, 2023.0),
        ] {
            assert_eq!(of_epoch(stamp), Some(unit), "{stamp}");
            assert_eq!(year_of(stamp, unit), year, "{stamp}");
        }
        assert_eq!(of_epoch(5_000_000_000), None);
    }

    #[test]
    fn the_unit_of_stamps_in_bursts_is_told_by_the_rate_of_all_samples() {
        for per_second in [1.0, 1e3, 1e6] {
            let stream = in_bursts(per_second).gyroscope.unwrap();
            let rate = stream.usual_step().unwrap().recip();
            assert!((rate - 100.0).abs() < 0.01, "{per_second}: {rate}");
        }
    }
}
