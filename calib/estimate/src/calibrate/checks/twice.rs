//! The same data in two recordings: standard errors would count them twice.

use findings::{Finding, Kind};
use recording::intervals::{Segmentation, StaticInterval};
use recording::{Error, Recording};

/// Static intervals in a row that have to be the same.
const IN_A_ROW: usize = 4;

/// Directions of gravity that differ by less than this share of the variance of their noise have the same noise: of two
/// recordings with the very same placements one pair of twenty would, and four in a row by chance in one of 10⁵.
const SAME_NOISE: f64 = 0.1;

/// Largest relative difference in length of equal static intervals, by rounding and by where the detector sees their ends.
const SAME_LENGTH: f64 = 0.1;

/// The recordings without copies, and what to say of these.
pub fn without_copies<'a>(
    recordings: impl IntoIterator<Item = &'a Recording>,
) -> (Vec<&'a Recording>, Vec<Finding>) {
    let (mut kept, mut said) = (Vec::<&Recording>::new(), Vec::new());
    for recording in recordings {
        let is_copy = |other: &&&Recording| {
            other.accelerometer == recording.accelerometer && other.gyroscope == recording.gyroscope
        };
        match kept.iter().find(is_copy) {
            Some(twin) => said.push(
                Finding::of(Kind::SameData)
                    .in_recording(&recording.name)
                    .detail("other", twin.name.clone()),
            ),
            None => kept.push(recording),
        }
    }
    (kept, said)
}

/// Refuses recordings of which one repeats a part of another, whatever its clock, its unit and its name.
///
/// # Errors
/// The two and where the same data are.
pub fn none_is_there_twice<'a>(
    cut: impl IntoIterator<Item = (&'a Recording, &'a Segmentation)>,
) -> Result<(), Error> {
    let all: Vec<_> = cut.into_iter().collect();
    for (k, (second, of_second)) in all.iter().enumerate() {
        for (first, of_first) in &all[..k] {
            let Some((i, j)) = same_from(&of_first.statics, &of_second.statics) else {
                continue;
            };
            let (here, there) = (of_first.statics[i].span, of_second.statics[j].span);
            return Err(Error::input(
                Finding::of(Kind::ReadingsTwice)
                    .in_recording(&second.name)
                    .at_interval(j)
                    .from_time(there.from)
                    .detail("other", first.name.clone())
                    .count("interval", i + 1)
                    .detail("time", format!("{:.2} s", here.from)),
            ));
        }
    }
    Ok(())
}

/// From where on so many static intervals in a row are the same.
fn same_from(first: &[StaticInterval], second: &[StaticInterval]) -> Option<(usize, usize)> {
    let runs = |i: usize| {
        let from = move |j: usize| (i, j);
        (0..=second.len().checked_sub(IN_A_ROW)?)
            .map(from)
            .find(|(i, j)| (0..IN_A_ROW).all(|k| is_same(&first[i + k], &second[j + k])))
    };
    (0..=first.len().checked_sub(IN_A_ROW)?).find_map(runs)
}

fn is_same(a: &StaticInterval, b: &StaticInterval) -> bool {
    let (Some(one), Some(other)) = (a.accelerometer, b.accelerometer) else {
        return false;
    };
    let [long, short] = [a.span.length(), b.span.length()];
    let direction = one.mean.normalize() - other.mean.normalize();
    let variance =
        [one, other].map(|m| m.covariance.trace() / m.mean.norm_squared() / m.count as f64);
    (long - short).abs() < SAME_LENGTH * long.max(short)
        && direction.norm_squared() <= SAME_NOISE * (variance[0] + variance[1])
}
