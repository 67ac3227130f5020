//! Files of tables, read by `stillpoint-formats` as the texts that they would be.

use file_formats::Tabular;
use findings::{Finding, Kind};

use super::format::{Format, Recognise};
use crate::Error;
use crate::recording::content::Recording;
use crate::recording::options::ReadOptions;
use crate::source::Source;
use crate::source::place::in_file;

/// The format of tables that is called so, and what finds out how the texts in it are read.
#[derive(Debug)]
pub(crate) struct Tables(pub &'static str, pub Recognise);

/// Formats of texts and folders that say nothing that the format of the file does not.
const PLAIN: [&str; 4] = ["csv", "imu_tk", "folder", "bundle"];

impl Format for Tables {
    fn name(&self) -> &'static str {
        self.0
    }

    fn about(&self) -> &'static str {
        Tabular::by_name(self.0).map_or("", |format| format.about)
    }

    fn recognises(&self, source: &Source) -> bool {
        matches!(source, Source::Tables(format, _) if format.name == self.0)
    }

    fn read(&self, source: Source, options: &ReadOptions) -> Result<Recording, Error> {
        let source = match source {
            Source::Tables(format, inner) if format.name == self.0 => *inner,
            other => {
                let expected = "its own files";
                return Err(crate::formats::format::mismatch(
                    other.name(),
                    self,
                    expected,
                ));
            }
        };
        let format = (self.1)(&source);
        let format =
            format.ok_or_else(|| in_file(source.name(), Finding::of(Kind::UNKNOWN_FORMAT)))?;
        let mut recording = format.read(source, options)?;
        let described = &mut recording.description.format;
        if described.is_empty() {
            *described = format.name();
        }
        if PLAIN.contains(described) {
            *described = self.0;
        }
        Ok(recording)
    }
}
