//! A magnetometer whose bias, or the field around it, becomes another part of the way: as where a phone corrects its offset by itself.

use findings::{Finding, Kind};
use nalgebra::{Vector2, Vector3};
use sensor::Sensor;

use super::units::Units;
use crate::methods::magnetic::{Field, MagneticFit, MagneticRequest, fit_magnetometer};
use crate::methods::small_sample::by_chance;

/// Fewest placements on either side.
const SIDE: usize = 5;

/// Noises of a mean by which the field has to differ from place to place before a step is looked for.
const UNEVEN: f64 = 4.0;

/// A step is the cause where it leaves less than this share of the unevenness.
const LEFT: f64 = 0.3;

/// Biases differ that are equal in fewer cases than this.
const UNLIKELY: f64 = 1e-4;

/// The fit where the magnetometer has a bias and a field of its own from some placement on; the result holds from there. With what is to
/// be said of it. `None` where that does not explain most of the unevenness.
pub fn stepped<'a>(
    request: &MagneticRequest<'a>,
    fit: &MagneticFit,
    name: &str,
    units: &Units,
) -> Option<(MagneticFit, Finding)> {
    let noise = fit.residual_rms / fit.reduced_chi2.max(f64::MIN_POSITIVE).sqrt();
    if request.recordings != 1 || fit.unevenness < UNEVEN * noise {
        return None;
    }
    let places = SIDE..request.placements.len().saturating_sub(SIDE - 1);
    let fits = places.filter_map(|at| Some((at, fit_magnetometer(divided(request, at)).ok()?)));
    let (at, best) = fits.min_by(|a, b| a.1.unevenness.total_cmp(&b.1.unevenness))?;
    if best.unevenness > LEFT * fit.unevenness {
        return None;
    }
    let span = request.placements[at].span;
    let of = |kind| {
        Finding::of(kind)
            .in_recording(name)
            .of_sensor(Sensor::Magnetometer)
            .at_interval(request.placements[at].interval)
            .from_time(span.from)
    };
    let [before, after] = [&best.biases[0], &best.biases[1]];
    let change = Vector3::from(after.value) - Vector3::from(before.value);
    let squares =
        (0..3).map(|k| change[k].powi(2) / (before.std[k].powi(2) + after.std[k].powi(2)));
    let is_bias = by_chance(squares.sum(), 3.0) < UNLIKELY;
    let found = match is_bias {
        true => {
            of(Kind::MagneticBiasStepped).number("size", change.norm(), units.reading.in_words())
        }
        false => {
            let size = difference(&best.fields[0], &best.fields[1]);
            of(Kind::FieldStepped).number("size", size, units.field.in_words())
        }
    };
    Some((best, found))
}

/// The smallest difference of two fields, whose headings nothing ties.
fn difference(one: &Field, other: &Field) -> f64 {
    let part = |field: &Field| {
        let (down, level) = field.inclination.sin_cos();
        Vector2::new(level, down) * field.strength
    };
    (part(one) - part(other)).norm()
}

/// The same with the placements from `at` on as another recording.
fn divided<'a>(request: &MagneticRequest<'a>, at: usize) -> MagneticRequest<'a> {
    let mut divided = request.clone();
    for placement in &mut divided.placements[at..] {
        placement.recording = 1;
    }
    divided.changes.retain(|change| change.from + 1 != at);
    MagneticRequest {
        recordings: 2,
        ..divided
    }
}
