//! The call as it was typed, for commands that repeat it with one option more.

use std::ffi::OsString;
use std::sync::OnceLock;

use crate::quoted::printable;
use crate::read_args::quoted;

static WORDS: OnceLock<Vec<String>> = OnceLock::new();

/// Options that say how much is said, and those that are added anew.
const NOT_AGAIN: [&str; 7] = [
    "-v",
    "--verbose",
    "-q",
    "--quiet",
    "--json",
    "--force",
    "--skip-existing",
];

/// Options that name what the call has written, and that would not be written over.
const WRITTEN: [&str; 3] = ["--emit-effect", "--report", "--plots"];

/// Keeps the words of the call, the program's name first.
pub fn remember(words: &[OsString]) {
    // A second call of one process keeps the first's words.
    let _ = WORDS.set(shown(words.iter().skip(1)));
}

/// Words of a call as they are shown.
pub fn shown<'a>(words: impl IntoIterator<Item = &'a OsString>) -> Vec<String> {
    let words = words.into_iter();
    words
        .map(|word| printable(&word.to_string_lossy()).into_owned())
        .collect()
}

/// The call of this process, or `call` in its place, with `more` behind it and the end that writes again: over the output that was
/// `given` and is there already, else to `output`.
pub fn again(call: Option<&Vec<String>>, more: &str, given: bool, output: &str) -> String {
    let words = call.or(WORDS.get()).map_or(&[][..], Vec::as_slice);
    let before = std::iter::once("").chain(words.iter().map(String::as_str));
    let is_written = |word: &str| {
        let option = word.split_once('=').map_or(word, |(option, _)| option);
        !given && WRITTEN.contains(&option)
    };
    let words = words.iter().zip(before).filter(|(word, before)| {
        let is_value = !given && WRITTEN.contains(before);
        !(NOT_AGAIN.contains(&word.as_str()) || is_written(word) || is_value)
    });
    let words: Vec<String> = words.map(|(word, _)| quoted(word)).collect();
    let end = match given {
        true => "--force".to_owned(),
        false => format!("-o {output}"),
    };
    let more = if more.is_empty() {
        String::new()
    } else {
        format!("{more} ")
    };
    format!("stillpoint {} {more}{end}", words.join(" "))
}
