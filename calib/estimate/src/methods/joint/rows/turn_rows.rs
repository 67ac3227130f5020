//! The two rows of a turn and their derivatives.

use nalgebra::{Matrix2x3, Matrix3, Vector2, Vector3};
use sensor::{BASE_PARAMETERS, Base, PLACES, Sensor, inverse};

use super::slopes::ModelSlopes;
use super::turn::{Carried, carry, rotation};
use crate::methods::joint::blocks::columns::Part;
use crate::methods::joint::clock::coning::Coning;
use crate::methods::joint::data::TurnSamples;
use crate::methods::joint::rows::Rows;

/// The derivatives of the effects at the samples of a turn.
pub(super) struct TurnSlopes {
    /// `(I + ∂e/∂ω)⁻¹` (3 × 3) of every sample; `None` where no effect depends on the rate.
    through: Option<Vec<Matrix3<f64>>>,
    /// `∂e/∂p` by the parameters of the effects, sample by sample.
    by_parameters: Vec<Vector3<f64>>,
    /// Number of parameters.
    count: usize,
}

impl TurnSlopes {
    /// `∂δ/∂(T (W − b))` of sample `k`, `gain` being that by the corrected rate.
    pub fn through(&self, k: usize, gain: &Matrix3<f64>) -> Matrix3<f64> {
        let through = self.through.as_ref();
        through.map_or(*gain, |all| gain * all[k])
    }

    /// `∂e/∂p` at sample `k`.
    pub fn by_parameters(&self, k: usize) -> &[Vector3<f64>] {
        &self.by_parameters[k * self.count..(k + 1) * self.count]
    }
}

impl Rows<'_> {
    /// `r = Eᵀ (Rᵀ u_k − u_{k+1})`: the direction before a turn carried through it by the corrected rate,
    /// less the one after, along the two unit vectors `E` across the latter.
    ///
    /// Both directions are parameters, so that consecutive turns share no noise: given the
    /// directions, the rows of a turn see the samples of that turn only.
    pub(super) fn turn_rows(
        &self,
        x: &[f64],
        turn: &TurnSamples,
        (row, part): (usize, &mut Part),
    ) -> Vector2<f64> {
        let columns = self.columns_at(Sensor::Gyroscope, turn.from);
        let p: Vec<f64> = columns.iter().map(|&c| x[c]).collect();
        let rates = self.rates(turn, &p);
        let carried = self.carried(turn, &rates);
        let slopes = self.turn_slopes(turn, &rates, &p);
        let across = self.charts[turn.from + 1].across.transpose();
        let before = self.direction(x, turn.from);
        let predicted = carried.rotation * before;
        let residual = across * (predicted - self.direction(x, turn.from + 1));
        // ∂(Rᵀ u) = (Rᵀ u) × δ
        let by_rotation = across * predicted.cross_matrix();
        let [from, to] = [turn.from, turn.from + 1].map(|rest| self.layout.direction(rest));
        let places = part.places(&columns);
        let [at_from, at_to] = [from, to].map(|first| part.places(&[first, first + 1]));
        let mut set = |column: usize, value: Vector2<f64>| {
            for i in 0..2 {
                part.values[(row + i, column)] = value[i];
            }
        };
        for (rotation, column) in self
            .by_parameters(turn, &carried, &slopes, &p)
            .iter()
            .zip(&places)
        {
            set(*column, by_rotation * rotation);
        }
        let slope_before = self.charts[turn.from].slope(&x[from..from + 2]);
        let slope_after = self.charts[turn.from + 1].slope(&x[to..to + 2]);
        for j in 0..2 {
            let moved = carried.rotation * slope_before.column(j);
            set(at_from[j], across * moved);
            set(at_to[j], -(across * slope_after.column(j)));
        }
        residual
    }

    /// Returns the coning terms for the samples of a turn: means over windows, or values at instants.
    pub(crate) fn coning(&self, turn: &TurnSamples) -> &Coning {
        let instants = self.data.sources[turn.recording].clock.instants;
        &self.conings[usize::from(instants)]
    }

    /// Change of the two rows of a turn at `x` where its samples are values at instants and not means over windows.
    pub(crate) fn by_instants(&self, x: &[f64], turn: &TurnSamples) -> Vector2<f64> {
        let p = self.local(x, Sensor::Gyroscope, turn.from);
        let rates = self.rates(turn, &p);
        let under = |coning: &Coning| rotation(coning, &rates, &turn.lengths);
        let [means, instants] = self.conings.each_ref().map(under);
        let moved = (instants - means) * self.direction(x, turn.from);
        self.charts[turn.from + 1].across.transpose() * moved
    }

    /// `∂r/∂λ` of the two rows of a turn by the share of the scatter that its clock has: a window's angle grows by
    /// `ω_k` times what the scatter adds to its length.
    pub(crate) fn by_clock(&self, x: &[f64], turn: &TurnSamples) -> Vector2<f64> {
        let base = self.data.sources[turn.recording].clock.base;
        let Some(clock) = turn.clocks.get(base) else {
            return Vector2::zeros();
        };
        let p = self.local(x, Sensor::Gyroscope, turn.from);
        let rates = self.rates(turn, &p);
        let carried = self.carried(turn, &rates);
        let windows = clock.slack.iter().zip(&turn.lengths);
        let moved: Vector3<f64> = windows
            .zip(carried.gains.iter().zip(&rates))
            .map(|((slack, length), (gain, rate))| gain * rate * (slack / length))
            .sum();
        self.by_rotation(x, turn, &carried.rotation) * moved
    }

    /// `∂r/∂δ = Eᵀ [Rᵀ u_k]×` of the two rows of a turn by a small rotation `δ` at its end, where `Rᵀ` carries the direction
    /// before it.
    pub(crate) fn by_rotation(
        &self,
        x: &[f64],
        turn: &TurnSamples,
        rotation: &Matrix3<f64>,
    ) -> Matrix2x3<f64> {
        let predicted = rotation * self.direction(x, turn.from);
        self.charts[turn.from + 1].across.transpose() * predicted.cross_matrix()
    }

    /// The rotation over a turn of these corrected rates, with its derivatives by them.
    pub(crate) fn carried(&self, turn: &TurnSamples, rates: &[Vector3<f64>]) -> Carried {
        carry(self.coning(turn), rates, &turn.lengths)
    }

    /// `∂δ/∂p` (3) of the rotation at the end of a turn by every parameter of the gyroscope's model.
    fn by_parameters(
        &self,
        turn: &TurnSamples,
        carried: &Carried,
        slopes: &TurnSlopes,
        p: &[f64],
    ) -> Vec<Vector3<f64>> {
        let base = Base::from_parameters(p);
        let mut by_element = [Vector3::zeros(); 9];
        let mut by_signal = Matrix3::zeros();
        let mut by_effects = vec![Vector3::zeros(); p.len() - BASE_PARAMETERS];
        for (k, gain) in carried.gains.iter().enumerate() {
            let through = slopes.through(k, gain);
            let unbiased = turn.readings[k] - base.bias;
            for (sum, (a, b)) in by_element.iter_mut().zip(PLACES) {
                *sum += through.column(a) * unbiased[b];
            }
            by_signal += through;
            for (sum, slope) in by_effects.iter_mut().zip(slopes.by_parameters(k)) {
                *sum -= through * slope;
            }
        }
        let by_bias = -(by_signal * base.t);
        by_element
            .into_iter()
            .chain((0..3).map(|axis| by_bias.column(axis).into_owned()))
            .chain(by_effects)
            .collect()
    }

    /// Computes the derivatives of the effects at the corrected rates of a turn, rad/s.
    pub(super) fn turn_slopes(
        &self,
        turn: &TurnSamples,
        rates: &[Vector3<f64>],
        p: &[f64],
    ) -> TurnSlopes {
        let count = p.len() - BASE_PARAMETERS;
        let model = ModelSlopes::new(self.gyroscope, p, Sensor::Gyroscope);
        let mut slopes = TurnSlopes {
            through: (!model.is_apart_from_signal()).then(|| Vec::with_capacity(rates.len())),
            by_parameters: Vec::with_capacity(count * rates.len()),
            count,
        };
        if self.gyroscope.effects().is_empty() {
            return slopes;
        }
        for (rate, known) in rates.iter().zip(&turn.known) {
            let truth = known.with_signal(Sensor::Gyroscope, *rate);
            let effects = model.at(&truth, &mut slopes.by_parameters);
            if let Some(through) = &mut slopes.through {
                let own = inverse(&(Matrix3::identity() + effects.by_signal));
                through.push(own.unwrap_or_else(Matrix3::identity));
            }
        }
        slopes
    }
}
