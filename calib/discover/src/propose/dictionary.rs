//! Candidate terms of an unexplained error: products of covariates.

use std::collections::{HashMap, HashSet};
use std::f64::consts::LN_2;

use faer::{Mat, MatRef};
use nalgebra::{DMatrix, Matrix2x3};
use sensor::{Axis, Covariate, Kinematics, Quantity, Sensor, Term};
use statrs::function::factorial::ln_binomial;

use crate::noise::projected::Whitened;
use crate::state::State;

/// Factors of a product, at most: three covariates, or one to the fourth power.
const FACTORS: usize = 4;

findings::tuning! {
    /// A column of which the model's parameters leave less than this share is theirs.
    LEFT: f64 = 1e-3;

    /// Directions of a group that hold less than this share of the largest are not seen.
    UNSEEN: f64 = 1e-4;
}

/// Factors of a product, each a covariate with its power.
pub type Factors = Vec<(Covariate, u32)>;

/// One form of an error with a coefficient for each axis of one sensor: the same product of covariates on every axis, as `e_i = c_i wx fy`,
/// or the product that goes with the axis, as `e_i = c_i w_i f_(i+1)`.
#[derive(Clone, Debug)]
pub struct Product {
    /// The sensor that would read it.
    pub sensor: Sensor,
    /// The axes on which the data can see it, with the factors there.
    pub parts: Vec<(Axis, Factors)>,
    /// `Nᵀ ∂r/∂c` of those axes (`q × axes`), in unit length.
    pub columns: Mat<f64>,
    /// Lengths that the columns were divided by.
    pub lengths: Vec<f64>,
}

impl Product {
    /// Returns the complexity of the product: its degree, and more than that of any polynomial where it has a size or a
    /// history.
    pub fn degree(&self) -> u32 {
        let of = |(covariate, power): &(Covariate, u32)| match covariate {
            Covariate::SpecificForce(_)
            | Covariate::AngularRate(_)
            | Covariate::AngularAcceleration(_)
            | Covariate::Time
            | Covariate::TemperatureChange => *power,
            _ => power + FACTORS as u32,
        };
        let first = self.parts.first();
        first.map_or(0, |(_, factors)| factors.iter().map(of).sum())
    }

    /// The term on the axis in place `k`, where the coefficient of the column of unit length is `coefficient`.
    pub fn term(&self, k: usize, coefficient: f64) -> Term {
        let (axis, factors) = &self.parts[k];
        Term::new(*axis, factors, coefficient / self.lengths[k])
    }

    /// An orthonormal basis (`q × rank`) of the whitened columns.
    pub fn basis(&self, whitened: &Whitened) -> Mat<f64> {
        seen_directions(whitened.columns(&self.columns).as_ref())
    }
}

/// An orthonormal basis (`q × rank`) of the directions of whitened columns that are seen.
pub fn seen_directions(w: MatRef<'_, f64>) -> Mat<f64> {
    let gram = w.transpose() * w;
    let gram = DMatrix::from_fn(w.ncols(), w.ncols(), |i, j| gram[(i, j)]);
    let eigen = gram.symmetric_eigen();
    let least = UNSEEN.get() * eigen.eigenvalues.max();
    let seen: Vec<usize> = (0..w.ncols())
        .filter(|&k| eigen.eigenvalues[k] > least)
        .collect();
    let mix = Mat::from_fn(w.ncols(), seen.len(), |i, k| {
        eigen.eigenvectors[(i, seen[k])] / eigen.eigenvalues[seen[k]].sqrt()
    });
    w * mix
}

/// `ln` of the number of formulas like one of so many products with so many terms: those of as many products, each on any of its axes, or those
/// of as many terms, whichever are fewer; twice that, for the two ways to count.
pub fn log_formulas(products: &[Product], count: usize, terms: usize) -> f64 {
    let axes = ((1u32 << Axis::ALL.len()) - 1) as f64;
    let of_products = ln_binomial(products.len() as u64, count as u64) + count as f64 * axes.ln();
    let parts = products.iter();
    let parts = parts.flat_map(|p| p.parts.iter().map(move |part| (p.sensor, part)));
    let distinct = parts.collect::<HashSet<_>>().len();
    let of_terms = ln_binomial(distinct as u64, terms as u64);
    of_products.min(of_terms) + LN_2
}

/// Every product of specific force, rate, angular acceleration, temperature and time, every size of a force or a rate, alone
/// or beside one, every history alone, and every covariate to the fourth power, that the model of `state` does not hold already and the data can
/// see: with the same factors on every axis, and with those that go with the axis.
pub fn dictionary(state: &State) -> Vec<Product> {
    let force = Axis::ALL.map(Covariate::SpecificForce);
    let rate = Axis::ALL.map(Covariate::AngularRate);
    let acceleration = Axis::ALL.map(Covariate::AngularAcceleration);
    let slow = [Covariate::Time, Covariate::TemperatureChange];
    let sizes = Axis::ALL.map(Covariate::ForceSize);
    // Of the accelerometer rests are compared only: nothing turns there.
    let offered = Offered {
        first: 3,
        powers: [&force[..], &slow].concat(),
        sizes: sizes.to_vec(),
        history: history(),
    };
    let mut all = products(state, Sensor::Accelerometer, &offered);
    if state.fit.has_gyroscope() {
        let turning = Axis::ALL.map(Covariate::RateSize);
        let offered = Offered {
            first: 6,
            powers: [&force[..], &rate, &acceleration, &slow].concat(),
            sizes: [&sizes[..], &turning].concat(),
            history: history(),
        };
        all.extend(products(state, Sensor::Gyroscope, &offered));
    }
    all
}

/// The products that go with the axis, of the signal of the sensor and of what else an effect with these `needs` looks at: force, rate,
/// time, temperature.
pub fn forms_of(state: &State, sensor: Sensor, needs: &[Quantity]) -> Vec<Product> {
    let looks_at = |quantity| needs.contains(&quantity) || quantity == Quantity::signal_of(sensor);
    let (mut signals, mut sizes, mut slow) = (Vec::new(), Vec::new(), Vec::new());
    if looks_at(Quantity::SpecificForce) {
        signals.extend(Axis::ALL.map(Covariate::SpecificForce));
        sizes.extend(Axis::ALL.map(Covariate::ForceSize));
    }
    if looks_at(Quantity::AngularRate) {
        signals.extend(Axis::ALL.map(Covariate::AngularRate));
        sizes.extend(Axis::ALL.map(Covariate::RateSize));
    }
    if looks_at(Quantity::Time) {
        slow.push(Covariate::Time);
    }
    if looks_at(Quantity::Temperature) {
        slow.push(Covariate::TemperatureChange);
    }
    let offered = Offered {
        first: signals.len(),
        powers: [signals, slow].concat(),
        sizes,
        history: Vec::new(),
    };
    let mut all = products(state, sensor, &offered);
    let goes_with_axis = |product: &Product| {
        let mut parts = product.parts.windows(2);
        product.parts.len() == Axis::ALL.len() && parts.all(|pair| pair[0].1 != pair[1].1)
    };
    all.retain(goes_with_axis);
    all
}

/// Covariates that products are built from.
struct Offered {
    /// Covariates of products with up to three factors.
    powers: Vec<Covariate>,
    /// So many of them, the first ones, stand beside a size too.
    first: usize,
    /// Stand alone or beside one of those.
    sizes: Vec<Covariate>,
    /// Stand alone.
    history: Vec<Covariate>,
}

impl Offered {
    fn covariates(&self) -> Vec<Covariate> {
        [&self.powers[..], &self.sizes, &self.history].concat()
    }

    fn choices(&self) -> Vec<[usize; FACTORS]> {
        let mut all = choices(self.powers.len());
        all.extend((1..=self.powers.len()).map(|one| [one; FACTORS]));
        let (first, last) = (self.powers.len(), self.powers.len() + self.sizes.len());
        for size in first + 1..=last {
            all.extend((0..=self.first).map(|beside| [0, 0, beside, size]));
        }
        all.extend((last + 1..=last + self.history.len()).map(|one| [0, 0, 0, one]));
        all
    }
}

/// Lists the covariates of history (last change of force, last turn, time since it, change of temperature) and vibration.
fn history() -> Vec<Covariate> {
    let triads = [
        Covariate::LastChange,
        Covariate::LastTurn,
        Covariate::Vibration,
    ];
    let triads = triads.into_iter().flat_map(|kind| Axis::ALL.map(kind));
    triads
        .chain([
            Covariate::SinceTurn,
            Covariate::TemperatureRate,
            Covariate::Warming,
        ])
        .collect()
}

fn products(state: &State, sensor: Sensor, offered: &Offered) -> Vec<Product> {
    let (covariates, choices) = (&offered.covariates(), offered.choices());
    let columns = state.whitened(columns(state, sensor, covariates, &choices));
    let projected = state.projected.columns(columns.as_ref());
    let length = projected.as_ref().col_iter().map(|column| column.norm_l2());
    let length: Vec<f64> = length.collect();
    let whole = columns.as_ref().col_iter().map(|column| column.norm_l2());
    let is_seen: Vec<bool> = whole
        .zip(&length)
        .map(|(whole, left)| *left > LEFT.get() * whole)
        .collect();
    let product = |group: [usize; 3]| {
        let axes = (0..3).map(|axis| (axis, group[axis], 3 * group[axis] + axis));
        let axes: Vec<_> = axes.filter(|(_, _, column)| is_seen[*column]).collect();
        let part = |&(axis, g, _): &(usize, usize, usize)| {
            (Axis::ALL[axis], factors(covariates, &choices[g]))
        };
        (!axes.is_empty()).then(|| Product {
            sensor,
            parts: axes.iter().map(part).collect(),
            columns: Mat::from_fn(projected.nrows(), axes.len(), |i, k| {
                let column = axes[k].2;
                projected[(i, column)] / length[column]
            }),
            lengths: axes.iter().map(|(_, _, column)| length[*column]).collect(),
        })
    };
    let same_on_all = (0..choices.len()).map(|g| [g; 3]);
    let of_the_axis = with_the_axis(covariates, &choices);
    same_on_all.chain(of_the_axis).filter_map(product).collect()
}

/// For every choice the places of itself and of those that it becomes where all its axes go to the next one, and to the one after;
/// none for a choice that stays the same.
fn with_the_axis(
    covariates: &[Covariate],
    choices: &[[usize; FACTORS]],
) -> impl Iterator<Item = [usize; 3]> {
    let place = |covariate: Covariate| covariates.iter().position(|own| *own == covariate);
    let next: Vec<usize> = std::iter::once(Some(0))
        .chain(
            covariates
                .iter()
                .map(|c| Some(place(c.on_next_axis())? + 1)),
        )
        .map(|place| place.unwrap_or(0))
        .collect();
    let places: HashMap<[usize; FACTORS], usize> =
        choices.iter().enumerate().map(|(g, c)| (*c, g)).collect();
    let turned = |choice: &[usize; FACTORS]| {
        let mut turned = choice.map(|k| next[k]);
        turned.sort_unstable();
        turned
    };
    let orbit = |(g, choice): (usize, &[usize; FACTORS])| {
        let second = turned(choice);
        let third = turned(&second);
        let group = [g, *places.get(&second)?, *places.get(&third)?];
        (second != *choice).then_some(group)
    };
    let orbits: Vec<[usize; 3]> = choices.iter().enumerate().filter_map(orbit).collect();
    orbits.into_iter()
}

/// All ways to take one to three of `n` things, the same again or not; `0` stands for none, `k + 1` for the `k`th.
fn choices(n: usize) -> Vec<[usize; FACTORS]> {
    let mut all = Vec::new();
    for c in 1..=n {
        for b in 0..=c {
            for a in 0..=b {
                all.push([0, a, b, c]);
            }
        }
    }
    all
}

fn factors(covariates: &[Covariate], choice: &[usize]) -> Vec<(Covariate, u32)> {
    let mut factors: Vec<(Covariate, u32)> = Vec::new();
    for k in choice.iter().filter_map(|k| k.checked_sub(1)) {
        match factors.iter_mut().find(|(c, _)| *c == covariates[k]) {
            Some((_, power)) => *power += 1,
            None => factors.push((covariates[k], 1)),
        }
    }
    factors
}

/// `∂r/∂c` (`m × 3 n`) of every product on x, y and z. As [`error_columns`], but what a turn adds up is the same
/// for the three axes.
///
/// [`error_columns`]: estimate::methods::joint::error_columns
fn columns(
    state: &State,
    sensor: Sensor,
    covariates: &[Covariate],
    choices: &[[usize; FACTORS]],
) -> Mat<f64> {
    let mut out = Mat::zeros(state.rows(), 3 * choices.len());
    let values = |truth: &Kinematics<f64>| {
        let own = covariates.iter().map(|c| c.value(truth));
        std::iter::once(1.0).chain(own).collect::<Vec<f64>>()
    };
    let product =
        |v: &[f64], choice: &[usize; FACTORS]| -> f64 { choice.iter().map(|k| v[*k]).product() };
    let means = state.sensitivities.means.iter();
    for mean in means.filter(|m| m.sensor == sensor) {
        let v = values(&mean.truth);
        for (g, choice) in choices.iter().enumerate() {
            let shift = mean.by_error * product(&v, choice);
            for axis in 0..3 {
                for i in 0..3 {
                    out[(mean.row + i, 3 * g + axis)] = shift[(i, axis)];
                }
            }
        }
    }
    if sensor == Sensor::Accelerometer {
        return out;
    }
    let mut sums = vec![Matrix2x3::zeros(); choices.len()];
    for turn in &state.sensitivities.turns {
        sums.fill(Matrix2x3::zeros());
        for (by_error, truth) in turn.by_error.iter().zip(&turn.truth) {
            let v = values(truth);
            for (sum, choice) in sums.iter_mut().zip(choices) {
                *sum += by_error * product(&v, choice);
            }
        }
        for (g, sum) in sums.iter().enumerate() {
            for axis in 0..3 {
                for i in 0..2 {
                    out[(turn.row + i, 3 * g + axis)] = sum[(i, axis)];
                }
            }
        }
    }
    out
}

#[cfg(test)]
mod tests {
    use estimate::methods::joint::{Sampling, error_columns};
    use simulate::Spec;

    use super::*;
    use crate::{Extension, Request, Session};

    #[test]
    fn three_of_five_things_can_be_taken_in_fifty_five_ways() {
        // C(5 + 3, 3) less the empty one.
        let all = choices(5);
        assert_eq!(all.len(), 55);
        let force = Axis::ALL.map(Covariate::SpecificForce);
        assert_eq!(
            factors(&force, &[0, 1, 2, 2]),
            [(force[0], 1), (force[1], 2)]
        );
        assert_eq!(factors(&force, &[0, 0, 0, 3]), [(force[2], 1)]);
    }

    #[test]
    fn a_product_goes_with_the_axis_and_one_that_is_the_same_on_all_does_not() {
        let covariates = [
            Axis::ALL.map(Covariate::SpecificForce),
            Axis::ALL.map(Covariate::AngularRate),
        ]
        .concat();
        let all = choices(covariates.len());
        let named = |g: usize| {
            let own = factors(&covariates, &all[g]).into_iter();
            own.map(|(c, _)| c.name()).collect::<Vec<_>>().join(" ")
        };
        let groups: Vec<_> = with_the_axis(&covariates, &all)
            .map(|group| group.map(named))
            .collect();
        assert!(groups.contains(&["fx wy", "fy wz", "fz wx"].map(String::from)));
        assert!(groups.iter().all(|[first, ..]| first != "fx fy fz"));
    }

    #[test]
    fn the_columns_of_a_product_are_those_of_its_error() {
        let spec = Spec::hand_held(3);
        let recordings = [spec.run().unwrap().recording];
        let session = Session::new(&recordings, &Request::new(spec.gravity)).unwrap();
        let state = State::fit(&session, Extension::default()).unwrap();
        let covariates = [
            Covariate::AngularRate(Axis::X),
            Covariate::SpecificForce(Axis::Y),
        ];
        let found = columns(&state, Sensor::Gyroscope, &covariates, &[[0, 1, 1, 2]]);
        let sampling = (Sensor::Gyroscope, Sampling::Every);
        let m = state.rows();
        let expected = error_columns(&state.sensitivities, m, sampling, 3, |instant, out| {
            let truth = instant.truth;
            let value = truth.angular_rate.x.powi(2) * truth.specific_force.y;
            out.extend(Axis::ALL.map(|axis| axis.unit() * value));
        });
        // Sums in the same order, products not.
        assert!((&found - &expected).norm_max() < 1e-12 * expected.norm_max());
    }
}
