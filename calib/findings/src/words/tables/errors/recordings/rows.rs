//! Words of rows and cells that cannot be read.

use crate::kind::Kind;
use crate::remedy::{OptionName, Remedy};
use crate::words::entry::Entry;

pub(in super::super::super) const ENTRIES: &[Entry] = &[
    Entry::error(
        Kind::HeaderAgain,
        "the header of line {header_line} again: two tables in one file",
        "split it here",
        Vec::new,
    ),
    Entry::error(
        Kind::RowEmpty,
        "every cell of the sensors is empty",
        "",
        || vec![Remedy::set_to(OptionName::Na, "drop")],
    ),
    Entry::error(
        Kind::RowRagged,
        "{found} cells, {expected} expected",
        "",
        || vec![Remedy::set(OptionName::SkipBadRows)],
    ),
    Entry::error(
        Kind::RowShort,
        "{found} cells, column {column} expected",
        "",
        Vec::new,
    ),
    Entry::error(
        Kind::QuoteOverLines,
        "a quote is opened here and closed in line {end}: a cell with a line break, where a row is one line",
        "take its line breaks out, or the column",
        Vec::new,
    ),
    Entry::error(
        Kind::QuoteOpen,
        "a quote is opened here and never closed",
        "",
        Vec::new,
    ),
    Entry::error(
        Kind::NumberCut,
        "`{cell}` in {column}: the text ends here, within a number that has {digits} characters from its decimal mark on in every other row",
        "",
        Vec::new,
    ),
    Entry::error(
        Kind::NumberMissing,
        "`{cell}` in {column}: no number",
        "",
        || vec![Remedy::set_to(OptionName::Na, "drop")],
    ),
    Entry::error(
        Kind::NumberNotFinite,
        "`{cell}` in {column}: not finite",
        "",
        || vec![Remedy::set_to(OptionName::Na, "drop")],
    ),
    Entry::error(
        Kind::ThousandsSeparators,
        "`{cell}` in {column}: thousands separators",
        "export the file without digit grouping",
        Vec::new,
    ),
    Entry::error(
        Kind::DecimalComma,
        "`{cell}` in {column}: a comma as decimal mark in a file of points",
        "export with one decimal mark",
        Vec::new,
    ),
    Entry::error(
        Kind::Hexadecimal,
        "`{cell}` in {column}: hexadecimal",
        "export in decimal notation",
        Vec::new,
    ),
    Entry::error(
        Kind::NumberAbsurd,
        "`{cell}` in {column}: no sensor and no clock reads that; wrong column, or wrong unit?",
        "",
        Vec::new,
    ),
    Entry::error(
        Kind::DateUnknown,
        "`{cell}` in {column}: not an ISO 8601 date (2026-11-21T03:04:05.123Z)",
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
        "`{cell}` in {column}: not of the pattern that was given",
        "",
        || vec![Remedy::set(OptionName::TimeFormat)],
    ),
    Entry::error(
        Kind::NotANumber,
        "`{cell}` in {column}: not a number",
        "",
        || vec![Remedy::set(OptionName::SkipBadRows)],
    ),
    Entry::error(
        Kind::NumberExpected,
        "`{cell}` in column {column}, a number expected",
        "",
        Vec::new,
    ),
    Entry::error(
        Kind::RecordNotFinite,
        "record {record} holds a number that is not finite",
        "",
        || vec![Remedy::set_to(OptionName::Na, "drop")],
    ),
];
