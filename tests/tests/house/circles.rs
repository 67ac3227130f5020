//! Circles among the files of a crate, read from what they name.
//!
//! A file leads to another where its code names what the other defines: in a path, or by a name that it imports. What a module
//! merely passes on (`pub use`) is followed to where it is defined, and declaring a module is no use of it: a file that only
//! declares and passes on is no stop on the way. Tests do not count.

use std::collections::{BTreeMap, BTreeSet};
use std::path::{Path, PathBuf};

use proc_macro2::{Delimiter, TokenStream, TokenTree};

/// A path: `["crate", "rows", "Rows"]` as written, `["rows", "Rows"]` from the root.
type Names = Vec<String>;

/// Longest chain of what is passed on.
const DEEPEST: usize = 20;

/// What begins a definition.
const DEFINES: [&str; 8] = [
    "struct", "enum", "fn", "trait", "type", "const", "static", "union",
];

/// One file as a module.
#[derive(Default)]
struct File {
    path: PathBuf,
    module: Names,
    /// Modules with a file of their own that it declares.
    children: BTreeSet<String>,
    /// What it defines.
    defined: BTreeSet<String>,
    /// What it imports, as written, and whether it passes that on.
    imports: BTreeMap<String, (Names, bool)>,
    /// Modules of which it imports or passes on everything.
    globs: Vec<Names>,
    /// Paths in its code.
    paths: BTreeSet<Names>,
    /// All words of its code.
    words: BTreeSet<String>,
}

/// The circles among the files of a crate, from its root file on.
pub fn circles(root: &Path) -> Vec<Vec<PathBuf>> {
    let mut files = Vec::new();
    read(root, root.parent().unwrap(), Vec::new(), &mut files);
    let places: BTreeMap<Names, usize> = files
        .iter()
        .enumerate()
        .map(|(k, file)| (file.module.clone(), k))
        .collect();
    let house = House { files, places };
    let leads_to: Vec<BTreeSet<usize>> =
        (0..house.files.len()).map(|k| house.leads_to(k)).collect();
    let reached: Vec<BTreeSet<usize>> =
        (0..leads_to.len()).map(|k| reached(&leads_to, k)).collect();
    let mut seen = BTreeSet::new();
    let mut all = Vec::new();
    for k in (0..reached.len()).filter(|&k| reached[k].contains(&k)) {
        let circle = reached[k]
            .iter()
            .copied()
            .filter(|&other| reached[other].contains(&k));
        let circle: Vec<usize> = circle.collect();
        if circle.iter().all(|file| seen.insert(*file)) {
            all.push(
                circle
                    .into_iter()
                    .map(|file| house.files[file].path.clone())
                    .collect(),
            );
        }
    }
    all
}

/// Everything that is reached from one, itself only where a circle leads back.
fn reached(leads_to: &[BTreeSet<usize>], one: usize) -> BTreeSet<usize> {
    let mut all = BTreeSet::new();
    let mut next: Vec<usize> = leads_to[one].iter().copied().collect();
    while let Some(k) = next.pop() {
        if all.insert(k) {
            next.extend(&leads_to[k]);
        }
    }
    all
}

/// Reads a file and those of the modules that it declares, which lie in `folder`.
fn read(path: &Path, folder: &Path, module: Names, files: &mut Vec<File>) {
    let text = std::fs::read_to_string(path).unwrap();
    let tokens: TokenStream = text
        .parse()
        .unwrap_or_else(|e| panic!("{}: {e}", path.display()));
    let mut file = File {
        path: path.to_owned(),
        module: module.clone(),
        ..File::default()
    };
    file.walk(tokens, 0);
    let children = file.children.clone();
    files.push(file);
    for child in children {
        let inside = folder.join(&child);
        let own = [folder.join(format!("{child}.rs")), inside.join("mod.rs")];
        let own = own.iter().find(|path| path.exists());
        let own = own.unwrap_or_else(|| panic!("{}: no file of {child}", path.display()));
        read(own, &inside, [module.clone(), vec![child]].concat(), files);
    }
}

fn word(tree: Option<&TokenTree>) -> Option<String> {
    match tree {
        Some(TokenTree::Ident(name)) => Some(name.to_string()),
        _ => None,
    }
}

fn is_punct(tree: Option<&TokenTree>, c: char) -> bool {
    matches!(tree, Some(TokenTree::Punct(p)) if p.as_char() == c)
}

/// Whether an item or a statement ends here.
fn is_end(tree: &TokenTree) -> bool {
    let is_body = matches!(tree, TokenTree::Group(g) if g.delimiter() == Delimiter::Brace);
    is_body || is_punct(Some(tree), ';')
}

/// Without what is compiled for tests only.
fn without_tests(tokens: TokenStream) -> Vec<TokenTree> {
    let is_of_tests = |tree: &TokenTree| match tree {
        TokenTree::Group(g) => g.to_string().replace(' ', "") == "[cfg(test)]",
        _ => false,
    };
    let mut kept = Vec::new();
    let mut all = tokens.into_iter();
    while let Some(tree) = all.next() {
        if is_of_tests(&tree) {
            kept.pop();
            all.find(is_end);
        } else {
            kept.push(tree);
        }
    }
    kept
}

impl File {
    /// Takes in some code, which lies so many inline modules deep.
    fn walk(&mut self, tokens: TokenStream, depth: usize) {
        let tokens = without_tests(tokens);
        let mut at = 0;
        while at < tokens.len() {
            match (&tokens[at], word(tokens.get(at + 1))) {
                (TokenTree::Ident(name), _) if name == "use" => {
                    let ends = |tree: &TokenTree| is_punct(Some(tree), ';');
                    let length = tokens[at..].iter().position(ends).unwrap_or(1);
                    let is_public = is_visibility(&tokens[..at]);
                    let mut found = Vec::new();
                    import(&tokens[at + 1..at + length], &[], &mut found);
                    for (name, from) in found {
                        let from = outside(from, depth);
                        if name == "*" {
                            self.globs.push(from);
                        } else {
                            self.imports.insert(name, (from, is_public));
                        }
                    }
                    at += length + 1;
                }
                (TokenTree::Ident(name), Some(module)) if name == "mod" => {
                    match tokens.get(at + 2) {
                        Some(TokenTree::Group(inside)) => self.walk(inside.stream(), depth + 1),
                        _ => _ = self.children.insert(module),
                    }
                    at += 3;
                }
                // `pub(in path)` names who may see it.
                (TokenTree::Ident(name), None) if name == "pub" => at += 2,
                (TokenTree::Ident(name), following) => {
                    let name = name.to_string();
                    if let (true, Some(following)) = (DEFINES.contains(&name.as_str()), following) {
                        self.defined.insert(following);
                    }
                    let mut names = vec![name];
                    at += 1;
                    while is_punct(tokens.get(at), ':') && is_punct(tokens.get(at + 1), ':') {
                        let Some(next) = word(tokens.get(at + 2)) else {
                            break;
                        };
                        names.push(next);
                        at += 3;
                    }
                    self.words.insert(names[0].clone());
                    if names.len() > 1 {
                        self.paths.insert(outside(names, depth));
                    }
                }
                (TokenTree::Group(inside), _) => {
                    self.walk(inside.stream(), depth);
                    at += 1;
                }
                _ => at += 1,
            }
        }
    }
}

/// A path as the file itself would write it that is written so many inline modules deep.
fn outside(mut names: Names, depth: usize) -> Names {
    for _ in 0..depth {
        if names.first().is_some_and(|name| name == "super") {
            names.remove(0);
            if names.first().is_none_or(|name| name != "super") {
                names.insert(0, "self".into());
                break;
            }
        }
    }
    names
}

/// Whether `pub` or `pub(…)` is the last of these.
fn is_visibility(before: &[TokenTree]) -> bool {
    let is_pub = |tree: Option<&TokenTree>| word(tree).is_some_and(|name| name == "pub");
    match before {
        [.., before, TokenTree::Group(g)] => {
            g.delimiter() == Delimiter::Parenthesis && is_pub(Some(before))
        }
        all => is_pub(all.last()),
    }
}

/// The names that one `use` brings, each with its path; `*` for all of a module.
fn import(tokens: &[TokenTree], before: &[String], found: &mut Vec<(String, Names)>) {
    let mut names = before.to_vec();
    for (at, tree) in tokens.iter().enumerate() {
        match tree {
            TokenTree::Ident(name) if name == "as" => {
                let name = word(tokens.get(at + 1)).unwrap_or_default();
                return found.push((name, names));
            }
            TokenTree::Ident(name) if name == "self" && !names.is_empty() => {}
            TokenTree::Ident(name) => names.push(name.to_string()),
            TokenTree::Group(g) => {
                let inside: Vec<TokenTree> = g.stream().into_iter().collect();
                let parts = inside.split(|t| is_punct(Some(t), ','));
                return parts
                    .filter(|part| !part.is_empty())
                    .for_each(|part| import(part, &names, found));
            }
            _ if is_punct(Some(tree), '*') => return found.push(("*".into(), names)),
            _ => {}
        }
    }
    if let Some(last) = names.last().cloned() {
        found.push((last, names));
    }
}

/// The files of a crate, and where each module is among them.
struct House {
    files: Vec<File>,
    places: BTreeMap<Names, usize>,
}

impl House {
    /// The files that one leads to.
    fn leads_to(&self, one: usize) -> BTreeSet<usize> {
        let file = &self.files[one];
        let is_used =
            |name: &String, is_passed_on: bool| !is_passed_on || file.words.contains(name);
        let imports = file.imports.iter();
        let imports = imports.filter(|(name, (_, is_passed_on))| is_used(name, *is_passed_on));
        let named = imports.map(|(_, (from, _))| from).chain(&file.paths);
        let mut to: BTreeSet<usize> = named
            .filter_map(|names| self.written(one, names, 0))
            .collect();
        // Of all that a module has, what the words here may be.
        let modules = file
            .globs
            .iter()
            .filter_map(|from| self.written(one, from, 0));
        for module in modules.filter(|module| *module != one) {
            let has = |word: &&String| {
                let module = &self.files[module];
                module.defined.contains(*word) || module.imports.contains_key(*word)
            };
            let words = file.words.iter().filter(has);
            to.extend(words.filter_map(|word| self.below(module, std::slice::from_ref(word), 0)));
        }
        to.remove(&one);
        to
    }

    /// The file that defines what a path as written in a file says; `None` where that is another crate.
    fn written(&self, one: usize, names: &[String], depth: usize) -> Option<usize> {
        if depth > DEEPEST {
            return None;
        }
        let file = &self.files[one];
        let (first, after) = names.split_first()?;
        match first.as_str() {
            "crate" => self.below(0, after, depth),
            "self" => self.below(one, after, depth),
            "super" => {
                let ups = names.iter().take_while(|name| *name == "super").count();
                let kept = file.module.len().checked_sub(ups)?;
                let module = *self.places.get(&file.module[..kept])?;
                self.below(module, &names[ups..], depth)
            }
            first if file.children.contains(first) => self.below(one, names, depth),
            first => {
                let (from, _) = file.imports.get(first)?;
                self.written(one, &[from, after].concat(), depth + 1)
            }
        }
    }

    /// The file that defines what a path says from a module on.
    fn below(&self, one: usize, names: &[String], depth: usize) -> Option<usize> {
        let file = &self.files[one];
        let Some((name, after)) = names.split_first() else {
            return Some(one);
        };
        if file.children.contains(name) {
            let child = [file.module.as_slice(), std::slice::from_ref(name)].concat();
            return self.below(*self.places.get(&child)?, after, depth);
        }
        if file.defined.contains(name) {
            return Some(one);
        }
        if let Some((from, _)) = file.imports.get(name) {
            return self.written(one, &[from, after].concat(), depth + 1);
        }
        if depth > DEEPEST {
            return Some(one);
        }
        let all = file.globs.iter();
        let all = all.filter_map(|from| self.written(one, from, depth + 1));
        let mut defining = all.filter_map(|module| self.below(module, names, depth + 1));
        let found = defining.find(|&k| self.files[k].defined.contains(name));
        Some(found.unwrap_or(one))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The circles among files with these texts.
    fn among(files: &[(&str, &str)]) -> Vec<Vec<String>> {
        let folder = tempfile::tempdir().unwrap();
        for (name, text) in files {
            let path = folder.path().join(name);
            std::fs::create_dir_all(path.parent().unwrap()).unwrap();
            std::fs::write(path, text).unwrap();
        }
        let name = |path: &PathBuf| {
            path.strip_prefix(folder.path())
                .unwrap()
                .display()
                .to_string()
        };
        let found = circles(&folder.path().join("lib.rs"));
        found
            .iter()
            .map(|circle| circle.iter().map(name).collect())
            .collect()
    }

    #[test]
    fn two_files_that_name_each_other_are_a_circle_whatever_way_the_name_takes() {
        let one = "pub struct One(super::Two);";
        let passing = "mod one;\nmod two;\npub use one::One;\npub use two::Two;\n";
        let ways = [
            "use crate::One;\npub struct Two(Vec<One>);",
            "use super::one::One as First;\npub struct Two(Vec<First>);",
            "pub struct Two;\nfn of() { let _ = vec![crate::one::One::new()]; }",
            "use super::*;\npub struct Two(Vec<One>);",
            "mod inside { use super::super::One; }\npub struct Two;",
        ];
        for two in ways {
            let found = among(&[("lib.rs", passing), ("one.rs", one), ("two.rs", two)]);
            assert!(
                found
                    .iter()
                    .any(|circle| circle.contains(&"two.rs".to_owned())),
                "{two}"
            );
        }
    }

    #[test]
    fn a_module_is_in_a_circle_with_a_child_that_uses_its_code_if_it_uses_the_child() {
        let child = (
            "child.rs",
            "use super::Parent;\npub struct Child(Box<Parent>);",
        );
        let uses = "mod child;\npub use child::Child;\npub struct Parent(Option<Child>);";
        assert_eq!(among(&[("lib.rs", uses), child]), [["lib.rs", "child.rs"]]);
        let passes_on = "mod child;\npub use child::Child;\npub struct Parent;";
        assert!(among(&[("lib.rs", passes_on), child]).is_empty());
    }

    #[test]
    fn tests_comments_and_who_may_see_something_are_no_use_of_it() {
        let lib = "mod one;\nmod two;";
        let one = "pub(in crate::two) struct One;\n/// As [`crate::two::Two`].\npub struct Other;\n\
                   #[cfg(test)]\nmod tests { use crate::two::Two; }";
        let two = "use crate::one::Other;\npub struct Two(Other);";
        assert!(among(&[("lib.rs", lib), ("one.rs", one), ("two.rs", two)]).is_empty());
    }
}
