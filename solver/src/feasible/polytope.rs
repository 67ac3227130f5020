//! Constraints in the free parameters.

use crate::constraints::{Constraint, Constraints};
use crate::error::Error;
use crate::linear::vector::{add, dot, norm, scaled_norm, unscaled};
use crate::parameters::{Mask, Parameters};

/// Relative rounding of `a · z` within which a constraint counts as met or as active.
const ROUNDING: f64 = 1e-12;

/// Relative rounding of a step onto a limit, which is all that is left of it at a limit of zero.
const STEP_ROUNDING: f64 = 64.0 * f64::EPSILON;

/// `lower ≤ A z ≤ upper` over the free parameters, the fixed ones moved to the limits.
#[derive(Clone, Debug)]
pub(crate) struct Polytope {
    rows: Vec<Row>,
}

/// One constraint.
#[derive(Clone, Debug)]
pub(crate) struct Row {
    /// Coefficients of the free parameters (`n`).
    pub a: Vec<f64>,
    /// Limits of `a · z`.
    pub lower: f64,
    /// Limits of `a · z`.
    pub upper: f64,
    /// The only free parameter, where there is only one.
    single: Option<usize>,
    /// Contribution of the fixed parameters.
    fixed: f64,
    /// The constraint as the user wrote it.
    source: Constraint,
}

/// The limit a constraint is held at.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Side {
    /// At its lower limit; the multiplier keeps its sign.
    Lower,
    /// At its upper limit.
    Upper,
    /// An equality.
    Both,
}

/// A constraint held at a limit.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct Active {
    /// Number of the constraint.
    pub row: usize,
    /// At which limit.
    pub side: Side,
}

impl Side {
    /// `−1` where the set lies against the constraint's normal, 1 elsewhere.
    pub fn sign(self) -> f64 {
        if self == Self::Upper { -1.0 } else { 1.0 }
    }
}

impl Row {
    fn new(source: &Constraint, start: &Parameters, mask: &Mask) -> Result<Self, Error> {
        let ordered = source.lower <= source.upper
            && source.lower < f64::INFINITY
            && source.upper > f64::NEG_INFINITY;
        if !ordered || source.terms.iter().any(|(_, c)| !c.is_finite()) {
            return Err(source.empty());
        }
        let free = mask.free_indices();
        let (mut a, mut fixed) = (vec![0.0; free.len()], 0.0);
        for (name, c) in &source.terms {
            let k = start
                .index(name)
                .ok_or_else(|| Error::UnknownParameter { name: name.clone() })?;
            match free.iter().position(|&f| f == k) {
                Some(column) => a[column] += c,
                None => fixed += c * start.values()[k],
            }
        }
        let mut used = (0..a.len()).filter(|&k| a[k] != 0.0);
        let single = used.next().filter(|_| used.next().is_none());
        let (lower, upper) = (source.lower - fixed, source.upper - fixed);
        Ok(Self {
            a,
            lower,
            upper,
            single,
            fixed,
            source: source.clone(),
        })
    }

    /// The size of the terms of `a · z`, to measure rounding by.
    fn size(&self, z: &[f64]) -> f64 {
        self.a
            .iter()
            .zip(z)
            .map(|(a, z)| (a * z).abs())
            .sum::<f64>()
            + self.fixed.abs()
    }

    /// The limits in terms of the only free parameter.
    fn interval(&self, k: usize) -> (f64, f64) {
        let (a, b) = (self.lower / self.a[k], self.upper / self.a[k]);
        (a.min(b), a.max(b))
    }

    fn is_met(&self, z: &[f64]) -> bool {
        self.is_met_within(z, ROUNDING * self.size(z))
    }

    /// True where the end `z` of a step of scaled length `‖D p‖` meets it; near a limit of zero the
    /// rounding is that of the step, all of whose entries may have gone into each.
    fn is_met_after(&self, z: &[f64], scale: &[f64], length: f64) -> bool {
        let rounding = STEP_ROUNDING * self.reach(scale, length);
        self.is_met_within(z, ROUNDING * self.size(z) + rounding)
    }

    /// Most by which `a · z` changes over steps `‖D p‖ ≤ length`.
    fn reach(&self, scale: &[f64], length: f64) -> f64 {
        norm(&unscaled(&self.a, scale)) * length
    }

    fn is_met_within(&self, z: &[f64], tolerance: f64) -> bool {
        let value = dot(&self.a, z);
        value >= self.lower - tolerance && value <= self.upper + tolerance
    }

    /// The limit that `z` touches, to rounding of `z` and of steps `‖D p‖ ≤ length`.
    fn touched(&self, z: &[f64], scale: &[f64], length: f64) -> Option<Side> {
        let value = dot(&self.a, z);
        let tolerance = ROUNDING * self.size(z) + STEP_ROUNDING * self.reach(scale, length);
        if self.upper - self.lower <= tolerance {
            Some(Side::Both)
        } else if value - self.lower <= tolerance {
            Some(Side::Lower)
        } else if self.upper - value <= tolerance {
            Some(Side::Upper)
        } else {
            None
        }
    }
}

impl Polytope {
    /// The constraints on the free parameters, `None` if there are none.
    pub fn new(
        constraints: &Constraints,
        start: &Parameters,
        mask: &Mask,
    ) -> Result<Option<Self>, Error> {
        let rows = constraints
            .rows()
            .iter()
            .map(|row| Row::new(row, start, mask));
        let rows: Vec<Row> = rows.collect::<Result<_, _>>()?;
        Ok((!rows.is_empty()).then_some(Self { rows }))
    }

    /// All constraints.
    pub fn rows(&self) -> &[Row] {
        &self.rows
    }

    /// The error that names the first constraint that `z` does not meet.
    pub fn check(&self, z: &[f64]) -> Result<(), Error> {
        match self.rows.iter().find(|row| !row.is_met(z)) {
            None => Ok(()),
            Some(row) => Err(Error::StartInfeasible {
                constraint: row.source.in_words(),
                value: dot(&row.a, z) + row.fixed,
                lower: row.source.lower,
                upper: row.source.upper,
            }),
        }
    }

    /// True where `z` meets every constraint, to rounding.
    pub fn contains(&self, z: &[f64]) -> bool {
        self.rows.iter().all(|row| row.is_met(z))
    }

    /// The first constraint that the end of a step `p` from `z` does not meet, to rounding of `z` and
    /// of `D p`, and the limit it passes.
    pub fn violated(&self, z: &[f64], p: &[f64], scale: &[f64]) -> Option<Active> {
        let (z, length) = (add(z, 1.0, p), scaled_norm(p, scale));
        let row = self
            .rows
            .iter()
            .position(|row| !row.is_met_after(&z, scale, length))?;
        let below = dot(&self.rows[row].a, &z) < self.rows[row].lower;
        Some(Active {
            row,
            side: if below { Side::Lower } else { Side::Upper },
        })
    }

    /// The constraints that `z` touches, to rounding of `z` and of steps `‖D p‖ ≤ length`: of `z`
    /// alone nothing is left next to a limit of zero.
    pub fn touching(&self, z: &[f64], scale: &[f64], length: f64) -> Vec<Active> {
        let rows = self.rows.iter().enumerate();
        rows.filter_map(|(row, r)| {
            let side = r.touched(z, scale, length)?;
            Some(Active { row, side })
        })
        .collect()
    }

    /// Largest amount by which a constraint is not met.
    pub fn violation(&self, z: &[f64]) -> f64 {
        let each = self.rows.iter().map(|row| {
            let value = dot(&row.a, z);
            (row.lower - value).max(value - row.upper)
        });
        each.fold(0.0, f64::max)
    }

    /// Puts parameters within rounding of a bound of their own exactly on it: the rounding of the
    /// bound, of the step `p` that led here and of steps `‖D p‖ ≤ length`.
    pub fn settle(&self, z: &mut [f64], p: &[f64], scale: &[f64], length: f64) {
        for row in &self.rows {
            let Some(k) = row.single else { continue };
            let (lower, upper) = row.interval(k);
            let rounding = STEP_ROUNDING * (p[k].abs() + length / scale[k]);
            let near = |bound: f64| {
                bound.is_finite() && (z[k] - bound).abs() <= ROUNDING * bound.abs() + rounding
            };
            let value = if near(lower) {
                lower
            } else if near(upper) {
                upper
            } else {
                z[k]
            };
            z[k] = value.max(lower).min(upper);
        }
    }

    /// The value `a · z` is held at.
    pub fn limit(&self, active: Active) -> f64 {
        let row = &self.rows[active.row];
        if active.side == Side::Upper {
            row.upper
        } else {
            row.lower
        }
    }

    /// A constraint in words and its limit, as the user wrote them.
    pub fn describe(&self, active: Active) -> (String, f64) {
        let source = &self.rows[active.row].source;
        (
            source.in_words(),
            if active.side == Side::Upper {
                source.upper
            } else {
                source.lower
            },
        )
    }
}
