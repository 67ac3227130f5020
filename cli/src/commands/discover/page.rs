//! The report of a discovery.

use calib::Recording;
use calib::discover::{Discovery, Findings, Request};
use sensor::Sensor;

use super::super::calibrate::tables::{PARAMETERS, parameters};
use super::advice::next_recordings;
use super::alternatives;
use super::first_screen::brief;
use super::tables::{self, Rows};
use super::verdict::{remains, verdict};
use super::words::proposed;
use crate::exit::Failure;
use crate::pages::coverage::{self, Coverage};
use crate::pages::session::{Session, all_cut};
use crate::pages::{calibration as pages, parameters as pictured, provenance};
use crate::report::{Figure, Picture, Report, ReportTable};
use crate::show;

/// The page: verdict, gap, every named effect with its residuals, the ranking, what could not be told, what to
/// record next, faults, the calibration.
pub fn page(
    discovery: &Discovery,
    recordings: &[Recording],
    request: &Request,
    plots: &[(String, Picture)],
) -> Result<Report, Failure> {
    page_after(discovery, recordings, request, plots, |report| report)
}

/// The same with what `first` puts before its sections.
pub fn page_after(
    discovery: &Discovery,
    recordings: &[Recording],
    request: &Request,
    plots: &[(String, Picture)],
    first: impl FnOnce(Report) -> Report,
) -> Result<Report, Failure> {
    let findings = &discovery.findings;
    let calibration = &findings.calibration;
    let (detector, choose) = (&request.detector, request.choose_multiplier);
    let cut = all_cut(recordings, detector, choose, calibration.gravity);
    let pairs = cut.iter().map(|(r, segmentation)| (*r, segmentation));
    let session = Session::of(pairs, Some(calibration), calibration.gravity)?;
    let coverage = pages::covered(&session);
    let mut report = Report::new("What is missing")
        .verdict(calibration.verdict().level.into(), brief(findings))
        .figures(figures(findings, coverage.as_ref()))
        .next(&next(findings))
        .warnings(&pages::notes(calibration))
        .provenance(provenance::rows(calibration));
    report = first(report).section("The gap").text(verdict(findings));
    let plot = |wanted: &str| plots.iter().find(|(name, _)| name == wanted);
    if let Some((_, gap)) = plot("gap").or(plot("remainder")) {
        report = report.plot(gap);
    }
    if let Some(coverage) = &coverage {
        report = report.plot(&coverage::picture(&session, coverage));
    }
    report = filled(report, tables::gaps(findings));
    report = tables::validated(findings)
        .into_iter()
        .fold(report, Report::text);
    if !findings.effects.is_empty() || !findings.validation.is_empty() {
        report = report.text(GAP);
    }
    report = named(report, discovery, plots);
    report = section(report, "Faults of the recording", tables::faults(findings));
    report = unexplained(report, findings);
    if let (Some((_, left)), false) = (plot("remainder"), findings.effects.is_empty()) {
        report = report.section("What the models leave").plot(left);
    }
    report = section(
        report,
        "Where the base models disagree",
        tables::disagreement(findings),
    );
    report = section(report, "The whole catalogue", tables::ranking(findings));
    if !findings.ranking.is_empty() {
        report = report.text(RANKING);
    }
    report = lines(
        report,
        "What could not be told apart",
        alternatives::ties(findings),
    );
    report = lines(
        report,
        "What may be there too",
        alternatives::beside(findings),
    );
    report = lines(
        report,
        "What cannot be seen here",
        tables::not_seen(findings),
    );
    report = calibrated(report, discovery);
    report = report
        .section("Parameters")
        .plot(&pictured::forest(calibration));
    if let Some(correlation) = pictured::correlation(calibration) {
        report = report.plot(&correlation);
    }
    pages::exports(report, calibration)
}

/// The largest gap before and after, weakest parameter, coverage.
fn figures(findings: &Findings, coverage: Option<&Coverage>) -> Vec<Figure> {
    let effects = findings.effects.iter();
    let widest = effects.max_by(|a, b| a.gap_before.total_cmp(&b.gap_before));
    let gap = match widest {
        Some(effect) => {
            let [before, after] = super::words::gaps(effect.gap_before, effect.gap_after);
            let by_chance = effect
                .gap_by_chance
                .map_or_else(String::new, |[low, high]| {
                    format!(", {low:.2} to {high:.2} is chance")
                });
            let note = format!(
                "{} with {}; 1 is explained to the noise{by_chance}",
                effect.channel.words(),
                effect.name
            );
            Figure::new("Gap, before → after", format!("{before} → {after}"), note)
        }
        None => {
            let worst = findings
                .disagreement
                .iter()
                .map(|d| d.size)
                .fold(1.0, f64::max);
            Figure::new(
                "Largest gap",
                format!("{worst:.2}"),
                "1 is explained to the noise",
            )
        }
    };
    let mut all = vec![gap];
    all.extend(pictured::weakest(&findings.calibration));
    all.extend(coverage.map(Coverage::figure));
    all
}

/// Returns the next steps: use the named effects, correct the faults, make further recordings.
fn next(findings: &Findings) -> Vec<String> {
    let said = findings.calibration.next.iter().flatten();
    let mut all: Vec<String> = said.map(show::step).collect();
    all.extend(next_recordings(findings));
    if all.is_empty() {
        all.push(
            "Calibrate with the base models: stillpoint calibrate RECORDING -o cal.json".into(),
        );
    }
    all
}

const GAP: &str = "A gap is the root of chi² per degree of freedom of one kind of comparison: 1 is explained to the noise that \
                   was measured in the recording. “Left out” are blocks of intervals that the fit did not see, predicted \
                   by the others.";

const RANKING: &str = "Each effect on its own against the base models, the random walk of the biases estimated under each. The \
                       chance is that of so much by any test of the catalogue where nothing is missing.";

/// Every named effect: equation, parameters, evidence, residuals.
fn named(mut report: Report, discovery: &Discovery, plots: &[(String, Picture)]) -> Report {
    let findings = &discovery.findings;
    let (header, evidence) = tables::evidence(findings);
    let held = &discovery.search.last.extension.effects;
    for (effect, row) in findings.effects.iter().zip(evidence) {
        report = report.section(effect.name.clone());
        if let Some((known, _)) = held.iter().find(|(e, _)| e.name() == effect.name) {
            report = report.text(known.equation());
        }
        report = filled(report, (PARAMETERS, tables::parameters(effect)));
        report = tables::reference(effect)
            .into_iter()
            .fold(report, Report::text);
        report = filled(report, (header, vec![row]));
        let own = format!("{}:", effect.name);
        let plots = plots.iter().map(|(_, plot)| plot);
        for plot in plots.filter(|plot| plot.title().starts_with(&own)) {
            report = report.plot(plot);
        }
    }
    report
}

fn unexplained(report: Report, findings: &Findings) -> Report {
    let Some(rest) = &findings.unexplained else {
        return report;
    };
    let instead = match rest.instead_of.as_slice() {
        [] => String::new(),
        names => format!(
            " It explains more than {}, whose name was withdrawn.",
            names.join(" and ")
        ),
    };
    let report = report
        .section("What remains unexplained")
        .text(format!("{}.{instead}", remains(rest)));
    let Some(proposal) = &findings.proposed else {
        return report;
    };
    let rows = tables::proposed_terms(proposal);
    filled(report.text(proposed(proposal)), (PARAMETERS, rows))
}

/// The base models of the final calibration.
fn calibrated(mut report: Report, discovery: &Discovery) -> Report {
    let (calibration, fit) = (&discovery.findings.calibration, &discovery.search.last.fit);
    let unit = |si: bool, unit: &'static str| if si { unit } else { "counts" };
    let sensors = [
        (
            "Accelerometer, a = T (A − b)",
            &calibration.accelerometer,
            unit(fit.force_unit.is_si(), "m/s²"),
            Sensor::Accelerometer,
        ),
        (
            "Gyroscope, w = T (W − b)",
            &calibration.gyroscope,
            unit(fit.rate_unit.is_si(), "rad/s"),
            Sensor::Gyroscope,
        ),
    ];
    for (heading, triad, unit, sensor) in sensors {
        if let Some(triad) = triad {
            let rows = parameters(triad, unit, sensor);
            report = section(report, heading, (PARAMETERS, rows));
        }
    }
    report
}

fn section<const N: usize>(report: Report, heading: &str, rows: Rows<N>) -> Report {
    if rows.1.is_empty() {
        return report;
    }
    filled(report.folded(heading), rows)
}

/// With a table, where it has rows.
fn filled<const N: usize>(report: Report, (header, rows): Rows<N>) -> Report {
    if rows.is_empty() {
        return report;
    }
    report.table(ReportTable::of(header, rows))
}

fn lines(report: Report, heading: &str, lines: Vec<String>) -> Report {
    if lines.is_empty() {
        return report;
    }
    let report = report.section(heading);
    lines.into_iter().fold(report, Report::text)
}
