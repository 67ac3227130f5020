//! The one recording that is asked for, of a file in which the clock begins again.

use super::options::{ReadOptions, Role};
use super::samples::Backwards;
use crate::Error;
use crate::clock::restarts::{Session, sessions};
use crate::clock::{digits_of_the_day, wraps};
use crate::rows::table::Table;
use crate::rows::{refuse_lone_header, sort};
use crate::shown::figure;
use crate::source::place::{at_column, at_line, in_file};
use findings::{Finding, Findings, Kind};

findings::tuning! {
    /// A session of fewer rows is no recording: a device that was switched on twice.
    FEWEST: usize = 200;
}

/// Leaves one recording in `tables`, its samples in order and each stamp once. What the name of the recording gets, where
/// the file holds several.
///
/// # Errors
/// [`Error::Parts`] where there are several and none was asked for; time that goes back otherwise.
pub(crate) fn take_one(
    name: &str,
    tables: &mut [Table],
    options: &ReadOptions,
    warnings: &mut Findings,
) -> Result<String, Error> {
    if options.rate.is_some() {
        refuse_part(name, options)?;
        return Ok(String::new());
    }
    if options.time_unit.is_none() {
        digits_of_the_day::count_on(tables);
    }
    for table in &mut *tables {
        match options.sort_time {
            true => sort::count_on(table),
            false => wraps::count_on(table),
        }
    }
    let taken = only_part(name, tables, options, warnings)?;
    if options.sort_time {
        sort::by_time(tables);
        return Ok(taken);
    }
    for table in tables {
        let origin = table.clock.origin;
        let time_first = time_is_first(table);
        let name = &table.name;
        for samples in [&mut table.accel, &mut table.gyro, &mut table.magnetometer] {
            *samples = std::mem::take(samples)
                .in_order()
                .map_err(|back| backwards(name, origin, time_first, back))?;
        }
        keep_ascending(&mut table.temperature_t, &mut table.temperature);
    }
    Ok(taken)
}

/// Refuses a second recording of a file that holds one.
///
/// # Errors
/// [`Error::Usage`].
pub(crate) fn refuse_part(name: &str, options: &ReadOptions) -> Result<(), Error> {
    match options.part {
        None | Some(1) => Ok(()),
        Some(part) => Err(Error::usage(
            Finding::of(Kind::PART_MISSING)
                .in_file(name)
                .count("part", part),
        )),
    }
}

/// Leaves the lines of one session in `tables`.
fn only_part(
    name: &str,
    tables: &mut [Table],
    options: &ReadOptions,
    warnings: &mut Findings,
) -> Result<String, Error> {
    let found: Vec<Vec<Session>> = tables.iter().map(sessions).collect();
    let count = |of: &Vec<Session>| of.len().max(1);
    let most = found.iter().map(count).max().unwrap_or(1);
    if most == 1 {
        // Neither the stamps nor a habit of the logger say why a header comes again.
        for table in &*tables {
            refuse_lone_header(&table.name, table.header_line, &table.headers)?;
        }
        refuse_part(name, options)?;
        return Ok(String::new());
    }
    let with_sensor = || {
        tables
            .iter()
            .zip(&found)
            .filter(|(table, _)| table.has_sensor())
    };
    if let Some((table, _)) = with_sensor().find(|(_, of)| count(of) != most) {
        return Err(in_file(
            &table.name,
            Finding::of(Kind::CLOCKS_RESTART_APART).count("most", most),
        ));
    }
    let Some((first, sessions)) = with_sensor().next() else {
        return Ok(String::new());
    };
    let is_long = |at: &usize| sessions[*at].rows >= FEWEST.get();
    let mut long: Vec<usize> = (0..most).filter(is_long).collect();
    if long.is_empty() {
        long = (0..most).collect();
    }
    for session in (0..most)
        .filter(|at| !long.contains(at))
        .map(|at| &sessions[at])
    {
        warnings.push(
            Finding::of(Kind::SESSION_LEFT_OUT)
                .in_recording(&first.name)
                .count("line", session.first as usize)
                .count("rows", session.rows),
        );
    }
    let part = match (options.part, &long[..]) {
        (None, [_]) => 1,
        (Some(part), _) if (1..=long.len()).contains(&part) => part,
        (given, _) => return Err(several(first, sessions, &long, given)),
    };
    let wanted = long[part - 1];
    for (table, sessions) in tables.iter_mut().zip(&found) {
        if let Some(session) = sessions.get(wanted) {
            let lines = session.first..=session.last;
            table.keep_lines(|line| lines.contains(&line));
            table.clock.wraps.retain(|line| lines.contains(line));
        }
    }
    Ok(match long.len() {
        1 => String::new(),
        _ => format!("#{part}"),
    })
}

/// Builds the error that one of several recordings has to be chosen.
fn several(table: &Table, sessions: &[Session], long: &[usize], given: Option<usize>) -> Error {
    let rows: Vec<String> = long
        .iter()
        .map(|&at| sessions[at].rows.to_string())
        .collect();
    let again = &sessions[long.get(1).copied().unwrap_or(0)];
    let before = long.first().map_or(again, |&at| &sessions[at]);
    // Dates are counted in nanoseconds.
    let shown = |stamp: f64| match table.clock.dates {
        true => figure((stamp / 1e3).round() / 1e6),
        false => figure(stamp),
    };
    let found = Finding::of(Kind::PART_OPEN)
        .in_file(&table.name)
        .at_line(again.first)
        .detail("from", shown(before.to))
        .detail("to", shown(again.from))
        .count("count", long.len())
        .detail("rows", rows.join(" and "));
    let found = match given {
        Some(part) => found.count("part", part),
        None => found,
    };
    Error::Parts {
        finding: found.into(),
        count: long.len(),
    }
}

/// Returns true if a row begins with its stamp; otherwise messages give only the line.
fn time_is_first(table: &Table) -> bool {
    let mut roles = table.roles.iter();
    let time = roles.find(|(role, _)| *role == Role::Time);
    time.is_some_and(|(_, column)| column == "1" || table.names.first() == Some(column))
}

fn backwards(name: &str, origin: Option<i64>, time_first: bool, back: Backwards) -> Error {
    let Backwards { line, last, t } = back;
    let found = Finding::of(Kind::TIME_GOES_BACK)
        .detail("from", figure(last))
        .detail("to", figure(t));
    let found = match origin {
        None | Some(0) => found,
        Some(origin) => found.detail("origin", origin.to_string()),
    };
    match time_first {
        true => at_column(name, line, 1, found),
        false => at_line(name, line, found),
    }
}

/// Leaves out the readings that are not later than all before them.
fn keep_ascending(t: &mut Vec<f64>, values: &mut Vec<f64>) {
    if t.windows(2).all(|pair| pair[0] < pair[1]) {
        return;
    }
    let mut kept: (Vec<f64>, Vec<f64>) = Default::default();
    for (t, value) in t.iter().zip(values.iter()) {
        if kept.0.last().is_none_or(|last| t > last) {
            kept.0.push(*t);
            kept.1.push(*value);
        }
    }
    (*t, *values) = kept;
}

#[cfg(test)]
mod tests {
    use crate::{Error, ReadOptions, Recording};

    /// A row with this stamp.
    fn row(stamp: &str, k: usize) -> String {
        let (s, c) = (k as f64 * 0.02).sin_cos();
        let z = 0.1 * (k as f64 * 0.7).sin();
        let force = format!("{:.4},{:.4},{z:.4}", 9.8 * c, 9.8 * s);
        let rate = format!("{:.4},{:.4},{:.4}", 0.01 * s, 0.01 * c, 2.0 + 0.01 * z);
        format!("{stamp},{force},{rate}\n")
    }

    /// A table of these milliseconds.
    fn text(name: &str, stamps: impl IntoIterator<Item = u64>) -> String {
        let rows = stamps.into_iter().enumerate();
        let rows: String = rows.map(|(k, t)| row(&t.to_string(), k)).collect();
        format!("{name},ax,ay,az,gx,gy,gz\n{rows}")
    }

    fn boots(lengths: &[u64]) -> String {
        text(
            "millis",
            lengths
                .iter()
                .flat_map(|length| (0..*length).map(|k| 20 * k)),
        )
    }

    fn read(text: &str, options: &ReadOptions) -> Result<Recording, Error> {
        Recording::from_bytes("r.csv", text.as_bytes(), options)
    }

    fn part(part: usize) -> ReadOptions {
        ReadOptions {
            part: Some(part),
            ..ReadOptions::default()
        }
    }

    #[test]
    fn a_counter_that_begins_again_makes_two_recordings() {
        let text = boots(&[500, 700]);
        let Err(Error::Parts { finding, count }) = read(&text, &ReadOptions::default()) else {
            panic!("two recordings read as one");
        };
        let message = finding.text(findings::Front::CommandLine);
        assert_eq!(count, 2);
        assert!(
            message.starts_with("r.csv:502: the clock begins again"),
            "{message}"
        );
        assert!(
            message.contains("--part 1") && !message.contains("--sort-time"),
            "{message}"
        );
        for (k, rows) in [(1, 500), (2, 700)] {
            let one = read(&text, &part(k)).unwrap();
            assert_eq!(
                (one.name.as_str(), one.accelerometer.unwrap().len()),
                (format!("r.csv#{k}").as_str(), rows)
            );
        }
        assert!(matches!(read(&text, &part(3)), Err(Error::Parts { .. })));
        let sorted = ReadOptions {
            sort_time: true,
            ..ReadOptions::default()
        };
        assert!(matches!(read(&text, &sorted), Err(Error::Parts { .. })));
    }

    #[test]
    fn all_recordings_of_a_file_are_read_with_names_of_their_own() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("log.csv");
        std::fs::write(&path, boots(&[500, 700])).unwrap();
        let all = Recording::read_all(&path, &ReadOptions::default()).unwrap();
        let ends: Vec<bool> = ["log.csv#1", "log.csv#2"]
            .iter()
            .zip(&all)
            .map(|(end, r)| r.name.ends_with(end))
            .collect();
        assert_eq!(ends, [true, true]);
        assert!(
            all[0].warnings.texts(findings::Front::CommandLine)[0].contains("read as"),
            "{:?}",
            all[0].warnings
        );
    }

    #[test]
    fn a_boot_of_a_few_rows_is_left_out() {
        let one = read(&boots(&[30, 700]), &ReadOptions::default()).unwrap();
        assert_eq!(one.accelerometer.unwrap().len(), 700);
        assert!(
            one.warnings.texts(findings::Front::CommandLine)[0]
                .contains("after 30 rows: these are left out"),
            "{:?}",
            one.warnings
        );
    }

    #[test]
    fn a_counter_that_wraps_goes_on_and_then_begins_again() {
        let wraps = (0..600).map(|k| (60_000 + 20 * k) % 65_536);
        let text = text("millis", wraps.chain((0..500).map(|k| 20 * k)));
        let first = read(&text, &part(1)).unwrap().accelerometer.unwrap();
        assert!(
            first
                .t
                .windows(2)
                .all(|w| (w[1] - w[0] - 0.02).abs() < 1e-9)
        );
        assert_eq!(first.len(), 600);
    }

    #[test]
    fn what_the_user_makes_of_the_time_is_seconds() {
        let cycles = text(
            "cycles",
            (0..400u64).map(|k| (4_200_000_000 + k * 3_360_000) % (1 << 32)),
        );
        let options = |columns: &str| ReadOptions {
            columns: columns.parse().unwrap(),
            ..ReadOptions::default()
        };
        let t = |text: &str, columns| {
            read(text, &options(columns)).map(|read| read.accelerometer.unwrap().t)
        };
        let found = t(&cycles, "t=cycles/168e6").unwrap();
        assert!(found.windows(2).all(|w| (w[1] - w[0] - 0.02).abs() < 1e-9));
        let seconds = boots(&[400]);
        assert!((t(&seconds, "t=millis*0.002").unwrap()[1] - 0.04).abs() < 1e-12);
        for (columns, words) in [
            ("t=cycles/168", "in which the rate would be"),
            ("t=-cycles", "a positive one expected"),
        ] {
            let error = t(&cycles, columns).unwrap_err().to_string();
            assert!(error.contains(words), "{error}");
        }
    }

    #[test]
    fn stamps_of_each_sensor_are_read_by_name_or_by_role() {
        let table = |names: [&str; 2]| {
            let row = |k: usize| {
                let cells = row("", k);
                let axes: Vec<&str> = cells.trim().split(',').collect();
                let t = 100.0 + 0.02 * k as f64;
                format!(
                    "{t:.3},{},{:.3},{}\n",
                    axes[1..4].join(","),
                    t - 0.007,
                    axes[4..].join(",")
                )
            };
            let header = format!("{},ax,ay,az,{},gx,gy,gz\n", names[0], names[1]);
            header + &(0..400).map(row).collect::<String>()
        };
        let check = |text: &str, options: &ReadOptions| {
            let read = read(text, options).unwrap();
            let [a, g] = [
                read.accelerometer.unwrap().t[0],
                read.gyroscope.unwrap().t[0],
            ];
            assert!((a - g - 0.007).abs() < 1e-9, "{a} {g}");
        };
        check(&table(["accel_ts", "gyro_ts"]), &ReadOptions::default());
        check(&table(["t_acc", "t_gyr"]), &ReadOptions::default());
        let said = ReadOptions {
            columns: "ta=one,tg=two".parse().unwrap(),
            ..ReadOptions::default()
        };
        check(&table(["one", "two"]), &said);
    }
}
