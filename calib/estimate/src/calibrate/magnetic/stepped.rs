//! A magnetometer whose bias, or the field around it, becomes another part of the way: as where a phone corrects its offset by itself.

use findings::{Finding, Kind};
use nalgebra::{Vector2, Vector3};
use sensor::Sensor;

use super::units::Units;
use crate::methods::magnetic::{Field, MagneticFit, MagneticRequest, fit_magnetometer};
use crate::methods::small_sample::by_chance;

/// Fewest placements on either side.
const SIDE: usize = 5;

/// Steps at most: what steps more often is no step.
const MOST: usize = 4;

/// Noises of a mean by which the field has to differ from place to place before a step is looked for.
const UNEVEN: f64 = 4.0;

/// Steps are the cause where they leave less than this share of the unevenness.
const LEFT: f64 = 0.3;

/// Biases differ that are equal in fewer cases than this.
const UNLIKELY: f64 = 1e-4;

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
    let (steps, best) = fewest_steps(request, fit)?;
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
    let ([.., last_bias, bias], [.., last_field, field]) = (&*best.biases, &*best.fields) else {
        return None;
    };
    let change = Vector3::from(bias.value) - Vector3::from(last_bias.value);
    let squares =
        (0..3).map(|k| change[k].powi(2) / (last_bias.std[k].powi(2) + bias.std[k].powi(2)));
    let is_bias = by_chance(squares.sum(), 3.0) < UNLIKELY;
    let found = match is_bias {
        true => {
            of(Kind::MagneticBiasStepped).number("size", change.norm(), units.reading.in_words())
        }
        false => {
            let size = difference(last_field, field);
            of(Kind::FieldStepped).number("size", size, units.field.in_words())
        }
    };
    Some((best, found))
}

/// The fewest steps that explain most of the unevenness; more where they explain most of what these leave.
fn fewest_steps<'a>(
    request: &MagneticRequest<'a>,
    fit: &MagneticFit,
) -> Option<(Vec<usize>, MagneticFit)> {
    let noise = fit.residual_rms / fit.reduced_chi2.max(f64::MIN_POSITIVE).sqrt();
    let (mut steps, mut found, mut left) = (Vec::new(), None, fit.unevenness);
    let mut needed = LEFT * left;
    while left > UNEVEN * noise && steps.len() < MOST {
        let Some(best) = one_more(request, &mut steps) else {
            break;
        };
        left = best.unevenness;
        if left < needed {
            needed = LEFT * left;
            let mut sorted = steps.clone();
            sorted.sort_unstable();
            found = Some((sorted, best));
        }
    }
    found
}

/// The fit that leaves least with one step more; where the others are is looked for again beside it.
fn one_more(request: &MagneticRequest<'_>, steps: &mut Vec<usize>) -> Option<MagneticFit> {
    let others = steps.len();
    let (place, mut best) = best_beside(request, steps)?;
    steps.push(place);
    for _ in 0..2 * others {
        steps.rotate_left(1);
        (steps[others], best) = best_beside(request, &steps[..others])?;
    }
    Some(best)
}

/// The place of one more step, and the fit that leaves least.
fn best_beside(request: &MagneticRequest<'_>, others: &[usize]) -> Option<(usize, MagneticFit)> {
    let places = SIDE..request.placements.len().saturating_sub(SIDE - 1);
    let is_apart = |at: &usize| others.iter().all(|other| other.abs_diff(*at) >= SIDE);
    let fits = places.filter(is_apart).filter_map(|at| {
        let all = [others, &[at]].concat();
        Some((at, fit_magnetometer(divided(request, &all)).ok()?))
    });
    fits.min_by(|a, b| a.1.unevenness.total_cmp(&b.1.unevenness))
}

/// The smallest difference of two fields, whose headings nothing ties.
fn difference(one: &Field, other: &Field) -> f64 {
    let part = |field: &Field| {
        let (down, level) = field.inclination.sin_cos();
        Vector2::new(level, down) * field.strength
    };
    (part(one) - part(other)).norm()
}

/// The same with another recording from each of the places on.
fn divided<'a>(request: &MagneticRequest<'a>, steps: &[usize]) -> MagneticRequest<'a> {
    let mut divided = request.clone();
    for at in steps {
        for placement in &mut divided.placements[*at..] {
            placement.recording += 1;
        }
    }
    divided
        .changes
        .retain(|change| !steps.contains(&(change.from + 1)));
    MagneticRequest {
        recordings: 1 + steps.len(),
        ..divided
    }
}
