//! Where reports and plots go.

use std::path::{Path, PathBuf};

use crate::exit::{Failure, OUTPUT};
use crate::output::Output;
use crate::report::{Plot, Report, Theme};

/// Options of commands that draw.
#[derive(Clone, Debug, clap::Args)]
#[command(next_help_heading = "Pictures")]
pub struct PictureArgs {
    /// Write a report with tables and plots here: one HTML file that needs no network
    #[arg(long, value_name = "FILE")]
    report: Option<PathBuf>,
    /// Write every plot into this folder, as SVG (NAME-dark.svg for dark pages) and as PNG
    #[arg(long, value_name = "DIR")]
    plots: Option<PathBuf>,
}

/// The files claimed for one run.
#[derive(Debug)]
pub struct Pictures {
    report: Option<Output>,
    plots: Vec<PlotFiles>,
}

/// The files of one plot.
#[derive(Debug)]
struct PlotFiles {
    light: Output,
    dark: Output,
    png: Output,
}

impl PictureArgs {
    /// Claims the report and the files for each of the plots called `names`.
    pub fn claim(
        &self,
        names: &[&str],
        force: bool,
        inputs: &[&Path],
    ) -> Result<Pictures, Failure> {
        let claim = |path: &Path| Output::claim(path, force, inputs);
        let report = self.report.as_deref().map(claim).transpose()?;
        let mut plots = Vec::new();
        if let Some(folder) = &self.plots {
            std::fs::create_dir_all(folder)
                .map_err(|e| Failure::new(OUTPUT, format!("{}: {e}", folder.display())))?;
            for name in names {
                let file = |ending: &str| claim(&folder.join(format!("{name}{ending}")));
                plots.push(PlotFiles {
                    light: file(".svg")?,
                    dark: file("-dark.svg")?,
                    png: file(".png")?,
                });
            }
        }
        Ok(Pictures { report, plots })
    }
}

impl Pictures {
    /// Whether anything is to be drawn.
    pub fn wanted(&self) -> bool {
        self.report.is_some() || !self.plots.is_empty()
    }

    /// Writes the plots, in the order of the names claimed, and the report.
    pub fn write(self, plots: &[Plot], report: &Report) -> Result<(), Failure> {
        for (files, plot) in self.plots.into_iter().zip(plots) {
            files.light.write(plot.svg(Theme::Light)?.as_bytes())?;
            files.dark.write(plot.svg(Theme::Dark)?.as_bytes())?;
            files.png.write(&plot.png()?)?;
        }
        match self.report {
            Some(output) => output.write(report.html()?.as_bytes()),
            None => Ok(()),
        }
    }
}
