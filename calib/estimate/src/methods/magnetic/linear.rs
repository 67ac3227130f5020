//! A factor that is linear in its blocks.

use solver::Factor;

/// `r = A x − b`, of `b.len()` rows.
#[derive(Clone, Debug)]
pub struct Linear {
    /// `A`, row after row.
    pub slopes: Vec<f64>,
    /// `b`.
    pub target: Vec<f64>,
}

impl Linear {
    /// One row.
    pub fn row(slopes: Vec<f64>, target: f64) -> Self {
        Self {
            slopes,
            target: vec![target],
        }
    }

    /// Three axes: `weight (Σ_k shares_k x_k − target)` of blocks of three.
    pub fn axes(weight: f64, shares: &[f64], target: [f64; 3]) -> Self {
        let slopes = (0..3).flat_map(|row| {
            let of_block = move |share: &f64| {
                let share = *share;
                (0..3).map(move |axis| if axis == row { weight * share } else { 0.0 })
            };
            shares.iter().flat_map(of_block).collect::<Vec<_>>()
        });
        Self {
            slopes: slopes.collect(),
            target: target.map(|t| weight * t).into(),
        }
    }

    /// Numbers that are 0 to within one.
    pub fn standard(count: usize) -> Self {
        let slope = |k: usize| f64::from(u8::from(k / count == k % count));
        Self {
            slopes: (0..count * count).map(slope).collect(),
            target: vec![0.0; count],
        }
    }
}

impl Factor for Linear {
    fn values(&self, x: &[f64], out: &mut Vec<f64>) {
        out.clear();
        let rows = self.slopes.chunks_exact(x.len()).zip(&self.target);
        out.extend(rows.map(|(row, b)| row.iter().zip(x).map(|(a, x)| a * x).sum::<f64>() - b));
    }

    fn linearize(&self, x: &[f64], residuals: &mut Vec<f64>, jacobian: &mut Vec<f64>) {
        self.values(x, residuals);
        jacobian.clear();
        jacobian.extend_from_slice(&self.slopes);
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn three_axes_of_two_blocks_are_their_difference() {
        let factor = Linear::axes(2.0, &[-1.0, 1.0], [0.0, 0.0, 1.0]);
        let mut out = Vec::new();
        factor.values(&[1.0, 2.0, 3.0, 1.5, 2.0, 5.0], &mut out);
        assert_eq!(out, [1.0, 0.0, 2.0]);
        Linear::standard(2).values(&[3.0, -4.0], &mut out);
        assert_eq!(out, [3.0, -4.0]);
    }
}
