//! Suggestions for misspelled names.

/// `; did you mean …?` with the candidate that `name` is most likely a misspelling of, or nothing.
pub fn did_you_mean<'a>(name: &str, candidates: impl Iterator<Item = &'a str>) -> String {
    let distance = |c: &str| strsim::damerau_levenshtein(name, c);
    let nearest = candidates.map(|c| (distance(c), c)).min();
    match nearest {
        Some((d, candidate)) if d <= 1 + name.len() / 3 => format!("; did you mean `{candidate}`?"),
        _ => String::new(),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_misspelling_finds_its_word_and_nonsense_finds_none() {
        let words = ["rate", "gravity", "latitude"];
        assert_eq!(
            did_you_mean("rtae", words.into_iter()),
            "; did you mean `rate`?"
        );
        assert_eq!(did_you_mean("zzzzzz", words.into_iter()), "");
    }
}
