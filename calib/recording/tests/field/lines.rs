//! What terminals, brokers, buses and databases keep of a device: a line or a row for each axis, numbers in sixteens, frames.

use findings::{Front, OptionName};
use stillpoint_recording::{Error, ReadOptions};

use crate::session::{G, Session, is_it, read, read_as, session, table, xyz};

const NAMES: [&str; 6] = ["ax", "ay", "az", "gx", "gy", "gz"];

/// The six numbers of a row.
fn numbers(s: &Session, k: usize) -> [f64; 6] {
    let (f, w) = (&s.force[k], &s.rate[k]);
    [f.x, f.y, f.z, w.x, w.y, w.z]
}

/// A line for each axis of a row.
fn axes(s: &Session, k: usize, line: impl Fn(&str, f64) -> String) -> String {
    let lines = NAMES.iter().zip(numbers(s, k));
    let lines: Vec<String> = lines.map(|(name, number)| line(name, number)).collect();
    lines.join("\n")
}

fn milliseconds(s: &Session, k: usize) -> u64 {
    (s.t[k] * 1e3).round() as u64 + 1234
}

fn at_rate() -> ReadOptions {
    ReadOptions {
        rate: Some(50.0),
        ..ReadOptions::default()
    }
}

#[test]
fn a_line_for_each_axis_is_read_with_its_stamp() {
    let s = session();
    for line in [
        |name: &str, ms: u64, number: f64| format!(">{name}:{ms}:{number:.6}"),
        |name: &str, ms: u64, number: f64| format!("imu/{name} {number:.6} {ms}"),
        |name: &str, ms: u64, number: f64| {
            format!("channel type=0({name}) shift=4 value={ms}000000ns ({number:.6})")
        },
    ] {
        let text = table("", |k| {
            axes(&s, k, |name, number| {
                line(name, milliseconds(&s, k), number)
            })
        });
        is_it(&read(&text), &s, 1e-4);
        // Lines may end with a return alone.
        is_it(&read(&text.replace('\n', "\r")), &s, 1e-4);
    }
    let text = table("hello", |k| {
        format!(
            "t_ms={}\n{}",
            milliseconds(&s, k),
            axes(&s, k, |name, number| format!("{name} = {number:.6}"))
        )
    });
    is_it(&read(&text), &s, 1e-4);
    let text = table("", |k| {
        axes(&s, k, |name, number| format!(">{name}:{number:.6}"))
    });
    is_it(&read_as(&text, &at_rate()).unwrap(), &s, 1e-4);
}

#[test]
fn a_line_of_an_axis_that_is_not_understood_stops_the_reading() {
    let s = session();
    let text = table("", |k| {
        let lines = axes(&s, k, |name, number| format!("{name} {number:.6}"));
        lines
            .replace("gx", "spin_x")
            .replace("gy", "spin_y")
            .replace("gz", "spin_z")
    });
    assert!(read_as(&text, &at_rate()).is_err());
}

#[test]
fn rows_sorted_by_their_names_are_those_of_their_stamps() {
    let s = session();
    let of = |at: usize, device: &str| {
        table("", |k| {
            format!(
                ",,{at},{:.3},{:.6},{},imu,{device}",
                1_700_000_000.0 + s.t[k],
                numbers(&s, k)[at],
                NAMES[at]
            )
        })
    };
    let header = ",result,table,_time,_value,_field,_measurement,device\n";
    let all = |device: &str| (0..6).map(|at| of(at, device)).collect::<String>();
    is_it(&read(&(header.to_owned() + &all("a"))), &s, 1e-4);
    // A header above each table, and one sensor alone.
    let apart: String = (0..6)
        .map(|at| format!("{header}{}\n", of(at, "a")))
        .collect();
    is_it(&read(&apart), &s, 1e-4);
    let one = read(&(header.to_owned() + &(0..3).map(|at| of(at, "a")).collect::<String>()));
    assert_eq!(
        (one.accelerometer.unwrap().len(), one.gyroscope),
        (1600, None)
    );
    // Two devices at the same instants are not one.
    let two: String = (0..6)
        .map(|at| of(at, "a") + &of(at, "b").replace(",0.", ",1."))
        .collect();
    assert!(read_as(&(header.to_owned() + &two), &ReadOptions::default()).is_err());
}

#[test]
fn labels_units_and_marks_beside_numbers_are_understood() {
    let s = session();
    for (accel, gyro, scale) in [
        (
            "[ACCEL] X:{}g Y:{}g Z:{}g | ",
            "[GYRO] X:{}°/s Y:{}°/s Z:{}°/s | [ANGLE] R:+1.0°",
            [1.0 / G, 180.0 / std::f64::consts::PI],
        ),
        (
            "Acceleration => AX: {} | AY: {} | AZ: {}\n",
            "Gyroscope => GX: {} | GY: {} | GZ: {}",
            [1.0, 1.0],
        ),
        (
            "Accelerometer - x: {} y: {} z: {}\n",
            "Gyro - x: {} y: {} z: {}",
            [1.0, 1.0],
        ),
        ("AccX={},Y={},Z={}\n", "GyrX={},Y={},Z={}", [1.0, 1.0]),
        (
            "acc analog: (unit mg) x: {} y: {} z: {}\n",
            "gyr analog: (unit dps) x: {} y: {} z: {}",
            [1e3 / G, 180.0 / std::f64::consts::PI],
        ),
        (
            "Accelerometer:\n X1 = {}\n Y1 = {}\n Z1 = {}\n",
            "Gyroscope:\n X1 = {}\n Y1 = {}\n Z1 = {}\nThermometer:\n Degrees C1 = 25.0",
            [1.0, 1.0],
        ),
    ] {
        let text = table("", |k| {
            let fill = |pattern: &str, value, scale| {
                let cells = xyz(value, scale);
                cells.split(',').fold(pattern.to_owned(), |text, cell| {
                    text.replacen("{}", cell, 1)
                })
            };
            fill(accel, &s.force[k], scale[0]) + &fill(gyro, &s.rate[k], scale[1])
        });
        is_it(&read_as(&text, &at_rate()).unwrap(), &s, 1e-3);
    }
}

#[test]
fn rows_of_a_robot_and_frames_of_a_bus_are_read() {
    let s = session();
    let text = table("boot", |k| {
        let ms = milliseconds(&s, k);
        format!(
            "ODOM,{ms},0.1,0.2\nIMU,{ms},{},{}\nBAT,{ms},12.1",
            xyz(&s.force[k], 1.0),
            xyz(&s.rate[k], 1.0)
        )
    });
    is_it(&read(&text), &s, 1e-4);
    let text = table("", |k| {
        let of = |id: u32, name: &str, units: &str, value| {
            let cells = xyz(value, 1.0);
            let cells: Vec<&str> = cells.split(',').collect();
            format!(
                " ({:.6})  can0  {id}   [6]  59 00 42 FF 90 40 :: IMU_{id}({name}X: {} {units}, {name}Y: {} {units}, {name}Z: {} {units})",
                1_700_000_000.0 + s.t[k],
                cells[0],
                cells[1],
                cells[2]
            )
        };
        of(101, "Acc", "m/s2", &s.force[k]) + "\n" + &of(102, "Gyr", "rad/s", &s.rate[k])
    });
    is_it(&read(&text), &s, 1e-4);
}

#[test]
fn counts_in_sixteens_and_names_with_strokes_are_respelt() {
    let s = session();
    let counts = |k: usize| numbers(&s, k).map(|number| (number * 1000.0).round() as i16);
    let tens = table("ms,ax,ay,az,gx,gy,gz", |k| {
        format!(
            "{},{}",
            milliseconds(&s, k),
            counts(k).map(|count| count.to_string()).join(",")
        )
    });
    let sixteens = table("ms,ax,ay,az,gx,gy,gz", |k| {
        format!(
            "{},{}",
            milliseconds(&s, k),
            counts(k)
                .map(|count| format!("{:04X}", count as u16))
                .join(",")
        )
    });
    let (expected, found) = (read(&tens), read(&sixteens));
    assert_eq!(
        found.accelerometer.unwrap().values,
        expected.accelerometer.unwrap().values
    );
    assert_eq!(
        found.gyroscope.unwrap().values,
        expected.gyroscope.unwrap().values
    );
    let header = "\"Utc\"|\"ms\"|0|0|1,\"AccelX\"|\"G\"|-3.0|3.0|50,\"AccelY\"|\"G\"|-3.0|3.0|50,\"AccelZ\"|\"G\"|-3.0|3.0|50,\"GyroX\"|\"Deg/Sec\"|-120|120|50,\"GyroY\"|\"Deg/Sec\"|-120|120|50,\"GyroZ\"|\"Deg/Sec\"|-120|120|50";
    let text = table(header, |k| {
        let degrees = 180.0 / std::f64::consts::PI;
        format!(
            "{},{},{}",
            milliseconds(&s, k),
            xyz(&s.force[k], 1.0 / G),
            xyz(&s.rate[k], degrees)
        )
    });
    is_it(&read(&text), &s, 1e-4);
}

/// The advice of a refusal.
fn advice(text: &str, options: &ReadOptions) -> String {
    let error: Error = read_as(text, options).unwrap_err();
    error
        .finding()
        .remedies
        .iter()
        .map(|remedy| format!("{remedy:?} "))
        .collect()
}

#[test]
fn an_example_of_columns_names_a_time_only_where_one_goes_up() {
    let s = session();
    let counts = |k: usize| {
        numbers(&s, k)
            .map(|number| ((number * 1000.0).round()).to_string())
            .join(",")
    };
    // Nine columns without stamps, as a monitor for calibration gets them.
    let text = table("", |k| {
        format!("Raw:{},{}", counts(k), xyz(&s.field[k], 10.0))
    });
    let said = advice(&text, &ReadOptions::default());
    assert!(
        said.contains("ax=1,ay=2,az=3") && !said.contains("t=1"),
        "{said}"
    );
    // Words are no columns.
    let text = table("", |k| format!("({:.6}) can0 101#59{:04X}", s.t[k], k));
    assert!(!advice(&text, &ReadOptions::default()).contains("ax="));
    // A table without stamps, of which no column goes up.
    let text = table("ax,ay,az,gx,gy,gz", |k| {
        format!("{},{}", xyz(&s.force[k], 1.0), xyz(&s.rate[k], 1.0))
    });
    let said = advice(&text, &ReadOptions::default());
    assert!(said.contains("Rate") && !said.contains("Columns"), "{said}");
}

#[test]
fn tenths_of_microseconds_are_offered_beside_the_clock_of_a_processor() {
    let s = session();
    let text = table("time,ax,ay,az,gx,gy,gz", |k| {
        let counts = numbers(&s, k).map(|number| ((number * 1000.0).round()).to_string());
        format!(
            "{},{}",
            (s.t[k] * 1e7).round() as u64 + 12_345,
            counts.join(",")
        )
    });
    let error = read_as(&text, &ReadOptions::default()).unwrap_err();
    let said = advice(&text, &ReadOptions::default());
    assert!(
        said.contains("0.1us") && said.contains("t=time/24000000"),
        "{said}"
    );
    assert!(
        error
            .text(Front::CommandLine)
            .contains("look up what they count")
    );
    assert!(said.contains(&format!("{:?}", OptionName::TimeUnit)));
}
