//! The sampling rate that the lines above a table state: `# Sample rate: 100.0 Hz`, `Fs;50`, `sample interval: 20 ms`.

use crate::header::look::Look;
use crate::header::preface::is_comment;

/// Rates that a sensor may have, Hz.
const RATES: std::ops::Range<f64> = 1.0..40_000.0;

/// Words for a rate, and for the time from sample to sample, in small letters.
const OF_RATES: [&str; 8] = [
    "rate",
    "frequency",
    "frequenz",
    "freq",
    "fs",
    "odr",
    "hz",
    "abtastrate",
];
const OF_STEPS: [&str; 3] = ["interval", "period", "intervall"];

/// Words of other rates.
const OF_OTHERS: [&str; 15] = [
    "filter", "cut", "band", "cpu", "clock", "baud", "bus", "spi", "i2c", "gps", "gnss", "mag",
    "baro", "video", "frame",
];

/// Returns the one rate that the lines above the rows of a text state, Hz; `None` where they state none or several.
pub(crate) fn said_rate(head: &[u8]) -> Option<f64> {
    let look = Look::at(head);
    let is_row = |line: &str| {
        let unsigned = line.trim_start_matches(['+', '-', '.']);
        unsigned.starts_with(|c: char| c.is_ascii_digit()) && !is_comment(line.as_bytes())
    };
    let above = look.lines().take_while(|line| !is_row(line.trim_start()));
    let clauses: Vec<String> = above.flat_map(clauses).collect();
    let mut rates = clauses.iter().filter_map(|clause| of_clause(clause));
    let first = rates.next()?;
    rates.all(|rate| rate == first).then_some(first)
}

/// The statements of a line, in small letters: `Fs;50` is one statement, and `rate = 100 Hz, range = 4 g` are two.
fn clauses(line: &str) -> Vec<String> {
    let line = line.to_lowercase();
    let has_number = |part: &str| part.contains(|c: char| c.is_ascii_digit());
    let parts = || line.split([',', ';', '\t', '|']);
    match parts().next().is_some_and(has_number) || parts().count() > 3 {
        true => parts().map(str::to_owned).collect(),
        false => vec![line],
    }
}

/// The rate that a statement in small letters states.
fn of_clause(clause: &str) -> Option<f64> {
    let separates = |c: char| c.is_whitespace() || "=:,;()[]\"\t".contains(c);
    let words: Vec<&str> = clause
        .split(separates)
        .filter(|word| !word.is_empty())
        .collect();
    let (at, value, unit) = words.iter().enumerate().find_map(|(at, word)| {
        let digits = word
            .find(|c: char| !c.is_ascii_digit() && c != '.')
            .unwrap_or(word.len());
        let value: f64 = word[..digits].parse().ok()?;
        let behind = &word[digits..];
        Some((
            at,
            value,
            if behind.is_empty() {
                words.get(at + 1).copied().unwrap_or_default()
            } else {
                behind
            },
        ))
    })?;
    let is_of_another = |word: &&str| OF_OTHERS.iter().any(|other| word.contains(other));
    if words[..at].iter().any(is_of_another) {
        return None;
    }
    let says = |wanted: &[&str]| words[..at].iter().any(|word| wanted.contains(word));
    let rate = match unit {
        "hz" | "sps" => value,
        "ms" if says(&OF_STEPS) => 1e3 / value,
        "s" | "sec" | "seconds" if says(&OF_STEPS) => value.recip(),
        _ if says(&OF_RATES) => value,
        _ => return None,
    };
    RATES.contains(&rate).then_some(rate)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn rates_above_tables_are_found() {
        for (line, rate) in [
            ("Sample rate: 100.0Hz", Some(100.0)),
            ("# Sampling frequency (Hz): 52", Some(52.0)),
            ("Fs;50", Some(50.0)),
            ("LSM6DSO ODR=104Hz FS=2g", Some(104.0)),
            ("# sample interval: 20 ms", Some(50.0)),
            (
                "# Config: data_rate = 2000.0 Hz, filter = 488 Hz, acc_range = 4 g",
                Some(2000.0),
            ),
            (
                "--- Data File Created By ActiGraph date format M/d/yyyy at 30 Hz  Filter Normal ---",
                Some(30.0),
            ),
            ("# range 4 g, filter 42 Hz", None),
            ("# rate 100 Hz\n# rate 50 Hz", None),
            ("Number of samples: 100", None),
        ] {
            let text = format!("{line}\nax,ay,az\n1,2,3\n4,5,6\n");
            assert_eq!(said_rate(text.as_bytes()), rate, "{line}");
        }
    }
}
