//! Tables of one device and of several, as users make them.

use findings::Front;
use rand::{RngExt, SeedableRng};
use rand_chacha::ChaCha8Rng;

use crate::{Error, ReadOptions, Recording};

/// Rows of a recording.
const ROWS: usize = 1200;
/// Its step, s.
const STEP: f64 = 0.02;

/// Stamps, s, and cells of the six axes of a device that rests and turns by turns; `device` 0 and 1 differ by their biases.
fn device(device: usize) -> Vec<(f64, String)> {
    let random = &mut ChaCha8Rng::seed_from_u64(device as u64);
    let bias = [0.0, 0.3][device];
    let rate = [0.001, -0.004][device];
    // About two axes by turns.
    let mut angles = [0.0_f64; 2];
    let mut row = |k: usize| {
        let omega = if k % 150 >= 100 { 1.5 } else { 0.0 };
        angles[k / 150 % 2] += omega * STEP;
        let mut noise =
            |size: f64| size * (random.random_range(-1.0..1.0) + random.random_range(-1.0..1.0));
        let [(sa, ca), (sb, cb)] = angles.map(f64::sin_cos);
        let f = [9.8 * ca * cb + bias, 9.8 * sa * cb - bias, 9.8 * sb];
        let w = [0.8 * omega + rate, omega - rate, 0.5 * omega + rate];
        let cells = f.map(|v| format!("{:.4}", v + noise(0.02)));
        let rates = w.map(|v| format!("{:.5}", v + noise(0.002)));
        (
            k as f64 * STEP,
            [cells.join(","), rates.join(",")].join(","),
        )
    };
    (0..ROWS).map(&mut row).collect()
}

const AXES: &str = "ax,ay,az,gx,gy,gz";

/// A table of both devices by turns, each row as `row` writes it: number, device, stamp, axes.
fn by_turns(header: &str, row: impl Fn(usize, usize, f64, &str) -> String) -> String {
    let devices = [device(0), device(1)];
    let rows = (0..ROWS).flat_map(|k| [(k, 0), (k, 1)]).map(|(k, d)| {
        let (t, axes) = &devices[d][k];
        row(k, d, *t, axes)
    });
    header.to_owned() + &rows.collect::<String>()
}

/// A table of device 0, each row as `row` writes it: number, stamp, axes.
fn of_one(header: &str, row: impl Fn(usize, f64, &str) -> String) -> String {
    let rows = device(0).into_iter().enumerate();
    header.to_owned()
        + &rows
            .map(|(k, (t, axes))| row(k, t, &axes))
            .collect::<String>()
}

fn read(text: &str, options: &ReadOptions) -> Result<Recording, Error> {
    Recording::from_bytes("r.csv", text.as_bytes(), options)
}

fn of(device: &str) -> ReadOptions {
    ReadOptions {
        device: Some(device.to_owned()),
        ..ReadOptions::default()
    }
}

#[track_caller]
fn asked(text: &str, devices: [&str; 2]) {
    let error = read(text, &ReadOptions::default()).unwrap_err();
    let words = error.text(Front::CommandLine);
    assert!(matches!(error, Error::Usage(_)), "{words}");
    for device in devices {
        let listed = format!("`{device}` ({ROWS} rows)");
        assert!(words.contains(&listed), "{words}");
    }
    assert!(
        words.contains(&format!("--instance {}", devices[0])),
        "{words}"
    );
    for (k, device) in devices.iter().enumerate() {
        let recording = read(text, &of(device)).unwrap();
        let accel = recording.accelerometer.unwrap();
        assert_eq!(accel.len(), ROWS, "{device}");
        let first = accel.values[..100].iter().map(|v| v.x).sum::<f64>() / 100.0;
        assert!(
            (first - 9.8 - [0.0, 0.3][k]).abs() < 0.01,
            "{device}: {first}"
        );
    }
    let none = read(text, &of("no such")).unwrap_err().to_string();
    assert!(
        none.contains("no device 'no such'") && none.contains(devices[1]),
        "{none}"
    );
}

#[test]
fn devices_by_turns_are_asked_for_whatever_the_column_is_called() {
    asked(
        &by_turns(&format!("t,I,{AXES}\n"), |_, d, t, axes| {
            format!("{t:.2},{d},{axes}\n")
        }),
        ["0", "1"],
    );
    asked(
        &by_turns(&format!("t,{AXES},device_id\n"), |_, d, t, axes| {
            format!("{t:.2},{axes},{}\n", d + 7)
        }),
        ["7", "8"],
    );
    asked(
        &by_turns(&format!("time_ms,mac,{AXES}\n"), |_, d, t, axes| {
            format!(
                "{:.0},{},{axes}\n",
                t * 1e3 + 5.0 * d as f64,
                ["AA:01", "AA:02"][d]
            )
        }),
        ["AA:01", "AA:02"],
    );
    // A name that says nothing: the readings do.
    asked(
        &by_turns(&format!("t,foo,{AXES}\n"), |_, d, t, axes| {
            format!(
                "{:.3},{},{axes}\n",
                t + 0.01 * d as f64,
                ["left", "right"][d]
            )
        }),
        ["left", "right"],
    );
}

#[test]
fn devices_of_a_table_without_a_header_are_asked_for() {
    asked(
        &by_turns("", |_, d, t, axes| format!("{t:.2},{d},{axes}\n")),
        ["0", "1"],
    );
    asked(
        &by_turns("", |_, d, t, axes| {
            format!("{:.3},{axes},{}\n", t + 0.01 * d as f64, d + 1)
        }),
        ["1", "2"],
    );
    asked(
        &by_turns("", |_, d, t, axes| {
            format!("{},{t:.2},{axes}\n", ["imuA", "imuB"][d])
        }),
        ["imuA", "imuB"],
    );
}

#[test]
fn devices_one_after_the_other_are_asked_for() {
    let devices = [device(0), device(1)];
    let table = |header: &str, shift: f64, names: [&str; 2]| {
        let rows = (0..2).flat_map(|d| {
            let name = names[d];
            let row = move |(t, axes): &(f64, String)| {
                format!("{name},{:.2},{axes}\n", t + shift * d as f64)
            };
            devices[d].iter().map(row)
        });
        header.to_owned() + &rows.collect::<String>()
    };
    asked(
        &table(&format!("id,t,{AXES}\n"), 0.0, ["0", "1"]),
        ["0", "1"],
    );
    asked(
        &table(&format!("id,t,{AXES}\n"), 60.0, ["0", "1"]),
        ["0", "1"],
    );
    asked(
        &table(&format!("sensor,t,{AXES}\n"), 60.0, ["A", "B"]),
        ["A", "B"],
    );
    asked(&table("", 0.0, ["1", "2"]), ["1", "2"]);
}

#[test]
fn devices_without_a_column_are_refused() {
    let same = by_turns(&format!("t,{AXES}\n"), |_, _, t, axes| {
        format!("{t:.2},{axes}\n")
    });
    let words = read(&same, &ReadOptions::default())
        .unwrap_err()
        .to_string();
    assert!(
        words.starts_with("r.csv:3: 1200 rows have the stamp of the row before"),
        "{words}"
    );
    let turns = by_turns(&format!("t,{AXES}\n"), |_, d, t, axes| {
        format!("{:.2},{axes}\n", t + 0.01 * d as f64)
    });
    let words = read(&turns, &ReadOptions::default())
        .unwrap_err()
        .to_string();
    assert!(words.contains("rows of 2 devices by turns"), "{words}");
}

#[test]
fn the_column_and_that_there_is_one_device_can_be_said() {
    let header = format!("t,status,{AXES}\n");
    let text = by_turns(&header, |_, d, t, axes| {
        format!("{:.3},{d},{axes}\n", t + 0.01 * d as f64)
    });
    let named = ReadOptions {
        columns: "device=status".parse().unwrap(),
        instance: Some(1),
        ..ReadOptions::default()
    };
    assert_eq!(read(&text, &named).unwrap().gyroscope.unwrap().len(), ROWS);
    let by_id = of_one(&format!("t,sensor,{AXES}\n"), |k, t, axes| {
        format!("{t:.2},{},{axes}\n", k % 2)
    });
    assert!(read(&by_id, &ReadOptions::default()).is_err());
    let all = read(&by_id, &of("all")).unwrap();
    assert_eq!(all.gyroscope.unwrap().len(), ROWS);
    let none = of_one(&format!("t,{AXES}\n"), |_, t, axes| {
        format!("{t:.2},{axes}\n")
    });
    let words = read(&none, &of("1")).unwrap_err().to_string();
    assert!(words.contains("no column tells devices apart"), "{words}");
}

#[test]
fn with_a_rate_the_rows_of_one_device_are_counted() {
    let text = by_turns(&format!("dev,{AXES}\n"), |_, d, _, axes| {
        format!("{d},{axes}\n")
    });
    let options = ReadOptions {
        rate: Some(50.0),
        ..of("1")
    };
    let t = read(&text, &options).unwrap().accelerometer.unwrap().t;
    assert_eq!((t.len(), t[1]), (ROWS, 0.02));
}

#[test]
fn one_device_is_never_taken_for_several() {
    type Cell = fn(usize) -> String;
    let columns: [(&str, Cell); 12] = [
        ("id", |_| "5".to_owned()),
        ("Address", |_| "0x50".to_owned()),
        ("status", |k| (k * k % 7 % 2).to_string()),
        ("new_mag", |k| u8::from(k % 3 == 0).to_string()),
        ("seq", |k| k.to_string()),
        ("seq", |k| (k % 16).to_string()),
        ("i", |k| (k % 4).to_string()),
        ("activity", |k| ["rest", "turn"][k / 150 % 2].to_owned()),
        ("battery", |k| (87 - k / 700).to_string()),
        ("foo", |k| (87 - k * k % 11 % 2).to_string()),
        ("position", |k| (k / 150).to_string()),
        ("id", |k| (k / 150).to_string()),
    ];
    for (name, cell) in columns {
        let text = of_one(&format!("t,{name},{AXES}\n"), |k, t, axes| {
            format!("{t:.2},{},{axes}\n", cell(k))
        });
        let found = read(&text, &ReadOptions::default());
        assert!(found.is_ok(), "{name}, {}: {:?}", cell(1), found.err());
    }
    // A clock too coarse for the rate, and a counter beside it.
    let text = of_one(&format!("t,n,{AXES}\n"), |k, _, axes| {
        format!("{:.2},{},{axes}\n", (k / 2) as f64 * 0.04, k % 2)
    });
    assert!(read(&text, &ReadOptions::default()).is_ok());
}
