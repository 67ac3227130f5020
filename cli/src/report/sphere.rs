//! Directions on a sphere, seen from two sides: a script may turn it, paper shows all of it.

use super::svg::{Svg, WIDTH, escaped, num, text_width};

/// A direction with a key of its interval.
#[derive(Clone, Debug, PartialEq)]
pub struct Placed {
    /// Unit vector, in the axes of the device.
    pub at: [f64; 3],
    /// The static interval.
    pub key: String,
    /// Colour, as that of the recording.
    pub colour: usize,
}

/// Placements and the directions that are missing.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Sphere {
    /// Directions of the placements.
    pub placed: Vec<Placed>,
    /// Missing directions, with words.
    pub missing: Vec<([f64; 3], String)>,
}

const RADIUS: f64 = 88.0;
const TOP: f64 = 26.0;
/// Dots from the end of an axis to its name, clear of a placement there; as the script has it.
const BESIDE: f64 = 13.0;
/// The side that the first view is seen from: azimuth and elevation, rad.
const VIEW: (f64, f64) = (0.6, 0.45);

/// Axes of the picture for a view: to the right, up, towards the eye.
fn axes((azimuth, elevation): (f64, f64)) -> [[f64; 3]; 3] {
    let (sa, ca) = azimuth.sin_cos();
    let (se, ce) = elevation.sin_cos();
    [
        [-sa, ca, 0.0],
        [-se * ca, -se * sa, ce],
        [ce * ca, ce * sa, se],
    ]
}

fn dot(a: &[f64; 3], b: &[f64; 3]) -> f64 {
    a.iter().zip(b).map(|(a, b)| a * b).sum()
}

impl Sphere {
    pub(super) fn drawing(&self) -> Svg {
        let mut svg = Svg::default();
        let opposite = (VIEW.0 + std::f64::consts::PI, -VIEW.1);
        for (side, view) in [(0.25, VIEW), (0.75, opposite)] {
            self.view(&mut svg, side * WIDTH, view);
        }
        svg.height = TOP + 2.0 * RADIUS + 26.0;
        let y = svg.height - 5.0;
        let mut x = 4.0;
        let marks = [
            ("dot", "c0", "upward direction of a placement"),
            ("ring", "c1", "missing"),
        ];
        let shown = 1 + usize::from(!self.missing.is_empty());
        for (mark, class, words) in marks.into_iter().take(shown) {
            svg.open(&format!("class=\"{class}\""));
            svg.circle((x + 6.0, y - 4.0), 4.0, &format!("class=\"{mark}\""));
            svg.close();
            svg.text((x + 16.0, y), "start", "soft", words);
            x += 34.0 + text_width(words);
        }
        svg
    }

    fn view(&self, svg: &mut Svg, x: f64, view: (f64, f64)) {
        let center = (x, TOP + RADIUS);
        let look = axes(view);
        let place = |v: &[f64; 3]| {
            let [right, up, near] = [0, 1, 2].map(|k| dot(&look[k], v));
            ((center.0 + RADIUS * right, center.1 - RADIUS * up), near)
        };
        svg.open(&format!(
            "class=\"sphere\" data-v=\"{} {}\" data-b=\"{} {} {}\"",
            view.0,
            view.1,
            num(center.0),
            num(center.1),
            num(RADIUS)
        ));
        svg.circle(center, RADIUS, "class=\"ball\"");
        for circle in 0..3 {
            let line: Vec<_> = great_circle(circle)
                .iter()
                .map(place)
                .filter(|(_, near)| *near >= -1e-9)
                .map(|(at, _)| at)
                .collect();
            svg.strokes("grid", &arcs(&line));
        }
        let ends = (0..6).map(|k| {
            let mut v = [0.0; 3];
            v[k / 2] = if k % 2 == 0 { 1.0 } else { -1.0 };
            (v, ["+x", "−x", "+y", "−y", "+z", "−z"][k])
        });
        for (v, name) in ends {
            let (at, near) = place(&v);
            if near >= 0.0 {
                let out = 1.0 + BESIDE / RADIUS;
                let x = center.0 + (at.0 - center.0) * out;
                svg.raw(&format!(
                    "<text x=\"{}\" y=\"{}\" text-anchor=\"middle\" class=\"soft\" data-p=\"{}\">{name}</text>",
                    num(x),
                    num(center.1 + (at.1 - center.1) * out + 4.0),
                    point(&v)
                ));
            }
        }
        for placed in &self.placed {
            let (at, near) = place(&placed.at);
            if near >= 0.0 {
                let words = format!(
                    "class=\"dot c{}\" data-k=\"{}\" data-p=\"{}\"",
                    placed.colour % super::theme::SERIES,
                    placed.key,
                    point(&placed.at)
                );
                svg.circle(at, 4.0, &words);
            }
        }
        for (v, words) in &self.missing {
            let (at, near) = place(v);
            if near >= 0.0 {
                let words = format!(
                    "class=\"ring c1\" data-p=\"{}\" data-t=\"{}\"",
                    point(v),
                    escaped(&format!("missing: {words}"))
                );
                svg.circle(at, 6.0, &words);
            }
        }
        svg.close();
    }
}

fn point(v: &[f64; 3]) -> String {
    v.map(|c| format!("{c:.2}")).join(" ")
}

/// Points of the circle across one axis.
fn great_circle(axis: usize) -> Vec<[f64; 3]> {
    (0..=72)
        .map(|k| {
            let (s, c) = (f64::from(k) * 5.0).to_radians().sin_cos();
            let mut v = [0.0; 3];
            v[(axis + 1) % 3] = c;
            v[(axis + 2) % 3] = s;
            v
        })
        .collect()
}

/// Strokes between neighbours; points that lie apart belong to two ends of the visible part.
fn arcs(points: &[(f64, f64)]) -> Vec<[(f64, f64); 2]> {
    let near = |a: &(f64, f64), b: &(f64, f64)| (a.0 - b.0).hypot(a.1 - b.1) < 0.2 * RADIUS;
    let pairs = points.windows(2).filter(|pair| near(&pair[0], &pair[1]));
    pairs.map(|pair| [pair[0], pair[1]]).collect()
}
