//! Misfit of the data from the model, before any error is enlarged.

use faer::Mat;
use recording::averages::root_mean_square;
use sensor::Sensor;

use crate::methods::chance;
use crate::methods::joint::blocks::arrow::Arrow;
use crate::methods::joint::blocks::columns::Columns;
use crate::methods::joint::data::TurnSamples;
use crate::methods::joint::faults::Scope;
use crate::methods::joint::fit::JointFit;
use crate::methods::joint::noise::weights::{ComponentKind, NoiseLevel, Whitening};
use crate::methods::joint::orientation::Shown;
use crate::methods::joint::result::channel::Channel;

findings::tuning! {
    /// Added to the unit diagonal of normal equations.
    HELD_UP: f64 = 1e-11;
}

/// Misfit of one kind of rows, against the noise that was measured within the static intervals and the walks of the
/// biases.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ChannelMisfit {
    /// Kind of the rows.
    pub channel: Channel,
    /// Root mean square of what is left: m/s² of the norm, rad/s of the rate, rad of the direction.
    pub rms: f64,
    /// Root mean square expected by the noise, in the same unit.
    pub noise: f64,
    /// `χ²` against the noise.
    pub chi2: f64,
    /// Its degrees of freedom.
    pub dof: f64,
    /// Probability of so much by noise alone.
    pub p_value: f64,
    /// Pattern by which the residuals depend on the orientation, where they do.
    pub pattern: Option<Shown>,
}

impl ChannelMisfit {
    /// Returns the ratio of the residuals to the noise: `√(χ²/dof)`.
    pub fn ratio(&self) -> f64 {
        (self.chi2 / self.dof).sqrt()
    }
}

impl JointFit {
    /// Returns the misfits of the norm of specific force, of the rate at the static intervals and of the direction
    /// through turns, each where it has degrees of freedom.
    ///
    /// Rows are in the order force, rate, turns, and whitening mixes a row with those before it only. The residual sums
    /// of squares of the first rows, of the first two kinds and of all rows therefore differ by independent sums of
    /// squares.
    pub fn misfits(&self) -> Vec<ChannelMisfit> {
        let of = |(channel, chi2, dof): (Channel, f64, f64)| {
            let rms = match channel {
                Channel::Force => self.norm_rms(),
                Channel::Rate => self.rate_rms(),
                Channel::Direction => self.direction_rms(),
            };
            ChannelMisfit {
                channel,
                rms,
                noise: if chi2 > 0.0 {
                    rms / (chi2 / dof).sqrt()
                } else {
                    rms
                },
                chi2,
                dof,
                p_value: chance::of_chi2(chi2, dof),
                pattern: self.pattern_of(channel),
            }
        };
        let squares = self.squares_under(&self.noise_whitening());
        squares.into_iter().map(of).collect()
    }

    /// Probability of what a sensor's readings at rest leave by the noise within the static intervals alone, without any walk.
    pub fn chance_without_walks(&self, sensor: Sensor) -> f64 {
        let wanted = match sensor {
            Sensor::Accelerometer => Channel::Force,
            Sensor::Gyroscope | Sensor::Magnetometer => Channel::Rate,
        };
        let whitening = self.whitening_by(|kind| kind.known_variance().is_some());
        let squares = self.squares_under(&whitening);
        let own = squares.iter().find(|(channel, ..)| *channel == wanted);
        own.map_or(1.0, |(_, chi2, dof)| chance::of_chi2(*chi2, *dof))
    }

    /// `χ²` and degrees of freedom of each channel that has any.
    fn squares_under(&self, whitening: &Whitening) -> Vec<(Channel, f64, f64)> {
        let m = self.white_residuals.len();
        let jacobian = whitening.finish_columns(self.white_jacobian.clone());
        let residuals = whitening.finish_column(&self.white_residuals);
        let [rate, turns] = self.first_rows;
        let channels = [
            (Channel::Force, rate),
            (Channel::Rate, turns),
            (Channel::Direction, m),
        ];
        let mut before = (0.0, 0.0);
        let mut squares = Vec::new();
        for (channel, end) in channels {
            let (square, spare) = left(&jacobian.first_rows(end), &residuals[..end]);
            let (chi2, dof) = ((square - before.0).max(0.0), spare - before.1);
            before = (square, spare);
            if dof >= 0.5 {
                squares.push((channel, chi2, dof));
            }
        }
        squares
    }

    /// Whitening by what was measured within the static intervals, and walks of the biases.
    pub(crate) fn noise_whitening(&self) -> Whitening {
        self.whitening_by(ComponentKind::is_noise)
    }

    /// The same where the turns scatter as they do beside that noise.
    pub(crate) fn noise_whitening_with_scatter(&self) -> Whitening {
        self.whitening_by(|kind| kind.is_noise() || kind == ComponentKind::TurnScatter)
    }

    fn whitening_by(&self, is_taken: impl Fn(ComponentKind) -> bool) -> Whitening {
        let levels = self.levels.iter().copied();
        let taken: Vec<NoiseLevel> = levels.filter(|level| is_taken(level.kind)).collect();
        Whitening::new(self.whitening.white.clone(), &self.components, &taken)
    }

    /// Root mean square of `‖f‖ − g` over the static intervals that nothing disturbed, each weighted by what its noise
    /// lets it know, m/s².
    pub fn norm_rms(&self) -> f64 {
        let disturbed = |place: usize| {
            self.flagged.iter().any(|flagged| {
                let rest = &self.data.rests[place];
                flagged.fault.opens_force
                    && (flagged.recording, flagged.interval) == (rest.recording, rest.interval)
            })
        };
        let sound = (0..self.data.rests.len()).filter(|place| !disturbed(*place));
        rms(sound.filter_map(|place| Some((*self.norms.get(place)?, self.norm_noise(place)))))
    }

    /// Root mean square of the rate at the static intervals less the bias, rad/s.
    pub fn rate_rms(&self) -> f64 {
        rms(self.static_rates())
    }

    /// Root mean square of the angle by which turns miss gravity, weighted in the same way, rad.
    pub fn direction_rms(&self) -> f64 {
        let first = self.first_rows[1];
        let white = &self.whitening.white;
        let noise = |turn: usize| {
            white
                .std(first + 2 * turn)
                .hypot(white.std(first + 2 * turn + 1))
        };
        let turns = self.sound_turns().into_iter();
        rms(turns.map(|turn| (self.chords[turn], noise(turn))))
    }

    /// Root mean square of the angle by which sound turns miss gravity, each as much as the others, rad.
    pub fn missed(&self) -> f64 {
        let turns = self.sound_turns().into_iter();
        root_mean_square(&turns.map(|turn| self.chords[turn]).collect::<Vec<_>>())
    }

    /// The turns that no fault opens, by their place; all of them where a third and more would go: then the reason is another.
    pub fn sound_turns(&self) -> Vec<usize> {
        let is_open = |turn: &TurnSamples| {
            let mut faults = self.flagged.iter();
            faults.any(|own| {
                let place = (own.recording, own.interval) == (turn.recording, turn.turn);
                own.fault.scope == Scope::Turn && place
            })
        };
        let turns = &self.data.turns;
        let sound: Vec<usize> = (0..turns.len()).filter(|&k| !is_open(&turns[k])).collect();
        match 3 * sound.len() > 2 * turns.len() {
            true => sound,
            false => (0..turns.len()).collect(),
        }
    }

    /// Standard deviation of the mean of the accelerometer in a rest, averaged over the axes, m/s².
    fn norm_noise(&self, rest: usize) -> f64 {
        let own = &self.data.rests[rest];
        let Some(noise) = &self.data.sources[own.recording].accelerometer else {
            return 1.0;
        };
        let chunks = &self.data.chunks[own.chunks.clone()];
        let means = chunks.iter().filter_map(|chunk| chunk.accelerometer);
        let information: f64 = means.map(|m| 3.0 / noise.variance_of(&m).sum()).sum();
        information.max(f64::MIN_POSITIVE).sqrt().recip()
    }

    /// `χ²` per degree of freedom of one kind of rows, against the noise that was measured.
    pub fn reduced_chi2(&self, channel: Channel) -> Option<f64> {
        let own = self.misfits().into_iter().find(|m| m.channel == channel);
        own.map(|m| m.chi2 / m.dof)
    }

    fn pattern_of(&self, channel: Channel) -> Option<Shown> {
        let sensor = match channel {
            Channel::Force => Sensor::Accelerometer,
            Channel::Rate => Sensor::Gyroscope,
            Channel::Direction => return None,
        };
        let own = self.shown.iter().find(|(of, _)| *of == sensor);
        own.map(|(_, shown)| *shown)
    }

    /// Rate less bias of every chunk of a rest, and its noise, rad/s.
    fn static_rates(&self) -> impl Iterator<Item = (f64, f64)> {
        let mut residuals = Mat::from_fn(self.white_residuals.len(), 1, |i, _| {
            self.white_residuals[i]
        });
        self.whitening.white.restore(residuals.as_mut());
        let [rate, turns] = self.first_rows;
        (rate..turns).map(move |i| (residuals[(i, 0)], self.whitening.white.std(i)))
    }
}

/// Root mean square of values with standard deviations, weighted by these; 0 of none.
fn rms(values: impl Iterator<Item = (f64, f64)>) -> f64 {
    let (square, weight) = values.fold((0.0, 0.0), |(square, weight), (value, sigma)| {
        let own = sigma.powi(-2);
        (square + own * value * value, weight + own)
    });
    if weight > 0.0 {
        (square / weight).sqrt()
    } else {
        0.0
    }
}

/// The sum of squares that columns leave of a residual, and the degrees of freedom: by normal equations with unit columns,
/// held up a little where columns depend on each other.
fn left(columns: &Columns, r: &[f64]) -> (f64, f64) {
    let norms = columns.norms();
    let used: Vec<usize> = (0..norms.len()).filter(|&k| norms[k] > 0.0).collect();
    let mut unit = columns.select(&used);
    unit.divide(&used.iter().map(|&k| norms[k]).collect::<Vec<_>>());
    let square: f64 = r.iter().map(|v| v * v).sum();
    let Some(factor) = Arrow::gram(&unit).factor(HELD_UP.get()) else {
        return (square, r.len() as f64);
    };
    let (own, shared) = factor.forward(&unit.transposed_times(r));
    let taken = own.iter().map(|own| own.squared_norm_l2()).sum::<f64>();
    let undetermined = HELD_UP.get() * factor.trace_of_inverse();
    let rank = used.len() as f64 - undetermined;
    (
        square - taken - shared.squared_norm_l2(),
        r.len() as f64 - rank,
    )
}
