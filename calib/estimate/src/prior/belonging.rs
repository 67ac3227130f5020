//! Test that a device belongs to its type.
//!
//! Mean and covariance of a type are themselves estimated, from `D` devices. Against a covariance of `ν` degrees of freedom a
//! distance in `p` parameters is `d² (ν − p + 1)/(ν p) ~ F(p, ν − p + 1)` and a single deviation is a `t` of `ν`: with
//! `ν = D − 1` and `1 + 1/D` in the covariance that is the limit of a chart of single observations in phase II (NIST/SEMATECH
//! e-Handbook of Statistical Methods, 6.5.4.3.4). Judged as `χ²`, one sound device in seven is refused at `p = 21`, `D = 65`.

use nalgebra::{DMatrix, DVector};

use crate::methods::chance;

findings::tuning! {
    /// A device of the type is refused in one of so many.
    pub FALSE_FLAGS: f64 = 0.01;

    /// Share of that for the parameter that is furthest: what is wrong with a device is mostly one thing. The remainder is for
    /// all parameters together.
    ONE_PARAMETER: f64 = 0.8;
    /// Degrees of freedom from which a covariance counts as known.
    KNOWN: f64 = 1e7;
}

/// A device against its type.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Belonging {
    /// Chance of a device of the type being so far out.
    pub p_value: f64,
    /// The parameter that is furthest.
    pub furthest: usize,
    /// By how many standard deviations.
    pub deviation: f64,
}

impl Belonging {
    /// Returns true if the device belongs to the type.
    pub fn belongs(&self) -> bool {
        self.p_value >= FALSE_FLAGS.get()
    }
}

/// A type as it was estimated from the sessions of its devices.
#[derive(Clone, Copy, Debug)]
pub struct EstimatedType<'a> {
    /// `Σ`, `p × p`: spread from device to device.
    pub covariance: &'a DMatrix<f64>,
    /// `V`, `p × p`: covariance of the error of the mean.
    pub mean_covariance: &'a DMatrix<f64>,
    /// `D`, devices that both were estimated from.
    pub devices: usize,
}

impl EstimatedType<'_> {
    /// Judges the deviation from the mean of a device that had no say in the estimate; none where the covariance is none.
    ///
    /// The deviation's covariance is `T = Σ + V + C` with the session's `C`. What is estimated of it are `Σ + V`, from values
    /// that scatter by `Σ` and the errors of the sessions of then, `D V` together: a Wishart matrix of mean `X = (D + 1) V` and
    /// `D − 1` degrees of freedom, less what is known. Where today's session is worse than those, `T` is known better than
    /// `X`; where it is better, worse.
    pub fn belonging(&self, deviation: &DVector<f64>, session: &DMatrix<f64>) -> Option<Belonging> {
        let devices = self.devices.max(2) as f64;
        let sampled = self.mean_covariance * (devices + 1.0);
        let total = self.covariance + self.mean_covariance + session;
        judged(deviation, &total, &sampled, devices - 1.0)
    }
}

/// Judges a deviation from a mean that is known, of a covariance that is known; none where the covariance is none.
pub fn belonging(deviation: &DVector<f64>, covariance: &DMatrix<f64>) -> Option<Belonging> {
    let n = deviation.len();
    judged(deviation, covariance, &DMatrix::zeros(n, n), 1.0)
}

/// The largest of the parameters' own deviations by Šidák's bound, and all together by the distance, where `sampled` of
/// `freedom` degrees of freedom is what errs in `covariance`.
fn judged(
    deviation: &DVector<f64>,
    covariance: &DMatrix<f64>,
    sampled: &DMatrix<f64>,
    freedom: f64,
) -> Option<Belonging> {
    let n = deviation.len();
    let scale = DVector::from_fn(n, |k, _| covariance[(k, k)].sqrt());
    let unit = |m: &DMatrix<f64>| DMatrix::from_fn(n, n, |i, j| m[(i, j)] / (scale[i] * scale[j]));
    let z = deviation.component_div(&scale);
    let sampled = unit(sampled);
    // A variance of `T` of which `X` is estimated has the relative error of `ν (T/X)²` degrees of freedom.
    let tails = (0..n).map(|k| tail(z[k], freedom / sampled[(k, k)].powi(2)));
    let (furthest, tail) = tails.enumerate().min_by(|a, b| {
        a.1.total_cmp(&b.1)
            .then(z[b.0].abs().total_cmp(&z[a.0].abs()))
    })?;
    let factor = unit(covariance).cholesky()?;
    let all = distance_tail(
        z.dot(&factor.solve(&z)),
        n as f64,
        freedom * of_one_degree(&factor.solve(&sampled)),
    );
    let one = -(n as f64 * (-tail).ln_1p()).exp_m1();
    let p_value = (one / ONE_PARAMETER.get())
        .min(all / (1.0 - ONE_PARAMETER.get()))
        .min(1.0);
    p_value.is_finite().then_some(Belonging {
        p_value,
        furthest,
        deviation: z[furthest],
    })
}

/// Degrees of freedom of a Wishart matrix of mean `T` with the error of one of mean `X` and one degree, from `M = T⁻¹ X`.
///
/// With `E` the error, `E tr((E T⁻¹)²)` is `(tr²(M) + tr(M²))/ν` for the one and `(p² + p)/ν` for the other.
fn of_one_degree(m: &DMatrix<f64>) -> f64 {
    let n = m.nrows() as f64;
    let trace = m.trace();
    (n * n + n) / (trace * trace + m.dot(&m.transpose()))
}

/// Chance of `|z|` or more on both sides.
fn tail(z: f64, freedom: f64) -> f64 {
    match freedom < KNOWN.get() {
        true => chance::of_t(z, freedom),
        false => chance::of_chi2(z * z, 1.0),
    }
}

/// Chance of a squared distance of `squared` or more in `n` parameters; 1 where the degrees of freedom are too few to tell.
fn distance_tail(squared: f64, n: f64, freedom: f64) -> f64 {
    if freedom >= KNOWN.get() {
        return chance::of_chi2(squared, n);
    }
    let left = freedom - n + 1.0;
    chance::of_f(squared * left / (freedom * n), [n, left])
}

#[cfg(test)]
mod tests {
    use rand::SeedableRng;
    use rand_chacha::ChaCha8Rng;
    use rand_distr::{Distribution, StandardNormal};

    use super::*;

    fn normals(random: &mut ChaCha8Rng, n: usize) -> DVector<f64> {
        DVector::from_fn(n, |_, _| StandardNormal.sample(random))
    }

    /// Shares of devices that are flagged: sound ones, and ones 6 spreads off in one parameter. Fleets of sessions with errors of
    /// `then` spreads, new sessions with errors of `now`; `Σ` and `V` of sessions with equal errors have a closed form.
    fn flagged(p: usize, devices: usize, [then, now]: [f64; 2]) -> [f64; 2] {
        let mut random = ChaCha8Rng::seed_from_u64(7 + (p * devices) as u64);
        let session = DMatrix::identity(p, p) * (now * now);
        let spread = (1.0 + then * then).sqrt();
        let seen = (1.0 + now * now).sqrt();
        let (fleets, each) = (10, 200);
        let mut counts = [0_u32; 2];
        for _ in 0..fleets {
            let fleet: Vec<_> = (0..devices)
                .map(|_| normals(&mut random, p) * spread)
                .collect();
            let d = devices as f64;
            let mean = fleet.iter().fold(DVector::zeros(p), |sum, v| sum + v) / d;
            let whole = fleet.iter().fold(DMatrix::zeros(p, p), |sum, v| {
                let g = v - &mean;
                sum + &g * g.transpose()
            }) / (d - 1.0);
            let known = EstimatedType {
                covariance: &(&whole - DMatrix::identity(p, p) * (then * then)),
                mean_covariance: &(&whole / d),
                devices,
            };
            for k in 0..each {
                let mut gap = normals(&mut random, p) * seen - &mean;
                let belongs =
                    |gap: &DVector<f64>| known.belonging(gap, &session).unwrap().belongs();
                counts[0] += u32::from(!belongs(&gap));
                gap[k % p] += 6.0 * seen;
                counts[1] += u32::from(!belongs(&gap));
            }
        }
        counts.map(|count| f64::from(count) / f64::from(fleets * each as u32))
    }

    #[test]
    fn one_sound_device_in_a_hundred_is_flagged_however_few_the_type_is_from() {
        for (p, devices) in [(9, 65), (9, 100), (21, 65), (21, 100)] {
            // Errors of sessions in spreads: none to speak of, as large as the spread, worse today than then.
            for errors in [[0.0, 0.0], [1.0, 1.0], [0.5, 2.0]] {
                let [sound, off] = flagged(p, devices, errors);
                let of = format!("{p} parameters, {devices} devices, {errors:?}: {sound}, {off}");
                // 2000 of one in a hundred: ± 0.2 %, and fleets differ by half a per cent.
                assert!((0.003..0.025).contains(&sound), "{of}");
                assert!(off > 0.9, "{of}");
            }
        }
    }

    /// One parameter, no error of the session: a `t` with `D − 1` degrees of freedom and a variance of `s² (1 + 1/D)`.
    #[test]
    fn one_parameter_is_judged_by_its_t() {
        let one = |v: f64| DMatrix::from_element(1, 1, v);
        let known = EstimatedType {
            covariance: &one(4.0),
            mean_covariance: &one(0.4),
            devices: 10,
        };
        // 2.262 is the 0.975 quantile of 9 degrees of freedom in every table.
        let gap = DVector::from_element(1, 2.262_157 * 4.4_f64.sqrt());
        let found = known.belonging(&gap, &one(0.0)).unwrap();
        assert!((found.p_value - 0.05 / ONE_PARAMETER.get()).abs() < 1e-6);
        assert!((found.deviation - 2.262_157).abs() < 1e-12);
    }
}
