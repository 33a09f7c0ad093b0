//! Checks at random points, with a bound of the chance that a wrong identity passes.

use num_bigint::BigInt;
use num_integer::Integer;
use num_traits::ToPrimitive;

use super::body::{Body, Failure, Numbers, compared};
use super::entries::Entries;
use super::tracked::{Tracked, tallied};
use crate::scalar::{Mersenne61, Rational, Scalar};

const PRIME: u64 = (1 << 61) - 1;
/// There are as many points as bring the bound to 10⁻¹⁸, and no more than twelve.
const AIM: u64 = 1_000_000_000_000_000_000;
const MOST_POINTS: u32 = 12;

/// A check at random points of the field of p = 2⁶¹ − 1 elements that found nothing.
///
/// A polynomial of degree D that is not zero vanishes at a random point with probability at most D/p (Schwartz, Zippel). Code
/// asks "is this zero?" where it chooses pivots, divides, and at last where the sides are compared; "no" is certain at any point, and
/// only "yes" may be an accident. One run beforehand, at a point that is not counted, fixes what is bounded: its answers, D and the number of
/// points. Every counted run must give the same answers.
///
/// If the identity is wrong for variables, or has no value, or the code decides otherwise for them, then the answers for variables are not those
/// fixed beforehand. Take the first question at which they differ: there the run beforehand said "yes" of a polynomial that is not zero, of degree at
/// most D, which does not depend on the counted points. To give the same answer, each of these must be one of its zeros. So a wrong identity passes with
/// probability at most `(D/p)^points`, however many questions there are. D is found by the code itself, run on [`Tracked`](super::Tracked) numbers. A point at
/// which a division fails counts as a failure and is not drawn again, so no probability is conditional on success.
///
/// What is bounded is the chance that the identity fails over the field of rational functions with coefficients modulo p. A
/// difference whose integer coefficients are all multiples of this prime would not be seen.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Chance {
    /// How many points.
    pub points: u32,
    /// How many questions are asked at each.
    pub questions: usize,
    /// D, a bound of the degree of what is asked about.
    pub degree: u128,
}

impl Chance {
    /// The bound `(D/p)^points` of the probability with which a wrong identity passes; one, if D > p.
    pub fn bound(&self) -> Rational {
        let [degree, prime] = [BigInt::from(self.degree), BigInt::from(PRIME)];
        if degree > prime { Rational::one() } else { Rational::new(degree, prime).pow(self.points.cast_signed()) }
    }

    /// The bound as a decimal of one digit, rounded up: `3e-19`.
    pub fn decimal(&self) -> String {
        let bound = self.bound();
        if bound.numer() == &BigInt::from(0) {
            return "0".to_owned();
        }
        let (mut above, mut exponent) = (bound.numer().clone(), 0);
        while above < *bound.denom() {
            above *= 10;
            exponent += 1;
        }
        match above.div_ceil(bound.denom()).to_u32() {
            Some(10) => format!("1e-{}", exponent - 1),
            digit => format!("{}e-{exponent}", digit.unwrap_or(1)),
        }
    }
}

/// A generator whose first number is determined by its seed (`SplitMix64`).
pub(super) struct Random(pub(super) u64);

impl Random {
    pub(super) fn next(&mut self) -> u64 {
        self.0 = self.0.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let mut z = self.0;
        z = (z ^ (z >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        z ^ (z >> 31)
    }

    /// Each residue with the same probability, as far as the generator is random.
    fn residue(&mut self) -> Mersenne61 {
        loop {
            let bits = self.next() >> 3;
            if bits < PRIME {
                return Mersenne61::new(bits);
            }
        }
    }
}

pub(super) fn checked<B: Body>(numbers: Numbers, seed: u64) -> Result<Chance, Failure> {
    let mut random = Random(seed);
    let mut run = || {
        let (outcome, tally) = tallied(|| {
            let mut next = || Tracked::variable(random.residue());
            compared(&B::sides(numbers, false, &mut Entries::new(&mut next))?)
        });
        outcome.map(|()| tally)
    };
    let planned = run()?;
    let chance = |points| Chance { points, questions: planned.answers.len(), degree: planned.degree };
    let aim = Rational::new(1.into(), AIM.into());
    let chance = (1..=MOST_POINTS).map(chance).find(|chance| chance.bound() <= aim).ok_or(Failure::NoBound)?;
    for _ in 0..chance.points {
        if run()? != planned {
            return Err(Failure::Decisions);
        }
    }
    Ok(chance)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::prove::body::Sides;
    use crate::scalar::Field;

    /// Fermat: xᵖ = x at every point modulo p, and not as polynomials.
    struct Fermat;

    impl Body for Fermat {
        const IDENTIFIERS: &'static [&'static str] = &[];
        const NAME: &'static str = "xᵖ = x";
        const WHERE: &'static str = "";
        const SLIP: &'static str = "";
        const LETTERS: &'static [&'static str] = &[];
        const SYMBOLIC: &'static [&'static [usize]] = &[];
        const RANDOM: &'static [&'static [usize]] = &[];

        fn sides<F: Field>(_: Numbers, _: bool, entries: &mut Entries<'_, F>) -> Result<Sides<F>, Failure> {
            let x = entries.column("x", 1);
            let mut power = x.clone();
            for _ in 0..60 {
                power = &power * &power * &x;
            }
            Ok(vec![(power, x)])
        }
    }

    /// Sides that differ by the product of all entries, of degree four, or by one.
    struct Nearly;

    impl Body for Nearly {
        const IDENTIFIERS: &'static [&'static str] = &[];
        const NAME: &'static str = "nearly equal";
        const WHERE: &'static str = "";
        const SLIP: &'static str = "";
        const LETTERS: &'static [&'static str] = &[];
        const SYMBOLIC: &'static [&'static [usize]] = &[];
        const RANDOM: &'static [&'static [usize]] = &[];

        fn sides<F: Field>([by_one, ..]: Numbers, _: bool, entries: &mut Entries<'_, F>) -> Result<Sides<F>, Failure> {
            let a = entries.matrix("A", 2, 2);
            let product = a.entries().iter().fold(F::one(), |product, entry| product.times(entry));
            let mut other = a.clone();
            other[(1, 1)] = other[(1, 1)].plus(&if by_one == 1 { F::one() } else { product });
            Ok(vec![(a, other)])
        }
    }

    #[test]
    fn what_all_points_hide_has_no_bound() {
        assert_eq!(checked::<Fermat>([0; 5], 1), Err(Failure::NoBound));
    }

    #[test]
    fn small_differences_are_seen() {
        for by_one in [0, 1] {
            let differs = Failure::Differs { equation: 1, row: 1, column: 1 };
            assert_eq!(checked::<Nearly>([by_one, 0, 0, 0, 0], 1), Err(differs.clone()));
            assert_eq!(crate::prove::proof::proved::<Nearly>([by_one, 0, 0, 0, 0], false, 0), Err(differs));
        }
    }

    #[test]
    fn bounds_multiply_and_are_those_of_the_prime() {
        let chance = |points, degree| Chance { points, questions: 8, degree };
        assert_eq!(chance(1, 3).bound(), Rational::new(3.into(), PRIME.into()));
        assert_eq!(chance(2, 3).bound(), chance(1, 3).bound() * chance(1, 3).bound());
        assert_eq!(chance(3, u128::MAX).bound(), Rational::one());
        // 1/(2⁶¹ − 1) is just above 4.3·10⁻¹⁹, (2³¹/(2⁶¹ − 1))² just above 8.6·10⁻¹⁹: to the nearest they would be 4 and 9.
        assert_eq!([chance(1, 1), chance(2, 1 << 31)].map(|chance| chance.decimal()), ["5e-19", "9e-19"]);
        // 0.1·p is no integer: just below and just above, and one itself.
        let tenth = u128::from(PRIME) / 10;
        assert_eq!([tenth, tenth + 1].map(|degree| chance(1, degree).decimal()), ["1e-1", "2e-1"]);
        assert_eq!([u128::from(PRIME) - 1, u128::MAX].map(|degree| chance(1, degree).decimal()), ["1e-0", "1e-0"]);
        assert_eq!(chance(1, 0).decimal(), "0");
    }
}
