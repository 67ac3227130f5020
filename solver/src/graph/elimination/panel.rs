//! A column of blocks: its factor, and what it takes from later ones.

use pulp::Simd;

/// A block below the diagonal.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Below {
    /// Rows of numbers before it in its panel.
    pub offset: u32,
    /// First unknown.
    pub first: u32,
    /// Position of its row.
    pub position: u32,
    pub width: u32,
}

/// The factor of a panel: that of its diagonal block, and the rows below times its inverse transposed.
#[inline(always)]
pub(crate) fn factor_panel(panel: &mut [f64], width: usize, height: usize) -> bool {
    for k in 0..width {
        let (done, later) = panel.split_at_mut((k + 1) * height);
        let column = &mut done[k * height..];
        let pivot = column[k];
        if !(pivot > 0.0 && pivot.is_finite()) {
            return false;
        }
        let root = pivot.sqrt();
        let inverse = 1.0 / root;
        column[k] = root;
        for value in &mut column[k + 1..] {
            *value *= inverse;
        }
        for (c, other) in later.chunks_exact_mut(height).enumerate() {
            let first = k + 1 + c;
            let factor = column[first];
            for (out, value) in other[first..].iter_mut().zip(&column[first..]) {
                *out -= value * factor;
            }
        }
    }
    true
}

/// The products of the blocks of a panel from one on by that one.
pub(crate) struct Product<'a> {
    pub panel: &'a [f64],
    pub height: usize,
    /// Rows of numbers before the one.
    pub b: usize,
    pub others: &'a [Below],
    /// Their place.
    pub places: &'a [u32],
    /// Entries before those that are changed.
    pub before: usize,
    /// Distance of columns there.
    pub stride: usize,
}

impl Product<'_> {
    #[inline(always)]
    pub fn subtract<S: Simd, const W: usize>(&self, simd: S, later: &mut [f64]) {
        let mut right = [[0.0; W]; W];
        for (k, right) in right.iter_mut().enumerate() {
            let Some(own) = self.panel[k * self.height + self.b..].first_chunk::<W>() else {
                return;
            };
            *right = own.map(|value| -value);
        }
        for (a, &place) in self.others.iter().zip(self.places) {
            let mut left = [[0.0; W]; W];
            for (k, left) in left.iter_mut().enumerate() {
                let from = k * self.height + a.offset as usize;
                let Some(own) = self.panel[from..].first_chunk::<W>() else {
                    return;
                };
                *left = *own;
            }
            let out = &mut later[place as usize - self.before..];
            for c in 0..W {
                let Some(out) = out[c * self.stride..].first_chunk_mut::<W>() else {
                    return;
                };
                if W >= S::F64_LANES {
                    add_columns(simd, out, &left, right.each_ref().map(|right| right[c]));
                    continue;
                }
                let mut sum = *out;
                for k in 0..W {
                    for r in 0..W {
                        sum[r] += left[k][r] * right[k][c];
                    }
                }
                *out = sum;
            }
        }
    }

    #[inline(always)]
    pub fn subtract_any(&self, width: usize, columns: usize, later: &mut [f64]) {
        for (a, &place) in self.others.iter().zip(self.places) {
            let rows = a.width as usize;
            for c in 0..columns {
                let from = place as usize - self.before + c * self.stride;
                let out = &mut later[from..from + rows];
                for k in 0..width {
                    let column = &self.panel[k * self.height..];
                    let factor = column[self.b + c];
                    let left = &column[a.offset as usize..][..rows];
                    for (out, left) in out.iter_mut().zip(left) {
                        *out -= left * factor;
                    }
                }
            }
        }
    }
}

/// Adds columns times factors: the first numbers as a vector, the others one by one.
#[inline(always)]
fn add_columns<S: Simd, const W: usize>(
    simd: S,
    out: &mut [f64; W],
    left: &[[f64; W]; W],
    factors: [f64; W],
) {
    let (body, end) = S::as_mut_simd_f64s(out.as_mut_slice());
    let Some(body) = body.first_mut() else {
        return;
    };
    let mut sum = *body;
    for (column, factor) in left.iter().zip(factors) {
        let (own, rest) = S::as_simd_f64s(column.as_slice());
        sum = simd.mul_add_e_f64s(own[0], simd.splat_f64s(factor), sum);
        for (out, value) in end.iter_mut().zip(rest) {
            *out += value * factor;
        }
    }
    *body = sum;
}
