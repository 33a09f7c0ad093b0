//! The direction of rounding: dyadic numbers, intervals and doubles, against quotients of machine integers.

use exact_kalman::scalar::{
    Dyadic, Interval, Precision, Rational, Toward, Undefined, exact_value, nearest_double, nearest_single, ratio,
};
use num_bigint::BigInt;

use crate::harness::{Replays, below, cover, harness};
use crate::ratio::integer;

/// m and e such that `m 2^e` is `numerator / denominator` to so many bits, as `rounded` takes the quotient `a / b` to an integer.
fn expected(numerator: i64, denominator: i64, bits: u32, rounded: impl Fn(i64, i64) -> i64) -> (i64, i64) {
    if numerator == 0 {
        return (0, 0);
    }
    // The e with 2^(e−1) ≤ |value| < 2^e, from below all that there are here.
    let mut e = -30;
    while scaled(numerator.abs(), -e) >= scaled(denominator, e) {
        e += 1;
    }
    let shift = i64::from(bits) - e;
    let rounded = rounded(scaled(numerator, shift), scaled(denominator, -shift));
    (rounded, -shift)
}

/// `number · 2^shift`, unchanged where the shift is negative.
fn scaled(number: i64, shift: i64) -> i64 {
    number << shift.max(0)
}

fn toward(direction: Toward) -> impl Fn(i64, i64) -> i64 {
    move |a, b| match direction {
        Toward::Below => a.div_euclid(b),
        Toward::Above => -(-a).div_euclid(b),
    }
}

/// Whether a dyadic number is `m 2^e`.
fn is(found: &Dyadic, (m, e): (i64, i64)) -> bool {
    let (mut m, mut e) = (m, e);
    while m != 0 && m % 2 == 0 {
        (m, e) = (m / 2, e + 1);
    }
    found.parts() == (&BigInt::from(m), if m == 0 { 0 } else { e })
}

fn direction() -> Toward {
    if below(2) == 0 { Toward::Below } else { Toward::Above }
}

fn count(bound: u64) -> u32 {
    1 + u32::try_from(below(bound)).unwrap_or(0)
}

harness! {
    /// The largest number of so many bits that is not above a fraction, and the smallest that is not below it.
    ///
    /// Domain: all fractions with numerators from −40 to 40 and denominators from 1 to 12, to 1 to 5 bits, both directions.
    fractions_are_rounded_as_told, unwind 132, Replays::All(81 * 12 * 5 * 2),
    covers ["exact", "rounded below", "rounded above", "carried to the next power of two", "below zero"], {
        let (n, d, bits, told) = (i64::from(integer(40)), i64::from(count(12)), count(5), direction());
        let found = Dyadic::rounded(&ratio(n, d), bits.into(), told);
        let (m, e) = expected(n, d, bits, toward(told));
        assert!(is(&found, (m, e)));
        let value = found.value();
        assert!(value.as_ref().is_some_and(|value| (*value <= ratio(n, d)) || told == Toward::Above));
        assert!(value.as_ref().is_some_and(|value| (*value >= ratio(n, d)) || told == Toward::Below));
        cover!(value == Some(ratio(n, d)), "exact");
        cover!(value < Some(ratio(n, d)), "rounded below");
        cover!(value > Some(ratio(n, d)), "rounded above");
        cover!(m == 1 << bits, "carried to the next power of two");
        cover!(n < 0, "below zero");
    }
}

harness! {
    /// Sums, products and quotients of dyadic numbers are the exact ones, rounded once.
    ///
    /// Domain: all pairs of m·2^e with m from −7 to 7 and e in {−3, 0, 2}, to 1 to 3 bits, both directions, three operations.
    operations_are_rounded_once, unwind 132, Replays::All(45 * 45 * 3 * 2 * 3),
    covers ["a sum", "a product", "a quotient", "division by zero", "cancellation"], {
        let exponent = || [-3_i64, 0, 2][usize::try_from(below(3)).unwrap_or(0)];
        let ((m, e), (k, f)) = ((i64::from(integer(7)), exponent()), (i64::from(integer(7)), exponent()));
        let (bits, told) = (count(3), direction());
        let (x, y) = (Dyadic::new(m.into(), e), Dyadic::new(k.into(), f));
        let (least, size) = (e.min(f), u64::from(bits));
        match below(3) {
            0 => {
                // Both in units of 2^−3.
                let sum = scaled(m, e + 3) + scaled(k, f + 3);
                cover!(sum == 0 && m != 0, "cancellation");
                cover!(least < 0, "a sum");
                assert!(is(&x.plus(&y, size, told), expected(sum, 8, bits, toward(told))));
            }
            1 => {
                cover!(m * k != 0, "a product");
                let (numerator, denominator) = (scaled(m * k, e + f), scaled(1, -e - f));
                assert!(is(&x.times(&y, size, told), expected(numerator, denominator, bits, toward(told))));
            }
            _ => match x.over(&y, size, told) {
                None => {
                    cover!(k == 0, "division by zero");
                    assert!(k == 0);
                }
                Some(found) => {
                    cover!(m != 0, "a quotient");
                    let (numerator, denominator) = (scaled(m * k.signum(), e - f), scaled(k.abs(), f - e));
                    assert!(is(&found, expected(numerator, denominator, bits, toward(told))));
                }
            },
        }
    }
}

harness! {
    /// What lies far below all bits that are kept moves a sum to the next number, or not at all, however far it is.
    ///
    /// Domain: all sums m + k·2^(−s), m and k from −7 to 7, s in {20, 1000, 10¹²}, to 1 to 3 bits, both directions.
    tiny_terms_only_say_where_to_round, unwind 132, Replays::All(15 * 15 * 3 * 3 * 2),
    covers ["the next number", "across a power of two", "unmoved"], {
        let (m, k, bits) = (i64::from(integer(7)), i64::from(integer(7)), count(3));
        let places = [20, 1000, 1_000_000_000_000][usize::try_from(below(3)).unwrap_or(0)];
        let told = direction();
        let found = Dyadic::new(m.into(), 0).plus(&Dyadic::new(k.into(), -places), bits.into(), told);
        if m == 0 {
            let (rounded, e) = expected(k, 1, bits, toward(told));
            assert!(is(&found, (rounded, e - places)));
        } else {
            assert!(is(&found, expected(scaled(m, 20) + k, 1 << 20, bits, toward(told))));
        }
        let moved = found != Dyadic::new(m.into(), 0);
        cover!(moved && m.abs() < 4 && m != 0, "the next number");
        cover!(moved && m == 4 && k < 0, "across a power of two");
        cover!(!moved && k != 0, "unmoved");
    }
}

harness! {
    /// Sums, products and quotients of intervals are the least dyadic ones around all results at their ends.
    ///
    /// Domain: all pairs of intervals with integer ends from −3 to 3, to 1 to 3 bits, three operations.
    intervals_enclose_their_results, unwind 132, Replays::All(7 * 7 * 7 * 7 * 3 * 3),
    covers ["both signs in both", "a divisor that may be zero", "a divisor that is zero", "rounded outward"], {
        let [a, b, c, d] = [(); 4].map(|()| i64::from(integer(3)));
        let [(a, b), (c, d)] = [(a.min(b), a.max(b)), (c.min(d), c.max(d))];
        let bits = count(3);
        let between = |low: i64, high: i64| Interval::between(Dyadic::new(low.into(), 0), Dyadic::new(high.into(), 0));
        let (x, y, size) = (between(a, b), between(c, d), u64::from(bits));
        cover!(a < 0 && b > 0 && c < 0 && d > 0, "both signs in both");
        // The results at the four ends over a common denominator; all others lie between them.
        let (found, results, denominator) = match below(3) {
            0 => (x.plus(&y, size), [a + c, a + d, b + c, b + d], 1),
            1 => (x.times(&y, size), [a * c, a * d, b * c, b * d], 1),
            _ => match x.over(&y, size) {
                // a/c = a d/(c d), and c d > 0.
                Ok(found) => (found, [a * d, a * c, b * d, b * c], c * d),
                Err(error) => {
                    cover!(error == Undefined::Undecided, "a divisor that may be zero");
                    cover!(error == Undefined::DivisionByZero, "a divisor that is zero");
                    assert!(c <= 0 && d >= 0 && (error == Undefined::DivisionByZero) == (c == 0 && d == 0));
                    return;
                }
            },
        };
        let least = results.into_iter().fold(i64::MAX, i64::min);
        let most = results.into_iter().fold(i64::MIN, i64::max);
        assert!(is(found.lower(), expected(least, denominator, bits, toward(Toward::Below))));
        assert!(is(found.upper(), expected(most, denominator, bits, toward(Toward::Above))));
        cover!(found.upper().value() > Some(ratio(most, denominator)), "rounded outward");
    }
}

harness! {
    /// The nearest number of so many bits, ties upwards.
    ///
    /// Domain: all fractions with numerators from −40 to 40 and denominators from 1 to 12, to 1 to 5 bits.
    the_nearest_has_its_ties_upwards, unwind 132, Replays::All(81 * 12 * 5), covers ["a tie", "exact", "below zero"], {
        let (n, d, bits) = (i64::from(integer(40)), i64::from(count(12)), count(5));
        let found = Precision::Rounded { bits }.of(&ratio(n, d));
        let (m, e) = expected(n, d, bits, |a, b| (2 * a + b).div_euclid(2 * b));
        let power = scaled(1, e.abs());
        assert!(found == if e < 0 { ratio(m, power) } else { ratio(m * power, 1) });
        cover!(expected(n, d, bits, |a, b| i64::from(2 * a.rem_euclid(b) == b)).0 == 1, "a tie");
        cover!(found == ratio(n, d), "exact");
        cover!(n < 0, "below zero");
    }
}

harness! {
    /// A quotient of two integers that are doubles, or singles, is what the machine's division gives.
    nearest_doubles_are_those_of_the_machine, unwind 132, Replays::Random(20_000),
    covers ["exact", "below the divisor", "below zero"], {
        #[expect(clippy::cast_precision_loss, reason = "integers of 53 bits are doubles")]
        let double = |n: i64| n as f64;
        let sign = if below(2) == 0 { 1 } else { -1 };
        let long = || 1 + i64::try_from(below(1 << 53) >> below(53)).unwrap_or(0).min((1 << 53) - 1);
        let (n, d) = (sign * long(), long());
        let found = nearest_double(&ratio(n, d));
        assert!(found.to_bits() == (double(n) / double(d)).to_bits());
        let short = |n: i64| i16::try_from(n % (1 << 15)).unwrap_or(0);
        let (a, b) = (short(n), short(d).max(1));
        if a != 0 {
            let single = f32::from(a) / f32::from(b);
            assert!(nearest_single(&ratio(a.into(), b.into())).to_bits() == single.to_bits());
        }
        cover!(n % d == 0, "exact");
        cover!(n.abs() < d, "below the divisor");
        cover!(n < 0, "below zero");
    }
}

harness! {
    /// Every pattern of bits: a finite double is read exactly, and is the nearest to what was read, but for the sign of zero.
    doubles_are_read_exactly, unwind 132, Replays::Random(20_000),
    covers ["subnormal", "not finite", "an integer", "below zero", "zero with a sign", "a power of two"], {
        let exponent = match below(8) {
            0 => 0,
            1 => 2047,
            _ => below(1 << 11),
        };
        let significand = if below(4) == 0 { 0 } else { below(1 << 52) };
        let value = f64::from_bits(significand | exponent << 52 | below(2) << 63);
        let read: Option<Rational> = exact_value(value);
        assert!(read.is_some() == (exponent < 2047));
        cover!(exponent == 0, "subnormal");
        cover!(exponent == 2047, "not finite");
        cover!(read.as_ref().is_some_and(Rational::is_integer), "an integer");
        cover!(value < 0.0, "below zero");
        cover!(value == 0.0 && value.is_sign_negative(), "zero with a sign");
        cover!(significand == 0 && exponent > 0 && exponent < 2047, "a power of two");
        if let Some(read) = read {
            // A fraction has one zero.
            let expected = if value == 0.0 { 0.0 } else { value };
            assert!(nearest_double(&read).to_bits() == expected.to_bits());
        }
    }
}
