//! Words of errors: sources of a guided session.

use crate::kind::Kind;
use crate::words::entry::Entry;

pub(in crate::words::tables) const ENTRIES: &[Entry] = &[
    Entry::error(
        Kind::SourceUnknown,
        "this is neither the address of a phone (http://192.168.0.12:8080) nor a file that exists, nor `-`",
        "name one of them",
        Vec::new,
    ),
    Entry::error(
        Kind::PhoneLost,
        "the phone gives no usable answer[ for {seconds}] ({reason})",
        "check that remote access is on (⋮, Allow remote access), that the phone's screen is on and that it is in the same network; if the phone answers, clear the data in phyphox and start the measurement again",
        Vec::new,
    ),
    Entry::error(
        Kind::PhoneRestless,
        "the measurement on the phone began anew {times} times",
        "leave the experiment open and measure without clearing its data",
        Vec::new,
    ),
    Entry::error(
        Kind::LineWithoutEnd,
        "the source sent {limit:byte} and more without a line break, and the program reads a sample per line",
        "let the source send a line of text for each sample, as in 0.01,0.1,0.2,9.8,0,0,0",
        Vec::new,
    ),
    Entry::error(
        Kind::TextTooLong,
        "the source sent more than {limit:byte} of text",
        "write it to a file and calibrate that",
        Vec::new,
    ),
    Entry::error(
        Kind::SessionTooLong,
        "the source sent more than {limit:sample}, which is the limit of a guided session",
        "record on the phone and calibrate its file",
        Vec::new,
    ),
    Entry::error(
        Kind::NotPhyphox,
        "this address is not phyphox's remote access (it answers `{begin}` from /config)",
        "name the address that the app shows",
        Vec::new,
    ),
    Entry::error(
        Kind::PhoneWithoutSensor,
        "the experiment `{experiment}` on the phone has no {missing} with x, y, z and time (found: {found})",
        "add a simple experiment with Accelerometer and Gyroscope in phyphox (+), open it and allow remote access (⋮)",
        Vec::new,
    ),
    Entry::error(
        Kind::SessionFile,
        "the file of the session cannot be written: {reason}",
        "make room, or name a folder on another disk",
        Vec::new,
    ),
    Entry::error(
        Kind::RequestFailed,
        "the request to the phone failed: {reason}",
        "check that remote access is on (⋮, Allow remote access), that the phone's screen is on and that it is in the same network",
        Vec::new,
    ),
    Entry::error(
        Kind::AnswerWithoutSamples,
        "the program cannot read samples from the phone's answer: {reason}",
        "check that the address is that of phyphox and that its experiment is open",
        Vec::new,
    ),
    Entry::error(
        Kind::TimeImpossible,
        "the phone sent a time of {seconds} s since the start of the measurement, which cannot be",
        "clear the data in phyphox and start the measurement again",
        Vec::new,
    ),
    Entry::error(
        Kind::ReadingImpossible,
        "the phone sent a reading of {value}, as no sensor gives",
        "clear the data in phyphox and start the measurement again",
        Vec::new,
    ),
    Entry::error(
        Kind::ExportLacksSamples,
        "the file that the phone exported has {accelerometer:sample} of the accelerometer and {gyroscope:sample} of the gyroscope: both are needed",
        "open an experiment with both sensors in phyphox and measure again",
        Vec::new,
    ),
    Entry::error(
        Kind::ExportOfOther,
        "the file that the phone exported is of another session than the one that the program guided",
        "use the calibration that is made from the live readings instead; next time leave the experiment open and keep its data until the program ends",
        Vec::new,
    ),
];
