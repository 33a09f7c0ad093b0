//! Quotients that are known to be integers, without division.

use std::borrow::Cow;

use num_bigint::{BigInt, BigUint};
use num_traits::{One, Zero};

/// Divisors shorter than this are divided by.
const SHORTEST: u64 = 1_000;

/// `(p a − q b) / d` for one pivot p and one positive divisor d, where all these quotients are integers.
///
/// With d = 2^s d₁, d₁ odd, the quotient is determined by `(p/d₁) a − (q/d₁) b` modulo a power of two longer than
/// itself. p/d₁ is worked out once, q/d₁ once for each row, so each quotient costs its two products and nothing else.
pub(super) struct Minors<'a> {
    pivot: &'a BigInt,
    divisor: &'a BigInt,
    residues: Option<Residues>,
}

/// Of one row, whose factor q is the same for all its quotients.
pub(super) struct Row<'a> {
    minors: &'a Minors<'a>,
    factor: Cow<'a, BigInt>,
}

/// Modulo a power of two.
struct Residues {
    modulus: Modulus,
    /// 1/d₁
    inverse: BigInt,
    /// p/d₁
    pivot: BigInt,
    /// s
    twos: u64,
}

impl<'a> Minors<'a> {
    /// For quotients whose numerators `p a − q b` have at most this length in bits.
    pub(super) fn of(pivot: &'a BigInt, divisor: &'a BigInt, numerator_bits: u64) -> Self {
        let residues = (divisor.bits() >= SHORTEST).then(|| Residues::of(pivot, divisor, numerator_bits));
        Self { pivot, divisor, residues }
    }

    pub(super) fn row(&'a self, factor: &'a BigInt) -> Row<'a> {
        let factor = match &self.residues {
            Some(residues) => Cow::Owned(residues.modulus.residue(factor * &residues.inverse)),
            None => Cow::Borrowed(factor),
        };
        Row { minors: self, factor }
    }
}

impl Row<'_> {
    /// `(p a − q b) / d`
    pub(super) fn quotient(&self, a: &BigInt, b: &BigInt) -> BigInt {
        match &self.minors.residues {
            Some(Residues { modulus, pivot, twos, .. }) => modulus.residue(pivot * a - &*self.factor * b) >> *twos,
            None => (self.minors.pivot * a - &*self.factor * b) / self.minors.divisor,
        }
    }
}

impl Residues {
    fn of(pivot: &BigInt, divisor: &BigInt, numerator_bits: u64) -> Self {
        let twos = divisor.trailing_zeros().unwrap_or(0);
        // One bit more than 2^s times the quotient, for its sign.
        let modulus = Modulus::of_bits(numerator_bits.saturating_sub(divisor.bits()) + twos + 2);
        let inverse = BigInt::from(modulus.inverse(&(divisor.magnitude() >> twos)));
        Self { pivot: modulus.residue(pivot * &inverse), inverse, twos, modulus }
    }
}

/// A power of two, of whole words.
struct Modulus {
    words: usize,
    /// The modulus less one.
    mask: BigUint,
}

impl Modulus {
    /// Of at least so many bits.
    fn of_bits(bits: u64) -> Self {
        Self::of(usize::try_from(bits.div_ceil(64)).unwrap_or(usize::MAX))
    }

    fn of(words: usize) -> Self {
        Self { words, mask: BigUint::new(vec![u32::MAX; 2 * words]) }
    }

    /// The residue that is nearest to zero.
    fn residue(&self, number: BigInt) -> BigInt {
        let (sign, mut magnitude) = number.into_parts();
        magnitude &= &self.mask;
        if magnitude.bits() == self.mask.bits() {
            return BigInt::from_biguint(-sign, &self.mask - magnitude + 1u32);
        }
        BigInt::from_biguint(sign, magnitude)
    }

    /// The inverse of an odd number, by Newton's iteration, each step of which doubles the known words.
    fn inverse(&self, odd: &BigUint) -> BigUint {
        if self.words <= 1 {
            return odd.iter_u64_digits().next().map_or_else(BigUint::one, |word| inverse_of_word(word).into());
        }
        let half = Self::of(self.words.div_ceil(2));
        let known = half.inverse(odd);
        let known_bits = half.mask.bits();
        let rest = Self::of(self.words - half.words);
        // odd · known = 1 + 2^bits · error
        let error = (((odd & &self.mask) * &known) >> known_bits) & &rest.mask;
        let correction = (error * (&known & &rest.mask)) & &rest.mask;
        if correction.is_zero() { known } else { known + ((&rest.mask - correction + 1u32) << known_bits) }
    }
}

/// The inverse of an odd word modulo 2⁶⁴: each number is its own inverse modulo 8, and each step doubles the bits.
fn inverse_of_word(odd: u64) -> u64 {
    (0..5).fold(odd, |known, _| known.wrapping_mul(2u64.wrapping_sub(odd.wrapping_mul(known))))
}

#[cfg(test)]
mod tests {
    use proptest::prelude::*;

    use super::*;

    fn number(words: std::ops::Range<usize>) -> impl Strategy<Value = BigInt> {
        let words = proptest::collection::vec(any::<u32>(), words);
        (any::<bool>(), words, 0u32..80).prop_map(|(negative, words, twos)| {
            let magnitude = BigInt::from(BigUint::new(words)) << twos;
            if negative { -magnitude } else { magnitude }
        })
    }

    /// Odd and even alike.
    fn positive(words: std::ops::Range<usize>) -> impl Strategy<Value = BigInt> {
        number(words).prop_map(|number| BigInt::from(number.magnitude().clone()).max(BigInt::one()))
    }

    proptest! {
        /// By residues and by division, for even and odd divisors and factors of both signs.
        #[test]
        fn residues_eq_division(p in positive(1..12), q in number(0..12), d in positive(1..12), r in number(0..12), t in number(0..4)) {
            // Numerators that d divides: q t p cancels.
            let (a, b) = (&d * &r + &q * &t, &d * &q + &p * &t);
            let numerator = &p * &a - &q * &b;
            let bits = (p.bits() + a.bits()).max(q.bits() + b.bits()) + 1;
            prop_assert!((&numerator % &d).is_zero());
            let minors = Minors { pivot: &p, divisor: &d, residues: Some(Residues::of(&p, &d, bits)) };
            prop_assert_eq!(minors.row(&q).quotient(&a, &b), numerator / &d);
        }

        /// The least modulus that the contract allows is enough.
        #[test]
        fn the_least_modulus_is_enough(r in number(0..12), d in positive(1..12)) {
            let p = BigInt::one();
            let a = &r * &d;
            let minors = Minors { pivot: &p, divisor: &d, residues: Some(Residues::of(&p, &d, a.bits())) };
            prop_assert_eq!(minors.row(&BigInt::zero()).quotient(&a, &BigInt::zero()), r);
        }

        #[test]
        fn inverse_times_number_is_one(odd in number(0..40), words in 1usize..20) {
            let odd = (odd.magnitude() << 1u8) + 1u8;
            let modulus = Modulus::of(words);
            prop_assert_eq!((modulus.inverse(&odd) * odd) & &modulus.mask, BigUint::one());
        }
    }
}
