//! The biases estimated again, as a page and a picture.

use calib::calibration::Calibration;
use calib::methods::online_bias::Stretch;

use super::updates::updates;
use crate::pages::provenance;
use crate::report::{Axis, Picture, Plot, Report, ReportTable, Series};
use crate::show;

/// The corrected rate in every long static interval, 95 % intervals: where the old bias holds it is zero.
pub fn plot(stretches: &[Stretch]) -> Plot {
    let axes = ["x", "y", "z"].into_iter().enumerate();
    let empty = Plot::new(
        "What the old bias leaves in the static intervals",
        Axis::linear("middle of the static interval, s"),
        Axis::linear("corrected rate, rad/s"),
    );
    axes.fold(empty, |plot, (k, axis)| {
        let bars = stretches.iter().map(|stretch| {
            let (rate, half) = (stretch.residual[k], 1.96 * stretch.std[k]);
            let middle = 0.5 * (stretch.span.from + stretch.span.to);
            (middle, rate, rate - half, rate + half)
        });
        plot.with(Series::bars(axis, k, bars.collect()))
    })
}

/// Warnings, the biases before and now, the picture.
pub fn page(name: &str, warnings: &[String], new: &Calibration, plot: Option<&Picture>) -> Report {
    let header = [
        "bias",
        "before",
        "now",
        "change",
        "std error",
        "static intervals",
    ];
    let table = ReportTable::of(header, updates(new));
    let page = Report::new(format!("Biases from {name}"))
        .warnings(&show::folded(warnings))
        .provenance(provenance::rows(new))
        .section("Biases")
        .table(table);
    match plot {
        Some(plot) => page.section("Rates at rest").plot(plot),
        None => page,
    }
}
