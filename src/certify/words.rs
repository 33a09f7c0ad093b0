//! Arithmetic on integers that stand in a place of fixed length, word by word, the least first.
//!
//! With integers this short, memory that is asked for and given back takes longer than multiplying. So a sum of products is made in one
//! place: in two's complement, of which the magnitude is taken at the end.

const WORD: u64 = 64;

/// An integer as its magnitude, without leading zeros, and its sign.
#[derive(Clone, Copy, Debug)]
pub(super) struct Integer<'w> {
    pub(super) words: &'w [u64],
    pub(super) negative: bool,
}

impl<'w> Integer<'w> {
    pub(super) fn new(words: &'w [u64], negative: bool) -> Self {
        Self { words: &words[..used(words)], negative }
    }

    pub(super) fn negated(self) -> Self {
        Self { negative: !self.negative, ..self }
    }

    /// The length of the magnitude in bits.
    pub(super) fn bits(self) -> u64 {
        let above = self.words.len().saturating_sub(1) as u64 * WORD;
        self.words.last().map_or(0, |last| above + WORD - u64::from(last.leading_zeros()))
    }
}

/// How many words there are up to the last one that is not zero.
pub(super) fn used(words: &[u64]) -> usize {
    words.iter().rposition(|&word| word != 0).map_or(0, |last| last + 1)
}

/// Words that hold so many bits and a sign.
pub(super) fn length(bits: u64) -> usize {
    usize::try_from(bits / WORD + 1).unwrap_or(usize::MAX)
}

/// Adds a product to a sum in two's complement.
pub(super) fn add_product(sum: &mut [u64], a: Integer<'_>, b: Integer<'_>) {
    let adds = a.negative == b.negative;
    for (i, &x) in a.words.iter().enumerate() {
        if x == 0 {
            continue;
        }
        let (mut carry, mut rest) = (0_u64, sum[i..].iter_mut());
        for &y in b.words {
            let Some(word) = rest.next() else { return };
            // (2^64 − 1)² + (2^64 − 1) < 2^128
            let product = u128::from(x) * u128::from(y) + u128::from(carry);
            #[expect(clippy::cast_possible_truncation, reason = "the two halves of a product")]
            let (low, high) = (product as u64, (product >> 64) as u64);
            let (next, overflows) = if adds { word.overflowing_add(low) } else { word.overflowing_sub(low) };
            *word = next;
            // The upper half is all ones only where the lower is zero, and then nothing overflows.
            carry = high + u64::from(overflows);
        }
        for word in rest {
            if carry == 0 {
                break;
            }
            let (next, overflows) = if adds { word.overflowing_add(carry) } else { word.overflowing_sub(carry) };
            *word = next;
            carry = u64::from(overflows);
        }
    }
}

/// Adds `a · 2^places` to a sum in two's complement.
pub(super) fn add_shifted(sum: &mut [u64], a: Integer<'_>, places: u64) {
    let (skipped, shift) = (usize::try_from(places / WORD).unwrap_or(usize::MAX), places % WORD);
    let (mut below, mut carry) = (0, false);
    for (i, word) in sum.iter_mut().skip(skipped).enumerate() {
        let own = a.words.get(i).copied();
        let lifted = own.unwrap_or(0) << shift | below;
        below = if shift == 0 { 0 } else { own.unwrap_or(0) >> (WORD - shift) };
        let (next, first) = if a.negative { word.overflowing_sub(lifted) } else { word.overflowing_add(lifted) };
        let (next, second) =
            if a.negative { next.overflowing_sub(carry.into()) } else { next.overflowing_add(carry.into()) };
        (*word, carry) = (next, first || second);
        if own.is_none() && !carry {
            break;
        }
    }
}

/// Writes `a / 2^dropped`, rounded to the nearest integer, upward from the middle, into a place of zeros in two's complement, and
/// says whether it is that exactly.
pub(super) fn put_nearest(place: &mut [u64], a: Integer<'_>, dropped: u64) -> bool {
    let (skipped, shift) = (usize::try_from(dropped / WORD).unwrap_or(usize::MAX), dropped % WORD);
    let kept = a.words.get(skipped..).unwrap_or_default();
    for (i, word) in place.iter_mut().enumerate().take(kept.len()) {
        let above = if shift == 0 { 0 } else { kept.get(i + 1).map_or(0, |next| next << (WORD - shift)) };
        *word = kept[i] >> shift | above;
    }
    let bit = |bit: u64| {
        let word = usize::try_from(bit / WORD).ok().and_then(|word| a.words.get(word));
        word.is_some_and(|word| word >> (bit % WORD) & 1 == 1)
    };
    let lies_below = |bits: u64| {
        let whole = usize::try_from(bits / WORD).unwrap_or(usize::MAX);
        a.words.iter().take(whole).any(|&word| word != 0)
            || a.words.get(whole).is_some_and(|word| word & ((1 << (bits % WORD)) - 1) != 0)
    };
    if dropped == 0 || !lies_below(dropped) {
        if a.negative {
            negate(place);
        }
        return true;
    }
    // From the middle a magnitude goes up for a positive number, down for a negative one.
    if bit(dropped - 1) && (!a.negative || lies_below(dropped - 1)) {
        add_product(place, Integer { words: &[1], negative: false }, Integer { words: &[1], negative: false });
    }
    if a.negative {
        negate(place);
    }
    false
}

/// Multiplies a number in two's complement by `2^places`.
pub(super) fn lift(words: &mut [u64], places: u64) {
    let (skipped, shift) = (usize::try_from(places / WORD).unwrap_or(usize::MAX), places % WORD);
    if places == 0 {
        return;
    }
    for i in (0..words.len()).rev() {
        let own = |back: usize| i.checked_sub(back).map_or(0, |from| words[from]);
        let (word, below) = (own(skipped), own(skipped.saturating_add(1)));
        words[i] = if shift == 0 { word } else { word << shift | below >> (WORD - shift) };
    }
}

pub(super) fn negate(words: &mut [u64]) {
    let mut carry = true;
    for word in words {
        let (next, overflows) = (!*word).overflowing_add(u64::from(carry));
        *word = next;
        carry = overflows;
    }
}

#[cfg(test)]
mod tests {
    use num_bigint::{BigInt, Sign};
    use proptest::prelude::*;

    use super::*;

    fn words() -> impl Strategy<Value = Vec<u64>> {
        let word = prop_oneof![Just(0), Just(1), Just(u64::MAX), Just(1 << 63), any::<u64>()];
        proptest::collection::vec(word, 0..4)
    }

    fn whole(integer: Integer<'_>) -> BigInt {
        let magnitude = integer.words.iter().rev().fold(BigInt::from(0), |sum, &word| (sum << 64) + word);
        if integer.negative { -magnitude } else { magnitude }
    }

    /// The value of a place in two's complement.
    fn value(place: &[u64]) -> BigInt {
        let bytes: Vec<u8> = place.iter().flat_map(|word| word.to_le_bytes()).collect();
        BigInt::from_signed_bytes_le(&bytes)
    }

    proptest! {
        /// Shifted numbers are added as integers are.
        #[test]
        fn shifted_numbers_are_added(
            (a, b) in (words(), words()), (minus, less) in any::<(bool, bool)>(), (p, q) in (0..140_u64, 0..140_u64),
        ) {
            let (a, b) = (Integer::new(&a, minus), Integer::new(&b, less));
            let mut sum = vec![0; 10];
            add_shifted(&mut sum, a, p);
            add_shifted(&mut sum, b, q);
            prop_assert_eq!(value(&sum), (whole(a) << p) + (whole(b) << q));
            prop_assert_eq!(a.bits(), whole(a).bits());
            lift(&mut sum, q);
            prop_assert_eq!(value(&sum), ((whole(a) << p) + (whole(b) << q)) << q);
        }

        /// The nearest integer is the floor of a half more, and exact where nothing was dropped.
        #[test]
        fn the_nearest_integer_is_put(a in words(), minus in any::<bool>(), dropped in 0..270_u64) {
            let a = Integer::new(&a, minus && a.iter().any(|&word| word != 0));
            let mut place = vec![0; length(a.bits() + 1)];
            let is_exact = put_nearest(&mut place, a, dropped);
            let twice = (whole(a) << 1) + (BigInt::from(1) << dropped);
            prop_assert_eq!(value(&place), twice >> (dropped + 1));
            prop_assert_eq!(is_exact, (whole(a) >> dropped) << dropped == whole(a));
            prop_assert!(a.words.is_empty() || (whole(a).sign() == Sign::Minus) == a.negative);
        }
    }
}
