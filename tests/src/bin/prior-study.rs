//! `cargo run -p stillpoint-tests --bin prior-study [DEVICES] [OTHERS]`: what a prior of the type is worth (500 and 2000).

use stillpoint_tests::prior_study::{POPULATIONS, study};

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let mut numbers = std::env::args().skip(1).map(|arg| arg.parse::<usize>());
    let devices = numbers.next().transpose()?.unwrap_or(500);
    let others = numbers.next().transpose()?.unwrap_or(2000);
    println!(
        "rms errors in session errors; devices that are not flagged, then all: over the bound, and over the"
    );
    println!(
        "bound of those who know the type, flag one device in a hundred and leave it to its session"
    );
    println!(
        "{:26} without    with   bound   ratio |    with   ratio  flagging |  covers   flagged  false",
        "population"
    );
    for (seed, population) in POPULATIONS.iter().enumerate() {
        let m = study(population, devices, others, seed as u64)?;
        let [without, with, bound] = m.rms;
        let [_, all, best] = m.rms_of_all;
        println!(
            "{:26} {without:7.4} {with:7.4} {bound:7.4} {:7.4} | {all:7.4} {:7.4}   {:7.4} | {:6.2} % {:6.1} % {:5.2} %",
            population.name,
            with / bound,
            all / best,
            all / m.flagging_bound,
            100.0 * m.coverage,
            100.0 * m.flagged,
            100.0 * m.false_flags
        );
    }
    Ok(())
}
