//! The products that a formula is made of.

use super::dictionary::Product;
use super::screen::Screened;
use crate::rank::APART;

findings::tuning! {
    /// Share of the halves that must select a group (Meinshausen and Bühlmann 2010 take 0.6 to 0.9).
    pub STABLE: f64 = 0.8;

    /// Products in a formula, at most: more are a description, not a proposal.
    pub MOST_PRODUCTS: usize = 3;
}

/// A product that was chosen.
pub struct Chosen<'a> {
    /// The product.
    pub product: &'a Product,
    /// Its place among the screened ones.
    pub place: usize,
    /// The share of the halves that select it.
    pub frequency: f64,
}

/// The products that most halves select, most evident first.
#[derive(Clone)]
pub struct Stable<'a> {
    screened: &'a Screened,
    products: &'a [Product],
    frequencies: &'a [f64],
    /// Places among the screened ones.
    pub places: Vec<usize>,
}

impl<'a> Stable<'a> {
    /// Those of the screened ones with these frequencies.
    pub fn of(screened: &'a Screened, products: &'a [Product], frequencies: &'a [f64]) -> Self {
        let places = (0..frequencies.len()).filter(|&place| frequencies[place] >= STABLE.get());
        Self {
            screened,
            products,
            frequencies,
            places: places.collect(),
        }
    }

    fn product(&self, place: usize) -> &'a Product {
        &self.products[self.screened.products[place]]
    }

    /// Returns true if two products explain nearly the same.
    pub fn are_alike(&self, one: usize, other: usize) -> bool {
        self.screened.are_alike(self.products, one, other)
    }

    /// Those of one sensor: of those that are alike one, the simplest that is no less likely than the best by [`APART`].
    pub fn chosen(&self) -> Vec<Chosen<'a>> {
        let mut stable = self.places.clone();
        let mut chosen = Vec::new();
        while let (Some(&best), true) = (stable.first(), chosen.len() < MOST_PRODUCTS.get()) {
            let sensor = self.product(best).sensor;
            let (alike, others): (Vec<usize>, Vec<usize>) = stable
                .iter()
                .partition(|&&place| self.are_alike(best, place));
            let log_p = |place: usize| self.screened.log_p(place);
            let likely = alike
                .into_iter()
                .filter(|&place| log_p(place) < log_p(best) + APART.get());
            let simplest = likely.min_by_key(|&place| self.product(place).degree());
            let place = simplest.unwrap_or(best);
            chosen.push(Chosen {
                product: self.product(place),
                place,
                frequency: self.frequencies[place],
            });
            stable = others;
            stable.retain(|&place| self.product(place).sensor == sensor);
        }
        chosen
    }
}
