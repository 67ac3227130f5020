//! Numbers and stamps that programs spell in their own way, respelt line by line before anything else looks at a text.

mod cells;
mod comma_stamp;
mod framed;
mod grouped;
mod lists;
mod packed_date;
mod respell;
mod sixteens;
mod stroke_names;
mod unit_cells;

pub(crate) use respell::Spelling;
pub(crate) use unit_cells::number_and_unit as number_with_unit;

/// Every way; what one respells the next one sees.
pub(crate) static SPELLINGS: [&Spelling; 8] = [
    &stroke_names::STROKE_NAMES,
    &sixteens::SIXTEENS,
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
    text.is_some_and(|text| number_with_unit(text).is_some())
}
