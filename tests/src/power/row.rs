//! What is hidden in the sessions of each row.

use std::f64::consts::TAU;

use calib::simulate::{
    Fault, Grade, Heading, Hidden, Pattern, Periodic, Relaxation, Rezeroing, SizeEffect, Spec,
    Telegraph,
};
use rand::{RngExt, SeedableRng};
use rand_chacha::ChaCha8Rng;
use sensor::{Axis, Sensor};
use serde::{Deserialize, Serialize};

use super::formulas;
use crate::conditions::condition;

/// The usual random walk of the biases of a consumer-grade device, m/s²/√s and rad/s/√s.
const WALK: [f64; 2] = [1e-4, 5e-6];

/// A tactical device has a tenth of a consumer device's errors.
const TACTICAL: f64 = 0.1;

/// Effects that go with orientation or rate.
const ORIENTATION: [&str; 16] = [
    "accel_quadratic",
    "accel_cubic",
    "accel_asymmetry",
    "accel_cross_axis",
    "accel_scale_temperature",
    "accel_hysteresis",
    "accel_vibration_rectification",
    "gyro_g_sensitivity",
    "gyro_g2_sensitivity",
    "gyro_scale_temperature",
    "gyro_quadratic",
    "gyro_cubic",
    "gyro_asymmetry",
    "gyro_delay",
    "earth_rate",
    "time_offset",
];

/// Effects that go with time.
const TIME: [&str; 9] = [
    "accel_drift",
    "accel_warmup",
    "accel_step",
    "accel_temperature",
    "accel_temperature_quadratic",
    "gyro_drift",
    "gyro_warmup",
    "gyro_step",
    "gyro_temperature",
];

/// Effects that joined the catalogue later.
const NEWER: [&str; 10] = [
    "accel_scale_drift",
    "gyro_scale_drift",
    "accel_misalignment_temperature",
    "accel_temperature_rate",
    "accel_thermal_hysteresis",
    "gyro_misalignment_temperature",
    "gyro_temperature_quadratic",
    "gyro_temperature_rate",
    "gyro_thermal_hysteresis",
    "gyro_vibration_rectification",
];

const OUTSIDE: [&str; 5] = ["periodic", "pattern", "telegraph", "heading", "relaxation"];
const INVISIBLE: [&str; 3] = ["wrong_gravity", "fast_clock", "size_effect"];
const INTEGRITY: [&str; 6] = [
    "saturation",
    "quantisation",
    "lost_samples",
    "lost_neighbours",
    "mount_slip",
    "disturbed_interval",
];
const ALTERED: [&str; 2] = ["dead_zone", "rezeroing"];
const CLEAN: [&str; 6] = [
    "consumer, no walk",
    "consumer, usual walk",
    "consumer, three times the usual walk",
    "tactical, no walk",
    "tactical, usual walk",
    "tactical, three times the usual walk",
];

/// Nothing hidden, under conditions of the coverage study: the rows.
const CONDITIONS: [&str; 12] = [
    "clean",
    "clean-tactical",
    "walk",
    "jitter-2",
    "jitter-2-tactical",
    "stamps-1",
    "flicker",
    "low-pass",
    "tremor-5",
    "quantised-1",
    "earth",
    "knocks-point",
];

/// Claims that are right under a condition although nothing is hidden.
const RIGHT: [(&str, &[&str]); 2] = [
    ("earth", &["earth_rate"]),
    ("knocks-point", &["undersampled_motion"]),
];

/// A row of the table.
#[derive(Clone, Copy, Debug, PartialEq, Eq, clap::ValueEnum, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Row {
    /// Nothing hidden.
    Clean,
    /// Nothing hidden, under every condition.
    Conditions,
    /// What this kind of data cannot show.
    Invisible,
    /// Effects that go with orientation or rate, lambda 60.
    Orientation60,
    /// The same, lambda 30.
    Orientation30,
    /// Effects that joined the catalogue later, lambda 60.
    Newer60,
    /// Effects that go with time, lambda 150, random walk unknown.
    Time150,
    /// The same, lambda 60, densities given.
    Time60,
    /// Pairs of effects, lambda 60 each.
    Pairs,
    /// The same, lambda 150 each.
    Pairs150,
    /// Outside the catalogue, lambda 150.
    Outside,
    /// Faults of the recording, lambda 60 where they have a size.
    Integrity,
    /// Formulas that no effect has, lambda 150.
    Formulas,
    /// Formulas that every axis has with a coefficient of its own, lambda 150.
    FormulasOfAxes150,
    /// The same, lambda 600.
    FormulasOfAxes600,
    /// A gyroscope's bias that the device hides or changes.
    Altered,
}

impl Row {
    /// The kinds of session, taken in turn.
    fn kinds(self) -> &'static [&'static str] {
        match self {
            Self::Clean => &CLEAN,
            Self::Conditions => &CONDITIONS,
            Self::Invisible => &INVISIBLE,
            Self::Orientation60 | Self::Orientation30 => &ORIENTATION,
            Self::Newer60 => &NEWER,
            Self::Time150 | Self::Time60 => &TIME,
            Self::Pairs | Self::Pairs150 => &["pair"],
            Self::Outside => &OUTSIDE,
            Self::Integrity => &INTEGRITY,
            Self::Formulas => &formulas::NAMES,
            Self::FormulasOfAxes150 | Self::FormulasOfAxes600 => &formulas::NAMES_ON_ALL_AXES,
            Self::Altered => &ALTERED,
        }
    }

    /// What kind of session has this number.
    fn kind(self, index: u64) -> &'static str {
        let kinds = self.kinds();
        kinds[(index % kinds.len() as u64) as usize]
    }

    /// Whether the session of this number hides this.
    pub fn hides(self, index: u64, what: &str) -> bool {
        self.kind(index) == what
    }

    /// The seed of the row: that of a row stays when others join.
    fn seed(self) -> u64 {
        match self {
            Self::Clean => 0,
            Self::Invisible => 1,
            Self::Orientation60 => 2,
            Self::Orientation30 => 3,
            Self::Time150 => 4,
            Self::Time60 => 5,
            Self::Pairs => 6,
            Self::Outside => 7,
            Self::Integrity => 8,
            Self::Conditions => 9,
            Self::Newer60 => 10,
            Self::Formulas => 11,
            Self::Pairs150 => 12,
            Self::Altered => 13,
            Self::FormulasOfAxes150 => 14,
            Self::FormulasOfAxes600 => 15,
        }
    }

    /// Sessions that the issue asks for.
    pub fn sessions(self) -> u64 {
        match self {
            Self::Clean => 500,
            Self::Conditions => 100 * CONDITIONS.len() as u64,
            Self::Invisible => 60,
            Self::Orientation60 | Self::Orientation30 => 50 * ORIENTATION.len() as u64,
            Self::Newer60 => 50 * NEWER.len() as u64,
            Self::Time150 | Self::Time60 => 50 * TIME.len() as u64,
            Self::Pairs | Self::Pairs150 => 100,
            Self::Outside => 50 * OUTSIDE.len() as u64,
            Self::Integrity => 40 * INTEGRITY.len() as u64,
            Self::Formulas | Self::FormulasOfAxes150 | Self::FormulasOfAxes600 => {
                20 * self.kinds().len() as u64
            }
            Self::Altered => 40 * ALTERED.len() as u64,
        }
    }

    /// The noncentrality that everything hidden is scaled to.
    pub fn lambda(self) -> f64 {
        match self {
            Self::Orientation30 => 30.0,
            Self::Time150
            | Self::Pairs150
            | Self::Outside
            | Self::Formulas
            | Self::FormulasOfAxes150 => 150.0,
            Self::FormulasOfAxes600 => 600.0,
            _ => 60.0,
        }
    }
}

/// One session to be made.
#[derive(Clone, Debug)]
pub struct Job {
    /// The row.
    pub row: Row,
    /// What kind of session of the row.
    pub kind: String,
    /// The names that are right.
    pub hidden: Vec<String>,
    /// Claims that are right although nothing is hidden.
    pub right: Vec<String>,
    /// The session with nothing hidden.
    pub clean: Spec,
    /// Random walk densities.
    pub walks: [f64; 2],
    /// Whether the analysis is told them.
    pub told: bool,
    /// Time constant of what warms up, s.
    tau: f64,
    random: ChaCha8Rng,
}

impl Job {
    /// The `index`-th session of a row; half of the devices are tactical.
    pub fn new(row: Row, index: u64) -> Self {
        let (kind, count) = (row.kind(index), row.kinds().len() as u64);
        let round = index / count;
        let (tactical, times) = match row {
            Row::Clean => {
                let k = index % count;
                (k >= 3, [0.0, 1.0, 3.0][(k % 3) as usize])
            }
            _ => (round % 2 == 1, 1.0),
        };
        let mut random = ChaCha8Rng::seed_from_u64(1_000_003 * (row.seed() + 1) + index);
        let seed = random.random();
        let mut clean = Spec::hand_held(seed);
        let mut walks = WALK.map(|k| times * k);
        if tactical {
            clean.grade = Grade::Tactical;
            walks = walks.map(|k| TACTICAL * k);
        }
        clean.accelerometer.random_walk = walks[0];
        clean.gyroscope.random_walk = walks[1];
        if let (Row::Conditions, Some(condition)) = (row, condition(kind)) {
            clean = condition.spec(seed >> 32);
        }
        let mut job = Self {
            row,
            kind: kind.into(),
            right: right(kind),
            hidden: Vec::new(),
            clean,
            walks,
            told: row == Row::Time60,
            tau: 120.0,
            random,
        };
        job.hide(kind);
        job
    }

    /// What is to be named, and what the clean session needs for it to show.
    fn hide(&mut self, kind: &str) {
        self.hidden = match self.row {
            Row::Clean
            | Row::Conditions
            | Row::Invisible
            | Row::Outside
            | Row::Formulas
            | Row::FormulasOfAxes150
            | Row::FormulasOfAxes600 => Vec::new(),
            Row::Pairs | Row::Pairs150 => self.pair(),
            // The stamps are closed up: nothing shows that samples are lost.
            Row::Integrity if kind.starts_with("lost") => vec!["outlying_turn".into()],
            _ => vec![kind.into()],
        };
        for name in self.hidden.clone() {
            if name.contains("therm") || name.contains("temperature") {
                let temperature = self.clean.temperature.get_or_insert_default();
                temperature.swing = 3.0;
                temperature.period = self.random.random_range(150.0..400.0);
            }
            if name.contains("vibration") {
                self.clean.vibration.get_or_insert_default();
            }
            if name.ends_with("_warmup") {
                self.tau = self.random.random_range(60.0..300.0);
            }
        }
    }

    /// Two effects of the catalogue; which ones changes with every fifth session.
    fn pair(&mut self) -> Vec<String> {
        let all: Vec<&str> = ORIENTATION.iter().chain(&TIME[..4]).copied().collect();
        let a = self.random.random_range(0..all.len());
        let b = (a + self.random.random_range(1..all.len())) % all.len();
        vec![all[a].into(), all[b].into()]
    }

    /// The clean session with one hidden thing of a size; `None` for what has no size.
    pub fn with(&self, what: &str, size: f64) -> Option<Spec> {
        let mut spec = self.clean.clone();
        match self.row {
            Row::Clean | Row::Conditions => return None,
            Row::Orientation60
            | Row::Orientation30
            | Row::Newer60
            | Row::Time150
            | Row::Time60
            | Row::Pairs
            | Row::Pairs150 => {
                spec = spec.with_effect(what, size);
                if what.ends_with("_warmup") {
                    spec.parameters.insert(format!("{what}.tau"), self.tau);
                }
            }
            Row::Invisible => spec = spec.with_hidden(invisible(what, size)),
            Row::Outside => spec = spec.with_hidden(self.outside(what, size)),
            Row::Formulas | Row::FormulasOfAxes150 | Row::FormulasOfAxes600 => {
                spec = formulas::Hidden::named(what)?.put_into(spec, size)?;
            }
            Row::Altered if what == "dead_zone" => return None,
            Row::Altered => {
                spec = spec.with_hidden(Hidden::Rezeroing(Rezeroing {
                    sensor: Sensor::Gyroscope,
                    amplitude: 2e-4 * size,
                    after: self.random.clone().random_range(2.0..4.0),
                }));
            }
            Row::Integrity => {
                let fault = self.fault(what, size)?;
                if let ("lost_neighbours", Fault::Lost { turn, length }) = (what, &fault) {
                    let (turn, length) = (turn + 1, *length);
                    spec = spec.with_fault(Fault::Lost { turn, length });
                }
                spec = spec.with_fault(fault);
            }
        }
        Some(spec)
    }

    /// What is hidden in the session, by name.
    pub fn what(&self) -> Vec<String> {
        match self.row {
            Row::Clean | Row::Conditions => Vec::new(),
            Row::Pairs | Row::Pairs150 => self.hidden.clone(),
            _ => vec![self.kind.clone()],
        }
    }

    fn outside(&self, what: &str, size: f64) -> Hidden {
        let mut random = self.random.clone();
        let sensor = if random.random() {
            Sensor::Accelerometer
        } else {
            Sensor::Gyroscope
        };
        let axis = [Axis::X, Axis::Y, Axis::Z][random.random_range(0..3)];
        let amplitude = size
            * if sensor == Sensor::Accelerometer {
                5e-3
            } else {
                1e-4
            };
        match what {
            "periodic" => Hidden::Periodic(Periodic {
                sensor,
                axis,
                amplitude,
                period: random.random_range(25.0..120.0),
                phase: random.random_range(0.0..TAU),
            }),
            "pattern" => Hidden::Pattern(Pattern {
                sensor,
                axis,
                amplitude,
                wavenumber: 7.0,
            }),
            "telegraph" => Hidden::Telegraph(Telegraph {
                sensor,
                axis,
                amplitude,
                dwell: random.random_range(15.0..50.0),
            }),
            "heading" => Hidden::Heading(Heading {
                sensor,
                amplitude,
                azimuth: random.random_range(0.0..TAU),
            }),
            _ => Hidden::Relaxation(Relaxation {
                sensor,
                axis,
                amplitude,
                tau: random.random_range(1.0..6.0),
            }),
        }
    }

    /// A fault at a random placement; `None` where it is no fault of the motion.
    fn fault(&self, what: &str, size: f64) -> Option<Fault> {
        let mut random = self.random.clone();
        let interval = random.random_range(3..22);
        match what {
            "mount_slip" => Some(Fault::Slip {
                interval,
                angle: 1.5e-3 * size,
            }),
            "disturbed_interval" => Some(Fault::Disturbed {
                interval,
                size: 2e-2 * size,
            }),
            "lost_samples" | "lost_neighbours" => Some(Fault::Lost {
                turn: interval,
                length: 0.05 * size,
            }),
            _ => None,
        }
    }
}

/// Claims that are right under this condition.
fn right(kind: &str) -> Vec<String> {
    let own = RIGHT.iter().find(|(name, _)| *name == kind);
    let own = own.map_or(&[][..], |(_, right)| right);
    own.iter().map(|name| (*name).into()).collect()
}

fn invisible(what: &str, size: f64) -> Hidden {
    match what {
        "wrong_gravity" => Hidden::WrongGravity {
            amplitude: 2e-3 * size,
        },
        "fast_clock" => Hidden::FastClock {
            amplitude: 1e-3 * size,
        },
        _ => Hidden::SizeEffect(SizeEffect {
            amplitude: 5e-3 * size,
        }),
    }
}
