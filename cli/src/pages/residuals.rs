//! Plots of the residuals at static intervals and through turns.

use calib::Calibration;
use calib::calibration::Remainder;
use calib::methods::joint::Channel;

use super::session::{Moved, Rest, Session};
use crate::report::{Axis, Picture, Plot, Series};

/// Colour of what is not calibrated.
pub const GREY: usize = 6;
/// Colour of what the noise allows.
const NOISE: usize = 2;
/// A temperature that changes by less, °C, is no axis.
const WARMED: f64 = 1.0;

/// One point of a picture.
struct Point {
    key: String,
    part: usize,
    x: f64,
    raw: Option<f64>,
    left: Option<f64>,
    std: f64,
}

/// Returns the measured noise in a calibration: norm in mm/s², direction in °.
pub fn noise(calibration: &Calibration) -> [Option<f64>; 2] {
    let of = |channel: Channel, factor: f64| {
        let found = calibration
            .misfit
            .iter()
            .find(|m: &&Remainder| m.channel == channel);
        found.map(|m| factor * m.noise).filter(|n| *n > 0.0)
    };
    [
        of(Channel::Force, 1e3),
        of(Channel::Direction, 1f64.to_degrees()),
    ]
}

/// The norm of specific force in every static interval, against its number.
pub fn norm(session: &Session<'_>, noise: Option<f64>) -> Plot {
    let point = |(k, rest): (usize, &Rest)| of_rest(rest, (k + 1) as f64);
    let points = session.rests.iter().enumerate().map(point).collect();
    two_panels(
        Plot::new(
            "Norm of specific force less gravity",
            Axis::linear("static interval, numbered through all recordings"),
            Axis::linear("raw, mm/s²"),
        ),
        "calibrated, mm/s²",
        session,
        points,
        noise.map(|n| (-2.0 * n, 2.0 * n)),
    )
}

/// The direction of gravity through every turn, against its number.
pub fn direction(session: &Session<'_>, noise: Option<f64>) -> Plot {
    let point = |turn: &Moved| {
        let number = turn.key[1..].parse().unwrap_or(0.0);
        of_turn(turn, number)
    };
    let points = session.turns.iter().map(point).collect();
    two_panels(
        Plot::new(
            "Error of gravity's direction, predicted through each turn",
            Axis::linear("turn, by the number of the static interval before it"),
            Axis::linear("raw, °"),
        ),
        "calibrated, °",
        session,
        points,
        noise.map(|n| (0.0, 2.0 * n)),
    )
}

/// Builds the plots of the residuals against orientation, temperature, time and rate, for each quantity that varies.
pub fn against(session: &Session<'_>, noise: [Option<f64>; 2]) -> Vec<Picture> {
    let mut all = Vec::new();
    if session
        .rests
        .iter()
        .any(|rest| rest.left.is_some() && rest.up.is_some())
    {
        all.push(orientation(session, noise[0]).into());
    }
    let band = noise[0].map(|n| (-2.0 * n, 2.0 * n));
    let rests = |x: &dyn Fn(&Rest) -> Option<f64>| -> Vec<Point> {
        let point = |rest: &Rest| Some(of_rest(rest, x(rest)?));
        session.rests.iter().filter_map(point).collect()
    };
    let norm = |title: &str, x: &str| {
        Plot::new(
            title,
            Axis::linear(x),
            Axis::linear("norm less gravity, mm/s²"),
        )
    };
    let middle = |rest: &Rest| Some(0.5 * (rest.span.0 + rest.span.1));
    let time = norm("What is left against time", "time, s");
    all.push(filled(time, session, &rests(&middle), band).into());
    let warm = rests(&|rest| rest.temperature);
    if spread(&warm) > WARMED {
        let plot = norm("What is left against temperature", "temperature, °C");
        all.push(filled(plot, session, &warm, band).into());
    }
    let turns = session.turns.iter();
    let turns: Vec<Point> = turns.filter_map(|t| Some(of_turn(t, t.rate?))).collect();
    let plot = Plot::new(
        "Error of gravity's direction against the rate",
        Axis::linear("largest rate in the turn, °/s"),
        Axis::linear("angle, °"),
    );
    all.push(filled(plot, session, &turns, noise[1].map(|n| (0.0, 2.0 * n))).into());
    all.retain(|picture: &Picture| !matches!(picture, Picture::Plot(plot) if plot.is_empty()));
    all
}

/// Three panels: against the component of the upward direction along each axis.
fn orientation(session: &Session<'_>, noise: Option<f64>) -> Plot {
    let axis = |k: usize| {
        Axis::linear(format!(
            "against {}: norm less gravity, mm/s²",
            ["x", "y", "z"][k]
        ))
    };
    let mut plot = Plot::new(
        "What is left against the orientation",
        Axis::linear("component of the upward direction along the axis").between(-1.0, 1.0),
        axis(0),
    );
    for k in 0..3 {
        if k > 0 {
            plot = plot.panel(axis(k));
        }
        let points = session.rests.iter();
        let points = points
            .filter_map(|rest| Some(of_rest(rest, rest.up?[k])))
            .collect::<Vec<_>>();
        plot = filled(plot, session, &points, noise.map(|n| (-2.0 * n, 2.0 * n)));
    }
    plot
}

fn of_rest(rest: &Rest, x: f64) -> Point {
    Point {
        key: rest.key.clone(),
        part: rest.part,
        x,
        raw: rest.raw,
        left: rest.left,
        std: rest.std.unwrap_or(0.0),
    }
}

fn of_turn(turn: &Moved, x: f64) -> Point {
    Point {
        key: turn.key.clone(),
        part: turn.part,
        x,
        raw: turn.raw,
        left: turn.left,
        std: 0.0,
    }
}

fn spread(points: &[Point]) -> f64 {
    let xs = points.iter().map(|p| p.x);
    let (low, high) = xs.fold((f64::INFINITY, f64::NEG_INFINITY), |(l, h), x| {
        (l.min(x), h.max(x))
    });
    high - low
}

/// Raw readings above, calibrated ones below with what the noise allows.
fn two_panels(
    plot: Plot,
    label: &str,
    session: &Session<'_>,
    points: Vec<Point>,
    band: Option<(f64, f64)>,
) -> Plot {
    let raw: Vec<&Point> = points.iter().filter(|p| p.raw.is_some()).collect();
    let dots = raw
        .iter()
        .map(|p| (p.x, p.raw.unwrap_or(f64::NAN)))
        .collect();
    let keys = raw.iter().map(|p| p.key.clone()).collect();
    let raw = Series::dots("raw", GREY, dots).of(keys);
    if points.iter().all(|p| p.left.is_none()) {
        return plot.with(raw);
    }
    let plot = if points.iter().any(|p| p.raw.is_some()) {
        plot.with(raw).panel(Axis::linear(label))
    } else {
        // Counts have nothing above.
        plot.labelled(Axis::linear(label))
    };
    filled(plot, session, &points, band)
}

/// The points of each recording with two standard errors, over what the noise allows.
fn filled(
    mut plot: Plot,
    session: &Session<'_>,
    points: &[Point],
    band: Option<(f64, f64)>,
) -> Plot {
    if let Some((low, high)) = band.filter(|_| points.iter().any(|p| p.left.is_some())) {
        plot = plot.with(Series::band("2σ of the measured noise", NOISE, low, high));
    }
    for (number, part) in session.parts.iter().enumerate() {
        let own = points.iter().filter(|p| p.part == number);
        let (mut bars, mut keys) = (Vec::new(), Vec::new());
        for point in own {
            if let Some(y) = point.left {
                bars.push((point.x, y, y - 2.0 * point.std, y + 2.0 * point.std));
                keys.push(point.key.clone());
            }
        }
        let name = if session.parts.len() > 1 {
            part.name.as_str()
        } else {
            "calibrated"
        };
        // The palette ends in the grey of the raw readings, and the third is the noise.
        let colour = [0, 1, 3, 4, 5][number % 5];
        plot = plot.with(Series::bars(name, colour, bars).of(keys));
    }
    plot
}

/// The readings over time with the static intervals marked, a picture for each recording.
pub fn over_time(session: &Session<'_>, units: [&str; 2]) -> Vec<Picture> {
    let picture = |part: &super::session::Part<'_>| {
        let count = part.segmentation.statics.len();
        let keys = (part.first..part.first + count).map(|k| k.to_string());
        let plot = super::intervals_plot(part.recording, part.segmentation, units, keys.collect());
        Picture::from(plot)
    };
    session.parts.iter().map(picture).collect()
}
