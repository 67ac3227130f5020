//! `--limits`: what a calibration must reach, and the verdict in words.

use ::findings::Front;
use std::path::PathBuf;

use calib::Calibration;
use calib::calibration::Triad;
use calib::limits::{
    Bound, Limit, LimitLine, Limits, Residuals, built_in, judge, judge_on, not_kept, read_limits,
};

use crate::exit::{Failure, GATE, NOT_ENOUGH};
use crate::{report, show};

/// Limits that the result must keep.
#[derive(Clone, Debug, Default, clap::Args)]
pub struct LimitArgs {
    /// Limits that the result must keep (TOML): exit status 1 with the reasons where one is not kept
    #[arg(long, value_name = "FILE.toml")]
    pub limits: Option<PathBuf>,
}

impl LimitArgs {
    /// The limits of the file; none without one.
    ///
    /// # Errors
    /// Status 2 with the place for a file that says what is no limit, 3 for one that cannot be read.
    pub fn read(&self) -> Result<Option<Limits>, Failure> {
        let read = self.limits.as_deref().map(read_limits);
        Ok(read.transpose()?)
    }
}

/// Writes the verdict into the calibration: the limits of the file, by the residuals of its own recordings where they are given, then
/// what holds without one.
pub fn state(calibration: &mut Calibration, limits: Option<&Limits>, own: Option<Residuals>) {
    let mut lines = match (limits, own) {
        (Some(limits), Some(own)) => judge_on(limits, calibration, own),
        (Some(limits), None) => judge(limits, calibration),
        (None, _) => Vec::new(),
    };
    lines.extend(built_in(calibration));
    calibration.state_limits(lines);
}

/// Status 1 with the reasons where a quality gate failed or a limit is not kept, 4 where a sensor is not calibrated.
pub fn gate(calibration: &Calibration) -> Result<(), Failure> {
    let failed = gate_for(&reasons(calibration));
    match calibration.not_calibrated.is_empty() {
        true => failed,
        false => failed.map_err(|failure| Failure::new(NOT_ENOUGH, failure.message)),
    }
}

/// Status 1 where there are reasons.
pub fn gate_for(reasons: &[String]) -> Result<(), Failure> {
    match reasons {
        [] => Ok(()),
        reasons => Err(Failure::new(GATE, reasons.join("\nstillpoint: "))),
    }
}

/// Status 1 with the reasons where a limit is not kept by one of several calibrations.
pub fn gate_of(judged: &[(String, Vec<LimitLine>)]) -> Result<(), Failure> {
    let of = |(name, lines): &(String, Vec<LimitLine>)| {
        let failed = not_kept(lines).into_iter();
        let words = |line| format!("{}: {}", show::name(name), reason(line, None));
        failed.map(words).collect::<Vec<_>>()
    };
    let reasons: Vec<String> = judged.iter().flat_map(of).collect();
    gate_for(&reasons)
}

/// Why not to use a calibration as it stands: its gates, then its limits.
pub fn reasons(calibration: &Calibration) -> Vec<String> {
    let mut reasons = calibration.failed_gates.texts(Front::CommandLine);
    let failed = not_kept(&calibration.limits).into_iter();
    reasons.extend(failed.map(|line| reason(line, Some(calibration))));
    reasons
}

/// The limit that fails, and the reason.
fn reason(line: &LimitLine, calibration: Option<&Calibration>) -> String {
    let is_own = line.built_in && line.value.is_some() && line.kind != Bound::Present;
    let which = if is_own { "built-in limit" } else { "limit" };
    format!("{which}: {}", why(line, calibration))
}

/// Why a line fails, and what can be done.
fn why(line: &LimitLine, calibration: Option<&Calibration>) -> String {
    let Some(value) = line.value else {
        let what = match line.name.strip_prefix("effects.") {
            Some(effect) => format!("{effect} is not estimated; name it in --effects"),
            None => format!("{} is not known", line.words()),
        };
        return format!("{what} (limit {})", bound(line));
    };
    if line.kind == Bound::Present {
        let sensor = line.name.trim_start_matches("required.");
        return format!("the {sensor} is required and is not calibrated");
    }
    format!(
        "{} is {}, {} allowed{}",
        line.words(),
        quantity(value, &line.unit),
        bound(line),
        calibration.map_or_else(String::new, |c| over_noise(line, c))
    )
}

/// ` (40 times the noise in the intervals)` for a residual.
fn over_noise(line: &LimitLine, calibration: &Calibration) -> String {
    let of = |triad: &Option<Triad>| {
        let chi2 = triad.as_ref()?.reduced_chi2?;
        Some(format!(
            " ({:.1} times the noise in the intervals)",
            chi2.sqrt()
        ))
    };
    let words = match line.name.split_once('.') {
        Some(("accelerometer", what)) if what.contains("residual") => {
            of(&calibration.accelerometer)
        }
        Some(("gyroscope", what)) if what.contains("residual") => of(&calibration.gyroscope),
        _ => None,
    };
    words.unwrap_or_default()
}

/// `at most 5 mm/s^2`.
fn bound(line: &LimitLine) -> String {
    match (line.kind, line.limit) {
        (Bound::AtLeast, Limit::One(v)) => format!("at least {}", quantity(v, &line.unit)),
        (_, Limit::One(v)) => format!("at most {}", quantity(v, &line.unit)),
        (_, Limit::Range([low, high])) => {
            format!("{} to {}", number(low), quantity(high, &line.unit))
        }
    }
}

fn quantity(value: f64, unit: &str) -> String {
    match unit {
        "" | "1" => number(value),
        unit => format!("{} {unit}", number(value)),
    }
}

/// Four figures.
pub fn number(value: f64) -> String {
    let size = value.abs();
    if size != 0.0 && !(1e-3..1e5).contains(&size) {
        return format!("{value:.3e}");
    }
    let decimals = if size >= 1.0 || size == 0.0 {
        3.0 - size.max(1.0).log10().floor()
    } else {
        3.0 - size.log10().floor()
    };
    let text = format!("{value:.*}", decimals.clamp(0.0, 7.0) as usize);
    match text.contains('.') {
        true => text.trim_end_matches('0').trim_end_matches('.').to_owned(),
        false => text,
    }
}

/// The limits of a file as a report shows them, those first that are not kept.
pub fn shown(lines: &[LimitLine]) -> Vec<report::Limit> {
    let mut own: Vec<&LimitLine> = lines.iter().filter(|line| !line.built_in).collect();
    own.sort_by_key(|line| line.pass);
    let shown = |line: &LimitLine| report::Limit {
        passed: line.pass,
        words: match line.value {
            Some(value) if line.kind != Bound::Present => {
                let found = quantity(value, &line.unit);
                format!("{}: {found}, {} asked", line.name, bound(line))
            }
            _ if line.pass => format!("{}: there", line.name),
            _ => reason(line, None),
        },
    };
    own.into_iter().map(shown).collect()
}

/// The limits of several calibrations as a report shows them, each with the name of its calibration where there are several.
pub fn shown_of(judged: &[(String, Vec<LimitLine>)]) -> Vec<report::Limit> {
    let of = |(name, lines): &(String, Vec<LimitLine>)| {
        let mut all = shown(lines);
        if judged.len() > 1 {
            let called = show::name(name);
            all.iter_mut()
                .for_each(|limit| limit.words = format!("{called}: {}", limit.words));
        }
        all
    };
    judged.iter().flat_map(of).collect()
}

/// Returns how many limits are not kept, and those, in words; `None` where all are.
pub fn failing(lines: &[LimitLine]) -> Option<String> {
    let failed = not_kept(lines);
    let words: Vec<String> = failed.iter().map(|line| why(line, None)).collect();
    (!failed.is_empty()).then(|| {
        format!(
            "{} of {} limits: {}",
            failed.len(),
            lines.len(),
            words.join("; ")
        )
    })
}

/// Returns the number of limits of the file that are kept or fail, in a few words; `None` without a limits file.
pub fn kept(lines: &[LimitLine]) -> Option<String> {
    let own = lines.iter().filter(|line| !line.built_in);
    let (good, bad): (Vec<&LimitLine>, Vec<&LimitLine>) = own.partition(|line| line.pass);
    let all = good.len() + bad.len();
    match (all, bad.len()) {
        (0, _) => None,
        (_, 0) => Some(format!("all {all} are kept")),
        (_, failed) => Some(format!("{failed} of {all} fail")),
    }
}

/// The verdict of a limits file as a table, reasons first; nothing where no file was given.
pub fn text(lines: &[LimitLine]) -> String {
    let own: Vec<&LimitLine> = lines.iter().filter(|line| !line.built_in).collect();
    if own.is_empty() {
        return String::new();
    }
    let failed = own.iter().filter(|line| !line.pass).count();
    let mut table = show::table(&["limit", "asked", "found", "verdict"]);
    let (bad, good): (Vec<&LimitLine>, Vec<&LimitLine>) =
        own.iter().copied().partition(|line| !line.pass);
    for line in bad.into_iter().chain(good) {
        let asked = match line.kind {
            Bound::Present => "required".to_owned(),
            _ => bound(line),
        };
        let found = match (line.kind, line.value) {
            (Bound::Present, Some(v)) if v > 0.0 => "calibrated".to_owned(),
            (Bound::Present, _) => "not calibrated".to_owned(),
            (_, Some(v)) => quantity(v, &line.unit),
            (_, None) => "not known".to_owned(),
        };
        let verdict = if line.pass { "pass" } else { "FAIL" };
        table.add_row([line.name.clone(), asked, found, verdict.to_owned()]);
    }
    format!("{failed} of {} limits fail\n{table}\n\n", own.len())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_have_four_figures() {
        let shown = [0.0, 1.0, 12.5, 1769.84, 0.04123, 4.9e-7, 123_456.0].map(number);
        let expected = ["0", "1", "12.5", "1770", "0.04123", "4.900e-7", "1.235e5"];
        assert_eq!(shown, expected);
    }
}
