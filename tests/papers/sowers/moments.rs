//! Lemmas 1 and 2 by polynomial moments, for laws F of finitely many atoms: fractions on both sides.

use exact_kalman::gaussian::{Gaussian, Polynomial};
use exact_kalman::matrix::Matrix;
use exact_kalman::nongaussian::as_printed::statistics_with_printed_error;
use exact_kalman::scalar::{Rational, ratio};

use super::Q;
use super::measure::Changed;
use super::world::{Dice, Noises, stacked};

const BOTH: &[Noises] = &[Noises::Correlated, Noises::Standard];

/// A law with a singular covariance, if need be.
fn law(mean: Q, covariance: Q) -> Gaussian<Rational> {
    Gaussian::new(mean, covariance).expect("symmetric")
}

/// Some terms of degree at most three, and the square of one of degree two where there are few variables.
fn polynomials(variables: usize, dice: &mut Dice) -> Vec<Polynomial<Rational>> {
    let mut product = |degree: usize| {
        let factors = (0..degree).map(|_| usize::try_from(dice.below(variables as u64)).expect("small"));
        factors
            .fold(Polynomial::constant(variables, ratio(1, 1)), |all, i| all.times(&Polynomial::variable(variables, i)))
    };
    let mixed = product(3).plus(&product(2).scaled(&ratio(2, 1))).plus(&product(1).scaled(&ratio(-3, 2)));
    let mut all = vec![Polynomial::constant(variables, ratio(1, 1)), product(2), mixed];
    if variables < 5 {
        let root = product(2).plus(&product(1));
        all.push(root.times(&root));
    }
    all
}

/// SM-L2, SM-4.16: X is a polynomial in (ξ, Y(0), …, Y(t)), F has three atoms, so both sides are fractions. Under ℙ and given ξ = z the
/// readings are Gaussian about a multiple of z, with coefficients from (1.1); under ℙ̄ they are centred and free of ξ, and the weight
/// exp(zᵀB̄ − ½ zᵀR*z), with the B̄ and R* of the code, moves their mean by cov(Y)Bᵀz, B̄ = BY, and multiplies by
/// exp(½ zᵀ(B cov(Y)Bᵀ − R*)z), which is 1. With (2.4) as printed that factor is another one, already for X = 1.
#[test]
fn both_expectations_of_polynomials() {
    let mut told = 0;
    for mut changed in Changed::all(BOTH) {
        let n = changed.world.n;
        let atoms = [(1, 2), (1, 3), (1, 6)].map(|(p, q)| (ratio(p, q), changed.dice.matrix(n, 1)));
        let data: Vec<Q> = changed.world.steps.iter().map(|_| changed.dice.matrix(changed.world.k, 1)).collect();
        let printed = statistics_with_printed_error(&changed.world.path(&data)).expect("noisy");
        let world = &changed.world;
        for (t, linear) in world.linear_statistics().iter().enumerate() {
            let readings = stacked(&world.readings()[..=t]);
            let old = readings.block(0..readings.rows(), world.sources());
            let of_z = readings.block(0..readings.rows(), 1..1 + n);
            let new = changed.past(t);
            let covariance = &new * new.transpose();
            let (_, map) = changed.means(linear, t);
            let (precision, as_printed) = (linear.now.precision(), printed[t + 1].precision());
            let still = Matrix::zeros(n, n);
            for polynomial in polynomials(n + readings.rows(), &mut changed.dice) {
                let expectation = |mean: &Q, z: &Q, covariance: &Q| {
                    law(z.above(mean), still.block_diagonal(covariance)).expectation(&polynomial).expect("semidefinite")
                };
                let (mut left, mut right) = (ratio(0, 1), ratio(0, 1));
                for (weight, z) in &atoms {
                    left += weight * expectation(&(&of_z * z), z, &(&old * old.transpose()));
                    let tilt = map.transpose() * z;
                    right += weight * expectation(&(&covariance * &tilt), z, &covariance);
                    let gained = tilt.transpose().congruence(&covariance);
                    let log_factor = |r: &Q| (&gained - z.transpose().congruence(r))[(0, 0)].clone();
                    assert_eq!(log_factor(&precision), ratio(0, 1));
                    assert_eq!(
                        log_factor(&as_printed) != ratio(0, 1),
                        precision != as_printed && {
                            !(z.transpose().congruence(&(&precision - &as_printed))).is_zero()
                        }
                    );
                    told += usize::from(log_factor(&as_printed) != ratio(0, 1));
                }
                assert_eq!(left, right);
            }
        }
    }
    assert!(told > 50, "(2.4) as printed would do");
}

/// SM-L1, SM-G: the moments of B̄ under ℙ̄ are those of G with Λ = R*, a normal law that may be degenerate; it is so always at n > k after one
/// reading, and for H = 0 it is the unit mass at 0. Under ℙ and given ξ = z they are those of N(R*z, R*).
#[test]
fn moments_of_the_statistic() {
    let mut degenerate = [0; 2];
    for mut changed in Changed::all(BOTH) {
        for blind in [false, true] {
            if blind {
                let (mut world, dice) = (changed.world, changed.dice);
                world.steps.iter_mut().for_each(|at| at.h = Matrix::zeros(at.h.rows(), at.h.columns()));
                changed = Changed::of((world, dice));
            }
            let n = changed.world.n;
            let z = changed.dice.matrix(n, 1);
            for (t, linear) in changed.world.linear_statistics().iter().enumerate() {
                let precision = linear.now.precision();
                let g = linear.now.law_of_linear();
                let (_, map) = changed.means(linear, t);
                let new = &map * changed.past(t);
                let sources = new.block(0..n, changed.world.sources());
                let source_law = Gaussian::standard(sources.columns()).affine(&sources, &Matrix::zeros(n, 1));
                assert!(new.block(0..n, 0..changed.world.sources().start).is_zero());
                let readings = stacked(&changed.world.readings()[..=t]);
                let old = &map * readings;
                let under_old = Gaussian::standard(sources.columns())
                    .affine(&old.block(0..n, changed.world.sources()), &(old.block(0..n, 1..1 + n) * &z));
                let about = law(&precision * &z, precision.clone());
                for polynomial in polynomials(n, &mut changed.dice) {
                    let of = |law: &Gaussian<Rational>| law.expectation(&polynomial).expect("semidefinite");
                    assert_eq!(of(&source_law), of(&g));
                    assert_eq!(of(&under_old), of(&about));
                }
                if blind {
                    assert_eq!(g, law(Matrix::zeros(n, 1), Matrix::zeros(n, n)));
                }
                degenerate[usize::from(blind)] += usize::from(precision.rank() < n);
            }
        }
    }
    assert!(degenerate.iter().all(|&count| count > 10), "{degenerate:?}");
}
