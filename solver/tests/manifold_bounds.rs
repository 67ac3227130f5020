//! Bounds on numbers of blocks that turn, against the dense solver's over plain numbers.

#![allow(clippy::unwrap_used)]

use stillpoint_solver::{
    Constraints, Error, Euclidean, Graph, GraphOptions, Manifold, Mask, Options, Parameters,
    PlanarMotion, Residual, RigidMotion, Rotation, RotationVector, Scalar, check_manifold,
    quaternion, solve, solve_graph,
};

const POINTS: [[f64; 3]; 5] = [
    [1.0, 0.2, -0.4],
    [-0.3, 1.1, 0.6],
    [0.5, -0.9, 1.2],
    [-1.4, 0.1, -0.7],
    [0.2, 0.8, 0.9],
];

/// Where a motion by 0.4, −0.2, 0.7 and a turn lead the points, with errors of some hundredths.
fn seen() -> [[f64; 3]; 5] {
    let q = quaternion::exponential(&[0.3, -0.5, 0.8]);
    std::array::from_fn(|k| {
        let turned = quaternion::rotate(&q, &POINTS[k]);
        let error = |i: usize| 0.05 * ((3 * k + i) as f64).sin();
        std::array::from_fn(|i| turned[i] + [0.4, -0.2, 0.7][i] + error(i))
    })
}

/// Points moved by `(t, q)` and as they are seen.
struct Moved;

impl<D: Scalar> Residual<D> for Moved {
    fn residuals(&self, x: &[D], out: &mut Vec<D>) {
        for (point, seen) in POINTS.iter().zip(seen()) {
            let turned = quaternion::rotate(&x[3..7], &point.map(D::from));
            out.extend((0..3).map(|i| turned[i] + x[i] - seen[i]));
        }
    }
}

/// The same over a place and a rotation vector.
struct MovedByVector;

impl<D: Scalar> Residual<D> for MovedByVector {
    fn residuals(&self, x: &[D], out: &mut Vec<D>) {
        let q = quaternion::exponential(&x[3..]);
        let pose = [x[0], x[1], x[2], q[0], q[1], q[2], q[3]];
        Residual::<D>::residuals(&Moved, &pose, out);
    }
}

#[test]
fn a_bounded_place_of_a_pose_and_its_multiplier_are_those_of_the_dense_problem() {
    let mut graph = Graph::new();
    let start = [0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0];
    let pose = graph.add("pose", (Euclidean(3), Rotation), &start).unwrap();
    graph.bound(pose, 2, f64::NEG_INFINITY, 0.6).unwrap();
    graph.bound(pose, 0, 0.0, 1.0).unwrap();
    graph.add_factor(&[pose], Moved);
    let report = solve_graph(&graph, &GraphOptions::default()).unwrap();
    let start = Parameters::unnamed(&[0.0; 6]);
    let constraints = Constraints::new()
        .bound("x2", f64::NEG_INFINITY, 0.6)
        .bound("x0", 0.0, 1.0);
    let options = Options {
        constraints,
        ..Options::default()
    };
    let dense = solve(&MovedByVector, &start, &Mask::all(6), &options).unwrap();
    assert!(report.termination.converged(), "{report}");
    assert!((report.cost / dense.cost - 1.0).abs() < 1e-10, "{report}");
    assert_eq!(report.value(pose)[2], 0.6);
    assert_eq!(report.active.len(), 1);
    assert_eq!(report.active[0].constraint, "pose.2");
    let multiplier = dense.active[0].multiplier;
    assert!((report.active[0].multiplier / multiplier - 1.0).abs() < 1e-6);
}

#[test]
fn numbers_after_a_rotation_vector_are_bounded_at_their_own_place() {
    // The rotation vector comes first: coordinate 5 of a step is number 5, behind a quaternion number 6.
    for first_of_place in [3, 4] {
        let mut graph = Graph::new();
        let block = match first_of_place {
            3 => graph.add("c", (RotationVector, Euclidean(3)), &[0.0; 6]),
            _ => {
                let start = [1.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0];
                graph.add("c", (Rotation, Euclidean(3)), &start)
            }
        }
        .unwrap();
        graph.bound(block, 5, 0.1, 0.6).unwrap();
        graph.move_within_bounds();
        assert_eq!(graph.value(block)[first_of_place + 2], 0.1);
        struct Turned(usize);
        impl<D: Scalar> Residual<D> for Turned {
            fn residuals(&self, x: &[D], out: &mut Vec<D>) {
                let q = match self.0 {
                    3 => quaternion::exponential(&x[..3]),
                    _ => [x[0], x[1], x[2], x[3]],
                };
                let t = &x[self.0..];
                let pose = [t[0], t[1], t[2], q[0], q[1], q[2], q[3]];
                Residual::<D>::residuals(&Moved, &pose, out);
            }
        }
        graph.add_factor(&[block], Turned(first_of_place));
        let report = solve_graph(&graph, &GraphOptions::default()).unwrap();
        assert!(report.termination.converged(), "{report}");
        assert_eq!(report.value(block)[first_of_place + 2], 0.6);
        assert_eq!(report.active[0].constraint, "c.5");
    }
}

#[test]
fn the_angle_of_a_motion_in_the_plane_can_be_bounded_and_its_place_cannot() {
    struct Near;
    impl<D: Scalar> Residual<D> for Near {
        fn residuals(&self, x: &[D], out: &mut Vec<D>) {
            out.extend([x[0] - 1.0, x[1] - 2.0, x[2] - 1.5, x[2] * x[0] - 1.2]);
        }
    }
    let mut graph = Graph::new();
    let pose = graph.add("pose", PlanarMotion, &[0.0; 3]).unwrap();
    graph.bound(pose, 2, -1.0, 1.0).unwrap();
    graph.add_factor(&[pose], Near);
    let report = solve_graph(&graph, &GraphOptions::default()).unwrap();
    assert_eq!(report.value(pose)[2], 1.0);
    // With the angle at 1 the place along x is the mean of 1 and 1.2.
    assert!((report.value(pose)[0] - 1.1).abs() < 1e-9, "{report}");
    let refused = graph.bound(pose, 0, 0.0, 1.0).unwrap_err();
    assert!(matches!(refused, Error::Unsupported { .. }));
    assert!(refused.to_string().contains("(Euclidean(3), Rotation)"));
    let start = [0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0];
    let rigid = graph.add("rigid", RigidMotion, &start).unwrap();
    assert!(graph.bound(rigid, 2, 0.0, 1.0).is_err());
}

#[test]
fn a_manifold_that_claims_a_plain_number_it_does_not_have_is_found_out() {
    #[derive(Debug)]
    struct Liar;
    impl Manifold for Liar {
        fn numbers(&self) -> usize {
            1
        }
        fn dimension(&self) -> usize {
            1
        }
        fn retract<D: Scalar>(&self, x: &[D], step: &[D], out: &mut [D]) {
            out[0] = x[0] * step[0].exp();
        }
        fn local<D: Scalar>(&self, x: &[D], y: &[D], out: &mut [D]) {
            out[0] = (y[0] / x[0]).ln();
        }
        fn plain(&self, coordinate: usize) -> Option<usize> {
            Some(coordinate)
        }
    }
    assert!(check_manifold(&Liar, &[2.0], &[0.3]) > 0.1);
    assert!(
        check_manifold(
            &(Rotation, Euclidean(2)),
            &[1.0, 0.0, 0.0, 0.0, 5.0, 6.0],
            &[0.1; 5]
        ) < 1e-8
    );
    assert!(check_manifold(&PlanarMotion, &[1.0, 2.0, 0.3], &[0.1; 3]) < 1e-8);
}
