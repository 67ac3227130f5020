//! Words of errors: sources of a guided session.

use crate::words::entry::error;

kinds! {
    /// A source is neither an address nor a file.
    SOURCE_UNKNOWN = "source_unknown" => error(
        "this is neither the address of a phone (http://192.168.0.12:8080) nor a file that exists, nor `-`",
        "name one of them",
    ),
    /// A phone does not answer.
    PHONE_LOST = "phone_lost" => error(
        "the phone gives no usable answer[ for {seconds}] ({reason})",
        "check that remote access is on (⋮, Allow remote access), that the phone's screen is on and that it is in the same network; if the phone answers, clear the data in phyphox and start the measurement again",
    ),
    /// The measurement of a phone begins again and again.
    PHONE_RESTLESS = "phone_restless" => error(
        "the measurement on the phone began anew {times} times",
        "leave the experiment open and measure without clearing its data",
    ),
    /// A source sends a line without an end.
    LINE_WITHOUT_END = "line_without_end" => error(
        "the source sent {limit:byte} and more without a line break, and the program reads a sample per line",
        "let the source send a line of text for each sample, as in 0.01,0.1,0.2,9.8,0,0,0",
    ),
    /// A source sends more text than a session has.
    TEXT_TOO_LONG = "text_too_long" => error(
        "the source sent more than {limit:byte} of text",
        "write it to a file and calibrate that",
    ),
    /// A phone sends more samples than a session has.
    SESSION_TOO_LONG = "session_too_long" => error(
        "the source sent more than {limit:sample}, which is the limit of a guided session",
        "record on the phone and calibrate its file",
    ),
    /// An address answers that is not phyphox.
    NOT_PHYPHOX = "not_phyphox" => error(
        "this address is not phyphox's remote access (it answers `{begin}` from /config)",
        "name the address that the app shows",
    ),
    /// The experiment on a phone lacks a sensor.
    PHONE_WITHOUT_SENSOR = "phone_without_sensor" => error(
        "the experiment `{experiment}` on the phone has no {missing} with x, y, z and time (found: {found})",
        "add a simple experiment with Accelerometer and Gyroscope in phyphox (+), open it and allow remote access (⋮)",
    ),
    /// A file of a session cannot be read or written.
    SESSION_FILE = "session_file" => error(
        "the file of the session cannot be written: {reason}",
        "make room, or name a folder on another disk",
    ),
    /// A request to a phone has failed.
    REQUEST_FAILED = "request_failed" => error(
        "the request to the phone failed: {reason}",
        "check that remote access is on (⋮, Allow remote access), that the phone's screen is on and that it is in the same network",
    ),
    /// The answer of a phone has no samples.
    ANSWER_WITHOUT_SAMPLES = "answer_without_samples" => error(
        "the program cannot read samples from the phone's answer: {reason}",
        "check that the address is that of phyphox and that its experiment is open",
    ),
    /// A phone states a time that no session lasts.
    TIME_IMPOSSIBLE = "time_impossible" => error(
        "the phone sent a time of {seconds} s since the start of the measurement, which cannot be",
        "clear the data in phyphox and start the measurement again",
    ),
    /// A phone states a reading that no sensor has.
    READING_IMPOSSIBLE = "reading_impossible" => error(
        "the phone sent a reading of {value}, as no sensor gives",
        "clear the data in phyphox and start the measurement again",
    ),
    /// The exported file of a phone lacks a sensor.
    EXPORT_LACKS_SAMPLES = "export_lacks_samples" => error(
        "the file that the phone exported has {accelerometer:sample} of the accelerometer and {gyroscope:sample} of the gyroscope: both are needed",
        "open an experiment with both sensors in phyphox and measure again",
    ),
    /// The exported file of a phone is of another session.
    EXPORT_OF_OTHER = "export_of_other" => error(
        "the file that the phone exported is of another session than the one that the program guided",
        "use the calibration that is made from the live readings instead; next time leave the experiment open and keep its data until the program ends",
    ),
}
