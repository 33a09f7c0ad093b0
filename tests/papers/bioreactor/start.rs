//! The initial covariances, and what a reading without noise does to them.

use exact_kalman::filter::{filter, one_shot};
use exact_kalman::gaussian::ConditionError;
use exact_kalman::matrix::{LdlError, Matrix};
use exact_kalman::model::{Field, ModelError, Place};
use exact_kalman::reproduce::bioreactor::{
    Belief, BioreactorError, Exponent, Options, Preset, Setting, realised, table,
};
use exact_kalman::scalar::{Rational, ratio};
use exact_kalman::trace::Record;
use proptest::prelude::*;

use super::{NATURAL, form, readings};

type Q = Matrix<Rational>;

fn records(setting: &Setting<Rational>, start: &Belief<Rational>, y: &[Rational]) -> Vec<Record<Rational>> {
    let path = realised(setting, start, true, y).expect("a system");
    filter(&path).expect("consistent readings").records
}

/// Row and column S.
fn of_substrate(p: &Q) -> [Rational; 4] {
    [p[(0, 1)].clone(), p[(1, 0)].clone(), p[(1, 1)].clone(), p[(1, 1)].clone()]
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 48, failure_persistence: None, ..ProptestConfig::default() })]

    /// HV-8c, HV-9b: after each reading row and column S of the covariance are 0 and the mean is the reading, if P ≥ 0; the
    /// covariance of the innovation is P_SS.
    #[test]
    fn a_reading_without_noise_leaves_no_doubt(entries in [-9_i64..=9, -9..=9, -9..=9, -9..=9], shift in -20_i64..20) {
        let root = Matrix::from_integers(&[[entries[0], entries[1]], [entries[2], entries[3]]]);
        let setting = Setting::printed(Exponent::Natural(1), 1);
        let y = readings(&setting, 4);
        // A substrate that is known must be the one that is read.
        let known = entries[2] == 0 && entries[3] == 0;
        let substrate = if known { y[0].clone() } else { &y[0] + ratio(shift, 1) };
        let start = Belief { mean: Matrix::column(vec![ratio(10, 1), substrate]), covariance: &root * root.transpose() };
        for (record, y) in records(&setting, &start, &y).iter().zip(&y) {
            prop_assert!(of_substrate(&record.filtered.covariance).iter().all(|entry| *entry == ratio(0, 1)));
            prop_assert_eq!(&record.filtered.mean[(1, 0)], y);
            prop_assert_eq!(&record.innovation_covariance[(0, 0)], &record.predicted.covariance[(1, 1)]);
        }
    }

    /// HV-8c: P_SS ≠ 0 is enough, whatever the sign of P.
    #[test]
    fn a_variance_that_is_not_zero_is_enough(b in -90_i64..90, s in -90_i64..90, cross in -90_i64..90) {
        prop_assume!(s != 0);
        let setting = Setting::printed(Exponent::Natural(0), 1);
        let covariance = Matrix::from_integers(&[[b, cross], [cross, s]]);
        let start = Belief { mean: Matrix::from_integers(&[[10], [45]]), covariance };
        let record = &records(&setting, &start, &[ratio(30, 1)])[0];
        prop_assert!(of_substrate(&record.filtered.covariance).iter().all(|entry| *entry == ratio(0, 1)));
    }
}

/// HV-8c: it fails for P_SS = 0, P_BS ≠ 0, which no random vector has.
#[test]
fn a_covariance_with_a_variance_of_zero_stays() {
    let setting = Setting::printed(Exponent::Natural(1), 1);
    let covariance = Matrix::from_integers(&[[80, 500], [500, 0]]);
    let start = Belief { mean: Matrix::from_integers(&[[10], [30]]), covariance: covariance.clone() };
    assert_eq!(records(&setting, &start, &[ratio(30, 1)])[0].filtered.covariance, covariance);
    assert!(matches!(covariance.ldl(), Err(LdlError::Indefinite(_))));
}

/// Erratum HV-P1.SKP: [[80, 500], [500, 80]] is no covariance: v = (1, −1) gives −840 and the determinant is −243600. One
/// reading of 30 leaves the biomass a variance of −3045 and the estimate −335/4, where the truth is 25. With P_BB ≥ 3125 it
/// would be one.
#[test]
fn the_printed_covariance_is_indefinite() {
    let printed = Preset::Printed.start(1).standard;
    let p = &printed.covariance;
    assert_eq!(*p, Matrix::from_integers(&[[80, 500], [500, 80]]));
    assert_eq!(form(p, &[1, -1]), ratio(-840, 1));
    assert_eq!(&p[(0, 0)] * &p[(1, 1)] - &p[(0, 1)] * &p[(1, 0)], ratio(-243_600, 1));
    let setting = Setting::printed(Exponent::Natural(1), 1);
    let y = [ratio(30, 1)];
    match realised(&setting, &printed, false, &y) {
        Err(BioreactorError::Model(ModelError::Indefinite { place, matrix, proof })) => {
            assert_eq!(place, Place { field: Field::InitialCovariance, step: None });
            assert_eq!(&matrix, p);
            assert_eq!(proof.witness.transpose().congruence(p)[(0, 0)], proof.value);
            assert!(proof.value < ratio(0, 1));
        }
        other => panic!("{other:?}"),
    }
    let after = |start: &Belief<Rational>| records(&setting, start, &y)[0].filtered.clone();
    let filtered = after(&printed);
    assert_eq!(filtered.covariance, Matrix::from_integers(&[[-3045, 0], [0, 0]]));
    assert_eq!(filtered.mean, Matrix::column(vec![ratio(-335, 4), ratio(30, 1)]));
    // With 3125 the determinant is 0, with one less it is negative.
    let least = |biomass: i64| Matrix::<Rational>::from_integers(&[[biomass, 500], [500, 80]]);
    assert!(least(3125).ldl().is_ok() && least(3124).ldl().is_err());
    let repaired = Preset::Repaired.start(1).standard;
    assert_eq!(repaired.covariance, least(5000));
    assert_eq!(after(&repaired).covariance[(0, 0)], ratio(5000 - 3125, 1));
}

/// HV-P1.SKP: the second reading makes the printed start positive again, for each β: the variance of the biomass after it
/// is 104.68, 3.57, 2.61 (rounded) for β = 2, 1, 0, where that of the substrate before it was negative.
#[test]
fn the_printed_start_heals() {
    for (exponent, hundredths) in NATURAL.into_iter().zip([10468, 357, 261]) {
        let setting = Setting::printed(exponent, 1);
        let y = [ratio(30, 1), ratio(30, 1)];
        let record = &records(&setting, &Preset::Printed.start(1).standard, &y)[1];
        assert!(record.predicted.covariance[(1, 1)] < ratio(0, 1));
        let variance = &record.filtered.covariance[(0, 0)] * ratio(100, 1);
        assert_eq!(variance.round(), ratio(hundredths, 1));
    }
}

/// Erratum HV-P1.EKP: the 3×3 matrix takes the value −840 at v = (1, −1, 0), and its determinant is −23592000.
#[test]
fn the_printed_extended_covariance_is_indefinite() {
    let start = Preset::Printed.start(1);
    let p = &start.extended.covariance;
    assert_eq!(*p, Matrix::from_integers(&[[80, 500, 20], [500, 80, 50], [20, 50, 100]]));
    assert_eq!(form(p, &[1, -1, 0]), ratio(-840, 1));
    // Along the first row.
    let minor = |i: usize, j: usize| &p[(1, i)] * &p[(2, j)] - &p[(1, j)] * &p[(2, i)];
    let determinant = &p[(0, 0)] * minor(1, 2) - &p[(0, 1)] * minor(0, 2) + &p[(0, 2)] * minor(0, 1);
    assert_eq!(determinant, ratio(-23_592_000, 1));
    assert!(matches!(p.ldl(), Err(LdlError::Indefinite(_))));
    // A semidefinite one with P_BB alone changed needs P_BB ≥ 24032000/5500 = 4369.4…
    let with = |biomass: i64| {
        let mut changed = p.clone();
        changed[(0, 0)] = ratio(biomass, 1);
        changed.ldl().is_ok()
    };
    assert!(with(4370) && !with(4369));
    assert_eq!(Preset::Repaired.start(1).extended.covariance[(0, 0)], ratio(5000, 1));
}

/// HV-P1.SKP, HV-P1.EKP, HV-Start: the presets, and that indefinite ones are refused with a witness unless the override is
/// set.
#[test]
fn indefinite_starts_are_refused() {
    for preset in Preset::ALL {
        for delay in 0..=3 {
            let mut start = preset.start(delay);
            assert_eq!(start.extended.mean.rows(), 2 + delay);
            let refused = matches!(preset, Preset::Printed | Preset::Closest);
            match start.checked(delay) {
                Err(BioreactorError::Indefinite { predictor: "standard", covariance, proof }) => {
                    assert!(refused, "{preset}");
                    assert_eq!(proof.witness.transpose().congruence(&covariance)[(0, 0)], proof.value);
                }
                outcome => assert_eq!((outcome, refused), (Ok(()), false), "{preset}"),
            }
            start.allow_indefinite = true;
            assert_eq!(start.checked(delay), Ok(()));
            let states = BioreactorError::States { predictor: "extended", expected: 3 + delay, found: 2 + delay };
            assert_eq!(start.checked(delay + 1), Err(states));
        }
    }
    let printed = Preset::Printed.start(1);
    assert_eq!(printed.standard.mean, Matrix::from_integers(&[[10], [45]]));
    let refused = table(&Options { runs: 1, ..Options::one_step(printed.clone()) }).expect_err("indefinite");
    assert!(refused.to_string().contains("-3045"), "{refused}");
    let mut skewed = printed;
    skewed.standard.covariance[(0, 1)] = ratio(499, 1);
    assert_eq!(skewed.checked(1), Err(BioreactorError::Asymmetric { predictor: "standard" }));
}

/// HV-9b, HV-Start: under a start that is a law, the recursion is the joint law conditioned once; readings that a certain
/// substrate excludes are an error.
#[test]
fn the_repaired_start_is_a_law() {
    let setting = Setting::printed(Exponent::Natural(2), 1);
    let y = readings(&setting, 5);
    let path = realised(&setting, &Preset::Repaired.start(1).standard, false, &y).expect("a valid system");
    let laws = one_shot(&path).expect("consistent");
    for (record, law) in filter(&path).expect("consistent").records.iter().zip(&laws) {
        assert_eq!(&record.filtered.mean, law.filtered.mean());
        assert_eq!(&record.filtered.covariance, law.filtered.covariance());
    }
    let certain =
        Belief { mean: Matrix::from_integers(&[[25], [31]]), covariance: Matrix::from_integers(&[[9, 0], [0, 0]]) };
    let path = realised(&setting, &certain, false, &[ratio(30, 1)]).expect("a valid system");
    let error = filter(&path).expect_err("31 was certain");
    assert!(matches!(error.source, ConditionError::Inconsistent(_)));
}
