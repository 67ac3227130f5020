//! Faults while files are written: a run that is killed, interrupted or may not write leaves what was there, or all of
//! what is new, and the next run leaves nothing else.

use std::collections::BTreeMap;
use std::path::{Path, PathBuf};
use std::process::{Command, Stdio};
use std::time::{Duration, Instant};

/// What stands in every output before a run.
const OLD: &[u8] = b"what was there before";

/// Commands with outputs, quick ones first; they all find `r.csv`, `cal.json`, `spec.toml`, `devices.csv` and a batch in `done`.
const COMMANDS: [&[&str]; 19] = [
    &[
        "segment",
        "r.csv",
        "-o",
        "out/segments.json",
        "--report",
        "out/segments.html",
    ],
    &[
        "calibrate",
        "r.csv",
        "-o",
        "out/cal.json",
        "--report",
        "out/cal.html",
        "--plots",
        "out/plots",
    ],
    &["apply", "cal.json", "r.csv", "-o", "out/corrected.csv"],
    &["apply", "cal.json", "r.csv", "-o", "out/corrected"],
    &[
        "bias",
        "cal.json",
        "r.csv",
        "-o",
        "out/bias.json",
        "--no-gyroscope",
        "--accelerometer",
    ],
    &[
        "allan",
        "r.csv",
        "--rest",
        "0,19",
        "-o",
        "out/noise.json",
        "--plots",
        "out/allan",
    ],
    &["simulate", "spec.toml", "-o", "out/simulated"],
    &["convert", "r.csv", "-o", "out/plain"],
    &["convert", "r.csv", "-o", "out/plain.csv"],
    &["plan", "-o", "out/plan.json", "--report", "out/plan.html"],
    &["export", "cal.json", "--to", "px4", "-o", "out/imu.params"],
    &["export", "cal.json", "--to", "imu_tk", "-o", "out/imu_tk"],
    &["generate", "--man", "out/man"],
    &[
        "evaluate",
        "r.csv",
        "--calibration",
        "mine=cal.json",
        "--report",
        "out/evaluation.html",
    ],
    &["batch", "devices.csv", "-o", "out/batch"],
    &[
        "batch", "merge", "done", "-o", "out/all", "--jsonl", "--csv", "--report",
    ],
    &[
        "reckon",
        "r.csv",
        "--motion",
        "21,24",
        "-o",
        "out/reckon.json",
        "--report",
        "out/reckon.html",
    ],
    &[
        "discover",
        "r.csv",
        "-o",
        "out/findings.json",
        "--report",
        "out/findings.html",
    ],
    &["demo", "--out", "out/demo"],
];

/// Signals, those after the first caught.
const SIGNALS: [&str; 4] = ["-KILL", "-TERM", "-HUP", "-INT"];

type Files = BTreeMap<PathBuf, Vec<u8>>;

/// A folder to work in and the program.
#[derive(Debug)]
pub struct Faults {
    program: PathBuf,
    folder: PathBuf,
    state: u64,
}

/// What was tried.
#[derive(Clone, Copy, Debug, Default)]
pub struct Tried {
    /// Runs that a signal was sent to.
    pub signals: usize,
    /// Of them those that it ended.
    pub ended: usize,
    /// Runs under a limit on file sizes.
    pub limited: usize,
}

impl Faults {
    /// `folder` is empty; it gets a recording, its calibration and a spec.
    ///
    /// # Errors
    /// What went wrong on the way.
    pub fn new(program: &Path, folder: &Path, seed: u64) -> Result<Self, String> {
        let faults = Self {
            program: program.to_owned(),
            folder: folder.to_owned(),
            state: seed.max(1),
        };
        let spec = "seed = 3\n[motion.hand_held]\nplacements = 14\ninitial_rest = 20.0\n";
        std::fs::write(folder.join("spec.toml"), spec).map_err(said)?;
        let devices = "id,inputs\nd,r.csv\n";
        std::fs::write(folder.join("devices.csv"), devices).map_err(said)?;
        for args in [
            &["simulate", "spec.toml", "-o", "session"][..],
            &["calibrate", "session", "-o", "cal.json"],
            &[
                "apply",
                "cal.json",
                "session",
                "-o",
                "r.csv",
                "--force-device",
            ],
            &["batch", "devices.csv", "-o", "done"],
        ] {
            let status = faults.command(args).status().map_err(said)?;
            // A device may fail a gate.
            if !matches!(status.code(), Some(0 | 1)) {
                return Err(format!("{args:?} ended with {status}"));
            }
        }
        Ok(faults)
    }

    /// Sends `trials` signals at random times to each of the first `commands` commands, and limits the file sizes of as
    /// many runs.
    ///
    /// # Errors
    /// The first run that broke a promise.
    pub fn run(&mut self, commands: usize, trials: usize) -> Result<Tried, String> {
        let mut tried = Tried::default();
        for command in COMMANDS.iter().take(commands) {
            let args: Vec<&str> = command.iter().copied().chain(["--force"]).collect();
            self.clear()?;
            let begin = Instant::now();
            let status = self.command(&args).status().map_err(said)?;
            let time = begin.elapsed();
            let new = self.outputs()?;
            if new.is_empty() {
                return Err(format!("{args:?} wrote nothing and ended with {status}"));
            }
            for _ in 0..trials {
                let signal = SIGNALS[(self.random() * 4.0) as usize % 4];
                let after = time.mul_f64(1.1 * self.random());
                tried.signals += 1;
                tried.ended += usize::from(self.killed(&args, signal, after, &new)?);
                tried.limited += 1;
                self.limited(&args, &new)?;
            }
        }
        Ok(tried)
    }

    /// One run that `signal` ends, if it is not done before.
    fn killed(
        &mut self,
        args: &[&str],
        signal: &str,
        after: Duration,
        new: &Files,
    ) -> Result<bool, String> {
        let fault = |what: String| Err(format!("{args:?}, {signal} after {after:?}: {what}"));
        self.restore(new)?;
        let mut child = self.command(args).spawn().map_err(said)?;
        std::thread::sleep(after);
        let process = child.id().to_string();
        let sent = Command::new("kill")
            .args([signal, &process])
            .stderr(Stdio::null())
            .status();
        sent.map_err(said)?;
        let status = child.wait().map_err(said)?;
        if let Err(what) = self.check(new, signal == "-KILL") {
            return fault(what);
        }
        // The next run is clean whatever was left.
        self.command(args).status().map_err(said)?;
        if self.outputs()? != *new {
            return fault("the next run left something else than its outputs".to_owned());
        }
        Ok(!status.success())
    }

    /// One run whose files may not be longer than some of what it writes.
    fn limited(&mut self, args: &[&str], new: &Files) -> Result<(), String> {
        self.restore(new)?;
        let longest = new.values().map(Vec::len).max().unwrap_or(0);
        let blocks = (longest as f64 / 512.0 * self.random()) as usize;
        let script = format!("ulimit -f {blocks}; exec \"$0\" \"$@\"");
        let mut shell = Command::new("sh");
        shell
            .current_dir(&self.folder)
            .args(["-c", &script])
            .arg(&self.program)
            .args(args);
        shell
            .stdin(Stdio::null())
            .stdout(Stdio::null())
            .stderr(Stdio::null());
        let status = shell.status().map_err(said)?;
        let checked = self.check(new, false);
        checked.map_err(|what| format!("{args:?}, files of {blocks} blocks, {status}: {what}"))
    }

    /// Every output is as it was or as it is to be, and beside them is nothing.
    fn check(&self, new: &Files, partials: bool) -> Result<(), String> {
        let found = self.outputs()?;
        for path in new.keys() {
            match found.get(path) {
                None => return Err(format!("{} is gone", path.display())),
                Some(bytes) if bytes == OLD || Some(bytes) == new.get(path) => {}
                Some(bytes) => {
                    return Err(format!(
                        "{} is neither old nor new: {} bytes",
                        path.display(),
                        bytes.len()
                    ));
                }
            }
        }
        let left = found.keys().find(|path| {
            let partial = path.extension().is_some_and(|e| e == "partial");
            !(new.contains_key(*path) || partials && partial)
        });
        left.map_or(Ok(()), |path| Err(format!("{} is left", path.display())))
    }

    fn command(&self, args: &[&str]) -> Command {
        let mut command = Command::new(&self.program);
        command.current_dir(&self.folder).args(args);
        command
            .stdin(Stdio::null())
            .stdout(Stdio::null())
            .stderr(Stdio::null());
        command
    }

    fn clear(&self) -> Result<(), String> {
        let out = self.folder.join("out");
        if out.is_dir() {
            std::fs::remove_dir_all(&out).map_err(said)?;
        }
        std::fs::create_dir(&out).map_err(said)
    }

    /// The outputs as they were before the run.
    fn restore(&self, new: &Files) -> Result<(), String> {
        self.clear()?;
        for path in new.keys() {
            let folder = path.parent().unwrap_or(path);
            std::fs::create_dir_all(folder).map_err(said)?;
            std::fs::write(path, OLD).map_err(said)?;
        }
        Ok(())
    }

    /// Every file below `out`.
    fn outputs(&self) -> Result<Files, String> {
        let mut files = Files::new();
        let mut folders = vec![self.folder.join("out")];
        while let Some(folder) = folders.pop() {
            for entry in std::fs::read_dir(&folder).map_err(said)? {
                let path = entry.map_err(said)?.path();
                if path.is_dir() {
                    folders.push(path);
                } else if !is_timing(&path) {
                    files.insert(path.clone(), std::fs::read(&path).map_err(said)?);
                }
            }
        }
        Ok(files)
    }

    /// Evenly between 0 and 1: xorshift64, Marsaglia 2003, section 3.
    fn random(&mut self) -> f64 {
        self.state ^= self.state << 13;
        self.state ^= self.state >> 7;
        self.state ^= self.state << 17;
        (self.state >> 11) as f64 / (1u64 << 53) as f64
    }
}

/// Whether the file says how long a device took, which differs from run to run.
fn is_timing(path: &Path) -> bool {
    let name = path.file_name().map(|name| name.to_string_lossy());
    name.is_some_and(|name| name.starts_with("timings-") && name.ends_with(".jsonl"))
}

fn said(error: std::io::Error) -> String {
    error.to_string()
}
