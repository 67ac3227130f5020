//! Recordings that tests need and a clone lacks.

use std::io::Write;
use std::path::PathBuf;
use std::sync::atomic::{AtomicUsize, Ordering};

/// Tests of this process that were skipped.
static SKIPPED: AtomicUsize = AtomicUsize::new(0);

/// The folder of recordings: `$STILLPOINT_DATA`, by default `../shared/data` beside the workspace.
pub fn data_folder() -> PathBuf {
    std::env::var_os("STILLPOINT_DATA").map_or_else(
        || PathBuf::from(env!("CARGO_MANIFEST_DIR")).join("../../shared/data"),
        PathBuf::from,
    )
}

/// `part` of [`data_folder`].
///
/// Where it is missing the calling test is to end: that it was skipped is said on standard error, uncaptured and
/// counted. With `STILLPOINT_REQUIRE_DATA=1` (as in `.ci/run`) it fails instead.
///
/// # Panics
/// Where the recordings are required and missing.
#[allow(clippy::panic)]
pub fn needed(part: &str) -> Option<PathBuf> {
    let path = data_folder().join(part);
    if path.exists() {
        return Some(path);
    }
    let required = std::env::var_os("STILLPOINT_REQUIRE_DATA").is_some_and(|value| value != "0");
    if required {
        panic!(
            "{} is missing: name the folder of the recordings in STILLPOINT_DATA, or unset STILLPOINT_REQUIRE_DATA to \
             skip the tests that need them",
            path.display()
        );
    }
    skipped(&format!("no {}", path.display()));
    None
}

/// Says on standard error that the calling test is skipped, and why. The test is to end then.
pub fn skipped(why: &str) {
    let count = SKIPPED.fetch_add(1, Ordering::Relaxed) + 1;
    let thread = std::thread::current();
    let test = thread.name().unwrap_or("a test");
    // Not by `eprintln!`: the output of a test that passes is captured.
    let _ = writeln!(
        std::io::stderr(),
        "skipped: {test}: {why} ({count} skipped in this file so far)"
    );
}
