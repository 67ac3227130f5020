//! Files of tables, end to end: with the tests of the workspace, or `cargo test -p stillpoint --features parquet,hdf5,xlsx --test cli tables`.

#![cfg(all(feature = "parquet", feature = "hdf5", feature = "xlsx"))]

use std::fs;
use std::path::Path;

use crate::common::{folder, json, status, stderr, stillpoint};
use file_formats::make::{SheetCell, hdf5, workbook};

const NAMES: [&str; 7] = ["t", "ax", "ay", "az", "gx", "gy", "gz"];

/// The columns of a CSV with one clock.
fn columns(path: &Path) -> Vec<Vec<f64>> {
    let text = fs::read_to_string(path).unwrap();
    let mut lines = text.lines();
    assert_eq!(lines.next().unwrap(), NAMES.join(","));
    let mut columns = vec![Vec::new(); NAMES.len()];
    for line in lines {
        for (column, cell) in columns.iter_mut().zip(line.split(',')) {
            column.push(cell.parse().unwrap());
        }
    }
    columns
}

/// The parts of a calibration that the samples decide.
fn calibration(folder: &Path, file: &str) -> [serde_json::Value; 3] {
    let run = stillpoint(folder, &["calibrate", file, "--json"]);
    assert_eq!(status(&run), 0, "{file}: {}", stderr(&run));
    let mut document = json(&run);
    ["accelerometer", "gyroscope", "covariance"].map(|part| {
        let part = document[part].take();
        assert!(!part.is_null(), "{file}");
        part
    })
}

#[test]
fn tables_are_calibrated_as_the_csv_that_they_hold() {
    let (_keep, folder) = folder();
    let columns = columns(&folder.join("good.csv"));
    let converted = stillpoint(&folder, &["convert", "good.csv", "-o", "good.parquet"]);
    assert_eq!(status(&converted), 0, "{}", stderr(&converted));
    let shape = [columns[0].len() as u64];
    let sets = NAMES.iter().zip(&columns);
    let sets: Vec<_> = sets
        .map(|(name, values)| (*name, &shape[..], values.clone()))
        .collect();
    fs::write(folder.join("good.h5"), hdf5(&sets)).unwrap();
    let names = NAMES.map(|name| SheetCell::Words(name.to_owned())).to_vec();
    let row = |k: usize| columns.iter().map(|c| SheetCell::Number(c[k])).collect();
    let rows = (0..columns[0].len()).map(row);
    let rows = std::iter::once(names).chain(rows).collect();
    let book = workbook(&[("Samples", false, rows)]);
    fs::write(folder.join("good.xlsx"), book).unwrap();

    let expected = calibration(&folder, "good.csv");
    for file in ["good.parquet", "good.h5", "good.xlsx"] {
        assert_eq!(calibration(&folder, file), expected, "{file}");
    }
    // And back.
    let back = stillpoint(&folder, &["convert", "good.parquet", "-o", "back.csv"]);
    assert_eq!(status(&back), 0, "{}", stderr(&back));
    assert_eq!(
        fs::read_to_string(folder.join("back.csv")).unwrap(),
        fs::read_to_string(folder.join("good.csv")).unwrap()
    );
}

/// The parser panics at a column that begins before the file; that is told as every other damage is.
#[test]
fn damage_at_which_a_parser_gives_up_is_one_message() {
    let (_keep, folder) = folder();
    let converted = stillpoint(&folder, &["convert", "good.csv", "-o", "good.parquet"]);
    assert_eq!(status(&converted), 0, "{}", stderr(&converted));
    let mut bytes = fs::read(folder.join("good.parquet")).unwrap();
    // The first field with the first column's offset, 4, which becomes -4.
    let tail = bytes.len() - 8;
    let size = u32::from_le_bytes(*bytes[tail..].first_chunk().unwrap());
    let metadata = &mut bytes[tail - size as usize..tail];
    let at = metadata.windows(2).position(|w| w == [0x26, 8]).unwrap();
    metadata[at + 1] = 7;
    fs::write(folder.join("damaged.parquet"), bytes).unwrap();
    let run = stillpoint(&folder, &["calibrate", "damaged.parquet"]);
    assert_ne!(status(&run), 0);
    let told = stderr(&run);
    assert!(told.contains("gave up"), "{told}");
    assert!(!told.contains("panicked"), "{told}");
}
