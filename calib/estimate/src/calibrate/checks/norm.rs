//! Check that the norm of specific force determines the parameters of an accelerometer's effects.

use findings::{Finding, Kind};
use nalgebra::{DMatrix, Vector3};
use recording::Error;
use sensor::{Kinematics, Model, PLACES};

use crate::methods::RawUnit;
use crate::residuals::StaticMean;

findings::tuning! {
    /// Singular values of columns of length one below this are zero: identical columns leave some 1e-16.
    NOTHING: f64 = 1e-9;

    /// Fewer placements are refused elsewhere.
    MOST_COLUMNS: usize = 10;

    /// A parameter with more than this share of a combination that the norm does not see belongs to it.
    SHARE: f64 = 0.1;
}

/// Refuses effects whose parameters change the norm of specific force alike, or not at all: a fit to that norm then
/// tells their sum only, and the direction of the corrected force is wrong by the rest. Judged for a perfect sensor, as
/// what a sensor's own misalignments tell of them is nothing to rely on.
pub(in crate::calibrate) fn the_norm_tells_them(
    model: &Model,
    means: &[Vec<StaticMean>],
    unit: &RawUnit,
    gravity: f64,
) -> Result<(), Error> {
    let placed = |mean: &StaticMean| {
        let up = unit.to_si(&mean.raw).normalize();
        let truth = mean.rest.with_signal(model.sensor(), up * gravity);
        (up, truth)
    };
    let placed: Vec<_> = means.iter().flatten().map(placed).collect();
    if placed.len() < MOST_COLUMNS.get() {
        return Ok(());
    }
    let columns = columns(model, &placed);
    let by_norm = |values: &Vec<Vector3<f64>>| -> Vec<f64> {
        let pairs = placed.iter().zip(values);
        pairs.map(|((up, _), e)| up.dot(e)).collect()
    };
    let by_vector =
        |values: &Vec<Vector3<f64>>| values.iter().flat_map(|e| [e.x, e.y, e.z]).collect();
    let unseen = blind(columns.iter().map(|(_, values)| by_norm(values)).collect());
    // What not even the vector would tell is not a matter of the method.
    let unknown = blind(
        columns
            .iter()
            .map(|(_, values)| by_vector(values))
            .collect(),
    );
    let names = columns.iter().enumerate();
    let names = names.filter(|(k, _)| unseen[*k] && !unknown[*k]);
    let names: Vec<&str> = names.filter_map(|(_, (name, _))| name.as_deref()).collect();
    if names.is_empty() {
        return Ok(());
    }
    let found = Finding::of(Kind::EFFECTS_ALIKE).detail("parameters", names.join(", "));
    Err(Error::not_enough(found))
}

/// Computes the change of the force in each placement per unit of each parameter, m/s²: nine of the base, then those of the
/// effects with their names.
fn columns(
    model: &Model,
    placed: &[(Vector3<f64>, Kinematics<f64>)],
) -> Vec<(Option<String>, Vec<Vector3<f64>>)> {
    let mut columns = Vec::new();
    for (i, j) in PLACES.into_iter().filter(|(i, j)| i <= j) {
        let of = |(up, _): &(Vector3<f64>, _)| Vector3::ith(i, up[j]);
        columns.push((None, placed.iter().map(of).collect()));
    }
    for axis in 0..3 {
        columns.push((None, vec![Vector3::ith(axis, 1.0); placed.len()]));
    }
    for effect in model.effects() {
        for (k, param) in effect.params().iter().enumerate() {
            if param.nominal != 0.0 {
                continue;
            }
            let mut p: Vec<f64> = effect.params().iter().map(|p| p.nominal).collect();
            p[k] = effect.typical_of(k);
            let of = |(_, truth): &(_, Kinematics<f64>)| effect.error_f64(truth, &p);
            let name = format!("{}.{}", effect.name(), param.name);
            columns.push((Some(name), placed.iter().map(of).collect()));
        }
    }
    columns
}

/// Marks the columns that belong to a combination in the null space; a column that is zero by itself is not marked.
fn blind(columns: Vec<Vec<f64>>) -> Vec<bool> {
    let length = |column: &[f64]| column.iter().map(|v| v * v).sum::<f64>().sqrt();
    let lengths: Vec<f64> = columns.iter().map(|column| length(column)).collect();
    let shown: Vec<usize> = (0..columns.len()).filter(|&k| lengths[k] > 0.0).collect();
    let rows = columns.first().map_or(0, Vec::len);
    let matrix = DMatrix::from_fn(rows, shown.len(), |i, k| {
        columns[shown[k]][i] / lengths[shown[k]]
    });
    let mut blind = vec![false; columns.len()];
    let finite = matrix.iter().all(|v| v.is_finite());
    if rows < shown.len() || !finite {
        return blind;
    }
    let svd = matrix.svd(false, true);
    let Some(v) = svd.v_t else { return blind };
    for (row, size) in svd.singular_values.iter().enumerate() {
        for (k, place) in shown.iter().enumerate() {
            blind[*place] |= *size < NOTHING.get() && v[(row, k)].abs() > SHARE.get();
        }
    }
    blind
}
