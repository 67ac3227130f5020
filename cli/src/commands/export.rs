//! `export`: a calibration in another tool's form.

use ::findings::Front;
use std::fmt::Write as _;
use std::path::{Path, PathBuf};

use calib::noise::NOISE_SCHEMA;
use exchange::{Form, Settings, Source, TARGETS, Target, by_name, export};
use serde_json::json;

use crate::commands::shared::inputs::{gates_of, load};
use crate::exit::{Failure, INPUT};
use crate::output::{Folder, Output, Replace};
use crate::show;

/// Writes a calibration in another tool's form, and says what of it that form does not hold and how much that is for this
/// device.
#[derive(Debug, clap::Args)]
#[command(after_help = targets())]
pub struct Args {
    /// Calibration written by `calibrate`
    #[arg(value_name = "CAL")]
    calibration: PathBuf,
    /// The tool
    #[arg(long, value_name = "TARGET", value_parser = target)]
    to: &'static Target,
    /// Write here; a folder for tools that want several files
    #[arg(short, value_name = "FILE")]
    output: PathBuf,
    /// Noise densities that `allan` has written, for Kalibr
    #[arg(long, value_name = "FILE.json")]
    noise: Option<PathBuf>,
    /// Which of several sensors of a kind, from 0, for PX4 and ArduPilot
    #[arg(long, value_name = "N", default_value_t = 0)]
    instance: usize,
    /// The parameters that were in force while the recording was logged, for PX4 (sensor_combined) and ArduPilot (IMU), which
    /// log corrected readings: the calibration is put together with them
    #[arg(long, value_name = "FILE.param")]
    logged_with: Option<PathBuf>,
    #[command(flatten)]
    replace: Replace,
    /// Print what is lost as JSON instead of text
    #[arg(long)]
    json: bool,
}

/// The example and the list of targets.
fn targets() -> String {
    let mut text =
        String::from("Example:\n  stillpoint export cal.json --to px4 -o imu.params\n\nTargets:\n");
    for target in TARGETS {
        let _ = writeln!(text, "  {:10} {}", target.name, target.about);
    }
    text
}

/// The target of a name.
fn target(name: &str) -> Result<&'static Target, String> {
    by_name(name).ok_or_else(|| {
        let names: Vec<&str> = TARGETS.iter().map(|t| t.name).collect();
        format!("no such target; use one of {}", names.join(", "))
    })
}

/// Runs the command.
pub fn run(args: &Args) -> Result<(), Failure> {
    refuse_useless(args)?;
    let inputs: Vec<&Path> = std::iter::once(&args.calibration)
        .chain(&args.noise)
        .chain(&args.logged_with)
        .map(PathBuf::as_path)
        .collect();
    let outputs = Outputs::claim(args, &inputs)?;
    args.replace.end_if_all_exist()?;
    let calibration = load(&args.calibration)?;
    let settings = settings(args)?;
    let export = export(args.to, &Source::new(&calibration), &settings)?;
    outputs.write(&export.files)?;
    gates_of(&calibration).for_each(|gate| show::warn(&gate));
    show::warn_each(&calibration.bias_alone());
    show::warn_each(&calibration.for_flipped_axes());
    for note in &export.notes {
        show::note(&format!("note: {}", note.text(Front::CommandLine)));
    }
    if args.json {
        let notes = export
            .notes
            .iter()
            .map(|note| note.text(Front::CommandLine));
        let notes: Vec<String> = notes.collect();
        let document = json!({
            "target": args.to.name,
            "output": show::path(&args.output),
            "lost": export.lost,
            "notes": notes,
        });
        return show::print(&show::json(&document)?);
    }
    let mut text = String::new();
    if export.lost.is_empty() {
        let _ = writeln!(text, "nothing is lost");
    }
    for lost in &export.lost {
        let _ = writeln!(text, "{lost}");
    }
    show::print(&show::wrapped(&text))
}

/// Refuses options that the target would ignore.
fn refuse_useless(args: &Args) -> Result<(), Failure> {
    let name = args.to.name;
    let useless = [
        ("--noise", args.noise.is_some(), &["kalibr"][..]),
        ("--instance", args.instance > 0, &["px4", "ardupilot"]),
        (
            "--logged-with",
            args.logged_with.is_some(),
            &["px4", "ardupilot"],
        ),
    ];
    for (option, given, targets) in useless {
        if given && !targets.contains(&name) {
            let why = format!(
                "{option} is for {} and means nothing to {name}",
                targets.join(" and ")
            );
            return Err(Failure::usage(why).advise("leave it out"));
        }
    }
    Ok(())
}

fn settings(args: &Args) -> Result<Settings, Failure> {
    let noise = args.noise.as_ref().map(|path| {
        let text = calib::read_text(path)?;
        let found: Result<calib::noise::NoiseSummary, _> = serde_json::from_str(&text);
        match found {
            Ok(summary) if summary.schema == NOISE_SCHEMA => Ok(summary),
            _ => Err(Failure::new(INPUT, format!("no \"{NOISE_SCHEMA}\""))
                .in_file(show::path(path))
                .advise("use a file that `allan -o` has written")),
        }
    });
    let logged_with = args.logged_with.as_ref();
    let logged_with = logged_with.map(|path| calib::read_text(path));
    Ok(Settings {
        instance: args.instance,
        noise: noise.transpose()?,
        logged_with: logged_with.transpose()?,
    })
}

/// The files of a target.
struct Outputs {
    files: Vec<Output>,
    _folder: Option<Folder>,
}

impl Outputs {
    fn claim(args: &Args, inputs: &[&Path]) -> Result<Self, Failure> {
        let (path, replace) = (&args.output, args.replace);
        let Form::Folder(names) = args.to.form else {
            return Ok(Self {
                files: vec![Output::claim(path, replace, inputs)?],
                _folder: None,
            });
        };
        if path.extension().is_some() {
            let why = format!(
                "-o {}: {} wants {}",
                show::path(path),
                args.to.name,
                names.join(" and ")
            );
            return Err(Failure::usage(why).advise("name a folder, without an extension"));
        }
        let folder = Folder::make(path)?;
        let claims = names
            .iter()
            .map(|name| Output::claim_in(path, name, replace, inputs));
        Ok(Self {
            files: claims.collect::<Result<_, _>>()?,
            _folder: Some(folder),
        })
    }

    fn write(self, contents: &[Vec<u8>]) -> Result<(), Failure> {
        Output::write_all(self.files.into_iter().zip(contents))
    }
}
