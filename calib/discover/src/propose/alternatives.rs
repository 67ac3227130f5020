//! Terms that fit about as well as a proposed one.

use faer::Mat;
use sensor::Formula;

use super::dictionary::Product;
use super::terms::Terms;
use crate::family::beside;
use crate::noise::projected::Whitened;
use crate::rank::APART;
use crate::score::score;

findings::tuning! {
    /// So many are stated.
    STATED: usize = 4;
}

/// The terms of `products` that explain as much as one of `terms` does, the others being there: with a likelihood no
/// less than a twentieth. The likeliest [`STATED`] of them, likeliest first, as formulas of one term.
pub fn alternatives(whitened: &Whitened, terms: &Terms, products: &[&Product]) -> Vec<String> {
    let columns: Vec<Mat<f64>> = products
        .iter()
        .map(|product| whitened.columns(&product.columns))
        .collect();
    let enough = terms.statistic - 2.0 * APART.get();
    let mut all: Vec<(f64, String)> = Vec::new();
    for k in 0..terms.terms.len() {
        let mut own = terms.columns.clone();
        for (product, columns) in products.iter().zip(&columns) {
            for axis in 0..product.parts.len() {
                let term = product.term(axis, 1.0);
                if terms.holds(product, &term) {
                    continue;
                }
                own[k] = columns.as_ref().subcols(axis, 1).to_owned();
                let swapped = score(beside(&own, whitened.z.nrows()).as_ref(), &whitened.z);
                let formula = Formula::new(product.sensor, vec![term]).to_string();
                if swapped.statistic > enough && all.iter().all(|(_, own)| *own != formula) {
                    all.push((swapped.statistic, formula));
                }
            }
        }
    }
    all.sort_by(|a, b| b.0.total_cmp(&a.0));
    all.truncate(STATED.get());
    all.into_iter().map(|(_, formula)| formula).collect()
}

#[cfg(test)]
mod tests {
    use estimate::methods::joint::{Columns, RowGroups};
    use sensor::{Axis, Covariate, Sensor};

    use super::*;
    use crate::noise::projected::Projected;

    fn product(covariate: Covariate, column: [f64; 3]) -> Product {
        Product {
            sensor: Sensor::Gyroscope,
            parts: vec![(Axis::X, vec![(covariate, 1)])],
            columns: Mat::from_fn(3, 1, |i, _| column[i]),
            lengths: vec![1.0],
        }
    }

    #[test]
    fn a_term_that_is_twenty_times_less_likely_is_no_alternative() {
        let nothing = Columns::none(&RowGroups::whole(3));
        let projected = Projected::new(&[10.0, 1.0, 0.0], &nothing, (&[], &[]));
        let whitened = projected.at(Default::default()).unwrap();
        let chosen = product(Covariate::Time, [1.0, 0.0, 0.0]);
        // (10 cos 0.2 + sin 0.2)² is 99.98, (10 cos 0.4 + sin 0.4)² is 92.2; of 100 more than 2 ln 20 less is 94.0.
        let turned = |angle: f64| [angle.cos(), angle.sin(), 0.0];
        let close = product(Covariate::TemperatureChange, turned(0.2));
        let far = product(Covariate::SpecificForce(Axis::X), turned(0.4));
        let terms = Terms {
            terms: vec![chosen.term(0, 10.0)],
            sensor: Sensor::Gyroscope,
            columns: vec![chosen.columns.clone()],
            statistic: 100.0,
            stability: 1.0,
            products: 1,
        };
        let found = alternatives(&whitened, &terms, &[&chosen, &close, &far]);
        assert_eq!(found, ["W_x += x_dt * dT"]);
    }
}
