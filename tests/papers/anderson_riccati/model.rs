//! The assumptions of section 1, on finite probability spaces: no normality, projections by their normal equations.

use exact_kalman::matrix::Matrix;
use exact_kalman::scalar::{Rational, ratio};

use super::draws::{Q, integers, inverse, map};

/// A random vector with finitely many values: probabilities and columns.
type Law = Vec<(Rational, Q)>;

/// One outcome: its probability, x(0), v(0), v(1), v(2) and w(1), w(2), w(3).
struct Outcome {
    probability: Rational,
    start: Q,
    state_noise: Vec<Q>,
    observation_noise: Vec<Q>,
}

/// How outcomes lose an independence.
type Change = fn(&mut Outcome);

const STEPS: usize = 3;

fn mean(law: &Law) -> Q {
    law.iter().fold(Matrix::zeros(law[0].1.rows(), 1), |sum, (p, value)| sum + value.scaled(p))
}

fn covariance(law: &Law) -> Q {
    let centre = mean(law);
    let n = centre.rows();
    law.iter().fold(Matrix::zeros(n, n), |sum, (p, value)| {
        let deviation = value - &centre;
        sum + (&deviation * deviation.transpose()).scaled(p)
    })
}

/// Every combination of independent choices.
fn outcomes(start: &Law, v: &Law, w: &Law) -> Vec<Outcome> {
    let mut all: Vec<_> = start
        .iter()
        .map(|(p, x)| Outcome {
            probability: p.clone(),
            start: x.clone(),
            state_noise: Vec::new(),
            observation_noise: Vec::new(),
        })
        .collect();
    for law in [v, w].into_iter().cycle().take(2 * STEPS) {
        let mut next = Vec::new();
        for outcome in &all {
            for (p, value) in law {
                let (mut state_noise, mut observation_noise) =
                    (outcome.state_noise.clone(), outcome.observation_noise.clone());
                if state_noise.len() == observation_noise.len() {
                    state_noise.push(value.clone());
                } else {
                    observation_noise.push(value.clone());
                }
                let (probability, start) = (&outcome.probability * p, outcome.start.clone());
                next.push(Outcome { probability, start, state_noise, observation_noise });
            }
        }
        all = next;
    }
    all
}

/// The states x(1), … and the readings y(1), … of an outcome.
fn run(a: &Q, outcome: &Outcome) -> (Vec<Q>, Vec<Q>) {
    let (mut x, mut states, mut readings) = (outcome.start.clone(), Vec::new(), Vec::new());
    for (v, w) in outcome.state_noise.iter().zip(&outcome.observation_noise) {
        x = a * x + v;
        readings.push(&x + w);
        states.push(x.clone());
    }
    (states, readings)
}

/// The projection of a random vector on the span of 1, y(1), …, y(k), at every outcome: E[xZᵀ](E[ZZᵀ])⁻¹Z.
fn projection(outcomes: &[Outcome], target: &[Q], readings: &[Vec<Q>], k: usize) -> Vec<Q> {
    let span: Vec<Q> =
        readings.iter().map(|all| all[..k].iter().fold(integers(&[[1]]), |span, y| span.above(y))).collect();
    let moment = |left: &[Q], right: &[Q]| {
        let terms = outcomes.iter().zip(left.iter().zip(right));
        terms.fold(Matrix::zeros(left[0].rows(), right[0].rows()), |sum, (outcome, (l, r))| {
            sum + (l * r.transpose()).scaled(&outcome.probability)
        })
    };
    let coefficients = moment(target, &span) * inverse(&moment(&span, &span));
    span.iter().map(|z| &coefficients * z).collect()
}

/// The filter's x(k|k) at every outcome.
fn filtered(a: &Q, laws: [&Law; 3], readings: &[Vec<Q>], k: usize) -> Vec<Q> {
    let map = map(a, &covariance(laws[1]), &covariance(laws[2]));
    let run = |all: &Vec<Q>| {
        let start = (mean(laws[0]), covariance(laws[0]));
        let last = all[..k].iter().fold(start, |(mean, p), y| {
            let step = map.step(&p);
            (map.filtered_mean(&step.gain, &mean, y), step.filtered)
        });
        last.0
    };
    readings.iter().map(run).collect()
}

/// Skewed laws of mean zero, and a start whose mean is not.
fn plain() -> (Q, Law, Law, Law) {
    let law = |values: &[(i64, i64, i64)]| values.iter().map(|&(n, d, x)| (ratio(n, d), integers(&[[x]]))).collect();
    (
        integers(&[[1]]).scaled(&ratio(3, 2)),
        law(&[(1, 2, 5), (1, 3, 1), (1, 6, -2)]),
        law(&[(2, 3, -1), (1, 3, 2)]),
        law(&[(1, 4, -3), (3, 4, 1)]),
    )
}

/// Two states; v moves along a line only, so that V is singular.
fn planar() -> (Q, Law, Law, Law) {
    let law = |values: &[(i64, i64, [i64; 2])]| {
        values.iter().map(|&(n, d, [x, y])| (ratio(n, d), integers(&[[x], [y]]))).collect()
    };
    (
        integers(&[[1, 1], [-1, 1]]),
        law(&[(1, 3, [2, 0]), (1, 3, [0, 1]), (1, 3, [1, 5])]),
        law(&[(1, 3, [2, 4]), (2, 3, [-1, -2])]),
        law(&[(1, 2, [1, 0]), (1, 4, [-1, 2]), (1, 4, [-1, -2])]),
    )
}

/// AK-1.1, AK-1.2, AK-A.v, AK-A.w, AK-A.x, AK-1.3a, AK-1.3b, AK-1.3c: whatever the laws, the filter's means are the
/// projections on 1, y(1), …, y(k), for states and readings to come. y(k|k) is y(k), not x(k|k).
#[test]
fn the_filter_projects_whatever_the_law() {
    for (a, start, v, w) in [plain(), planar()] {
        let outcomes = outcomes(&start, &v, &w);
        let runs: Vec<_> = outcomes.iter().map(|outcome| run(&a, outcome)).collect();
        let (states, readings): (Vec<_>, Vec<_>) = runs.into_iter().unzip();
        let total = outcomes.iter().fold(ratio(0, 1), |sum, outcome| sum + &outcome.probability);
        assert_eq!(total, ratio(1, 1));
        let at = |all: &[Vec<Q>], k: usize| all.iter().map(|run| run[k - 1].clone()).collect::<Vec<_>>();
        let map = map(&a, &covariance(&v), &covariance(&w));
        for k in 1..=2 {
            let estimate = filtered(&a, [&start, &v, &w], &readings, k);
            assert_eq!(estimate, projection(&outcomes, &at(&states, k), &readings, k));
            for t in k + 1..=STEPS {
                let ahead: Vec<_> = estimate.iter().map(|mean| map.predicted_mean(mean, t - k)).collect();
                assert_eq!(ahead, projection(&outcomes, &at(&states, t), &readings, k));
                assert_eq!(ahead, projection(&outcomes, &at(&readings, t), &readings, k));
            }
            let present = projection(&outcomes, &at(&readings, k), &readings, k);
            assert_eq!(present, at(&readings, k));
            assert_ne!(present, estimate);
        }
    }
}

/// AK-A.v: without normality the filter is the best linear estimate, not the best one: given y(1) the mean of x(1) is another
/// function of it.
#[test]
fn the_filter_is_not_the_conditional_mean() {
    let (a, start, v, w) = plain();
    let outcomes = outcomes(&start, &v, &w);
    let readings: Vec<_> = outcomes.iter().map(|outcome| run(&a, outcome).1).collect();
    let estimate = filtered(&a, [&start, &v, &w], &readings, 1);
    let differs = (0..outcomes.len()).any(|i| {
        let same: Vec<usize> = (0..outcomes.len()).filter(|&j| readings[j][0] == readings[i][0]).collect();
        let weight = same.iter().fold(ratio(0, 1), |sum, &j| sum + &outcomes[j].probability);
        let mean = same.iter().fold(Matrix::zeros(1, 1), |sum, &j| {
            sum + run(&a, &outcomes[j]).0[0].scaled(&(&outcomes[j].probability / &weight))
        });
        mean != estimate[i]
    });
    assert!(differs);
}

/// AK-A.v, AK-A.w, AK-A.x: each independence is needed: if v(1) repeats v(0), or w(k) repeats v(k−1), or v(0) follows x(0),
/// with the same V, W and P(0), the filter's means are no projections.
#[test]
fn dependent_noise_breaks_the_filter() {
    let (a, start, v, _) = plain();
    let w = v.clone();
    let changes: [(&str, Change); 3] = [
        ("v", |outcome| outcome.state_noise[1] = outcome.state_noise[0].clone()),
        ("w", |outcome| outcome.observation_noise = outcome.state_noise.clone()),
        // x(0) = 5 has probability 1/2: a variable of mean 0 on ±1 that x(0) determines.
        ("x", |outcome| {
            let sign = if outcome.start == integers(&[[5]]) { 1 } else { -1 };
            outcome.state_noise[0] = integers(&[[sign]]);
        }),
    ];
    for (name, change) in changes {
        let mut outcomes = outcomes(&start, &v, &w);
        outcomes.iter_mut().for_each(change);
        let (states, readings): (Vec<_>, Vec<_>) = outcomes.iter().map(|outcome| run(&a, outcome)).unzip();
        // The filter runs on the laws that the noises have, one by one.
        let sign: Law = vec![(ratio(1, 2), integers(&[[1]])), (ratio(1, 2), integers(&[[-1]]))];
        let v = if name == "x" { &sign } else { &v };
        let k = if name == "v" { 2 } else { 1 };
        let target: Vec<_> = states.iter().map(|run: &Vec<Q>| run[k - 1].clone()).collect();
        let estimate = filtered(&a, [&start, v, &w], &readings, k);
        assert_ne!(estimate, projection(&outcomes, &target, &readings, k), "{name}");
    }
}
