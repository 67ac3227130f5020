//! `truth-study`: every effect by every method, simulated, calibrated, applied to another recording.
//!
//! ```text
//! cargo run --release -p stillpoint-tests --bin truth-study -- [PLACEMENTS] [SEEDS] [NAME]
//! ```
//! A line per effect and method: reduced χ² of force at static intervals and of direction through turns, with the
//! effect and without it, or the refusal. PLACEMENTS (300) are those of the recording that is judged; SEEDS (3) devices
//! are added up.
#![allow(clippy::print_stdout)]

use calib::calibrate::Method;
use stillpoint_tests::one_truth::{Chi2, End, trials};

fn main() {
    let mut arguments = std::env::args().skip(1);
    let mut number = |default: u64| {
        let given = arguments.next().and_then(|text| text.parse().ok());
        given.unwrap_or(default)
    };
    let (placements, seeds) = (number(300) as usize, number(3));
    let only = std::env::args().nth(3);
    println!("effect, method: force, direction (without the effect: force, direction)");
    for (place, trial) in trials().into_iter().enumerate() {
        let name = trial.effect.name();
        if only.as_ref().is_some_and(|only| only != name) {
            continue;
        }
        for method in [Method::Stepwise, Method::Joint] {
            let (mut with, mut without) = ([Chi2::default(); 2], [Chi2::default(); 2]);
            let mut said = None;
            for seed in 1..=seeds {
                match trial.run(method, 100 * place as u64 + seed, placements) {
                    End::Left {
                        with: own,
                        without: none,
                    } => {
                        for k in 0..2 {
                            add(&mut with[k], &own[k]);
                            add(&mut without[k], &none[k]);
                        }
                    }
                    End::Refused(why) => said = Some(format!("refused: {why}")),
                    End::Failed(error) => said = Some(format!("FAILED: {error}")),
                }
            }
            let text = said.unwrap_or_else(|| {
                let [a, b] = with.map(|c| c.reduced());
                let [c, d] = without.map(|c| c.reduced());
                let verdict = [a, b].iter().all(|v| (0.9..=1.1).contains(v));
                let mark = if verdict {
                    ""
                } else {
                    "  <-- beyond 0.9 to 1.1"
                };
                format!("{a:.3}, {b:.3} ({c:.2}, {d:.2}){mark}")
            });
            println!("{name}, {method:?}: {text}");
        }
    }
}

fn add(sum: &mut Chi2, own: &Chi2) {
    sum.sum += own.sum;
    sum.dof += own.dof;
}
