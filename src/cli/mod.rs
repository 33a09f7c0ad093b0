//! Floor 7 · The program: verbs, files, exit codes.
//!
//! stdout is data, stderr is talk. A verb is a file of its own, with its arguments and what it does.

mod cases;
mod certificate;
mod check;
mod declared;
mod effort;
mod enclosed;
mod estimate;
mod exit;
mod explain;
mod identify;
mod input;
mod interrupt;
mod judge;
mod length;
mod manifest;
mod notation;
mod numbers;
mod parallel;
mod price;
mod progress;
mod prove;
mod proved;
mod proved_interval;
mod reporting;
mod reproduce;
mod rest;
mod shown;
mod solve;
mod spec;
mod stability;
mod steady;
mod steps;
mod tier;
mod verify;
mod verify_steady;

use std::ffi::OsString;
use std::process::ExitCode;

use clap::{Parser, Subcommand, ValueEnum};
use exit::{Exit, Trouble};

use crate::report::printable;

const EXAMPLES: &str = "\
Examples:
  exact-kalman check                                    the built-in f64 filters, side by side
  exact-kalman check -- python3 my_filter.py            your program, on the whole suite of cases
  exact-kalman solve examples/cases/nile.json --last    exact answers, correctly rounded

Results go to standard output, talk to standard error.
Exit codes: 0 all agree; 1 some finding; 2 trouble with the command line or the input;
3 nothing wrong, but something undecided or too long; 130 interrupted by Ctrl-C";

/// The exact reference for Kalman filtering: exact values, and a judge for any program
#[derive(Parser, Debug)]
#[command(name = "exact-kalman", version, after_help = EXAMPLES, max_term_width = 100)]
struct Arguments {
    #[command(subcommand)]
    verb: Verb,
}

#[derive(Subcommand, Debug)]
enum Verb {
    Solve(solve::Solve),
    Estimate(estimate::Estimate),
    Check(check::Check),
    Judge(judge::JudgeAnswers),
    Cases(cases::ListCases),
    Explain(explain::Explain),
    Spec(spec::Spec),
    Identify(identify::Identify),
    Stability(stability::Stability),
    Steady(steady::Steady),
    Reproduce(reproduce::Reproduce),
    Prove(prove::Prove),
    Verify(verify::Verify),
}

/// How results are printed.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, ValueEnum)]
enum Format {
    /// For people.
    #[default]
    Text,
    /// For programs.
    Json,
}

/// Runs the program with the given arguments, its name first.
pub fn run(arguments: impl IntoIterator<Item = OsString>) -> ExitCode {
    let arguments = match Arguments::try_parse_from(arguments) {
        Ok(arguments) => arguments,
        Err(error) => {
            // Nothing is to be done if even this cannot be printed.
            let _ = error.print();
            return if error.use_stderr() { Exit::Trouble.into() } else { Exit::Clean.into() };
        }
    };
    let outcome = match arguments.verb {
        Verb::Solve(verb) => verb.run(),
        Verb::Estimate(verb) => verb.run(),
        Verb::Check(verb) => verb.run(),
        Verb::Judge(verb) => verb.run(),
        Verb::Cases(verb) => verb.run(),
        Verb::Explain(verb) => verb.run(),
        Verb::Spec(verb) => verb.run(),
        Verb::Identify(verb) => verb.run(),
        Verb::Stability(verb) => verb.run(),
        Verb::Steady(verb) => verb.run(),
        Verb::Reproduce(verb) => verb.run(),
        Verb::Prove(verb) => verb.run(),
        Verb::Verify(verb) => verb.run(),
    };
    match outcome {
        Ok(exit) => exit.into(),
        // Whoever read the output has seen enough.
        Err(Trouble::Output(error)) if error.kind() == std::io::ErrorKind::BrokenPipe => Exit::Clean.into(),
        Err(trouble) => {
            // A message may quote a document, and a document anything.
            eprintln!("error: {}", printable(&trouble.to_string()));
            Exit::Trouble.into()
        }
    }
}
