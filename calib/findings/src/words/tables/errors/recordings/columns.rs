//! Words of columns that are missing, or not understood.

use crate::kind::Kind;
use crate::remedy::{OptionName, Remedy};
use crate::words::entry::Entry;

pub(in super::super::super) const ENTRIES: &[Entry] = &[
    Entry::error(
        Kind::ColumnMissing,
        "the table has no column for {missing}",
        "export it too",
        Vec::new,
    ),
    Entry::error(
        Kind::NoSensorColumns,
        "the program finds no columns of an accelerometer or a gyroscope among {columns}",
        "name the columns t,ax,ay,az,gx,gy,gz (and temp for a temperature)",
        || {
            vec![Remedy::such_as(
                OptionName::Columns,
                "t=1,ax=2,ay=3,az=4,gx=5,gy=6,gz=7",
            )]
        },
    ),
    Entry::error(
        Kind::ColumnsAlike,
        "the program cannot tell which column is {role}: column {first} (`{first_name}`) or column {second} (`{second_name}`)",
        "",
        || vec![Remedy::such_as(OptionName::Columns, "ax=2")],
    ),
    Entry::error(
        Kind::ColumnForTwo,
        "{given}: column {column} for both {first} and {second}",
        "give each a column of its own",
        Vec::new,
    ),
    Entry::error(
        Kind::NoSuchColumn,
        "{role}={wanted}: no such column among {count}[; nearest: `{nearest}`]",
        "name a column that is there, by its name or its number",
        Vec::new,
    ),
    Entry::error(
        Kind::ColumnsUnclear,
        "the program cannot tell from the names of the columns which are the accelerometer's and which the gyroscope's. The columns {columns} may be theirs",
        "",
        || {
            vec![Remedy::such_as(
                OptionName::Columns,
                "t=1,ax=2,ay=3,az=4,gx=5,gy=6,gz=7",
            )]
        },
    ),
    Entry::error(
        Kind::SensorUnclear,
        "the names of the columns tell no {sensor}, but the columns {columns} change and are not used. If they hold the {sensor}, name them. If they do not, only one sensor was recorded",
        "",
        || vec![Remedy::OneSensor],
    ),
    Entry::error(
        Kind::SensorTwice,
        "the table has the columns of more than one {sensor}, and the program cannot tell which are meant. The further ones are {columns}",
        "",
        || vec![Remedy::such_as(OptionName::Columns, "ax=2,ay=3,az=4")],
    ),
    Entry::error(
        Kind::ColumnsWithoutGravity,
        "the columns {columns} are acceleration without gravity, and calibration needs it",
        "record the accelerometer with gravity (\"total\", \"raw\", \"uncalibrated\" or \"with g\")",
        || vec![Remedy::OneSensor],
    ),
    Entry::error(
        Kind::UnitRowUnknown,
        "a row of units under the header: `{cell}` in {column}: unknown unit; known: {known}",
        "correct or delete this row",
        Vec::new,
    ),
    Entry::error(
        Kind::UnitRowContradicts,
        "a row of units under the header: `{cell}` in {column}: not the unit that the header or another axis has",
        "correct or delete this row",
        Vec::new,
    ),
    Entry::error(
        Kind::CommaTwice,
        "the header has {names} names but the rows {width} cells: a comma is both separator and decimal mark, which cannot be undone",
        "export with points or with semicolons",
        Vec::new,
    ),
    Entry::error(
        Kind::HeaderWidth,
        "the header has {names:name} and the rows have {width:cell}, so that the program cannot tell which name is of which cell",
        "correct the header (perhaps two names lack a separator)",
        || {
            vec![Remedy::such_as(
                OptionName::Columns,
                "t=1,ax=2,ay=3,az=4,gx=5,gy=6,gz=7",
            )]
        },
    ),
    Entry::error(
        Kind::NoHeader,
        "the table has {width:column} without a header (a row of names), and the readings do not show which columns are which",
        "write the names above the rows, as in t,ax,ay,az,gx,gy,gz",
        || {
            vec![Remedy::such_as(
                OptionName::Columns,
                "t=1,ax=2,ay=3,az=4,gx=5,gy=6,gz=7",
            )]
        },
    ),
    Entry::error(
        Kind::NoHeaderNoForce,
        "the table has {width:column} without a header (a row of names). None shows gravity: all read the same at rest in every orientation, as a gyroscope does",
        "record the accelerometer too, whose readings at rest have the length of gravity",
        || {
            vec![Remedy::such_as(
                OptionName::Columns,
                "t=1,ax=2,ay=3,az=4,gx=5,gy=6,gz=7",
            )]
        },
    ),
    Entry::error(
        Kind::NoHeaderSlow,
        "the table has {width:column} without a header (a row of names). Column {slow} hardly changes beside the others, so it may be a temperature",
        "",
        || {
            vec![Remedy::such_as(
                OptionName::Columns,
                "t=1,ax=2,ay=3,az=4,gx=5,gy=6,gz=7,temp=8",
            )]
        },
    ),
    Entry::error(
        Kind::NoHeaderUndecided,
        "the table has {width:column} without a header (a row of names), and the readings do not show which are the accelerometer's",
        "write the names above the rows, as in t,ax,ay,az,gx,gy,gz",
        || {
            vec![Remedy::such_as(
                OptionName::Columns,
                "t=1,ax=2,ay=3,az=4,gx=5,gy=6,gz=7",
            )]
        },
    ),
    Entry::error(
        Kind::OtherSensor,
        "the file has no columns {columns}; are the two files swapped?",
        "check the names of the two files",
        Vec::new,
    ),
    Entry::error(
        Kind::OnlyTemperature,
        "the recording has no accelerometer and no gyroscope, only a temperature",
        "name a file with the sensors too",
        Vec::new,
    ),
    Entry::error(
        Kind::ColumnEntry,
        "`{entry}` is not of the form ROLE=COLUMN, such as ax=acc_x",
        "write it like this",
        Vec::new,
    ),
    Entry::error(
        Kind::ColumnRole,
        "`{role}` is no quantity that a column can hold; known: {known}",
        "choose one of these",
        Vec::new,
    ),
    Entry::error(
        Kind::ColumnTwice,
        "the columns name `{role}` twice",
        "leave one out",
        Vec::new,
    ),
    Entry::error(
        Kind::ColumnUnnamed,
        "`{entry}` names no column, as ax=acc_x or ax=2 does",
        "name the column behind `=`",
        Vec::new,
    ),
    Entry::error(
        Kind::NoStaticMeans,
        "the file has no rows of means of the readings at rest[, only a {found}]",
        "write a row with the means ax,ay,az for each placement",
        Vec::new,
    ),
    Entry::error(
        Kind::StaticMeansColumns,
        "the file of means at rest has the columns {columns}, where ax,ay,az are expected",
        "correct the names",
        Vec::new,
    ),
    Entry::error(
        Kind::StaticMeansWidth,
        "the file of means at rest has {width:column} without a header, and ax,ay,az are three",
        "write the names above the rows, as in ax,ay,az",
        Vec::new,
    ),
];
