//! Interrupts: what is half written goes, what had been there stays, exit 130.

use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::{Arc, OnceLock};
use std::time::{Duration, Instant};

#[cfg(any(unix, windows))]
use crate::exit::{Failure, INTERRUPTED};
#[cfg(any(unix, windows))]
use crate::show;

/// Catches what asks the process to end. Where that cannot be done the system's own handling stays.
pub fn install() {
    system::install();
}

/// Flag set by a signal that is about to call [`end`].
static ASKED: OnceLock<Arc<AtomicBool>> = OnceLock::new();

/// Waits for a pending interrupt to end the process, so that a failure caused by the interrupt is not reported.
pub fn give_way() {
    let asked = || {
        ASKED
            .get()
            .is_some_and(|asked| asked.load(Ordering::SeqCst))
    };
    let begin = Instant::now();
    while asked() && begin.elapsed() < Duration::from_secs(5) {
        std::thread::sleep(Duration::from_millis(5));
    }
}

#[cfg(any(unix, windows))]
fn end() -> ! {
    // Held until the end: nothing is made any more.
    let mut leftovers = output::leftovers();
    leftovers.remove();
    show::failure(&Failure::new(INTERRUPTED, "interrupted"));
    std::process::exit(i32::from(INTERRUPTED));
}

#[cfg(unix)]
mod system {
    use std::sync::atomic::{AtomicBool, Ordering};
    use std::sync::{Arc, mpsc};
    use std::thread;

    use signal_hook::consts::{SIGABRT, SIGHUP, SIGINT, SIGTERM, SIGXFSZ};
    use signal_hook::flag;
    use signal_hook::iterator::Signals;

    pub fn install() {
        // Beyond a limit on the size of files a write fails, as on a full disk.
        let _ = flag::register(SIGXFSZ, Arc::default());
        end_without_memory();
        let (installed, ready) = mpsc::channel();
        let wait = move || {
            let wanted = [SIGINT, SIGTERM, SIGHUP]
                .into_iter()
                .filter(|s| !is_ignored(*s));
            let wanted: Vec<i32> = wanted.collect();
            let asked = super::ASKED.get_or_init(Arc::default);
            let signals = Signals::new(&wanted);
            for signal in wanted.iter().filter(|_| signals.is_ok()) {
                let _ = flag::register(*signal, Arc::clone(asked));
            }
            let _ = installed.send(());
            if let Ok(mut signals) = signals
                && signals.forever().next().is_some()
            {
                super::end();
            }
        };
        let thread = thread::Builder::new().name("interrupt".into());
        if thread.stack_size(256 << 10).spawn(wait).is_ok() {
            let _ = ready.recv();
        }
    }

    /// An allocation that fails aborts the process once it has said so. Under a limit of memory that is the fault of too
    /// large an input, and the status says so; after a panic an abort stays one.
    fn end_without_memory() {
        let starved = Arc::new(AtomicBool::new(true));
        let status = i32::from(crate::exit::INPUT);
        let ends = flag::register_conditional_shutdown(SIGABRT, status, Arc::clone(&starved));
        if ends.is_ok() {
            let usual = std::panic::take_hook();
            std::panic::set_hook(Box::new(move |panic| {
                if is_of_memory(panic) {
                    eprintln!(
                        "stillpoint: not enough memory for another thread; raise the limit (ulimit -v)"
                    );
                    return;
                }
                // The message of the damaged file follows.
                if calib::recording::formats::catches_panics() {
                    return;
                }
                starved.store(false, Ordering::SeqCst);
                usual(panic);
            }));
        }
    }

    /// Returns true if the system refused memory to a thread at its start, which panics instead of returning an error.
    fn is_of_memory(panic: &std::panic::PanicHookInfo<'_>) -> bool {
        let payload = panic.payload();
        let text = payload.downcast_ref::<String>().map(String::as_str);
        let text = text.or_else(|| payload.downcast_ref::<&str>().copied());
        text.is_some_and(|text| text.contains("failed to allocate"))
    }

    /// Returns true if the process was started with the signal ignored, as `nohup` does.
    fn is_ignored(signal: i32) -> bool {
        let status = std::fs::read_to_string("/proc/self/status").unwrap_or_default();
        let mask = status.lines().find_map(|line| line.strip_prefix("SigIgn:"));
        let mask = mask.and_then(|mask| u64::from_str_radix(mask.trim(), 16).ok());
        mask.is_some_and(|mask| mask >> (signal - 1) & 1 == 1)
    }
}

#[cfg(windows)]
mod system {
    pub fn install() {
        let _ = ctrlc::set_handler(|| super::end());
    }
}

/// Nothing asks a program of WebAssembly to end: its host ends it.
#[cfg(not(any(unix, windows)))]
mod system {
    pub fn install() {}
}
