//! Files of g2o: `VERTEX_SE2 id x y angle`, `EDGE_SE2 i j x y angle information…`, `VERTEX_SE3:QUAT id x y z qx qy qz qw`,
//! `EDGE_SE3:QUAT i j x y z qx qy qz qw information…`, `FIX id`; the information is the upper triangle, row after row.

use std::collections::HashMap;
use std::fmt::Write;

use super::PoseGraph;
use super::edge::{PlanarEdge, SpatialEdge};
use super::information::{Indefinite, root};
use super::order::chained;
use crate::graph::quaternion::{conjugate, multiply, rotate, rotate_back};

/// A line that is no line of a pose graph.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[error("line {line}: {kind}")]
pub struct ReadError {
    /// Its number, from 1.
    pub line: usize,
    /// The mistake in it.
    pub kind: ReadErrorKind,
}

/// Mistakes of a line.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum ReadErrorKind {
    /// Fewer or more numbers than the kind of line has.
    #[error("{found} numbers, {needed} belong to {tag}")]
    Count {
        /// The first word of the line.
        tag: String,
        /// Numbers of such a line.
        needed: usize,
        /// Numbers found.
        found: usize,
    },
    /// A word that is no finite number.
    #[error("`{0}` is no finite number")]
    Number(String),
    /// A number of a pose that is no whole number.
    #[error("`{0}` is no number of a pose")]
    Id(f64),
    /// The same pose twice.
    #[error("pose {0} is given twice")]
    Repeated(i64),
    /// An edge from a pose to itself.
    #[error("an edge from pose {0} to itself")]
    Loop(i64),
    /// A quaternion of length zero.
    #[error("the quaternion has the length zero")]
    Quaternion,
    /// An information matrix that is not positive definite.
    #[error(
        "the information matrix is not positive definite; Indefinite::WithoutWrongTerms leaves terms in the wrong place out, \
         Indefinite::PlanarTermsMoved moves them"
    )]
    Indefinite,
}

/// Poses by their numbers in the file, known or not.
struct Poses<P> {
    places: HashMap<i64, u32>,
    known: Vec<Option<P>>,
}

impl<P: Copy> Poses<P> {
    fn new() -> Self {
        Self {
            places: HashMap::new(),
            known: Vec::new(),
        }
    }

    fn place(&mut self, id: i64) -> u32 {
        *self.places.entry(id).or_insert_with(|| {
            self.known.push(None);
            self.known.len() as u32 - 1
        })
    }

    fn add(&mut self, id: i64, pose: P) -> Result<(), ReadErrorKind> {
        let place = self.place(id) as usize;
        match self.known[place].replace(pose) {
            None => Ok(()),
            Some(_) => Err(ReadErrorKind::Repeated(id)),
        }
    }

    fn ends(&mut self, a: f64, b: f64) -> Result<(u32, u32), ReadErrorKind> {
        let (a, b) = (id(a)?, id(b)?);
        match a == b {
            true => Err(ReadErrorKind::Loop(a)),
            false => Ok((self.place(a), self.place(b))),
        }
    }
}

fn id(value: f64) -> Result<i64, ReadErrorKind> {
    match value.fract() == 0.0 && value.abs() < 9e15 {
        true => Ok(value as i64),
        false => Err(ReadErrorKind::Id(value)),
    }
}

/// The part of a file that has been read.
struct Reader {
    graph: PoseGraph,
    planar: Poses<[f64; 3]>,
    spatial: Poses<[f64; 7]>,
    fixed: Vec<i64>,
    indefinite: Indefinite,
}

impl Reader {
    fn line(&mut self, text: &str) -> Result<(), ReadErrorKind> {
        let mut words = text.split_whitespace();
        let tag = words.next().unwrap_or("");
        let needed = match tag {
            "VERTEX_SE2" => 4,
            "VERTEX_SE3:QUAT" => 8,
            "EDGE_SE2" => 11,
            "EDGE_SE3:QUAT" => 30,
            "FIX" => 1,
            _ => return Ok(()),
        };
        let values = words.map(number).collect::<Result<Vec<f64>, _>>()?;
        if values.len() != needed && (tag != "FIX" || values.is_empty()) {
            return Err(ReadErrorKind::Count {
                tag: tag.to_owned(),
                needed,
                found: values.len(),
            });
        }
        match (tag, values.as_slice()) {
            ("VERTEX_SE2", &[number, x, y, angle]) => self.planar.add(id(number)?, [x, y, angle]),
            ("VERTEX_SE3:QUAT", [number, v @ ..]) => self.spatial.add(id(*number)?, pose(v)?),
            ("EDGE_SE2", [a, b, x, y, angle, upper @ ..]) => {
                let (a, b) = self.planar.ends(*a, *b)?;
                let root = root(upper, self.indefinite).ok_or(ReadErrorKind::Indefinite)?;
                let measured = [*x, *y, *angle];
                let edge = PlanarEdge { measured, root };
                self.graph.planar_edges.push((a, b, edge));
                Ok(())
            }
            ("EDGE_SE3:QUAT", [a, b, more @ ..]) => {
                let (a, b) = self.spatial.ends(*a, *b)?;
                let (motion, upper) = more.split_at(7);
                let root = root(upper, self.indefinite).ok_or(ReadErrorKind::Indefinite)?;
                let measured = pose(motion)?;
                let edge = SpatialEdge { measured, root };
                self.graph.spatial_edges.push((a, b, edge));
                Ok(())
            }
            (_, numbers) => {
                for &number in numbers {
                    self.fixed.push(id(number)?);
                }
                Ok(())
            }
        }
    }

    fn finished(mut self) -> PoseGraph {
        let (graph, fixed) = (&mut self.graph, &self.fixed);
        let held = |places: &HashMap<i64, u32>| {
            let mut held: Vec<u32> = fixed
                .iter()
                .filter_map(|id| places.get(id).copied())
                .collect();
            held.sort_unstable();
            held.dedup();
            held
        };
        graph.planar_held = held(&self.planar.places);
        graph.spatial_held = held(&self.spatial.places);
        let edges = &graph.planar_edges;
        graph.planar = chained(&mut self.planar.known, edges, [0.0; 3], after_planar);
        let origin = [0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0];
        let edges = &graph.spatial_edges;
        graph.spatial = chained(&mut self.spatial.known, edges, origin, after_spatial);
        self.graph
    }
}

/// The pose at the other end of a planar edge.
fn after_planar(a: &[f64; 3], edge: &PlanarEdge, forward: bool) -> [f64; 3] {
    let [x, y, angle] = edge.measured;
    let turned = |angle: f64, x: f64, y: f64| {
        let (sine, cosine) = angle.sin_cos();
        [cosine * x - sine * y, sine * x + cosine * y]
    };
    let (way, turn) = match forward {
        true => ([x, y], angle),
        false => (turned(-angle, -x, -y), -angle),
    };
    let moved = turned(a[2], way[0], way[1]);
    [a[0] + moved[0], a[1] + moved[1], a[2] + turn]
}

/// The pose at the other end of an edge in space.
fn after_spatial(a: &[f64; 7], edge: &SpatialEdge, forward: bool) -> [f64; 7] {
    let (m, q) = (&edge.measured, &edge.measured[3..]);
    let (way, turn) = match forward {
        true => ([m[0], m[1], m[2]], [q[0], q[1], q[2], q[3]]),
        false => (rotate_back(q, &[-m[0], -m[1], -m[2]]), conjugate(q)),
    };
    let moved = rotate(&a[3..], &way);
    let [w, x, y, z] = multiply(&a[3..], &turn);
    [
        a[0] + moved[0],
        a[1] + moved[1],
        a[2] + moved[2],
        w,
        x,
        y,
        z,
    ]
}

impl PoseGraph {
    /// Reads a file's text. Lines of other kinds are passed over; poses that only edges name are where the edges lead.
    ///
    /// # Errors
    /// [`ReadError`]: a line with too few or too many numbers, what is no finite number, a pose given twice, and an
    /// information matrix that is not positive definite, unless `indefinite` says what to do with it.
    pub fn read(text: &str, indefinite: Indefinite) -> Result<Self, ReadError> {
        let mut reader = Reader {
            graph: Self::default(),
            planar: Poses::new(),
            spatial: Poses::new(),
            fixed: Vec::new(),
            indefinite,
        };
        for (number, line) in text.lines().enumerate() {
            reader.line(line).map_err(|kind| ReadError {
                line: number + 1,
                kind,
            })?;
        }
        Ok(reader.finished())
    }

    /// The text of a file.
    pub fn write(&self) -> String {
        let mut text = String::new();
        let quaternion = |p: &[f64; 7]| {
            format!(
                "{:e} {:e} {:e} {:e} {:e} {:e} {:e}",
                p[0], p[1], p[2], p[4], p[5], p[6], p[3]
            )
        };
        for (k, p) in self.planar.iter().enumerate() {
            let _ = writeln!(text, "VERTEX_SE2 {k} {:e} {:e} {:e}", p[0], p[1], p[2]);
        }
        for (k, p) in self.spatial.iter().enumerate() {
            let _ = writeln!(text, "VERTEX_SE3:QUAT {k} {}", quaternion(p));
        }
        for id in self.planar_held.iter().chain(&self.spatial_held) {
            let _ = writeln!(text, "FIX {id}");
        }
        for (a, b, edge) in &self.planar_edges {
            let [x, y, angle] = edge.measured;
            let _ = write!(text, "EDGE_SE2 {a} {b} {x:e} {y:e} {angle:e}");
            write_information(&mut text, &edge.root, 3);
        }
        for (a, b, edge) in &self.spatial_edges {
            let _ = write!(text, "EDGE_SE3:QUAT {a} {b} {}", quaternion(&edge.measured));
            write_information(&mut text, &edge.root, 6);
        }
        text
    }
}

fn number(word: &str) -> Result<f64, ReadErrorKind> {
    let value = word.parse::<f64>().ok().filter(|value| value.is_finite());
    value.ok_or_else(|| ReadErrorKind::Number(word.to_owned()))
}

/// `(t, w, x, y, z)`, the quaternion of unit length, from the file's `(t, x, y, z, w)`.
fn pose(v: &[f64]) -> Result<[f64; 7], ReadErrorKind> {
    let length = v[3..7].iter().map(|q| q * q).sum::<f64>().sqrt();
    if length == 0.0 || !length.is_finite() {
        return Err(ReadErrorKind::Quaternion);
    }
    let q = |k: usize| v[k] / length;
    Ok([v[0], v[1], v[2], q(6), q(3), q(4), q(5)])
}

fn write_information(text: &mut String, root: &[f64], n: usize) {
    for i in 0..n {
        for k in i..n {
            let entry: f64 = (0..=i).map(|j| root[j * n + i] * root[j * n + k]).sum();
            let _ = write!(text, " {entry:e}");
        }
    }
    text.push('\n');
}

#[cfg(test)]
mod tests {
    use super::*;

    const SPACE: &str = "VERTEX_SE3:QUAT 7 0 0 0 0 0 0 1\n\
        EDGE_SE3:QUAT 7 3 1 2 3 0 0 1 1 1 0 0 0 0 0 1 0 0 0 0 1 0 0 0 4 0 0 4 0 4\n\
        EDGE_SE3:QUAT 9 3 0 0 1 0 0 0 1 1 0 0 0 0 0 1 0 0 0 0 1 0 0 0 4 0 0 4 0 4\n";

    #[test]
    fn what_is_written_is_read() {
        let space = PoseGraph::read(SPACE, Indefinite::Refused).unwrap();
        let again = PoseGraph::read(&space.write(), Indefinite::Refused).unwrap();
        assert_eq!(again.spatial_edges.len(), 2);
        for (a, b) in space.spatial.iter().zip(&again.spatial) {
            assert!(a.iter().zip(b).all(|(a, b)| (a - b).abs() < 1e-15));
        }
        let plane =
            "VERTEX_SE2 0 1 2 3\nVERTEX_SE2 1 2 2 3\nFIX 1\nEDGE_SE2 0 1 1 0 0.5 2 0.5 0 2 0 9\n";
        let plane = PoseGraph::read(plane, Indefinite::Refused).unwrap();
        assert_eq!(plane.planar_held, [1]);
        let again = PoseGraph::read(&plane.write(), Indefinite::Refused).unwrap();
        let roots = [&plane, &again].map(|g| g.planar_edges[0].2.root);
        assert!(
            roots[0]
                .iter()
                .zip(roots[1])
                .all(|(a, b)| (a - b).abs() < 1e-14)
        );
    }

    #[test]
    fn poses_that_only_edges_name_are_where_the_edges_lead() {
        let graph = PoseGraph::read(SPACE, Indefinite::Refused).unwrap();
        let r = 0.5f64.sqrt();
        let due = [
            [1.0, 2.0, 3.0, r, 0.0, 0.0, r],
            [1.0, 2.0, 2.0, r, 0.0, 0.0, r],
        ];
        for (pose, due) in graph.spatial[1..].iter().zip(due) {
            assert!(
                pose.iter().zip(due).all(|(a, b)| (a - b).abs() < 1e-12),
                "{pose:?}"
            );
        }
    }

    #[test]
    fn a_bad_line_is_named() {
        let of = |text: &str| PoseGraph::read(text, Indefinite::Refused).unwrap_err();
        let first = "VERTEX_SE2 0 0 0 0\n";
        for (line, kind) in [
            ("VERTEX_SE2 1 0 0", "3 numbers, 4 belong to VERTEX_SE2"),
            ("VERTEX_SE2 1 0 x 0", "`x` is no finite number"),
            ("VERTEX_SE2 1 0 nan 0", "`nan` is no finite number"),
            ("VERTEX_SE2 0 0 1 0", "pose 0 is given twice"),
            ("VERTEX_SE2 1.5 0 1 0", "`1.5` is no number of a pose"),
            (
                "EDGE_SE2 0 0 1 2 3 1 0 0 1 0 1",
                "an edge from pose 0 to itself",
            ),
            (
                "VERTEX_SE3:QUAT 1 0 0 0 0 0 0 0",
                "the quaternion has the length zero",
            ),
        ] {
            let error = of(&format!("{first}{line}"));
            assert_eq!(error.to_string(), format!("line 2: {kind}"));
        }
        let error = of("EDGE_SE2 0 1 1 2 3 1 5 0 1 0 1");
        assert_eq!(error.kind, ReadErrorKind::Indefinite);
    }
}
