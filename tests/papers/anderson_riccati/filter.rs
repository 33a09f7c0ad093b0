//! The filter (1.3)–(1.4), by three filters and the joint law, with singular V, W and P(0).

use exact_kalman::filter::{filter, one_shot};
use exact_kalman::gaussian::Gaussian;
use exact_kalman::matrix::Matrix;
use exact_kalman::model::{Noise, Observation, System};
use exact_kalman::riccati::{RiccatiError, RiccatiMap, Role};
use exact_kalman::scalar::{Rational, ratio};
use proptest::collection::vec;
use proptest::prelude::*;

use super::draws::{Q, integers, inverse, map, matrices, number, parallel_sum, scalar, shorted};

/// A model by factors of its covariances, and the values that its sources take.
#[derive(Clone, Debug)]
struct Draw {
    a: Q,
    mean: Q,
    /// Factors of P(0), V and W, of any rank.
    factors: [Q; 3],
    /// The source of x(0), then those of v and w, one column each.
    start: Q,
    sources: Vec<(Q, Q)>,
}

impl Draw {
    fn covariances(&self) -> [Q; 3] {
        self.factors.each_ref().map(|factor| factor * factor.transpose())
    }

    fn map(&self) -> RiccatiMap<Rational> {
        let [_, v, w] = self.covariances();
        map(&self.a, &v, &w)
    }

    /// y(1), y(2), … by AK-1.1 and AK-1.2.
    fn readings(&self) -> Vec<Q> {
        let mut x = &self.mean + &self.factors[0] * &self.start;
        let mut readings = Vec::new();
        for (v, w) in &self.sources {
            x = &self.a * x + &self.factors[1] * v;
            readings.push(&x + &self.factors[2] * w);
        }
        readings
    }
}

fn draws() -> impl Strategy<Value = Draw> {
    let sizes = (1usize..=3).prop_flat_map(|n| (Just(n), 0..=n, 0..=n, 0..=n));
    sizes.prop_flat_map(|(n, p, v, w)| {
        let factors = (matrices(n, p, 3), matrices(n, v, 3), matrices(n, w, 3));
        let sources = vec((matrices(v, 1, 3), matrices(w, 1, 3)), 1..=3);
        (matrices(n, n, 3), matrices(n, 1, 3), factors, matrices(p, 1, 3), sources)
            .prop_map(|(a, mean, (p, v, w), start, sources)| Draw { a, mean, factors: [p, v, w], start, sources })
    })
}

fn complete(reading: &Q) -> Observation<Rational> {
    Observation::complete(reading.entries().to_vec())
}

fn missing(n: usize) -> Observation<Rational> {
    Observation::new(vec![None; n])
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 100, failure_persistence: None, ..ProptestConfig::default() })]

    /// AK-1.1, AK-1.2, AK-1.3a, AK-1.3-start, AK-1.4a, AK-1.4b, AK-1.4c, AK-1.4-start: the recursion of the paper, the general
    /// filter on the same system, and the joint law conditioned once give the same numbers.
    #[test]
    fn the_papers_filter_is_the_filter(draw in draws()) {
        let (map, readings) = (draw.map(), draw.readings());
        let [p0, v, w] = draw.covariances();
        let observations: Vec<_> = readings.iter().map(complete).collect();
        let path = map.system(draw.mean.clone(), p0.clone()).realised(&observations).unwrap_or_else(|error| panic!("{error}"));
        let trace = filter(&path).unwrap_or_else(|error| panic!("{error}"));
        let laws = one_shot(&path).unwrap_or_else(|error| panic!("{error}"));
        prop_assert_eq!(laws.len(), readings.len());
        let (mut mean, mut p) = (draw.mean.clone(), p0);
        for ((reading, record), law) in readings.iter().zip(&trace.records).zip(&laws) {
            let step = map.step(&p);
            mean = map.filtered_mean(&step.gain, &mean, reading);
            prop_assert_eq!((&mean, &step.filtered), (law.filtered.mean(), law.filtered.covariance()));
            prop_assert_eq!((&mean, &step.filtered), (&record.filtered.mean, &record.filtered.covariance));
            prop_assert_eq!(&step.predicted, law.predicted.covariance());
            prop_assert_eq!(&step.gain, &record.gain);
            // AK-1.4c: P(k) = S(k):W, by elimination; and (1.4a) written out.
            prop_assert_eq!(&step.filtered, &shorted(&step.predicted, &w));
            prop_assert_eq!(&step.predicted, &(&draw.a * &p * draw.a.transpose() + &v));
            p = step.filtered;
        }
    }

    /// AK-4.1: S(k) = φ(S(k−1)) for k ≥ 2, singular V and W included; S(1) is A P(0)Aᵀ + V.
    #[test]
    fn covariances_before_observations_follow_the_map(draw in draws()) {
        let map = draw.map();
        let [p0, v, w] = draw.covariances();
        let mut step = map.step(&p0);
        prop_assert_eq!(&step.predicted, &(draw.a.congruence(&p0) + &v));
        for _ in 2..=4 {
            let s = step.predicted;
            step = map.step(&step.filtered);
            prop_assert_eq!(&step.predicted, &map.image(&s));
            let inverse = (&s + &w).pseudo_inverse().unwrap_or_else(|error| panic!("{error}"));
            prop_assert_eq!(&step.predicted, &(draw.a.congruence(&(&s - &s * inverse * &s)) + &v));
            prop_assert_eq!(&step.predicted, &(draw.a.congruence(&shorted(&s, &w)) + &v));
        }
    }

    /// AK-1.3b, AK-1.3c: predictions further ahead, against the general filter with the later readings missing.
    #[test]
    fn predictions_are_powers_of_the_transition(draw in draws(), ahead in 1usize..=2) {
        let (map, readings) = (draw.map(), draw.readings());
        let [p0, ..] = draw.covariances();
        let n = draw.a.rows();
        let mut observations: Vec<_> = readings.iter().map(complete).collect();
        observations.extend((0..ahead).map(|_| missing(n)));
        let path = map.system(draw.mean.clone(), p0).realised(&observations).unwrap_or_else(|error| panic!("{error}"));
        let laws = one_shot(&path).unwrap_or_else(|error| panic!("{error}"));
        let last = laws[readings.len() - 1].filtered.mean();
        for steps in 1..=ahead {
            let expected = laws[readings.len() - 1 + steps].filtered.mean();
            prop_assert_eq!(&map.predicted_mean(last, steps), expected);
        }
    }

    /// AK-M: with a nonsingular M the filter of Mx(k), with MAM⁻¹ and MVMᵀ, is M times the filter of x(k).
    #[test]
    fn sensors_of_full_rank_change_the_basis(draw in draws(), entries in vec(-3i64..=3, 9)) {
        let n = draw.a.rows();
        let sensors = Matrix::from_fn(n, n, |i, j| ratio(entries[3 * i + j], 1));
        prop_assume!(sensors.rank() == n);
        let [p0, v, w] = draw.covariances();
        let original = System {
            observation: sensors.clone().into(),
            ..map(&draw.a, &v, &w).system(draw.mean.clone(), p0.clone())
        };
        // Readings that the system can produce: M x(k) + w(k) = M(x(k) + M⁻¹w(k)).
        let readings: Vec<Q> = {
            let mut moved = draw.clone();
            moved.factors[2] = inverse(&sensors) * &draw.factors[2];
            moved.readings().iter().map(|reading| &sensors * reading).collect()
        };
        let observations: Vec<_> = readings.iter().map(complete).collect();
        let path = original.realised(&observations).unwrap_or_else(|error| panic!("{error}"));
        let laws = one_shot(&path).unwrap_or_else(|error| panic!("{error}"));
        let map = RiccatiMap::with_sensors(&sensors, &draw.a, &v, w).unwrap_or_else(|error| panic!("{error}"));
        let (mut mean, mut p) = (&sensors * &draw.mean, sensors.congruence(&p0));
        for (reading, law) in readings.iter().zip(&laws) {
            let step = map.step(&p);
            mean = map.filtered_mean(&step.gain, &mean, reading);
            p = step.filtered;
            prop_assert_eq!(&mean, &(&sensors * law.filtered.mean()));
            prop_assert_eq!(&p, &sensors.congruence(law.filtered.covariance()));
        }
    }

    /// AK-W0: without observation noise P(k) = 0 for k ≥ 1, and S(k) = V, Δ(k) = VV⁺ for k ≥ 2.
    #[test]
    fn exact_readings_leave_no_doubt(draw in draws()) {
        let [p0, v, _] = draw.covariances();
        let zero = Matrix::zeros(v.rows(), v.rows());
        let map = map(&draw.a, &v, &zero);
        let first = map.step(&p0);
        let second = map.step(&first.filtered);
        prop_assert!(first.filtered.is_zero() && second.filtered.is_zero());
        prop_assert_eq!(&second.predicted, &v);
        // VV⁺ is the symmetric idempotent matrix with the range of V.
        let projection = second.gain;
        prop_assert_eq!(&projection * &projection, projection.clone());
        prop_assert_eq!(projection.transpose(), projection.clone());
        prop_assert_eq!(&projection * &v, v.clone());
        prop_assert_eq!(projection.rank(), v.rank());
    }
}

/// Erratum AK-1.3a: printed as the projection on the span of y(1), …, y(k). x(0) = 100, A = 9/10, V = 4, W = 1, y(1) = 95: the
/// filter (1.3) gives 94, which is the projection on 1 and y(1); the one on y(1) alone is 153976/1621.
#[test]
fn projections_need_the_constant() {
    let map = map(&scalar(ratio(9, 10)), &scalar(ratio(4, 1)), &scalar(ratio(1, 1)));
    let step = map.step(&scalar(ratio(0, 1)));
    let printed_filter = number(&map.filtered_mean(&step.gain, &scalar(ratio(100, 1)), &scalar(ratio(95, 1))));
    // Moments by hand: x(1) = 90 + v(0), y(1) = x(1) + w(1).
    let (mean, variance, noise) = (ratio(90, 1), ratio(4, 1), ratio(1, 1));
    let second_moment = &mean * &mean + &variance;
    let with_constant = &mean + &variance / (&variance + &noise) * (ratio(95, 1) - &mean);
    let without = &second_moment / (&second_moment + &noise) * ratio(95, 1);
    assert_eq!(printed_filter, with_constant);
    assert_eq!(with_constant, ratio(94, 1));
    assert_eq!(without, ratio(153_976, 1621));
    assert_ne!(printed_filter, without);
}

/// Erratum AK-W0: printed for k ≥ 1. A = P(0) = V = 1 has S(1) = 2, not V; A = P(0) = 1, V = 0 has Δ(1) = 1, not VV⁺ = 0.
#[test]
fn the_first_step_without_noise_still_sees_the_start() {
    let [zero, one, two] = [0, 1, 2].map(|value| scalar(ratio(value, 1)));
    let map = |v: &Q| map(&one, v, &zero);
    let first = map(&one).step(&one);
    assert_eq!(first.predicted, two);
    assert_ne!(first.predicted, one, "as printed");
    assert_eq!(map(&one).step(&first.filtered).predicted, one, "for k = 2");
    let first = map(&zero).step(&one);
    assert_eq!(first.gain, one);
    assert_ne!(first.gain, zero, "as printed");
    assert_eq!(map(&zero).step(&first.filtered).gain, zero, "for k = 2");
}

/// Erratum AK-M: printed noise v(k) in the observation. For A = M = V = W = P(0) = 1 the covariance of x(2) and y(1) is 2 with
/// w(1), 3 with v(1), and the best prediction of x(2) from y(1) has the filter's gain 2/3 with w(1) only.
#[test]
fn observations_have_a_noise_of_their_own() {
    // Sources x(0), v(0), v(1), w(1); rows x(2), y(1).
    let gain = |observation: [i64; 4]| {
        let rows = Matrix::from_fn(2, 4, |i, j| ratio([[1, 1, 1, 0], observation][i][j], 1));
        let joint = Gaussian::<Rational>::standard(4).affine(&rows, &Matrix::zeros(2, 1));
        let given = joint.conditioned(&[1], &integers(&[[0]])).unwrap_or_else(|error| panic!("{error}"));
        (joint.covariance()[(0, 1)].clone(), number(&given.gain))
    };
    let (right, printed) = (gain([1, 1, 0, 1]), gain([1, 1, 1, 0]));
    assert_eq!(right, (ratio(2, 1), ratio(2, 3)));
    assert_eq!(printed, (ratio(3, 1), ratio(1, 1)));
    let one = scalar(ratio(1, 1));
    let map = RiccatiMap::with_sensors(&one, &one, &one, one.clone()).unwrap_or_else(|error| panic!("{error}"));
    let step = map.step(&one);
    assert_eq!(number(&step.gain), right.1);
    assert_eq!(parallel_sum(&step.predicted, &one), step.filtered);
}

/// AK-M, AK-2.5: what makes no map is refused, with a proof.
#[test]
fn what_is_no_model_is_refused() {
    let (one, bad) = (Matrix::identity(2), integers(&[[1, 2], [2, 1]]));
    match RiccatiMap::new(one.clone(), bad.clone(), one.clone()) {
        Err(RiccatiError::NotSemidefinite {
            role: Role::StateNoise,
            source: exact_kalman::matrix::LdlError::Indefinite(proof),
        }) => {
            assert_eq!(proof.witness.transpose().congruence(&bad)[(0, 0)], proof.value);
        }
        other => panic!("{other:?}"),
    }
    let shape = RiccatiMap::new(one.clone(), one.clone(), Matrix::identity(3));
    assert!(matches!(shape, Err(RiccatiError::Shape { role: Role::ObservationNoise, .. })));
    let shape = RiccatiMap::new(Matrix::zeros(2, 1), one.clone(), one.clone());
    assert!(matches!(shape, Err(RiccatiError::Shape { role: Role::Transition, .. })));
    let singular = integers(&[[1, 2], [2, 4]]);
    match RiccatiMap::with_sensors(&singular, &one, &one, one.clone()) {
        Err(RiccatiError::SensorsSingular { direction }) => {
            assert!((singular * &direction).is_zero() && !direction.is_zero());
        }
        other => panic!("{other:?}"),
    }
}

/// AK-1.1, AK-1.2, AK-A.v, AK-A.w, AK-A.x: the system of a map has the paper's matrices, shares no noise, and starts before
/// a transition.
#[test]
fn the_system_is_the_papers() {
    let (a, v, w) = (integers(&[[1, 2], [0, 3]]), integers(&[[2, 1], [1, 2]]), integers(&[[1, 0], [0, 0]]));
    let (mean, p) = (integers(&[[5], [6]]), integers(&[[4, 0], [0, 9]]));
    let system = map(&a, &v, &w).system(mean.clone(), p.clone());
    assert!(matches!(system.noise, Noise::Covariances { cross: None, .. }));
    let path = system.realised(&[complete(&mean)]).unwrap_or_else(|error| panic!("{error}"));
    // One step: x(1) = A x(0) + v(0), y(1) = x(1) + w(1), from the moments written out.
    let law = &one_shot(&path).unwrap_or_else(|error| panic!("{error}"))[0];
    assert_eq!(law.predicted.mean(), &(&a * &mean));
    assert_eq!(law.predicted.covariance(), &(&a * &p * a.transpose() + &v));
    let record = &filter(&path).unwrap_or_else(|error| panic!("{error}")).records[0];
    assert_eq!(record.innovation_covariance, &a * &p * a.transpose() + v + w);
}
