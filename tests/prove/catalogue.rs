//! Every identity, at its light sizes and at random points: `exact-kalman prove` runs all sizes.

use std::collections::BTreeSet;

use exact_kalman::prove::{Failure, catalogue};
use exact_kalman::scalar::{Rational, ratio};
use exact_kalman::spec::entries;

/// CKS-L3-pinv, HV-L3, CKS-L3i, CKS-L3ii, CKS-T, CKS-K, HV-4, EK-L1, EK-L3, WG-52, WG-53, AK-L4.1iv, AK-4.1, AK-L4.3-id, AK-B.V, AK-B.W, SM-4.6,
/// SM-4.7, HV-X.ad, HV-X.da: proved over the rational functions, at small sizes.
#[test]
fn identities_are_proved_at_small_sizes() {
    for identity in catalogue() {
        for &size in &identity.symbolic {
            let proof = identity.proved(size);
            assert!(proof.as_ref().is_ok_and(|proof| proof.terms > 0), "{} at {size}: {proof:?}", identity.name);
        }
    }
}

/// The same code at larger sizes; another seed gives other points and the same bound.
#[test]
fn identities_hold_at_random_points() {
    for identity in catalogue() {
        for &size in &identity.random {
            let chances = [1, 2].map(|seed| {
                identity.chance(size, seed).unwrap_or_else(|failure| panic!("{}, {size}: {failure}", identity.name))
            });
            assert_eq!(chances[0], chances[1], "{} at {size}", identity.name);
            assert!(
                chances[0].bound() <= ratio(1, 1_000_000_000_000_000_000),
                "{} at {size}: {:?}",
                identity.name,
                chances[0]
            );
            assert!(chances[0].degree > 0 && chances[0].questions > 0);
        }
    }
}

/// Every twin fails at small integers, and over the rational functions.
#[test]
fn twins_are_disproved() {
    for identity in catalogue() {
        let witness = identity.twin_disproved().unwrap_or_else(|failure| panic!("{}: {failure}", identity.name));
        let is_small = |entry: &Rational| entry.is_integer() && *entry <= ratio(9, 1) && *entry >= ratio(-9, 1);
        assert!(witness.point.iter().flat_map(|(_, matrix)| matrix.entries()).all(is_small));
        let outcomes: Vec<_> = identity.symbolic.iter().take(3).map(|&size| identity.twin_proved(size)).collect();
        let differs = |outcome: &Result<_, _>| matches!(outcome, Err(Failure::Differs { .. }));
        assert!(outcomes.iter().any(differs), "{}: {outcomes:?}", identity.name);
    }
}

/// Identifiers are those of entries, and every identity has a hypothesis and sizes of both kinds.
#[test]
fn identifiers_are_those_of_the_specification() {
    let entries = entries().expect("a page");
    let known: BTreeSet<&str> = entries.iter().map(|entry| entry.id).collect();
    let identities = catalogue();
    for identity in &identities {
        assert!(!identity.symbolic.is_empty() && !identity.random.is_empty() && !identity.hypothesis.is_empty());
        for id in identity.identifiers {
            assert!(known.contains(id), "{id}");
        }
    }
    let names: BTreeSet<&str> = identities.iter().map(|identity| identity.name).collect();
    assert_eq!(names.len(), identities.len());
}
