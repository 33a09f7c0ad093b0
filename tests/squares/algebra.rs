//! The room `matrix`, as far as it needs no order.

use exact_kalman::matrix::{Echelon, Matrix, PseudoInverseError, SolveError};
use exact_kalman::scalar::{Field, Scalar, ZeroTest};

use super::ball::enclosed;
use super::commuting::{Algorithm, Answer, Named};
use super::inputs::Input;
use super::maps::over_fields;

/// An algorithm: its name, the bound on the scalar, the functions covered, and what it answers.
macro_rules! algorithm {
    ($name:ident, $bound:ident, $covers:expr, |$input:ident| $answer:expr) => {
        pub struct $name;

        impl $crate::commuting::Named for $name {
            const NAME: &'static str = stringify!($name);
            const COVERS: &'static [&'static str] = &$covers;
        }

        impl<S: $bound> $crate::commuting::Algorithm<S> for $name {
            fn run($input: &$crate::inputs::Input<S>) -> $crate::commuting::Answer<S> {
                $answer
            }
        }
    };
}
pub(crate) use algorithm;

algorithm!(
    Products,
    Scalar,
    ["matrix::Matrix::congruence", "matrix::Matrix::scaled", "matrix::Matrix::block_diagonal"],
    |input| {
        let Input { a, b, wide, p, x, .. } = input;
        let sums = (a + b) * (a - b) - -(a * wide * wide.transpose());
        let joined = a.block_diagonal(p).congruence(&b.block_diagonal(p).transpose()) * x.above(x);
        Answer::new().matrix(&sums).matrix(&joined).matrix(&a.congruence(p).scaled(&x[(0, 0)]))
    }
);

algorithm!(
    Traces,
    Scalar,
    [
        "matrix::Matrix::trace",
        "matrix::Matrix::squared_norm",
        "matrix::Matrix::zeros",
        "matrix::Matrix::identity",
        "matrix::Matrix::diagonal",
        "matrix::Matrix::from_integers"
    ],
    |input| {
        let n = input.a.rows();
        let constants = Matrix::<S>::from_integers(&[[-3, 0], [7, i64::MIN]]).block_diagonal(&Matrix::identity(n));
        let diagonal = Matrix::diagonal(input.x.entries()) + Matrix::zeros(n, n);
        Answer::new()
            .number(&input.a.trace())
            .number(&input.wide.squared_norm())
            .matrix(&constants)
            .matrix(&(diagonal * &input.a))
    }
);

algorithm!(Sums, Scalar, [], |input| {
    // Nothing follows these that would bring a number back into its form.
    let Input { a, b, .. } = input;
    let nothing = a - &a.clone();
    let vanishing = nothing.entries().iter().all(|entry| entry.zero_test() == ZeroTest::Zero);
    Answer::new().matrix(&(a + b)).matrix(&(a - b)).matrix(&-a).matrix(&nothing).matrix(&(a + -a)).says(vanishing)
});

fn echelon<S: Scalar>(matrix: &Matrix<S>, columns: usize) -> Answer<S> {
    let Ok(echelon) = Echelon::of(matrix, columns) else { return Answer::new().undecided() };
    let Ok(reduced) = echelon.reduced() else { return Answer::new().undecided() };
    let answer = Answer::new().count(echelon.rank()).number(echelon.divisor()).matrix(echelon.undivided());
    echelon.pivots().iter().fold(answer.matrix(&reduced), |answer, &pivot| answer.count(pivot))
}

algorithm!(
    Elimination,
    Scalar,
    [
        "matrix::Echelon::of",
        "matrix::Echelon::rank",
        "matrix::Echelon::pivots",
        "matrix::Echelon::divisor",
        "matrix::Echelon::undivided",
        "matrix::Echelon::reduced"
    ],
    |input| echelon(&input.wide.beside(&input.b), input.wide.columns())
);

algorithm!(Determinants, Scalar, ["matrix::Matrix::determinant"], |input| {
    match input.a.determinant() {
        Ok(determinant) => Answer::new().number(&determinant),
        Err(_) => Answer::new().undecided(),
    }
});

fn solved<S: Scalar>(solution: Result<Matrix<S>, SolveError>) -> Answer<S> {
    match solution {
        Ok(solution) => Answer::new().matrix(&solution),
        Err(SolveError::Singular { rank, order }) => Answer::new().refused().count(rank).count(order),
        Err(SolveError::Undecided(_)) => Answer::new().undecided(),
    }
}

algorithm!(Solving, Scalar, ["matrix::Matrix::solve"], |input| solved(input.a.solve(&input.b)));
algorithm!(Inversion, Scalar, ["matrix::Matrix::inverse"], |input| solved(input.a.inverse()));

fn pseudo_inverse<S: Scalar>(result: Result<Matrix<S>, PseudoInverseError>) -> Answer<S> {
    match result {
        Ok(inverse) => Answer::new().matrix(&inverse),
        Err(PseudoInverseError::DoesNotExist { rank, order }) => Answer::new().refused().count(rank).count(order),
        Err(PseudoInverseError::Undecided(_)) => Answer::new().undecided(),
    }
}

algorithm!(PseudoInversion, Scalar, ["matrix::Matrix::pseudo_inverse"], |input| pseudo_inverse(
    input.wide.pseudo_inverse()
));
algorithm!(ParallelSums, Scalar, ["matrix::Matrix::parallel_sum"], |input| pseudo_inverse(
    input.p.parallel_sum(&input.q)
));

algorithm!(Factorisation, Scalar, ["matrix::Matrix::full_rank_factorisation"], |input| {
    match input.wide.full_rank_factorisation() {
        Ok(factors) => Answer::new().matrix(&factors.left).matrix(&factors.right),
        Err(_) => Answer::new().undecided(),
    }
});

algorithm!(PseudoDeterminants, Scalar, ["matrix::Matrix::pseudo_determinant"], |input| {
    match input.p.pseudo_determinant() {
        Ok(determinant) => Answer::new().number(&determinant),
        Err(_) => Answer::new().undecided(),
    }
});

algorithm!(CharacteristicPolynomials, Scalar, ["matrix::Matrix::characteristic_polynomial"], |input| {
    input.a.characteristic_polynomial().iter().fold(Answer::new(), Answer::number)
});

algorithm!(SymmetricPowers, Scalar, ["matrix::Matrix::symmetric_power"], |input| {
    Answer::new().matrix(&input.a.symmetric_power(2)).matrix(&input.wide.block(0..1, 0..1).symmetric_power(3))
});

algorithm!(Ranks, Field, ["matrix::Matrix::rank", "matrix::Matrix::kernel", "matrix::Matrix::is_zero"], |input| {
    let kernel = input.wide.kernel();
    Answer::new()
        .count(input.wide.rank())
        .says((&input.wide * &kernel).is_zero())
        .matrix(&kernel)
        .says(input.p.is_zero())
});

algorithm!(SteinSolutions, Field, ["matrix::Matrix::stein_solution"], |input| {
    match input.a.stein_solution(&input.b) {
        Ok(solution) => Answer::new().matrix(&solution),
        Err(error) => Answer::new().refused().matrix(&error.homogeneous),
    }
});

pub const COVERED: &[&[&str]] = &[
    Products::COVERS,
    Traces::COVERS,
    Elimination::COVERS,
    Determinants::COVERS,
    Solving::COVERS,
    Inversion::COVERS,
    PseudoInversion::COVERS,
    ParallelSums::COVERS,
    Factorisation::COVERS,
    PseudoDeterminants::COVERS,
    CharacteristicPolynomials::COVERS,
    SymmetricPowers::COVERS,
    Ranks::COVERS,
    SteinSolutions::COVERS,
];

/// Sums, products, traces and constants.
#[test]
fn arithmetic_commutes() {
    over_fields!(Sums, Products, Traces, SymmetricPowers);
    enclosed!(Products, Traces, SymmetricPowers);
}

/// Elimination, and everything made of pivots.
#[test]
fn elimination_commutes() {
    over_fields!(Elimination, Determinants, Solving, Inversion, Ranks);
    enclosed!(Elimination, Determinants, Solving, Inversion);
}

/// CKS-L3-pinv, HV-L3: the full-rank formula commutes with maps of fields; AK-Par: so does the parallel sum.
#[test]
fn pseudo_inverses_commute() {
    over_fields!(Factorisation, PseudoInversion, PseudoDeterminants, ParallelSums);
    enclosed!(Factorisation, PseudoInversion, PseudoDeterminants, ParallelSums);
}

/// Characteristic polynomials, and Stein's equation.
#[test]
fn spectra_commute() {
    over_fields!(CharacteristicPolynomials, SteinSolutions);
    enclosed!(CharacteristicPolynomials);
}

/// The helper must see an algorithm that is not generic: one that asks for the characteristic does not commute.
#[test]
fn an_algorithm_that_knows_its_scalar_does_not_commute() {
    struct Peeking;
    impl Named for Peeking {
        const NAME: &'static str = "Peeking";
        const COVERS: &'static [&'static str] = &[];
    }
    impl<S: Field> Algorithm<S> for Peeking {
        fn run(input: &Input<S>) -> Answer<S> {
            let is_residue = std::any::type_name::<S>().contains("Residue");
            Answer::new().matrix(if is_residue { &input.b } else { &input.a })
        }
    }
    let run = || super::commuting::commutes::<super::maps::Modulo<101>, Peeking>();
    let message = std::panic::catch_unwind(run).expect_err("a square that does not commute");
    assert!(message.downcast_ref::<String>().is_some_and(|text| text.contains("Peeking under")));
}
