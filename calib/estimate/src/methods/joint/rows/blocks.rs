//! Groups of rows that share no noise.

use faer::Mat;

/// The groups that the nonzero entries of symmetric matrices (`m × m`) connect, each in ascending order.
pub fn independent(matrices: &[&Mat<f64>]) -> Vec<Vec<usize>> {
    let m = matrices.first().map_or(0, |c| c.nrows());
    let mut seen = vec![false; m];
    let mut groups = Vec::new();
    for first in 0..m {
        if seen[first] {
            continue;
        }
        seen[first] = true;
        let mut group = vec![first];
        let mut next = 0;
        while let Some(&row) = group.get(next) {
            for (other, seen) in seen.iter_mut().enumerate() {
                if !*seen && matrices.iter().any(|c| c[(other, row)] != 0.0) {
                    *seen = true;
                    group.push(other);
                }
            }
            next += 1;
        }
        group.sort_unstable();
        groups.push(group);
    }
    groups
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn rows_that_a_third_connects_are_one_group() {
        let mut c = Mat::<f64>::identity(5, 5);
        for (i, k) in [(0, 3), (3, 4)] {
            c[(i, k)] = 0.5;
            c[(k, i)] = 0.5;
        }
        assert_eq!(independent(&[&c]), [vec![0, 3, 4], vec![1], vec![2]]);
    }
}
