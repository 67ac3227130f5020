//! A folder to run the program in, and what may be asserted of a run.

use std::collections::BTreeMap;
use std::io::{Read as _, Seek as _, SeekFrom};
use std::path::PathBuf;
use std::process::{Command, Output, Stdio};
use std::time::{Duration, Instant};

use tempfile::TempDir;

/// No message is longer than this, whatever is in the input.
const LONGEST_LINE: usize = 2_000;

/// No case takes longer than this, in a debug build on a busy machine.
const PATIENCE: Duration = Duration::from_secs(60);

/// A folder with the inputs of one case.
#[derive(Debug)]
pub struct Bench {
    folder: TempDir,
}

impl Bench {
    pub fn new() -> Self {
        Self {
            folder: tempfile::tempdir().unwrap(),
        }
    }

    /// A folder with one file.
    pub fn with(name: &str, content: impl AsRef<[u8]>) -> Self {
        let bench = Self::new();
        bench.write(name, content);
        bench
    }

    pub fn path(&self, name: &str) -> PathBuf {
        self.folder.path().join(name)
    }

    pub fn write(&self, name: &str, content: impl AsRef<[u8]>) {
        let path = self.path(name);
        std::fs::create_dir_all(path.parent().unwrap()).unwrap();
        std::fs::write(path, content).unwrap();
    }

    /// The program with these arguments, to be given an environment or limits. It says all that it has to say.
    pub fn command(&self, args: &[&str]) -> Command {
        let mut command = Command::new(env!("CARGO_BIN_EXE_stillpoint"));
        let says_all = ["-q", "-v"].iter().any(|said| args.contains(said));
        command
            .current_dir(self.folder.path())
            .args((!says_all).then_some("-v"))
            .args(args)
            .stdin(Stdio::null());
        command
    }

    #[track_caller]
    pub fn run(&self, args: &[&str]) -> Run {
        self.watch(self.command(args))
    }

    /// Runs `command` and compares the folder before and after.
    #[track_caller]
    pub fn watch(&self, mut command: Command) -> Run {
        let before = self.listing();
        let output = within(&mut command, PATIENCE);
        let after = self.listing();
        let run = Run {
            status: output.status.code(),
            stdout: String::from_utf8_lossy(&output.stdout).into_owned(),
            stderr: String::from_utf8_lossy(&output.stderr).into_owned(),
            changed: changed(&before, &after),
        };
        run.assert_is_decent();
        run
    }

    /// Every file under the folder with its content.
    fn listing(&self) -> BTreeMap<PathBuf, Vec<u8>> {
        let mut files = BTreeMap::new();
        let mut folders = vec![self.folder.path().to_owned()];
        while let Some(folder) = folders.pop() {
            let Ok(entries) = std::fs::read_dir(&folder) else {
                continue;
            };
            for entry in entries {
                let entry = entry.unwrap();
                let kind = entry.file_type().unwrap();
                if kind.is_dir() {
                    folders.push(entry.path());
                } else {
                    let content = if kind.is_file() {
                        std::fs::read(entry.path()).unwrap_or_default()
                    } else {
                        Vec::new()
                    };
                    files.insert(entry.path(), content);
                }
            }
        }
        files
    }
}

/// The output of `command`, which is killed if it takes longer than `patience`.
#[track_caller]
fn within(command: &mut Command, patience: Duration) -> Output {
    let (out, err) = (tempfile::tempfile().unwrap(), tempfile::tempfile().unwrap());
    let handles = (out.try_clone().unwrap(), err.try_clone().unwrap());
    let mut child = command.stdout(handles.0).stderr(handles.1).spawn().unwrap();
    let end = Instant::now() + patience;
    let status = loop {
        if let Some(status) = child.try_wait().unwrap() {
            break status;
        }
        if Instant::now() > end {
            child.kill().unwrap();
            child.wait().unwrap();
            panic!("still running after {patience:?}: {command:?}");
        }
        std::thread::sleep(Duration::from_millis(5));
    };
    let [stdout, stderr] = [out, err].map(|mut file| {
        let mut bytes = Vec::new();
        file.seek(SeekFrom::Start(0)).unwrap();
        file.read_to_end(&mut bytes).unwrap();
        bytes
    });
    Output {
        status,
        stdout,
        stderr,
    }
}

fn changed(before: &BTreeMap<PathBuf, Vec<u8>>, after: &BTreeMap<PathBuf, Vec<u8>>) -> Vec<String> {
    let differ = |(path, content): &(&PathBuf, &Vec<u8>)| before.get(*path) != Some(content);
    let new = after.iter().filter(differ).map(|(path, _)| path);
    let gone = before.keys().filter(|path| !after.contains_key(*path));
    new.chain(gone)
        .map(|path| path.file_name().unwrap().to_string_lossy().into_owned())
        .collect()
}

/// What a run ended with.
#[derive(Debug)]
pub struct Run {
    pub status: Option<i32>,
    pub stdout: String,
    pub stderr: String,
    /// Names of the files that the run made, changed or removed.
    pub changed: Vec<String>,
}

impl Run {
    /// What holds of every run: no panic, no bug of ours, no control character, no endless line.
    #[track_caller]
    fn assert_is_decent(&self) {
        let code = self.status;
        assert!(code.is_some(), "ended by a signal: {}", self.stderr);
        assert!(
            !matches!(code, Some(7 | 101 | 134)),
            "status {code:?}: {}",
            self.stderr
        );
        for text in [&self.stdout, &self.stderr] {
            let odd = text.chars().find(|c| c.is_control() && *c != '\n');
            assert_eq!(odd, None, "control character in: {text}");
            let longest = text
                .lines()
                .filter(|l| !l.starts_with('{'))
                .map(str::len)
                .max();
            assert!(
                longest.unwrap_or(0) <= LONGEST_LINE,
                "a line of {longest:?} bytes"
            );
        }
    }

    #[track_caller]
    pub fn ends(&self, status: i32) -> &Self {
        assert_eq!(self.status, Some(status), "{self:#?}");
        self
    }

    /// The messages hold every one of `words`.
    #[track_caller]
    pub fn says(&self, words: &[&str]) -> &Self {
        for word in words {
            assert!(self.stderr.contains(word), "expected `{word}` in {self:#?}");
        }
        self
    }

    #[track_caller]
    pub fn is_silent_on(&self, words: &[&str]) -> &Self {
        for word in words {
            assert!(
                !self.stderr.contains(word),
                "unexpected `{word}` in {self:#?}"
            );
        }
        self
    }

    /// No file was made, changed or removed but these.
    #[track_caller]
    pub fn changes(&self, files: &[&str]) -> &Self {
        assert_eq!(self.changed, files, "{self:#?}");
        self
    }

    /// The one document on standard output.
    #[track_caller]
    pub fn json(&self) -> serde_json::Value {
        serde_json::from_str(&self.stdout).unwrap_or_else(|error| panic!("{error}: {self:#?}"))
    }
}
