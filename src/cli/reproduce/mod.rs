//! `reproduce`: published tables and figures, simulated again.

mod bioreactor;
mod consistency;

use clap::Subcommand;

use super::exit::{Exit, Trouble};

const EXAMPLES: &str = "\
Examples:
  exact-kalman reproduce AK-Tab1 --batches 50                      Anderson et al. 1969, Table 1
  exact-kalman reproduce HV-Tab1 --start repaired --runs 20        Hilgert and Vila 1999, Table 1
  exact-kalman reproduce HV-Fig1 --start repaired > figure1.csv    and its figures, as columns

Exit codes: 0 all simulated; 2 trouble with the command line, or a start that is no start";

/// Simulate a published table or figure again
#[derive(clap::Args, Debug)]
#[command(after_help = EXAMPLES)]
pub(super) struct Reproduce {
    #[command(subcommand)]
    target: Target,
}

/// What can be reproduced, under its identifier in SPEC.md.
#[derive(Subcommand, Debug)]
enum Target {
    #[command(name = "AK-Tab1")]
    Consistency(consistency::Consistency),
    #[command(name = "HV-Tab1")]
    Errors(bioreactor::Errors),
    #[command(name = "HV-Fig1")]
    OneStep(bioreactor::OneStep),
    #[command(name = "HV-Fig2")]
    TwoSteps(bioreactor::TwoSteps),
}

impl Reproduce {
    pub(super) fn run(self) -> Result<Exit, Trouble> {
        match self.target {
            Target::Consistency(target) => target.run(),
            Target::Errors(target) => target.run(),
            Target::OneStep(target) => target.run(),
            Target::TwoSteps(target) => target.run(),
        }
    }
}
