//! The words of findings: one entry per kind, filled with a finding's numbers.

pub(crate) mod command;
mod entry;
mod human;
pub(crate) mod remedies;
mod shell;
mod tables;
mod template;

pub use entry::{Entry, Front};
pub use human::{human, significant};
pub use tables::{entries, entry};

use crate::finding::Finding;
use crate::kind::Kind;

/// The table of all kinds for the manual: name, level, text with its names in braces, ways out.
pub fn manual_table() -> String {
    let mut table = String::from("| kind | level | says | to do |\n| --- | --- | --- | --- |\n");
    for kind in Kind::ALL {
        let entry = entry(*kind);
        let remedies = (entry.remedies)();
        let remedies: Vec<String> = remedies
            .iter()
            .map(|remedy| remedies::words(remedy, Front::CommandLine))
            .collect();
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

impl Finding {
    /// The finding in words: where, what, and what to do.
    pub fn text(&self, front: Front) -> String {
        let what = template::filled(entry(self.kind).text, self);
        let mut text = match &self.place.recording {
            Some(place) => format!("{place}: {what}"),
            None => what,
        };
        if let Some(advice) = self.advice(front) {
            text.push_str("; ");
            text.push_str(&advice);
        }
        text
    }

    /// The reason in a few words, without its place.
    pub fn reason(&self) -> String {
        template::filled(entry(self.kind).reason, self)
    }

    /// What to do about it; none where nothing helps or nothing has to be done.
    pub fn advice(&self, front: Front) -> Option<String> {
        let all = self.remedies.iter();
        let all: Vec<String> = all.map(|remedy| remedies::words(remedy, front)).collect();
        (!all.is_empty()).then(|| all.join(", or "))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_kind_has_exactly_one_entry_and_its_own_name() {
        for kind in Kind::ALL {
            let count = entries().filter(|entry| entry.kind == *kind).count();
            assert_eq!(count, 1, "{}", kind.name());
            assert_eq!(Kind::named(kind.name()), *kind);
        }
        assert_eq!(entries().count(), Kind::ALL.len());
    }

    #[test]
    fn no_entry_names_a_flag_or_a_command() {
        for entry in entries() {
            for words in [entry.reason, entry.text] {
                assert!(
                    !words.contains("--") && !words.contains("stillpoint"),
                    "{words}"
                );
                assert!(!words.ends_with(['.', ';']), "{words}");
            }
            assert!(
                entry.reason.split_whitespace().count() <= 14,
                "{}",
                entry.reason
            );
        }
    }
}
