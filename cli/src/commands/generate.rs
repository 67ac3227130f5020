//! `generate`: completions and manual pages, for packagers.

use std::path::{Path, PathBuf};

use clap_complete::Shell;
use clap_mangen::Man;

use crate::commands::calibrate::methods::OF_METHODS;
use crate::exit::{BUG, Failure};
use crate::output::{Folder, Output, Replace};
use crate::show;
use crate::without_effect::WITHOUT_EFFECT;

/// Writes completions of a shell to standard output, or manual pages into a folder.
#[derive(Debug, clap::Args)]
#[command(after_help = "\
Example:
  stillpoint generate --completions bash > stillpoint.bash
  stillpoint generate --man man1/")]
pub struct Args {
    /// The shell to complete for
    #[arg(long, value_name = "SHELL", required_unless_present_any = ["man", "options"])]
    completions: Option<Shell>,
    /// Write a manual page for every command into this folder
    #[arg(long, value_name = "DIR", conflicts_with = "completions")]
    man: Option<PathBuf>,
    /// Print the options that change no result, and those that not every method of `calibrate` follows
    #[arg(long, conflicts_with_all = ["completions", "man"])]
    options: bool,
    #[command(flatten)]
    replace: Replace,
}

/// Runs the command; `whole` is the command line as a whole.
pub fn run(args: &Args, mut whole: clap::Command) -> Result<(), Failure> {
    if let Some(shell) = args.completions {
        let mut text = Vec::new();
        clap_complete::generate(shell, &mut whole, "stillpoint", &mut text);
        return show::print(&String::from_utf8_lossy(&text));
    }
    if args.options {
        return show::print(&options());
    }
    match &args.man {
        Some(dir) => manual(dir, whole, args.replace),
        None => Ok(()),
    }
}

/// The tables of the manual.
fn options() -> String {
    let mut without = show::texts(&["command", "option", "why it changes no result"]);
    for own in WITHOUT_EFFECT {
        let command = match own.command {
            "" => "every",
            command => command,
        };
        without.add_row([command, own.option, own.reason]);
    }
    let mut methods = show::texts(&["option of calibrate", "methods that follow it"]);
    for own in &OF_METHODS {
        methods.add_row([own.option, &own.in_words()]);
    }
    format!("{without}\n\n{methods}")
}

fn manual(dir: &Path, mut command: clap::Command, replace: Replace) -> Result<(), Failure> {
    command.build();
    let mut pages = vec![("stillpoint".to_owned(), command.clone())];
    let commands = command
        .get_subcommands()
        .filter(|c| !c.is_hide_set() && c.get_name() != "help");
    pages.extend(commands.map(|c| {
        let name = format!("stillpoint-{}", c.get_name());
        (name.clone(), c.clone().name(name))
    }));
    let folder = Folder::make(dir)?;
    let mut claimed = Vec::new();
    for (name, command) in pages {
        let output = Output::claim_in(dir, &format!("{name}.1"), replace, &[])?;
        let mut page = Vec::new();
        let written = Man::new(command).render(&mut page);
        written.map_err(|e| Failure::new(BUG, e.to_string()))?;
        claimed.push((output, page));
    }
    replace.end_if_all_exist()?;
    let written = Output::write_all(claimed);
    drop(folder);
    written
}
