//! Plots drawn by `plotters`, with an embedded font: the same picture on every machine.

use std::ops::Range;
use std::sync::OnceLock;

use plotters::coord::ranged1d::{KeyPointHint, NoDefaultFormatting, ValueFormatter};
use plotters::prelude::*;
use plotters::style::{FontStyle, register_font};

use super::axis::Scale;
use super::plot::{Mark, Plot, Series};
use super::theme::Theme;
use crate::exit::{BUG, Failure};

/// Size of a picture, in dots of the SVG.
const SIZE: (u32, u32) = (760, 460);

/// Dots of a PNG per dot of the SVG.
const PNG_SCALE: u32 = 2;

/// The part of a side that a legend may take.
const LEGEND_SHARE: f64 = 0.27;

/// Width of a level stroke, in dots of the SVG.
const STROKE: u32 = 5;

/// How a series looks in the legend.
#[derive(Clone, Copy, PartialEq)]
enum Legend {
    Line,
    Dashed,
    Dot,
    Thick,
}

impl Legend {
    fn of(mark: &Mark) -> Self {
        match mark {
            Mark::Line { dashed: false, .. } | Mark::Strokes { thick: false, .. } => Self::Line,
            Mark::Line { dashed: true, .. } => Self::Dashed,
            Mark::Bars(_) => Self::Dot,
            Mark::Strokes { thick: true, .. } => Self::Thick,
        }
    }
}

/// The name under which the font is known to plotters; a browser finds its own sans-serif by it.
const FONT: &str = "sans-serif";

impl Plot {
    /// The picture as an SVG document.
    ///
    /// # Errors
    /// What the drawing library refuses (a bug of ours).
    pub fn svg(&self, theme: Theme) -> Result<String, Failure> {
        let mut text = String::new();
        let area = SVGBackend::with_string(&mut text, SIZE).into_drawing_area();
        draw(self, theme, 1, &area).map_err(bug)?;
        drop(area);
        Ok(text)
    }

    /// The picture as a PNG file, on white, at twice the size.
    ///
    /// # Errors
    /// What the drawing library refuses (a bug of ours).
    pub fn png(&self) -> Result<Vec<u8>, Failure> {
        let (width, height) = (PNG_SCALE * SIZE.0, PNG_SCALE * SIZE.1);
        let mut pixels = vec![0; 3 * (width * height) as usize];
        let area = BitMapBackend::with_buffer(&mut pixels, (width, height)).into_drawing_area();
        draw(self, Theme::Light, PNG_SCALE as i32, &area).map_err(bug)?;
        drop(area);
        let mut file = Vec::new();
        let mut encoder = png::Encoder::new(&mut file, width, height);
        encoder.set_color(png::ColorType::Rgb);
        encoder.set_depth(png::BitDepth::Eight);
        let written = encoder
            .write_header()
            .and_then(|mut w| w.write_image_data(&pixels));
        written.map_err(bug)?;
        Ok(file)
    }
}

fn bug(error: impl std::fmt::Display) -> Failure {
    Failure::new(BUG, format!("a plot could not be drawn: {error}"))
}

/// Makes the font known, once.
fn font() -> Result<(), String> {
    static REGISTERED: OnceLock<bool> = OnceLock::new();
    let load = || register_font(FONT, FontStyle::Normal, dejavu::sans::regular()).is_ok();
    if *REGISTERED.get_or_init(load) {
        Ok(())
    } else {
        Err("the embedded font is unreadable".into())
    }
}

/// The corner with the fewest points, for the legend.
fn emptiest_corner(plot: &Plot, x: &Scale, y: &Scale) -> SeriesLabelPosition {
    let share = |scale: &Scale, place: f64| (place - scale.from) / (scale.to - scale.from);
    let places: Vec<(f64, f64)> = plot
        .series
        .iter()
        .flat_map(Series::extent)
        .filter_map(|(px, py)| Some((share(x, plot.x.place(px)?), share(y, plot.y.place(py)?))))
        .collect();
    let in_corner = |right: bool, upper: bool| {
        let near = |share: f64, far_end: bool| {
            if far_end {
                share > 1.0 - LEGEND_SHARE
            } else {
                share < LEGEND_SHARE
            }
        };
        places
            .iter()
            .filter(|(px, py)| near(*px, right) && near(*py, upper))
            .count()
    };
    [
        (SeriesLabelPosition::UpperRight, in_corner(true, true)),
        (SeriesLabelPosition::UpperLeft, in_corner(false, true)),
        (SeriesLabelPosition::LowerRight, in_corner(true, false)),
        (SeriesLabelPosition::LowerLeft, in_corner(false, false)),
    ]
    .into_iter()
    .min_by_key(|(_, points)| *points)
    .map_or(SeriesLabelPosition::UpperRight, |(corner, _)| corner)
}

impl Ranged for Scale {
    type FormatOption = NoDefaultFormatting;
    type ValueType = f64;

    fn map(&self, place: &f64, (first, last): (i32, i32)) -> i32 {
        let share = (place - self.from) / (self.to - self.from);
        first + (share * f64::from(last - first)).round() as i32
    }

    fn key_points<Hint: KeyPointHint>(&self, hint: Hint) -> Vec<f64> {
        if hint.weight().allow_light_points() {
            self.fine_ticks.clone()
        } else {
            self.ticks.clone()
        }
    }

    fn range(&self) -> Range<f64> {
        self.from..self.to
    }
}

impl ValueFormatter<f64> for Scale {
    fn format(tick: &f64) -> String {
        tick.to_string()
    }

    fn format_ext(&self, tick: &f64) -> String {
        self.text(*tick)
    }
}

fn draw<B: DrawingBackend>(
    plot: &Plot,
    theme: Theme,
    scale: i32,
    area: &DrawingArea<B, plotters::coord::Shift>,
) -> Result<(), String> {
    font()?;
    let text = |size: i32| (FONT, size * scale).into_font().color(&theme.ink());
    let words = |e: DrawingAreaErrorKind<B::ErrorType>| e.to_string();
    let points = || plot.series.iter().flat_map(Series::extent);
    let x = plot.x.scale(points().map(|(x, _)| x));
    let y = plot.y.scale(points().map(|(_, y)| y));
    area.fill(&theme.background()).map_err(words)?;
    let mut chart = ChartBuilder::on(area)
        .caption(&plot.title, text(19))
        .margin(14 * scale)
        .x_label_area_size(50 * scale)
        .y_label_area_size(74 * scale)
        .build_cartesian_2d(x.clone(), y.clone())
        .map_err(words)?;
    chart
        .configure_mesh()
        .bold_line_style(theme.grid().stroke_width(scale as u32))
        .light_line_style(theme.fine_grid().stroke_width(scale as u32))
        .axis_style(theme.ink().stroke_width(scale as u32))
        .x_desc(&plot.x.label)
        .y_desc(&plot.y.label)
        .axis_desc_style(text(16))
        .label_style(text(14))
        .draw()
        .map_err(words)?;
    for series in &plot.series {
        let colour = theme.series(series.colour);
        let stroke = colour.stroke_width(2 * scale as u32);
        let thick = colour.stroke_width(STROKE * scale as u32);
        let place = |(px, py): (f64, f64)| Some((plot.x.place(px)?, plot.y.place(py)?));
        let drawn = match &series.mark {
            Mark::Line { points, dashed } => {
                let line: Vec<_> = points.iter().filter_map(|&p| place(p)).collect();
                if *dashed {
                    chart.draw_series(DashedLineSeries::new(line, 7 * scale, 4 * scale, stroke))
                } else {
                    chart.draw_series(LineSeries::new(line, stroke))
                }
            }
            Mark::Bars(points) => {
                let floor = y.from;
                let bars = points.iter().filter_map(|&(px, _, low, high)| {
                    let (bx, top) = place((px, high))?;
                    let bottom = plot.y.place(low).unwrap_or(floor);
                    (bottom < top).then(|| PathElement::new(vec![(bx, bottom), (bx, top)], stroke))
                });
                chart.draw_series(bars).map_err(words)?;
                let dots = points
                    .iter()
                    .filter_map(|&(px, py, ..)| place((px, py)))
                    .map(|at| Circle::new(at, 3 * scale, colour.filled()));
                chart.draw_series(dots)
            }
            Mark::Strokes { strokes, thick: t } => {
                let style = if *t { thick } else { stroke };
                let strokes = strokes.iter().filter_map(|&[from, to]| {
                    Some(PathElement::new(vec![place(from)?, place(to)?], style))
                });
                chart.draw_series(strokes)
            }
        };
        let drawn = drawn.map_err(words)?;
        if !series.name.is_empty() {
            let (kind, length) = (Legend::of(&series.mark), 22 * scale);
            drawn.label(&series.name).legend(move |(x, y)| {
                let dash = |from: i32, to: i32| {
                    let style = if kind == Legend::Thick { thick } else { stroke };
                    PathElement::new(vec![(x + from, y), (x + to, y)], style)
                };
                let (first, second) = match kind {
                    Legend::Dot => (dash(0, 0), dash(0, 0)),
                    Legend::Dashed => (dash(0, 9 * scale), dash(13 * scale, length)),
                    Legend::Line | Legend::Thick => (dash(0, length), dash(0, 0)),
                };
                // A circle of no size is a dot still: it hides in the stroke.
                let (middle, radius) = match kind {
                    Legend::Dot => (length / 2, 3 * scale),
                    _ => (scale, 0),
                };
                EmptyElement::at((0, 0))
                    + first
                    + second
                    + Circle::new((x + middle, y), radius, colour.filled())
            });
        }
    }
    if plot
        .series
        .iter()
        .filter(|series| !series.name.is_empty())
        .count()
        > 1
    {
        chart
            .configure_series_labels()
            .position(emptiest_corner(plot, &x, &y))
            .legend_area_size(30 * scale)
            .margin(8 * scale)
            .label_font(text(14))
            .background_style(theme.background().mix(0.85))
            .border_style(theme.grid())
            .draw()
            .map_err(words)?;
    }
    area.present().map_err(words)
}
