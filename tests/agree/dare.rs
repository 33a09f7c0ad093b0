//! The examples of other libraries for Riccati's equation of control, and hard scalings: each is proved to 30 digits or refused with a proof,
//! and what is proved agrees with another algorithm in another program's numbers.

use std::collections::BTreeMap;
use std::path::{Path, PathBuf};

use exact_kalman::certify::{Existence, SteadyEffort, SteadyState};
use exact_kalman::model::Timing;
use exact_kalman::protocol::SteadyModel;
use exact_kalman::scalar::{Interval, Rational, ratio};
use num_bigint::BigInt;
use num_traits::Signed;
use serde::Deserialize;

/// More than a few seconds each: `benches/dare.py` runs them.
const SLOW: [&str; 3] = ["darex-15", "chain-100", "rod-100"];

/// Forty digits of X by structure-preserving doubling with 1000 bits (`benches/dare.py --solutions`, FLINT 3 through python-flint).
const SOLUTIONS: &str = include_str!("dare.json");

#[derive(Deserialize)]
struct Solution {
    diagonal: Vec<String>,
    first: Vec<String>,
}

fn models(folder: &str) -> Vec<SteadyModel> {
    let place: PathBuf = Path::new(env!("CARGO_MANIFEST_DIR")).join("examples/steady").join(folder);
    let mut paths: Vec<PathBuf> =
        place.read_dir().expect("a folder").map(|entry| entry.expect("an entry").path()).collect();
    paths.sort();
    let read = |path: &PathBuf| {
        let model = SteadyModel::parse(&std::fs::read_to_string(path).expect("text")).expect("a model");
        assert_eq!(path.file_stem().and_then(|stem| stem.to_str()), Some(model.id.as_str()));
        model
    };
    paths.iter().map(read).collect()
}

/// `-1.25e-3`
fn decimal(text: &str) -> Rational {
    let (digits, exponent) = text.split_once('e').unwrap_or((text, "0"));
    let (whole, part) = digits.split_once('.').unwrap_or((digits, ""));
    let integer: BigInt = format!("{whole}{part}").parse().expect("digits");
    let exponent: i32 = exponent.parse().expect("an exponent");
    Rational::from(integer) * ratio(10, 1).pow(exponent - i32::try_from(part.len()).expect("short"))
}

/// Whether a number of forty digits may be one in the interval; zero there is what 1000 bits leave of it, at sizes up to 1e14.
fn holds(interval: &Interval, text: &str) -> bool {
    let value = decimal(text);
    let error = value.abs() * ratio(10, 1).pow(-39) + ratio(10, 1).pow(-250);
    let (low, high) = (interval.lower().value().expect("short"), interval.upper().value().expect("short"));
    low <= &value + &error && &value - &error <= high
}

/// Every example is proved to 30 digits or refused with a proof; the other route's numbers lie in the intervals.
#[test]
fn examples_are_proved_or_refused() {
    let solutions: BTreeMap<String, Solution> = serde_json::from_str(SOLUTIONS).expect("solutions");
    let (dare, hard) = (models("dare"), models("hard"));
    assert_eq!(dare.len(), 19, "16 real examples and 3 complex ones");
    for model in dare.iter().chain(&hard) {
        let (id, step) = (&model.id, model.unified());
        let filtered = model.equation.timing() == Some(Timing::Departing);
        let effort = SteadyEffort { filtered, open: !filtered, ..SteadyEffort::default() };
        if SLOW.contains(&id.as_str()) {
            continue;
        }
        if id.starts_with("absent") {
            assert!(matches!(Existence::of(&step), Existence::Absent(_)), "{id}");
            assert!(SteadyState::of(&step, effort).is_err(), "{id}");
            continue;
        }
        assert!(!matches!(Existence::of(&step), Existence::Absent(_)), "{id}");
        let state = SteadyState::of(&step, effort).unwrap_or_else(|error| panic!("{id}: {error}"));
        assert!(state.digits.is_none_or(|digits| digits >= 30), "{id}: {:?} digits", state.digits);
        let known = solutions.get(id).unwrap_or_else(|| panic!("{id} has no solution"));
        assert_eq!(known.diagonal.len(), step.states(), "{id}");
        for (i, text) in known.diagonal.iter().enumerate() {
            assert!(holds(&state.solution[(i, i)], text), "{id}: {text} at {i}, {i}");
        }
        for (j, text) in known.first.iter().enumerate() {
            assert!(holds(&state.solution[(0, j)], text), "{id}: {text} at 0, {j}");
        }
    }
}
