//! The report of a discovery.

use calib::discover::{Discovery, Findings};

use super::super::calibrate::tables::{PARAMETERS, parameters};
use super::super::limits;
use super::tables::{self, Rows};
use super::words::{next_recordings, proposed, verdict};
use crate::exit::Failure;
use crate::report::{Plot, Report, ReportTable};

/// The page: verdict, gap, every named effect with its residuals, the ranking, what could not be told, what to
/// record next, faults, the calibration.
pub fn page(discovery: &Discovery, plots: &[Plot]) -> Result<Report, Failure> {
    let findings = &discovery.findings;
    let calibration = &findings.calibration;
    let failed = limits::reasons(calibration).into_iter();
    let gates: Vec<String> = failed.map(|gate| format!("Do not use: {gate}")).collect();
    let mut report = Report::new("What is missing")
        .section("Verdict")
        .text(verdict(findings));
    if let Some(gap) = plots.first() {
        report = report.plot(gap)?;
    }
    report = filled(report, tables::gaps(findings));
    report = tables::validated(findings)
        .into_iter()
        .fold(report, Report::text);
    if !findings.effects.is_empty() || !findings.validation.is_empty() {
        report = report.text(GAP);
    }
    report = named(report, discovery, plots)?;
    report = section(report, "Faults of the recording", tables::faults(findings));
    report = unexplained(report, findings);
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
        tables::ties(findings),
    );
    report = lines(report, "What to record next", next_recordings(findings));
    report = lines(
        report,
        "What cannot be seen here",
        tables::not_seen(findings),
    );
    report = lines(
        report,
        "Notes on the recordings",
        calibration.warnings.clone(),
    );
    Ok(calibrated(report, discovery).warnings(&gates))
}

const GAP: &str = "A gap is the root of chi² per degree of freedom of one kind of comparison: 1 is explained to the noise that \
                   was measured in the recording. “Left out” are blocks of intervals that the fit did not see, foretold \
                   by the others.";

const RANKING: &str = "Each effect on its own against the base models, the random walk of the biases estimated under each. The \
                       chance is that of so much by any test of the catalogue where nothing is missing.";

/// Every named effect: equation, parameters, evidence, residuals.
fn named(mut report: Report, discovery: &Discovery, plots: &[Plot]) -> Result<Report, Failure> {
    let findings = &discovery.findings;
    let (header, evidence) = tables::evidence(findings);
    let held = &discovery.search.last.extension.effects;
    for (effect, row) in findings.effects.iter().zip(evidence) {
        report = report.section(effect.name.clone());
        if let Some((known, _)) = held.iter().find(|(e, _)| e.name() == effect.name) {
            report = report.text(known.equation());
        }
        report = filled(report, (PARAMETERS, tables::parameters(effect)));
        report = filled(report, (header, vec![row]));
        let own = format!("{}:", effect.name);
        for plot in plots.iter().filter(|plot| plot.title.starts_with(&own)) {
            report = report.plot(plot)?;
        }
    }
    Ok(report)
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
    let report = report.section("What remains unexplained").text(format!(
        "{}: gap {:.2} of the {}, chance {}.{instead}",
        rest.shape,
        rest.size,
        rest.channel.words(),
        super::words::chance(rest.p_value)
    ));
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
            "accel",
        ),
        (
            "Gyroscope, w = T (W − b)",
            &calibration.gyroscope,
            unit(fit.rate_unit.is_si(), "rad/s"),
            "gyro",
        ),
    ];
    for (heading, triad, unit, prefix) in sensors {
        if let Some(triad) = triad {
            let rows = parameters(triad, unit, prefix);
            report = section(report, heading, (PARAMETERS, rows));
        }
    }
    report
}

fn section<const N: usize>(report: Report, heading: &str, rows: Rows<N>) -> Report {
    if rows.1.is_empty() {
        return report;
    }
    filled(report.section(heading), rows)
}

/// With a table, where it has rows.
fn filled<const N: usize>(report: Report, (header, rows): Rows<N>) -> Report {
    if rows.is_empty() {
        return report;
    }
    let mut table = ReportTable::new(header);
    rows.into_iter().for_each(|row| table.row(row));
    report.table(table)
}

fn lines(report: Report, heading: &str, lines: Vec<String>) -> Report {
    if lines.is_empty() {
        return report;
    }
    let report = report.section(heading);
    lines.into_iter().fold(report, Report::text)
}
