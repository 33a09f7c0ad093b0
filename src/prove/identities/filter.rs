//! The recursion of the Theorem against the joint law of everything, conditioned once.

use super::path::{changed, path, singular_path, without_shared_noise};
use crate::filter::{filter, one_shot};
use crate::model::{Path, Timing};
use crate::prove::body::{Body, Failure, Numbers, Sides, no_value, paired};
use crate::prove::entries::Entries;
use crate::scalar::Field;

fn both<F: Field>(path: &Path<F>, twin: bool) -> Result<Sides<F>, Failure> {
    let recursive = if twin { changed(path, without_shared_noise) } else { path.clone() };
    let trace = filter(&recursive).map_err(|error| no_value(error.source))?;
    let laws = one_shot(path).map_err(|error| no_value(error.source))?;
    let mut sides = Vec::new();
    for (_, (record, law)) in paired(path.steps(), paired(&trace.records, &laws)?)? {
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
    const WHERE: &'static str = "every Σ is regular";
    const SLIP: &'static str = "the noise that transition and reading share is forgotten";
    const LETTERS: &'static [&'static str] = &["n", "m", "steps"];
    const SYMBOLIC: &'static [&'static [usize]] =
        &[&[1, 1, 1], &[2, 1, 1], &[1, 2, 1], &[1, 1, 2], &[3, 1, 1], &[1, 1, 3]];
    const HEAVY: &'static [&'static [usize]] = &[&[2, 2, 1]];
    const RANDOM: &'static [&'static [usize]] = &[&[2, 1, 2], &[2, 2, 2], &[3, 2, 3], &[4, 2, 3], &[8, 3, 2]];

    fn sides<F: Field>(numbers: Numbers, twin: bool, entries: &mut Entries<'_, F>) -> Result<Sides<F>, Failure> {
        both(&path(Timing::Arriving, numbers, entries), twin)
    }
}

/// Noise shared with the transition that departs.
pub(in crate::prove) struct Departing;

impl Body for Departing {
    const IDENTIFIERS: &'static [&'static str] = &["HV-3", "HV-4", "HV-5"];
    const NAME: &'static str = "the predictor = the joint law conditioned (departing noise)";
    const WHERE: &'static str = "every Σ is regular";
    const SLIP: &'static str = "the noise that reading and transition share is forgotten";
    const LETTERS: &'static [&'static str] = &["n", "m", "steps"];
    const SYMBOLIC: &'static [&'static [usize]] = &[&[1, 1, 2], &[1, 1, 3]];
    const HEAVY: &'static [&'static [usize]] = &[&[2, 1, 2], &[1, 2, 2]];
    const RANDOM: &'static [&'static [usize]] = &[&[2, 1, 2], &[2, 2, 2], &[3, 2, 3], &[4, 2, 3], &[8, 3, 2]];

    fn sides<F: Field>(numbers: Numbers, twin: bool, entries: &mut Entries<'_, F>) -> Result<Sides<F>, Failure> {
        both(&path(Timing::Departing, numbers, entries), twin)
    }
}

/// The first with singular innovations.
pub(in crate::prove) struct SingularArriving;

impl Body for SingularArriving {
    const IDENTIFIERS: &'static [&'static str] = Arriving::IDENTIFIERS;
    const NAME: &'static str = "the filter = the joint law conditioned (arriving noise, singular Σ)";
    const WHERE: &'static str = "every Σ has that rank, and the start no variance in the known directions";
    const SLIP: &'static str = Arriving::SLIP;
    const LETTERS: &'static [&'static str] = &["n", "m", "steps", "rank", "known"];
    const SYMBOLIC: &'static [&'static [usize]] =
        &[&[1, 2, 1, 1, 0], &[2, 2, 1, 1, 0], &[2, 2, 1, 1, 1], &[1, 3, 1, 1, 0]];
    const HEAVY: &'static [&'static [usize]] = &[&[1, 2, 2, 1, 0], &[1, 3, 1, 2, 0]];
    const RANDOM: &'static [&'static [usize]] = &[&[2, 2, 2, 1, 1], &[3, 3, 3, 2, 1], &[8, 4, 2, 2, 3]];

    fn sides<F: Field>(numbers: Numbers, twin: bool, entries: &mut Entries<'_, F>) -> Result<Sides<F>, Failure> {
        both(&singular_path(Timing::Arriving, numbers, entries), twin)
    }
}

/// The second with singular innovations.
pub(in crate::prove) struct SingularDeparting;

impl Body for SingularDeparting {
    const IDENTIFIERS: &'static [&'static str] = Departing::IDENTIFIERS;
    const NAME: &'static str = "the predictor = the joint law conditioned (departing noise, singular Σ)";
    const WHERE: &'static str = "every Σ has that rank, and the start no variance in the known directions";
    const SLIP: &'static str = Departing::SLIP;
    const LETTERS: &'static [&'static str] = &["n", "m", "steps", "rank", "known"];
    const SYMBOLIC: &'static [&'static [usize]] = &[&[1, 2, 2, 1, 0]];
    const HEAVY: &'static [&'static [usize]] = &[&[2, 2, 2, 1, 1]];
    const RANDOM: &'static [&'static [usize]] = &[&[2, 2, 2, 1, 1], &[3, 3, 3, 2, 1], &[8, 4, 2, 2, 3]];

    fn sides<F: Field>(numbers: Numbers, twin: bool, entries: &mut Entries<'_, F>) -> Result<Sides<F>, Failure> {
        both(&singular_path(Timing::Departing, numbers, entries), twin)
    }
}
