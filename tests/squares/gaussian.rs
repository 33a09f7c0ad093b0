//! The room `gaussian`.

use exact_kalman::gaussian::{ConditionError, Gaussian, Polynomial};
use exact_kalman::matrix::{Matrix, PseudoInverseError};
use exact_kalman::scalar::{Field, OrderedField, Scalar};

use super::algebra::algorithm;
use super::ball::enclosed;
use super::commuting::{Algorithm, Answer, Drawn, Named};
use super::inputs::Input;
use super::maps::{over_fields, over_ordered_fields};

/// The law N(x, P) of an input, made by functions that every scalar has.
fn law<S: Scalar>(input: &Input<S>) -> Gaussian<S> {
    let n = input.p.rows();
    Gaussian::standard(n).affine(&input.b, &input.x)
}

fn refused<S: Scalar>(error: ConditionError<S>) -> Answer<S> {
    match error {
        ConditionError::Inconsistent(proof) => Answer::new().refused().matrix(&proof.direction).number(&proof.value),
        ConditionError::Diffuse => Answer::new().refused().count(1),
        ConditionError::PseudoInverse(PseudoInverseError::DoesNotExist { rank, order }) => {
            Answer::new().refused().count(rank).count(order)
        }
        ConditionError::PseudoInverse(PseudoInverseError::Undecided(_)) => Answer::new().undecided(),
    }
}

pub fn conditioned<S: Scalar>(input: &Input<S>) -> Answer<S> {
    // (X, Y) = (X, wideᵀ X), with data that X can explain but for the first, which is moved.
    let (n, m) = (input.p.rows(), input.wide.columns());
    let image = input.wide.transpose();
    let joint = law(input).affine(&Matrix::identity(n).above(&image), &input.x.above(&(&image * &input.x)));
    let observed: Vec<usize> = (n..n + m).collect();
    let moved = Matrix::from_fn(m, 1, |i, _| if i == 0 { input.q[(0, 0)].clone() } else { S::zero() });
    let offset = &image * (&input.b * &input.a * &input.x) + moved;
    let values = joint.marginal(&observed).mean() + offset;
    match joint.conditioned(&observed, &values) {
        Ok(found) => Answer::new()
            .matrix(found.law.mean())
            .matrix(found.law.covariance())
            .matrix(&found.innovation)
            .matrix(&found.innovation_covariance)
            .matrix(&found.pseudo_inverse)
            .matrix(&found.cross_covariance)
            .matrix(&found.gain),
        Err(error) => refused(error),
    }
}

algorithm!(
    Conditioning,
    Scalar,
    ["gaussian::Gaussian::conditioned", "gaussian::Gaussian::marginal", "gaussian::Inconsistent::found"],
    |input| conditioned(input)
);

algorithm!(
    AffineImages,
    Scalar,
    [
        "gaussian::Gaussian::affine",
        "gaussian::Gaussian::joined",
        "gaussian::Gaussian::standard",
        "gaussian::Gaussian::characteristic_exponent"
    ],
    |input| {
        let joined = law(input).joined(&Gaussian::standard(1));
        let exponent = law(input).characteristic_exponent(&(&input.a * &input.x));
        Answer::new()
            .matrix(joined.mean())
            .matrix(joined.covariance())
            .number(&exponent.linear)
            .number(&exponent.quadratic)
    }
);

algorithm!(Independence, Field, ["gaussian::Gaussian::new", "gaussian::Gaussian::are_independent"], |input| {
    let Ok(law) = Gaussian::new(input.x.clone(), input.p.clone()) else { return Answer::new().refused() };
    let joint = law.joined(&law);
    let n = input.p.rows();
    let far: Vec<usize> = (n..2 * n).collect();
    let symmetric = Gaussian::new(input.x.clone(), input.a.clone()).is_ok();
    Answer::new().says(joint.are_independent(&[0], &far)).says(joint.are_independent(&[0], &[n - 1])).says(symmetric)
});

fn polynomial<S: Field>(input: &Input<S>) -> Polynomial<S> {
    let n = input.x.rows();
    let linear =
        (0..n).fold(Polynomial::zero(n), |sum, i| sum.plus(&Polynomial::variable(n, i).scaled(&input.a[(0, i)])));
    let square = linear.times(&linear).plus(&Polynomial::term(input.b[(0, 0)].clone(), vec![2; n]));
    square.plus(&Polynomial::constant(n, input.x[(0, 0)].clone()))
}

fn terms<S: Field>(polynomial: &Polynomial<S>) -> Answer<S> {
    polynomial.terms().fold(Answer::new().count(polynomial.variables()), |answer, (exponents, coefficient)| {
        exponents.iter().fold(answer.number(coefficient), |answer, &e| answer.count(e as usize))
    })
}

algorithm!(
    Polynomials,
    Field,
    [
        "gaussian::Polynomial::zero",
        "gaussian::Polynomial::term",
        "gaussian::Polynomial::constant",
        "gaussian::Polynomial::variable",
        "gaussian::Polynomial::scaled",
        "gaussian::Polynomial::plus",
        "gaussian::Polynomial::times",
        "gaussian::Polynomial::derivative",
        "gaussian::Polynomial::terms",
        "gaussian::Polynomial::variables",
    ],
    |input| {
        let polynomial = polynomial(input);
        let slope = terms(&polynomial.derivative(0));
        let all = slope.plain.iter().fold(terms(&polynomial), |answer, &count| answer.count(count));
        slope.numbers.iter().fold(all, Answer::number)
    }
);

algorithm!(
    Expectations,
    OrderedField,
    ["gaussian::Gaussian::expectation", "gaussian::Gaussian::definiteness"],
    |input| {
        let Ok(law) = Gaussian::new(input.x.clone(), input.p.clone()) else { return Answer::new().refused() };
        let answer = Answer::new().says(law.definiteness().is_ok());
        match law.expectation(&polynomial(input)) {
            Ok(value) => answer.number(&value),
            Err(_) => answer.refused(),
        }
    }
);

pub const COVERED: &[&[&str]] =
    &[Conditioning::COVERS, AffineImages::COVERS, Independence::COVERS, Polynomials::COVERS, Expectations::COVERS];

/// CKS-L2i, CKS-L3i: affine images and conditioning, refusals with their witnesses included.
#[test]
fn gaussian_laws_commute() {
    over_fields!(Conditioning, AffineImages, Independence, Polynomials);
    enclosed!(Conditioning, AffineImages);
}

/// Expectations need a factorisation LDLᵀ, and so an order.
#[test]
fn expectations_commute() {
    over_ordered_fields!(Expectations);
}

/// Data outside the support are among the inputs, or refusals would be checked by nothing.
#[test]
fn data_are_refused_at_times() {
    let counts = super::commuting::counted("refused data", |tape| {
        let input = Input::<exact_kalman::scalar::Rational>::drawn(&tape, Drawn::drawn);
        Ok(<Conditioning as Algorithm<_>>::run(&input).plain[0] == 8_000)
    });
    assert!(counts.equal > 0 && counts.vanished > 0, "{counts:?}");
}
