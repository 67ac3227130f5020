//! Files that are cut, changed or strange: read as far as they go or refused, never a panic.

use crate::make::{self, ImuRow, Packer, Rows};
use crate::{Content, Error, FORMATS, Limits, Quantity, Wanted, recognise};

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

#[test]
fn whole_files_of_every_format_give_every_sample() {
    for file in files() {
        let content = read(&file).unwrap().unwrap();
        let accel = content
            .streams
            .iter()
            .find(|s| s.quantity == Quantity::SpecificForce)
            .unwrap();
        assert_eq!(accel.stamps.len(), 20);
        assert_eq!(accel.stamps[1] - accel.stamps[0], 10_000_000);
        assert_eq!(content.cut, None);
    }
    assert_eq!(FORMATS.len(), 6);
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
        content.warnings[0].contains("check sum"),
        "{:?}",
        content.warnings
    );
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
    assert!(error.contains("0x0000"), "{error}");
}

#[test]
fn bytes_that_are_no_messages_of_a_dataflash_log_are_counted() {
    let mut file = make::ardupilot(&rows(), &[]);
    let at = file.len() - 3 * 39;
    file.splice(at..at, [0u8; 50]);
    let content = read(&file).unwrap().unwrap();
    assert!(
        content.warnings.iter().any(|w| w.starts_with("50 bytes")),
        "{:?}",
        content.warnings
    );
    let accel = content
        .streams
        .iter()
        .find(|s| s.quantity == Quantity::SpecificForce)
        .unwrap();
    assert_eq!(accel.stamps.len(), 20);
}

#[test]
fn dropouts_of_a_log_are_told_with_their_time() {
    let content = read(&files()[5]).unwrap().unwrap();
    assert!(
        content
            .warnings
            .iter()
            .any(|w| w.contains("1 dropouts") && w.contains("0.120 s")),
        "{:?}",
        content.warnings
    );
}
