//! Words of errors: sources of a guided session.

use crate::kind::Kind;
use crate::words::entry::{Entry, error};

pub(in crate::words::tables) fn words(kind: Kind) -> Option<Entry> {
    Some(match kind {
        Kind::SourceUnknown => error(
            "this is neither the address of a phone (http://192.168.0.12:8080) nor a file that exists, nor `-`",
            "name one of them",
        ),
        Kind::PhoneLost => error(
            "the phone gives no usable answer[ for {seconds}] ({reason})",
            "check that remote access is on (⋮, Allow remote access), that the phone's screen is on and that it is in the same network; if the phone answers, clear the data in phyphox and start the measurement again",
        ),
        Kind::PhoneRestless => error(
            "the measurement on the phone began anew {times} times",
            "leave the experiment open and measure without clearing its data",
        ),
        Kind::LineWithoutEnd => error(
            "the source sent {limit:byte} and more without a line break, and the program reads a sample per line",
            "let the source send a line of text for each sample, as in 0.01,0.1,0.2,9.8,0,0,0",
        ),
        Kind::TextTooLong => error(
            "the source sent more than {limit:byte} of text",
            "write it to a file and calibrate that",
        ),
        Kind::SessionTooLong => error(
            "the source sent more than {limit:sample}, which is the limit of a guided session",
            "record on the phone and calibrate its file",
        ),
        Kind::NotPhyphox => error(
            "this address is not phyphox's remote access (it answers `{begin}` from /config)",
            "name the address that the app shows",
        ),
        Kind::PhoneWithoutSensor => error(
            "the experiment `{experiment}` on the phone has no {missing} with x, y, z and time (found: {found})",
            "add a simple experiment with Accelerometer and Gyroscope in phyphox (+), open it and allow remote access (⋮)",
        ),
        Kind::SessionFile => error(
            "the file of the session cannot be written: {reason}",
            "make room, or name a folder on another disk",
        ),
        Kind::RequestFailed => error(
            "the request to the phone failed: {reason}",
            "check that remote access is on (⋮, Allow remote access), that the phone's screen is on and that it is in the same network",
        ),
        Kind::AnswerWithoutSamples => error(
            "the program cannot read samples from the phone's answer: {reason}",
            "check that the address is that of phyphox and that its experiment is open",
        ),
        Kind::TimeImpossible => error(
            "the phone sent a time of {seconds} s since the start of the measurement, which cannot be",
            "clear the data in phyphox and start the measurement again",
        ),
        Kind::ReadingImpossible => error(
            "the phone sent a reading of {value}, as no sensor gives",
            "clear the data in phyphox and start the measurement again",
        ),
        Kind::ExportLacksSamples => error(
            "the file that the phone exported has {accelerometer:sample} of the accelerometer and {gyroscope:sample} of the gyroscope: both are needed",
            "open an experiment with both sensors in phyphox and measure again",
        ),
        Kind::ExportOfOther => error(
            "the file that the phone exported is of another session than the one that the program guided",
            "use the calibration that is made from the live readings instead; next time leave the experiment open and keep its data until the program ends",
        ),
        _ => return None,
    })
}
