//! Times of a twelve-hour clock, `01:05:10.5 PM`, as those of 24 hours.

use std::borrow::Cow;

/// What stands behind the hours before noon and after it, without points.
const HALVES: [(&str, bool); 2] = [("am", false), ("pm", true)];

/// Splits a text into what is before `AM`, `pm` or `p.m.` at its end, and whether that is after noon; `None` where no digit stands
/// before it.
fn half(text: &str) -> Option<(&str, bool)> {
    let end = text.trim_end();
    let begin = end.trim_end_matches(|c: char| c.is_ascii_alphabetic() || c == '.');
    let letters: String = end[begin.len()..]
        .chars()
        .filter(|c| *c != '.')
        .flat_map(char::to_lowercase)
        .collect();
    let (_, after_noon) = HALVES.iter().find(|(half, _)| *half == letters)?;
    let before = begin.trim_end();
    before
        .ends_with(|c: char| c.is_ascii_digit())
        .then_some((before, *after_noon))
}

/// The text with the hours of 24 instead of twelve and a half of the day; others as they are. The time stands at its end, behind a
/// date or alone. Hours from 13 on have no half and stay.
pub(crate) fn of_the_day(text: &str) -> Cow<'_, str> {
    let Some((time, after_noon)) = half(text) else {
        return Cow::Borrowed(text);
    };
    let digits = time.find(':').map(|colon| {
        let begin = time[..colon].trim_end_matches(|c: char| c.is_ascii_digit());
        begin.len()..colon
    });
    let hour = digits.clone().and_then(|at| time[at].parse::<u32>().ok());
    match (digits, hour) {
        (Some(at), Some(hour @ 1..=12)) => {
            let hour = hour % 12 + if after_noon { 12 } else { 0 };
            Cow::Owned(format!("{}{hour:02}{}", &time[..at.start], &time[at.end..]))
        }
        _ => Cow::Borrowed(text),
    }
}

/// Returns the length of the half of the day, and the blanks before it, that `text` begins with; 0 of any other text.
pub(crate) fn length_of_half(text: &str) -> usize {
    let letters = text.trim_start_matches([' ', '\u{a0}', '\u{202f}']);
    let end = letters.find(|c: char| !c.is_ascii_alphabetic() && c != '.');
    let word = &letters[..end.unwrap_or(letters.len())];
    match half(&format!("0{word}")) {
        Some(_) => text.len() - letters.len() + word.len(),
        None => 0,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn noon_is_twelve_and_midnight_is_zero() {
        for (text, expected) in [
            ("12:59:59.9 PM", "12:59:59.9"),
            ("01:00:00 pm", "13:00:00"),
            ("1:00:02.5 AM", "01:00:02.5"),
            ("12:00:00.5AM", "00:00:00.5"),
            ("11:59:59 p.m.", "23:59:59"),
            ("2026-11-21 12:59:20.000 PM", "2026-11-21 12:59:20.000"),
            ("2026-11-21 3:04:05 PM", "2026-11-21 15:04:05"),
            // No time of a twelve-hour clock.
            ("13:00:00 PM", "13:00:00 PM"),
            ("00:00:00 AM", "00:00:00 AM"),
            ("13:00:00", "13:00:00"),
            ("PM", "PM"),
            ("spam", "spam"),
        ] {
            assert_eq!(of_the_day(text), expected, "{text}");
        }
    }

    #[test]
    fn the_half_of_the_day_ends_a_time() {
        assert_eq!(length_of_half(" PM,0.1"), 3);
        assert_eq!(length_of_half("p.m.\t0.1"), 4);
        assert_eq!(length_of_half(",0.1,pm") + length_of_half(" ping"), 0);
    }
}
