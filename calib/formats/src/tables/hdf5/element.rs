//! The numbers in an element of a dataset.

use std::fmt;

use hdf5_reader::error::{ByteOrder, Error as Hdf5Error};
use hdf5_reader::{Datatype, H5Type, dtype_element_size};

use super::super::rows::Cell;
use super::bounds::WIDEST;

/// An element of a dataset as cells: one number, or the numbers of a record.
#[derive(Clone, Debug)]
pub(super) struct Element(pub Vec<Cell>);

impl H5Type for Element {
    fn hdf5_type() -> Datatype {
        f64::hdf5_type()
    }

    fn from_bytes(bytes: &[u8], datatype: &Datatype) -> Result<Self, Hdf5Error> {
        let mut cells = Vec::with_capacity(1);
        add_cells(bytes, datatype, &mut cells)?;
        Ok(Self(cells))
    }

    fn element_size(datatype: &Datatype) -> usize {
        dtype_element_size(datatype).unwrap_or(1)
    }
}

/// Adds what `bytes` hold.
fn add_cells(bytes: &[u8], datatype: &Datatype, cells: &mut Vec<Cell>) -> Result<(), Hdf5Error> {
    let unread = |what: &dyn fmt::Debug| Hdf5Error::InvalidData(format!("type not read: {what:?}"));
    match datatype {
        Datatype::Compound { fields, .. } => {
            for field in fields {
                let at = field.byte_offset as usize;
                let rest = bytes.get(at..).unwrap_or_default();
                add_cells(rest, &field.datatype, cells)?;
            }
        }
        Datatype::Array { base, .. } => {
            let size = dtype_element_size(base)?;
            for at in 0..width_of(datatype) {
                let rest = bytes.get(at * size..).unwrap_or_default();
                add_cells(rest, base, cells)?;
            }
        }
        Datatype::Enum { base, .. } => add_cells(bytes, base, cells)?,
        Datatype::FixedPoint {
            size,
            signed,
            byte_order,
        } => {
            let mut wide = [0; 8];
            let size = usize::from(*size);
            let digits = bytes.get(..size).filter(|_| size <= 8);
            let digits = digits.ok_or_else(|| unread(datatype))?;
            for (to, from) in wide.iter_mut().zip(ordered(digits, *byte_order)) {
                *to = from;
            }
            // The sign of the shorter number goes on to the left.
            let unused = 8 * (8 - size.max(1)) as u32;
            let number = u64::from_le_bytes(wide);
            cells.push(match (signed, i64::try_from(number)) {
                (true, _) => Cell::Whole((number << unused) as i64 >> unused),
                (false, Ok(number)) => Cell::Whole(number),
                (false, Err(_)) => Cell::Unsigned(number),
            });
        }
        Datatype::FloatingPoint { size, byte_order } => {
            let digits = bytes.get(..usize::from(*size));
            let digits: Vec<u8> =
                ordered(digits.ok_or_else(|| unread(datatype))?, *byte_order).collect();
            cells.push(match (digits.first_chunk(), digits.first_chunk(), size) {
                (Some(digits), _, 4) => Cell::Single(f32::from_le_bytes(*digits)),
                (_, Some(digits), 8) => Cell::Double(f64::from_le_bytes(*digits)),
                _ => return Err(unread(datatype)),
            });
        }
        // Words beside numbers in a record.
        _ => cells.push(Cell::Text("text".to_owned())),
    }
    Ok(())
}

/// Bytes of a number, least first.
fn ordered(bytes: &[u8], order: ByteOrder) -> impl Iterator<Item = u8> + '_ {
    let last = bytes.len().saturating_sub(1);
    (0..bytes.len()).map(move |at| match order {
        ByteOrder::LittleEndian => bytes[at],
        ByteOrder::BigEndian => bytes[last - at],
    })
}

/// Numbers in an element, those of records within it too.
pub(super) fn numbers_in(datatype: &Datatype) -> u64 {
    match datatype {
        Datatype::Compound { fields, .. } => {
            let numbers = fields.iter().map(|field| numbers_in(&field.datatype));
            numbers.fold(0, u64::saturating_add)
        }
        Datatype::Array { base, dims } => dims
            .iter()
            .fold(numbers_in(base), |all, dim| all.saturating_mul(*dim)),
        _ => 1,
    }
}

/// Numbers in a field of a record.
pub(super) fn width_of(datatype: &Datatype) -> usize {
    match datatype {
        Datatype::Array { dims, .. } => dims
            .iter()
            .product::<u64>()
            .try_into()
            .unwrap_or(usize::MAX)
            .min(WIDEST as usize),
        _ => 1,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_of_arrays_within_arrays_multiply() {
        let mut datatype = f64::hdf5_type();
        for _ in 0..3 {
            datatype = Datatype::Array {
                base: Box::new(datatype),
                dims: vec![64],
            };
        }
        assert_eq!(numbers_in(&datatype), 64 * 64 * 64);
    }
}
