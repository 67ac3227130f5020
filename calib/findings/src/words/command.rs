//! Commands that carry a remedy out.

use crate::finding::Finding;
use crate::inputs::Inputs;
use crate::remedy::{OptionName, Remedy};

use super::remedies::{flag, turning_back};
use super::shell::quoted;

/// The command line of a remedy; none where no command does it.
pub fn of(remedy: &Remedy, finding: &Finding, inputs: &Inputs<'_>) -> Option<String> {
    let names = match inputs.recordings.as_slice() {
        [] => "RECORDING".to_owned(),
        all => all.iter().map(|r| input(r)).collect::<Vec<_>>().join(" "),
    };
    // An option is given once: the one that the remedy sets takes the place of the one that was given.
    let set = match remedy {
        Remedy::Set { any_of } => any_of.first().map(|first| first.option),
        _ => None,
    };
    let given = inputs.place.iter().filter(|own| Some(own.0) != set);
    let place = |(option, value): &(OptionName, f64)| format!(" {} {value}", flag(*option));
    let place: String = given.map(place).collect();
    let calibrate =
        |options: &str| format!("stillpoint calibrate {names}{place} {options} -o cal.json");
    Some(match remedy {
        Remedy::Discover => format!("stillpoint discover {names}{place} -o findings.json"),
        Remedy::AddPlacements { .. } | Remedy::AddTurns { .. } | Remedy::Plan => {
            "stillpoint plan cal.json".into()
        }
        Remedy::Set { any_of } => {
            let first = any_of.first()?;
            if first.option == OptionName::Rest {
                let value = quoted(first.value.as_deref()?);
                return Some(format!("stillpoint allan {names} --rest {value}"));
            }
            let flag = flag(first.option);
            let usual = match first.option {
                OptionName::Gravity => "GRAVITY",
                OptionName::Latitude => "DEGREES",
                OptionName::Altitude => "METRES",
                OptionName::Rate => "HZ",
                OptionName::ForceDevice | OptionName::SkipBadRows | OptionName::SortTime => "",
                _ => first.value.as_deref()?,
            };
            let value = first.value.as_deref().unwrap_or(usual);
            match value {
                "" => calibrate(&flag),
                value => calibrate(&format!("{flag} {}", quoted(value))),
            }
        }
        Remedy::LeaveOut => {
            let (t0, t1) = (finding.place.t0?, finding.place.t1?);
            calibrate(&format!("--leave-out {:.2}", 0.5 * (t0 + t1)))
        }
        Remedy::UpdateBias => format!("stillpoint bias cal.json {names} -o cal.json"),
        Remedy::Validate => "stillpoint evaluate SECOND --calibration cal=cal.json".into(),
        Remedy::LookInto => format!("stillpoint info {names}"),
        Remedy::TurnBack { recording, columns } => turning_back(recording, columns),
        Remedy::ListEffects => "stillpoint effects".into(),
        Remedy::OtherMethod { method } => calibrate(&format!("--method {}", quoted(method))),
        _ => return None,
    })
}

/// A recording as a call names it: one that was put together of a file for each sensor by both.
fn input(recording: &str) -> String {
    match recording.split_once(" + ") {
        Some((force, rate)) if !rate.contains(" + ") => {
            format!(
                "--accel-file {} --gyro-file {}",
                quoted(force),
                quoted(rate)
            )
        }
        _ => quoted(recording),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::kind::Kind;

    #[test]
    fn commands_have_the_names_of_the_recordings_as_a_shell_reads_them() {
        let found = Finding::of(Kind::MISFIT);
        let of_recording = |name| Inputs {
            recordings: vec![name],
            place: Vec::new(),
        };
        let command = of(&Remedy::Discover, &found, &of_recording("my phone/rec 1"));
        let expected = "stillpoint discover 'my phone/rec 1' -o findings.json";
        assert_eq!(command.as_deref(), Some(expected));
        let command = of(
            &Remedy::Discover,
            &found,
            &of_recording("a/acc.csv + a/gyro.csv"),
        );
        let expected =
            "stillpoint discover --accel-file a/acc.csv --gyro-file a/gyro.csv -o findings.json";
        assert_eq!(command.as_deref(), Some(expected));
    }

    #[test]
    fn a_setting_has_its_value_and_the_gravity_that_was_given() {
        let found = Finding::of(Kind::MISFIT);
        let remedy = Remedy::set_to(OptionName::Columns, "az=az*0.5");
        let inputs = Inputs {
            recordings: vec!["a.csv"],
            place: vec![(OptionName::Gravity, 9.81)],
        };
        let command = of(&remedy, &found, &inputs);
        let expected =
            "stillpoint calibrate a.csv --gravity 9.81 --columns 'az=az*0.5' -o cal.json";
        assert_eq!(command.as_deref(), Some(expected));
    }

    #[test]
    fn an_option_that_is_set_anew_is_given_once() {
        let found = Finding::of(Kind::LATITUDE_DOUBTFUL);
        let inputs = Inputs {
            recordings: vec!["a.csv"],
            place: vec![(OptionName::Latitude, 48.0), (OptionName::Altitude, 500.0)],
        };
        let command = of(
            &Remedy::set_to(OptionName::Latitude, "-33"),
            &found,
            &inputs,
        );
        let expected = "stillpoint calibrate a.csv --altitude 500 --latitude -33 -o cal.json";
        assert_eq!(command.as_deref(), Some(expected));
    }
}
