//! The page of the tuning constants states what the sources state.

use stillpoint_tests::tuning::{constants, rows_of, written_again};

use super::root;

#[test]
fn the_manual_lists_every_tuning_constant_with_its_value() {
    let all = constants(root()).unwrap();
    assert!(all.len() > 400, "{}", all.len());
    let file = root().join("cli/manual/tuning.md");
    let mut page = std::fs::read_to_string(&file).unwrap();
    if std::env::var_os("STILLPOINT_WRITE").is_some() {
        page = written_again(&all, &page);
        std::fs::write(&file, &page).unwrap();
    }
    let listed: Vec<_> = rows_of(&page)
        .into_iter()
        .map(|row| (row.place, row.value))
        .collect();
    let stated = all
        .iter()
        .map(|c| ((c.file.clone(), c.name.clone()), c.value.clone()));
    for (listed, stated) in listed.iter().zip(stated.clone()) {
        assert_eq!(
            *listed, stated,
            "write the page again: STILLPOINT_WRITE=1 cargo test --workspace --test house"
        );
    }
    assert_eq!(listed.len(), all.len());
}

#[test]
fn every_tuning_constant_has_a_meaning() {
    let all = constants(root()).unwrap();
    let silent = all.into_iter().find(|constant| constant.meaning.is_empty());
    assert_eq!(silent, None);
}
