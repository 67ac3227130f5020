//! NIST's file format.

use std::path::{Path, PathBuf};

use crate::needed_data::data_folder;

/// One `.dat` file.
#[derive(Clone, Debug)]
pub struct Dataset {
    /// Name of the problem.
    pub name: String,
    /// Start 1 and start 2.
    pub starts: [Vec<f64>; 2],
    /// Certified parameters.
    pub certified: Vec<f64>,
    /// Certified standard deviations of the parameters.
    pub deviations: Vec<f64>,
    /// Certified residual sum of squares.
    pub sum_of_squares: f64,
    /// Rows of the data: the response, then the predictors.
    pub rows: Vec<Vec<f64>>,
}

/// Why a file could not be read.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum ReadError {
    /// The file cannot be opened.
    #[error("{path}: {source}")]
    Io {
        /// Which file.
        path: PathBuf,
        /// Why.
        source: std::io::Error,
    },
    /// The file is not in NIST's format.
    #[error("{path}: no {what}")]
    Format {
        /// Which file.
        path: PathBuf,
        /// What is missing.
        what: &'static str,
    },
}

impl Dataset {
    /// Reads one file.
    ///
    /// # Errors
    /// A file that is missing, or without starting values, sum of squares or data.
    pub fn read(path: &Path) -> Result<Self, ReadError> {
        let text = std::fs::read_to_string(path).map_err(|source| ReadError::Io {
            path: path.to_owned(),
            source,
        })?;
        Self::parse(&text).map_err(|what| ReadError::Format {
            path: path.to_owned(),
            what,
        })
    }

    fn parse(text: &str) -> Result<Self, &'static str> {
        let name = text
            .lines()
            .find_map(|line| line.strip_prefix("Dataset Name:"))
            .and_then(|rest| rest.split_whitespace().next())
            .ok_or("name")?;
        let table: Vec<Vec<f64>> = text.lines().filter_map(parameter_line).collect();
        if table.is_empty() {
            return Err("starting values");
        }
        let column = |k: usize| table.iter().map(|row| row[k]).collect::<Vec<f64>>();
        let sum_of_squares = text
            .lines()
            .find_map(|line| line.strip_prefix("Residual Sum of Squares:"))
            .and_then(|rest| rest.trim().parse().ok())
            .ok_or("residual sum of squares")?;
        let data = text
            .lines()
            .skip_while(|line| !is_data_heading(line))
            .skip(1);
        let rows: Vec<Vec<f64>> = data.map(numbers).filter(|row| row.len() >= 2).collect();
        if rows.is_empty() {
            return Err("data");
        }
        Ok(Self {
            name: name.to_owned(),
            starts: [column(0), column(1)],
            certified: column(2),
            deviations: column(3),
            sum_of_squares,
            rows,
        })
    }
}

/// `../shared/data/nist` next to the workspace, or `nist` in the folder that `STILLPOINT_DATA` names.
pub fn default_folder() -> PathBuf {
    data_folder().join("nist")
}

/// `b1 = start1 start2 certified deviation`.
fn parameter_line(line: &str) -> Option<Vec<f64>> {
    let (name, values) = line.split_once('=')?;
    let digits = name.trim().strip_prefix('b')?;
    digits.parse::<usize>().ok()?;
    let values = numbers(values);
    (values.len() == 4).then_some(values)
}

/// The second `Data:` line, which names the columns.
fn is_data_heading(line: &str) -> bool {
    line.strip_prefix("Data:")
        .is_some_and(|rest| rest.trim_start().starts_with('y'))
}

/// The numbers of a line; none if a word is not a number.
fn numbers(line: &str) -> Vec<f64> {
    line.split_whitespace()
        .map(str::parse)
        .collect::<Result<_, _>>()
        .unwrap_or_default()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn reads_starts_certified_values_and_data() {
        let text = "Dataset Name:  Toy (Toy.dat)\n  b1 = 500 250 2.5E+02 2.7E+00\n\
                    Residual Sum of Squares:   1.25E-01\nData:   1 Response\nData:   y   x\n 10.07E0 77.6E0\n";
        let data = Dataset::parse(text).unwrap();
        assert_eq!(data.starts, [vec![500.0], vec![250.0]]);
        assert_eq!((data.certified[0], data.sum_of_squares), (250.0, 0.125));
        assert_eq!(data.rows, [[10.07, 77.6]]);
    }

    #[test]
    fn says_what_is_missing() {
        assert_eq!(
            Dataset::parse("Dataset Name: Toy\n").unwrap_err(),
            "starting values"
        );
    }
}
