//! Laws of the logarithm.

use exact_kalman::scalar::{Interval, Logarithms, Rational, Undefined, ratio};
use num_bigint::BigInt;
use quickcheck::QuickCheck;

fn logarithm(x: &Rational, bits: u64) -> Interval {
    Logarithms::new(bits).of(x).expect("a positive number")
}

fn ends(found: &Interval) -> [Rational; 2] {
    [found.lower(), found.upper()].map(|end| end.value().expect("short"))
}

fn power_of_ten(exponent: u32) -> Rational {
    Rational::from(BigInt::from(10).pow(exponent))
}

/// mpmath: `mp.dps = 60; log(2)`, `log(10)`, `log(1/mpf(3))`, `log(mpf(1000001)/1000000)`, `log(mpf(10)**300)`; 50 digits after the point.
#[test]
fn digits_of_an_outside_program() {
    for (x, digits) in [
        (ratio(2, 1), "69314718055994530941723212145817656807550013436025"),
        (ratio(10, 1), "230258509299404568401799145468436420760110148862877"),
        (ratio(1, 3), "-109861228866810969139524523692252570464749055782274"),
        (ratio(1_000_001, 1_000_000), "99999950000033333308333353333316666680952368"),
        (power_of_ten(300), "69077552789821370520539743640530926228033044658863189"),
        (power_of_ten(300).recip(), "-69077552789821370520539743640530926228033044658863189"),
    ] {
        let unit = power_of_ten(50).recip();
        let cut = Rational::from(digits.parse::<BigInt>().expect("digits")) * &unit;
        for bits in [167, 600] {
            let [lower, upper] = ends(&logarithm(&x, bits));
            // Cut off toward zero.
            let (below, above) =
                if cut < ratio(0, 1) { (&cut - &unit, cut.clone()) } else { (cut.clone(), &cut + &unit) };
            assert!(lower <= upper && below <= upper && lower <= above, "{x}: {lower} … {upper}");
            assert!(&upper - &lower < ratio(1, 2).pow(i32::try_from(bits).expect("few")), "{x}");
        }
    }
}

#[test]
fn only_positive_numbers_have_one() {
    for x in [ratio(0, 1), ratio(-1, 3)] {
        assert_eq!(Logarithms::new(60).of(&x), Err(Undefined::OutsideTheRing));
    }
    let [lower, upper] = ends(&logarithm(&ratio(1, 1), 60));
    assert!(lower <= ratio(0, 1) && upper >= ratio(0, 1));
}

/// exp(ln x) encloses x: the exponential has a code of its own.
#[test]
fn the_exponential_leads_back() {
    fn property(over: u64, under: u64, shift: i8, bits: u8) -> bool {
        let x = Rational::new(BigInt::from(over) + 1, BigInt::from(under) + 1) * ratio(2, 1).pow(i32::from(shift) * 4);
        let bits = u64::from(bits) + 4;
        let [lower, upper] = ends(&logarithm(&x, bits));
        let of = |y: &Rational| Interval::exponential(y, bits + 64).expect("far from an overflow");
        let [below, above] = [&lower, &upper].map(|end| ends(&of(end)));
        below[0] <= x && x <= above[1] && upper - lower < ratio(1, 2).pow(i32::try_from(bits).expect("few"))
    }
    QuickCheck::new().tests(400).quickcheck(property as fn(u64, u64, i8, u8) -> bool);
}
