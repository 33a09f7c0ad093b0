//! Symmetric powers against monomials that are multiplied out.

use exact_kalman::matrix::Matrix;
use exact_kalman::scalar::{Rational, ratio};

use crate::worlds::{matrices, signs};

type Q = Matrix<Rational>;

/// All monomials of two variables, x₁ⁿ first.
fn monomials_of_two(x: &Q, degree: i32) -> Q {
    Matrix::column((0..=degree).map(|i| x[(0, 0)].pow(degree - i) * x[(1, 0)].pow(i)).collect())
}

#[test]
fn symmetric_powers_of_all_matrices_of_signs() {
    let points = [(2, 3), (-1, 5), (7, -2)].map(|(a, b)| Matrix::column(vec![ratio(a, 1), ratio(b, 2)]));
    let mut count = 0;
    for a in matrices(2, 2, &signs()) {
        for degree in 0..=4_u8 {
            let power = a.symmetric_power(degree.into());
            for x in &points {
                assert_eq!(&power * monomials_of_two(x, degree.into()), monomials_of_two(&(&a * x), degree.into()));
                count += 1;
            }
        }
    }
    assert_eq!(count, 81 * 5 * 3);
}

/// With d variables: the trace of A^[2] is ((tr A)² + tr A²)/2, its size C(d+1, 2), and products go to products.
#[test]
fn symmetric_squares_have_their_trace() {
    let trace = |a: &Q| (0..a.rows()).map(|i| a[(i, i)].clone()).sum::<Rational>();
    for d in 1..=3 {
        let entries = signs();
        let all = matrices(d, d, &entries);
        let some: Vec<Q> = all.step_by(if d == 3 { 97 } else { 1 }).collect();
        for (i, a) in some.iter().enumerate() {
            let square = a.symmetric_power(2);
            assert_eq!(square.rows(), d * (d + 1) / 2);
            assert_eq!(trace(&square), (trace(a).pow(2) + trace(&(a * a))) / ratio(2, 1));
            let b = &some[(i * 7 + 3) % some.len()];
            assert_eq!((a * b).symmetric_power(3), a.symmetric_power(3) * b.symmetric_power(3));
        }
    }
    // A row holds the coefficients of a power of its linear form: (x + 2y)³.
    assert_eq!(Q::from_integers(&[[1, 2]]).symmetric_power(3), Q::from_integers(&[[1, 6, 12, 8]]));
    assert_eq!(Q::zeros(0, 0).symmetric_power(0), Q::identity(1));
}
