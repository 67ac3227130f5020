//! Parameters with their intervals, a row each, grouped by unit.

use super::axis::Axis;
use super::svg::{Svg, WIDTH, escaped, fitted, text_width};

/// Parameters of one unit over one axis.
#[derive(Clone, Debug, PartialEq)]
pub struct Group {
    /// Label of the group, with the unit.
    pub label: String,
    /// The parameters.
    pub rows: Vec<Row>,
}

/// A parameter with its interval.
#[derive(Clone, Debug, PartialEq)]
pub struct Row {
    /// Its name.
    pub name: String,
    /// Its value, in the unit of the group.
    pub value: f64,
    /// Half of its 95 % interval; none where it was held fixed.
    pub half: Option<f64>,
}

const ROW: f64 = 20.0;
const LINE: f64 = 20.0;
/// Room for `−12345.6 ± 0.1`.
const NUMBERS: f64 = 132.0;
const RIGHT: f64 = 8.0;

/// The drawing: name, dot with its interval, the numbers.
pub(super) fn drawing(groups: &[Group]) -> Svg {
    let mut svg = Svg::default();
    let names = groups.iter().flat_map(|g| &g.rows);
    let widest = names.map(|row| text_width(&row.name)).fold(30.0, f64::max);
    let left = widest.min(0.35 * WIDTH) + 8.0;
    for group in groups {
        self::group(&mut svg, group, left);
    }
    svg
}

fn group(svg: &mut Svg, group: &Group, left: f64) {
    let width = WIDTH - left - NUMBERS - RIGHT;
    svg.height += LINE;
    let label = fitted(&group.label, WIDTH - 8.0);
    svg.text((4.0, svg.height - 6.0), "start", "soft", &label);
    let ends = group.rows.iter().flat_map(|row| {
        let half = row.half.unwrap_or(0.0);
        [row.value - half, row.value + half]
    });
    let scale = Axis::linear("").scale(ends.chain([0.0]));
    let at = |v: f64| left + width * (v - scale.from) / (scale.to - scale.from);
    let (top, bottom) = (svg.height, svg.height + ROW * group.rows.len() as f64);
    let upright = |v: f64| [(at(v), top), (at(v), bottom)];
    let grid: Vec<_> = scale.ticks.iter().map(|tick| upright(*tick)).collect();
    svg.strokes("grid", &grid);
    svg.strokes("zero", &[upright(0.0)]);
    for row in &group.rows {
        let y = svg.height + 0.5 * ROW;
        let name = fitted(&row.name, left - 8.0);
        svg.text((left - 6.0, y + 4.0), "end", "", &name);
        let numbers = numbers(row);
        let words = escaped(&format!("{}: {numbers}, {}", row.name, group.label));
        svg.open(&format!("class=\"c0\" data-t=\"{words}\""));
        if let Some(half) = row.half {
            svg.strokes(
                "line",
                &[[(at(row.value - half), y), (at(row.value + half), y)]],
            );
        }
        svg.circle((at(row.value), y), 3.0, "class=\"dot\"");
        svg.close();
        svg.text((WIDTH - RIGHT, y + 4.0), "end", "", &numbers);
        svg.height += ROW;
    }
    let mut free = 0.0;
    for tick in &scale.ticks {
        let text = scale.text(*tick);
        let half = 0.5 * text_width(&text);
        if at(*tick) - half >= free {
            svg.text((at(*tick), svg.height + 12.0), "middle", "soft", &text);
            free = at(*tick) + half + 6.0;
        }
    }
    svg.height += 18.0;
}

/// `12.3 ± 0.4`, two figures of the interval.
fn numbers(row: &Row) -> String {
    match row.half {
        Some(half) if half > 0.0 && half.is_finite() => {
            let decimals = (1.0 - half.log10().floor()).clamp(0.0, 6.0) as usize;
            format!("{:.decimals$} ± {half:.decimals$}", row.value + 0.0).replace('-', "−")
        }
        _ => format!("{:.3} held", row.value).replace('-', "−"),
    }
}
