//! Text without a header: rows of numbers, as imu_tk writes them.

use super::format::{Format, text};
use crate::Error;
use crate::header::names::sensor_of_file;
use crate::header::sniff::starts_with_numbers;
use crate::recording::assemble::assemble;
use crate::recording::{ReadOptions, Recording};
use crate::rows::table::Table;
use crate::source::Source;

/// `t x y z` of one sensor, or seven columns that gravity tells apart.
#[derive(Debug)]
pub(crate) struct ImuTk;

impl Format for ImuTk {
    fn name(&self) -> &'static str {
        "imu_tk"
    }

    fn about(&self) -> &'static str {
        "rows of numbers without a header: t x y z of one sensor, in any unit"
    }

    fn recognises(&self, source: &Source) -> bool {
        matches!(source, Source::Text(input) if starts_with_numbers(&input.head))
    }

    fn read(&self, source: Source, options: &ReadOptions) -> Result<Recording, Error> {
        let input = text(source, self)?;
        let (name, only) = (input.name.clone(), sensor_of_file(&input.name));
        assemble(
            name,
            vec![Table::read(input, only, None, options)?],
            options,
        )
    }
}
