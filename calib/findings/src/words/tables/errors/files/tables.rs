//! Words of errors: files of tables.

use crate::kind::Kind;
use crate::remedy::Remedy;
use crate::words::entry::{Entry, error, error_by, error_with};

pub(in crate::words::tables) fn words(kind: Kind) -> Option<Entry> {
    Some(match kind {
        Kind::NotInBuild => error_by(
            "this is {format}, which this build of the program does not read",
            vec![Remedy::ExportAs {
                format: "CSV".into(),
            }],
        ),
        Kind::NotWrittenByBuild => error("this build does not write {format}", "name a .csv file"),
        Kind::JsonDamaged => error(
            "the JSON cannot be read: {reason}",
            "check that the JSON is complete",
        ),
        Kind::JsonWithoutTable => error(
            "the JSON holds no list of records or of numbers: it holds {listed}",
            "write a list of records, one per sample",
        ),
        Kind::ListsInRecords => error(
            "the JSON holds lists within its records, as `{name}`",
            "write a record for each sample, in which each name has one number",
        ),
        Kind::ValueTooLong => error(
            "the JSON has a value of more than {limit:byte}",
            "write a record per line",
        ),
        Kind::NameTooLong => error(
            "the JSON has a name of {bytes:byte}, as no column has",
            "name another file, or shorten the name",
        ),
        Kind::NamesTooMany => error(
            "the records of the JSON have more than {limit} names, as no recording has",
            "write the same names in every record",
        ),
        Kind::NamesMixed => error(
            "the JSON holds records with names and others without",
            "write all with names",
        ),
        Kind::TableGone => error(
            "the table `{table}` is not in the file any more: the file has changed",
            "wait until the file is complete and try again",
        ),
        Kind::RowsBeyondClaim => error(
            "the {format} is damaged: it has more rows than it announces",
            "copy or export the file again",
        ),
        Kind::ColumnsBeyondFile => error(
            "the {format} is damaged: its columns together are longer than it",
            "copy or export the file again",
        ),
        Kind::ColumnCompressed => error(
            "the columns of the file are compressed by {method}, which this build of the program does not unpack",
            "write the file again with `compression=\"snappy\"` (as pandas and pyarrow take it)",
        ),
        Kind::CellsAreLists => error(
            "the column {column} has lists in its cells",
            "write a column per axis",
        ),
        Kind::NumberTypeUnread => error(
            "the column {column} has numbers of a type that the program does not read",
            "write it as double",
        ),
        Kind::TextsAsDifferences => error(
            "{what} holds texts as differences (delta encoding), which the program does not read",
            "write them as they are (in pyarrow: no `column_encoding`)",
        ),
        Kind::NoDataset => error(
            "the file has no dataset of numbers with {least} rows or more: it holds {listed}",
            "write the samples as one dataset per sensor",
        ),
        Kind::DatasetShape => error(
            "the dataset {dataset} has {shape} numbers, and the program reads only rows of columns",
            "write it with a row per sample and a column per axis",
        ),
        Kind::DatasetLength => error(
            "the dataset {dataset} has {count:number} where {expected} were expected",
            "write the datasets of a sensor with equal lengths",
        ),
        Kind::NoSheet => error_by(
            "the workbook has no visible sheet with cells",
            vec![Remedy::SaveAsCsv],
        ),
        Kind::WordsTooMany => error_with(
            "the workbook is damaged: its part {part} claims to hold {words:word} in {bytes:byte}, which cannot be",
            "open it in a spreadsheet program and save it again",
            vec![Remedy::SaveAsCsv],
        ),
        Kind::CellImpossible => error_with(
            "the workbook is damaged: the cell {cell} is out of order or outside of any sheet",
            "open it in a spreadsheet program and save it again",
            vec![Remedy::SaveAsCsv],
        ),
        Kind::CellTwice => error_with(
            "the workbook is damaged: it has the cell {cell} twice",
            "open it in a spreadsheet program and save it again",
            vec![Remedy::SaveAsCsv],
        ),
        Kind::CellIsDate => error(
            "the cell {cell} is a date or time of day",
            "format the column as numbers, in seconds, and save again",
        ),
        _ => return None,
    })
}
