//! Variants compared: a table, CSV, and a performance profile as a picture.

use stillpoint_solver::{DualNum, Jet, Measure, Parameters, Variant, compare, from_fn, spread};

fn main() -> Result<(), std::io::Error> {
    let data = [(0.0, 2.0), (1.0, 1.2), (2.0, 0.8), (3.0, 0.4)];
    let decay = from_fn(|x: &[Jet], out: &mut Vec<Jet>| {
        out.extend(data.iter().map(|&(t, y)| x[0] * (-x[1] * t).exp() - y));
    });
    let starts: Vec<Parameters> = spread(&[0.5, 0.0], &[10.0, 5.0], 10)
        .iter()
        .map(|x| Parameters::unnamed(x))
        .collect();
    let table = compare(&decay, &starts, &Variant::all());
    print!("{}", table.summary());
    let picture = std::env::temp_dir().join("profile.svg");
    std::fs::write(&picture, table.performance_svg(Measure::Evaluations))?;
    println!("performance profile: {}", picture.display());
    Ok(())
}
