//! Fit, measure the noise, look for disturbances, fit again.

use nalgebra::Matrix3;
use recording::Error;
use sensor::{Base, EffectRef, Quantity, Sensor};

use super::data::{Cut, Data};
use super::fit::JointFit;
use super::minimum::{Point, Run};
use super::request::JointRequest;
use super::start::{Start, charts, start};
use crate::methods::joint::clock::fit::settle_clock;
use crate::methods::joint::rows::knowledge::by_models;

findings::tuning! {
    /// Rounds of weighting at most; one suffices where nothing was disturbed.
    ROUNDS: usize = 6;

    /// Bends of the rows between two points below this, in standard deviations, change no judgement: all
    /// that is judged is what the Jacobian's columns leave, and that is the same at both.
    STRAIGHT: f64 = 0.2;
}

/// Fits everything at once.
///
/// # Errors
/// Means that lie on no sphere, rests without a direction, and what the solver refuses.
pub fn fit_joint(request: &JointRequest<'_>) -> Result<JointFit, Error> {
    let start = start(request)?;
    let cuts: Vec<Cut<'_>> = request
        .recordings
        .iter()
        .map(|(recording, segmentation)| Cut {
            recording,
            segmentation,
            force_unit: start.force_unit,
            rate_unit: start.rate_unit,
            clock: request.clock,
        })
        .collect();
    let (mut run, mut point) = match request.minimum_before() {
        Some(before) => go_on(request, start, &cuts, before)?,
        None => begin(request, start, &cuts)?,
    };
    // A search for what noise does not explain keeps to what the readings show of it: rests of a device that sways differ by
    // more than a smaller noise.
    if request.disturbances && run.data.is_coloured() {
        let (shares, reached) = run.shares_of_noise(point.as_ref())?;
        run.data.lower_noise(&shares);
        point = Some(reached);
    }
    run.run(point)
}

/// A run with its data and the point that it begins at.
type Begun<'a> = (Run<'a>, Option<Point>);

/// The rests, turns and noise of the recordings.
fn cut_up(cuts: &[Cut<'_>], axes: Matrix3<f64>) -> Data {
    let mut data = Data {
        axes_at_rest: axes,
        ..Data::default()
    };
    cuts.iter().for_each(|cut| data.add(cut));
    data.forget_what_some_know();
    data
}

/// From the recordings.
fn begin<'a>(
    request: &'a JointRequest<'a>,
    start: Start,
    cuts: &[Cut<'_>],
) -> Result<Begun<'a>, Error> {
    let mut data = request
        .before
        .map_or_else(|| cut_up(cuts, start.axes), |before| before.data.clone());
    let look = |effect: &EffectRef| {
        let mut needs = effect.needs().into_iter();
        needs.any(Quantity::is_told_by_intervals)
    };
    let covariates = request.covariates
        || !request.gyroscope.effects().is_empty()
        || request.accelerometer.effects().iter().any(look);
    for k in data.with_scatter() {
        data.set_clock(k, 0, 0.0);
    }
    if let Some(decided) = &request.clocks {
        data.go_by(decided);
    }
    let charts = charts(&data, &request.accelerometer, &start)?;
    let mut run = Run {
        request,
        data,
        charts,
        start,
    };
    let first = covariates.then(|| run.know(cuts, None)).transpose()?;
    let mut point = settle_clock(&mut run, first.clone())?;
    // What effects ask for is asked for at the samples' times.
    if covariates && point.is_some() {
        point = Some(run.know(cuts, point.as_ref())?);
    }
    let point = point.or(first);
    if let Some(reached) = &point {
        run.hold_axes(reached);
    }
    Ok((run, point))
}

/// From a fit of the same recordings with other effects: what these change is small.
fn go_on<'a>(
    request: &'a JointRequest<'a>,
    start: Start,
    cuts: &[Cut<'_>],
    before: &JointFit,
) -> Result<Begun<'a>, Error> {
    let mut run = Run {
        request,
        data: before.data.clone(),
        charts: before.charts.clone(),
        start,
    };
    let x = run.begin_at(&run.rows(&[]));
    let point = run.approach(&run.weights_at(x.values()), None)?;
    run.hold_axes(&point);
    let point = settle_clock(&mut run, Some(point.clone()))?.unwrap_or(point);
    let models = run.models(&point);
    run.write_down(cuts, &models);
    Ok((run, Some(point)))
}

/// Parameters of the accelerometer and the gyroscope in each recording.
type ByRecording = Vec<(Vec<f64>, Vec<f64>)>;

impl Run<'_> {
    /// Works out what effects look at: first by the models of the request or of the fit before, then by those of a first fit,
    /// which it returns.
    fn know(&mut self, cuts: &[Cut<'_>], before: Option<&Point>) -> Result<Point, Error> {
        let first = match before {
            Some(point) => self.models(point),
            None => {
                let perfect = self.request.gyroscope.parameters();
                let first = self.start.accelerometer.iter();
                first
                    .map(|p| (p.clone(), perfect.values().to_vec()))
                    .collect()
            }
        };
        self.write_down(cuts, &first);
        let point = self.approach(&self.weights_near(None), before)?;
        let fitted = self.models(&point);
        self.write_down(cuts, &fitted);
        Ok(point)
    }

    fn write_down(&mut self, cuts: &[Cut<'_>], models: &ByRecording) {
        let request = self.request;
        for (k, (cut, (force, rate))) in cuts.iter().zip(models).enumerate() {
            let (force, rate) = (
                (&request.accelerometer, force.as_slice()),
                (&request.gyroscope, rate.as_slice()),
            );
            let truth = by_models(cut, force, rate);
            self.data.know(k, &truth, cut.recording.start());
        }
        self.data.forget_what_some_know();
    }

    /// The models at a fit: what effects look at depends on them in second order only.
    fn models(&self, point: &Point) -> ByRecording {
        let (rows, x) = (self.rows(&[]), point.parameters.values());
        let perfect = self.request.gyroscope.parameters();
        let of = |recording: usize| {
            let mut own = self.data.rests.iter();
            let first = own.position(|rest| rest.recording == recording);
            let first = first.unwrap_or_default();
            let rate = match rows.layout.gyroscope {
                0 => perfect.values().to_vec(),
                _ => rows.local(x, Sensor::Gyroscope, first),
            };
            (rows.local(x, Sensor::Accelerometer, first), rate)
        };
        (0..self.data.sources.len()).map(of).collect()
    }

    /// Holds `T` of the gyroscope at rest where the turns of a fit have it.
    fn hold_axes(&mut self, point: &Point) {
        if let Some((_, rate)) = self.models(point).first() {
            self.data.axes_at_rest = Base::from_parameters(rate).t;
        }
    }

    fn run(&mut self, before: Option<Point>) -> Result<JointFit, Error> {
        let mut weights = self.weights_near(before.as_ref());
        let mut point = self.approach(&weights, before.as_ref())?;
        self.hold_axes(&point);
        let earth = self.request.earth.then(|| {
            let rows = self.rows(&[]);
            rows.earth_columns(point.plain_values())
        });
        let before = self.request.before;
        let mut levels = before.map_or_else(Vec::new, |before| before.levels.clone());
        for _ in 0..ROUNDS.get() {
            weights = self.judge(&point, earth.as_ref(), &levels);
            levels.clone_from(&weights.levels);
            let next = self.approach(&weights, Some(&point))?;
            let bend = self.bend(&point, &next, &weights.whitening);
            point = next;
            self.hold_axes(&point);
            // Readings that no model fits are not judged over and over.
            let spent = self.start.steps.are_spent(self.data.cost_of_a_step());
            if bend < STRAIGHT.get() || spent {
                break;
            }
        }
        self.finish(&point, weights)
    }
}

#[cfg(test)]
mod tests {
    use recording::intervals::{Detector, segment};
    use simulate::Spec;

    use super::*;
    use crate::methods::earth::on_the_earth;

    #[test]
    fn rates_at_rest_that_no_bias_explains_do_not_turn_the_axes() {
        for (seed, size) in [(1, 5.0), (3, 8.0), (1, 30.0)] {
            let mut spec = Spec::hand_held(seed);
            let own = [("size".to_owned(), size)].into();
            spec.effects.insert("gyro_g_sensitivity".into(), own);
            let recording = spec.run().unwrap().recording;
            let segmentation = segment(&recording, &Detector::default()).unwrap();
            let (gyroscope, vertical) = on_the_earth(gyroscope::model(), 48.0);
            let fit = fit_joint(&JointRequest {
                gyroscope,
                held: vec![vertical],
                ..JointRequest::new(vec![(&recording, &segmentation)], spec.gravity)
            });
            let fit = fit.unwrap();
            let square = |chords: &[f64]| chords.iter().map(|c| c * c).sum::<f64>();
            let (before, after) = (square(&fit.chords_before), square(&fit.chords));
            assert!(after < before, "{seed} {size}: {after} of {before}");
        }
    }
}
