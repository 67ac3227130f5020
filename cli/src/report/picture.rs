//! A drawing as a file of its own: SVG for light and dark pages, PNG on white.

use std::sync::{Arc, OnceLock};

use resvg::{tiny_skia, usvg};

use super::forest::{self, Group};
use super::matrix;
use super::plot::Plot;
use super::sphere::Sphere;
use super::svg::{Svg, WIDTH};
use super::theme;
use crate::exit::{BUG, Failure};
use crate::show;

/// Dots of a PNG per dot of the drawing.
const PNG_SCALE: f32 = 3.0;

/// Anything that is drawn.
#[derive(Clone, Debug, PartialEq)]
pub enum Picture {
    /// Series over axes.
    Plot(Plot),
    /// Parameters with intervals: title, groups.
    Forest(String, Vec<Group>),
    /// Correlations: title, names, rows.
    Matrix(String, Vec<String>, Vec<Vec<f64>>),
    /// Directions: title, what there is.
    Sphere(String, Sphere),
}

impl From<Plot> for Picture {
    fn from(plot: Plot) -> Self {
        Self::Plot(plot)
    }
}

impl Picture {
    /// What it shows.
    pub fn title(&self) -> &str {
        match self {
            Self::Plot(plot) => &plot.title,
            Self::Forest(title, _) | Self::Matrix(title, ..) | Self::Sphere(title, _) => title,
        }
    }

    fn drawing(&self) -> Svg {
        match self {
            Self::Plot(plot) => plot.drawing(),
            Self::Forest(_, groups) => forest::drawing(groups),
            Self::Matrix(_, names, rows) => matrix::drawing(names, rows),
            Self::Sphere(_, sphere) => sphere.drawing(),
        }
    }

    /// The element for a page that has the style of plots.
    pub(super) fn element(&self) -> String {
        show::printable(&self.drawing().element()).into_owned()
    }

    /// The picture as an SVG document for light and dark pages.
    pub fn svg(&self) -> String {
        let document = self.drawing().document(self.title(), &theme::of_picture());
        show::printable(&document).into_owned()
    }

    /// The picture as a PNG file, on white.
    ///
    /// # Errors
    /// What the renderer refuses (a bug of ours).
    pub fn png(&self) -> Result<Vec<u8>, Failure> {
        let document = self.drawing().document(self.title(), &theme::of_paper());
        let document = show::printable(&document).into_owned();
        let options = usvg::Options {
            font_family: FONT.into(),
            fontdb: fonts(),
            ..usvg::Options::default()
        };
        let tree = usvg::Tree::from_str(&document, &options).map_err(bug)?;
        let size = tree.size();
        let width = (PNG_SCALE * WIDTH as f32).round() as u32;
        let height = (PNG_SCALE * size.height()).ceil() as u32;
        let mut pixels =
            tiny_skia::Pixmap::new(width, height).ok_or_else(|| bug("a picture without size"))?;
        let scale = tiny_skia::Transform::from_scale(PNG_SCALE, PNG_SCALE);
        resvg::render(&tree, scale, &mut pixels.as_mut());
        pixels.encode_png().map_err(bug)
    }
}

/// The embedded font: the same picture on every machine.
const FONT: &str = "DejaVu Sans";

fn fonts() -> Arc<usvg::fontdb::Database> {
    static FONTS: OnceLock<Arc<usvg::fontdb::Database>> = OnceLock::new();
    let load = || {
        let mut fonts = usvg::fontdb::Database::new();
        fonts.load_font_data(dejavu::sans::regular().to_vec());
        Arc::new(fonts)
    };
    FONTS.get_or_init(load).clone()
}

fn bug(error: impl std::fmt::Display) -> Failure {
    Failure::new(BUG, format!("a plot could not be drawn: {error}"))
}

#[cfg(test)]
mod tests {
    use super::super::{Axis, Series};
    use super::*;

    #[test]
    fn a_png_has_its_signature_and_its_letters() {
        let blank = Plot::new("", Axis::log(""), Axis::log(""));
        let words = Plot::new("A title", Axis::log("x, s"), Axis::log("y, m")).with(Series::bars(
            "a",
            0,
            vec![(1.0, 1.0, 0.0, 2.0), (0.0, 1.0, 1.0, 1.0)],
        ));
        let [blank, words] = [blank, words].map(|plot| Picture::from(plot).png().unwrap());
        assert_eq!(&words[..8], b"\x89PNG\r\n\x1a\n");
        assert_eq!(words[16..20], [0, 0, 4, 236]);
        assert!(words.len() > blank.len() + 1000, "no letters");
    }
}
