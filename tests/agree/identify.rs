//! Identification by two routes: running sums against data matrices, the adaptive filter against the filter of the
//! Theorem, recursive least squares against the batch answer and against one-shot conditioning.

use exact_kalman::filter::{filter, one_shot};
use exact_kalman::identify::{
    AdaptiveError, AdaptiveRecord, Belief, Estimates, History, Obstacle, Posterior, Regression, Series, SeriesError,
    SingularPrior, adaptive_filter, estimates,
};
use exact_kalman::matrix::Matrix;
use exact_kalman::model::{Before, Coefficient, Initial, Noise, Observation, Past, Reading, Repair, System, Timing};
use exact_kalman::scalar::{Rational, Scalar, Undefined, ratio};
use proptest::collection::vec;
use proptest::prelude::*;

type Q = Matrix<Rational>;

fn series(readings: &[Vec<i64>]) -> Series<Rational> {
    let rows = readings.iter().map(|y| y.iter().map(|&entry| ratio(entry, 1)).collect()).collect();
    Series::new(rows).unwrap_or_else(|error| panic!("{error}"))
}

/// Three to eight readings of one to three components; zeros are frequent, so that lag sums are often singular.
fn readings() -> impl Strategy<Value = Vec<Vec<i64>>> {
    (1_usize..=3, 3_usize..=8).prop_flat_map(|(p, n)| vec(vec(-3_i64..=3, p), n))
}

/// The columns y(from), …, y(to), counted from 1, side by side.
fn columns(series: &Series<Rational>, from: usize, to: usize) -> Q {
    let y = series.readings();
    Matrix::from_fn(series.dimension(), to + 1 - from, |i, j| y[from - 1 + j][(i, 0)].clone())
}

/// Â(n), by matrices of data.
fn transition(series: &Series<Rational>, n: usize) -> Q {
    let [ahead, one, two] = [columns(series, 3, n), columns(series, 2, n - 1), columns(series, 1, n - 2)];
    let inverse = (one * two.transpose()).pseudo_inverse().unwrap_or_else(|error| panic!("{error}"));
    ahead * two.transpose() * inverse
}

/// What stands for Âⁱ at step k.
type Factor<'a> = Box<dyn Fn(usize) -> Q + 'a>;

/// B(n,i): all residuals side by side, each with its own matrix F for Âⁱ, times their transpose.
fn residual_covariance(series: &Series<Rational>, n: usize, i: usize, factor: impl Fn(usize) -> Q) -> Q {
    let y = |k: usize| &series.readings()[k - 1];
    let residuals: Vec<Q> = (3..=n).map(|k| y(k) - factor(k) * y(k - i)).collect();
    let all = Matrix::from_fn(series.dimension(), residuals.len(), |row, k| residuals[k][(row, 0)].clone());
    (&all * all.transpose()).scaled(&ratio(1, i64::try_from(n).unwrap_or(i64::MAX)))
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 192, failure_persistence: None, ..ProptestConfig::default() })]

    /// AK-2.1, AK-2.2, AK-Rem2.2: running sums equal the formulas on matrices of data, in all three readings.
    #[test]
    fn running_estimates_eq_batch(readings in readings()) {
        let series = series(&readings);
        let a = |k: usize| transition(&series, k.max(3));
        for reading in Reading::ALL {
            let found = estimates(&series, reading).unwrap_or_else(|error| panic!("{error}"));
            prop_assert_eq!(found.iter().map(|one| one.count).collect::<Vec<_>>(), (3..=readings.len()).collect::<Vec<_>>());
            for Estimates { count: n, transition, residuals } in found {
                prop_assert_eq!(transition, a(n));
                let (one, two): (Factor, Factor) = match reading {
                    Reading::Printed => (Box::new(a), Box::new(|k| a(k) * a(k))),
                    Reading::Last => (Box::new(move |_| a(n)), Box::new(move |_| a(n) * a(n))),
                    Reading::Predictive => (Box::new(|k| a(k - 1)), Box::new(|k| a(k) * a(k - 1))),
                };
                prop_assert_eq!(residuals.one_step, residual_covariance(&series, n, 1, one));
                prop_assert_eq!(residuals.two_step, residual_covariance(&series, n, 2, two));
            }
        }
    }

    /// AK-2.3a, AK-2.3b, AK-2.3c, AK-2.3-start, AK-2.4: with covariances repaired, the adaptive filter is the filter of
    /// the Theorem on the system whose matrices are the estimates of each step.
    #[test]
    fn adaptive_filter_eq_filter_with_estimates(readings in readings(), root in vec(-2_i64..=2, 9), mean in vec(-5_i64..=5, 3)) {
        let series = series(&readings);
        let p = series.dimension();
        let root = Matrix::from_fn(p, p, |i, j| ratio(root[3 * i + j], 1));
        let start = Belief { mean: Matrix::from_fn(p, 1, |i, _| ratio(mean[i], 1)), covariance: &root * root.transpose() };
        for repair in [Repair::Zero, Repair::LastSemidefinite] {
            for reading in Reading::ALL {
                let records = adaptive_filter(&series, reading, &start, repair).unwrap_or_else(|error| panic!("{error}"));
                prop_assert_eq!(records.len(), readings.len() - 2);
                let expected = filtered(&series, &start, &records);
                for (record, expected) in records.iter().zip(&expected) {
                    prop_assert_eq!(&record.predicted_covariance, &expected.predicted.covariance);
                    prop_assert_eq!(&record.gain, &expected.gain);
                    prop_assert_eq!(&record.belief.covariance, &expected.filtered.covariance);
                    prop_assert_eq!(&record.belief.mean, &expected.filtered.mean);
                }
            }
        }
    }

    /// CKS-ARX, CKS-ARX.finite: recursion, batch answer and one-shot conditioning agree with `==` at every step, whatever feedback that
    /// does not look ahead made the inputs.
    #[test]
    fn recursive_least_squares_eq_batch_eq_one_shot(
        (lags, outputs) in ((0_usize..=2, 0_usize..=2), vec(-4_i64..=4, 1..=4)),
        (root, means) in (vec(-2_i64..=2, 16), vec(-3_i64..=3, 4)),
        (noise, feedback) in (1_i64..=4, 0_usize..4),
        (early_outputs, early_inputs) in (vec(-3_i64..=3, 0..3), vec(-3_i64..=3, 0..3)),
    ) {
        let count = lags.0 + lags.1;
        prop_assume!(count > 0);
        let root = Matrix::from_fn(count, count, |i, j| ratio(root[4 * i + j], 1));
        let integers = |values: &[i64]| values.iter().map(|&value| ratio(value, 1)).collect::<Vec<_>>();
        let regression = Regression {
            output_lags: lags.0,
            input_lags: lags.1,
            mean: Matrix::from_fn(count, 1, |i, _| ratio(means[i], 1)),
            covariance: &root * root.transpose(),
            noise: ratio(noise, 2),
            history: History { outputs: integers(&early_outputs), inputs: integers(&early_inputs) },
        };
        let outputs = integers(&outputs);
        let law = LAWS[feedback];
        let Ok(inputs) = (1..=outputs.len()).map(|count| law(&outputs[..count])).collect::<Result<Vec<_>, _>>() else {
            // u = 1/y is not finite on this path.
            return Ok(());
        };
        let data: Vec<_> = outputs.iter().map(|y| Observation::complete([y.clone()])).collect();
        let system = regression.system(move |past: Past<'_, Rational>| {
            let known: Vec<_> = (0..past.len()).filter_map(|k| past.entry(k, 0).cloned()).collect();
            law(&known)
        });
        let path = system.realised(&data).unwrap_or_else(|error| panic!("{error}"));
        let recorded = regression.recorded(inputs.clone()).realised(&data).unwrap_or_else(|error| panic!("{error}"));
        prop_assert_eq!(&path, &recorded);
        let trace = filter(&path).unwrap_or_else(|error| panic!("{error}"));
        let laws = one_shot(&path).unwrap_or_else(|error| panic!("{error}"));
        for (k, (record, law)) in trace.records.iter().zip(&laws).enumerate() {
            prop_assert_eq!(&record.filtered.mean, law.filtered.mean());
            prop_assert_eq!(&record.filtered.covariance, law.filtered.covariance());
            match regression.at_once(&outputs[..=k], &inputs[..=k]) {
                Ok(Posterior { mean, covariance }) => {
                    prop_assert_eq!(&record.filtered.mean, &mean);
                    prop_assert_eq!(&record.filtered.covariance, &covariance);
                }
                Err(SingularPrior) => prop_assert!(root.rank() < count),
            }
        }
    }
}

/// The filter of the Theorem from k = 3 on, with Â(k), V̂(k), Ŵ(k) as they were used; up to data that these matrices
/// call impossible.
fn filtered(
    series: &Series<Rational>,
    start: &Belief<Rational>,
    records: &[AdaptiveRecord<Rational>],
) -> Vec<exact_kalman::trace::Record<Rational>> {
    let each = |part: fn(&AdaptiveRecord<Rational>) -> &Q| Coefficient::per_step(records.iter().map(part).cloned());
    let system = System {
        timing: Timing::Arriving,
        initial: Initial::new(Before::Transition, start.mean.clone(), start.covariance.clone()),
        transition: each(|record| &record.model.transition),
        observation: Matrix::identity(series.dimension()).into(),
        noise: Noise::Covariances {
            process: each(|record| &record.model.noise.process),
            cross: None,
            observation: each(|record| &record.model.noise.observation),
        },
        input: None,
        observation_input: None,
    };
    let data: Vec<_> =
        series.readings()[2..].iter().map(|y| Observation::complete(y.entries().iter().cloned())).collect();
    let path = system.realised(&data).unwrap_or_else(|error| panic!("repaired covariances: {error}"));
    match filter(&path) {
        Ok(trace) => trace.records,
        Err(error) => error.computed,
    }
}

type Law = fn(&[Rational]) -> Result<Rational, Undefined>;

/// Feedback without moments, with memory, and without an excuse.
const LAWS: [Law; 4] = [
    |y| Ok(y[y.len() - 1].pow(3)),
    |y| ratio(1, 1).over(&y[y.len() - 1]),
    |y| Ok(y.iter().sum::<Rational>() * &y[0]),
    |_| Ok(ratio(0, 1)),
];

/// CKS-ARX: a direction that no regressor ever points in keeps its prior variance: here the input's coefficient, with
/// no input, and a prior under which the coefficients are independent.
#[test]
fn what_is_not_excited_is_not_learnt() {
    let regression = Regression {
        output_lags: 1,
        input_lags: 1,
        mean: Matrix::from_integers(&[[1], [7]]),
        covariance: Matrix::from_integers(&[[3, 0], [0, 5]]),
        noise: ratio(1, 1),
        history: History { outputs: vec![ratio(2, 1)], inputs: vec![] },
    };
    let outputs = [3, -1, 4].map(|y| ratio(y, 1));
    let last = |regression: &Regression<Rational>, inputs: [i64; 3]| {
        let system = regression.recorded(inputs.map(|u| ratio(u, 1)).to_vec());
        let path = system.realised(&outputs.clone().map(|y| Observation::complete([y])));
        let trace = path.map(|path| filter(&path).unwrap_or_else(|error| panic!("{error}")));
        trace.unwrap_or_else(|error| panic!("{error}")).records[2].filtered.clone()
    };
    let blind = last(&regression, [0, 0, 0]);
    assert_eq!((&blind.mean[(1, 0)], &blind.covariance[(1, 1)]), (&ratio(7, 1), &ratio(5, 1)));
    assert!(blind.covariance[(0, 0)] < ratio(3, 1));
    assert!(last(&regression, [1, 0, 0]).covariance[(1, 1)] < ratio(5, 1), "one input tells something");
}

/// AK-B.hat, AK-2.4: where Â is singular there are no V̂ and Ŵ, and a kernel vector says why; then keeping stops the
/// filter, and the other policies put zero or the last good covariance in their place.
#[test]
fn singular_estimates_have_a_witness_and_a_policy() {
    // Â(3) = y(3)/y(2) = 0.
    let series = series(&[vec![1], vec![1], vec![0], vec![2], vec![1]]);
    let all = estimates(&series, Reading::Printed).unwrap_or_else(|error| panic!("{error}"));
    assert_eq!(all[0].transition, Matrix::zeros(1, 1));
    let singular = all[0].noise().expect_err("Â(3) = 0");
    assert_eq!(&all[0].transition * &singular.kernel, Matrix::zeros(1, 1));
    assert_ne!(singular.kernel, Matrix::zeros(1, 1));
    assert!(singular.to_string().ends_with("it maps [1] to zero"), "{singular}");
    let start = Belief { mean: Matrix::zeros(1, 1), covariance: Matrix::identity(1) };
    match adaptive_filter(&series, Reading::Printed, &start, Repair::Keep) {
        Err(AdaptiveError { step: 3, source: Obstacle::Singular(_), computed }) => assert_eq!(computed, []),
        other => panic!("{other:?}"),
    }
    for repair in [Repair::Zero, Repair::LastSemidefinite] {
        let records =
            adaptive_filter(&series, Reading::Printed, &start, repair).unwrap_or_else(|error| panic!("{error}"));
        assert!(records[0].process_repaired && records[0].observation_repaired);
        assert_eq!(records[0].model.noise.process, Matrix::zeros(1, 1));
    }
}

/// AK-2.4, AK-B.hat: the three policies on estimates of which some are negative; (2.3) and (2.4) written out.
#[test]
fn policies_differ_where_an_estimate_is_no_covariance() {
    let series = series(&[-2, -2, -2, 3, -2, 3].map(|y| vec![y]));
    let start = Belief { mean: Matrix::zeros(1, 1), covariance: Matrix::identity(1) };
    let run =
        |repair| adaptive_filter(&series, Reading::Printed, &start, repair).unwrap_or_else(|error| panic!("{error}"));
    let [kept, zeroed, last] = [Repair::Keep, Repair::Zero, Repair::LastSemidefinite].map(run);
    let zero = ratio(0, 1);
    let mut seen = [0_usize; 2];
    let mut good: [Option<Rational>; 2] = [None, None];
    for ((kept, zeroed), last) in kept.iter().zip(&zeroed).zip(&last) {
        assert!(!kept.process_repaired && !kept.observation_repaired);
        let parts = [
            (
                &kept.model.noise.process,
                &zeroed.model.noise.process,
                &last.model.noise.process,
                zeroed.process_repaired,
            ),
            (
                &kept.model.noise.observation,
                &zeroed.model.noise.observation,
                &last.model.noise.observation,
                zeroed.observation_repaired,
            ),
        ];
        for (place, (kept, zeroed, last, repaired)) in parts.into_iter().enumerate() {
            let estimate = &kept[(0, 0)];
            assert_eq!(repaired, *estimate < zero);
            if repaired {
                // A repair after a good estimate that is not zero tells the policies apart.
                seen[place] += usize::from(good[place].as_ref().is_some_and(|good| *good > zero));
                assert_eq!(zeroed[(0, 0)], zero);
                assert_eq!(last[(0, 0)], good[place].clone().unwrap_or_else(|| zero.clone()));
            } else {
                assert_eq!((zeroed, last), (kept, kept));
                good[place] = Some(estimate.clone());
            }
        }
    }
    assert_eq!(seen, [1, 1]);
    // (2.3)–(2.4) written out for the indefinite matrices that are kept.
    let (mut mean, mut variance) = (zero.clone(), ratio(1, 1));
    for (record, y) in kept.iter().zip(&series.readings()[2..]) {
        let part = |matrix: &Q| matrix[(0, 0)].clone();
        let [a, v, w] =
            [&record.model.transition, &record.model.noise.process, &record.model.noise.observation].map(part);
        let s = &a * &a * &variance + v;
        let gain = if &s + &w == zero { zero.clone() } else { &s / (&s + &w) };
        mean = (ratio(1, 1) - &gain) * a * mean + &gain * part(y);
        variance = &s - gain * &s;
        assert_eq!((part(&record.belief.mean), part(&record.belief.covariance)), (mean.clone(), variance.clone()));
    }
}

#[test]
fn bad_series_are_refused() {
    let rows = |lengths: &[usize]| lengths.iter().map(|&length| vec![ratio(1, 1); length]).collect::<Vec<_>>();
    assert_eq!(Series::new(rows(&[1, 1])), Err(SeriesError::TooShort { found: 2 }));
    assert_eq!(Series::new(rows(&[])), Err(SeriesError::TooShort { found: 0 }));
    assert_eq!(Series::new(rows(&[0, 0, 0])), Err(SeriesError::NoComponent));
    assert_eq!(Series::new(rows(&[2, 2, 1, 3])), Err(SeriesError::Ragged { index: 2, expected: 2, found: 1 }));
    assert!(Series::new(rows(&[2, 2, 2])).is_ok());
}

/// CKS-ARX, CKS-ARX.sum: two lags of each and a history, the regressors written out by hand; the batch answer is solved
/// here, and only then compared with the recursion.
#[test]
fn regressors_of_two_lags_by_hand() {
    let integers = |values: &[i64]| values.iter().map(|&value| ratio(value, 1)).collect::<Vec<_>>();
    // y_{−1} = 5, y_{−2} = 7, u_{−1} = 11, u_{−2} = 13.
    let history = History { outputs: integers(&[5, 7]), inputs: integers(&[11, 13]) };
    let (mean, covariance) = (Matrix::column(integers(&[1, -1, 2, 0])), Matrix::diagonal(&integers(&[1, 2, 3, 4])));
    let regression = Regression {
        output_lags: 2,
        input_lags: 2,
        mean: mean.clone(),
        covariance: covariance.clone(),
        noise: ratio(1, 1),
        history,
    };
    let (y, u) = ([2, -3, 4, 1], [17, 19, 23]);
    // y_{k−1}, y_{k−2}, u_{k−1}, u_{k−2}
    let phi = Matrix::from_integers(&[[5, 7, 11, 13], [2, 5, 17, 11], [-3, 2, 19, 17], [4, -3, 23, 19]]);
    let data: Vec<_> = y.iter().map(|&y| Observation::complete([ratio(y, 1)])).collect();
    let path = regression.recorded(integers(&u)).realised(&data).unwrap_or_else(|error| panic!("{error}"));
    let trace = filter(&path).unwrap_or_else(|error| panic!("{error}"));
    let inverse = |matrix: &Q| matrix.inverse().unwrap_or_else(|error| panic!("{error}"));
    let prior = inverse(&covariance);
    for (k, record) in trace.records.iter().enumerate() {
        let rows = phi.block(0..k + 1, 0..4);
        let known = Matrix::column(integers(&y[..=k]));
        let posterior = inverse(&(&prior + rows.transpose() * &rows));
        assert_eq!(record.filtered.mean, &posterior * (&prior * &mean + rows.transpose() * known));
        assert_eq!(record.filtered.covariance, posterior);
    }
}

/// AK-2.3a, AK-B.hat: estimates kept as they are, for two components: the filter begins at y(4), as Â(3) has rank one, and each
/// step is that of the formulas with V̂ and Ŵ computed here from the residuals.
#[test]
fn kept_estimates_begin_where_there_are_some() {
    let data = [[3, 1], [1, -2], [2, 2], [-1, 3], [1, 1], [3, -1], [-2, 2]].map(Vec::from);
    let series = series(&data);
    let start = Belief { mean: Matrix::zeros(2, 1), covariance: Matrix::identity(2) };
    assert_eq!(transition(&series, 3).rank(), 1);
    let records =
        adaptive_filter(&series, Reading::Last, &start, Repair::Keep).unwrap_or_else(|error| panic!("{error}"));
    assert_eq!(records.iter().map(|record| record.step).collect::<Vec<_>>(), [4, 5, 6, 7]);
    let inverse = |matrix: &Q| matrix.inverse().unwrap_or_else(|error| panic!("{error}"));
    let (mut mean, mut p) = (start.mean, start.covariance);
    for record in &records {
        let a = transition(&series, record.step);
        let b1 = residual_covariance(&series, record.step, 1, |_| a.clone());
        let b2 = residual_covariance(&series, record.step, 2, |_| &a * &a);
        let w = (&b1 + inverse(&a).congruence(&(&b1 - &b2))).scaled(&ratio(1, 2));
        let v = &b1 - &w - a.congruence(&w);
        let s = a.congruence(&p) + &v;
        let gain = &s * inverse(&(&s + &w));
        mean = &a * &mean + &gain * (&series.readings()[record.step - 1] - &a * &mean);
        p = &s - &gain * &s;
        assert_eq!((&record.belief.mean, &record.belief.covariance), (&mean, &p));
        assert!(!record.process_repaired && !record.observation_repaired);
    }
}
