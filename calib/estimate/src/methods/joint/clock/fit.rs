//! The share of the scatter that belongs to the samples, and what is missing between them, from the turns.
//!
//! ```text
//! fit ─► what it leaves of the turns ─► sampling share c, clock share λ ─► weights, windows ─► fit …
//!                                                       └─► 0 or 1 where χ² allows it
//! ```

use recording::Error;

use super::sampling::{Share, likeliest};
use super::turn_residuals::TurnResiduals;
use crate::methods::joint::clock::{ClockMode, ClockState, SourceClock};
use crate::methods::joint::data::{Data, Source};
use crate::methods::joint::minimum::{Point, Run};

findings::tuning! {
    /// Rounds at most, for one clock.
    ROUNDS: usize = 5;

    /// A share that moves by less than this is found, ...
    SETTLED: f64 = 0.02;
    /// ... if it moves by less than this share of its standard error.
    SETTLED_ERRORS: f64 = 0.2;

    /// A sampling share that changes by less than this part of itself is found.
    STEADY: f64 = 0.06;

    /// The same of the scatter of the turns, in whose place others are put later.
    STEADY_FLOOR: f64 = 0.5;

    /// Other shares are not taken where the log-likelihood of the data falls by more than this.
    LESS_LIKELY: f64 = 0.5;

    /// `χ²` that 0 or 1 may cost over the fitted share.
    ALLOWED: f64 = 4.0;

    /// Turns that miss by more than this `χ²` per degree of freedom do not know the share well enough to say that it is 0
    /// or 1.
    MISFIT: f64 = 2.0;

    /// Shares between 0 and 1 that a mean is taken over.
    GRID: i32 = 64;

    /// A share with a larger standard error says nothing.
    UNKNOWN: f64 = 0.35;

    /// Log-likelihood that samples at instants have to gain over means, in units of what the turns miss by usually (`χ²` per degree of
    /// freedom): what something else makes of the turns may look like a little of either.
    EVIDENT: f64 = 2.0;

    /// First value of the sampling share: the usual part of the jumps that is missing between instantaneous samples.
    USUAL: f64 = 0.25;

    /// Sampling share from which on the new fit is rejected: a single turn with another fault makes a share as large as
    /// this.
    WHOLE: f64 = 0.9;
}

/// Fits the clocks of the recordings, writes them into the data, and returns the point that was reached; `None` where
/// there is nothing to fit.
///
/// # Errors
/// What the solver refuses.
pub(crate) fn settle_clock(
    run: &mut Run<'_>,
    point: Option<Point>,
) -> Result<Option<Point>, Error> {
    let request = run.request;
    let mut fit = ClockFit {
        run,
        open: Vec::new(),
        point,
        decided: request.clocks.clone(),
    };
    let data = &fit.run.data;
    let left = if request.clocks.is_some() {
        if !data.misses_something_between_samples() {
            return Ok(None);
        }
        fit.rounds()?
    } else {
        let either = fit.run.tell_instants(fit.point.as_ref());
        let jumps = (0..data.sources.len()).any(|k| data.jumps(k));
        if request.clock == ClockMode::Auto {
            fit.open = data.with_scatter();
        }
        if fit.open.is_empty() && either.is_empty() && !jumps {
            return Ok(None);
        }
        let left = fit.choose(&either)?;
        match request.disturbances {
            true => left,
            false => fit.with_the_whole_scatter(left)?,
        }
    };
    fit.decide(&left);
    let ClockFit { run, point, .. } = fit;
    // What scatters beyond noise and clock is judged with everything else.
    run.data
        .sources
        .iter_mut()
        .for_each(|source| source.clock.floor = 0.0);
    Ok(point)
}

/// The usual share in place of a scatter, for the recordings with jumps.
fn begin_with_a_share(data: &mut Data) {
    for k in 0..data.sources.len() {
        if data.jumps(k) {
            data.sources[k].clock.floor = 0.0;
            data.sources[k].clock.sampling = Share {
                value: USUAL.get(),
                ..Share::default()
            };
        }
    }
}

/// Estimates the uncertainty of the sampling shares that kept their first value.
fn say_how_sure(data: &mut Data, left: &TurnResiduals) {
    for k in 0..data.sources.len() {
        let (levels, turns) = (data.sources[k].levels(), left.of(data, k));
        let own = &mut data.sources[k].clock.sampling;
        if own.value > 0.0 && own.between == [0.0; 2] {
            let (found, _) = likeliest(&turns, levels, Some(true));
            let [low, high] = found.between;
            *own = Share {
                value: own.value,
                between: [low.min(own.value), high.max(own.value)],
                ..found
            };
        }
    }
}

/// A fit on its way.
struct ClockFit<'a, 'b> {
    run: &'a mut Run<'b>,
    /// The recordings whose share is fitted.
    open: Vec<usize>,
    point: Option<Point>,
    /// The clocks that are decided.
    decided: Option<Vec<SourceClock>>,
}

impl ClockFit<'_, '_> {
    /// The likeliest clocks: the shares from two starts, then what is behind the stamps, then what the samples of the
    /// recordings are that may have `either`.
    fn choose(&mut self, either: &[usize]) -> Result<TurnResiduals, Error> {
        let mut left = self.rounds()?;
        let scatters = |source: &Source| source.clock.floor > 0.0;
        if self.run.data.sources.iter().any(scatters) {
            left = self.anew_with_a_share(left)?;
        }
        for k in self.open.clone() {
            if self.run.data.bases(k) < 2 {
                continue;
            }
            let share = self.run.data.sources[k].clock.share;
            let misfit = left.misfit(&self.run.data, k);
            self.run.data.set_clock(k, 1, share);
            left = self.rounds()?;
            if left.misfit(&self.run.data, k) >= misfit {
                self.run.data.set_clock(k, 0, share);
                left = self.rounds()?;
            }
        }
        for &k in either {
            let needed = left.likelihood + EVIDENT.get() * left.misfit(&self.run.data, k).max(1.0);
            let (before, point) = (self.run.data.decided_clocks(), self.point.clone());
            self.run.data.sources[k].clock.instants = true;
            left = self.rounds()?;
            // Of all rows and under their own noise: a scatter that is allowed for makes any residual small.
            if left.likelihood < needed {
                // The last point may lie elsewhere: what is judged is judged at the one that stays.
                self.run.data.go_by(&before);
                self.point = point;
                left = self.fit()?;
            }
        }
        Ok(left)
    }

    /// Fits until the shares stand still, or the data are less likely under others.
    fn rounds(&mut self) -> Result<TurnResiduals, Error> {
        let mut left = self.fit()?;
        for _ in 0..ROUNDS.get() {
            let (before, point) = (self.run.data.decided_clocks(), self.point.clone());
            let moved = self.sampling(&left) | self.shares(&left);
            if !moved {
                break;
            }
            let next = self.fit()?;
            if next.likelihood < left.likelihood - LESS_LIKELY.get() {
                let clocks = before.into_iter().zip(&self.run.data.sources);
                let clocks = clocks.map(|(before, since)| SourceClock {
                    fitted: since.clock.fitted,
                    ..before
                });
                self.run.data.go_by(&clocks.collect::<Vec<_>>());
                self.point = point;
                say_how_sure(&mut self.run.data, &left);
                break;
            }
            left = next;
        }
        Ok(left)
    }

    /// Begins anew with the share that is usual where the rate jumps between samples, and stays there where the data are
    /// likelier so.
    ///
    /// Turns that were believed to their noise at first bend the models, and what then remains of them looks like a scatter
    /// that is the same for all.
    fn anew_with_a_share(&mut self, left: TurnResiduals) -> Result<TurnResiduals, Error> {
        let (before, point) = (self.run.data.decided_clocks(), self.point.clone());
        begin_with_a_share(&mut self.run.data);
        let from_share = self.rounds()?;
        let mut shares = self.run.data.sources.iter().map(|s| s.clock.sampling.value);
        if from_share.likelihood > left.likelihood && shares.all(|share| share < WHOLE.get()) {
            return Ok(from_share);
        }
        self.run.data.go_by(&before);
        self.point = point;
        Ok(left)
    }

    /// Refits with the whole scatter of the turns given to the sampling share, where the request allows the turns no
    /// scatter beyond all noise.
    /// The fits that this one is compared with do the same: a comparison needs the same noise in all of them.
    fn with_the_whole_scatter(&mut self, left: TurnResiduals) -> Result<TurnResiduals, Error> {
        let shares =
            |source: &Source| source.clock.floor > 0.0 && source.clock.sampling.value > 0.0;
        if !self.run.data.sources.iter().any(shares) {
            return Ok(left);
        }
        self.decided = Some(self.run.data.decided_clocks());
        self.run
            .data
            .sources
            .iter_mut()
            .filter(|source| shares(source))
            .for_each(|source| source.clock.floor = 0.0);
        self.rounds()
    }

    /// Returns the earlier decision on whether a recording misses something between samples; `None` without one.
    fn decided(&self, recording: usize) -> Option<bool> {
        let decided = self.decided.as_ref()?.get(recording);
        decided.map(|clock| clock.sampling.value > 0.0)
    }

    /// The minimum with the shares as they are.
    fn fit(&mut self) -> Result<TurnResiduals, Error> {
        let noise = self.run.noise_near(self.point.as_ref());
        let weights = self.run.weights_under(&noise);
        let point = self.run.approach(&weights, self.point.as_ref())?;
        let under = (&weights.whitening.white, noise.by_share.as_slice());
        let left = TurnResiduals::of_fit(self.run, &point, under, &self.open);
        self.point = Some(point);
        Ok(left)
    }

    /// The likeliest sampling share of every recording; whether any moved.
    fn sampling(&mut self, left: &TurnResiduals) -> bool {
        let mut moved = false;
        for k in 0..self.run.data.sources.len() {
            let decided = self.decided(k);
            let data = &mut self.run.data;
            if !data.jumps(k) {
                continue;
            }
            let before = data.sources[k].levels();
            let (share, floor) = likeliest(&left.of(data, k), before, decided);
            data.sources[k].clock.sampling = share;
            data.sources[k].clock.floor = floor;
            let differs = |a: f64, b: f64, by: f64| (a - b).abs() > by * a.max(b);
            moved |= differs(share.value, before.share, STEADY.get())
                || differs(floor, before.floor, STEADY_FLOOR.get());
        }
        moved
    }

    /// The likeliest shares of the clocks; whether any moved.
    fn shares(&mut self, left: &TurnResiduals) -> bool {
        let data = &mut self.run.data;
        let Some((steps, errors)) = left.steps(data) else {
            return false;
        };
        let mut moved = false;
        for (place, &k) in self.open.iter().enumerate() {
            let clock = data.sources[k].clock;
            let share = clock.share + steps[place];
            data.sources[k].clock.fitted = Some((share, errors[place]));
            let inside = share.clamp(0.0, 1.0);
            let change = (inside - clock.share).abs();
            if change > SETTLED.get() && change > SETTLED_ERRORS.get() * errors[place] {
                data.set_clock(k, clock.base, inside);
                moved = true;
            }
        }
        moved
    }

    /// Takes 0 or 1 where `χ²` allows it.
    fn decide(&mut self, left: &TurnResiduals) {
        let data = &mut self.run.data;
        for k in 0..data.sources.len() {
            if data.turns.iter().any(|turn| turn.recording == k) {
                data.sources[k].clock.misfit = Some(left.whole_misfit(data, k));
            }
        }
        for &k in &self.open {
            let clock = data.sources[k].clock;
            let Some((share, error)) = clock.fitted else {
                continue;
            };
            let misfit = left.misfit(data, k);
            let allows = |value: f64| ((share - value) / error).powi(2) <= ALLOWED.get();
            let nearer = if share < 0.5 { 0.0 } else { 1.0 };
            let (state, chosen) = if error.is_nan() || error > UNKNOWN.get() {
                // Steps that add up are those of samples taken when the host has time.
                let adds = data.bases(k) > 1;
                (ClockState::Undecided, if adds { 1.0 } else { 0.0 })
            } else if misfit <= MISFIT.get() && allows(nearer) {
                (ClockState::Snapped, nearer)
            } else if misfit <= MISFIT.get() && allows(1.0 - nearer) {
                (ClockState::Snapped, 1.0 - nearer)
            } else {
                (ClockState::Fitted, share.clamp(0.0, 1.0))
            };
            data.set_clock(k, clock.base, chosen);
            data.sources[k].clock.state = state;
            if state == ClockState::Snapped {
                data.set_timing(k, missed_by_snapping((share, error), chosen));
            }
        }
    }
}

/// Variance of the samples' times over that of the scatter, where a share that was fitted is taken for `chosen`, 0 or 1.
///
/// With a share `λ` the times have the variance `λ(1 − λ)` about the best clock, and `|λ − chosen|` about the chosen one: its
/// mean over what the share may be, half the prior chance on 0 and 1, half evenly between them. A share that is known
/// well leaves nothing; one that is known badly may be a mixture, and its turns are off by more than the noise of the
/// readings.
fn missed_by_snapping((share, error): (f64, f64), chosen: f64) -> f64 {
    let likelihood = |value: f64| (-0.5 * ((value - share) / error).powi(2)).exp();
    let between = (0..GRID.get()).map(|k| (f64::from(k) + 0.5) / f64::from(GRID.get()));
    let (sum, moment) = between.fold((0.0, 0.0), |(sum, moment), value| {
        let weight = 0.5 * likelihood(value) / f64::from(GRID.get());
        (sum + weight, moment + weight * (value - chosen).abs())
    });
    let [right, wrong] = [chosen, 1.0 - chosen].map(|value| 0.25 * likelihood(value));
    (moment + wrong) / (sum + right + wrong)
}

#[cfg(test)]
mod tests {
    use recording::intervals::{Detector, segment};
    use simulate::{Grade, Sampling, Spec};

    use super::*;
    use crate::methods::joint::{JointRequest, fit_joint};

    fn clock_of(spec: &Spec) -> SourceClock {
        let recording = spec.run().unwrap().recording;
        let segmentation = segment(&recording, &Detector::default()).unwrap();
        let request = JointRequest::new(vec![(&recording, &segmentation)], spec.gravity);
        fit_joint(&request).unwrap().data.sources[0].clock
    }

    fn tactical(seed: u64) -> Spec {
        Spec {
            grade: Grade::Tactical,
            ..Spec::hand_held(seed)
        }
    }

    #[test]
    fn stamps_that_scatter_about_an_even_clock_have_no_share() {
        let mut spec = tactical(1);
        spec.gyroscope.clock.jitter = 1.5e-3;
        let clock = clock_of(&spec);
        assert_eq!((clock.state, clock.share), (ClockState::Snapped, 0.0));
        assert!((clock.scatter / 1.5e-3 - 1.0).abs() < 0.03, "{clock:?}");
        assert_eq!((clock.gaps, clock.lost), (0, 0));
    }

    #[test]
    fn samples_taken_unevenly_keep_their_stamps() {
        let mut spec = tactical(2);
        spec.gyroscope.clock.sampling_jitter = 2e-4;
        let clock = clock_of(&spec);
        assert_eq!((clock.state, clock.share), (ClockState::Snapped, 1.0));
    }

    #[test]
    fn of_a_mixture_the_share_is_that_of_the_variances() {
        let mut spec = tactical(3);
        spec.gyroscope.clock.sampling_jitter = 1e-3;
        spec.gyroscope.clock.jitter = 1e-3;
        let clock = clock_of(&spec);
        let (share, std) = clock.fitted.unwrap();
        assert!((share - 0.5).abs() < 4.0 * std && std < 0.2, "{clock:?}");
    }

    #[test]
    fn a_share_that_may_be_a_mixture_leaves_its_times_uncertain() {
        // Nothing is missed where the data know the share.
        assert!(missed_by_snapping((1.0, 0.01), 1.0) < 1e-3);
        assert!(missed_by_snapping((0.0, 0.01), 0.0) < 1e-3);
        // Nothing known: 1/4 from the share on the other side, 1/2 · 1/2 from between.
        assert!((missed_by_snapping((0.5, 1e6), 1.0) - 0.5).abs() < 1e-6);
        // A quarter of the scatter is the stamps' own: a good part of that is expected.
        let missed = missed_by_snapping((0.75, 0.2), 1.0);
        assert!(missed > 0.1 && missed < 0.25, "{missed}");
        let mut spec = Spec::hand_held(0);
        spec.gyroscope.clock.sampling_jitter = 5e-4;
        spec.gyroscope.clock.resolution = 1e-3;
        let recording = spec.run().unwrap().recording;
        let segmentation = segment(&recording, &Detector::default()).unwrap();
        let request = JointRequest::new(vec![(&recording, &segmentation)], spec.gravity);
        let source = fit_joint(&request).unwrap().data.sources[0].clone();
        // Rounding leaves 1 ms/√12.
        let rounding = 1e-6 / 12.0;
        assert_eq!(source.clock.state, ClockState::Snapped);
        assert!(
            source.clock.timing > 0.2 * rounding && source.clock.timing < 2.0 * rounding,
            "{source:?}"
        );
    }

    #[test]
    fn exact_stamps_of_slow_turns_cost_no_fit() {
        let mut spec = tactical(4);
        if let simulate::Motion::HandHeld(motion) = &mut spec.motion {
            (motion.turn, motion.tremor) = ([6.0, 8.0], 0.0);
        }
        let clock = clock_of(&spec);
        assert_eq!((clock.state, clock.misfit), (ClockState::Exact, None));
        assert_eq!(clock.sampling.value, 0.0);
    }

    /// A scatter that is fitted beside one of the two makes its residuals small, and is no evidence for it.
    #[test]
    fn means_and_instants_are_told_apart_where_the_turns_tell_them() {
        let quick = [(25.0, [1.0, 2.5]), (100.0, [0.6, 1.0])];
        for (rate, turn) in quick {
            for (sampling, instants) in [(Sampling::Average, false), (Sampling::Point, true)] {
                for seed in 0..3 {
                    let mut spec = tactical(seed);
                    (spec.rate, spec.sampling) = (rate, sampling);
                    if let simulate::Motion::HandHeld(motion) = &mut spec.motion {
                        (motion.turn, motion.tremor, motion.shock) = (turn, 0.0, 0.0);
                    }
                    let clock = clock_of(&spec);
                    assert_eq!(
                        clock.instants, instants,
                        "{rate} Hz, {sampling:?}, {seed}: {clock:?}"
                    );
                }
            }
        }
    }

    #[test]
    fn knocks_seen_at_instants_miss_a_share_that_is_found() {
        let mut spec = Spec::hand_held(5);
        spec.sampling = Sampling::Point;
        if let simulate::Motion::HandHeld(motion) = &mut spec.motion {
            motion.knocks = 3;
        }
        let clock = clock_of(&spec);
        assert!(clock.sampling.value > 0.05, "{clock:?}");
        assert!(clock.sampling.over_none > 5.0, "{clock:?}");
        spec.sampling = Sampling::Average;
        let averaged = clock_of(&spec).sampling.value;
        assert!(averaged < 0.5 * clock.sampling.value, "{averaged}");
    }

    #[test]
    fn what_is_missing_is_evident_beside_however_little_noise() {
        // What knocks make of these turns is thousands of times the variance of the readings' noise.
        for seed in 0..4 {
            let mut spec = tactical(seed);
            spec.sampling = Sampling::Point;
            if let simulate::Motion::HandHeld(motion) = &mut spec.motion {
                motion.knocks = 3;
            }
            let sampling = clock_of(&spec).sampling;
            assert!(sampling.value > 0.05, "{seed}: {sampling:?}");
            let gained = [sampling.over_noise, sampling.over_noise_without_one];
            assert!(
                gained.iter().all(|l| l.is_finite() && *l > 2.0),
                "{seed}: {sampling:?}"
            );
        }
    }
}
