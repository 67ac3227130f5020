//! Normalised residuals against what chance alone would give.

use statrs::distribution::{ContinuousCDF, Normal};

use super::session::Session;
use crate::report::{Axis, Picture, Plot, Series};

const GREY: usize = 6;

/// The pictures, where the noise is known: static intervals against a normal deviate, turns against the length of a
/// pair of them.
pub fn pictures(session: &Session<'_>, noise: [Option<f64>; 2]) -> Vec<Picture> {
    let mut all = Vec::new();
    if let Some(noise) = noise[0] {
        let left = session.rests.iter();
        let left = left.filter_map(|r| Some((r.left? / noise, r.key.clone())));
        let normal = |p: f64| Normal::standard().inverse_cdf(p);
        let what = "Normalised residuals of static intervals";
        all.push(picture(what, "normal quantile", left.collect(), normal));
    }
    if let Some(noise) = noise[1] {
        let left = session.turns.iter();
        let left = left.filter_map(|t| Some((t.left? / noise, t.key.clone())));
        // The squared length of two deviates is exponential: its root mean square is one here.
        let length = |p: f64| (-(1.0 - p).ln()).sqrt();
        let what = "Normalised errors of direction after turns";
        all.push(picture(what, "Rayleigh quantile", left.collect(), length));
    }
    all.into_iter().flatten().collect()
}

fn picture(
    title: &str,
    axis: &str,
    mut all: Vec<(f64, String)>,
    quantile: impl Fn(f64) -> f64,
) -> Option<Picture> {
    if all.len() < 3 {
        return None;
    }
    all.sort_by(|a, b| a.0.total_cmp(&b.0));
    let count = all.len() as f64;
    // Plotting positions of Blom (Statistical estimates and transformed beta-variables, 1958).
    let at = |k: usize| quantile((k as f64 + 0.625) / (count + 0.25));
    let dots = all
        .iter()
        .enumerate()
        .map(|(k, (value, _))| (at(k), *value));
    let (low, high) = (at(0), at(all.len() - 1));
    let plot = Plot::new(
        title,
        Axis::linear(axis),
        Axis::linear("residual over its noise"),
    )
    .with(Series::dashed(
        "noise alone",
        GREY,
        vec![(low, low), (high, high)],
    ))
    .with(
        Series::dots("measured", 0, dots.collect())
            .of(all.iter().map(|(_, key)| key.clone()).collect()),
    );
    Some(plot.into())
}
