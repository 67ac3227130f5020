//! A sample far from its neighbours, where those around it are quiet: no noise and no motion makes it.

use crate::averages::{NORMAL_OVER_MEDIAN, median};

findings::tuning! {
    /// Samples on each side that show what is usual around one.
    pub AROUND: usize = 50;
    /// Fewest of them at the ends of a recording.
    pub FEWEST_AROUND: usize = 20;

    /// A lone sample leaves its neighbours by so many standard deviations of the samples around it ...
    BEYOND: f64 = 15.0;
    /// ... which stay within so many themselves ...
    QUIET: f64 = 8.0;
    /// ... but for this share: where the device moves or is knocked, nothing stands out, but other lone samples nearby make no place restless ...
    RESTLESS: f64 = 0.06;
    /// ... and its neighbours differ by less than this share of it.
    NEIGHBOURS: f64 = 0.25;
}

/// The smallest changes that an axis can show.
#[derive(Clone, Copy, Debug)]
pub struct Resolution {
    /// The smallest step between neighbours.
    pub step: f64,
    /// The smallest reading that is not zero: half the width of a dead zone, where there is one.
    pub beside_zero: f64,
}

/// Distance of a reading from the nearer neighbour, where it leaves both to the same side and they are alike; else zero.
pub fn size([before, at, after]: [f64; 3]) -> f64 {
    let (left, right) = (at - before, at - after);
    let size = left.abs().min(right.abs());
    match left * right > 0.0 && (after - before).abs() < NEIGHBOURS.get() * size {
        true => size,
        false => 0.0,
    }
}

/// Returns true if a reading that is `size` from its neighbours stands out from the readings around it.
pub fn stands_out(reading: f64, size: f64, around: &[f64], resolution: &Resolution) -> bool {
    let Some(middle) = median(around.iter().copied()) else {
        return false;
    };
    let off: Vec<f64> = around.iter().map(|v| (v - middle).abs()).collect();
    // Readings of zero may be noise within a dead zone: from there to its edge and back nothing stands out.
    let in_dead_zone = reading == 0.0 || around.contains(&0.0);
    let least = match in_dead_zone {
        true => resolution.step.max(resolution.beside_zero),
        false => resolution.step,
    };
    is_far(size, &off, least)
}

/// Returns true if a distance is far beyond those around it, which are quiet; none of them is told from less than `least`.
pub fn is_far(distance: f64, around: &[f64], least: f64) -> bool {
    if around.len() < FEWEST_AROUND.get() {
        return false;
    }
    let Some(usual) = median(around.iter().copied()) else {
        return false;
    };
    let spread = (NORMAL_OVER_MEDIAN * usual).max(least);
    let restless = around.iter().filter(|v| **v > QUIET.get() * spread).count();
    distance > BEYOND.get() * spread && restless as f64 <= RESTLESS.get() * around.len() as f64
}
