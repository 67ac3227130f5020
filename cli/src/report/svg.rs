//! Writing SVG: numbers short, texts escaped.

use std::fmt::Write as _;

/// Width of every picture, dots: a phone's page shows it at its own size, a wide page two side by side.
pub(super) const WIDTH: f64 = 420.0;

/// A drawing that grows downwards.
#[derive(Clone, Debug, Default)]
pub(super) struct Svg {
    body: String,
    /// Dots used so far.
    pub height: f64,
}

impl Svg {
    /// Appends markup of ours.
    pub fn raw(&mut self, markup: &str) {
        self.body.push_str(markup);
    }

    /// Opens a group with attributes of ours.
    pub fn open(&mut self, attributes: &str) {
        let _ = write!(self.body, "<g {attributes}>");
    }

    /// Closes it.
    pub fn close(&mut self) {
        self.body.push_str("</g>");
    }

    /// A text; `anchor` is `start`, `middle` or `end`.
    pub fn text(&mut self, (x, y): (f64, f64), anchor: &str, class: &str, text: &str) {
        let anchor = match anchor {
            "start" => String::new(),
            other => format!(" text-anchor=\"{other}\""),
        };
        let class = match class {
            "" => String::new(),
            class => format!(" class=\"{class}\""),
        };
        let _ = write!(
            self.body,
            "<text x=\"{}\" y=\"{}\"{anchor}{class}>{}</text>",
            num(x),
            num(y),
            escaped(text)
        );
    }

    /// A path through points, each pair of strokes apart where `apart`.
    pub fn path(&mut self, class: &str, points: &[(f64, f64)]) {
        if points.len() > 1 {
            let _ = write!(
                self.body,
                "<path class=\"{class}\" d=\"{}\"/>",
                through(points)
            );
        }
    }

    /// Straight strokes in one path.
    pub fn strokes(&mut self, class: &str, strokes: &[[(f64, f64); 2]]) {
        if strokes.is_empty() {
            return;
        }
        let all: String = strokes.iter().map(|stroke| through(stroke)).collect();
        let _ = write!(self.body, "<path class=\"{class}\" d=\"{all}\"/>");
    }

    /// A circle with further attributes of ours.
    pub fn circle(&mut self, (x, y): (f64, f64), r: f64, attributes: &str) {
        let _ = write!(
            self.body,
            "<circle cx=\"{}\" cy=\"{}\" r=\"{}\" {attributes}/>",
            num(x),
            num(y),
            num(r)
        );
    }

    /// The element for a page.
    pub fn element(&self) -> String {
        format!(
            "<svg class=\"plot\" viewBox=\"0 0 {} {}\">{}</svg>",
            num(WIDTH),
            num(self.height),
            self.body
        )
    }

    /// A document of its own with a style and a title above the drawing.
    pub fn document(&self, title: &str, style: &str) -> String {
        let lines = wrapped(title, WIDTH - 8.0, 1.08);
        let above = 18.0 * lines.len() as f64 + 6.0;
        let mut head = Self::default();
        for (k, line) in lines.iter().enumerate() {
            head.text((4.0, 16.0 + 18.0 * k as f64), "start", "", line);
        }
        let height = num(self.height + above);
        let width = num(WIDTH);
        format!(
            "<svg xmlns=\"http://www.w3.org/2000/svg\" class=\"plot\" viewBox=\"0 0 {width} {height}\" \
             width=\"{width}\" height=\"{height}\"><style>{style}</style>\
             <rect class=\"bg\" width=\"{width}\" height=\"{height}\"/>{}\
             <g transform=\"translate(0 {above})\">{}</g></svg>\n",
            head.body, self.body
        )
    }
}

fn through(points: &[(f64, f64)]) -> String {
    let mut d = String::new();
    let mut before = None;
    for (x, y) in points {
        let (x, y) = (num(*x), num(*y));
        // Writing to memory does not fail.
        let _ = match &before {
            None => write!(d, "M{x} {y}"),
            Some(same) if *same == x => write!(d, "V{y}"),
            Some(_) => write!(d, "L{x} {y}"),
        };
        before = Some(x);
    }
    d
}

/// A number of dots with one decimal at most.
pub(super) fn num(v: f64) -> String {
    let text = format!("{:.1}", v + 0.0);
    let text = text.strip_suffix(".0").unwrap_or(&text);
    if text == "-0" {
        "0".into()
    } else {
        text.into()
    }
}

/// Text in an element or in a quoted attribute.
pub(super) fn escaped(text: &str) -> String {
    let mut safe = String::with_capacity(text.len());
    for c in text.chars() {
        match c {
            '<' => safe.push_str("&lt;"),
            '>' => safe.push_str("&gt;"),
            '&' => safe.push_str("&amp;"),
            '"' => safe.push_str("&quot;"),
            '\'' => safe.push_str("&#39;"),
            c => safe.push(c),
        }
    }
    safe
}

/// About the width of a text of 12 dots' height.
pub(super) fn text_width(text: &str) -> f64 {
    let wide = |c: char| match c {
        'i' | 'l' | 'j' | '.' | ',' | ' ' | '|' | ':' | '\'' => 4.2,
        'm' | 'w' | 'M' | 'W' | '%' => 11.0,
        '−' | '+' | '±' => 10.1,
        c if c.is_ascii_uppercase() => 8.6,
        c if u32::from(c) >= 0x2e80 => 12.5,
        _ => 7.4,
    };
    text.chars().map(wide).sum()
}

/// The text in lines of a width; `size` times 12 dots high.
pub(super) fn wrapped(text: &str, width: f64, size: f64) -> Vec<String> {
    let mut lines = vec![String::new()];
    for word in text.split_whitespace() {
        let word = fitted(word, width / size);
        let Some(line) = lines.last_mut() else { break };
        let longer = format!("{line} {word}");
        if line.is_empty() {
            *line = word;
        } else if size * text_width(&longer) <= width {
            *line = longer;
        } else {
            lines.push(word);
        }
    }
    lines
}

/// The text, its middle left out where it is wider.
pub(super) fn fitted(text: &str, width: f64) -> String {
    if text_width(text) <= width {
        return text.to_owned();
    }
    let letters: Vec<char> = text.chars().collect();
    let mut kept = letters.len().saturating_sub(1);
    loop {
        let (head, tail) = (kept - kept / 2, kept / 2);
        let short: String = letters[..head]
            .iter()
            .chain(['…'].iter())
            .chain(&letters[letters.len() - tail..])
            .collect();
        if kept <= 2 || text_width(&short) <= width {
            return short;
        }
        kept -= 1;
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_are_short_and_have_no_empty_sign() {
        assert_eq!([num(1.0), num(-0.04), num(2.25)], ["1", "0", "2.2"]);
    }

    #[test]
    fn a_long_name_loses_its_middle_and_a_long_title_is_wrapped() {
        let short = fitted("recording_of_the_morning_001.csv", 80.0);
        assert!(short.starts_with("reco") && short.ends_with("csv") && text_width(&short) <= 80.0);
        assert_eq!(wrapped("one two", 30.0, 1.0), ["one", "two"]);
    }
}
