//! Templates: text with names in braces, and parts in brackets that depend on them.

use crate::finding::Finding;

use super::human::human;
use super::parameters;

/// The template with the finding's numbers, words and place in it. A part in brackets is left out where a name in it is
/// not known; elsewhere such a name becomes `?`. `{count:gap}` is `1 gap` or `3 gaps`.
pub(super) fn filled(template: &str, finding: &Finding) -> String {
    let mut text = String::with_capacity(2 * template.len());
    let mut left = template;
    while let Some(open) = left.find('[') {
        let (before, from) = left.split_at(open);
        text.push_str(&plain(before, finding).0);
        let close = from.find(']').unwrap_or(from.len());
        let (part, all_known) = plain(from.get(1..close).unwrap_or_default(), finding);
        if all_known {
            text.push_str(&part);
        }
        left = from.get(close + 1..).unwrap_or_default();
    }
    text.push_str(&plain(left, finding).0);
    text
}

/// Text without brackets, and whether all its names are known.
fn plain(template: &str, finding: &Finding) -> (String, bool) {
    let mut text = String::new();
    let mut all_known = true;
    let mut left = template;
    while let Some((before, from)) = left.split_once('{') {
        text.push_str(before);
        let (name, after) = from.split_once('}').unwrap_or((from, ""));
        match known(name, finding) {
            Some(words) => text.push_str(&words),
            None => {
                text.push('?');
                all_known = false;
            }
        }
        left = after;
    }
    text.push_str(left);
    (text, all_known)
}

/// Returns the text for a name in a template; `None` if the finding does not give it.
fn known(name: &str, finding: &Finding) -> Option<String> {
    let place = &finding.place;
    match name {
        "sensor" => return place.sensor.map(|sensor| sensor.name().to_owned()),
        "at" => return at(finding),
        "t0" => return place.t0.map(|t| format!("{t:.2} s")),
        "t1" => return place.t1.map(|t| format!("{t:.2} s")),
        _ => {}
    }
    if let Some((name, thing)) = name.split_once(':') {
        let plural = match finding.value(name)? == 1.0 {
            true => "",
            false if thing.ends_with("ch") => "es",
            false => "s",
        };
        return Some(format!("{} {thing}{plural}", known(name, finding)?));
    }
    if let Some(number) = finding.numbers.iter().find(|n| n.name == name) {
        return number.value.map(|value| human(value, &number.unit));
    }
    match (finding.word(name), name) {
        (Some(word), "parameter") => Some(parameters::with_words(word)),
        (Some(word), _) => Some(word.to_owned()),
        (None, "interval") => place.interval.map(|interval| interval.to_string()),
        (None, "turn") => place.turn.map(|turn| turn.to_string()),
        (None, _) => None,
    }
}

/// `static interval 3 (t = 1.20 to 4.50 s)`, or as much of it as is known.
fn at(finding: &Finding) -> Option<String> {
    let place = &finding.place;
    let time = match (place.t0, place.t1) {
        (Some(t0), Some(t1)) => Some(format!("t = {t0:.2} to {t1:.2} s")),
        (Some(t0), None) => Some(format!("t = {t0:.2} s")),
        _ => None,
    };
    let what = match (place.interval, place.turn) {
        (Some(interval), _) => Some(format!("static interval {interval}")),
        (None, Some(turn)) => Some(format!("turn {turn}")),
        _ => None,
    };
    match (what, time) {
        (Some(what), Some(time)) => Some(format!("{what} ({time})")),
        (one, other) => one.or(other),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::kind::Kind;

    #[test]
    fn names_are_filled_and_parts_without_theirs_left_out() {
        let found = Finding::of(Kind::REMARK)
            .at_interval(2)
            .between(1.0, 2.5)
            .number("size", 0.0028, "m/s^2")
            .detail("axis", "x");
        let text = filled("{at}: {size} on {axis}[ and {other}][ (of {axis})]", &found);
        assert_eq!(
            text,
            "static interval 3 (t = 1.00 to 2.50 s): 2.8 mm/s² on x (of x)"
        );
    }

    #[test]
    fn things_are_counted_in_the_singular_and_in_the_plural() {
        let found = |count| Finding::of(Kind::REMARK).count("count", count);
        let text = [1, 3].map(|count| filled("{count:gap}[, {more:row}]", &found(count)));
        assert_eq!(text, ["1 gap", "3 gaps"]);
    }
}
