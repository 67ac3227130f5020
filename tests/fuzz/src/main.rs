//! One binary for all targets: the environment variable `TARGET` names the one to run.
#![no_main]

use std::sync::OnceLock;

use libfuzzer_sys::fuzz_target;
use stillpoint_tests::fuzz::{TARGETS, Target};

static TARGET: OnceLock<Target> = OnceLock::new();

fn named() -> Target {
    let name = std::env::var("TARGET").unwrap_or_default();
    let found = TARGETS.into_iter().find(|(known, _)| *known == name);
    found.unwrap_or_else(|| {
        let known: Vec<_> = TARGETS.iter().map(|(name, _)| *name).collect();
        panic!("TARGET={name}: one of {} expected", known.join(", "))
    })
}

fuzz_target!(|bytes: &[u8]| {
    let (_, run) = TARGET.get_or_init(named);
    run(bytes);
});
