//! `info`: what is in a file, and the command that would calibrate it.

mod clock;
mod log;
mod ours;

use ::findings::{Finding, Front};
use std::fmt::Write as _;
use std::path::{Path, PathBuf};

use calib::Recording;
use calib::gravity::Gravity;
use calib::intervals::{Detector, Rejected};
use calib::methods::{Choice, cut};
use calib::readings::symptoms;
use calib::recording::{Described, FieldUnit, UnitBy};
use clock::Clock;
use log::Log;
use ours::Ours;
use sensor::Sensor;
use serde_json::{Value, json};

use crate::commands::shared::first_screen::to_calibrate;
use crate::commands::shared::inputs::read_all;
use crate::commands::shared::names::Names;
use crate::exit::Failure;
use crate::read_args::ReadArgs;
use crate::{pages, show, terminal};

/// Shows what is in a file: format, sensors, columns, units and what decided them, clocks, gaps, rests.
#[derive(Debug, clap::Args)]
#[command(after_help = "\
Example:
  stillpoint info experiment.zip log.ulg")]
pub struct Args {
    /// Files or folders; `-` reads standard input
    #[arg(value_name = "FILE", required = true)]
    files: Vec<PathBuf>,
    /// Print JSON instead of tables
    #[arg(long)]
    json: bool,
    #[command(flatten)]
    read: ReadArgs,
}

/// Runs the command.
pub fn run(args: &Args) -> Result<(), Failure> {
    let (mut documents, mut pages) = (Vec::new(), Vec::new());
    for path in &args.files {
        if let Some(ours) = Ours::of(path)? {
            documents.push(ours.document(path));
            pages.push(ours.page(path));
            continue;
        }
        match read_all(path, &args.read) {
            Ok(recordings) => {
                for recording in recordings {
                    let facts = Facts::of(path, &recording, &args.read);
                    if args.json {
                        documents.push(facts.document());
                        continue;
                    }
                    pages.push(match terminal::is_verbose() {
                        true => format!("{}\n\n{}", facts.screen(), facts.page()),
                        false if terminal::is_quiet() => facts.headline(),
                        false => facts.screen(),
                    });
                }
            }
            Err(refused) => {
                let log = Log::of(path, &args.read, refused)?;
                documents.push(log.document());
                pages.push(log.page());
            }
        }
    }
    if args.json {
        return show::print(&show::json(
            &json!({"schema": "stillpoint.info/1", "files": documents}),
        )?);
    }
    show::print(&show::wrapped(&pages.join("\n")))
}

/// Notes that are said without asking.
const NOTES: usize = 4;

/// Facts about a recording, as `info` shows them.
struct Facts<'a> {
    recording: &'a Recording,
    choice: Option<Choice>,
    remarks: Vec<String>,
    command: String,
}

fn decided(by: UnitBy) -> &'static str {
    match by {
        UnitBy::Option => "an option",
        UnitBy::File => "the file",
        UnitBy::Data => "the samples",
        UnitBy::Nothing => "nothing, and assumed",
    }
}

/// Columns by role.
fn names(columns: &[(&'static str, String)]) -> serde_json::Map<String, Value> {
    let of = |(role, column): &(&str, String)| ((*role).to_owned(), json!(column));
    columns.iter().map(of).collect()
}

/// Columns by role as words: `ax=acc_x, ay=acc_y`.
fn assigned(sensor: &Described) -> String {
    let columns = sensor.columns.iter();
    let words = columns.map(|(role, column)| format!("{role}={}", show::name(column)));
    words.collect::<Vec<_>>().join(", ")
}

fn sign(sensor: &Described) -> Option<&'static str> {
    (sensor.sensor == Sensor::Accelerometer).then_some(match sensor.turned {
        true => "turned to +g on the axis that points up",
        false => "as it is, +g on the axis that points up",
    })
}

impl<'a> Facts<'a> {
    fn of(path: &Path, recording: &'a Recording, read: &ReadArgs) -> Self {
        let gravity = Gravity::of(None, None, None).value;
        let choice = cut(
            &recording.clone().decimated(),
            &Detector::default(),
            true,
            gravity,
        )
        .ok();
        let found = choice
            .iter()
            .flat_map(|choice| symptoms(recording, &choice.segmentation))
            .map(|symptom| Finding::from(&symptom));
        let rejected = choice
            .iter()
            .flat_map(|choice| Rejected::findings(&choice.segmentation.rejected));
        let remarks = recording
            .warnings
            .texts(Front::CommandLine)
            .into_iter()
            .chain(
                rejected
                    .chain(found)
                    .map(|finding| finding.text(Front::CommandLine)),
            );
        let rests = choice
            .as_ref()
            .map_or(0, |choice| choice.segmentation.statics.len());
        let least = plan::REQUIREMENT.placements;
        let command = match &recording.accelerometer {
            None if recording.is_magnetometer_only() => {
                let alone = ::findings::Finding::of(::findings::Kind::MAGNETOMETER_ALONE);
                format!("none: {}", alone.text(Front::CommandLine))
            }
            Some(_) if rests < least => format!(
                "none by this recording alone: it has {}, and a calibration needs {least} placements in which the device is held still",
                show::counted(rests, "static interval")
            ),
            Some(_) => format!(
                "stillpoint calibrate {}{} -o cal.json",
                crate::show::command_line(path),
                read.command_line()
            ),
            None => {
                "none: a calibration needs an accelerometer, and there is none in it".to_owned()
            }
        };
        Self {
            recording,
            remarks: remarks.collect(),
            choice,
            command,
        }
    }

    fn temperature(&self) -> Option<[f64; 2]> {
        let celsius = &self.recording.temperature.as_ref()?.celsius;
        Some([
            celsius.iter().copied().fold(f64::INFINITY, f64::min),
            celsius.iter().copied().fold(f64::NEG_INFINITY, f64::max),
        ])
    }

    fn rests(&self) -> Option<(usize, f64)> {
        // A magnetometer alone shows no rest.
        let choice = self.choice.as_ref();
        let choice = choice.filter(|_| !self.recording.is_magnetometer_only())?;
        let statics = &choice.segmentation.statics;
        // The sum of none is −0.
        let length = 0.0 + statics.iter().map(|rest| rest.span.length()).sum::<f64>();
        Some((statics.len(), length))
    }

    fn document(&self) -> Value {
        let sensors = self.recording.description.sensors.iter().map(|sensor| {
            let clock = self.recording.stream(sensor.sensor).and_then(Clock::of);
            json!({
                "sensor": sensor.sensor.name(),
                "source": sensor.source,
                "columns": names(&sensor.columns),
                "columns_not_used": sensor.unused,
                "unit": sensor.unit,
                "unit_decided_by": decided(sensor.unit_by),
                "sign": sign(sensor),
                "samples": clock.as_ref().map(|c| c.samples),
                "start": clock.as_ref().map(|c| c.start),
                "duration": clock.as_ref().map(|c| c.duration),
                "rate": clock.as_ref().map(|c| c.rate),
                "jitter": clock.as_ref().map(|c| c.jitter),
                "gaps": clock.as_ref().map(|c| c.gaps),
                "longest_gap": clock.as_ref().map(|c| c.longest_gap),
            })
        });
        json!({
            "file": self.recording.name,
            "format": self.recording.description.format,
            "sensors": sensors.collect::<Vec<_>>(),
            "one_clock": self.one_clock(),
            "temperature": self.temperature(),
            "magnetometer": self.recording.magnetometer.as_ref().map(|field| {
                let clock = Clock::of(&field.stream);
                json!({
                    "source": field.source,
                    "columns": names(&field.columns),
                    "unit": field.unit.map(FieldUnit::name),
                    "samples": field.stream.len(),
                    "start": clock.as_ref().map(|c| c.start),
                    "duration": clock.as_ref().map(|c| c.duration),
                    "rate": clock.as_ref().map(|c| c.rate),
                })
            }),
            "static_intervals": self.rests().map(|(count, length)| json!({"count": count, "seconds": length})),
            "warnings": self.remarks,
            "command": self.command,
        })
    }

    /// Both sensors have the same stamps; `None` with one sensor.
    fn one_clock(&self) -> Option<bool> {
        let pair = self
            .recording
            .accelerometer
            .as_ref()
            .zip(self.recording.gyroscope.as_ref())?;
        Some(pair.0.t == pair.1.t)
    }

    /// Returns the headline: format, length, rate and static intervals, in a sentence.
    fn headline(&self) -> String {
        let recording = self.recording;
        let streams = [&recording.accelerometer, &recording.gyroscope];
        let clock = streams.into_iter().flatten().find_map(Clock::of);
        let clock = clock.or_else(|| Clock::of(&recording.magnetometer.as_ref()?.stream));
        let length = clock.map_or_else(String::new, |clock| {
            format!(", {:.1} s at {:.2} Hz", clock.duration, clock.rate)
        });
        let rests = match self.rests() {
            Some((count, length)) => {
                format!(
                    ", {} ({length:.0} s)",
                    show::counted(count, "static interval")
                )
            }
            None if recording.is_magnetometer_only() => String::new(),
            None => ", no static interval found".into(),
        };
        let format = &recording.description.format;
        format!("{}: {format}{length}{rests}", self.name())
    }

    /// The name that it is called by.
    fn name(&self) -> String {
        let name = self.recording.name.as_str();
        pages::session::short_names(&[name])
            .pop()
            .unwrap_or_default()
    }

    /// Returns the first screen: the headline, the sensors, notes and the next command.
    fn screen(&self) -> String {
        let mut text = format!("{}\n\n{}\n", self.headline(), self.sensors());
        let names = Names::of([self.recording]);
        for sensor in &self.recording.description.sensors {
            let turned = if sensor.turned {
                ", turned to +g up"
            } else {
                ""
            };
            let _ = writeln!(
                text,
                "{}: {}; unit by {}{turned}",
                sensor.sensor.name(),
                assigned(sensor),
                decided(sensor.unit_by)
            );
        }
        let folded = show::folded(&self.remarks);
        for remark in folded.iter().take(NOTES) {
            let _ = writeln!(text, "note: {}", names.short(&show::gist(remark)));
        }
        match folded.len().saturating_sub(NOTES) {
            0 => {}
            1 => text.push_str("1 more note with -v\n"),
            more => {
                let _ = writeln!(text, "{more} more notes with -v");
            }
        }
        let _ = writeln!(text, "\n{}", to_calibrate(&self.command));
        text
    }

    fn page(&self) -> String {
        let description = &self.recording.description;
        let mut text = format!(
            "{}: {}\n\n",
            show::name(&self.recording.name),
            description.format
        );
        let _ = writeln!(text, "{}\n", self.sensors());
        for sensor in &description.sensors {
            let _ = writeln!(
                text,
                "{}: {} from {}, {} by {}",
                sensor.sensor.name(),
                assigned(sensor),
                show::name(&sensor.source),
                sensor.unit,
                decided(sensor.unit_by)
            );
            if let Some(sign) = sign(sensor) {
                let _ = writeln!(text, "  sign: {sign}");
            }
            if !sensor.unused.is_empty() {
                let names: Vec<String> =
                    sensor.unused.iter().map(|name| show::name(name)).collect();
                let _ = writeln!(text, "  not read: {}", names.join(", "));
            }
        }
        match self.one_clock() {
            Some(true) => text.push_str("clock: one for both sensors\n"),
            Some(false) => text.push_str("clock: each sensor has its own stamps\n"),
            None => {}
        }
        match self.temperature() {
            Some([low, high]) => {
                let _ = writeln!(text, "temperature: {low:.2} to {high:.2} °C");
            }
            None => text.push_str("temperature: none\n"),
        }
        if let Some(field) = &self.recording.magnetometer {
            let _ = writeln!(
                text,
                "magnetometer: {} readings at {:.2} Hz in {} from {}, kept as they are",
                field.stream.len(),
                Clock::of(&field.stream).map_or(0.0, |clock| clock.rate),
                field
                    .unit
                    .map_or("a unit that is not stated", FieldUnit::name),
                show::name(&field.source)
            );
        }
        match self.rests() {
            Some((count, length)) => {
                let _ = writeln!(text, "static intervals: {count}, {length:.1} s in all");
            }
            None if self.recording.is_magnetometer_only() => {}
            None => text.push_str("static intervals: none found\n"),
        }
        for remark in &self.remarks {
            let _ = writeln!(text, "note: {remark}");
        }
        let _ = writeln!(text, "\n{}", to_calibrate(&self.command));
        text
    }

    /// The sensors with their clocks.
    fn sensors(&self) -> comfy_table::Table {
        let mut table = show::table(&[
            "sensor",
            "unit",
            "rows",
            "for s",
            "rate Hz",
            "jitter ms",
            "gaps",
        ]);
        let names = Sensor::ALL.iter().map(|sensor| sensor.name());
        show::keep_names_whole(&mut table, names);
        for sensor in &self.recording.description.sensors {
            let Some(clock) = self.recording.stream(sensor.sensor).and_then(Clock::of) else {
                continue;
            };
            table.add_row(clock.row(sensor.sensor.name(), sensor.unit));
        }
        if let Some(field) = &self.recording.magnetometer
            && let Some(clock) = Clock::of(&field.stream)
        {
            let unit = field.unit.map_or("not stated", FieldUnit::name);
            table.add_row(clock.row(Sensor::Magnetometer.name(), unit));
        }
        table
    }
}
