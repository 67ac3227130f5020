//! The blackbox of Betaflight, Cleanflight and INAV as it is on the flight controller: known, and not decoded here.

use std::io::Read;

use findings::{Finding, Kind};

use crate::format::Format;
use crate::{Content, Error, Limits, Wanted};

/// A blackbox log, `.bbl`, `.bfl` or `.txt`.
#[derive(Debug)]
pub(crate) struct Blackbox;

const MAGIC: &[u8] = b"H Product:Blackbox flight data recorder";

impl Format for Blackbox {
    fn name(&self) -> &'static str {
        "blackbox"
    }

    fn about(&self) -> &'static str {
        "a Betaflight blackbox as it is on the flight controller, before blackbox_decode"
    }

    fn recognises(&self, head: &[u8]) -> bool {
        // A dump of the flash may begin within another log.
        memchr::memmem::find(head, MAGIC).is_some()
    }

    fn read(&self, _: &mut dyn Read, _: &Wanted, _: Limits) -> Result<Content, Error> {
        Err(Error::refused(Finding::of(Kind::BlackboxNotDecoded)))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_blackbox_is_known_and_its_decoder_is_named() {
        let log = b"H Product:Blackbox flight data recorder by Nicholas Sherlock\nH Data version:2\nI\x00\x01\xff".to_vec();
        assert!(Blackbox.recognises(&log));
        assert!(Blackbox.recognises(&[&[0xff; 100], &log[..]].concat()));
        assert!(!Blackbox.recognises(b"H Products\n"));
        let read = Blackbox.read(&mut &log[..], &Wanted::default(), Limits::default());
        assert!(read.unwrap_err().to_string().contains("blackbox_decode"));
    }
}
