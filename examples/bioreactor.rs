//! Predicts the biomass of a stirred tank reactor one step ahead, from noise-free readings of its substrate.
//!
//! Prints one run as comma-separated values: the biomass, the standard (exact) prediction and the extended one, as in
//! Figure 1 of Hilgert and Vila 1999.
//!
//! ```text
//! cargo run --example bioreactor > course.csv
//! ```

use std::error::Error;
use std::io::Write;

use exact_kalman::reproduce::bioreactor::{Exponent, Options, Preset, figure};

fn main() -> Result<(), Box<dyn Error>> {
    // The covariances as printed are no covariances, and are refused; with P_BB = 5000 they are.
    let printed = Options::one_step(Preset::Printed.start(1));
    if let Err(error) = figure(&printed, Exponent::Real(0.5), 0) {
        eprintln!("As printed: {error}");
    }
    let repaired = Options::one_step(Preset::Repaired.start(1));
    let course = figure(&repaired, Exponent::Real(0.5), 0)?;
    write!(std::io::stdout(), "{course}")?;
    Ok(())
}
