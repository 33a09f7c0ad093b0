//! Many integers over one denominator, each quotient in lowest terms: the work that they share is done once.
//!
//! What all numerators share with the denominator is divided out first, if it is long; then the single divisors are
//! those of short numbers. Nothing here is likely only: whatever the numbers are, the quotients are in lowest terms.
//! (A product of all numerators modulo the denominator would tell by one greatest common divisor that none shares
//! anything, but a product and a remainder cost as much as the divisor that they save.)

use num_bigint::BigInt;
use num_traits::{One, Zero};

use crate::scalar::{Rational, common_divisor};

/// Common factors of fewer bits are not worth a division of all numerators.
const WORTHWHILE: u64 = 128;

/// Every quotient in lowest terms; the denominator is positive.
pub(super) fn lowest_terms(numerators: &[&BigInt], denominator: &BigInt) -> Vec<Rational> {
    let Some((first, others)) = numerators.split_first() else { return Vec::new() };
    let shared = common_divisor(first, denominator);
    let content = content(&shared, others);
    if content.is_one() {
        let others = others.iter().map(|other| reduced(other, denominator, &common_divisor(other, denominator)));
        return std::iter::once(reduced(first, denominator, &shared)).chain(others).collect();
    }
    let denominator = denominator / &content;
    let others = others.iter().map(|&other| {
        let other = other / &content;
        reduced(&other, &denominator, &common_divisor(&other, &denominator))
    });
    std::iter::once(reduced(&(*first / &content), &denominator, &(shared / &content))).chain(others).collect()
}

/// The quotient of two integers without what they share.
fn reduced(numerator: &BigInt, denominator: &BigInt, shared: &BigInt) -> Rational {
    if numerator.is_zero() {
        Rational::zero()
    } else if shared.is_one() {
        Rational::new_raw(numerator.clone(), denominator.clone())
    } else {
        Rational::new_raw(numerator / shared, denominator / shared)
    }
}

/// What a divisor shares with all these numbers; one if that is short, or if there is no number.
fn content(divisor: &BigInt, numbers: &[&BigInt]) -> BigInt {
    let mut content = divisor.clone();
    for number in numbers {
        if content.bits() <= WORTHWHILE {
            break;
        }
        content = common_divisor(&content, number);
    }
    if numbers.is_empty() || content.bits() <= WORTHWHILE { BigInt::one() } else { content }
}
