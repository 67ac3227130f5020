//! Words of columns that are missing, or not understood.

use crate::kind::Kind;
use crate::remedy::Remedy;
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
        "the table has no accelerometer and no gyroscope columns among {columns}; expected t,ax,ay,az,gx,gy,gz, and temp if any",
        "",
        Vec::new,
    ),
    Entry::error(
        Kind::ColumnsAlike,
        "the columns {first} (`{first_name}`) and {second} (`{second_name}`) can both be {role}",
        "",
        Vec::new,
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
        "",
        Vec::new,
    ),
    Entry::error(
        Kind::ColumnsUnclear,
        "the names of the columns tell no accelerometer and no gyroscope, but the columns {columns} change and are not used",
        "",
        Vec::new,
    ),
    Entry::error(
        Kind::SensorUnclear,
        "the names of the columns tell no {sensor}, but the columns {columns} change and are not used: one of them may be it",
        "",
        || vec![Remedy::OneSensor],
    ),
    Entry::error(
        Kind::SensorTwice,
        "the table has more than one {sensor}: the columns {columns} are there as well",
        "",
        Vec::new,
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
        "the header has {names} names, the rows have {width} cells: are two names glued together?",
        "",
        Vec::new,
    ),
    Entry::error(
        Kind::NoHeader,
        "the table has {width} columns without a header, and gravity does not tell which are which",
        "",
        Vec::new,
    ),
    Entry::error(
        Kind::NoHeaderNoForce,
        "the table has {width} columns without a header, and all rest at one reading in all orientations, as a gyroscope does and no accelerometer",
        "",
        Vec::new,
    ),
    Entry::error(
        Kind::NoHeaderSlow,
        "the table has {width} columns without a header, of which {slow} hardly changes beside the others: a temperature?",
        "",
        Vec::new,
    ),
    Entry::error(
        Kind::NoHeaderUndecided,
        "the table has {width} columns without a header, and neither gravity nor what changes between rests tells which are the accelerometer's",
        "",
        Vec::new,
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
        "[{found} found, ]no rows of static means",
        "write one row ax,ay,az for each placement",
        Vec::new,
    ),
    Entry::error(
        Kind::StaticMeansColumns,
        "the file of static means has the columns {columns}, ax,ay,az expected",
        "correct the names",
        Vec::new,
    ),
    Entry::error(
        Kind::StaticMeansWidth,
        "the file of static means has {width} columns without a header, and ax,ay,az are three",
        "write the names above the rows, as in ax,ay,az",
        Vec::new,
    ),
];
