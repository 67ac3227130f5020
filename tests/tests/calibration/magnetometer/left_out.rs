//! Effects that a calibration of a magnetometer leaves out.

use calib::calibrate::Method;
use calib::calibration::LeftOut;

use super::{calibrated, errors, request, spec};

/// Parameters of the magnetometer as `errors` has them: each axis of `T`, then its bias.
const NAMES: [&str; 12] = [
    "s_x", "gamma_yz", "gamma_zy", "b_x", "gamma_xz", "s_y", "gamma_zx", "b_y", "gamma_xy",
    "gamma_yx", "s_z", "b_z",
];

#[test]
fn a_small_square_is_within_what_is_left_out() {
    let mut spec = spec(3, 0.0);
    let small = ["x", "y", "z"].map(|axis| (axis.to_owned(), 4e-5));
    spec.effects.insert("mag_quadratic".into(), small.into());
    let session = spec.run().unwrap();
    let calibration = calibrated(&session, &request(Method::Joint));
    let of = |effect: &str| {
        let mut all = calibration.left_out.iter();
        all.find(|own| own.effect == effect).unwrap()
    };
    let LeftOut {
        parameter,
        std_added,
        ..
    } = of("mag_quadratic");
    let k = calibration
        .parameters
        .iter()
        .position(|own| own == parameter);
    let std = calibration.covariance[k.unwrap()][k.unwrap()].sqrt();
    let name = parameter.strip_prefix("mag.").unwrap();
    let place = NAMES.iter().position(|own| *own == name).unwrap();
    let error = errors(&calibration, &session)[place].abs();
    assert!(
        error > 3.0 && std_added / std > 0.5 * error,
        "{error} {std_added} {std}"
    );
    assert!(of("mag_cubic").std_added > 0.0);
}
