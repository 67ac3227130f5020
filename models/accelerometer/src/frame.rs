//! The frame that the nine observable numbers of an accelerometer are written in.
//!
//! `|T (A − b)| = g` does not change when `T` is replaced by `R T` for a rotation `R`: gravity's
//! norm knows nine of the twelve numbers. The convention `alpha_xz = alpha_xy = alpha_yx = 0`
//! takes up the other three: the sensor's x axis on the body's x axis, its y axis in the body's x-y
//! plane, `T` upper triangular (Liu et al. 2021; Skog & Händel 2006).

/// The parameters that the triangular frame holds at zero.
pub const FIXED_BY_FRAME: [&str; 3] = ["accel.alpha_xz", "accel.alpha_xy", "accel.alpha_yx"];

/// True for the parameters that are free in the triangular frame.
pub fn is_free_in_triangular_frame(name: &str) -> bool {
    !FIXED_BY_FRAME.contains(&name)
}
