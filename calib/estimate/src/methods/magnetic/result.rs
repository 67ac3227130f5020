//! A minimum written down: covariance, fields, and what is left.

use std::ops::Range;

use findings::{Finding, Kind};
use nalgebra::{DMatrix, Vector3};
use recording::Error;
use sensor::{BASE_PARAMETERS, PLACES, Sensor};
use solver::{Block, Products};

use super::disturbed::readings_left;
use super::factors::FIELD;
use super::fitted::{Field, Fitted, MagneticFit, OwnBias};
use super::placement::Placement;
use super::problem::{Minimum, Problem, refused};
use super::start::Start;
use crate::methods::chance;
use crate::methods::small_sample::widening;

findings::tuning! {
    /// The common scale counts as known to this share: far better than any recording tells, and loose enough for the
    /// factorisation.
    TIE: f64 = 1e-7;
}

/// A minimum with the covariance of all but headings and rates.
pub struct Judged<'a> {
    problem: &'a Problem<'a>,
    minimum: &'a Minimum,
    uneven: f64,
    /// Covariance of model, other sensors' errors, fields and own biases, one after the other.
    covariance: Vec<Vec<f64>>,
    /// Reading less model of each placement.
    left: Vec<Vector3<f64>>,
}

impl<'a> Judged<'a> {
    /// Linearises the graph at its minimum.
    ///
    /// # Errors
    /// [`Error::NotEnough`] where the attitudes leave a combination of parameters open.
    pub fn new(
        problem: &'a Problem<'a>,
        start: &Start,
        uneven: f64,
        minimum: &'a Minimum,
    ) -> Result<Self, Error> {
        let graph = problem.graph(start, uneven, TIE.get())?.graph;
        let products = Products::new(&graph, &minimum.report.values).map_err(refused)?;
        if let Some(open) = products.null_space().first() {
            return Err(Error::not_enough(
                Finding::of(Kind::ATTITUDES_LEAVE_OPEN)
                    .of_sensor(Sensor::Magnetometer)
                    .detail("open", open.words.clone()),
            ));
        }
        let blocks = &minimum.blocks;
        let all = [blocks.model, blocks.errors].into_iter();
        let all = all.chain(blocks.fields.iter().copied());
        let all: Vec<Block> = all.chain(blocks.biases.iter().copied()).collect();
        Ok(Self {
            problem,
            minimum,
            uneven,
            covariance: products.covariance(&all),
            left: readings_left(problem, minimum),
        })
    }

    /// Reading less model of each placement, in the unit of the readings.
    pub fn left(&self) -> &[Vector3<f64>] {
        &self.left
    }

    /// The result.
    ///
    /// # Errors
    /// [`Error::NotEnough`] without degrees of freedom.
    pub fn written(&self) -> Result<MagneticFit, Error> {
        let dof = self.freedom();
        if dof == 0 {
            return Err(Error::not_enough(
                Finding::of(Kind::ATTITUDES_TOO_FEW)
                    .of_sensor(Sensor::Magnetometer)
                    .count("count", self.used().count()),
            ));
        }
        // Where the unevenness was estimated, few places say little of it: Student's t.
        let widened = match self.uneven > 0.0 {
            true => widening(dof).powi(2),
            false => 1.0,
        };
        let (model, errors) = (self.model(), self.errors());
        let turns = self.problem.changes.len();
        let squares: f64 = self.used().map(|(_, left)| left.norm_squared()).sum();
        Ok(MagneticFit {
            model: Fitted {
                values: self.values(self.minimum.blocks.model),
                covariance: self.block(&model, &model) * widened,
            },
            errors: Fitted {
                values: self.values(self.minimum.blocks.errors),
                covariance: self.block(&errors, &errors),
            },
            between: self.block(&model, &errors),
            fields: self.fields(widened),
            biases: self.biases(widened),
            unevenness: self.uneven,
            residual_rms: (squares / (3 * self.used().count()) as f64).sqrt(),
            reduced_chi2: self.over_noise() / dof as f64,
            degrees_of_freedom: dof,
            placements: self.problem.placements.to_vec(),
            left: self.left.clone(),
            disturbed: Vec::new(),
            turns_p_value: match turns {
                0 => 1.0,
                _ => chance::of_chi2(self.problem.turns_left(self.minimum), turns as f64),
            },
            rank: model.len() - self.ties(),
            turns,
        })
    }

    fn used(&self) -> impl Iterator<Item = (&Placement, &Vector3<f64>)> {
        let all = self.problem.placements.iter().zip(&self.left);
        all.filter(|(placement, _)| placement.is_used)
    }

    /// `Σ (left / noise)²`, without what the field differs by.
    fn over_noise(&self) -> f64 {
        let of = |(p, left): (&Placement, &Vector3<f64>)| left.norm_squared() / (p.noise * p.noise);
        self.used().map(of).sum()
    }

    /// Readings, turns and ties less parameters, fields and headings.
    fn freedom(&self) -> usize {
        let fields = self.field_coordinates() * self.problem.recordings;
        let known = 3 * self.used().count() + self.problem.changes.len() + self.ties();
        let biases = 3 * self.minimum.blocks.biases.len();
        let unknown = self.model().len() + fields + biases + self.problem.placements.len();
        known.saturating_sub(unknown)
    }

    /// Rows that fix the common scale.
    fn ties(&self) -> usize {
        usize::from(!self.problem.strength_given)
    }

    fn field_coordinates(&self) -> usize {
        if self.problem.strength_given {
            FIELD - 1
        } else {
            FIELD
        }
    }

    fn values(&self, block: Block) -> Vec<f64> {
        self.minimum.report.value(block).to_vec()
    }

    fn model(&self) -> Range<usize> {
        0..self.minimum.report.value(self.minimum.blocks.model).len()
    }

    fn errors(&self) -> Range<usize> {
        let first = self.model().end;
        first..first + self.problem.errors
    }

    fn block(&self, rows: &Range<usize>, columns: &Range<usize>) -> DMatrix<f64> {
        DMatrix::from_fn(rows.len(), columns.len(), |i, j| {
            self.covariance[rows.start + i][columns.start + j]
        })
    }

    /// The bias of every part with its standard errors: `b` of the last and what the others differ by.
    fn biases(&self, widened: f64) -> Vec<OwnBias> {
        let first = self.errors().end + self.field_coordinates() * self.problem.recordings;
        let bias = &self.values(self.minimum.blocks.model)[PLACES.len()..BASE_PARAMETERS];
        let of = |part: usize| {
            let block = self.minimum.blocks.biases.get(part);
            let moved = block.map_or_else(|| vec![0.0; 3], |block| self.values(*block));
            let variance = |axis: usize| {
                let (b, own) = (PLACES.len() + axis, first + 3 * part + axis);
                let c = &self.covariance;
                match block {
                    Some(_) => c[b][b] + 2.0 * c[b][own] + c[own][own],
                    None => c[b][b],
                }
            };
            OwnBias {
                value: [0, 1, 2].map(|axis| bias[axis] + moved[axis]),
                std: [0, 1, 2].map(|axis| (variance(axis) * widened).max(0.0).sqrt()),
            }
        };
        (0..self.problem.parts).map(of).collect()
    }

    fn fields(&self, widened: f64) -> Vec<Field> {
        let std = |k: usize| (self.covariance[k][k] * widened).max(0.0).sqrt();
        let first = self.errors().end;
        let places = (first..).step_by(self.field_coordinates());
        let all = self.minimum.blocks.fields.iter().zip(places);
        let of = |(block, place): (&Block, usize)| {
            let value = self.minimum.report.value(*block);
            let strength = self.problem.strength * value[1].exp();
            Field {
                strength,
                strength_std: (!self.problem.strength_given).then(|| strength * std(place + 1)),
                inclination: value[0],
                inclination_std: std(place),
            }
        };
        all.map(of).collect()
    }
}
