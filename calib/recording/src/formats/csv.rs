//! Text with a header: plain CSV and its relatives.

use super::format::{Format, text};
use crate::Error;
use crate::header::names::sensor_of_file;
use crate::recording::assemble::assemble;
use crate::recording::{ReadOptions, Recording};
use crate::rows::parts;
use crate::rows::table::Table;
use crate::source::Source;

/// `t,ax,ay,az,gx,gy,gz[,temp]` by name, in any order, with any separator; one sensor alone will do.
#[derive(Debug)]
pub(crate) struct Csv;

impl Format for Csv {
    fn name(&self) -> &'static str {
        "csv"
    }

    fn about(&self) -> &'static str {
        "text with a header such as t,ax,ay,az,gx,gy,gz[,temp]; columns by name"
    }

    fn recognises(&self, source: &Source) -> bool {
        matches!(source, Source::Text(_))
    }

    fn read(&self, source: Source, options: &ReadOptions) -> Result<Recording, Error> {
        let input = text(source, self)?;
        let name = input.name.clone();
        // Who says which columns are a sensor's needs no name of the file for it.
        let only = sensor_of_file(&name).filter(|_| !options.columns.names_a_sensor());
        let tables = match parts::with_own_stamps(&options.columns) {
            Some(parts) => parts::read(input, &parts, options)?,
            None => vec![Table::read(input, only, None, options)?],
        };
        assemble(name, tables, options)
    }
}
