//! Directions in parameter space written in parameter names.

/// A component smaller than this, relative to the largest, is not named.
const NAMED_COMPONENT: f64 = 0.05;

/// A direction as `a + 0.5 b - c`.
pub(crate) fn in_words(direction: &[f64], names: &[String]) -> String {
    let largest = direction
        .iter()
        .copied()
        .fold(0.0, |a: f64, b| if b.abs() > a.abs() { b } else { a });
    let mut words = String::new();
    for (value, name) in direction.iter().zip(names) {
        let c = value / largest;
        if c.abs() < NAMED_COMPONENT {
            continue;
        }
        let sign = if c < 0.0 { "-" } else { "+" };
        if !words.is_empty() {
            words.push_str(&format!(" {sign} "));
        } else if c < 0.0 {
            words.push('-');
        }
        if (c.abs() - 1.0).abs() > 0.005 {
            words.push_str(&format!("{:.2} ", c.abs()));
        }
        words.push_str(name);
    }
    words
}
