//! The recursion of the Theorem against the joint law of everything, conditioned once.

use super::path::{changed, path, without_shared_noise};
use crate::filter::{filter, one_shot};
use crate::model::{Before, Timing};
use crate::prove::body::{Body, Failure, Sides, no_value};
use crate::prove::entries::Entries;
use crate::scalar::Field;

fn both<F: Field>(
    timing: Timing,
    before: Before,
    numbers: [usize; 3],
    twin: bool,
    entries: &mut Entries<'_, F>,
) -> Result<Sides<F>, Failure> {
    let path = path(timing, before, numbers, entries);
    let recursive = if twin { changed(&path, without_shared_noise) } else { path.clone() };
    let trace = filter(&recursive).map_err(|error| no_value(error.source))?;
    let laws = one_shot(&path).map_err(|error| no_value(error.source))?;
    let mut sides = Vec::new();
    for (record, law) in trace.records.iter().zip(&laws) {
        for (own, other) in [(&record.predicted, &law.predicted), (&record.filtered, &law.filtered)] {
            sides.push((own.mean.clone(), other.mean().clone()));
            sides.push((own.covariance.clone(), other.covariance().clone()));
        }
    }
    Ok(sides)
}

/// Noise shared with the transition that arrives.
pub(in crate::prove) struct Arriving;

impl Body for Arriving {
    const IDENTIFIERS: &'static [&'static str] =
        &["CKS-T", "CKS-3", "CKS-4", "CKS-K", "CKS-R", "CKS-5", "CKS-10", "CKS-11", "CKS-12"];
    const NAME: &'static str = "the filter = the joint law conditioned (arriving noise)";
    const SLIP: &'static str = "the noise that transition and reading share is forgotten";
    const LETTERS: &'static [&'static str] = &["n", "m", "steps"];
    const SYMBOLIC: &'static [[usize; 3]] = &[[1, 1, 1], [2, 1, 1], [1, 2, 1], [1, 1, 2], [3, 1, 1], [1, 1, 3]];
    const HEAVY: &'static [[usize; 3]] = &[[2, 2, 1]];
    const RANDOM: &'static [[usize; 3]] = &[[2, 1, 2], [2, 2, 2], [3, 2, 3], [4, 2, 3], [8, 3, 2]];

    fn sides<F: Field>(numbers: [usize; 3], twin: bool, entries: &mut Entries<'_, F>) -> Result<Sides<F>, Failure> {
        both(Timing::Arriving, Before::Transition, numbers, twin, entries)
    }
}

/// Noise shared with the transition that departs.
pub(in crate::prove) struct Departing;

impl Body for Departing {
    const IDENTIFIERS: &'static [&'static str] = &["HV-3", "HV-4", "HV-5"];
    const NAME: &'static str = "the predictor = the joint law conditioned (departing noise)";
    const SLIP: &'static str = "the noise that reading and transition share is forgotten";
    const LETTERS: &'static [&'static str] = &["n", "m", "steps"];
    const SYMBOLIC: &'static [[usize; 3]] = &[[1, 1, 2], [1, 1, 3]];
    const HEAVY: &'static [[usize; 3]] = &[[2, 1, 2], [1, 2, 2]];
    const RANDOM: &'static [[usize; 3]] = &[[2, 1, 2], [2, 2, 2], [3, 2, 3], [4, 2, 3], [8, 3, 2]];

    fn sides<F: Field>(numbers: [usize; 3], twin: bool, entries: &mut Entries<'_, F>) -> Result<Sides<F>, Failure> {
        both(Timing::Departing, Before::Observation, numbers, twin, entries)
    }
}
