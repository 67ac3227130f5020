//! Words of rows and cells that cannot be read.

use crate::remedy::{OptionName, Remedy};
use crate::words::entry::{error, error_by};

kinds! {
    /// A header stands in a text again.
    HEADER_AGAIN = "header_again" => error(
        "the header of line {header_line} comes again: two tables are in one file",
        "split the file here",
    ),
    /// The names of a sensor's axes state different units.
    AXES_IN_UNITS = "axes_in_units" => error(
        "the axes of the {sensor} are in different units: {names}",
        "write the three in one unit",
    ),
    /// A header of other columns stands in a text.
    OTHER_HEADER = "other_header" => error(
        "the names of other columns ({names}) stand here below the header of line {header_line}: two tables are in one file",
        "split the file here",
    ),
    /// A row has no reading.
    ROW_EMPTY = "row_empty" => error_by(
        "every cell of the sensors is empty in this row",
        vec![Remedy::set_to(OptionName::Na, "drop")],
    ),
    /// A row has more or fewer cells than the others.
    ROW_RAGGED = "row_ragged" => error_by(
        "this row has {found} cells, {expected} expected",
        vec![Remedy::set_to(OptionName::SkipBadRows, "20")],
    ),
    /// A row ends before a column that is read.
    ROW_SHORT = "row_short" => error(
        "this row has {found} cells, column {column} expected",
        "correct the row",
    ),
    /// A cell goes on in the next line.
    QUOTE_OVER_LINES = "quote_over_lines" => error(
        "a quote is opened here and closed in line {end}: a cell with a line break, where a row is one line",
        "take the line breaks out of the cells, or leave the column out",
    ),
    /// A quote is never closed.
    QUOTE_OPEN = "quote_open" => error(
        "a quote is opened here and never closed",
        "close or delete the quote",
    ),
    /// A text ends within a number.
    NUMBER_CUT = "number_cut" => error(
        "`{cell}` in {column}: the text ends here, within a number that has {digits} characters from its decimal mark on in every other row",
        "copy the file again, or delete this row",
    ),
    /// A cell has no number.
    NUMBER_MISSING = "number_missing" => error_by(
        "`{cell}` in {column} is no number but stands for a missing value",
        vec![Remedy::set_to(OptionName::Na, "drop")],
    ),
    /// A number is not finite.
    NUMBER_NOT_FINITE = "number_not_finite" => error_by(
        "`{cell}` in {column} is not finite",
        vec![Remedy::set_to(OptionName::Na, "drop")],
    ),
    /// A number has separators of thousands.
    THOUSANDS_SEPARATORS = "thousands_separators" => error(
        "`{cell}` in {column} has thousands separators",
        "export the file without digit grouping",
    ),
    /// Points or commas separate thousands, and were read as decimal marks.
    THOUSANDS_BY_POINTS = "thousands_by_points" => error(
        "{axis} of the {sensor} has whole numbers below 1000, and from 1 on numbers with three decimals: {value} seems to be {thousands} with a separator of thousands",
        "export the file without digit grouping",
    ),
    /// A number has a unit behind it that is not the column's.
    UNIT_OF_CELL = "unit_of_cell" => error(
        "`{cell}` in {column} has a unit that is not that of the column",
        "write all numbers of the column in one unit, and that unit in its name",
    ),
    /// Numbers have lost their decimal points.
    POINTS_LOST = "points_lost" => error(
        "{axis} of the {sensor} is {value} beside {beside}: numbers have lost their decimal points, as in a spreadsheet that takes points for separators of thousands",
        "take the numbers from the file that the spreadsheet read, or tell it the decimal mark when it reads that file",
    ),
    /// A number has a comma in a file of points.
    DECIMAL_COMMA = "decimal_comma" => error(
        "`{cell}` in {column} has a decimal comma, and the other numbers of the file have decimal points",
        "export the file with decimal points only",
    ),
    /// A number is hexadecimal.
    HEXADECIMAL = "hexadecimal" => error(
        "`{cell}` in {column} is hexadecimal",
        "export in decimal notation",
    ),
    /// A number is too large for any sensor and clock.
    NUMBER_ABSURD = "number_absurd" => error(
        "`{cell}` in {column}: nothing reads that: wrong column, wrong unit or damaged row",
        "delete the row, or name the right column",
    ),
    /// A date is not ISO 8601.
    DATE_UNKNOWN = "date_unknown" => error_by(
        "`{cell}` in {column} is not an ISO 8601 date (2026-11-21T03:04:05.123Z)",
        vec![Remedy::such_as(
            OptionName::TimeFormat,
            "%d.%m.%Y %H:%M:%S%.f",
        )],
    ),
    /// A date is not of the pattern that was given.
    DATE_OTHER = "date_other" => error_by(
        "`{cell}` in {column} does not fit the date format that was given",
        vec![Remedy::such_as(
            OptionName::TimeFormat,
            "%d.%m.%Y %H:%M:%S%.f",
        )],
    ),
    /// A date is a month behind the one before it, and a day by the other order of day and month.
    DATE_OTHER_ORDER = "date_other_order" => error_by(
        "`{cell}` in {column} is a month or more behind the row before, and a day at most where the day and the month are in the other order",
        vec![Remedy::such_as(
            OptionName::TimeFormat,
            "%d/%m/%Y %H:%M:%S%.f",
        )],
    ),
    /// A cell is not a number.
    NOT_A_NUMBER = "not_a_number" => error_by(
        "`{cell}` in {column} is not a number",
        vec![Remedy::set_to(OptionName::SkipBadRows, "20")],
    ),
    /// A cell of a small table is not a number.
    NUMBER_EXPECTED = "number_expected" => error(
        "`{cell}` in column {column}, a number expected",
        "correct the cell",
    ),
    /// A record of a log holds a number that is not finite.
    RECORD_NOT_FINITE = "record_not_finite" => error_by(
        "record {record} of the log holds a number that is not finite",
        vec![Remedy::set_to(OptionName::Na, "drop")],
    ),
}
