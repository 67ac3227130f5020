//! A bias that jumps at the same time into every static interval: the device sets its zero anew while it rests.

use nalgebra::Vector3;

use super::of_sensor::OfSensor;
use super::symptom::Symptom;
use crate::averages::median;

findings::tuning! {
    /// Readings are compared as means over so long, s.
    BATCH: f64 = 0.25;

    /// So much of a static interval is looked at, s.
    LOOKED_AT: f64 = 15.0;

    /// The square of the steps from reading to reading is twice the variance of white noise. Where it is less than this share of
    /// that, a hand trembles, and what is left of that in the means is slow and may begin with the rest.
    WHITE: f64 = 0.35;

    /// Means left out at the begin: what is left of the turn, and of the hand that lays the device down.
    SETTLING: usize = 2;

    /// Means on either side of a jump, at least.
    BESIDE: usize = 4;

    /// Fewest static intervals that show a jump.
    FEWEST: usize = 5;

    /// The jumps explain more than chance by so many standard deviations of `χ²`: one in a million by a normal law, a few hundred
    /// times more by the tail of `χ²` and all places of the jump.
    EVIDENT: f64 = 5.0;

    /// A creep or a decay, with as many coefficients, explains less by this factor and by [`APART`] ...
    BEATS: f64 = 1.1;
    /// ... and jumps at another place, [`ELSEWHERE`] from there and more, less by this one: a hand that trembles and noise that
    /// wanders have jumps everywhere.
    BEATS_ELSEWHERE: f64 = 1.25;

    /// s.
    ELSEWHERE: f64 = 1.5;

    /// Twice the log-likelihood that makes a jump twenty times likelier.
    APART: f64 = 6.0;

    /// Least mean share of each static interval's best jump that jumps at the common place, or within [`BESIDE_IT`] means of it,
    /// explain. A bias that flips at random jumps elsewhere in each interval. In simulation the share is at least .88 for twelve devices
    /// that set their zero anew, and at most .84 for the seven whose bias flips the most.
    COMMON: f64 = 0.86;
    /// Means beside the common place that count as it.
    BESIDE_IT: usize = 2;

    /// Means that are so far from each other know nothing of each other.
    APART_MEANS: usize = 3;
}

/// Time constants of a decay that are tried, s.
const DECAYS: [f64; 3] = [1.0, 3.0, 6.0];

/// A jump that is the same distance from the begin of most static intervals.
///
/// In every static interval but the first, of which nobody knows when the rest began, means over [`BATCH`] are fitted by two
/// levels that meet at a time that is common to all. What that explains, over the scatter of the means of that interval about
/// it, is `χ²` of three degrees of freedom for each interval where nothing jumps.
pub(super) fn found(of: &OfSensor<'_>) -> Option<Symptom> {
    let rests = batches(of)?;
    let longest = rests.iter().map(|rest| rest.means.len()).max()?;
    let places = BESIDE.get()..longest.saturating_sub(BESIDE.get()) + 1;
    let jump = |place: usize| explained(&rests, |k, n| jump(place, k, n));
    let all: Vec<Jumps> = places.map(|place| (place, jump(place))).collect();
    let (place, own) = all
        .iter()
        .max_by(|a, b| total(&a.1).total_cmp(&total(&b.1)))?;
    let shown: Vec<&(usize, f64)> = own.iter().filter(|(_, by)| *by > 0.0).collect();
    let largest = shown.iter().map(|(_, by)| *by).fold(0.0, f64::max);
    let memory = memory(&rests);
    let is_evident = |explained: f64, count: usize| {
        let dof = 3.0 * count as f64;
        explained / memory > dof + EVIDENT.get() * (2.0 * dof).sqrt()
    };
    // One static interval that was touched has a jump of its own.
    let is_shown = shown.len() >= FEWEST.get()
        && is_evident(total(own), shown.len())
        && is_evident(total(own) - largest, shown.len() - 1);
    if !is_shown {
        return None;
    }
    let beats = total(own) > rival(&rests, &all, *place, own) + APART.get();
    (beats && common(&all, *place) > COMMON.get()).then(|| Symptom::Rezeroed {
        sensor: of.sensor,
        after: (SETTLING.get() + place) as f64 * BATCH.get(),
        size: size(&rests, *place),
        intervals: shown.iter().map(|(rest, _)| rest + 1).collect(),
    })
}

/// Variance of a level over that of means that know nothing of each other, at least 1: `(1 + ρ)/(1 − ρ)` of neighbours that correlate by
/// `ρ`, which their differences show beside those of means [`APART_MEANS`] further. A jump is in few differences, and not in their median.
fn memory(rests: &[Rest]) -> f64 {
    let of = |lag: usize| {
        let pairs = rests
            .iter()
            .flat_map(|rest| rest.means.iter().zip(rest.means.iter().skip(lag)));
        median(pairs.flat_map(|(a, b)| (b - a).map(|d| d * d).data.0[0]))
    };
    match (of(1), of(APART_MEANS.get())) {
        (Some(near), Some(far)) if near > 0.0 => (2.0 * far / near - 1.0).max(1.0),
        _ => 1.0,
    }
}

/// Returns the chi-square that jumps at `place` must exceed: that of a line or a decay in each interval (creep, warm-up,
/// relaxation; as many coefficients), or of jumps at distant places, each times a factor.
fn rival(rests: &[Rest], all: &[Jumps], place: usize, own: &[(usize, f64)]) -> f64 {
    let of_shape = |shape: &dyn Fn(usize, usize) -> Option<f64>| {
        let of = explained(rests, shape);
        let same = of.iter().zip(own).filter(|(_, (_, by))| *by > 0.0);
        same.map(|((_, by), _)| by).sum::<f64>()
    };
    let line = of_shape(&|k, _| Some(k as f64));
    let decays = DECAYS.map(|tau| of_shape(&|k, _| Some((-(k as f64) * BATCH.get() / tau).exp())));
    let smooth = decays.into_iter().fold(line, f64::max);
    let is_far = |other: usize| other.abs_diff(place) as f64 * BATCH.get() >= ELSEWHERE.get();
    let far = all.iter().filter(|(other, _)| is_far(*other));
    let elsewhere = far.map(|(_, by)| total(by)).fold(0.0, f64::max);
    (BEATS.get() * smooth).max(BEATS_ELSEWHERE.get() * elsewhere)
}

/// A place, and of every static interval its own place and what a jump there explains.
type Jumps = (usize, Vec<(usize, f64)>);

/// The means of one static interval, each axis over its scatter.
struct Rest {
    /// Its place.
    place: usize,
    means: Vec<Vector3<f64>>,
    /// Sum of squares about the mean of all.
    square: f64,
    /// The scatter of neighbouring means.
    scatter: Vector3<f64>,
}

/// The static intervals but the first that are long enough for a jump.
fn batches(of: &OfSensor<'_>) -> Option<Vec<Rest>> {
    let step = of.stream.median_step().filter(|step| *step > 0.0)?;
    let size = (BATCH.get() / step).round().max(1.0) as usize;
    let mut rests = Vec::new();
    let (mut steps, mut within) = (0.0, 0.0);
    for (place, _) in of.moments.iter().filter(|(place, _)| *place > 0) {
        let span = of.statics[*place].span;
        let until = span.to.min(span.from + LOOKED_AT.get());
        let samples = &of.stream.values[of.stream.between(span.from, until)];
        let whole = samples.chunks_exact(size).skip(SETTLING.get());
        let means = whole.map(|batch| {
            let mean = batch.iter().sum::<Vector3<f64>>() / size as f64;
            let jumps = batch
                .windows(2)
                .map(|pair| (pair[1] - pair[0]).norm_squared());
            steps += jumps.sum::<f64>();
            within += batch.iter().map(|v| (v - mean).norm_squared()).sum::<f64>();
            mean
        });
        let means: Vec<Vector3<f64>> = means.collect();
        if means.len() >= 2 * BESIDE.get() {
            rests.push((*place, means));
        }
    }
    let mut square = Vector3::zeros();
    let mut count = 0.0;
    for pair in rests.iter().flat_map(|(_, means)| means.windows(2)) {
        square += (pair[1] - pair[0]).map(|d| d * d);
        count += 2.0;
    }
    let scatter = square.map(|s: f64| (s / count).sqrt());
    // Of `n` readings there are `n − 1` steps, and as many degrees of freedom about their mean.
    let is_white = steps >= WHITE.get() * 2.0 * within;
    let moves = is_white && scatter.iter().all(|s| *s > 0.0);
    let rest = |(place, means): (usize, Vec<Vector3<f64>>)| {
        let means: Vec<Vector3<f64>> = means.iter().map(|m| m.component_div(&scatter)).collect();
        let mean = means.iter().sum::<Vector3<f64>>() / means.len() as f64;
        Rest {
            place,
            square: means.iter().map(|m| (m - mean).norm_squared()).sum(),
            means,
            scatter,
        }
    };
    (rests.len() >= FEWEST.get() && moves).then(|| rests.into_iter().map(rest).collect())
}

/// Two levels that meet at `place`; `None` of an interval that has too little on either side.
fn jump(place: usize, k: usize, n: usize) -> Option<f64> {
    (place + BESIDE.get() <= n).then(|| f64::from(u8::from(k >= place)))
}

/// Fits a level and a multiple of the shape `f(k)` to the `n` means of each interval, for every axis. Returns the interval's place
/// and the chi-square explained: the fall of the sum of squares below that of a level, over the variance that is left.
fn explained(rests: &[Rest], shape: impl Fn(usize, usize) -> Option<f64>) -> Vec<(usize, f64)> {
    let of = |rest: &Rest| {
        let n = rest.means.len();
        let own: Option<Vec<f64>> = (0..n).map(|k| shape(k, n)).collect();
        let by = own.map_or(0.0, |own| along(&centred(&own), &rest.means).norm_squared());
        let left = (rest.square - by) / (3 * (n - 2)) as f64;
        (rest.place, if left > 0.0 { by / left } else { 0.0 })
    };
    rests.iter().map(of).collect()
}

/// The shape less its mean, of unit length.
fn centred(shape: &[f64]) -> Vec<f64> {
    let mean = shape.iter().sum::<f64>() / shape.len() as f64;
    let length = shape.iter().map(|s| (s - mean).powi(2)).sum::<f64>().sqrt();
    shape.iter().map(|s| (s - mean) / length).collect()
}

fn along(shape: &[f64], means: &[Vector3<f64>]) -> Vector3<f64> {
    shape.iter().zip(means).map(|(s, m)| m * *s).sum()
}

/// Returns the ratio of the best jump about `place` to the best jump anywhere, as a mean over the intervals.
fn common(all: &[Jumps], place: usize) -> f64 {
    let count = all.first().map_or(0, |(_, by)| by.len());
    let shares = (0..count).filter_map(|rest| {
        let most = |near: &dyn Fn(usize) -> bool| {
            let places = all.iter().filter(|(other, _)| near(*other));
            places.map(|(_, by)| by[rest].1).fold(0.0, f64::max)
        };
        let best = most(&|_| true);
        let here = most(&|other| other.abs_diff(place) <= BESIDE_IT.get());
        (best > 0.0).then_some(here / best)
    });
    let shares: Vec<f64> = shares.collect();
    shares.iter().sum::<f64>() / shares.len().max(1) as f64
}

fn total(explained: &[(usize, f64)]) -> f64 {
    explained.iter().map(|(_, by)| by).sum()
}

/// Root mean square length of the jumps, less what the scatter of the means makes of it.
fn size(rests: &[Rest], place: usize) -> f64 {
    let own = rests
        .iter()
        .filter(|rest| rest.means.len() >= place + BESIDE.get());
    let of = |rest: &Rest| {
        let (before, after) = rest.means.split_at(place);
        let mean = |part: &[Vector3<f64>]| part.iter().sum::<Vector3<f64>>() / part.len() as f64;
        let jump = (mean(after) - mean(before)).component_mul(&rest.scatter);
        let noise = 1.0 / before.len() as f64 + 1.0 / after.len() as f64;
        jump.norm_squared() - noise * rest.scatter.norm_squared()
    };
    let squares: Vec<f64> = own.map(of).collect();
    (squares.iter().sum::<f64>() / squares.len().max(1) as f64)
        .max(0.0)
        .sqrt()
}
