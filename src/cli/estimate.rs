//! `estimate`: prediction from a start that is not Gaussian.

use std::io::Write;
use std::path::PathBuf;

use serde_json::{Value, json};

use super::Format;
use super::exit::{Exit, Trouble};
use super::input;
use super::numbers::{Numbers, laid_out};
use super::price::Price;
use super::proved::proved;
use crate::matrix::Matrix;
use crate::model::Path;
use crate::nongaussian::{
    Average, Component, InitialLaw, InitialLawError, Linear, Posterior, StatisticsError, statistics,
};
use crate::protocol::{CaseError, EstimateCase};
use crate::scalar::Rational;

const EXAMPLES: &str = "\
Examples:
  exact-kalman estimate examples/estimate/coin.json                     a start of two values
  exact-kalman estimate examples/estimate/coin.json --last --digits 50  proved digits
  exact-kalman estimate examples/estimate/slab.json --exact             fractions, if there are
  exact-kalman estimate examples/estimate/coin.json --price             what the affine one loses
  exact-kalman estimate examples/estimate/slab.json --format json

Digits are proved: irrational numbers are enclosed until both ends round alike. With --exact they
are decimals of 17 digits followed by `…`. The price may be `from … to …`, both ends proved, or,
where the readings see more than two directions, `unsupported (…)` with a simulation, no proof. `<2^-N` bounds what is closer to zero than any
decimal that is computed, `unknown (…)` says why an entry has no digits. Exit codes: 0 all
estimated, 2 the file is refused, with the place and the reason, or other trouble";

/// Print best and best affine predictions of the next state, for a start that is a mixture of Gaussian laws
#[derive(clap::Args, Debug)]
#[command(after_help = EXAMPLES)]
pub(super) struct Estimate {
    /// A file as described in docs/ESTIMATE.md, or `-` for standard input.
    file: PathBuf,
    #[command(flatten)]
    numbers: Numbers,
    /// Only the last step.
    #[arg(long)]
    last: bool,
    #[command(flatten)]
    price: Price,
    /// How to print.
    #[arg(long, value_enum, default_value_t)]
    format: Format,
}

/// A number as text.
type Shown = Matrix<String>;

impl Estimate {
    pub(super) fn run(self) -> Result<Exit, Trouble> {
        let place = self.file.display().to_string();
        let refused = |message: String| Trouble::Other { place: place.clone(), message };
        let text = input::text(&self.file)?;
        let case = EstimateCase::parse(text.strip_prefix('\u{feff}').unwrap_or(&text))
            .map_err(|source| Trouble::Case { place: place.clone(), source })?;
        let (path, law) = realised(&case).map_err(refused)?;
        let all = statistics(&path).map_err(|error| refused(unfit(&error)))?;
        let mut out = std::io::stdout().lock();
        let mut steps = Vec::new();
        let first = if self.last { all.len().saturating_sub(1) } else { 1 };
        for (t, now) in all.iter().enumerate().skip(first.max(1)) {
            let (posterior, linear) = (now.posterior(&law), now.linear(&law));
            let mut shown = self.step(t - 1, &posterior, &linear);
            if let Some(price) = self.price.text(now, &law, self.numbers) {
                shown.push(("price of linearity", "price", Matrix::column(vec![price])));
            }
            match self.format {
                Format::Text => {
                    writeln!(out, "{} · after step {}", case.id, t - 1)?;
                    for (name, _, matrix) in &shown {
                        writeln!(out, "  {name:36} {}", laid_out(matrix))?;
                    }
                }
                Format::Json => steps.push(json_of(t - 1, &shown)),
            }
        }
        if self.format == Format::Json {
            writeln!(out, "{}", json!({"id": case.id, "steps": steps}))?;
        }
        Ok(Exit::Clean)
    }

    /// What is shown of a step: names for people and for programs.
    fn step(
        &self,
        step: usize,
        posterior: &Posterior<Rational>,
        linear: &Linear<Rational>,
    ) -> Vec<(&'static str, &'static str, Shown)> {
        let mut averages = posterior.averages();
        let columns = [averages.mean(), averages.difference(linear), averages.weights()];
        let covariance = averages.covariance();
        let mut proved = |all: &Matrix<Average>| {
            all.map(|number| {
                let text = proved(&mut averages, number, self.numbers);
                text.unwrap_or_else(|reason| format!("unknown ({}, after step {step}: {reason})", number.quantity))
            })
        };
        let [mean, difference, weights] = columns.map(|column| proved(&Matrix::column(column)));
        let fractions = |matrix: &Matrix<Rational>| matrix.map(|entry| self.numbers.text(entry));
        vec![
            ("best estimate", "mmse", mean),
            ("best affine estimate", "lmmse", fractions(&linear.estimate)),
            ("difference", "difference", difference),
            ("probabilities", "weights", weights),
            ("covariance", "covariance", proved(&covariance)),
            ("covariance of the affine error", "linear_covariance", fractions(&linear.covariance)),
        ]
    }
}

/// The model, and the law of its start; refusals name the place.
fn realised(case: &EstimateCase) -> Result<(Path<Rational>, InitialLaw<Rational>), String> {
    let mut path = None;
    let mut components = Vec::new();
    let states = case.initial_law.first().map_or(0, |part| part.mean.len());
    for (index, part) in case.initial_law.iter().enumerate() {
        if part.mean.len() != states {
            let found = part.mean.len();
            return Err(format!(
                "initial_law[{index}].mean: has {found} entries; that of the first component has {states}"
            ));
        }
        // What a case calls its initial belief is here a component.
        let placed = |error: CaseError| error.to_string().replacen("initial.", &format!("initial_law[{index}]."), 1);
        let problem = case.problem_of(part).map_err(placed)?;
        let found = problem.realised().map_err(placed)?;
        let weight = case.numbers.read_finite(part.weight.as_str());
        let weight = weight.map_err(|error| format!("initial_law[{index}].weight: {error}"))?;
        let law = crate::gaussian::Gaussian::new(problem.system.initial.mean, problem.system.initial.covariance);
        let law = law.map_err(|error| format!("initial_law[{index}].covariance: {error}"))?;
        components.push(Component { weight, law });
        path.get_or_insert(found);
    }
    let law = InitialLaw::mixture(components).map_err(|error| match error {
        InitialLawError::Weight { component } => format!("initial_law[{component}].weight: {error}"),
        InitialLawError::Sum { ref sum } => format!("initial_law: {error}, but to {sum}"),
        other => format!("initial_law: {other}"),
    })?;
    Ok((path.ok_or("initial_law: is empty")?, law))
}

fn unfit(error: &StatisticsError<Rational>) -> String {
    match error {
        StatisticsError::Noiseless { step, witness } => {
            let witness: Vec<String> = witness.entries().iter().map(ToString::to_string).collect();
            format!(
                "noise.observation: at step {step} it is singular: v = [{}] has Rv = 0; every observation must be noisy here",
                witness.join(", ")
            )
        }
        StatisticsError::Arriving | StatisticsError::Undecided { .. } => error.to_string(),
    }
}

fn json_of(step: usize, shown: &[(&'static str, &'static str, Shown)]) -> Value {
    let mut object = serde_json::Map::new();
    object.insert("step".to_owned(), step.into());
    for (_, key, matrix) in shown {
        let value = match *key {
            "covariance" | "linear_covariance" => {
                (0..matrix.rows()).map(|row| Value::from(matrix.row(row).to_vec())).collect()
            }
            "price" => Value::from(matrix[(0, 0)].clone()),
            _ => Value::from(matrix.entries().to_vec()),
        };
        object.insert((*key).to_owned(), value);
    }
    object.into()
}
