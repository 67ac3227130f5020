//! Arrays of NumPy: a `.npy` file, or the `.npz` archive of several. Vectors of one length are the columns of a table, an array of
//! three columns is a triad of them, records and other arrays are tables of their own.

mod array;
mod literal;

use std::collections::BTreeMap;
use std::io::{Read, Write};

use findings::{Finding, Kind};

use self::array::{Array, SIGNATURE};
use super::reader::{Listed, Reader};
use super::rows;
use crate::container::archive::Archive;
use crate::error::counted;
use crate::shown::shown;
use crate::store::Store;
use crate::{Error, Limits};

/// `.npy` and `.npz`.
pub(super) const READER: Reader = Reader { tables, write };

/// Fewest rows of a table.
const FEWEST: u64 = 20;
/// Arrays of words that name the columns of the array beside them.
const NAMES: [&str; 5] = ["columns", "column_names", "names", "labels", "header"];

/// True for the first bytes of a `.npy` file.
pub(super) fn begins(head: &[u8]) -> bool {
    head.starts_with(SIGNATURE)
}

/// Arrays of as many rows.
struct Table {
    name: String,
    arrays: Vec<Array>,
}

fn tables(store: &Store, limits: Limits) -> Result<Listed, Error> {
    let (tables, others) = found(store, limits)?;
    if tables.is_empty() {
        let none = counted(Finding::of(Kind::NO_DATASET), "least", FEWEST);
        let called = |name: &String| match name.is_empty() {
            true => "one array".to_owned(),
            false => shown(name),
        };
        let others: Vec<String> = others.iter().take(12).map(called).collect();
        return Err(Error::refused(none.detail("listed", others.join(", "))));
    }
    Ok(Listed {
        names: tables.into_iter().map(|table| table.name).collect(),
        ..Listed::default()
    })
}

fn write(store: &Store, name: &str, limits: Limits, out: &mut dyn Write) -> Result<(), Error> {
    let (tables, _) = found(store, limits)?;
    let mut tables = tables.into_iter();
    let table = tables.find(|table| table.name == name).ok_or_else(|| {
        let gone = Finding::of(Kind::TABLE_GONE).detail("table", shown(name));
        Error::refused(gone)
    })?;
    let names: Option<Vec<Vec<String>>> = table.arrays.iter().map(Array::names).collect();
    if let Some(names) = names {
        out.write_all(rows::header(&names.concat()).as_bytes())?;
    }
    let count = table.arrays.first().map_or(0, |array| array.rows);
    rows::check(count, limits.rows)?;
    let (mut line, mut cells) = (String::new(), Vec::new());
    for row in 0..count {
        cells.clear();
        for array in &table.arrays {
            array.row(row, &mut cells);
        }
        rows::write(out, &mut line, cells.iter())?;
    }
    Ok(())
}

/// The tables of a file, and the arrays that make none.
fn found(store: &Store, limits: Limits) -> Result<(Vec<Table>, Vec<String>), Error> {
    let mut arrays = arrays(store, limits)?;
    // Words that name the columns of the only array as wide.
    let named = arrays.iter().find_map(|array| {
        let words = array.words()?;
        NAMES.contains(&array.name.as_str()).then_some(words)
    });
    if let Some(words) = named {
        let wide = |array: &&mut Array| array.width() == words.len() && array.words().is_none();
        let mut wide = arrays.iter_mut().filter(wide);
        if let (Some(array), None) = (wide.next(), wide.next()) {
            array.given = Some(words.clone());
        }
    }
    let (mut tables, mut others) = (Vec::new(), Vec::new());
    let mut together: BTreeMap<u64, Vec<Array>> = BTreeMap::new();
    for array in arrays {
        if !array.is_read() || array.rows < FEWEST {
            others.push(array.name);
        } else if array.is_record() || array.given.is_some() || !matches!(array.width(), 1 | 3) {
            let name = array.name.clone();
            tables.push(Table {
                name,
                arrays: vec![array],
            });
        } else {
            together.entry(array.rows).or_default().push(array);
        }
    }
    for (count, arrays) in together {
        if arrays.iter().map(Array::width).sum::<usize>() < 3 {
            others.extend(arrays.into_iter().map(|array| array.name));
            continue;
        }
        let mut triads = arrays.iter().filter(|array| array.width() == 3);
        let name = match (triads.next(), triads.next()) {
            // Stamps and one sensor's triad.
            (Some(triad), None) => triad.name.clone(),
            _ => format!("{count} rows"),
        };
        tables.push(Table { name, arrays });
    }
    if let [only] = &mut tables[..] {
        only.name = String::new();
    }
    Ok((tables, others))
}

/// The arrays of a file in the order of their names.
fn arrays(store: &Store, limits: Limits) -> Result<Vec<Array>, Error> {
    let mut file = store.open()?;
    let mut begin = [0; 4];
    let read = file.read(&mut begin)?;
    if &begin[..read] != b"PK\x03\x04" {
        let bytes = whole(begin[..read].chain(file), "the array", limits)?;
        return Ok(vec![Array::of("", bytes)?]);
    }
    let archive = Archive::open(store.clone(), limits)?;
    let mut left = limits;
    let mut arrays = Vec::new();
    for (name, packed) in &archive.entries {
        let Some(stem) = name.strip_suffix(".npy") else {
            continue;
        };
        let bytes = whole(archive.content(name, packed)?, name, left)?;
        left.bytes -= bytes.len() as u64;
        arrays.push(Array::of(stem, bytes)?);
    }
    Ok(arrays)
}

fn whole(content: impl Read, what: &str, limits: Limits) -> Result<Vec<u8>, Error> {
    let mut bytes = Vec::new();
    content
        .take(limits.bytes.saturating_add(1))
        .read_to_end(&mut bytes)?;
    match bytes.len() as u64 > limits.bytes {
        true => Err(limits.too_large(what)),
        false => Ok(bytes),
    }
}

#[cfg(test)]
mod tests {
    use std::sync::Arc;

    use super::*;

    /// An array with a header such as NumPy writes.
    fn npy(descr: &str, order: &str, shape: &str, data: &[u8]) -> Vec<u8> {
        let header =
            format!("{{'descr': {descr}, 'fortran_order': {order}, 'shape': {shape}, }}\n");
        let length = (header.len() as u16).to_le_bytes();
        [SIGNATURE, &[1, 0], &length, header.as_bytes(), data].concat()
    }

    fn text(bytes: Vec<u8>) -> Result<String, Error> {
        let store = Store::Memory(Arc::from(bytes));
        let limits = Limits::default();
        let listed = tables(&store, limits)?;
        let mut out = Vec::new();
        write(&store, &listed.names[0], limits, &mut out)?;
        Ok(String::from_utf8_lossy(&out).into_owned())
    }

    fn doubles(numbers: impl Iterator<Item = f64>) -> Vec<u8> {
        numbers.flat_map(f64::to_le_bytes).collect()
    }

    #[test]
    fn rows_and_columns_are_those_of_the_array_in_either_order() {
        let data = doubles((0..80).map(|k| f64::from(k) / 2.0));
        let rows = text(npy("'<f8'", "False", "(20, 4)", &data)).unwrap();
        assert_eq!(rows.lines().nth(1), Some("2.0,2.5,3.0,3.5"));
        let rows = text(npy("'<f8'", "True", "(20, 4)", &data)).unwrap();
        assert_eq!(rows.lines().nth(1), Some("0.5,10.5,20.5,30.5"));
        // Of a row per axis.
        let rows = text(npy("'<f8'", "False", "(4, 20)", &data)).unwrap();
        assert_eq!(rows.lines().nth(1), Some("0.5,10.5,20.5,30.5"));
        let integers: Vec<u8> = (0..60_i16).flat_map(i16::to_be_bytes).collect();
        let rows = text(npy("'>i2'", "False", "(20, 3)", &integers)).unwrap();
        assert_eq!(rows.lines().nth(19), Some("57,58,59"));
    }

    #[test]
    fn records_name_their_columns() {
        let record = |k: u8| [&[k, 0, 0, 0][..], &1.5_f32.to_le_bytes().repeat(3)].concat();
        let data: Vec<u8> = (0..20).flat_map(record).collect();
        let rows = text(npy(
            "[('t', '<i4'), ('acc', '<f4', (3,))]",
            "False",
            "(20,)",
            &data,
        ));
        let rows = rows.unwrap();
        assert_eq!(rows.lines().next(), Some("t,acc_x,acc_y,acc_z"));
        assert_eq!(rows.lines().nth(8), Some("7,1.5,1.5,1.5"));
    }

    #[test]
    fn what_is_no_array_of_numbers_is_refused() {
        let data = doubles((0..80).map(f64::from));
        for bytes in [
            npy("'|O'", "False", "(20, 4)", &data),
            npy("'<f8'", "False", "(20, 5)", &data),
            npy("'<f8'", "False", "(20, 99999999999999999999)", &data),
            npy("'<f8'", "False", "()", &data[..8]),
            npy("[('a', [('b', '<f8')])]", "False", "(20,)", &data),
            npy("'<f8'", "False", "(((((((((((((((((((((((((", &data),
            [SIGNATURE, &[1, 0, 255, 255, b'{']].concat(),
            SIGNATURE.to_vec(),
        ] {
            assert!(text(bytes).is_err());
        }
    }
}
