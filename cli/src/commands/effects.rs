//! `effects`: the catalogue.

use std::path::PathBuf;

use calib::effect_file::catalogue_with;
use sensor::REFERENCE_TEMPERATURE;
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
    let mut table = show::texts(&["effect", "sensor", "equation", "parameters"]);
    let all: Vec<_> = catalogue_with(&own).collect();
    show::keep_names_whole(&mut table, all.iter().map(|effect| effect.name()));
    for effect in all {
        table.add_row([
            effect.name().to_owned(),
            effect.sensor().name().to_owned(),
            effect.equation(),
            parameters(effect.params()),
        ]);
    }
    show::print(&format!(
        "{table}\n\nT0 is {REFERENCE_TEMPERATURE} °C: scale factors and biases are stated for that temperature."
    ))
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
