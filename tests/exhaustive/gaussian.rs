//! CKS-L2i, CKS-L2ii and CKS-2 on small laws, by sums written out.

use exact_kalman::gaussian::{CharacteristicExponent, Gaussian};
use exact_kalman::matrix::Matrix;
use exact_kalman::scalar::{Rational, ratio};

use crate::worlds::{matrices, signs, symmetric};

type Q = Matrix<Rational>;

fn law(covariance: Q) -> Gaussian<Rational> {
    let mean = Matrix::from_fn(covariance.rows(), 1, |i, _| ratio([3, -1, 2][i], 2));
    Gaussian::new(mean, covariance).unwrap_or_else(|error| panic!("{error}"))
}

/// Σᵢⱼ lᵢ pᵢⱼ rⱼ
fn form(left: &[Rational], p: &Q, right: &[Rational]) -> Rational {
    let places = (0..p.rows()).flat_map(|i| (0..p.columns()).map(move |j| (i, j)));
    places.fold(ratio(0, 1), |sum, (i, j)| sum + &left[i] * &p[(i, j)] * &right[j])
}

fn dot(left: &[Rational], right: &[Rational]) -> Rational {
    left.iter().zip(right).fold(ratio(0, 1), |sum, (a, b)| sum + a * b)
}

/// CKS-L2i, entry by entry: E(AX + b) = A X̂ + b and cov(AX + b) = A P Aᵀ.
///
/// Domain: all symmetric 2×2 matrices P and all 2×2 matrices A over {−1, 0, 1}, one mean and one b.
#[test]
fn affine_images_have_the_moments_of_the_lemma() {
    let mut count = 0;
    let b = Matrix::column(vec![ratio(5, 1), ratio(-1, 3)]);
    for p in symmetric(2, &signs()) {
        let x = law(p.clone());
        for a in matrices(2, 2, &signs()) {
            let image = x.affine(&a, &b);
            for i in 0..2 {
                assert_eq!(image.mean()[(i, 0)], dot(a.row(i), x.mean().entries()) + &b[(i, 0)]);
                for j in 0..2 {
                    assert_eq!(image.covariance()[(i, j)], form(a.row(i), &p, a.row(j)));
                }
            }
            count += 1;
        }
    }
    assert_eq!(count, 27 * 81);
}

/// CKS-2, CKS-L2.image: `exp(iλᵀX̂ − ½ λᵀPλ)`, and under an affine map λᵀ(AX + b) = (Aᵀλ)ᵀX + λᵀb.
///
/// Domain: all symmetric 2×2 matrices P, all 2×2 matrices A and all λ over {−1, 0, 1}, one mean and one b.
#[test]
fn characteristic_exponents_follow_affine_maps() {
    let mut count = 0;
    let b = Matrix::column(vec![ratio(5, 1), ratio(-1, 3)]);
    for p in symmetric(2, &signs()) {
        let x = law(p.clone());
        for lambda in matrices(2, 1, &signs()) {
            let CharacteristicExponent { linear, quadratic } = x.characteristic_exponent(&lambda);
            assert_eq!(linear, dot(lambda.entries(), x.mean().entries()));
            assert_eq!(quadratic, form(lambda.entries(), &p, lambda.entries()));
            for a in matrices(2, 2, &signs()) {
                let image = x.affine(&a, &b).characteristic_exponent(&lambda);
                let moved = x.characteristic_exponent(&(a.transpose() * &lambda));
                assert_eq!(image.linear, moved.linear + dot(lambda.entries(), b.entries()));
                assert_eq!(image.quadratic, moved.quadratic);
                count += 1;
            }
        }
    }
    assert_eq!(count, 27 * 9 * 81);
}

/// CKS-L2ii: parts are independent iff their cross covariance vanishes, iff no value of one moves the law of the other.
///
/// Domain: all covariances LLᵀ, L 3×2 over {−1, 0, 1}, the first entry against the other two.
#[test]
fn independence_is_a_vanishing_cross_covariance() {
    let mut counts = [0; 2];
    for factor in matrices(3, 2, &signs()) {
        let p = &factor * factor.transpose();
        let joint = law(p.clone());
        let (x, y) = ([0], [1, 2]);
        let vanishes = p[(0, 1)] == ratio(0, 1) && p[(0, 2)] == ratio(0, 1);
        assert_eq!(joint.are_independent(&x, &y), vanishes);
        assert_eq!(joint.are_independent(&y, &x), vanishes);
        let alone = joint.marginal(&x);
        let moves = matrices(2, 1, &signs()).any(|source| {
            // A value that the law can produce.
            let value = joint.mean().select_rows(&y) + factor.select_rows(&y) * source;
            let given = joint.conditioned(&y, &value).unwrap_or_else(|error| panic!("{p}: {error}"));
            given.law != alone
        });
        assert_eq!(moves, !vanishes, "{p}");
        counts[usize::from(vanishes)] += 1;
    }
    assert_eq!(counts[0] + counts[1], 729);
    assert!(counts[1] > 100, "{counts:?}");
}

/// CKS-L2.product: the exponent at (λ, μ) is the sum of those at λ and at μ for all λ and μ iff the cross covariance
/// vanishes.
///
/// Domain: all symmetric 3×3 matrices over {−1, 0, 1}, λ = 1 and all μ over {−1, 0, 1}.
#[test]
fn exponents_add_iff_the_cross_covariance_vanishes() {
    let mut count = 0;
    for p in symmetric(3, &signs()) {
        count += 1;
        let vanishes = p[(0, 1)] == ratio(0, 1) && p[(0, 2)] == ratio(0, 1);
        let joint = law(p);
        let (x, y) = (joint.marginal(&[0]), joint.marginal(&[1, 2]));
        let adds = |lambda: &Q, mu: &Q| {
            let both = joint.characteristic_exponent(&lambda.above(mu));
            let (one, other) = (x.characteristic_exponent(lambda), y.characteristic_exponent(mu));
            assert_eq!(both.linear, one.linear + other.linear);
            both.quadratic == one.quadratic + other.quadratic
        };
        let one = Matrix::identity(1);
        assert_eq!(matrices(2, 1, &signs()).all(|mu| adds(&one, &mu)), vanishes);
    }
    assert_eq!(count, 729);
}

/// The joint law of independent vectors, and the standard law.
#[test]
fn joined_laws_are_block_diagonal() {
    let mut count = 0;
    for p in symmetric(2, &signs()) {
        let (x, w) = (law(p), Gaussian::<Rational>::standard(1));
        let joint = x.joined(&w);
        assert_eq!((joint.marginal(&[0, 1]), joint.marginal(&[2])), (x, w));
        assert!(joint.are_independent(&[0, 1], &[2]));
        assert_eq!(joint.covariance()[(2, 2)], ratio(1, 1));
        count += 1;
    }
    assert_eq!(count, 27);
}
