//! Ctrl-C: the half-written file goes, the old one stays, exit 130.

use std::path::PathBuf;
use std::sync::{Mutex, PoisonError};

use crate::exit::INTERRUPTED;

static PARTIAL_FILES: Mutex<Vec<PathBuf>> = Mutex::new(Vec::new());

/// Catches the interrupt signal. Where that cannot be done the system's own handling stays.
pub fn install() {
    let_writes_fail();
    let _ = ctrlc::set_handler(|| {
        for path in partial_files().drain(..) {
            let _ = std::fs::remove_file(path);
        }
        eprintln!("stillpoint: interrupted");
        std::process::exit(i32::from(INTERRUPTED));
    });
}

/// Beyond a limit on the size of files a write fails, as on a full disk, instead of ending the process with what it
/// has half written.
#[cfg(unix)]
fn let_writes_fail() {
    let seen = std::sync::Arc::default();
    let _ = signal_hook::flag::register(signal_hook::consts::SIGXFSZ, seen);
}

#[cfg(not(unix))]
fn let_writes_fail() {}

/// Remembers a file to remove on an interrupt.
pub fn remember(path: PathBuf) {
    partial_files().push(path);
}

/// Forgets it: it is removed or in its place.
pub fn forget(path: &std::path::Path) {
    partial_files().retain(|p| p != path);
}

fn partial_files() -> std::sync::MutexGuard<'static, Vec<PathBuf>> {
    PARTIAL_FILES.lock().unwrap_or_else(PoisonError::into_inner)
}
