//! The words of findings: one entry per kind, filled with a finding's numbers.

pub(crate) mod command;
mod entry;
mod human;
pub mod names;
mod parameters;
pub(crate) mod remedies;
mod shell;
mod tables;
mod template;
pub mod turns;

pub use entry::Front;
pub use human::{human, significant};
pub(crate) use tables::entry;

use self::entry::UseOfResult;
use crate::finding::{Finding, Place};
use crate::kind::Kind;
use crate::level::Level;
use crate::remedy::Remedy;

/// End of a remark that requires no action.
const NOTHING_TO_DO: &str = "nothing has to be done";

/// The table of all kinds for the manual: name, level, text with its names in braces, ways out.
pub fn manual_table() -> String {
    let mut table = String::from("| kind | level | says | to do |\n| --- | --- | --- | --- |\n");
    for kind in Kind::all() {
        let entry = entry(kind);
        let own = (!entry.advice.is_empty()).then(|| entry.advice.replace(['[', ']'], ""));
        let remedies = entry
            .remedies
            .iter()
            .map(|remedy| remedies::words(remedy, Front::CommandLine));
        let remedies: Vec<String> = own.into_iter().chain(remedies).collect();
        let text = entry.text.replace(['[', ']'], "").replace('|', "\\|");
        table.push_str(&format!(
            "| `{}` | {} | {text} | {} |\n",
            kind.name(),
            entry.level.name(),
            remedies.join("; or ")
        ));
    }
    table
}

impl Remedy {
    /// The remedy in words, an imperative.
    pub fn text(&self, front: Front) -> String {
        remedies::words(self, front)
    }
}

impl Place {
    /// `recording`, `file:line:column`, or `file: byte 17`.
    fn in_words(&self) -> Option<String> {
        let mut place = match (&self.recording, &self.file) {
            (Some(recording), None) => recording.clone(),
            (_, Some(file)) => file.clone(),
            (None, None) => String::new(),
        };
        let of_arrays = place.is_empty();
        for (number, what) in [(self.line, "row"), (self.column, "column")] {
            let Some(number) = number else { continue };
            place = match (of_arrays, place.is_empty()) {
                (false, _) => format!("{place}:{number}"),
                (true, true) => format!("{what} {number}"),
                (true, false) => format!("{place}, {what} {number}"),
            };
        }
        if let Some(byte) = self.byte {
            let colon = if place.is_empty() { "" } else { ": " };
            place = format!("{place}{colon}byte {byte}");
        }
        (!place.is_empty()).then_some(place)
    }
}

impl Finding {
    /// The finding in words: where, what, and what to do.
    pub fn text(&self, front: Front) -> String {
        let mut text = self.stated();
        let advice = self.advice(front);
        // What goes on and has advice of its own needs none of its cause.
        let is_advised = advice.is_some() && self.level != Level::Error;
        let nothing = || (self.level == Level::Remark).then(|| NOTHING_TO_DO.to_owned());
        if let Some(advice) = advice.or_else(nothing) {
            text.push_str("; ");
            text.push_str(&advice);
        }
        for cause in &self.because {
            text.push_str("; ");
            text.push_str(&match is_advised {
                true => cause.stated(),
                false => cause.text(front),
            });
        }
        text
    }

    /// The place and the fact.
    fn stated(&self) -> String {
        let what = template::filled(entry(self.kind).text, self);
        match self.place.in_words() {
            Some(place) => format!("{place}: {what}"),
            None => what,
        }
    }

    /// Returns the message without its place and without advice.
    pub fn what(&self) -> String {
        let finding = Self {
            place: Place {
                sensor: self.place.sensor,
                ..Place::default()
            },
            ..self.clone()
        };
        let own = template::filled(entry(self.kind).text, &finding);
        let causes = self.because.iter().map(Self::what);
        std::iter::once(own)
            .chain(causes)
            .collect::<Vec<_>>()
            .join("; ")
    }

    /// The reason in a few words, without its place; of an error its whole text.
    pub fn reason(&self) -> String {
        let entry = entry(self.kind);
        let template = if entry.reason.is_empty() {
            entry.text
        } else {
            entry.reason
        };
        template::filled(template, self)
    }

    /// True where the advice is to use the result under a condition.
    pub fn allows_use(&self) -> bool {
        entry(self.kind).use_of_result == UseOfResult::Conditional
    }

    /// True where the result must not be used.
    pub fn forbids_use(&self) -> bool {
        self.level >= Level::Bad || entry(self.kind).use_of_result == UseOfResult::Forbidden
    }

    /// Returns the advice; `None` if nothing helps or nothing has to be done.
    pub fn advice(&self, front: Front) -> Option<String> {
        let own = template::filled(entry(self.kind).advice, self);
        let own = (!own.is_empty()).then_some(own);
        let all: Vec<String> = own.into_iter().chain(self.ways_out(front)).collect();
        (!all.is_empty()).then(|| all.join(", or "))
    }

    /// The remedies in words; `None` where there are none.
    pub fn ways_out(&self, front: Front) -> Option<String> {
        let remedies = self.remedies.iter();
        let all: Vec<String> = remedies
            .map(|remedy| remedies::words(remedy, front))
            .collect();
        (!all.is_empty()).then(|| all.join(", or "))
    }
}

impl std::fmt::Display for Finding {
    /// The text for nobody in particular.
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.write_str(&self.text(Front::Plain))
    }
}

impl std::error::Error for Finding {}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn no_entry_names_a_flag_or_a_command() {
        for entry in Kind::all().map(entry) {
            for words in [entry.reason, entry.text, entry.advice] {
                assert!(
                    !words.contains("--") && !words.contains("stillpoint"),
                    "{words}"
                );
                assert!(!words.ends_with(['.', ';']), "{words}");
            }
            let begin = match entry.use_of_result {
                UseOfResult::Open => "",
                UseOfResult::Conditional => "use th",
                UseOfResult::Forbidden => "do not use",
            };
            assert!(entry.advice.starts_with(begin), "{}", entry.advice);
            assert!(
                entry.reason.split_whitespace().count() <= 14,
                "{}",
                entry.reason
            );
        }
    }
}
