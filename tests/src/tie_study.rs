//! Effects that a session cannot tell apart, and whether the recording that is planned for them does.

use calib::Error;
use calib::discover::{Conditions, Discovery, Request, Rivalry, ShownBy, discover, separate};
use calib::methods::joint::BiasNoise;
use calib::simulate::{Motion, Session, Spec};
use plan::Timing;

use crate::power::{Row, hidden_in};

/// Added to the seed of a session for that of the planned one.
const PLANNED: u64 = 1 << 40;

/// A tie of the power study.
#[derive(Clone, Copy, Debug)]
pub struct Tie {
    /// The row of the power study that it is in.
    pub row: Row,
    /// What is hidden.
    pub hidden: &'static str,
    /// What it is tied to.
    pub other: &'static str,
    /// Whether the device may be warmed.
    pub warmed: bool,
}

const fn tie(row: Row, hidden: &'static str, other: &'static str) -> Tie {
    Tie {
        row,
        hidden,
        other,
        warmed: false,
    }
}

/// Those that occur in the power study's sessions, either of the two being hidden.
pub const TIES: [Tie; 10] = [
    tie(Row::Orientation60, "accel_quadratic", "accel_asymmetry"),
    tie(Row::Orientation60, "accel_asymmetry", "accel_quadratic"),
    tie(Row::Orientation60, "gyro_quadratic", "gyro_asymmetry"),
    tie(Row::Orientation60, "gyro_asymmetry", "gyro_quadratic"),
    tie(Row::Time60, "accel_drift", "accel_warmup"),
    tie(Row::Time60, "accel_warmup", "accel_drift"),
    tie(Row::Time60, "gyro_drift", "gyro_warmup"),
    tie(Row::Time60, "gyro_warmup", "gyro_drift"),
    tie(
        Row::Time60,
        "accel_temperature",
        "accel_temperature_quadratic",
    )
    .warmed(),
    tie(
        Row::Time60,
        "accel_temperature_quadratic",
        "accel_temperature",
    )
    .warmed(),
];

impl Tie {
    const fn warmed(mut self) -> Self {
        self.warmed = true;
        self
    }

    /// The first `count` sessions of the row from `first` on that have the tie, each followed through; at most `most` sessions
    /// are looked into.
    ///
    /// # Errors
    /// As [`follow`].
    pub fn outcomes(&self, first: u64, count: usize, most: u64) -> Result<Vec<Outcome>, Error> {
        let all = (first..).filter(|index| self.row.hides(*index, self.hidden));
        let mut found = Vec::new();
        for index in all.take(most as usize) {
            found.extend(follow(self, index)?);
            if found.len() == count {
                break;
            }
        }
        Ok(found)
    }
}

/// What became of one session.
#[derive(Clone, Debug)]
pub struct Outcome {
    /// Its place in the row.
    pub index: u64,
    /// What was named first.
    pub named: String,
    /// `λ (1 − ρ²)` before.
    pub before: f64,
    /// As planned.
    pub after: f64,
    /// Placements of the plan.
    pub placements: usize,
    /// Minutes that it takes.
    pub minutes: f64,
    /// What was named with both recordings, with its ties.
    pub found: Vec<(String, Vec<String>)>,
    /// Why neither was.
    pub refused: Option<String>,
    /// What the plan says would help where it does not.
    pub shown_by: ShownBy,
    /// Statistic and degrees of freedom of what is hidden and of the other, against the base models and both recordings.
    pub against: [Option<(f64, f64)>; 2],
    /// Seconds that the plan took.
    pub planning: f64,
}

impl Outcome {
    /// Whether what is hidden was named, 20 to 1 against the other.
    pub fn is_separated(&self, tie: &Tie) -> bool {
        let own = self.found.iter().find(|(name, _)| name == tie.hidden);
        own.is_some_and(|(_, ties)| !ties.iter().any(|t| t == tie.other))
            && self.found.iter().all(|(name, _)| name != tie.other)
    }
}

/// Looks into the session of this number; where it has the tie, plans, records what is planned in simulation, and looks into both.
/// `None` where it has not.
///
/// # Errors
/// A spec that contradicts itself; a plan that fails.
pub fn follow(tie: &Tie, index: u64) -> Result<Option<Outcome>, Error> {
    let Some((spec, noise)) = hidden_in(tie.row, tie.hidden, index)? else {
        return Ok(None);
    };
    let session = spec.run()?;
    let mut request = Request::new(spec.gravity);
    request.noise = noise;
    let first = [session.recording.clone()];
    let Ok(discovery) = discover(&first, &request) else {
        return Ok(None);
    };
    let Some(rivalry) = tied(&discovery, tie) else {
        return Ok(None);
    };
    let start = std::time::Instant::now();
    let aim = separate(
        std::slice::from_ref(&rivalry),
        None,
        &Conditions {
            white: discovery.findings.white,
            noise: BiasNoise::walks(discovery.findings.walks),
            gravity: spec.gravity,
            timing: Timing::default(),
            warmed: tie.warmed,
            catalogue: request.catalogue.clone(),
            watch: request.watch.clone(),
        },
    )?;
    let planning = start.elapsed().as_secs_f64();
    let again = Spec {
        seed: spec.seed ^ PLANNED,
        motion: Motion::Planned(aim.design.motion()),
        temperature: aim.design.temperature().or(spec.temperature.clone()),
        parameters: truth_of(&session),
        ..spec
    };
    let mut second = again.run()?.recording;
    second.name = "planned".into();
    let (found, refused, against) = match discover(&[session.recording, second], &request) {
        Ok(discovery) => {
            let against = [tie.hidden, tie.other].map(|name| statistic(&discovery, name));
            (names(&discovery), None, against)
        }
        Err(error) => (Vec::new(), Some(error.to_string()), [None; 2]),
    };
    Ok(aim.ties.first().map(|planned| Outcome {
        index,
        named: rivalry.named.name.clone(),
        before: planned.before,
        after: planned.after,
        placements: aim.design.ups.len(),
        minutes: aim.design.duration() / 60.0,
        shown_by: planned.shown_by(),
        found,
        refused,
        against,
        planning,
    }))
}

/// The tie between the two, whichever was named.
fn tied(discovery: &Discovery, tie: &Tie) -> Option<Rivalry> {
    let all = discovery.findings.effects.iter().flat_map(|e| &e.rivals);
    let is_it = |rivalry: &&Rivalry| {
        let names = [rivalry.named.name.as_str(), rivalry.other.name.as_str()];
        names == [tie.hidden, tie.other] || names == [tie.other, tie.hidden]
    };
    all.into_iter().find(is_it).cloned()
}

fn statistic(discovery: &Discovery, name: &str) -> Option<(f64, f64)> {
    let mut all = discovery.search.first_ranking.iter();
    let found = all.find(|(claim, _)| claim.name() == name);
    found.map(|(_, ranked)| (ranked.statistic, ranked.dof))
}

fn names(discovery: &Discovery) -> Vec<(String, Vec<String>)> {
    let effects = discovery.findings.effects.iter();
    effects
        .map(|e| (e.name.clone(), e.indistinguishable_from.clone()))
        .collect()
}

/// All true parameters: another session of the same device has them too.
fn truth_of(session: &Session) -> std::collections::BTreeMap<String, f64> {
    let truth = &session.truth;
    [&truth.accelerometer, &truth.gyroscope]
        .into_iter()
        .flat_map(|p| p.names().iter().cloned().zip(p.values().iter().copied()))
        .collect()
}
