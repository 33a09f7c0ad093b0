//! The filter on small models against formulas in machine integers, and two steps of it against the joint law.

use exact_kalman::filter::filter;
use exact_kalman::gaussian::ConditionError;
use exact_kalman::matrix::Matrix;
use exact_kalman::model::{Before, Initial, Noise, Observation, Path, System, Timing};
use exact_kalman::scalar::{Rational, ratio};
use exact_kalman::trace::Moments;

use crate::minors::{rank, schur_complement};
use crate::worlds::{covariances, integers, matrices, signs};

type Q = Matrix<Rational>;

/// A, C, D, F that last, and the first law.
struct Model<'a> {
    timing: Timing,
    a: &'a Q,
    c: &'a Q,
    d: &'a Q,
    f: &'a Q,
    mean: &'a Q,
    covariance: &'a Q,
}

impl Model<'_> {
    fn path(&self, readings: &[i64]) -> Path<Rational> {
        let before = match self.timing {
            Timing::Arriving => Before::Transition,
            Timing::Departing => Before::Observation,
        };
        let system = System {
            timing: self.timing,
            initial: Initial::new(before, self.mean.clone(), self.covariance.clone()),
            transition: self.a.clone().into(),
            observation: self.c.clone().into(),
            noise: Noise::Factors { process: self.d.clone().into(), observation: self.f.clone().into() },
            input: None,
            observation_input: None,
        };
        let observations: Vec<_> = readings.iter().map(|&y| Observation::complete([ratio(y, 1)])).collect();
        system.realised(&observations).unwrap_or_else(|error| panic!("{error}"))
    }
}

/// A 2×1 or 1×2 matrix of machine integers.
fn pair(matrix: &Q) -> [i64; 2] {
    [0, 1].map(|i| integer(&matrix.entries()[i]))
}

fn square(matrix: &Q) -> [[i64; 2]; 2] {
    [0, 1].map(|i| [0, 1].map(|j| integer(&matrix[(i, j)])))
}

fn integer(value: &Rational) -> i64 {
    assert!(value.is_integer());
    i64::try_from(value.numer()).unwrap_or_else(|error| panic!("{error}"))
}

fn dot(left: [i64; 2], right: [i64; 2]) -> i64 {
    left[0] * right[0] + left[1] * right[1]
}

fn image(a: [[i64; 2]; 2], x: [i64; 2]) -> [i64; 2] {
    a.map(|row| dot(row, x))
}

/// A P Aᵀ + D Dᵀ for a symmetric P.
fn predicted(a: [[i64; 2]; 2], p: [[i64; 2]; 2], d: [i64; 2]) -> [[i64; 2]; 2] {
    [0, 1].map(|i| [0, 1].map(|j| dot(a[i], image(p, a[j])) + d[i] * d[j]))
}

/// Whether the moments are x + γν/s and P − γγᵀ/s, without the fractions where s = 0.
fn is_updated(moments: &Moments<Rational>, x: [i64; 2], p: [[i64; 2]; 2], gamma: [i64; 2], nu: i64, s: i64) -> bool {
    let share = |numerator: i64| if s == 0 { ratio(0, 1) } else { ratio(numerator, s) };
    let place = [0, 1];
    place.iter().all(|&i| {
        moments.mean[(i, 0)] == ratio(x[i], 1) + share(gamma[i] * nu)
            && place.iter().all(|&j| moments.covariance[(i, j)] == ratio(p[i][j], 1) - share(gamma[i] * gamma[j]))
    })
}

/// Counts: updates with s ≠ 0, with s = 0, and contradictions.
fn census(timing: Timing) -> [usize; 3] {
    const Y: i64 = 2;
    let (signs, bits) = (signs(), &integers(1)[1..]);
    let mean = Matrix::from_integers(&[[1], [-2]]);
    let covariances = covariances(2, 1);
    let mut counts = [0; 3];
    for a in matrices(2, 2, &signs) {
        for (c, d) in matrices(1, 2, &signs).flat_map(|c| matrices(2, 1, bits).map(move |d| (c.clone(), d))) {
            for (p, f) in covariances.iter().flat_map(|p| matrices(1, 1, bits).map(move |f| (p, f))) {
                let model = Model { timing, a: &a, c: &c, d: &d, f: &f, mean: &mean, covariance: p };
                let found = filter(&model.path(&[Y]));
                let (a, p, c, d, f, x) = (square(&a), square(p), pair(&c), pair(&d), integer(&f[(0, 0)]), pair(&mean));
                let (next, ahead) = (image(a, x), predicted(a, p, d));
                // The law that is observed, and the covariance of its state with the reading.
                let (x, p, shared) = match timing {
                    Timing::Arriving => (next, ahead, d.map(|d| d * f)),
                    Timing::Departing => (x, p, [0, 0]),
                };
                let cp = image(p, c);
                let gamma = [0, 1].map(|i| cp[i] + shared[i]);
                let s = dot(c, cp) + f * f + 2 * dot(c, shared);
                let nu = Y - dot(c, x);
                match found {
                    Err(error) => {
                        assert!(s == 0 && nu != 0 && matches!(error.source, ConditionError::Inconsistent(_)));
                        counts[2] += 1;
                    }
                    Ok(trace) => {
                        assert!(s != 0 || nu == 0, "{trace:?} has probability zero");
                        let [record] = &trace.records[..] else { panic!("one reading") };
                        assert!(is_updated(&record.predicted, x, p, [0, 0], 0, 0), "{record:?}");
                        assert_eq!(record.innovation[(0, 0)], ratio(nu, 1));
                        assert_eq!(record.innovation_covariance[(0, 0)], ratio(s, 1));
                        let gain = |i: usize| if s == 0 { ratio(0, 1) } else { ratio(gamma[i], s) };
                        assert!((0..2).all(|i| record.gain[(i, 0)] == gain(i)), "{record:?}");
                        assert!(is_updated(&record.filtered, x, p, gamma, nu, s), "{record:?}");
                        if let Some(found) = &trace.ahead {
                            let departing = image(a, gamma);
                            let cross = [0, 1].map(|i| departing[i] + d[i] * f);
                            assert!(is_updated(found, next, ahead, cross, nu, s), "{found:?}");
                        }
                        assert_eq!(trace.ahead.is_some(), timing == Timing::Departing);
                        counts[usize::from(s == 0)] += 1;
                    }
                }
            }
        }
    }
    counts
}

/// CKS-3, CKS-4, CKS-K, CKS-R, CKS-12: one step in arriving timing, written out in machine integers, S = 0 included.
///
/// Domain: A 2×2 and C 1×2 over {−1, 0, 1}, D 2×1 and F over {0, 1}, P ≥ 0 over {−1, 0, 1}; one mean and one reading.
#[test]
fn arriving_updates_of_all_small_models() {
    let counts = census(Timing::Arriving);
    assert_eq!(counts.iter().sum::<usize>(), 81 * 9 * 4 * 2 * 6);
    assert!(counts.iter().all(|&count| count > 400), "{counts:?}");
}

/// HV-3, HV-4, HV-5: one step in departing timing, written out in machine integers, S = 0 included.
///
/// Domain: A 2×2 and C 1×2 over {−1, 0, 1}, D 2×1 and F over {0, 1}, P ≥ 0 over {−1, 0, 1}; one mean and one reading.
#[test]
fn departing_updates_of_all_small_models() {
    let counts = census(Timing::Departing);
    assert_eq!(counts.iter().sum::<usize>(), 81 * 9 * 4 * 2 * 6);
    assert!(counts.iter().all(|&count| count > 400), "{counts:?}");
}

/// A combination of the first state and the two noises.
type Form = [i64; 3];

fn combined(left: (i64, Form), right: (i64, Form)) -> Form {
    [0, 1, 2].map(|i| left.0 * left.1[i] + right.0 * right.1[i])
}

/// CKS-T, CKS-5, CKS-6, CKS-7: two steps of a scalar state, given both readings: the filter, step by step, against the joint law of
/// the state and both readings, by minors.
///
/// Domain: a, c, d, f over {−2, …, 2}, P(0) = 0 or 1, both readings over {0, 1}; the mean 1.
#[test]
fn two_steps_are_the_joint_law_conditioned_once() {
    let one = Q::identity(1);
    let (mut counts, all) = ([0; 3], integers(2));
    for coefficients in matrices(4, 1, &all) {
        let [a, c, d, f] = [0, 1, 2, 3].map(|i| coefficients.block(i..i + 1, 0..1));
        let values = [&a, &c, &d, &f].map(|matrix| integer(&matrix[(0, 0)]));
        for variance in [0, 1] {
            let covariance = one.scaled(&ratio(variance, 1));
            let model =
                Model { timing: Timing::Arriving, a: &a, c: &c, d: &d, f: &f, mean: &one, covariance: &covariance };
            // x₁ = a x₀ + d w₁ and y₁ = c x₁ + f w₁, then the same again.
            let [x0, w1, w2] = [[variance, 0, 0], [0, 1, 0], [0, 0, 1]];
            let [a, c, d, f] = values;
            let x1 = combined((a, x0), (d, w1));
            let x2 = combined((a, x1), (d, w2));
            let rows = [x2, combined((c, x1), (f, w1)), combined((c, x2), (f, w2))];
            let whole = Matrix::from_fn(3, 3, |i, j| ratio((0..3).map(|k| rows[i][k] * rows[j][k]).sum(), 1));
            let means = [a * a, c * a, c * a * a];
            for readings in [[0, 0], [0, 1], [1, 0], [1, 1]] {
                let innovation = Matrix::column([0, 1].map(|i| ratio(readings[i] - means[i + 1], 1)).to_vec());
                let yy = whole.select(&[1, 2], &[1, 2]);
                let consistent = rank(&yy.beside(&innovation)) == rank(&yy);
                match filter(&model.path(&readings)) {
                    Err(error) => {
                        assert!(!consistent && matches!(error.source, ConditionError::Inconsistent(_)));
                        counts[2] += 1;
                    }
                    Ok(trace) => {
                        assert!(consistent, "{values:?} at {readings:?}");
                        let found = &trace.records[1].filtered;
                        assert_eq!(found.covariance, schur_complement(&whole, &[0], &[1, 2]), "{values:?}");
                        // 0 − P_xy P_yy⁻ ν
                        let bordered = Matrix::zeros(1, 1).beside(&whole.select(&[0], &[1, 2]));
                        let bordered = bordered.above(&innovation.beside(&yy));
                        let moved =
                            Matrix::column(vec![ratio(means[0], 1)]) - schur_complement(&bordered, &[0], &[1, 2]);
                        assert_eq!(found.mean, moved, "{values:?} at {readings:?}");
                        counts[usize::from(rank(&yy) < 2)] += 1;
                    }
                }
            }
        }
    }
    assert_eq!(counts.iter().sum::<usize>(), 625 * 2 * 4);
    assert!(counts.iter().all(|&count| count > 100), "{counts:?}");
}
