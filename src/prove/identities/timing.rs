//! From one timing of shared noise to the other.

use super::path::{changed, path, without_shared_noise};
use crate::filter::filter;
use crate::matrix::Matrix;
use crate::model::{Path, Timing};
use crate::prove::body::{Body, Failure, Numbers, Sides, no_value, paired};
use crate::prove::entries::Entries;
use crate::scalar::Field;

/// What is predicted in departing timing is what was filtered in arriving timing.
pub(in crate::prove) struct ToDeparting;

impl Body for ToDeparting {
    const IDENTIFIERS: &'static [&'static str] = &["HV-X.ad"];
    const NAME: &'static str = "arriving noise as departing noise of the state before";
    const WHERE: &'static str = "every Σ is regular";
    const SLIP: &'static str = "no noise is taken to be shared after the change";
    const LETTERS: &'static [&'static str] = &["n", "m", "steps"];
    const SYMBOLIC: &'static [&'static [usize]] = &[&[1, 1, 1], &[2, 1, 1], &[1, 2, 1], &[1, 1, 2]];
    const HEAVY: &'static [&'static [usize]] = &[&[2, 2, 1], &[1, 1, 3]];
    const RANDOM: &'static [&'static [usize]] = &[&[2, 1, 2], &[2, 2, 2], &[3, 2, 3], &[8, 3, 2]];

    fn sides<F: Field>(numbers: Numbers, twin: bool, entries: &mut Entries<'_, F>) -> Result<Sides<F>, Failure> {
        let arriving = path(Timing::Arriving, numbers, entries);
        let mut departing = arriving.to_departing();
        if twin {
            departing = changed(&departing, without_shared_noise);
        }
        let before = filter(&arriving).map_err(|error| no_value(error.source))?;
        let after = filter(&departing).map_err(|error| no_value(error.source))?;
        let predicted = after.records.iter().skip(1).map(|record| &record.predicted).chain(&after.ahead);
        let mut sides = Vec::new();
        for (_, (record, moments)) in paired(arriving.steps(), paired(&before.records, predicted)?)? {
            sides.push((record.filtered.mean.clone(), moments.mean.clone()));
            sides.push((record.filtered.covariance.clone(), moments.covariance.clone()));
        }
        Ok(sides)
    }
}

/// Feeding each reading back leaves the same laws and no shared noise.
pub(in crate::prove) struct ToArriving;

impl Body for ToArriving {
    const IDENTIFIERS: &'static [&'static str] = &["HV-X.da"];
    const NAME: &'static str = "departing noise taken away by feeding readings back";
    const WHERE: &'static str = "every FFᵀ and Σ is regular";
    const SLIP: &'static str = "the matrix of the transition stays A, not A − LC";
    const LETTERS: &'static [&'static str] = &["n", "m", "steps"];
    const SYMBOLIC: &'static [&'static [usize]] = &[&[1, 1, 2], &[1, 1, 3]];
    const HEAVY: &'static [&'static [usize]] = &[&[2, 1, 2], &[1, 2, 2]];
    const RANDOM: &'static [&'static [usize]] = &[&[2, 1, 2], &[2, 2, 2], &[3, 2, 3], &[8, 3, 2]];

    fn sides<F: Field>(numbers: Numbers, twin: bool, entries: &mut Entries<'_, F>) -> Result<Sides<F>, Failure> {
        let departing = path(Timing::Departing, numbers, entries);
        let mut arriving = departing.to_arriving().map_err(no_value)?;
        if twin {
            arriving = unmoved(&departing, &arriving)?;
        }
        let before = filter(&departing).map_err(|error| no_value(error.source))?;
        let after = filter(&arriving).map_err(|error| no_value(error.source))?;
        let shared = arriving.steps().iter().filter_map(|step| step.transition.as_ref()).map(|t| &t.cross_noise);
        let mut sides: Sides<F> =
            shared.map(|cross| (cross.clone(), Matrix::zeros(cross.rows(), cross.columns()))).collect();
        for (_, (own, other)) in paired(departing.steps(), paired(&before.records, &after.records)?)? {
            sides.push((own.filtered.mean.clone(), other.filtered.mean.clone()));
            sides.push((own.filtered.covariance.clone(), other.filtered.covariance.clone()));
        }
        Ok(sides)
    }
}

/// The second path with the matrices of the first, one step later.
fn unmoved<F: Field>(departing: &Path<F>, arriving: &Path<F>) -> Result<Path<F>, Failure> {
    let mut steps = arriving.steps().to_vec();
    let originals = departing.steps().split_last().map_or(&[][..], |(_, before)| before);
    for (step, last) in paired(steps.iter_mut().skip(1), originals)? {
        if let (Some(own), Some(original)) = (&mut step.transition, &last.transition) {
            own.matrix = original.matrix.clone();
        }
    }
    Ok(Path::from_parts(arriving.timing(), arriving.initial().clone(), steps))
}
