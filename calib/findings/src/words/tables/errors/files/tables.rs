//! Words of errors: files of tables.

use crate::kind::Kind;
use crate::remedy::Remedy;
use crate::words::entry::Entry;

pub(in crate::words::tables) const ENTRIES: &[Entry] = &[
    Entry::error(
        Kind::NotInBuild,
        "this is {format}, which this build of the program does not read",
        "",
        || {
            vec![Remedy::ExportAs {
                format: "CSV".into(),
            }]
        },
    ),
    Entry::error(
        Kind::NotWrittenByBuild,
        "this build does not write {format}",
        "name a .csv file",
        Vec::new,
    ),
    Entry::error(
        Kind::JsonDamaged,
        "the JSON cannot be read: {reason}",
        "check that the JSON is complete",
        Vec::new,
    ),
    Entry::error(
        Kind::JsonWithoutTable,
        "the JSON holds no list of records or of numbers: it holds {listed}",
        "write a list of records, one per sample",
        Vec::new,
    ),
    Entry::error(
        Kind::ListsInRecords,
        "the JSON holds lists within its records, as `{name}`",
        "write a record for each sample, in which each name has one number",
        Vec::new,
    ),
    Entry::error(
        Kind::ValueTooLong,
        "the JSON has a value of more than {limit:byte}",
        "write a record per line",
        Vec::new,
    ),
    Entry::error(
        Kind::NameTooLong,
        "the JSON has a name of {bytes:byte}, as no column has",
        "name another file, or shorten the name",
        Vec::new,
    ),
    Entry::error(
        Kind::NamesTooMany,
        "the records of the JSON have more than {limit} names, as no recording has",
        "write the same names in every record",
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
        "wait until the file is complete and try again",
        Vec::new,
    ),
    Entry::error(
        Kind::RowsBeyondClaim,
        "the {format} is damaged: it has more rows than it announces",
        "copy or export the file again",
        Vec::new,
    ),
    Entry::error(
        Kind::ColumnsBeyondFile,
        "the {format} is damaged: its columns together are longer than it",
        "copy or export the file again",
        Vec::new,
    ),
    Entry::error(
        Kind::ColumnCompressed,
        "the columns of the file are compressed by {method}, which this build of the program does not unpack",
        "write the file again with `compression=\"snappy\"` (as pandas and pyarrow take it)",
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
        "the column {column} has numbers of a type that the program does not read",
        "write it as double",
        Vec::new,
    ),
    Entry::error(
        Kind::TextsAsDifferences,
        "{what} holds texts as differences (delta encoding), which the program does not read",
        "write them as they are (in pyarrow: no `column_encoding`)",
        Vec::new,
    ),
    Entry::error(
        Kind::NoDataset,
        "the file has no dataset of numbers with {least} rows or more: it holds {listed}",
        "write the samples as one dataset per sensor",
        Vec::new,
    ),
    Entry::error(
        Kind::DatasetShape,
        "the dataset {dataset} has {shape} numbers, and the program reads only rows of columns",
        "write it with a row per sample and a column per axis",
        Vec::new,
    ),
    Entry::error(
        Kind::DatasetLength,
        "the dataset {dataset} has {count:number} where {expected} were expected",
        "write the datasets of a sensor with equal lengths",
        Vec::new,
    ),
    Entry::error(
        Kind::NoSheet,
        "the workbook has no visible sheet with cells",
        "",
        || vec![Remedy::SaveAsCsv],
    ),
    Entry::error(
        Kind::WordsTooMany,
        "the workbook is damaged: its part {part} claims to hold {words:word} in {bytes:byte}, which cannot be",
        "open it in a spreadsheet program and save it again",
        || vec![Remedy::SaveAsCsv],
    ),
    Entry::error(
        Kind::CellImpossible,
        "the workbook is damaged: the cell {cell} is out of order or outside of any sheet",
        "open it in a spreadsheet program and save it again",
        || vec![Remedy::SaveAsCsv],
    ),
    Entry::error(
        Kind::CellTwice,
        "the workbook is damaged: it has the cell {cell} twice",
        "open it in a spreadsheet program and save it again",
        || vec![Remedy::SaveAsCsv],
    ),
    Entry::error(
        Kind::CellIsDate,
        "the cell {cell} is a date or time of day",
        "format the column as numbers, in seconds, and save again",
        Vec::new,
    ),
];
