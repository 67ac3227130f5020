//! A magnetometer against the horizon: its axes and hand.

use findings::{Finding, Kind, Level, OptionName, Remedy};
use nalgebra::Matrix3;
use recording::Recording;
use sensor::Sensor;

use super::axes::SignedAxes;
use super::columns::Columns;

findings::tuning! {
    /// Inclinations and latitudes beyond this have a sign that cannot be mistaken, degrees: the magnetic equator is nowhere
    /// farther from the other.
    PLAIN: f64 = 25.0;
}

/// Says where the axes of a magnetometer are turned or mirrored: its field and gravity fit as well with all signs changed, so that
/// a wrong sign turns the field backwards. `inclination` is the corrected field's, degrees below the horizontal.
pub(in crate::calibrate) fn turned_field(
    t: &Matrix3<f64>,
    inclination: f64,
    latitude: Option<f64>,
    recordings: &[&Recording],
) -> Option<Finding> {
    let axes = SignedAxes::nearest(t)?;
    let columns = Columns::of(recordings, Sensor::Magnetometer);
    let side = if inclination < 0.0 { "above" } else { "below" };
    let of = |kind| {
        Finding::of(kind)
            .of_sensor(Sensor::Magnetometer)
            .detail("angle", format!("{:.0}°", inclination.abs()))
            .detail("side", side)
    };
    let known =
        latitude.filter(|latitude| latitude.abs() > PLAIN.get() && inclination.abs() > PLAIN.get());
    let read = || columns.turned(&axes.opposite());
    if let Some(latitude) = known {
        return (inclination * latitude < 0.0).then(|| {
            of(Kind::FIELD_SIGNS_WRONG)
                .detail("latitude", format!("{latitude}°"))
                .only_remedies([read()])
        });
    }
    if axes.is_unchanged() {
        return None;
    }
    let turned = of(Kind::FIELD_TURNED).detail("axes", axes.in_words());
    Some(match axes.is_half_turn() {
        false => turned.at_level(Level::Remark).only_remedies([]),
        true => turned
            .detail("half", if inclination < 0.0 { "south" } else { "north" })
            .only_remedies([Remedy::set(OptionName::Latitude), read()]),
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    fn said(diagonal: [f64; 3], inclination: f64, latitude: Option<f64>) -> Option<String> {
        let t = Matrix3::from_diagonal(&diagonal.into()) * 0.97;
        turned_field(&t, inclination, latitude, &[]).map(|f| f.text(findings::Front::CommandLine))
    }

    #[test]
    fn a_wrong_sign_is_said_with_the_option_that_undoes_it_whatever_is_known_of_the_place() {
        for (axis, diagonal) in [[1.0, -1.0, -1.0], [-1.0, 1.0, -1.0], [-1.0, -1.0, 1.0]]
            .into_iter()
            .enumerate()
        {
            let flip = format!("--flip {}", ["mx", "my", "mz"][axis]);
            let words = said(diagonal, -62.9, None).unwrap();
            assert!(
                words.contains("63° above") && words.contains(&flip),
                "{words}"
            );
            let words = said(diagonal, -62.9, Some(48.0)).unwrap();
            assert!(words.contains(&flip), "{words}");
            assert_eq!(said(diagonal, -62.9, Some(-35.0)), None);
        }
        assert_eq!(said([1.0, 1.0, 1.0], -62.9, None), None);
        assert!(said([1.0, 1.0, 1.0], -62.9, Some(48.0)).is_some());
    }
}
