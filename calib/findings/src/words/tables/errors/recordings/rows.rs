//! Words of rows and cells that cannot be read.

use crate::kind::Kind;
use crate::remedy::{OptionName, Remedy};
use crate::words::entry::{Entry, error, error_by};

pub(in crate::words::tables) fn words(kind: Kind) -> Option<Entry> {
    Some(match kind {
        Kind::HeaderAgain => error(
            "the header of line {header_line} comes again: two tables are in one file",
            "split the file here",
        ),
        Kind::AxesInUnits => error(
            "the axes of the {sensor} are in different units: {names}",
            "write the three in one unit",
        ),
        Kind::OtherHeader => error(
            "the names of other columns ({names}) stand here below the header of line {header_line}: two tables are in one file",
            "split the file here",
        ),
        Kind::RowEmpty => error_by(
            "every cell of the sensors is empty in this row",
            vec![Remedy::set_to(OptionName::Na, "drop")],
        ),
        Kind::RowRagged => error_by(
            "this row has {found} cells, {expected} expected",
            vec![Remedy::set_to(OptionName::SkipBadRows, "20")],
        ),
        Kind::RowShort => error(
            "this row has {found} cells, column {column} expected",
            "correct the row",
        ),
        Kind::QuoteOverLines => error(
            "a quote is opened here and closed in line {end}: a cell with a line break, where a row is one line",
            "take the line breaks out of the cells, or leave the column out",
        ),
        Kind::QuoteOpen => error(
            "a quote is opened here and never closed",
            "close or delete the quote",
        ),
        Kind::NumberCut => error(
            "`{cell}` in {column}: the text ends here, within a number that has {digits} characters from its decimal mark on in every other row",
            "copy the file again, or delete this row",
        ),
        Kind::NumberMissing => error_by(
            "`{cell}` in {column} is no number but stands for a missing value",
            vec![Remedy::set_to(OptionName::Na, "drop")],
        ),
        Kind::NumberNotFinite => error_by(
            "`{cell}` in {column} is not finite",
            vec![Remedy::set_to(OptionName::Na, "drop")],
        ),
        Kind::ThousandsSeparators => error(
            "`{cell}` in {column} has thousands separators",
            "export the file without digit grouping",
        ),
        Kind::ThousandsByPoints => error(
            "{axis} of the {sensor} has whole numbers below 1000, and from 1 on numbers with three decimals: {value} seems to be {thousands} with a separator of thousands",
            "export the file without digit grouping",
        ),
        Kind::UnitOfCell => error(
            "`{cell}` in {column} has a unit that is not that of the column",
            "write all numbers of the column in one unit, and that unit in its name",
        ),
        Kind::PointsLost => error(
            "{axis} of the {sensor} is {value} beside {beside}: numbers have lost their decimal points, as in a spreadsheet that takes points for separators of thousands",
            "take the numbers from the file that the spreadsheet read, or tell it the decimal mark when it reads that file",
        ),
        Kind::DecimalComma => error(
            "`{cell}` in {column} has a decimal comma, and the other numbers of the file have decimal points",
            "export the file with decimal points only",
        ),
        Kind::Hexadecimal => error(
            "`{cell}` in {column} is hexadecimal",
            "export in decimal notation",
        ),
        Kind::NumberAbsurd => error(
            "`{cell}` in {column}: nothing reads that: wrong column, wrong unit or damaged row",
            "delete the row, or name the right column",
        ),
        Kind::DateUnknown => error_by(
            "`{cell}` in {column} is not an ISO 8601 date (2026-11-21T03:04:05.123Z)",
            vec![Remedy::such_as(
                OptionName::TimeFormat,
                "%d.%m.%Y %H:%M:%S%.f",
            )],
        ),
        Kind::DateOther => error_by(
            "`{cell}` in {column} does not fit the date format that was given",
            vec![Remedy::such_as(
                OptionName::TimeFormat,
                "%d.%m.%Y %H:%M:%S%.f",
            )],
        ),
        Kind::DateOtherOrder => error_by(
            "`{cell}` in {column} is a month or more behind the row before, and a day at most where the day and the month are in the other order",
            vec![Remedy::such_as(
                OptionName::TimeFormat,
                "%d/%m/%Y %H:%M:%S%.f",
            )],
        ),
        Kind::NotANumber => error_by(
            "`{cell}` in {column} is not a number",
            vec![Remedy::set_to(OptionName::SkipBadRows, "20")],
        ),
        Kind::NumberExpected => error(
            "`{cell}` in column {column}, a number expected",
            "correct the cell",
        ),
        Kind::RecordNotFinite => error_by(
            "record {record} of the log holds a number that is not finite",
            vec![Remedy::set_to(OptionName::Na, "drop")],
        ),
        _ => return None,
    })
}
