//! Commands for what comes after a calibration.

use ::findings::{Finding, Front, Remedy};
use calib::Calibration;
use calib::gravity::GravitySource;

use crate::call;
use crate::commands::calibrate::arguments::Args;
use crate::commands::calibrate::judgement::Judgement;
use crate::commands::shared::first_screen::{Step, apply_to};
use crate::pages::coverage::Coverage;
use crate::show;
use crate::show::command_line;

/// Commands for what comes next, the most telling first.
pub fn next(
    args: &Args,
    calibration: &Calibration,
    judgement: &Judgement,
    coverage: Option<&Coverage>,
) -> Vec<Step> {
    let given = args.output.as_deref().map(command_line);
    let cal = given.clone().unwrap_or("cal.json".into());
    let inputs = args.recordings.command_line() + &args.read.command_line();
    let again = |more: &str| call::again(args.call.as_ref(), more, given.is_some(), &cal);
    let mut steps: Vec<Step> = Vec::new();
    let remedies = || {
        judgement
            .findings
            .iter()
            .flat_map(|finding| finding.remedies.first())
    };
    let search = || {
        let place = args.place.command_line() + &args.leave_out.command_line();
        Step::new(
            "look for a missing effect",
            format!("stillpoint discover {inputs}{place} -o findings.json"),
        )
    };
    // What forbids the use of a calibration overrules what would allow it.
    let is_forbidden = judgement.findings.iter().any(Finding::forbids_use);
    let mut use_is_said = false;
    for finding in &judgement.findings {
        let step = match (
            finding.remedies.first(),
            finding.place.t0.zip(finding.place.t1),
        ) {
            (None | Some(Remedy::Plan), _) => None,
            (Some(Remedy::Discover), _) => Some(search()),
            (Some(Remedy::LeaveOut), Some((t0, t1))) => {
                let which = number(calibration, finding.place.recording.as_deref());
                let option = format!("--leave-out {which}{:.1}", 0.5 * (t0 + t1));
                Some(Step::new("leave out what was touched", again(&option)))
            }
            // That the result may be used all the same is said once.
            _ if finding.allows_use() && use_is_said => None,
            _ => {
                use_is_said |= finding.allows_use();
                let advice = match is_forbidden && finding.allows_use() {
                    true => finding.ways_out(Front::CommandLine),
                    false => finding.advice(Front::CommandLine),
                };
                advice.map(|advice| Step::words(show::capital(&advice) + "."))
            }
        };
        steps.extend(step.filter(|step| !steps.contains(step)));
    }
    let lacks_placements = coverage.and_then(Coverage::advice).is_some();
    if lacks_placements || remedies().any(|remedy| *remedy == Remedy::Plan) {
        // What a calibration knows it knows by all recordings, and as they were read.
        let known = given.clone().or_else(|| alone(args));
        if known.is_none() {
            steps.push(Step::new("keep the calibration", again("")));
        }
        let known = known.unwrap_or_else(|| cal.clone());
        steps.push(Step::new(
            "plan the placements to add",
            format!("stillpoint plan {known}"),
        ));
    }
    if is_forbidden {
        return steps;
    }
    if calibration.gravity_source == GravitySource::Assumed && calibration.accelerometer.is_some() {
        steps.extend(
            gained(calibration).map(|what| Step::new(what, again("--latitude DEG --altitude M"))),
        );
    }
    let keep = Step::new("keep the calibration", again(""));
    if given.is_none() && !steps.contains(&keep) {
        steps.push(keep);
    }
    let one = args.recordings.first() + &args.read.command_line();
    steps.push(apply_to(&one, &cal));
    steps.push(Step::new(
        "check on a second recording",
        format!("stillpoint evaluate SECOND --calibration cal={cal}"),
    ));
    steps
}

/// The recording, where its name alone says how it is read.
fn alone(args: &Args) -> Option<String> {
    let is_plain = args.read.command_line().is_empty() && args.leave_out.is_empty();
    match args.recordings.recordings.as_slice() {
        [one] if is_plain => Some(command_line(one)),
        _ => None,
    }
}

/// A place that leaves more of the errors is not asked for.
const WORTH_IT: f64 = 0.8;

/// Returns a step that states the gain in scale factor errors from a known place; `None` if the gain is small.
fn gained(calibration: &Calibration) -> Option<String> {
    let stds = calibration.accelerometer.iter().flat_map(|triad| {
        // Of counts a scale factor is far from 1.
        let of = |k: usize| Some(triad.t_std[k][k]? / triad.t[k][k].abs());
        (0..3).filter_map(of)
    });
    let of_gravity = calibration.gravity_source.std() / calibration.gravity;
    let (mut now, mut then) = (0.0, 0.0);
    for std in stds {
        let own = (std.powi(2) - of_gravity.powi(2)).max(0.0).sqrt();
        if std > now {
            (now, then) = (std, own);
        }
    }
    let ppm = |v: f64| show::rounded(1e6 * v, 2);
    let is_worth_it = then < WORTH_IT * now;
    is_worth_it.then(|| {
        format!(
            "give latitude and height: scale errors {} → {} ppm",
            ppm(now),
            ppm(then)
        )
    })
}

/// `2:` of the second of several recordings, as `--leave-out` takes it.
fn number(calibration: &Calibration, recording: Option<&str>) -> String {
    let inputs = &calibration.provenance.inputs;
    let is_its = |name: &str| Some(name) == recording;
    let place = inputs.iter().position(|input| is_its(&input.recording));
    let place = place.filter(|_| inputs.len() > 1);
    place.map_or_else(String::new, |k| format!("{}:", k + 1))
}
