//! Steps of long work as lines on standard error, for a program that runs this one, such as the page in a browser.

use std::io::Write;
use std::ops::ControlFlow;
use std::sync::Mutex;
use std::time::{Duration, Instant};

use calib::watch::{Progress, Watch};

/// Asks for the lines where it is set.
const ASKED: &str = "STILLPOINT_PROGRESS";
/// The beginning of a line: a character that no other line has, so that the reader can take them out.
const MARK: &str = "\u{1e}progress";
/// Shortest time between two lines.
const PAUSE: Duration = Duration::from_millis(50);

/// A watch that prints the steps of a command if the environment asks for it: `\u{1e}progress fitting 34`.
pub fn watch() -> Watch {
    if std::env::var_os(ASKED).is_none() {
        return Watch::default();
    }
    let last: Mutex<Option<Instant>> = Mutex::new(None);
    Watch::new(move |progress: Progress| {
        if let Ok(mut last) = last.lock()
            && last.is_none_or(|last| last.elapsed() >= PAUSE)
        {
            *last = Some(Instant::now());
            let (stage, steps) = (progress.stage.name(), progress.steps);
            let _ = writeln!(std::io::stderr(), "{MARK} {stage} {steps}");
        }
        ControlFlow::Continue(())
    })
}
