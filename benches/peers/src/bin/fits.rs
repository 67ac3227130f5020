//! Fits one problem again and again and prints the Jacobians of one fit: what `instructions.py` runs
//! under valgrind.
//!
//! ```text
//! cargo run --release --bin fits -- SOLVER PROBLEM ROUNDS
//! cargo run --release --bin fits -- list
//! ```

use peers::{Solver, all};

fn main() {
    let words: Vec<String> = std::env::args().skip(1).collect();
    let problems = all(2);
    let [solver, problem, rounds] = &words[..] else {
        problems.iter().for_each(|p| println!("{}", p.name));
        return;
    };
    let solver = Solver::ALL.into_iter().find(|s| s.name() == solver);
    let problem = problems.iter().find(|p| &p.name == problem);
    let (Some(solver), Some(p), Ok(rounds)) = (solver, problem, rounds.parse()) else {
        eprintln!("no such solver, problem or number: {words:?}");
        std::process::exit(2);
    };
    let jacobians: Vec<usize> = (0..rounds)
        .map(|_| solver.fit(&*p.problem, &p.start))
        .collect();
    println!("{}", jacobians.first().unwrap_or(&0));
}
