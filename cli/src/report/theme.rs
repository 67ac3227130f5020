//! Colours of plots on light and on dark pages, as style sheets.

/// Rules that pages, pictures and the PNG share; colours are variables.
const RULES: &str = include_str!("../../templates/plot.css");

/// Name of a variable, on light pages, on dark pages. The series are distinguishable with every kind of colour vision
/// (Okabe and Ito, Color universal design, 2008), darkened where they were too pale on white.
const COLOURS: [(&str, &str, &str); 12] = [
    ("--ink", "#202124", "#e6e8ec"),
    ("--soft", "#555b64", "#a9b0ba"),
    ("--page", "#ffffff", "#16181c"),
    ("--line", "#c9cdd4", "#4a5059"),
    ("--band", "#f1f3f6", "#23272e"),
    ("--s0", "#0072b2", "#56b4e9"),
    ("--s1", "#c45500", "#ff9147"),
    ("--s2", "#00805f", "#2bc49a"),
    ("--s3", "#a64d84", "#e59ac6"),
    ("--s4", "#946400", "#f0b429"),
    ("--s5", "#4a56c8", "#9aa5ff"),
    ("--s6", "#737880", "#8f959e"),
];

/// Number of colours for series; the last is the grey of what is not calibrated.
pub(super) const SERIES: usize = 7;

/// The style of a page's plots: variables for light, dark and paper, and the rules.
pub(super) fn of_page() -> String {
    let [light, dark] = [variables(|c| c.1), variables(|c| c.2)];
    format!(
        ":root{{{light}}}@media(prefers-color-scheme:dark){{:root{{{dark}}}}}@media print{{:root{{{light}}}}}{RULES}"
    )
}

/// The style of a picture of its own.
pub(super) fn of_picture() -> String {
    let [light, dark] = [variables(|c| c.1), variables(|c| c.2)];
    format!("svg{{{light}}}@media(prefers-color-scheme:dark){{svg{{{dark}}}}}{RULES}")
}

/// The rules with colours for white paper in them, for a renderer without variables.
pub(super) fn of_paper() -> String {
    COLOURS
        .iter()
        .fold(RULES.to_owned(), |css, (name, light, _)| {
            css.replace(&format!("var({name})"), light)
        })
}

fn variables(of: fn(&(&'static str, &'static str, &'static str)) -> &'static str) -> String {
    let all = COLOURS.iter().map(|c| format!("{}:{};", c.0, of(c)));
    all.collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Relative luminance (WCAG 2.2, definition).
    fn luminance(colour: &str) -> f64 {
        let part = |k: usize| {
            let byte = u8::from_str_radix(&colour[k..k + 2], 16).unwrap();
            let c = f64::from(byte) / 255.0;
            if c <= 0.04045 {
                c / 12.92
            } else {
                ((c + 0.055) / 1.055).powf(2.4)
            }
        };
        0.2126 * part(1) + 0.7152 * part(3) + 0.0722 * part(5)
    }

    fn contrast(one: &str, other: &str) -> f64 {
        let (a, b) = (luminance(one), luminance(other));
        (a.max(b) + 0.05) / (a.min(b) + 0.05)
    }

    #[test]
    fn words_and_marks_stand_out_on_either_page() {
        let page = COLOURS[2];
        for (name, light, dark) in COLOURS {
            // WCAG 2.2: 4.5 for text (1.4.3), 3 for graphics (1.4.11).
            let asked = match name {
                "--ink" | "--soft" => 4.5,
                _ if name.starts_with("--s") => 3.0,
                _ => continue,
            };
            for (colour, page) in [(light, page.1), (dark, page.2)] {
                let found = contrast(colour, page);
                assert!(found >= asked, "{name} {colour}: {found:.2}");
            }
        }
    }

    #[test]
    fn the_paper_has_no_variable_left() {
        assert!(!of_paper().contains("var("));
    }
}
