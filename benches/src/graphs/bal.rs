//! Bundle adjustment files: `cameras points observations`, then `camera point u v` of every
//! observation, then 9 numbers of every camera and 3 of every point.

use std::fmt::Write;

use solver::{Block, Error, Euclidean, Graph, Manifold};

use super::reprojection::{AnalyticReprojection, Reprojection};

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

impl Bundle {
    /// Reads a file's text.
    ///
    /// # Errors
    /// A word that is not a number, an index out of range, and a file that ends early.
    pub fn read(text: &str) -> Result<Self, String> {
        let mut words = text.split_whitespace();
        let mut next = || {
            let word = words.next().ok_or("the file ends early")?;
            word.parse::<f64>()
                .map_err(|_| format!("{word} is not a number"))
        };
        let (cameras, points, seen) = (next()? as usize, next()? as usize, next()? as usize);
        let mut bundle = Self::default();
        for _ in 0..seen {
            let (camera, point) = (next()? as usize, next()? as usize);
            if camera >= cameras || point >= points {
                return Err(format!("camera {camera} or point {point} is out of range"));
            }
            let place = [next()?, next()?];
            bundle.seen.push((camera as u32, point as u32, place));
        }
        for _ in 0..cameras {
            let mut camera = [0.0; 9];
            for value in &mut camera {
                *value = next()?;
            }
            bundle.cameras.push(camera);
        }
        for _ in 0..points {
            bundle.points.push([next()?, next()?, next()?]);
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

    /// As [`graph`](Self::graph), with cameras on a manifold of nine numbers and steps. The own Jacobian
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
    use super::super::cameras::ring;
    use super::*;

    #[test]
    fn what_is_written_is_read() {
        let bundle = ring(4, 12, 3, 1);
        assert_eq!(Bundle::read(&bundle.write()), Ok(bundle));
        assert!(Bundle::read("1 1 1\n0 3 0 0").is_err());
    }
}
