//! A made-up bundle adjustment: cameras on a ring look at points in a ball.

use std::f64::consts::TAU;

use rand::{RngExt, SeedableRng};
use rand_chacha::ChaCha8Rng;
use solver::Residual;
use solver::bundle_adjustment::{Bundle, Reprojection};

/// `cameras` on a ring of radius 6, `points` in a unit ball, each seen by `views` cameras (all, where
/// there are fewer) with an error of half a pixel; the start is off by some percent.
pub fn ring(cameras: usize, points: usize, views: usize, seed: u64) -> Bundle {
    let mut rng = ChaCha8Rng::seed_from_u64(seed);
    let mut noise = move |size: f64| {
        // The sum of twelve uniform numbers less six: nearly a Gaussian.
        let sum: f64 = (0..12).map(|_| rng.random_range(0.0..1.0)).sum();
        size * (sum - 6.0)
    };
    let mut choose = ChaCha8Rng::seed_from_u64(seed + 1);
    let mut bundle = Bundle::default();
    for k in 0..cameras {
        let angle = TAU * k as f64 / cameras as f64;
        // Half a turn at most: near a full one, plain rotation vectors cannot turn every way.
        let angle = if 2 * k > cameras { angle - TAU } else { angle };
        // Turned about y so that the camera looks along −z at the centre.
        let w = [noise(0.02), -angle + noise(0.02), noise(0.02)];
        let t = [noise(0.05), noise(0.05), -6.0 + noise(0.2)];
        bundle.cameras.push([
            w[0],
            w[1],
            w[2],
            t[0],
            t[1],
            t[2],
            800.0 + noise(10.0),
            noise(0.01),
            noise(0.001),
        ]);
    }
    for _ in 0..points {
        bundle.points.push([(); 3].map(|()| noise(0.5)));
    }
    for (p, point) in bundle.points.iter().enumerate() {
        let mut chosen: Vec<usize> = (0..cameras).collect();
        let views = views.min(cameras);
        for k in 0..views {
            let other = choose.random_range(k..cameras);
            chosen.swap(k, other);
        }
        chosen.truncate(views);
        chosen.sort_unstable();
        for camera in chosen {
            let mut x = bundle.cameras[camera].to_vec();
            x.extend(point);
            let mut place = Vec::new();
            Residual::<f64>::residuals(&Reprojection([0.0; 2]), &x, &mut place);
            let seen = [place[0] + noise(0.5), place[1] + noise(0.5)];
            bundle.seen.push((camera as u32, p as u32, seen));
        }
    }
    for camera in &mut bundle.cameras {
        for (k, value) in camera.iter_mut().enumerate() {
            *value += match k {
                0..3 => noise(0.01),
                3..6 => noise(0.05),
                6 => noise(10.0),
                _ => noise(0.001),
            };
        }
    }
    for point in &mut bundle.points {
        point.iter_mut().for_each(|value| *value += noise(0.05));
    }
    bundle
}
