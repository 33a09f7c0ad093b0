//! The answers to perturbed problems, at a cost that grows with the number of steps and not with its cube.
//!
//! Exact numbers lengthen with every step, and full significands make perturbed problems the worst of all. But of a
//! perturbed answer only its distance from the truth is wanted, some 2⁻⁵³, so the state is rounded to 2048 bits every
//! few steps: far less than the data were moved, even where numbers cancel that lie as far apart as doubles can.

use super::reference::BITS;
use crate::filter::{Effort, RationalFilter, RationalStep, StepValues};
use crate::model::{Before, Initial, Path, Timing};
use crate::scalar::{Precision, Rational};
use crate::trace::Quantity;

/// Bits of the state that are carried on.
const CARRIED: u32 = 2048;

/// How many steps are exact before the state is rounded; more while a diffuse start is not resolved.
const STRETCH: usize = 4;

/// The answer to a problem, up to where it has one.
///
/// Numbers that outgrow `maximal_bits` before a diffuse start is resolved end it, too.
pub(super) fn answer(path: &Path<Rational>, maximal_bits: Option<u64>) -> Vec<StepValues> {
    let effort = Effort { maximal_bits, ..Effort::default() };
    let steps = path.steps();
    let mut initial = path.initial().clone();
    let (mut done, mut length) = (Vec::with_capacity(steps.len()), STRETCH);
    while done.len() < steps.len() {
        let begin = done.len();
        let end = steps.len().min(begin.saturating_add(length));
        // A departing transition shows its effect in the step that follows it.
        let seen = if path.timing() == Timing::Departing { steps.len().min(end + 1) } else { end };
        let stretch = Path::from_parts(path.timing(), initial.clone(), steps[begin..seen].to_vec());
        let carried = |step: RationalStep| step.fractions(Precision::Rounded { bits: CARRIED });
        let mut solved: Vec<_> = RationalFilter::new(&stretch, effort).map_while(Result::ok).map(carried).collect();
        let stopped = solved.len() < seen - begin;
        let next = if stopped || end == steps.len() { None } else { handed_on(&initial, path.timing(), &solved) };
        if next.is_none() && !stopped && end < steps.len() {
            length = length.saturating_mul(2);
            continue;
        }
        solved.truncate(end - begin);
        done.extend(solved.into_iter().map(|step| step.rounded(Precision::Rounded { bits: BITS })));
        match next {
            Some(next) => initial = next,
            None => break,
        }
    }
    done
}

/// The belief with which the next stretch begins; nothing while a diffuse start is not resolved.
fn handed_on(initial: &Initial<Rational>, timing: Timing, solved: &[StepValues]) -> Option<Initial<Rational>> {
    let values = &solved.last()?.values;
    let (before, mean, covariance) = match timing {
        Timing::Arriving => (Before::Transition, Quantity::FilteredMean, Quantity::FilteredCovariance),
        Timing::Departing => (Before::Observation, Quantity::PredictedMean, Quantity::PredictedCovariance),
    };
    let (mean, covariance) = (values.get(&mean)?.clone(), values.get(&covariance)?.clone());
    Some(Initial { before, mean, covariance, diffuse: None, ..initial.clone() })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::filter::filter_rational;
    use crate::judge::data_kind::Moved;
    use crate::judge::perturb::Perturbation;
    use crate::judge::suite;
    use crate::protocol::Expect;
    use crate::scalar::{Scalar as _, ratio};

    /// The same problems, exactly, by the readable recursion in one piece.
    #[test]
    fn rounding_the_state_changes_far_less_than_moving_the_data() {
        let bound = ratio(1, 2).pow(230);
        for case in
            suite().iter().filter(|case| case.expect == Expect::Estimate && !case.flags.contains(&"singular".into()))
        {
            let mut path = case.problem().and_then(|problem| problem.realised()).expect("a case of the suite");
            // Long enough for several stretches, short enough for fractions in lowest terms.
            path = Path::from_parts(
                path.timing(),
                path.initial().clone(),
                path.steps().iter().take(19).cloned().collect(),
            );
            let moved = Perturbation::seeded(7, Moved::all(53)).of(&path);
            let (rounded, exact) =
                (answer(&moved, None), filter_rational(&moved, Effort::default()).expect("data as a model makes them"));
            assert_eq!(rounded.len(), exact.len(), "{}", case.id);
            for (step, (rounded, exact)) in rounded.iter().zip(&exact).enumerate() {
                let exact = exact.fractions(Precision::Rounded { bits: 400 });
                assert_eq!(rounded.innovation_rank, exact.innovation_rank, "{} at step {step}", case.id);
                assert!(rounded.values.keys().eq(exact.values.keys()), "{} at step {step}", case.id);
                for (quantity, matrix) in &exact.values {
                    for (a, b) in rounded.values[quantity].entries().iter().zip(matrix.entries()) {
                        let error = a.minus(b);
                        assert!(
                            error.times(&error) <= b.times(b).times(&bound).times(&bound),
                            "{}: {quantity} at step {step}",
                            case.id
                        );
                    }
                }
            }
        }
    }
}
