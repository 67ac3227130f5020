//! Many decays `y = a exp(−b t)` at twenty instants, in one call and one after the other:
//! `cargo run --release -p stillpoint-solver --example batch [COUNT] [THREADS]`.

use std::time::Instant;

use stillpoint_solver::{
    BatchOptions, Mask, Options, Parameters, Residual, Scalar, solve, solve_batch,
};

const INSTANTS: usize = 20;

struct Decay([f64; INSTANTS]);

impl<D: Scalar> Residual<D> for Decay {
    #[inline(always)]
    fn residuals(&self, x: &[D], out: &mut Vec<D>) {
        for (k, y) in self.0.iter().enumerate() {
            let t = 0.2 * k as f64;
            out.push(x[0] * (-x[1] * t).exp() - *y);
        }
    }
}

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let mut words = std::env::args().skip(1);
    let count: usize = words.next().map_or(Ok(100_000), |word| word.parse())?;
    let threads: usize = words.next().map_or(Ok(1), |word| word.parse())?;
    let mut state = 1u64;
    let mut noise = move || {
        state = state
            .wrapping_mul(6_364_136_223_846_793_005)
            .wrapping_add(1);
        (state >> 11) as f64 / (1u64 << 53) as f64 - 0.5
    };
    let problems: Vec<Decay> = (0..count)
        .map(|_| {
            let (a, b) = (2.0 + noise(), 0.8 + noise());
            Decay(std::array::from_fn(|k| {
                a * (-b * 0.2 * k as f64).exp() + 0.05 * noise()
            }))
        })
        .collect();
    let starts: Vec<f64> = (0..count).flat_map(|_| [1.0, 1.0]).collect();

    let begin = Instant::now();
    let options = BatchOptions {
        threads,
        ..BatchOptions::default()
    };
    let batch = solve_batch(&problems, 2, &starts, &options)?;
    let together = begin.elapsed().as_secs_f64();

    let (start, mask, options) = (
        Parameters::unnamed(&[1.0, 1.0]),
        Mask::all(2),
        Options::default(),
    );
    let begin = Instant::now();
    let mut farthest = 0.0f64;
    for (problem, cost) in problems.iter().zip(&batch.costs) {
        let fit = solve(problem, &start, &mask, &options)?;
        farthest = farthest.max((fit.cost / cost - 1.0).abs());
    }
    let apart = begin.elapsed().as_secs_f64();
    let converged = batch.terminations.iter().filter(|t| t.converged()).count();
    println!(
        "{count} problems, {converged} at a minimum: {:.2} µs each in one call, {:.2} µs one after the other, ratio {:.3}; \
         costs differ by {farthest:.1e}",
        1e6 * together / count as f64,
        1e6 * apart / count as f64,
        together / apart
    );
    Ok(())
}
