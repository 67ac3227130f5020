//! Judgement of the rows: levels of noise, and the disturbances that the rows flag.

use sensor::Sensor;

use super::belief::Weights;
use super::gross::bends;
use crate::methods::joint::blocks::columns::Columns;
use crate::methods::joint::data::MOST_DISTURBED;
use crate::methods::joint::faults::{Site, Suspect, shaken, suspects, suspects_beside_biases};
use crate::methods::joint::minimum::{Point, Run};
use crate::methods::joint::noise::bias::{BiasNoise, within};
use crate::methods::joint::noise::rows::RowNoise;
use crate::methods::joint::noise::weights::{ComponentKind, NoiseLevel, White, Whitening};
use crate::methods::joint::orientation::Shown;
use crate::methods::joint::orientation::oriented::At;
use crate::methods::joint::request::Known;
use crate::methods::joint::result::analysis::{Analysis, walks};
use crate::methods::joint::rows::Rows;

findings::tuning! {
    /// So many disturbances may be the whole of a misfit by noise alone.
    FEW: usize = 2;

    /// Multiple of the misfit by which the specific force of an interval that did not shake must be off to count as a push,
    /// where the norm misses at all static intervals: four standard deviations along each of three axes. A smaller
    /// excursion is the effect that the model lacks: hysteresis of 1 mg leaves single intervals off by one to three times
    /// the misfit of the others.
    STANDS_OUT: f64 = 7.0;
}

impl Run<'_> {
    /// White noise, and the walks where they are given, at a point, or else at the start.
    pub(crate) fn weights_near(&self, point: Option<&Point>) -> Weights {
        self.weights_under(&self.noise_near(point))
    }

    /// The same at any values.
    pub(crate) fn weights_at(&self, x: &[f64]) -> Weights {
        self.weights_under(&self.rows(&[]).noise(x))
    }

    /// The noise of the rows at a point, or else at the start.
    pub(crate) fn noise_near(&self, point: Option<&Point>) -> RowNoise {
        let rows = self.rows(&[]);
        rows.noise(&self.values_near(&rows, point))
    }

    /// Weights under this noise of the rows.
    pub(crate) fn weights_under(&self, noise: &RowNoise) -> Weights {
        let rows = self.rows(&[]);
        let white = White::new(noise, rows.first_turn_row());
        let components = walks(noise, &white, &rows.stations(noise));
        let given = self.request.bias_noise.as_ref();
        let levels = given.map(BiasNoise::levels).unwrap_or_default();
        Weights {
            whitening: Whitening::new(white, &components, &levels),
            carried: Columns::none(rows.groups()),
            of_place: Columns::none(rows.groups()),
            components,
            walk_ends_with_rests: false,
            levels,
            flagged: Vec::new(),
            shown: Vec::new(),
        }
    }

    /// Levels of noise and disturbances at a point, the levels `before` being those of a point nearby.
    pub(crate) fn judge(
        &self,
        point: &Point,
        earth: Option<&Columns>,
        before: &[NoiseLevel],
    ) -> Weights {
        let rows = self.rows(&[]);
        let x = point.plain_values();
        let mut free = point.mask.free_indices();
        free.retain(|&k| k < point.plain);
        let linear = point.undisturbed();
        let mut analysis = Analysis::new(&rows, &linear, &rows.noise(x), &free);
        if self.request.flicker {
            let flicker = rows.flicker(x, &analysis.white, &analysis.stations);
            analysis.components.extend(flicker);
        }
        if let Some(columns) = earth {
            analysis.carry(ComponentKind::EarthRotation, columns);
        }
        if let Some(columns) = rows.rounding_columns(x) {
            analysis.carry(ComponentKind::CommonRounding, &columns);
        }
        let mut shown = Vec::new();
        let (levels, flagged) = if self.request.disturbances {
            let at = At {
                rows: &rows,
                x,
                linear: &linear,
                free: &free,
                earth,
            };
            self.flag(&at, &mut analysis, &mut shown, before)
        } else {
            let known = self.known(&rows, x);
            let all: Vec<&Suspect> = known.iter().collect();
            analysis.allow_scatter_of_gross_turns(&rows, &all);
            if self.request.scatter {
                analysis.allow_scatter_where_misfit(&rows, &all);
            }
            (self.measured(&analysis, &all, before), known)
        };
        Weights {
            whitening: analysis.weighting(&levels),
            carried: analysis.carried(&levels),
            of_place: analysis.of_place(earth),
            components: analysis.components,
            walk_ends_with_rests: analysis.walk_ends_with_rests,
            levels,
            flagged,
            shown,
        }
    }

    fn measured(
        &self,
        analysis: &Analysis,
        known: &[&Suspect],
        before: &[NoiseLevel],
    ) -> Vec<NoiseLevel> {
        match &self.request.bias_noise {
            Some(noise) => noise.levels(),
            None => {
                let within = within(&self.data, &analysis.estimated_kinds());
                analysis.levels(known, &within, before)
            }
        }
    }

    /// Returns the suspects that the request names as disturbed.
    fn known(&self, rows: &Rows<'_>, x: &[f64]) -> Vec<Suspect> {
        if self.request.known.is_empty() {
            return Vec::new();
        }
        let if_known = |mut s: Suspect| {
            let same = |k: &&Known| k.fault == s.fault && k.place == s.place;
            s.reason = self.request.known.iter().find(same)?.reason;
            Some(s)
        };
        let rotations = rows.rotations(x);
        let site = Site {
            rows,
            x,
            rotations: &rotations,
        };
        suspects(&site).into_iter().filter_map(if_known).collect()
    }

    /// Levels of noise and disturbances: what was seen to shake, then what the rows flag.
    fn flag(
        &self,
        at: &At<'_>,
        analysis: &mut Analysis,
        shown: &mut Vec<(Sensor, Shown)>,
        before: &[NoiseLevel],
    ) -> (Vec<NoiseLevel>, Vec<Suspect>) {
        let (rows, x) = (at.rows, at.x);
        let rotations = rows.rotations(x);
        let site = Site {
            rows,
            x,
            rotations: &rotations,
        };
        let mut candidates = suspects_beside_biases(&site);
        let touched = self.touched(&site);
        let given: Vec<usize> = (candidates.len()..candidates.len() + touched.len()).collect();
        candidates.extend(touched);
        let most =
            given.len() + (MOST_DISTURBED.get() * self.data.rests.len() as f64).ceil() as usize;
        let all = |places: &[usize]| places.iter().map(|&k| &candidates[k]).collect::<Vec<_>>();
        let columns = analysis.columns(&candidates);
        let mut found = given.clone();
        let is_missed = analysis.is_missed(rows, &all(&given));
        if is_missed {
            // One rest or two that are far off pull on all of the others where these are few.
            let trial = analysis.trial(&candidates, &columns, &[]);
            let few = trial.flag(&given, given.len() + FEW.get());
            // The fit may be bent by more of them: it is judged again without these.
            let bends = || bends(at, analysis, (&candidates, &trial), &given, most);
            found = few
                .filter(|few| !analysis.is_missed(rows, &all(few)))
                .or_else(bends)
                .unwrap_or(found);
        }
        let patterns = at.allow_patterns(&all(&found), analysis, shown);
        // Where nothing was missed and nothing was added there is no scatter to allow.
        let mut misfit = patterns;
        if is_missed || patterns {
            misfit |= analysis.allow_scatter_where_misfit(rows, &all(&found));
        }
        if self.data.misses_something_between_samples() || self.data.moves_at_rest() {
            // What falls between samples altogether shows in none of them, and a device that sways begins a turn where it sways
            // to: turns scatter by more than their samples say.
            analysis.allow_scatter_of_turns(rows);
            misfit = true;
        }
        if !misfit {
            let trial = analysis.trial(&candidates, &columns, &[]);
            found = trial.flag(&given, most).unwrap_or(given.clone());
        }
        let mut levels = self.measured(analysis, &all(&found), before);
        for _ in 0..3 {
            let trial = analysis.trial(&candidates, &columns, &levels);
            let mut doubtful = found.clone();
            doubtful.retain(|k| !given.contains(k));
            let mut kept = given.clone();
            kept.extend(trial.confirm(&found, &doubtful));
            let next = trial.flag(&kept, most).unwrap_or(kept);
            if next == found {
                break;
            }
            found = next;
            levels = self.measured(analysis, &all(&found), &levels);
        }
        let mut more = at.allow_patterns(&all(&found), analysis, shown);
        more |= analysis.allow_scatter_beyond(rows, &all(&found), &levels);
        if more {
            levels = self.measured(analysis, &all(&found), &levels);
        }
        let count = found.len();
        let is_push = |k: &usize| candidates[*k].fault.opens_force;
        let without_shaking = |k: &usize| !given.contains(k) && is_push(k);
        if found.iter().any(without_shaking) {
            let limit = STANDS_OUT.get() * at.misfit_of_norm(&all(&found));
            if limit > 0.0 {
                let trial = analysis.trial(&candidates, &columns, &[]);
                let flagged = found.clone();
                let stands_out = |k| trial.size(k, &flagged).is_none_or(|size| size > limit);
                found.retain(|k| !without_shaking(k) || stands_out(*k));
            }
        }
        if found.len() < count {
            levels = self.measured(analysis, &all(&found), &levels);
        }
        if self.request.bias_noise.is_none() {
            analysis.doubt_turns(rows, &all(&found), &mut levels);
        }
        found.sort_unstable();
        let found = found.iter().map(|&k| candidates[k].clone()).collect();
        (levels, found)
    }

    /// The chunks that were seen to shake: their force may be off and the device may have moved. None where
    /// shaking is how the recording is: the rows are believed by their own noise then. Nor where the device sways, as in a
    /// hand, which trembles now more and now less.
    fn touched(&self, site: &Site<'_>) -> Vec<Suspect> {
        if self.data.shakes_throughout().is_some() {
            return Vec::new();
        }
        self.data
            .shaken
            .iter()
            .filter(|(chunk, _)| {
                let recording = self.data.rests[self.data.chunks[*chunk].rest].recording;
                !self.data.sources[recording].moves_at_rest()
            })
            .filter_map(|(chunk, shake)| shaken(site, (*chunk, shake)))
            .collect()
    }
}

#[cfg(test)]
mod tests {
    use std::collections::BTreeMap;

    use recording::intervals::{Detector, segment};
    use simulate::{Fault, Simulation, Spec};

    use super::*;
    use crate::methods::joint::{JointFit, JointRequest, fit_joint};

    fn fit(simulation: &Simulation) -> JointFit {
        let recording = simulation.run().unwrap().recording;
        let segmentation = segment(&recording, &Detector::default()).unwrap();
        let gravity = simulation.spec().gravity;
        fit_joint(&JointRequest::new(
            vec![(&recording, &segmentation)],
            gravity,
        ))
        .unwrap()
    }

    #[test]
    fn a_bias_that_drifts_is_no_scatter_from_rest_to_rest() {
        let mut square = 0.0;
        let seeds = [0, 4, 11];
        for seed in seeds {
            let mut spec = Spec::hand_held(seed);
            // 1 mg while the device warms up.
            spec.accelerometer.thermal_drift = 9.80665e-3;
            let simulation = Simulation::new(&spec).unwrap();
            let fit = fit(&simulation);
            let spans: Vec<_> = fit.data.rests.iter().map(|rest| rest.span).collect();
            let at_rest = |t: f64| spans.iter().any(|span| span.from <= t && t < span.to);
            let samples = simulation.samples(Sensor::Accelerometer);
            let drifts: Vec<_> = samples.filter(|s| at_rest(s.t)).map(|s| s.drift).collect();
            let truth = simulation.run().unwrap().truth;
            let fitted = fit.fitted(Sensor::Accelerometer);
            let found = fitted.local(fit.models[0].parameter_count(), 0);
            for (axis, name) in ["accel.b_x", "accel.b_y", "accel.b_z"].iter().enumerate() {
                let drift = drifts.iter().map(|d| d[axis]).sum::<f64>() / drifts.len() as f64;
                let error = found[9 + axis] - truth.get(name).unwrap() - drift;
                square += (error / fitted.standard_error(name).unwrap()).powi(2);
            }
        }
        // Nine squares of variance one: 21.7 is passed by one in a hundred. As scatter they were 57.
        let count = 3 * seeds.len();
        assert!(square < 21.7, "{square} of {count}");
    }

    #[test]
    fn what_an_effect_leaves_is_no_drift() {
        let mut spec = Spec::hand_held(0);
        let coefficients = [("x", 1e-4), ("y", -1e-4), ("z", 1e-4)];
        let coefficients: BTreeMap<String, f64> = coefficients
            .map(|(axis, value)| (axis.to_owned(), value))
            .into();
        spec.effects.insert("accel_quadratic".into(), coefficients);
        let fit = fit(&Simulation::new(&spec).unwrap());
        let walk = fit
            .levels
            .iter()
            .find(|l| l.kind == ComponentKind::AccelerometerWalk);
        // A walk through the whole recording would be 6e-4 m/s²/√s and more.
        assert!(walk.unwrap().size < 2e-4, "{:?}", fit.levels);
    }

    /// Hysteresis of 1 mg that the model lacks, and the pushed intervals that a fit flags.
    fn pushed_beside_hysteresis(seed: u64, faults: &[Fault]) -> Vec<usize> {
        let mut spec = Spec::hand_held(seed);
        let sizes = [("x", 9.8e-3), ("y", -9.8e-3), ("z", 9.8e-3)];
        let sizes: BTreeMap<String, f64> = sizes.map(|(a, v)| (a.to_owned(), v)).into();
        spec.effects.insert("accel_hysteresis".into(), sizes);
        spec.faults.extend_from_slice(faults);
        let fit = fit(&Simulation::new(&spec).unwrap());
        let pushed = |a: &&crate::methods::joint::Flagged| a.fault.opens_force;
        let pushed = fit.flagged.iter().filter(pushed);
        pushed.map(|a| a.interval).collect()
    }

    #[test]
    fn what_hysteresis_leaves_beside_its_pattern_is_no_push() {
        for seed in [1, 2] {
            assert_eq!(pushed_beside_hysteresis(seed, &[]), [0; 0], "{seed}");
        }
    }

    #[test]
    fn a_push_beside_hysteresis_is_named() {
        let push = Fault::Disturbed {
            interval: 6,
            size: 0.1,
        };
        assert_eq!(pushed_beside_hysteresis(1, &[push]), [6]);
    }

    #[test]
    fn no_placement_is_suspected_of_a_push_where_none_can_be_spared() {
        let suspected = |placements: usize| {
            let mut spec = Spec::hand_held(0);
            spec.motion = simulate::Motion::HandHeld(simulate::HandHeld {
                placements: Some(placements),
                ..simulate::HandHeld::default()
            });
            let fit = fit(&Simulation::new(&spec).unwrap());
            let (rows, x) = (fit.plain_rows(), fit.parameters.values());
            let site = Site {
                rows: &rows,
                x,
                rotations: &rows.rotations(x),
            };
            let all = suspects_beside_biases(&site);
            all.iter().any(|s| s.fault.opens_force)
        };
        // Nine parameters: without a placement of ten the nine others meet any misfit.
        assert!(!suspected(10) && suspected(14));
    }
}
