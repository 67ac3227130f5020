//! Output of reports and plots.

use std::path::{Path, PathBuf};

use crate::exit::Failure;
use crate::output::{Folder, Output, Replace};
use crate::report::{Picture, Plot, Report};

/// Options of commands that draw.
#[derive(Clone, Debug, clap::Args)]
#[command(next_help_heading = "Pictures")]
pub struct PictureArgs {
    /// Write a report with tables and plots here: one HTML file that needs no network
    #[arg(long, value_name = "FILE")]
    report: Option<PathBuf>,
    /// Write every plot into this folder, as SVG (for light and dark pages) and as PNG
    #[arg(long, value_name = "DIR")]
    plots: Option<PathBuf>,
}

/// The files claimed for one run.
#[derive(Debug)]
pub struct Pictures {
    report: Option<Output>,
    plots: Vec<PlotFiles>,
    /// After the files, so that it is empty when it goes.
    _folder: Option<Folder>,
}

/// The files of one plot.
#[derive(Debug)]
struct PlotFiles {
    name: String,
    svg: Output,
    png: Output,
}

impl PictureArgs {
    /// Returns the paths of the report and the plots, if given.
    pub fn paths(&self) -> impl Iterator<Item = &Path> {
        let all = self.report.iter().chain(&self.plots);
        all.map(PathBuf::as_path)
    }

    /// Claims the report and the files for each of the plots called `names`.
    pub fn claim(
        &self,
        names: &[&str],
        replace: Replace,
        inputs: &[&Path],
    ) -> Result<Pictures, Failure> {
        let claim = |path: &Path| Output::claim(path, replace, inputs);
        let report = self.report.as_deref().map(claim).transpose()?;
        let mut plots = Vec::new();
        let mut made = None;
        if let Some(folder) = &self.plots {
            made = Some(Folder::make(folder)?);
            for name in names {
                let file = |ending: &str| {
                    Output::claim_in(folder, &format!("{name}{ending}"), replace, inputs)
                };
                plots.push(PlotFiles {
                    name: (*name).to_owned(),
                    svg: file(".svg")?,
                    png: file(".png")?,
                });
            }
        }
        Ok(Pictures {
            report,
            plots,
            _folder: made,
        })
    }
}

impl Pictures {
    /// Returns true if anything is to be drawn.
    pub fn wanted(&self) -> bool {
        self.report.is_some() || !self.plots.is_empty()
    }

    /// Writes the plots whose names were claimed, and the report.
    pub fn write(self, plots: &[(String, Picture)], report: &Report) -> Result<(), Failure> {
        let mut all = Vec::new();
        for files in self.plots {
            // A plot that there is nothing for leaves no file.
            if let Some((_, plot)) = plots.iter().find(|(name, _)| *name == files.name) {
                all.extend([
                    (files.svg, plot.svg().into_bytes()),
                    (files.png, plot.png()?),
                ]);
            }
        }
        if let Some(output) = self.report {
            all.push((output, report.html()?.into_bytes()));
        }
        Output::write_all(all)
    }
}

/// Plots with the names that were claimed for them, in order.
pub fn named<'a>(
    names: impl IntoIterator<Item = &'a str>,
    plots: impl IntoIterator<Item = Plot>,
) -> Vec<(String, Picture)> {
    let names = names.into_iter().map(str::to_owned);
    names.zip(plots.into_iter().map(Picture::from)).collect()
}
