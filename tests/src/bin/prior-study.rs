//! `cargo run -p stillpoint-tests --bin prior-study [DEVICES] [OTHERS]`: what a prior of the type is worth (500 and 2000).

use stillpoint_tests::prior_study::{POPULATIONS, study};

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let mut numbers = std::env::args().skip(1).map(|arg| arg.parse::<usize>());
    let devices = numbers.next().transpose()?.unwrap_or(500);
    let others = numbers.next().transpose()?.unwrap_or(2000);
    println!(
        "{:26} {:>9} {:>9} {:>9} {:>7} {:>9} {:>8} {:>8}",
        "population", "without", "with", "bound", "ratio", "covers", "flagged", "false"
    );
    for (seed, population) in POPULATIONS.iter().enumerate() {
        let m = study(population, devices, others, seed as u64)?;
        let [without, with, bound] = m.rms;
        println!(
            "{:26} {without:9.4} {with:9.4} {bound:9.4} {:7.4} {:8.2} % {:6.1} % {:6.2} %",
            population.name,
            with / bound,
            100.0 * m.coverage,
            100.0 * m.flagged,
            100.0 * m.false_flags
        );
    }
    Ok(())
}
