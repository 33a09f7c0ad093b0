//! The program `exact-kalman`.

use std::process::ExitCode;

fn main() -> ExitCode {
    exact_kalman::cli::run(std::env::args_os())
}
