//! Recordings by short names that no other has.

use calib::Recording;

use crate::pages::session::short_names;

/// Short names of recordings for display, by their full names.
#[derive(Clone, Debug, Default)]
pub struct Names(Vec<(String, String)>);

impl Names {
    /// Builds the short names of recordings.
    pub fn of<'a>(recordings: impl IntoIterator<Item = &'a Recording>) -> Self {
        let names = recordings.into_iter().map(|r| r.name.as_str());
        Self::of_words(&names.collect::<Vec<_>>())
    }

    /// Builds the short names from full names.
    pub fn of_words(whole: &[&str]) -> Self {
        let mut whole = whole.to_vec();
        whole.dedup();
        let short = short_names(&whole);
        let pairs = whole.iter().map(|name| (*name).to_owned()).zip(short);
        // A path only: any other name may be a word.
        let mut pairs: Vec<_> = pairs.filter(|(name, _)| name.contains('/')).collect();
        // A longer one may begin with a shorter.
        pairs.sort_by_key(|(name, _)| std::cmp::Reverse(name.len()));
        Self(pairs)
    }

    /// The text with the short names.
    pub fn short(&self, text: &str) -> String {
        let replaced = |text: String, (name, short): &(String, String)| {
            let inside = format!("{}/", name.trim_end_matches('/'));
            let text = text.replace(&inside, &format!("{short}/"));
            text.replace(name.as_str(), short)
        };
        self.0.iter().fold(text.to_owned(), replaced)
    }

    /// The same for several.
    pub fn all_short(&self, texts: &[String]) -> Vec<String> {
        texts.iter().map(|text| self.short(text)).collect()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_path_in_a_message_is_the_short_name_of_its_recording() {
        let names = Names::of_words(&["data/a/rec_1", "data/a/rec_10/"]);
        assert_eq!(
            names.short("data/a/rec_1/acc.csv: 1 gap; data/a/rec_10: none"),
            "rec_1/acc.csv: 1 gap; data/a/rec_10: none".replace("data/a/rec_10", "rec_10")
        );
        let same = Names::of_words(&["day_1/run.csv", "day_2/run.csv"]);
        assert_eq!(same.short("day_2/run.csv: x"), "day_2/run: x");
    }
}
