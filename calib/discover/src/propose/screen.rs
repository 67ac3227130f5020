//! The products that may explain the rest: few enough for a cone program.

use estimate::methods::joint::BiasNoise;
use faer::Mat;
use statrs::distribution::{ChiSquared, ContinuousCDF};

use super::dictionary::{Product, seen_directions};
use crate::noise::level::Level;
use crate::noise::projected::Whitened;
use crate::score::log_tail;
use crate::state::State;

findings::tuning! {
    /// Products that are kept.
    KEPT: usize = 40;

    /// Two products that share more than this (`ρ²`) are the same to these data: that of lower degree is kept.
    TWINS: f64 = 0.98;

    /// Groups that share more than this (`ρ²`) stand for each other: halves that select the one speak for the other.
    ALIKE: f64 = 0.5;

    /// Chance that noise alone pulls any product of the dictionary into the model.
    BY_CHANCE: f64 = 0.05;
}

/// Products of the dictionary that passed the screening.
#[derive(Debug)]
pub struct Screened {
    /// Places in the dictionary of those with the best scores, twins among them.
    pub kept: Vec<usize>,
    /// Places of those that are left without twins, most evident first.
    pub products: Vec<usize>,
    /// Their orthonormal columns (`q × rank`).
    pub bases: Vec<Mat<f64>>,
    /// Their whitened columns.
    columns: Vec<Mat<f64>>,
    /// The noise of the biases that suits the best of them.
    pub noise: BiasNoise,
    /// The disagreement at that noise.
    pub whitened: Whitened,
    /// The `λ` below which noise alone would select.
    pub floor: f64,
}

impl Screened {
    /// Returns true if two of the screened products explain nearly the same, as a whole or on one axis: an error of one axis alone is in the
    /// product that is the same on all axes and in the one that goes with the axis.
    pub fn are_alike(&self, products: &[Product], one: usize, other: usize) -> bool {
        let product = |place: usize| &products[self.products[place]];
        let (a, b) = (product(one), product(other));
        let columns = [&self.columns[one], &self.columns[other]];
        let axes = a.parts.iter().enumerate();
        let mut same_axis = axes.filter_map(|(i, (axis, _))| {
            let k = b.parts.iter().position(|(own, _)| own == axis)?;
            Some((columns[0].col(i), columns[1].col(k)))
        });
        let correlated = same_axis.any(|(x, y)| {
            let shared = x.transpose() * y;
            shared * shared > ALIKE.get() * x.squared_norm_l2() * y.squared_norm_l2()
        });
        alike(&self.bases[one], &self.bases[other]) || (a.sensor == b.sensor && correlated)
    }

    /// `ln p` of one of the products.
    pub fn log_p(&self, place: usize) -> f64 {
        log_p(&self.bases[place], &self.whitened)
    }
}

/// The products with the best score of their own.
pub fn screen(state: &State, products: &[Product]) -> Option<Screened> {
    let levels = state.levels();
    let kept = best(products, levels);
    let level = &levels[likeliest(products, &kept, levels)?];
    let whitened = level.whitened.clone();
    let law = ChiSquared::new(3.0).ok()?;
    let floor = law.inverse_cdf(1.0 - BY_CHANCE.get() / products.len().max(1) as f64) / 3.0;
    let mut screened = Screened {
        kept: kept.clone(),
        products: Vec::new(),
        bases: Vec::new(),
        columns: Vec::new(),
        noise: level.noise,
        whitened,
        floor: floor.sqrt(),
    };
    let mut simplest = kept;
    simplest.sort_by_key(|k| products[*k].degree());
    for k in simplest {
        let columns = screened.whitened.columns(&products[k].columns);
        let basis = seen_directions(columns.as_ref());
        let is_twin = |i: usize| {
            let other: &Mat<f64> = &screened.bases[i];
            let rank = other.ncols().max(basis.ncols()) as f64;
            products[screened.products[i]].sensor == products[k].sensor
                && (other.transpose() * &basis).squared_norm_l2() > TWINS.get() * rank
        };
        if !(0..screened.bases.len()).any(is_twin) {
            screened.products.push(k);
            screened.bases.push(basis);
            screened.columns.push(columns);
        }
    }
    Some(by_evidence(screened))
}

fn by_evidence(screened: Screened) -> Screened {
    let evidence = |basis: &Mat<f64>| log_p(basis, &screened.whitened);
    let mut order: Vec<(f64, usize)> = screened.bases.iter().map(evidence).zip(0..).collect();
    order.sort_by(|a, b| a.0.total_cmp(&b.0));
    Screened {
        products: order.iter().map(|(_, i)| screened.products[*i]).collect(),
        bases: order
            .iter()
            .map(|(_, i)| screened.bases[*i].clone())
            .collect(),
        columns: order
            .iter()
            .map(|(_, i)| screened.columns[*i].clone())
            .collect(),
        ..screened
    }
}

/// The likeliest at the likeliest noise of the biases, or without any: what is taken for noise may be what they explain.
fn best(products: &[Product], levels: &[Level]) -> Vec<usize> {
    let nothing = levels
        .first()
        .map_or(0.0, |level| level.whitened.log_likelihood());
    let of = |p: &Product| {
        let own = levels
            .iter()
            .enumerate()
            .filter(|(k, level)| *k == 0 || (level.is_for(p.sensor) && level.is_without_noise()));
        let each = own.map(|(_, level)| {
            let gained = 2.0 * (level.whitened.log_likelihood() - nothing);
            let basis = p.basis(&level.whitened);
            log_tail(
                (gained + statistic(&basis, &level.whitened)).max(0.0),
                basis.ncols() as f64,
            )
        });
        each.fold(0.0, f64::min)
    };
    let mut all: Vec<(f64, usize)> = products.iter().map(of).zip(0..).collect();
    all.sort_by(|a, b| a.0.total_cmp(&b.0));
    all.into_iter().take(KEPT.get()).map(|(_, k)| k).collect()
}

/// `|Uᵀ z|²` of orthonormal columns.
fn statistic(basis: &Mat<f64>, whitened: &Whitened) -> f64 {
    (basis.transpose() * &whitened.z).squared_norm_l2()
}

fn log_p(basis: &Mat<f64>, whitened: &Whitened) -> f64 {
    log_tail(statistic(basis, whitened), basis.ncols() as f64)
}

/// The level at which the data are likeliest with the best product for it.
fn likeliest(products: &[Product], kept: &[usize], levels: &[Level]) -> Option<usize> {
    let of = |level: &Level| {
        let own = kept.iter().map(|k| &products[*k]);
        let own = own.filter(|p| level.is_for(p.sensor));
        let gains = own.map(|p| 0.5 * statistic(&p.basis(&level.whitened), &level.whitened));
        level.whitened.log_likelihood() + gains.fold(0.0, f64::max)
    };
    (0..levels.len()).max_by(|a, b| of(&levels[*a]).total_cmp(&of(&levels[*b])))
}

/// Returns true if two spaces of orthonormal columns (`q × p`) share most of the smaller one.
fn alike(one: &Mat<f64>, other: &Mat<f64>) -> bool {
    let rank = one.ncols().min(other.ncols()).max(1) as f64;
    (one.transpose() * other).squared_norm_l2() > ALIKE.get() * rank
}
