//! What the fuzzers of the readers of files kept, run again with the readers of tables that release builds have. The workspace's
//! replay refuses those.
#![cfg(feature = "tables")]
#![allow(clippy::unwrap_used, clippy::expect_used, clippy::panic)]

extern crate stillpoint_formats as file_formats;

#[path = "../../../tests/src/fuzz/files.rs"]
mod files;

use std::path::Path;
use std::time::{Duration, Instant};

use files::FILES;

/// Of one input; a hang is what is looked for, not slowness.
const PATIENCE: Duration = Duration::from_secs(10);

#[test]
fn every_input_of_the_corpus_is_read_soundly_or_refused() {
    let corpus = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../tests/corpus");
    for (name, run) in FILES {
        let mut inputs = 0;
        for entry in std::fs::read_dir(corpus.join(name)).unwrap() {
            let path = entry.unwrap().path();
            let began = Instant::now();
            run(&std::fs::read(&path).unwrap());
            assert!(began.elapsed() < PATIENCE, "{}", path.display());
            inputs += 1;
        }
        assert!(inputs > 0, "no corpus for {name}");
    }
}
