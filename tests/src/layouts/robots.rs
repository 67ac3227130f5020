//! Bags of robots, logs of flight controllers, MATLAB files.

use file_formats::make::{self, ImuRow, Packer, Rows};

use super::layout::{EPOCH, Layout, Samples};

fn file(name: &'static str, path: &'static str, bytes: Vec<u8>) -> Layout {
    Layout::new(name, vec![(path.to_owned(), bytes)], &[path])
}

fn rows(stream: &calib::recording::Stream, from: i64) -> Rows {
    let stamp = |t: &f64| from + (t * 1e9).round() as i64;
    stream
        .t
        .iter()
        .zip(&stream.values)
        .map(|(t, v)| (stamp(t), [v.x, v.y, v.z]))
        .collect()
}

pub(super) fn layouts(s: &Samples) -> Vec<Layout> {
    let epoch = EPOCH as i64 * 1_000_000_000;
    let together: Vec<ImuRow> = s
        .rows()
        .map(|(t, f, w)| (epoch + (t * 1e9).round() as i64, f.into(), w.into()))
        .collect();
    let provided = [0.0, 0.0];
    let imu: [(&str, &[ImuRow], [f64; 2]); 1] = [("/imu/data_raw", &together, provided)];
    let zero = [0.0; 3];
    let accel: Vec<ImuRow> = rows(&s.accel, epoch)
        .into_iter()
        .map(|(t, v)| (t, v, zero))
        .collect();
    let gyro: Vec<ImuRow> = rows(&s.gyro, epoch)
        .into_iter()
        .map(|(t, v)| (t, zero, v))
        .collect();
    let apart: [(&str, &[ImuRow], [f64; 2]); 2] = [
        ("/camera/accel/sample", &accel, provided),
        ("/camera/gyro/sample", &gyro, provided),
    ];
    let (accel, gyro) = (
        rows(&s.accel, 20_000_000_000),
        rows(&s.gyro, 20_000_000_000),
    );
    let corrected: Vec<ImuRow> = s
        .rows()
        .map(|(t, f, w)| {
            let force = [(f.x - 0.3) * 1.01, f.y, f.z];
            (
                80_000_000_000 + (t * 1e9).round() as i64,
                force,
                [w.x - 0.02, w.y, w.z],
            )
        })
        .collect();
    let parameters = [
        ("INS_ACCOFFS_X", 0.3),
        ("INS_ACCOFFS_Y", 0.0),
        ("INS_ACCOFFS_Z", 0.0),
        ("INS_ACCSCAL_X", 1.01),
        ("INS_ACCSCAL_Y", 1.0),
        ("INS_ACCSCAL_Z", 1.0),
        ("INS_GYROFFS_X", 0.02),
        ("INS_GYROFFS_Y", 0.0),
        ("INS_GYROFFS_Z", 0.0),
    ];
    let metadata = (
        "metadata.yaml".to_owned(),
        b"rosbag2_bagfile_information:\n  version: 9\n".to_vec(),
    );
    let mut folder = Layout::new(
        "ROS 2 bag, folder",
        vec![
            ("bag_0.mcap".to_owned(), make::mcap(&imu, Packer::None)),
            metadata,
        ],
        &["."],
    )
    .one_clock();
    folder.within = [1e-6; 3];
    let single = [1e-6, 2e-6, 2e-7];
    vec![
        file("ROS 1 bag", "imu.bag", make::bag(&imu, Packer::None)).one_clock(),
        file("ROS 1 bag, lz4", "imu.bag", make::bag(&imu, Packer::Lz4)).one_clock(),
        file("ROS 1 bag, bz2", "imu.bag", make::bag(&imu, Packer::Bz2)).one_clock(),
        file(
            "ROS 1 bag, a topic for each sensor",
            "imu.bag",
            make::bag(&apart, Packer::None),
        ),
        file("MCAP", "imu.mcap", make::mcap(&imu, Packer::None)).one_clock(),
        file("MCAP, lz4", "imu.mcap", make::mcap(&imu, Packer::Lz4)).one_clock(),
        file("MCAP, zstd", "imu.mcap", make::mcap(&imu, Packer::Zstd)).one_clock(),
        folder,
        file(
            "ROS 2 bag, db3",
            "bag_0.db3",
            make::db3("/imu/data_raw", &together),
        )
        .one_clock(),
        file(
            "PX4 log",
            "log.ulg",
            make::ulog(
                &[("sensor_accel", 0, &accel), ("sensor_gyro", 0, &gyro)],
                &[],
            ),
        )
        .within(single),
        file(
            "ArduPilot log",
            "log.BIN",
            make::ardupilot(&corrected, &parameters),
        )
        .one_clock()
        .within(single),
        file(
            "MATLAB matrices",
            "imu.mat",
            make::mat(&[("acc", &accel), ("gyro", &gyro)]),
        ),
    ]
}
