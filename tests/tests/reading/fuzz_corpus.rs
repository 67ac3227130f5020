//! What the fuzzers found worth keeping, run again: nothing panics, nothing takes long.

use std::path::Path;
use std::time::{Duration, Instant};

use stillpoint_tests::fuzz::targets;

/// Of one input; a hang is what is looked for, not slowness.
const PATIENCE: Duration = Duration::from_secs(10);

#[test]
fn every_input_of_the_corpus_is_read_soundly_or_refused() {
    for (name, run) in targets() {
        let folder = Path::new(env!("CARGO_MANIFEST_DIR"))
            .join("corpus")
            .join(name);
        let mut inputs = 0;
        for entry in std::fs::read_dir(&folder).unwrap() {
            let path = entry.unwrap().path();
            let began = Instant::now();
            run(&std::fs::read(&path).unwrap());
            assert!(began.elapsed() < PATIENCE, "{}", path.display());
            inputs += 1;
        }
        assert!(inputs > 0, "no corpus for {name}");
    }
}
