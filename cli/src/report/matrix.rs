//! Correlations as a table of coloured squares.

use super::svg::{Svg, WIDTH, escaped, fitted, num, text_width};

/// Correlations below this are left blank.
const FAINT: f64 = 0.03;
/// Squares are at most this large.
const LARGEST: f64 = 30.0;

/// The drawing of a symmetric matrix with ones on its diagonal (`n × n`, rows).
pub(super) fn drawing(names: &[String], rows: &[Vec<f64>]) -> Svg {
    let mut svg = Svg::default();
    let names: Vec<String> = names.iter().map(|name| fitted(name, 90.0)).collect();
    let left = names.iter().map(|n| text_width(n)).fold(20.0, f64::max) + 6.0;
    let count = names.len().max(1) as f64;
    let side = ((WIDTH - left - 4.0) / count).min(LARGEST);
    let size = side * count;
    let (top, font) = (left, (side * 0.85).clamp(5.0, 12.0));
    let (x, y, dots) = (num(left), num(top), num(size));
    svg.raw(&format!(
        "<rect class=\"ball\" x=\"{x}\" y=\"{y}\" width=\"{dots}\" height=\"{dots}\"/>"
    ));
    for (i, name) in names.iter().enumerate() {
        let middle = (i as f64 + 0.5) * side;
        let name = escaped(name);
        svg.raw(&format!(
            "<text x=\"{}\" y=\"{}\" text-anchor=\"end\" font-size=\"{font}\">{name}</text>\
             <text transform=\"translate({} {}) rotate(-90)\" font-size=\"{font}\">{name}</text>",
            num(left - 4.0),
            num(top + middle + 0.35 * font),
            num(left + middle + 0.35 * font),
            num(top - 4.0),
        ));
    }
    // The other triangle is the mirror of this one.
    for (i, row) in rows.iter().enumerate() {
        let lower = row.iter().enumerate().take(i + 1);
        for (j, value) in lower.filter(|(_, v)| v.abs() >= FAINT) {
            let (x, y) = (left + j as f64 * side, top + i as f64 * side);
            let colour = if *value < 0.0 { 1 } else { 0 };
            let words = if i == j {
                String::new()
            } else {
                let pair = format!("{} and {}: {value:+.2}", names[i], names[j]);
                format!(" data-t=\"{}\"", escaped(&pair))
            };
            svg.raw(&format!(
                "<rect class=\"cell c{colour}\" x=\"{}\" y=\"{}\" width=\"{2}\" height=\"{2}\" opacity=\"{3:.2}\"{words}/>",
                num(x),
                num(y),
                num(side),
                value.abs().min(1.0)
            ));
        }
    }
    svg.height = top + size + 24.0;
    let y = svg.height - 6.0;
    let mut x = 4.0;
    for (colour, words) in [
        (1, "−1"),
        (0, "+1: strength of the colour is the correlation"),
    ] {
        svg.raw(&format!(
            "<rect class=\"cell c{colour}\" x=\"{}\" y=\"{}\" width=\"12\" height=\"12\"/>",
            num(x),
            num(y - 10.0)
        ));
        svg.text((x + 17.0, y), "start", "soft", words);
        x += 50.0;
    }
    svg
}
