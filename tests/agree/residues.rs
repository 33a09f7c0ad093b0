//! The squares between scalars commute: image of the result = result on the image.

use exact_kalman::filter::{TraceAhead, filter, predict_ahead};
use exact_kalman::scalar::{Mersenne61, Rational};
use exact_kalman::trace::Quantity;
use proptest::prelude::*;

use super::ahead::realised;
use super::draws::draws;
use super::systems::{Draw, Kind};

const KIND: Kind = Kind { states: 4, sensors: 3, steps: 4, adapted: true, gaps: true };

fn image(value: &Rational) -> Result<Mersenne61, TestCaseError> {
    Mersenne61::image(value).ok_or_else(|| TestCaseError::reject("the prime divides a denominator"))
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 1000, failure_persistence: None, ..ProptestConfig::default() })]

    /// CKS-T: the same generic recursion modulo 2⁶¹ − 1.
    #[test]
    fn filter_commutes_with_residues(draw in draws(KIND)) {
        let path = draw.system().realised(&draw.data()).map_err(|error| TestCaseError::fail(error.to_string()))?;
        let exact = filter(&path).map_err(|error| TestCaseError::fail(error.to_string()))?;
        let modular = filter(&path.try_map(image)?).map_err(|error| TestCaseError::fail(error.to_string()))?;
        prop_assert_eq!(exact.records.len(), modular.records.len());
        for (record, residues) in exact.records.iter().zip(&modular.records) {
            let (values, residues) = (record.values(), residues.values());
            prop_assert!(values.keys().eq(residues.keys()));
            for quantity in Quantity::ALL {
                let (Some(value), Some(residue)) = (values.get(&quantity), residues.get(&quantity)) else { continue };
                prop_assert_eq!(&value.try_map(image)?, residue);
            }
        }
    }

    /// HV-T1, HV-X.ad, HV-X.da: so do the predictor and the change of timing.
    #[test]
    fn predictor_commutes_with_residues(draw in draws(KIND), d in 1usize..=3) {
        let draw = Draw { lag: d, ..draw };
        let fail = |error: String| TestCaseError::fail(error);
        let path = realised(&draw).map_err(fail)?;
        let exact = predict_ahead(&path).map_err(|error| fail(error.to_string()))?;
        let images = path.try_map(image)?;
        let modular = predict_ahead(&images).map_err(|error| fail(error.to_string()))?;
        let laws = |trace: &TraceAhead<Rational>| -> Vec<_> {
            trace.start.iter().chain(trace.steps.iter().flat_map(|step| &step.ahead)).cloned().collect()
        };
        let residues: Vec<_> = modular.start.iter().chain(modular.steps.iter().flat_map(|step| &step.ahead)).collect();
        prop_assert_eq!(laws(&exact).len(), residues.len());
        for (law, residue) in laws(&exact).iter().zip(residues) {
            prop_assert_eq!(&law.mean.try_map(image)?, &residue.mean);
            prop_assert_eq!(&law.covariance.try_map(image)?, &residue.covariance);
        }
        let arriving = path.path().to_arriving().map_err(|error| fail(error.to_string()))?;
        let modular = images.path().to_arriving().map_err(|error| fail(error.to_string()))?;
        prop_assert_eq!(arriving.try_map(image)?, modular.clone());
        prop_assert_eq!(arriving.to_departing().try_map(image)?, modular.to_departing());
    }
}
