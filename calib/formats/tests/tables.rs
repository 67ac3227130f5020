//! Files of tables as the texts that they would be. The readers are features of the build:
//! `cargo test -p stillpoint-formats --features parquet,hdf5,xlsx`.

#![allow(clippy::unwrap_used, clippy::expect_used, clippy::panic, missing_docs)]

use std::io::Read;

use stillpoint_formats::make::{SheetCell, hdf5, workbook};
use stillpoint_formats::{Container, Error, Limits, Tabular, write_parquet};

/// The names of the tables and their texts.
fn texts(format: &str, bytes: &[u8]) -> Result<Vec<(String, String)>, String> {
    let format = Tabular::by_name(format).unwrap();
    let words = |error: Error| error.to_string();
    let limits = Limits::default();
    let tables = Container::tables_in_memory(format, bytes.into(), limits).map_err(words)?;
    let text = |entry| {
        let mut text = String::new();
        let mut reader = tables.open(entry).map_err(words)?;
        reader
            .read_to_string(&mut text)
            .map_err(|e| e.to_string())?;
        Ok((entry.name.clone(), text))
    };
    tables.entries().iter().map(text).collect()
}

/// The numbers of a text below its names.
#[cfg(any(feature = "parquet", feature = "hdf5", feature = "xlsx"))]
fn numbers(text: &str) -> Vec<Vec<f64>> {
    let row = |line: &str| {
        let cells = line.split(',').map(|cell| cell.parse().unwrap_or(f64::NAN));
        cells.collect()
    };
    let rows = text.lines().skip(1).filter(|line| !line.is_empty());
    rows.map(row).collect()
}

const NAMES: [&str; 7] = ["t", "ax", "ay", "az", "gx", "gy", "gz"];

/// Rows of seven numbers that need all their digits.
fn rows() -> Vec<Vec<f64>> {
    let cell = |row: usize, column: usize| {
        (row as f64 * 0.01 + column as f64).sin() * 10_f64.powi(column as i32 - 3)
    };
    let row = |row| (0..7).map(|column| cell(row, column)).collect();
    (0..5000).map(row).collect()
}

fn columns() -> Vec<(String, Vec<f64>)> {
    let column = |at: usize| rows().iter().map(|row| row[at]).collect();
    let named = (0..7).map(|at| (NAMES[at].to_owned(), column(at)));
    named.collect()
}

fn vectors() -> Vec<u8> {
    let columns = columns();
    let shape = [columns[0].1.len() as u64];
    let sets = columns
        .iter()
        .map(|(name, values)| (name.as_str(), &shape[..], values.clone()));
    hdf5(&sets.collect::<Vec<_>>())
}

fn sheet(rows: &[Vec<f64>]) -> Vec<Vec<SheetCell>> {
    let names = NAMES.map(|name| SheetCell::Words(name.to_owned()));
    let numbers = rows
        .iter()
        .map(|row| row.iter().map(|v| SheetCell::Number(*v)).collect());
    [names.to_vec()].into_iter().chain(numbers).collect()
}

#[test]
fn a_file_of_tables_is_known_by_its_first_bytes() {
    let name = |head: &[u8]| Tabular::recognise(head).map(|format| format.name);
    assert_eq!(name(b"PAR1\x15"), Some("parquet"));
    assert_eq!(name(&vectors()), Some("hdf5"));
    assert_eq!(name(b"MATLAB 7.3 MAT-file, Platform"), Some("hdf5"));
    assert_eq!(name(b"MATLAB 5.0 MAT-file, Platform"), None);
    assert_eq!(name(b"PK\x03\x04"), None);
}

#[cfg(feature = "parquet")]
mod parquet {
    use super::*;

    #[test]
    fn what_is_written_is_read_to_the_last_digit() {
        let file = write_parquet(&columns()).unwrap();
        let [(name, text)] = &texts("parquet", &file).unwrap()[..] else {
            panic!("one table")
        };
        assert_eq!(name, "");
        assert_eq!(text.lines().next(), Some(&*NAMES.join(",")));
        assert_eq!(numbers(text), rows());
    }

    #[test]
    fn what_is_not_there_is_an_empty_cell() {
        let columns = [
            ("a, b".to_owned(), vec![1.0, f64::NAN]),
            ("c".to_owned(), vec![f64::NAN, 1e-9]),
        ];
        let file = write_parquet(&columns).unwrap();
        let [(_, text)] = &texts("parquet", &file).unwrap()[..] else {
            panic!("one table")
        };
        assert_eq!(text, "\"a, b\",c\n1.0,\n,1e-9\n");
    }

    #[test]
    fn more_rows_than_the_limit_are_refused() {
        let file = write_parquet(&columns()).unwrap();
        let limits = Limits {
            rows: 4999,
            ..Limits::default()
        };
        let format = Tabular::by_name("parquet").unwrap();
        let error = Container::tables_in_memory(format, file.into(), limits).unwrap_err();
        assert!(
            error
                .finding()
                .text(findings::Front::CommandLine)
                .contains("--max-rows"),
            "{error}"
        );
    }
}

#[cfg(feature = "hdf5")]
mod hdf5_files {
    use super::*;

    #[test]
    fn vectors_of_one_length_are_a_table() {
        let [(name, text)] = &texts("hdf5", &vectors()).unwrap()[..] else {
            panic!("one table")
        };
        assert_eq!(name, "");
        // In the order of their names.
        assert_eq!(text.lines().next(), Some("ax,ay,az,gx,gy,gz,t"));
        let ordered = |row: &Vec<f64>| [&row[1..], &row[..1]].concat();
        assert_eq!(
            numbers(text),
            rows().iter().map(ordered).collect::<Vec<_>>()
        );
    }

    /// MATLAB writes column after column, so that its dimensions come in the other order.
    #[test]
    fn matrices_of_matlab_are_triads() {
        let columns = columns();
        let rows = columns[0].1.len() as u64;
        let triad = |from: usize| columns[from..from + 3].iter().flat_map(|(_, v)| v.clone());
        let mut file = b"MATLAB 7.3 MAT-file, Platform: GLNXA64".to_vec();
        file.resize(512, 0);
        file.extend(hdf5(&[
            ("acc", &[3, rows], triad(1).collect()),
            ("gyro", &[3, rows], triad(4).collect()),
            ("t", &[1, rows], columns[0].1.clone()),
            ("settings", &[2], vec![1.0, 2.0]),
        ]));
        let [(_, text)] = &texts("hdf5", &file).unwrap()[..] else {
            panic!("one table")
        };
        let names = text.lines().next();
        assert_eq!(names, Some("acc_x,acc_y,acc_z,gyro_x,gyro_y,gyro_z,t"));
        let first = &numbers(text)[1234];
        let expected: Vec<f64> = (1..7).chain([0]).map(|at| columns[at].1[1234]).collect();
        assert_eq!(first, &expected);
    }

    #[test]
    fn sensors_of_unequal_length_are_tables_called_after_them() {
        let file = hdf5(&[
            ("t_acc", &[20], vec![0.0; 20]),
            ("acc", &[20, 3], vec![0.0; 60]),
            ("t_gyro", &[30], vec![0.0; 30]),
            ("gyro", &[30, 3], vec![0.0; 90]),
        ]);
        let tables = texts("hdf5", &file).unwrap();
        let names: Vec<&str> = tables.iter().map(|(name, _)| name.as_str()).collect();
        assert_eq!(names, ["acc", "gyro"]);
        assert_eq!(tables[1].1.lines().next(), Some("gyro_x,gyro_y,gyro_z,t"));
    }

    #[test]
    fn a_sensor_in_more_dimensions_is_refused_by_name() {
        let file = hdf5(&[("acc", &[20, 3, 3], vec![0.0; 180])]);
        let error = texts("hdf5", &file).unwrap_err();
        assert!(error.contains("acc"), "{error}");
        let file = hdf5(&[("voltage", &[2], vec![0.0; 2])]);
        let error = texts("hdf5", &file).unwrap_err();
        assert!(error.contains("it holds voltage"), "{error}");
    }
}

#[cfg(feature = "xlsx")]
mod workbooks {
    use super::*;

    #[test]
    fn a_line_is_a_row_of_the_sheet() {
        let file = workbook(&[("Raw", false, sheet(&rows())), ("Old", true, Vec::new())]);
        let [(name, text)] = &texts("xlsx", &file).unwrap()[..] else {
            panic!("one table")
        };
        assert_eq!(name, "Raw");
        assert_eq!(text.lines().next(), Some(&*NAMES.join(",")));
        assert_eq!(numbers(text), rows());
        let format = Tabular::by_name("xlsx").unwrap();
        let tables = Container::tables_in_memory(format, file.into(), Limits::default()).unwrap();
        assert!(
            tables.warnings.texts(findings::Front::CommandLine)[0].contains("Old"),
            "{:?}",
            tables.warnings
        );
    }

    #[test]
    fn a_date_among_numbers_is_refused_by_its_cell() {
        let words = |words: &str| SheetCell::Words(words.to_owned());
        let mut cells = vec![vec![words("made"), SheetCell::Date(45_000.5)], Vec::new()];
        cells.extend(sheet(&rows()[..4]));
        let file = workbook(&[("Raw", false, cells.clone())]);
        let text = &texts("xlsx", &file).unwrap()[0].1;
        assert!(text.starts_with("made,45000.5\n\nt,ax"), "{text}");
        cells[6][1] = SheetCell::Date(45_000.5);
        let error = texts("xlsx", &workbook(&[("Raw", false, cells)])).unwrap_err();
        assert!(
            error.contains("Raw!B7") && error.contains("seconds"),
            "{error}"
        );
    }

    #[test]
    fn an_entry_longer_than_it_says_is_refused() {
        let file = workbook(&[("Raw", false, sheet(&rows()[..4]))]);
        let mut damaged = file.clone();
        // The directory stands at the end; it says sizes.
        let at = file.windows(11).rposition(|w| w == b"xl/workbook").unwrap() - 46 + 24;
        damaged[at] ^= 1;
        assert!(texts("xlsx", &damaged).is_err());
    }
}

/// What small files may ask for, and how they are refused.
#[cfg(all(feature = "parquet", feature = "hdf5", feature = "xlsx"))]
mod claims {
    use super::*;
    use stillpoint_formats::make::{Packing, zip};

    /// A Parquet file with this schema and nothing else.
    fn with_schema(elements: usize, children: [u8; 5]) -> Vec<u8> {
        // Fields 1 (version), 2 (the schema, a list of structures with a name and a number of children).
        let mut metadata = vec![0x15, 2, 0x19, 0xfc];
        metadata.extend([0, 7, 14].map(|shift| (elements >> shift) as u8 & 0x7f | 0x80));
        metadata.push((elements >> 21) as u8);
        for _ in 0..elements {
            metadata.extend([0x48, 1, b'x', 0x15]);
            metadata.extend(children);
            metadata.push(0);
        }
        metadata.extend([0x16, 0, 0x19, 0x0c, 0]);
        let length = (metadata.len() as u32).to_le_bytes();
        [b"PAR1", &metadata[..], &length, b"PAR1"].concat()
    }

    #[test]
    fn a_schema_with_more_children_than_elements_is_refused() {
        let file = with_schema(1, [0xfe, 0xff, 0xff, 0xff, 0x0f]);
        let error = texts("parquet", &file).unwrap_err();
        assert!(error.contains("schema"), "{error}");
    }

    /// The parser would end the program by want of stack.
    #[test]
    fn a_schema_of_groups_within_groups_is_refused() {
        let file = with_schema(1 << 20, [0x82, 0x80, 0x80, 0x80, 0]);
        let error = texts("parquet", &file).unwrap_err();
        assert!(error.contains("schema"), "{error}");
    }

    /// The parser would end the program by want of memory.
    #[test]
    fn a_workbook_that_announces_more_words_than_it_has_is_refused() {
        let words = r#"<sst uniqueCount="99999999999999"><si><t>t</t></si></sst>"#;
        let wide: Vec<u8> = words.bytes().flat_map(|byte| [byte, 0]).collect();
        for (folder, words) in [("xl", words.as_bytes()), ("xl/worksheets", &wide)] {
            let beginning = format!(
                "<Relationships><Relationship Type=\"/relationships/officeDocument\" Target=\"{folder}/workbook.xml\"/></Relationships>"
            );
            let file = zip(&[
                ("_rels/.rels", beginning.as_bytes(), Packing::Deflated),
                (
                    &format!("{folder}/sharedStrings.xml"),
                    words,
                    Packing::Deflated,
                ),
            ]);
            let error = texts("xlsx", &file).unwrap_err();
            assert!(error.contains("99999999999999"), "{error}");
        }
    }
}

/// Every file with bytes changed or cut gives tables or an error, and comes to an end.
#[test]
fn damage_is_an_error_or_harmless() {
    let small: Vec<(String, Vec<f64>)> = columns()
        .into_iter()
        .map(|(name, values)| (name, values[..40].to_vec()))
        .collect();
    let sets: Vec<_> = small
        .iter()
        .map(|(name, values)| (name.as_str(), &[40][..], values.clone()))
        .collect();
    let mut files = vec![
        ("hdf5", hdf5(&sets)),
        ("xlsx", workbook(&[("Raw", false, sheet(&rows()[..40]))])),
    ];
    files.extend(write_parquet(&small).map(|file| ("parquet", file)));
    let mut state = 0x9e37_79b9_7f4a_7c15_u64;
    let mut random = move |below: usize| {
        state ^= state << 13;
        state ^= state >> 7;
        state ^= state << 17;
        state as usize % below
    };
    std::panic::set_hook(Box::new(|_| {}));
    for (format, file) in files {
        for _ in 0..300 {
            let mut bytes = file.clone();
            for _ in 0..=random(3) {
                let at = random(bytes.len());
                bytes[at] = [0, 0xff, bytes[at] ^ 1 << random(8)][random(3)];
            }
            if random(4) == 0 {
                bytes.truncate(random(bytes.len()));
            }
            // Whatever comes of it.
            let _ = texts(format, &bytes);
        }
    }
    let _ = std::panic::take_hook();
}
