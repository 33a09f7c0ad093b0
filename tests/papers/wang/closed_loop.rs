//! Products of the closed loop, and the gain.

use exact_kalman::matrix::Matrix;
use exact_kalman::scalar::{Rational, ratio};
use exact_kalman::stability::{
    Bracket, ClosedLoopBound, ClosedLoopError, Factor, GainError, Mode, RiccatiStep, riccati_path,
};

use super::draws::{mode, sizes};
use super::paths::trace;
use super::sources::Sources;
use super::{Q, integer_mode, scalar, scalar_mode};
use crate::dice::Dice;

fn width() -> Rational {
    ratio(1, 1 << 20)
}

/// Whether ‖X‖² ≤ bound.
fn is_bounded(matrix: &Q, bound: &Rational) -> bool {
    (matrix * matrix.transpose()).loewner_le(&Matrix::identity(matrix.rows()).scaled(bound)).is_ok()
}

/// WG-55: brackets of eigenvalues and norms, against the test of Schur, Cohn and Jury on the characteristic polynomial.
#[test]
fn brackets_hold_the_largest_eigenvalue() {
    let (mut dice, mut met) = (Dice(71), 0);
    for _ in 0..150 {
        let d = 1 + dice.size(2);
        let (a, b) = (dice.semidefinite(d), dice.positive_definite(d));
        let found = Bracket::largest_eigenvalue(&a, &b, &width()).expect("B > 0");
        let quotient = b.solve(&a).expect("B > 0");
        let above = &found.upper + ratio(1, 1 << 30);
        assert!(quotient.spectral_radius_lt(&above) && !quotient.spectral_radius_lt(&found.lower));
        assert!(&found.upper - &found.lower <= width() * found.lower.clone().max(ratio(1, 1)));
        met += usize::from(found.lower == found.upper);
        let x = dice.matrix(d, 2);
        let (norm, square) = (Bracket::norm(&x, &width()), x.transpose() * &x);
        let upper = &norm.upper * &norm.upper + ratio(1, 1 << 30);
        assert!(square.spectral_radius_lt(&upper) && !square.spectral_radius_lt(&(&norm.lower * &norm.lower)));
    }
    assert!(met > 20, "{met}");
    let singular = Bracket::largest_eigenvalue(&Matrix::identity(2), &Matrix::<Rational>::zeros(2, 2), &width());
    assert!(singular.is_err());
}

/// WG-L2.2, WG-55: the printed bound and the sharper one with λ_max for every factor, their right sides taken from below; the same as a chain of
/// Loewner orders, XP(m)Xᵀ ≤ ∏(1 − 1/t)P(n) for P(k+1) ≤ tQ̄(k). For d = 1 the sharp bound is equality, and print is not.
#[test]
fn products_of_the_closed_loop() {
    let (mut dice, mut smaller) = (Dice(72), 0);
    for _ in 0..30 {
        let Sources { path, initial_mean, .. } = Sources::random(&mut dice, 4);
        let d = initial_mean.rows();
        let initial = dice.positive_definite(d);
        let steps = riccati_path(&path, &initial);
        for n in 1..=4 {
            let of = |factor| ClosedLoopBound::new(&steps[..n], &initial, factor, &width()).expect("Q > 0");
            let (printed, sharp) = (of(Factor::Printed), of(Factor::Sharp));
            let product = steps[..n].iter().fold(Matrix::identity(d), |product, step| &step.closed_loop * product);
            assert_eq!((&printed.product, &sharp.product), (&product, &product));
            assert!(is_bounded(&product, &printed.lower()));
            assert!(is_bounded(&product, &sharp.lower()));
            assert!(sharp.lower() <= sharp.upper() && sharp.lower() <= printed.upper());
            smaller += usize::from(sharp.upper() < printed.lower());
            let decay: Rational = sharp.factors.iter().map(|factor| factor.upper.clone()).product();
            product.congruence(&initial).loewner_le(&steps[n - 1].next.scaled(&decay)).expect("step by step");
            for (step, factor) in steps[..n].iter().zip(&sharp.factors) {
                let t = ratio(1, 1) / (ratio(1, 1) - &factor.upper);
                step.next.loewner_le(&step.noise.scaled(&t)).expect("the upper end");
            }
            if d == 1 {
                let factor = |step: &RiccatiStep<Rational>| {
                    let t = &step.next[(0, 0)] / &step.noise[(0, 0)];
                    &t / (ratio(1, 1) + &t)
                };
                let right =
                    steps[..n].iter().map(factor).product::<Rational>() * &steps[n - 1].next[(0, 0)] / &initial[(0, 0)];
                assert_eq!((printed.lower(), printed.upper()), (right.clone(), right));
                assert_eq!((sharp.lower(), sharp.upper()), (product.squared_norm(), product.squared_norm()));
            }
        }
    }
    assert!(smaller > 60, "{smaller}");
}

/// WG-L2.2: with a singular Q̄ or P(m) the bound has no meaning: F = 1, H = 0, Q = 0 has left side 1 for ever.
#[test]
fn products_without_noise_do_not_decay() {
    let path = vec![integer_mode([1, 0, 0, 1]); 5];
    let one = scalar(ratio(1, 1));
    let steps = riccati_path(&path, &one);
    let product = steps.iter().fold(one.clone(), |product, step| &step.closed_loop * product);
    assert_eq!(product, one);
    for factor in [Factor::Printed, Factor::Sharp] {
        let found = ClosedLoopBound::new(&steps, &one, factor, &width());
        assert!(matches!(found, Err(ClosedLoopError::Noise { step: 0, .. })));
        let found = ClosedLoopBound::new(&steps, &scalar(ratio(0, 1)), factor, &width());
        assert!(matches!(found, Err(ClosedLoopError::Start(_))));
    }
}

/// P and a fraction that is its norm: a rational rotation of a diagonal.
fn of_known_norm(dice: &mut Dice) -> (Q, Rational) {
    let rotation =
        Matrix::from_rows(vec![vec![ratio(3, 5), ratio(4, 5)], vec![ratio(-4, 5), ratio(3, 5)]]).expect("square");
    let entry = |dice: &mut Dice| ratio(i64::try_from(dice.below(5)).expect("small"), 2);
    let entries = [entry(dice), entry(dice)];
    let norm = entries.iter().max().expect("two").clone();
    (rotation.congruence(&Matrix::diagonal(&entries)), norm)
}

/// WG-gain: the chain at covariances whose norm is a fraction, member by member, and the sharp 1/(4a) in one stroke; as a Loewner order,
/// S⁻¹HPHᵀS⁻¹ ≤ I/(4a). For the next covariance aFL(FL)ᵀ ≤ Q̄ ≤ P₊, so that ‖FL‖² ≤ ‖P₊‖/a.
#[test]
fn the_gain_is_bounded() {
    let mut dice = Dice(73);
    for _ in 0..60 {
        let (_, m) = sizes(&mut dice);
        let drawn = mode(&mut dice, 2, m);
        let (p, norm) = of_known_norm(&mut dice);
        // The ridge of the noise, as it is drawn.
        let floor = Bracket::largest_eigenvalue(&Matrix::identity(m), drawn.observation_noise(), &width());
        let floor = ratio(1, 1) / floor.expect("R > 0").upper;
        let bounds = drawn.gain_bounds(&p, &floor).expect("R ≥ aI");
        let step = drawn.step(&p);
        let chain = [&bounds.innovation, &bounds.precision, &bounds.noise_precision, &bounds.floor];
        assert!(chain.windows(2).all(|pair| pair[0] <= pair[1]));
        assert!(chain.iter().all(|c| is_bounded(&step.gain, &(&norm * *c))));
        assert!(is_bounded(&step.gain, &(&norm * &bounds.sharp)));
        let innovation = drawn.observation().congruence(&p) + drawn.observation_noise();
        let (s, seen) = (innovation.inverse().expect("R > 0"), drawn.observation().congruence(&p));
        let inverse = drawn.observation_noise().inverse().expect("R > 0");
        let sensors = Rational::from_integer(m.into());
        let written = [trace(&(&seen * &s * &s)), trace(&s), trace(&inverse), sensors / &floor];
        assert_eq!(chain.map(Clone::clone), written);
        s.congruence(&seen).loewner_le(&Matrix::identity(m).scaled(&bounds.sharp)).expect("x − ax² ≤ 1/(4a)");
        let transported = drawn.transition() * &step.gain;
        (&transported * transported.transpose()).scaled(&floor).loewner_le(&step.noise).expect("R ≥ aI");
        step.noise.loewner_le(&step.next).expect("the rest is a covariance");
        let next = Bracket::largest_eigenvalue(&step.next, &Matrix::identity(2), &width()).expect("regular");
        assert_eq!(bounds.transported, ratio(1, 1) / &floor);
        assert!(is_bounded(&transported, &(next.upper * &bounds.transported)));
        let above = drawn.gain_bounds(&p, &(floor + ratio(1, 1)));
        assert!(matches!(above, Err(GainError::BelowFloor(_))));
        assert_eq!(drawn.gain_bounds(&p, &ratio(0, 1)), Err(GainError::Floor));
    }
}

/// WG-gain: for d = m = 1 and a ≤ r the sharp bound is met exactly if h²p = r = a, and ‖FL‖² ≤ ‖P₊‖/a never for Q > 0.
#[test]
fn the_sharp_gain_is_met() {
    let values = [ratio(1, 4), ratio(1, 1), ratio(3, 1), ratio(4, 1)];
    let mut met = 0;
    for h in [1, 2, -2] {
        for p in &values {
            for r in &values {
                for a in values.iter().filter(|a| *a <= r) {
                    let mode = scalar_mode([ratio(2, 1), ratio(h, 1), ratio(1, 1), r.clone()]);
                    let bounds = mode.gain_bounds(&scalar(p.clone()), a).expect("a ≤ r");
                    let step = mode.step(&scalar(p.clone()));
                    let (square, sharp) = (step.gain.squared_norm(), bounds.sharp * p);
                    let is_met = &(ratio(h * h, 1) * p) == r && r == a;
                    assert_eq!(square == sharp, is_met);
                    assert!(square <= sharp);
                    assert!((mode.transition() * &step.gain).squared_norm() < bounds.transported * &step.next[(0, 0)]);
                    met += usize::from(is_met);
                }
            }
        }
    }
    assert!(met > 5, "{met}");
}

/// WG-T3.1: the closed loop without observations, H = 0 and F = 1: every product is 1, and the mean square of the error is P(0) + k.
#[test]
fn without_observations_errors_grow() {
    let one = scalar(ratio(1, 1));
    let steps = riccati_path(&vec![Mode::clone(&integer_mode([1, 0, 1, 1])); 20], &one);
    assert!(steps.iter().all(|step| step.closed_loop == one));
    assert_eq!(steps[19].next, scalar(ratio(21, 1)));
}
