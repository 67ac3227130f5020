//! The blackbox of Betaflight, Cleanflight and INAV as it is on the flight controller: known, and not decoded here.

use std::io::Read;

use findings::{Finding, Kind};

use crate::format::{Format, Reads};
use crate::{Content, Error, Limits, Wanted};

/// A blackbox log, `.bbl`, `.bfl` or `.txt`.
pub(crate) static BLACKBOX: Format = Format {
    name: "blackbox",
    about: "a Betaflight blackbox as it is on the flight controller, before blackbox_decode",
    begins: |head| {
        // A dump of the flash may begin within another log.
        memchr::memmem::find(head, MAGIC).is_some()
    },
    reads: Reads::Forward(read),
};

const MAGIC: &[u8] = b"H Product:Blackbox flight data recorder";

fn read(_: &mut dyn Read, _: &Wanted, _: Limits) -> Result<Content, Error> {
    Err(Error::refused(Finding::of(Kind::BLACKBOX_NOT_DECODED)))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_blackbox_is_known_and_its_decoder_is_named() {
        let log = b"H Product:Blackbox flight data recorder by Nicholas Sherlock\nH Data version:2\nI\x00\x01\xff".to_vec();
        assert!((BLACKBOX.begins)(&log));
        assert!((BLACKBOX.begins)(&[&[0xff; 100], &log[..]].concat()));
        assert!(!(BLACKBOX.begins)(b"H Products\n"));
        let read = BLACKBOX.read(&mut &log[..], &Wanted::default(), Limits::default());
        assert!(read.unwrap_err().to_string().contains("blackbox_decode"));
    }
}
