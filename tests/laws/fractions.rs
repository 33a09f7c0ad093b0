//! Fractions to draw: small, long, huge, and several over one denominator.

use exact_kalman::scalar::{Rational, ratio};
use num_bigint::BigInt;
use quickcheck::{Arbitrary, Gen};

/// Three fractions; one time in three over the same denominator, which is where sums cancel.
#[derive(Clone, Debug)]
pub struct Triple(pub Rational, pub Rational, pub Rational);

/// An integer of up to 20 words of 64 bits, often with few bits set or few cleared.
fn integer(g: &mut Gen) -> BigInt {
    let words = *g.choose(&[1, 1, 1, 2, 3, 20]).unwrap_or(&1);
    let word = |g: &mut Gen| match u8::arbitrary(g) % 4 {
        0 => 0,
        1 => u64::MAX,
        _ => u64::arbitrary(g),
    };
    let magnitude = (0..words).fold(BigInt::from(1 + u64::arbitrary(g) % 9), |value, _| (value << 64) + word(g));
    if bool::arbitrary(g) { -magnitude } else { magnitude }
}

fn small(g: &mut Gen) -> BigInt {
    BigInt::from(i64::arbitrary(g) % 13)
}

/// A denominator, often with a square or a power of two in it, which leaves factors to cancel.
fn denominator(g: &mut Gen) -> BigInt {
    match u8::arbitrary(g) % 4 {
        0 => BigInt::from(*g.choose(&[1, 2, 3, 4, 6, 12, 36]).unwrap_or(&1)),
        1 => BigInt::from(1) << (u32::arbitrary(g) % 200),
        2 => integer(g).pow(2),
        _ => BigInt::from(BigInt::magnitude(&integer(g)).clone()),
    }
}

fn fraction(g: &mut Gen, denominator: &BigInt) -> Rational {
    let numerator = if bool::arbitrary(g) { small(g) } else { integer(g) };
    Rational::new(numerator, denominator.clone())
}

impl Arbitrary for Triple {
    fn arbitrary(g: &mut Gen) -> Self {
        let shared = denominator(g);
        if u8::arbitrary(g) % 3 == 0 {
            return Self(fraction(g, &shared), fraction(g, &shared), fraction(g, &shared));
        }
        let (second, third) = (denominator(g), denominator(g));
        Self(fraction(g, &shared), fraction(g, &second), fraction(g, &third))
    }

    fn shrink(&self) -> Box<dyn Iterator<Item = Self>> {
        let Self(a, b, c) = self.clone();
        let simpler = |value: &Rational| vec![ratio(0, 1), ratio(1, 1), ratio(1, 2), value.trunc(), value.fract()];
        let first: Vec<Self> = simpler(&a).into_iter().map(|a| Self(a, b.clone(), c.clone())).collect();
        let second = simpler(&b).into_iter().map(|b| Self(a.clone(), b, c.clone())).collect();
        let third = simpler(&c).into_iter().map(|c| Self(a.clone(), b.clone(), c)).collect();
        let same = |other: &Self| (&other.0, &other.1, &other.2) != (&a, &b, &c);
        let all: Vec<Self> = [first, second, third].concat().into_iter().filter(same).collect();
        // Each step must get simpler, or shrinking goes round in circles.
        let size = |t: &Self| [&t.0, &t.1, &t.2].iter().map(|x| x.numer().bits() + x.denom().bits()).sum::<u64>();
        let bound = size(self);
        Box::new(all.into_iter().filter(move |triple| size(triple) < bound))
    }
}
