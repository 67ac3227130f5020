//! A recording on its way into the joint problem: rests trimmed and cut into chunks, turns from sample to sample between them.

use std::borrow::Cow;

use nalgebra::Vector3;
use recording::intervals::{Span, TurnFault};
use recording::readings::dead_zones;
use recording::{INSTANT, Stream};
use sensor::Kinematics;

use super::mean::Mean;
use super::{Chunk, Cut, Data, LostTurn, Rest, Source, TurnSamples};
use crate::methods::joint::clock::sampling::shocks;
use crate::methods::joint::clock::windows::means_over_windows;
use crate::methods::joint::clock::{SourceClock, TurnClock, clocks_behind, window};
use crate::methods::joint::disturbance::broken::{Beside, Pair, touched};
use crate::methods::joint::disturbance::shake::{gaps, shakes};
use crate::methods::joint::disturbance::trim::quiet_part;
use crate::methods::joint::noise::SensorNoise;
use crate::methods::joint::rows::knowledge::by_units;
use crate::methods::joint::rows::turn::MARGIN;
use crate::truth::RawUnit;

findings::tuning! {
    /// Rests are cut into chunks of about this length, s: they anchor random walk, drift and warm-up.
    CHUNK: f64 = 8.0;

    /// Rests shorter than this many chunks stay whole.
    WHOLE: f64 = 1.5;

    /// Chunks of a recording that suffice: of longer recordings they are longer.
    MOST_CHUNKS: f64 = 60.0;
}

impl Data {
    /// Adds a recording: its rests trimmed and cut into chunks, its turns from sample to sample
    /// between them, its noise.
    ///
    /// Every sample is in one chunk or in one turn, so that their white noise is independent.
    pub fn add(&mut self, cut: &Cut<'_>) {
        let place = self.sources.len();
        let force = near_si(cut.recording.accelerometer.as_ref(), &cut.force_unit);
        let rate = near_si(cut.recording.gyroscope.as_ref(), &cut.rate_unit);
        let (force, rate) = (force.as_deref(), rate.as_deref());
        let spans: Vec<Span> = cut
            .segmentation
            .statics
            .iter()
            .map(|rest| quiet_part(force.into_iter().chain(rate), rest.span))
            .collect();
        let total: f64 = spans.iter().map(Span::length).sum();
        let length = CHUNK.get().max(total / MOST_CHUNKS.get());
        let (truth, start) = (by_units(cut), cut.recording.start());
        let first = self.rests.len();
        for (interval, span) in spans.iter().enumerate() {
            let from = self.chunks.len();
            let celsius = cut.recording.temperature.as_ref();
            for part in parts(*span, length) {
                self.chunks.push(Chunk {
                    rest: self.rests.len(),
                    accelerometer: force.and_then(|s| mean_over(s, part)),
                    gyroscope: rate.and_then(|s| mean_over(s, part)),
                    temperature: celsius.and_then(|t| t.mean(part.from, part.to)),
                    thermal: truth.thermal(part.from, part.to),
                });
            }
            self.rests.push(Rest {
                recording: place,
                interval: cut.segmentation.before() + interval,
                heading: 0,
                span: *span,
                turned: truth.turned(interval),
                known: Kinematics {
                    time: 0.5 * (span.from + span.to) - start,
                    ..truth.at_rest(interval)
                },
                chunks: from..self.chunks.len(),
            });
        }
        let of = |stream: Option<&Stream>| {
            let stream = stream?;
            let chunks = spans.iter().flat_map(|span| parts(*span, length));
            let ranges: Vec<_> = chunks.map(|c| stream.between(c.from, c.to)).collect();
            Some((SensorNoise::measure(stream, &ranges)?, ranges))
        };
        let of_force = of(force).map(|(noise, _)| noise);
        let with_ranges = of(rate);
        let quiet_rate = with_ranges.as_ref().map(|(noise, _)| *noise);
        // Zeros are what the sensor reads: near SI units its bias may be taken off.
        let raw = cut.recording.gyroscope.as_ref();
        let of_rate = raw.zip(with_ranges).map(|(raw, (noise, ranges))| {
            noise.with_dead_zones(dead_zones(raw, &ranges), cut.rate_unit.scale.abs())
        });
        if let (Some(f), Some(nf), Some(r), Some(nr)) = (force, &of_force, rate, &quiet_rate) {
            let pair = Pair {
                force: (f, nf),
                rate: (r, nr),
            };
            self.look_for_touches(cut, &pair, &spans, first);
        }
        let streams = [(force, &of_force), (rate, &of_rate)];
        let known = streams.into_iter().filter_map(|(s, n)| s.zip(n.as_ref()));
        self.look_for_shakes(known, first);
        // Frozen rows are left out and named: what is missing there is no gap.
        let is_frozen = |gap: &Span| {
            let mut frozen = cut.recording.frozen.iter();
            frozen.any(|own| own.is_between(gap.from, gap.to))
        };
        self.gaps
            .retain(|(rest, gap)| *rest < first || !is_frozen(gap));
        let clock = match rate {
            Some(rate) => self.add_turns(cut, rate, of_rate.as_ref(), &spans, first),
            None => SourceClock::default(),
        };
        self.number_headings(first);
        self.sources.push(Source {
            name: cut.segmentation.name_in(&cut.recording.name),
            accelerometer: of_force,
            gyroscope: of_rate,
            has_thermometer: cut.recording.temperature.is_some(),
            reference: middle_edge(&spans),
            clock,
            noise_shares: [1.0; 2],
        });
    }

    /// Numbers the stretches through which the heading can be followed in a recording whose rests begin at `first`.
    fn number_headings(&mut self, first: usize) {
        let mut followed = self.turns.iter().map(|turn| turn.from).peekable();
        let before = first.checked_sub(1).map(|k| self.rests[k].heading + 1);
        let mut heading = before.unwrap_or(0);
        for k in first..self.rests.len() {
            while followed.next_if(|from| from + 1 < k).is_some() {}
            if k > first && followed.next_if_eq(&(k - 1)).is_none() {
                heading += 1;
            }
            self.rests[k].heading = heading;
        }
    }

    /// Touches that broke a rest in two or off its end.
    fn look_for_touches(&mut self, cut: &Cut<'_>, pair: &Pair<'_>, spans: &[Span], first: usize) {
        let is_frozen = |k: usize| {
            let turn = cut.segmentation.turns.get(k);
            turn.is_some_and(|turn| matches!(turn.fault, Some(TurnFault::Frozen(_))))
        };
        for (k, ends) in spans.windows(2).enumerate() {
            if is_frozen(k) {
                continue;
            }
            let chunks = self.rests[first + k].chunks.clone();
            let after = self.rests[first + k + 1].chunks.start;
            let force = |chunk: &Chunk| Some(chunk.accelerometer?.value);
            let (Some(chunk), Some(next)) = (self.chunks[chunks].last(), self.chunks.get(after))
            else {
                continue;
            };
            let (Some(rate), Some(one), Some(other)) = (chunk.gyroscope, force(chunk), force(next))
            else {
                continue;
            };
            let turn = Span {
                from: ends[0].to,
                to: ends[1].from,
            };
            let beside = Beside {
                bias: rate.value,
                forces: [one, other],
                variances: self.restless(first + k),
            };
            if let Some(span) = touched(pair, turn, &beside) {
                let interval = cut.segmentation.before() + k;
                self.broken.push((self.sources.len(), interval, span));
            }
        }
    }

    /// The larger variances of the accelerometer and the gyroscope in a rest and the next.
    fn restless(&self, rest: usize) -> [Vector3<f64>; 2] {
        let chunks = self.rests[rest].chunks.start..self.rests[rest + 1].chunks.end;
        let larger = |mean: fn(&Chunk) -> Option<Mean>| {
            let own = self.chunks[chunks.clone()].iter().filter_map(mean);
            own.fold(Vector3::zeros(), |most: Vector3<f64>, m| {
                most.sup(&m.variance)
            })
        };
        [larger(|c| c.accelerometer), larger(|c| c.gyroscope)]
    }

    /// Chunks that shake and rests with gaps, in either sensor, among the rests from `first` on.
    fn look_for_shakes<'a>(
        &mut self,
        streams: impl Iterator<Item = (&'a Stream, &'a SensorNoise)>,
        first: usize,
    ) {
        let from = self
            .rests
            .get(first)
            .map_or(self.chunks.len(), |r| r.chunks.start);
        let stretches: Vec<Span> = self.rests[first..]
            .iter()
            .flat_map(|rest| {
                let count = rest.chunks.len() as f64;
                let edge = move |k: usize| rest.span.from + rest.span.length() * k as f64 / count;
                (0..rest.chunks.len()).map(move |k| Span {
                    from: edge(k),
                    to: edge(k + 1),
                })
            })
            .collect();
        for (stream, noise) in streams {
            for shake in shakes(stream, &stretches, &noise.step) {
                let chunk = from + shake.stretch;
                if self.shaken.iter().all(|(known, _)| *known != chunk) {
                    self.shaken.push((chunk, shake));
                }
            }
            let rests: Vec<Span> = self.rests[first..].iter().map(|r| r.span).collect();
            for (k, found) in gaps(stream, &rests).into_iter().enumerate() {
                for gap in found {
                    if self.gaps.iter().all(|(known, _)| *known != first + k) {
                        self.gaps.push((first + k, gap));
                    }
                }
            }
        }
        self.shaken.sort_by_key(|(chunk, _)| *chunk);
    }

    fn add_turns(
        &mut self,
        cut: &Cut<'_>,
        rate: &Stream,
        noise: Option<&SensorNoise>,
        spans: &[Span],
        first: usize,
    ) -> SourceClock {
        let recording = self.sources.len();
        let (clock, behind) = clocks_behind(rate, cut.clock);
        for turn in &cut.segmentation.turns {
            let span = Span {
                from: spans[turn.from].to,
                to: spans[turn.from + 1].from,
            };
            let inner = rate.between(span.from, span.to);
            let fits = inner.start >= MARGIN && inner.end + MARGIN < rate.len();
            let fault = turn
                .fault
                .clone()
                .or((!fits || inner.len() < 2).then_some(TurnFault::Empty));
            if let Some(fault) = fault {
                self.lost.push(LostTurn {
                    recording,
                    turn: cut.segmentation.before() + turn.from,
                    span,
                    fault,
                });
                continue;
            }
            let range = inner.start - MARGIN..inner.end + MARGIN;
            let own = &rate.values[range.clone()];
            let of = |even: &Vec<f64>| TurnClock::of(&rate.t, even, range.clone());
            self.turns.push(TurnSamples {
                recording,
                turn: cut.segmentation.before() + turn.from,
                from: first + turn.from,
                span,
                t: rate.t[range.clone()].to_vec(),
                lengths: range.clone().map(|k| window(&rate.t, k)).collect(),
                samples: own.to_vec(),
                readings: means_over_windows(&rate.t[range.clone()], own),
                known: Vec::new(),
                clocks: behind.iter().map(of).collect(),
                shocks: noise.map_or(Vec::new(), |noise| shocks(own, &noise.white)),
            });
        }
        clock
    }
}

/// A stream near SI units: as it is, without a copy, where it is in them.
fn near_si<'a>(stream: Option<&'a Stream>, unit: &RawUnit) -> Option<Cow<'a, Stream>> {
    let stream = stream?;
    if unit.is_si() && unit.zero == Vector3::zeros() {
        return Some(Cow::Borrowed(stream));
    }
    Some(Cow::Owned(Stream {
        t: stream.t.clone(),
        values: stream.values.iter().map(|v| unit.to_si(v)).collect(),
    }))
}

/// The span in equal parts of about `length`; none of an empty one.
fn parts(span: Span, length: f64) -> Vec<Span> {
    if span.length() <= 0.0 {
        return Vec::new();
    }
    let count = if !span.lasts(WHOLE.get() * length) {
        1
    } else {
        ((span.length() + INSTANT.get()) / length).round() as usize
    };
    let edge = |k: usize| span.from + span.length() * k as f64 / count as f64;
    (0..count)
        .map(|k| Span {
            from: edge(k),
            to: if k + 1 == count { span.to } else { edge(k + 1) },
        })
        .collect()
}

fn mean_over(stream: &Stream, part: Span) -> Option<Mean> {
    let range = stream.between(part.from, part.to);
    let count = range.len();
    if count < 2 {
        return None;
    }
    let (t, values) = (&stream.t[range.clone()], &stream.values[range.clone()]);
    let mean_time = t.iter().sum::<f64>() / count as f64;
    let value = values.iter().sum::<Vector3<f64>>() / count as f64;
    let (mut spread, mut moment, mut square) = (0.0, Vector3::zeros(), Vector3::zeros());
    for (t, v) in t.iter().zip(values) {
        spread += (t - mean_time).powi(2);
        moment += (v - value) * (t - mean_time);
        square += (v - value).map(|d: f64| d * d);
    }
    Some(Mean {
        span: Span {
            from: t[0] - 0.5 * window(&stream.t, range.start),
            to: t[count - 1] + 0.5 * window(&stream.t, range.end - 1),
        },
        count,
        value,
        variance: square / (count - 1) as f64,
        slope: moment / spread,
        spread,
    })
}

/// The end of a rest that lies nearest the middle of all.
fn middle_edge(spans: &[Span]) -> f64 {
    let (Some(first), Some(last)) = (spans.first(), spans.last()) else {
        return 0.0;
    };
    let middle = 0.5 * (first.from + last.to);
    spans
        .iter()
        .map(|s| s.to)
        .min_by(|a, b| (a - middle).abs().total_cmp(&(b - middle).abs()))
        .unwrap_or(middle)
}
