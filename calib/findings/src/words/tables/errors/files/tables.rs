//! Words of errors: files of tables.

use crate::kind::Kind;
use crate::words::entry::Entry;

pub(in crate::words::tables) const ENTRIES: &[Entry] = &[
    Entry::error(
        Kind::NotInBuild,
        "this is {format}, which this build does not read",
        "",
        Vec::new,
    ),
    Entry::error(
        Kind::NotWrittenByBuild,
        "this build does not write {format}",
        "name a .csv file",
        Vec::new,
    ),
    Entry::error(
        Kind::JsonDamaged,
        "{reason}",
        "check that the JSON is complete",
        Vec::new,
    ),
    Entry::error(
        Kind::JsonWithoutTable,
        "JSON without a list of records or of numbers: it holds {listed}",
        "",
        Vec::new,
    ),
    Entry::error(
        Kind::ListsInRecords,
        "the JSON holds lists within its records, as `{name}`",
        "write a record per sample",
        Vec::new,
    ),
    Entry::error(
        Kind::ValueTooLong,
        "a value of more than {limit:byte}",
        "write a record per line",
        Vec::new,
    ),
    Entry::error(
        Kind::NameTooLong,
        "a name of {bytes:byte}, as no column has",
        "",
        Vec::new,
    ),
    Entry::error(
        Kind::NamesTooMany,
        "the records of the JSON have more than {limit} names, as no recording has",
        "",
        Vec::new,
    ),
    Entry::error(
        Kind::NamesMixed,
        "the JSON holds records with names and others without",
        "write all with names",
        Vec::new,
    ),
    Entry::error(
        Kind::TableGone,
        "the table `{table}` is not in the file any more: the file has changed",
        "",
        Vec::new,
    ),
    Entry::error(
        Kind::RowsBeyondClaim,
        "more rows than the {format} announces",
        "",
        Vec::new,
    ),
    Entry::error(
        Kind::ColumnsBeyondFile,
        "columns that together are longer than the {format}: it is damaged",
        "",
        Vec::new,
    ),
    Entry::error(
        Kind::ColumnCompressed,
        "its columns are compressed by {method}, which this build does not unpack",
        "write it with `compression=\"snappy\"`",
        Vec::new,
    ),
    Entry::error(
        Kind::CellsAreLists,
        "the column {column} has lists in its cells",
        "write a column per axis",
        Vec::new,
    ),
    Entry::error(
        Kind::NumberTypeUnread,
        "the column {column} has numbers of a type that is not read",
        "write it as double",
        Vec::new,
    ),
    Entry::error(
        Kind::TextsAsDifferences,
        "{what} holds texts as differences, which are not read",
        "write them as they are (in pyarrow: no `column_encoding`)",
        Vec::new,
    ),
    Entry::error(
        Kind::NoDataset,
        "no dataset of numbers with {least} rows or more: it holds {listed}",
        "",
        Vec::new,
    ),
    Entry::error(
        Kind::DatasetShape,
        "the dataset {dataset} has {shape} numbers, and only rows of columns are read",
        "",
        Vec::new,
    ),
    Entry::error(
        Kind::DatasetLength,
        "the dataset {dataset} has {count:number} where {expected} were expected",
        "",
        Vec::new,
    ),
    Entry::error(
        Kind::NoSheet,
        "a workbook without a sheet of cells",
        "",
        Vec::new,
    ),
    Entry::error(
        Kind::WordsTooMany,
        "{part} announces {words:word} in {bytes:byte}: the workbook is damaged",
        "",
        Vec::new,
    ),
    Entry::error(
        Kind::CellImpossible,
        "the cell {cell} stands where no cell can be: the workbook is damaged",
        "",
        Vec::new,
    ),
    Entry::error(
        Kind::CellTwice,
        "the cell {cell} is there twice: the workbook is damaged",
        "",
        Vec::new,
    ),
    Entry::error(
        Kind::CellIsDate,
        "the cell {cell} is a date or time of day",
        "format the column as numbers, in seconds, and save again",
        Vec::new,
    ),
];
