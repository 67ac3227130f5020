//! Recording of a device in SI units, each sensor on its own clock.
//!
//! ```text
//! file ──► source ──► header ──► rows ──┐
//!          UTF-8,     what the   tables ├─► assemble ──► Recording
//!          batches    columns    tables ┘   clock: seconds
//!          of lines   are                   units: SI
//! ```

pub(crate) mod arrays;
pub(crate) mod assemble;
pub(crate) mod checks;
pub(crate) mod content;
pub(crate) mod decimate;
pub(crate) mod description;
mod frozen;
pub(crate) mod magnetometer;
pub(crate) mod options;
mod read;
pub(crate) mod samples;
pub(crate) mod scalar;
pub(crate) mod sessions;
pub(crate) mod stream;
pub(crate) mod temperature;
pub(crate) mod with_gravity;
pub(crate) mod write;

pub use arrays::Rows;
pub use content::Recording;
pub use description::{AppliedBefore, Described, Description, UnitBy};
pub use frozen::Frozen;
pub use magnetometer::Magnetometer;
pub use options::{ColumnMap, ReadOptions, Role};
pub(crate) use samples::{line_numbers, memory, packets};
pub use scalar::ScalarStream;
pub use stream::{Gap, INSTANT, Stream, Temperature, is_before};
pub(crate) use temperature::{counts as temperature_counts, thermometer};
pub use write::{FOLDER_FILES, FolderFile, field_names, stream_to_csv, to_csv, to_parquet};
