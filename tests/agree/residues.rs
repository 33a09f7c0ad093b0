//! The squares between scalars commute: image of the result = result on the image.

use exact_kalman::filter::filter;
use exact_kalman::scalar::{Mersenne61, Rational};
use exact_kalman::trace::Quantity;
use proptest::prelude::*;

use super::draws::draws;
use super::systems::Kind;

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
}
