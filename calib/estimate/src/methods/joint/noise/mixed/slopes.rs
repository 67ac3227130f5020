//! Derivatives of the restricted likelihood by the variances, from the factorisation that gave it.

use faer::MatRef;

use super::{At, Kind, Line, Mixed, Part};

/// First derivatives, and average information (Gilmour, Thompson & Cullis 1995).
pub struct Slopes {
    /// `½ (rᵀ P C_c P r − tr(P C_c))`.
    pub score: Vec<f64>,
    /// `½ rᵀ P C_c P C_d P r`.
    pub information: Vec<Vec<f64>>,
}

/// Product `C_c P r` of one variance component with the projected residual, whitened, line by line.
type Moved = Vec<Vec<f64>>;

impl Mixed {
    /// The derivatives by the variances of the active components.
    pub fn slopes(&self, at: &At, theta: &[f64], active: &[bool]) -> Slopes {
        let count = self.kinds.len();
        let mut score = vec![0.0; count];
        let scales = self.scales(theta);
        let lines: Vec<AtLine<'_>> = self
            .lines
            .iter()
            .zip(&at.parts)
            .map(|(line, part)| AtLine::new(line, part, at, &scales))
            .collect();
        let mut moved: Vec<Option<Moved>> = vec![None; count];
        for c in (0..count).filter(|&c| active[c]) {
            let (own, slope) = match &self.kinds[c] {
                Kind::Passed => passed(&lines, c),
                Kind::Columns(columns, least) => {
                    let variance = theta[c].max(*least);
                    let left = at.factor.left_of_unit(columns.clone());
                    let weights = weights(&lines, columns.clone(), self.columns);
                    let square: f64 = weights.iter().map(|w| w * w).sum();
                    (
                        of_columns(&lines, &weights),
                        0.5 * (square - left / variance),
                    )
                }
            };
            score[c] = slope;
            moved[c] = Some(own);
        }
        Slopes {
            information: self.information(at, &lines, &scales, &moved),
            score,
        }
    }

    fn information(
        &self,
        at: &At,
        lines: &[AtLine<'_>],
        scales: &[f64],
        moved: &[Option<Moved>],
    ) -> Vec<Vec<f64>> {
        let count = moved.len();
        // `L⁻¹ Xᵀ V₀⁻¹ C_c P r` of every component.
        let taken: Vec<Option<Vec<f64>>> = moved
            .iter()
            .map(|moved| {
                let mut right = vec![0.0; self.columns];
                for (line, own) in lines.iter().zip(moved.as_ref()?) {
                    line.add_products(own, scales, &mut right);
                }
                let (own, shared) = at.factor.forward(&right);
                let own = own.iter().flat_map(|own| own.col(0).iter());
                Some(own.chain(shared.col(0).iter()).copied().collect())
            })
            .collect();
        let mut information = vec![vec![0.0; count]; count];
        for i in 0..count {
            for k in 0..=i {
                let (Some(a), Some(b)) = (&moved[i], &moved[k]) else {
                    continue;
                };
                let whole: f64 = a.iter().zip(b).map(|(a, b)| dot(a, b)).sum();
                let (Some(a), Some(b)) = (&taken[i], &taken[k]) else {
                    continue;
                };
                let value = 0.5 * (whole - dot(a, b));
                information[i][k] = value;
                information[k][i] = value;
            }
        }
        information
    }
}

/// One line at the variances.
struct AtLine<'a> {
    line: &'a Line,
    part: &'a Part,
    /// Whitened residuals after the fit of the columns (`k`).
    left: Vec<f64>,
    /// `P r` (`k`).
    weighted: Vec<f64>,
    /// `Y` with `V₀⁻¹ X M⁻¹ Xᵀ V₀⁻¹ = Y Yᵀ`, row by row, and its number of columns.
    taken: (Vec<f64>, usize),
}

impl<'a> AtLine<'a> {
    fn new(line: &'a Line, part: &'a Part, at: &At, scales: &[f64]) -> Self {
        let c = line.columns.len();
        let x: Vec<f64> = line
            .columns
            .iter()
            .map(|&k| scales[k] * at.solution[k])
            .collect();
        let rows = part.whitened.chunks_exact(c + 1);
        let left: Vec<f64> = rows.map(|row| row[c] - dot(&row[..c], &x)).collect();
        let mut weighted = left.clone();
        line.sequence.unwhiten(&part.factor, &mut weighted, 1);
        let mut scaled = Vec::with_capacity(left.len() * c);
        for row in part.whitened.chunks_exact(c + 1) {
            scaled.extend(
                row[..c]
                    .iter()
                    .zip(&line.columns)
                    .map(|(v, &k)| v * scales[k]),
            );
        }
        let scaled = MatRef::from_row_major_slice(&scaled, left.len(), c);
        let (mut taken, width) = at
            .factor
            .forward_rows(line.recording, &line.columns, scaled);
        line.sequence.unwhiten(&part.factor, &mut taken, width);
        Self {
            line,
            part,
            left,
            weighted,
            taken: (taken, width),
        }
    }

    /// Adds `Xᵀ v` of whitened rows.
    fn add_products(&self, own: &[f64], scales: &[f64], right: &mut [f64]) {
        let c = self.line.columns.len();
        for (row, value) in self.part.whitened.chunks_exact(c + 1).zip(own) {
            if *value != 0.0 {
                for (v, &k) in row[..c].iter().zip(&self.line.columns) {
                    right[k] += scales[k] * v * value;
                }
            }
        }
    }
}

/// `C_c P r` of a component that is passed on, whitened, and the derivative by it.
fn passed(lines: &[AtLine<'_>], c: usize) -> (Moved, f64) {
    let mut slope = 0.0;
    let moved = lines.iter().map(|at| {
        let sequence = &at.line.sequence;
        if !sequence.feels(c) {
            return vec![0.0; at.left.len()];
        }
        let mut moved = sequence.times(c, &at.weighted, 1);
        let (taken, width) = &at.taken;
        let through = dot(taken, &sequence.times(c, taken, *width));
        let trace = sequence.trace(&at.part.factor, c) - through;
        slope += 0.5 * (dot(&at.weighted, &moved) - trace);
        sequence.whiten(&at.part.factor, &mut moved, 1);
        moved
    });
    (moved.collect(), slope)
}

/// `Uᵀ P r`.
fn weights(lines: &[AtLine<'_>], columns: std::ops::Range<usize>, count: usize) -> Vec<f64> {
    let mut right = vec![0.0; count];
    let unit = vec![1.0; count];
    lines
        .iter()
        .for_each(|line| line.add_products(&line.left, &unit, &mut right));
    let mut weights = vec![0.0; count];
    weights[columns.clone()].copy_from_slice(&right[columns]);
    weights
}

/// `U w`, whitened.
fn of_columns(lines: &[AtLine<'_>], weights: &[f64]) -> Moved {
    let of_line = |at: &AtLine<'_>| -> Vec<f64> {
        let c = at.line.columns.len();
        let own: Vec<f64> = at.line.columns.iter().map(|&k| weights[k]).collect();
        let rows = at.part.whitened.chunks_exact(c + 1);
        rows.map(|row| dot(&row[..c], &own)).collect()
    };
    lines.iter().map(of_line).collect()
}

fn dot(a: &[f64], b: &[f64]) -> f64 {
    a.iter().zip(b).map(|(a, b)| a * b).sum()
}
