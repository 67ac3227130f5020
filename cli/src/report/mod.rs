//! Pictures and pages for people: plots as SVG and PNG, and one HTML file per report that needs no
//! network.
//!
//! ```text
//! Plot (panels of series) · Forest · Matrix · Sphere ──► Picture ──► svg() · png()
//! Report (verdict, figures, next steps, sections)    ──► html(): light and dark, wide, narrow, paper
//! ```
//!
//! Every picture is drawn once, 420 dots wide with letters of 12: a phone shows it at about that size, a wide page two
//! side by side. Colours are variables of the style, so that one drawing serves light, dark and paper.

mod axis;
mod draw;
mod forest;
mod html;
mod matrix;
mod picture;
mod plot;
#[cfg_attr(target_family = "wasm", path = "no_png.rs")]
mod png;
mod sphere;
mod svg;
mod theme;

pub use axis::Axis;
pub use forest::{Group, Row};
pub use html::{Figure, Level, Limit, Report, ReportTable, policy};
pub use picture::{Picture, numbered};
pub use plot::{Plot, Series};
pub use sphere::{Placed, Sphere};
