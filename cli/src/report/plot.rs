//! What is plotted; how it is drawn is `draw`'s affair.

use super::axis::Axis;
use crate::show;

/// More points than this in a line are thinned: the page is a thousand dots wide.
const DENSEST: usize = 1500;

/// A plot of series over one pair of axes.
#[derive(Clone, Debug, PartialEq)]
pub struct Plot {
    /// Above the plot.
    pub title: String,
    pub(super) x: Axis,
    pub(super) y: Axis,
    pub(super) series: Vec<Series>,
}

/// Points with a name and a way to be drawn.
#[derive(Clone, Debug, PartialEq)]
pub struct Series {
    /// In the legend; empty keeps a series out of it.
    pub(super) name: String,
    pub(super) colour: usize,
    pub(super) mark: Mark,
}

#[derive(Clone, Debug, PartialEq)]
pub(super) enum Mark {
    /// A line through `(x, y)`.
    Line {
        points: Vec<(f64, f64)>,
        dashed: bool,
    },
    /// Dots at `(x, y)` with a bar from `low` to `high`: `(x, y, low, high)`.
    Bars(Vec<(f64, f64, f64, f64)>),
    /// Straight strokes from one point to another.
    Strokes {
        strokes: Vec<[(f64, f64); 2]>,
        thick: bool,
    },
}

impl Series {
    /// A line; `colour` counts through the palette.
    pub fn line(name: impl Into<String>, colour: usize, points: Vec<(f64, f64)>) -> Self {
        Self {
            name: show::printable(&name.into()).into_owned(),
            colour,
            mark: Mark::Line {
                points: thin(points),
                dashed: false,
            },
        }
    }

    /// A broken line, for what is computed rather than measured.
    pub fn dashed(name: impl Into<String>, colour: usize, points: Vec<(f64, f64)>) -> Self {
        Self {
            name: show::printable(&name.into()).into_owned(),
            colour,
            mark: Mark::Line {
                points: thin(points),
                dashed: true,
            },
        }
    }

    /// Dots with intervals `(x, y, low, high)`.
    pub fn bars(name: impl Into<String>, colour: usize, points: Vec<(f64, f64, f64, f64)>) -> Self {
        Self {
            name: show::printable(&name.into()).into_owned(),
            colour,
            mark: Mark::Bars(points),
        }
    }

    /// Dots at `(x, y)`.
    pub fn dots(name: impl Into<String>, colour: usize, points: Vec<(f64, f64)>) -> Self {
        let bare = points.into_iter().map(|(x, y)| (x, y, y, y)).collect();
        Self::bars(name, colour, bare)
    }

    /// Level strokes `(x0, x1, y)`, thick, for stretches of time.
    pub fn stretches(name: impl Into<String>, colour: usize, all: Vec<(f64, f64, f64)>) -> Self {
        let strokes = all.into_iter().map(|(from, to, y)| [(from, y), (to, y)]);
        Self::strokes(name.into(), colour, strokes.collect(), true)
    }

    /// Upright strokes `(x, low, high)`, for the range of many samples.
    pub fn ranges(name: impl Into<String>, colour: usize, all: Vec<(f64, f64, f64)>) -> Self {
        let strokes = all.into_iter().map(|(x, low, high)| [(x, low), (x, high)]);
        Self::strokes(name.into(), colour, strokes.collect(), false)
    }

    fn strokes(name: String, colour: usize, strokes: Vec<[(f64, f64); 2]>, thick: bool) -> Self {
        Self {
            name,
            colour,
            mark: Mark::Strokes { strokes, thick },
        }
    }

    /// All `(x, y)` that must be in the picture.
    pub(super) fn extent(&self) -> Vec<(f64, f64)> {
        match &self.mark {
            Mark::Line { points, .. } => points.clone(),
            Mark::Bars(points) => points
                .iter()
                .flat_map(|&(x, y, low, high)| [(x, y), (x, low), (x, high)])
                .collect(),
            Mark::Strokes { strokes, .. } => strokes.concat(),
        }
    }
}

impl Plot {
    /// An empty plot.
    pub fn new(title: impl Into<String>, x: Axis, y: Axis) -> Self {
        Self {
            title: show::printable(&title.into()).into_owned(),
            x,
            y,
            series: Vec::new(),
        }
    }

    /// With one more series.
    #[must_use]
    pub fn with(mut self, series: Series) -> Self {
        self.series.push(series);
        self
    }
}

/// Every `k`-th point, and the last.
fn thin(points: Vec<(f64, f64)>) -> Vec<(f64, f64)> {
    let every = points.len().div_ceil(DENSEST).max(1);
    let last = points.len().saturating_sub(1);
    let kept = |k: usize| k.is_multiple_of(every) || k == last;
    points
        .into_iter()
        .enumerate()
        .filter(|(k, _)| kept(*k))
        .map(|(_, point)| point)
        .collect()
}
