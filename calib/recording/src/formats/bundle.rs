//! A folder or an archive with a recording in it.

use super::{Format, Source, recognise};
use crate::Error;
use crate::recording::{ReadOptions, Recording};
use crate::shown::shown;
use crate::source::files::Files;
use crate::source::place::in_file;

/// One file of a container that is a recording of its own, as of a bag of ROS 2.
#[derive(Debug)]
pub(crate) struct Bundle;

impl Format for Bundle {
    fn name(&self) -> &'static str {
        "bundle"
    }

    fn about(&self) -> &'static str {
        "a folder or zip archive with one recording in it; --entry NAME chooses among several"
    }

    fn recognises(&self, source: &Source) -> bool {
        matches!(source, Source::Files(_))
    }

    fn read(&self, source: Source, options: &ReadOptions) -> Result<Recording, Error> {
        let files = super::files(source, self)?;
        let entry = match &options.entry {
            Some(name) => files.entry(name).ok_or_else(|| {
                let words = format!("no entry `{}`; found {}", shown(name), files.listed());
                in_file(&files.name, words)
            })?,
            None => only(&files, options)?,
        };
        let source = files.source(entry, options)?;
        let format = recognise(&source)
            .ok_or_else(|| in_file(&files.called(entry), "of no known format"))?;
        let mut recording = format.read(source, options)?;
        recording.description.format = format.name();
        recording.warnings.extend(files.warnings());
        Ok(recording)
    }
}

/// The one entry that is a recording.
fn only<'a>(files: &'a Files, options: &ReadOptions) -> Result<&'a file_formats::Entry, Error> {
    let is_recording = |entry: &&file_formats::Entry| {
        let source = files.source(entry, options);
        source.is_ok_and(|source| source.holds_samples(options))
    };
    let recordings: Vec<_> = files
        .entries()
        .iter()
        .filter(is_recording)
        .take(20)
        .collect();
    match recordings[..] {
        [entry] => Ok(entry),
        [] => Err(in_file(
            &files.name,
            format!(
                "{}, with neither acc.csv (t,ax,ay,az) nor gyro.csv (t,gx,gy,gz) nor any other recording; found {}",
                files.kind(),
                files.listed()
            ),
        )),
        [first, ..] => {
            let names: Vec<_> = recordings.iter().map(|entry| shown(&entry.name)).collect();
            Err(in_file(
                &files.name,
                format!(
                    "{} recordings in it: {}; say which, as in --entry '{}'",
                    names.len(),
                    names.join(", "),
                    shown(&first.name)
                ),
            ))
        }
    }
}
