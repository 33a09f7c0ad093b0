//! An integer as its machine words, ready to be taken modulo primes.

use num_bigint::{BigInt, Sign};

use super::PrimeField;

/// The sign and the words of an integer, the lowest first.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Digits {
    negative: bool,
    words: Vec<u64>,
}

impl From<&BigInt> for Digits {
    fn from(value: &BigInt) -> Self {
        Self { negative: value.sign() == Sign::Minus, words: value.iter_u64_digits().collect() }
    }
}

impl Digits {
    /// The number of words.
    pub fn len(&self) -> usize {
        self.words.len()
    }

    /// Whether the integer is zero.
    pub fn is_empty(&self) -> bool {
        self.words.is_empty()
    }

    /// The form of the integer in a field, of which enough powers of a word are given.
    ///
    /// # Panics
    ///
    /// If there are fewer powers than words.
    #[inline]
    pub fn form(&self, field: &PrimeField, powers: &[u64]) -> u64 {
        assert!(powers.len() >= self.words.len(), "a power for each word");
        let form = field.form_of_words(&self.words, powers);
        if self.negative { field.negative(form) } else { form }
    }
}
