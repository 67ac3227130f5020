//! Words of rows and cells that cannot be read.

use crate::kind::Kind;
use crate::remedy::{OptionName, Remedy};
use crate::words::entry::Entry;

pub(in super::super::super) const ENTRIES: &[Entry] = &[
    Entry::error(
        Kind::HeaderAgain,
        "the header of line {header_line} comes again: two tables are in one file",
        "split the file here",
        Vec::new,
    ),
    Entry::error(
        Kind::RowEmpty,
        "every cell of the sensors is empty in this row",
        "",
        || vec![Remedy::set_to(OptionName::Na, "drop")],
    ),
    Entry::error(
        Kind::RowRagged,
        "this row has {found} cells, {expected} expected",
        "",
        || vec![Remedy::set_to(OptionName::SkipBadRows, "20")],
    ),
    Entry::error(
        Kind::RowShort,
        "this row has {found} cells, column {column} expected",
        "correct the row",
        Vec::new,
    ),
    Entry::error(
        Kind::QuoteOverLines,
        "a quote is opened here and closed in line {end}: a cell with a line break, where a row is one line",
        "take the line breaks out of the cells, or leave the column out",
        Vec::new,
    ),
    Entry::error(
        Kind::QuoteOpen,
        "a quote is opened here and never closed",
        "close or delete the quote",
        Vec::new,
    ),
    Entry::error(
        Kind::NumberCut,
        "`{cell}` in {column}: the text ends here, within a number that has {digits} characters from its decimal mark on in every other row",
        "copy the file again, or delete this row",
        Vec::new,
    ),
    Entry::error(
        Kind::NumberMissing,
        "`{cell}` in {column} is no number but stands for a missing value",
        "",
        || vec![Remedy::set_to(OptionName::Na, "drop")],
    ),
    Entry::error(
        Kind::NumberNotFinite,
        "`{cell}` in {column} is not finite",
        "",
        || vec![Remedy::set_to(OptionName::Na, "drop")],
    ),
    Entry::error(
        Kind::ThousandsSeparators,
        "`{cell}` in {column} has thousands separators",
        "export the file without digit grouping",
        Vec::new,
    ),
    Entry::error(
        Kind::DecimalComma,
        "`{cell}` in {column} has a decimal comma, and the other numbers of the file have decimal points",
        "export the file with decimal points only",
        Vec::new,
    ),
    Entry::error(
        Kind::Hexadecimal,
        "`{cell}` in {column} is hexadecimal",
        "export in decimal notation",
        Vec::new,
    ),
    Entry::error(
        Kind::NumberAbsurd,
        "`{cell}` in {column}: nothing reads that: wrong column, wrong unit or damaged row",
        "delete the row, or name the right column",
        Vec::new,
    ),
    Entry::error(
        Kind::DateUnknown,
        "`{cell}` in {column} is not an ISO 8601 date (2026-11-21T03:04:05.123Z)",
        "",
        || {
            vec![Remedy::such_as(
                OptionName::TimeFormat,
                "%d.%m.%Y %H:%M:%S%.f",
            )]
        },
    ),
    Entry::error(
        Kind::DateOther,
        "`{cell}` in {column} does not fit the date format that was given",
        "",
        || {
            vec![Remedy::such_as(
                OptionName::TimeFormat,
                "%d.%m.%Y %H:%M:%S%.f",
            )]
        },
    ),
    Entry::error(
        Kind::NotANumber,
        "`{cell}` in {column} is not a number",
        "",
        || vec![Remedy::set_to(OptionName::SkipBadRows, "20")],
    ),
    Entry::error(
        Kind::NumberExpected,
        "`{cell}` in column {column}, a number expected",
        "correct the cell",
        Vec::new,
    ),
    Entry::error(
        Kind::RecordNotFinite,
        "record {record} of the log holds a number that is not finite",
        "",
        || vec![Remedy::set_to(OptionName::Na, "drop")],
    ),
];
