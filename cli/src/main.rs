//! The program: [`stillpoint_cli`] with the arguments of the process.

use std::process::ExitCode;

fn main() -> ExitCode {
    ExitCode::from(stillpoint_cli::run(std::env::args_os()))
}
