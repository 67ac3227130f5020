//! Running the program as a person or a script would.

use std::io::Write as _;
use std::path::{Path, PathBuf};
use std::process::{Command, Output, Stdio};

use calib::recording::to_csv;
use calib::simulate::{HandHeld, Motion, Spec};

/// Runs `stillpoint` in a folder, with nothing on its standard input.
pub fn stillpoint(folder: &Path, args: &[&str]) -> Output {
    Command::new(env!("CARGO_BIN_EXE_stillpoint"))
        .current_dir(folder)
        .args(args)
        .stdin(Stdio::null())
        .output()
        .unwrap()
}

/// What it said to a person.
pub fn stderr(output: &Output) -> String {
    String::from_utf8_lossy(&output.stderr).into_owned()
}

/// What it printed.
pub fn stdout(output: &Output) -> String {
    String::from_utf8_lossy(&output.stdout).into_owned()
}

/// The one document that it printed.
pub fn json(output: &Output) -> serde_json::Value {
    serde_json::from_slice(&output.stdout).unwrap()
}

/// A folder with `good.csv`, a simulated session of 14 placements.
pub fn folder() -> (tempfile::TempDir, PathBuf) {
    let dir = tempfile::tempdir().unwrap();
    let mut spec = Spec::hand_held(11);
    let motion = HandHeld {
        placements: Some(14),
        initial_rest: Some(20.0),
        ..HandHeld::default()
    };
    spec.motion = Motion::HandHeld(motion);
    let path = dir.path().to_owned();
    let mut session = spec.run().unwrap();
    std::fs::write(path.join("good.csv"), to_csv(&mut session.recording)).unwrap();
    (dir, path)
}

/// The names in a folder, in order.
pub fn files(folder: &Path) -> Vec<String> {
    let entries = std::fs::read_dir(folder).unwrap();
    let names = entries.map(|entry| entry.unwrap().file_name().into_string().unwrap());
    let mut names: Vec<String> = names.collect();
    names.sort();
    names
}

/// The exit status.
pub fn status(output: &Output) -> i32 {
    output.status.code().unwrap()
}

/// A browser to look at pages with. Without one the test is skipped, which is said uncaptured.
pub fn chromium() -> Option<&'static str> {
    let answers = |name: &&str| {
        let mut version = Command::new(name);
        version
            .arg("--version")
            .stdout(Stdio::null())
            .stderr(Stdio::null());
        version.status().is_ok_and(|status| status.success())
    };
    let names = ["chromium", "chromium-browser", "google-chrome"];
    let found = names.into_iter().find(answers);
    if found.is_none() {
        let current = std::thread::current();
        let test = current.name().unwrap_or("a test");
        // Whoever captures standard error still has the test's result.
        let _ = writeln!(std::io::stderr(), "skipped: {test}: no chromium");
    }
    found
}

/// The document that a browser makes of an address after its scripts have run, and what it logs.
pub fn browsed(chromium: &str, address: &str) -> [String; 2] {
    let browser = Command::new(chromium)
        .args([
            "--headless",
            "--no-sandbox",
            "--disable-gpu",
            "--enable-logging=stderr",
            "--virtual-time-budget=4000",
            "--dump-dom",
            address,
        ])
        .output()
        .unwrap();
    [browser.stdout, browser.stderr].map(|bytes| String::from_utf8_lossy(&bytes).into_owned())
}
