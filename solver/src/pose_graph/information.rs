//! Information matrices of edges: their roots, and what becomes of those that are none.

/// Treatment of an information matrix that is not positive definite.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Indefinite {
    /// Refuse the file, naming the line.
    #[default]
    Refused,
    /// Leave out the terms between two numbers of which one is off the diagonal by more than both diagonals allow,
    /// `|Ωᵢₖ| ≥ √(Ωᵢᵢ Ωₖₖ)`: entries that stand in the wrong place. What is still indefinite then is refused.
    WithoutWrongTerms,
    /// In space, move what stands between `z` and the turns about `x` and `y` to between `x` and `y` and the turn about `z`, where a
    /// motion measured in the plane has it: files that were lifted from the plane (cubicle, all 5,021 of its indefinite matrices) hold
    /// it in the wrong place. What is still indefinite then, or has something there already, is refused.
    PlanarTermsMoved,
}

/// The upper triangular `U` of `UᵀU`, row after row, from the upper triangle of the information; `None` if it is not
/// positive definite.
pub(super) fn root<const N: usize>(upper: &[f64], indefinite: Indefinite) -> Option<[f64; N]> {
    let n = N.isqrt();
    let mut full = [0.0; N];
    let mut entries = upper.iter();
    for i in 0..n {
        for k in i..n {
            full[i * n + k] = *entries.next()?;
        }
    }
    factored(full).or_else(|| match indefinite {
        Indefinite::Refused => None,
        Indefinite::WithoutWrongTerms => factored(without_wrong_terms(full)),
        Indefinite::PlanarTermsMoved => factored(planar_terms_moved(full)?),
    })
}

/// The matrix without entries that no covariance allows.
fn without_wrong_terms<const N: usize>(mut a: [f64; N]) -> [f64; N] {
    let n = N.isqrt();
    for i in 0..n {
        for k in i + 1..n {
            let most = a[i * n + i] * a[k * n + k];
            if a[i * n + k] * a[i * n + k] >= most {
                a[i * n + k] = 0.0;
            }
        }
    }
    a
}

/// The matrix with the terms `(z, φx)`, `(z, φy)` at `(x, φz)`, `(y, φz)`; `None` where those are taken, or of another size.
fn planar_terms_moved<const N: usize>(mut a: [f64; N]) -> Option<[f64; N]> {
    const MOVES: [(usize, usize); 2] = [(2 * 6 + 3, 5), (2 * 6 + 4, 6 + 5)];
    for (from, to) in MOVES {
        if N != 36 || a[to] != 0.0 {
            return None;
        }
        a[to] = std::mem::take(&mut a[from]);
    }
    Some(a)
}

/// Cholesky's factor of an upper triangle.
fn factored<const N: usize>(mut u: [f64; N]) -> Option<[f64; N]> {
    let n = N.isqrt();
    for i in 0..n {
        for k in i..n {
            for j in 0..i {
                u[i * n + k] -= u[j * n + i] * u[j * n + k];
            }
        }
        let pivot = u[i * n + i];
        if pivot.is_nan() || pivot <= 0.0 {
            return None;
        }
        (i..n).for_each(|k| u[i * n + k] /= pivot.sqrt());
    }
    u.iter().all(|v| v.is_finite()).then_some(u)
}

/// Mean variances of the first `split` numbers and of the others, `tr(Ω⁻¹)` over their count, from the root.
pub(super) fn mean_variances<const N: usize>(root: &[f64; N], split: usize) -> [f64; 2] {
    let n = N.isqrt();
    // Rows of U⁻¹, backwards: the variance of a number is the square of its row.
    let mut inverse = [0.0; N];
    for i in (0..n).rev() {
        for k in i..n {
            let unit = f64::from(u8::from(i == k));
            let sum: f64 = (i + 1..=k)
                .map(|j| root[i * n + j] * inverse[j * n + k])
                .sum();
            inverse[i * n + k] = (unit - sum) / root[i * n + i];
        }
    }
    let mean = |rows: std::ops::Range<usize>| {
        let count = rows.len() as f64;
        let squares = rows.flat_map(|i| &inverse[i * n..(i + 1) * n]);
        squares.map(|v| v * v).sum::<f64>() / count
    };
    [mean(0..split), mean(split..n)]
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_root_squared_is_the_information_and_its_inverse_the_covariance() {
        let upper = [4.0, 1.0, 0.0, 5.0, 0.0, 0.25];
        let u: [f64; 9] = root(&upper, Indefinite::Refused).unwrap();
        let entry = |i: usize, k: usize| (0..3).map(|j| u[3 * j + i] * u[3 * j + k]).sum::<f64>();
        assert!((entry(0, 1) - 1.0).abs() < 1e-15 && (entry(1, 1) - 5.0).abs() < 1e-15);
        // The inverse of [[4, 1], [1, 5]] has the trace 9 / 19.
        let [way, turn] = mean_variances(&u, 2);
        assert!((way - 9.0 / 38.0).abs() < 1e-15 && (turn - 4.0).abs() < 1e-15);
    }

    #[test]
    fn a_term_in_the_wrong_place_is_refused_or_left_out() {
        let upper = [10.0, 8e4, 0.0, 10.0, 1.0, 7.0];
        assert_eq!(root::<9>(&upper, Indefinite::Refused), None);
        let u: [f64; 9] = root(&upper, Indefinite::WithoutWrongTerms).unwrap();
        assert_eq!(u[1], 0.0);
        assert!(u[5] > 0.0);
        let planar = Indefinite::PlanarTermsMoved;
        assert_eq!(root::<9>(&upper, planar), None);
        let negative = [-1.0, 0.0, 0.0, 1.0, 0.0, 1.0];
        assert_eq!(root::<9>(&negative, Indefinite::WithoutWrongTerms), None);
    }

    #[test]
    fn terms_of_a_planar_measurement_are_moved_to_the_turn_about_z() {
        // The first of cubicle's: as a planar one (x, y, φz) and beside it 10 for what the plane does not know.
        let [x, xy, y, turn, xt, yt] = [2.46483e6, 5.3553e6, 1.52034e7, 91520.2, 84022.3, 132748.0];
        let upper = [
            x, xy, 0.0, 0.0, 0.0, 0.0, y, 0.0, 0.0, 0.0, 0.0, 10.0, xt, yt, 0.0, 10.0, 0.0, 0.0,
            10.0, 0.0, turn,
        ];
        assert_eq!(root::<36>(&upper, Indefinite::Refused), None);
        let u: [f64; 36] = root(&upper, Indefinite::PlanarTermsMoved).unwrap();
        let planar: [f64; 9] = root(&[x, xy, xt, y, yt, turn], Indefinite::Refused).unwrap();
        let at = [0, 1, 5];
        for i in 0..3 {
            for k in i..3 {
                let (found, due) = (u[6 * at[i] + at[k]], planar[3 * i + k]);
                assert!(
                    (found - due).abs() <= 1e-12 * due.abs(),
                    "{i} {k}: {found} {due}"
                );
            }
        }
        assert!((u[6 * 2 + 2] - 10f64.sqrt()).abs() < 1e-15 && u[6 * 2 + 3] == 0.0);
        // A matrix that is one stays as it is, and one whose place is taken is refused.
        let mut whole = upper;
        (whole[12], whole[13]) = (1.0, 0.0);
        let kept: [f64; 36] = root(&whole, Indefinite::PlanarTermsMoved).unwrap();
        assert_ne!(kept[6 * 2 + 3], 0.0);
        let mut taken = upper;
        taken[5] = 1.0;
        assert_eq!(root::<36>(&taken, Indefinite::PlanarTermsMoved), None);
    }
}
