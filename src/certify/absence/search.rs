//! The search for modes that forbid a stabilising solution, in one prime field after the other.

use super::circle;
use super::invariant::{Images, Invariant};
use super::polynomial::Polynomial;
use super::proof::Absence;
use super::remainder::{Mersenne521, Mersenne2203, Remainder};
use super::spectrum::{characteristic_polynomial, is_unstable};
use crate::model::UnifiedStep;
use crate::scalar::{Mersenne61, Rational, ratio};

/// What a search found.
pub(super) enum Found {
    /// Modes that forbid a solution.
    Proof(Box<Absence>),
    /// There are none; that is proved.
    Nothing,
    /// None were found, with a singular R, where there may be others.
    Inconclusive,
    /// The numbers are too long for this field.
    Unknown,
}

impl Found {
    fn proof(absence: Absence) -> Self {
        Self::Proof(Box::new(absence))
    }
}

/// In fields of long numbers the work is bounded by fewer dimensions.
const LONG_DIMENSIONS: usize = 48;

/// Unobservable modes of modulus 1 or more.
pub(super) fn unobservable(step: &UnifiedStep) -> Found {
    in_fields(unobservable_in::<Mersenne61>, unobservable_in::<Mersenne521>, unobservable_in::<Mersenne2203>, step)
}

/// Modes on the unit circle that no noise reaches.
pub(super) fn unreachable(step: &UnifiedStep) -> Found {
    in_fields(unreachable_in::<Mersenne61>, unreachable_in::<Mersenne521>, unreachable_in::<Mersenne2203>, step)
}

type Search = fn(&UnifiedStep, usize) -> Found;

/// The first answer; longer primes hold longer fractions.
fn in_fields(short: Search, long: Search, longest: Search, step: &UnifiedStep) -> Found {
    for (search, dimensions) in [(short, usize::MAX), (long, LONG_DIMENSIONS), (longest, LONG_DIMENSIONS)] {
        let found = search(step, dimensions);
        if !matches!(found, Found::Unknown) {
            return found;
        }
    }
    Found::Unknown
}

fn unobservable_in<F: Remainder>(step: &UnifiedStep, dimensions: usize) -> Found {
    let Some(images) = Images::<F>::of(step) else { return Found::Unknown };
    let all = images.unobservable();
    if all.dimension() == 0 {
        return Found::Nothing;
    }
    if all.dimension() > dimensions {
        return Found::Unknown;
    }
    let paired = Paired::of(&all);
    if let Some(fixed) = paired.fixed(&all) {
        let exact = fixed.unobserved(step).filter(is_fixed);
        return exact.map_or(Found::Unknown, |rows| Found::proof(Absence::unobservable(&rows)));
    }
    if paired.divisor.degree() > 0 {
        // Of z and 1/z one has modulus 1 or more.
        let exact = paired.cyclic(&all).and_then(|part| part.unobserved(step));
        let exact = exact.filter(|rows| paired_polynomial(rows).is_some());
        return exact.map_or(Found::Unknown, |rows| Found::proof(Absence::unobservable(&rows)));
    }
    // The rank over the fractions is at least that modulo the prime: these are all unobservable rows.
    let Some(rows) = all.unobserved(step) else { return Found::Unknown };
    match is_unstable(&rows.map) {
        Some(true) => Found::proof(Absence::unobservable(&rows)),
        Some(false) => Found::Nothing,
        None => Found::Unknown,
    }
}

fn unreachable_in<F: Remainder>(step: &UnifiedStep, dimensions: usize) -> Found {
    let Some(images) = Images::<F>::of(step) else { return Found::Unknown };
    // R that is regular modulo a prime is regular.
    let nothing = if images.is_noise_regular() { Found::Nothing } else { Found::Inconclusive };
    let Some(all) = images.unreachable(dimensions) else { return Found::Inconclusive };
    if all.dimension() == 0 {
        return nothing;
    }
    if all.dimension() > dimensions {
        return Found::Unknown;
    }
    let paired = Paired::of(&all);
    if paired.divisor.degree() == 0 {
        return nothing;
    }
    if let Some(fixed) = paired.fixed(&all) {
        let exact = fixed.unreached(step).filter(is_fixed);
        return exact.map_or(Found::Unknown, |rows| Found::proof(Absence::unreachable(rows, None)));
    }
    let Some(rows) = paired.cyclic(&all).and_then(|part| part.unreached(step)) else { return Found::Unknown };
    let Some(polynomial) = paired_polynomial(&rows) else { return Found::Unknown };
    if polynomial.square_free() != polynomial {
        return Found::Unknown;
    }
    if let Some(between) = circle::bracket(&circle::folded(&polynomial)) {
        return Found::proof(Absence::unreachable(rows, Some(between)));
    }
    let part = all.annihilated(&paired.divisor);
    if is_all_off_circle(&part, &paired.divisor, step) { nothing } else { Found::Unknown }
}

/// Whether the map is 1 or −1, not only modulo the prime.
fn is_fixed(rows: &Invariant<Rational>) -> bool {
    rows.map.entries().iter().all(|entry| *entry == ratio(1, 1) || *entry == ratio(-1, 1))
}

/// Whether the rows that the divisor annihilates show that it is the image of the divisor over the fractions, and that this has no
/// root on the circle.
///
/// The characteristic polynomial c of these rows divides that of all rows. If it is self-reciprocal and of the degree of the divisor modulo
/// the prime, which is not below that over the fractions, it is the divisor over the fractions, with all the roots on the circle.
fn is_all_off_circle<F: Remainder>(rows: &Invariant<F>, divisor: &Polynomial<F>, step: &UnifiedStep) -> bool {
    let polynomial = rows.unreached(step).as_ref().and_then(paired_polynomial);
    polynomial.is_some_and(|c| c.degree() == divisor.degree() && !circle::has_root(&circle::folded(&c)))
}

/// The characteristic polynomial, if it is self-reciprocal and has neither root ±1.
fn paired_polynomial(rows: &Invariant<Rational>) -> Option<Polynomial<Rational>> {
    let polynomial = characteristic_polynomial(&rows.map)?;
    let ends = [ratio(1, 1), ratio(-1, 1)];
    let is_paired = circle::is_self_reciprocal(&polynomial) && ends.iter().all(|end| polynomial.at(end) != ratio(0, 1));
    is_paired.then_some(polynomial)
}

/// The part of a characteristic polynomial whose roots come in pairs z and 1/z: those on the circle are among them.
///
/// The divisor over the fractions is monic and divides polynomials without the prime in a denominator, so that its image divides the
/// divisor modulo the prime: where this has degree 0, no root is on the circle.
struct Paired<F> {
    divisor: Polynomial<F>,
}

impl<F: Remainder> Paired<F> {
    fn of(rows: &Invariant<F>) -> Self {
        let polynomial = Polynomial::new(rows.map.characteristic_polynomial());
        Self { divisor: polynomial.common_divisor(&polynomial.reciprocal()) }
    }

    /// Rows with each of these roots once.
    fn cyclic(&self, rows: &Invariant<F>) -> Option<Invariant<F>> {
        let roots = self.divisor.square_free();
        rows.annihilated(&roots).cyclic(roots.degree())
    }

    /// One row with the eigenvalue 1 or −1, if there is one.
    fn fixed(&self, rows: &Invariant<F>) -> Option<Invariant<F>> {
        let one = F::one();
        let end = [one.clone(), one.negated()].into_iter().find(|end| self.divisor.at(end).is_zero())?;
        Some(rows.annihilated(&Polynomial::new(vec![end.negated(), one])).of_first(1))
    }
}
