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
        "the phone gives no answer[ for {seconds}] ({reason})",
        "check that remote access is on (⋮, Allow remote access), that the phone's screen is on and that it is in the same network",
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
        "the source sent a line of more than {limit:byte}",
        "send lines of text",
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
        "",
        Vec::new,
    ),
    Entry::error(
        Kind::AnswerWithoutSamples,
        "the phone's answer holds no samples: {reason}",
        "",
        Vec::new,
    ),
    Entry::error(
        Kind::TimeImpossible,
        "the phone says that {seconds} s have passed, which cannot be",
        "",
        Vec::new,
    ),
    Entry::error(
        Kind::ReadingImpossible,
        "the phone sends a reading of {value}, as no sensor does",
        "",
        Vec::new,
    ),
    Entry::error(
        Kind::ExportLacksSamples,
        "the file that the phone exported has {accelerometer} accelerometer and {gyroscope} gyroscope samples: both are needed",
        "",
        Vec::new,
    ),
    Entry::error(
        Kind::ExportOfOther,
        "the file that the phone exported holds another session than the one that was guided",
        "",
        Vec::new,
    ),
];
