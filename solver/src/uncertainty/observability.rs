//! Directions in parameter space written in parameter names.

/// A component smaller than this, relative to the largest, is not named.
const NAMED_COMPONENT: f64 = 0.05;

/// Simplifies a basis (rows of equal length) so that each direction has a parameter that no other
/// has: Gauss–Jordan elimination with the largest pivots. Two parameters that are not observable
/// come out as themselves and not as their sum and difference.
pub(crate) fn separate(mut basis: Vec<Vec<f64>>, units: &[f64]) -> Vec<Vec<f64>> {
    let mut pivots: Vec<usize> = Vec::new();
    for row in 0..basis.len() {
        let size = |k: &usize| (basis[row][*k] * units[*k]).abs();
        let candidates = (0..units.len()).filter(|k| !pivots.contains(k));
        let Some(pivot) = candidates.max_by(|a, b| size(a).total_cmp(&size(b))) else {
            break;
        };
        let value = basis[row][pivot];
        if value == 0.0 {
            continue;
        }
        basis[row].iter_mut().for_each(|v| *v /= value);
        let reference = basis[row].clone();
        for (_, other) in basis.iter_mut().enumerate().filter(|(i, _)| *i != row) {
            let factor = other[pivot];
            other
                .iter_mut()
                .zip(&reference)
                .for_each(|(v, r)| *v -= factor * r);
        }
        pivots.push(pivot);
    }
    basis
}

/// A direction as `a + 0.5 b - c`; components count in `units`, the norms of the columns.
pub(crate) fn in_words(direction: &[f64], units: &[f64], names: &[String]) -> String {
    let larger = |a: f64, b: f64| if b.abs() > a.abs() { b } else { a };
    let visible = direction.iter().zip(units).map(|(d, u)| d * u);
    let most = visible.clone().fold(0.0, larger).abs();
    let named: Vec<usize> = visible
        .enumerate()
        .filter(|(_, v)| v.abs() >= NAMED_COMPONENT * most)
        .map(|(k, _)| k)
        .collect();
    let largest = named.iter().map(|&k| direction[k]).fold(0.0, larger);
    let first = named.first().map_or(1.0, |&k| direction[k]);
    let unit = largest.abs() * first.signum();
    let mut words = String::new();
    for k in named {
        let c = direction[k] / unit;
        if !words.is_empty() {
            words.push_str(if c < 0.0 { " - " } else { " + " });
        }
        if (c.abs() - 1.0).abs() > 0.005 {
            words.push_str(&format!("{} ", coefficient(c.abs())));
        }
        words.push_str(&names[k]);
    }
    words
}

fn coefficient(c: f64) -> String {
    if (0.01..1000.0).contains(&c) {
        format!("{c:.2}")
    } else {
        format!("{c:.2e}")
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn two_unobservable_parameters_are_named_apart() {
        let r = 0.5f64.sqrt();
        let basis = separate(vec![vec![r, r, 0.0], vec![r, -r, 0.0]], &[1.0; 3]);
        let names: Vec<String> = ["a", "b", "c"].map(String::from).to_vec();
        let mut words: Vec<String> = basis
            .iter()
            .map(|d| in_words(d, &[1.0; 3], &names))
            .collect();
        words.sort();
        assert_eq!(words, ["a", "b"]);
    }

    #[test]
    fn a_difference_is_written_with_its_sign() {
        let names: Vec<String> = ["a", "b", "c"].map(String::from).to_vec();
        assert_eq!(in_words(&[-1.0, 0.5, 0.0], &[1.0; 3], &names), "a - 0.50 b");
    }
}
