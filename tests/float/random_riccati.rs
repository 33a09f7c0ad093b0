//! The random equation of Riccati in `f64`, judged by the digits that the data allow, as in [`crate::steady`].

use exact_kalman::float::{FloatMatrixError, FloatMode, expected_covariances, gramian};
use exact_kalman::matrix::Matrix;
use exact_kalman::scalar::{Rational, ratio};
use exact_kalman::stability::Mode;
use proptest::prelude::*;

use crate::steady::{ALLOWED, Q, Signs, attainable, definite, digits, doubles, matrices, rational};

type Data = [Q; 4];

fn data(d: usize, m: usize) -> impl Strategy<Value = Data> {
    (matrices(d, d), matrices(m, d), definite(d), definite(m)).prop_map(|(f, h, q, r)| [f, h, q, r])
}

fn mode([f, h, q, r]: &Data) -> Mode<Rational> {
    Mode::new(f.clone(), h.clone(), q.clone(), r.clone()).expect("covariances")
}

fn float_mode(data: &Data) -> FloatMode {
    let [transition, observation, process_noise, observation_noise] = [0, 1, 2, 3].map(|i| doubles(&data[i]));
    FloatMode { transition, observation, process_noise, observation_noise }
}

fn moved([f, h, q, r]: &Data, signs: &mut Signs) -> Data {
    [signs.moved(f), signs.moved(h), signs.moved_symmetric(q), signs.moved_symmetric(r)]
}

/// E P(3) of two modes that follow a chain, path by path.
fn expected(modes: &[Data], law: &[Rational], chain: &Q, start: &Q) -> Q {
    let modes: Vec<_> = modes.iter().map(mode).collect();
    let mut sum = Matrix::zeros(start.rows(), start.rows());
    for path in (0..8_usize).map(|bits| [0, 1, 2].map(|time| bits >> time & 1)) {
        let weight = &law[path[0]] * &chain[(path[0], path[1])] * &chain[(path[1], path[2])];
        let end = path.iter().fold(start.clone(), |covariance, &mode| modes[mode].step(&covariance).next);
        sum = sum + end.scaled(&weight);
    }
    sum
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 48, failure_persistence: None, ..ProptestConfig::default() })]

    /// WG-1: one step.
    #[test]
    fn steps_keep_their_digits((data, start) in (1usize..=3, 1usize..=2).prop_flat_map(|(d, m)| (data(d, m), definite(d)))) {
        let exact = mode(&data).step(&start).next;
        let found = float_mode(&data).step(&doubles(&start)).expect("R > 0");
        prop_assert_eq!(found.asymmetry(), None);
        let attainable = attainable(&exact, |signs| Some(mode(&moved(&data, signs)).step(&signs.moved_symmetric(&start)).next));
        let digits = digits(&rational(&found), &exact);
        prop_assert!(digits >= attainable - ALLOWED, "{digits:.1} digits of {attainable:.1}");
    }

    /// WG-6: the Gramian of three modes.
    #[test]
    fn gramians_keep_their_digits(window in (1usize..=3).prop_flat_map(|d| prop::collection::vec(data(d, 2), 3))) {
        let of = |window: &[Data]| {
            let stacked = window.iter().fold((Matrix::identity(window[0][0].rows()), None::<Q>), |(phi, rows), [f, h, ..]| {
                let row = h * &phi;
                (f * phi, Some(rows.map_or(row.clone(), |rows| rows.above(&row))))
            });
            let stacked = stacked.1.expect("three modes");
            stacked.transpose() * stacked
        };
        let exact = of(&window);
        // A state that is never seen has no size to scale by.
        prop_assume!((0..exact.rows()).all(|i| exact[(i, i)] > ratio(0, 1)));
        let found = gramian(&window.iter().map(float_mode).collect::<Vec<_>>()).expect("finite");
        prop_assert_eq!(found.asymmetry(), None);
        let attainable = attainable(&exact, |signs| Some(of(&window.iter().map(|data| moved(data, signs)).collect::<Vec<_>>())));
        let digits = digits(&rational(&found), &exact);
        prop_assert!(digits >= attainable - ALLOWED, "{digits:.1} digits of {attainable:.1}");
    }
}

proptest! {
    // Each case takes twenty-one exact means.
    #![proptest_config(ProptestConfig { cases: 6, failure_persistence: None, ..ProptestConfig::default() })]

    /// WG-1: the mean over all paths of three steps.
    #[test]
    fn expectations_keep_their_digits((one, other, start) in (1usize..=2).prop_flat_map(|d| (data(d, 1), data(d, 1), definite(d)))) {
        let modes = [one, other];
        let law = [ratio(1, 4), ratio(3, 4)];
        let chain = Matrix::from_rows(vec![vec![ratio(1, 2), ratio(1, 2)], vec![ratio(1, 8), ratio(7, 8)]]).expect("square");
        let exact = expected(&modes, &law, &chain, &start);
        let floats: Vec<FloatMode> = modes.iter().map(float_mode).collect();
        let found = expected_covariances(&floats, &[0.25, 0.75], &doubles(&chain), &doubles(&start), 3).expect("R > 0");
        prop_assert_eq!(found.len(), 4);
        prop_assert_eq!(&found[0], &doubles(&start));
        let attainable = attainable(&exact, |signs| {
            let moved: Vec<Data> = modes.iter().map(|data| moved(data, signs)).collect();
            Some(expected(&moved, &law, &chain, &signs.moved_symmetric(&start)))
        });
        let digits = digits(&rational(&found[3]), &exact);
        prop_assert!(digits >= attainable - ALLOWED, "{digits:.1} digits of {attainable:.1}");
    }
}

#[test]
fn a_singular_innovation_is_an_error() {
    let number = |value: f64| Matrix::column(vec![value]);
    let mode = FloatMode {
        transition: number(1.0),
        observation: number(0.0),
        process_noise: number(1.0),
        observation_noise: number(0.0),
    };
    assert_eq!(mode.step(&number(1.0)), Err(FloatMatrixError::Singular));
    let overflow = FloatMode { transition: number(1e200), observation_noise: number(1.0), ..mode };
    assert_eq!(overflow.step(&number(1.0)), Err(FloatMatrixError::NotFinite));
    // Paths of probability zero are not walked.
    let chain = Matrix::from_rows(vec![vec![1.0]]).expect("square");
    assert_eq!(expected_covariances(&[overflow], &[0.0], &chain, &number(1.0), 1), Ok(vec![number(1.0), number(0.0)]));
}
