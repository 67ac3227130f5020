//! Flicker noise of the biases in the rows of the joint problem.

use sensor::Sensor;

use super::{FLICKERS, Fading, Flicker};
use crate::methods::joint::noise::stations::Stations;
use crate::methods::joint::noise::weights::{Component, Form, White};
use crate::methods::joint::rows::Rows;
use crate::methods::joint::rows::turn::MARGIN;

impl Rows<'_> {
    /// The flicker of both biases, of unit instability, whitened by the white noise, at `x`.
    pub(in crate::methods::joint) fn flicker(
        &self,
        x: &[f64],
        white: &White,
        stations: &Stations,
    ) -> Vec<Component> {
        let spans = self.data.rests.iter().map(|rest| rest.span);
        let (from, to) = spans.fold((f64::INFINITY, f64::NEG_INFINITY), |(a, b), span| {
            (a.min(span.from), b.max(span.to))
        });
        let flicker = Flicker::lasting((to - from).max(1.0));
        let sensors = [Sensor::Accelerometer, Sensor::Gyroscope].into_iter();
        let of = |(place, sensor): (usize, Sensor)| {
            let all = self.fading(&flicker, x, sensor, white);
            let flicker = &flicker;
            let axis = move |axis: usize| Component {
                kind: FLICKERS[place][axis],
                covariance: flicker.covariance(&all, axis, self.count()),
                form: Form::Passed(flicker.chain(&all, axis, stations)),
            };
            (0..3).map(axis).collect::<Vec<_>>()
        };
        let all = sensors.enumerate().flat_map(of);
        all.filter(|c| c.covariance.diagonal().any(|v| v > 0.0))
            .collect()
    }

    fn fading(&self, flicker: &Flicker, x: &[f64], sensor: Sensor, white: &White) -> Vec<Fading> {
        let mut all = Vec::new();
        for own in self.means(sensor) {
            let recording = self.data.rests[own.chunk.rest].recording;
            let span = (own.mean.span.from, own.mean.span.to);
            all.push(flicker.of_mean(own.row..own.row + 3, recording, span, -1.0));
        }
        if sensor == Sensor::Gyroscope {
            for (row, turn) in self.turns() {
                let gains = self.gains(x, turn);
                let inner = &turn.t[MARGIN..turn.t.len() - MARGIN];
                all.push(flicker.of_samples(row..row + 2, turn.recording, inner, &gains));
            }
        }
        all.into_iter().map(|one| one.whitened(white)).collect()
    }
}
