//! Arithmetic modulo word-sized primes, against arithmetic on large integers.

use exact_kalman::modular::{Basis, Digits, PRIME_BITS, PrimeField, Primes};
use num_bigint::{BigInt, BigUint};
use num_integer::Integer as _;
use proptest::prelude::*;

fn largest() -> PrimeField {
    PrimeField::new((1 << 62) - 57)
}

/// Small primes, where every residue occurs, and the largest one, where words are full.
fn fields() -> impl Strategy<Value = PrimeField> {
    prop_oneof![
        Just(largest()),
        Just(PrimeField::new(3)),
        Just(PrimeField::new(101)),
        Just(PrimeField::new((1 << 61) - 1))
    ]
}

fn integer(words: &[u64], negative: bool) -> BigInt {
    let magnitude = words.iter().rev().fold(BigUint::default(), |all, word| (all << 64u8) + word);
    if negative { -BigInt::from(magnitude) } else { magnitude.into() }
}

fn residue(value: &BigInt, field: &PrimeField) -> u64 {
    u64::try_from(value.mod_floor(&field.modulus().into())).expect("a remainder below the prime")
}

/// The product M of the primes, and `x (M/p)⁻¹ mod p` for each of them, by division.
fn parts_by_division(basis: &Basis, value: &BigInt) -> (BigInt, Vec<u64>) {
    let product: BigInt = basis.fields().iter().map(|field| BigInt::from(field.modulus())).product();
    let part = |field: &PrimeField| {
        let inverse = (&product / field.modulus()).modinv(&field.modulus().into()).expect("distinct primes");
        residue(&(inverse * value), field)
    };
    let parts = basis.fields().iter().map(part).collect();
    (product, parts)
}

/// Extreme words are likelier than in a uniform draw.
fn word() -> impl Strategy<Value = u64> {
    prop_oneof![any::<u64>(), Just(0), Just(1), Just(u64::MAX), Just((1 << 62) - 58), Just(1 << 63)]
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 400, failure_persistence: None, ..ProptestConfig::default() })]

    #[test]
    fn field_operations_are_those_of_remainders(field in fields(), [a, b, c, d] in [word(), word(), word(), word()]) {
        let p = u128::from(field.modulus());
        let wide = |x: u64| u128::from(x) % p;
        let [x, y, z, w] = [a, b, c, d].map(|x| field.form(x));
        let equal = |form: u64, expected: u128| u128::from(field.residue(form)) == expected % p;
        prop_assert!(equal(x, wide(a)) && equal(field.one(), 1) && equal(field.product(field.half(), field.form(2)), 1));
        prop_assert!(equal(field.sum(x, y), wide(a) + wide(b)));
        prop_assert!(equal(field.difference(x, y), wide(a) + p - wide(b)));
        prop_assert!(equal(field.sum(field.negative(x), x), 0));
        prop_assert!(equal(field.product(x, y), wide(a) * wide(b)));
        prop_assert!(equal(field.minor(x, y, z, w), wide(a) * wide(b) % p + p - wide(c) * wide(d) % p));
        prop_assert!(field.inverse(x).map_or(wide(a) == 0, |inverse| equal(field.product(inverse, x), 1)));
        match field.invert_all([x, y, z]) {
            Some(inverses) => for (inverse, form) in inverses.into_iter().zip([x, y, z]) {
                prop_assert!(equal(field.product(inverse, form), 1));
            },
            None => prop_assert!([a, b, c].into_iter().any(|x| wide(x) == 0)),
        }
    }

    #[test]
    fn inner_products_do_not_overflow(field in fields(), pairs in prop::collection::vec((word(), word()), 0..40)) {
        let p = u128::from(field.modulus());
        let (left, right): (Vec<u64>, Vec<u64>) = pairs.iter().map(|(a, b)| (field.form(*a), field.form(*b))).unzip();
        let expected = pairs.iter().fold(0, |sum, (a, b)| (sum + u128::from(*a) % p * (u128::from(*b) % p)) % p);
        prop_assert_eq!(u128::from(field.residue(field.inner_product(&left, &right))), expected);
    }

    #[test]
    fn images_of_integers_are_remainders(
        field in fields(), words in prop::collection::vec(word(), 0..40), negative in any::<bool>(),
    ) {
        let value = integer(&words, negative);
        let form = Digits::from(&value).form(&field, &field.powers_of_a_word(40));
        prop_assert_eq!(field.residue(form), residue(&value, &field));
    }

    /// The parts are made from remainders by division, the basis grows in two strides.
    #[test]
    fn integers_follow_from_their_remainders(
        words in prop::collection::vec(word(), 0..300), negative in any::<bool>(), first in 0usize..300, spare in 0usize..3,
    ) {
        let value = integer(&words, negative);
        let mut primes = Primes::default();
        let mut basis = Basis::default();
        basis.extend(primes.by_ref().take(first));
        let missing = value.bits().saturating_sub(basis.determines()).div_ceil(PRIME_BITS);
        basis.extend(primes.take(usize::try_from(missing)? + spare));
        prop_assert!(basis.determines() >= value.bits());
        let (product, parts) = parts_by_division(&basis, &value);
        for (field, cofactor) in basis.fields().iter().zip(basis.cofactors()) {
            prop_assert_eq!(field.residue(*cofactor), residue(&(&product / field.modulus()), field));
        }
        prop_assert_eq!(basis.determined().integer(&parts), value);
    }
}

/// The longest integers that so many primes determine, where groups of primes begin and end; the tree has up to seven.
#[test]
fn the_longest_integers_follow_from_their_remainders() {
    for count in [1, 2, 3, 5, 127, 128, 129, 256, 257, 385, 513, 640, 700, 800] {
        let mut basis = Basis::default();
        basis.extend(Primes::default().take(count));
        let longest: BigInt = (BigInt::from(1) << basis.determines()) - 1;
        for value in [longest.clone(), -&longest, BigInt::from(-1), BigInt::from(0), -(&longest >> 70u8)] {
            let (_, parts) = parts_by_division(&basis, &value);
            assert!(basis.determined().integer(&parts) == value, "{count} primes");
        }
    }
}

/// Against trial by all primes below 100 and Fermat's test with large integers to some other bases, and against the distances of
/// the first primes from 2⁶² as C. Caldwell's tables have them.
#[test]
fn primes_descend_from_two_to_the_62() {
    let distances: Vec<u64> = Primes::default().take(10).map(|field| (1 << 62) - field.modulus()).collect();
    assert_eq!(distances, [57, 87, 117, 143, 153, 167, 171, 195, 203, 273]);
    let primes: Vec<u64> = Primes::default().take(200).map(|field| field.modulus()).collect();
    let small: Vec<u64> = (2..100).filter(|n| (2..*n).all(|d| n % d != 0)).collect();
    let is_prime = |n: u64| {
        let fermat = |base: u64| BigUint::from(base).modpow(&(n - 1).into(), &n.into()) == BigUint::from(1u8);
        small.iter().all(|d| !n.is_multiple_of(*d)) && [11, 13, 1_000_003].into_iter().all(fermat)
    };
    let expected: Vec<u64> = (primes[199]..1 << 62).rev().filter(|n| is_prime(*n)).collect();
    assert_eq!(primes, expected);
}
