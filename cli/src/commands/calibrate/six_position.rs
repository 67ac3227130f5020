//! `calibrate --method six-position`: each axis once up and once down.

use ::findings::Front;
use std::fmt::Write as _;

use calib::calibrate::Request;
use calib::gravity::Gravity;
use calib::limits::Limits;
use calib::methods::six_position::{
    EarthRotation, Face, GyroscopePart, SixPosition, Solved, calibrate,
};
use calib::{Calibration, Recording};
use nalgebra::Vector3;

use super::arguments::Args;
use super::first_screen::{self, Shown};
use super::limits::{self, gate};
use crate::commands::shared::pictures::{Pictures, named};
use crate::exit::Failure;
use crate::output::Output;
use crate::pages::coverage::Coverage;
use crate::pages::{calibration, parameters, provenance, verdict as judge};
use crate::report::{Axis, Figure, Picture, Plot, Report, ReportTable, Series};
use crate::show;

const AXES: [&str; 3] = ["x", "y", "z"];

/// Names of the plots.
pub const PLOTS: [&str; 2] = ["modulus", "parameters"];

/// Runs the method on six recordings, or on one with all placements.
pub fn run(
    args: &Args,
    recordings: &[Recording],
    request: &Request,
    limits: Option<Limits>,
    output: Option<Output>,
    pictures: Pictures,
) -> Result<(), Failure> {
    let gravity = Gravity {
        value: request.gravity,
        source: request.gravity_source,
    };
    let Solved {
        mut calibration,
        solution,
        labels,
    } = calibrate(recordings, &request.detector, gravity, args.first_order)?;
    limits::state(&mut calibration, limits.as_ref(), None);
    first_screen::state_next(args, &mut calibration, None);
    let json = show::json(&calibration)?;
    Output::write_given(output, &json)?;
    if pictures.wanted() {
        let mut plots = named(PLOTS, [plot(&solution)]);
        plots.push((PLOTS[1].into(), parameters::forest(&calibration)));
        let page = report(&solution, &labels, &calibration, &plots)?;
        pictures.write(&plots, &page)?;
    }
    if args.json {
        show::warn_all(&calibration.warnings.texts(Front::CommandLine));
        show::print(&json)?;
        return gate(&calibration);
    }
    let shown = Shown {
        args,
        recordings,
        calibration: &calibration,
        residual: format!(
            "{} mm/s² over the six faces, which are tilted by about {:.2}°",
            show::figures(1e3 * solution.residual_rms, 3),
            solution.tilt().to_degrees()
        ),
    };
    first_screen::screen(&shown)
        .show(|| limits::text(&calibration.limits) + &text(&solution, &labels))?;
    gate(&calibration)
}

/// Builds the plot of the residual of gravity's norm on each face, mm/s².
fn plot(solution: &SixPosition) -> Plot {
    let left = |correct: &dyn Fn(&Vector3<f64>) -> Vector3<f64>| {
        (0..6)
            .map(|k| {
                let mean: Vector3<f64> = solution.means.column(k).into();
                let norm = correct(&mean).norm();
                ((k + 1) as f64, 1e3 * (norm - solution.gravity))
            })
            .collect::<Vec<_>>()
    };
    let faces = ["x down", "x up", "y down", "y up", "z down", "z up"];
    let plot = Plot::new(
        "What is left of gravity's norm on each face",
        Axis::categories("face", faces.map(str::to_owned).to_vec()),
        Axis::linear("raw: norm less gravity, mm/s²"),
    )
    .with(Series::dots("raw", 6, left(&|mean| *mean)));
    match solution.base() {
        Some(base) => plot
            .panel(Axis::linear("calibrated: norm less gravity, mm/s²"))
            .with(Series::dots("six positions", 0, left(&|m| base.correct(m)))),
        None => plot,
    }
}

fn report(
    solution: &SixPosition,
    labels: &[String; 6],
    calibration: &Calibration,
    plots: &[(String, Picture)],
) -> Result<Report, Failure> {
    let table = |(header, rows): ([&str; 5], Vec<[String; 5]>)| ReportTable::of(header, rows);
    let directions = solution.means.column_iter().map(|c| {
        let mean: Vector3<f64> = c.into();
        (mean / mean.norm()).into()
    });
    let coverage = Coverage::of(&directions.collect::<Vec<_>>());
    let judged = judge::judged(calibration, None);
    let residual = format!("{:.1} mm/s²", 1e3 * solution.residual_rms);
    let tilt = format!(
        "placements tilted by about {:.2}°",
        solution.tilt().to_degrees()
    );
    let mut figures = vec![Figure::new("Residual, calibrated", residual, tilt)];
    figures.extend(parameters::weakest(calibration));
    figures.push(coverage.figure());
    let mut report = Report::new("Calibration by six positions")
        .verdict(judged.level, &judged.sentence)
        .figures(figures)
        .next(&judged.next)
        .warnings(&calibration::notes(calibration))
        .provenance(provenance::rows(calibration))
        .section("Accelerometer")
        .text(format!("Gravity {} m/s².", solution.gravity))
        .table(table(matrix(solution)))
        .text(misfit(solution))
        .plot(&plots[0].1)
        .plot(&plots[1].1)
        .section("Placements")
        .table(table(faces(solution, labels)));
    if let Some(part) = &solution.gyroscope {
        report = report
            .section("Gyroscope")
            .table(table(rates(part)))
            .text(verdict(part));
    }
    calibration::exports(report, calibration)
}

/// A table of the result.
fn shown((header, rows): ([&str; 5], Vec<[String; 5]>)) -> comfy_table::Table {
    show::table_of(&header, rows)
}

fn text(solution: &SixPosition, labels: &[String; 6]) -> String {
    let mut text = String::new();
    let _ = writeln!(text, "{}\n", shown(faces(solution, labels)));
    let _ = writeln!(text, "{}", shown(matrix(solution)));
    let _ = writeln!(text, "{}\n", misfit(solution));
    if let Some(part) = &solution.gyroscope {
        let _ = writeln!(text, "{}\n{}", shown(rates(part)), verdict(part));
    }
    text
}

fn faces(solution: &SixPosition, labels: &[String; 6]) -> ([&'static str; 5], Vec<[String; 5]>) {
    let header = ["face", "mean x, m/s²", "mean y", "mean z", "from"];
    let row = |(k, face): (usize, &Face)| {
        let mean = |axis: usize| format!("{:.6}", solution.means[(axis, k)]);
        let from = show::name(&labels[k]);
        [face.name().into(), mean(0), mean(1), mean(2), from]
    };
    (header, Face::ALL.iter().enumerate().map(row).collect())
}

fn matrix(solution: &SixPosition) -> ([&'static str; 5], Vec<[String; 5]>) {
    let header = ["raw = (I + M) f + b", "M x", "M y", "M z", "b, m/s²"];
    let row = |(i, axis): (usize, &&str)| {
        let m = |j: usize| format!("{:+.7}", solution.m[(i, j)]);
        let bias = format!("{:+.6}", solution.bias[i]);
        [(*axis).into(), m(0), m(1), m(2), bias]
    };
    (header, AXES.iter().enumerate().map(row).collect())
}

fn misfit(solution: &SixPosition) -> String {
    format!(
        "residual {:.1} mm/s² rms; the placements are tilted by about {:.2}° rms",
        1e3 * solution.residual_rms,
        solution.tilt().to_degrees()
    )
}

fn rates(part: &GyroscopePart) -> ([&'static str; 5], Vec<[String; 5]>) {
    let header = [
        "gyroscope, as published",
        "bias, rad/s",
        "std error",
        "S",
        "std error",
    ];
    let row = |(k, axis): (usize, &&str)| {
        [
            (*axis).into(),
            format!("{:+.7}", part.bias[k]),
            show::error(Some(part.bias_std[k])),
            format!("{:+.4}", part.scale_error[k]),
            show::error(Some(part.scale_error_std[k])),
        ]
    };
    (header, AXES.iter().enumerate().map(row).collect())
}

/// Returns the verdict on the gyroscope's part.
fn verdict(part: &GyroscopePart) -> &'static str {
    match part.earth_rotation() {
        EarthRotation::Seen => {
            "the earth's rate stands out on every axis: S is a scale factor error"
        }
        EarthRotation::Hidden => {
            "S means nothing here: the bias wanders by more than the earth's rate between placements; \
             only the bias goes into the calibration"
        }
        EarthRotation::Absent => {
            "S means nothing here: beyond ±0.1 the readings do not follow the earth's rate as assumed \
             (near -1 not at all); the published formula leaves out the sine of the latitude; only the \
             bias goes into the calibration"
        }
    }
}
