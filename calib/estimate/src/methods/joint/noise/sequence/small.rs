//! Products of matrices of few rows.

/// Most rows of a station.
pub const MOST: usize = 3;

/// A small square matrix, `MOST` numbers a row.
pub type Small = [f64; MOST * MOST];

/// From another kind of matrix.
pub fn small(a: &nalgebra::DMatrix<f64>) -> Small {
    let mut small = [0.0; MOST * MOST];
    for i in 0..a.nrows() {
        for k in 0..a.ncols() {
            small[i * MOST + k] = a[(i, k)];
        }
    }
    small
}

/// `A += s B`.
pub fn add(a: &mut Small, by: f64, b: &Small) {
    a.iter_mut().zip(b).for_each(|(a, b)| *a += by * b);
}

/// `a += s b`.
pub fn add_scaled(a: &mut [f64], s: f64, b: &[f64]) {
    if s != 0.0 {
        a.iter_mut().zip(b).for_each(|(a, b)| *a += s * b);
    }
}

/// `out += sign A B`, `A` `d × r`, `B` `r × n`.
pub fn product(out: &mut [f64], a: &[f64], b: &[f64], (d, r, n): (usize, usize, usize), sign: f64) {
    for i in 0..d {
        let to = &mut out[i * n..(i + 1) * n];
        for s in 0..r {
            add_scaled(to, sign * a[i * r + s], &b[s * n..(s + 1) * n]);
        }
    }
}

/// `out += Aᵀ B`, `A` `d × r`, `B` `d × n`.
pub fn transposed_product(out: &mut [f64], a: &[f64], b: &[f64], (d, r, n): (usize, usize, usize)) {
    for i in 0..d {
        let from = &b[i * n..(i + 1) * n];
        for s in 0..r {
            add_scaled(&mut out[s * n..(s + 1) * n], a[i * r + s], from);
        }
    }
}

/// `S += s Aᵀ B`, `A` and `B` `d × r`.
pub fn add_gram(state: &mut [f64], a: &[f64], b: &[f64], (d, r): (usize, usize), by: f64) {
    for i in 0..d {
        for s in 0..r {
            let to = &mut state[s * r..(s + 1) * r];
            add_scaled(to, by * a[i * r + s], &b[i * r..(i + 1) * r]);
        }
    }
}

/// `L⁻¹ A` in place.
pub fn forward(lower: &Small, d: usize, a: &mut [f64], n: usize) {
    for i in 0..d {
        let (above, own) = a.split_at_mut(i * n);
        let own = &mut own[..n];
        for k in 0..i {
            add_scaled(own, -lower[i * MOST + k], &above[k * n..(k + 1) * n]);
        }
        let pivot = lower[i * MOST + i].recip();
        own.iter_mut().for_each(|v| *v *= pivot);
    }
}

/// `L⁻ᵀ A` in place.
pub fn backward(lower: &Small, d: usize, a: &mut [f64], n: usize) {
    for i in (0..d).rev() {
        let (own, below) = a.split_at_mut((i + 1) * n);
        let own = &mut own[i * n..];
        for k in i + 1..d {
            add_scaled(
                own,
                -lower[k * MOST + i],
                &below[(k - i - 1) * n..(k - i) * n],
            );
        }
        let pivot = lower[i * MOST + i].recip();
        own.iter_mut().for_each(|v| *v *= pivot);
    }
}

/// `L` of a positive matrix (`d × d`).
pub fn cholesky(a: &Small, d: usize) -> Option<Small> {
    let mut lower = [0.0; MOST * MOST];
    for i in 0..d {
        for k in 0..=i {
            let mut sum = a[i * MOST + k];
            for j in 0..k {
                sum -= lower[i * MOST + j] * lower[k * MOST + j];
            }
            if i == k {
                if !(sum > 0.0 && sum.is_finite()) {
                    return None;
                }
                lower[i * MOST + i] = sum.sqrt();
            } else {
                lower[i * MOST + k] = sum / lower[k * MOST + k];
            }
        }
    }
    Some(lower)
}

/// `L⁻¹ A L⁻ᵀ` of a symmetric matrix.
pub fn both_sides(lower: &Small, a: &Small, d: usize) -> Small {
    let mut half = *a;
    forward(lower, d, &mut half, MOST);
    let mut whole = [0.0; MOST * MOST];
    for i in 0..d {
        for k in 0..d {
            whole[i * MOST + k] = half[k * MOST + i];
        }
    }
    forward(lower, d, &mut whole, MOST);
    whole
}
