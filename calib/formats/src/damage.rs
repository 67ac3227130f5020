//! Files that are cut, changed or strange: read as far as they go or refused, never a panic.

use crate::make::{self, ImuRow, Packer, Rows};
use crate::{Content, Error, FORMATS, Limits, Quantity, Stream, Wanted, recognise};

fn rows() -> Vec<ImuRow> {
    let row = |k: i64| {
        (
            1_700_000_000_000_000_000 + k * 10_000_000,
            [0.1, k as f64, 9.8],
            [0.01, 0.02, k as f64],
        )
    };
    (0..20).map(row).collect()
}

fn one_sensor() -> Rows {
    (0..20)
        .map(|k| (k * 10_000_000, [0.1, k as f64, 9.8]))
        .collect()
}

/// A file of every format.
fn files() -> Vec<Vec<u8>> {
    let rows = rows();
    let topics: [(&str, &[ImuRow], [f64; 2]); 1] = [("/imu", &rows, [0.0; 2])];
    let sensor = one_sensor();
    let json: Vec<String> = sensor.iter().map(|(t, v)| format!("{{\"sensor\":\"TotalAcceleration\",\"time\":\"{t}\",\"x\":\"{}\",\"y\":\"{}\",\"z\":\"{}\"}}", v[0], v[1], v[2])).collect();
    vec![
        make::mcap(&topics, Packer::None),
        make::mcap(&topics, Packer::Lz4),
        make::mcap(&topics, Packer::Zstd),
        make::bag(&topics, Packer::None),
        make::db3("/imu", &rows),
        make::bag(&topics, Packer::Bz2),
        make::ulog(
            &[("sensor_accel", 0, &sensor), ("sensor_gyro", 0, &sensor)],
            &[("CAL_ACC0_XOFF", 0.1)],
        ),
        make::ardupilot(&rows, &[("INS_ACCOFFS_X", 0.1)]),
        make::mat(&[("acc", &sensor), ("gyro", &sensor)]),
        format!("[{}]", json.join(",")).into_bytes(),
    ]
}

/// Variables of 200 rows: a time, an accelerometer in one matrix, a gyroscope in three vectors.
fn apart() -> Vec<(&'static str, [usize; 2], Vec<f64>)> {
    let column = |first: f64| (0..200).map(move |k| first + 0.01 * f64::from(k));
    vec![
        ("t", [1, 200], column(0.0).collect()),
        (
            "acc",
            [200, 3],
            column(1.0).chain(column(2.0)).chain(column(3.0)).collect(),
        ),
        ("gx", [200, 1], column(4.0).collect()),
        ("gy", [200, 1], column(5.0).collect()),
        ("gz", [200, 1], column(6.0).collect()),
    ]
}

#[test]
fn variables_with_a_time_of_their_own_are_joined() {
    let content = read(&make::matrices_of(&apart())).unwrap().unwrap();
    // Fields of a structure are as variables.
    let of_structure = read(&make::structure_of("imu", &apart())).unwrap().unwrap();
    assert_eq!(of_structure.streams, content.streams);
    let found = |quantity| {
        let mut streams = content.streams.iter();
        streams.find(|stream| stream.quantity == quantity).unwrap()
    };
    let (accel, gyro) = (found(Quantity::SpecificForce), found(Quantity::AngularRate));
    assert_eq!((accel.values.len(), gyro.values.len()), (200, 200));
    assert_eq!(accel.stamps[7], 70_000_000);
    let near = |a: [f64; 3], b: [f64; 3]| (0..3).all(|axis| (a[axis] - b[axis]).abs() < 1e-12);
    assert!(
        near(accel.values[7], [1.07, 2.07, 3.07]),
        "{:?}",
        accel.values[7]
    );
    assert!(
        near(gyro.values[7], [4.07, 5.07, 6.07]),
        "{:?}",
        gyro.values[7]
    );
    // A row per quantity, as `[t; x; y; z]` is.
    let lying: Vec<f64> = (0..200)
        .flat_map(|k| [0.01 * f64::from(k), 1.0, 2.0, f64::from(k)])
        .collect();
    let content = read(&make::matrices_of(&[("acc", [4, 200], lying)]))
        .unwrap()
        .unwrap();
    assert_eq!(content.streams[0].values[9], [1.0, 2.0, 9.0]);
}

#[test]
fn matrices_without_a_time_are_asked_about() {
    let apart: Vec<_> = apart()
        .into_iter()
        .filter(|(name, ..)| *name != "t")
        .collect();
    let content = read(&make::matrices_of(&apart)).unwrap().unwrap();
    assert!(content.streams.is_empty());
    assert!(
        content.warnings.texts(findings::Front::CommandLine)[0].contains("`t`"),
        "{:?}",
        content.warnings
    );
}

#[test]
fn json_whose_only_accelerometer_lacks_gravity_is_refused() {
    let row = |sensor: &str, at: u32| {
        format!(
            "{{\"sensor\":\"{sensor}\",\"time\":\"{at}\",\"x\":\"0\",\"y\":\"0\",\"z\":\"{at}\"}}"
        )
    };
    let rows: Vec<String> = (1..9)
        .flat_map(|at| [row("Accelerometer", at), row("Gyroscope", at)])
        .collect();
    let error = read(format!("[{}]", rows.join(",")).as_bytes())
        .unwrap()
        .unwrap_err();
    assert!(error.to_string().contains("without gravity"), "{error}");
}

fn read(bytes: &[u8]) -> Option<Result<Content, Error>> {
    let limits = Limits {
        bytes: 16 << 20,
        rows: 1000,
        ..Limits::default()
    };
    let format = recognise(bytes)?;
    Some(format.read(&mut &bytes[..], &Wanted::default(), limits))
}

fn samples(content: &Content) -> usize {
    content
        .streams
        .iter()
        .map(|stream| stream.stamps.len())
        .sum()
}

fn accel(content: &Content) -> &Stream {
    let of = |stream: &&Stream| stream.quantity == Quantity::SpecificForce;
    content.streams.iter().find(of).unwrap()
}

#[test]
fn whole_files_of_every_format_give_every_sample() {
    for file in files() {
        let content = read(&file).unwrap().unwrap();
        let accel = accel(&content);
        assert_eq!(accel.stamps.len(), 20);
        assert_eq!(accel.stamps[1] - accel.stamps[0], 10_000_000);
        assert_eq!(content.cut, None);
    }
    // What is only known, to name its decoder, has no samples.
    let read = FORMATS
        .iter()
        .filter(|format| format.name != "blackbox")
        .count();
    assert_eq!(read, 7);
}

#[test]
fn a_file_that_is_cut_anywhere_is_read_up_to_there_or_refused() {
    for file in files() {
        let whole = samples(&read(&file).unwrap().unwrap());
        let mut most = 0;
        for length in 0..file.len() {
            if let Some(Ok(content)) = read(&file[..length]) {
                assert!(samples(&content) <= whole);
                most = most.max(samples(&content));
            }
        }
        // What is complete before the cut is not lost, but for the footer of a compressed piece.
        assert!(
            most == whole || most == 0 || most + 3 >= whole || 2 * most >= whole,
            "{most} of {whole}"
        );
    }
}

#[test]
fn a_changed_byte_is_noticed_or_harmless() {
    for file in files() {
        for at in 0..file.len() {
            for change in [0x01, 0x80, 0xff] {
                let mut changed = file.clone();
                changed[at] ^= change;
                let _ = read(&changed);
            }
        }
    }
}

#[test]
fn a_chunk_with_a_wrong_check_sum_is_left_out_and_told() {
    let rows = rows();
    let mut file = make::mcap(&[("/imu", &rows, [0.0; 2])], Packer::None);
    let at = file.len() - 200;
    file[at] ^= 1;
    let content = read(&file).unwrap().unwrap();
    assert_eq!(samples(&content), 0);
    assert!(
        content.warnings.texts(findings::Front::CommandLine)[0].contains("check sum"),
        "{:?}",
        content.warnings
    );
}

#[test]
fn a_matrix_with_a_wrong_check_sum_is_refused() {
    let mut file = make::mat(&[("acc", &one_sensor())]);
    let last = file.len() - 1;
    file[last] ^= 1;
    let error = read(&file).unwrap().unwrap_err().to_string();
    assert!(error.contains("damaged"), "{error}");
}

#[test]
fn what_a_topic_does_not_provide_is_no_stream_of_it() {
    let rows = rows();
    let file = make::mcap(&[("/imu", &rows, [0.0, -1.0])], Packer::None);
    let content = read(&file).unwrap().unwrap();
    let found: Vec<Quantity> = content.streams.iter().map(|s| s.quantity).collect();
    assert_eq!(found, [Quantity::SpecificForce]);
}

#[test]
fn big_endian_messages_are_refused_by_their_encapsulation() {
    let mut file = make::mcap(&[("/imu", &rows()[..1], [0.0; 2])], Packer::None);
    let at = file
        .windows(8)
        .position(|w| w == [0, 1, 0, 0, 0, 0xf1, 0x53, 0x65])
        .unwrap();
    file[at + 1] = 0;
    // A check sum of 0 says that there is none.
    let magic = 8 + 9 + 4 + 4 + 4 + 4;
    let crc = magic + 9 + 16 + 8;
    file[crc..crc + 4].fill(0);
    let error = read(&file).unwrap().unwrap_err().to_string();
    assert!(error.contains("big-endian"), "{error}");
}

#[test]
fn bytes_that_are_no_messages_of_a_dataflash_log_are_counted() {
    let mut file = make::ardupilot(&rows(), &[]);
    let at = file.len() - 3 * 40;
    file.splice(at..at, [0u8; 50]);
    let content = read(&file).unwrap().unwrap();
    assert!(
        content
            .warnings
            .texts(findings::Front::CommandLine)
            .iter()
            .any(|w| w.starts_with("50 bytes")),
        "{:?}",
        content.warnings
    );
    let accel = accel(&content);
    assert_eq!(accel.stamps.len(), 20);
}

#[test]
fn dropouts_of_a_log_are_told_with_their_time() {
    let content = read(&files()[6]).unwrap().unwrap();
    assert!(
        content
            .warnings
            .texts(findings::Front::CommandLine)
            .iter()
            .any(|w| w.contains("lost samples 1 time") && w.contains("0.120 s")),
        "{:?}",
        content.warnings
    );
}

/// Numbers by Marsaglia's xorshift, 2003.
struct Random(u64);

impl Random {
    fn below(&mut self, limit: usize) -> usize {
        self.0 ^= self.0 << 13;
        self.0 ^= self.0 >> 7;
        self.0 ^= self.0 << 17;
        (self.0 % limit.max(1) as u64) as usize
    }
}

/// One of the changes that find most: bytes of extremes, cuts, parts twice or not at all.
fn changed(file: &[u8], random: &mut Random) -> Vec<u8> {
    const EXTREMES: [u8; 6] = [0, 1, 0x7f, 0x80, 0xfe, 0xff];
    let mut bytes = file.to_vec();
    for _ in 0..=random.below(4) {
        let at = random.below(bytes.len());
        let end = (at + random.below(64)).min(bytes.len());
        match random.below(6) {
            0 if !bytes.is_empty() => bytes[at] ^= 1 << random.below(8),
            1 if !bytes.is_empty() => bytes[at] = EXTREMES[random.below(6)],
            2 => bytes[at..end].fill(EXTREMES[random.below(6)]),
            3 => bytes.truncate(at),
            4 => {
                let part = bytes[at..end].to_vec();
                bytes.splice(at..at, part);
            }
            _ => {
                bytes.drain(at..end);
            }
        }
    }
    bytes
}

/// `MUTATIONS=10000000 cargo test --release -p stillpoint-formats -- --ignored` is the run that a release asks for.
#[test]
#[ignore = "minutes to hours, by MUTATIONS"]
fn random_changes_of_every_format_never_panic() {
    let count = std::env::var("MUTATIONS")
        .ok()
        .and_then(|count| count.parse().ok());
    let count: u64 = count.unwrap_or(100_000);
    for (kind, file) in files().iter().enumerate() {
        let mut random = Random(0x9e37_79b9_7f4a_7c15 + kind as u64);
        let format = recognise(file).unwrap();
        let limits = Limits {
            bytes: 16 << 20,
            rows: 100_000,
            ..Limits::default()
        };
        let mut read = 0;
        for _ in 0..count {
            let bytes = changed(file, &mut random);
            read += u64::from(
                format
                    .read(&mut &bytes[..], &Wanted::default(), limits)
                    .is_ok(),
            );
        }
        println!(
            "{}: {count} changed files, {read} of them read",
            format.name
        );
    }
}
