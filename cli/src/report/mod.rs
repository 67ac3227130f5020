//! Pictures and pages for people: plots as SVG and PNG, and one HTML file per report that needs no
//! network.
//!
//! ```text
//! Plot (axes with units, series) ──► svg(theme) · png()
//! Report (sections of text, tables, plots) ──► html(): light and dark, wide and narrow
//! ```

mod axis;
mod draw;
mod html;
mod plot;
mod theme;

pub use axis::Axis;
pub use html::{Report, ReportTable};
pub use plot::{Plot, Series};
pub use theme::Theme;
