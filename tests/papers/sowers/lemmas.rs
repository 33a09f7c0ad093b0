//! Section IV: the lemmas, and the lines of the proofs of Theorems 2 and 3 that hold for every F.

use exact_kalman::matrix::Matrix;
use exact_kalman::nongaussian::as_printed::statistics_with_printed_error;
use exact_kalman::nongaussian::{InitialLaw, statistics};
use exact_kalman::scalar::ratio;

use super::measure::Changed;
use super::world::{Noises, World, form, half, integrated, product, stacked};
use super::{Q, number, scalar};

const BOTH: &[Noises] = &[Noises::Correlated, Noises::Standard];

/// SM-L1, SM-4.9, SM-4.10, SM-4.12, SM-4.13, SM-B-moments, SM-4.14, SM-4.15: in the sources of the new measure B and B̄ are linear, so their means
/// are 0; their second moments are M and R*, and that of the difference is R. Under ℙ and given ξ = z the mean of B̄ is R*z.
#[test]
fn moments_of_b() {
    for changed in Changed::all(BOTH) {
        let world = &changed.world;
        let mut last = Matrix::zeros(world.n, world.n);
        for (t, linear) in world.linear_statistics().iter().enumerate() {
            let b = changed.anew(&changed.b[t + 1]);
            let (_, map) = changed.means(linear, t);
            let readings = stacked(&world.readings()[..=t]);
            let mean = changed.anew(&(&map * &readings));
            let until = 0..world.sources().start;
            assert!(b.block(0..world.n, until.clone()).is_zero() && mean.block(0..world.n, until).is_zero());
            let second = |rows: &Q| rows * rows.transpose();
            let (of_b, of_mean, of_error) = (second(&b), second(&mean), second(&(&b - &mean)));
            assert_eq!(of_b, &of_mean + &of_error);
            // (4.13), from B(t) and V(t+1) as independent parts
            let at = &world.steps[t];
            let step = form(&(&at.h * &world.psi()[t]), &at.v_inverse());
            assert_eq!(of_b, last + step);
            assert_eq!((&of_b, &of_error), (&linear.now.information, &linear.now.error));
            assert_eq!(of_mean, linear.now.precision());
            last = of_b;
            // Under ℙ: the slope in z.
            let old = &map * readings;
            assert_eq!(old.block(0..world.n, 1..1 + world.n), linear.now.precision());
        }
    }
}

/// SM-L2, SM-4.16, SM-4.17, SM-4.18, SM-4.19: for X = exp(aᵀY) and given ξ = z, as functions of (z, a): all members are equal. These X determine
/// every X, so the lemma holds. With (2.4) as printed it fails wherever R* is another matrix.
#[test]
fn expectations_under_both_measures() {
    let mut told = 0;
    for mut changed in Changed::all(BOTH) {
        let a = changed.dice.matrix(changed.world.k * changed.world.steps.len(), changed.world.n);
        let world = &changed.world;
        let data = vec![Matrix::zeros(world.k, 1); world.steps.len()];
        let printed = statistics_with_printed_error(&world.path(&data)).expect("noisy");
        for (t, linear) in world.linear_statistics().iter().enumerate() {
            let readings = stacked(&world.readings()[..=t]);
            let rows = 0..readings.rows();
            let weight = a.block(rows, 0..world.n) * world.eta();
            let x = product(&weight, &readings);
            let (_, map) = changed.means(linear, t);
            let (z, b, b_mean) = (world.z(), &changed.b[t + 1], &map * &readings);
            let mean = |exponent: &Q| integrated(exponent, world.sources()).expect("finite");
            let new = |exponent: Q| mean(&changed.exponent_anew(&exponent));
            let old = mean(&x);
            assert_eq!(old.1, ratio(1, 1));
            // (4.17)
            assert_eq!(new(&x + product(&z, b) - half(&form(&z, &linear.now.information))), old);
            // (4.16)
            assert_eq!(new(&x + product(&z, &b_mean) - half(&form(&z, &linear.now.precision()))), old);
            let printed = printed[t + 1].precision();
            let by_printed = new(&x + product(&z, &b_mean) - half(&form(&z, &printed)));
            assert_eq!(by_printed == old, printed == linear.now.precision());
            told += usize::from(by_printed != old);
            // (4.18), (4.19): the error of B is independent of the readings.
            let error = product(&z, &(b - &b_mean));
            assert_eq!(new(error).0, half(&form(&z, &linear.now.error)));
        }
    }
    assert!(told > 20, "(2.4) as printed would do");
}

/// SM-4.24, SM-4.24-shifted, SM-4.20: E exp(ηᵀ(u + X_Σ) + vᵀB_Σ) by completing squares in sources whose covariance is the Σ of
/// the code, as an identity of entire functions of η: at η = iθ the terms in η change to iθ, those in ηηᵀ to −θθᵀ.
///
/// Erratum SM-4.24-shifted: at the point u = x + Ψξ, v = ξ the slope in ξ is Q + Ψ = Q*. Printed −(Q − Ψ): for A = H = Σʷ = Σᵛ = 1,
/// Σʷᵛ = 0 and t + 1 = 2 the slope is 1/2, printed 3/2; at t + 1 = 1 both are 1.
#[test]
fn the_functional_of_the_test_function() {
    for changed in Changed::all(BOTH) {
        let world = &changed.world;
        for (t, linear) in world.linear_statistics().iter().enumerate() {
            // The errors of X and B are a pair with covariance Σ (checked elsewhere), linear in the new sources.
            let (mean, b_mean) = changed.means(linear, t);
            let readings = stacked(&world.readings()[..=t]);
            let errors = changed.errors(t, &mean, &b_mean, &readings);
            let (x, b) =
                (errors.block(0..world.n, 0..world.size()), errors.block(world.n..2 * world.n, 0..world.size()));
            let (z, eta) = (world.z(), world.eta());
            let direct = product(&eta, &(&world.psi()[t + 1] * &z + x)) + product(&z, &b);
            let (found, determinant) = integrated(&direct, world.sources()).expect("finite");
            let now = &linear.now;
            let right = half(&form(&eta, &now.covariance))
                + product(&eta, &(now.response() * &z))
                + half(&form(&z, &now.error));
            assert_eq!((found, determinant), (right, ratio(1, 1)));
        }
    }
    let slopes: Vec<_> = statistics(&scalar([1, 1, 1, 0, 1], &[0, 0])).expect("noisy")[1..]
        .iter()
        .map(|now| {
            let (q, psi) = (now.cross[(0, 0)].clone(), now.transition[(0, 0)].clone());
            (&q + &psi, &psi - &q)
        })
        .collect();
    assert_eq!(slopes, [(ratio(1, 1), ratio(1, 1)), (ratio(1, 2), ratio(3, 2))]);
}

/// SM-T2, SM-A4, SM-T2-remark-ii, SM-4.28, SM-4.29, SM-Gaussian: for Δ > 0 the formulas with Δ⁻¹ as they are printed are those without, and
/// integrals over N(μ, Δ) are what the sources of ξ give: log ∫ exp(zᵀb − ½zᵀR*z) dG and its gradient in b.
#[test]
fn gaussian_integrals() {
    for mut changed in Changed::all(BOTH) {
        let n = changed.world.n;
        let data: Vec<Q> = changed.world.steps.iter().map(|_| changed.dice.matrix(changed.world.k, 1)).collect();
        let factor = Matrix::from_fn(n, n, |i, j| ratio(i64::from(i == j) * 2 + i64::from(i > j), 1));
        let (mu, delta) = (changed.dice.matrix(n, 1), &factor * factor.transpose());
        let delta_inverse = delta.inverse().expect("regular");
        let gaussian = exact_kalman::gaussian::Gaussian::new(mu.clone(), delta.clone()).expect("symmetric");
        let law = InitialLaw::gaussian(gaussian).expect("a law");
        for now in &changed.world.statistics(&data)[1..] {
            let (r, b) = (now.precision(), &now.linear);
            let inner = (&r + &delta_inverse).inverse().expect("regular") * (b + &delta_inverse * &mu);
            assert_eq!(now.linear(&law).estimate, &now.mean + now.response() * &inner);
            // z = μ + Lg, variables (1, b, g): log ∫ = log E exp(zᵀb − ½ zᵀR*z)
            let size = 1 + 2 * n;
            let select = |from: usize| Matrix::from_fn(n, size, |i, j| ratio(i64::from(from + i == j), 1));
            let constant = Matrix::from_fn(n, size, |i, j| if j == 0 { mu[(i, 0)].clone() } else { ratio(0, 1) });
            let z = constant + &factor * select(1 + n);
            let exponent = product(&z, &select(1)) - half(&form(&z, &r));
            let (log, determinant) = integrated(&exponent, 1 + n..size).expect("finite");
            let u = Matrix::identity(1).above(b).above(&Matrix::zeros(n, 1));
            let value = form(&u, &log)[(0, 0)].clone();
            let component = &now.posterior(&law).components[0];
            assert_eq!((&component.evidence.exponent, &component.evidence.determinant), (&value, &determinant));
            let shifted = b + &delta_inverse * &mu;
            let printed = (form(&shifted, &(&r + &delta_inverse).inverse().expect("regular"))
                - form(&mu, &delta_inverse))[(0, 0)]
                .clone();
            assert_eq!(printed * ratio(1, 2), value);
            assert_eq!((&delta * &r + Matrix::identity(n)).determinant(), Ok(determinant));
            // (4.28) over (4.29): the gradient of the logarithm.
            let gradient = (log * u).scaled(&ratio(2, 1)).block(1..1 + n, 0..1);
            assert_eq!((&gradient, component.initial.mean()), (&inner, &inner));
        }
    }
}

/// SM-T2-remark-iii, SM-4.6, SM-4.7, SM-4.8, SM-4.5: the recursions close, run by themselves.
///
/// Erratum SM-T2-remark-iii: they come from (1.7), the recursion of Ψ: A = H = 1, Σʷᵛ = Σʷ = 1, Σᵛ = 2: Q*(1) = 1/2 = Q(1) + Ψ(1,0), and
/// with Φ(1,0) of (1.6) for Ψ it would be 1.
///
/// Erratum SM-4.5: M(1) = ΨᵀHᵀΣᵛ⁻¹HΨ; the inverse of Σ(1), as printed, has the size 2n where k is needed, and does not exist.
#[test]
fn closed_recursions() {
    for (world, mut dice) in World::all(BOTH) {
        let data: Vec<Q> = world.steps.iter().map(|_| dice.matrix(world.k, 1)).collect();
        let all = world.statistics(&data);
        let n = world.n;
        let (mut q, mut r, mut b) = (Matrix::identity(n), Matrix::zeros(n, n), Matrix::zeros(n, 1));
        for (t, at) in world.steps.iter().enumerate() {
            assert_eq!((&all[t].response(), &all[t].precision(), &all[t].linear), (&q, &r, &b));
            let p = &all[t].covariance;
            let j = at.h.congruence(p) + at.v();
            let gain = (&at.a * p * at.h.transpose() + at.wv()) * j.inverse().expect("regular");
            let seen = (&at.h * &q).transpose() * j.inverse().expect("regular");
            (q, r, b) = (
                (&at.a - gain * &at.h) * &q,
                r + &seen * &at.h * &q,
                &b - &seen * &at.h * &all[t].mean + &seen * &data[t],
            );
        }
    }
    let after = &statistics(&scalar([1, 1, 1, 1, 2], &[0])).expect("noisy")[1];
    assert_eq!(after.response(), number(ratio(1, 2)));
    assert_ne!(&after.cross + number(ratio(1, 1)), number(ratio(1, 2)));
    let world =
        (1..100).map(|seed| World::random(seed, Noises::Correlated)).find(|w| (w.n, w.k) == (2, 1)).expect("some");
    let at = &world.steps[0];
    let after = &world.statistics(&vec![Matrix::zeros(1, 1); world.steps.len()])[1];
    assert_eq!(after.information, form(&at.h, &at.v_inverse()));
    let printed = after.joint_covariance();
    assert!(printed.rows() != at.h.rows() && printed.inverse().is_err());
}
