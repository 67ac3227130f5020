//! Plots as SVG: panels with their y label above them, the legend above all, nothing on the data.

use std::fmt::Write as _;

use super::axis::Scale;
use super::plot::{Mark, Panel, Plot, Series};
use super::svg::{Svg, WIDTH, escaped, fitted, num, text_width};
use super::theme::SERIES;

/// Dots between the numbers of the y axis and its line, and at the right.
const PAD: f64 = 6.0;
const RIGHT: f64 = 12.0;
/// Height of a panel that is alone, of one of several, of a line of words.
const ALONE: f64 = 210.0;
const STACKED: f64 = 130.0;
const LINE: f64 = 18.0;
/// Half of the height of a number beside an axis.
const HALF_A_NUMBER: f64 = 7.0;
/// Radius of a dot, and of one of very many.
const DOT: f64 = 3.0;
const SMALL: f64 = 2.0;
const MANY: usize = 150;

/// Mapping of values to the drawing area of a panel.
struct Frame<'a> {
    plot: &'a Plot,
    panel: &'a Panel,
    x: &'a Scale,
    y: Scale,
    left: f64,
    top: f64,
    width: f64,
    height: f64,
}

impl Plot {
    /// The drawing.
    pub(super) fn drawing(&self) -> Svg {
        let mut svg = Svg::default();
        let everything = self.panels.iter().flat_map(|panel| &panel.series);
        let xs: Vec<f64> = everything.flat_map(Series::extent).map(|p| p.0).collect();
        let x = self.x.scale(xs.into_iter());
        let ys: Vec<Scale> = self.panels.iter().map(y_scale).collect();
        let widest = ys
            .iter()
            .flat_map(|y| y.ticks.iter().map(|tick| text_width(&y.text(*tick))));
        let left = widest.fold(24.0, f64::max).min(0.4 * WIDTH) + PAD + 2.0;
        legend(&mut svg, self);
        for (panel, y) in self.panels.iter().zip(ys) {
            let height = match (self.panels.len(), panel.y.named()) {
                (_, names) if names > 0 => 24.0 * names as f64,
                (1, _) => ALONE,
                _ => STACKED,
            };
            // The highest number may stand at the very top of the panel: the label stays clear of it.
            svg.height += LINE + HALF_A_NUMBER;
            let label = fitted(&panel.y.label, WIDTH - 8.0);
            let base = svg.height - 5.0 - HALF_A_NUMBER;
            svg.text((4.0, base), "start", "soft", &label);
            let frame = Frame {
                plot: self,
                panel,
                x: &x,
                y,
                left,
                top: svg.height,
                width: WIDTH - left - RIGHT,
                height,
            };
            frame.draw(&mut svg);
            svg.height += height + 6.0;
        }
        let last = Frame {
            plot: self,
            panel: &self.panels[self.panels.len() - 1],
            x: &x,
            y: x.clone(),
            left,
            top: 0.0,
            width: WIDTH - left - RIGHT,
            height: 0.0,
        };
        last.x_numbers(&mut svg);
        svg
    }
}

fn y_scale(panel: &Panel) -> Scale {
    let all = panel.series.iter().flat_map(Series::extent);
    panel.y.scale(all.map(|p| p.1))
}

/// Every name once, in lines.
fn legend(svg: &mut Svg, plot: &Plot) {
    let mut named: Vec<&Series> = Vec::new();
    for series in plot.panels.iter().flat_map(|panel| &panel.series) {
        let same = |other: &&Series| other.name == series.name && other.colour == series.colour;
        if !series.name.is_empty() && !named.iter().any(same) {
            named.push(series);
        }
    }
    if named.len() < 2 {
        return;
    }
    let mut x = 4.0;
    svg.height += LINE;
    for series in named {
        let name = fitted(&series.name, WIDTH - 60.0);
        let width = 30.0 + text_width(&name) + 12.0;
        if x + width > WIDTH && x > 4.0 {
            (x, svg.height) = (4.0, svg.height + LINE);
        }
        let middle = svg.height - 9.0;
        svg.open(&format!("class=\"c{}\"", series.colour % SERIES));
        let stroke = [[(x, middle), (x + 22.0, middle)]];
        match &series.mark {
            Mark::Line { dashed: true, .. } => svg.strokes("dash", &stroke),
            Mark::Line { .. } | Mark::Strokes { thick: false, .. } => svg.strokes("line", &stroke),
            Mark::Strokes { .. } => svg.strokes("thick", &stroke),
            Mark::Bars(_) => svg.circle((x + 14.0, middle), DOT, "class=\"dot\""),
            Mark::Band { .. } => {
                let (x, y) = (num(x), num(middle - 5.0));
                svg.raw(&format!(
                    "<rect class=\"band\" x=\"{x}\" y=\"{y}\" width=\"22\" height=\"10\"/>"
                ));
            }
        }
        svg.close();
        svg.text((x + 28.0, middle + 4.0), "start", "", &name);
        x += width;
    }
    svg.height += 2.0;
}

impl Frame<'_> {
    fn at_x(&self, place: f64) -> f64 {
        self.left + self.width * (place - self.x.from) / (self.x.to - self.x.from)
    }

    fn at_y(&self, place: f64) -> f64 {
        self.top + self.height * (self.y.to - place) / (self.y.to - self.y.from)
    }

    /// Returns the position of a value in dots.
    fn place(&self, (x, y): (f64, f64)) -> Option<(f64, f64)> {
        let (x, y) = (self.plot.x.place(x)?, self.panel.y.place(y)?);
        Some((self.at_x(x), self.at_y(y)))
    }

    fn draw(&self, svg: &mut Svg) {
        let mut attributes = String::from("class=\"panel\"");
        let ends = |axis: &super::axis::Axis, scale: &Scale| {
            let log = u8::from(axis.is_log());
            format!("{} {} {log} {}", scale.from, scale.to, axis.named())
        };
        let _ = write!(
            attributes,
            " data-x=\"{}\" data-y=\"{}\" data-b=\"{} {} {} {}\" data-n=\"{}\"",
            ends(&self.plot.x, self.x),
            ends(&self.panel.y, &self.y),
            num(self.left),
            num(self.top),
            num(self.width),
            num(self.height),
            escaped(&format!("{}|{}", self.plot.x.label, self.panel.y.label)),
        );
        svg.open(&attributes);
        self.grid(svg);
        svg.open("class=\"data\"");
        for series in &self.panel.series {
            self.series(svg, series);
        }
        svg.close();
        svg.close();
    }

    fn grid(&self, svg: &mut Svg) {
        let (right, bottom) = (self.left + self.width, self.top + self.height);
        let ys = self.y.ticks.iter().map(|tick| self.at_y(*tick));
        let level: Vec<_> = ys.map(|y| [(self.left, y), (right, y)]).collect();
        svg.strokes("grid", &level);
        svg.open("class=\"xg\"");
        let xs = self.x.ticks.iter().map(|tick| self.at_x(*tick));
        let upright: Vec<_> = xs.map(|x| [(x, self.top), (x, bottom)]).collect();
        svg.strokes("grid", &upright);
        svg.close();
        if let (false, Some(zero)) = (self.panel.y.is_log(), self.panel.y.place(0.0))
            && zero > self.y.from
            && zero < self.y.to
            && self.panel.y.named() == 0
        {
            let y = self.at_y(zero);
            svg.strokes("zero", &[[(self.left, y), (right, y)]]);
        }
        svg.path(
            "axis",
            &[(self.left, self.top), (self.left, bottom), (right, bottom)],
        );
        for tick in &self.y.ticks {
            let name = fitted(&self.y.text(*tick), 0.4 * WIDTH);
            svg.text((self.left - PAD, self.at_y(*tick) + 4.0), "end", "", &name);
        }
    }

    fn series(&self, svg: &mut Svg, series: &Series) {
        let name = escaped(&series.name);
        svg.open(&format!(
            "class=\"c{}\" data-s=\"{name}\"",
            series.colour % SERIES
        ));
        match &series.mark {
            Mark::Line { points, dashed } => {
                let line: Vec<_> = points.iter().filter_map(|&p| self.place(p)).collect();
                svg.path(if *dashed { "dash" } else { "line" }, &line);
            }
            Mark::Bars(points) => self.bars(svg, points, &series.keys),
            Mark::Strokes { strokes, thick } => self.strokes(svg, strokes, *thick, &series.keys),
            Mark::Band { low, high } => {
                let place = |v: f64| self.panel.y.place(v).map(|v| self.at_y(v));
                if let (Some(bottom), Some(top)) = (place(*low), place(*high)) {
                    svg.raw(&format!(
                        "<rect class=\"band\" x=\"{}\" y=\"{}\" width=\"{}\" height=\"{}\"/>",
                        num(self.left),
                        num(top),
                        num(self.width),
                        num(bottom - top)
                    ));
                }
            }
        }
        svg.close();
    }

    fn bars(&self, svg: &mut Svg, points: &[(f64, f64, f64, f64)], keys: &[String]) {
        let floor = self.top + self.height;
        let bars = points.iter().filter_map(|&(x, _, low, high)| {
            let (bx, top) = self.place((x, high))?;
            let bottom = self.place((x, low)).map_or(floor, |p| p.1);
            (bottom > top).then_some([(bx, bottom), (bx, top)])
        });
        let bars: Vec<_> = bars.collect();
        svg.strokes("thin", &bars);
        let radius = if points.len() > MANY { SMALL } else { DOT };
        // What all dots share stands once: a page has thousands of them.
        svg.open("class=\"dot\"");
        for (k, &(x, y, ..)) in points.iter().enumerate() {
            if let Some(at) = self.place((x, y)) {
                let key = keys.get(k).map(|key| format!("data-k=\"{key}\""));
                svg.circle(at, radius, &key.unwrap_or_default());
            }
        }
        svg.close();
    }

    fn strokes(&self, svg: &mut Svg, strokes: &[[(f64, f64); 2]], thick: bool, keys: &[String]) {
        let class = if thick { "thick" } else { "thin" };
        let placed = |&[from, to]: &[(f64, f64); 2]| Some([self.place(from)?, self.place(to)?]);
        if keys.is_empty() {
            let all: Vec<_> = strokes.iter().filter_map(placed).collect();
            return svg.strokes(class, &all);
        }
        for (stroke, key) in strokes.iter().zip(keys) {
            if let Some([(x0, y0), (x1, y1)]) = placed(stroke) {
                svg.raw(&format!(
                    "<path class=\"{class}\" data-k=\"{key}\" d=\"M{} {}L{} {}\"/>",
                    num(x0),
                    num(y0),
                    num(x1),
                    num(y1)
                ));
            }
        }
    }

    /// The numbers and the label under the last panel.
    fn x_numbers(&self, svg: &mut Svg) {
        let y = svg.height + 9.0;
        svg.open("class=\"xn\"");
        let texts: Vec<(f64, String)> = self
            .x
            .ticks
            .iter()
            .map(|tick| (self.at_x(*tick), self.x.text(*tick)))
            .collect();
        let mut free = 0.0;
        for (x, text) in texts {
            let half = 0.5 * text_width(&text);
            let x = x.min(WIDTH - half - 1.0);
            if x - half >= free {
                svg.text((x, y), "middle", "", &text);
                free = x + half + 6.0;
            }
        }
        svg.close();
        let label = fitted(&self.plot.x.label, WIDTH - 8.0);
        if !label.is_empty() {
            let half = 0.5 * text_width(&label);
            let middle = self.left + 0.5 * self.width;
            let x = middle.clamp(half.min(0.5 * WIDTH), (WIDTH - half).max(0.5 * WIDTH));
            svg.text((x, y + 17.0), "middle", "soft", &label);
            svg.height += 17.0;
        }
        svg.height += 15.0;
    }
}
