//! Evaluates the published problems for other programs: one JSON request a line on stdin, one
//! JSON answer a line on stdout.
//!
//! ```text
//! {"list": true}            → [{"group": …, "name": …, "start": […], "lower": […], "upper": […],
//!                               "linear": bool, "minima": […]}, …]
//! {"case": 3, "x": […]}     → {"r": […], "jacobian": [[…], …], "optimality": …}
//! ```
//! With `--held-out` it serves the held-out problems instead, whose list also says what the default
//! variant finds: `"cost"` (`Σ r²`), `"found"` (`x`), `"converged"`, `"reason"`.
//!
//! Infinite bounds are `null`. Values that are not finite come as `null` too.

use std::io::{BufRead, Write};

use serde_json::{Value, json};
use stillpoint_benches::problem_study::{fit, groups};
use stillpoint_tests::problems::{self, Case};

fn main() -> std::io::Result<()> {
    let held_out = std::env::args().any(|word| word == "--held-out");
    let cases: Vec<(&str, Case)> = if held_out {
        let all = problems::held_out::all().into_iter();
        all.map(|case| ("held out", case)).collect()
    } else {
        let groups = groups().into_iter();
        groups
            .flat_map(|(group, cases)| cases.into_iter().map(move |c| (group, c)))
            .collect()
    };
    let mut out = std::io::stdout().lock();
    for line in std::io::stdin().lock().lines() {
        let answer = match serde_json::from_str::<Value>(&line?) {
            Ok(request) => answer(&cases, &request),
            Err(error) => json!({ "error": error.to_string() }),
        };
        writeln!(out, "{answer}")?;
        out.flush()?;
    }
    Ok(())
}

fn answer(cases: &[(&str, Case)], request: &Value) -> Value {
    if request.get("list").is_some() {
        return Value::Array(
            cases
                .iter()
                .map(|(group, case)| describe(group, case))
                .collect(),
        );
    }
    let case = request["case"].as_u64().and_then(|k| cases.get(k as usize));
    let x: Option<Vec<f64>> = request["x"]
        .as_array()
        .map(|x| x.iter().map(|v| v.as_f64().unwrap_or(f64::NAN)).collect());
    match (case, x) {
        (Some((_, case)), Some(x)) if x.len() == case.start.len() => evaluate(case, &x),
        _ => json!({ "error": "no such case, or x of the wrong length" }),
    }
}

fn describe(group: &str, case: &Case) -> Value {
    let found = match group {
        "held out" => fit(case).ok(),
        _ => None,
    };
    json!({
        "cost": found.as_ref().map(|report| 2.0 * report.cost),
        "found": found.as_ref().map(|report| report.parameters.values().to_vec()),
        "converged": found.as_ref().map(|report| report.termination.converged()),
        "reason": found.as_ref().map(|report| format!("{:?}", report.termination)),
        "group": group, "name": case.name, "start": case.start, "lower": case.lower,
        "upper": case.upper, "linear": !case.linear.is_empty(), "minima": case.minima,
    })
}

fn evaluate(case: &Case, x: &[f64]) -> Value {
    let free: Vec<usize> = (0..x.len()).collect();
    let mut r = Vec::new();
    let jacobian = case.problem.linearize(x, &free, &mut r);
    let rows: Vec<Vec<f64>> = (0..r.len())
        .map(|i| free.iter().map(|&k| jacobian[(i, k)]).collect())
        .collect();
    json!({ "r": r, "jacobian": rows, "optimality": case.optimality(x) })
}
