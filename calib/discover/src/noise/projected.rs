//! The disagreement, with everything that the model's parameters could explain taken out.

use estimate::methods::joint::{
    BiasNoise, Column, Columns, Component, ComponentKind, NoiseLevel, RowGroups, Within,
    left_null_space, orthonormal,
};
use faer::{Mat, MatRef, Side};
use sensor::Sensor;

use super::projected_columns::ProjectedColumns;
use super::spectrum::{Kept, Root, Spectrum, product};

/// `z = Nᵀ r ~ N(Nᵀ E β + Nᵀ S γ, I + Σ θ_c C_c)`, `N` (`m × q`) of every recording the left null space of the columns of a
/// model's Jacobian that are its own, directions and biases; `S` what all recordings share, which is taken out under the
/// noise at hand; `C_c` those of walk and flicker of the biases.
#[derive(Clone, Debug)]
pub struct Projected {
    /// The rows (`m`) of each part.
    rows: RowGroups,
    /// Those of `z` (`q`) of each part.
    places: RowGroups,
    parts: Vec<Part>,
    /// `Nᵀ r` (`q × 1`), the recordings one after the other.
    z: Mat<f64>,
    /// `Nᵀ S` (`q × s`), orthonormal.
    shared: Mat<f64>,
    /// Kinds of noise of the biases, in order.
    kinds: Vec<ComponentKind>,
    /// True if the turns scatter, their errors being far larger than the noise.
    pub scatters: bool,
    /// Slopes of the readings within static intervals, which show the noise of the biases but no error of a model;
    /// components in the order of `kinds`.
    pub within: Vec<Within>,
}

/// One recording, or several that share noise.
#[derive(Clone, Debug)]
struct Part {
    /// Its rows.
    rows: Vec<usize>,
    /// `N` (`rows × q`).
    null: Mat<f64>,
    /// `Nᵀ C N` (`q × q`) of the noise of the biases.
    noise: Vec<Mat<f64>>,
    /// The scatter of the turns at its likeliest (`q × q`).
    scatter: Option<Mat<f64>>,
}

impl Part {
    /// `Nᵀ E` (`q × k`), of the rows that `E` has: errors of one sensor touch its own alone, which are neighbours.
    fn project(&self, e: MatRef<'_, f64>) -> Mat<f64> {
        let is_used = |i: &usize| e.row(*i).iter().any(|v| *v != 0.0);
        let first = (0..e.nrows()).find(is_used).unwrap_or(0);
        let count = (first..e.nrows())
            .rfind(is_used)
            .map_or(0, |last| last + 1 - first);
        self.null.as_ref().subrows(first, count).transpose() * e.subrows(first, count)
    }
}

impl Projected {
    /// Builds it from white-whitened residuals (`m`), Jacobian (`m × n`) and kinds of noise (`m × m`) with their levels.
    pub fn new(
        residuals: &[f64],
        jacobian: &Columns,
        (noise, levels): (&[Component], &[NoiseLevel]),
    ) -> Self {
        let of_biases = |c: &&Component| c.kind.is_walk() || c.kind.is_flicker();
        let of_turns = |c: &&Component| c.kind == ComponentKind::TurnScatter;
        let scatter = noise.iter().find(of_turns).and_then(|c| {
            let size = levels.iter().find(|level| level.kind == c.kind)?.size;
            (size > 0.0).then_some((size * size, &c.covariance))
        });
        let noise: Vec<&Component> = noise.iter().filter(of_biases).collect();
        let all = noise.iter().map(|c| &c.covariance);
        let all = all.chain(scatter.map(|(_, c)| c));
        let groups = jacobian.groups().connected_by(all);
        let jacobian = jacobian.clone().regrouped(&groups);
        let parts_of = jacobian.parts_of();
        let common: Vec<usize> = (0..parts_of.len()).filter(|&k| parts_of[k] > 1).collect();
        let shared = jacobian.select(&common).to_dense();
        let part = |part: &estimate::methods::joint::Part| {
            let null = left_null_space(&part.own_columns(&parts_of));
            Part {
                noise: noise
                    .iter()
                    .map(|c| c.covariance.both_sides_of(&part.rows, &null))
                    .collect(),
                scatter: scatter
                    .map(|(size, c)| faer::Scale(size) * c.both_sides_of(&part.rows, &null)),
                rows: part.rows.clone(),
                null,
            }
        };
        let parts: Vec<Part> = jacobian.parts().iter().map(part).collect();
        let places = parts.iter().enumerate();
        let places = places.flat_map(|(k, part)| vec![k; part.null.ncols()]);
        let mut projected = Self {
            places: RowGroups::of_count(places.collect(), parts.len()),
            rows: groups,
            parts,
            z: Mat::zeros(0, 1),
            shared: Mat::zeros(0, 0),
            kinds: noise.iter().map(|c| c.kind).collect(),
            scatters: scatter.is_some(),
            within: Vec::new(),
        };
        let r = Mat::from_fn(residuals.len(), 1, |i, _| residuals[i]);
        projected.z = projected.columns(r.as_ref());
        projected.shared = orthonormal(&projected.columns(shared.as_ref()));
        projected
    }

    /// Kinds of noise of the biases, in order.
    pub fn kinds(&self) -> Vec<ComponentKind> {
        self.kinds.clone()
    }

    /// Degrees of freedom `q − s`.
    pub fn dof(&self) -> usize {
        self.z.nrows() - self.shared.ncols()
    }

    /// `Nᵀ E` (`q × k`) of white-whitened columns.
    pub fn columns(&self, e: MatRef<'_, f64>) -> Mat<f64> {
        if let [part] = self.parts.as_slice() {
            return part.project(e);
        }
        let count = self.parts.iter().map(|part| part.null.ncols()).sum();
        let mut all = Mat::zeros(count, e.ncols());
        let mut above = 0;
        for part in &self.parts {
            let q = part.null.ncols();
            let is_used = |k: &usize| part.rows.iter().any(|&i| e[(i, *k)] != 0.0);
            let used: Vec<usize> = (0..e.ncols()).filter(is_used).collect();
            let own = Mat::from_fn(part.rows.len(), used.len(), |i, k| {
                e[(part.rows[i], used[k])]
            });
            put(&mut all, above, &used, &part.project(own.as_ref()));
            above += q;
        }
        all
    }

    /// `Nᵀ E` (`q × k`) of columns that most recordings have nothing of.
    pub fn by_recording(&self, e: &Columns) -> Columns {
        let e = e.clone().regrouped(&self.rows);
        let of_group = e.parts().iter().map(|part| part.columns.clone());
        let mut all = Columns::zeros(&self.places, e.ncols(), of_group.collect());
        for (k, (own, part)) in e.parts().iter().zip(&self.parts).enumerate() {
            all.part_mut(k).values = part.project(own.values.as_ref());
        }
        all
    }

    /// The same of unit columns, one for each of these rows.
    pub fn units(&self, rows: &[usize]) -> Columns {
        let units: Vec<Column> = rows.iter().map(|&row| Column::unit(row)).collect();
        let units: Vec<&Column> = units.iter().collect();
        self.by_recording(&Columns::sparse(&self.rows, &units))
    }

    /// Such columns, one after the other.
    pub fn side_by_side(&self, all: &[Columns]) -> Columns {
        Columns::side_by_side(&self.places, &all.iter().collect::<Vec<_>>())
    }

    /// `V = I + Σ θ_c C_c` (`q × q`) of a recording; `None` where that is the identity.
    fn covariance(&self, part: &Part, noise: BiasNoise, share: f64) -> Option<Mat<f64>> {
        let q = part.null.ncols();
        let mut sum: Option<Mat<f64>> = None;
        for (kind, size) in noise.sizes() {
            let own = self.kinds.iter().position(|own| *own == kind);
            if let (Some(place), true) = (own, size > 0.0) {
                let c = &part.noise[place];
                *sum.get_or_insert_with(|| Mat::identity(q, q)) += faer::Scale(size * size) * c;
            }
        }
        if let (Some(scatter), true) = (&part.scatter, share > 0.0) {
            *sum.get_or_insert_with(|| Mat::identity(q, q)) += faer::Scale(share) * scatter;
        }
        sum
    }

    fn log_likelihood_within(&self, noise: &BiasNoise) -> f64 {
        let variance = |kind: &ComponentKind| {
            let size = noise.sizes().find(|(own, _)| own == kind);
            size.map_or(0.0, |(_, size)| size * size)
        };
        let theta: Vec<f64> = self.kinds.iter().map(variance).collect();
        self.within.iter().map(|w| w.log_likelihood(&theta)).sum()
    }

    /// The whole under white noise alone.
    pub fn white(&self) -> Whitened {
        let noise = BiasNoise::default();
        self.whitened(&noise, vec![Root::Identity; self.parts.len()], 0.0)
    }

    /// The whole at given noise of the biases; `None` where that is not finite.
    pub fn at(&self, noise: BiasNoise) -> Option<Whitened> {
        self.at_share(noise, 1.0)
    }

    /// The same with a share of the variance by which turns scatter.
    pub fn at_share(&self, noise: BiasNoise, share: f64) -> Option<Whitened> {
        let mut log_determinant = 0.0;
        let mut root = |part: &Part| match self.covariance(part, noise, share) {
            Some(v) => {
                let l = v.llt(Side::Lower).ok()?.L().to_owned();
                log_determinant += (0..l.nrows()).map(|k| 2.0 * l[(k, k)].ln()).sum::<f64>();
                Some(Root::Inverse(l))
            }
            None => Some(Root::Identity),
        };
        let roots: Option<Vec<Root>> = self.parts.iter().map(&mut root).collect();
        let roots = roots?;
        Some(self.whitened(&noise, roots, log_determinant))
    }

    /// The whole at every density of the walk of one sensor beside the other noise of `noise`, from one factorisation; `None` where it is not
    /// finite.
    pub fn along_walk(&self, noise: BiasNoise, sensor: Sensor) -> Option<AlongWalk<'_>> {
        let others = noise.with_walk(sensor, 0.0, 1.0);
        let is_it = |kind: &ComponentKind| *kind == BiasNoise::walk_of(sensor);
        let place = self.kinds.iter().position(is_it);
        let spectrum = |part: &Part| {
            let v = self.covariance(part, others, 1.0);
            let q = part.null.ncols();
            let c = place.map_or_else(|| Mat::zeros(q, q), |place| part.noise[place].clone());
            Spectrum::new(v.as_ref(), c)
        };
        let spectra: Option<Vec<Spectrum>> = self.parts.iter().map(spectrum).collect();
        Some(AlongWalk {
            projected: self,
            spectra: spectra?,
            others,
            sensor,
        })
    }

    /// The whole under noise with these roots and `ln det` of its covariance, recording by recording.
    fn whitened(&self, noise: &BiasNoise, roots: Vec<Root>, mut log_determinant: f64) -> Whitened {
        let sizes = self.parts.iter().map(|part| part.null.ncols());
        let mut whitened = Whitened {
            z: self.z.clone(),
            sizes: sizes.collect(),
            roots,
            taken: Mat::zeros(self.z.nrows(), 0),
            log_determinant: 0.0,
            square: 0.0,
            within: self.log_likelihood_within(noise),
        };
        if self.shared.ncols() > 0 {
            let qr = whitened.columns(&self.shared).qr();
            let triangle = qr.thin_R();
            let pivots = (0..triangle.nrows()).map(|k| 2.0 * triangle[(k, k)].abs().ln());
            log_determinant += pivots.sum::<f64>();
            whitened.taken = qr.compute_thin_Q();
        }
        whitened.z = whitened.columns(&self.z);
        whitened.square = whitened.z.squared_norm_l2();
        whitened.log_determinant = log_determinant;
        whitened
    }
}

/// The disagreement at every density of the walk of one sensor.
#[derive(Debug)]
pub struct AlongWalk<'a> {
    projected: &'a Projected,
    spectra: Vec<Spectrum>,
    others: BiasNoise,
    sensor: Sensor,
}

impl AlongWalk<'_> {
    /// The noise with a walk of this density, and the whole there.
    pub fn at(&self, walk: f64) -> (BiasNoise, Whitened) {
        let noise = self.others.with_walk(self.sensor, walk, 1.0);
        let variance = walk * walk;
        let roots = self.spectra.iter().map(|own| own.at(variance)).collect();
        let log_determinants = self.spectra.iter().map(|own| own.log_determinant(variance));
        let whitened = self
            .projected
            .whitened(&noise, roots, log_determinants.sum());
        (noise, whitened)
    }
}

/// Writes columns `used` of some rows.
fn put(all: &mut Mat<f64>, above: usize, used: &[usize], own: &Mat<f64>) {
    for (k, &column) in used.iter().enumerate() {
        for i in 0..own.nrows() {
            all[(above + i, column)] = own[(i, k)];
        }
    }
}

/// The disagreement at given noise of the biases, whitened.
#[derive(Clone, Debug)]
pub struct Whitened {
    /// `P R z` (`q × 1`), `V⁻¹ = Rᵀ R`, `P` what takes out what the recordings share.
    pub z: Mat<f64>,
    /// Number of rows of `z` of each recording.
    sizes: Vec<usize>,
    /// `R` of each recording.
    roots: Vec<Root>,
    /// An orthonormal basis of what the recordings share (`q × s`).
    taken: Mat<f64>,
    /// `ln det V` and that of `SᵀV⁻¹S`.
    pub log_determinant: f64,
    /// `zᵀ V⁻¹ z`: χ² of `q − s` when nothing is missing.
    pub square: f64,
    /// Log-likelihood of the readings within static intervals.
    within: f64,
}

impl Whitened {
    /// `P R F` (`q × k`) of projected columns.
    pub fn columns(&self, f: &Mat<f64>) -> Mat<f64> {
        let mut w = f.clone();
        let mut above = 0;
        for (q, root) in self.sizes.iter().zip(&self.roots) {
            self.times(root, (above, *q), &mut w);
            above += q;
        }
        if self.taken.ncols() > 0 {
            w -= &self.taken * (self.taken.transpose() * &w);
        }
        w
    }

    /// The same of columns that most recordings have nothing of.
    pub fn by_recording(&self, f: Columns) -> ProjectedColumns {
        self.seen(product(&self.roots, f))
    }

    /// The same of columns that are whitened at other sizes of the noise too.
    pub fn again(&self, f: &mut Kept<'_>) -> ProjectedColumns {
        self.seen(f.times(&self.roots))
    }

    /// With the projection of `R F` onto what the recordings share.
    fn seen(&self, inside: Columns) -> ProjectedColumns {
        let mut taken = Mat::zeros(self.taken.ncols(), inside.ncols());
        let mut above = 0;
        for (part, q) in inside.parts().iter().zip(&self.sizes) {
            if taken.nrows() > 0 {
                let own = self.taken.as_ref().subrows(above, *q).transpose() * &part.values;
                for (k, &column) in part.columns.iter().enumerate() {
                    for i in 0..taken.nrows() {
                        taken[(i, column)] += own[(i, k)];
                    }
                }
            }
            above += q;
        }
        ProjectedColumns { inside, taken }
    }

    /// The same with more columns (`q × k`, whitened) taken out, as if the model had them.
    pub fn beside(&self, columns: &Mat<f64>) -> Self {
        let qr = columns.qr();
        let triangle = qr.thin_R();
        let pivots = (0..triangle.nrows()).map(|k| 2.0 * triangle[(k, k)].abs().ln());
        let basis = qr.compute_thin_Q();
        let mut taken = Mat::zeros(self.z.nrows(), self.taken.ncols() + basis.ncols());
        let (old, new) = taken.as_mut().split_at_col_mut(self.taken.ncols());
        let (mut old, mut new) = (old, new);
        old.copy_from(&self.taken);
        new.copy_from(&basis);
        let z = &self.z - &basis * (basis.transpose() * &self.z);
        Self {
            square: z.squared_norm_l2(),
            z,
            taken,
            log_determinant: self.log_determinant + pivots.sum::<f64>(),
            ..self.clone()
        }
    }

    /// `R` times the `q` rows of a recording that begin at `above`, in those columns that are not zero there.
    fn times(&self, root: &Root, (above, q): (usize, usize), w: &mut Mat<f64>) {
        if let Root::Identity = root {
            return;
        }
        if let [_] = self.roots.as_slice() {
            *w = root.times(std::mem::replace(w, Mat::zeros(0, 0)));
            return;
        }
        let is_used = |k: &usize| (above..above + q).any(|i| w[(i, *k)] != 0.0);
        let used: Vec<usize> = (0..w.ncols()).filter(is_used).collect();
        let own = Mat::from_fn(q, used.len(), |i, k| w[(above + i, used[k])]);
        put(w, above, &used, &root.times(own));
    }

    /// Log-likelihood of the model as it is, up to a constant.
    pub fn log_likelihood(&self) -> f64 {
        self.within - 0.5 * (self.log_determinant + self.square)
    }
}

#[cfg(test)]
mod tests {
    use estimate::methods::joint::{Covariance, Form};
    use faer::linalg::solvers::DenseSolveCore;

    use super::*;

    #[test]
    fn the_square_is_that_of_the_disagreement_under_its_whole_covariance() {
        let j = Mat::from_fn(9, 2, |i, k| ((i * 3 + k * 7) % 5) as f64 - 2.0);
        let r: Vec<f64> = (0..9).map(|i| ((i * 4 % 9) as f64) - 4.0).collect();
        let walk = Mat::from_fn(9, 9, |i, k| (i.min(k) + 1) as f64);
        let component = Component {
            kind: ComponentKind::AccelerometerWalk,
            covariance: Covariance::dense(walk.clone()),
            form: Form::Columns(Columns::none(&RowGroups::whole(9))),
        };
        let one = Columns::cut(&j, &RowGroups::whole(9));
        let projected = Projected::new(&r, &one, (&[component], &[]));
        assert_eq!(projected.dof(), 7);
        let at = projected.at(BiasNoise::walks([0.5, 0.0])).unwrap();
        // zᵀ (Nᵀ(I + k²C)N)⁻¹ z with the inverse written out.
        let v = Mat::<f64>::identity(9, 9) + faer::Scale(0.25) * &walk;
        let null = left_null_space(&j);
        let inner = null.transpose() * (&v * &null);
        let inverse = inner.llt(Side::Lower).unwrap().inverse();
        let direct = (projected.z.transpose() * (inverse * &projected.z))[(0, 0)];
        assert!((at.square / direct - 1.0).abs() < 1e-12);
        assert!(
            (projected.at(BiasNoise::default()).unwrap().square - projected.z.squared_norm_l2())
                .abs()
                < 1e-12
        );
    }

    #[test]
    fn recordings_by_themselves_disagree_as_all_rows_together_do() {
        let whole = Mat::from_fn(24, 7, |i, k| {
            let value = ((i * 7 + k * 5 + i * k) % 11) as f64 - 5.0;
            if k < 3 || i / 12 == k / 5 { value } else { 0.0 }
        });
        let r: Vec<f64> = (0..24).map(|i| ((i * 5 % 13) as f64) - 6.0).collect();
        let walk = Mat::from_fn(12, 12, |i, k| 0.1 * (i.min(k) + 1) as f64);
        let blocks = [0, 12].map(|first| ((first..first + 12).collect(), walk.clone()));
        let component = Component {
            kind: ComponentKind::GyroscopeWalk,
            covariance: Covariance::of_blocks(24, blocks.into()),
            form: Form::Columns(Columns::none(&RowGroups::whole(24))),
        };
        let groups = || RowGroups::new((0..24).map(|i| i / 12).collect());
        let [cut, one] = [groups(), RowGroups::whole(24)].map(|groups| {
            let jacobian = Columns::cut(&whole, &groups);
            Projected::new(&r, &jacobian, (std::slice::from_ref(&component), &[]))
        });
        assert_eq!((cut.dof(), one.dof()), (17, 17));
        // The last is of the second recording alone.
        let e = Mat::from_fn(24, 3, |i, k| {
            let value = ((i * (k + 3)) % 7) as f64;
            if k < 2 || i >= 12 { value } else { 0.0 }
        });
        let at = |projected: &Projected, walk: f64| {
            let whitened = projected.at(BiasNoise::walks([0.0, walk])).unwrap();
            let w = whitened.columns(&projected.columns(e.as_ref()));
            let (gram, moved) = (w.transpose() * &w, w.transpose() * &whitened.z);
            let cut = Columns::cut(&e, &groups());
            let seen = whitened.by_recording(projected.by_recording(&cut));
            let (same, right) = seen.normal(0..3, &whitened.z);
            for i in 0..3 {
                assert!((right[i] - moved[(i, 0)]).abs() < 1e-10 * moved.norm_max());
                for k in 0..3 {
                    assert!((same[(i, k)] - gram[(i, k)]).abs() < 1e-10 * gram.norm_max());
                }
            }
            (whitened.square, whitened.log_likelihood(), gram, moved)
        };
        // From one factorisation of all walks it is the same.
        for projected in [&cut, &one] {
            let along = projected.along_walk(BiasNoise::walks([0.0, 0.2]), Sensor::Gyroscope);
            let (noise, whitened) = along.unwrap().at(0.7);
            let direct = projected.at(noise).unwrap();
            assert!((whitened.square / direct.square - 1.0).abs() < 1e-10);
            let change = whitened.log_likelihood() - direct.log_likelihood();
            assert!(change.abs() < 1e-10 * direct.square);
            let e = Columns::cut(&e, &groups()).regrouped(&projected.rows);
            let e = projected.by_recording(&e);
            let kept = &mut Kept::of(&e);
            for _ in 0..2 {
                let seen = [whitened.again(kept), direct.by_recording(e.clone())];
                let [a, b] = [&whitened, &direct].map(|w| w.z.clone());
                let [a, b] = [seen[0].normal(0..3, &a), seen[1].normal(0..3, &b)];
                assert!((&a.0 - &b.0).amax() < 1e-10 * b.0.amax());
                assert!((&a.1 - &b.1).amax() < 1e-10 * b.1.amax());
            }
        }
        let (a, b) = (at(&cut, 0.7), at(&one, 0.7));
        assert!((a.0 / b.0 - 1.0).abs() < 1e-10);
        assert!((&a.2 - &b.2).norm_max() < 1e-10 * b.2.norm_max());
        assert!((&a.3 - &b.3).norm_max() < 1e-10 * b.3.norm_max());
        let change = |p: &Projected| at(p, 0.7).1 - at(p, 0.0).1;
        assert!((change(&cut) - change(&one)).abs() < 1e-10);
    }
}
