//! Programs of microcontrollers: an MPU-6050 at ±2 g and ±500 °/s.

use std::fmt::Write as _;

use nalgebra::Vector3;

use super::layout::{G, Layout, Samples};

/// Counts per m/s² and per rad/s.
const COUNTS: [f64; 2] = [16384.0 / G, 65.5 * 180.0 / std::f64::consts::PI];
/// Half a count.
const WITHIN: [f64; 3] = [1e-3, 0.51 / COUNTS[0], 0.51 / COUNTS[1]];

fn counts(v: &Vector3<f64>, scale: f64) -> [i64; 3] {
    [v.x, v.y, v.z].map(|value| ((value * scale).round() as i64).clamp(-32768, 32767))
}

/// A line for every row, of its milliseconds and counts.
fn lines(s: &Samples, line: impl Fn(u64, [i64; 3], [i64; 3]) -> String) -> String {
    s.rows().fold(String::new(), |mut text, (t, f, w)| {
        let milliseconds = (t * 1e3).round() as u64 + 1234;
        let _ = writeln!(
            text,
            "{}",
            line(milliseconds, counts(&f, COUNTS[0]), counts(&w, COUNTS[1]))
        );
        text
    })
}

pub(super) fn layouts(s: &Samples) -> Vec<Layout> {
    let counted = |name, text: String, call: &[&'static str]| Layout {
        counts: COUNTS,
        ..Layout::new(name, vec![("log.txt".to_owned(), text.into_bytes())], call)
            .one_clock()
            .within(WITHIN)
    };
    let comma = |f: [i64; 3], w: [i64; 3]| {
        [f, w]
            .concat()
            .iter()
            .map(ToString::to_string)
            .collect::<Vec<_>>()
            .join(",")
    };
    let stamped = ["log.txt"];
    let unstamped = ["log.txt", "--rate", "100"];
    let plain = lines(s, |t, f, w| format!("{t},{}", comma(f, w)));
    let named = format!("millis,ax,ay,az,gx,gy,gz\n{plain}");
    let without_stamps = lines(s, |_, f, w| comma(f, w));
    let gyro_first = lines(s, |t, f, w| format!("{t},{}", comma(w, f)));
    let plotter = lines(s, |_, f, w| {
        format!(
            "ax:{}\tay:{}\taz:{}\tgx:{}\tgy:{}\tgz:{}",
            f[0], f[1], f[2], w[0], w[1], w[2]
        )
    });
    let teleplot = lines(s, |t, f, w| {
        let numbers = [f, w].concat();
        let names = ["ax", "ay", "az", "gx", "gy", "gz"].iter().zip(numbers);
        let of_axes: Vec<String> = names
            .map(|(name, number)| format!(">{name}:{t}:{number}"))
            .collect();
        of_axes.join("\n")
    });
    let logged = lines(s, |t, f, w| {
        format!(
            "I ({t}) imu: ax:{} ay:{} az:{} gx:{} gy:{} gz:{}",
            f[0], f[1], f[2], w[0], w[1], w[2]
        )
    });
    let jeff = format!(
        "Initializing I2C devices...\nTesting device connections...\nMPU6050 connection successful\n{}",
        lines(s, |_, f, w| format!(
            "a/g:\t{}",
            comma(f, w).replace(',', "\t")
        ))
    );
    let arduino = lines(s, |t, f, w| {
        format!(
            "22:{:02}:{:02}.{:03} -> {}",
            13 + t / 60_000,
            t / 1000 % 60,
            t % 1000,
            comma(f, w)
        )
    });
    let rows: Vec<&str> = named.lines().collect();
    let torn = format!(
        "{}\n{}\n{}",
        &rows[500][9..],
        rows[501..rows.len() - 1].join("\n"),
        &rows[rows.len() - 1][..11]
    );
    let micros = s.rows().fold(
        String::from("micros,ax,ay,az,gx,gy,gz\n"),
        |mut text, (t, f, w)| {
            let micros = ((t * 1e6).round() as u64 + (1 << 32) - 30_000_000) % (1 << 32);
            let _ = writeln!(
                text,
                "{micros},{}",
                comma(counts(&f, COUNTS[0]), counts(&w, COUNTS[1]))
            );
            text
        },
    );
    let adafruit = s.rows().fold(String::from("Adafruit MPU6050 test!\nMPU6050 Found!\n"), |mut text, (_, f, w)| {
        let _ = writeln!(text, "Acceleration X: {:.2}, Y: {:.2}, Z: {:.2} m/s^2\nRotation X: {:.2}, Y: {:.2}, Z: {:.2} rad/s\nTemperature: 30.10 degC\n", f.x, f.y, f.z, w.x, w.y, w.z);
        text
    });
    vec![
        counted("serial log with names", named, &stamped),
        counted("serial log without names", plain, &stamped),
        counted(
            "serial log without names, gyroscope first",
            gyro_first,
            &stamped,
        ),
        counted(
            "serial log without names and stamps",
            without_stamps,
            &unstamped,
        ),
        counted("serial plotter", plotter, &unstamped),
        counted("Teleplot", teleplot, &stamped),
        counted("ESP-IDF, Arduino-ESP32, Zephyr", logged, &stamped),
        counted("MPU6050_raw of I2Cdevlib", jeff, &unstamped),
        counted("Arduino IDE with time stamps", arduino, &stamped),
        counted("serial log torn at both ends", torn, &stamped),
        counted("serial log with a counter that wraps", micros, &stamped),
        Layout::text("Adafruit MPU6050", "log.txt", adafruit)
            .one_clock()
            .within([1e-3, 0.6e-2, 0.6e-2])
            .with_rate(),
    ]
}

impl Layout {
    fn with_rate(mut self) -> Self {
        self.call.extend(["--rate", "100"]);
        self
    }
}
