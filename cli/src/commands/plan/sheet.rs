//! A page to print: a picture of every placement.

use std::fmt::Write as _;

use nalgebra::{Matrix3, Rotation3, Vector3};
use plan::{Plan, Step};

use super::tables::instruction;
use crate::report::policy;
use crate::show;

/// Half the sides of a phone.
const HALF: [f64; 3] = [0.36, 0.72, 0.06];
/// Viewpoint: azimuth about the vertical, then elevation, °.
const EYE: [f64; 2] = [28.0, 22.0];
/// Pixels per length, the middle of the picture, and where the table is.
const SCALE: f64 = 78.0;
const MIDDLE: f64 = 100.0;
const TABLE: f64 = 158.0;
/// Length of the drawn axes outside the device.
const OUT: [f64; 3] = [0.2, 0.2, 0.4];
/// From the top of the device to the middle of the word for it, across and up, pixels.
const BESIDE: [f64; 2] = [46.0, 38.0];

/// The page.
pub fn page(plan: &Plan, notes: &[String], force_only: bool) -> String {
    let mut page = format!(
        "<!doctype html><html lang=\"en\"><head><meta charset=\"utf-8\">\
         <meta http-equiv=\"Content-Security-Policy\" content=\"{}\">\
         <meta name=\"viewport\" content=\"width=device-width\"><title>Placements to record</title>\
         <style>{STYLE}</style></head><body><main>",
        policy(STYLE, None)
    );
    let _ = write!(
        page,
        "<h1>{}, {}</h1>",
        show::counted(plan.steps.len(), "placement"),
        show::counted((plan.duration / 60.0).ceil() as usize, "minute")
    );
    // What the words mean comes before them.
    if let Some(legend) = notes.first() {
        let _ = write!(page, "<p>{}</p>", escaped(legend));
    }
    page.push_str("<ol>");
    for step in &plan.steps {
        let words = escaped(&instruction(step, force_only));
        let _ = write!(page, "<li>{}<p>{words}</p></li>", picture(step));
    }
    page.push_str("</ol>");
    for note in notes.iter().skip(1) {
        let _ = write!(page, "<p>{}</p>", escaped(note));
    }
    page.push_str("</main></body></html>\n");
    page
}

const STYLE: &str = "\
:root{color-scheme:light dark;--ink:#1d2733;--paper:#fff;--side:#c9d3de;--edge:#44566b;--screen:#2f6fb3;--line:#d5dce4}\
@media (prefers-color-scheme:dark){:root{--ink:#e6ebf1;--paper:#14191f;--side:#4d5c6d;--edge:#b8c6d6;--screen:#2f6fb3;\
--line:#313b46}}@media print{:root{--ink:#000;--paper:#fff;--side:#ddd;--edge:#333;--screen:#446}}\
body{font:15px/1.4 system-ui,sans-serif;color:var(--ink);background:var(--paper);max-width:72rem;margin:1.5rem auto;\
padding:0 1rem}ol{display:grid;grid-template-columns:repeat(auto-fill,minmax(15rem,1fr));gap:1rem;padding:0;\
list-style-position:inside}li{border:1px solid var(--line);border-radius:.5rem;padding:.6rem;break-inside:avoid}\
li::marker{font-weight:600}svg{display:block;width:100%;max-height:11rem}p{margin:.4rem 0}text{text-anchor:middle;\
font:11px system-ui,sans-serif}.side{fill:var(--side)}.screen{fill:var(--screen)}\
.box{stroke:var(--edge);stroke-width:1.5;stroke-linejoin:round}.table{fill:none;stroke:var(--line);stroke-width:2}\
.ink{fill:var(--ink)}.axis{stroke:var(--ink);stroke-width:1.5}.name{fill:#fff}";

/// The box with its placement's direction up.
fn picture(step: &Step) -> String {
    let up = Vector3::from(step.up);
    let attitude = eye() * upright(&up);
    let mut svg = format!(
        "<svg viewBox=\"0 0 200 190\" role=\"img\" aria-label=\"{}\"><ellipse class=\"table\" cx=\"100\" cy=\"{TABLE}\" \
         rx=\"88\" ry=\"24\"/>",
        escaped(&step.words)
    );
    let table = TABLE + lowest(&attitude);
    let at = |v: &Vector3<f64>| [MIDDLE + SCALE * v.x, table - SCALE * v.z];
    let mut faces: Vec<usize> = (0..6).collect();
    let depth = |k: usize| (attitude * (normal(k) * HALF[k / 2])).y;
    faces.sort_by(|a, b| depth(*b).total_cmp(&depth(*a)));
    for k in faces {
        if (attitude * normal(k)).y >= -1e-9 {
            continue;
        }
        let corners: Vec<String> = corners(k)
            .iter()
            .map(|c| at(&(attitude * c)))
            .map(|[x, y]| format!("{x:.1},{y:.1}"))
            .collect();
        let class = if k == 4 { "box screen" } else { "box side" };
        let _ = write!(
            svg,
            "<polygon class=\"{class}\" points=\"{}\"/>",
            corners.join(" ")
        );
        let [x, y] = at(&(attitude * (normal(k) * HALF[k / 2])));
        let (class, name) = match k {
            4 => ("name", "screen"),
            5 => ("ink", "back"),
            _ => continue,
        };
        let _ = write!(
            svg,
            "<text class=\"{class}\" x=\"{x:.0}\" y=\"{:.0}\">{name}</text>",
            y + 4.0
        );
    }
    // The axes that turns are about, from the middle of the device out of it.
    for (k, name) in ["x", "y", "z"].into_iter().enumerate() {
        let axis = |length: f64| attitude * (Vector3::ith(k, 1.0) * length);
        let [from, to] = [at(&axis(HALF[k])), at(&axis(HALF[k] + OUT[k]))];
        let [x, y] = at(&axis(HALF[k] + OUT[k] + 0.1));
        let _ = write!(
            svg,
            "<line class=\"axis\" x1=\"{:.1}\" y1=\"{:.1}\" x2=\"{:.1}\" y2=\"{:.1}\"/>\
             <text class=\"ink\" x=\"{x:.0}\" y=\"{:.0}\">{name}</text>",
            from[0],
            from[1],
            to[0],
            to[1],
            y + 4.0
        );
    }
    // Beside the top, in the direction from the middle to it; towards the eye a word would lie on the device.
    let top = attitude * Vector3::new(0.0, HALF[1], 0.0);
    let length = top.x.hypot(top.z).max(1e-9);
    let [x, y] = at(&top);
    let _ = write!(
        svg,
        "<text class=\"ink\" x=\"{:.0}\" y=\"{:.0}\">top</text></svg>",
        x + BESIDE[0] * top.x / length,
        y - BESIDE[1] * top.z / length + 4.0
    );
    svg
}

/// Returns the height of the lowest corner relative to the middle of the device on the picture, pixels, negative
/// downwards.
fn lowest(attitude: &Rotation3<f64>) -> f64 {
    let all = (0..6).flat_map(corners).map(|c| (attitude * c).z);
    SCALE * all.fold(0.0, f64::min)
}

fn normal(k: usize) -> Vector3<f64> {
    Vector3::ith(k / 2, if k.is_multiple_of(2) { 1.0 } else { -1.0 })
}

fn corners(k: usize) -> [Vector3<f64>; 4] {
    let (a, b) = ((k / 2 + 1) % 3, (k / 2 + 2) % 3);
    [(-1.0, -1.0), (1.0, -1.0), (1.0, 1.0), (-1.0, 1.0)].map(|(s, t)| {
        let mut c = normal(k) * HALF[k / 2];
        c[a] = s * HALF[a];
        c[b] = t * HALF[b];
        c
    })
}

fn eye() -> Rotation3<f64> {
    let [around, raised] = EYE.map(f64::to_radians);
    Rotation3::from_axis_angle(&Vector3::x_axis(), raised)
        * Rotation3::from_axis_angle(&Vector3::z_axis(), around)
}

/// Body to room with `up` vertical and the screen, else the top, towards the eye.
fn upright(up: &Vector3<f64>) -> Rotation3<f64> {
    let front = if up.z.abs() > 0.95 {
        -Vector3::y() * up.z.signum()
    } else {
        Vector3::z()
    };
    let front = (front - up * up.dot(&front)).normalize();
    // The eye looks along +y: what faces it points to -y.
    let back = -front;
    let right = back.cross(up);
    Rotation3::from_matrix_unchecked(Matrix3::from_rows(&[
        right.transpose(),
        back.transpose(),
        up.transpose(),
    ]))
}

fn escaped(text: &str) -> String {
    let text = show::printable(text);
    text.replace('&', "&amp;")
        .replace('<', "&lt;")
        .replace('>', "&gt;")
        .replace('"', "&quot;")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_placement_is_drawn_upright_and_not_mirrored() {
        for up in plan::tilts() {
            let attitude = upright(&up);
            assert!((attitude * up - Vector3::z()).norm() < 1e-12);
            assert!((attitude.matrix().determinant() - 1.0).abs() < 1e-12);
        }
    }
}
