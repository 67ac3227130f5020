//! The k-th smallest of many values, without a copy of them.

/// Values that are copied and partly sorted at once.
const FEW: usize = 1 << 14;
/// Buckets of a pass: 2 to this power.
const BUCKET_BITS: u32 = 12;

/// The value with `rank` smaller or equal ones before it in [`f64::total_cmp`]'s order, rank 0 being
/// the smallest; `None` where there are no more than `rank` values.
///
/// Counts the values in equal buckets between the smallest and the largest, then in the bucket that
/// holds the rank, and so on: at most six passes over `values`, each in sequence, and memory that does
/// not grow with them.
pub(crate) fn nth_smallest(values: impl Iterator<Item = f64> + Clone, rank: usize) -> Option<f64> {
    let keys = values.map(key);
    let (mut low, mut high, mut count) = (u64::MAX, 0, 0);
    for key in keys.clone() {
        (low, high, count) = (low.min(key), high.max(key), count + 1);
    }
    if rank >= count {
        return None;
    }
    let mut rank = rank;
    while low < high {
        let within = keys.clone().filter(|key| (low..=high).contains(key));
        if count <= FEW {
            let mut within: Vec<u64> = within.collect();
            return Some(value(*within.select_nth_unstable(rank).1));
        }
        let shift = (u64::BITS - (high - low).leading_zeros()).saturating_sub(BUCKET_BITS);
        let mut buckets = [0; 1 << BUCKET_BITS];
        within.for_each(|key| buckets[((key - low) >> shift) as usize] += 1);
        let mut bucket = 0;
        while rank >= buckets[bucket] {
            rank -= buckets[bucket];
            bucket += 1;
        }
        count = buckets[bucket];
        low += (bucket as u64) << shift;
        high = high.min(low + ((1 << shift) - 1));
    }
    Some(value(low))
}

/// A number whose order among others is that of `value` by [`f64::total_cmp`].
fn key(value: f64) -> u64 {
    let bits = value.to_bits();
    bits ^ if bits >> 63 == 0 { 1 << 63 } else { u64::MAX }
}

/// The value of a [`key`].
fn value(key: u64) -> f64 {
    f64::from_bits(key ^ if key >> 63 == 1 { 1 << 63 } else { u64::MAX })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[track_caller]
    fn agrees_with_sorting(values: &[f64]) {
        let mut sorted = values.to_vec();
        sorted.sort_by(f64::total_cmp);
        for share in [0.0, 0.1, 0.5, 0.95, 1.0] {
            let rank = (share * (values.len() - 1) as f64) as usize;
            let found = nth_smallest(values.iter().copied(), rank).map(f64::to_bits);
            assert_eq!(found, Some(sorted[rank].to_bits()), "rank {rank}");
        }
    }

    #[test]
    fn ranks_are_those_of_the_sorted_values() {
        let n = 3 * FEW as u64;
        let scattered = |k: u64| (k.wrapping_mul(0x9e37_79b9_7f4a_7c15) >> 11) as f64;
        let any: Vec<f64> = (0..n).map(|k| f64::from_bits(key(scattered(k)))).collect();
        agrees_with_sorting(&any);
        let even: Vec<f64> = (0..n)
            .map(|k| (k + 1) as f64 * 0.01 - k as f64 * 0.01)
            .collect();
        agrees_with_sorting(&even);
        let outlier = [
            &even[..],
            &[1e300, -1e300, f64::NAN, f64::NEG_INFINITY, -0.0],
        ]
        .concat();
        agrees_with_sorting(&outlier);
        agrees_with_sorting(&vec![9.8; n as usize]);
        agrees_with_sorting(&[2.0, 1.0]);
    }

    #[test]
    fn there_is_no_rank_beyond_the_last() {
        assert_eq!(nth_smallest([1.0].into_iter(), 1), None);
        assert_eq!(nth_smallest(std::iter::empty(), 0), None);
    }
}
