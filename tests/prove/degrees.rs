//! Bounds of degrees, and what they are good for.

use exact_kalman::matrix::Matrix;
use exact_kalman::prove::Tracked;
use exact_kalman::scalar::{Field, Mersenne61, RationalFunction, Scalar};

/// The entries of a pseudo-inverse of rank one, an inverse and a parallel sum.
fn entries<F: Field>(next: &mut impl FnMut() -> F) -> Vec<F> {
    let u = Matrix::from_fn(3, 1, |_, _| next());
    let v = Matrix::from_fn(1, 2, |_, _| next());
    let (f, g) = (Matrix::from_fn(2, 2, |_, _| next()), Matrix::from_fn(2, 2, |_, _| next()));
    let all = [
        (u * v).pseudo_inverse().expect("there is one"),
        f.inverse().expect("regular"),
        f.parallel_sum(&g).expect("regular"),
    ];
    all.iter().flat_map(|matrix| matrix.entries().to_vec()).collect()
}

/// The second route to a degree: the rational function itself.
#[test]
fn bounds_of_degrees_are_no_less_than_the_degrees() {
    let mut number = 0;
    let functions = entries(&mut || {
        number += 1;
        RationalFunction::variable(number - 1)
    });
    let mut value = 1;
    let tracked = entries(&mut || {
        value = value * 48_271 % 2_147_483_647;
        Tracked::variable(Mersenne61::new(value))
    });
    for (function, bound) in functions.iter().zip(&tracked) {
        let (above, below) = function.degrees().expect("short");
        let (most_above, most_below) = bound.degrees();
        assert!(u128::from(above) <= most_above && u128::from(below) <= most_below, "{function:?}, {bound:?}");
    }
}

#[test]
fn degrees_follow_the_operations() {
    let (x, y) = (Tracked::variable(Mersenne61::new(3)), Tracked::variable(Mersenne61::new(5)));
    let quotient = x.times(&x).over(&y).expect("not zero");
    assert_eq!(quotient.degrees(), (2, 1));
    // x²/y + x = (x² + xy)/y
    assert_eq!(quotient.plus(&x).degrees(), (2, 1));
    // x²/y − y/x²: (x⁴ − y²)/(x²y)
    assert_eq!(quotient.minus(&y.over(&x.times(&x)).expect("not zero")).degrees(), (4, 3));
    assert_eq!(Tracked::from_integer(7).degrees(), (0, 0));
}
