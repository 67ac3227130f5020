//! A drawing as a file of its own: SVG for light and dark pages, PNG on white.

use super::forest::{self, Group};
use super::matrix;
use super::plot::Plot;
use super::sphere::Sphere;
use super::svg::Svg;
use super::theme;
use crate::exit::Failure;
use crate::show;

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

/// Pictures of one kind with their names: `noise-1`, `noise-2`.
pub fn numbered(name: &str, all: Vec<Picture>) -> impl Iterator<Item = (String, Picture)> {
    let numbered = (1..).zip(all);
    numbered.map(move |(k, picture)| (format!("{name}-{k}"), picture))
}

impl Picture {
    /// Returns the title of the picture.
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
        super::png::drawn(&document)
    }
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
