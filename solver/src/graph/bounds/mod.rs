//! Bounds on the numbers of blocks: which there are, which hold, and what they leave of `H`.

mod of_blocks;
pub(crate) mod step;

use super::elimination::structure::{NONE, Structure};
use super::problem::{Block, Graph};
use crate::constraints::ActiveConstraint;
use crate::error::Error;

/// A bounded unknown.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Bound {
    pub unknown: usize,
    /// Its place among the stored values of all blocks.
    pub value: usize,
    pub lower: f64,
    pub upper: f64,
    block: Block,
    coordinate: usize,
}

impl Bound {
    fn name(&self, graph: &Graph<'_>) -> String {
        graph.variables[self.block.number()].coordinate(self.coordinate)
    }

    /// True where the bound holds there: the value lies on it, and the gradient presses it against it. An
    /// equality always does.
    fn holds(&self, values: &[f64], gradient: &[f64]) -> bool {
        let (x, slope) = (values[self.value], gradient[self.unknown]);
        (x <= self.lower && slope >= 0.0)
            || (x >= self.upper && slope <= 0.0)
            || self.lower == self.upper
    }
}

/// The bounds of the free coordinates, in the order of the unknowns.
#[derive(Clone, Debug, Default)]
pub(crate) struct Bounds(pub Vec<Bound>);

impl Bounds {
    /// Those of a graph.
    pub fn new(graph: &Graph<'_>, structure: &Structure) -> Self {
        let mut all = Vec::with_capacity(graph.ranges.len());
        for (&(block, coordinate), &(lower, upper)) in &graph.ranges {
            let position = structure.position[block as usize];
            let variable = &graph.variables[block as usize];
            let place = variable
                .free_coordinates()
                .position(|k| k == coordinate as usize);
            let number = variable.plain(coordinate as usize);
            if let (true, Some(place), Some(number)) = (position != NONE, place, number) {
                all.push(Bound {
                    unknown: structure.first[position as usize] + place,
                    value: variable.first + number,
                    lower,
                    upper,
                    block: Block(block),
                    coordinate: coordinate as usize,
                });
            }
        }
        all.sort_unstable_by_key(|bound| bound.unknown);
        Self(all)
    }

    pub fn is_empty(&self) -> bool {
        self.0.is_empty()
    }

    /// Refuses a start outside.
    ///
    /// # Errors
    /// The first coordinate that lies outside its bounds.
    pub fn check(&self, graph: &Graph<'_>, values: &[f64]) -> Result<(), Error> {
        let outside = self.0.iter().find(|bound| {
            let x = values[bound.value];
            x < bound.lower || x > bound.upper
        });
        outside.map_or(Ok(()), |bound| {
            Err(Error::StartInfeasible {
                constraint: bound.name(graph),
                value: values[bound.value],
                lower: bound.lower,
                upper: bound.upper,
            })
        })
    }

    /// Takes what rounding left of a step beyond a bound.
    pub fn cut(&self, values: &mut [f64]) {
        for bound in &self.0 {
            let x = &mut values[bound.value];
            *x = x.clamp(bound.lower, bound.upper);
        }
    }

    /// Unknowns that are held at a point; `None` where there are none.
    pub fn held(&self, unknowns: usize, values: &[f64], gradient: &[f64]) -> Option<Held> {
        let mut held = vec![false; unknowns];
        let mut count = 0;
        for bound in self.0.iter().filter(|b| b.holds(values, gradient)) {
            held[bound.unknown] = true;
            count += 1;
        }
        (count > 0).then_some(Held { held, count })
    }

    /// The bounds that hold at a point, by name, with their multipliers.
    pub fn active(
        &self,
        graph: &Graph<'_>,
        values: &[f64],
        gradient: &[f64],
    ) -> Vec<ActiveConstraint> {
        let mut holding: Vec<&Bound> = (self.0.iter())
            .filter(|bound| bound.holds(values, gradient))
            .collect();
        holding.sort_unstable_by_key(|bound| (bound.block, bound.coordinate));
        holding
            .into_iter()
            .map(|bound| ActiveConstraint {
                constraint: bound.name(graph),
                value: values[bound.value],
                multiplier: gradient[bound.unknown],
            })
            .collect()
    }
}

/// Unknowns that are held by bounds.
#[derive(Clone, Debug)]
pub(crate) struct Held {
    /// True for each that is.
    pub held: Vec<bool>,
    /// Number of those that are.
    pub count: usize,
}

impl Held {
    /// Writes `H` without the rows and columns of the unknowns that are held; on the diagonal it keeps what
    /// it has, or 1 in place of 0, so that it decays into two matrices in the old pattern.
    pub fn leave(&self, s: &Structure, h: &[f64], out: &mut Vec<f64>) {
        out.clear();
        out.extend_from_slice(h);
        for column in 0..s.order.len() {
            let of_column = &self.held[s.first[column]..s.first[column + 1]];
            for slot in s.column[column]..s.column[column + 1] {
                let row = s.row[slot] as usize;
                let of_row = &self.held[s.first[row]..s.first[row + 1]];
                if !of_row.iter().chain(of_column).any(|&held| held) {
                    continue;
                }
                let block = &mut out[s.entry[slot]..s.entry[slot + 1]];
                let entries = block.chunks_exact_mut(of_row.len());
                for (c, (entries, &held)) in entries.zip(of_column).enumerate() {
                    for (r, entry) in entries.iter_mut().enumerate() {
                        if row == column && r == c {
                            *entry = if held && *entry == 0.0 { 1.0 } else { *entry };
                        } else if held || of_row[r] {
                            *entry = 0.0;
                        }
                    }
                }
            }
        }
    }

    /// Sets what belongs to the unknowns that are held to zero, in every column of `x`.
    pub fn clear(&self, x: &mut [f64]) {
        for column in x.chunks_exact_mut(self.held.len()) {
            for (x, &held) in column.iter_mut().zip(&self.held) {
                *x = if held { 0.0 } else { *x };
            }
        }
    }

    /// `Σ ln H_kk` over the unknowns that are held, of what [`leave`](Self::leave) wrote.
    pub fn log_diagonal(&self, s: &Structure, h: &[f64]) -> f64 {
        let mut sum = 0.0;
        for position in 0..s.order.len() {
            let (first, width) = (s.entry[s.column[position]], s.width(position));
            let own = &self.held[s.first[position]..s.first[position + 1]];
            let diagonal = (0..width).map(|k| h[first + k * (width + 1)]);
            let kept = diagonal.zip(own).filter(|(_, held)| **held);
            sum += kept.map(|(h, _)| h.ln()).sum::<f64>();
        }
        sum
    }
}
