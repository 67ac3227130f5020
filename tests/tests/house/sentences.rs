//! Sentences in the code of a crate: what libraries have to say stands in the tables of findings alone.
//!
//! A sentence is a text of six words or more. Contents of files that a library writes, names of quantities and descriptions of formats
//! are no messages; [`CONTENTS`] and [`DESCRIPTIONS`] list them.

use std::path::{Path, PathBuf};

use proc_macro2::{Delimiter, TokenStream, TokenTree};
use stillpoint_tests::rust_files::rust_files;

/// Words of a sentence, at least; names of channels and formats have up to five.
const WORDS: usize = 6;

/// Files that hold other texts than messages.
const CONTENTS: [&str; 12] = [
    // Files in another tool's language, and what they lose.
    "exchange/src/targets/",
    "exchange/src/source.rs",
    "exchange/src/loss.rs",
    "formats/src/make/",
    "formats/src/damage.rs",
    "sensor/src/definition/emit.rs",
    "facade/src/example.rs",
    // Names of quantities.
    "sensor/src/covariate.rs",
    "sensor/src/quantity.rs",
    "discover/src/pictures.rs",
    "discover/src/gap/channel.rs",
    "discover/src/gap/localise.rs",
];

/// Names of texts that describe a thing in a line: a format, an effect, units, a convention.
const DESCRIPTIONS: [&str; 4] = ["about", "EQUATION", "KNOWN", "SIGN_CONVENTION"];

/// Sentences, flags and commands in the code of the crates at these folders, each with its file.
pub fn sentences(folders: &[PathBuf]) -> Vec<String> {
    let mut found = Vec::new();
    for folder in folders {
        for file in sources(folder) {
            let is_content = CONTENTS
                .iter()
                .any(|name| file.to_string_lossy().contains(name));
            let text = std::fs::read_to_string(&file).unwrap();
            let tokens: TokenStream = text.parse().unwrap();
            let mut literals = Vec::new();
            collect(tokens, &mut literals);
            let own = literals
                .into_iter()
                .filter(|text| is_sentence(text) && !is_content);
            found.extend(own.map(|text| format!("{}: {text}", file.display())));
        }
    }
    found
}

fn is_sentence(text: &str) -> bool {
    names_a_flag(text) || names_a_command(text) || words(text) >= WORDS
}

/// Words of letters, what stands in braces left out.
fn words(text: &str) -> usize {
    let mut depth = 0_usize;
    let plain: String = text
        .chars()
        .filter(|c| {
            match c {
                '{' => depth += 1,
                '}' => depth = depth.saturating_sub(1),
                _ => return depth == 0,
            }
            false
        })
        .collect();
    let is_word = |word: &&str| word.chars().filter(|c| c.is_alphabetic()).count() >= 2;
    plain.split_whitespace().filter(is_word).count()
}

fn names_a_flag(text: &str) -> bool {
    let mut starts = text.match_indices("--");
    starts.any(|(at, _)| {
        let before = text[..at].chars().next_back();
        let after = text[at + 2..].chars().next();
        before.is_none_or(|c| c.is_whitespace() || c == '`' || c == '(')
            && after.is_some_and(|c| c.is_ascii_lowercase())
    })
}

fn names_a_command(text: &str) -> bool {
    const COMMANDS: [&str; 8] = [
        "calibrate",
        "discover",
        "plan",
        "allan",
        "info",
        "segment",
        "evaluate",
        "bias",
    ];
    COMMANDS
        .iter()
        .any(|name| text.contains(&format!("stillpoint {name}")))
}

/// String literals, but for those of attributes, of tests and of what only a bug prints.
fn collect(tokens: TokenStream, all: &mut Vec<String>) {
    let tokens: Vec<TokenTree> = tokens.into_iter().collect();
    let mut k = 0;
    while let Some(token) = tokens.get(k) {
        match token {
            TokenTree::Punct(mark) if mark.as_char() == '#' => {
                // `#![…]` is of the file.
                k += usize::from(
                    tokens
                        .get(k + 1)
                        .is_some_and(|next| next.to_string() == "!"),
                );
                let attribute = tokens.get(k + 1).map(ToString::to_string);
                let is_test = attribute.is_some_and(|text| text.replace(' ', "") == "[cfg(test)]");
                k += if is_test { item(&tokens, k + 2) + 2 } else { 2 };
                continue;
            }
            TokenTree::Ident(name) if is_of_a_bug(&name.to_string()) => {
                let mark =
                    matches!(tokens.get(k + 1), Some(TokenTree::Punct(p)) if p.as_char() == '!');
                k += if mark { 3 } else { 2 };
                continue;
            }
            TokenTree::Ident(name) if DESCRIPTIONS.contains(&name.to_string().as_str()) => {
                let is_text = |token: &TokenTree| match token {
                    TokenTree::Literal(_) => true,
                    TokenTree::Group(group) => group.delimiter() == Delimiter::Brace,
                    TokenTree::Punct(mark) => mark.as_char() == ',',
                    TokenTree::Ident(_) => false,
                };
                let text = tokens[k..].iter().position(is_text);
                k += text.map_or(1, |length| length + 1);
                continue;
            }
            TokenTree::Group(group) => collect(group.stream(), all),
            TokenTree::Literal(literal) => {
                let text = literal.to_string();
                if text.starts_with(['"', 'r']) {
                    all.push(text.replace("\\\n", " "));
                }
            }
            TokenTree::Punct(_) | TokenTree::Ident(_) => {}
        }
        k += 1;
    }
}

/// Macros and calls whose text nobody sees but after a bug.
fn is_of_a_bug(name: &str) -> bool {
    [
        "expect",
        "panic",
        "unreachable",
        "assert",
        "assert_eq",
        "debug_assert",
    ]
    .contains(&name)
}

/// Tokens of the item that begins at `from`: up to its block or its semicolon.
fn item(tokens: &[TokenTree], from: usize) -> usize {
    let ends = |token: &TokenTree| match token {
        TokenTree::Group(group) => group.delimiter() == Delimiter::Brace,
        TokenTree::Punct(mark) => mark.as_char() == ';',
        _ => false,
    };
    let length = tokens[from.min(tokens.len())..].iter().position(ends);
    length.map_or(tokens.len(), |k| k + 1)
}

/// Rust files of a crate without its tests.
fn sources(folder: &Path) -> Vec<PathBuf> {
    let is_of_tests = |path: &PathBuf| {
        let below = path.strip_prefix(folder).unwrap();
        below
            .iter()
            .any(|part| part == "tests" || part == "tests.rs")
    };
    let mut all = rust_files(folder).unwrap();
    all.retain(|path| !is_of_tests(path));
    all
}

#[test]
fn a_sentence_a_flag_and_a_command_are_found_and_others_not() {
    let tokens: TokenStream = r#"
        #[doc = "one two three four five six"]
        fn a() -> &'static str { "the time goes back here again {k}" }
        fn b() { c("give --rate", "a -- b", "time, s", x.expect("this is never seen by anybody")) }
        #[cfg(test)] mod tests { const T: &str = "one two three four five six"; }
        fn d() { "run stillpoint plan" }
    "#
    .parse()
    .unwrap();
    let mut all = Vec::new();
    collect(tokens, &mut all);
    all.retain(|text| is_sentence(text));
    assert_eq!(
        all,
        [
            "\"the time goes back here again {k}\"",
            "\"give --rate\"",
            "\"run stillpoint plan\""
        ]
    );
}
