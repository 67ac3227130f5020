//! Families of hypotheses about terms that the model of a recording may lack.

use std::f64::consts::LN_2;

use estimate::methods::joint::{
    Column, Columns, FAULTS, FaultRef, Known, effect_columns, step_columns,
};
use faer::Mat;
use sensor::{EffectRef, Nature, Param, Role, Sensor};

use super::remainder::shape::Shape;
use super::state::{Extension, State, with_companions};

/// Time constants tried for an effect that settles, s. Between neighbours the shapes correlate by more than
/// 0.98 over a session of minutes.
const TIME_CONSTANTS: [f64; 6] = [20.0, 40.0, 70.0, 120.0, 200.0, 350.0];

/// Returns the number of parameters of an effect that depend on the heading; they come before the others.
pub fn references(effect: &EffectRef) -> usize {
    let params = effect.params().iter();
    params.filter(|p| p.role == Role::Reference).count()
}

/// Returns true if the effect is a time offset of the stamps, which shows in the accelerometer during motion.
pub fn is_late(effect: &EffectRef) -> bool {
    effect.nature() == Nature::Delay && effect.sensor() == Sensor::Accelerometer
}

/// Claim of a family: an effect, a disturbance or an unexplained shape.
#[derive(Clone, Debug)]
pub enum Claim {
    /// The sensor has an effect of the catalogue.
    Effect(EffectRef),
    /// The recording was disturbed.
    Disturbed(FaultRef),
    /// Something is left that no effect of the catalogue explains, of this shape.
    Shape(Shape, Sensor),
}

impl Claim {
    /// The effect that it claims, if it claims one.
    pub fn effect(&self) -> Option<&EffectRef> {
        match self {
            Self::Effect(effect) => Some(effect),
            Self::Disturbed(_) | Self::Shape(..) => None,
        }
    }

    /// The name in findings.
    pub fn name(&self) -> &str {
        match self {
            Self::Effect(effect) => effect.name(),
            Self::Disturbed(fault) => fault.name,
            Self::Shape(shape, _) => shape.kind().name(),
        }
    }

    /// Returns true if both make the same claim.
    pub fn is_same(&self, other: &Self) -> bool {
        match (self, other) {
            (Self::Effect(one), Self::Effect(two)) => one.name() == two.name(),
            (Self::Disturbed(one), Self::Disturbed(two)) => one == two,
            (Self::Shape(one, a), Self::Shape(two, b)) => one == two && a == b,
            _ => false,
        }
    }

    /// The disturbance of a model that it is, where it claims one.
    pub fn known(&self, hypothesis: &Hypothesis) -> Option<Known> {
        match self {
            Self::Disturbed(fault) => Some(Known::disturbed(fault, hypothesis.place?)),
            Self::Effect(_) | Self::Shape(..) => None,
        }
    }

    /// Returns true if a model has it; a shape that no effect has is in none.
    pub fn is_in(&self, model: &Extension, hypothesis: &Hypothesis) -> bool {
        let known = self.known(hypothesis);
        let is_own = |other: &Known| known.is_some_and(|known| known.is_at(other));
        self.effect().is_some_and(|own| model.has(own.name())) || model.disturbed.iter().any(is_own)
    }

    /// Takes it into a model, with the companions of the `catalogue` that come with it.
    pub fn put_in(&self, model: &mut Extension, hypothesis: &Hypothesis, catalogue: &[EffectRef]) {
        if let Some(effect) = self.effect() {
            model.hold(effect.clone(), hypothesis.shape, catalogue);
        }
        model.disturbed.extend(self.known(hypothesis));
    }

    /// Takes it out of a model.
    pub fn take_out_of(&self, model: &mut Extension, hypothesis: &Hypothesis) {
        if let Some(effect) = self.effect() {
            model.remove(effect.name());
        }
        if let Some(known) = self.known(hypothesis) {
            model.disturbed.retain(|other| !known.is_at(other));
        }
    }

    /// The evidence that it needs where an effect needs `threshold`: a fault of the recording may be claimed by chance half as often.
    pub fn needed(&self, threshold: f64) -> f64 {
        let is_fault = matches!(self, Self::Disturbed(_));
        threshold + if is_fault { LN_2 } else { 0.0 }
    }

    /// The sensor whose bias walk can be taken for it.
    pub fn sensor(&self) -> Sensor {
        match self {
            Self::Effect(effect) => effect.sensor(),
            Self::Disturbed(fault) => fault.sensor,
            Self::Shape(_, sensor) => *sensor,
        }
    }
}

/// One way in which a claim can hold: an instant, a time constant, an interval.
#[derive(Clone, Debug)]
pub struct Hypothesis {
    /// A parameter that shapes the effect, by its place, with its value: `tau` or `t0`.
    pub shape: Option<(usize, f64)>,
    /// The rest, chunk or turn of a disturbance.
    pub place: Option<usize>,
    /// Its columns among those of the family.
    pub columns: std::ops::Range<usize>,
}

/// All hypotheses of one claim.
#[derive(Clone, Debug)]
pub struct Family {
    /// Claim that all its hypotheses share.
    pub claim: Claim,
    /// The ways.
    pub hypotheses: Vec<Hypothesis>,
    /// `∂r/∂c · typical` (`m × …`), white-whitened: columns of all hypotheses side by side.
    pub columns: Columns,
    /// The size that a column stands for.
    pub typical: f64,
    /// Degrees of freedom that the choice of a shape spends.
    pub shape_dof: f64,
    /// `ln` of the number of places that it could be at.
    pub log_places: f64,
}

impl Family {
    /// The columns of one of its hypotheses.
    pub fn columns_of(&self, hypothesis: usize) -> Mat<f64> {
        let own: Vec<usize> = self.hypotheses[hypothesis].columns.clone().collect();
        self.columns.select(&own).to_dense()
    }
}

/// Places of an effect's coefficients, which are nothing in a perfect sensor, and of the parameter that
/// shapes it, where there is one.
pub fn coefficients(effect: &EffectRef) -> (Vec<usize>, Option<usize>) {
    let params = effect.params();
    let shape = params.iter().position(is_shape);
    let reference = effect.reference();
    let linear = (0..params.len())
        .filter(|k| Some(*k) != shape && reference.is_none_or(|name| params[*k].name != name))
        .collect();
    (linear, shape)
}

/// Returns true if the error is not linear in this parameter, so that it is tried at some values.
fn is_shape(p: &Param) -> bool {
    matches!(p.role, Role::Shape | Role::TimeConstant | Role::Instant)
}

/// The values at which a parameter that shapes an effect is tried.
pub fn tried(p: &Param) -> &[f64] {
    match p.tried {
        [] => &TIME_CONSTANTS,
        own => own,
    }
}

/// Everything that the model of `state` lacks and its recordings could show.
pub fn families(state: &State, catalogue: &[EffectRef]) -> Vec<Family> {
    let mut all: Vec<Family> = catalogue
        .iter()
        .filter(|effect| may_be_missing(state, effect))
        .map(|effect| effect_family(state, effect, catalogue))
        .collect();
    all.extend(disturbance_families(state));
    all
}

/// Returns true if the effect's sensor was recorded and the model does not have the effect yet.
pub(super) fn may_be_missing(state: &State, effect: &EffectRef) -> bool {
    let is_recorded = effect.sensor() == Sensor::Accelerometer || state.fit.has_gyroscope();
    is_recorded && !state.has(effect.name())
}

/// The family of one effect; `catalogue` has its companions.
pub(super) fn effect_family(state: &State, effect: &EffectRef, catalogue: &[EffectRef]) -> Family {
    let (linear, shape) = coefficients(effect);
    let nominal: Vec<f64> = effect.params().iter().map(|p| p.nominal).collect();
    let values: Vec<Option<f64>> = match shape {
        Some(k) if effect.params()[k].role == Role::Instant => {
            state.boundaries().into_iter().map(Some).collect()
        }
        Some(k) => tried(&effect.params()[k])
            .iter()
            .copied()
            .map(Some)
            .collect(),
        None => vec![None],
    };
    let role = shape.map(|k| effect.params()[k].role);
    let is_instant = role == Some(Role::Instant);
    let mut parts = if is_instant {
        vec![steps(state, effect, &linear, &values)]
    } else {
        Vec::new()
    };
    let mut hypotheses = Vec::new();
    let mut first = 0;
    for value in &values {
        let shape = shape.zip(*value);
        let mut count = linear.len();
        if !is_instant {
            let mut p = nominal.clone();
            if let Some((k, value)) = shape {
                p[k] = value;
            }
            let mut own = scaled(state, effect, &p, &linear);
            let of_heading = references(effect);
            if of_heading > 0 {
                own = by_heading(state, own, of_heading);
                count = own.ncols();
            }
            parts.push(own);
            let companions = with_companions(effect, catalogue).skip(1);
            for companion in companions.filter(|c| !state.has(c.name())) {
                let (linear, _) = coefficients(&companion);
                let p: Vec<f64> = companion.params().iter().map(|p| p.nominal).collect();
                count += linear.len();
                parts.push(scaled(state, &companion, &p, &linear));
            }
        }
        hypotheses.push(Hypothesis {
            shape,
            place: None,
            columns: first..first + count,
        });
        first += count;
    }
    Family {
        claim: Claim::Effect(effect.clone()),
        // Neighbouring time constants make nearly the same columns: choosing spends a degree of freedom, not a search.
        shape_dof: if role == Some(Role::TimeConstant) {
            1.0
        } else {
            0.0
        },
        log_places: if matches!(role, Some(Role::Instant | Role::Shape)) {
            (values.len().max(1) as f64).ln()
        } else {
            0.0
        },
        hypotheses,
        columns: state.cut(state.whitened(beside(&parts, state.rows()))),
        typical: effect.typical(),
    }
}

/// The columns of an effect's coefficients, for typical sizes.
fn scaled(state: &State, effect: &EffectRef, p: &[f64], linear: &[usize]) -> Mat<f64> {
    let columns = effect_columns(&state.sensitivities, state.rows(), effect, p, linear);
    sized(columns, effect, linear)
}

/// Columns of coefficients, for the typical size of each.
fn sized(mut columns: Mat<f64>, effect: &EffectRef, linear: &[usize]) -> Mat<f64> {
    for (k, mut column) in columns.col_iter_mut().enumerate() {
        column *= faer::Scale(effect.typical_of(linear[k % linear.len()]));
    }
    columns
}

/// The columns of the coefficients of an effect that begins at an instant, for all instants.
fn steps(state: &State, effect: &EffectRef, linear: &[usize], values: &[Option<f64>]) -> Mat<f64> {
    let instants: Vec<f64> = values.iter().flatten().copied().collect();
    // The instant is no coefficient: it is put before everything.
    let always: Vec<f64> = (0..effect.params().len())
        .map(|k| {
            if linear.contains(&k) {
                0.0
            } else {
                f64::NEG_INFINITY
            }
        })
        .collect();
    let of = (always.as_slice(), linear);
    let columns = step_columns(&state.sensitivities, state.rows(), effect, of, &instants);
    sized(columns, effect, linear)
}

fn disturbance_families(state: &State) -> Vec<Family> {
    let of = |&fault: &FaultRef| {
        let suspects: Vec<_> = state
            .suspects
            .iter()
            .filter(|s| s.fault == fault && !state.is_flagged(fault, s.place))
            .collect();
        let mut hypotheses = Vec::new();
        let mut first = 0;
        for suspect in &suspects {
            hypotheses.push(Hypothesis {
                shape: None,
                place: Some(suspect.place),
                columns: first..first + suspect.columns.len(),
            });
            first += suspect.columns.len();
        }
        let all: Vec<&Column> = suspects.iter().flat_map(|s| &s.columns).collect();
        let mut columns = state.sparse(&all);
        let typical = fault.typical;
        columns.scale(typical);
        Family {
            claim: Claim::Disturbed(fault),
            shape_dof: 0.0,
            log_places: (suspects.len().max(1) as f64).ln(),
            hypotheses,
            columns,
            typical,
        }
    };
    FAULTS.iter().map(of).collect()
}

/// The first `count` columns (`m × k`) in the rows of every stretch through which the heading can be followed, as columns of
/// their own: nobody knows it from one recording to the next, nor after a turn that is not used. First those of the first stretch and all others (`k`), then those of the other stretches, `count` each.
pub fn by_heading(state: &State, columns: Mat<f64>, count: usize) -> Mat<f64> {
    let rests = &state.fit.data.rests;
    let heading = |row: usize| rests[state.fit.rest_of_row[row]].heading;
    let headings = rests.last().map_or(1, |rest| rest.heading + 1);
    let k = columns.ncols();
    let count = count.min(k);
    if headings < 2 || count == 0 {
        return columns;
    }
    Mat::from_fn(columns.nrows(), k + count * (headings - 1), |i, j| {
        let (of, column) = match j.checked_sub(k) {
            Some(beyond) => (Some(1 + beyond / count), beyond % count),
            None => ((j < count).then_some(0), j),
        };
        match of {
            Some(of) if of != heading(i) => 0.0,
            _ => columns[(i, column)],
        }
    })
}

/// The places of the first `count` of such columns (`k` before they were cut) in every stretch.
pub fn places_by_heading(all: usize, k: usize, count: usize) -> Vec<Vec<usize>> {
    let others = (k..all).collect::<Vec<usize>>();
    let others = others.chunks(count.max(1)).map(<[usize]>::to_vec);
    std::iter::once((0..count).collect())
        .chain(others)
        .collect()
}

/// Matrices of `m` rows side by side.
pub fn beside(parts: &[Mat<f64>], m: usize) -> Mat<f64> {
    let count = parts.iter().map(Mat::ncols).sum();
    let mut whole = Mat::zeros(m, count);
    let mut first = 0;
    for part in parts {
        whole
            .as_mut()
            .subcols_mut(first, part.ncols())
            .copy_from(part);
        first += part.ncols();
    }
    whole
}

#[cfg(test)]
mod tests {
    use simulate::Spec;

    use super::*;
    use crate::{Extension, Request, Session};

    #[test]
    fn steps_at_once_are_the_steps_one_by_one() {
        let spec = Spec::hand_held(3);
        let recordings = [spec.run().unwrap().recording];
        let session = Session::new(&recordings, &Request::new(spec.gravity)).unwrap();
        let state = State::fit(&session, Extension::default()).unwrap();
        let effect = effects::effect_named("gyro_step").unwrap();
        let (wanted, always) = ([0, 1, 2], [0.0, 0.0, 0.0, f64::NEG_INFINITY]);
        let instants = [60.0, 100.0, 200.0];
        let m = state.rows();
        let at_once = step_columns(
            &state.sensitivities,
            m,
            &effect,
            (&always, &wanted),
            &instants,
        );
        for (k, instant) in instants.into_iter().enumerate() {
            let p = [0.0, 0.0, 0.0, instant];
            let one = effect_columns(&state.sensitivities, m, &effect, &p, &wanted);
            let difference = &one - at_once.as_ref().subcols(3 * k, 3);
            // Sums in another order.
            assert!(difference.norm_max() < 1e-12 * one.norm_max());
        }
    }
}
