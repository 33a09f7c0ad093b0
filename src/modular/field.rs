//! The field of a prime below 2⁶², in Montgomery's form.

/// The integers modulo a prime below 2⁶².
///
/// An element is a word below the prime: that of the residue x is `2⁶⁴ x mod p`, its *form*. Sums of products are
/// reduced once, at their end.
///
/// # Examples
///
/// ```
/// use exact_kalman::modular::PrimeField;
///
/// let field = PrimeField::new(101);
/// let (three, seven) = (field.form(3), field.form(7));
/// assert_eq!(field.residue(field.product(three, seven)), 21);
/// assert_eq!(field.inverse(three).map(|third| field.product(third, field.form(6))), Some(field.form(2)));
/// assert_eq!(field.inverse(0), None);
/// ```
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct PrimeField {
    modulus: u64,
    /// −p⁻¹ mod 2⁶⁴
    negative_inverse: u64,
    /// 2⁶⁴ mod p: the form of 1.
    one: u64,
    /// 2¹²⁸ mod p: the form of 2⁶⁴.
    word: u64,
}

/// The number of products below p² that may be added to a number below 2⁶⁴p without an overflow.
const TERMS: usize = 4;

impl PrimeField {
    /// The field of a prime.
    ///
    /// # Panics
    ///
    /// If the modulus is even, or not between 2 and 2⁶². That it is a prime is the caller's word.
    pub const fn new(modulus: u64) -> Self {
        assert!(modulus > 2 && modulus < 1 << 62 && modulus % 2 == 1, "an odd prime below 2^62");
        // Newton's iteration doubles the number of right bits; p·p = 1 modulo 8 gives three to begin with.
        let mut inverse = modulus;
        let mut bits = 3;
        while bits < 64 {
            inverse = inverse.wrapping_mul(2u64.wrapping_sub(modulus.wrapping_mul(inverse)));
            bits *= 2;
        }
        #[expect(clippy::cast_possible_truncation, reason = "remainders modulo p")]
        let (one, word) = {
            let one = (1u128 << 64) % modulus as u128;
            (one as u64, (one * one % modulus as u128) as u64)
        };
        Self { modulus, negative_inverse: inverse.wrapping_neg(), one, word }
    }

    /// p
    pub const fn modulus(&self) -> u64 {
        self.modulus
    }

    /// The form of 1.
    pub const fn one(&self) -> u64 {
        self.one
    }

    /// The form of 1/2.
    pub const fn half(&self) -> u64 {
        // One of x and x + p is even.
        if self.one.is_multiple_of(2) { self.one / 2 } else { u64::midpoint(self.one, self.modulus) }
    }

    /// The form of a word.
    #[inline]
    pub fn form(&self, value: u64) -> u64 {
        self.product(value % self.modulus, self.word)
    }

    /// The residue of a form, between 0 and p.
    #[inline]
    pub fn residue(&self, form: u64) -> u64 {
        self.reduced(form.into())
    }

    /// `t / 2⁶⁴ mod p`, for t < 2⁶⁴ p.
    #[inline]
    #[expect(clippy::cast_possible_truncation, reason = "low and high words")]
    fn reduced(&self, t: u128) -> u64 {
        let multiple = (t as u64).wrapping_mul(self.negative_inverse);
        // t + multiple·p < 2⁶⁴ p + 2⁶⁴ p < 2¹²⁷, and its low word is zero.
        self.below(((t + u128::from(multiple) * u128::from(self.modulus)) >> 64) as u64)
    }

    /// A number below 2p, modulo p.
    #[inline]
    fn below(&self, value: u64) -> u64 {
        let less = value.wrapping_sub(self.modulus);
        if value < self.modulus { value } else { less }
    }

    /// The sum of two forms.
    #[inline]
    pub fn sum(&self, left: u64, right: u64) -> u64 {
        self.below(left + right)
    }

    /// The difference of two forms.
    #[inline]
    pub fn difference(&self, left: u64, right: u64) -> u64 {
        self.below(left + (self.modulus - right))
    }

    /// The additive inverse of a form.
    #[inline]
    pub fn negative(&self, form: u64) -> u64 {
        self.below(self.modulus - form)
    }

    /// The product of two forms.
    #[inline]
    pub fn product(&self, left: u64, right: u64) -> u64 {
        self.reduced(u128::from(left) * u128::from(right))
    }

    /// `a b − c d`
    #[inline]
    pub fn minor(&self, a: u64, b: u64, c: u64, d: u64) -> u64 {
        self.reduced(u128::from(a) * u128::from(b) + u128::from(self.modulus - c) * u128::from(d))
    }

    /// `a₁ b₁ + a₂ b₂ + …`; the shorter list ends the sum.
    #[inline]
    pub fn inner_product(&self, left: &[u64], right: &[u64]) -> u64 {
        let size = left.len().min(right.len());
        let (left, right) = (&left[..size], &right[..size]);
        let mut total = 0u128;
        let (lefts, rights) = (left.chunks_exact(TERMS), right.chunks_exact(TERMS));
        for (a, b) in lefts.remainder().iter().zip(rights.remainder()) {
            total += u128::from(*a) * u128::from(*b);
        }
        total = self.folded(total);
        for (a, b) in lefts.zip(rights) {
            total += u128::from(a[0]) * u128::from(b[0])
                + u128::from(a[1]) * u128::from(b[1])
                + u128::from(a[2]) * u128::from(b[2])
                + u128::from(a[3]) * u128::from(b[3]);
            total = self.folded(total);
        }
        self.reduced(total)
    }

    /// The form of an integer that is given by its words, the lowest first, with as many
    /// [powers of a word](Self::powers_of_a_word); the shorter list ends the sum.
    #[inline]
    #[expect(clippy::cast_possible_truncation, reason = "low and high words")]
    pub fn form_of_words(&self, words: &[u64], powers: &[u64]) -> u64 {
        let (mut total, mut carries) = (0u128, 0u64);
        for (word, power) in words.iter().zip(powers) {
            let (sum, carry) = total.overflowing_add(u128::from(*word) * u128::from(*power));
            total = sum;
            carries += u64::from(carry);
        }
        let high = (total >> 64) as u64 % self.modulus;
        let rest = self.reduced(u128::from(high) << 64 | u128::from(total as u64));
        self.sum(rest, self.product(carries, self.word))
    }

    /// A number below 2⁶⁵ p, less 2⁶⁴ p if that leaves something.
    #[inline]
    fn folded(&self, t: u128) -> u128 {
        let bound = u128::from(self.modulus) << 64;
        if t < bound { t } else { t - bound }
    }

    /// A form to a power.
    pub fn power(&self, base: u64, mut exponent: u64) -> u64 {
        let (mut square, mut result) = (base, self.one);
        while exponent > 0 {
            if exponent & 1 == 1 {
                result = self.product(result, square);
            }
            square = self.product(square, square);
            exponent >>= 1;
        }
        result
    }

    /// The multiplicative inverse of a form, by Euclid's algorithm; nothing for zero.
    pub fn inverse(&self, form: u64) -> Option<u64> {
        if form == 0 {
            return None;
        }
        // r = s·form modulo p throughout, with the signs of s alternating and |s| ≤ p.
        let (mut r, mut next) = (self.modulus, form);
        let (mut s, mut following) = (0u64, 1u64);
        let mut negative = false;
        while next > 1 {
            let quotient = r / next;
            (r, next) = (next, r - quotient * next);
            (s, following) = (following, s + quotient * following);
            negative = !negative;
        }
        let inverse = if negative { self.modulus - following } else { following };
        // The inverse of 2⁶⁴x is 2⁻⁶⁴x⁻¹; its form needs 2¹²⁸ more.
        Some(self.product(self.product(inverse, self.word), self.word))
    }

    /// Replaces forms by their inverses at the cost of one; nothing, and nothing changed, if one of them is zero.
    pub fn invert_all<const N: usize>(&self, forms: [u64; N]) -> Option<[u64; N]> {
        let mut before = [self.one; N];
        let mut all = self.one;
        for (before, form) in before.iter_mut().zip(&forms) {
            *before = all;
            all = self.product(all, *form);
        }
        let mut rest = self.inverse(all)?;
        let mut inverses = before;
        for (inverse, form) in inverses.iter_mut().zip(&forms).rev() {
            *inverse = self.product(*inverse, rest);
            rest = self.product(rest, *form);
        }
        Some(inverses)
    }

    /// The forms of 2⁶⁴, 2¹²⁸, …: with them the form of an integer is an inner product with its words.
    pub fn powers_of_a_word(&self, count: usize) -> Vec<u64> {
        std::iter::successors(Some(self.word), |power| Some(self.product(*power, self.word))).take(count).collect()
    }
}
