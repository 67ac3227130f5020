//! Curves in files: columns of numbers with a model written as an expression, or NIST's format.

use std::path::{Path, PathBuf};

use sensor::expression::{Expression, FUNCTIONS};
use solver::{Parameters, Residual, Scalar, lit};

/// Residuals `model(x; b) − y` of a table of numbers.
#[derive(Clone, Debug)]
pub struct Curve {
    response: Expression,
    model: Expression,
    rows: Vec<Vec<f64>>,
    columns: usize,
    /// Names of the parameters, in the order they appear.
    pub parameters: Vec<String>,
}

/// Why a curve could not be read.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum CurveError {
    /// The file cannot be read.
    #[error("{path}: {source}")]
    Io {
        /// Which file.
        path: PathBuf,
        /// Why.
        source: std::io::Error,
    },
    /// A line that is not numbers, or of another length.
    #[error("{path}, line {line}: {what}")]
    Line {
        /// Which file.
        path: PathBuf,
        /// Number of the line, from 1.
        line: usize,
        /// What is wrong.
        what: String,
    },
    /// A model that is not `RESPONSE = EXPRESSION`.
    #[error("model '{model}': {what}")]
    Model {
        /// The model.
        model: String,
        /// What is wrong.
        what: String,
    },
    /// A start that does not fit the parameters.
    #[error("start '{start}': {what}")]
    Start {
        /// The start.
        start: String,
        /// What is wrong.
        what: String,
    },
}

impl Curve {
    /// Numbers under a line of names, split by commas, semicolons or white space, and a model such as
    /// `y = b1*exp(-b2*x)`: names that are no columns are parameters. The left side may be an
    /// expression of columns (`ln(y) = …`).
    ///
    /// # Errors
    /// A file that cannot be read, a line that is not numbers, a model that is not an expression.
    pub fn read(path: &Path, model: &str) -> Result<Self, CurveError> {
        let text = std::fs::read_to_string(path).map_err(|source| CurveError::Io {
            path: path.to_owned(),
            source,
        })?;
        let (columns, rows) = table(path, &text)?;
        Self::new(&columns, rows, model)
    }

    /// The same from columns in memory.
    ///
    /// # Errors
    /// A model that is not an expression.
    pub fn new(columns: &[String], rows: Vec<Vec<f64>>, model: &str) -> Result<Self, CurveError> {
        let refuse = |what: String| CurveError::Model {
            model: model.to_owned(),
            what,
        };
        let (left, right) = model
            .split_once('=')
            .ok_or_else(|| refuse("RESPONSE = EXPRESSION expected, as y = b1*exp(-b2*x)".into()))?;
        let parameters = parameters_of(right, columns);
        if parameters.is_empty() {
            return Err(refuse("no parameter: every name is a column".into()));
        }
        let names: Vec<&str> = columns
            .iter()
            .chain(&parameters)
            .map(String::as_str)
            .collect();
        let parsed = |text: &str, names: &[&str]| {
            let error =
                |e: sensor::expression::ParseError| refuse(findings::Finding::from(e).to_string());
            Expression::parse(text.trim(), names).map_err(error)
        };
        Ok(Self {
            response: parsed(left, &names[..columns.len()])?,
            model: parsed(right, &names)?,
            columns: columns.len(),
            rows,
            parameters,
        })
    }

    /// A start written as `b1=1,b2=0.1`.
    ///
    /// # Errors
    /// A word that is not `NAME=NUMBER`, and a parameter without a value.
    pub fn start(&self, text: &str) -> Result<Parameters, CurveError> {
        let refuse = |what: String| CurveError::Start {
            start: text.to_owned(),
            what,
        };
        let mut values = vec![None; self.parameters.len()];
        for word in text.split(',').filter(|word| !word.trim().is_empty()) {
            let pair = word
                .split_once('=')
                .map(|(name, value)| (name.trim(), value.trim().parse::<f64>()));
            let Some((name, Ok(value))) = pair else {
                return Err(refuse(format!("'{word}' is not NAME=NUMBER")));
            };
            let place = self.parameters.iter().position(|p| p == name);
            let place =
                place.ok_or_else(|| refuse(format!("the model has no parameter {name}")))?;
            values[place] = Some(value);
        }
        let mut start = Parameters::new();
        for (name, value) in self.parameters.iter().zip(values) {
            let value = value.ok_or_else(|| refuse(format!("no value for {name}")))?;
            start.push(name.clone(), "", value);
        }
        Ok(start)
    }
}

impl<D: Scalar> Residual<D> for Curve {
    fn residuals(&self, b: &[D], out: &mut Vec<D>) {
        for row in &self.rows {
            let variable = |k: usize| {
                if k < self.columns {
                    lit::<D>(row[k])
                } else {
                    b[k - self.columns]
                }
            };
            let response: f64 = self.response.eval(&|k: usize| row[k]);
            out.push(self.model.eval(&variable) - lit::<D>(response));
        }
    }
}

/// Names of a model that are neither columns nor functions nor `pi`, in the order they appear.
fn parameters_of(model: &str, columns: &[String]) -> Vec<String> {
    let mut found: Vec<String> = Vec::new();
    let is_part = |c: char| c.is_alphanumeric() || c == '_';
    for word in model.split(|c: char| !is_part(c)) {
        let is_name = word.starts_with(|c: char| c.is_alphabetic() || c == '_');
        let known = word == "pi" || FUNCTIONS.contains(&word) || columns.iter().any(|c| c == word);
        // 1e5 begins with a digit and is no name.
        if is_name && !known && !found.iter().any(|f| f == word) {
            found.push(word.to_owned());
        }
    }
    found
}

/// Names and rows; columns without names are `y`, `x`, `x2`, ….
fn table(path: &Path, text: &str) -> Result<(Vec<String>, Vec<Vec<f64>>), CurveError> {
    let (mut names, mut rows) = (Vec::new(), Vec::<Vec<f64>>::new());
    for (number, line) in text.lines().enumerate() {
        let line = line.trim();
        if line.is_empty() || line.starts_with('#') {
            continue;
        }
        let words: Vec<&str> = line
            .split(|c: char| c == ',' || c == ';' || c.is_whitespace())
            .filter(|word| !word.is_empty())
            .collect();
        let numbers: Result<Vec<f64>, _> = words.iter().map(|word| word.parse()).collect();
        match numbers {
            Ok(row) if rows.first().is_none_or(|first| first.len() == row.len()) => rows.push(row),
            Err(_) if names.is_empty() && rows.is_empty() => {
                names = words.iter().map(|&word| word.to_owned()).collect();
            }
            Ok(row) => {
                let what = format!("{} numbers, {} in the first row", row.len(), rows[0].len());
                return Err(CurveError::Line {
                    path: path.to_owned(),
                    line: number + 1,
                    what,
                });
            }
            Err(error) => {
                let what = format!("not numbers: {error}");
                return Err(CurveError::Line {
                    path: path.to_owned(),
                    line: number + 1,
                    what,
                });
            }
        }
    }
    let width = rows.first().map_or(0, Vec::len);
    if width == 0 || (!names.is_empty() && names.len() != width) {
        let what = format!("{} names for {width} columns", names.len());
        return Err(CurveError::Line {
            path: path.to_owned(),
            line: 1,
            what,
        });
    }
    if names.is_empty() {
        let name = |k: usize| match k {
            0 => "y".to_owned(),
            1 => "x".to_owned(),
            k => format!("x{k}"),
        };
        names = (0..width).map(name).collect();
    }
    Ok((names, rows))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_model_written_as_text_is_fitted() {
        let (columns, rows) = table(Path::new("toy"), "t,y\n0,2\n1,1\n2,0.5\n").unwrap();
        let curve = Curve::new(&columns, rows, "y = a*exp(-k*t)").unwrap();
        assert_eq!(curve.parameters, ["a", "k"]);
        let start = curve.start("a=1,k=0.1").unwrap();
        let fit =
            solver::solve(&curve, &start, &solver::Mask::all(2), &Default::default()).unwrap();
        assert!((fit.parameters.values()[1] - 2f64.ln()).abs() < 1e-12);
        assert!(curve.start("a=1").is_err());
        assert!(Curve::new(&columns, Vec::new(), "y = t").is_err());
    }
}
