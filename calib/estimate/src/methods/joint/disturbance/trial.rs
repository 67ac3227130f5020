//! Tests of everything that may have been disturbed, one against the data or against others.

use faer::Mat;
use statrs::distribution::{ChiSquared, ContinuousCDF};

use crate::methods::joint::disturbance::Suspect;
use crate::methods::joint::noise::weights::Whitening;
use crate::methods::joint::result::marginal::orthonormal;

/// Chance of any false accusation of a clean recording.
const CHANCE: f64 = 0.001;

/// Eigenvalues of the information below this share of what the columns had before projection are nothing.
const UNSEEN: f64 = 1e-8;

/// A suspect that the data accuse.
#[derive(Clone, Copy, Debug)]
pub struct Verdict {
    /// The suspect's place among the suspects.
    pub suspect: usize,
    /// `χ²` of its parameters.
    pub statistic: f64,
    /// Probability of so much by chance, in this one test.
    pub p_value: f64,
}

/// All suspects under one whitening.
///
/// Score test: with `E` the whitened columns of a suspect and `P` the projection orthogonal to the Jacobian,
/// `bᵀ A⁻¹ b ~ χ²` of `b = Eᵀ P r`, `A = Eᵀ P E`, plus what the slopes add. No refit is needed.
#[derive(Debug)]
pub struct Trial<'a> {
    suspects: &'a [Suspect],
    /// First column of every suspect, and the end.
    first: Vec<usize>,
    /// First column of what looks like each suspect, and the end.
    alike: Vec<usize>,
    /// The columns of all, then what looks like each, whitened (`m × k`).
    columns: Mat<f64>,
    /// An orthonormal basis of the columns of the Jacobian.
    basis: Mat<f64>,
    /// The residuals, whitened (`m × 1`).
    residuals: Mat<f64>,
}

impl<'a> Trial<'a> {
    /// Of residuals, a Jacobian and the suspects' columns, all whitened by the white noise.
    pub fn new(
        suspects: &'a [Suspect],
        mut columns: Mat<f64>,
        mut jacobian: Mat<f64>,
        mut residuals: Mat<f64>,
        whitening: &Whitening,
    ) -> Self {
        whitening.finish(columns.as_mut());
        whitening.finish(jacobian.as_mut());
        whitening.finish(residuals.as_mut());
        let ends = |begin: usize, count: fn(&Suspect) -> usize| {
            let mut ends = vec![begin];
            ends.extend(suspects.iter().scan(begin, |sum, s| {
                *sum += count(s);
                Some(*sum)
            }));
            ends
        };
        let first = ends(0, |s| s.columns.len());
        let alike = ends(first[suspects.len()], |s| s.nuisance.len());
        Self {
            suspects,
            first,
            alike,
            columns,
            basis: orthonormal(&jacobian),
            residuals,
        }
    }

    /// The disturbances that chance does not explain, one after the other from the worst on, given
    /// those already `accused`; `None` where there are more than `most` (places among the suspects).
    pub fn accuse(&self, accused: &[usize], most: usize) -> Option<Vec<usize>> {
        let mut found = accused.to_vec();
        let level = self.level();
        loop {
            let worst = self
                .verdicts(&found, 0..self.suspects.len())
                .into_iter()
                .filter(|v| !found.contains(&v.suspect) && v.p_value < level)
                .min_by(|a, b| {
                    let by_p = a.p_value.total_cmp(&b.p_value);
                    by_p.then(b.statistic.total_cmp(&a.statistic))
                });
            match worst {
                None => return Some(found),
                Some(_) if found.len() >= most => return None,
                Some(verdict) => found.push(verdict.suspect),
            }
        }
    }

    /// Those of the doubtful among the accused whose own test, given the others, chance does not
    /// explain.
    pub fn confirm(&self, accused: &[usize], doubtful: &[usize]) -> Vec<usize> {
        let level = self.level();
        let holds = |k: usize| {
            let others: Vec<usize> = accused.iter().copied().filter(|&o| o != k).collect();
            let own = self.verdicts(&others, std::iter::once(k));
            own.iter().any(|v| v.p_value < level)
        };
        doubtful.iter().copied().filter(|&k| holds(k)).collect()
    }

    /// The level of each test.
    fn level(&self) -> f64 {
        CHANCE / self.suspects.len().max(1) as f64
    }

    /// The tests of `tried`, with the columns of `known` among the free ones.
    fn verdicts(&self, known: &[usize], tried: impl Iterator<Item = usize>) -> Vec<Verdict> {
        let basis = self.with(known);
        let r = &self.residuals - &basis * (basis.transpose() * &self.residuals);
        let inside = basis.transpose() * &self.columns;
        tried
            .filter_map(|suspect| {
                let (statistic, p_value) = self.test(suspect, (&basis, &inside), &r)?;
                Some(Verdict {
                    suspect,
                    statistic,
                    p_value,
                })
            })
            .collect()
    }

    /// The basis with what the columns of `known` add to it.
    fn with(&self, known: &[usize]) -> Mat<f64> {
        let places: Vec<usize> = known
            .iter()
            .flat_map(|&k| self.first[k]..self.first[k + 1])
            .collect();
        let m = self.basis.nrows();
        let own = Mat::from_fn(m, places.len(), |i, k| self.columns[(i, places[k])]);
        // Twice is enough: what the first projection leaves of rounding, the second takes.
        let mut left = &own - &self.basis * (self.basis.transpose() * &own);
        left = &left - &self.basis * (self.basis.transpose() * &left);
        let added = orthonormal(&left);
        let n = self.basis.ncols();
        Mat::from_fn(m, n + added.ncols(), |i, k| {
            if k < n {
                self.basis[(i, k)]
            } else {
                added[(i, k - n)]
            }
        })
    }

    /// An orthonormal basis of what looks like a suspect beyond the `basis`; `None` where nothing does.
    fn alike(&self, suspect: usize, basis: &Mat<f64>, inside: &Mat<f64>) -> Option<Mat<f64>> {
        let range = self.alike[suspect]..self.alike[suspect + 1];
        let n = self.columns.as_ref().subcols(range.start, range.len());
        let left = n - basis * inside.as_ref().subcols(range.start, range.len());
        (!range.is_empty()).then(|| orthonormal(&left))
    }

    /// `inside` are the columns' parts in the `basis`.
    fn test(
        &self,
        suspect: usize,
        (basis, inside): (&Mat<f64>, &Mat<f64>),
        r: &Mat<f64>,
    ) -> Option<(f64, f64)> {
        let range = self.first[suspect]..self.first[suspect + 1];
        let q = range.len();
        let e = self.columns.as_ref().subcols(range.start, q);
        let taken = inside.as_ref().subcols(range.start, q);
        let gram = e.transpose() * e;
        let mut taken = taken.transpose() * taken;
        let mut moved = e.transpose() * r;
        if let Some(alike) = self.alike(suspect, basis, inside) {
            let shared = e.transpose() * &alike;
            moved -= &shared * (alike.transpose() * r);
            taken += &shared * shared.transpose();
        }
        let mut a = nalgebra::DMatrix::from_fn(q, q, |i, k| gram[(i, k)] - taken[(i, k)]);
        let mut b = nalgebra::DVector::from_fn(q, |i, _| moved[(i, 0)]);
        let before = (0..q).map(|k| gram[(k, k)]).fold(0.0, f64::max);
        for (by, s) in &self.suspects[suspect].slopes {
            for i in 0..q {
                b[i] += by[i] * s;
                for k in 0..q {
                    a[(i, k)] += by[i] * by[k];
                }
            }
        }
        let eigen = a.symmetric_eigen();
        let (mut statistic, mut dof) = (0.0, 0);
        for (k, value) in eigen.eigenvalues.iter().enumerate() {
            if *value > UNSEEN * before.max(eigen.eigenvalues.max()) {
                statistic += eigen.eigenvectors.column(k).dot(&b).powi(2) / value;
                dof += 1;
            }
        }
        let law = ChiSquared::new(f64::from(dof)).ok()?;
        Some((statistic, law.sf(statistic)))
    }
}
