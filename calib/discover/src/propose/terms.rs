//! The terms of the selected products that the data need.

use faer::Mat;
use sensor::{Sensor, Term};

use super::chosen::Chosen;
use super::dictionary::Product;
use crate::family::beside;
use crate::noise::projected::Whitened;
use crate::score::score;

findings::tuning! {
    /// A product needs a coefficient of so many standard errors: among nine, one of noise reaches it in .4 % of all cases.
    SIGNIFICANT: f64 = 3.5;

    /// On its other axes so many do (Schwarz 1978: `√ln n` of about 60 rows): what one axis has, the others are likely to have too.
    SIGNIFICANT_BESIDE: f64 = 2.0;
}

/// The terms, and the least stability of the products that have one.
#[derive(Debug)]
pub struct Terms {
    /// With their estimates.
    pub terms: Vec<Term>,
    /// The sensor that has them.
    pub sensor: Sensor,
    /// Their whitened columns (`q × 1` each).
    pub columns: Vec<Mat<f64>>,
    /// `χ²` that they explain together.
    pub statistic: f64,
    /// Selection frequency of the least stable product.
    pub stability: f64,
    /// Number of products that have a term.
    pub products: usize,
}

impl Terms {
    /// Returns true if `term` of `product` is one of them.
    pub fn holds(&self, product: &Product, term: &Term) -> bool {
        let name = term.name();
        product.sensor == self.sensor && self.terms.iter().any(|own| own.name() == name)
    }
}

/// The terms of stable products, by backward elimination: the least significant goes first, the rest is
/// estimated again. A product goes as a whole where none of its axes is significant.
pub fn terms(whitened: &Whitened, chosen: &[Chosen<'_>]) -> Option<Terms> {
    let mut places: Vec<(usize, usize)> = Vec::new();
    for (k, of) in chosen.iter().enumerate() {
        places.extend((0..of.product.parts.len()).map(|axis| (k, axis)));
    }
    let columns: Vec<Mat<f64>> = chosen
        .iter()
        .map(|of| whitened.columns(&of.product.columns))
        .collect();
    while !places.is_empty() {
        let own = places.iter().map(|&(k, axis)| {
            let column = columns[k].as_ref().subcols(axis, 1);
            column.to_owned()
        });
        let own: Vec<Mat<f64>> = own.collect();
        let fitted = score(beside(&own, whitened.z.nrows()).as_ref(), &whitened.z);
        let sizes: Vec<f64> = (0..places.len())
            .map(|i| {
                fitted.change[i].abs() / fitted.covariance[(i, i)].sqrt().max(f64::MIN_POSITIVE)
            })
            .collect();
        let least = (0..places.len()).min_by(|a, b| sizes[*a].total_cmp(&sizes[*b]))?;
        // A direction that the data do not see has no size of its own.
        if fitted.dof < places.len() || sizes[least] < SIGNIFICANT_BESIDE.get() {
            places.remove(least);
            continue;
        }
        if let Some(doubtful) = doubtful(&places, &sizes) {
            places.retain(|(product, _)| *product != doubtful);
            continue;
        }
        let term = |(i, &(k, axis)): (usize, &(usize, usize))| {
            chosen[k].product.term(axis, fitted.change[i])
        };
        let stability = places.iter().map(|(k, _)| chosen[*k].frequency);
        let mut products: Vec<usize> = places.iter().map(|(k, _)| *k).collect();
        products.dedup();
        return Some(Terms {
            products: products.len(),
            terms: places.iter().enumerate().map(term).collect(),
            sensor: chosen[0].product.sensor,
            columns: own,
            statistic: fitted.statistic,
            stability: stability.fold(1.0, f64::min),
        });
    }
    None
}

/// The least significant product, where none of its terms is significant; `places` (product, axis) are in the order of the products.
fn doubtful(places: &[(usize, usize)], sizes: &[f64]) -> Option<usize> {
    let products = places.iter().map(|(product, _)| *product);
    let terms: Vec<(usize, f64)> = products.zip(sizes.iter().copied()).collect();
    let largest = terms
        .chunk_by(|a, b| a.0 == b.0)
        .filter_map(|own| own.iter().copied().max_by(|a, b| a.1.total_cmp(&b.1)));
    let least = largest.min_by(|a, b| a.1.total_cmp(&b.1));
    least
        .filter(|(_, size)| *size < SIGNIFICANT.get())
        .map(|(product, _)| product)
}
