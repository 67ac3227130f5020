//! A drawing as a PNG file.

use std::sync::{Arc, OnceLock};

use resvg::{tiny_skia, usvg};

use super::svg::WIDTH;
use crate::exit::{BUG, Failure};

/// Dots of a PNG per dot of the drawing.
const PNG_SCALE: f32 = 3.0;

/// The PNG file of an SVG document.
///
/// # Errors
/// What the renderer refuses (a bug of ours).
pub fn drawn(document: &str) -> Result<Vec<u8>, Failure> {
    let options = usvg::Options {
        font_family: FONT.into(),
        fontdb: fonts(),
        ..usvg::Options::default()
    };
    let tree = usvg::Tree::from_str(document, &options).map_err(bug)?;
    let size = tree.size();
    let width = (PNG_SCALE * WIDTH as f32).round() as u32;
    let height = (PNG_SCALE * size.height()).ceil() as u32;
    let mut pixels =
        tiny_skia::Pixmap::new(width, height).ok_or_else(|| bug("a picture without size"))?;
    let scale = tiny_skia::Transform::from_scale(PNG_SCALE, PNG_SCALE);
    resvg::render(&tree, scale, &mut pixels.as_mut());
    pixels.encode_png().map_err(bug)
}

/// The embedded font: the same picture on every machine.
const FONT: &str = "DejaVu Sans";

fn fonts() -> Arc<usvg::fontdb::Database> {
    static FONTS: OnceLock<Arc<usvg::fontdb::Database>> = OnceLock::new();
    let load = || {
        let mut fonts = usvg::fontdb::Database::new();
        fonts.load_font_data(dejavu::sans::regular().to_vec());
        Arc::new(fonts)
    };
    FONTS.get_or_init(load).clone()
}

fn bug(error: impl std::fmt::Display) -> Failure {
    Failure::new(BUG, format!("a plot could not be drawn: {error}"))
}
