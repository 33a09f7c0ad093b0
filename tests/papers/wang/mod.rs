//! Wang, Guo 1999: the claims on random Riccati equations, and what the paper prints beside what is right.

mod adapted;
mod bounded_moments;
mod closed_loop;
mod constants;
mod critical;
mod decay;
mod draws;
mod earlier_conditions;
mod equation;
mod error_recursion;
mod exponential;
mod gramian;
mod lossy_link;
mod means;
mod misspecified;
mod moment_conditions;
mod moments;
mod observability;
mod observer;
mod optimality;
mod paths;
mod powers;
mod sources;
mod transition;
mod uniform_bound;
mod window;

use exact_kalman::matrix::Matrix;
use exact_kalman::scalar::{Rational, ratio};
use exact_kalman::stability::Mode;

type Q = Matrix<Rational>;

/// A 1×1 matrix.
fn scalar(value: Rational) -> Q {
    Matrix::column(vec![value])
}

/// The scalar mode with these F, H, Q and R.
fn scalar_mode([f, h, q, r]: [Rational; 4]) -> Mode<Rational> {
    Mode::new(scalar(f), scalar(h), scalar(q), scalar(r)).expect("shapes fit and variances are not negative")
}

/// The same for integers.
fn integer_mode(entries: [i64; 4]) -> Mode<Rational> {
    scalar_mode(entries.map(|entry| ratio(entry, 1)))
}
