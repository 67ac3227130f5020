//! What `plan` asks for after the first placements of a real recording, followed by simulation.

use calib::intervals::{Detector, Segmentation, Span};
use calib::methods::joint::{JointRequest, fit_joint};
use calib::methods::{accelerometer_unit, cut, static_means};
use calib::simulate::{Motion, SensorSpec, Spec};
use calib::{Error, Recording};
use nalgebra::Vector3;
use plan::{
    Known, Noise, REQUIREMENT, Timing, Words, faces_edges_corners, fewest, force_covariance,
    force_information, parameter_names,
};

use crate::plan_study::motion;

/// White noise densities of the phone's sensors, m/s²/√Hz and rad/s/√Hz: 4.4 mm/s² and 1.4 mrad/s a sample at 100 Hz.
const WHITE: [f64; 2] = [4.4e-4, 1.4e-4];

/// What became of the advice after the first placements.
#[derive(Clone, Debug)]
pub struct Followed {
    /// Placements of the recording that are taken.
    pub after: usize,
    /// Placements that `plan` asks for.
    pub advised: usize,
    /// The fewest of the same candidates that determine every parameter of the accelerometer, tried one and all.
    pub fewest: usize,
    /// What recording and simulated placements together leave open.
    pub unobservable: Vec<String>,
    /// Largest standard error of a scale factor or misalignment of either sensor, 1.
    pub largest: [f64; 2],
}

impl Followed {
    /// Whether every parameter is determined with one placement more than the fewest at most.
    pub fn is_as_asked(&self) -> bool {
        self.unobservable.is_empty() && self.advised <= self.fewest + 1
    }
}

/// Cuts `recording` after so many placements, asks, follows in simulation and calibrates both together.
///
/// # Errors
/// As the joint fit; a recording of fewer placements.
pub fn follow(recording: &Recording, after: usize, gravity: f64) -> Result<Followed, Error> {
    let choice = cut(recording, &Detector::default(), true, gravity)?;
    let all: Vec<Span> = choice.segmentation.statics.iter().map(|s| s.span).collect();
    let Some(first) = all.get(..after) else {
        let found = all.len();
        return Err(Error::not_enough(format!(
            "{found} placements, {after} asked for"
        )));
    };
    let multiplier = choice.segmentation.multiplier;
    let taken = Segmentation::from_spans(recording, first, multiplier);
    let ups = directions(recording, &taken, gravity);
    let advised = fewest(&ups);
    let noise = Noise {
        force: WHITE[0],
        rate: WHITE[1],
        gravity,
        ..Noise::default()
    };
    let timing = Timing::default();
    let known = Known {
        information: Some(plan::recorded(&ups, &noise, &timing)),
        up: ups.last().copied(),
        scale: [0.0; 6],
    };
    let planned = plan::plan(&advised, &known, &noise, &timing, Words::Phone);
    let mut follows = motion(&planned, &timing);
    if let Some(up) = ups.last() {
        // The device lies there already: the first of the plan is turned to.
        follows.up = (*up).into();
        follows.first_rest = timing.rest;
        follows.steps = planned
            .steps
            .iter()
            .map(|s| crate::plan_study::step(s, &timing))
            .collect();
    }
    let whole = JointRequest::new(vec![(recording, &choice.segmentation)], gravity);
    let truth = fit_joint(&whole)?.all_fitted().parameters;
    let white = |k: usize| SensorSpec {
        white: Some(WHITE[k]),
        ..SensorSpec::default()
    };
    let spec = Spec {
        seed: after as u64,
        gravity,
        motion: Motion::Planned(follows),
        accelerometer: white(0),
        gyroscope: white(1),
        parameters: parameter_names()
            .into_iter()
            .filter_map(|name| Some((name.clone(), truth.get(&name)?)))
            .collect(),
        ..Spec::default()
    };
    let mut recordings = vec![(recording, &taken)];
    let session = spec.run()?.recording;
    let more = cut(&session, &Detector::default(), true, gravity)?.segmentation;
    if !advised.is_empty() {
        recordings.push((&session, &more));
    }
    let fitted = fit_joint(&JointRequest::new(recordings, gravity))?.all_fitted();
    let largest = |sensor: &str| {
        let own = fitted.free.iter().enumerate();
        own.filter(|(_, name)| name.starts_with(sensor) && !name.contains(".b_"))
            .map(|(k, _)| fitted.covariance[k][k].sqrt())
            .fold(0.0, f64::max)
    };
    Ok(Followed {
        after,
        advised: advised.len(),
        fewest: exhaustive(&ups, advised.len()),
        largest: [largest("accel."), largest("gyro.")],
        unobservable: fitted.unobservable.clone(),
    })
}

fn directions(recording: &Recording, taken: &Segmentation, gravity: f64) -> Vec<Vector3<f64>> {
    let means = static_means(recording, taken);
    let means: Vec<Vector3<f64>> = means.iter().map(|mean| mean.raw).collect();
    let unit = accelerometer_unit(&means, gravity);
    let si = means
        .iter()
        .map(|raw| unit.as_ref().map_or(*raw, |unit| unit.to_si(raw)));
    si.map(|force| force.normalize()).collect()
}

/// The fewest faces, edges and corners (repeats allowed) beside those that are there that leave no standard error above the
/// requirement, of all sets of fewer than `most`; `most` where there is none. Unlike the advice it counts no placements.
fn exhaustive(there: &[Vector3<f64>], most: usize) -> usize {
    fn any(there: &mut Vec<Vector3<f64>>, all: &[Vector3<f64>], left: usize) -> bool {
        if left == 0 {
            return force_covariance(&force_information(there.iter()))
                .is_some_and(|c| c.diagonal().max().sqrt() <= REQUIREMENT.largest_error);
        }
        (0..all.len()).any(|k| {
            there.push(all[k]);
            let found = any(there, &all[k..], left - 1);
            there.pop();
            found
        })
    }
    let all = faces_edges_corners();
    let found = (0..most).find(|count| any(&mut there.to_vec(), &all, *count));
    found.unwrap_or(most)
}
