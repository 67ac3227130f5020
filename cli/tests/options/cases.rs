//! A call for each option, on an input on which it matters.

/// Options of one procedure of `reckon`; how a recording is read is looked at in the other alone, for the published one takes the
/// accelerometer at a rate that it assumes.
const IN_BOTH: [&str; 11] = [
    "--mode",
    "--ending",
    "--motion",
    "--distance",
    "--level",
    "--vertical",
    "--gravity",
    "--high-pass",
    "--low-pass",
    "--assumed-rate",
    "--picked-by",
];

/// What the calls of a command are made of: `REC` is the recording, `OUT` a name that is not there yet.
pub fn bases(command: &str, option: &str) -> Vec<&'static str> {
    match command {
        "demo" => vec!["demo"],
        "info" => vec!["info REC"],
        "calibrate" => vec![
            "calibrate REC --json",
            "calibrate REC --json --method stepwise",
            "calibrate REC --json --method six-position",
        ],
        "batch" => vec!["batch REC.d -o OUT", "batch REC.d -o OUT --discover"],
        "batch merge" => vec!["batch merge parts -o OUT"],
        "batch prior" => vec!["batch prior fleet -o OUT"],
        "live" => vec!["live - --out OUT --poll 0"],
        "segment" => vec!["segment REC --json"],
        "apply" => vec!["apply cal.json REC"],
        "convert" => vec!["convert REC -o OUT.csv"],
        "allan" => vec!["allan REC --json"],
        "bias" => vec!["bias cal.json REC --json"],
        "reckon" if IN_BOTH.contains(&option) => vec![
            "reckon REC --json --calibration c=cal.json",
            "reckon REC --json --calibration c=cal.json --procedure published",
        ],
        "reckon" => vec!["reckon REC --json --calibration c=cal.json"],
        "evaluate" => vec!["evaluate REC --json --calibration c=cal.json"],
        "simulate" => vec!["simulate spec.toml -o OUT"],
        "discover" => vec!["discover REC --json"],
        "effects" => vec!["effects"],
        "plan" => vec!["plan --json", "plan cal.json --json", "plan REC --json"],
        "export" => vec![
            "export cal.json --to px4 -o OUT",
            "export cal.json --to ardupilot -o OUT",
            "export cal.json --to kalibr -o OUT",
            "export cal.json --to c -o OUT",
        ],
        "import" => vec!["import imu.yaml -o OUT"],
        "page" => vec!["page -o OUT"],
        "generate" => vec!["generate --completions bash"],
        _ => Vec::new(),
    }
}

/// The recording that a command is called with where an option needs no other.
pub fn recording(command: &str) -> &'static str {
    match command {
        "allan" => "still.csv",
        "reckon" => "push.csv",
        _ => "good.csv",
    }
}

/// The recording that a call is made with, and what is added to it; `None` for an option that no call is known for. What stands
/// before a bar is in the call without the option too.
pub fn case(command: &str, option: &str) -> Option<(&'static str, &'static str)> {
    let good = recording(command);
    let of_command = match (command, option) {
        ("calibrate" | "batch", "--effects") => "--effects gyro_g_sensitivity",
        ("calibrate" | "discover", "--effect-file") => "--effect-file own.toml",
        ("effects", "--effect-file") => "--effect-file own.toml",
        ("calibrate", "--method") => "--method stepwise",
        ("batch", "--method") => "--method stepwise",
        ("calibrate", "--first-order") => return Some(("six.csv", "--first-order")),
        ("calibrate" | "batch", "--prior") => "--prior prior.json",
        ("calibrate", "--gyro-recording") => "--gyro-recording good2.csv",
        ("calibrate", "--frame") => "--frame symmetric",
        ("calibrate", "--sensor") => "--sensor accelerometer",
        ("calibrate", "--integrator") => "--integrator first-order",
        ("calibrate", "--gyro-bias") => "--gyro-bias initial",
        ("calibrate", "--nominal-rate") => "--nominal-rate 101",
        ("calibrate" | "batch" | "discover", "--clock") => {
            return Some(("jitter.csv", "--clock even"));
        }
        ("calibrate", "--field") => return Some(("field.csv", "--field 48")),
        ("calibrate", "--sections") => "--sections sections.csv",
        ("calibrate" | "discover", "--leave-out") => "--leave-out 10",
        ("calibrate", "--static-means") => "--static-means means.csv",
        ("calibrate", "--accel-file" | "--gyro-file") => {
            "--accel-file acc.txt --gyro-file gyro.txt"
        }
        ("discover", "--accel-file" | "--gyro-file") => "--accel-file acc.txt --gyro-file gyro.txt",
        ("calibrate", "--force-device") => "other.csv | --force-device",
        ("discover", "--force-device") => "other.csv | --force-device",
        ("apply" | "bias" | "evaluate" | "reckon", "--force-device") => {
            return Some(("sign.csv", "--force-device"));
        }
        ("batch", "--shard") => "--shard 2/2",
        ("batch", "--budget") => "--budget 0.000001",
        ("batch", "--discover") => "--discover",
        ("batch", "--jobs") => "--jobs 1",
        ("batch", "--resume") => "--resume",
        ("batch merge", "--jsonl") => "--csv | --jsonl",
        ("batch merge", "--csv") => "--csv",
        ("batch merge", "--report") => "--report",
        ("live", "--web") => "--web",
        ("live", "--placements") => "--placements 9",
        ("live", "--hold") => "--hold 9",
        ("live", "--baud") => "--baud 9600",
        ("live", "--poll") => "--poll 0.001",
        ("live", "--events") => "--events EVENTS",
        ("allan", "--rest") => "--rest 0,70",
        ("bias", "--accelerometer") => "--accelerometer",
        ("bias", "--no-gyroscope") => "--accelerometer | --no-gyroscope",
        ("reckon" | "evaluate", "--calibration") => "--calibration other=cal2.json",
        ("reckon", "--mode") => "--mode level",
        ("reckon", "--ending") => "--ending free",
        ("reckon", "--motion") => "--motion 4,7",
        ("reckon", "--displacement") => "--displacement 1,0,0",
        ("reckon", "--distance") => "--distance 1",
        ("reckon", "--procedure") => "--procedure published",
        ("reckon", "--level") => "--level 0.1",
        ("reckon", "--vertical") => "--vertical x",
        ("reckon", "--gravity") => "--gravity 9.7",
        ("reckon", "--high-pass") => "--high-pass 0.1",
        ("reckon", "--low-pass") => "--low-pass 1",
        ("reckon", "--assumed-rate") => "--assumed-rate 50",
        ("reckon", "--picked-by") => "--picked-by c",
        ("simulate", "--example") => "--example",
        ("discover", "--validation") => "--validation good2.csv",
        ("discover", "--alpha") => return Some(("effect.csv", "--alpha 1e-60")),
        ("discover", "--noise") => "--noise noise.json",
        ("discover", "--flicker") => "--flicker",
        ("discover", "--units") => "good2.csv | --units",
        ("discover", "--emit-effect") => "--emit-effect OUT.rs",
        ("plan", "--placements") => "--placements 9",
        ("plan", "--next") => "--next 7",
        ("plan", "--protocol") => "--protocol imu_tk",
        ("plan", "--criterion") => "--criterion volume",
        ("plan", "--accelerometer-only") => "--accelerometer-only",
        ("plan", "--temperature") => "--temperature",
        ("plan", "--axes") => "--axes",
        ("plan", "--rest") => "--rest 9",
        ("plan", "--speed") => "--speed 30",
        ("plan", "--misfit") => "--misfit 3",
        ("export", "--to") => "--to toml",
        ("export", "--noise") => "--noise noise.json",
        ("export", "--instance") => "--instance 1",
        ("export", "--logged-with") => "--logged-with all.params",
        ("import", "--from") => "--from imu_tk",
        ("generate", "--completions") => "--completions zsh",
        ("generate", "--man") => "--man OUT",
        ("generate", "--options") => "--options",
        _ => "",
    };
    if !of_command.is_empty() {
        return Some((good, of_command));
    }
    Some(match option {
        "-o" => (good, "-o RESULT"),
        "--out" => (good, "--out RESULT"),
        "--report" => (good, "--report RESULT.html"),
        "--plots" => (good, "--plots RESULT"),
        "--json" => (good, "--json"),
        "--force" => (good, "--force"),
        "--skip-existing" => (good, "--skip-existing"),
        "--quiet" => (good, "--quiet"),
        "--verbose" => (good, "--verbose"),
        "--color" => (good, "--color always"),
        "--limits" => (good, "--limits limits.toml"),
        "--gravity" => (good, "--gravity 9.78"),
        "--latitude" => (good, "--latitude 10"),
        "--altitude" => (good, "--latitude 10 | --altitude 3000"),
        "--multiplier" => (good, "--multiplier 0.5"),
        "--min-static" => (good, "--min-static 30"),
        "--min-dynamic" => (good, "--min-dynamic 30"),
        "--window" => (good, "--window 2"),
        "--initial-static" => (good, "--initial-static 9"),
        "--format" => ("short.csv", "--format ulog"),
        "--entry" => ("several", "--entry a.csv"),
        "--topic" => ("log.ulg", "--topic none"),
        "--part" => ("parts.csv", "--part 2"),
        "--mag-unit" => ("field.csv", "--mag-unit G"),
        "--instance" => ("log.ulg", "--instance 3"),
        "--columns" => ("odd.csv", "--columns t=1,ax=2,ay=3,az=4,gx=5,gy=6,gz=7"),
        "--skip-bad-rows" => ("broken.csv", "--skip-bad-rows 1"),
        "--na" => ("empty.csv", "--na drop"),
        "--sort-time" => ("back.csv", "--sort-time"),
        "--rate" => ("timeless.csv", "--rate 100"),
        "--time-unit" => ("ticks.csv", "--time-unit us"),
        "--time-format" => ("dates.csv", "--time-format %d.%m.%YT%H:%M:%S%.f"),
        "--accel-unit" => (good, "--accel-unit g"),
        "--gyro-unit" => (good, "--gyro-unit deg/s"),
        "--flip" => (good, "--flip ax"),
        "--max-rows" => ("short.csv", "--max-rows 10"),
        "--max-bytes" => ("short.csv", "--max-bytes 100"),
        _ => return None,
    })
}
