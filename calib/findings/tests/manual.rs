//! The manual's chapter of findings against the kinds that there are.
#![allow(clippy::unwrap_used, clippy::expect_used, clippy::panic)]

use std::path::Path;

/// With the variable `STILLPOINT_WRITE` set the table is written anew.
#[test]
fn the_chapter_of_findings_has_the_table_of_all_kinds() {
    let chapter = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../cli/manual/findings.md");
    let text = std::fs::read_to_string(&chapter).unwrap();
    let (before, table) = text.split_at(text.find("| kind |").unwrap());
    if std::env::var_os("STILLPOINT_WRITE").is_some() {
        std::fs::write(
            &chapter,
            before.to_owned() + &stillpoint_findings::manual_table(),
        )
        .unwrap();
        return;
    }
    assert!(
        table == stillpoint_findings::manual_table(),
        "write the table anew: STILLPOINT_WRITE=1 cargo test -p stillpoint-findings --test manual"
    );
}
