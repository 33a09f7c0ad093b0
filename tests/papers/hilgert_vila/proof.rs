//! Theorem 1 and every line of its proof.

use exact_kalman::filter::{filter, one_shot_ahead};
use exact_kalman::gaussian::Gaussian;
use exact_kalman::matrix::Matrix;
use exact_kalman::model::{Coefficient, Input, Past};
use exact_kalman::scalar::{Rational, Scalar, ratio};

use super::{At, COVARIANCE, MEAN, Q, at, integers, law, number, predicted, realised, system, varying};

fn data() -> [Q; 3] {
    [integers(&[[1], [2]]), integers(&[[3], [-4]]), integers(&[[0], [6]])]
}

/// The states and the readings as affine functions of the sources (x(1), w(1), …, w(3)): no recursion for any moment.
struct Sources {
    law: Gaussian<Rational>,
    states: Vec<(Q, Q)>,
    readings: Vec<(Q, Q)>,
}

impl Sources {
    fn new() -> Self {
        let law = law(&integers(&MEAN), &integers(&COVARIANCE)).joined(&Gaussian::standard(9));
        let noise = |k: usize| Matrix::from_fn(3, 11, |i, j| ratio(i64::from(j == 2 + 3 * (k - 1) + i), 1));
        let mut state = (Matrix::from_fn(2, 11, |i, j| ratio(i64::from(i == j), 1)), Matrix::zeros(2, 1));
        let (mut states, mut readings) = (Vec::new(), Vec::new());
        for k in 1..=3 {
            let At { a, b_u, d, c, g_v, f } = at(i64::try_from(k).expect("small"));
            states.push(state.clone());
            readings.push((&c * &state.0 + f * noise(k), c * &state.1 + g_v));
            state = (&a * state.0 + d * noise(k), a * state.1 + b_u);
        }
        states.push(state);
        Self { law, states, readings }
    }

    /// The joint law of affine functions given y(1), …, y(known).
    fn given(&self, wanted: &(Q, Q), known: usize) -> Gaussian<Rational> {
        let (mut matrix, mut offset, mut values) = (wanted.0.clone(), wanted.1.clone(), Matrix::zeros(0, 1));
        for ((slope, shift), y) in self.readings.iter().zip(data()).take(known) {
            (matrix, offset, values) = (matrix.above(slope), offset.above(shift), values.above(&y));
        }
        let observed: Vec<usize> = (wanted.0.rows()..matrix.rows()).collect();
        self.law.affine(&matrix, &offset).conditioned(&observed, &values).expect("regular").law
    }
}

/// HV-S.1, HV-S.k, HV-E.x, HV-E.y, HV-P.a, HV-P.b, HV-P.c, HV-P.mean, HV-P.cov, HV-3, HV-4, HV-5, HV-6, HV-7, HV-T1: the lines
/// of the proof, each from the law of the step before, for time-varying coefficients with noise that both equations share.
#[test]
fn every_line_of_the_proof() {
    let trace = predicted(&varying(3, 3), &data(), 3);
    let laws = one_shot_ahead(&realised(&varying(3, 3), &data(), 3)).expect("consistent data");
    let (mut mean, mut p) = (integers(&MEAN), integers(&COVARIANCE));
    for (k, ((step, known), y)) in (1..).zip(trace.steps.iter().zip(&laws).zip(data())) {
        let At { a, b_u, d, c, g_v, f } = at(k);
        assert_eq!((&step.record.predicted.mean, &step.record.predicted.covariance), (&mean, &p));
        // [x(k+1); y(k)] = [[A, D], [C, F]] [x(k); w(k)] + [Bu; Gv], where (x(k), w(k)) is Gaussian given Y(k−1).
        let stacked =
            law(&mean, &p).joined(&Gaussian::standard(3)).affine(&a.beside(&d).above(&c.beside(&f)), &b_u.above(&g_v));
        let (next, reading) = (&a * &mean + &b_u, &c * &mean + &g_v);
        assert_eq!(stacked.mean(), &next.above(&reading));
        assert_eq!((known[1].mean(), &step.record.predicted_observation), (&next, &reading));
        let p_a = a.congruence(&p) + &d * d.transpose();
        let p_b = c.congruence(&p) + &f * f.transpose();
        let p_c = &a * &p * c.transpose() + &d * f.transpose();
        assert_eq!(stacked.covariance(), &p_a.beside(&p_c).above(&p_c.transpose().beside(&p_b)));
        assert_eq!((known[1].covariance(), &step.record.innovation_covariance), (&p_a, &p_b));
        // S is regular here, so its inverse is all that is needed.
        let gain = &p_c * p_b.inverse().expect("regular");
        let innovation = &y - &reading;
        assert_eq!(step.record.innovation, innovation);
        // (3) is the first line of the conditioning, (4) the second, and both forms of (4) in print are one.
        mean = &a * &mean + b_u + &gain * innovation;
        let four = &p_a - &gain * (&c * &p * a.transpose() + &f * d.transpose());
        assert_eq!(four, p_a - &gain * p_c.transpose());
        p = four;
        let given = stacked.conditioned(&[2, 3], &y).expect("data that are possible").law;
        assert_eq!((given.mean(), given.covariance()), (&mean, &p));
        assert_eq!((&step.ahead[0].mean, &step.ahead[0].covariance), (&mean, &p));
        // (6), (7)
        let (mut far, mut spread) = (mean.clone(), p.clone());
        for (i, ahead) in (1..).zip(&step.ahead[1..]) {
            let At { a, b_u, d, .. } = at(k + i);
            (far, spread) = (&a * far + b_u, a.congruence(&spread) + &d * d.transpose());
            assert_eq!((&ahead.mean, &ahead.covariance), (&far, &spread));
        }
        assert_eq!(step.ahead.len(), 3);
    }
}

/// HV-E.w: `E(x(k)wᵀ(k) | Y(k−1)) = 0,  E(w(k)wᵀ(k) | Y(k−1)) = I`, from the joint law of all sources; y(k) itself has seen
/// w(k), and given Y(k) neither holds.
///
/// HV-7: so A P(k|k) Aᵀ + D Dᵀ is not P(k+1|k) where D(k)Fᵀ(k−1) ≠ 0.
#[test]
fn noise_given_the_past() {
    let sources = Sources::new();
    let trace = predicted(&varying(3, 1), &data(), 1);
    for k in 1..=3 {
        let noise = Matrix::from_fn(3, 11, |i, j| ratio(i64::from(j == 2 + 3 * (k - 1) + i), 1));
        let (state, shift) = &sources.states[k - 1];
        let pair = (state.above(&noise), shift.above(&Matrix::zeros(3, 1)));
        let before = sources.given(&pair, k - 1);
        assert!(before.covariance().block(0..2, 2..5).is_zero());
        assert_eq!(before.marginal(&[2, 3, 4]), Gaussian::standard(3));
        let after = sources.given(&pair, k);
        assert!(!after.covariance().block(0..2, 2..5).is_zero());
        assert_ne!(after.marginal(&[2, 3, 4]), Gaussian::standard(3));
        let At { a, d, .. } = at(i64::try_from(k).expect("small"));
        let step = &trace.steps[k - 1];
        let next = sources.given(&sources.states[k], k);
        assert_eq!(&step.ahead[0].covariance, next.covariance());
        assert_ne!(a.congruence(&step.record.filtered.covariance) + &d * d.transpose(), step.ahead[0].covariance);
    }
}

/// HV-7, HV-6: without shared noise filtering and then moving on is predicting.
#[test]
fn without_shared_noise_the_filter_moves_on() {
    let (a, d) = (integers(&[[1, 1], [-1, 2]]), integers(&[[1, 0, 0], [2, 0, 0]]));
    let f = integers(&[[0, 1, 0], [0, 1, 1]]);
    let plain = system(integers(&COVARIANCE), a.clone(), integers(&[[1, 0], [1, 1]]), d.clone(), f);
    for step in predicted(&plain, &data(), 1).steps {
        assert_eq!(step.ahead[0].mean, &a * step.record.filtered.mean);
        assert_eq!(step.ahead[0].covariance, a.congruence(&step.record.filtered.covariance) + &d * d.transpose());
    }
}

/// HV-5 with a singular innovation covariance: on data that the model can produce any S⁻ with S S⁻ S = S gives the x̂ and P of
/// (3) and (4), but not the same K.
#[test]
fn any_generalised_inverse_will_do() {
    // Two sensors that say the same; S = s [[1, 1], [1, 1]].
    let (a, c) = (integers(&[[1, 1], [-1, 2]]), integers(&[[1, 0], [1, 0]]));
    let (d, f) = (integers(&[[1, 0], [1, 1]]), integers(&[[1, 1], [1, 1]]));
    let p = integers(&COVARIANCE);
    let twins = system(p.clone(), a.clone(), c.clone(), d.clone(), f.clone());
    let y = integers(&[[3], [3]]);
    let ahead = &predicted(&twins, std::slice::from_ref(&y), 1).steps[0].ahead[0];
    let s = c.congruence(&p) + &f * f.transpose();
    let weight = ratio(1, 1).over(&s[(0, 0)]).expect("not zero");
    let cross = &a * &p * c.transpose() + &d * f.transpose();
    let inverses = [
        integers(&[[1, 1], [1, 1]]).scaled(&(&weight / ratio(4, 1))),
        integers(&[[1, 0], [0, 0]]).scaled(&weight),
        integers(&[[3, 0], [0, -2]]).scaled(&weight),
    ];
    assert_eq!(s.pseudo_inverse().expect("there is one over the fractions"), inverses[0]);
    for (i, inverse) in inverses.iter().enumerate() {
        assert_eq!(&s * inverse * &s, s);
        let gain = &cross * inverse;
        assert_eq!(ahead.mean, &gain * &y);
        assert_eq!(ahead.covariance, a.congruence(&p) + &d * d.transpose() - &gain * cross.transpose());
        assert_eq!(gain == &cross * &inverses[0], i == 0);
    }
}

/// HV-M.P, HV-M.x: P depends on the readings only through the coefficients.
#[test]
fn covariance_follows_the_readings_through_coefficients_only() {
    let other = [integers(&[[-7], [1]]), integers(&[[0], [0]]), integers(&[[9], [9]])];
    let covariances = |readings: &[Q], adapted: bool| -> Vec<Q> {
        let mut system = varying(3, 2);
        if adapted {
            let rule = |past: Past<'_, Rational>| {
                let y = past.last_entry(0).cloned().unwrap_or_else(|| ratio(1, 1));
                Ok(Matrix::identity(2).scaled(&y))
            };
            system.transition = Coefficient::adapted(rule);
        }
        let steps = predicted(&system, readings, 2).steps;
        steps.into_iter().flat_map(|step| step.ahead).map(|law| law.covariance).collect()
    };
    assert_eq!(covariances(&data(), false), covariances(&other, false));
    assert_ne!(covariances(&data(), true), covariances(&other, true));
}

/// HV-2: `x̂(k+d|k) = E(x̂(k+d|k+d−1) | Y(k)), d ≥ 2`, with d = 3: x̂(4|3) is an affine function of y(2) and y(3), whose slopes are
/// found by moving them; their joint law given y(1) comes from the sources. The variances add up in the same way.
#[test]
fn readings_between_are_integrated_out() {
    let sources = Sources::new();
    let last = |readings: &[Q]| predicted(&varying(3, 1), readings, 1).steps[2].ahead[0].clone();
    let readings = data();
    let base = last(&readings);
    let mut slope = Matrix::zeros(2, 4);
    for column in 0..4 {
        let mut moved = readings.clone();
        let (reading, sensor) = (1 + column / 2, column % 2);
        moved[reading][(sensor, 0)] += ratio(1, 1);
        let difference = &last(&moved).mean - &base.mean;
        (slope[(0, column)], slope[(1, column)]) = (difference[(0, 0)].clone(), difference[(1, 0)].clone());
        // Affine: twice as far is twice the difference.
        moved[reading][(sensor, 0)] += ratio(1, 1);
        assert_eq!(&last(&moved).mean - &base.mean, difference.scaled(&ratio(2, 1)));
    }
    let future = |i: usize| sources.readings[i].clone();
    let (two, three) = (future(1), future(2));
    let between = sources.given(&(two.0.above(&three.0), two.1.above(&three.1)), 1);
    let shift = &base.mean - &slope * readings[1].above(&readings[2]);
    let integrated = between.affine(&slope, &shift);
    let far = &predicted(&varying(3, 3), &readings, 3).steps[0].ahead[2];
    assert_eq!(&far.mean, integrated.mean());
    assert_eq!(far.covariance, integrated.covariance() + &base.covariance);
}

/// HV-2 comes after HV-T1: u(2) = 1/y(1) is finite almost surely, and x(3) given y(1) is Gaussian; but x(3) has no mean. Since the
/// density of N(0, 1) exceeds 6/25 on [−1, 1] (e^½ < 1.65, √(2π) < 2.51), E(1/|y|; |y| > 2⁻ⁿ) is more than 6n/25.
#[test]
fn a_state_without_a_mean_has_a_conditional_one() {
    let one: Q = Matrix::identity(1);
    let mut system = system(Matrix::zeros(1, 1), one.clone(), one.clone(), Matrix::zeros(1, 1), one);
    let reciprocal = |past: Past<'_, Rational>| match past.entry(0, 0) {
        Some(y) => Ok(number(ratio(1, 1).over(y)?)),
        None => Ok(Matrix::zeros(1, 1)),
    };
    system.input = Some(Input { matrix: None, vector: Coefficient::adapted(reciprocal) });
    for n in 1..20 {
        // y = 2^−n, and the law of x(3): exactly 2ⁿ.
        let ahead = &predicted(&system, &[number(ratio(1, 1 << n))], 2).steps[0].ahead[1];
        assert_eq!((ahead.mean[(0, 0)].clone(), ahead.covariance.is_zero()), (ratio(1 << n, 1), true));
        // Between 2^−n and 2^(1−n) the integrand is at least 2^(n−1), on both sides of zero a length of 2^−n.
        let least = (1..=n).map(|j| ratio(6, 25) * ratio(1 << (j - 1), 1) * ratio(2, 1) * ratio(1, 1 << j));
        assert_eq!(least.fold(ratio(0, 1), |sum, part| sum + part), ratio(6 * n, 25));
    }
    // 1.65² > e and 2.51² > 2π, from e < 2.7183 and π < 3.1416, so the density at 1 is more than 1/(1.65 · 2.51) > 6/25.
    assert!(ratio(165, 100).pow(2) > ratio(27183, 10000) && ratio(251, 100).pow(2) > ratio(62832, 10000));
    assert!(ratio(6, 25) * ratio(165, 100) * ratio(251, 100) < ratio(1, 1));
}

/// HV-T1: the induction starts at k = 0. With all scalars 1, x(1) ~ N(0, 1) given y(0), the text under its first
/// case stacks (x(2), y(1)) with the variance 2 of x(2): right for what is given at k = 0, Y(0); at k = 1, as printed, y(1) is
/// known, and that variance is 0.
#[test]
fn the_induction_starts_at_zero() {
    let one: Q = Matrix::identity(1);
    let ones = system(one.clone(), one.clone(), one.clone(), one.clone(), one.clone());
    let stacked =
        Gaussian::standard(1).joined(&Gaussian::standard(1)).affine(&integers(&[[1, 1], [1, 1]]), &Matrix::zeros(2, 1));
    let in_the_text = stacked.covariance().block(0..1, 0..1);
    let trace = predicted(&ones, &[one], 2);
    let (right, printed) = (&trace.start[1].covariance, &trace.steps[0].ahead[0].covariance);
    assert_eq!((&in_the_text, right), (&integers(&[[2]]), &in_the_text));
    assert_eq!(printed, &integers(&[[0]]));
    assert_ne!(printed, &in_the_text);
}

/// Erratum HV-S.w: the exponent of (x(1), w(1)) given y(0) has −½ μᵀμ, a number; the printed μμᵀ is a matrix unless w(1)
/// is a number.
///
/// HV-S.w: `E[exp(iλᵀx(1) + iμᵀw(1)) | y(0)] = exp(iλᵀx̂(1|0) − ½ λᵀP(1|0)λ − ½ μᵀμ)`
#[test]
fn state_and_noise_are_jointly_gaussian() {
    let (lambda, mu) = (integers(&[[3], [5]]), integers(&[[1], [-2]]));
    let (mean, p) = (integers(&MEAN), integers(&COVARIANCE));
    let joint = law(&mean, &p).joined(&Gaussian::standard(2));
    let exponent = joint.characteristic_exponent(&lambda.above(&mu));
    let form = |v: &Q, m: &Q| v.transpose().congruence(m)[(0, 0)].clone();
    let (right, printed) = (mu.transpose() * &mu, &mu * mu.transpose());
    assert_eq!(exponent.linear, (lambda.transpose() * &mean)[(0, 0)].clone());
    assert_eq!(number(&exponent.quadratic - form(&lambda, &p)), right);
    assert_eq!((right.rows(), right.columns()), (1, 1));
    assert_ne!((printed.rows(), printed.columns()), (1, 1));
    // The filter starts from this law: its first step is that of the stacked vector.
    let step = &predicted(&varying(1, 1), &data()[..1], 1).steps[0];
    assert_eq!((&step.record.predicted.mean, &step.record.predicted.covariance), (&mean, &p));
}

/// Erratum HV-P.b: the second factor is (C(x − x̂) + F w)ᵀ as a whole. With F wᵀ in it two sensors give a product of two columns,
/// which there is none of, and for q ≠ 1 sources F wᵀ is none either; the right form, over the signs of three sources, has the
/// expectation that follows in print.
#[test]
fn the_whole_factor_is_transposed() {
    let (c, f) = (integers(&[[1], [2]]), integers(&[[1, 1], [0, 3]]));
    let mut sum = Matrix::zeros(2, 2);
    for bits in 0..8_i64 {
        let sign = |i: i64| 1 - 2 * (bits >> i & 1);
        // x − x̂ with P = 4, and w.
        let (error, w) = (integers(&[[2 * sign(0)]]), integers(&[[sign(1)], [sign(2)]]));
        let factor = &c * error + &f * &w;
        sum = sum + &factor * factor.transpose();
        // As printed: the second factor would be a column again, if F wᵀ were defined.
        assert_ne!(f.columns(), w.transpose().rows(), "F wᵀ");
        assert_ne!(factor.columns(), factor.rows(), "a column times a column");
    }
    let p_b = c.congruence(&integers(&[[4]])) + &f * f.transpose();
    assert_eq!(sum.scaled(&ratio(1, 8)), p_b);
    let system = system(integers(&[[4]]), Matrix::identity(1), c, Matrix::zeros(1, 2), f);
    let path = realised(&system, &[integers(&[[0], [0]])], 1);
    assert_eq!(filter(path.path()).expect("consistent data").records[0].innovation_covariance, p_b);
}
