//! Words of errors: files of tables.

use crate::remedy::Remedy;
use crate::words::entry::{error, error_by, error_with};

kinds! {
    /// This build does not read the format.
    NOT_IN_BUILD = "not_in_build" => error_by(
        "this is {format}, which this build of the program does not read",
        vec![Remedy::ExportAs {
            format: "CSV".into(),
        }],
    ),
    /// This build does not write the format.
    NOT_WRITTEN_BY_BUILD = "not_written_by_build" => error("this build does not write {format}", "name a .csv file"),
    /// A text is no JSON from a place on.
    JSON_DAMAGED = "json_damaged" => error(
        "the JSON cannot be read: {reason}",
        "check that the JSON is complete",
    ),
    /// A JSON file has no list of records or of numbers.
    JSON_WITHOUT_TABLE = "json_without_table" => error(
        "the JSON holds no list of records or of numbers: it holds {listed}",
        "write a list of records, one per sample",
    ),
    /// Records of a JSON file hold lists.
    LISTS_IN_RECORDS = "lists_in_records" => error(
        "the JSON holds lists within its records, as `{name}`",
        "write a record for each sample, in which each name has one number",
    ),
    /// A value of a JSON file is too long.
    VALUE_TOO_LONG = "value_too_long" => error(
        "the JSON has a value of more than {limit:byte}",
        "write a record per line",
    ),
    /// A name is longer than any column's.
    NAME_TOO_LONG = "name_too_long" => error(
        "the JSON has a name of {bytes:byte}, as no column has",
        "name another file, or shorten the name",
    ),
    /// The records of a JSON file have too many names.
    NAMES_TOO_MANY = "names_too_many" => error(
        "the records of the JSON have more than {limit} names, as no recording has",
        "write the same names in every record",
    ),
    /// Some records of a JSON file have names and others have none.
    NAMES_MIXED = "names_mixed" => error(
        "the JSON holds records with names and others without",
        "write all with names",
    ),
    /// A table is no longer in the file.
    TABLE_GONE = "table_gone" => error(
        "the table `{table}` is not in the file any more: the file has changed",
        "wait until the file is complete and try again",
    ),
    /// A file has more rows than it announces.
    ROWS_BEYOND_CLAIM = "rows_beyond_claim" => error(
        "the {format} is damaged: it has more rows than it announces",
        "copy or export the file again",
    ),
    /// The columns of a file are longer than the file.
    COLUMNS_BEYOND_FILE = "columns_beyond_file" => error(
        "the {format} is damaged: its columns together are longer than it",
        "copy or export the file again",
    ),
    /// Columns are compressed in a way that this build does not unpack.
    COLUMN_COMPRESSED = "column_compressed" => error(
        "the columns of the file are compressed by {method}, which this build of the program does not unpack",
        "write the file again with `compression=\"snappy\"` (as pandas and pyarrow take it)",
    ),
    /// The cells of a column are lists.
    CELLS_ARE_LISTS = "cells_are_lists" => error(
        "the column {column} has lists in its cells",
        "write a column per axis",
    ),
    /// The numbers of a column are of a type that is not read.
    NUMBER_TYPE_UNREAD = "number_type_unread" => error(
        "the column {column} has numbers of a type that the program does not read",
        "write it as double",
    ),
    /// A page holds texts as differences.
    TEXTS_AS_DIFFERENCES = "texts_as_differences" => error(
        "{what} holds texts as differences (delta encoding), which the program does not read",
        "write them as they are (in pyarrow: no `column_encoding`)",
    ),
    /// An HDF5 file has no dataset of numbers.
    NO_DATASET = "no_dataset" => error(
        "the file has no dataset of numbers with {least} rows or more: it holds {listed}",
        "write the samples as one dataset per sensor",
    ),
    /// A dataset has a shape that is not read.
    DATASET_SHAPE = "dataset_shape" => error(
        "the dataset {dataset} has {shape} numbers, and the program reads only rows of columns",
        "write it with a row per sample and a column per axis",
    ),
    /// A dataset gives another number of numbers than it states.
    DATASET_LENGTH = "dataset_length" => error(
        "the dataset {dataset} has {count:number} where {expected} were expected",
        "write the datasets of a sensor with equal lengths",
    ),
    /// A workbook has no sheet of cells.
    NO_SHEET = "no_sheet" => error_by(
        "the workbook has no visible sheet with cells",
        vec![Remedy::SaveAsCsv],
    ),
    /// A workbook announces more words than it has bytes.
    WORDS_TOO_MANY = "words_too_many" => error_with(
        "the workbook is damaged: its part {part} claims to hold {words:word} in {bytes:byte}, which cannot be",
        "open it in a spreadsheet program and save it again",
        vec![Remedy::SaveAsCsv],
    ),
    /// A cell of a workbook stands where no cell can be.
    CELL_IMPOSSIBLE = "cell_impossible" => error_with(
        "the workbook is damaged: the cell {cell} is out of order or outside of any sheet",
        "open it in a spreadsheet program and save it again",
        vec![Remedy::SaveAsCsv],
    ),
    /// A cell of a workbook is there twice.
    CELL_TWICE = "cell_twice" => error_with(
        "the workbook is damaged: it has the cell {cell} twice",
        "open it in a spreadsheet program and save it again",
        vec![Remedy::SaveAsCsv],
    ),
    /// A cell of a workbook is a date among numbers.
    CELL_IS_DATE = "cell_is_date" => error(
        "the cell {cell} is a date or time of day",
        "format the column as numbers, in seconds, and save again",
    ),
}
