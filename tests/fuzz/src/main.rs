//! One binary for the targets of texts, one for those of files: the environment variable `TARGET` names the one to run.
#![no_main]

use std::collections::BTreeSet;
use std::panic::{set_hook, take_hook};
use std::sync::atomic::{AtomicUsize, Ordering};
use std::sync::{Mutex, OnceLock};

use libfuzzer_sys::fuzz_target;
use peak_alloc::PeakAlloc;
#[cfg(feature = "texts")]
use stillpoint_tests::fuzz::{Target, targets};

#[cfg(not(feature = "texts"))]
#[path = "../../src/fuzz/files.rs"]
mod files;
#[cfg(not(feature = "texts"))]
use files::{FILES, Target};

#[cfg(not(feature = "texts"))]
fn targets() -> impl Iterator<Item = Target> {
    FILES.into_iter()
}

/// Counts what an execution takes, also where it was only asked for.
#[global_allocator]
static MEMORY: PeakAlloc = PeakAlloc;

/// Bytes that an execution may take.
const MOST: usize = 200_000_000;

static TARGET: OnceLock<Target> = OnceLock::new();
/// The most that an execution took, MB.
static LARGEST: AtomicUsize = AtomicUsize::new(0);
/// Where parsers of other projects panicked.
static PANICS: Mutex<BTreeSet<String>> = Mutex::new(BTreeSet::new());

fn named() -> Target {
    let name = std::env::var("TARGET").unwrap_or_default();
    let found = targets().find(|(known, _)| *known == name);
    pass_panics_of_others();
    found.unwrap_or_else(|| {
        let known: Vec<_> = targets().map(|(name, _)| name).collect();
        panic!("TARGET={name}: one of {} expected", known.join(", "))
    })
}

/// Readers of tables catch the panics of other projects' parsers; the fuzzer's hook would end at them. One that nobody
/// catches ends the fuzzer all the same.
fn pass_panics_of_others() {
    let ours = take_hook();
    set_hook(Box::new(move |panic| {
        let place = panic.location().map(ToString::to_string).unwrap_or_default();
        if !place.contains("/registry/src/") && !place.contains("/library/") {
            return ours(panic);
        }
        if PANICS.lock().is_ok_and(|mut panics| panics.insert(place.clone())) {
            eprintln!("caught: {place}");
        }
    }));
}

fuzz_target!(|bytes: &[u8]| {
    let (_, run) = TARGET.get_or_init(named);
    MEMORY.reset_peak_usage();
    let before = MEMORY.current_usage();
    run(bytes);
    let taken = MEMORY.peak_usage().saturating_sub(before);
    let megabytes = taken / 1_000_000;
    if LARGEST.fetch_max(megabytes, Ordering::Relaxed) < megabytes {
        eprintln!("memory: {megabytes} MB");
    }
    assert!(taken <= MOST, "{megabytes} MB of memory");
});
