//! Numbers and stamps that programs spell in their own way, respelt line by line before anything else looks at a text.

mod cells;
mod comma_stamp;
mod framed;
mod grouped;
mod lists;
mod packed_date;
mod respell;
mod unit_cells;

pub(crate) use respell::Spelling;

/// Every way; what one respells the next one sees.
pub(crate) static SPELLINGS: [&Spelling; 6] = [
    &framed::FRAMED,
    &lists::LISTS,
    &packed_date::PACKED_DATE,
    &comma_stamp::COMMA_STAMP,
    &unit_cells::UNIT_CELLS,
    &grouped::GROUPED,
];

/// True for a number with a unit behind it.
pub(crate) fn is_number_with_unit(cell: &[u8]) -> bool {
    let text = std::str::from_utf8(cell).ok();
    text.is_some_and(|text| unit_cells::number_and_unit(text).is_some())
}
