//! Lemmas about expectations on finite spaces: taking out what is known, and Gaussian integrals.

use exact_kalman::scalar::{Rational, ratio};
use proptest::collection::vec;
use proptest::prelude::*;

use super::search::{counterexample, holds_without};

/// A space of four points of the given weights, in two cells {0, 1} and {2, 3}; α and X by their values.
type Space = (Vec<i64>, Vec<i64>, Vec<i64>);

fn spaces() -> impl Strategy<Value = Space> {
    (vec(1_i64..5, 4), vec(-3_i64..4, 4), vec(-3_i64..4, 4))
}

/// E(f | cell) at each point.
fn conditional(weights: &[i64], f: impl Fn(usize) -> i64) -> Vec<Rational> {
    let average = |cell: [usize; 2]| {
        let mass: i64 = cell.iter().map(|&i| weights[i]).sum();
        ratio(cell.iter().map(|&i| weights[i] * f(i)).sum(), mass)
    };
    let [first, second] = [average([0, 1]), average([2, 3])];
    vec![first.clone(), first, second.clone(), second]
}

fn is_taken_out((weights, alpha, x): &Space) -> bool {
    let (product, alone) = (conditional(weights, |i| alpha[i] * x[i]), conditional(weights, |i| x[i]));
    (0..4).all(|i| product[i] == ratio(alpha[i], 1) * &alone[i])
}

/// CKS-L0: what the cells know is taken out; what they do not know is not.
#[test]
fn only_what_is_known_is_taken_out() {
    let known = |alpha: &[i64]| alpha[0] == alpha[1] && alpha[2] == alpha[3];
    let measurable =
        spaces().prop_map(|(weights, alpha, x)| (weights, vec![alpha[0], alpha[0], alpha[2], alpha[2]], x));
    holds_without(measurable, is_taken_out);
    let (_, alpha, _) = counterexample(spaces(), is_taken_out);
    assert!(!known(&alpha));
}

/// `(1/b(n)) Σ b(k)a(k)` over a series `a` that is at an end after its first terms.
fn weighted(a: &[i64], b: impl Fn(i64) -> Rational, n: i64) -> Rational {
    let sum: Rational = a.iter().zip(1..).map(|(&a, k)| b(k) * ratio(a, 1)).sum();
    sum / b(n)
}

/// AK-Kron: for a series that ends, the weighted sums are a constant over b(n): they fall below a thousandth where b grows without
/// bound, and not where b stops growing.
#[test]
fn weights_must_grow_without_bound() {
    let series = || vec(-3_i64..4, 1..6);
    let falls = |b: fn(i64) -> Rational| {
        move |a: &Vec<i64>| {
            let value = weighted(a, b, 1_000_000);
            value < ratio(1, 1000) && value > ratio(-1, 1000)
        }
    };
    holds_without(series(), falls(|k| ratio(k, 1)));
    let a = counterexample(series(), falls(|k| ratio(k.min(2), 1)));
    assert!(a.iter().any(|&a| a != 0));
}
