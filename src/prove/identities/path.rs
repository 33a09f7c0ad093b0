//! Paths of fresh entries.

use crate::matrix::Matrix;
use crate::model::{Before, Initial, Observation, Path, Step, Timing, Transition};
use crate::prove::body::Numbers;
use crate::prove::entries::Entries;
use crate::scalar::Field;

/// A system with n states and m sensors whose every matrix changes at every step, inputs and shared noise included; every Σ is regular.
pub(super) fn path<F: Field>(timing: Timing, [n, m, steps, ..]: Numbers, entries: &mut Entries<'_, F>) -> Path<F> {
    singular_path(timing, [n, m, steps, m, 0], entries)
}

/// The same where every innovation is Lν, so that its covariance Σ has the given rank; `known` directions of the start have variance zero.
///
/// L = [I; L₂] has `rank` columns: the first readings determine the others, which is no restriction but on their order. Likewise the start
/// has the covariance [I; W]P[I; W]ᵀ. At the first step a reading may also see what is known for certain, through a matrix whose
/// kernel holds the rest; and in arriving timing its noise may cancel that of a known state.
pub(super) fn singular_path<F: Field>(
    timing: Timing,
    [n, m, steps, rank, known]: Numbers,
    entries: &mut Entries<'_, F>,
) -> Path<F> {
    let before = match timing {
        Timing::Arriving => Before::Transition,
        Timing::Departing => Before::Observation,
    };
    let dependence = entries.matrix("W", known, n - known);
    let (mean, core) = (entries.column("mean", n), entries.symmetric("P", n - known));
    let covariance = Matrix::identity(n - known).above(&dependence).congruence(&core);
    let mut steps: Vec<_> = (0..steps).map(|k| step(&k.to_string(), [n, m, 1, rank, 0], entries)).collect();
    if let (Some(first), true) = (steps.first_mut(), known > 0) {
        see_what_is_known(first, timing, &dependence, &mean, [n, m, 1, rank, known], entries);
    }
    Path::from_parts(timing, Initial::new(before, mean, covariance), steps)
}

fn step<F: Field>(k: &str, [n, m, _, rank, _]: Numbers, entries: &mut Entries<'_, F>) -> Step<F> {
    let named = |name: &str| format!("{name}({k})");
    let l = Matrix::identity(rank).above(&entries.matrix(&named("L"), m - rank, rank));
    let observation_input = entries.column(&named("Gv"), m);
    Step {
        transition: Some(Transition {
            matrix: entries.matrix(&named("A"), n, n),
            input: entries.column(&named("Bu"), n),
            noise: entries.symmetric(&named("Q"), n),
            cross_noise: entries.matrix(&named("DFᵀ"), n, rank) * l.transpose(),
        }),
        observation: &l * entries.matrix(&named("C"), rank, n),
        observation_noise: l.congruence(&entries.symmetric(&named("R"), rank)),
        reading: Observation::complete(
            (&l * entries.column(&named("y"), rank) + &observation_input).entries().to_vec(),
        ),
        observation_input,
    }
}

/// Adds EZ to C, where ZP = 0 for the covariance P = [I; W]P₁[I; W]ᵀ of what is observed but for noise; the reading moves with its mean.
fn see_what_is_known<F: Field>(
    step: &mut Step<F>,
    timing: Timing,
    dependence: &Matrix<F>,
    mean: &Matrix<F>,
    [n, m, _, rank, known]: Numbers,
    entries: &mut Entries<'_, F>,
) {
    let Some(transition) = &mut step.transition else { return };
    // The kernel of [I; W]ᵀ, as rows.
    let annihilator = |w: &Matrix<F>| (-w).beside(&Matrix::identity(known));
    let extra = Matrix::zeros(rank, known).above(&entries.matrix("E", m - rank, known));
    let (added, seen) = match timing {
        Timing::Departing => (extra * annihilator(dependence), mean.clone()),
        Timing::Arriving => {
            // A leads [I; W] to [I; W₁]T.
            let after = entries.matrix("W₁", known, n - known);
            let free = transition.matrix.clone();
            let led = Matrix::identity(n - known).above(&after) * free.block(0..n - known, 0..n - known);
            let start = Matrix::identity(n - known).beside(&Matrix::zeros(n - known, known));
            transition.matrix = led * start + free.block(0..n, n - known..n) * annihilator(dependence);
            (extra * annihilator(&after), &transition.matrix * mean + &transition.input)
        }
    };
    let values = Matrix::column(step.reading.values().entries().to_vec()) + &added * seen;
    step.reading = Observation::complete(values.entries().to_vec());
    step.observation = &step.observation + &added;
    if timing == Timing::Arriving {
        // The noise that enters is w, so what the added rows see of it is taken back.
        let mixed = &added * &transition.cross_noise;
        step.observation_noise =
            &step.observation_noise - &mixed - mixed.transpose() + added.congruence(&transition.noise);
        transition.cross_noise = &transition.cross_noise - &transition.noise * added.transpose();
    }
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
