//! Apps of phones.

use std::fmt::Write as _;

use calib::recording::Stream;
use file_formats::make::{Packing, zip};
use nalgebra::Vector3;

use super::layout::{EPOCH, G, Layout, Samples};

/// phyphox in one of its dialects.
fn phyphox(stream: &Stream, names: [&str; 4], separator: char, mark: char) -> Vec<u8> {
    let quoted: Vec<String> = names.iter().map(|name| format!("\"{name}\"")).collect();
    let mut text = quoted.join(&separator.to_string()) + "\n";
    for (t, v) in stream.t.iter().zip(&stream.values) {
        let cells =
            [*t, v.x, v.y, v.z].map(|value| format!("{value:.9E}").replace('.', &mark.to_string()));
        text.push_str(&cells.join(&separator.to_string()));
        text.push('\n');
    }
    text.into_bytes()
}

const ACCEL: [&str; 4] = [
    "Time (s)",
    "Acceleration x (m/s^2)",
    "Acceleration y (m/s^2)",
    "Acceleration z (m/s^2)",
];
const GYRO: [&str; 4] = [
    "Time (s)",
    "Gyroscope x (rad/s)",
    "Gyroscope y (rad/s)",
    "Gyroscope z (rad/s)",
];
const DIALECTS: [(&str, char, char); 5] = [
    ("phyphox", ',', '.'),
    ("phyphox, semicolons", ';', '.'),
    ("phyphox, semicolons and decimal commas", ';', ','),
    ("phyphox, tabs", '\t', '.'),
    ("phyphox, tabs and decimal commas", '\t', ','),
];

fn as_zip(files: &[(String, Vec<u8>)]) -> Vec<u8> {
    let entries: Vec<_> = files
        .iter()
        .map(|(name, content)| (name.as_str(), content.as_slice(), Packing::Deflated))
        .collect();
    zip(&entries)
}

fn phyphox_files(s: &Samples, separator: char, mark: char) -> Vec<(String, Vec<u8>)> {
    vec![
        ("Accelerometer.csv".into(), phyphox(&s.accel, ACCEL, separator, mark)),
        ("Gyroscope.csv".into(), phyphox(&s.gyro, GYRO, separator, mark)),
        ("meta/device.csv".into(), b"\"property\",\"value\"\n\"deviceModel\",\"SM-G991B\"\n".to_vec()),
        ("meta/time.csv".into(), b"\"event\",\"experiment time\",\"system time\",\"system time text\"\n\"START\",0.000000000E0,1700000000.123,\"x\"\n".to_vec()),
    ]
}

/// A table of Sensor Logger.
fn sensor_logger(stream: &Stream, scale: f64, order: &str) -> Vec<u8> {
    let mut text = format!("time,seconds_elapsed,{order}\n");
    for (t, v) in stream.t.iter().zip(&stream.values) {
        let stamp = EPOCH * 1_000_000_000 + (t * 1e9).round() as u64;
        let v = v * scale;
        let axes = if order == "z,y,x" {
            [v.z, v.y, v.x]
        } else {
            [v.x, v.y, v.z]
        };
        let _ = writeln!(text, "{stamp},{t},{},{},{}", axes[0], axes[1], axes[2]);
    }
    text.into_bytes()
}

fn metadata(platform: &str, standardised: bool) -> Vec<u8> {
    format!("version,device name,platform,appVersion,standardisation\n3,x,{platform},1.47.1,{standardised}\n").into_bytes()
}

/// What a phone takes for gravity, and what is left.
fn apart(accel: &Stream) -> [Stream; 2] {
    let gravity: Vec<Vector3<f64>> = accel.values.iter().map(|v| v.normalize() * G).collect();
    let linear = accel
        .values
        .iter()
        .zip(&gravity)
        .map(|(v, g)| v - g)
        .collect();
    [linear, gravity].map(|values| Stream {
        t: accel.t.clone(),
        values,
    })
}

fn sensor_loggers(s: &Samples) -> Vec<Layout> {
    let file = |name: &str, content: Vec<u8>| (name.to_owned(), content);
    let [linear, gravity] = apart(&s.accel);
    let plain = |stream: &Stream| sensor_logger(stream, 1.0, "z,y,x");
    let android = vec![
        file("Metadata.csv", metadata("android", false)),
        file("Accelerometer.csv", plain(&linear)),
        file("Gravity.csv", plain(&gravity)),
        file("TotalAcceleration.csv", plain(&s.accel)),
        file("Gyroscope.csv", plain(&s.gyro)),
    ];
    let archive = vec![("recording.zip".to_owned(), as_zip(&android))];
    let ios = vec![
        file("Metadata.csv", metadata("ios", false)),
        file("Accelerometer.csv", sensor_logger(&linear, -1.0, "z,y,x")),
        file("Gravity.csv", sensor_logger(&gravity, -1.0, "z,y,x")),
        file(
            "AccelerometerUncalibrated.csv",
            sensor_logger(&s.accel, -1.0 / G, "z,y,x"),
        ),
        file("Gyroscope.csv", sensor_logger(&s.gyro, 1.0, "x,y,z")),
    ];
    let mut sum = ios.clone();
    sum.retain(|(name, _)| name != "AccelerometerUncalibrated.csv");
    let entry = |sensor: &str, t: f64, v: &Vector3<f64>| {
        let stamp = EPOCH * 1_000_000_000 + (t * 1e9).round() as u64;
        format!(
            "{{\"sensor\": \"{sensor}\", \"time\": \"{stamp}\", \"seconds_elapsed\": \"{t}\", \"z\": \"{}\", \"y\": \"{}\", \"x\": \"{}\"}}",
            v.z, v.y, v.x
        )
    };
    let all = |sensor, stream: &Stream| {
        stream
            .t
            .iter()
            .zip(&stream.values)
            .map(|(t, v)| entry(sensor, *t, v))
            .collect::<Vec<_>>()
    };
    let json = [
        all("TotalAcceleration", &s.accel),
        all("Gyroscope", &s.gyro),
    ]
    .concat()
    .join(", ");
    vec![
        Layout::new("Sensor Logger, Android", android, &["."]),
        Layout::new("Sensor Logger, zip", archive, &["recording.zip"]),
        Layout::new("Sensor Logger, iPhone", ios, &["."]),
        Layout::new("Sensor Logger, iPhone without uncalibrated", sum, &["."]),
        Layout::text("Sensor Logger, JSON", "recording.json", format!("[{json}]")),
    ]
}

/// A row for every event, with Android's number of its sensor's type.
fn android_events(s: &Samples) -> Layout {
    let mut text = String::from("timestamp_ns,type,x,y,z\n");
    let mut event = |t: f64, kind: u8, v: &Vector3<f64>| {
        let nanoseconds = (t * 1e9).round() as u64 + 123_456_000_000;
        let _ = writeln!(
            text,
            "{nanoseconds},{kind},{:.7},{:.7},{:.7}",
            v.x, v.y, v.z
        );
    };
    let gyro = s.gyro.t.iter().zip(&s.gyro.values);
    for ((t, f), (u, w)) in s.accel.t.iter().zip(&s.accel.values).zip(gyro) {
        event(*t, 1, f);
        event(*u, 4, w);
    }
    Layout::text("Android events", "events.csv", text)
}

fn physics_toolbox(s: &Samples, clock: bool) -> String {
    let mut text = String::from("time,gFx,gFy,gFz,wx,wy,wz,Bx,By,Bz,\n");
    for (t, f, w) in s.rows() {
        let f = f / G;
        let milliseconds = (t * 1e3).round() as u64 + 36_000_000;
        let time = match clock {
            false => format!("{t:.4}"),
            true => format!(
                "{:02}:{:02}:{:02}:{:03}",
                milliseconds / 3_600_000,
                milliseconds / 60_000 % 60,
                milliseconds / 1000 % 60,
                milliseconds % 1000
            ),
        };
        let _ = writeln!(
            text,
            "{time},{:.4},{:.4},{:.4},{:.4},{:.4},{:.4},20.1,-3.2,40.0,",
            f.x, f.y, f.z, w.x, w.y, w.z
        );
    }
    text
}

fn sensorlog(s: &Samples) -> String {
    let mut text = String::from(
        "loggingTime(txt),loggingSample(N),accelerometerTimestamp_sinceReboot(s),accelerometerAccelerationX(G),accelerometerAccelerationY(G),accelerometerAccelerationZ(G),gyroTimestamp_sinceReboot(s),gyroRotationX(rad/s),gyroRotationY(rad/s),gyroRotationZ(rad/s),motionRotationRateX(rad/s),motionRotationRateY(rad/s),motionRotationRateZ(rad/s)\n",
    );
    for (k, (t, f)) in s.accel.t.iter().zip(&s.accel.values).enumerate() {
        let (f, w) = (-f / G, s.gyro.values[k]);
        let _ = writeln!(
            text,
            "2023-11-14T22:13:{:06.3}+0100,{k},{:.6},{:.6},{:.6},{:.6},{:.6},{:.6},{:.6},{:.6},0.1,0.2,0.3",
            t % 60.0,
            1000.0 + t,
            f.x,
            f.y,
            f.z,
            1000.003 + t,
            w.x,
            w.y,
            w.z
        );
    }
    text
}

fn androsensor(s: &Samples) -> String {
    let mut text = String::from(
        "ACCELEROMETER X (m/s²);ACCELEROMETER Y (m/s²);ACCELEROMETER Z (m/s²);GRAVITY X (m/s²);GRAVITY Y (m/s²);GRAVITY Z (m/s²);LINEAR ACCELERATION X (m/s²);LINEAR ACCELERATION Y (m/s²);LINEAR ACCELERATION Z (m/s²);GYROSCOPE X (rad/s);GYROSCOPE Y (rad/s);GYROSCOPE Z (rad/s);Time since start in ms ;YYYY-MO-DD HH-MI-SS_SSS\n",
    );
    for (t, f, w) in s.rows() {
        let _ = writeln!(
            text,
            "{:.4};{:.4};{:.4};0.1;0.1;9.8;0.0;0.0;0.0;{:.4};{:.4};{:.4};{};2023-11-14 22:13:20:123",
            f.x,
            f.y,
            f.z,
            w.x,
            w.y,
            w.z,
            (t * 1e3).round()
        );
    }
    text
}

pub(super) fn layouts(s: &Samples) -> Vec<Layout> {
    let mut all: Vec<Layout> = DIALECTS
        .iter()
        .map(|(name, separator, mark)| {
            Layout::new(name, phyphox_files(s, *separator, *mark), &["."])
        })
        .collect();
    let archive = as_zip(&phyphox_files(s, ',', '.'));
    all.push(Layout::new(
        "phyphox, zip",
        vec![("experiment.zip".into(), archive)],
        &["experiment.zip"],
    ));
    let german = |names: [&str; 4], from: &str, to: &str| {
        names.map(|name| name.replace("Time", "Zeit").replace(from, to))
    };
    let (accel, gyro) = (
        german(ACCEL, "Acceleration", "Beschleunigung"),
        german(GYRO, "Gyroscope", "Gyroskop"),
    );
    let names = |names: &[String; 4]| names.each_ref().map(String::as_str).map(str::to_owned);
    let of = |stream, names: [String; 4]| {
        phyphox(stream, names.each_ref().map(String::as_str), ';', ',')
    };
    let files = vec![
        ("Beschleunigung.csv".into(), of(&s.accel, names(&accel))),
        ("Gyroskop.csv".into(), of(&s.gyro, names(&gyro))),
    ];
    all.push(Layout::new("phyphox, German", files, &["."]));
    all.push(Layout {
        accelerometer_only: true,
        ..Layout::new(
            "phyphox, one sensor",
            vec![("Raw Data.csv".into(), phyphox(&s.accel, ACCEL, ',', '.'))],
            &["Raw Data.csv"],
        )
    });
    all.extend(sensor_loggers(s));
    let coarse = [1e-4, 0.6e-3, 0.6e-4];
    all.push(android_events(s));
    all.push(
        Layout::text("Physics Toolbox", "toolbox.csv", physics_toolbox(s, false))
            .one_clock()
            .within(coarse),
    );
    all.push(
        Layout::text(
            "Physics Toolbox, time of day",
            "toolbox.csv",
            physics_toolbox(s, true),
        )
        .one_clock()
        .within(coarse),
    );
    all.push(Layout::text("SensorLog", "sensorlog.csv", sensorlog(s)).within([2e-6, 1e-5, 1e-6]));
    all.push(
        Layout::text("AndroSensor", "androsensor.csv", androsensor(s))
            .one_clock()
            .within([1e-3, 0.6e-4, 0.6e-4]),
    );
    all
}
