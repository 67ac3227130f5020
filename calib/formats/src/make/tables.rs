//! Files of tables: a workbook, and HDF5 as its first version lays it out.

use std::fmt::Write as _;

use super::zip::{Packing, zip};

/// A cell of a sheet.
#[derive(Clone, Debug)]
pub enum SheetCell {
    /// A number.
    Number(f64),
    /// Words.
    Words(String),
    /// A date, days since 1900.
    Date(f64),
}

/// An Excel workbook; every sheet has a name, whether it is hidden, and rows.
pub fn workbook(sheets: &[(&str, bool, Vec<Vec<SheetCell>>)]) -> Vec<u8> {
    const MAIN: &str = "http://schemas.openxmlformats.org/spreadsheetml/2006/main";
    const OFFICE: &str = "http://schemas.openxmlformats.org/officeDocument/2006/relationships";
    const PACKAGE: &str = "http://schemas.openxmlformats.org/package/2006/relationships";
    let (mut listed, mut related) = (String::new(), String::new());
    let mut entries: Vec<(String, String)> = Vec::new();
    // Writing to a string does not fail.
    for (at, (name, hidden, rows)) in (1..).zip(sheets) {
        let state = if *hidden { " state=\"hidden\"" } else { "" };
        let _ = write!(
            listed,
            "<sheet name=\"{name}\" sheetId=\"{at}\"{state} r:id=\"rId{at}\"/>"
        );
        let _ = write!(
            related,
            "<Relationship Id=\"rId{at}\" Type=\"{OFFICE}/worksheet\" Target=\"worksheets/sheet{at}.xml\"/>"
        );
        let mut cells = String::new();
        for (row, found) in (1..).zip(rows) {
            let _ = write!(cells, "<row r=\"{row}\">");
            for (column, cell) in ('A'..='Z').zip(found) {
                let _ = match cell {
                    SheetCell::Number(v) => write!(cells, "<c r=\"{column}{row}\"><v>{v}</v></c>"),
                    SheetCell::Date(v) => {
                        write!(cells, "<c r=\"{column}{row}\" s=\"1\"><v>{v}</v></c>")
                    }
                    SheetCell::Words(v) => write!(
                        cells,
                        "<c r=\"{column}{row}\" t=\"inlineStr\"><is><t>{v}</t></is></c>"
                    ),
                };
            }
            cells.push_str("</row>");
        }
        entries.push((
            format!("xl/worksheets/sheet{at}.xml"),
            format!("<worksheet xmlns=\"{MAIN}\"><sheetData>{cells}</sheetData></worksheet>"),
        ));
    }
    // The second format of cells is that of dates.
    let styles = format!(
        "<styleSheet xmlns=\"{MAIN}\"><cellXfs><xf numFmtId=\"0\"/><xf numFmtId=\"22\"/></cellXfs></styleSheet>"
    );
    let _ = write!(
        related,
        "<Relationship Id=\"styles\" Type=\"{OFFICE}/styles\" Target=\"styles.xml\"/>"
    );
    entries.extend([
        (
            "_rels/.rels".to_owned(),
            format!("<Relationships xmlns=\"{PACKAGE}\"><Relationship Id=\"rId1\" Type=\"{OFFICE}/officeDocument\" Target=\"xl/workbook.xml\"/></Relationships>"),
        ),
        (
            "xl/workbook.xml".to_owned(),
            format!("<workbook xmlns=\"{MAIN}\" xmlns:r=\"{OFFICE}\"><sheets>{listed}</sheets></workbook>"),
        ),
        (
            "xl/_rels/workbook.xml.rels".to_owned(),
            format!("<Relationships xmlns=\"{PACKAGE}\">{related}</Relationships>"),
        ),
        ("xl/styles.xml".to_owned(), styles),
    ]);
    let entries: Vec<(&str, &[u8], Packing)> = entries
        .iter()
        .map(|(name, text)| (name.as_str(), text.as_bytes(), Packing::Deflated))
        .collect();
    zip(&entries)
}

const UNDEFINED: u64 = u64::MAX;

fn words(numbers: &[u64]) -> Vec<u8> {
    numbers.iter().flat_map(|n| n.to_le_bytes()).collect()
}

/// A message of an object header, version 1.
fn message(kind: u16, mut data: Vec<u8>) -> Vec<u8> {
    data.resize(data.len().next_multiple_of(8), 0);
    let mut bytes = kind.to_le_bytes().to_vec();
    bytes.extend((data.len() as u16).to_le_bytes());
    bytes.extend([0; 4]);
    bytes.extend(data);
    bytes
}

/// An object header, version 1.
fn header(messages: &[Vec<u8>]) -> Vec<u8> {
    let content = messages.concat();
    let mut bytes = vec![1, 0];
    bytes.extend((messages.len() as u16).to_le_bytes());
    bytes.extend(1_u32.to_le_bytes());
    bytes.extend((content.len() as u32).to_le_bytes());
    bytes.extend([0; 4]);
    bytes.extend(content);
    bytes
}

/// An HDF5 file of up to eight datasets of doubles: name, dimensions, numbers. "HDF5 File Format Specification", version
/// 3.0: superblock 0, symbol table, contiguous layout.
pub fn hdf5(datasets: &[(&str, &[u64], Vec<f64>)]) -> Vec<u8> {
    let mut datasets: Vec<_> = datasets.iter().collect();
    // A symbol table is in the order of its names.
    datasets.sort_by_key(|(name, ..)| *name);
    let (root, tree, symbols, heap) = (96_u64, 136_u64, 680_u64, 1008_u64);
    let mut names = vec![0; 8];
    let mut places = Vec::new();
    for (name, ..) in &datasets {
        places.push(names.len() as u64);
        names.extend(name.as_bytes());
        names.push(0);
        names.resize(names.len().next_multiple_of(8), 0);
    }
    let mut end = heap + 32 + names.len() as u64;
    let mut objects = Vec::new();
    let mut table = Vec::new();
    for ((_, shape, numbers), place) in datasets.iter().zip(&places) {
        let mut space = vec![1, shape.len() as u8, 0, 0, 0, 0, 0, 0];
        space.extend(words(shape));
        // Little endian, sign in bit 63, exponent 11 bits from 52 on, mantissa 52 bits, bias 1023.
        let kind = [
            0x11, 0x20, 0x3f, 0, 8, 0, 0, 0, 0, 0, 64, 0, 52, 11, 0, 52, 0xff, 3, 0, 0,
        ];
        let size = 8 * numbers.len() as u64;
        // The length of a header does not depend on the place of the data.
        let object = |data: u64| {
            let mut layout = vec![3, 1];
            layout.extend(words(&[data, size]));
            header(&[
                message(1, space.clone()),
                message(3, kind.to_vec()),
                message(8, layout),
            ])
        };
        let bytes = object(end + object(0).len() as u64);
        table.extend(words(&[*place, end, 0, 0, 0]));
        end += bytes.len() as u64 + size;
        objects.extend(bytes);
        objects.extend(numbers.iter().flat_map(|n| n.to_le_bytes()));
    }
    let mut file = b"\x89HDF\r\n\x1a\n\0\0\0\0\0\x08\x08\0\x04\0\x10\0\0\0\0\0".to_vec();
    file.extend(words(&[0, UNDEFINED, end, UNDEFINED]));
    file.extend(words(&[0, root, 1, tree, heap]));
    file.extend(header(&[message(17, words(&[tree, heap]))]));
    file.extend(b"TREE\0\0\x01\0");
    let last = places.last().copied().unwrap_or(0);
    file.extend(words(&[UNDEFINED, UNDEFINED, 0, symbols, last]));
    file.resize(symbols as usize, 0);
    file.extend(b"SNOD\x01\0");
    file.extend((datasets.len() as u16).to_le_bytes());
    file.extend(table);
    file.resize(heap as usize, 0);
    file.extend(b"HEAP\0\0\0\0");
    file.extend(words(&[names.len() as u64, 1, heap + 32]));
    file.extend(names);
    file.extend(objects);
    file
}
