//! Integers from their remainders: the Chinese remainder theorem.

use std::borrow::Cow;
use std::ops::Range;

use num_bigint::{BigInt, BigUint};
use num_traits::Zero;

use super::{PRIME_BITS, PrimeField};

/// The primes whose multiples are summed directly, by the rows of a table; above that, products of large integers.
const GROUP: usize = 128;

/// Primes p₁, …, p_k with product M, and what is needed to find an integer x from its remainders:
///
/// > `x = s₁ M/p₁ + … + s_k M/p_k mod M`, `s_i = (x mod p_i) (M/p_i)⁻¹ mod p_i`
///
/// # Examples
///
/// ```
/// use exact_kalman::modular::{Basis, Digits, Primes};
/// use num_bigint::BigInt;
///
/// let x = BigInt::from(-7).pow(80);
/// let mut basis = Basis::default();
/// let mut primes = Primes::default();
/// while basis.determines() <= x.bits() {
///     basis.extend(primes.next());
/// }
/// let parts: Vec<u64> = (basis.fields().iter().zip(basis.cofactors()))
///     .map(|(field, cofactor)| {
///         let image = Digits::from(&x).form(field, &field.powers_of_a_word(4));
///         field.residue(field.product(image, field.inverse(*cofactor).expect("primes are coprime")))
///     })
///     .collect();
/// assert_eq!(basis.determined().integer(&parts), x);
/// ```
#[derive(Clone, Debug, Default)]
pub struct Basis {
    fields: Vec<PrimeField>,
    /// The forms of M/p_i modulo p_i.
    cofactors: Vec<u64>,
    groups: Vec<Group>,
    /// The products of 2, 4, 8, … neighbouring groups, where all of these are full.
    products: Vec<Vec<BigUint>>,
}

impl Basis {
    /// The fields of the primes, in the order in which they came.
    pub fn fields(&self) -> &[PrimeField] {
        &self.fields
    }

    /// The forms of M/p_i in the field of p_i.
    pub fn cofactors(&self) -> &[u64] {
        &self.cofactors
    }

    /// A b for which the remainders determine every integer x with |x| < 2^b, if the primes are some of
    /// [`Primes`](super::Primes).
    pub fn determines(&self) -> u64 {
        (PRIME_BITS * self.fields.len() as u64).saturating_sub(2)
    }

    /// What is needed to put integers together.
    pub fn determined(&self) -> Determined<'_> {
        let modulus = self.modulus(0..self.groups.len()).into_owned();
        Determined { basis: self, spine: self.spine(), half: &modulus >> 1u8, modulus }
    }

    fn spine(&self) -> Vec<BigUint> {
        let mut spine = Vec::new();
        let mut rest = 0..self.groups.len();
        while rest.len() > 1 {
            rest.start += left_half(rest.len());
            spine.push(self.modulus(rest.clone()).into_owned());
        }
        spine
    }

    /// The product of the primes of neighbouring groups.
    fn modulus(&self, groups: Range<usize>) -> Cow<'_, BigUint> {
        match (groups.len(), self.product(&groups)) {
            (0, _) => Cow::Owned(BigUint::from(1u8)),
            (1, _) => Cow::Borrowed(&self.groups[groups.start].modulus),
            (_, Some(product)) => Cow::Borrowed(product),
            (length, None) => {
                let middle = groups.start + left_half(length);
                Cow::Owned(&*self.modulus(groups.start..middle) * &*self.modulus(middle..groups.end))
            }
        }
    }

    /// The stored product of a full node of the tree.
    fn product(&self, groups: &Range<usize>) -> Option<&BigUint> {
        let length = groups.len();
        if !length.is_power_of_two() || length < 2 {
            return None;
        }
        self.products.get(length.ilog2() as usize - 1)?.get(groups.start / length)
    }

    /// Stores the products of the nodes that the last group has made full.
    fn complete(&mut self) {
        let count = self.groups.len();
        let mut length = 2;
        while count.is_multiple_of(length) {
            let middle = count - length / 2;
            let product = &*self.modulus(count - length..middle) * &*self.modulus(middle..count);
            let level = length.ilog2() as usize - 1;
            if self.products.len() == level {
                self.products.push(Vec::new());
            }
            self.products[level].push(product);
            length *= 2;
        }
    }
}

impl Extend<PrimeField> for Basis {
    /// Adds primes, which must be new and distinct.
    fn extend<T: IntoIterator<Item = PrimeField>>(&mut self, fields: T) {
        for field in fields {
            let modulus = field.modulus();
            let mut own = field.one();
            for (other, cofactor) in self.fields.iter().zip(&mut self.cofactors) {
                *cofactor = other.product(*cofactor, other.form(modulus));
                own = field.product(own, field.form(other.modulus()));
            }
            self.fields.push(field);
            self.cofactors.push(own);
            let mut group = self.groups.pop_if(|group| group.size < GROUP).unwrap_or_else(Group::empty);
            group.push(modulus);
            let is_full = group.size == GROUP;
            self.groups.push(group);
            if is_full {
                self.complete();
            }
        }
    }
}

/// The size of the left part of a node with so many groups: the largest power of two below it.
fn left_half(groups: usize) -> usize {
    groups.next_power_of_two() / 2
}

/// Up to [`GROUP`] primes.
#[derive(Clone, Debug)]
struct Group {
    size: usize,
    modulus: BigUint,
    /// The words of M/p_i, M the product of this group: a row of [`GROUP`] for the first words of all, one for the second
    /// ones, ….
    words: Vec<u64>,
}

impl Group {
    fn empty() -> Self {
        Self { size: 0, modulus: BigUint::from(1u8), words: Vec::new() }
    }

    /// Adds a prime: it multiplies what the others have, and what it has is their product.
    #[expect(clippy::cast_possible_truncation, reason = "low and high words")]
    fn push(&mut self, prime: u64) {
        let own: Vec<u64> = self.modulus.iter_u64_digits().collect();
        self.words.resize((own.len() + 1) * GROUP, 0);
        let mut carries = vec![0; self.size];
        for (row, own) in self.words.chunks_exact_mut(GROUP).zip(own.into_iter().chain([0])) {
            for (word, carry) in row.iter_mut().zip(&mut carries) {
                let product = u128::from(*word) * u128::from(prime) + u128::from(*carry);
                *word = product as u64;
                *carry = (product >> 64) as u64;
            }
            row[self.size] = own;
        }
        self.modulus *= prime;
        self.size += 1;
    }

    /// `s₁ M/p₁ + …`, for s_i < p_i.
    #[expect(clippy::cast_possible_truncation, reason = "low and high words")]
    fn sum(&self, parts: &[u64]) -> BigUint {
        let mut digits: Vec<u32> = Vec::with_capacity(2 * self.size + 4);
        let mut put = |word: u64| digits.extend([word as u32, (word >> 32) as u32]);
        let (mut total, mut carries) = (0u128, 0u64);
        for row in self.words.chunks_exact(GROUP) {
            let row = &row[..self.size];
            let (rows, parts) = (row.chunks_exact(4), parts.chunks_exact(4));
            let mut rest = 0u128;
            for (a, b) in rows.remainder().iter().zip(parts.remainder()) {
                rest += u128::from(*a) * u128::from(*b);
            }
            let mut add = |sum: u128| {
                let (sum, carry) = total.overflowing_add(sum);
                total = sum;
                carries += u64::from(carry);
            };
            add(rest);
            for (a, b) in rows.zip(parts) {
                // Parts are below 2⁶²: four products are below 2¹²⁸.
                add(u128::from(a[0]) * u128::from(b[0])
                    + u128::from(a[1]) * u128::from(b[1])
                    + u128::from(a[2]) * u128::from(b[2])
                    + u128::from(a[3]) * u128::from(b[3]));
            }
            put(total as u64);
            total = total >> 64 | u128::from(carries) << 64;
            carries = 0;
        }
        put(total as u64);
        put((total >> 64) as u64);
        BigUint::new(digits)
    }
}

/// The primes of a [`Basis`] with the products that its last groups need.
#[derive(Clone, Debug)]
pub struct Determined<'a> {
    basis: &'a Basis,
    /// The moduli of the right parts of the nodes along the right edge of the tree, from the root downwards.
    spine: Vec<BigUint>,
    modulus: BigUint,
    half: BigUint,
}

impl Determined<'_> {
    /// The integer between −M/2 and M/2 with these parts `s_i = (x mod p_i) (M/p_i)⁻¹ mod p_i`.
    ///
    /// # Panics
    ///
    /// If there are not as many parts as primes.
    pub fn integer(&self, parts: &[u64]) -> BigInt {
        assert_eq!(parts.len(), self.basis.fields.len(), "a part for each prime");
        if parts.is_empty() {
            return BigInt::zero();
        }
        let rest = self.sum(parts, 0..self.basis.groups.len(), Some(0)) % &self.modulus;
        if rest > self.half { BigInt::from(rest) - BigInt::from(self.modulus.clone()) } else { rest.into() }
    }

    /// The sum over neighbouring groups, modulo nothing: at most the number of primes times their product.
    fn sum(&self, parts: &[u64], groups: Range<usize>, depth: Option<usize>) -> BigUint {
        if groups.len() == 1 {
            let last = parts.len().min(groups.end * GROUP);
            return self.basis.groups[groups.start].sum(&parts[groups.start * GROUP..last]);
        }
        let middle = groups.start + left_half(groups.len());
        let (left, right) = (groups.start..middle, middle..groups.end);
        // Off the right edge all nodes are full, and their products stored.
        let right_modulus = match depth {
            Some(depth) => Cow::Borrowed(&self.spine[depth]),
            None => self.basis.modulus(right.clone()),
        };
        let left_modulus = self.basis.modulus(left.clone());
        self.sum(parts, left, None) * &*right_modulus
            + self.sum(parts, right, depth.map(|depth| depth + 1)) * &*left_modulus
    }
}
