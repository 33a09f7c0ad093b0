//! Quotients of integers rounded without their lowest terms, against the reduced fraction and against candidates.

use exact_kalman::scalar::{Precision, Quotient, Rational, exact_value, nearest_double, ratio};
use num_bigint::{BigInt, BigUint, Sign};
use proptest::prelude::*;

fn power(base: u32, exponent: u32) -> BigInt {
    BigInt::from(base).pow(exponent)
}

/// A numerator and a denominator as they are, with nothing cancelled.
type Pair = (BigInt, BigInt);

fn value((numerator, denominator): &Pair) -> Rational {
    Rational::new(numerator.clone(), denominator.clone())
}

/// Both multiplied by the same.
fn multiplied((numerator, denominator): &Pair, factor: &BigInt) -> Pair {
    (numerator * factor, denominator * factor)
}

fn any_integer(words: usize) -> impl Strategy<Value = BigInt> {
    prop::collection::vec(any::<u32>(), 1..=words).prop_map(|words| BigInt::from(BigUint::new(words)) + 1)
}

/// Quotients of long integers, of all sizes from far below the least double to far beyond the largest.
fn long_pair() -> impl Strategy<Value = Pair> {
    (any_integer(60), any_integer(60), any::<bool>()).prop_map(|(a, b, negative)| (if negative { -a } else { a }, b))
}

/// Numbers with `bits` bits and one half more or less in the last place (`off` is zero), or a little beside it;
/// as pairs of long integers.
fn near_ties(bits: u32) -> impl Strategy<Value = Pair> {
    let off = prop_oneof![Just(-1_i32), Just(0), Just(1)];
    (any::<u64>(), -1200_i32..1200, off, 100_u32..3000, any_integer(40), any::<bool>()).prop_map(
        move |(low, exponent, off, depth, factor, negative)| {
            let top = power(2, bits - 1);
            let significand = (&top + BigInt::from(low) % &top) * 2 + 1;
            let numerator = (significand << depth) + off;
            let scale = power(2, exponent.unsigned_abs());
            let pair =
                if exponent >= 0 { (numerator * scale, power(2, depth)) } else { (numerator, power(2, depth) * scale) };
            let (numerator, denominator) = multiplied(&pair, &factor);
            (if negative { -numerator } else { numerator }, denominator)
        },
    )
}

fn absolute(value: Rational) -> Rational {
    if *value.numer() < BigInt::from(0) { -value } else { value }
}

/// `2^exponent`
fn two_to(exponent: i64) -> Rational {
    let power = Rational::from(BigInt::from(1) << exponent.unsigned_abs());
    if exponent < 0 { power.recip() } else { power }
}

/// By the words of the definition: the multiples of the unit below and above, and the nearer one.
fn rounded_by_definition(value: &Rational, bits: u32) -> Rational {
    let magnitude = absolute(value.clone());
    let (numerator, denominator) = (magnitude.numer().bits(), magnitude.denom().bits());
    let mut e = i64::try_from(numerator).expect("it fits") - i64::try_from(denominator).expect("it fits") - 1;
    while two_to(e) <= magnitude {
        e += 1;
    }
    assert!(two_to(e - 1) <= magnitude);
    let unit = two_to(e - i64::from(bits));
    let below = (value / &unit).floor() * &unit;
    let above = &below + &unit;
    if value - &below < &above - value { below } else { above }
}

/// The nearest double by its neighbours: none of them is nearer, and at a tie the pattern is even.
fn is_nearest(found: f64, value: &Rational) -> bool {
    let distance = |x: f64| exact_value(x).map(|x| absolute(x - value));
    let Some(own) = distance(found) else {
        let beyond = exact_value(f64::MAX).expect("it is finite") + two_to(970);
        return found.is_infinite() && absolute(value.clone()) >= beyond;
    };
    let even = found.to_bits().is_multiple_of(2);
    let largest = exact_value(f64::MAX).expect("it is finite") + two_to(970);
    let fits = |other: f64| match distance(other) {
        Some(distance) => own < distance || own == distance && even,
        None => absolute(value.clone()) < largest,
    };
    fits(found.next_up()) && fits(found.next_down())
}

fn is_rounded(pair: &Pair, bits: u32) -> bool {
    let found = Quotient::new(&pair.0, &pair.1).handed_out(Precision::Rounded { bits });
    let reduced = Rational::new(found.numer().clone(), found.denom().clone());
    let same = |other: &Rational| (found.numer(), found.denom()) == (other.numer(), other.denom());
    same(&reduced)
        && found == rounded_by_definition(&value(pair), bits)
        && same(&Precision::Rounded { bits }.of(&value(pair)))
}

fn is_nearest_double(pair: &Pair) -> bool {
    let found = Quotient::new(&pair.0, &pair.1).nearest_double();
    found.to_bits() == nearest_double(&value(pair)).to_bits()
        && is_nearest(found, &value(pair))
        && found.is_sign_negative() == (pair.0.sign() == Sign::Minus)
}

/// All quotients of small integers, multiplied up to more bits than are looked at: ties and powers of two among them.
#[test]
fn small_quotients_are_exhausted() {
    let factors = [BigInt::from(1), power(3, 200) + 2, power(2, 400)];
    let mut ties = 0;
    for a in (-40_i64..=40).filter(|a| *a != 0) {
        for b in 1..=20_i64 {
            let small = (BigInt::from(a), BigInt::from(b));
            for factor in &factors {
                let pair = multiplied(&small, factor);
                for bits in 1..=5 {
                    assert!(is_rounded(&pair, bits), "{a}/{b} · {factor} to {bits}");
                }
                assert!(is_nearest_double(&pair), "{a}/{b} · {factor}");
            }
            let rest = ratio(a, b) - Precision::Rounded { bits: 3 }.of(&ratio(a, b));
            ties += u32::from([4, 2, 1].iter().any(|unit| absolute(rest.clone()) == ratio(*unit, 2)));
        }
    }
    assert!(ties > 20, "only {ties} ties");
    assert_eq!(Precision::Rounded { bits: 0 }.of(&ratio(5, 1)), ratio(4, 1));
    assert_eq!(Precision::Rounded { bits: 9 }.of(&ratio(0, 1)), ratio(0, 1));
}

/// The ends of the doubles: the least, half of it, the largest, and the middle between that and 2¹⁰²⁴.
#[test]
fn the_ends_of_the_doubles() {
    let factor = power(3, 500);
    let at = |value: Rational| {
        let pair = multiplied(&(value.numer().clone(), value.denom().clone()), &factor);
        assert!(is_nearest_double(&pair), "{value}");
        Quotient::new(&pair.0, &pair.1).nearest_double()
    };
    let (least, tiny) = (two_to(-1074), two_to(-3000));
    assert_eq!(at(&least / ratio(2, 1)).to_bits(), 0);
    assert_eq!(at(&least / ratio(2, 1) + &tiny).to_bits(), 1);
    assert_eq!(at(-&least / ratio(2, 1)).to_bits(), 1 << 63);
    assert_eq!(at(&least * ratio(3, 2)).to_bits(), 2);
    assert_eq!(at(&least * ratio(5, 2)).to_bits(), 2);
    assert_eq!(at(two_to(-4000)).to_bits(), 0);
    assert_eq!(at(two_to(-1022) - &least / ratio(2, 1)).to_bits(), f64::MIN_POSITIVE.to_bits());
    let middle = exact_value(f64::MAX).expect("it is finite") + two_to(970);
    assert_eq!(at(middle.clone()).to_bits(), f64::INFINITY.to_bits());
    assert_eq!(at(&middle - &tiny).to_bits(), f64::MAX.to_bits());
    assert_eq!(at(-two_to(5000)).to_bits(), f64::NEG_INFINITY.to_bits());
}

proptest! {
    #[test]
    fn long_quotients(pair in long_pair(), bits in 1_u32..200) {
        prop_assert!(is_nearest_double(&pair));
        prop_assert!(is_rounded(&pair, bits));
    }

    #[test]
    fn next_to_ties_of_doubles(pair in near_ties(53), less in 1_u32..53) {
        prop_assert!(is_nearest_double(&pair));
        // Below the normal numbers the ties are elsewhere.
        let pair = (pair.0, pair.1 << (1000 + less));
        prop_assert!(is_nearest_double(&pair));
    }

    #[test]
    fn next_to_ties_of_rounded_fractions(pair in near_ties(20)) {
        prop_assert!(is_rounded(&pair, 20));
        prop_assert!(is_rounded(&pair, 19) && is_rounded(&pair, 21) && is_rounded(&pair, 300));
    }

    /// The enclosure holds the value and is as narrow as it says.
    #[test]
    fn enclosures_hold_the_value(pair in long_pair(), bits in 1_u64..300) {
        let interval = Quotient::new(&pair.0, &pair.1).enclosed(bits);
        let [lower, upper] = [interval.lower(), interval.upper()].map(|end| end.value().expect("ends of an enclosure are finite"));
        let value = value(&pair);
        prop_assert!(lower <= value && value <= upper);
        let width = two_to(2 - i64::try_from(bits).expect("it fits"));
        prop_assert!(upper - lower <= absolute(value) * width);
    }
}

#[test]
#[should_panic(expected = "a denominator is positive")]
fn negative_denominators_are_refused() {
    let _ = Quotient::new(&BigInt::from(1), &BigInt::from(-2));
}
