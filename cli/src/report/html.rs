//! One self-contained HTML page.

use askama::Template;

use super::plot::Plot;
use super::theme::Theme;
use crate::exit::{BUG, Failure};
use crate::show;

/// A report: a title, warnings, and sections of text, tables and plots.
///
/// Everything given to it is plain text and is escaped; the page runs no script and loads nothing.
#[derive(Debug, Template)]
#[template(path = "report.html")]
pub struct Report {
    title: String,
    by: &'static str,
    warnings: Vec<String>,
    sections: Vec<Section>,
}

#[derive(Debug)]
struct Section {
    heading: String,
    blocks: Vec<Block>,
}

#[derive(Debug)]
enum Block {
    Text(String),
    Table(ReportTable),
    Plot(Drawn),
}

/// Both versions of a picture, drawn by us: no text in it is markup.
#[derive(Debug)]
struct Drawn {
    title: String,
    light: String,
    dark: String,
}

/// A table of plain text; the first column is aligned left, the others right.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct ReportTable {
    header: Vec<String>,
    rows: Vec<Vec<String>>,
}

impl ReportTable {
    /// Without rows yet.
    pub fn new<S: Into<String>>(header: impl IntoIterator<Item = S>) -> Self {
        Self {
            header: header.into_iter().map(|cell| safe(cell.into())).collect(),
            rows: Vec::new(),
        }
    }

    /// Appends a row.
    pub fn row<S: Into<String>>(&mut self, cells: impl IntoIterator<Item = S>) {
        let safe = cells.into_iter().map(|cell| safe(cell.into()));
        self.rows.push(safe.collect());
    }
}

impl Report {
    /// An empty report.
    pub fn new(title: impl Into<String>) -> Self {
        Self {
            title: safe(title.into()),
            by: concat!("stillpoint ", env!("CARGO_PKG_VERSION")),
            warnings: Vec::new(),
            sections: Vec::new(),
        }
    }

    /// With warnings at the top.
    #[must_use]
    pub fn warnings(mut self, warnings: &[String]) -> Self {
        let safe = warnings.iter().map(|w| safe(show::shortened(w)));
        self.warnings.extend(safe);
        self
    }

    /// Opens a section; text, tables and plots go into the last one.
    #[must_use]
    pub fn section(mut self, heading: impl Into<String>) -> Self {
        self.sections.push(Section {
            heading: safe(heading.into()),
            blocks: Vec::new(),
        });
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

    /// With a plot.
    ///
    /// # Errors
    /// What the drawing library refuses (a bug of ours).
    pub fn plot(self, plot: &Plot) -> Result<Self, Failure> {
        let drawn = Drawn {
            title: plot.title.clone(),
            light: plot.svg(Theme::Light)?,
            dark: plot.svg(Theme::Dark)?,
        };
        Ok(self.block(Block::Plot(drawn)))
    }

    /// The page.
    ///
    /// # Errors
    /// What the template refuses (a bug of ours).
    pub fn html(&self) -> Result<String, Failure> {
        self.render()
            .map_err(|e| Failure::new(BUG, format!("the report could not be made: {e}")))
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

/// The text without characters that would turn the direction of writing or end a line.
fn safe<'a>(text: impl Into<std::borrow::Cow<'a, str>>) -> String {
    show::printable(&text.into()).into_owned()
}

#[cfg(test)]
mod tests {
    use super::super::{Axis, Series};
    use super::*;

    const NASTY: &str = "<img src=x onerror=alert(1)></script>&\"'";

    fn page() -> String {
        let mut table = ReportTable::new([NASTY, "value"]);
        table.row([NASTY, "1"]);
        let plot = Plot::new(NASTY, Axis::log(NASTY), Axis::linear(NASTY))
            .with(Series::line(NASTY, 0, vec![(1.0, 1.0), (10.0, 2.0)]))
            .with(Series::dashed("b", 1, vec![(1.0, 2.0), (10.0, 2.0)]));
        let report = Report::new(NASTY)
            .warnings(&[NASTY.into()])
            .section(NASTY)
            .text(NASTY);
        report.table(table).plot(&plot).unwrap().html().unwrap()
    }

    #[test]
    fn nothing_a_user_supplies_becomes_markup() {
        let page = page();
        assert!(
            !page.contains("<img") && !page.contains("</script"),
            "{page}"
        );
        assert!(page.contains("&lt;img") || page.contains("&#60;img"));
    }

    #[test]
    fn the_page_loads_nothing_and_forbids_scripts() {
        let page = page();
        assert!(page.contains("Content-Security-Policy\" content=\"default-src 'none'"));
        // The only addresses are the name spaces of SVG.
        let addresses = page.matches("http://").count() + page.matches("https://").count();
        assert_eq!(
            addresses,
            page.matches("http://www.w3.org/2000/svg").count()
        );
        assert!(!page.contains("<script") && !page.contains("<link"));
    }

    #[test]
    fn a_png_has_its_signature_and_size() {
        let plot = Plot::new("t", Axis::log("x, s"), Axis::log("y, m")).with(Series::bars(
            "a",
            0,
            vec![(1.0, 1.0, 0.0, 2.0), (0.0, 1.0, 1.0, 1.0)],
        ));
        let file = plot.png().unwrap();
        assert_eq!(&file[..8], b"\x89PNG\r\n\x1a\n");
        assert_eq!(file[16..24], [0, 0, 5, 240, 0, 0, 3, 152]);
    }
}
