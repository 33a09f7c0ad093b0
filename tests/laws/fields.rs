//! The laws on fields of residues: every triple of a small one, random triples of the large one.

use exact_kalman::scalar::{Mersenne61, Rational, Residue, Scalar, laws, ratio};
use num_integer::Integer;
use quickcheck::{QuickCheck, TestResult};

/// Checks every triple; how many there are.
fn exhausted<const P: u64>() -> usize {
    let world: Vec<Residue<P>> = (0..P).map(Residue::new).collect();
    let mut count = 0;
    for a in &world {
        for b in &world {
            for c in &world {
                assert_eq!(laws::field(a, b, c), Ok(()), "{a:?}, {b:?}, {c:?}");
                count += 1;
            }
        }
    }
    count
}

#[test]
fn small_fields_are_fields() {
    assert_eq!(exhausted::<2>(), 8);
    assert_eq!(exhausted::<3>(), 27);
    assert_eq!(exhausted::<5>(), 125);
    assert_eq!(exhausted::<7>(), 343);
    assert_eq!(exhausted::<31>(), 29_791);
}

/// Random words are seldom near the modulus, where sums and products wrap: both ends are drawn as well.
fn residue(word: u64) -> Mersenne61 {
    const P: u64 = (1 << 61) - 1;
    Mersenne61::new(match word % 4 {
        0 => word % 3,
        1 => P - 1 - word % 3,
        _ => word,
    })
}

#[test]
fn residues_modulo_a_large_prime_are_a_field() {
    fn holds(a: u64, b: u64, c: u64) -> bool {
        laws::field(&residue(a), &residue(b), &residue(c)) == Ok(())
    }
    assert_eq!(QuickCheck::new().tests(10_000).quicktest(holds as fn(u64, u64, u64) -> bool).ok(), Some(10_000));
}

#[test]
fn integers_map_into_every_field() {
    fn holds(a: i32, b: i32) -> bool {
        let verdicts = [
            laws::integers::<Residue<2>>(a, b),
            laws::integers::<Residue<3>>(a, b),
            laws::integers::<Residue<5>>(a, b),
            laws::integers::<Residue<7>>(a, b),
            laws::integers::<Mersenne61>(a, b),
            laws::integers::<Rational>(a, b),
        ];
        verdicts == [Ok(()); 6]
    }
    assert_eq!(QuickCheck::new().tests(5_000).quicktest(holds as fn(i32, i32) -> bool).ok(), Some(5_000));
    let ends = [i32::MIN, -1, 0, 1, i32::MAX];
    assert!(ends.iter().all(|&a| ends.iter().all(|&b| holds(a, b))));
}

/// The image of a fraction is a homomorphism where it exists: `image(a/b) · b = a`, and it exists unless P divides b.
#[test]
fn images_of_fractions_solve_their_equation() {
    fn holds(numerator: i64, denominator: i64) -> TestResult {
        if denominator == 0 {
            return TestResult::discard();
        }
        let value = ratio(numerator, denominator);
        let small = match Residue::<7>::image(&value) {
            Some(image) => image.times(&integer(value.denom())) == integer(value.numer()),
            None => value.denom() % 7 == 0.into(),
        };
        let large = Mersenne61::image(&value).is_none_or(|image| {
            image.times(&Mersenne61::from_integer(denominator)) == Mersenne61::from_integer(numerator)
        });
        TestResult::from_bool(small && large)
    }
    fn integer(value: &num_bigint::BigInt) -> Residue<7> {
        let residue = value.mod_floor(&7.into());
        Residue::new(u64::try_from(residue).unwrap_or(u64::MAX))
    }
    let passed = QuickCheck::new().tests(5_000).quicktest(holds as fn(i64, i64) -> TestResult).ok();
    assert_eq!(passed, Some(5_000));
}
