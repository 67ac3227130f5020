//! Global options for standard output and error: amount, width and colour.

use std::ffi::OsString;
use std::io::IsTerminal;
#[cfg(unix)]
use std::os::fd::AsFd as Stream;
#[cfg(windows)]
use std::os::windows::io::AsHandle as Stream;
use std::sync::atomic::{AtomicU8, Ordering};

use clap::{ColorChoice, ValueEnum};

/// Columns of everything that is no terminal.
pub const COLUMNS: usize = 80;
/// Narrower terminals are taken to be this wide.
const NARROWEST: usize = 40;

/// Options of every command.
#[derive(Clone, Copy, Debug, clap::Args)]
#[command(next_help_heading = "Terminal")]
pub struct TerminalArgs {
    /// Say the verdict or the main figure only, and errors
    #[arg(short, long, global = true, conflicts_with = "verbose")]
    quiet: bool,
    /// Say everything: what stands behind the result, and every warning
    #[arg(short, long, global = true)]
    verbose: bool,
    /// Colour of warnings and errors
    #[arg(long, global = true, value_enum, value_name = "WHEN", default_value_t = Colour::Auto)]
    color: Colour,
}

/// When words are coloured.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub enum Colour {
    /// On a terminal, unless NO_COLOR is set
    Auto,
    /// Always
    Always,
    /// Never
    Never,
}

const QUIET: u8 = 1;
const VERBOSE: u8 = 2;
const COLOURED: u8 = 4;

static ASKED: AtomicU8 = AtomicU8::new(0);

impl TerminalArgs {
    /// Holds from now on.
    pub fn install(self) {
        let flags = [
            (self.quiet, QUIET),
            (self.verbose, VERBOSE),
            (self.color.holds(), COLOURED),
        ];
        let asked = flags.into_iter().filter(|(set, _)| *set);
        ASKED.store(asked.map(|(_, flag)| flag).sum(), Ordering::SeqCst);
    }
}

impl Colour {
    /// Returns the colour option in the words of a call, before they are parsed: help and errors of the parser are
    /// coloured too.
    pub fn in_call(words: &[OsString]) -> Self {
        let words: Vec<String> = words
            .iter()
            .map(|word| word.to_string_lossy().into_owned())
            .take_while(|word| word != "--")
            .collect();
        let separate = words.windows(2).find(|pair| pair[0] == "--color");
        let separate = separate.map(|pair| pair[1].as_str());
        let joined = words.iter().find_map(|word| word.strip_prefix("--color="));
        match separate.or(joined) {
            Some("always") => Self::Always,
            Some("never") => Self::Never,
            _ => Self::Auto,
        }
    }

    /// The same for the parser.
    pub fn choice(self) -> ColorChoice {
        match self {
            Self::Auto if no_color() => ColorChoice::Never,
            Self::Auto => ColorChoice::Auto,
            Self::Always => ColorChoice::Always,
            Self::Never => ColorChoice::Never,
        }
    }

    fn holds(self) -> bool {
        match self {
            Self::Auto => std::io::stderr().is_terminal() && !no_color(),
            Self::Always => true,
            Self::Never => false,
        }
    }
}

/// Returns true if the environment asks for no colour (no-color.org).
fn no_color() -> bool {
    std::env::var_os("NO_COLOR").is_some_and(|value| !value.is_empty())
}

fn asked(flag: u8) -> bool {
    ASKED.load(Ordering::SeqCst) & flag != 0
}

/// Returns true if only results and errors are to be printed.
pub fn is_quiet() -> bool {
    asked(QUIET)
}

/// Returns true if everything is to be printed.
pub fn is_verbose() -> bool {
    asked(VERBOSE)
}

/// Columns of standard output.
pub fn width() -> usize {
    columns_of(std::io::stdout()).map_or(COLUMNS, |columns| columns.max(NARROWEST))
}

/// Columns of standard error; `None` where it is no terminal: a log keeps a message in one line.
pub fn error_width() -> Option<usize> {
    columns_of(std::io::stderr()).map(|columns| columns.max(NARROWEST))
}

#[cfg(any(unix, windows))]
fn columns_of(stream: impl Stream) -> Option<usize> {
    let size = terminal_size::terminal_size_of(stream);
    size.map(|(width, _)| usize::from(width.0))
}

/// There is no terminal.
#[cfg(not(any(unix, windows)))]
fn columns_of<T>(_stream: T) -> Option<usize> {
    None
}

/// The first words of a line in a colour of the terminal (ANSI number), where colours are wanted.
pub fn coloured(words: &str, colour: u8) -> String {
    if asked(COLOURED) {
        format!("\u{1b}[1;{colour}m{words}\u{1b}[0m")
    } else {
        words.to_owned()
    }
}

/// The text with lines of at most `width` columns, broken between words; continued lines are indented as the first.
pub fn wrapped(text: &str, width: usize) -> String {
    let lines = text.split('\n').map(|line| wrapped_line(line, width));
    lines.collect::<Vec<_>>().join("\n")
}

fn wrapped_line(line: &str, width: usize) -> String {
    if line.chars().count() <= width {
        return line.to_owned();
    }
    let before: String = line.chars().take_while(|c| *c == ' ').collect();
    let (mut text, mut column) = (before.clone(), before.len());
    // What goes on below a bullet stands beside it.
    let bullet = line.trim_start().starts_with("• ");
    let indent = if bullet { before + "  " } else { before };
    for (k, word) in line.split_whitespace().enumerate() {
        let length = word.chars().count();
        if k > 0 && column + 1 + length > width {
            text.push('\n');
            text.push_str(&indent);
            column = indent.len();
        } else if k > 0 {
            text.push(' ');
            column += 1;
        }
        text.push_str(word);
        column += length;
    }
    text
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_goes_on_below_a_bullet_stands_beside_it() {
        assert_eq!(wrapped("• one two three", 10), "• one two\n  three");
    }

    #[test]
    fn long_lines_are_broken_between_words_and_keep_their_indent() {
        assert_eq!(
            wrapped("  one two three\nfour", 10),
            "  one two\n  three\nfour"
        );
        let long = "x".repeat(30);
        assert_eq!(wrapped(&format!("a {long} b"), 10), format!("a\n{long}\nb"));
    }
}
