//! Montgomery's arithmetic at the ends of its words, against remainders of double words.
//!
//! The largest prime that is used leaves the least room: what does not overflow there does not overflow at all.
//! Arithmetic is checked for overflows here, as it is in every build for tests.

use exact_kalman::modular::PrimeField;

use crate::harness::{Replays, below, cover, harness};

/// The largest prime below 2⁶².
const LARGEST: u64 = (1 << 62) - 57;

/// The remainder modulo the largest prime.
fn remainder(number: u128) -> u128 {
    number % u128::from(LARGEST)
}

/// Whether a word is the form of a number: it is below the prime, and 2⁶⁴ times the number modulo the prime.
fn is_form(form: u64, number: u128) -> bool {
    form < LARGEST && u128::from(form) == remainder(remainder(number) * remainder(1 << 64))
}

/// A word below the prime: mostly one of both ends.
fn word(kinds: u64) -> u64 {
    match below(kinds) {
        0 => 0,
        1 => 1,
        2 => LARGEST - 2,
        3 => LARGEST - 1,
        4 => LARGEST / 2,
        5 => 1 << 61,
        _ => below(LARGEST),
    }
}

harness! {
    /// Every double word t below 2⁶⁴ p is reduced to `t / 2⁶⁴ mod p`, which is below p.
    double_words_are_reduced, unwind 12, Replays::Random(20_000),
    covers ["the largest double word", "high words are equal to the largest", "low words are full"], {
        let field = PrimeField::new(LARGEST);
        let high = word(10);
        let low = match below(4) {
            0 => 0,
            1 => u64::MAX,
            2 => 1,
            _ => below(u64::MAX),
        };
        cover!(high == LARGEST - 1 && low == u64::MAX, "the largest double word");
        cover!(high == LARGEST - 1, "high words are equal to the largest");
        cover!(low == u64::MAX, "low words are full");
        // 2⁶³ · 2 high + low is t itself.
        let reduced = field.form_of_words(&[1 << 63, low], &[2 * high, 1]);
        let t = u128::from(high) << 64 | u128::from(low);
        assert!(reduced < LARGEST);
        assert!(remainder(u128::from(reduced) * remainder(1 << 64)) == remainder(t));
    }
}

harness! {
    /// `a b − c d` at the ends of the forms, where the sum of both products is the longest.
    ///
    /// Domain: all quadruples of six words at the ends and in the middle, modulo 2⁶² − 57.
    minors_do_not_overflow, unwind 12, Replays::All(6 * 6 * 6 * 6),
    covers ["the longest sum", "a difference below zero", "nothing is subtracted"], {
        let field = PrimeField::new(LARGEST);
        let [a, b, c, d] = [(); 4].map(|()| word(6));
        cover!(a == LARGEST - 1 && b == a && c == 0 && d == a, "the longest sum");
        cover!(u128::from(a) * u128::from(b) < u128::from(c) * u128::from(d), "a difference below zero");
        cover!(c == 0 || d == 0, "nothing is subtracted");
        let minor = field.minor(a, b, c, d);
        let products = [[a, b], [c, d]].map(|[x, y]| remainder(u128::from(x) * u128::from(y)));
        let difference = products[0] + u128::from(LARGEST) - products[1];
        assert!(minor < LARGEST && remainder(u128::from(minor) * remainder(1 << 64)) == remainder(difference));
    }
}

harness! {
    /// Sums of up to nine products, which are folded after every fourth, with the largest forms wherever they can stand.
    ///
    /// Domain: all sums of at most nine products of 1 or the largest form with the largest, modulo 2⁶² − 57.
    inner_products_do_not_overflow, unwind 12, Replays::All((1 << 10) - 1),
    covers ["nothing to add", "the longest sum", "something is left after folding twice"], {
        let field = PrimeField::new(LARGEST);
        let count = usize::try_from(below(10)).unwrap_or(0);
        let mut left = [0; 9];
        for word in &mut left[..count] {
            *word = if below(2) == 0 { 1 } else { LARGEST - 1 };
        }
        let right = [LARGEST - 1; 9];
        cover!(count == 0, "nothing to add");
        cover!(left == right, "the longest sum");
        cover!(count == 9, "something is left after folding twice");
        let sum = field.inner_product(&left[..count], &right);
        let expected = left[..count].iter().map(|word| remainder(u128::from(*word) * u128::from(LARGEST - 1))).sum();
        assert!(sum < LARGEST && remainder(u128::from(sum) * remainder(1 << 64)) == remainder(expected));
    }
}

harness! {
    /// A form is that of its number, for full words as well, and leads back to the remainder.
    forms_are_of_their_numbers, unwind 12, Replays::Random(20_000),
    covers ["a full word", "a word above the prime"], {
        let field = PrimeField::new(LARGEST);
        let value = if below(8) == 0 { u64::MAX } else { below(u64::MAX) };
        cover!(value == u64::MAX, "a full word");
        cover!(value > LARGEST, "a word above the prime");
        let form = field.form(value);
        assert!(is_form(form, value.into()));
        assert!(u128::from(field.residue(form)) == remainder(value.into()));
    }
}
