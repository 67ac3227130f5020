//! Files that this program writes: what they are, and what to do with them.

use std::path::Path;

use serde_json::{Value, json};

use crate::commands::shared::inputs::looked_at;
use crate::exit::Failure;
use crate::show;

/// Files above this are recordings, bytes.
const LARGEST: u64 = 64 << 20;

/// Kinds of documents: beginning of the schema, what it is, what to do with it.
const KINDS: [(&str, &str, &str); 7] = [
    (
        "stillpoint.calibration/",
        "a calibration",
        "stillpoint apply FILE RECORDING -o corrected.csv",
    ),
    (
        "stillpoint.findings/",
        "the findings of discover",
        "stillpoint apply FILE RECORDING -o corrected.csv",
    ),
    (
        "stillpoint.segments/",
        "the static intervals of a recording",
        "stillpoint calibrate RECORDING -o cal.json",
    ),
    (
        "stillpoint.noise/",
        "the noise of a sensor",
        "stillpoint discover RECORDING --noise FILE",
    ),
    (
        "stillpoint.truth/",
        "the truth of a simulated recording",
        "stillpoint calibrate FOLDER -o cal.json",
    ),
    (
        "stillpoint.reckon/",
        "dead reckoning",
        "stillpoint reckon RECORDING --calibration NAME=CAL",
    ),
    ("stillpoint.", "a file of this program", "stillpoint --help"),
];

/// Document of this program, with its kind and the next command.
#[derive(Debug, PartialEq)]
pub struct Ours {
    schema: String,
    what: &'static str,
    next: String,
}

impl Ours {
    /// Looks at a file.
    ///
    /// # Errors
    /// Status 3: the system does not let it be read, so that nobody can tell what it is.
    pub fn of(path: &Path) -> Result<Option<Self>, Failure> {
        if path.extension().is_none_or(|e| e != "json") {
            return Ok(None);
        }
        let found = looked_at(path, std::fs::metadata(path))?;
        if found.is_none_or(|found| !found.is_file() || found.len() > LARGEST) {
            return Ok(None);
        }
        let bytes = looked_at(path, std::fs::read(path))?;
        Ok(bytes.and_then(|bytes| Self::in_bytes(path, &bytes)))
    }

    fn in_bytes(path: &Path, bytes: &[u8]) -> Option<Self> {
        let document: Value = serde_json::from_slice(bytes).ok()?;
        let schema = document.get("schema")?.as_str()?;
        let (_, what, next) = KINDS.iter().find(|(kind, ..)| schema.starts_with(kind))?;
        Some(Self {
            schema: show::name(schema),
            what,
            next: next.replace("FILE", &crate::show::command_line(path)),
        })
    }

    /// For programs.
    pub fn document(&self, path: &Path) -> Value {
        json!({"file": show::path(path), "format": self.schema, "command": self.next})
    }

    /// For people.
    pub fn page(&self, path: &Path) -> String {
        format!(
            "{}: {} ({})\n\nnext: {}\n",
            show::path(path),
            self.what,
            self.schema,
            self.next
        )
    }
}

#[cfg(test)]
mod tests {
    use std::io::{Error, ErrorKind};

    use super::*;

    #[test]
    fn a_file_that_cannot_be_read_is_not_taken_for_one_of_others() {
        let found =
            |kind: ErrorKind| looked_at::<()>(Path::new("cal.json"), Err(Error::from(kind)));
        assert!(found(ErrorKind::NotFound).unwrap().is_none());
        let failure = found(ErrorKind::TimedOut).unwrap_err();
        assert_eq!(failure.code, crate::exit::INPUT);
        assert!(failure.message.starts_with("cal.json: "), "{failure:?}");
    }
}
