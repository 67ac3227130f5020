//! Stamps in minutes, in two columns, and without their leading zeros.

use findings::Front;
use stillpoint_recording::ReadOptions;

use crate::session::{Session, is_it, read, read_as, session, table, xyz};

/// A table of the session whose rows begin with a stamp of the time in milliseconds.
fn stamped(header: &str, s: &Session, stamp: impl Fn(u64) -> String) -> String {
    table(&format!("{header},ax,ay,az,gx,gy,gz"), |k| {
        let stamp = stamp((1e3 * s.t[k]).round() as u64);
        format!("{stamp},{},{}", xyz(&s.force[k], 1.0), xyz(&s.rate[k], 1.0))
    })
}

/// The time of day of so many milliseconds after noon, with what separates their part of the second.
fn after_noon(ms: u64, part: &str) -> String {
    let seconds = ms / 1000;
    format!("12:{:02}:{:02}{part}", seconds / 60, seconds % 60)
}

#[track_caller]
fn refused(text: &str) -> String {
    read_as(text, &ReadOptions::default())
        .unwrap_err()
        .text(Front::CommandLine)
}

#[test]
fn minutes_are_a_unit_of_time_in_whatever_words() {
    let s = session();
    for header in [
        "time (min)",
        "minutes",
        "time_min",
        "Time in minutes",
        "elapsed minutes",
        "Zeit (Minuten)",
        "时间（分钟）",
    ] {
        let text = stamped(header, &s, |ms| format!("{:.9}", ms as f64 / 60e3));
        is_it(&read(&text), &s, 1e-4);
    }
    // In a unit that nobody knows it may be anything, though the rate is one of a sensor.
    let text = stamped("time (jiffies)", &s, |ms| format!("{}", ms / 10));
    assert!(refused(&text).contains("it does not know the one in `time (jiffies)`"));
    // The minutes of a clock are none.
    let text = stamped("hours,minutes", &s, |ms| format!("12,{}", ms / 60_000));
    assert!(refused(&text).contains("no column with the time"));
}

#[test]
fn seconds_and_their_part_in_another_column_are_one_stamp() {
    let s = session();
    let unix = |ms: u64, per: u64| {
        let (seconds, part) = (1_715_000_000 + (ms + 123) / 1000, (ms + 123) % 1000);
        format!("{seconds},{}", part * per)
    };
    for (header, per) in [
        ("unix,ms", 1),
        ("timestamp,millis", 1),
        ("unixtime,milliseconds", 1),
        ("sec,usec", 1000),
        ("header.stamp.sec,header.stamp.nanosec", 1_000_000),
    ] {
        let found = read(&stamped(header, &s, |ms| unix(ms, per)));
        is_it(&found, &s, 1e-4);
        assert_eq!(found.description.format, "split_stamp");
    }
    let clock = |ms: u64| format!("{},{}", after_noon(ms, ""), ms % 1000);
    is_it(&read(&stamped("time,ms", &s, clock)), &s, 1e-4);
}

#[test]
fn a_column_of_milliseconds_that_goes_on_is_a_clock_of_its_own() {
    let s = session();
    let both = |ms: u64| format!("{},{ms}", 1_715_000_000 + ms / 1000);
    let found = read(&stamped("unix,ms", &s, both));
    assert_ne!(found.description.format, "split_stamp");
    // What begins as a part and goes on past the second is refused at its line.
    let later = |ms: u64| {
        let part = if ms < 24_000 { ms % 1000 } else { ms };
        format!("{},{part}", 1_715_000_000 + ms / 1000)
    };
    let words = refused(&stamped("unix,ms", &s, later));
    assert!(words.contains("1715000024 and 24000"), "{words}");
}

#[test]
fn milliseconds_without_their_zeros_are_counts_if_they_go_on_as_counts_do() {
    let s = session();
    let part = |ms: u64| (ms + 7) % 1000;
    let at = |ms: u64| ms + 7;
    let clock = |ms: u64| after_noon(at(ms), &format!(".{}", part(ms)));
    let colons = |ms: u64| after_noon(at(ms), &format!(":{}", part(ms)));
    let dated = |ms: u64| format!("2026-05-01 {}", clock(ms));
    let unix = |ms: u64| format!("{}.{}", 1_715_000_000 + at(ms) / 1000, part(ms));
    for text in [
        stamped("time", &s, clock),
        stamped("time", &s, colons),
        stamped("timestamp", &s, dated),
        stamped("t", &s, unix),
    ] {
        let found = read(&text);
        is_it(&found, &s, 1e-4);
        assert_eq!(found.description.format, "unpadded");
    }
    // Decimals whose last zeros are left out are decimals.
    let decimals = |ms: u64| format!("{}", at(ms) as f64 / 1e3);
    let found = read(&stamped("t", &s, decimals));
    is_it(&found, &s, 1e-4);
    assert_ne!(found.description.format, "unpadded");
}

#[test]
fn parts_that_may_be_of_anything_are_refused() {
    let s = session();
    // Hundredths without zeros, which are no milliseconds.
    let hundredths = |ms: u64| after_noon(ms, &format!(".{}", ms % 1000 / 10));
    assert!(refused(&stamped("time", &s, hundredths)).contains("time goes back"));
}

#[test]
fn the_format_of_dates_that_is_offered_reads_them() {
    let s = session();
    let of_day = |ms: u64| (after_noon(ms, ""), ms % 1000);
    type Stamp<'a> = &'a dyn Fn(u64) -> String;
    let comma: Stamp<'_> = &|ms| {
        let (time, part) = of_day(ms);
        format!("\"27.10.2024 {time},{part:03}\"")
    };
    let noon: Stamp<'_> = &|ms| {
        let (time, part) = of_day(ms);
        format!("03/13/2025 {time}.{part:03} PM")
    };
    for (stamp, pattern) in [
        (comma, "%d.%m.%Y %H:%M:%S,%f"),
        (noon, "%m/%d/%Y %I:%M:%S%.f %p"),
    ] {
        let text = stamped("time", &s, stamp);
        let said = refused(&text);
        assert!(said.contains(pattern), "{said}");
        let options = ReadOptions {
            time_format: Some(pattern.to_owned()),
            ..ReadOptions::default()
        };
        is_it(&read_as(&text, &options).unwrap(), &s, 1e-4);
    }
}

#[test]
fn a_temperature_called_t_in_capitals_is_no_time() {
    let s = session();
    let both = |ms: u64| format!("{:.2},{ms}", 24.0 + 1e-6 * ms as f64);
    let found = read(&stamped("T,t", &s, both));
    is_it(&found, &s, 1e-4);
    let turned = |ms: u64| format!("{ms},{:.2}", 24.0 + 1e-6 * ms as f64);
    is_it(&read(&stamped("t,T", &s, turned)), &s, 1e-4);
}

#[test]
fn a_rate_out_of_range_has_few_digits() {
    let s = session();
    let said = refused(&stamped("time (ms)", &s, |ms| {
        format!("{:.6}", ms as f64 / 2e4)
    }));
    assert!(said.contains("would be 1000000 Hz"), "{said}");
}

#[test]
fn minutes_and_seconds_of_a_spreadsheet_are_a_time() {
    let s = session();
    let short = |ms: u64| format!("59:{:06.3}", ms as f64 / 1e3);
    let text = stamped("Time", &s, |ms| match ms {
        0..60_000 => short(ms),
        _ => short(ms - 60_000).replace("59:", "00:"),
    });
    is_it(&read(&text), &s, 1e-4);
}

#[test]
fn a_part_of_the_second_that_goes_on_or_is_there_twice_is_told() {
    let s = session();
    // Half a minute before the minute ends.
    let clock = |ms: u64| ((ms + 47_000) / 60_000, (ms + 47_000) % 60_000);
    let goes_on = |ms: u64| {
        let (minute, rest) = clock(ms);
        format!("{minute},{},{}", rest / 1000, ms + 4567)
    };
    let twice = |ms: u64| {
        let (minute, rest) = clock(ms);
        format!("{minute},{:.3},{}", rest as f64 / 1e3, rest % 1000)
    };
    let letters = |ms: u64| {
        let (minute, rest) = clock(ms);
        format!("12,{minute},{:.3}", rest as f64 / 1e3)
    };
    for text in [
        stamped("min,sec,millis", &s, goes_on),
        stamped("min,sec,ms", &s, twice),
        stamped("h,m,s", &s, letters),
    ] {
        let found = read(&text);
        is_it(&found, &s, 1e-4);
        assert_eq!(found.description.format, "clock_columns");
    }
    // Whole seconds beside a count of milliseconds or microseconds.
    for (header, per) in [("sec,ms", 1), ("sec,micros", 1000)] {
        let both = |ms: u64| format!("{},{}", ms / 1000, ms * per);
        is_it(&read(&stamped(header, &s, both)), &s, 1e-4);
    }
    let both = |ms: u64| format!("{},{}", after_noon(ms, ""), ms + 4567);
    is_it(&read(&stamped("time,millis", &s, both)), &s, 1e-4);
}

#[test]
fn whole_seconds_are_no_milliseconds() {
    let s = session();
    let rate = |text: &str| {
        let found = read(text).accelerometer.unwrap();
        found.usual_step().unwrap().recip().round()
    };
    for header in ["time", "sec"] {
        assert_eq!(
            rate(&stamped(header, &s, |ms| format!("{}", ms / 1000 + 77))),
            50.0
        );
    }
}

#[test]
fn a_counter_with_a_sign_goes_on_behind_its_end() {
    let s = session();
    let wrapped = |ms: u64| {
        let micros = (ms * 1000 + (1 << 31) - 9_000_000) as u32;
        format!("{}", micros as i32)
    };
    is_it(&read(&stamped("us", &s, wrapped)), &s, 1e-4);
}

#[test]
fn a_unit_with_a_factor_is_refused_with_what_makes_seconds_of_it() {
    let s = session();
    let text = stamped("time (10 ms)", &s, |ms| format!("{}", ms / 10 + 54_321));
    let words = refused(&text);
    assert!(words.contains("t=time (10 ms)/100"), "{words}");
    let options = ReadOptions {
        columns: "t=time (10 ms)/100".parse().unwrap(),
        ..ReadOptions::default()
    };
    is_it(&read_as(&text, &options).unwrap(), &s, 1e-4);
    is_it(
        &read(&stamped("Time (GPS seconds)", &s, |ms| {
            format!("{}", ms as f64 / 1e3)
        })),
        &s,
        1e-4,
    );
}
