//! One self-contained HTML page: verdict and next step first, everything else below.

use ::findings::Grade;
use askama::Template;
use base64::Engine as _;
use base64::prelude::BASE64_STANDARD;
use sha2::{Digest, Sha256};

use super::picture::Picture;
use super::theme;
use crate::exit::{BUG, Failure};
use crate::show;

/// The one script of every page: it adds what a pointer can do, and the page says all without it.
const SCRIPT: &str = include_str!("../../templates/report.js");
/// The style of a page, beside that of its plots.
const STYLE: &str = include_str!("../../templates/report.css");

/// A report: verdict, next steps, warnings, and sections of text, tables and pictures.
///
/// Everything given to it is plain text and is escaped. The page loads nothing and runs one fixed script, whose hash
/// stands in its content security policy.
#[derive(Debug, Template)]
#[template(path = "report.html")]
pub struct Report {
    title: String,
    by: &'static str,
    verdict: Option<(Level, String)>,
    figures: Vec<Figure>,
    next: Vec<String>,
    limits: Vec<Limit>,
    warnings: Vec<String>,
    sections: Vec<Section>,
    provenance: Vec<[String; 2]>,
    exports: Vec<[String; 2]>,
}

/// Quality level of a result.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Level {
    /// Nothing speaks against it.
    Good,
    /// To be used with the warnings in mind.
    Care,
    /// Not to be used.
    Bad,
    /// There is no calibration.
    Refused,
}

impl From<Grade> for Level {
    fn from(grade: Grade) -> Self {
        match grade {
            Grade::Good => Self::Good,
            Grade::Care => Self::Care,
            Grade::Bad => Self::Bad,
        }
    }
}

impl Level {
    /// Its class in a page's style.
    pub fn class(self) -> &'static str {
        match self {
            Self::Good => "good",
            Self::Care => "care",
            Self::Bad | Self::Refused => "bad",
        }
    }

    /// In words.
    pub fn words(self) -> &'static str {
        match self {
            Self::Good => "✓ Good",
            Self::Care => "! With care",
            Self::Bad => "✗ Not to be used",
            Self::Refused => "✗ No calibration",
        }
    }
}

/// One of the figures under the verdict.
#[derive(Clone, Debug, PartialEq)]
pub struct Figure {
    label: String,
    value: String,
    note: String,
}

impl Figure {
    /// Builds a figure from its name, its value and a note.
    pub fn new(label: &str, value: impl Into<String>, note: impl Into<String>) -> Self {
        Self {
            label: safe(label),
            value: safe(value.into()),
            note: safe(note.into()),
        }
    }

    /// The same three for a terminal.
    pub fn words(&self) -> [&str; 3] {
        [&self.label, &self.value, &self.note]
    }
}

/// A limit that was asked for, and whether it holds.
#[derive(Clone, Debug, PartialEq)]
pub struct Limit {
    /// True if the limit is kept.
    pub passed: bool,
    /// Requirement and value found, in words.
    pub words: String,
}

#[derive(Debug)]
struct Section {
    heading: String,
    folded: bool,
    blocks: Vec<Block>,
}

#[derive(Debug)]
enum Block {
    Text(String),
    Table(ReportTable),
    Figures(Vec<Drawn>),
}

/// A picture drawn by us: no text in it is markup.
#[derive(Debug)]
struct Drawn {
    title: String,
    svg: String,
}

/// A table of plain text; the first column is aligned left, the others right.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct ReportTable {
    header: Vec<String>,
    rows: Vec<(Option<String>, Vec<String>)>,
}

impl ReportTable {
    /// Without rows yet.
    pub fn new<S: Into<String>>(header: impl IntoIterator<Item = S>) -> Self {
        Self {
            header: header.into_iter().map(|cell| safe(cell.into())).collect(),
            rows: Vec::new(),
        }
    }

    /// A table with rows.
    pub fn of<S: Into<String>, R: IntoIterator<Item: Into<String>>>(
        header: impl IntoIterator<Item = S>,
        rows: impl IntoIterator<Item = R>,
    ) -> Self {
        let mut table = Self::new(header);
        rows.into_iter().for_each(|row| table.row(row));
        table
    }

    /// Appends a row.
    pub fn row<S: Into<String>>(&mut self, cells: impl IntoIterator<Item = S>) {
        let safe = cells.into_iter().map(|cell| safe(cell.into()));
        self.rows.push((None, safe.collect()));
    }

    /// Appends the row of an interval, which points of that key in pictures show.
    pub fn keyed<S: Into<String>>(&mut self, key: &str, cells: impl IntoIterator<Item = S>) {
        self.row(cells);
        if let Some(row) = self.rows.last_mut() {
            row.0 = Some(safe(key));
        }
    }
}

impl Report {
    /// An empty report.
    pub fn new(title: impl Into<String>) -> Self {
        Self {
            title: safe(title.into()),
            by: concat!("stillpoint ", env!("CARGO_PKG_VERSION")),
            verdict: None,
            figures: Vec::new(),
            next: Vec::new(),
            limits: Vec::new(),
            warnings: Vec::new(),
            sections: Vec::new(),
            provenance: Vec::new(),
            exports: Vec::new(),
        }
    }

    /// With the verdict in one sentence, first of all.
    #[must_use]
    pub fn verdict(mut self, level: Level, sentence: impl AsRef<str>) -> Self {
        self.verdict = Some((level, safe(show::shortened(sentence.as_ref()))));
        self
    }

    /// With the figures under the verdict.
    #[must_use]
    pub fn figures(mut self, figures: impl IntoIterator<Item = Figure>) -> Self {
        self.figures.extend(figures);
        self
    }

    /// With what to do next, a sentence each, the most telling first.
    #[must_use]
    pub fn next(mut self, sentences: &[String]) -> Self {
        let safe = sentences.iter().map(|s| safe(show::shortened(s)));
        self.next.extend(safe);
        self
    }

    /// With the limits that were asked for, above the figures.
    #[must_use]
    pub fn limits(mut self, limits: impl IntoIterator<Item = Limit>) -> Self {
        let safe = limits.into_iter().map(|limit| Limit {
            words: safe(limit.words),
            ..limit
        });
        self.limits.extend(safe);
        self
    }

    /// With warnings, folded under what to do next.
    #[must_use]
    pub fn warnings(mut self, warnings: &[String]) -> Self {
        let safe = warnings.iter().map(|w| safe(show::shortened(w)));
        self.warnings.extend(safe);
        self
    }

    /// With where it comes from: what, and which.
    #[must_use]
    pub fn provenance(mut self, rows: impl IntoIterator<Item = [String; 2]>) -> Self {
        let safe = rows.into_iter().map(|row| row.map(safe));
        self.provenance.extend(safe);
        self
    }

    /// With a text to be copied: its name and itself.
    #[must_use]
    pub fn export(mut self, name: &str, text: impl Into<String>) -> Self {
        self.exports.push([safe(name), safe(text.into())]);
        self
    }

    /// Opens a section; text, tables and plots go into the last one.
    #[must_use]
    pub fn section(mut self, heading: impl Into<String>) -> Self {
        self.sections.push(Section {
            heading: safe(heading.into()),
            folded: false,
            blocks: Vec::new(),
        });
        self
    }

    /// Opens a section that is folded up on a screen and open on paper.
    #[must_use]
    pub fn folded(mut self, heading: impl Into<String>) -> Self {
        self = self.section(heading);
        if let Some(section) = self.sections.last_mut() {
            section.folded = true;
        }
        self
    }

    /// With a paragraph.
    #[must_use]
    pub fn text(self, text: impl Into<String>) -> Self {
        self.block(Block::Text(safe(text.into())))
    }

    /// With a table.
    #[must_use]
    pub fn table(self, table: ReportTable) -> Self {
        self.block(Block::Table(table))
    }

    /// With a picture, beside the one before it where the page is wide.
    #[must_use]
    pub fn plot(mut self, picture: &Picture) -> Self {
        let drawn = Drawn {
            title: safe(picture.title()),
            svg: picture.element(),
        };
        let last = self.sections.last_mut().and_then(|s| s.blocks.last_mut());
        if let Some(Block::Figures(figures)) = last {
            figures.push(drawn);
            return self;
        }
        self.block(Block::Figures(vec![drawn]))
    }

    /// The page.
    ///
    /// # Errors
    /// What the template refuses (a bug of ours).
    pub fn html(&self) -> Result<String, Failure> {
        self.render()
            .map_err(|e| Failure::new(BUG, format!("the report could not be made: {e}")))
    }

    /// The text before a command, the command, the text behind it …: a command of ours begins behind a colon, or stands between
    /// backticks.
    fn commands(step: &str) -> impl Iterator<Item = &str> {
        let mut parts: Vec<&str> = step.split('`').collect();
        if let [only] = parts[..]
            && let Some((before, _)) = only.split_once(": stillpoint ")
        {
            let (before, command) = only.split_at(before.len() + 2);
            let end = command.find(". ").unwrap_or(command.len());
            parts = vec![before, &command[..end], &command[end..]];
        }
        // A backtick without its like is none.
        if parts.len().is_multiple_of(2) {
            parts = vec![step];
        }
        parts.into_iter()
    }

    /// The text before an option, the option, the text before the next one …: a line does not end within an option.
    fn options(step: &str) -> impl Iterator<Item = &str> {
        let mut parts = Vec::new();
        let mut remaining = step;
        while let Some(at) = remaining.find(" --") {
            let (before, option) = remaining.split_at(at + 1);
            let end = option
                .find([' ', ',', ';', ')', ':'])
                .unwrap_or(option.len());
            parts.extend([before, &option[..end]]);
            remaining = &option[end..];
        }
        parts.push(remaining);
        parts.into_iter()
    }

    /// The style, exactly as it stands in the page.
    fn style(&self) -> String {
        theme::of_page() + STYLE
    }

    /// The script, exactly as it stands in the page.
    fn script(&self) -> &'static str {
        SCRIPT
    }

    /// Returns the content security policy of the page: nothing but its own style and script.
    fn policy(&self) -> String {
        policy(&self.style(), Some(self.script()))
    }

    fn block(mut self, block: Block) -> Self {
        if self.sections.is_empty() {
            self = self.section("");
        }
        if let Some(section) = self.sections.last_mut() {
            section.blocks.push(block);
        }
        self
    }
}

/// The content security policy of a page with this style and, where it has one, this script: nothing else.
pub fn policy(style: &str, script: Option<&str>) -> String {
    let script = script.map_or(String::new(), |script| {
        format!("; script-src '{}'", hash(script))
    });
    format!(
        "default-src 'none'; style-src '{}'{script}; base-uri 'none'; form-action 'none'",
        hash(style)
    )
}

/// The source expression of an inline text (Content Security Policy Level 3, section 2.3.1).
fn hash(text: &str) -> String {
    format!("sha256-{}", BASE64_STANDARD.encode(Sha256::digest(text)))
}

/// The text without characters that would turn the direction of writing or end a line.
fn safe<'a>(text: impl Into<std::borrow::Cow<'a, str>>) -> String {
    show::printable(&text.into()).into_owned()
}

#[cfg(test)]
mod tests {
    use super::super::{Axis, Plot, Series};
    use super::*;

    #[test]
    fn options_stand_between_the_texts_around_them() {
        let parts: Vec<&str> = Report::options("give --rest, or see --help").collect();
        assert_eq!(parts, ["give ", "--rest", ", or see ", "--help", ""]);
        assert_eq!(Report::options("no option").count(), 1);
    }

    #[test]
    fn commands_stand_between_the_texts_around_them() {
        let parts = |step| Report::commands(step).collect::<Vec<_>>();
        assert_eq!(
            parts("Learn more: stillpoint info a.csv. It is short."),
            ["Learn more: ", "stillpoint info a.csv", ". It is short."]
        );
        assert_eq!(
            parts("then `stillpoint plan` says"),
            ["then ", "stillpoint plan", " says"]
        );
        assert_eq!(parts("one ` alone"), ["one ` alone"]);
        assert_eq!(parts("no command"), ["no command"]);
    }

    const NASTY: &str = "<img src=x onerror=alert(1)></script>&\"'";

    fn page() -> String {
        let mut table = ReportTable::new([NASTY, "value"]);
        table.keyed(NASTY, [NASTY, "1"]);
        let plot = Plot::new(NASTY, Axis::log(NASTY), Axis::linear(NASTY))
            .with(Series::line(NASTY, 0, vec![(1.0, 1.0), (10.0, 2.0)]))
            .with(Series::dashed("b", 1, vec![(1.0, 2.0), (10.0, 2.0)]));
        let report = Report::new(NASTY)
            .verdict(Level::Care, NASTY)
            .figures([Figure::new(NASTY, NASTY, NASTY)])
            .next(&[NASTY.into()])
            .warnings(&[NASTY.into()])
            .provenance([[NASTY.into(), NASTY.into()]])
            .export(NASTY, NASTY)
            .section(NASTY)
            .text(NASTY);
        let report = report.table(table).plot(&plot.into());
        report.html().unwrap()
    }

    #[test]
    fn nothing_a_user_supplies_becomes_markup() {
        let page = page();
        assert!(!page.contains("<img"), "{page}");
        assert_eq!(page.matches("</script").count(), 1);
        assert!(page.contains("&lt;img") || page.contains("&#60;img"));
    }

    #[test]
    fn the_page_loads_nothing_and_its_policy_lets_one_script_and_one_style_run() {
        let page = page();
        assert!(page.contains("Content-Security-Policy\" content=\"default-src 'none'; style-src"));
        assert!(!page.contains("unsafe") && !page.contains("://"));
        let inside = |tag: &str| {
            let (open, close) = (format!("<{tag}>"), format!("</{tag}>"));
            assert_eq!(page.matches(&open).count(), 1, "{tag}");
            let from = page.find(&open).unwrap() + open.len();
            &page[from..from + page[from..].find(&close).unwrap()]
        };
        for tag in ["style", "script"] {
            assert!(page.contains(&hash(inside(tag))), "{tag}");
        }
        assert!(!page.contains(" style=") && !page.contains("<link"));
    }
}
