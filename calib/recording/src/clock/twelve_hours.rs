//! Times of a twelve-hour clock, `01:05:10.5 PM`, as those of 24 hours.

use std::borrow::Cow;

/// Marks behind the hours before noon and after it, or before them, without points and blanks.
const HALVES: [(&str, bool); 8] = [
    ("am", false),
    ("pm", true),
    ("오전", false),
    ("오후", true),
    ("上午", false),
    ("下午", true),
    ("午前", false),
    ("午後", true),
];

/// The half of the day that a word is, true after noon: `PM`, `p. m.`, `下午`.
fn half(word: &str) -> Option<bool> {
    let letters: String = word
        .chars()
        .filter(|c| *c != '.' && !c.is_whitespace())
        .flat_map(char::to_lowercase)
        .collect();
    let known = HALVES.iter().find(|(half, _)| *half == letters);
    known.map(|(_, after_noon)| *after_noon)
}

/// Returns where the digits of the hour before the first colon begin, and where they end.
fn hour_in(text: &str) -> Option<(usize, usize)> {
    let colon = text.find(':')?;
    let begin = text[..colon].trim_end_matches(|c: char| c.is_ascii_digit());
    Some((begin.len(), colon))
}

/// The text with the hours of 24 instead of twelve and a half of the day; others as they are. The time stands at its end, behind a
/// date or alone, and the half behind it or before it. Hours from 13 on have no half and stay.
pub(crate) fn of_the_day(text: &str) -> Cow<'_, str> {
    converted(text).map_or(Cow::Borrowed(text), Cow::Owned)
}

fn converted(text: &str) -> Option<String> {
    let (begin, colon) = hour_in(text)?;
    let is_digit = |c: char| c.is_ascii_digit();
    let end = text.trim_end_matches(|c: char| !is_digit(c)).len();
    let before = text[..begin].trim_end_matches(|c: char| !is_digit(c));
    let behind = half(&text[end..]).map(|after_noon| (after_noon, &text[..begin]));
    let (after_noon, date) =
        behind.or_else(|| Some((half(&text[before.len()..begin])?, before)))?;
    let hour: u32 = text[begin..colon].parse().ok()?;
    let mark = match date.ends_with(is_digit) {
        true => " ",
        false => "",
    };
    (1..=12).contains(&hour).then(|| {
        let hour = hour % 12 + if after_noon { 12 } else { 0 };
        format!("{date}{mark}{hour:02}{}", &text[colon..end])
    })
}

/// Returns the length of the half of the day, and the blanks before it, that `text` begins with; 0 of any other text.
pub(crate) fn length_of_half(text: &str) -> usize {
    let blanks = text.len() - text.trim_start_matches([' ', '\u{a0}', '\u{202f}']).len();
    let word = &text[blanks..];
    let is_part = |c: char| c.is_alphabetic() || c == '.';
    let end = |from: usize| {
        let rest = &word[from..];
        from + rest.find(|c: char| !is_part(c)).unwrap_or(rest.len())
    };
    let first = end(0);
    // `p. m.` has a blank in it.
    let blank = word[first..].chars().next().filter(|c| c.is_whitespace());
    let next = blank.map(|blank| first + blank.len_utf8());
    let second = next.map(end).filter(|end| Some(*end) > next);
    let ends = second.into_iter().chain([first]);
    let found = { ends }.find(|end| half(&word[..*end]).is_some());
    found.map_or(0, |end| blanks + end)
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
            ("11:59:59.5 p. m.", "23:59:59.5"),
            // The half before the hours.
            ("PM 11:59:30", "23:59:30"),
            ("오전 12:00:01", "00:00:01"),
            ("2026-11-21 오후 3:04:05", "2026-11-21 15:04:05"),
            ("2026/11/21 下午03:04:05", "2026/11/21 15:04:05"),
            ("2026-11-21T03:04:05", "2026-11-21T03:04:05"),
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
        assert_eq!(length_of_half(" p.\u{a0}m.;0.1"), 7);
        assert_eq!(length_of_half(",0.1,pm") + length_of_half(" ping"), 0);
    }
}
