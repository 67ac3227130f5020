//! What a prior of the type is worth, on simulated populations whose best possible answer is known.
//!
//! A device is `θ ~ N(μ, Σ)`, a session `y = θ + e` with a covariance of its own. With `μ` and `Σ` known no estimate has a smaller
//! mean square error than the posterior mean: that is the bound. Who flags one device in a hundred and leaves it as its session
//! found it pays for that with `μ` and `Σ` known, too: the bound of all devices has that rule in it. The study fits the prior to
//! sessions of `devices` devices and applies it to the sessions of others, through `cal.json` as the command does.

use batch::{Session, fit_prior};
use calib::Calibration;
use calib::calibration::{EffectParameter, EffectValues};
use calib::limits::parameter;
use calib::methods::six_position::{Face, Placement, Six, SixPosition};
use calib::prior::{Prior, belonging};
use nalgebra::{DMatrix, DVector};
use rand::SeedableRng;
use rand_chacha::ChaCha8Rng;
use rand_distr::{ChiSquared, Distribution, StandardNormal};

/// Standard errors of a usual session: scale factors and misalignments, biases, g-sensitivity.
const ERRORS: [f64; 3] = [1e-3, 5e-3, 2e-5];

/// A type of devices.
#[derive(Clone, Copy, Debug)]
pub struct Population {
    /// What it is called.
    pub name: &'static str,
    /// Spread of the base parameters in multiples of a session's error.
    pub spread: f64,
    /// Spread of the effect's parameters in the same, where the type has one in common.
    pub effect: Option<f64>,
}

/// The four of the study.
pub const POPULATIONS: [Population; 4] = [
    Population {
        name: "tight",
        spread: 0.5,
        effect: None,
    },
    Population {
        name: "tight, effect in common",
        spread: 0.5,
        effect: Some(0.2),
    },
    Population {
        name: "wide",
        spread: 10.0,
        effect: None,
    },
    Population {
        name: "wide, effect in common",
        spread: 10.0,
        effect: Some(0.2),
    },
];

/// What was measured of a population.
#[derive(Clone, Copy, Debug, Default)]
pub struct Measured {
    /// Root mean square error in session errors: without the prior, with it, and the bound; of the devices that are not flagged.
    pub rms: [f64; 3],
    /// The same of all: a device that is flagged, one in a hundred, keeps what its session says.
    pub rms_of_all: [f64; 3],
    /// Of all devices, with `μ` and `Σ` known and flags by them: no method that flags so many and leaves them does better.
    pub flagging_bound: f64,
    /// Share of 95 % intervals that hold.
    pub coverage: f64,
    /// Share of devices of the population that are flagged.
    pub false_flags: f64,
    /// Share of devices 5 standard deviations off in one parameter that are flagged.
    pub flagged: f64,
}

struct Simulator {
    random: ChaCha8Rng,
    names: Vec<String>,
    unit: DVector<f64>,
    mean: DVector<f64>,
    root: DMatrix<f64>,
}

impl Simulator {
    fn new(population: &Population, seed: u64) -> Self {
        let axes = ["x", "y", "z"];
        let mut names: Vec<String> = ["s_x", "s_y", "s_z", "alpha_yz", "alpha_xz", "alpha_xy"]
            .map(|n| format!("accel.{n}"))
            .to_vec();
        let mut unit = vec![ERRORS[0]; 6];
        names.extend(axes.map(|a| format!("accel.b_{a}")));
        unit.extend([ERRORS[1]; 3]);
        let mut spread = vec![population.spread; 9];
        if let Some(effect) = population.effect {
            names.extend(axes.map(|a| format!("gyro_g_sensitivity.g_{a}{a}")));
            unit.extend([ERRORS[2]; 3]);
            spread.extend([effect; 3]);
        }
        let mut random = ChaCha8Rng::seed_from_u64(seed);
        let n = names.len();
        let unit = DVector::from_vec(unit);
        // Correlated in the type as in a session.
        let mix =
            DMatrix::from_fn(n, n, |_, _| 0.3 * normal(&mut random)) + DMatrix::identity(n, n);
        let scale = DVector::from_fn(n, |k, _| spread[k] * unit[k] / mix.row(k).norm());
        let root = DMatrix::from_diagonal(&scale) * mix;
        let mean = DVector::from_fn(n, |k, _| 3.0 * unit[k] * normal(&mut random));
        Self {
            random,
            names,
            unit,
            mean,
            root,
        }
    }

    fn normals(&mut self) -> DVector<f64> {
        DVector::from_fn(self.names.len(), |_, _| normal(&mut self.random))
    }

    /// A device and its session; `off` moves one parameter by so many standard deviations of type and session.
    fn session(&mut self, off: f64) -> (DVector<f64>, Session) {
        let n = self.names.len();
        let drawn = self.normals();
        let mut theta = &self.mean + &self.root * drawn;
        let mix =
            DMatrix::from_fn(n, n, |_, _| 0.3 * normal(&mut self.random)) + DMatrix::identity(n, n);
        // Sessions differ in length: errors from half to twice the usual.
        let length: f64 = ChiSquared::new(8.0).map_or(1.0, |d| d.sample(&mut self.random) / 8.0);
        let scale = DVector::from_fn(n, |k, _| {
            self.unit[k] / mix.row(k).norm() / length.max(0.1).sqrt()
        });
        let root = DMatrix::from_diagonal(&scale) * mix;
        let covariance = &root * root.transpose();
        if off > 0.0 {
            let k = (self.random_index()) % n;
            let sigma = self.root.row(k).norm_squared() + covariance[(k, k)];
            theta[k] += off * sigma.sqrt();
        }
        let values = &theta + &root * self.normals();
        (
            theta,
            Session {
                id: String::new(),
                values,
                covariance,
            },
        )
    }

    fn random_index(&mut self) -> usize {
        (normal(&mut self.random).abs() * 1e6) as usize
    }
}

fn normal(random: &mut ChaCha8Rng) -> f64 {
    StandardNormal.sample(random)
}

/// A calibration that says what the session says.
fn calibration(template: &Calibration, names: &[String], session: &Session) -> Calibration {
    let mut own = template.clone();
    own.parameters = names.to_vec();
    let n = names.len();
    own.covariance = (0..n)
        .map(|i| (0..n).map(|j| session.covariance[(i, j)]).collect())
        .collect();
    if let Some(triad) = &mut own.accelerometer {
        for (name, value) in names.iter().zip(session.values.iter()) {
            let base = sensor::base_names(sensor::Sensor::Accelerometer);
            match base.iter().position(|own| own == name) {
                Some(k) if k < 9 => {
                    let (i, j) = sensor::PLACES[k];
                    triad.t[i][j] = *value;
                }
                Some(k) => triad.bias[k - 9] = *value,
                None => {}
            }
        }
    }
    let of_effect = names.iter().zip(session.values.iter());
    let parameters: Vec<EffectParameter> = of_effect
        .filter_map(|(name, value)| {
            let name = name.strip_prefix("gyro_g_sensitivity.")?;
            Some(EffectParameter {
                name: name.into(),
                value: *value,
                std: None,
                unit: String::new(),
            })
        })
        .collect();
    if !parameters.is_empty() {
        let name = "gyro_g_sensitivity".to_owned();
        own.effects = vec![EffectValues {
            name,
            definition: None,
            parameters,
            outside: None,
        }];
    }
    own
}

fn template() -> Result<Calibration, calib::Error> {
    let placements = Face::ALL.map(|face| Placement {
        label: face.name().into(),
        accelerometer: face.direction() * 9.8,
        gyroscope: None,
    });
    SixPosition::solve(&Six::sort(placements.to_vec(), 9.80665)?, 9.80665).calibration(false)
}

/// Runs the study on one population.
///
/// # Errors
/// What the library refuses.
pub fn study(
    population: &Population,
    devices: usize,
    others: usize,
    seed: u64,
) -> Result<Measured, Box<dyn std::error::Error>> {
    let mut simulator = Simulator::new(population, seed);
    let mut sessions: Vec<Session> = (0..devices).map(|_| simulator.session(0.0).1).collect();
    // One in fifty of the devices that the prior is fitted to is not of the type.
    for session in sessions.iter_mut().step_by(50) {
        *session = simulator.session(20.0).1;
    }
    let prior = fit_prior(&simulator.names, &sessions)?;
    let sigma = &simulator.root * simulator.root.transpose();
    let template = template()?;
    let mut measured = Measured::default();
    let (mut held, mut intervals, mut used_intervals) = (0_u32, 0_u32, 0_u32);
    for _ in 0..others {
        let (theta, session) = simulator.session(0.0);
        let found = informed(&template, &simulator.names, &session, &prior)?;
        let used = found.prior.as_ref().is_some_and(|used| used.belongs);
        measured.false_flags += f64::from(u8::from(!used)) / others as f64;
        let gain = &session.covariance * inverse(&(&session.covariance + &sigma))?;
        let gap = &simulator.mean - &session.values;
        let best = &session.values + gain * &gap;
        let known = belonging(&gap, &(&session.covariance + &sigma)).ok_or("no covariance")?;
        for (k, name) in simulator.names.iter().enumerate() {
            let (value, _) = parameter(&found, name).ok_or("lost")?;
            let std = found.covariance[k][k].sqrt();
            let square = |v: f64| ((v - theta[k]) / simulator.unit[k]).powi(2);
            let own = [session.values[k], value, best[k]].map(square);
            for (at, v) in own.into_iter().enumerate() {
                measured.rms_of_all[at] += v;
                measured.rms[at] += if used { v } else { 0.0 };
            }
            let left = if known.belongs() {
                best[k]
            } else {
                session.values[k]
            };
            measured.flagging_bound += square(left);
            used_intervals += u32::from(used);
            held += u32::from((value - theta[k]).abs() < 1.959_964 * std);
            intervals += 1;
        }
        let (_, outside) = simulator.session(5.0);
        let found = informed(&template, &simulator.names, &outside, &prior)?;
        let flagged = found.prior.as_ref().is_some_and(|used| !used.belongs);
        measured.flagged += f64::from(u8::from(flagged)) / others as f64;
    }
    measured.rms_of_all = measured
        .rms_of_all
        .map(|sum| (sum / f64::from(intervals)).sqrt());
    measured.rms = measured
        .rms
        .map(|sum| (sum / f64::from(used_intervals)).sqrt());
    measured.flagging_bound = (measured.flagging_bound / f64::from(intervals)).sqrt();
    measured.coverage = f64::from(held) / f64::from(intervals);
    Ok(measured)
}

fn informed(
    template: &Calibration,
    names: &[String],
    session: &Session,
    prior: &Prior,
) -> Result<Calibration, calib::Error> {
    let mut own = calibration(template, names, session);
    prior.inform(&mut own)?;
    Ok(own)
}

fn inverse(m: &DMatrix<f64>) -> Result<DMatrix<f64>, &'static str> {
    Ok(m.clone().cholesky().ok_or("no covariance")?.inverse())
}
