//! The library's rationals: after every operation in lowest terms with a positive denominator.

use exact_kalman::scalar::{Rational, Residue, Scalar, Undefined, ratio};

use crate::harness::{Replays, below, cover, harness};
use crate::ratio::{common_divisor, integer};

/// Whether a fraction has the value `numerator / denominator`, in lowest terms with a positive denominator.
fn is_normal(value: &Rational, numerator: i128, denominator: i128) -> bool {
    let (Ok(n), Ok(d)) = (i128::try_from(value.numer()), i128::try_from(value.denom())) else { return false };
    // The parts of the normal form follow from any other form by its greatest common divisor.
    let shared = common_divisor(numerator, denominator) * denominator.signum();
    (n, d) == (numerator / shared, denominator / shared)
}

/// All four operations on two fractions against cross products.
fn obeys((a, b): (i64, i64), (c, d): (i64, i64)) {
    let (x, y) = (ratio(a, b), ratio(c, d));
    let [a, b, c, d] = [a, b, c, d].map(i128::from);
    assert!(is_normal(&x.plus(&y), a * d + c * b, b * d));
    assert!(is_normal(&x.minus(&y), a * d - c * b, b * d));
    assert!(is_normal(&x.times(&y), a * c, b * d));
    match x.over(&y) {
        Ok(quotient) => assert!(c != 0 && is_normal(&quotient, a * d, b * c)),
        Err(error) => assert!(c == 0 && error == Undefined::DivisionByZero),
    }
}

/// Any fraction with a numerator up to 6 and a denominator up to 6, in lowest terms or not.
fn small() -> (i64, i64) {
    (integer(6).into(), i64::from(integer(2)) + 4)
}

harness! {
    /// Sums, differences, products and quotients of small fractions.
    ///
    /// Domain: all pairs of fractions with numerators from −6 to 6 and denominators from 2 to 6.
    rationals_stay_in_normal_form, unwind 132, Replays::All(65 * 65),
    covers ["the sum cancels", "the product cancels", "a divisor below zero", "division by zero"], {
        let (x, y) = (small(), small());
        cover!(common_divisor(i128::from(x.0 * y.1 + y.0 * x.1), i128::from(x.1 * y.1)) > 1, "the sum cancels");
        cover!(common_divisor(i128::from(x.0), i128::from(y.1)) > 1, "the product cancels");
        cover!(y.0 < 0, "a divisor below zero");
        cover!(y.0 == 0, "division by zero");
        obeys(x, y);
    }
}

harness! {
    /// Fractions of 30 bits with common factors.
    longer_rationals_stay_in_normal_form, unwind 132, Replays::Random(20_000),
    covers ["equal denominators", "denominators share a factor", "a divisor below zero"], {
        let part = || i64::try_from(below(1 << 20)).unwrap_or(0) * i64::try_from(1 + below(1 << 10)).unwrap_or(1);
        let shared = i64::try_from(1 + below(1 << 10)).unwrap_or(1);
        let sign = if below(2) == 0 { 1 } else { -1 };
        let x = (part(), shared * i64::try_from(1 + below(1 << 10)).unwrap_or(1));
        let y = (sign * part(), if below(4) == 0 { x.1 } else { shared * i64::try_from(1 + below(1 << 10)).unwrap_or(1) });
        cover!(x.1 == y.1, "equal denominators");
        cover!(common_divisor(x.1.into(), y.1.into()) > 1, "denominators share a factor");
        cover!(y.0 < 0, "a divisor below zero");
        obeys(x, y);
    }
}

harness! {
    /// The image of a fraction modulo 7, times its denominator, is its numerator; images of sums and products are sums and
    /// products of images.
    ///
    /// Domain: all pairs of fractions with numerators from −8 to 8 and denominators from 1 to 8, modulo 7.
    images_of_fractions_modulo_7, unwind 132, Replays::All(136 * 136),
    covers ["no image", "an image though seven divides the denominator as written", "zero"], {
        type F = Residue<7>;
        let part = || (i64::from(integer(8)), 1 + i64::try_from(below(8)).unwrap_or(0));
        let of = |n: i64| F::new(u64::try_from(n.rem_euclid(7)).unwrap_or(0));
        let [x, y] = [(); 2].map(|()| part());
        let [image, other] = [x, y].map(|(n, d)| F::image(&ratio(n, d)));
        // Seven divides the denominator in lowest terms iff it divides the denominator and not the numerator.
        assert!(image.is_none() == (x.1 % 7 == 0 && x.0 % 7 != 0));
        cover!(image.is_none(), "no image");
        cover!(image.is_some() && x.1 % 7 == 0, "an image though seven divides the denominator as written");
        cover!(image == Some(F::zero()), "zero");
        if let Some(image) = image.filter(|_| x.1 % 7 != 0) {
            assert!(image.times(&of(x.1)) == of(x.0));
        }
        if let (Some(image), Some(other)) = (image, other) {
            assert!(F::image(&ratio(x.0, x.1).plus(&ratio(y.0, y.1))) == Some(image.plus(&other)));
            assert!(F::image(&ratio(x.0, x.1).times(&ratio(y.0, y.1))) == Some(image.times(&other)));
        }
    }
}
