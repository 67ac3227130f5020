//! Data of a plot. Module `draw` draws it.

use super::axis::Axis;
use crate::show;

/// More points than this in a line are thinned: a picture is some four hundred dots wide.
const DENSEST: usize = 400;

/// Panels of series, one above the other, over one x axis.
#[derive(Clone, Debug, PartialEq)]
pub struct Plot {
    /// Above the plot.
    pub title: String,
    pub(super) x: Axis,
    pub(super) panels: Vec<Panel>,
}

/// Series over one y axis.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Panel {
    pub y: Axis,
    pub series: Vec<Series>,
}

/// Points with a name and a way to be drawn.
#[derive(Clone, Debug, PartialEq)]
pub struct Series {
    /// In the legend; empty keeps a series out of it.
    pub(super) name: String,
    pub(super) colour: usize,
    pub(super) mark: Mark,
    /// The interval that each point belongs to; empty where they belong to none.
    pub(super) keys: Vec<String>,
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
    /// The area between `low` and `high` over the whole width.
    Band { low: f64, high: f64 },
}

impl Series {
    fn new(name: impl Into<String>, colour: usize, mark: Mark) -> Self {
        Self {
            name: show::printable(&name.into()).into_owned(),
            colour,
            mark,
            keys: Vec::new(),
        }
    }

    /// A line; `colour` counts through the palette.
    pub fn line(name: impl Into<String>, colour: usize, points: Vec<(f64, f64)>) -> Self {
        let (points, dashed) = (thin(points), false);
        Self::new(name, colour, Mark::Line { points, dashed })
    }

    /// A broken line, for what is computed rather than measured.
    pub fn dashed(name: impl Into<String>, colour: usize, points: Vec<(f64, f64)>) -> Self {
        let (points, dashed) = (thin(points), true);
        Self::new(name, colour, Mark::Line { points, dashed })
    }

    /// Dots with intervals `(x, y, low, high)`.
    pub fn bars(name: impl Into<String>, colour: usize, points: Vec<(f64, f64, f64, f64)>) -> Self {
        Self::new(name, colour, Mark::Bars(points))
    }

    /// Dots at `(x, y)`.
    pub fn dots(name: impl Into<String>, colour: usize, points: Vec<(f64, f64)>) -> Self {
        let bare = points.into_iter().map(|(x, y)| (x, y, y, y)).collect();
        Self::bars(name, colour, bare)
    }

    /// Level strokes `(x0, x1, y)`, thick, for stretches of time.
    pub fn stretches(name: impl Into<String>, colour: usize, all: Vec<(f64, f64, f64)>) -> Self {
        let strokes = all.into_iter().map(|(from, to, y)| [(from, y), (to, y)]);
        let (strokes, thick) = (strokes.collect(), true);
        Self::new(name, colour, Mark::Strokes { strokes, thick })
    }

    /// Level strokes `(x0, x1, y)`, thin.
    pub fn levels(name: impl Into<String>, colour: usize, all: Vec<(f64, f64, f64)>) -> Self {
        let mut series = Self::stretches(name, colour, all);
        if let Mark::Strokes { thick, .. } = &mut series.mark {
            *thick = false;
        }
        series
    }

    /// Upright strokes `(x, low, high)`, for the range of many samples.
    pub fn ranges(name: impl Into<String>, colour: usize, all: Vec<(f64, f64, f64)>) -> Self {
        let strokes = all.into_iter().map(|(x, low, high)| [(x, low), (x, high)]);
        let (strokes, thick) = (strokes.collect(), false);
        Self::new(name, colour, Mark::Strokes { strokes, thick })
    }

    /// The area between two values.
    pub fn band(name: impl Into<String>, colour: usize, low: f64, high: f64) -> Self {
        Self::new(name, colour, Mark::Band { low, high })
    }

    /// With the interval that each point belongs to, in order: the same key is the same interval in every plot and in
    /// the table of intervals.
    #[must_use]
    pub fn of(mut self, keys: Vec<String>) -> Self {
        self.keys = keys;
        self
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
            Mark::Band { low, high } => vec![(f64::NAN, *low), (f64::NAN, *high)],
        }
    }
}

impl Plot {
    /// An empty plot of one panel.
    pub fn new(title: impl Into<String>, x: Axis, y: Axis) -> Self {
        let series = Vec::new();
        Self {
            title: show::printable(&title.into()).into_owned(),
            x,
            panels: vec![Panel { y, series }],
        }
    }

    /// With one more series in the last panel.
    #[must_use]
    pub fn with(mut self, series: Series) -> Self {
        if let Some(panel) = self.panels.last_mut() {
            panel.series.push(series);
        }
        self
    }

    /// With one more panel below, over the same x axis.
    #[must_use]
    pub fn panel(mut self, y: Axis) -> Self {
        let series = Vec::new();
        self.panels.push(Panel { y, series });
        self
    }

    /// With another axis for its last panel.
    #[must_use]
    pub fn labelled(mut self, y: Axis) -> Self {
        if let Some(panel) = self.panels.last_mut() {
            panel.y = y;
        }
        self
    }

    /// Returns true if no panel has any data.
    pub fn is_empty(&self) -> bool {
        let mut all = self.panels.iter().flat_map(|panel| &panel.series);
        all.all(|series| series.extent().iter().all(|(x, _)| !x.is_finite()))
    }
}

/// The smallest and the largest of every stretch of points, so that no short excursion is lost.
fn thin(points: Vec<(f64, f64)>) -> Vec<(f64, f64)> {
    if points.len() <= DENSEST {
        return points;
    }
    let length = points.len().div_ceil(DENSEST / 2).max(1);
    let ends = |stretch: &[(f64, f64)]| {
        let least = stretch
            .iter()
            .enumerate()
            .min_by(|a, b| a.1.1.total_cmp(&b.1.1));
        let most = stretch
            .iter()
            .enumerate()
            .max_by(|a, b| a.1.1.total_cmp(&b.1.1));
        let mut both: Vec<(usize, (f64, f64))> = least
            .into_iter()
            .chain(most)
            .map(|(k, p)| (k, *p))
            .collect();
        both.sort_by_key(|(k, _)| *k);
        both.dedup_by_key(|(k, _)| *k);
        both.into_iter().map(|(_, p)| p).collect::<Vec<_>>()
    };
    let mut thinned: Vec<(f64, f64)> = points.chunks(length).flat_map(ends).collect();
    if let Some(last) = points.last().filter(|last| thinned.last() != Some(last)) {
        thinned.push(*last);
    }
    thinned
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn one_excursion_among_many_points_stays() {
        let mut points: Vec<(f64, f64)> = (0..100_000).map(|k| (f64::from(k), 0.0)).collect();
        points[54_321].1 = 7.0;
        let thinned = thin(points);
        assert!(thinned.len() <= DENSEST + 1);
        assert!(thinned.contains(&(54_321.0, 7.0)) && thinned.ends_with(&[(99_999.0, 0.0)]));
    }
}
