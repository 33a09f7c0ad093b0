//! Lemma 4.1 of Anderson and others without F ≥ 0, G ≥ 0. (That it holds as a whole: `papers::anderson_riccati::parallel_sum`.)

use exact_kalman::matrix::Matrix;
use proptest::prelude::*;

use super::models::{Q, is_definite, is_semidefinite, le, matrices, parallel_sum, semidefinite};
use super::search::{counterexample, holds_where, holds_without};

fn symmetric(n: usize) -> impl Strategy<Value = Q> {
    matrices(n, n, 3).prop_map(|a| &a + a.transpose())
}

fn orders() -> std::ops::RangeInclusive<usize> {
    1..=2
}

fn pairs(first: bool, second: bool) -> impl Strategy<Value = (Q, Q)> {
    let one = |n, is_semidefinite: bool| if is_semidefinite { semidefinite(n).boxed() } else { symmetric(n).boxed() };
    orders().prop_flat_map(move |n| (one(n, first), one(n, second)))
}

/// AK-L4.1ii: `F:G = G:F ≥ 0`; without F ≥ 0 or without G ≥ 0 the sum may be negative. Where both are dropped it
/// may not even commute: (F + G)⁺ then loses a direction that F sees.
#[test]
fn symmetry_needs_semidefinite_matrices() {
    for (first, second) in [(false, true), (true, false)] {
        let (f, g) = counterexample(pairs(first, second), |(f, g)| is_semidefinite(&parallel_sum(f, g)));
        assert!(is_semidefinite(&f) != is_semidefinite(&g), "{f} and {g}");
    }
    let (f, g) = counterexample(pairs(false, false), |(f, g)| parallel_sum(f, g) == parallel_sum(g, f));
    assert!(!is_semidefinite(&f) || !is_semidefinite(&g));
    holds_without(pairs(true, true), |(f, g)| {
        let sum = parallel_sum(f, g);
        is_semidefinite(&sum) && sum == parallel_sum(g, f)
    });
}

/// AK-L4.1iii: monotony fails with an F that is not ≥ 0, with a G that is not, and without F ≤ H.
#[test]
fn monotony_needs_semidefinite_matrices() {
    let triples = |first, second| (pairs(first, second), 0_i64..4, 0_i64..4);
    let larger = |f: &Q, i: i64, j: i64| {
        let v = Matrix::from_fn(f.rows(), 1, |row, _| exact_kalman::scalar::ratio(if row == 0 { i } else { j }, 1));
        f + &v * v.transpose()
    };
    let is_monotone =
        |((f, g), i, j): &((Q, Q), i64, i64)| le(&parallel_sum(f, g), &parallel_sum(&larger(f, *i, *j), g));
    for (first, second) in [(false, true), (true, false)] {
        let ((f, g), ..) = counterexample(triples(first, second), is_monotone);
        assert!(!is_semidefinite(&f) || !is_semidefinite(&g));
    }
    holds_without(triples(true, true), is_monotone);
    let (f, h, g) =
        counterexample(orders().prop_flat_map(|n| (semidefinite(n), semidefinite(n), semidefinite(n))), |(f, h, g)| {
            le(&parallel_sum(f, g), &parallel_sum(h, g))
        });
    assert!(!le(&f, &h), "{f}, {h}, {g}");
}

/// AK-L4.1iv: `F:G = F − F(F + G)⁻¹F` is a matter of algebra where F + G is regular, whatever the signs; that it is ≤ F follows
/// from F + G > 0 alone, and fails without a sign of F + G.
#[test]
fn the_subtractive_form_needs_no_sign_and_the_bound_does() {
    let is_regular = |(f, g): &(Q, Q)| (f + g).rank() == f.rows();
    let subtractive =
        |(f, g): &(Q, Q)| (f + g).inverse().is_ok_and(|inverse| parallel_sum(f, g) == f - f * inverse * f);
    holds_where(pairs(false, false), is_regular, subtractive);
    holds_where(pairs(false, false), |(f, g)| is_definite(&(f + g)), |(f, g)| le(&parallel_sum(f, g), f));
    let (f, g) = counterexample(pairs(true, false), |(f, g)| le(&parallel_sum(f, g), f));
    assert!(!is_semidefinite(&(&f + &g)), "{f} and {g}");
}

/// AK-L4.1iv: without F + G > 0 the form needs ⁺, and F ≥ 0: with signs the pseudo-inverse does not give F:G.
#[test]
fn the_subtractive_form_with_singular_sums_needs_signs() {
    let subtractive = |(f, g): &(Q, Q)| {
        let inverse = (f + g).pseudo_inverse().expect("over an ordered field");
        parallel_sum(f, g) == f - f * inverse * f
    };
    holds_without(pairs(true, true), subtractive);
    let (f, g) = counterexample(pairs(false, false), subtractive);
    assert!(!is_definite(&(&f + &g)) && (&f + &g).rank() < f.rows(), "{f} and {g}");
}
