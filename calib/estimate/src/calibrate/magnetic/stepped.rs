//! A magnetometer whose bias, or the field around it, becomes another part of the way: as where a phone corrects its offset by itself.

use findings::{Finding, Kind};
use nalgebra::{Vector2, Vector3};
use sensor::Sensor;

use super::units::Units;
use super::wandering::neighbours_are_alike;
use crate::methods::chance;
use crate::methods::magnetic::{Field, MagneticFit, MagneticRequest, chi2_at, fit_magnetometer};

/// What is another from a step on.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Stepping {
    /// Bias and field.
    Both,
    /// The bias alone: the field goes on, so that fewer placements show it.
    Bias,
}

impl Stepping {
    /// Fewest placements on either side.
    fn side(self) -> usize {
        match self {
            Self::Both => 5,
            Self::Bias => 2,
        }
    }
}

findings::tuning! {
    /// Steps at most: what steps more often is no step.
    MOST: usize = 4;

    /// Noises of a mean by which the field has to differ from place to place before a step is looked for.
    UNEVEN: f64 = 4.0;

    /// Steps of the bias alone are looked for where neighbours are alike as in fewer than this share of all orders: a bias turns with the device.
    IN_ORDER: f64 = 0.1;

    /// Placements to either side of a step among which it is looked for again beside another.
    NEAR: usize = 3;

    /// Steps are the cause where they leave less than this share of the unevenness.
    LEFT: f64 = 0.3;

    /// Steps of the bias alone leave an even field: no more than so many noises of a mean.
    EVEN: f64 = 1.0;

    /// Biases differ that are equal in fewer cases than this.
    UNLIKELY: f64 = 1e-4;
}

/// The fit where the magnetometer has a bias and a field of its own from some placements on; the result holds from the last of them. With what is
/// to be said of it. `None` where that does not explain most of the unevenness.
pub fn stepped<'a>(
    request: &MagneticRequest<'a>,
    fit: &MagneticFit,
    name: &str,
    units: &Units,
) -> Option<(MagneticFit, Finding)> {
    if request.recordings != 1 {
        return None;
    }
    let noise = fit.residual_rms / fit.reduced_chi2.max(f64::MIN_POSITIVE).sqrt();
    let both = fewest_steps(request, fit, noise, Stepping::Both);
    let (steps, best) = match both {
        Some((steps, best)) if best.unevenness <= UNEVEN.get() * noise => (steps, best),
        both => steps_of_the_bias(request, fit, noise).or(both)?,
    };
    let (at, before) = steps.split_last()?;
    let span = request.placements[*at].span;
    let of = |kind| {
        let found = Finding::of(kind)
            .in_recording(name)
            .of_sensor(Sensor::Magnetometer)
            .at_interval(request.placements[*at].interval)
            .from_time(span.from);
        match before.is_empty() {
            true => found,
            false => found.count("count", steps.len()),
        }
    };
    let [.., last_bias, bias] = &*best.biases else {
        return None;
    };
    let change = Vector3::from(bias.value) - Vector3::from(last_bias.value);
    let squares =
        (0..3).map(|k| change[k].powi(2) / (last_bias.std[k].powi(2) + bias.std[k].powi(2)));
    let is_bias = chance::of_chi2(squares.sum(), 3.0) < UNLIKELY.get();
    let found = match &*best.fields {
        [.., last, field] if !is_bias => {
            let size = difference(last, field);
            of(Kind::FIELD_STEPPED).number("size", size, units.field.in_words())
        }
        _ => {
            of(Kind::MAGNETIC_BIAS_STEPPED).number("size", change.norm(), units.reading.in_words())
        }
    };
    Some((best, found))
}

/// The fewest steps that explain most of the unevenness; more where they explain most of what these leave.
fn fewest_steps<'a>(
    request: &MagneticRequest<'a>,
    fit: &MagneticFit,
    noise: f64,
    stepping: Stepping,
) -> Option<(Vec<usize>, MagneticFit)> {
    let (mut steps, mut found, mut left) = (Vec::new(), None, fit.unevenness);
    let mut needed = LEFT.get() * left;
    while left > UNEVEN.get() * noise && steps.len() < MOST.get() {
        let Some(best) = one_more(request, &mut steps, stepping, left) else {
            break;
        };
        left = best.unevenness;
        if left < needed {
            needed = LEFT.get() * left;
            let mut sorted = steps.clone();
            sorted.sort_unstable();
            found = Some((sorted, best));
        }
    }
    found
}

/// The fit with one step more, at the likeliest place in a field that differs by `uneven`; where the others are is looked for again beside it.
fn one_more(
    request: &MagneticRequest<'_>,
    steps: &mut Vec<usize>,
    stepping: Stepping,
    uneven: f64,
) -> Option<MagneticFit> {
    let others = steps.len();
    let beside = |steps: &[usize], near: Option<usize>| {
        likeliest_beside(request, steps, stepping, near, uneven)
    };
    steps.push(beside(steps, None)?);
    for _ in 0..2 * others {
        steps.rotate_left(1);
        steps[others] = beside(&steps[..others], Some(steps[others]))?;
    }
    fit_magnetometer(divided(request, steps, stepping)).ok()
}

/// The likeliest place of one more step in a field that differs by `uneven`, near another where one is given.
fn likeliest_beside(
    request: &MagneticRequest<'_>,
    others: &[usize],
    stepping: Stepping,
    near: Option<usize>,
    uneven: f64,
) -> Option<usize> {
    let side = stepping.side();
    let places = side..request.placements.len().saturating_sub(side - 1);
    let is_apart = |at: &usize| others.iter().all(|other| other.abs_diff(*at) >= side);
    let is_near = |at: &usize| near.is_none_or(|near| near.abs_diff(*at) <= NEAR.get());
    let fits = places.filter(is_apart).filter(is_near).filter_map(|at| {
        let all = [others, &[at]].concat();
        let chi2 = chi2_at(&divided(request, &all, stepping), uneven).ok()?;
        Some((at, chi2))
    });
    let best = fits.min_by(|a, b| a.1.total_cmp(&b.1))?;
    Some(best.0)
}

/// Steps of the bias alone that leave an even field, where chance does not make so much of an uneven one.
fn steps_of_the_bias<'a>(
    request: &MagneticRequest<'a>,
    fit: &MagneticFit,
    noise: f64,
) -> Option<(Vec<usize>, MagneticFit)> {
    if !neighbours_are_alike(fit, IN_ORDER.get()) {
        return None;
    }
    let (steps, best) = fewest_steps(request, fit, noise, Stepping::Bias)?;
    let square = |fit: &MagneticFit| {
        let variance = fit.unevenness.powi(2) + noise.powi(2);
        (fit.degrees_of_freedom as f64, variance)
    };
    let ((dof, before), (left, after)) = (square(fit), square(&best));
    let explained = (dof * before - left * after) / (dof - left);
    let p = chance::of_f(explained / after, [dof - left, left]);
    let places = (request.placements.len() as f64).powi(i32::try_from(steps.len()).ok()?);
    let is_no_chance = p * places < UNLIKELY.get();
    (best.unevenness <= EVEN.get() * noise && is_no_chance).then_some((steps, best))
}

/// The smallest difference of two fields, whose headings nothing ties.
fn difference(one: &Field, other: &Field) -> f64 {
    let part = |field: &Field| {
        let (down, level) = field.inclination.sin_cos();
        Vector2::new(level, down) * field.strength
    };
    (part(one) - part(other)).norm()
}

/// The same with another part from each of the places on.
fn divided<'a>(
    request: &MagneticRequest<'a>,
    steps: &[usize],
    stepping: Stepping,
) -> MagneticRequest<'a> {
    let mut divided = request.clone();
    divided.parts += steps.len();
    for at in steps {
        for placement in &mut divided.placements[*at..] {
            placement.part += 1;
        }
    }
    if stepping == Stepping::Both {
        let (placements, changes) = (&mut divided.placements, &mut divided.changes);
        placements
            .iter_mut()
            .for_each(|own| own.recording = own.part);
        changes.retain(|change| !steps.contains(&(change.from + 1)));
        divided.recordings = divided.parts;
    }
    divided
}
