//! Bags of ROS 1 and MCAP files with `sensor_msgs/Imu`.

use std::io::Write;

use super::ImuRow;

/// Encoding of messages, by version of ROS.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Ros {
    /// Packed, with a sequence number.
    One,
    /// CDR.
    Two,
}

/// Compression of chunks.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Packer {
    /// Not compressed.
    None,
    /// lz4 frames.
    Lz4,
    /// bzip2.
    Bz2,
    /// zstd.
    Zstd,
}

impl Packer {
    fn name(self, none: &'static str) -> &'static str {
        match self {
            Self::None => none,
            Self::Lz4 => "lz4",
            Self::Bz2 => "bz2",
            Self::Zstd => "zstd",
        }
    }

    /// Writing to memory does not fail.
    fn pack(self, bytes: &[u8]) -> Vec<u8> {
        match self {
            Self::None => bytes.to_vec(),
            Self::Lz4 => {
                let mut encoder = lz4_flex::frame::FrameEncoder::new(Vec::new());
                let _ = encoder.write_all(bytes);
                encoder.finish().unwrap_or_default()
            }
            Self::Bz2 => {
                let mut encoder =
                    bzip2::write::BzEncoder::new(Vec::new(), bzip2::Compression::fast());
                let _ = encoder.write_all(bytes);
                encoder.finish().unwrap_or_default()
            }
            Self::Zstd => ruzstd::encoding::compress_to_vec(
                bytes,
                ruzstd::encoding::CompressionLevel::Fastest,
            ),
        }
    }
}

/// An Imu message; `provided` is the first entry of the covariances of force and rate.
pub(super) fn imu(ros: Ros, (stamp, force, rate): &ImuRow, provided: [f64; 2]) -> Vec<u8> {
    let mut message = Vec::new();
    match ros {
        Ros::One => message.extend(7u32.to_le_bytes()),
        Ros::Two => message.extend([0, 1, 0, 0]),
    }
    message.extend(((stamp / 1_000_000_000) as u32).to_le_bytes());
    message.extend(((stamp % 1_000_000_000) as u32).to_le_bytes());
    let frame: &[u8] = if ros == Ros::One {
        b"imu_link"
    } else {
        b"imu_link\0"
    };
    message.extend((frame.len() as u32).to_le_bytes());
    message.extend(frame);
    if ros == Ros::Two {
        let padded = 4 + (message.len() - 4).next_multiple_of(8);
        message.resize(padded, 0);
    }
    let mut numbers = vec![0.0, 0.0, 0.0, 1.0, -1.0];
    numbers.extend([0.0; 8]);
    for (vector, provided) in [(rate, provided[1]), (force, provided[0])] {
        numbers.extend(vector);
        numbers.push(provided);
        numbers.extend([0.0; 8]);
    }
    message.extend(numbers.iter().flat_map(|number: &f64| number.to_le_bytes()));
    message
}

fn record(op: u8, body: &[u8]) -> Vec<u8> {
    let mut record = vec![op];
    record.extend((body.len() as u64).to_le_bytes());
    record.extend(body);
    record
}

fn text(text: &str) -> Vec<u8> {
    let mut bytes = (text.len() as u32).to_le_bytes().to_vec();
    bytes.extend(text.as_bytes());
    bytes
}

/// An MCAP file with these topics: name, rows, and whether force and rate are provided (0) or not (-1).
pub fn mcap(topics: &[(&str, &[ImuRow], [f64; 2])], packer: Packer) -> Vec<u8> {
    let mut file = b"\x89MCAP0\r\n".to_vec();
    file.extend(record(1, &[text("ros2"), text("test")].concat()));
    let schema = [
        1u16.to_le_bytes().to_vec(),
        text("sensor_msgs/msg/Imu"),
        text("ros2msg"),
        text(""),
    ]
    .concat();
    let mut chunk = record(3, &schema);
    for (id, (name, rows, provided)) in (0u16..).zip(topics) {
        let channel = [
            id.to_le_bytes().to_vec(),
            1u16.to_le_bytes().to_vec(),
            text(name),
            text("cdr"),
            vec![0; 4],
        ];
        chunk.extend(record(4, &channel.concat()));
        for row in *rows {
            let mut message = id.to_le_bytes().to_vec();
            message.extend([0; 4]);
            message.extend((row.0 as u64 + 300_000).to_le_bytes());
            message.extend((row.0 as u64 + 300_000).to_le_bytes());
            message.extend(imu(Ros::Two, row, *provided));
            chunk.extend(record(5, &message));
        }
    }
    let mut crc = flate2::Crc::new();
    crc.update(&chunk);
    let packed = packer.pack(&chunk);
    let mut body = vec![0; 16];
    body.extend((chunk.len() as u64).to_le_bytes());
    body.extend(crc.sum().to_le_bytes());
    body.extend(text(packer.name("")));
    body.extend((packed.len() as u64).to_le_bytes());
    body.extend(packed);
    file.extend(record(6, &body));
    file.extend(record(15, &[0; 4]));
    file.extend(record(2, &[0; 20]));
    file.extend(b"\x89MCAP0\r\n");
    file
}

fn header(fields: &[(&str, &[u8])]) -> Vec<u8> {
    let mut bytes = Vec::new();
    for (name, value) in fields {
        bytes.extend(((name.len() + 1 + value.len()) as u32).to_le_bytes());
        bytes.extend(name.as_bytes());
        bytes.push(b'=');
        bytes.extend(*value);
    }
    bytes
}

fn bag_record(fields: &[(&str, &[u8])], data: &[u8]) -> Vec<u8> {
    let header = header(fields);
    let mut record = (header.len() as u32).to_le_bytes().to_vec();
    record.extend(header);
    record.extend((data.len() as u32).to_le_bytes());
    record.extend(data);
    record
}

/// A bag of ROS 1 with these topics, as those of [`mcap`].
pub fn bag(topics: &[(&str, &[ImuRow], [f64; 2])], packer: Packer) -> Vec<u8> {
    let mut file = b"#ROSBAG V2.0\n".to_vec();
    let zero = [0; 8];
    file.extend(bag_record(
        &[
            ("op", &[3]),
            ("index_pos", &zero),
            ("conn_count", &zero[..4]),
            ("chunk_count", &zero[..4]),
        ],
        &[b' '; 4000],
    ));
    let mut chunk = Vec::new();
    for (id, (name, rows, provided)) in (0u32..).zip(topics) {
        let id = id.to_le_bytes();
        let data = header(&[
            ("topic", name.as_bytes()),
            ("type", b"sensor_msgs/Imu"),
            ("md5sum", b"x"),
            ("message_definition", b"x"),
        ]);
        chunk.extend(bag_record(
            &[("op", &[7]), ("conn", &id), ("topic", name.as_bytes())],
            &data,
        ));
        for row in *rows {
            chunk.extend(bag_record(
                &[("op", &[2]), ("conn", &id), ("time", &zero)],
                &imu(Ros::One, row, *provided),
            ));
        }
    }
    let size = (chunk.len() as u32).to_le_bytes();
    let packed = packer.pack(&chunk);
    let method = packer.name("none");
    file.extend(bag_record(
        &[
            ("op", &[5]),
            ("compression", method.as_bytes()),
            ("size", &size),
        ],
        &packed,
    ));
    file
}
