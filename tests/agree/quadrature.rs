//! Exact expectations of polynomials in independent standard Gaussian variables.
//!
//! Weights on the integers −M, …, M that give the moments 1, 0, 1, 0, 3, 0, 15, … of N(0, 1) up to degree 2M + 1 give
//! the expectation of every polynomial of that degree in each variable. Some are negative: it is a sum, not a law.

use exact_kalman::matrix::Matrix;
use exact_kalman::scalar::{Rational, ratio};

/// The nodes and weights that are exact up to degree 2M + 1.
pub fn standard(m: i64) -> Vec<(Rational, Rational)> {
    let nodes: Vec<Rational> = (-m..=m).map(|node| ratio(node, 1)).collect();
    let count = nodes.len();
    let powers = Matrix::from_fn(count, count, |power, node| (0..power).fold(ratio(1, 1), |p, _| p * &nodes[node]));
    // (2j − 1)!! for the even powers 2j.
    let moment = |power: usize| match power % 2 {
        0 => (1..power).step_by(2).fold(ratio(1, 1), |p, odd| p * ratio(i64::try_from(odd).expect("a small power"), 1)),
        _ => ratio(0, 1),
    };
    let weights = powers.solve(&Matrix::column((0..count).map(moment).collect())).expect("distinct nodes");
    nodes.into_iter().zip(weights.entries().to_vec()).collect()
}

/// E f(z) for z ~ N(0, I) of the given dimension: f returns a list of values, all expected at once.
pub fn expected(dimension: usize, m: i64, mut f: impl FnMut(&[Rational]) -> Vec<Rational>) -> Vec<Rational> {
    let rule = standard(m);
    let mut sums: Vec<Rational> = Vec::new();
    for place in 0..rule.len().pow(u32::try_from(dimension).expect("few dimensions")) {
        let digits = (0..dimension).scan(place, |rest, _| {
            let digit = *rest % rule.len();
            *rest /= rule.len();
            Some(&rule[digit])
        });
        let (point, weights): (Vec<Rational>, Vec<Rational>) = digits.cloned().unzip();
        let weight = weights.into_iter().fold(ratio(1, 1), |product, weight| product * weight);
        let values = f(&point);
        sums.resize(values.len(), ratio(0, 1));
        for (sum, value) in sums.iter_mut().zip(values) {
            *sum += value * &weight;
        }
    }
    sums
}

/// The known moments 1, 0, 1, 0, 3, 0, 15, 0, 105 come out, and one beyond the degree does not.
#[test]
fn moments_of_the_standard_law() {
    let power = |z: &[Rational], n: i32| z[0].pow(n);
    let found = expected(1, 4, |z| (0..=10).map(|n| power(z, n)).collect());
    assert_eq!(found[..10], [1, 0, 1, 0, 3, 0, 15, 0, 105, 0].map(|moment| ratio(moment, 1)));
    assert_ne!(found[10], ratio(945, 1));
}
