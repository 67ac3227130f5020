//! A start without a guess: the readings' model is linear in `T`, `T b` and the field, but for a factor.

use findings::{Finding, Kind};
use nalgebra::{DMatrix, Matrix3, SymmetricEigen, Vector3};
use recording::Error;
use sensor::Sensor;

use super::placement::{HeadingChange, Placement};

/// Unknowns before the fields: `T` and `T b`.
const SHARED: usize = 12;

/// Starting point of the solver.
#[derive(Clone, Debug)]
pub struct Start {
    /// `T`, of determinant 1, or for the strength given.
    pub t: Matrix3<f64>,
    /// `b`.
    pub bias: Vector3<f64>,
    /// Strength of the field in the first recording.
    pub strength: f64,
    /// Inclination of each recording's field, rad, positive downwards.
    pub inclinations: Vec<f64>,
    /// Heading of each placement, rad.
    pub headings: Vec<f64>,
}

/// Placements with known headings against the first of them.
struct Chain {
    recording: usize,
    /// Place of each, and its heading.
    members: Vec<(usize, f64)>,
}

/// Solves `T M − T b = Rᵀ h` by the smallest singular vector.
///
/// Placements that turns connect share a horizontal field and give three rows; one by itself gives the vertical one. With
/// the opposite sign everything fits as well: `T` is taken to be right-handed.
///
/// # Errors
/// [`Error::NotEnough`] where there are fewer rows than unknowns.
pub fn linear_start(
    placements: &[Placement],
    changes: &[HeadingChange],
    recordings: usize,
    strength: Option<f64>,
) -> Result<Start, Error> {
    let chains = chains(placements, changes);
    let used = placements.iter().filter(|p| p.is_used);
    let scale = used.map(|p| p.mean.norm()).sum::<f64>() / placements.len() as f64;
    let unknowns = SHARED + recordings + 2 * chains.iter().filter(|c| c.members.len() > 1).count();
    let mut normal = DMatrix::zeros(unknowns, unknowns);
    let mut rows = 0;
    let mut add = |row: &DMatrix<f64>| {
        normal += row.transpose() * row;
        rows += row.nrows();
    };
    let mut horizontal = SHARED + recordings;
    for chain in &chains {
        let connected = chain.members.len() > 1;
        for &(place, heading) in &chain.members {
            let placement = &placements[place];
            if !placement.is_used {
                continue;
            }
            let axes = turned(placement, heading);
            let mut row = reading_rows(&axes, &(placement.mean / scale), unknowns);
            row[(2, SHARED + chain.recording)] = -1.0;
            if connected {
                row[(0, horizontal)] = -1.0;
                row[(1, horizontal + 1)] = -1.0;
                add(&row);
            } else {
                add(&row.rows(2, 1).into_owned());
            }
        }
        horizontal += if connected { 2 } else { 0 };
    }
    if rows < unknowns {
        return Err(Error::not_enough(
            Finding::of(Kind::ATTITUDES_TOO_FEW)
                .of_sensor(Sensor::Magnetometer)
                .count("count", placements.len()),
        ));
    }
    let x = smallest(normal);
    let t = Matrix3::from_fn(|i, j| x[3 * i + j]) / scale;
    let offset = Vector3::new(x[9], x[10], x[11]);
    let sign = t.determinant().signum();
    let (t, offset) = (t * sign, offset * sign);
    let bias = t.try_inverse().map(|inverse| inverse * offset);
    let bias = bias.ok_or_else(|| {
        let found = Finding::of(Kind::ATTITUDES_LEAVE_OPEN).of_sensor(Sensor::Magnetometer);
        Error::not_enough(found)
    })?;
    Ok(scaled(placements, &chains, recordings, (t, bias), strength))
}

/// The three rows of a reading in level axes, by `T` and `T b`.
fn reading_rows(axes: &Matrix3<f64>, mean: &Vector3<f64>, unknowns: usize) -> DMatrix<f64> {
    let mut row = DMatrix::zeros(3, unknowns);
    for level in 0..3 {
        for i in 0..3 {
            for j in 0..3 {
                row[(level, 3 * i + j)] = axes[(i, level)] * mean[j];
            }
            row[(level, 9 + i)] = -axes[(i, level)];
        }
    }
    row
}

/// The chain's level frame in body axes.
fn turned(placement: &Placement, heading: f64) -> Matrix3<f64> {
    let (sine, cosine) = heading.sin_cos();
    let about = Matrix3::new(cosine, sine, 0.0, -sine, cosine, 0.0, 0.0, 0.0, 1.0);
    placement.reference() * about
}

fn smallest(normal: DMatrix<f64>) -> Vec<f64> {
    let eigen = SymmetricEigen::new(normal);
    let place = eigen.eigenvalues.imin();
    eigen.eigenvectors.column(place).iter().copied().collect()
}

fn chains(placements: &[Placement], changes: &[HeadingChange]) -> Vec<Chain> {
    let mut chains: Vec<Chain> = Vec::new();
    for (place, placement) in placements.iter().enumerate() {
        let before = place
            .checked_sub(1)
            .and_then(|before| changes.iter().find(|change| change.from == before));
        match (before, chains.last_mut()) {
            (Some(change), Some(chain)) => {
                let heading = chain.members.last().map_or(0.0, |(_, heading)| *heading);
                chain.members.push((place, heading + change.angle));
            }
            _ => chains.push(Chain {
                recording: placement.recording,
                members: vec![(place, 0.0)],
            }),
        }
    }
    chains
}

/// Field and headings by a first model, with the model brought to the scale asked for.
fn scaled(
    placements: &[Placement],
    chains: &[Chain],
    recordings: usize,
    (t, bias): (Matrix3<f64>, Vector3<f64>),
    strength: Option<f64>,
) -> Start {
    let corrected = |p: &Placement| t * (p.mean - bias);
    let of_first = placements.iter().filter(|p| p.recording == 0 && p.is_used);
    let norms: Vec<f64> = of_first.map(|p| corrected(p).norm()).collect();
    let norm = norms.iter().sum::<f64>() / norms.len().max(1) as f64;
    let factor = match strength {
        Some(strength) => strength / norm,
        None => t.determinant().abs().cbrt().recip(),
    };
    let mut headings = vec![0.0; placements.len()];
    let mut sums = vec![[0.0; 2]; recordings];
    for chain in chains {
        // The chain's heading is that at which its readings agree best.
        let mut level = Vector3::zeros();
        for &(place, heading) in &chain.members {
            let placement = &placements[place];
            if placement.is_used {
                level += turned(placement, heading).transpose() * corrected(placement);
            }
        }
        let north = -level.y.atan2(level.x);
        for &(place, heading) in &chain.members {
            headings[place] = heading + north;
        }
        sums[chain.recording][0] += level.xy().norm();
        sums[chain.recording][1] -= level.z;
    }
    Start {
        t: t * factor,
        bias,
        strength: strength.unwrap_or(norm * factor),
        inclinations: sums
            .iter()
            .map(|[level, down]| down.atan2(*level))
            .collect(),
        headings,
    }
}
