//! Dyadic numbers rounded in a direction, and what intervals enclose.

use exact_kalman::scalar::{Dyadic, Exponentials, Interval, Rational, Toward, Undefined, ratio};
use num_bigint::BigInt;
use num_traits::Signed;
use quickcheck::QuickCheck;

fn fraction(numerator: i64, denominator: i64) -> Rational {
    ratio(numerator, 1 + (denominator % 1000).abs())
}

fn value(dyadic: &Dyadic) -> Rational {
    dyadic.value().unwrap_or_else(|| panic!("{dyadic:?} is too long"))
}

/// Below and above, and no more than one unit of the last bit apart.
fn encloses(below: &Dyadic, above: &Dyadic, truth: &Rational, bits: u64) -> bool {
    let (below, above) = (value(below), value(above));
    let unit = truth.abs() * Rational::new(BigInt::from(4), BigInt::from(1) << bits);
    below <= *truth && *truth <= above && &above - &below <= unit
}

/// Every operation against the fractions, at precisions down to one bit.
#[test]
fn operations_round_as_they_are_told() {
    fn property(a: (i64, i64), b: (i64, i64), shift: i16, bits: u8) -> bool {
        let bits = 1 + u64::from(bits % 40);
        let scale = Dyadic::new(BigInt::from(1), i64::from(shift));
        let of = |x: &Rational| Dyadic::rounded(x, 80, Toward::Below);
        let a = of(&fraction(a.0, a.1));
        let b = of(&fraction(b.0, b.1)).times(&scale, 80, Toward::Below);
        let both = |of: &dyn Fn(Toward) -> Dyadic| (of(Toward::Below), of(Toward::Above));
        let (sum, product) = (both(&|to| a.plus(&b, bits, to)), both(&|to| a.times(&b, bits, to)));
        let quotient = b.over(&a, bits, Toward::Below).zip(b.over(&a, bits, Toward::Above));
        let divided = match quotient {
            None => a.is_zero(),
            Some((below, above)) => encloses(&below, &above, &(value(&b) / value(&a)), bits),
        };
        let sum_encloses = {
            let truth = value(&a) + value(&b);
            value(&sum.0) <= truth && truth <= value(&sum.1)
        };
        divided && sum_encloses && encloses(&product.0, &product.1, &(value(&a) * value(&b)), bits)
    }
    QuickCheck::new().tests(3000).quickcheck(property as fn((i64, i64), (i64, i64), i16, u8) -> bool);
}

/// The order is that of the fractions.
#[test]
fn dyadic_numbers_are_ordered() {
    fn property(a: (i32, i8), b: (i32, i8)) -> bool {
        let of = |(mantissa, exponent): (i32, i8)| Dyadic::new(mantissa.into(), exponent.into());
        of(a).cmp(&of(b)) == value(&of(a)).cmp(&value(&of(b)))
    }
    QuickCheck::new().tests(2000).quickcheck(property as fn((i32, i8), (i32, i8)) -> bool);
}

/// Sums of numbers of absurdly different size are short and on the right side.
#[test]
fn tiny_summands_only_decide_the_rounding() {
    let tiny = Dyadic::new(BigInt::from(3), -1_000_000_000_000);
    let (below, above) = (Dyadic::one().plus(&tiny, 10, Toward::Below), Dyadic::one().plus(&tiny, 10, Toward::Above));
    assert_eq!(below, Dyadic::one());
    assert!(above > Dyadic::one() && value(&above) == ratio(513, 512));
    let (below, above) = (
        Dyadic::one().plus(&tiny.negated(), 10, Toward::Below),
        Dyadic::one().plus(&tiny.negated(), 10, Toward::Above),
    );
    assert_eq!(above, Dyadic::one());
    assert!(below < Dyadic::one() && value(&below) == ratio(1023, 1024));
    assert_eq!(tiny.value(), None);
}

/// √x² ∋ x, to the bits asked for; squares are met exactly.
#[test]
fn square_roots_square_to_their_argument() {
    fn property(numerator: u32, denominator: u16, bits: u8) -> bool {
        let x = ratio(i64::from(numerator), 1 + i64::from(denominator));
        let bits = 2 + u64::from(bits);
        let Ok(root) = Interval::square_root(&x, bits) else { return false };
        let (lower, upper) = (value(root.lower()), value(root.upper()));
        let narrow = (&upper - &lower) * Rational::from(BigInt::from(1) << (bits - 1)) <= upper;
        &lower * &lower <= x && x <= &upper * &upper && narrow
    }
    QuickCheck::new().tests(1000).quickcheck(property as fn(u32, u16, u8) -> bool);
    let three_halves = Interval::square_root(&ratio(9, 4), 5);
    assert_eq!(three_halves.map(|root| (value(root.lower()), value(root.upper()))), Ok((ratio(3, 2), ratio(3, 2))));
    assert_eq!(Interval::square_root(&ratio(-1, 1), 5), Err(Undefined::OutsideTheRing));
}

/// Published digits: e, exp(−700/3), exp(123456.789), to 50 digits and more.
#[test]
fn exponentials_have_the_published_digits() {
    for (x, digits, decade) in [
        (ratio(1, 1), "271828182845904523536028747135266249775724709369995", -50_i32),
        (ratio(-700, 3), "461977569042693603537704153724668004648672342782647", -152),
        (ratio(123_456_789, 1000), "400143893926308175709824717074096746464375837090554", 53566),
    ] {
        let found = Interval::exponential(&x, 180).unwrap_or_else(|error| panic!("{error}"));
        let power = Rational::from(BigInt::from(10).pow(decade.unsigned_abs()));
        let unit = if decade < 0 { power.recip() } else { power };
        let digits = Rational::from(digits.parse::<BigInt>().unwrap_or_else(|error| panic!("{error}")));
        let (below, above) = (&digits * &unit, (&digits + ratio(1, 1)) * &unit);
        assert!(below <= value(found.lower()) && value(found.upper()) <= above, "exp({x})");
    }
}

/// exp(x) exp(y) and exp(x + y) meet, and the enclosure is as narrow as it says.
#[test]
fn exponentials_multiply() {
    fn property(x: (i32, i64), y: (i32, i64), bits: u8) -> bool {
        let bits = 8 + u64::from(bits);
        let (x, y) = (fraction(i64::from(x.0 % 3000), x.1), fraction(i64::from(y.0 % 3000), y.1));
        let of = |x: &Rational| Interval::exponential(x, bits).unwrap_or_else(|error| panic!("{error}"));
        let (product, sum) = (of(&x).times(&of(&y), bits + 30), of(&(&x + &y)));
        let meet = product.lower() <= sum.upper() && sum.lower() <= product.upper();
        let width = value(sum.upper()) - value(sum.lower());
        meet && width * Rational::from(BigInt::from(1) << bits) <= value(sum.upper())
    }
    QuickCheck::new().tests(400).quickcheck(property as fn((i32, i64), (i32, i64), u8) -> bool);
}

/// exp(±10¹²) is enclosed in an instant, exp(−10³⁰) lies between zero and hardly more, exp(10³⁰) is refused.
#[test]
fn huge_exponents() {
    // 10¹²/ln 2 = 1442695040888.96…
    for (sign, magnitude) in [(1, 1_442_695_040_889), (-1, -1_442_695_040_888)] {
        let found =
            Interval::exponential(&ratio(sign * 1_000_000_000_000, 1), 60).unwrap_or_else(|error| panic!("{error}"));
        assert_eq!((found.lower().magnitude(), found.upper().magnitude()), (Some(magnitude), Some(magnitude)));
    }
    let absurd = Rational::from(BigInt::from(10).pow(30));
    assert!(Interval::exponential(&absurd, 60).is_err());
    let nothing = Interval::exponential(&-absurd, 60).unwrap_or_else(|error| panic!("{error}"));
    assert!(nothing.lower().is_zero() && nothing.upper().magnitude() < Some(-(1 << 60)));
}

/// exp(−2⁶²), the last that is told from 0, has the magnitude ⌊−2⁶²/ln 2⌋ + 1. Its square and its square over 2^(2⁶²) lie beyond the
/// least number: enclosed by it and 0, on the side that they are told.
#[test]
fn results_too_small_are_rounded_as_told() {
    let last = Interval::exponential(&ratio(-(1 << 62), 1), 60).unwrap_or_else(|error| panic!("{error}"));
    assert_eq!(last.lower().magnitude(), Some(-6_653_256_548_922_161_245));
    let square = last.times(&last, 60);
    assert!(square.lower().is_zero() && !square.upper().is_zero() && square.upper() < last.lower());
    let large = Interval::exponential(&ratio(1 << 62, 1), 60).unwrap_or_else(|error| panic!("{error}"));
    let quotient = last.over(&large, 60).unwrap_or_else(|error| panic!("{error}"));
    assert!(quotient.lower().is_zero() && quotient.upper() == square.upper());
    let negative = last.times(&last.negated(), 60);
    assert!(negative.upper().is_zero() && negative.lower().is_negative() && negative.lower() > last.negated().upper());
    // Sums of what is left are still right: 1 ± exp(−2⁶²)² lies next to 1, on both sides of it.
    let one = Dyadic::one();
    assert!(one.plus(square.upper(), 60, Toward::Above) > one && one.plus(negative.lower(), 60, Toward::Below) < one);
    // And what is too large has a lower bound, but no upper one.
    let ends = large.lower().times(large.lower(), 60, Toward::Below);
    assert!(ends > *large.upper());
    let above = std::panic::catch_unwind(|| large.upper().times(large.upper(), 60, Toward::Above));
    assert!(above.is_err());
}

/// e to 1500 digits, as the sum of 1/n! for n < 600, exact but for 2/600! < 10⁻¹⁴⁰⁷; and exponentials of one precision agree with
/// those computed one by one.
#[test]
fn exponentials_to_many_bits() {
    let (mut sum, mut term) = (ratio(0, 1), ratio(1, 1));
    for n in 1..=600 {
        sum += &term;
        term /= ratio(n, 1);
    }
    let bits = 4600;
    let found = Interval::exponential(&ratio(1, 1), bits).unwrap_or_else(|error| panic!("{error}"));
    let width = value(found.upper()) - value(found.lower());
    assert!(value(found.lower()) <= &sum + &term * ratio(2, 1) && sum <= value(found.upper()));
    assert!(width * Rational::from(BigInt::from(1) << (bits - 2)) <= ratio(1, 1));
    let exponentials = Exponentials::new(100);
    for x in [ratio(-7, 3), ratio(1, 1_000_000), ratio(1 << 40, 3), ratio(0, 1)] {
        assert_eq!(exponentials.of(&x), Interval::exponential(&x, 100));
    }
}

/// Products and quotients of intervals hold those of their members, for all signs; a divisor around zero is undecided.
#[test]
fn intervals_enclose_all_results() {
    fn property(a: (i16, i16), b: (i16, i16)) -> bool {
        let of = |(x, y): (i16, i16)| {
            let dyadic = |x: i16| Dyadic::new(x.into(), -3);
            Interval::between(dyadic(x), dyadic(y))
        };
        let inside = |x: &Rational, interval: &Interval| value(interval.lower()) <= *x && *x <= value(interval.upper());
        let ends = |interval: &Interval| [value(interval.lower()), value(interval.upper())];
        let (a, b) = (of(a), of(b));
        let (sum, product, quotient) = (a.plus(&b, 6), a.times(&b, 6), a.over(&b, 6));
        ends(&a).iter().all(|x| {
            ends(&b).iter().all(|y| {
                let divides = quotient.as_ref().is_ok_and(|quotient| inside(&(x / y), quotient));
                let zero = ratio(0, 1);
                let around = value(b.lower()) <= zero && zero <= value(b.upper());
                inside(&(x + y), &sum) && inside(&(x * y), &product) && (around != divides)
            })
        })
    }
    QuickCheck::new().tests(2000).quickcheck(property as fn((i16, i16), (i16, i16)) -> bool);
}

/// Published digits: π to 50, cos 1, sin 1, cos 100, sin 100 to 30; of 10¹⁰⁰⁰ + 1/3 by mpmath with 1200 digits. Beyond 2^131072 nothing
/// is known but the range.
#[test]
fn circles_have_the_published_digits() {
    let holds = |found: &Interval, digits: &str, places: u32| {
        let unit = Rational::from(BigInt::from(10).pow(places)).recip();
        let below = Rational::from(digits.parse::<BigInt>().unwrap_or_else(|error| panic!("{error}"))) * &unit;
        let (below, above) = (&below - &unit, below + &unit);
        below < value(found.lower()) && value(found.upper()) < above
    };
    assert!(holds(&Interval::pi(200), "314159265358979323846264338327950288419716939937510", 50));
    let (cosine, sine) = Interval::cosine_and_sine(&ratio(1, 1), 150);
    assert!(holds(&cosine, "540302305868139717400936607443", 30) && holds(&sine, "841470984807896506652502321630", 30));
    let (cosine, sine) = Interval::cosine_and_sine(&ratio(100, 1), 150);
    assert!(
        holds(&cosine, "862318872287683934101938513950", 30) && holds(&sine, "-506365641109758793656557610459", 30)
    );
    let far = Rational::from(BigInt::from(10).pow(1000)) + ratio(1, 3);
    let (cosine, sine) = Interval::cosine_and_sine(&far, 150);
    assert!(
        holds(&cosine, "-92915319035509322459401488508901", 32) && holds(&sine, "36969494025879214772199026493164", 32)
    );
    let (cosine, sine) = Interval::cosine_and_sine(&Rational::from(BigInt::from(1) << 200_000), 150);
    let whole = Interval::between(Dyadic::one().negated(), Dyadic::one());
    assert!(cosine == whole && sine == whole);
}

/// cos² + sin² ∋ 1, the addition theorem, evenness, and widths of at most 2^−bits, for arguments of any size.
#[test]
fn circles_turn() {
    fn property(x: (i64, i64), y: (i32, i64), bits: u8) -> bool {
        let bits = 4 + u64::from(bits);
        let (x, y) = (fraction(x.0, x.1), fraction(i64::from(y.0), y.1));
        let ((cx, sx), (cy, sy)) = (Interval::cosine_and_sine(&x, bits), Interval::cosine_and_sine(&y, bits));
        let (sum, _) = Interval::cosine_and_sine(&(&x + &y), bits);
        let (even, odd) = Interval::cosine_and_sine(&-&x, bits);
        let work = bits + 20;
        let meet = |a: &Interval, b: &Interval| a.lower() <= b.upper() && b.lower() <= a.upper();
        let one = cx.times(&cx, work).plus(&sx.times(&sx, work), work);
        let theorem = cx.times(&cy, work).minus(&sx.times(&sy, work), work);
        let width = value(sx.upper()) - value(sx.lower());
        meet(&one, &Interval::of(&ratio(1, 1), work))
            && meet(&theorem, &sum)
            && meet(&even, &cx)
            && meet(&odd.negated(), &sx)
            && width * Rational::from(BigInt::from(1) << bits) <= ratio(1, 1)
    }
    QuickCheck::new().tests(300).quickcheck(property as fn((i64, i64), (i32, i64), u8) -> bool);
}
