//! The most that a formula can explain.

use estimate::methods::joint::orthonormal;
use faer::Mat;
use sensor::Sensor;

use super::chosen::MOST_PRODUCTS;
use super::dictionary::{Product, log_formulas};
use super::screen::Screened;
use crate::noise::level::Level;
use crate::score::log_tail;

/// The evidence, by likelihood ratio, that no formula of screened products goes beyond: as if one term explained what
/// the products that explain most do together, and had been looked for among all terms once.
///
/// Products are taken one after the other, the one that adds most each time; each is orthogonal to those before. Eight formulas
/// that took the place of names had 5 to 15 less (natural logarithm).
pub(super) fn most_evidence(screened: &Screened, products: &[Product], levels: &[Level]) -> f64 {
    let nothing = levels
        .first()
        .map_or(0.0, |level| level.whitened.log_likelihood());
    let gained = 2.0 * (screened.whitened.log_likelihood() - nothing);
    let sensors = [Sensor::Accelerometer, Sensor::Gyroscope];
    let explained = sensors.map(|sensor| explained(screened, products, sensor));
    let statistic = gained + explained.into_iter().fold(0.0, f64::max);
    -log_tail(statistic, 1.0) - log_formulas(products, 1, 1)
}

/// `χ²` that products of one sensor explain together.
fn explained(screened: &Screened, products: &[Product], sensor: Sensor) -> f64 {
    let all = screened.bases.iter().zip(&screened.products);
    let own = all.filter(|(_, place)| products[**place].sensor == sensor);
    let mut bases: Vec<Mat<f64>> = own.map(|(basis, _)| basis.clone()).collect();
    let mut left = screened.whitened.z.clone();
    for _ in 0..MOST_PRODUCTS.get() {
        let by = |basis: &Mat<f64>| (basis.transpose() * &left).squared_norm_l2();
        let best = (0..bases.len()).max_by(|&a, &b| by(&bases[a]).total_cmp(&by(&bases[b])));
        let Some(best) = best else {
            break;
        };
        let taken = bases.swap_remove(best);
        left -= &taken * (taken.transpose() * &left);
        for basis in &mut bases {
            let beside = &*basis - &taken * (taken.transpose() * &*basis);
            *basis = orthonormal(&beside);
        }
    }
    screened.whitened.z.squared_norm_l2() - left.squared_norm_l2()
}
