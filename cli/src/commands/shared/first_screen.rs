//! The first screen: what a person sees without asking, the verdict first, in at most 24 lines of 80 columns.
//!
//! The result is on standard output, remarks follow on standard error: so a result that goes into a file or a pipe is free of them,
//! and a terminal still shows the verdict first. Both are counted together.

use std::path::Path;

pub use ::findings::Step;

use crate::exit::Failure;
use crate::{show, terminal};

/// Lines of a terminal.
pub const LINES: usize = 24;
/// Remarks that are said without asking.
const REMARKS: usize = 5;
/// Lines of one of them.
const OF_A_REMARK: usize = 3;
/// Columns of the words before a command, at most.
const LABEL: usize = 26;

/// Content of the first screen, from top to bottom.
#[derive(Clone, Debug, Default)]
pub struct Screen {
    /// The verdict or the main figure, then its reasons: a paragraph each.
    pub verdict: Vec<String>,
    /// Names and values of a few figures.
    pub figures: Vec<[String; 2]>,
    /// A table, or several lines that go together.
    pub tables: Vec<String>,
    /// Next steps, the most informative first.
    pub next: Vec<Step>,
    /// Sentence with the files that were written.
    pub written: String,
    /// Warnings that the verdict or the next steps have said already: again only with `-v`.
    pub said: Vec<String>,
    /// The others, the gravest first.
    pub remarks: Vec<String>,
    /// Lines that will be said after these, by the message of a failure.
    pub reserved: usize,
}

/// The step that corrects a recording by a calibration, both as a shell takes them, into a file that is not there yet.
pub fn apply_to(recording: &str, calibration: &str) -> Step {
    let is_free = |name: &String| !Path::new(name).exists();
    let numbered = (2..100).map(|k| format!("corrected-{k}.csv"));
    let mut names = std::iter::once("corrected.csv".to_owned()).chain(numbered);
    let free = names.find(is_free).unwrap_or("corrected.csv".into());
    let command = format!("stillpoint apply {calibration} {recording} -o {free}");
    Step::new("correct a recording", command)
}

/// The lines of a step, its command below it where one line does not hold both.
fn lines_of(step: &Step, width: usize) -> Vec<String> {
    let Some(command) = &step.command else {
        return wrapped(&format!("  {}", step.text), width);
    };
    let one = format!("  {:<LABEL$}  {command}", step.text);
    if columns(&step.text) <= LABEL && columns(&one) <= width {
        return vec![one];
    }
    let mut lines = wrapped(&format!("  {}:", step.text), width);
    lines.extend(continued(command, width));
    lines
}

/// The line that calibrates, the command below its label where one line does not hold both; or why none does.
pub fn to_calibrate(command: &str) -> String {
    let width = terminal::width();
    let one = format!("to calibrate: {command}");
    match columns(&one) <= width || !command.starts_with("stillpoint ") {
        true => one,
        false => format!("to calibrate:\n{}", continued(command, width).join("\n")),
    }
}

/// The columns of a text.
fn columns(text: &str) -> usize {
    text.chars().count()
}

fn wrapped(text: &str, width: usize) -> Vec<String> {
    let lines = terminal::wrapped(text, width);
    lines.lines().map(str::to_owned).collect()
}

/// A command over several lines, as a shell takes it.
fn continued(command: &str, width: usize) -> Vec<String> {
    const INDENT: &str = "    ";
    // Blanks within quotes are no place to break a line at.
    let (mut words, mut in_quotes) = (vec![String::new()], false);
    for c in command.chars() {
        in_quotes ^= c == '\'';
        match c {
            ' ' if !in_quotes => words.push(String::new()),
            c => {
                if let Some(word) = words.last_mut() {
                    word.push(c);
                }
            }
        }
    }
    // An option stays beside its value.
    let mut pairs: Vec<String> = Vec::new();
    for word in words {
        match pairs.last_mut() {
            Some(option)
                if option.starts_with('-') && !option.contains(' ') && !word.starts_with('-') =>
            {
                option.push(' ');
                option.push_str(&word);
            }
            _ => pairs.push(word),
        }
    }
    let mut lines = vec![INDENT.to_owned()];
    for word in pairs {
        let last = lines.pop().unwrap_or_default();
        let is_first = last.trim().is_empty();
        if !is_first && columns(&last) + 1 + columns(&word) + 2 > width {
            lines.push(last + " \\");
            lines.push(format!("{INDENT}  {word}"));
        } else if is_first {
            lines.push(last + &word);
        } else {
            lines.push(last + " " + &word);
        }
    }
    lines
}

impl Screen {
    /// Prints it, with `-v` the details below it and every remark, with `-q` the verdict alone.
    ///
    /// # Errors
    /// As [`show::print`].
    pub fn show(&self, details: impl FnOnce() -> String) -> Result<(), Failure> {
        if terminal::is_quiet() {
            let first = self.verdict.first().map_or("", String::as_str);
            return show::print(&show::wrapped(first));
        }
        let (width, of_errors) = (
            terminal::width(),
            terminal::error_width().unwrap_or(terminal::COLUMNS),
        );
        if terminal::is_verbose() {
            let all = self.lines(width, self.next.len()).join("\n");
            show::print(&format!("{all}\n\n{}", show::wrapped(&details())))?;
            show::warn_all(&[&self.said[..], &self.remarks].concat());
            return Ok(());
        }
        let (lines, remarks) = self.fitted(width, of_errors);
        show::print(&lines.join("\n"))?;
        remarks.iter().for_each(|remark| show::remark(remark));
        Ok(())
    }

    /// The lines of the screen and of the remarks below it, no more than a terminal has.
    fn fitted(&self, width: usize, of_errors: usize) -> (Vec<String>, Vec<String>) {
        let room = LINES.saturating_sub(self.reserved);
        let for_remarks = match self.remarks.len() {
            0 => 0,
            1 => 1,
            _ => 2,
        };
        let steps = (1..=self.next.len()).rev();
        let fits = |count: &usize| self.lines(width, *count).len() + for_remarks <= room;
        let steps = steps.into_iter().find(fits).unwrap_or(1);
        let lines = self.lines(width, steps);
        let remarks = said(&self.remarks, room.saturating_sub(lines.len()), of_errors);
        (lines, remarks)
    }

    /// The lines with so many of the next steps.
    fn lines(&self, width: usize, steps: usize) -> Vec<String> {
        let of = |paragraphs: &[String]| {
            let lines = paragraphs.iter().flat_map(|p| wrapped(p, width));
            lines.collect::<Vec<String>>()
        };
        let longest = self.figures.iter().map(|[name, _]| columns(name)).max();
        let names = longest.unwrap_or(0);
        let figures = self.figures.iter().flat_map(|[name, value]| {
            let mut lines = wrapped(value, width.saturating_sub(names + 4)).into_iter();
            let first = lines.next().unwrap_or_default();
            let first = format!("  {name:<names$}  {first}");
            let more = lines.map(move |line| format!("{:1$}{line}", "", names + 4));
            std::iter::once(first).chain(more)
        });
        let mut next: Vec<String> = Vec::new();
        for step in self.next.iter().take(steps) {
            if next.is_empty() {
                next.push("Next".into());
            }
            next.extend(lines_of(step, width));
        }
        let tables = self.tables.iter().map(|table| {
            let lines = table.lines().map(|line| line.trim_end().to_owned());
            lines.collect()
        });
        let mut blocks = vec![of(&self.verdict), figures.collect()];
        blocks.extend(tables);
        next.extend(wrapped(&self.written, width));
        blocks.push(next);
        blocks.retain(|block| !block.is_empty());
        blocks.join(&String::new())
    }
}

/// Lines of the message with which a command ends that fails for these reasons.
pub fn lines_of_failure(reasons: &[String]) -> usize {
    let lines = |reason: &String| {
        let message = show::wrapped(&format!("stillpoint: {reason}"));
        message.lines().count()
    };
    reasons.iter().map(lines).sum()
}

/// The files that were written; `nothing` where there are none.
pub fn wrote<'a>(files: impl IntoIterator<Item = &'a Path>, nothing: &str) -> String {
    let files: Vec<String> = files.into_iter().map(show::path).collect();
    match files.as_slice() {
        [] => nothing.to_owned(),
        files => format!("Wrote {}.", files.join(" and ")),
    }
}

/// Says which file was written where that is all that there is to say, unless the output is quiet.
///
/// # Errors
/// A standard output that cannot be written.
pub fn say_written(file: &Path) -> Result<(), Failure> {
    match terminal::is_quiet() {
        true => Ok(()),
        false => show::print(&wrote([file], "")),
    }
}

/// Says remarks where there is no result that they stand below: half a terminal of them, all with `-v`.
pub fn say(remarks: &[String]) {
    if terminal::is_quiet() {
        return;
    }
    if terminal::is_verbose() {
        return show::warn_all(remarks);
    }
    let width = terminal::error_width().unwrap_or(terminal::COLUMNS);
    let lines = said(remarks, LINES / 2, width);
    lines.iter().for_each(|line| show::remark(line));
}

/// The gist of as many remarks as there is room for, and how many are left.
fn said(remarks: &[String], room: usize, width: usize) -> Vec<String> {
    let folded = show::folded(remarks);
    let mut lines: Vec<String> = Vec::new();
    let mut count = 0;
    for remark in folded.iter().take(REMARKS) {
        let own = remark_lines(remark, width);
        let more = usize::from(count + 1 < folded.len());
        if lines.len() + own.len() + more > room {
            break;
        }
        lines.extend(own);
        count += 1;
    }
    match folded.len() - count {
        0 => {}
        1 if count == 0 => lines.push("1 remark with -v".into()),
        1 => lines.push("1 more remark with -v".into()),
        left if count == 0 => lines.push(format!("{left} remarks with -v")),
        left => lines.push(format!("{left} more remarks with -v")),
    }
    lines
}

fn remark_lines(remark: &str, width: usize) -> Vec<String> {
    let gist = show::gist(remark);
    let mut lines = wrapped(&format!("warning: {gist}"), width);
    if lines.len() > OF_A_REMARK {
        lines.truncate(OF_A_REMARK);
        if let Some(last) = lines.last_mut() {
            while columns(last) + 2 > width {
                let end = last.rfind(' ').unwrap_or(0);
                last.truncate(end);
            }
            last.push_str(" …");
        }
    }
    lines
}

#[cfg(test)]
mod tests {
    use super::*;

    fn full() -> Screen {
        let step = |k: usize| Step::new(format!("step {k}"), "stillpoint demo");
        Screen {
            verdict: vec!["With care: one two three.".into()],
            figures: vec![["a".into(), "1".into()], ["bcd".into(), "2".into()]],
            tables: vec!["row\n".repeat(9)],
            next: (0..9).map(step).collect(),
            written: "Wrote cal.json.".into(),
            said: Vec::new(),
            remarks: (0..9)
                .map(|k| format!("{} remark", "x".repeat(k)))
                .collect(),
            reserved: 0,
        }
    }

    #[test]
    fn a_screen_and_its_remarks_fill_a_terminal_and_no_more() {
        let (lines, remarks) = full().fitted(80, 80);
        assert!(lines.len() + remarks.len() <= LINES);
        assert!(lines[0].starts_with("With care"), "{lines:?}");
        assert!(remarks.last().unwrap().ends_with("with -v"), "{remarks:?}");
        let reserved = Screen {
            reserved: 4,
            ..full()
        };
        let (lines, remarks) = reserved.fitted(80, 80);
        assert!(lines.len() + remarks.len() + 4 <= LINES);
    }

    #[test]
    fn a_long_command_is_broken_where_a_shell_takes_it_up_again() {
        let command = format!(
            "stillpoint discover '{}' -o findings.json",
            "a b".repeat(20)
        );
        let lines = continued(&command, 80);
        assert!(lines.iter().all(|line| columns(line) <= 80), "{lines:?}");
        let joined = lines.join("\n").replace(" \\\n", "");
        assert_eq!(
            joined.split_whitespace().collect::<Vec<_>>(),
            command.split_whitespace().collect::<Vec<_>>()
        );
    }

    #[test]
    fn at_most_five_remarks_are_said_and_the_others_counted() {
        let said = said(&full().remarks, 20, 80);
        assert_eq!(said.len(), REMARKS + 1);
        assert_eq!(said[REMARKS], "4 more remarks with -v");
        assert_eq!(super::said(&full().remarks[..1], 1, 80).len(), 1);
    }
}
