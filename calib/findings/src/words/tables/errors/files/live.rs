//! Words of errors: sources of a guided session.

use crate::kind::Kind;
use crate::words::entry::Entry;

pub(in crate::words::tables) const ENTRIES: &[Entry] = &[
    Entry::error(
        Kind::SourceUnknown,
        "neither the address of a phone (http://192.168.0.12:8080) nor a file that exists, nor `-`",
        "name one of them",
        Vec::new,
    ),
    Entry::error(
        Kind::PhoneLost,
        "no answer[ for {seconds}] ({reason})",
        "check that remote access is on (⋮, Allow remote access), that the phone's screen is on and that \
         it is in the same network",
        Vec::new,
    ),
    Entry::error(
        Kind::PhoneRestless,
        "the measurement began anew {times} times",
        "leave the experiment open and measure without clearing its data",
        Vec::new,
    ),
    Entry::error(
        Kind::LineWithoutEnd,
        "a line of more than {limit:byte} comes",
        "send lines of text",
        Vec::new,
    ),
    Entry::error(
        Kind::TextTooLong,
        "more than {limit:byte} of text came",
        "write it to a file and calibrate that",
        Vec::new,
    ),
    Entry::error(
        Kind::SessionTooLong,
        "more than {limit:sample} came",
        "record on the phone and calibrate its file",
        Vec::new,
    ),
    Entry::error(
        Kind::NotPhyphox,
        "not phyphox's remote access (`{begin}` from /config)",
        "name the address that the app shows",
        Vec::new,
    ),
    Entry::error(
        Kind::PhoneWithoutSensor,
        "the experiment `{experiment}` has no {missing} with x, y, z and time (found: {found})",
        "add a simple experiment with Accelerometer and Gyroscope in phyphox (+), open it and allow \
         remote access (⋮)",
        Vec::new,
    ),
    Entry::error(
        Kind::SessionFile,
        "{reason}",
        "make room, or name a folder on another disk",
        Vec::new,
    ),
    Entry::error(Kind::RequestFailed, "{reason}", "", Vec::new),
    Entry::error(
        Kind::AnswerWithoutSamples,
        "no samples in its answer: {reason}",
        "",
        Vec::new,
    ),
    Entry::error(
        Kind::TimeImpossible,
        "it says that {seconds} s have passed",
        "",
        Vec::new,
    ),
    Entry::error(
        Kind::ReadingImpossible,
        "it reads {value}, as no sensor does",
        "",
        Vec::new,
    ),
    Entry::error(
        Kind::ExportLacksSamples,
        "{accelerometer} and {gyroscope} samples in the exported file",
        "",
        Vec::new,
    ),
    Entry::error(
        Kind::ExportOfOther,
        "it holds another session than the one that was guided",
        "",
        Vec::new,
    ),
];
