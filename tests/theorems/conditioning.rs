//! Lemmas 2 and 3 of Chen, Kumar and van Schuppen (those of Hilgert and Vila's appendix) on random models, and without
//! each hypothesis.

use exact_kalman::gaussian::{ConditionError, Gaussian, Polynomial};
use exact_kalman::matrix::Matrix;
use exact_kalman::scalar::{Rational, ratio};
use proptest::collection::vec;
use proptest::prelude::*;

use super::models::{Q, is_definite, is_semidefinite, matrices, semidefinite};
use super::search::{counterexample, holds_where, holds_without};

/// X is the first component, Y the others.
fn conditioned(joint: &Q) -> Option<(Q, Q, Q)> {
    let n = joint.rows();
    let law = Gaussian::new(Matrix::zeros(n, 1), joint.clone()).expect("symmetric");
    let observed: Vec<usize> = (1..n).collect();
    // The mean itself is in the support of every law.
    let found = law.conditioned(&observed, &Matrix::zeros(n - 1, 1)).ok()?;
    Some((found.gain, found.cross_covariance, found.law.covariance().clone()))
}

fn semidefinite_joints() -> impl Strategy<Value = Q> {
    (2_usize..=4).prop_flat_map(semidefinite)
}

fn symmetric_joints() -> impl Strategy<Value = Q> {
    (2_usize..=3).prop_flat_map(|n| matrices(n, n, 2)).prop_map(|a| &a + a.transpose())
}

/// cov(X − K Y, Y) = 0: the residual of X is uncorrelated with what is observed.
fn is_residual_uncorrelated(joint: &Q) -> bool {
    let n = joint.rows();
    conditioned(joint).is_none_or(|(gain, cross, _)| cross == gain * joint.block(1..n, 1..n))
}

/// The covariance handed out is that of X − K Y: K is the regression, and P = cov(X − K Y).
fn is_residual_covariance(joint: &Q) -> bool {
    conditioned(joint)
        .is_none_or(|(gain, _, covariance)| Matrix::identity(1).beside(&-gain).congruence(joint) == covariance)
}

proptest! {
    /// CKS-L3i, HV-L3-mean, HV-L3-cov: the residual is uncorrelated with the data, and the covariance is its own; it is never
    /// negative and never above the prior. At y = E(Y) + P_yy z, which is in the support for every z, the mean is E(X) + P_xy z.
    #[test]
    fn conditioning_is_regression(joint in semidefinite_joints(), numbers in vec(-3_i64..4, 7)) {
        let n = joint.rows();
        let column = |places: std::ops::Range<usize>| Matrix::column(numbers[places].iter().map(|&x| ratio(x, 2)).collect());
        let (mean, z) = (column(0..n), column(n..2 * n - 1));
        let observed: Vec<usize> = (1..n).collect();
        let values = mean.select_rows(&observed) + joint.select(&observed, &observed) * &z;
        let law = Gaussian::new(mean.clone(), joint.clone()).expect("symmetric");
        let found = law.conditioned(&observed, &values).expect("in the support");
        prop_assert_eq!(found.law.mean(), &(mean.select_rows(&[0]) + joint.select(&[0], &observed) * z));
        prop_assert!(is_residual_uncorrelated(&joint) && is_residual_covariance(&joint));
        let (_, _, covariance) = conditioned(&joint).expect("over an ordered field");
        prop_assert!(is_semidefinite(&covariance));
        prop_assert!(covariance[(0, 0)] <= joint[(0, 0)]);
    }
}

/// CKS-L3i, CKS-L3ii, HV-L3-cov: without a positive semidefinite joint covariance the residual is correlated with the data. The
/// covariance handed out is that of the residual all the same: S⁺SS⁺ = S⁺ is all it needs.
#[test]
fn conditioning_needs_a_covariance() {
    let joint = counterexample(symmetric_joints(), is_residual_uncorrelated);
    assert!(!is_semidefinite(&joint), "{joint}");
    holds_without(symmetric_joints(), is_residual_covariance);
    let n = joint.rows();
    assert!(joint.block(1..n, 1..n).rank() < n - 1, "a regular S would be enough");
}

/// CKS-L3i: without data in the support there is no value; the refusal carries a direction of variance zero, along which the
/// data differ from the mean.
#[test]
fn conditioning_needs_data_in_the_support() {
    let models = (1_usize..=2).prop_flat_map(|m| (semidefinite(m + 1), matrices(m, 1, 2)));
    let given = |(joint, data): &(Q, Q)| {
        let n = joint.rows();
        let law = Gaussian::new(Matrix::zeros(n, 1), joint.clone()).expect("symmetric");
        law.conditioned(&(1..n).collect::<Vec<_>>(), data)
    };
    let model = counterexample(models, |model| given(model).is_ok());
    let (joint, data) = &model;
    let n = joint.rows();
    let observed = joint.block(1..n, 1..n);
    assert!(observed.beside(data).rank() > observed.rank());
    let Err(ConditionError::Inconsistent(proof)) = given(&model) else { panic!("{joint} given {data}") };
    assert!((observed * &proof.direction).is_zero());
    assert_ne!(proof.direction.transpose() * data, Matrix::zeros(1, 1));
}

/// Whether A(X)X with A(X) = fixed + slope·X, for X ~ N(mean, variance), has the mean fixed·mean and the third and fourth central
/// moments of a Gaussian law.
fn looks_gaussian((mean, variance, fixed, slope): (i64, i64, i64, i64)) -> bool {
    let law =
        Gaussian::new(Matrix::column(vec![ratio(mean, 1)]), Matrix::column(vec![ratio(variance, 1)])).expect("a law");
    let x = Polynomial::<Rational>::variable(1, 0);
    let image = x.scaled(&ratio(fixed, 1)).plus(&x.times(&x).scaled(&ratio(slope, 1)));
    let expected = |p: &Polynomial<Rational>| law.expectation(p).expect("semidefinite");
    let centred = image.plus(&Polynomial::constant(1, -expected(&image)));
    let square = centred.times(&centred);
    let second = expected(&square);
    expected(&centred.times(&square)) == ratio(0, 1)
        && expected(&square.times(&square)) == ratio(3, 1) * &second * second
        && expected(&image) == ratio(fixed, 1) * ratio(mean, 1)
}

/// CKS-L2i, HV-L2i: an affine image has the moments of a Gaussian; with an A that depends on X it has not.
#[test]
fn affine_images_need_coefficients_that_x_does_not_move() {
    let numbers = |slopes: std::ops::Range<i64>| (-3_i64..4, 0_i64..4, -3_i64..4, slopes);
    holds_without(numbers(0..1), |&numbers| looks_gaussian(numbers));
    let (_, _, _, slope) = counterexample(numbers(-3..4), |&numbers| looks_gaussian(numbers));
    assert_ne!(slope, 0);
}

/// A law on finitely many points of the plane, equally likely, and their mirror images under y ↦ −y: X and Y are uncorrelated.
fn mirrored() -> impl Strategy<Value = Vec<(i64, i64)>> {
    vec((-2_i64..3, -2_i64..3), 1..4)
        .prop_map(|atoms| atoms.iter().flat_map(|&(x, y)| [(x, y), (x, -y)]).collect::<Vec<_>>())
}

/// E XⁱYʲ = E Xⁱ E Yʲ for i, j ≤ 4
fn moments_factor(moment: impl Fn(u32, u32) -> Rational) -> bool {
    (0..5).all(|i| (0..5).all(|j| moment(i, j) == moment(i, 0) * moment(0, j)))
}

/// CKS-L2ii, HV-L2ii: for a joint Gaussian law the moments factor exactly if the covariance vanishes; without joint normality they
/// need not.
#[test]
fn independence_needs_joint_normality() {
    holds_without((semidefinite(2), matrices(2, 1, 2)), |(covariance, mean)| {
        let law = Gaussian::new(mean.clone(), covariance.clone()).expect("a law");
        let moment = |i, j| law.expectation(&Polynomial::term(ratio(1, 1), vec![i, j])).expect("semidefinite");
        moments_factor(moment) == law.are_independent(&[0], &[1])
    });
    let atoms = counterexample(mirrored(), |atoms| {
        let count = ratio(i64::try_from(atoms.len()).expect("few"), 1);
        moments_factor(|i, j| atoms.iter().map(|&(x, y)| ratio(x.pow(i) * y.pow(j), 1)).sum::<Rational>() / &count)
    });
    assert_eq!(atoms.iter().map(|(x, y)| x * y).sum::<i64>(), 0, "uncorrelated");
}

/// X = P⁺ + Z − P⁺P Z PP⁺, which is every X with PXP = P.
fn inverses() -> impl Strategy<Value = (Q, Q)> {
    (1_usize..=2, 1_usize..=2, 0_usize..=2).prop_flat_map(|(rows, columns, rank)| {
        (matrices(rows, rank, 2), matrices(rank, columns, 2), matrices(columns, rows, 2)).prop_map(|(u, v, z)| {
            let p = u * v;
            let inverse = p.pseudo_inverse().expect("over an ordered field");
            let x = &inverse + &z - &inverse * &p * z * &p * &inverse;
            (p, x)
        })
    })
}

/// CKS-L3-pinv: PXP = P with X = UPᵀ = PᵀV determines X; PXP = P alone does not, nor with one of the two forms.
#[test]
fn pseudo_inverses_need_both_conditions() {
    let is_right_form = |p: &Q, x: &Q| p.transpose().beside(x).rank() == p.rank();
    let is_left_form = |p: &Q, x: &Q| p.transpose().above(x).rank() == p.rank();
    let is_inverse = |p: &Q, x: &Q| *x == p.pseudo_inverse().expect("over an ordered field");
    holds_without(inverses(), |(p, x)| *p == p * x * p);
    holds_where(inverses(), |(p, x)| is_right_form(p, x) && is_left_form(p, x), |(p, x)| is_inverse(p, x));
    counterexample(inverses(), |(p, x)| is_inverse(p, x));
    let (p, x) = counterexample(inverses(), |(p, x)| !is_right_form(p, x) || is_inverse(p, x));
    assert!(!is_left_form(&p, &x));
    let (p, x) = counterexample(inverses(), |(p, x)| !is_left_form(p, x) || is_inverse(p, x));
    assert!(!is_right_form(&p, &x));
    // Without PXP = P: X = 0 is of both forms.
    let (p, x) = (Matrix::<Rational>::identity(1), Matrix::zeros(1, 1));
    assert!(is_right_form(&p, &x) && is_left_form(&p, &x) && !is_inverse(&p, &x));
}

/// HV-L3: P⁺ = Vᵀ(VVᵀ)⁻¹(UᵀU)⁻¹Uᵀ for every factorisation of full rank; for factors that are too wide the Gram matrices have no
/// inverse, and with ⁺ in its place the formula is wrong.
#[test]
fn the_full_rank_formula_needs_full_rank() {
    let factors =
        || (1_usize..=3, 1_usize..=2, 1_usize..=3).prop_flat_map(|(m, r, n)| (matrices(m, r, 2), matrices(r, n, 2)));
    let formula = |u: &Q, v: &Q| {
        let (ut, vt) = (u.transpose(), v.transpose());
        let inverse = |gram: Q| gram.pseudo_inverse().expect("over an ordered field");
        &vt * inverse(v * &vt) * inverse(&ut * u) * &ut
    };
    let is_full = |u: &Q, v: &Q| u.rank() == u.columns() && v.rank() == v.rows();
    let is_right = |u: &Q, v: &Q| formula(u, v) == (u * v).pseudo_inverse().expect("over an ordered field");
    holds_where(factors(), |(u, v)| is_full(u, v), |(u, v)| is_right(u, v));
    let (u, v) = counterexample(factors(), |(u, v)| is_right(u, v));
    assert!(!is_definite(&(u.transpose() * &u)) || !is_definite(&(&v * v.transpose())));
}
