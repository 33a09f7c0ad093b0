//! Times the exact filter on the problem of a case file, for `benches/compare.py`.
//!
//! Prints one JSON object: medians of CPU and wall seconds of a run, lengths of the denominators, the peak of memory, and
//! remainders of the results modulo 2⁶¹ − 1, by which other programs' results are compared. Reading the case is not timed.
//!
//! Run with `cargo run --release --example throughput -- examples/cases/nile.json`; `--help` lists the options.

use std::collections::BTreeMap;
use std::time::Instant;

use clap::{Parser, ValueEnum};
use exact_kalman::filter::{Effort, RationalStep, Route, Wanted, filter_rational};
use exact_kalman::matrix::{Fractions, Matrix};
use exact_kalman::protocol::{Case, Decimal};
use exact_kalman::scalar::{Precision, Rational};
use exact_kalman::trace::Quantity;
use num_bigint::BigInt;

#[derive(Parser)]
struct Options {
    /// The file of the case.
    case: String,
    /// How the states are computed.
    #[arg(long, value_enum, default_value = "fastest")]
    route: RouteName,
    /// What the filter is asked for.
    #[arg(long, value_enum, default_value = "filtered")]
    wanted: WantedName,
    /// What belongs to a run besides the filter.
    #[arg(long, value_enum, default_value = "integers")]
    output: Output,
    /// Runs are repeated until they have taken this long; where there are several, the first does not count.
    #[arg(long, default_value_t = 0.3)]
    seconds: f64,
    /// The least number of runs.
    #[arg(long, default_value_t = 1)]
    runs: usize,
}

#[derive(Clone, Copy, ValueEnum)]
enum RouteName {
    Fastest,
    FractionFree,
    Multimodular,
}

#[derive(Clone, Copy, ValueEnum)]
enum WantedName {
    Everything,
    Filtered,
}

/// The form in which all results of all steps are handed out.
#[derive(Clone, Copy, ValueEnum)]
enum Output {
    /// As integers over denominators.
    Integers,
    /// As fractions in lowest terms.
    LowestTerms,
    /// As text with 17 significant digits, correctly rounded.
    Digits,
}

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let options = Options::parse();
    let path = Case::parse(&std::fs::read_to_string(&options.case)?)?.problem()?.realised()?;
    let route = match options.route {
        RouteName::Fastest => Route::Fastest,
        RouteName::FractionFree => Route::FractionFree,
        RouteName::Multimodular => Route::Multimodular,
    };
    let wanted = match options.wanted {
        WantedName::Everything => Wanted::Everything,
        WantedName::Filtered => Wanted::Filtered,
    };
    let effort = Effort { route, wanted, ..Effort::default() };

    let memory_before = peak_of_memory();
    let (mut cpu, mut wall) = (Vec::new(), Vec::new());
    let (steps, length_of_output) = loop {
        let start = (cpu_seconds(), Instant::now());
        let steps = filter_rational(&path, effort)?;
        let length = handed_out(&steps, options.output);
        wall.push(start.1.elapsed().as_secs_f64());
        cpu.push(cpu_seconds() - start.0);
        if wall.iter().sum::<f64>() >= options.seconds && wall.len() >= options.runs {
            break (steps, length);
        }
    };
    let memory = peak_of_memory();
    let length = |count: usize| {
        Some((count, steps.get(count.checked_sub(1)?)?.values[&Quantity::FilteredCovariance].denominator.bits()))
    };
    let half_and_end = [(steps.len() / 2).max(1), steps.len()].into_iter().filter_map(length);
    let bits: BTreeMap<String, u64> = half_and_end.map(|(count, bits)| (count.to_string(), bits)).collect();
    // What was timed is what is hashed: of fractions in lowest terms, these.
    let handed_over: Vec<StepFractions> = steps
        .iter()
        .map(|step| match options.output {
            Output::LowestTerms => {
                let values = step.fractions(Precision::Exact).values;
                values.into_iter().map(|(quantity, matrix)| (quantity, entries_of_fractions(&matrix))).collect()
            }
            Output::Integers | Output::Digits => {
                step.values.iter().map(|(quantity, matrix)| (*quantity, entries_of_integers(matrix))).collect()
            }
        })
        .collect();
    let report = serde_json::json!({
        "cpu": median(&mut cpu), "wall": median(&mut wall), "runs": cpu.len(),
        "bits": bits, "output": length_of_output,
        "memory_before": memory_before, "memory": memory,
        "hash_last": hash(&handed_over[steps.len().saturating_sub(1)..]), "hash_all": hash(&handed_over),
        "version": format!("exact-kalman {}", env!("CARGO_PKG_VERSION")),
    });
    println!("{report}");
    Ok(())
}

/// Makes the output of all steps, and says how long it is: in bits, or in characters.
fn handed_out(steps: &[RationalStep], output: Output) -> u64 {
    match output {
        Output::Integers => steps.iter().flat_map(|step| step.values.values()).map(length_of_integers).sum(),
        Output::LowestTerms => {
            let fractions: Vec<_> = steps.iter().map(|step| step.fractions(Precision::Exact)).collect();
            let entries = fractions.iter().flat_map(|step| step.values.values()).flat_map(Matrix::entries);
            entries.map(|entry| entry.numer().bits() + entry.denom().bits()).sum()
        }
        Output::Digits => steps.iter().flat_map(|step| &step.values).map(length_of_digits).sum(),
    }
}

fn length_of_integers(matrix: &Fractions) -> u64 {
    matrix.denominator.bits() + matrix.numerators.entries().iter().map(BigInt::bits).sum::<u64>()
}

fn length_of_digits((quantity, matrix): (&Quantity, &Fractions)) -> u64 {
    let numerators = &matrix.numerators;
    let mut length = 0;
    for row in 0..numerators.rows() {
        let columns = if quantity.is_covariance() { row + 1 } else { numerators.columns() };
        for column in 0..columns {
            length += Decimal::of_quotient(matrix.quotient(row, column), 17).to_string().len() as u64;
        }
    }
    length
}

/// Numerators and denominators of the entries of what a step handed out, row by row.
type StepFractions = BTreeMap<Quantity, Vec<(BigInt, BigInt)>>;

fn entries_of_fractions(matrix: &Matrix<Rational>) -> Vec<(BigInt, BigInt)> {
    matrix.entries().iter().map(|entry| (entry.numer().clone(), entry.denom().clone())).collect()
}

fn entries_of_integers(matrix: &Fractions) -> Vec<(BigInt, BigInt)> {
    matrix.numerators.entries().iter().map(|numerator| (numerator.clone(), matrix.denominator.clone())).collect()
}

/// The filtered covariances, then the means, entry by entry modulo 2⁶¹ − 1, as the digits of one number.
fn hash(steps: &[StepFractions]) -> u64 {
    let modulus = (1u64 << 61) - 1;
    let product = |left: u64, right: u64| u128::from(left) * u128::from(right) % u128::from(modulus);
    let (big, inverting) = (BigInt::from(modulus), BigInt::from(modulus - 2));
    let remainder = |integer: &BigInt| {
        let nonnegative = ((integer % &big) + &big) % &big;
        u64::try_from(nonnegative).unwrap_or_default()
    };
    let remainder_of = |integer: &BigInt| BigInt::from(remainder(integer));
    let mut hash = 0;
    for step in steps {
        for quantity in [Quantity::FilteredCovariance, Quantity::FilteredMean] {
            for (numerator, denominator) in &step[&quantity] {
                let inverse = remainder(&remainder_of(denominator).modpow(&inverting, &big));
                let sum = product(hash, 1_000_003) + product(remainder(numerator), inverse);
                hash = u64::try_from(sum % u128::from(modulus)).unwrap_or_default();
            }
        }
    }
    hash
}

/// The median; the first of several is left out, since it warms the machine up.
fn median(seconds: &mut [f64]) -> f64 {
    let counted = if seconds.len() > 1 { &mut seconds[1..] } else { seconds };
    counted.sort_by(f64::total_cmp);
    counted[counted.len() / 2]
}

/// The CPU time of all threads of this process.
#[cfg(unix)]
fn cpu_seconds() -> f64 {
    use nix::time::{ClockId, clock_gettime};
    clock_gettime(ClockId::CLOCK_PROCESS_CPUTIME_ID)
        .map_or(f64::NAN, |time| std::time::Duration::from(time).as_secs_f64())
}

#[cfg(not(unix))]
fn cpu_seconds() -> f64 {
    f64::NAN
}

/// The most memory this process has ever held, in KiB, where the system tells (Linux).
fn peak_of_memory() -> Option<u64> {
    let status = std::fs::read_to_string("/proc/self/status").ok()?;
    let line = status.lines().find(|line| line.starts_with("VmHWM:"))?;
    line.split_whitespace().nth(1)?.parse().ok()
}
