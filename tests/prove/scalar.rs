//! Rational functions against fractions: values at points, laws, identities done by hand.

use exact_kalman::scalar::{Field, Rational, RationalFunction, Scalar, Undefined, ZeroTest, laws, ratio};
use num_bigint::BigInt;
use proptest::prelude::*;

fn x(number: usize) -> RationalFunction {
    RationalFunction::variable(number)
}

/// What is done to a stack of values.
#[derive(Clone, Copy, Debug)]
enum Act {
    Push(u8),
    Plus,
    Minus,
    Times,
    Over,
}

fn run<F: Field>(acts: &[Act], leaf: impl Fn(u8) -> F) -> Option<F> {
    let mut stack = vec![leaf(0)];
    for act in acts {
        if let Act::Push(number) = act {
            stack.push(leaf(*number));
            continue;
        }
        if stack.len() < 2 {
            continue;
        }
        let (b, a) = (stack.pop()?, stack.pop()?);
        stack.push(match act {
            Act::Plus => a.plus(&b),
            Act::Minus => a.minus(&b),
            Act::Times => a.times(&b),
            _ => a.over(&b).ok()?,
        });
    }
    stack.pop()
}

fn acts(most: usize) -> impl Strategy<Value = Vec<Act>> {
    let act = prop_oneof![
        3 => (0_u8..6).prop_map(Act::Push),
        1 => Just(Act::Plus),
        1 => Just(Act::Minus),
        1 => Just(Act::Times),
        1 => Just(Act::Over),
    ];
    proptest::collection::vec(act, 1..most)
}

/// Leaves 0 to 2 are variables, 3 to 5 the integers 1, 2 and −3.
fn symbol(number: u8) -> RationalFunction {
    let constants = [1, 2, -3];
    if number < 3 { x(number.into()) } else { RationalFunction::from_integer(constants[usize::from(number) - 3]) }
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(300))]

    #[test]
    fn the_laws_of_a_field_hold(a in acts(9), b in acts(9), c in acts(9)) {
        let value = |acts: &[Act]| run(acts, symbol).unwrap_or_else(RationalFunction::one);
        prop_assert_eq!(laws::field(&value(&a), &value(&b), &value(&c)), Ok(()));
    }

    #[test]
    fn integers_are_mapped_by_a_homomorphism(a: i32, b: i32) {
        prop_assert_eq!(laws::integers::<RationalFunction>(a, b), Ok(()));
    }

    /// Putting numbers in for variables commutes with every operation.
    #[test]
    fn values_at_points_are_those_of_fractions(acts in acts(24), point in proptest::array::uniform3(-9_i64..10)) {
        let whole: Vec<BigInt> = point.iter().map(|&value| value.into()).collect();
        let leaf = |number: u8| if number < 3 { ratio(point[usize::from(number)], 1) } else {
            symbol(number).value_at(&whole).expect("no zero below")
        };
        let numbers: Option<Rational> = run(&acts, leaf);
        let function = run(&acts, symbol);
        if let (Some(number), Some(function)) = (numbers, function) {
            // Where the fractions divide by nothing, the form at hand may still have a factor more.
            if let Some(value) = function.value_at(&whole) {
                prop_assert_eq!(value, number);
            }
        }
    }
}

/// Divisors that share factors without dividing each other: ab, bc and ac are taken for a base of abc², which leaves one c when ab is
/// divided out first. By hand, at a = b = d = e = 1, c = 2: 1/4 + 1/2.
#[test]
fn divisors_with_common_factors_are_added_right() {
    let [a, b, c, d, e] = [0, 1, 2, 3, 4].map(|number| x(number).plus(&RationalFunction::one()));
    let over = |function: &RationalFunction, divisor: &RationalFunction| function.over(divisor).expect("not zero");
    let one = RationalFunction::one();
    let own = over(&over(&one, &d.times(&e)), &a.times(&b).times(&c).times(&c));
    let other = over(&over(&over(&one, &b.times(&c)), &a.times(&b)), &d);
    let point = [0, 0, 1, 0, 0].map(BigInt::from);
    assert_eq!(own.plus(&other).value_at(&point), Some(ratio(3, 4)));
    assert_eq!(other.plus(&own).value_at(&point), Some(ratio(3, 4)));
    assert!(own.plus(&other).minus(&own).minus(&other).is_zero());
}

#[test]
fn identities_by_hand() {
    let (a, b, c) = (x(0), x(1), x(2));
    // 1/((a−b)(a−c)) + 1/((b−c)(b−a)) + 1/((c−a)(c−b)) = 0
    let part = |p: &RationalFunction, q: &RationalFunction, r: &RationalFunction| {
        RationalFunction::one().over(&p.minus(q).times(&p.minus(r))).expect("not zero")
    };
    assert!(part(&a, &b, &c).plus(&part(&b, &c, &a)).plus(&part(&c, &a, &b)).is_zero());
    // (a³ − b³)/(a − b) = a² + ab + b²
    let cube = |v: &RationalFunction| v.times(v).times(v);
    let quotient = cube(&a).minus(&cube(&b)).over(&a.minus(&b)).expect("not zero");
    assert_eq!(quotient, a.times(&a).plus(&a.times(&b)).plus(&b.times(&b)));
    assert_eq!(quotient.terms(), Some(3));
    assert_eq!(quotient.degrees(), Some((2, 0)));
    // a/b ≠ b/a, though they agree at a = b.
    assert_ne!(a.over(&b).expect("not zero"), b.over(&a).expect("not zero"));
    assert_eq!(a.over(&a.minus(&a)), Err(Undefined::DivisionByZero));
    assert_eq!(a.minus(&b).to_string(), "x0 - x1");
}

/// The bound of work answers, and does not hang.
#[test]
fn what_is_too_large_is_undecided() {
    let sum = (0..12).fold(RationalFunction::one(), |sum, i| sum.plus(&x(i)));
    let mut power = sum.clone();
    for _ in 0..9 {
        power = power.times(&sum);
        if power.is_too_large() {
            break;
        }
    }
    assert!(power.is_too_large());
    assert_eq!(power.zero_test(), ZeroTest::Undecided);
    let alone = exact_kalman::matrix::Matrix::from_fn(1, 1, |_, _| power.clone());
    assert!(matches!(exact_kalman::matrix::Echelon::of(&alone, 1), Err(exact_kalman::matrix::Undecided { column: 0 })));
    assert_eq!(sum.over(&power), Err(Undefined::Undecided));
    assert!(power.minus(&power).is_too_large());
    assert_eq!(power, power.clone());
    assert_ne!(power, sum);
    assert!(RationalFunction::variable(64).is_too_large());
}
