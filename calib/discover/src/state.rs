//! A model fitted to the recordings, and what it leaves unexplained.

use std::sync::{Arc, OnceLock};

use ::findings::Kind;
use estimate::methods::earth::{self, on_the_earth};
use estimate::methods::joint::{
    BiasNoise, Column, Columns, Component, ComponentKind, FaultRef, JointFit, JointRequest, Known,
    NoiseLevel, Sensitivities, Site, Suspect, fit_joint, suspects, within,
};
use faer::{Mat, MatMut};
use recording::Error;
use recording::watch::Stage;
use sensor::{EffectRef, Role};

use super::gap::channel::Channel;
use super::noise::level::{Level, levels};
use super::noise::projected::Projected;
use super::noise::walk_prior::walk_levels;
use super::request::Session;

findings::tuning! {
    /// Means of static intervals on either side that a step of a bias needs.
    BESIDE_A_STEP: usize = 3;
}

/// The parameter that shapes an effect (`tau`, `t0`), by its place, and its value, which the fit holds.
pub type FixedShape = Option<(usize, f64)>;

/// Effects and disturbances of a model, on top of the base models.
#[derive(Clone, Debug, Default)]
pub struct Extension {
    /// Effects, with what shapes them.
    pub effects: Vec<(EffectRef, FixedShape)>,
    /// Disturbances with their place: parameters of their own.
    pub disturbed: Vec<Known>,
    /// True if time constants are fitted, starting from their held values; false if they stay fixed.
    pub settles: bool,
}

impl Extension {
    /// Takes an effect in, with the companions of the `catalogue` that come with it.
    pub fn hold(&mut self, effect: EffectRef, shape: FixedShape, catalogue: &[EffectRef]) {
        let companions: Vec<EffectRef> = with_companions(&effect, catalogue).skip(1).collect();
        self.effects.push((effect, shape));
        for companion in companions {
            if !self.has(companion.name()) {
                self.effects.push((companion, None));
            }
        }
    }

    /// Returns true if it has the effect of this name.
    pub fn has(&self, name: &str) -> bool {
        self.effects.iter().any(|(effect, _)| effect.name() == name)
    }

    /// Takes the effect of this name out.
    pub fn remove(&mut self, name: &str) {
        self.effects.retain(|(effect, _)| effect.name() != name);
    }

    /// Returns true if both have the same terms, in any order.
    pub fn is_same(&self, other: &Self) -> bool {
        let holds = |(effect, held): &(EffectRef, FixedShape)| {
            let mut others = other.effects.iter();
            others.any(|(e, h)| e.name() == effect.name() && h == held)
        };
        self.settles == other.settles
            && self.effects.len() == other.effects.len()
            && self.disturbed.len() == other.disturbed.len()
            && self.effects.iter().all(holds)
            && self
                .disturbed
                .iter()
                .all(|known| other.disturbed.contains(known))
    }
}

/// One model, fitted.
#[derive(Clone, Debug)]
pub struct State {
    /// Terms of the model beyond the base models.
    pub extension: Extension,
    /// The fit.
    pub fit: Arc<JointFit>,
    /// Derivatives of the rows by errors that the model lacks.
    pub sensitivities: Arc<Sensitivities>,
    /// Residuals, projected onto the null space of the model's own parameters.
    pub projected: Arc<Projected>,
    /// Noise of the biases when nothing more is missing: given or likeliest.
    pub noise: BiasNoise,
    /// True if that noise was given.
    pub noise_given: bool,
    /// Possible disturbances.
    pub suspects: Arc<Vec<Suspect>>,
    /// The settings of the densities, once somebody asked.
    levels: OnceLock<Arc<Vec<Level>>>,
    /// Levels of the noise at which claims are tried, computed on first use.
    walks: OnceLock<Arc<Vec<Level>>>,
}

impl State {
    /// Fits the base models and the extension to a session.
    ///
    /// # Errors
    /// As [`fit_joint`].
    pub fn fit(session: &Session<'_>, extension: Extension) -> Result<Self, Error> {
        session.request.watch.step(Stage::Searching)?;
        let fit = fit_joint(&joint_request(session, &extension))?;
        let sensitivities = fit.sensitivities();
        let projected = projected(&fit, (&fit.components, &fit.levels));
        let noise = BiasNoise::of(&fit.levels);
        Ok(Self {
            extension,
            suspects: Arc::new(possible_disturbances(&fit)),
            fit: Arc::new(fit),
            sensitivities: Arc::new(sensitivities),
            projected: Arc::new(projected),
            noise,
            noise_given: session.request.noise.is_some(),
            levels: OnceLock::new(),
            walks: OnceLock::new(),
        })
    }

    /// Fits the model with what a search leaves out. Where nobody says the latitude the earth's rotation is uncertainty: at rest its vertical part
    /// does what the diagonal of a g-sensitivity does, and the rotation is one of the things that are looked for. What the model misses makes static
    /// intervals and turns scatter, and a search takes them for walks. Where the device turns at rest, rates and turns scatter by that.
    ///
    /// # Errors
    /// As [`fit_joint`].
    pub fn fitted_in_full(&self, session: &Session<'_>) -> Result<JointFit, Error> {
        self.fitted_with(session, session.remarks.has(Kind::RESTS_TURN))
    }

    /// The same without the static intervals and turns that are off, as a calibration of the base models leaves them out.
    ///
    /// # Errors
    /// As [`fit_joint`].
    pub fn fitted_without_outliers(&self, session: &Session<'_>) -> Result<JointFit, Error> {
        self.fitted_with(session, true)
    }

    fn fitted_with(&self, session: &Session<'_>, disturbances: bool) -> Result<JointFit, Error> {
        let request = joint_request(session, &self.extension);
        let of_the_earth = request.gyroscope.effects();
        let earth = session.request.latitude.is_none() && !earth::is_among(of_the_earth);
        fit_joint(&JointRequest {
            earth,
            disturbances,
            scatter: true,
            compared: false,
            before: Some(&*self.fit).filter(|_| !disturbances),
            from_its_minimum: request.from_its_minimum && !disturbances,
            ..request
        })
    }

    /// The model with its biases' noise taken as known.
    pub fn at_noise(&self, noise: BiasNoise) -> Self {
        Self {
            noise,
            noise_given: true,
            levels: OnceLock::new(),
            walks: OnceLock::new(),
            ..self.clone()
        }
    }

    /// Computes the projected residuals where the biases flicker as well as walk, with that noise.
    pub fn flickering(&self) -> (Projected, BiasNoise) {
        let (components, levels) = self.fit.flickering();
        let projected = projected(&self.fit, (&components, &levels));
        (projected, BiasNoise::of(&levels))
    }

    /// Root mean square of what a channel leaves, in its own unit: m/s², rad/s, rad; `None` of one that the joint fit has no
    /// rows of.
    pub fn rms(&self, channel: Channel) -> Option<f64> {
        match channel {
            Channel::StaticNorm => Some(self.fit.norm_rms()),
            Channel::StaticRate => Some(self.fit.rate_rms()),
            Channel::Direction => Some(self.fit.direction_rms()),
            Channel::MovingForce => None,
        }
    }

    /// Standard deviation by which the turns scatter beyond the gyroscope's noise, rad.
    pub fn scatter_of_turns(&self) -> f64 {
        let mut levels = self.fit.levels.iter();
        let own = levels.find(|level| level.kind == ComponentKind::TurnScatter);
        own.map_or(0.0, |level| level.size)
    }

    /// Number of rows.
    pub fn rows(&self) -> usize {
        self.fit.white_residuals.len()
    }

    /// Whitens columns by the white noise.
    pub fn whitened(&self, mut columns: Mat<f64>) -> Mat<f64> {
        let view: MatMut<'_, f64> = columns.as_mut();
        self.fit.whitening.white.apply(view);
        columns
    }

    /// Columns cut into the rows of the recordings.
    pub fn cut(&self, columns: Mat<f64>) -> Columns {
        Columns::cut(&columns, self.fit.whitening.white.groups())
    }

    /// Columns with few entries, whitened by the white noise.
    pub fn sparse(&self, columns: &[&Column]) -> Columns {
        self.fit.whitening.white.sparse(columns)
    }

    /// Returns the columns (`q × columns`) of one suspect, projected onto the null space of the model's own parameters.
    pub fn explained_by(&self, suspect: &Suspect) -> Mat<f64> {
        let own: Vec<&Column> = suspect.columns.iter().collect();
        let own = Column::side_by_side(self.rows(), &own);
        self.projected.columns(self.whitened(own).as_ref())
    }

    /// Returns true if the model has the effect of this name.
    pub fn has(&self, name: &str) -> bool {
        self.extension.has(name)
    }

    /// Returns true if the model already has this disturbance.
    pub fn is_flagged(&self, fault: FaultRef, place: usize) -> bool {
        self.known(fault, place).is_some()
    }

    /// Returns the disturbance of this kind at this place, if the model has it.
    pub fn known(&self, fault: FaultRef, place: usize) -> Option<Known> {
        let mut all = self.extension.disturbed.iter();
        all.find(|k| k.fault == fault && k.place == place).copied()
    }

    /// The settings of the densities at which hypotheses are tried.
    pub fn levels(&self) -> &[Level] {
        self.levels
            .get_or_init(|| Arc::new(levels(&self.projected, self.noise, self.noise_given)))
    }

    /// Log-likelihood at the likeliest of these settings, up to a constant that is the same for models of the same rows.
    pub fn log_likelihood(&self) -> f64 {
        let levels = self.levels().iter();
        let each = levels.map(|level| level.whitened.log_likelihood());
        each.fold(f64::NEG_INFINITY, f64::max)
    }

    /// The levels of the noise at which claims are tried, each with its prior probability.
    pub fn walks(&self) -> &[Level] {
        self.walks.get_or_init(|| {
            let (noise, is_given) = (self.noise, self.noise_given);
            Arc::new(walk_levels(
                &self.projected,
                &self.fit.data,
                noise,
                is_given,
            ))
        })
    }

    /// Times (since the start of the recording, s) at which a bias may have jumped: between neighbouring chunks of rests,
    /// where three of them on either side show that it moved and stayed. Between two rests there have to be two on either
    /// side: what happens after the only orientation so far may as well be an error of that orientation.
    ///
    /// None of several recordings: an instant belongs to one of them, and between them biases are their own.
    pub fn boundaries(&self) -> Vec<f64> {
        match self.fit.data.sources.len() {
            1 => self.boundaries_in(0),
            _ => Vec::new(),
        }
    }

    /// The times within one recording at which a bias may have jumped.
    pub fn boundaries_in(&self, recording: usize) -> Vec<f64> {
        let rests = &self.fit.data.rests;
        let means = self.sensitivities.means.iter();
        let mut middles: Vec<(f64, usize)> = means
            .map(|mean| (mean.truth.time, self.fit.data.chunks[mean.chunk].rest))
            .filter(|(_, rest)| rests[*rest].recording == recording)
            .collect();
        middles.sort_by(|a, b| a.0.total_cmp(&b.0));
        middles.dedup_by(|a, b| (a.0 - b.0).abs() < 1.0);
        let most = middles.len().saturating_sub(BESIDE_A_STEP.get());
        let own = rests.iter().enumerate();
        let mut own = own.filter(|(_, rest)| rest.recording == recording);
        let first = own.next().map_or(0, |(k, _)| k);
        let last = own.next_back().map_or(first, |(k, _)| k);
        let is_shown =
            |before: usize, after: usize| before == after || (before > first && after < last);
        middles
            .windows(2)
            .enumerate()
            .filter(|(k, _)| (BESIDE_A_STEP.get()..=most).contains(&(k + 1)))
            .filter(|(_, pair)| is_shown(pair[0].1, pair[1].1))
            .map(|(_, pair)| 0.5 * (pair[0].0 + pair[1].0))
            .collect()
    }
}

/// Everything that may be wrong with an interval or a turn of a fit, with its columns.
fn possible_disturbances(fit: &JointFit) -> Vec<Suspect> {
    let rows = fit.plain_rows();
    let x = &fit.parameters.values()[..rows.layout.disturbance(0)];
    let rotations = rows.rotations(x);
    let site = Site {
        rows: &rows,
        x,
        rotations: &rotations,
    };
    suspects(&site)
}

/// Projects the residuals of a fit, under noise of these components and levels.
fn projected(fit: &JointFit, noise: (&[Component], &[NoiseLevel])) -> Projected {
    let mut projected = Projected::new(&fit.white_residuals, &fit.white_jacobian, noise);
    projected.within = within(&fit.data, &projected.kinds());
    projected
}

/// The joint fit of the base models with an extension.
pub fn joint_request<'a>(session: &'a Session<'_>, extension: &Extension) -> JointRequest<'a> {
    let request = &session.request;
    let (mut accelerometer, mut gyroscope) = (accelerometer::model(), gyroscope::model());
    let (mut held, mut starts) = (Vec::new(), Vec::new());
    if let Some(latitude) = request.latitude {
        let (with_it, vertical) = on_the_earth(gyroscope, latitude);
        gyroscope = with_it;
        held.push(vertical);
    }
    for (effect, shape) in &extension.effects {
        accelerometer = accelerometer.with(effect.clone());
        gyroscope = gyroscope.with(effect.clone());
        let mut hold = |parameter: &str, value: f64| {
            held.push((format!("{}.{parameter}", effect.name()), value));
        };
        if let Some(reference) = effect.reference() {
            hold(reference, 0.0);
        }
        if let Some((k, value)) = shape {
            let parameter = &effect.params()[*k];
            if extension.settles && parameter.role == Role::TimeConstant {
                starts.push((format!("{}.{}", effect.name(), parameter.name), *value));
            } else {
                hold(&parameter.name, *value);
            }
        }
    }
    let before = session.base.as_deref();
    let parts = session.parts();
    let cut = parts.map(|(recording, part)| (recording, &part.segmentation));
    JointRequest {
        accelerometer,
        gyroscope,
        bias_noise: request.noise,
        flicker: request.flicker,
        disturbances: false,
        known: extension.disturbed.clone(),
        held,
        starts,
        clock: request.clock,
        clocks: session.clocks.clone(),
        compared: before.is_some(),
        before,
        // Not where turns miss motion between the samples: that share is fitted too, and from the base models on the fit
        // ends at another value (a third larger on rec_3 of the phone).
        from_its_minimum: before.is_some_and(|fit| !fit.data.misses_something_between_samples()),
        covariates: true,
        watch: request.watch.clone(),
        ..JointRequest::new(cut.collect(), request.gravity)
    }
}

/// The effects that come with `effect`, itself first.
pub fn with_companions<'a>(
    effect: &EffectRef,
    catalogue: &'a [EffectRef],
) -> impl Iterator<Item = EffectRef> + use<'a> {
    let companion = effect.companion();
    let companion = companion.and_then(|with| catalogue.iter().find(|e| e.name() == with));
    std::iter::once(effect.clone()).chain(companion.cloned())
}
