//! Tests of everything that may have been disturbed, one against the data or against others.

use faer::Mat;
use nalgebra::{DMatrix, DVector, Dyn, SymmetricEigen};

use crate::methods::chance;
use crate::methods::joint::blocks::basis::{Basis, stacked};
use crate::methods::joint::blocks::columns::Columns;
use crate::methods::joint::faults::Suspect;
use crate::methods::joint::result::marginal::orthonormal;

findings::tuning! {
    /// Chance of that anything is flagged in a clean recording.
    CHANCE: f64 = 0.001;

    /// Eigenvalues of the information below this share of what the columns had before projection are nothing.
    UNSEEN: f64 = 1e-8;

    /// A suspect with fewer parameters that explains this share of what another does takes its place.
    AS_WELL: f64 = 0.99;
}

/// A suspect that the data flag.
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
    /// The columns of all, then what looks like each, whitened (`m × k`): those of a suspect are in one group of rows.
    columns: Columns,
    /// Basis of the columns of the Jacobian.
    basis: Basis,
    /// The residuals, whitened (`m`).
    residuals: Vec<f64>,
}

/// Disturbances fitted beside the Jacobian, and the residuals after that.
struct Known {
    /// An orthonormal basis of what the columns of the disturbances add (`m × a`).
    added: Mat<f64>,
    /// Remainder of the residuals (`m`).
    left: Vec<f64>,
    /// The parts of the suspects' columns in the space of all that is fitted, group by group.
    inside: Vec<Mat<f64>>,
}

impl<'a> Trial<'a> {
    /// Builds the tests from residuals, a Jacobian and the suspects' columns, all whitened.
    pub fn new(
        suspects: &'a [Suspect],
        columns: Columns,
        jacobian: &Columns,
        residuals: Vec<f64>,
    ) -> Self {
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
            basis: Basis::of(jacobian),
            residuals,
        }
    }

    /// The disturbances that chance does not explain, one after the other from the worst on, given
    /// those already `flagged`; `None` where there are more than `most` (places among the suspects).
    pub fn flag(&self, flagged: &[usize], most: usize) -> Option<Vec<usize>> {
        let mut found = flagged.to_vec();
        loop {
            match self.worst(&found) {
                None => return Some(found),
                Some(_) if found.len() >= most => return None,
                Some(worst) => self.add(&mut found, worst, flagged.len()),
            }
        }
    }

    /// Adds the worst, and takes for those beyond the `given` ones what explains as much beside the others with fewer parameters: two turns
    /// that miss look like a push between them.
    pub fn add(&self, found: &mut Vec<usize>, worst: usize, given: usize) {
        found.push(worst);
        let columns = |k: usize| self.first[k + 1] - self.first[k];
        if found.len() < 2 {
            return;
        }
        for place in given..found.len() {
            let own = found[place];
            let mut others = found.clone();
            others.remove(place);
            let is_simpler =
                |k: &usize| *k == own || (columns(*k) < columns(own) && !others.contains(k));
            let tried = (0..self.suspects.len()).filter(is_simpler);
            let (mine, simpler): (Vec<Verdict>, Vec<Verdict>) = self
                .verdicts(&others, tried)
                .into_iter()
                .partition(|verdict| verdict.suspect == own);
            let best = simpler
                .into_iter()
                .max_by(|a, b| a.statistic.total_cmp(&b.statistic));
            let explained = mine.first().map_or(0.0, |verdict| verdict.statistic);
            if let Some(best) = best.filter(|best| best.statistic >= AS_WELL.get() * explained) {
                found[place] = best.suspect;
            }
        }
    }

    /// The one that chance explains least, given those already `flagged`; `None` where it explains all others.
    pub fn worst(&self, flagged: &[usize]) -> Option<usize> {
        let level = self.level();
        let all = self.verdicts(flagged, 0..self.suspects.len()).into_iter();
        let others = all.filter(|v| !flagged.contains(&v.suspect) && v.p_value < level);
        let worst = others.min_by(|a, b| {
            let by_p = a.p_value.total_cmp(&b.p_value);
            by_p.then(b.statistic.total_cmp(&a.statistic))
        });
        worst.map(|verdict| verdict.suspect)
    }

    /// Those of the doubtful among the flagged whose own test, given the others, chance does not
    /// explain.
    pub fn confirm(&self, flagged: &[usize], doubtful: &[usize]) -> Vec<usize> {
        let level = self.level();
        let holds = |k: usize| {
            let others: Vec<usize> = flagged.iter().copied().filter(|&o| o != k).collect();
            let own = self.verdicts(&others, std::iter::once(k));
            own.iter().any(|v| v.p_value < level)
        };
        doubtful.iter().copied().filter(|&k| holds(k)).collect()
    }

    /// The level of each test.
    fn level(&self) -> f64 {
        CHANCE.get() / self.suspects.len().max(1) as f64
    }

    /// The tests of `tried`, with the columns of `known` among the free ones.
    fn verdicts(&self, known: &[usize], tried: impl Iterator<Item = usize>) -> Vec<Verdict> {
        let known = self.with(known);
        tried
            .filter_map(|suspect| {
                let (statistic, p_value) = self.test(suspect, &known)?;
                Some(Verdict {
                    suspect,
                    statistic,
                    p_value,
                })
            })
            .collect()
    }

    /// Fits the columns of the suspects `known` beside the Jacobian.
    fn with(&self, known: &[usize]) -> Known {
        let places: Vec<usize> = known
            .iter()
            .flat_map(|&k| self.first[k]..self.first[k + 1])
            .collect();
        let mut left = self.basis.without_column(&self.residuals);
        if places.is_empty() {
            return self.known(Mat::zeros(left.len(), 0), left);
        }
        // Twice is enough: what the first projection leaves of rounding, the second takes.
        let own = self.basis.without(&self.columns.select(&places));
        let added = orthonormal(&self.basis.without(&own).to_dense());
        let column = Mat::from_fn(left.len(), 1, |i, _| left[i]);
        let taken = &added * (added.transpose() * &column);
        left.iter_mut()
            .zip(taken.col(0).iter())
            .for_each(|(l, t)| *l -= t);
        self.known(added, left)
    }

    fn known(&self, added: Mat<f64>, left: Vec<f64>) -> Known {
        let groups = 0..self.columns.parts().len();
        Known {
            inside: groups.map(|group| self.inside(group, &added)).collect(),
            added,
            left,
        }
    }

    /// The parts of the columns of a group of rows in the space of all that is fitted, of which `added` is not in the basis.
    fn inside(&self, group: usize, added: &Mat<f64>) -> Mat<f64> {
        let part = &self.columns.parts()[group];
        let in_basis = self.basis.inside(group, part.values.as_ref());
        let count = added.ncols();
        let added = Mat::from_fn(part.rows.len(), count, |i, k| added[(part.rows[i], k)]);
        stacked(&in_basis, &(added.transpose() * &part.values))
    }

    /// The group of rows that a column is in, and its place there.
    fn place(&self, column: usize) -> Option<(usize, usize)> {
        let mut parts = self.columns.parts().iter().enumerate();
        parts.find_map(|(group, part)| Some((group, part.place(column)?)))
    }

    /// An orthonormal basis of what looks like a suspect beyond all that is fitted, in the rows of the suspect's group, and
    /// its part in what is left of the residuals; `None` where nothing does.
    fn alike(&self, suspect: usize, known: &Known) -> Option<(Mat<f64>, Mat<f64>)> {
        let range: Vec<usize> = (self.alike[suspect]..self.alike[suspect + 1]).collect();
        let (group, _) = self.place(*range.first()?)?;
        let left = self.basis.without(&self.columns.select(&range)).to_dense();
        let left = &left - &known.added * (known.added.transpose() * &left);
        let basis = orthonormal(&left);
        let r = Mat::from_fn(known.left.len(), 1, |i, _| known.left[i]);
        let moved = basis.transpose() * &r;
        let rows = &self.columns.parts()[group].rows;
        let own = Mat::from_fn(rows.len(), basis.ncols(), |i, k| basis[(rows[i], k)]);
        Some((own, moved))
    }

    /// Returns the norm of a suspect's parameters, the other flagged ones fitted beside it.
    pub fn size(&self, suspect: usize, flagged: &[usize]) -> Option<f64> {
        let others: Vec<usize> = flagged.iter().copied().filter(|&k| k != suspect).collect();
        let score = self.score(suspect, &self.with(&others))?;
        let seen = score.seen();
        let along = |(value, vector, b): (f64, DVector<f64>, f64)| vector * (b / value);
        Some(seen.map(along).sum::<DVector<f64>>().norm())
    }

    /// Statistic and p-value of a suspect.
    fn test(&self, suspect: usize, known: &Known) -> Option<(f64, f64)> {
        let score = self.score(suspect, known)?;
        let (mut statistic, mut dof) = (0.0, 0);
        for (value, _, b) in score.seen() {
            statistic += b * b / value;
            dof += 1;
        }
        (dof > 0).then(|| (statistic, chance::of_chi2(statistic, f64::from(dof))))
    }

    fn score(&self, suspect: usize, known: &Known) -> Option<Score> {
        let q = self.first[suspect + 1] - self.first[suspect];
        let (group, place) = self.place(self.first[suspect])?;
        let part = &self.columns.parts()[group];
        let e = part.values.as_ref().subcols(place, q);
        let taken = known.inside[group].as_ref().subcols(place, q);
        let gram = e.transpose() * e;
        let mut taken = taken.transpose() * taken;
        let r = Mat::from_fn(part.rows.len(), 1, |i, _| known.left[part.rows[i]]);
        let mut moved = e.transpose() * r;
        if let Some((alike, of_rest)) = self.alike(suspect, known) {
            let shared = e.transpose() * &alike;
            moved -= &shared * of_rest;
            taken += &shared * shared.transpose();
        }
        let mut a = DMatrix::from_fn(q, q, |i, k| gram[(i, k)] - taken[(i, k)]);
        let mut b = DVector::from_fn(q, |i, _| moved[(i, 0)]);
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
        let least = UNSEEN.get() * before.max(eigen.eigenvalues.max());
        Some(Score { eigen, b, least })
    }
}

/// `A` of a suspect by its eigenvalues, and `b`.
struct Score {
    eigen: SymmetricEigen<f64, Dyn>,
    b: DVector<f64>,
    /// Eigenvalues up to this are nothing.
    least: f64,
}

impl Score {
    /// Eigenvalue, eigenvector and the part of `b` along it, wherever the rows see one.
    fn seen(&self) -> impl Iterator<Item = (f64, DVector<f64>, f64)> {
        let values = self.eigen.eigenvalues.iter().enumerate();
        values
            .filter(|(_, value)| **value > self.least)
            .map(|(k, value)| {
                let vector = self.eigen.eigenvectors.column(k).into_owned();
                let b = vector.dot(&self.b);
                (*value, vector, b)
            })
    }
}
