//! What algorithms are given: matrices, and a path with data that it can produce.

use std::cell::RefCell;
use std::num::NonZero;

use exact_kalman::matrix::Matrix;
use exact_kalman::model::{Path, PathAhead};
use exact_kalman::scalar::{Rational, Scalar, ratio};

use super::systems::{Draw, Kind, Tape, draw};

/// Matrices of one order n, and a column and a path of their own sizes.
#[derive(Clone, Debug)]
pub struct Input<S> {
    /// n×n, any.
    pub a: Matrix<S>,
    /// n×n, any.
    pub b: Matrix<S>,
    /// n×m, of any rank.
    pub wide: Matrix<S>,
    /// F Fᵀ, n×n, of any rank.
    pub p: Matrix<S>,
    /// F Fᵀ, n×n, of any rank.
    pub q: Matrix<S>,
    /// n×1
    pub x: Matrix<S>,
    pub ahead: PathAhead<S>,
}

const KIND: Kind = Kind { states: 3, sensors: 2, steps: 3, adapted: true, gaps: true };

fn fraction(tape: &mut Tape) -> Rational {
    let numerator = i64::try_from(tape.choice(7)).expect("small") - 3;
    ratio(numerator, [1, 1, 2, 3][tape.choice(4)])
}

fn path(tape: Vec<i8>) -> PathAhead<Rational> {
    let lag = 1 + usize::from(tape.first().copied().unwrap_or(0).unsigned_abs() % 3);
    let spread = tape.get(1).copied().unwrap_or(0);
    let draw = Draw { lag, ..draw(KIND, tape) };
    let mut system = draw.system();
    if spread > 40 {
        // A direction of which nothing is known.
        let direction = Matrix::from_fn(draw.mean.rows(), 1, |i, _| ratio(i64::from(spread) % 3 - i64::from(i > 0), 1));
        system.initial.diffuse = Some(&direction * direction.transpose());
    }
    let d = NonZero::new(lag).expect("at least one");
    system.realised_ahead(&draw.data(), d).unwrap_or_else(|error| panic!("a system that is one: {error}"))
}

impl<S: Scalar> Input<S> {
    /// The input that a tape describes.
    pub fn drawn(tape: &[i8], entry: impl Fn(&Rational, &Rational) -> S) -> Self {
        let (algebra, system) = tape.split_at(tape.len().min(120));
        let tape = RefCell::new(Tape::new(algebra.to_vec()));
        let n = 1 + tape.borrow_mut().choice(3);
        let any = |rows, columns| {
            Matrix::from_fn(rows, columns, |_, _| {
                let tape = &mut *tape.borrow_mut();
                entry(&fraction(tape), &fraction(tape))
            })
        };
        let square = || {
            let rank = tape.borrow_mut().choice(n + 1);
            let factor = any(n, rank);
            &factor * factor.transpose()
        };
        let (p, q, x, a) = (square(), square(), any(n, 1), any(n, n));
        let m = 1 + tape.borrow_mut().choice(3);
        let rank = tape.borrow_mut().choice(n.min(m) + 1);
        let (wide, b) = (any(n, rank) * any(rank, m), any(n, n));
        let lifted = |value: &Rational| Ok::<_, ()>(entry(value, &Rational::zero()));
        let ahead = path(system.to_vec()).try_map(lifted).expect("total");
        Self { a, b, wide, p, q, x, ahead }
    }

    pub fn try_map<U: Scalar>(&self, image: impl Fn(&S) -> Option<U>) -> Option<Input<U>> {
        let entry = |value: &S| image(value).ok_or(());
        let matrix = |matrix: &Matrix<S>| matrix.try_map(entry).ok();
        Some(Input {
            a: matrix(&self.a)?,
            b: matrix(&self.b)?,
            wide: matrix(&self.wide)?,
            p: matrix(&self.p)?,
            q: matrix(&self.q)?,
            x: matrix(&self.x)?,
            ahead: self.ahead.try_map(entry).ok()?,
        })
    }

    pub fn path(&self) -> &Path<S> {
        self.ahead.path()
    }
}
