//! Small recordings and files on which the options matter.

use std::fmt::Write as _;
use std::path::Path;

use calib::recording::to_csv;
use calib::simulate::Spec;
use file_formats::make;
use serde_json::Value;

use crate::common::{json, status, stderr, stillpoint};

/// Devices of a type.
const DEVICES: usize = 70;

/// A row: stamp, specific force, rate.
type Row = [f64; 7];

fn spec(seed: u64, more: &str) -> String {
    format!(
        "seed = {seed}\nrate = 50.0\ngrade = \"consumer\"\n{more}[motion.hand_held]\nplacements = 14\ninitial_rest = 25.0\n"
    )
}

fn session(seed: u64, more: &str) -> String {
    let spec = Spec::from_toml(&spec(seed, more), "spec.toml").unwrap();
    to_csv(&mut spec.run().unwrap().recording)
}

/// A number in −1 to 1 by a counter: noise that is the same everywhere.
fn noise(k: usize) -> f64 {
    let bits = (k as u64).wrapping_mul(0x9E37_79B9_7F4A_7C15);
    let bits = (bits ^ (bits >> 29)).wrapping_mul(0xBF58_476D_1CE4_E5B9);
    (bits >> 11) as f64 / (1u64 << 52) as f64 - 1.0
}

fn noisy(k: usize, [t, ax, ay, az, gx, gy, gz]: Row) -> Row {
    let n = |axis: usize, size: f64| size * noise(7 * k + axis);
    [
        t,
        ax + n(1, 0.02),
        ay + n(2, 0.02),
        az + n(3, 0.02),
        gx + n(4, 0.002),
        gy + n(5, 0.002),
        gz + n(6, 0.002),
    ]
}

/// At rest for so many seconds at 100 Hz.
fn still(seconds: usize) -> Vec<Row> {
    let row = |k| {
        noisy(
            k,
            [k as f64 * 0.01, 0.03, -0.04, 9.79, 0.004, -0.003, 0.002],
        )
    };
    (0..100 * seconds).map(row).collect()
}

/// Each face up for 6 s, turned in 1 s.
fn six() -> Vec<Row> {
    let faces = [
        [0.0, 0.0, 1.0],
        [0.0, 0.0, -1.0],
        [0.0, 1.0, 0.0],
        [0.0, -1.0, 0.0],
        [1.0, 0.0, 0.0],
        [-1.0, 0.0, 0.0],
    ];
    let mut rows = Vec::new();
    for (face, next) in faces.iter().zip(faces.iter().skip(1).chain(&faces[..1])) {
        for k in 0..700 {
            let share = (k as f64 - 600.0).max(0.0) / 100.0;
            let f = [0, 1, 2].map(|axis| 9.81 * ((1.0 - share) * face[axis] + share * next[axis]));
            let turning = if share > 0.0 { 2.0 } else { 0.0 };
            let t = rows.len() as f64 * 0.01;
            rows.push(noisy(
                rows.len(),
                [t, f[0], f[1], f[2], turning, 0.3 * turning, 0.01],
            ));
        }
    }
    rows
}

/// A push along x between two rests.
fn push() -> Vec<Row> {
    let mut rows = still(9);
    for (k, row) in rows.iter_mut().enumerate() {
        if (400..500).contains(&k) {
            row[1] += if k < 450 { 2.0 } else { -2.0 };
            row[6] += 0.2;
        }
    }
    rows
}

fn csv(header: &str, rows: &[Row]) -> String {
    let mut text = format!("{header}\n");
    for row in rows {
        let words: Vec<String> = row.iter().map(|v| format!("{v:.6}")).collect();
        let _ = writeln!(text, "{}", words.join(","));
    }
    text
}

const PLAIN: &str = "t,ax,ay,az,gx,gy,gz";

/// Rows of a plain CSV with the first column changed.
fn stamped(rows: &[Row], header: &str, stamp: impl Fn(usize) -> String) -> String {
    let text = csv(header, rows);
    let mut lines = text.lines();
    let mut made = format!("{}\n", lines.next().unwrap());
    for (k, line) in lines.enumerate() {
        let _ = writeln!(made, "{},{}", stamp(k), line.split_once(',').unwrap().1);
    }
    made
}

/// A folder with everything that the calls name.
pub fn folder() -> tempfile::TempDir {
    let dir = tempfile::tempdir().unwrap();
    let path = dir.path();
    let good = session(11, "");
    let rows: Vec<Row> = good.lines().skip(1).map(row).collect();
    let short = still(3);
    let text = csv(PLAIN, &short);
    let lines: Vec<&str> = text.lines().collect();
    let with = |at: usize, line: &str| {
        let mut lines = lines.clone();
        lines[at] = line;
        lines.join("\n") + "\n"
    };
    let swapped = {
        let mut lines = lines.clone();
        lines.swap(100, 101);
        lines.join("\n") + "\n"
    };
    let timeless: Vec<&str> = lines
        .iter()
        .map(|line| line.split_once(',').unwrap().1)
        .collect();
    let mirrored: Vec<Row> = rows
        .iter()
        .map(|r| [r[0], r[1], r[2], r[3], -r[4], -r[5], -r[6]])
        .collect();
    let recordings = [
        ("good.csv", good.clone()),
        ("good2.csv", session(12, "")),
        ("other.csv", session(13, "")),
        (
            "effect.csv",
            session(11, "[effects.gyro_g_sensitivity]\nsize = 0.1\n"),
        ),
        (
            "field.csv",
            session(
                11,
                "[magnetic_field]\nstrength = 48.0\ninclination = 60.0\n",
            ),
        ),
        (
            "jitter.csv",
            stamped(&rows, PLAIN, |k| {
                format!("{:.6}", rows[k][0] + 4e-3 * noise(k))
            }),
        ),
        (
            "parts.csv",
            [csv(PLAIN, &rows), csv(PLAIN, &rows[500..])]
                .concat()
                .replacen(&format!("\n{PLAIN}\n"), "\n", 1),
        ),
        ("sign.csv", csv(PLAIN, &mirrored)),
        ("still.csv", csv(PLAIN, &still(100))),
        ("six.csv", csv(PLAIN, &six())),
        ("push.csv", csv(PLAIN, &push())),
        ("short.csv", text.clone()),
        ("odd.csv", csv("zeit,p,q,r,u,v,w", &short)),
        ("broken.csv", with(100, "1.0,2.0")),
        ("empty.csv", with(100, "1.0,,0.1,9.8,0,0,0")),
        ("back.csv", swapped),
        ("timeless.csv", timeless.join("\n") + "\n"),
        (
            "ticks.csv",
            stamped(&short, "timestamp,ax,ay,az,gx,gy,gz", |k| {
                (10 * k).to_string()
            }),
        ),
        (
            "dates.csv",
            stamped(&short, "time,ax,ay,az,gx,gy,gz", |k| {
                format!("21.11.2026T03:04:{:02}.{:02}", k / 100, k % 100)
            }),
        ),
    ];
    for (name, text) in &recordings {
        std::fs::write(path.join(name), text).unwrap();
    }
    let of = |first: usize| -> Vec<(i64, [f64; 3])> {
        let stamped = |r: &Row| {
            let nanoseconds = 1_000_000_000 + (r[0] * 1e9) as i64;
            (nanoseconds, [r[first], r[first + 1], r[first + 2]])
        };
        short.iter().map(stamped).collect()
    };
    let (accel, gyro) = (of(1), of(4));
    let log = make::ulog(
        &[("sensor_accel", 0, &accel), ("sensor_gyro", 0, &gyro)],
        &[],
    );
    std::fs::write(path.join("log.ulg"), log).unwrap();
    std::fs::create_dir(path.join("several")).unwrap();
    for name in ["a.csv", "b.csv"] {
        std::fs::write(path.join("several").join(name), &text).unwrap();
    }
    for name in recordings
        .iter()
        .map(|(name, _)| *name)
        .chain(["log.ulg", "several"])
    {
        of_device(path, name);
    }
    others(path, &rows);
    made(path);
    dir
}

fn row(line: &str) -> Row {
    let all: Vec<f64> = line
        .split(',')
        .take(7)
        .map(|word| word.parse().unwrap())
        .collect();
    all.try_into().unwrap()
}

/// `NAME.d`, a batch of one device.
fn of_device(path: &Path, name: &str) {
    let device = path.join(format!("{name}.d")).join("device");
    std::fs::create_dir_all(&device).unwrap();
    let from = path.join(name);
    if from.is_dir() {
        for entry in std::fs::read_dir(from).unwrap().map(Result::unwrap) {
            std::fs::copy(entry.path(), device.join(entry.file_name())).unwrap();
        }
    } else {
        std::fs::copy(from, device.join(name)).unwrap();
    }
}

/// What is no recording.
fn others(path: &Path, rows: &[Row]) {
    let write = |name: &str, text: &str| std::fs::write(path.join(name), text).unwrap();
    write("spec.toml", &spec(11, ""));
    write("limits.toml", "[accelerometer]\nintervals = 100\n");
    write(
        "own.toml",
        "[[effect]]\nname = \"gyro_swirl\"\nsensor = \"gyroscope\"\nx = \"k * fy * fz\"\nparameters = [{ name = \"k\", unit = \
         \"rad/s/(m/s^2)^2\", typical = 5e-6 }]\n",
    );
    let identity = "[[1, 0, 0], [0, 1, 0], [0, 0, 1]]";
    write(
        "imu.yaml",
        &format!(
            "accelerometers:\n  M: {identity}\ngyroscopes:\n  M: {identity}\n  A: {identity}\n  C_gyro_i: {identity}\n"
        ),
    );
    let mut parameters = String::new();
    for (name, value) in [
        ("CAL_ACC0_{}OFF", 0.1),
        ("CAL_ACC0_{}SCALE", 1.01),
        ("CAL_GYRO0_{}OFF", 0.01),
        ("INS_ACCOFFS_{}", 0.1),
        ("INS_ACCSCAL_{}", 1.01),
        ("INS_GYROFFS_{}", 0.01),
    ] {
        for axis in ["X", "Y", "Z"] {
            let _ = writeln!(parameters, "{},{value}", name.replace("{}", axis));
        }
    }
    write("all.params", &parameters);
    let triads = |from: usize| {
        let line = |r: &Row| format!("{} {} {} {}\n", r[0], r[from], r[from + 1], r[from + 2]);
        rows.iter().map(line).collect::<String>()
    };
    write("acc.txt", &triads(1));
    write("gyro.txt", &triads(4));
    let mut means = String::from("ax,ay,az\n");
    for k in 0..27 {
        let v = [k % 3, k / 3 % 3, k / 9].map(|c| f64::from(c) - 1.0);
        let size = v.iter().map(|c| c * c).sum::<f64>().sqrt();
        if size > 0.0 {
            let [x, y, z] = v.map(|c| 9.83 * c / size + 0.02);
            let _ = writeln!(means, "{x},{y},{z}");
        }
    }
    write("means.csv", &means);
}

/// What the program makes of them.
fn made(path: &Path) {
    let run = |call: &str| {
        let output = stillpoint(path, &call.split(' ').collect::<Vec<_>>());
        assert!(status(&output) < 2, "{call}: {}", stderr(&output));
        output
    };
    run("calibrate good.csv -o cal.json");
    run("calibrate good2.csv -o cal2.json");
    fleet(path);
    run("batch prior fleet -o prior.json");
    run("allan still.csv -o noise.json");
    run("batch good.csv.d -o parts");
    let cut = json(&run("segment good.csv --json"));
    let mut sections = String::from("t0,t1\n");
    for rest in cut["static"].as_array().unwrap() {
        let (from, to) = (rest["t0"].as_f64().unwrap(), rest["t1"].as_f64().unwrap());
        let _ = writeln!(sections, "{},{}", from + 0.5, to - 0.5);
    }
    std::fs::write(path.join("sections.csv"), sections).unwrap();
}

/// A batch of so many devices of one type that a prior can be made of them: `cal.json` with other numbers.
fn fleet(path: &Path) {
    let text = std::fs::read_to_string(path.join("cal.json")).unwrap();
    let mut calibration: Value = serde_json::from_str(&text).unwrap();
    for hash in ["numbers_sha256", "basis_sha256"] {
        calibration.as_object_mut().unwrap().remove(hash);
    }
    for device in 0..DEVICES {
        let mut own = calibration.clone();
        own["inputs"][0]["samples_sha256"] = format!("{device:064x}").into();
        let mut count = 0;
        for sensor in ["accelerometer", "gyroscope"] {
            let size = if sensor == "gyroscope" { 0.01 } else { 0.1 };
            for axis in 0..3 {
                let mut add = |entry: &mut Value, size: f64| {
                    count += 1;
                    let value = entry.as_f64().unwrap() + size * noise(97 * device + count);
                    *entry = value.into();
                };
                add(&mut own[sensor]["bias"][axis], size);
                for other in 0..3 {
                    if !own[sensor]["T_std"][axis][other].is_null() {
                        add(&mut own[sensor]["T"][axis][other], 5e-3);
                    }
                }
            }
        }
        let folder = path.join(format!("fleet/devices/{device}"));
        std::fs::create_dir_all(&folder).unwrap();
        std::fs::write(folder.join("cal.json"), own.to_string()).unwrap();
    }
}
