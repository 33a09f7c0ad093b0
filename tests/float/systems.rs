//! Small systems whose every number is a short dyadic fraction, hence a double.

use exact_kalman::matrix::Matrix;
use exact_kalman::model::{Before, Coefficient, Initial, Input, Noise, Observation, Path, System, Timing};
use exact_kalman::scalar::{Rational, ratio};
use num_traits::ToPrimitive;
use proptest::collection::vec;
use proptest::option::weighted;
use proptest::prelude::*;

/// The doubles of a path of doubles.
pub(crate) fn doubles(path: &Path<Rational>) -> Path<f64> {
    let double = |value: &Rational| {
        let double = value.to_f64().ok_or("no double")?;
        if Rational::from_float(double).as_ref() == Some(value) { Ok(double) } else { Err("not a double") }
    };
    path.try_map(double).expect("every number is a short dyadic fraction")
}

fn matrix(rows: usize, columns: usize, bound: i64, denominator: i64) -> impl Strategy<Value = Matrix<Rational>> {
    vec(-bound..=bound, rows * columns)
        .prop_map(move |entries| Matrix::from_fn(rows, columns, |i, j| ratio(entries[i * columns + j], denominator)))
}

fn per_step(
    steps: usize,
    rows: usize,
    columns: usize,
    bound: i64,
    denominator: i64,
) -> impl Strategy<Value = Vec<Matrix<Rational>>> {
    vec(matrix(rows, columns, bound, denominator), steps)
}

/// A random path in the given timing: everything changes from step to step, noise is shared, inputs act, and a
/// quarter of the entries is missing.
///
/// R and P₀ are at least I and ‖A‖ is at most 3/2: S has a condition number below about 10⁴.
pub(crate) fn paths(timing: Timing) -> impl Strategy<Value = Path<Rational>> {
    moved_paths(timing, 0)
}

/// The same with readings as if each entry of the first state were larger by this.
pub(crate) fn moved_paths(timing: Timing, shift: i64) -> impl Strategy<Value = Path<Rational>> {
    (1usize..=3, 1usize..=3, 1usize..=4, any::<bool>()).prop_flat_map(move |(n, m, steps, early)| {
        let initial = (matrix(n, 1, 8, 2), matrix(n, n, 2, 2));
        let dynamics = (per_step(steps, n, n, 2, 4), per_step(steps, m, n, 4, 4));
        let noise = (per_step(steps, n, 2, 4, 4), per_step(steps, m, 2, 4, 4));
        let inputs = (per_step(steps, n, 1, 4, 2), per_step(steps, m, 2, 4, 2), per_step(steps, 2, 1, 4, 2));
        let readings = vec(vec(weighted(0.75, (-40i64..40).prop_map(|value| ratio(value, 4))), m), steps);
        (initial, dynamics, noise, inputs, readings).prop_map(move |parts| {
            let ((mean, root), (a, c), (d, f), (u, g, v), readings) = parts;
            let mut moved = Matrix::from_fn(n, 1, |_, _| ratio(shift, 1));
            let readings: Vec<Vec<Option<Rational>>> = (readings.into_iter().zip(a.iter().zip(&c)))
                .map(|(reading, (a, c))| {
                    let seen = c * &moved;
                    moved = a * &moved;
                    reading
                        .into_iter()
                        .zip(seen.entries())
                        .map(|(value, more)| value.map(|value| value + more))
                        .collect()
                })
                .collect();
            let before = if timing == Timing::Arriving && early { Before::Transition } else { Before::Observation };
            let covariance = &root * root.transpose() + Matrix::identity(n);
            // The own noise [0 I] of each sensor beside the two shared sources keeps S away from singular.
            let own = |shared: Matrix<Rational>, own: Matrix<Rational>| shared.beside(&own);
            let process = d.into_iter().map(|d| own(d, Matrix::zeros(n, m)));
            let observation = f.into_iter().map(|f| own(f, Matrix::identity(m)));
            let system = System {
                timing,
                initial: Initial::new(before, mean, covariance),
                transition: Coefficient::per_step(a),
                observation: Coefficient::per_step(c),
                noise: Noise::Factors {
                    process: Coefficient::per_step(process),
                    observation: Coefficient::per_step(observation),
                },
                input: Some(Input { matrix: None, vector: Coefficient::per_step(u) }),
                observation_input: Some(Input {
                    matrix: Some(Coefficient::per_step(g)),
                    vector: Coefficient::per_step(v),
                }),
            };
            let readings: Vec<_> = readings.into_iter().map(Observation::new).collect();
            system.realised(&readings).expect("a valid system")
        })
    })
}

/// Two equal sensors on one of two states; from the reading `quiet` on they have no noise.
pub(crate) fn twin_sensors(quiet: usize, readings: &[i64]) -> Path<Rational> {
    let noise = |k: usize| if k < quiet { Matrix::identity(2) } else { Matrix::zeros(2, 2) };
    let covariances = (0..readings.len()).map(noise);
    let system = System {
        timing: Timing::Departing,
        initial: Initial::new(
            Before::Observation,
            Matrix::zeros(2, 1),
            Matrix::from_integers(&[[3, 1], [1, 5]]).scaled(&ratio(7, 8)),
        ),
        transition: Matrix::from_integers(&[[1, 1], [0, 1]]).into(),
        observation: Matrix::from_integers(&[[1, 0], [1, 0]]).into(),
        noise: Noise::Covariances {
            process: Matrix::identity(2).scaled(&ratio(3, 16)).into(),
            cross: None,
            observation: Coefficient::per_step(covariances),
        },
        input: None,
        observation_input: None,
    };
    let twins = |&value: &i64| Observation::complete(vec![ratio(value, 1); 2]);
    let readings: Vec<_> = readings.iter().map(twins).collect();
    system.realised(&readings).expect("a valid system")
}
