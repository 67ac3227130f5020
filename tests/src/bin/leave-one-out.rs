//! Joint against stepwise on the phone's recordings, each left out in turn.
//!
//! ```text
//! cargo run --release -p stillpoint-tests --bin leave-one-out
//! ```

use std::process::ExitCode;

use stillpoint_tests::leave_one_out::{Contest, HeldOut, leave_one_out};
use stillpoint_tests::phone;

/// The gravity that the recordings' authors used, m/s².
const GRAVITY: f64 = 9.79;

fn main() -> ExitCode {
    if phone::folder().is_none() {
        return ExitCode::SUCCESS;
    }
    match table() {
        Ok(rows) => {
            print(&rows);
            ExitCode::SUCCESS
        }
        Err(error) => {
            eprintln!("{error}");
            ExitCode::FAILURE
        }
    }
}

fn table() -> Result<Vec<HeldOut>, calib::Error> {
    let names = ["rec_1", "rec_2", "rec_3"];
    let recordings: Result<Vec<_>, _> = names
        .iter()
        .map(|name| phone::recording(&format!("multi_position/{name}")))
        .collect();
    leave_one_out(&recordings?, GRAVITY)
}

fn print(rows: &[HeldOut]) {
    println!("held out                what             stepwise     joint   joint - stepwise");
    for row in rows {
        line(&row.recording, "|f| - g, mm/s\u{b2}", &row.norm, 1e3);
        line(&row.recording, "direction, \u{b0}", &row.direction, 1.0);
    }
}

fn line(recording: &str, what: &str, contest: &Contest, unit: f64) {
    println!(
        "{recording:22}  {what:15}  {:8.4}  {:8.4}  {:+.4} \u{b1} {:.4}",
        unit * contest.stepwise,
        unit * contest.joint,
        unit * contest.difference(),
        unit * contest.standard_error
    );
}
