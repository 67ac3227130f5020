//! Memory that a recording takes, requested from the system before it is needed.

use findings::{Finding, Kind};

use crate::Error;
use crate::source::place::in_file;

/// A stamp and three values.
pub(crate) const SAMPLE: u64 = 32;

/// Working memory of a calibration beside the samples, bytes per sample: about a half more in sums and moments, and the unit that
/// the allocator rounds up to.
const WORK: u64 = 32;

/// Returns true if the system grants so many bytes; they are freed at once. The system refuses more than a set limit (`ulimit -v`)
/// and, without one, what exceeds memory and swap by far.
fn is_granted(bytes: u64) -> bool {
    let mut probe: Vec<u8> = Vec::new();
    let granted = usize::try_from(bytes).is_ok_and(|bytes| probe.try_reserve_exact(bytes).is_ok());
    // Without this the compiler may leave out an allocation that nobody uses.
    std::hint::black_box(&mut probe);
    granted
}

/// Refuses a text of about `rows` rows of `sensors` sensors whose samples do not fit.
pub(crate) fn room_to_read(name: &str, rows: u64, sensors: u64) -> Result<(), Error> {
    room(name, rows, rows.saturating_mul(sensors * (SAMPLE + WORK)))
}

/// Refuses `samples` samples that leave no room to work on them.
pub(crate) fn room_to_work(name: &str, samples: usize) -> Result<(), Error> {
    room(name, samples as u64, (samples as u64).saturating_mul(WORK))
}

fn room(name: &str, rows: u64, bytes: u64) -> Result<(), Error> {
    if is_granted(bytes) {
        return Ok(());
    }
    let size = format!("{:.0} MB", (bytes as f64 / 1e6).ceil());
    let found = Finding::of(Kind::TOO_LARGE_FOR_MEMORY)
        .count("rows", rows as usize)
        .detail("size", size);
    Err(in_file(name, found))
}

/// Room for one more in `vector`, by an eighth of what it holds: doubling would ask for half as much again as is
/// needed.
///
/// # Errors
/// When memory is short.
pub(crate) fn one_more<T>(vector: &mut Vec<T>) -> Result<(), ()> {
    if vector.len() < vector.capacity() {
        return Ok(());
    }
    let more = (vector.len() / 8).max(1024);
    let granted = vector.try_reserve_exact(more);
    granted
        .or_else(|_| vector.try_reserve_exact(1))
        .map_err(|_| ())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn more_than_there_is_is_refused_with_the_figure() {
        assert!(room_to_read("a.csv", 1000, 2).is_ok());
        let message = room_to_read("a.csv", 1 << 50, 2).unwrap_err().to_string();
        assert!(
            message.starts_with("a.csv: about 1125899906842624 rows need"),
            "{message}"
        );
        assert!(room_to_work("a.csv", usize::MAX).is_err());
    }

    #[test]
    fn a_vector_grows_by_an_eighth() {
        let mut vector = vec![0u8; 80_000];
        vector.shrink_to_fit();
        one_more(&mut vector).unwrap();
        assert!((80_001..100_000).contains(&vector.capacity()));
    }
}
