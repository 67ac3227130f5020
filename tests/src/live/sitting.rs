//! One guided session from its first sample to its calibration.

use std::time::Duration;

use calib::calibrate::calibrate;
use calib::recording::ReadOptions;
use calib::{Calibration, Recording};
use live::{Aim, Instruction, Opening, Session, Waits, open};
use rand::{RngExt, SeedableRng};
use rand_chacha::ChaCha8Rng;

use super::person::{Habits, Person};
use super::phone::Phone;
use super::server::Server;

/// Polls after which a session has not ended: ten minutes.
const LONGEST: usize = 2400;
/// As the command line waits for a phone that does not answer.
const PATIENCE: Duration = Duration::from_secs(180);

/// How a session went.
#[derive(Clone, Debug)]
pub struct Sitting {
    /// Placements that were planned.
    pub planned: usize,
    /// Placements that the person made.
    pub made: usize,
    /// Placements that were counted.
    pub counted: usize,
    /// Length, s.
    pub seconds: f64,
    /// Pauses, connections lost, words about hands and speed.
    pub incidents: [usize; 4],
    /// The calibration of what the session left, or why there is none.
    pub calibration: Result<Calibration, String>,
    /// Errors of its parameters over their standard errors.
    pub normalised: Vec<f64>,
    /// Why the phone's own file was not taken, where it was not.
    pub fallback: Option<String>,
}

impl Sitting {
    /// Whether it ended with a calibration of both sensors in at most 1.2 times the planned placements.
    pub fn is_good(&self) -> bool {
        let both = self
            .calibration
            .as_ref()
            .is_ok_and(|c| c.accelerometer.is_some() && c.gyroscope.is_some());
        both && self.made * 5 <= self.planned * 6
    }
}

/// What goes wrong in the session of a seed: one kind in six of seven seeds in turn, all of them in the seventh.
pub const KINDS: [&str; 7] = [
    "nothing goes wrong",
    "held in the hand",
    "wrong faces",
    "too fast and touched",
    "the phone pauses",
    "out of reach",
    "all of it",
];

/// The kind of a seed, an index of [`KINDS`].
pub fn kind(seed: u64) -> usize {
    (seed % 7) as usize
}

/// The phone and the person of a seed.
pub fn phone(seed: u64) -> Phone {
    let mut rng = ChaCha8Rng::seed_from_u64(seed ^ 0x73_69_74);
    let has = |what: usize| [what, KINDS.len() - 1].contains(&kind(seed));
    let if_has = |what: usize, share: f64| if has(what) { share } else { 0.0 };
    let habits = Habits {
        in_the_hand: if_has(1, 0.4),
        wrong_face: if_has(2, 0.25),
        hasty: has(3),
        impatient: if_has(3, 0.05),
    };
    let mut times =
        |count: usize| -> Vec<f64> { (0..count).map(|_| rng.random_range(8.0..90.0)).collect() };
    let pauses = times(if has(4) { 2 } else { 0 });
    let drops = times(if has(5) { 4 } else { 0 });
    // The last one is that of a phone that is carried out of the network.
    let lengths = [6.0, 6.0, 6.0, 60.0];
    let drops = drops.into_iter().zip(lengths);
    let drops = drops.map(|(from, length)| [from, from + length]);
    Phone::new(Person::new(habits, seed), seed)
        .pausing(pauses)
        .dropping(drops.collect())
}

/// Holds a session of `planned` placements with the phone and the person of `seed`.
///
/// # Errors
/// What keeps the session from being held at all: no port, no folder, a phone that is lost for good.
pub fn sit(seed: u64, planned: usize) -> Result<Sitting, Box<dyn std::error::Error>> {
    sit_with(phone(seed), planned)
}

/// Holds a session of `planned` placements with a phone.
///
/// # Errors
/// As [`sit`].
pub fn sit_with(phone: Phone, planned: usize) -> Result<Sitting, Box<dyn std::error::Error>> {
    let server = Server::start(phone)?;
    let folder = tempfile::tempdir()?;
    let how = Opening {
        folder: folder.path().to_owned(),
        read: ReadOptions::default(),
        baud: 0,
        patience: PATIENCE,
        waits: Waits::default(),
    };
    let mut source = open(&server.address, &how)?;
    let aim = Aim {
        placements: planned,
        ..Aim::default()
    };
    let request = aim.request.clone();
    let mut session = Session::new(aim);
    let mut incidents = [0; 4];
    for _ in 0..LONGEST {
        let now = Duration::from_secs_f64(server.phone().seconds());
        let batch = source.poll(now)?;
        server
            .phone()
            .wait(batch.pause.unwrap_or_default().as_secs_f64());
        for said in session.take(&batch) {
            let kinds = [
                matches!(said, Instruction::Paused),
                matches!(said, Instruction::Reconnecting),
                matches!(said, Instruction::LetGo { .. }),
                matches!(said, Instruction::TooFast { .. }),
            ];
            incidents
                .iter_mut()
                .zip(kinds)
                .for_each(|(n, is)| *n += usize::from(is));
        }
        server.phone().tell(session.instruction());
        if session.instruction().ends() {
            break;
        }
    }
    let made = server.phone().person.placements;
    let seconds = server.phone().seconds();
    let finished = source.finish()?;
    let recording = Recording::read(&finished.recording, &ReadOptions::default());
    let outcome =
        recording.and_then(|recording| calibrate(&[recording.decimated()], &[], &request));
    let calibration = outcome
        .map(|outcome| outcome.calibration)
        .map_err(|e| e.to_string());
    let normalised = calibration
        .as_ref()
        .map_or(Vec::new(), |c| normalised(c, &server.phone()));
    Ok(Sitting {
        planned,
        made,
        counted: session.placements().len(),
        seconds,
        incidents,
        calibration,
        normalised,
        fallback: finished.fallback,
    })
}

/// Estimate less truth over standard error, of every parameter that has one.
fn normalised(calibration: &Calibration, phone: &Phone) -> Vec<f64> {
    let triads = [&calibration.accelerometer, &calibration.gyroscope];
    let mut all = Vec::new();
    for (triad, truth) in triads.into_iter().zip(&phone.errors) {
        let Some(triad) = triad else { continue };
        for i in 0..3 {
            let bias = triad.bias_std[i].map(|std| (triad.bias[i] - truth.bias[i]) / std);
            let matrix =
                (0..3).filter_map(|j| Some((triad.t[i][j] - truth.t[(i, j)]) / triad.t_std[i][j]?));
            all.extend(matrix.chain(bias));
        }
    }
    all
}
