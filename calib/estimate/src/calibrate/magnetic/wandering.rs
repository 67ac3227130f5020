//! A magnetometer whose bias moves in the course of a recording.

use findings::{Finding, Kind};
use nalgebra::Vector3;
use sensor::{Base, Sensor};

use super::units::Units;
use crate::calibration::Calibration;
use crate::methods::magnetic::MagneticFit;

findings::tuning! {
    /// Orders that are tried by chance.
    ORDERS: usize = 20_000;

    /// The order of the static intervals is no chance where fewer than this share of all orders has neighbours so alike.
    UNLIKELY: f64 = 1e-3;
}

/// Takes an uneven field for a bias that moves where what the fit leaves is alike in neighbouring static intervals: however the device was
/// turned in between, a bias turns with it, and a field that differs from place to place does not.
pub fn told_from_the_field(
    calibration: &Calibration,
    fit: &MagneticFit,
    units: &Units,
) -> Option<Finding> {
    let uneven =
        |found: &&Finding| matches!(found.kind, Kind::FIELD_UNEVEN | Kind::FIELD_LITTLE_UNEVEN);
    let uneven = calibration.warnings.iter().find(uneven)?;
    if !neighbours_are_alike(fit, UNLIKELY.get()) {
        return None;
    }
    let kind = match uneven.kind {
        Kind::FIELD_UNEVEN => Kind::BIAS_WANDERED,
        _ => Kind::BIAS_UNSTEADY,
    };
    let size = fit.unevenness * Base::from_parameters(&fit.model.values).scale();
    let found = Finding::of(kind).of_sensor(Sensor::Magnetometer);
    Some(found.number("size", size, units.field.in_words()))
}

/// Residuals of the readings that are used, recording by recording in the order of time.
fn in_order(fit: &MagneticFit) -> Vec<Vec<Vector3<f64>>> {
    let mut all: Vec<Vec<Vector3<f64>>> = vec![Vec::new(); fit.biases.len()];
    for (placement, left) in fit.placements.iter().zip(&fit.left) {
        if let Some(own) = all.get_mut(placement.part).filter(|_| placement.is_used) {
            own.push(*left);
        }
    }
    all
}

/// Returns true if what a fit leaves is alike in neighbouring static intervals as in fewer than this share of all orders.
pub fn neighbours_are_alike(fit: &MagneticFit, unlikely: f64) -> bool {
    are_alike(&in_order(fit), unlikely)
}

/// Returns true if neighbours are alike as in few orders of the same vectors.
fn are_alike(all: &[Vec<Vector3<f64>>], unlikely: f64) -> bool {
    let alike = |all: &[Vec<Vector3<f64>>]| -> f64 {
        let pairs = all.iter().flat_map(|own| own.windows(2));
        pairs.map(|pair| pair[0].dot(&pair[1])).sum()
    };
    let (found, most) = (alike(all), (unlikely * ORDERS.get() as f64) as usize);
    let mut others = all.to_vec();
    let mut order = Order(1);
    let as_alike = (0..ORDERS.get()).filter(|_| {
        others.iter_mut().for_each(|own| order.shuffle(own));
        alike(&others) >= found
    });
    as_alike.take(most).count() < most
}

/// Orders as by chance, the same in every run (splitmix64).
struct Order(u64);

impl Order {
    fn next(&mut self) -> u64 {
        self.0 = self.0.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let mut z = self.0;
        z = (z ^ (z >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        z ^ (z >> 31)
    }

    fn shuffle(&mut self, own: &mut [Vector3<f64>]) {
        for last in (1..own.len()).rev() {
            let other = self.next() % (last as u64 + 1);
            own.swap(last, other as usize);
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_ramp_is_no_chance_and_the_same_vectors_in_another_order_are_one() {
        let ramp: Vec<_> = (0..20)
            .map(|k| Vector3::repeat(f64::from(k) - 9.5))
            .collect();
        let mixed: Vec<_> = (0..20).map(|k| ramp[k * 7 % 20]).collect();
        assert!(are_alike(&[ramp], UNLIKELY.get()));
        assert!(!are_alike(&[mixed], UNLIKELY.get()));
    }
}
