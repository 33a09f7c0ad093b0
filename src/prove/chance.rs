//! Checks at random points, with a bound of the chance that a wrong identity passes.

use super::body::{Body, Failure, compared};
use super::entries::Entries;
use super::tracked::{Tracked, tallied};
use crate::scalar::Mersenne61;

const PRIME: u64 = (1 << 61) - 1;
/// Points are added until the bound is below this.
const AIM: f64 = 1e-18;
const MOST_POINTS: u32 = 12;

/// A check at random points of the field of 2⁶¹ − 1 elements that found nothing.
///
/// A polynomial of degree D that is not zero vanishes at a random point with probability at most D/(2⁶¹ − 1) (Schwartz, Zippel). Code
/// asks "is this zero?" where it chooses pivots, divides, and at last where the sides are compared; "no" is certain at any point, and
/// only "yes" may be an accident. If the identity is wrong, or the code would decide otherwise for variables, then at the first question
/// for which the answer of all points is an accident every point lies on the zeros of a polynomial that does not depend on the points. It is one of
/// T questions, and each has degree at most D. So a wrong identity is accepted with probability at most `T (D/(2⁶¹ − 1))^points`.
/// D is found by the code itself, run on [`Tracked`] numbers. A point at which a division fails counts as a failure and is not drawn again, so no
/// probability is conditional.
///
/// What is bounded is the chance that the identity fails over the field of rational functions with coefficients modulo 2⁶¹ − 1. A
/// difference whose integer coefficients are all multiples of this prime would not be seen.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Chance {
    /// How many points.
    pub points: u32,
    /// T, the number of questions asked at each.
    pub questions: u64,
    /// D, a bound of the degree of what is asked about.
    pub degree: u128,
}

impl Chance {
    /// The bound of the probability, rounded.
    #[expect(clippy::cast_precision_loss, reason = "a bound is printed with two digits")]
    pub fn bound(&self) -> f64 {
        let each = (self.degree as f64 / PRIME as f64).min(1.0);
        (self.questions as f64 * each.powf(f64::from(self.points))).min(1.0)
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

pub(super) fn checked<B: Body>(numbers: [usize; 3], seed: u64) -> Result<Chance, Failure> {
    let mut random = Random(seed);
    let mut first = None;
    let mut chance = Chance { points: 0, questions: 0, degree: 0 };
    while chance.points == 0 || (chance.bound() > AIM && chance.points < MOST_POINTS) {
        let (outcome, tally) = tallied(|| {
            let mut next = || Tracked::variable(random.residue());
            compared(&B::sides(numbers, false, &mut Entries::new(&mut next))?)
        });
        outcome?;
        if *first.get_or_insert(tally) != tally {
            return Err(Failure::Decisions);
        }
        chance = Chance { points: chance.points + 1, questions: tally.questions, degree: tally.degree };
    }
    if chance.bound() > AIM { Err(Failure::NoBound) } else { Ok(chance) }
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
        const SLIP: &'static str = "";
        const LETTERS: &'static [&'static str] = &[];
        const SYMBOLIC: &'static [[usize; 3]] = &[];
        const RANDOM: &'static [[usize; 3]] = &[];

        fn sides<F: Field>(_: [usize; 3], _: bool, entries: &mut Entries<'_, F>) -> Result<Sides<F>, Failure> {
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
        const SLIP: &'static str = "";
        const LETTERS: &'static [&'static str] = &[];
        const SYMBOLIC: &'static [[usize; 3]] = &[];
        const RANDOM: &'static [[usize; 3]] = &[];

        fn sides<F: Field>(
            [by_one, ..]: [usize; 3],
            _: bool,
            entries: &mut Entries<'_, F>,
        ) -> Result<Sides<F>, Failure> {
            let a = entries.matrix("A", 2, 2);
            let product = a.entries().iter().fold(F::one(), |product, entry| product.times(entry));
            let mut other = a.clone();
            other[(1, 1)] = other[(1, 1)].plus(&if by_one == 1 { F::one() } else { product });
            Ok(vec![(a, other)])
        }
    }

    #[test]
    fn what_all_points_hide_has_no_bound() {
        assert_eq!(checked::<Fermat>([0; 3], 1), Err(Failure::NoBound));
    }

    #[test]
    fn small_differences_are_seen() {
        for by_one in [0, 1] {
            let differs = Failure::Differs { equation: 1, row: 1, column: 1 };
            assert_eq!(checked::<Nearly>([by_one, 0, 0], 1), Err(differs.clone()));
            assert_eq!(crate::prove::proof::proved::<Nearly>([by_one, 0, 0], false), Err(differs));
        }
    }

    #[test]
    fn bounds_multiply() {
        let chance = |points| Chance { points, questions: 8, degree: 1 << 31 };
        assert!((chance(1).bound() / 2_f64.powi(-27) - 1.0).abs() < 1e-9);
        assert!((chance(2).bound() / 2_f64.powi(-57) - 1.0).abs() < 1e-9);
    }
}
