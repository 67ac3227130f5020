//! `page`: this program as a page for a browser.

use std::path::PathBuf;

use crate::exit::Failure;
use crate::output::{Output, Replace};

/// The page that `cli/web/build` has written. Documentation with all features is made without.
#[cfg(all(feature = "page", not(doc)))]
const PAGE: Option<&[u8]> = Some(include_bytes!("../../../web/stillpoint.html"));
#[cfg(any(not(feature = "page"), doc))]
const PAGE: Option<&[u8]> = None;

/// Writes a page that calibrates in a browser, for those who have no terminal: one HTML file that needs no network and uploads nothing.
///
/// Open it from the disk, hand it on, or put it on any web server.
#[derive(Debug, clap::Args)]
#[command(after_help = "\
Example:
  stillpoint page -o stillpoint.html")]
pub struct Args {
    /// Write here
    #[arg(short, value_name = "FILE", required = true)]
    output: PathBuf,
    #[command(flatten)]
    replace: Replace,
}

/// Runs the command.
pub fn run(args: &Args) -> Result<(), Failure> {
    let Some(page) = PAGE else {
        return Err(Failure::usage("this build carries no page").advise(
            "take stillpoint.html from a release, or run cli/web/build in the source, which writes it",
        ));
    };
    let output = Output::claim(&args.output, args.replace, &[])?;
    args.replace.end_if_all_exist()?;
    output.write(page)
}
