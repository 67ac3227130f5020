//! Made-up pose graphs: a walk with edges to poses passed shortly and long before.

use rand::{RngExt, SeedableRng};
use rand_chacha::ChaCha8Rng;
use solver::pose_graph::{PlanarEdge, PoseGraph, SpatialEdge};
use solver::quaternion::{exponential, multiply, rotate, rotate_back};

/// Sigma of the measured way and turn, in m and rad, and of the same in the start.
const WAY: f64 = 0.05;
const TURN: f64 = 0.01;

/// Poses of a lap of [`Loops::Laps`].
const LAP: usize = 100;

/// To which poses passed long before every twelfth pose has an edge.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Loops {
    /// Any of all before: whatever the order of elimination, one pose of nearly every such edge is left for
    /// a dense matrix.
    Anywhere,
    /// One about a lap of 100 poses before, as by a vehicle on its rounds; one in a hundred of them any of all before.
    Laps,
}

/// For every pose its partners: the one before, of most one of the last ten, and of every twelfth pose
/// one passed long before.
fn partners(rng: &mut ChaCha8Rng, k: usize, loops: Loops) -> Vec<usize> {
    let mut partners = vec![k - 1];
    if k > 10 && rng.random_range(0..100) < 92 {
        partners.push(k - rng.random_range(2..10));
    }
    if k > 30 && k.is_multiple_of(12) {
        partners.push(match loops {
            Loops::Laps if k >= LAP + 10 && !k.is_multiple_of(1_200) => {
                k - LAP - rng.random_range(0..10)
            }
            _ => rng.random_range(0..k - 10),
        });
    }
    partners
}

fn noise(rng: &mut ChaCha8Rng, size: f64) -> f64 {
    let sum: f64 = (0..12).map(|_| rng.random_range(0.0..1.0)).sum();
    size * (sum - 6.0)
}

/// A walk of `count` poses in the plane.
pub fn planar(count: usize, seed: u64, loops: Loops) -> PoseGraph {
    let mut rng = ChaCha8Rng::seed_from_u64(seed);
    let rng = &mut rng;
    let mut truth = vec![[0.0; 3]];
    let mut graph = PoseGraph::default();
    graph.planar.push([0.0; 3]);
    for k in 1..count {
        let before = truth[k - 1];
        let turn = noise(rng, 0.2);
        truth.push(after(before, [1.0, 0.0, turn]));
        for partner in partners(rng, k, loops) {
            let (a, b) = (truth[partner], truth[k]);
            let (sine, cosine) = a[2].sin_cos();
            let (east, north) = (b[0] - a[0], b[1] - a[1]);
            let measured = [
                cosine * east + sine * north + noise(rng, WAY),
                cosine * north - sine * east + noise(rng, WAY),
                b[2] - a[2] + noise(rng, TURN),
            ];
            let mut root = [0.0; 9];
            (root[0], root[4], root[8]) = (1.0 / WAY, 1.0 / WAY, 1.0 / TURN);
            if partner == k - 1 {
                let start = after(graph.planar[k - 1], measured);
                graph.planar.push(start);
            }
            let edge = PlanarEdge { measured, root };
            graph.planar_edges.push((partner as u32, k as u32, edge));
        }
    }
    near_the_truth(&mut graph.planar, &truth);
    graph
}

fn after(a: [f64; 3], step: [f64; 3]) -> [f64; 3] {
    let (sine, cosine) = a[2].sin_cos();
    [
        a[0] + cosine * step[0] - sine * step[1],
        a[1] + sine * step[0] + cosine * step[1],
        a[2] + step[2],
    ]
}

/// The way walked by dead reckoning leaves the truth by its length to the power 1.5; a start that far
/// off has other minima. So the start keeps a share of that error.
fn near_the_truth(start: &mut [[f64; 3]], truth: &[[f64; 3]]) {
    let share = (30.0 / start.len() as f64).min(1.0);
    for (s, t) in start.iter_mut().zip(truth) {
        (0..3).for_each(|k| s[k] = t[k] + share * (s[k] - t[k]));
    }
}

/// A walk of `count` poses in space.
pub fn spatial(count: usize, seed: u64, loops: Loops) -> PoseGraph {
    let mut rng = ChaCha8Rng::seed_from_u64(seed);
    let rng = &mut rng;
    let mut truth = vec![[0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0]];
    let mut graph = PoseGraph::default();
    for k in 1..count {
        let turn = [(); 3].map(|()| noise(rng, 0.15));
        let way = [1.0, noise(rng, 0.1), noise(rng, 0.1)];
        truth.push(moved(&truth[k - 1], &way, &turn));
        for partner in partners(rng, k, loops) {
            let (a, b) = (&truth[partner], &truth[k]);
            let way = rotate_back(&a[3..], &[b[0] - a[0], b[1] - a[1], b[2] - a[2]]);
            let inverse = [a[3], -a[4], -a[5], -a[6]];
            let turned = multiply(&inverse, &b[3..]);
            let exact = [
                way[0], way[1], way[2], turned[0], turned[1], turned[2], turned[3],
            ];
            let error = [(); 3].map(|()| noise(rng, TURN));
            let mut measured = moved(&exact, &[0.0; 3], &error);
            measured[..3].iter_mut().for_each(|t| *t += noise(rng, WAY));
            let mut root = [0.0; 36];
            for i in 0..6 {
                root[i * 7] = 1.0 / if i < 3 { WAY } else { TURN };
            }
            let edge = SpatialEdge { measured, root };
            graph.spatial_edges.push((partner as u32, k as u32, edge));
        }
    }
    // The truth, off by a few times the error of an edge.
    for pose in &truth {
        let turn = [(); 3].map(|()| noise(rng, 4.0 * TURN));
        let way = [(); 3].map(|()| noise(rng, 4.0 * WAY));
        graph.spatial.push(moved(pose, &way, &turn));
    }
    graph.spatial[0] = truth[0];
    graph
}

fn moved(a: &[f64; 7], way: &[f64; 3], turn: &[f64; 3]) -> [f64; 7] {
    let t = rotate(&a[3..], way);
    let q = multiply(&a[3..], &exponential(turn));
    [
        a[0] + t[0],
        a[1] + t[1],
        a[2] + t[2],
        q[0],
        q[1],
        q[2],
        q[3],
    ]
}

#[cfg(test)]
mod tests {
    use solver::pose_graph::{EdgeError, Indefinite};

    use super::*;

    #[test]
    fn walks_are_the_same_after_a_file() {
        for graph in [
            planar(20, 3, Loops::Anywhere),
            spatial(20, 3, Loops::Anywhere),
        ] {
            let read = PoseGraph::read(&graph.write(), Indefinite::Refused).unwrap();
            let costs = [&graph, &read].map(|poses| {
                let graph = poses.graph(EdgeError::Apart).unwrap();
                graph.cost(graph.values())
            });
            assert!((costs[0] / costs[1] - 1.0).abs() < 1e-9, "{costs:?}");
        }
    }
}
