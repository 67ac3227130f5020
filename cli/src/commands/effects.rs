//! `effects`: the catalogue.

use std::fmt::Write as _;
use std::path::PathBuf;

use calib::effect_file::catalogue_with;
use comfy_table::Table;
use sensor::{EffectRef, REFERENCE_TEMPERATURE, Sensor};
use serde_json::json;

use crate::commands::shared::inputs::own_effects;
use crate::exit::Failure;
use crate::show;

/// Lists every effect with its equation, parameters and units.
///
/// `A`, `W` are the raw readings, `f` the true specific force, `w` the true rate, `t` time and `T`
/// temperature, `T0` the 25 °C at which scale factors and biases are stated; one coefficient per
/// axis unless the parameters say otherwise.
#[derive(Debug, clap::Args)]
#[command(after_help = "\
Example:
  stillpoint effects
  stillpoint calibrate phone.csv --effects gyro_g_sensitivity")]
pub struct Args {
    /// Print JSON instead of a table
    #[arg(long)]
    json: bool,
    /// File that defines further effects as expressions (TOML)
    #[arg(long, value_name = "FILE.toml")]
    effect_file: Vec<PathBuf>,
}

/// Runs the command.
pub fn run(args: &Args) -> Result<(), Failure> {
    let own = own_effects(&args.effect_file)?;
    if args.json {
        let effects: Vec<_> = catalogue_with(&own)
            .map(|effect| {
                let parameters: Vec<_> = effect
                    .params()
                    .iter()
                    .map(|p| json!({"name": p.name, "unit": p.unit, "nominal": p.nominal}))
                    .collect();
                json!({
                    "name": effect.name(),
                    "sensor": effect.sensor().name(),
                    "equation": effect.equation(),
                    "parameters": parameters,
                })
            })
            .collect();
        return show::print(&show::json(&effects)?);
    }
    let mut text = String::new();
    for sensor in Sensor::ALL {
        let effects = catalogue_with(&own).filter(|effect| effect.sensor() == sensor);
        let name = show::capital(sensor.name());
        let _ = writeln!(text, "{name}\n{}\n", table(&effects.collect::<Vec<_>>()));
    }
    show::print(&format!(
        "{text}T0 is {REFERENCE_TEMPERATURE} °C: scale factors and biases are stated for that temperature."
    ))
}

/// The effects of a sensor.
fn table(effects: &[EffectRef]) -> Table {
    let mut table = show::texts(&["effect", "equation", "parameters"]);
    show::keep_names_whole(&mut table, effects.iter().map(|effect| effect.name()));
    for effect in effects {
        let cells = [
            effect.name().to_owned(),
            effect.equation(),
            parameters(effect.params()),
        ];
        table.add_row(cells);
    }
    table
}

/// `x y z (m/s^2), tau (s)`: neighbours of one unit together.
fn parameters(params: &[sensor::Param]) -> String {
    params
        .chunk_by(|a, b| a.unit == b.unit)
        .map(|group| {
            let names: Vec<&str> = group.iter().map(|p| &*p.name).collect();
            let unit = group.first().map_or("", |p| &*p.unit);
            match unit {
                "" => names.join(" "),
                unit => format!("{} ({unit})", names.join(" ")),
            }
        })
        .collect::<Vec<_>>()
        .join(", ")
}
