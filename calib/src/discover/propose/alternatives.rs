//! What would do about as well as a proposed term.

use faer::Mat;
use sensor::Formula;

use super::dictionary::Product;
use super::terms::Terms;
use crate::discover::family::beside;
use crate::discover::projected::Whitened;
use crate::discover::score::score;
use crate::discover::search::APART;

/// The terms of `products` that explain as much as one of `terms` does, the others being there: with a likelihood no
/// less than a twentieth. As formulas of one term.
pub fn alternatives(whitened: &Whitened, terms: &Terms, products: &[&Product]) -> Vec<String> {
    let columns: Vec<Mat<f64>> = products
        .iter()
        .map(|product| whitened.columns(&product.columns))
        .collect();
    let enough = terms.statistic - 2.0 * APART;
    let mut all = Vec::new();
    for k in 0..terms.terms.len() {
        let mut own = terms.columns.clone();
        for (product, columns) in products.iter().zip(&columns) {
            for axis in 0..product.axes.len() {
                let term = product.term(axis, 1.0);
                if terms.holds(product, &term) {
                    continue;
                }
                own[k] = columns.as_ref().subcols(axis, 1).to_owned();
                let swapped = score(beside(&own, whitened.z.nrows()).as_ref(), &whitened.z);
                let formula = Formula::new(product.sensor, vec![term]).to_string();
                if swapped.statistic > enough && !all.contains(&formula) {
                    all.push(formula);
                }
            }
        }
    }
    all
}
