//! In a browser's program no PNG file is drawn: the renderer and its font are a tenth of it.

use crate::exit::Failure;

/// No PNG file.
///
/// # Errors
/// Always.
pub fn drawn(_document: &str) -> Result<Vec<u8>, Failure> {
    Err(Failure::usage(
        "--plots: the program of a browser writes no PNG files; --report has the same pictures",
    ))
}
