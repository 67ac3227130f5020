//! Three batches of a text at once: one is read, the next is parsed by all threads, the last is used.

use std::io::Read;

use super::batches::{Batch, Batches};
use crate::rows::plain::{Block, Plain};

/// Hands every batch that is left to `using`, parsed and in order, until that fails.
///
/// What `using` sees does not depend on the number of threads.
///
/// # Errors
/// Those of `using`.
pub fn parse_all<E: Send>(
    batches: &mut Batches<impl Read + Send>,
    plain: &Plain,
    mut using: impl FnMut(&Batch, &[Block]) -> Result<(), E> + Send,
) -> Result<(), E> {
    let mut parsed: Option<(Batch, Vec<Block>)> = None;
    let mut read = batches.next(Vec::new());
    while let Some(batch) = read {
        let last = parsed.take();
        let (next, blocks) = rayon::join(
            || {
                if let Some((batch, blocks)) = &last {
                    using(batch, blocks)?;
                }
                let emptied = last.map(|(batch, _)| batch.bytes);
                Ok(batches.next(emptied.unwrap_or_default()))
            },
            || plain.parse(&batch, 0),
        );
        read = next?;
        parsed = Some((batch, blocks));
    }
    parsed.map_or(Ok(()), |(batch, blocks)| using(&batch, &blocks))
}
