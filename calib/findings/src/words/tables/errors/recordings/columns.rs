//! Words of columns that are missing, or not understood.

use crate::kind::Kind;
use crate::remedy::{OptionName, Remedy};
use crate::words::entry::{Entry, error, error_by, error_with};

pub(in crate::words::tables) fn words(kind: Kind) -> Option<Entry> {
    Some(match kind {
        Kind::ColumnMissing => error("the table has no column for {missing}", "export it too"),
        Kind::FieldColumnsUnknown => error(
            "the program cannot tell which columns of {file} are those of the magnetometer",
            "call them t, mx, my and mz",
        ),
        Kind::NoSensorColumns => error_with(
            "the program recognises no columns of an accelerometer or a gyroscope among {columns}",
            "name the columns t,ax,ay,az,gx,gy,gz (and temp for a temperature)",
            vec![Remedy::such_as(
                OptionName::Columns,
                "t=1,ax=2,ay=3,az=4,gx=5,gy=6,gz=7",
            )],
        ),
        Kind::ColumnsAlike => error_by(
            "the program cannot tell which column is {role}: column {first} (`{first_name}`) or column {second} (`{second_name}`)",
            vec![Remedy::such_as(OptionName::Columns, "ax=2")],
        ),
        Kind::ColumnForTwo => error(
            "{given}: column {column} for both {first} and {second}",
            "give each a column of its own",
        ),
        Kind::NoSuchColumn => error(
            "{role}={wanted}: no such column among {count}[; nearest: `{nearest}`]",
            "name a column that is there, by its name or its number",
        ),
        Kind::ColumnsUnclear => error_by(
            "the program cannot tell from the names of the columns which are the accelerometer's and which the gyroscope's. The columns {columns} may be theirs",
            vec![Remedy::such_as(
                OptionName::Columns,
                "t=1,ax=2,ay=3,az=4,gx=5,gy=6,gz=7",
            )],
        ),
        Kind::SensorUnclear => error_by(
            "the names of the columns tell no {sensor}, but the columns {columns} change and are not used. If they hold the {sensor}, name them. If they do not, only one sensor was recorded",
            vec![Remedy::OneSensor],
        ),
        Kind::SensorTwice => error_by(
            "the table has the columns of more than one {sensor}, and the program cannot tell which are meant. The further ones are {columns}",
            vec![Remedy::such_as(OptionName::Columns, "ax=2,ay=3,az=4")],
        ),
        Kind::ColumnsWithoutGravity => error_with(
            "the columns {columns} are acceleration without gravity, and calibration needs it",
            "record the accelerometer with gravity (\"total\", \"raw\", \"uncalibrated\" or \"with g\")",
            vec![Remedy::OneSensor],
        ),
        Kind::UnitRowUnknown => error(
            "a row of units under the header: `{cell}` in {column}: unknown unit; known: {known}",
            "correct or delete this row",
        ),
        Kind::UnitRowContradicts => error(
            "a row of units under the header: `{cell}` in {column}: not the unit that the header or another axis has",
            "correct or delete this row",
        ),
        Kind::CommaTwice => error(
            "the header has {names} names but the rows {width} cells: a comma is both separator and decimal mark, which cannot be undone",
            "export with points or with semicolons",
        ),
        Kind::HeaderWidth => error_with(
            "the header has {names:name} and the rows have {width:cell}, so that the program cannot tell which name is of which cell",
            "correct the header (perhaps two names lack a separator)",
            vec![Remedy::such_as(
                OptionName::Columns,
                "t=1,ax=2,ay=3,az=4,gx=5,gy=6,gz=7",
            )],
        ),
        Kind::NoHeader => error_with(
            "the table has {width:column} without a header (a row of names), and the readings do not show which columns are which",
            "write the names above the rows, as in t,ax,ay,az,gx,gy,gz",
            vec![Remedy::such_as(
                OptionName::Columns,
                "t=1,ax=2,ay=3,az=4,gx=5,gy=6,gz=7",
            )],
        ),
        Kind::NoHeaderNoForce => error_with(
            "the table has {width:column} without a header (a row of names). None shows gravity: all read the same at rest in every orientation, as a gyroscope does",
            "record the accelerometer too, whose readings at rest have the length of gravity",
            vec![Remedy::such_as(
                OptionName::Columns,
                "t=1,ax=2,ay=3,az=4,gx=5,gy=6,gz=7",
            )],
        ),
        Kind::NoHeaderSlow => error_by(
            "the table has {width:column} without a header (a row of names). Column {slow} hardly changes beside the others, so it may be a temperature",
            vec![Remedy::such_as(
                OptionName::Columns,
                "t=1,ax=2,ay=3,az=4,gx=5,gy=6,gz=7,temp=8",
            )],
        ),
        Kind::NoHeaderUndecided => error_with(
            "the table has {width:column} without a header (a row of names), and the readings do not show which are the accelerometer's",
            "write the names above the rows, as in t,ax,ay,az,gx,gy,gz",
            vec![Remedy::such_as(
                OptionName::Columns,
                "t=1,ax=2,ay=3,az=4,gx=5,gy=6,gz=7",
            )],
        ),
        Kind::OtherSensor => error(
            "the file has no columns {columns}; are the two files swapped?",
            "check the names of the two files",
        ),
        Kind::OnlyTemperature => error(
            "the recording has no accelerometer and no gyroscope, only a temperature",
            "name a file with the sensors too",
        ),
        Kind::ColumnEntry => error(
            "`{entry}` is not of the form ROLE=COLUMN, such as ax=acc_x",
            "write it like this",
        ),
        Kind::ColumnRole => error(
            "`{role}` is no quantity that a column can hold; known: {known}",
            "choose one of these",
        ),
        Kind::ColumnTwice => error("the columns name `{role}` twice", "leave one out"),
        Kind::ColumnUnnamed => error(
            "`{entry}` names no column, as ax=acc_x or ax=2 does",
            "name the column behind `=`",
        ),
        Kind::NoStaticMeans => error(
            "the file has no rows of means of the readings at rest[, only a {found}]",
            "write a row with the means ax,ay,az for each placement",
        ),
        Kind::StaticMeansColumns => error(
            "the file of means at rest has the columns {columns}, where ax,ay,az are expected",
            "correct the names",
        ),
        Kind::StaticMeansWidth => error(
            "the file of means at rest has {width:column} without a header, and ax,ay,az are three",
            "write the names above the rows, as in ax,ay,az",
        ),
        _ => return None,
    })
}
