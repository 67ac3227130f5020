//! A fill-reducing order of the blocks.

use faer::dyn_stack::{MemBuffer, MemStack};
use faer::sparse::SymbolicSparseColMatRef;
use faer::sparse::linalg::amd::{Control, order_maybe_unsorted, order_maybe_unsorted_scratch};

/// The place of every block in an approximate minimum degree order of the graph in which each meets
/// those listed (both ways); `None` where memory does not suffice. Blocks that nearly all others
/// meet come last.
///
/// Source: Amestoy, Davis and Duff, "An approximate minimum degree ordering algorithm", 1996.
pub(crate) fn fill_reducing(meets: &[Vec<u32>]) -> Option<Vec<u32>> {
    let n = meets.len();
    let mut starts = Vec::with_capacity(n + 1);
    let mut rows: Vec<u32> = Vec::new();
    starts.push(0u32);
    for (column, others) in meets.iter().enumerate() {
        let before = rows.len();
        rows.extend(others.iter().filter(|&&row| (row as usize) < column));
        rows[before..].sort_unstable();
        starts.push(u32::try_from(rows.len()).ok()?);
    }
    let pattern = SymbolicSparseColMatRef::new_checked(n, n, &starts, None, &rows);
    let mut memory = MemBuffer::try_new(order_maybe_unsorted_scratch::<u32>(n, rows.len())).ok()?;
    let (mut order, mut place) = (vec![0u32; n], vec![0u32; n]);
    order_maybe_unsorted(
        &mut order,
        &mut place,
        pattern,
        Control::default(),
        MemStack::new(&mut memory),
    )
    .ok()?;
    // Nested levels of the elimination tree stay together; see the test.
    Some(place)
}
