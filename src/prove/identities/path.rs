//! Paths of fresh entries.

use crate::matrix::Matrix;
use crate::model::{Before, Initial, Observation, Path, Step, Timing, Transition};
use crate::prove::entries::Entries;
use crate::scalar::Field;

/// A system with n states and m sensors whose every matrix changes at every step, inputs and shared noise included.
pub(super) fn path<F: Field>(
    timing: Timing,
    before: Before,
    [n, m, steps]: [usize; 3],
    entries: &mut Entries<'_, F>,
) -> Path<F> {
    let initial = Initial::new(before, entries.column("mean", n), entries.symmetric("P", n));
    let steps = (0..steps).map(|k| {
        let named = |name: &str| format!("{name}({k})");
        Step {
            transition: Some(Transition {
                matrix: entries.matrix(&named("A"), n, n),
                input: entries.column(&named("Bu"), n),
                noise: entries.symmetric(&named("Q"), n),
                cross_noise: entries.matrix(&named("DFᵀ"), n, m),
            }),
            observation: entries.matrix(&named("C"), m, n),
            observation_input: Matrix::zeros(m, 1),
            observation_noise: entries.symmetric(&named("R"), m),
            reading: Observation::complete(entries.column(&named("y"), m).entries().to_vec()),
        }
    });
    let steps = steps.collect();
    Path::from_parts(timing, initial, steps)
}

/// The same path with the steps changed.
pub(super) fn changed<F: Field>(path: &Path<F>, change: impl Fn(&mut Step<F>)) -> Path<F> {
    let mut steps = path.steps().to_vec();
    steps.iter_mut().for_each(change);
    Path::from_parts(path.timing(), path.initial().clone(), steps)
}

/// What a slip leaves out.
pub(super) fn without_shared_noise<F: Field>(step: &mut Step<F>) {
    if let Some(transition) = &mut step.transition {
        transition.cross_noise = Matrix::zeros(transition.cross_noise.rows(), transition.cross_noise.columns());
    }
}
