//! Section C: time.

use super::*;

/// The usual rows with other stamps.
fn stamped(stamps: impl Iterator<Item = String>) -> String {
    let cells = |(i, stamp): (usize, String)| stamp + &row(0.0, i)[6..];
    file(HEADER, &stamps.enumerate().map(cells).collect::<Vec<_>>())
}

fn stamps(content: &str) -> Vec<f64> {
    read(content, &ReadOptions::default())
        .unwrap()
        .accelerometer
        .unwrap()
        .t
}

#[test]
fn row_61_time_that_goes_back_is_refused_or_sorted() {
    let mut lines = rows(200);
    lines.swap(100, 101);
    let text = file(HEADER, &lines);
    refused(&text, "103:1", &["from 1.01 to 1", "--sort-time"]);
    let sort = ReadOptions {
        sort_time: true,
        ..ReadOptions::default()
    };
    assert_same_samples(&read(&text, &sort).unwrap(), 200);
}

/// `text` with its rows shuffled, and how that is to be read.
fn shuffled(text: &str, seed: u64) -> (String, ReadOptions) {
    let (header, rows) = text.trim_end().split_once('\n').unwrap();
    let mut rows: Vec<String> = rows.lines().map(str::to_owned).collect();
    let mut state = seed;
    for i in (1..rows.len()).rev() {
        // Knuth's MMIX generator.
        state = state
            .wrapping_mul(6_364_136_223_846_793_005)
            .wrapping_add(1_442_695_040_888_963_407);
        rows.swap(i, (state >> 33) as usize % (i + 1));
    }
    let sort = ReadOptions {
        sort_time: true,
        ..ReadOptions::default()
    };
    (file(header, &rows), sort)
}

#[test]
fn row_61_shuffled_rows_are_sorted_to_what_they_were() {
    let with_temperature = |step: f64, origin: u64, count: usize| {
        let cells = |i: usize| {
            let t = origin as f64 + step * i as f64;
            format!("{t:.2}{},{:.2}", &row(0.0, i)[6..], 20.0 + 0.01 * i as f64)
        };
        file(
            &format!("{HEADER},temp"),
            &(0..count).map(cells).collect::<Vec<_>>(),
        )
    };
    // 60 s and 80 s of seconds, 60 s of milliseconds, a day of this century: next to where counters of
    // 16 bits start again, and far from it.
    for (step, origin, count) in [
        (0.01, 0, 6000),
        (0.01, 0, 8000),
        (10.0, 0, 6000),
        (0.25, 1_700_000_000, 6000),
    ] {
        let text = with_temperature(step, origin, count);
        let sorted = read(&text, &ReadOptions::default()).unwrap();
        for seed in 0..5 {
            let (text, sort) = shuffled(&text, seed);
            let read = read(text, &sort).unwrap();
            assert_eq!(read.warnings.len(), sorted.warnings.len());
            assert_eq!(read.accelerometer, sorted.accelerometer);
            assert_eq!(read.gyroscope, sorted.gyroscope);
            let (read, sorted) = (
                read.temperature.unwrap(),
                sorted.temperature.as_ref().unwrap(),
            );
            assert_eq!((read.t, &read.celsius), (sorted.t.clone(), &sorted.celsius));
        }
    }
}

#[test]
fn rows_61_and_70_a_counter_that_wraps_is_counted_on_before_it_is_sorted() {
    let mut stamps: Vec<u64> = (0..20_000).map(|i| (40_000 + 10 * i) % 65_536).collect();
    for i in [100, 2553, 2554, 9000] {
        stamps.swap(i, i + 1);
    }
    let text = stamped(stamps.iter().map(u64::to_string));
    let (_, sort) = shuffled(&text, 0);
    let recording = read(&text, &sort).unwrap();
    assert!(
        recording
            .warnings
            .texts(findings::Front::CommandLine)
            .iter()
            .any(|w| w.contains("counter starts again")),
        "{:?}",
        recording.warnings
    );
    let t = recording.accelerometer.unwrap().t;
    assert!(t.windows(2).all(|w| (w[1] - w[0] - 0.01).abs() < 1e-9));
}

#[test]
fn row_61_rows_repeated_out_of_order_say_nothing_new() {
    let mut lines = rows(200);
    for i in 0..20 {
        lines.insert(150 + 2 * i, row(0.01 * (130 + i) as f64, 130 + i));
    }
    let recording = read(file(HEADER, &lines), &ReadOptions::default()).unwrap();
    assert!(
        recording.warnings.texts(findings::Front::CommandLine)[0]
            .contains("20 rows between lines 152 and 190 repeat")
    );
    assert_same_samples(&recording, 200);
}

#[test]
fn row_62_equal_stamps_are_merged_to_their_mean() {
    let mut lines = rows(200);
    let usual = lines[51].split_once(',').unwrap().1.to_owned();
    lines.insert(51, format!("0.5000,{usual}"));
    let text = file(HEADER, &lines);
    let recording = read(text, &ReadOptions::default()).unwrap();
    assert!(
        recording.warnings.texts(findings::Front::CommandLine)[0].contains("1 row"),
        "{:?}",
        recording.warnings
    );
    let usual = read(file(HEADER, &rows(200)), &ReadOptions::default()).unwrap();
    let (merged, usual) = (
        recording.accelerometer.unwrap(),
        usual.accelerometer.unwrap(),
    );
    assert_eq!(merged.t, usual.t);
    let mean = (usual.values[50].x + usual.values[51].x) / 2.0;
    assert!((merged.values[50].x - mean).abs() < 1e-12);
}

#[test]
fn row_62_equal_stamps_that_differ_by_more_than_noise_are_refused() {
    let mut lines = rows(200);
    lines.insert(51, "0.5000,1,2,3,4,5,6".to_owned());
    let expected = [
        "the stamp of the row before",
        "several devices",
        "--rate 100",
    ];
    refused(file(HEADER, &lines), "53", &expected);
}

#[test]
fn rows_63_and_67_stamps_that_stand_still_are_refused() {
    refused(
        stamped((0..200).map(|_| "5".to_owned())),
        "",
        &["the same", "--rate"],
    );
    let f32_epoch = (0..20_000).map(|i| format!("{}", 1_700_000_000 + i / 12_800 * 128));
    refused(stamped(f32_epoch), "", &["share their stamp", "--rate"]);
}

#[test]
fn row_64_no_time_column_needs_a_rate() {
    let lines: Vec<_> = rows(200).iter().map(|r| r[7..].to_owned()).collect();
    let text = file("ax,ay,az,gx,gy,gz", &lines);
    let error = read(&text, &ReadOptions::default()).unwrap_err();
    assert!(
        matches!(&error, Error::Usage(found) if found.text(findings::Front::CommandLine).contains("--rate 100")),
        "{error}"
    );
    let rate = ReadOptions {
        rate: Some(100.0),
        ..ReadOptions::default()
    };
    assert_same_samples(&read(&text, &rate).unwrap(), 200);
    for rate in [0.0, -1.0, f64::NAN, f64::INFINITY] {
        let rate = ReadOptions {
            rate: Some(rate),
            ..ReadOptions::default()
        };
        assert!(matches!(read(&text, &rate), Err(Error::Usage(_))));
    }
}

#[test]
fn row_65_units_of_time_are_found_by_the_rate_or_the_header() {
    for (step, unit) in [(10u64, "ms"), (10_000, "us"), (10_000_000, "ns")] {
        let text = stamped((0..200).map(|i| (i * step).to_string()));
        let recording = warned(&text, &["time is taken as", unit]);
        assert_same_samples(&recording, 200);
        let stated = text.replacen('t', &format!("timestamp [{unit}]"), 1);
        read_as_usual(&stated, 200);
        read_as_usual(text.replacen('t', &format!("time_{unit}"), 1), 200);
    }
    let text = stamped((0..200).map(|i| (i * 500).to_string()));
    refused(text, "", &["Their usual step of 500", "--time-unit"]);
}

#[test]
fn row_66_nanosecond_epochs_keep_their_digits() {
    let text =
        stamped((0..200).map(|i| (1_700_000_000_000_000_123u64 + 5_000_001 * i).to_string()));
    let t = stamps(&text);
    assert_eq!((t[0], t[199]), (0.0, 995_000_199.0 / 1e9));
}

#[test]
fn row_66_epochs_with_an_exponent_start_at_zero_too() {
    let plain = stamps(&stamped(
        (0..200).map(|i| format!("17000000{:05.2}", 0.01 * f64::from(i))),
    ));
    let exponent = |i: u32| format!("1.7000000{:04}e9", i);
    assert_eq!(plain[..2], [0.0, 0.01]);
    assert_eq!(stamps(&stamped((0..200).map(exponent))), plain);
}

#[test]
fn no_clock_shows_more_than_nineteen_digits() {
    refused(
        stamped(["0", "1e300"].into_iter().map(str::to_owned)),
        "3:1",
        &["`1e300` in column 1 (`t`)", "wrong unit"],
    );
}

#[test]
fn row_68_dates_are_iso_or_by_pattern() {
    let iso = (0..200).map(|i| format!("2026-11-21T03:04:{:06.3}Z", 0.01 * f64::from(i)));
    let t = stamps(&stamped(iso));
    assert_eq!((t[0], t[199]), (0.0, 1.99));
    let local = (0..200).map(|i| format!("21.11.2026 03:04:{:06.3}", 0.01 * f64::from(i)));
    let text = stamped(local);
    refused(&text, "2:1", &["ISO 8601", "--time-format"]);
    let pattern = Some("%d.%m.%Y %H:%M:%S%.f".to_owned());
    let options = ReadOptions {
        time_format: pattern,
        ..ReadOptions::default()
    };
    assert_eq!(read(&text, &options).unwrap().accelerometer.unwrap().t, t);
    let other = ReadOptions {
        time_format: Some("%Y".to_owned()),
        ..ReadOptions::default()
    };
    refused_with(&text, &other, "2:1", &["does not fit the date format"]);
}

#[test]
fn row_70_counters_that_wrap_go_on() {
    for (modulus, step) in [(1u64 << 16, 10), (1 << 32, 10_000)] {
        let start = modulus - 100 * step;
        let text = stamped((0..200).map(|i| ((start + i * step) % modulus).to_string()));
        let recording = read(&text, &ReadOptions::default()).unwrap();
        assert!(
            recording
                .warnings
                .texts(findings::Front::CommandLine)
                .iter()
                .any(|w| w.contains("the time counter starts again") && w.contains("line 102."))
        );
        let t = recording.accelerometer.unwrap().t;
        assert!(
            t.windows(2).all(|w| (w[1] - w[0] - 0.01).abs() < 1e-9),
            "{modulus}"
        );
    }
}

#[test]
fn row_71_gaps_are_data() {
    let stamp = |i: usize| format!("{:.3}", 0.01 * i as f64 + if i > 120 { 0.3 } else { 0.0 });
    let text = stamped((0..200).map(stamp));
    let recording = read(text, &ReadOptions::default()).unwrap();
    assert!(
        recording
            .warnings
            .texts(findings::Front::CommandLine)
            .iter()
            .all(|w| w.contains("has 1 gap without samples"))
    );
    let gaps = recording.gyroscope.unwrap().gaps();
    assert_eq!(gaps.len(), 1);
    assert_eq!((gaps[0].after, gaps[0].t0, gaps[0].t1), (120, 1.2, 1.51));
}

#[test]
fn row_72_bursts_are_not_gaps() {
    let stamp = |i: usize| format!("{:.4}", 0.05 * (i / 5) as f64 + 0.0001 * (i % 5) as f64);
    let text = stamped((0..500).map(stamp));
    let recording = read(text, &ReadOptions::default()).unwrap();
    assert!(recording.accelerometer.unwrap().gaps().is_empty());
    assert!(
        recording
            .warnings
            .texts(findings::Front::CommandLine)
            .iter()
            .any(|w| w.contains("bursts")),
        "{:?}",
        recording.warnings
    );
}

#[test]
fn row_77_sensors_that_never_overlap_are_refused_with_their_ranges() {
    let lines: Vec<String> = rows(400)
        .iter()
        .enumerate()
        .map(|(i, row)| {
            let c: Vec<_> = row.split(',').collect();
            if i < 200 {
                format!("{},{},{},{},,,", c[0], c[1], c[2], c[3])
            } else {
                format!("{},,,,{},{},{}", c[0], c[4], c[5], c[6])
            }
        })
        .collect();
    refused(
        file(HEADER, &lines),
        "",
        &["from 0 to 1.99 s", "from 2 to 3.99 s", "overlap"],
    );
}

#[test]
fn row_79_values_that_a_slower_sensor_held_are_left_out() {
    let lines: Vec<String> = (0..400)
        .map(|i| {
            let (fast, slow) = (row(0.01 * i as f64, i), row(0.0, i / 2 * 2));
            let (fast, slow): (Vec<_>, Vec<_>) =
                (fast.split(',').collect(), slow.split(',').collect());
            [
                fast[0], slow[1], slow[2], slow[3], fast[4], fast[5], fast[6],
            ]
            .join(",")
        })
        .collect();
    let recording = warned(file(HEADER, &lines), &["accelerometer", "2 times slower"]);
    assert_eq!(recording.accelerometer.unwrap().len(), 200);
    assert_eq!(recording.gyroscope.unwrap().len(), 400);
}
