//! Cases 46, 49, 55, 56 and 60: what logs and data files hold that cannot be read.

use file_formats::make::{self, Packer};

use super::containers::{calibrate, imu, sensor};
use super::device::{HEADER, good, line};

/// An element of a MAT file.
fn element(kind: u32, bytes: &[u8]) -> Vec<u8> {
    let mut element = [kind, bytes.len() as u32].map(u32::to_le_bytes).concat();
    element.extend(bytes);
    element.resize(element.len().next_multiple_of(8), 0);
    element
}

#[test]
fn case_046_an_object_of_an_unknown_class_in_a_matlab_file_is_named_and_passed_over() {
    let rows = imu();
    let (accel, gyro) = (sensor(&rows, false, 1), sensor(&rows, true, 1));
    let mut file = make::mat(&[("acc", &accel), ("gyro", &gyro)]);
    let value = [
        element(6, &[13, 0, 0, 0, 0, 0, 0, 0]),
        element(5, &[1, 0, 0, 0, 1, 0, 0, 0]),
        element(1, b""),
        element(6, &7u32.to_le_bytes()),
    ]
    .concat();
    let object = [
        element(6, &[17, 0, 0, 0, 0, 0, 0, 0]),
        element(1, b"port"),
        element(1, b"MCOS"),
        element(1, b"serial"),
        element(14, &value),
    ]
    .concat();
    file.extend(element(14, &object));
    calibrate("a.mat", file, &[])
        .ends(0)
        .says(&["port", "class serial"]);
}

#[test]
fn case_049_an_hdf5_file_is_named_and_nothing_that_it_links_to_is_opened() {
    let mut file = b"\x89HDF\r\n\x1a\n".to_vec();
    file.extend([0; 64]);
    file.extend(b"/etc/passwd\0data");
    let words: &[&str] = match cfg!(feature = "hdf5") {
        true => &["a.h5: "],
        false => &["HDF5", "CSV", "--features hdf5"],
    };
    calibrate("a.h5", file, &[]).ends(3).says(words);
}

#[test]
fn case_055_messages_of_another_byte_order_are_refused_with_their_encapsulation() {
    let mut file = make::db3("/imu", &imu());
    let mut changed = 0;
    for at in 0..file.len() - 8 {
        // The encapsulation of CDR, little endian, before a stamp of 2023.
        if file[at..at + 4] == [0, 1, 0, 0] && file[at + 6..at + 8] == [0x53, 0x65] {
            file[at + 1] = 0;
            changed += 1;
        }
    }
    assert!(changed > 100, "{changed}");
    calibrate("a.db3", file, &[]).ends(3).says(&["big-endian"]);
}

#[test]
fn case_056_a_chunk_with_a_wrong_check_sum_is_left_out_and_named() {
    let rows = imu();
    let mut file = make::mcap(&[("/imu", &rows, [0.0; 2])], Packer::None);
    let at = file.len() / 2;
    file[at] ^= 1;
    calibrate("a.mcap", file, &[])
        .ends(3)
        .says(&["a.mcap", "byte ", "check sum", "leaves it out"]);
}

#[test]
fn case_060_rows_of_erased_memory_at_the_end_are_cut() {
    let rows = good();
    let mut text: String = rows.iter().map(|row| line(row) + "\n").collect();
    let last = rows.last().unwrap()[0];
    for k in 1..200 {
        text += &format!("{:.4},-1,-1,-1,-1,-1,-1\n", last + 0.01 * f64::from(k));
    }
    calibrate("a.csv", format!("{HEADER}\n{text}"), &[])
        .ends(0)
        .says(&["row", &(rows.len() + 2).to_string()]);
}
