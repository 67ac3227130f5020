//! The gap and the residuals before and after, as pictures.

use calib::discover::{
    Channel, ChannelResiduals, Discovery, Findings, Picture, Point, pictures, residuals_by_interval,
};

use super::tables::places;
use crate::report::{self, Axis, Plot, Series};
use crate::show;

/// Names of the plots as files, at most.
pub const PLOTS: [&str; 14] = [
    "remainder",
    "gap",
    "residual-1",
    "residual-2",
    "residual-3",
    "residual-4",
    "residual-5",
    "residual-6",
    "residual-7",
    "residual-8",
    "residual-9",
    "residual-10",
    "residual-11",
    "residual-12",
];

/// Colours of what is before and after, of the noise, and of what joins them.
const BEFORE: usize = 1;
const AFTER: usize = 0;
const BY_AXIS: [usize; 3] = [1, 4, 3];
const NOISE: usize = 2;
const GREY: usize = 6;

/// A gap above this wants a logarithmic axis.
const WIDE: f64 = 6.0;

/// Letters of a place beside the axis.
const LETTERS: usize = 18;

/// The plots by the names of their files: the gap, then for every named effect its residuals, and whatever the verdict what the
/// models leave of every interval.
pub fn plots(discovery: &Discovery) -> Vec<(String, report::Picture)> {
    let findings = &discovery.findings;
    let mut all = Vec::new();
    if !findings.effects.is_empty() {
        let residuals = pictures(discovery);
        all.push(gap(findings));
        all.extend(residuals.iter().flat_map(residual_plots));
    }
    let [remainder_name, names @ ..] = PLOTS;
    let remainder = remainder(
        &residuals_by_interval(discovery),
        !findings.effects.is_empty(),
    );
    let named = names
        .into_iter()
        .zip(all)
        .map(|(name, plot)| (name.to_owned(), plot.into()));
    let mut named: Vec<(String, report::Picture)> = named.collect();
    named.extend(remainder.map(|plot| (remainder_name.to_owned(), plot.into())));
    named
}

/// Builds the plot of the residual by interval, one panel per channel, with the base models beside it if an effect is
/// named.
fn remainder(all: &[ChannelResiduals], is_named: bool) -> Option<Plot> {
    let axis = |left: &ChannelResiduals| {
        let (measured, unit, _) = measured(left.channel);
        Axis::linear(format!("{measured}, {unit}"))
    };
    let x = Axis::linear("static interval, or the one before the turn, over all recordings");
    let title = "What the models leave, interval by interval, with 95 % of the white noise";
    let mut plot = Plot::new(title, x, axis(all.first()?));
    for (k, left) in all.iter().enumerate() {
        if k > 0 {
            plot = plot.panel(axis(left));
        }
        let (_, _, factor) = measured(left.channel);
        let bars = |of: fn(&Point) -> f64| {
            let bar = |(interval, p): &(usize, Point)| {
                let (y, half) = (factor * of(p), 1.96 * factor * p.std);
                // The axes of one interval side by side.
                (
                    *interval as f64 + 0.2 * (p.axis as f64),
                    y,
                    y - half,
                    y + half,
                )
            };
            left.points.iter().map(bar).collect::<Vec<_>>()
        };
        let name = |words: &'static str| if k == 0 { words } else { "" };
        if is_named {
            plot = plot.with(Series::bars(
                name("base models"),
                BEFORE,
                bars(|p| p.before),
            ));
        }
        plot = plot.with(Series::bars(name("final model"), AFTER, bars(|p| p.after)));
    }
    Some(plot)
}

/// The gap before and after everywhere it was measured.
fn gap(findings: &Findings) -> Plot {
    let several = findings.effects.len() > 1;
    let mut rows: Vec<(String, f64, f64)> = Vec::new();
    for (order, effect) in findings.effects.iter().enumerate() {
        for (place, before, after) in places(findings, effect) {
            let place: String = place.chars().take(LETTERS).collect();
            let name = if several {
                format!("{} {place}", order + 1)
            } else {
                place
            };
            rows.push((name, before, after));
        }
    }
    // The first is the topmost.
    let count = rows.len() as f64;
    let at = |k: usize| count - k as f64;
    let widest = rows.iter().map(|row| row.1.max(row.2)).fold(0.0, f64::max);
    let label = "gap, root of chi² per degree of freedom";
    let axis = if widest > WIDE {
        Axis::log(label)
    } else {
        Axis::linear(label)
    };
    let title = match findings.effects.as_slice() {
        [one] => format!("The gap of the {}", one.channel.words()),
        many => {
            let numbered = many.iter().enumerate();
            let names: Vec<String> = numbered
                .map(|(k, e)| format!("{} {}", k + 1, e.name))
                .collect();
            format!("The gap of {}", names.join(", "))
        }
    };
    let numbered = || rows.iter().enumerate();
    let dots =
        |of: fn(&(String, f64, f64)) -> f64| numbered().map(|(k, row)| (of(row), at(k))).collect();
    let joined = numbered().map(|(k, row)| (row.1.min(row.2), row.1.max(row.2), at(k)));
    let joined = joined.collect();
    let names = rows.iter().rev().map(|row| row.0.clone()).collect();
    Plot::new(
        title,
        axis,
        Axis::categories("where it was measured", names),
    )
    .with(Series::dashed(
        "explained to the noise",
        NOISE,
        vec![(1.0, 0.5), (1.0, count + 0.5)],
    ))
    .with(Series::levels("", GREY, joined))
    .with(Series::dots(
        "without the effect",
        BEFORE,
        dots(|row| row.1),
    ))
    .with(Series::dots("with it", AFTER, dots(|row| row.2)))
}

/// The residuals against what the effect predicts, and against what it goes with.
fn residual_plots(picture: &Picture) -> Vec<Plot> {
    let (measured, unit, factor) = measured(picture.channel);
    let label = format!("{measured}, {unit}");
    let effect = show::name(&picture.effect);
    let predicted = against(
        Plot::new(
            format!("{effect}: predicted and measured"),
            Axis::linear(format!("predicted by {effect}, {unit}")),
            Axis::linear(&label),
        )
        .with(diagonal(&picture.points, factor)),
        &picture.points,
        factor,
        |p| Some(factor * p.predicted),
    );
    let mut plots = vec![predicted];
    if let Some(covariate) = &picture.covariate {
        let x = match covariate.unit {
            "" => covariate.name.clone(),
            unit => format!("{}, {unit}", covariate.name),
        };
        let plot = Plot::new(
            format!("{effect}: residual before and after"),
            Axis::linear(x),
            Axis::linear(&label),
        );
        plots.push(against(plot, &picture.points, factor, |p| p.covariate));
    }
    plots
}

/// Returns the residual of a channel: its name, its unit, and the factor from the SI unit.
fn measured(channel: Channel) -> (&'static str, &'static str, f64) {
    match channel {
        Channel::StaticNorm => ("norm less gravity", "mm/s²", 1e3),
        Channel::StaticRate => ("rate at static intervals", "mrad/s", 1e3),
        Channel::Direction => ("gravity's direction after the turn", "°", 1f64.to_degrees()),
        Channel::MovingForce => ("specific force while turning", "mm/s²", 1e3),
    }
}

fn diagonal(points: &[Point], factor: f64) -> Series {
    let values = points.iter().map(|p| factor * p.predicted);
    let (low, high) = values.fold((0.0_f64, 0.0_f64), |(l, h), v| (l.min(v), h.max(v)));
    Series::dashed("as predicted", GREY, vec![(low, low), (high, high)])
}

/// Dots with 95 % of the white noise, before and after; before axis by axis, where there are several.
fn against(plot: Plot, points: &[Point], factor: f64, x: impl Fn(&Point) -> Option<f64>) -> Plot {
    let bars = |of: fn(&Point) -> f64, wanted: &dyn Fn(&Point) -> bool| {
        let bar = |p: &Point| {
            let (y, half) = (factor * of(p), 1.96 * factor * p.std);
            Some((x(p)?, y, y - half, y + half))
        };
        let all = points.iter().filter(|p| wanted(p));
        all.filter_map(bar).collect::<Vec<(f64, f64, f64, f64)>>()
    };
    let axes = 1 + points.iter().map(|p| p.axis).max().unwrap_or(0);
    let plot = (0..axes).fold(plot, |plot, axis| {
        let name = match (axes, axis) {
            (3, 0) => "x without the effect",
            (3, 1) => "y without the effect",
            (3, 2) => "z without the effect",
            (_, 0) => "without the effect",
            _ => "",
        };
        let colour = if axes == 3 { BY_AXIS[axis] } else { BEFORE };
        plot.with(Series::bars(
            name,
            colour,
            bars(|p| p.before, &|p| p.axis == axis),
        ))
    });
    plot.with(Series::bars("with it", AFTER, bars(|p| p.after, &|_| true)))
}
