//! Residuals and columns under noise that is passed on along lines of stations, and under errors of few columns.
//!
//! `r ~ N(J x, I + Σ θ_c C_c)`. Columns of `J` that reach a few stations only, as those of the directions, are passed on too, with
//! a variance that holds nothing: what is left of `J` are the parameters of the models. What is passed on (`C_c` a [`Chain`](super::chain::Chain)) is factored station by station. An error of columns
//! `C_c = U Uᵀ` is fitted beside `J` instead, held by its variance (Henderson's mixed model equations, Henderson 1975, Biometrics 31):
//! with `X = [J, √θ U]` and `D` the identity on `U`, `|V| |JᵀV⁻¹J| = |V₀| |XᵀV₀⁻¹X + D|`. No matrix is larger than
//! the columns of one recording.

mod slopes;

pub use self::slopes::Slopes;

use std::ops::Range;
use std::sync::Arc;

use faer::{Mat, MatRef};

use super::chain::Chain;
use super::sequence::{Factor, Sequence};
use super::stations::Stations;
use super::weights::{Component, Form};
use crate::methods::joint::blocks::arrow::{Arrow, ArrowFactor, Places, lower_gram};
use crate::methods::joint::blocks::columns::Columns;

findings::tuning! {
    /// Columns of unit length of which others leave less than this, as a square, depend on them.
    DEPENDENT: f64 = 1e-11;

    /// A column that reaches no more than one in so many stations of a recording is passed on as well, ...
    SHARE: usize = 4;
    /// ... and one that reaches no more than so many.
    FEW: usize = 8;

    /// The variance of what is passed on and may be of any size, of columns of unit length: what it leaves free of them is nothing, and
    /// half of the digits stay.
    ANY_SIZE: f64 = 1e8;

    /// Errors of columns are at least so large, as the square of what they do to a row: their derivative at zero is that there.
    LEAST_SQUARE: f64 = 1e-7;
}

/// The problem, cut into lines.
#[derive(Clone, Debug)]
pub struct Mixed {
    lines: Vec<Line>,
    places: Arc<Places>,
    /// Number of columns `n`, those of errors included.
    columns: usize,
    kinds: Vec<Kind>,
    /// Columns that others explain.
    dropped: Vec<usize>,
}

/// Treatment of a component.
#[derive(Clone, Debug)]
enum Kind {
    /// Covariance that is passed on from station to station.
    Passed,
    /// Columns fitted beside the Jacobian, with the least variance of their coefficients.
    Columns(Range<usize>, f64),
}

/// The rows of one line of stations.
#[derive(Clone, Debug)]
struct Line {
    recording: usize,
    /// The columns that are not zero here.
    columns: Vec<usize>,
    /// Their values and the residuals (`k × (c + 1)`), row by row.
    bordered: Vec<f64>,
    sequence: Sequence,
}

/// A line at some variances.
#[derive(Clone, Debug)]
pub struct Part {
    factor: Factor,
    /// `L⁻¹ [X r]`, errors' columns of unit size.
    whitened: Vec<f64>,
    /// The lower triangle of `[X r]ᵀ V₀⁻¹ [X r]`.
    gram: Mat<f64>,
}

/// Sums over lines.
#[derive(Clone, Debug)]
pub struct Sum {
    /// `XᵀV₀⁻¹X`.
    normal: Arrow,
    /// `XᵀV₀⁻¹r`.
    right: Vec<f64>,
    /// `rᵀV₀⁻¹r`.
    square: f64,
    /// `ln |V₀|`.
    log_determinant: f64,
}

/// The restricted likelihood at some variances.
pub struct At {
    /// `−½ (ln |V| + ln |JᵀV⁻¹J| + rᵀ P r)`, up to a constant.
    pub log_likelihood: f64,
    parts: Vec<Part>,
    factor: ArrowFactor,
    /// The columns' coefficients.
    solution: Vec<f64>,
}

impl Mixed {
    /// Builds the problem from residuals (`m`), a Jacobian (`m × n`, in the rows of the recordings) and components of
    /// noise, all whitened by the white noise.
    pub fn new(residuals: &[f64], jacobian: &Columns, components: &[&Component]) -> Self {
        let mut unit = jacobian.clone();
        let norms = jacobian.norms().into_iter();
        unit.divide(
            &norms
                .map(|n| if n > 0.0 { n } else { 1.0 })
                .collect::<Vec<_>>(),
        );
        let mut chains: Vec<Option<&Chain>> = components.iter().map(|c| c.form.chain()).collect();
        let stations = match chains.iter().flatten().next() {
            Some(chain) => chain.stations().clone(),
            None => Stations::single(jacobian.groups()),
        };
        let (local, wide) = apart(&unit, &stations);
        let mut passed = unit.select(&local);
        passed.scale(ANY_SIZE.get().sqrt());
        let passed = Chain::of_columns(&stations, &passed);
        chains.push(Some(&passed));
        let mut all = unit.select(&wide);
        let mut kinds = Vec::new();
        for component in components {
            kinds.push(match &component.form {
                Form::Passed(_) => Kind::Passed,
                Form::Columns(own) => {
                    let first = all.ncols();
                    all = all.beside(own);
                    let largest = own.norms().into_iter().fold(f64::MIN_POSITIVE, f64::max);
                    Kind::Columns(first..all.ncols(), LEAST_SQUARE.get() / (largest * largest))
                }
            });
        }
        let line = |line: Range<usize>| Line::new(&stations, line, &chains, &all, residuals);
        let lines = stations.lines().into_iter().map(line);
        let mut mixed = Self {
            lines: lines.collect(),
            places: Arc::new(Places::of(&all)),
            columns: all.ncols(),
            kinds,
            dropped: Vec::new(),
        };
        mixed.drop_dependent(wide.len());
        mixed
    }

    /// Takes out those of the first `count` columns that others of them explain under white noise.
    fn drop_dependent(&mut self, count: usize) {
        let none = vec![0.0; self.kinds.len()];
        let mut sum = self.nothing();
        for line in &self.lines {
            if let Some(part) = line.part(&none) {
                let own = line.columns.partition_point(|&column| column < count);
                let columns = &line.columns[..own];
                sum.normal.add(line.recording, columns, &part.gram);
            }
        }
        // Errors are held by their variance.
        (count..self.columns).for_each(|k| sum.normal.add_diagonal(k, 1.0));
        let dependent = sum.normal.dependent(DEPENDENT.get());
        let lines = self.lines.iter_mut();
        lines.for_each(|line| line.drop_columns(&dependent));
        self.dropped = dependent;
    }

    /// Number of lines.
    pub fn lines(&self) -> usize {
        self.lines.len()
    }

    /// Number of components.
    pub fn components(&self) -> usize {
        self.kinds.len()
    }

    /// Products that one evaluation takes, in rows times columns squared.
    pub fn work(&self) -> f64 {
        let of = |line: &Line| line.sequence.rows() as f64 * (line.columns.len() as f64).powi(2);
        self.lines.iter().map(of).sum()
    }

    /// Returns true if the part of a line depends on a component.
    pub fn feels(&self, line: usize, component: usize) -> bool {
        self.lines[line].sequence.feels(component)
    }

    /// A line at some variances; `None` where the covariance is not positive.
    pub fn part(&self, line: usize, theta: &[f64]) -> Option<Part> {
        self.lines[line].part(theta)
    }

    /// Returns the sum over no lines.
    pub fn nothing(&self) -> Sum {
        Sum {
            normal: Arrow::zeros(&self.places),
            right: vec![0.0; self.columns],
            square: 0.0,
            log_determinant: 0.0,
        }
    }

    /// Adds a line.
    pub fn add(&self, sum: &mut Sum, line: usize, part: &Part, theta: &[f64]) {
        let line = &self.lines[line];
        let scales = self.scales(theta);
        let last = line.columns.len();
        let mut gram = part.gram.clone();
        let own: Vec<f64> = line.columns.iter().map(|&k| scales[k]).collect();
        if own.iter().any(|s| *s != 1.0) {
            for k in 0..last {
                for i in k..last {
                    gram[(i, k)] *= own[i] * own[k];
                }
                gram[(last, k)] *= own[k];
            }
        }
        sum.normal.add(line.recording, &line.columns, &gram);
        for (k, &column) in line.columns.iter().enumerate() {
            sum.right[column] += gram[(last, k)];
        }
        sum.square += gram[(last, last)];
        sum.log_determinant += part.factor.log_determinant;
    }

    /// The log-likelihood of a sum of all lines, and what it was worked out by; `None` where that is no number.
    fn solved(&self, mut sum: Sum) -> Option<(f64, ArrowFactor, Vec<f64>)> {
        let dropped = self.dropped.iter();
        dropped.for_each(|&k| sum.normal.add_diagonal(k, 1.0));
        for kind in &self.kinds {
            if let Kind::Columns(columns, _) = kind {
                columns
                    .clone()
                    .for_each(|k| sum.normal.add_diagonal(k, 1.0));
            }
        }
        let factor = sum.normal.factor(0.0)?;
        let solution = factor.solve(&sum.right);
        let explained = solution.iter().zip(&sum.right).map(|(x, r)| x * r);
        let square = sum.square - explained.sum::<f64>();
        let pivots: f64 = factor.pivots().map(|pivot| 2.0 * pivot.ln()).sum();
        let log_likelihood = -0.5 * (sum.log_determinant + pivots + square);
        (!log_likelihood.is_nan()).then_some((log_likelihood, factor, solution))
    }

    /// The log-likelihood of a sum of all lines.
    pub fn log_likelihood(&self, sum: Sum) -> f64 {
        let solved = self.solved(sum);
        solved.map_or(f64::NEG_INFINITY, |(log_likelihood, ..)| log_likelihood)
    }

    /// The likelihood at some variances.
    pub fn at(&self, theta: &[f64]) -> Option<At> {
        let parts: Option<Vec<Part>> = self.lines.iter().map(|line| line.part(theta)).collect();
        let parts = parts?;
        let mut sum = self.nothing();
        for (line, part) in parts.iter().enumerate() {
            self.add(&mut sum, line, part, theta);
        }
        let (log_likelihood, factor, solution) = self.solved(sum)?;
        Some(At {
            log_likelihood,
            parts,
            factor,
            solution,
        })
    }

    /// By what every column is multiplied.
    fn scales(&self, theta: &[f64]) -> Vec<f64> {
        let mut scales = vec![1.0; self.columns];
        for (kind, variance) in self.kinds.iter().zip(theta) {
            if let Kind::Columns(columns, least) = kind {
                scales[columns.clone()].fill(variance.max(*least).sqrt());
            }
        }
        scales
    }
}

/// The columns that reach few stations of one recording, and the others.
fn apart(columns: &Columns, stations: &Stations) -> (Vec<usize>, Vec<usize>) {
    let mut station_of = vec![0; columns.nrows()];
    for (k, station) in stations.all().iter().enumerate() {
        station.rows.clone().for_each(|row| station_of[row] = k);
    }
    let mut most = vec![FEW.get(); stations.all().len()];
    for line in stations.lines() {
        most[line.clone()].fill(FEW.get().max(line.len() / SHARE.get()));
    }
    let parts_of = columns.parts_of();
    let mut reach: Vec<Option<(usize, usize)>> = vec![None; columns.ncols()];
    for part in columns.parts() {
        for (k, &column) in part.columns.iter().enumerate() {
            for (i, row) in part.rows.iter().enumerate() {
                if part.values[(i, k)] != 0.0 {
                    let at = station_of[*row];
                    let (first, last) = reach[column].unwrap_or((at, at));
                    reach[column] = Some((first.min(at), last.max(at)));
                }
            }
        }
    }
    (0..columns.ncols()).partition(|&k| {
        parts_of[k] == 1 && reach[k].is_some_and(|(first, last)| last + 1 - first <= most[first])
    })
}

impl Line {
    fn new(
        stations: &Stations,
        line: Range<usize>,
        chains: &[Option<&Chain>],
        all: &Columns,
        residuals: &[f64],
    ) -> Self {
        let own = &stations.all()[line.clone()];
        let rows: Vec<usize> = own.iter().flat_map(|s| s.rows.clone()).collect();
        let recording = rows.first().map_or(0, |&row| all.groups().of(row));
        let part = &all.parts()[recording];
        let places = rows
            .iter()
            .filter_map(|row| part.rows.binary_search(row).ok());
        let places: Vec<usize> = places.collect();
        let used: Vec<usize> = (0..part.columns.len())
            .filter(|&k| places.iter().any(|&i| part.values[(i, k)] != 0.0))
            .collect();
        let mut bordered = Vec::with_capacity(rows.len() * (used.len() + 1));
        for (&row, &i) in rows.iter().zip(&places) {
            bordered.extend(used.iter().map(|&k| part.values[(i, k)]));
            bordered.push(residuals[row]);
        }
        Self {
            recording,
            columns: used.into_iter().map(|k| part.columns[k]).collect(),
            bordered,
            sequence: Sequence::new(chains, line),
        }
    }

    fn drop_columns(&mut self, dropped: &[usize]) {
        let width = self.columns.len() + 1;
        let is_kept = |k: &usize| dropped.binary_search(&self.columns[*k]).is_err();
        let kept: Vec<usize> = (0..width - 1).filter(is_kept).collect();
        if kept.len() + 1 < width {
            let rows = self.bordered.chunks_exact(width);
            let own = |row: &[f64]| {
                let values = kept.iter().map(|&k| row[k]).chain([row[width - 1]]);
                values.collect::<Vec<_>>()
            };
            self.bordered = rows.flat_map(own).collect();
            self.columns = kept.into_iter().map(|k| self.columns[k]).collect();
        }
    }

    fn part(&self, theta: &[f64]) -> Option<Part> {
        // What is passed on and may be of any size is the last.
        let factor = self.sequence.factor(&[theta, &[1.0]].concat())?;
        let mut whitened = self.bordered.clone();
        let width = self.columns.len() + 1;
        self.sequence.whiten(&factor, &mut whitened, width);
        let rows = MatRef::from_row_major_slice(&whitened, self.sequence.rows(), width);
        let gram = lower_gram(rows);
        Some(Part {
            factor,
            whitened,
            gram,
        })
    }
}
