//! What brokers, databases and terminals keep of messages: documents, lines and rows of a number.

use std::fmt::Write as _;

use nalgebra::Vector3;

use super::layout::{EPOCH, Layout, Samples};

/// The numbers of three axes behind what `before` writes of each.
fn axes(v: &Vector3<f64>, separator: &str, before: impl Fn(char) -> String) -> String {
    let number = |(axis, value): (char, &f64)| format!("{}{value:.9}", before(axis));
    let all: Vec<String> = "xyz".chars().zip(v.iter()).map(number).collect();
    all.join(separator)
}

/// A text of what `line` writes of every row: its nanoseconds since 1970, force and rate.
fn text(s: &Samples, line: impl Fn(u64, Vector3<f64>, Vector3<f64>) -> String) -> String {
    s.rows().fold(String::new(), |mut text, (t, f, w)| {
        let stamp = EPOCH * 1_000_000_000 + (t * 1e9).round() as u64;
        let _ = write!(text, "{}", line(stamp, f, w));
        text
    })
}

pub(super) fn layouts(s: &Samples) -> Vec<Layout> {
    let documents = text(s, |stamp, f, w| {
        let vector = |v: &Vector3<f64>| axes(v, "\n", |axis| format!("  {axis}: "));
        format!(
            "header:\n  stamp:\n    sec: {}\n    nanosec: {}\n  frame_id: imu\norientation:\n  x: 0.0\n  y: 0.0\n  z: 0.0\n  w: 1.0\nangular_velocity:\n{}\nangular_velocity_covariance:\n- 0.0\n- 0.0\nlinear_acceleration:\n{}\n---\n",
            stamp / 1_000_000_000,
            stamp % 1_000_000_000,
            vector(&w),
            vector(&f),
        )
    });
    let influx = text(s, |stamp, f, w| {
        let of = |v: &Vector3<f64>, name: char| axes(v, ",", |axis| format!("{name}{axis}="));
        format!("imu,device=esp32 {},{} {stamp}\n", of(&f, 'a'), of(&w, 'g'))
    });
    let per_number = text(s, |stamp, f, w| {
        let of = |v: &Vector3<f64>, name: char| {
            axes(v, "\n", |axis| format!("{},{name}{axis},", stamp / 1000))
        };
        format!("{}\n{}\n", of(&f, 'a'), of(&w, 'g'))
    });
    let field = |name: String, value: &dyn Fn(&Vector3<f64>, &Vector3<f64>) -> f64| {
        text(s, |stamp, f, w| {
            format!(
                ",,0,{}.{:06},{:.9},{name},imu\n",
                stamp / 1_000_000_000,
                stamp / 1000 % 1_000_000,
                value(&f, &w)
            )
        })
    };
    let sorted: String = (0..6)
        .map(|at| {
            let (sensor, axis) = (["a", "g"][at / 3], at % 3);
            let name = format!("{sensor}{}", ["x", "y", "z"][axis]);
            field(name, &|f, w| if at < 3 { f[axis] } else { w[axis] })
        })
        .collect();
    let records: Vec<String> = s
        .rows()
        .enumerate()
        .map(|(at, (t, f, w))| {
            let of = |v: &Vector3<f64>| axes(v, ",", |axis| format!("\"{axis}\":"));
            format!(
                "\"-Nx{at:09}\":{{\"t\":{t:.6},\"acc\":{{{}}},\"gyro\":{{{}}}}}",
                of(&f),
                of(&w)
            )
        })
        .collect();
    let firebase = format!("{{\"log\":{{{}}}}}", records.join(","));
    vec![
        Layout::text("rostopic echo, ros2 topic echo", "imu.txt", documents).one_clock(),
        Layout::text("InfluxDB", "imu.txt", influx).one_clock(),
        Layout::text(
            "InfluxDB, CSV",
            "imu.csv",
            format!(",result,table,_time,_value,_field,_measurement\n{sorted}"),
        )
        .one_clock(),
        Layout::text("Firebase", "imu.json", firebase).one_clock(),
        Layout::text(
            "a row per number",
            "imu.csv",
            format!("time_us,name,value\n{per_number}"),
        )
        .one_clock(),
    ]
}
