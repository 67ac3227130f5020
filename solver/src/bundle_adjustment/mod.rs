//! Bundle adjustment: `min ½ Σ ‖π(camera, point) − seen‖²` over cameras and points, from the files of "Bundle adjustment in the
//! large": `cameras points observations`, then `camera point u v` of every observation, then 9 numbers of every camera and 3 of
//! every point.
//!
//! ```
//! use stillpoint_solver::bundle_adjustment::Bundle;
//!
//! let text = "1 1 1\n0 0 2.0 -4.0\n0 0 0 0 0 -5 100 0 0\n0.1 -0.2 0\n";
//! let graph = Bundle::read(text)?.graph(true, true)?;
//! assert!(graph.cost(graph.values()) < 1e-20);
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```
//!
//! Source: Agarwal, Snavely, Seitz and Szeliski, "Bundle adjustment in the large", 2010; the layout is that of its data sets.

mod reprojection;

use std::fmt::Write;

pub use reprojection::{AnalyticReprojection, Reprojection};

use crate::error::Error;
use crate::graph::{Block, Euclidean, Graph, Manifold};

/// A bundle adjustment.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Bundle {
    /// Cameras `(ω, t, f, k₁, k₂)` at the start.
    pub cameras: Vec<[f64; 9]>,
    /// Points at the start.
    pub points: Vec<[f64; 3]>,
    /// Camera, point and where it was seen, in pixels.
    pub seen: Vec<(u32, u32, [f64; 2])>,
}

/// A file that is no bundle adjustment.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum ReadError {
    /// Fewer numbers than the first line says.
    #[error("the file ends early, after {0} numbers")]
    Short(usize),
    /// A word that is no finite number.
    #[error("number {place}: `{word}` is no finite number")]
    Number {
        /// Its place among the words, from 1.
        place: usize,
        /// The word.
        word: String,
    },
    /// A camera or a point that the first line does not announce.
    #[error("number {place}: {found} is out of range, there are {count}")]
    Index {
        /// Its place among the words, from 1.
        place: usize,
        /// The value found.
        found: f64,
        /// Their number.
        count: u32,
    },
}

/// The numbers of a file one after the other.
struct Numbers<'a> {
    words: std::str::SplitWhitespace<'a>,
    place: usize,
}

impl Numbers<'_> {
    fn next(&mut self) -> Result<f64, ReadError> {
        let word = self.words.next().ok_or(ReadError::Short(self.place))?;
        self.place += 1;
        let value = word.parse::<f64>().ok().filter(|value| value.is_finite());
        value.ok_or_else(|| ReadError::Number {
            place: self.place,
            word: word.to_owned(),
        })
    }

    /// A whole number below `count`.
    fn index(&mut self, count: u32) -> Result<u32, ReadError> {
        let found = self.next()?;
        let is_index = found >= 0.0 && found < f64::from(count) && found.fract() == 0.0;
        match is_index {
            true => Ok(found as u32),
            false => Err(ReadError::Index {
                place: self.place,
                found,
                count,
            }),
        }
    }

    fn array<const N: usize>(&mut self) -> Result<[f64; N], ReadError> {
        let mut all = [0.0; N];
        for value in &mut all {
            *value = self.next()?;
        }
        Ok(all)
    }
}

impl Bundle {
    /// Reads a file's text.
    ///
    /// # Errors
    /// [`ReadError`]: a word that is not a number, an index out of range, and a file that ends early.
    pub fn read(text: &str) -> Result<Self, ReadError> {
        let words = text.split_whitespace();
        let mut numbers = Numbers { words, place: 0 };
        let cameras = numbers.index(u32::MAX)?;
        let points = numbers.index(u32::MAX)?;
        let seen = numbers.index(u32::MAX)?;
        let mut bundle = Self::default();
        for _ in 0..seen {
            let (camera, point) = (numbers.index(cameras)?, numbers.index(points)?);
            bundle.seen.push((camera, point, numbers.array()?));
        }
        for _ in 0..cameras {
            bundle.cameras.push(numbers.array()?);
        }
        for _ in 0..points {
            bundle.points.push(numbers.array()?);
        }
        Ok(bundle)
    }

    /// The file's text.
    pub fn write(&self) -> String {
        let mut text = format!(
            "{} {} {}\n",
            self.cameras.len(),
            self.points.len(),
            self.seen.len()
        );
        for (camera, point, [u, v]) in &self.seen {
            let _ = writeln!(text, "{camera} {point} {u:e} {v:e}");
        }
        let numbers = self.cameras.iter().flatten();
        for number in numbers.chain(self.points.iter().flatten()) {
            let _ = writeln!(text, "{number:e}");
        }
        text
    }

    /// The graph, with blocks `c0, c1, …` and `p0, p1, …`; `analytic` for the own Jacobian. With
    /// `fixed` the first camera and the distance of the second along x are held: seven numbers
    /// (place, attitude and scale) that nothing determines.
    ///
    /// # Errors
    /// A start that is not finite.
    pub fn graph(&self, analytic: bool, fixed: bool) -> Result<Graph<'static>, Error> {
        self.graph_on(Euclidean(9), analytic, fixed)
    }

    /// Like [`graph`](Self::graph), with cameras on a manifold of nine numbers and steps. The own Jacobian
    /// is by the numbers, as a flat one steps.
    ///
    /// # Errors
    /// A start that is not finite.
    pub fn graph_on(
        &self,
        camera: impl Manifold + Copy,
        analytic: bool,
        fixed: bool,
    ) -> Result<Graph<'static>, Error> {
        let mut graph = Graph::new();
        let cameras: Vec<Block> = self
            .cameras
            .iter()
            .enumerate()
            .map(|(k, c)| graph.add(format!("c{k}"), camera, c))
            .collect::<Result<_, _>>()?;
        let points: Vec<Block> = self
            .points
            .iter()
            .enumerate()
            .map(|(k, p)| graph.add(format!("p{k}"), Euclidean(3), p))
            .collect::<Result<_, _>>()?;
        for &(camera, point, seen) in &self.seen {
            let blocks = [cameras[camera as usize], points[point as usize]];
            if analytic {
                graph.add_factor(&blocks, AnalyticReprojection(seen));
            } else {
                graph.add_factor(&blocks, Reprojection(seen));
            }
        }
        if fixed {
            if let Some(&first) = cameras.first() {
                (0..6).for_each(|k| graph.hold_part(first, k));
            }
            if let Some(&second) = cameras.get(1) {
                graph.hold_part(second, 3);
            }
        }
        Ok(graph)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_is_written_is_read() {
        let bundle = Bundle {
            cameras: vec![[0.1, 0.2, 0.3, 0.0, 0.0, -5.0, 100.0, 1e-3, 0.0]],
            points: vec![[1.0, 2.0, 3.0], [0.5, 0.0, -0.25]],
            seen: vec![(0, 1, [3.5, -4.25]), (0, 0, [1.0, 2.0])],
        };
        assert_eq!(Bundle::read(&bundle.write()), Ok(bundle));
    }

    #[test]
    fn what_is_wrong_is_named() {
        for (text, words) in [
            ("1 1", "the file ends early, after 2 numbers"),
            ("1 1 1\n0 3 0 0", "number 5: 3 is out of range, there are 1"),
            ("1 1 1\n0 0 inf 0", "number 6: `inf` is no finite number"),
            (
                "-1 1 1",
                "number 1: -1 is out of range, there are 4294967295",
            ),
        ] {
            assert_eq!(Bundle::read(text).unwrap_err().to_string(), words);
        }
    }
}
