//! A few faults while files are written; `stillpoint-tests --bin faults` tries hundreds.
#![cfg(unix)]

#[path = "../../tests/src/faults.rs"]
mod study;

#[test]
fn killed_interrupted_and_limited_runs_leave_no_half_file_and_nothing_else() {
    let folder = tempfile::tempdir().unwrap();
    let program = std::path::Path::new(env!("CARGO_BIN_EXE_stillpoint"));
    let mut faults = study::Faults::new(program, folder.path(), 7).unwrap();
    let tried = faults.run(17, 1).unwrap();
    assert_eq!(tried.signals, 17);
    assert!(tried.ended > 0 && tried.limited > 0);
}
