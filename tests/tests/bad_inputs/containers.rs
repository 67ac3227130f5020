//! Cases 36 to 60: archives, folders, and logs of other programs.

use file_formats::make::{self, ImuRow, Packer, Packing, Rows, zip};

use super::bench::{Bench, Run};
use super::device::{csv, good};

const STAMP: i64 = 1_700_000_000_000_000_000;

pub fn imu() -> Vec<ImuRow> {
    let row = |row: &super::device::Row| {
        let stamp = STAMP + (row[0] * 1e9).round() as i64;
        (stamp, [row[1], row[2], row[3]], [row[4], row[5], row[6]])
    };
    good().iter().map(row).collect()
}

/// One sensor's rows, every so many of them, from 20 s on.
pub fn sensor(rows: &[ImuRow], gyro: bool, every: usize) -> Rows {
    let part = |(stamp, force, rate): &ImuRow| {
        (
            stamp - STAMP + 20_000_000_000,
            if gyro { *rate } else { *force },
        )
    };
    rows.iter().step_by(every).map(part).collect()
}

fn phyphox(rows: &[ImuRow], gyro: bool, names: [&str; 4]) -> String {
    let quoted: Vec<String> = names.iter().map(|name| format!("\"{name}\"")).collect();
    let mut text = quoted.join(",") + "\n";
    for (stamp, v) in sensor(rows, gyro, 1) {
        text += &format!(
            "{:.9E},{:.9E},{:.9E},{:.9E}\n",
            stamp as f64 * 1e-9,
            v[0],
            v[1],
            v[2]
        );
    }
    text
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

pub fn tables() -> [String; 2] {
    let rows = imu();
    [phyphox(&rows, false, ACCEL), phyphox(&rows, true, GYRO)]
}

pub fn archive(extra: &[(&str, &[u8])]) -> Vec<u8> {
    let [accel, gyro] = tables();
    let mut entries: Vec<(&str, &[u8], Packing)> = vec![
        ("Accelerometer.csv", accel.as_bytes(), Packing::Deflated),
        ("Gyroscope.csv", gyro.as_bytes(), Packing::Deflated),
    ];
    entries.extend(
        extra
            .iter()
            .map(|(name, content)| (*name, *content, Packing::Stored)),
    );
    zip(&entries)
}

#[track_caller]
pub fn calibrate(name: &str, content: impl AsRef<[u8]>, options: &[&str]) -> Run {
    let bench = Bench::with(name, content);
    bench.run(&[&["calibrate", name, "-o", "cal.json"], options].concat())
}

/// Runs again with the option that the message proposes; it has to work.
#[track_caller]
fn as_advised(name: &str, content: &[u8], run: &Run) {
    let advice = run
        .stderr
        .rsplit("as in ")
        .next()
        .unwrap()
        .trim()
        .trim_matches('\'');
    let words: Vec<&str> = advice
        .split_whitespace()
        .map(|word| word.trim_matches('\''))
        .collect();
    calibrate(name, content, &words).ends(0);
}

#[test]
fn case_036_names_that_lead_out_of_an_archive_are_ignored() {
    let bench = Bench::with(
        "a.zip",
        archive(&[("../../evil.csv", b"x"), ("/tmp/evil.csv", b"x")]),
    );
    let run = bench.run(&["calibrate", "a.zip", "-o", "cal.json"]);
    run.ends(0)
        .says(&["evil.csv", "leaves"])
        .changes(&["cal.json"]);
}

#[test]
fn case_037_bombs_are_refused() {
    let zeros = vec![b'0'; 64 << 20];
    let bomb = zip(&[("Accelerometer.csv", &zeros, Packing::Deflated)]);
    calibrate("a.zip", &bomb, &[]).ends(3).says(&["1000 times"]);
    // Rows, then blocks of one byte that stands for 128 kB of blank lines.
    let rows = csv(&good()[..100]);
    let mut repeated = b"\x28\xb5\x2f\xfd\0\x58".to_vec();
    repeated.extend(&(rows.len() as u32 * 8).to_le_bytes()[..3]);
    repeated.extend(rows.as_bytes());
    (0..99).for_each(|_| repeated.extend([0x02, 0x00, 0x10, b'\n']));
    repeated.extend([0x03, 0x00, 0x10, b'\n']);
    calibrate("a.csv.zst", repeated, &[])
        .ends(3)
        .says(&["1000 times"]);
    let nested = zip(&[("inner.zip", &archive(&[]), Packing::Stored)]);
    calibrate("a.zip", nested, &[]).ends(3).says(&["inner.zip"]);
    let many: Vec<String> = (0..10_001).map(|k| format!("{k}.csv")).collect();
    let many: Vec<_> = many
        .iter()
        .map(|name| (name.as_str(), &b"1"[..], Packing::Stored))
        .collect();
    calibrate("a.zip", zip(&many), &[])
        .ends(3)
        .says(&["10000 entries"]);
}

#[test]
fn case_038_encrypted_archives_are_named_so() {
    let mut encrypted = archive(&[]);
    let header = encrypted
        .windows(4)
        .position(|w| w == b"PK\x01\x02")
        .unwrap();
    encrypted[header + 8] |= 1;
    calibrate("a.zip", encrypted, &[])
        .ends(3)
        .says(&["encrypted", "Accelerometer.csv"]);
}

#[test]
fn case_039_damaged_archives_name_the_entry() {
    let whole = archive(&[]);
    calibrate("a.zip", &whole[..whole.len() / 2], &[])
        .ends(3)
        .says(&["directory", "byte"]);
    let [accel, gyro] = tables();
    let mut wrong = zip(&[
        ("Accelerometer.csv", accel.as_bytes(), Packing::Stored),
        ("Gyroscope.csv", gyro.as_bytes(), Packing::Stored),
    ]);
    let at = 30 + 17 + accel.len() - 5;
    wrong[at] = b'7' + (wrong[at] == b'7') as u8;
    calibrate("a.zip", wrong, &[])
        .ends(3)
        .says(&["Accelerometer.csv", "CRC"]);
}

#[test]
fn case_040_two_recordings_in_an_archive_are_asked_about() {
    let text = csv(good());
    let two = zip(&[
        ("one.csv", text.as_bytes(), Packing::Deflated),
        ("two.csv", text.as_bytes(), Packing::Deflated),
    ]);
    let run = calibrate("a.zip", &two, &[]);
    run.ends(3)
        .says(&["2 recordings", "one.csv", "two.csv", "--entry"]);
    as_advised("a.zip", &two, &run);
}

#[test]
fn case_041_sensor_logger_without_gravity_names_what_to_switch_on() {
    let rows: String = imu()
        .iter()
        .map(|(t, f, _)| format!("{t},0.1,{},{},{}\n", f[2] * 1e-3, f[1] * 1e-3, f[0] * 1e-3))
        .collect();
    let table = format!("time,seconds_elapsed,z,y,x\n{rows}");
    let archive = zip(&[("Accelerometer.csv", table.as_bytes(), Packing::Deflated)]);
    calibrate("a.zip", archive, &[])
        .ends(3)
        .says(&["without gravity", "Total Acceleration"]);
}

#[test]
fn case_042_phyphox_without_g_names_the_experiment() {
    let linear = [
        "Time (s)",
        "Linear Acceleration x (m/s^2)",
        "Linear Acceleration y (m/s^2)",
        "Linear Acceleration z (m/s^2)",
    ];
    let [_, gyro] = tables();
    let archive = zip(&[
        (
            "Linear.csv",
            phyphox(&imu(), false, linear).as_bytes(),
            Packing::Deflated,
        ),
        ("Gyroscope.csv", gyro.as_bytes(), Packing::Deflated),
    ]);
    calibrate("a.zip", archive, &[])
        .ends(3)
        .says(&["gravity", "with g"]);
}

#[test]
fn case_043_phyphox_in_another_language_is_read_by_units() {
    let finnish = [
        "Aika (s)",
        "Kiihtyvyys x (m/s^2)",
        "Kiihtyvyys y (m/s^2)",
        "Kiihtyvyys z (m/s^2)",
    ];
    let [_, gyro] = tables();
    let archive = zip(&[
        (
            "Kiihtyvyys.csv",
            phyphox(&imu(), false, finnish).as_bytes(),
            Packing::Deflated,
        ),
        ("Gyroskooppi.csv", gyro.as_bytes(), Packing::Deflated),
    ]);
    calibrate("a.zip", archive, &[])
        .ends(0)
        .is_silent_on(&["gyroscope only", "accelerometer only"]);
    let text = phyphox(&imu(), false, finnish);
    calibrate("a.csv", text, &[])
        .ends(0)
        .says(&["by their units"]);
}

#[test]
fn case_044_a_workbook_is_to_be_saved_as_csv() {
    let workbook = zip(&[("xl/workbook.xml", b"<workbook/>", Packing::Deflated)]);
    let run = calibrate("a.xlsx", workbook, &[]);
    let words: &[&str] = match cfg!(feature = "xlsx") {
        true => &["a.xlsx: "],
        false => &["Excel", "CSV", "--features xlsx"],
    };
    run.ends(3).says(words);
}

#[test]
fn cases_045_and_047_matlab_files_are_read_or_listed() {
    let rows = imu();
    let (accel, gyro) = (sensor(&rows, false, 1), sensor(&rows, true, 1));
    calibrate("a.mat", make::mat(&[("acc", &accel), ("gyr", &gyro)]), &[]).ends(0);
    calibrate("a.mat", make::mat(&[("voltage", &accel)]), &[])
        .ends(3)
        .says(&["voltage (numbers", "no accelerometer"]);
    let mut v73 = b"MATLAB 7.3 MAT-file, Platform: GLNXA64".to_vec();
    v73.resize(600, 0);
    let words: &[&str] = match cfg!(feature = "hdf5") {
        true => &["a.mat: "],
        false => &["7.3", "save -v7", "--features hdf5"],
    };
    calibrate("a.mat", v73, &[]).ends(3).says(words);
}

#[test]
fn case_048_matlab_files_of_big_endian_machines_and_bombs_are_refused() {
    let rows = imu();
    let mut file = make::mat(&[("acc", &sensor(&rows, false, 1))]);
    file[126..128].copy_from_slice(b"MI");
    calibrate("a.mat", &file, &[]).ends(3).says(&["big-endian"]);
    let zeros: Rows = (0..400_000)
        .map(|k| (k * 1_000_000_000, [0.0; 3]))
        .collect();
    let mut bomb = make::mat(&[("acc", &zeros)]);
    bomb.truncate(200);
    calibrate("a.mat", &bomb, &[])
        .ends(3)
        .says(&["ends within a variable"]);
}

#[test]
fn case_050_a_bag_that_was_not_closed_is_read_as_far_as_it_goes() {
    let rows = imu();
    let half = make::bag(&[("/imu", &rows, [0.0; 2])], Packer::None);
    let mut two = half.clone();
    two.extend(&half[13..]);
    // The second half is cut within its chunk.
    two.truncate(half.len() + 5000);
    calibrate("a.bag", two, &[])
        .ends(0)
        .says(&["ends within a record", "byte"]);
    calibrate("b.bag", &half[..5000], &[])
        .ends(3)
        .says(&["ends within a record"]);
}

#[test]
fn case_051_a_bag_without_an_imu_lists_its_topics() {
    let empty = make::bag(&[("/imu", &[], [0.0; 2])], Packer::None);
    calibrate("a.bag", empty, &[])
        .ends(3)
        .says(&["/imu (sensor_msgs/Imu, 0 messages)"]);
}

#[test]
fn case_052_several_topics_are_asked_about() {
    let rows = imu();
    let file = make::mcap(
        &[("/left", &rows, [0.0; 2]), ("/right", &rows, [0.0; 2])],
        Packer::None,
    );
    let run = calibrate("a.mcap", &file, &[]);
    run.ends(3)
        .says(&["/left", "/right", "samples", "Hz", "--topic"]);
    as_advised("a.mcap", &file, &run);
    calibrate("a.mcap", &file, &["--topic", "/right"]).ends(0);
    calibrate("a.mcap", &file, &["--topic", "/none"])
        .ends(3)
        .says(&["/left"]);
}

#[test]
fn cases_053_and_054_a_topic_of_one_sensor_is_that_sensor() {
    let rows = imu();
    let file = make::mcap(
        &[
            ("/accel", &rows, [0.0, -1.0]),
            ("/gyro", &rows, [-1.0, 0.0]),
        ],
        Packer::Lz4,
    );
    calibrate("a.mcap", file, &[])
        .ends(0)
        .is_silent_on(&["gyroscope only", "accelerometer only"]);
    let none = make::mcap(&[("/imu", &rows, [-1.0, -1.0])], Packer::None);
    calibrate("a.mcap", none, &[])
        .ends(3)
        .says(&["no accelerometer", "/imu"]);
}

#[test]
fn case_057_a_px4_log_at_one_hertz_says_what_to_set() {
    let rows = imu();
    let (accel, gyro) = (sensor(&rows, false, 100), sensor(&rows, true, 100));
    let log = make::ulog(
        &[("sensor_accel", 0, &accel), ("sensor_gyro", 0, &gyro)],
        &[],
    );
    calibrate("a.ulg", log, &[])
        .ends(4)
        .says(&["1 Hz only", "SDLOG_PROFILE"]);
    let (accel, gyro) = (sensor(&rows, false, 1), sensor(&rows, true, 1));
    let log = make::ulog(
        &[
            ("sensor_accel", 0, &accel),
            ("sensor_accel", 1, &accel),
            ("sensor_gyro", 0, &gyro),
            ("sensor_gyro", 1, &gyro),
        ],
        &[],
    );
    let run = calibrate("a.ulg", &log, &[]);
    run.ends(3).says(&["2 accelerometers", "--instance 0"]);
    as_advised("a.ulg", &log, &run);
}

#[test]
fn cases_058_and_059_what_logs_lost_is_counted() {
    let rows = imu();
    let (accel, gyro) = (sensor(&rows, false, 1), sensor(&rows, true, 1));
    let log = make::ulog(
        &[("sensor_accel", 0, &accel), ("sensor_gyro", 0, &gyro)],
        &[],
    );
    calibrate("a.ulg", log, &[])
        .ends(0)
        .says(&["the log lost samples", "0.120 s"]);
    let mut log = make::ardupilot(&rows, &[]);
    let at = log.len() - 40;
    log.splice(at..at, [0u8; 4096]);
    calibrate("a.bin", log, &[])
        .ends(0)
        .says(&["4096 bytes", "byte"]);
}
