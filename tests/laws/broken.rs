//! Scalars that are none: the laws must name what is wrong with each.

use std::cmp::Ordering;

use exact_kalman::scalar::laws::{self, Broken};
use exact_kalman::scalar::{Field, OrderedField, Rational, Residue, Scalar, Undefined, ZeroTest, ratio};

/// The laws that some triple of the world breaks.
fn broken<S: Field>(world: &[S], check: impl Fn(&S, &S, &S) -> Result<(), Broken>) -> Vec<&'static str> {
    let mut names = Vec::new();
    for a in world {
        for b in world {
            for c in world {
                if let Err(Broken(name)) = check(a, b, c)
                    && !names.contains(&name)
                {
                    names.push(name);
                }
            }
        }
    }
    names
}

/// Fermat's inverse is none modulo a composite number: 2 · 2⁷ = 256 = 4 modulo 9.
#[test]
fn composite_moduli_are_no_fields() {
    fn of<const P: u64>() -> Vec<&'static str> {
        broken(&(0..P).map(Residue::<P>::new).collect::<Vec<_>>(), laws::field)
    }
    assert_eq!(of::<9>(), ["division inverts multiplication"]);
    assert_eq!(of::<15>(), ["division inverts multiplication"]);
    assert_eq!(of::<7>(), [""; 0]);
}

/// What is wrong with a [`Faulty`].
#[derive(Clone, Copy, PartialEq, Eq)]
enum Fault {
    None,
    SumOfEqualsIsOneMore,
    ProductOfEqualsIsOneMore,
    ProductPrefersTheLeft,
    DifferenceIsTurned,
    QuotientByZeroIsZero,
    QuotientIsProduct,
    EveryQuotientFails,
    ThreeLooksLikeZero,
    ThreeIsUndecided,
    OneIsZero,
}

const FAULTS: [(Fault, &str); 10] = [
    (Fault::SumOfEqualsIsOneMore, "addition is associative"),
    (Fault::ProductOfEqualsIsOneMore, "multiplication is associative"),
    (Fault::ProductPrefersTheLeft, "multiplication commutes"),
    (Fault::DifferenceIsTurned, "subtraction adds the negative"),
    (Fault::QuotientByZeroIsZero, "nothing is divided by zero"),
    (Fault::QuotientIsProduct, "division inverts multiplication"),
    (Fault::EveryQuotientFails, "a field decides division and contains every quotient"),
    (Fault::ThreeLooksLikeZero, "the zero test agrees with equality"),
    (Fault::ThreeIsUndecided, "a field decides zero"),
    (Fault::OneIsZero, "zero and one differ"),
];

/// The residues modulo 7 with the fault numbered `N`: `FAULTS[N]`, or none.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
struct Faulty<const N: usize>(Residue<7>);

impl<const N: usize> Faulty<N> {
    fn has(fault: Fault) -> bool {
        FAULTS.get(N).map_or(Fault::None, |(fault, _)| *fault) == fault
    }

    fn and_one_if(value: Residue<7>, more: bool) -> Self {
        Self(if more { value.plus(&Residue::one()) } else { value })
    }
}

impl<const N: usize> Scalar for Faulty<N> {
    fn zero() -> Self {
        Self(Residue::zero())
    }

    fn one() -> Self {
        Self(Residue::new(u64::from(!Self::has(Fault::OneIsZero))))
    }

    fn plus(&self, other: &Self) -> Self {
        // Not for zero, so that zero stays neutral and the law that fails is the one meant.
        let equal = self == other && self.0 == Residue::new(3);
        Self::and_one_if(self.0.plus(&other.0), equal && Self::has(Fault::SumOfEqualsIsOneMore))
    }

    fn minus(&self, other: &Self) -> Self {
        if Self::has(Fault::DifferenceIsTurned) && self.0 != Residue::zero() {
            return Self(other.0.minus(&self.0));
        }
        Self(self.0.minus(&other.0))
    }

    fn times(&self, other: &Self) -> Self {
        if Self::has(Fault::ProductPrefersTheLeft) && other.0 != Residue::one() && self.0 != Residue::one() {
            // Associative, and one is neutral; that is all.
            return *self;
        }
        let equal = self == other && self.0 == Residue::new(3);
        Self::and_one_if(self.0.times(&other.0), equal && Self::has(Fault::ProductOfEqualsIsOneMore))
    }

    fn over(&self, divisor: &Self) -> Result<Self, Undefined> {
        if Self::has(Fault::EveryQuotientFails) {
            return Err(Undefined::Undecided);
        }
        if Self::has(Fault::QuotientByZeroIsZero) && divisor.0 == Residue::zero() {
            return Ok(Self::zero());
        }
        if Self::has(Fault::QuotientIsProduct) && divisor.0 != Residue::zero() {
            return Ok(Self(self.0.times(&divisor.0)));
        }
        self.0.over(&divisor.0).map(Self)
    }

    fn zero_test(&self) -> ZeroTest {
        match self.0.representative() {
            3 if Self::has(Fault::ThreeLooksLikeZero) => ZeroTest::Zero,
            3 if Self::has(Fault::ThreeIsUndecided) => ZeroTest::Undecided,
            _ => self.0.zero_test(),
        }
    }
}

impl<const N: usize> Field for Faulty<N> {}

fn faults_found<const N: usize>() -> Vec<&'static str> {
    broken(&(0..7).map(|value| Faulty::<N>(Residue::new(value))).collect::<Vec<_>>(), laws::field)
}

#[test]
fn every_fault_is_found_under_its_name() {
    let found = [
        faults_found::<0>(),
        faults_found::<1>(),
        faults_found::<2>(),
        faults_found::<3>(),
        faults_found::<4>(),
        faults_found::<5>(),
        faults_found::<6>(),
        faults_found::<7>(),
        faults_found::<8>(),
        faults_found::<9>(),
    ];
    for ((_, law), found) in FAULTS.iter().zip(found) {
        assert!(found.contains(law), "«{law}» is not among {found:?}");
    }
    assert_eq!(faults_found::<10>(), [""; 0]);
}

/// The residues in the order of their representatives: a field and an order, and no ordered field.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
struct Ranked(u64);

/// The rationals upside down.
#[derive(Clone, Debug, PartialEq, Eq)]
struct Inverted(Rational);

impl PartialOrd for Inverted {
    fn partial_cmp(&self, other: &Self) -> Option<Ordering> {
        Some(self.cmp(other))
    }
}

impl Ord for Inverted {
    fn cmp(&self, other: &Self) -> Ordering {
        other.0.cmp(&self.0)
    }
}

/// A scalar that is another one in a shell.
macro_rules! shell {
    ($shell:ident, $inner:ty, |$value:ident| $open:expr, |$result:ident| $close:expr) => {
        impl Scalar for $shell {
            fn zero() -> Self {
                let $result = <$inner>::zero();
                $close
            }
            fn one() -> Self {
                let $result = <$inner>::one();
                $close
            }
            fn plus(&self, other: &Self) -> Self {
                let open = |$value: &Self| -> $inner { $open };
                let $result = open(self).plus(&open(other));
                $close
            }
            fn minus(&self, other: &Self) -> Self {
                let open = |$value: &Self| -> $inner { $open };
                let $result = open(self).minus(&open(other));
                $close
            }
            fn times(&self, other: &Self) -> Self {
                let open = |$value: &Self| -> $inner { $open };
                let $result = open(self).times(&open(other));
                $close
            }
            fn over(&self, divisor: &Self) -> Result<Self, Undefined> {
                let open = |$value: &Self| -> $inner { $open };
                let $result = open(self).over(&open(divisor))?;
                Ok($close)
            }
            fn zero_test(&self) -> ZeroTest {
                let $value = self;
                let inner: $inner = $open;
                inner.zero_test()
            }
        }
        impl Field for $shell {}
        impl OrderedField for $shell {}
    };
}

shell!(Ranked, Residue<7>, |value| Residue::new(value.0), |result| Self(result.representative()));
shell!(Inverted, Rational, |value| value.0.clone(), |result| Self(result));

#[test]
fn orders_that_arithmetic_does_not_respect_are_found() {
    let residues: Vec<Ranked> = (0..7).map(Ranked).collect();
    assert_eq!(broken(&residues, laws::field), [""; 0]);
    assert!(broken(&residues, laws::ordered_field).contains(&"the order is that of the difference"));
    let fractions: Vec<Inverted> = (-2..=2).map(|value| Inverted(ratio(value, 2))).collect();
    assert_eq!(broken(&fractions, laws::field), [""; 0]);
    let found = broken(&fractions, laws::ordered_field);
    assert!(found.contains(&"products of nonnegatives are nonnegative"), "{found:?}");
}

/// The image of the integers must not stop at a sign or a bit.
#[test]
fn images_of_integers_that_are_none_are_found() {
    assert_eq!(laws::integers::<Residue<7>>(-3, 5), Ok(()));
    assert!(laws::integers::<Halved>(3, 5).is_err());
    assert!(laws::integers::<Halved>(0, 1).is_err());
}

/// The rationals, with an image of the integers that is half of what it should be.
#[derive(Clone, Debug, PartialEq, Eq)]
struct Halved(Rational);

impl Scalar for Halved {
    fn zero() -> Self {
        Self(ratio(0, 1))
    }

    fn one() -> Self {
        Self(ratio(1, 1))
    }

    fn plus(&self, other: &Self) -> Self {
        Self(self.0.plus(&other.0))
    }

    fn minus(&self, other: &Self) -> Self {
        Self(self.0.minus(&other.0))
    }

    fn times(&self, other: &Self) -> Self {
        Self(self.0.times(&other.0))
    }

    fn over(&self, divisor: &Self) -> Result<Self, Undefined> {
        self.0.over(&divisor.0).map(Self)
    }

    fn zero_test(&self) -> ZeroTest {
        self.0.zero_test()
    }

    fn from_integer(value: i64) -> Self {
        Self(ratio(value, 2))
    }
}

impl Field for Halved {}
