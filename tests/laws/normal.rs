//! Laws of the normal distribution function.

use exact_kalman::scalar::{Dyadic, Interval, Rational, Toward, ratio};
use num_bigint::BigInt;

fn phi(x: &Rational, bits: u64) -> Interval {
    Interval::normal_distribution(x, bits).expect("small")
}

/// Whether the interval lies between the decimal 0.digits·10^(−zeros) and the next one.
fn has_digits(found: &Interval, digits: &str, zeros: u32) -> bool {
    let unit =
        Rational::new(BigInt::from(1), BigInt::from(10).pow(zeros + u32::try_from(digits.len()).expect("small")));
    let value = Rational::from(digits.parse::<BigInt>().expect("digits")) * &unit;
    let [lower, upper] = [found.lower(), found.upper()].map(|end| end.value().expect("short"));
    value <= lower && lower <= upper && upper <= value + unit
}

/// mpmath: `mp.dps = 60; ncdf(1)`, `ncdf(-8)`, `ncdf(-40)`, `ncdf(-1/mpf(1000))`, `ncdf(7/mpf(2))`, `ncdf(sqrt(2))`.
#[test]
fn digits_of_an_outside_program() {
    for (x, digits, zeros) in [
        (ratio(1, 1), "8413447460685429485852325456320379224779", 0),
        (ratio(-8, 1), "6220960574271784123515995172588188422488", 15),
        (ratio(-40, 1), "3655893540915029703748985802688283665053", 349),
        (ratio(-1, 1000), "4996010577860889374154096775556730587314", 0),
        (ratio(7, 2), "9997673709209644749636500741132720152264", 0),
    ] {
        for bits in [170, 600] {
            assert!(has_digits(&phi(&x, bits), digits, zeros), "{x}: {:?}", phi(&x, bits));
        }
    }
    let root = Interval::normal_distribution_of_root(false, &ratio(2, 1), 170).expect("enclosed");
    assert!(has_digits(&root, "9213503964748574346706103175413046296480", 0), "{root:?}");
}

fn relative_width(found: &Interval, bits: i64) -> bool {
    let width = found.upper().plus(&found.lower().negated(), 64, Toward::Above);
    width <= found.lower().times(&Dyadic::new(BigInt::from(1), -bits), 64, Toward::Below)
}

/// Φ(x) + Φ(−x) = 1, Φ(0) = ½, Φ increases, and the width is as promised: at the places where one formula takes over from the
/// other too (x² next to the bits).
#[test]
fn symmetric_increasing_narrow() {
    assert_eq!(phi(&ratio(0, 1), 50), Interval::of(&ratio(1, 2), 1));
    for bits in [10, 64, 100] {
        let mut before: Option<Interval> = None;
        for step in -120..=120 {
            let x = ratio(step, 8);
            let (here, there) = (phi(&x, bits), phi(&-&x, bits));
            assert!(relative_width(&here, i64::try_from(bits).expect("small")), "{x} {here:?}");
            let sum = here.plus(&there, 200);
            assert!(*sum.lower() <= Dyadic::one() && Dyadic::one() <= *sum.upper());
            if let Some(before) = before.filter(|_| step.abs() < 24) {
                assert!(before.upper() < here.lower(), "{x}");
            }
            before = Some(here);
        }
    }
}

/// Few bits use the continued fraction where many use the series: both must hold the same number.
#[test]
fn the_two_formulas_agree() {
    for square in [17, 20, 50, 99, 150] {
        for negative in [true, false] {
            let few = Interval::normal_distribution_of_root(negative, &ratio(square, 1), 16).expect("enclosed");
            let many = Interval::normal_distribution_of_root(negative, &ratio(square, 1), 200).expect("enclosed");
            assert!(few.lower() <= many.lower() && many.upper() <= few.upper(), "{square}");
        }
    }
}
