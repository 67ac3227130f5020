//! The same data in two recordings, or twice in one: standard errors would count them twice.

use findings::{Finding, Kind};
use recording::intervals::{Segmentation, StaticInterval};
use recording::{Error, Recording};

findings::tuning! {
    /// Static intervals in a row that have to be the same.
    IN_A_ROW: usize = 4;

    /// Directions of gravity that differ by less than this share of the variance of their noise have the same noise: of two
    /// recordings with the very same placements one pair of twenty would, and four in a row by chance in one of 10⁵.
    SAME_NOISE: f64 = 0.1;

    /// The same within one recording, whose clock, unit and rounding are one: placements that a jig repeats differ by their noise.
    SAME_NOISE_WITHIN: f64 = 0.01;

    /// Largest relative difference in length of equal static intervals, by rounding and by where the detector sees their ends.
    SAME_LENGTH: f64 = 0.1;
}

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
                Finding::of(Kind::SAME_DATA)
                    .in_recording(&recording.name)
                    .detail("other", twin.name.clone()),
            ),
            None => kept.push(recording),
        }
    }
    (kept, said)
}

/// Refuses recordings of which one repeats a part of another, whatever its clock, its unit and its name, or a part of its own.
///
/// # Errors
/// The two and where the same data are.
pub fn none_is_there_twice<'a>(
    cut: impl IntoIterator<Item = (&'a Recording, &'a Segmentation)>,
) -> Result<(), Error> {
    let all: Vec<_> = cut.into_iter().collect();
    for (k, (second, of_second)) in all.iter().enumerate() {
        for (earlier, (first, of_first)) in all[..=k].iter().enumerate() {
            let (found, other) = match earlier == k {
                true => (again_from(&of_second.statics), "itself"),
                false => {
                    let found = same_from(&of_first.statics, &of_second.statics);
                    (found, &*first.name)
                }
            };
            let Some((i, j)) = found else {
                continue;
            };
            let (here, there) = (of_first.statics[i].span, of_second.statics[j].span);
            return Err(Error::input(
                Finding::of(Kind::READINGS_TWICE)
                    .in_recording(&second.name)
                    .at_interval(j)
                    .from_time(there.from)
                    .detail("other", other)
                    .count("interval", i + 1)
                    .detail("time", format!("{:.2} s", here.from)),
            ));
        }
    }
    Ok(())
}

/// From where on so many static intervals in a row are the same.
fn same_from(first: &[StaticInterval], second: &[StaticInterval]) -> Option<(usize, usize)> {
    let mut runs = first.windows(IN_A_ROW.get()).enumerate();
    runs.find_map(|(i, run)| Some((i, place_of(run, second, SAME_NOISE.get())?)))
}

/// From where on a recording has static intervals that were there before.
fn again_from(all: &[StaticInterval]) -> Option<(usize, usize)> {
    // One placement again and again is no session that was appended.
    let is_one = |run: &[StaticInterval]| are_same(&run[1..], run, SAME_NOISE.get());
    let runs = all.windows(IN_A_ROW.get()).enumerate();
    let mut runs = runs.filter(|(_, run)| run.iter().all(is_noisy) && !is_one(run));
    runs.find_map(|(i, run)| {
        let later = i + IN_A_ROW.get();
        Some((
            i,
            later + place_of(run, &all[later..], SAME_NOISE_WITHIN.get())?,
        ))
    })
}

/// The first place of the same static intervals in a row.
fn place_of(run: &[StaticInterval], all: &[StaticInterval], noise: f64) -> Option<usize> {
    let mut places = all.windows(run.len());
    places.position(|other| are_same(run, other, noise))
}

/// Returns true if the readings are more than one value.
fn is_noisy(rest: &StaticInterval) -> bool {
    rest.accelerometer
        .is_some_and(|mean| mean.covariance.trace() > 0.0)
}

fn are_same(first: &[StaticInterval], second: &[StaticInterval], noise: f64) -> bool {
    first.iter().zip(second).all(|(a, b)| is_same(a, b, noise))
}

fn is_same(a: &StaticInterval, b: &StaticInterval, noise: f64) -> bool {
    let (Some(one), Some(other)) = (a.accelerometer, b.accelerometer) else {
        return false;
    };
    let [long, short] = [a.span.length(), b.span.length()];
    let direction = one.mean.normalize() - other.mean.normalize();
    let variance =
        [one, other].map(|m| m.covariance.trace() / m.mean.norm_squared() / m.count as f64);
    (long - short).abs() < SAME_LENGTH.get() * long.max(short)
        && direction.norm_squared() <= noise * (variance[0] + variance[1])
}

#[cfg(test)]
mod tests {
    use recording::intervals::{Detector, segment};
    use simulate::Spec;

    use super::*;

    #[test]
    fn a_recording_appended_to_itself_is_refused_and_repeated_faces_are_not() {
        let once = Spec::hand_held(3).run().unwrap().recording;
        let cut = segment(&once, &Detector::default()).unwrap();
        assert!(none_is_there_twice([(&once, &cut)]).is_ok());
        let (first, mut second) = (&cut.statics, cut.statics.clone());
        let both = |second: &[StaticInterval]| [first, second].concat();
        assert_eq!(again_from(&both(&second)), Some((0, first.len())));
        // The very same placements with a noise of their own.
        for rest in &mut second {
            let mean = rest.accelerometer.as_mut().unwrap();
            mean.mean.x += (mean.covariance[(0, 0)] / mean.count as f64).sqrt();
        }
        assert_eq!(again_from(&both(&second)), None);
    }
}
