//! Every option of every command changes the result, is refused with the reason, or is listed as changing nothing.

use crate::common;
mod cases;
mod inputs;

use std::collections::{BTreeMap, HashMap};
use std::path::Path;
use std::process::{Command, Stdio};
use std::sync::Mutex;
use std::sync::atomic::{AtomicUsize, Ordering};

use cases::{bases, case, recording};
use serde_json::Value;
use stillpoint_cli::without_effect::reason;

/// What a call did, but for what it says on the way.
#[derive(Clone, Debug, PartialEq)]
struct Outcome {
    status: i32,
    printed: String,
    /// Contents by name.
    files: BTreeMap<String, Vec<u8>>,
    /// Why it failed.
    why: String,
}

/// An option of a command.
struct Asked {
    command: String,
    option: String,
    takes_value: bool,
}

/// All of them, as the parser knows them.
fn all() -> Vec<Asked> {
    fn add(path: &str, command: &clap::Command, all: &mut Vec<Asked>) {
        for arg in command.get_arguments().filter(|arg| !arg.is_positional()) {
            let long = arg.get_long().map(|name| format!("--{name}"));
            let option = long
                .or(arg.get_short().map(|name| format!("-{name}")))
                .unwrap();
            if option != "--help" && option != "--version" {
                all.push(Asked {
                    command: path.to_owned(),
                    option,
                    takes_value: arg.get_action().takes_values(),
                });
            }
        }
        for sub in command
            .get_subcommands()
            .filter(|sub| sub.get_name() != "help")
        {
            let path = format!("{path} {}", sub.get_name());
            add(path.trim(), sub, all);
        }
    }
    let mut found = Vec::new();
    for command in stillpoint_cli::command().get_subcommands() {
        if command.get_name() != "help" {
            add(command.get_name(), command, &mut found);
        }
    }
    found
}

struct Bench {
    inputs: tempfile::TempDir,
    ran: Mutex<HashMap<String, Outcome>>,
}

impl Bench {
    /// The outcome of a call, in a folder that holds links to the inputs.
    fn run(&self, call: &str, recording: &str) -> Outcome {
        let call = call.replace("REC", recording);
        if let Some(known) = self.ran.lock().unwrap().get(&call) {
            return known.clone();
        }
        let folder = tempfile::tempdir().unwrap();
        for entry in std::fs::read_dir(self.inputs.path()).unwrap() {
            let entry = entry.unwrap();
            std::os::unix::fs::symlink(entry.path(), folder.path().join(entry.file_name()))
                .unwrap();
        }
        let stdin = std::fs::File::open(self.inputs.path().join(recording))
            .map_or(Stdio::null(), Stdio::from);
        let output = Command::new(env!("CARGO_BIN_EXE_stillpoint"))
            .current_dir(folder.path())
            .args(call.split(' '))
            .stdin(stdin)
            .output()
            .unwrap();
        let status = output.status.code().unwrap();
        let errors = common::stderr(&output);
        let why = errors
            .lines()
            .filter(|line| !line.starts_with("warning"))
            .collect::<Vec<_>>()
            .join("\n");
        let mut files = BTreeMap::new();
        collect(folder.path(), folder.path(), &mut files);
        let outcome = Outcome {
            status,
            printed: result(&output.stdout),
            files,
            why: if status == 0 { String::new() } else { why },
        };
        self.ran.lock().unwrap().insert(call, outcome.clone());
        outcome
    }

    /// What is wrong with an option; nothing where it is as it should be.
    fn judge(&self, asked: &Asked) -> Option<String> {
        let Asked {
            command, option, ..
        } = asked;
        let name = format!("{command} {option}");
        let Some((file, with)) = case(command, option) else {
            return Some(format!("{name}: no call is known for it"));
        };
        let (both, with) = with.split_once(" | ").unwrap_or(("", with));
        for base in bases(command, option) {
            let file = match base.contains("six-position") && file == recording(command) {
                true => "six.csv",
                false => file,
            };
            let base = format!("{base} {both}");
            let (without, with) = match without(base.trim(), asked) {
                Some(without) => (without, base.trim().to_owned()),
                None => (
                    base.trim().to_owned(),
                    format!("{base} {with}").replace("  ", " "),
                ),
            };
            let (without, with) = (self.run(&without, file), self.run(&with, file));
            let same = without == with;
            if reason(command, option).is_some() {
                continue;
            }
            // What the parser takes for no option or no value says nothing of the command.
            let refused = with.status == 2 && without.status != 2;
            let misspelt = ["unexpected argument", "invalid value", "unrecognized"];
            let is_named = with.why.contains(option.as_str())
                && !misspelt.iter().any(|words| with.why.contains(words));
            if refused && !is_named {
                let why = with.why;
                return Some(format!(
                    "{base}: {option} is refused without being named: {why}"
                ));
            }
            if same {
                return Some(format!(
                    "{base} on {file}: {option} is ignored (exit {}: {})",
                    with.status, with.why
                ));
            }
        }
        None
    }
}

/// The call without an option that it has; `None` where it does not have it.
fn without(call: &str, asked: &Asked) -> Option<String> {
    let words: Vec<&str> = call.split(' ').collect();
    let at = words.iter().position(|word| *word == asked.option)?;
    let until = at + 1 + usize::from(asked.takes_value);
    let left = words[..at].iter().chain(&words[until..]);
    Some(left.copied().collect::<Vec<_>>().join(" "))
}

/// What was printed, of a document without how it was asked for.
fn result(printed: &[u8]) -> String {
    let text = String::from_utf8_lossy(printed).into_owned();
    let Ok(mut document) = serde_json::from_str::<Value>(&text) else {
        return text;
    };
    strip(&mut document);
    document.to_string()
}

fn strip(value: &mut Value) {
    match value {
        Value::Object(entries) => {
            for key in ["options", "basis_sha256", "numbers_sha256"] {
                entries.remove(key);
            }
            entries.values_mut().for_each(strip);
        }
        Value::Array(all) => all.iter_mut().for_each(strip),
        _ => {}
    }
}

/// The files below a folder that are no links.
fn collect(root: &Path, folder: &Path, files: &mut BTreeMap<String, Vec<u8>>) {
    for entry in std::fs::read_dir(folder).unwrap().map(Result::unwrap) {
        let kind = entry.file_type().unwrap();
        let path = entry.path();
        let name = path
            .strip_prefix(root)
            .unwrap()
            .to_string_lossy()
            .into_owned();
        // How long each device took.
        if kind.is_dir() {
            collect(root, &path, files);
        } else if kind.is_file() && !name.contains("timings") {
            files.insert(name, result(&std::fs::read(&path).unwrap()).into_bytes());
        }
    }
}

#[test]
fn every_option_of_every_command_changes_the_result_or_is_refused_or_listed() {
    let bench = Bench {
        inputs: inputs::folder(),
        ran: Mutex::default(),
    };
    let only = std::env::var("OPTIONS").ok();
    let mut asked = all();
    asked.retain(|a| {
        only.as_ref()
            .is_none_or(|only| format!("{} {}", a.command, a.option).contains(only))
    });
    let next = AtomicUsize::new(0);
    let wrong = Mutex::new(Vec::new());
    std::thread::scope(|scope| {
        for _ in 0..std::thread::available_parallelism().map_or(1, usize::from) {
            scope.spawn(|| {
                while let Some(asked) = asked.get(next.fetch_add(1, Ordering::Relaxed)) {
                    wrong.lock().unwrap().extend(bench.judge(asked));
                }
            });
        }
    });
    let wrong = wrong.into_inner().unwrap();
    assert!(
        wrong.is_empty(),
        "{} of {} options:\n{}",
        wrong.len(),
        asked.len(),
        wrong.join("\n")
    );
}
