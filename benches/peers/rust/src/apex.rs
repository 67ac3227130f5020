//! The crate apex-solver: its explicit Schur complement, its matrix-free one, its sparse Cholesky.

use std::error::Error;

use apex_solver::apex_io::{G2oLoader, GraphLoader};
use apex_solver::core::noise::NoiseModel;
use apex_solver::core::problem::Problem;
use apex_solver::factors::Factor;
use apex_solver::factors::pose::BetweenFactor;
use apex_solver::linalg::LinearSolverType;
use apex_solver::optimizer::levenberg_marquardt::{LevenbergMarquardt, LevenbergMarquardtConfig};
use apex_solver::{JacobianMode, ManifoldType};
use faer::MatMut;
use nalgebra_apex::{DMatrix, DVector};

use crate::{Outcome, bal, camera, processor_seconds};

struct Reprojection([f64; 2]);

impl Factor for Reprojection {
    fn linearize(&self, x: &[&[f64]], residual: &mut [f64], jacobian: Option<MatMut<'_, f64>>) {
        let mut own = [[0.0; 12]; 2];
        let asked = jacobian.is_some().then_some(&mut own);
        residual.copy_from_slice(&camera::project(x[0], x[1], &self.0, asked));
        let Some(mut jacobian) = jacobian else { return };
        for (r, row) in own.iter().enumerate() {
            for (c, value) in row.iter().enumerate() {
                jacobian[(r, c)] = *value;
            }
        }
    }

    fn residual_dim(&self) -> usize {
        2
    }

    fn jacobian_shape(&self) -> (usize, usize) {
        (2, 12)
    }
}

/// The first damping is Ceres'; the ending that of the other solvers.
fn config(config: LevenbergMarquardtConfig) -> LevenbergMarquardtConfig {
    config
        .with_max_iterations(200)
        .with_cost_tolerance(1e-10)
        .with_parameter_tolerance(1e-300)
        .with_gradient_tolerance(1e-300)
}

fn run(
    mut problem: Problem,
    config: LevenbergMarquardtConfig,
    begin: f64,
) -> Result<Outcome, Box<dyn Error>> {
    let found = LevenbergMarquardt::with_config(config).optimize(&mut problem)?;
    Ok(Outcome {
        start: found.initial_cost,
        cost: found.final_cost,
        steps: found.iterations,
        seconds: processor_seconds() - begin,
        ending: format!("{:?}", found.status).replace(' ', "_"),
    })
}

/// A bundle adjustment with an own Jacobian.
pub fn bundle(file: &str, fixed: bool, method: &str) -> Result<Outcome, Box<dyn Error>> {
    let bundle = bal::read(file)?;
    let begin = processor_seconds();
    let mut problem = Problem::new(JacobianMode::Sparse);
    if method == "dense" {
        problem = Problem::new(JacobianMode::Dense);
    }
    let mut add =
        |values: &[f64]| problem.add_variable(ManifoldType::RN, DVector::from_column_slice(values));
    let cameras: Vec<_> = bundle.cameras.iter().map(|c| add(c)).collect();
    let points: Vec<_> = bundle.points.iter().map(|p| add(p)).collect();
    points.iter().for_each(|&p| problem.mark_for_elimination(p));
    for &(c, p, seen) in &bundle.seen {
        problem.add_residual_block(&[cameras[c], points[p]], Box::new(Reprojection(seen)), None);
    }
    if fixed {
        (0..6).for_each(|k| problem.fix_variable(cameras[0], k));
        problem.fix_variable(cameras[1], 3);
    }
    let solver = match method {
        "sparse" => LinearSolverType::ExplicitSparseSchur,
        "dense" => LinearSolverType::ExplicitDenseSchur,
        "implicit" => LinearSolverType::ImplicitSparseSchur,
        _ => return Err("sparse, dense or implicit".into()),
    };
    let config = config(LevenbergMarquardtConfig::for_bundle_adjustment().with_damping(1e-4));
    run(problem, config.with_linear_solver_type(solver), begin)
}

/// A pose graph with the crate's own factor `log(T_ij⁻¹ T_i⁻¹ T_j)`, the first pose held.
pub fn poses(file: &str) -> Result<Outcome, Box<dyn Error>> {
    let graph = G2oLoader::load(file)?;
    let begin = processor_seconds();
    let mut problem = Problem::new(JacobianMode::Sparse);
    let mut keys = std::collections::HashMap::new();
    let planar = !graph.vertices_se2.is_empty();
    let mut ids: Vec<usize> = graph
        .vertices_se2
        .keys()
        .chain(graph.vertices_se3.keys())
        .copied()
        .collect();
    ids.sort_unstable();
    for id in &ids {
        let key = if let Some(v) = graph.vertices_se2.get(id) {
            let values = [v.x(), v.y(), v.theta()];
            problem.add_variable(ManifoldType::SE2, DVector::from_column_slice(&values))
        } else {
            let pose = &graph.vertices_se3[id].pose;
            let (q, t) = (pose.rotation_quaternion(), pose.translation());
            let values = [t.x, t.y, t.z, q.w, q.i, q.j, q.k];
            problem.add_variable(ManifoldType::SE3, DVector::from_column_slice(&values))
        };
        keys.insert(*id, key);
    }
    (0..if planar { 3 } else { 6 }).for_each(|k| problem.fix_variable(keys[&ids[0]], k));
    for edge in &graph.edges_se2 {
        let noise = DMatrix::from_column_slice(3, 3, edge.information.as_slice());
        let factor = Box::new(BetweenFactor::new(edge.measurement.clone()));
        let ends = [keys[&edge.from], keys[&edge.to]];
        problem.add_residual_block_with_noise(
            &ends,
            factor,
            None,
            NoiseModel::from_information(noise)?,
        );
    }
    for edge in &graph.edges_se3 {
        let noise = DMatrix::from_column_slice(6, 6, edge.information.as_slice());
        let factor = Box::new(BetweenFactor::new(edge.measurement.clone()));
        let ends = [keys[&edge.from], keys[&edge.to]];
        problem.add_residual_block_with_noise(
            &ends,
            factor,
            None,
            NoiseModel::from_information(noise)?,
        );
    }
    let tuned = if planar {
        LevenbergMarquardtConfig::for_2d_pose_graph()
    } else {
        LevenbergMarquardtConfig::default()
    };
    let config = config(tuned).with_linear_solver_type(LinearSolverType::SparseCholesky);
    run(problem, config, begin)
}
