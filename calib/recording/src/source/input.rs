//! A text that is about to be read: its beginning, what follows, and where it comes from.

use findings::{Finding, Findings, Kind};
use std::io::{self, Cursor, Read};
use std::path::{Path, PathBuf};
use std::sync::{Arc, OnceLock};

use file_formats::Entry;

use super::batches::is_too_long;
use super::decode;
use super::files::Files;
use super::head::{HEAD, take_head};
use super::lines::{end_of_line, lines};
use super::on_disk::Unchanged;
use super::place::in_file;
use crate::Error;
use crate::header::look::Look;
use crate::header::preface::is_comment;
use crate::recording::options::ReadOptions;
use crate::spelling::{SPELLINGS, Spelling};

/// No comments are longer.
const LONGEST_PREFACE: usize = 64 << 20;

/// Origin of a text, for opening it once more.
#[derive(Clone, Debug)]
pub(super) enum Origin {
    Path(PathBuf),
    Entry(Files, Entry),
    Memory(Arc<[u8]>),
    Stream,
}

/// A text that is about to be read.
pub struct Input {
    /// The name in messages.
    pub(crate) name: String,
    /// Its beginning.
    pub(crate) head: Vec<u8>,
    /// Reader of the text after its beginning.
    pub(crate) rest: Box<dyn Read + Send>,
    /// Warnings from opening the text.
    pub(crate) warnings: Findings,
    /// The file as it was when it was opened.
    pub(crate) unchanged: Option<Unchanged>,
    pub(super) origin: Origin,
    /// The first lines of `head`, once a format has asked: every other one asks too.
    look: OnceLock<Look>,
}

impl std::fmt::Debug for Input {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.debug_struct("Input")
            .field("name", &self.name)
            .finish_non_exhaustive()
    }
}

impl Input {
    pub(super) fn new(
        name: String,
        unpacked: decode::Unpacked,
        origin: Origin,
        options: &ReadOptions,
    ) -> Result<Self, Error> {
        let (mut reader, warnings) = decode::text(&name, unpacked);
        let mut head = take_head(&name, &mut reader)?;
        decode::refuse_other_formats(&name, &head)?;
        take_preface(&name, &mut reader, &mut head)?;
        let input = Self {
            name,
            head,
            rest: reader,
            warnings,
            unchanged: None,
            origin,
            look: OnceLock::new(),
        };
        input.respelt(options)
    }

    /// The same text with numbers and stamps as readers take them.
    fn respelt(mut self, options: &ReadOptions) -> Result<Self, Error> {
        let is_said = |spelling: &&&Spelling| spelling.of_dates && options.time_format.is_some();
        for spelling in SPELLINGS.iter().filter(|spelling| !is_said(spelling)) {
            let Some(change) = (spelling.change)(self.look()) else {
                continue;
            };
            self = self.changed(change)?;
            self.warnings.push(
                Finding::of(Kind::NUMBER_SPELLING)
                    .in_recording(&self.name)
                    .detail("spelling", spelling.spelling)
                    .detail("read_as", spelling.read_as),
            );
        }
        Ok(self)
    }

    /// The first lines.
    pub(crate) fn look(&self) -> &Look {
        self.look.get_or_init(|| Look::at(&self.head))
    }

    /// The text as `change` turns it into another with the same lines.
    pub(crate) fn changed(
        mut self,
        change: impl FnOnce(Box<dyn Read + Send>) -> Box<dyn Read + Send>,
    ) -> Result<Self, Error> {
        let head = std::mem::take(&mut self.head);
        let whole = Box::new(
            Cursor::new(head).chain(std::mem::replace(&mut self.rest, Box::new(io::empty()))),
        );
        self.rest = change(whole);
        self.head = take_head(&self.name, &mut self.rest)?;
        take_preface(&self.name, &mut self.rest, &mut self.head)?;
        self.look = OnceLock::new();
        Ok(self)
    }

    /// The whole text.
    pub(crate) fn into_reader(self) -> Box<dyn Read + Send> {
        Box::new(Cursor::new(self.head).chain(self.rest))
    }

    /// Content decides; an extension that says otherwise is worth a word.
    pub(super) fn warn_of_extension(&mut self, path: &Path) {
        const BINARY: [&str; 9] = [
            "mat", "bag", "mcap", "db3", "xlsx", "xls", "ulg", "bin", "parquet",
        ];
        let extension = path.extension().map(|e| e.to_string_lossy().to_lowercase());
        if let Some(extension) = extension.filter(|e| BINARY.contains(&e.as_str())) {
            self.warnings.push(
                Finding::of(Kind::NAME_MISLEADS)
                    .in_recording(&self.name)
                    .detail("extension", extension),
            );
        }
    }
}

/// Reads on while `head` holds nothing but comments and the text goes on.
fn take_preface(name: &str, reader: &mut dyn Read, head: &mut Vec<u8>) -> Result<(), Error> {
    // Up to here there are nothing but whole lines of comment.
    let mut comments = 0;
    let mut length = head.len() as u64;
    while length == HEAD {
        for line in lines(head, comments) {
            let end = end_of_line(&head[line.end..]);
            if end == 0 || !is_skipped(&head[line.clone()]) {
                break;
            }
            comments = line.end + end;
        }
        let behind = head.len() - comments;
        let is_text = |line: std::ops::Range<usize>| !is_skipped(&head[line]);
        let met = lines(head, comments).next().is_some_and(is_text);
        if met && behind >= HEAD as usize || is_too_long(behind) {
            break;
        }
        if head.len() > LONGEST_PREFACE {
            return Err(in_file(name, Finding::of(Kind::ONLY_COMMENTS)));
        }
        let more = take_head(name, reader)?;
        length = more.len() as u64;
        head.extend(more);
    }
    Ok(())
}

/// True for lines that are neither names nor rows.
fn is_skipped(line: &[u8]) -> bool {
    is_comment(line) || line.trim_ascii().is_empty()
}
