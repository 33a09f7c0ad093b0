//! An answer beside the truth, place by place.

use crate::judge::digits::log2;
use crate::judge::verdict::ALLOWED_LOSS;
use crate::judge::{Digits, Reference, Scale};
use crate::matrix::Matrix;
use crate::protocol::Number;
use crate::scalar::Rational;
use crate::trace::{Quantity, Values};

/// More bits than a double has.
const HOLDS: f64 = 60.0;

/// An answer beside the truth.
pub(super) struct Comparison<'a> {
    pub(super) reference: &'a Reference,
    /// Per step that is answered, the places that are judged.
    pub(super) steps: Vec<Vec<Place<'a>>>,
}

/// A quantity at a step.
pub(super) struct Place<'a> {
    pub(super) quantity: Quantity,
    pub(super) exact: &'a Matrix<Rational>,
    /// What is answered, if it has the right shape and is finite.
    pub(super) theirs: Option<Matrix<Rational>>,
    /// The digits of a right answer: two fewer than attainable.
    pub(super) right: f64,
    pub(super) scale: Scale,
    /// The units of the entries, as binary logarithms; for a vector one per row.
    units: Vec<f64>,
}

impl<'a> Comparison<'a> {
    /// Quantities that are answered somewhere are expected everywhere.
    pub(super) fn of(answered: &[Values<Number>], reference: &'a Reference) -> Self {
        let answers = |quantity: &Quantity| answered.iter().any(|values| values.contains_key(quantity));
        let quantities: Vec<Quantity> = Quantity::ALL.into_iter().filter(answers).collect();
        let steps = answered.iter().zip(&reference.values).enumerate();
        let places = |(step, (theirs, truth)): (usize, (&Values<Number>, &'a Values<Rational>))| {
            let place = |&quantity: &Quantity| Place::of(quantity, step, theirs, truth, reference);
            quantities.iter().filter_map(place).collect()
        };
        Self { reference, steps: steps.map(places).collect() }
    }

    /// The quantities that are compared, per step.
    pub(super) fn quantities(&self) -> Vec<Vec<Quantity>> {
        self.steps.iter().map(|places| places.iter().map(|place| place.quantity).collect()).collect()
    }

    /// Whether there is nothing to compare.
    pub(super) fn is_empty(&self) -> bool {
        self.steps.iter().all(Vec::is_empty)
    }
}

impl<'a> Place<'a> {
    fn of(
        quantity: Quantity,
        step: usize,
        theirs: &Values<Number>,
        truth: &'a Values<Rational>,
        reference: &Reference,
    ) -> Option<Self> {
        let exact = truth.get(&quantity)?;
        let scale = reference.scale(step, quantity)?;
        let attainable = reference.attainable.get(step).and_then(|kept| kept.get(&quantity));
        let right = attainable.copied().unwrap_or(Digits::EXACT).value() - ALLOWED_LOSS;
        let half = |i: usize| magnitude(scale.variance(i)) / 2.0;
        let units = if quantity.is_vector() {
            (0..exact.rows()).map(|i| magnitude(&exact[(i, 0)]).max(half(i))).collect()
        } else {
            let (rows, columns) = (exact.rows(), exact.columns());
            (0..rows).flat_map(|i| (0..columns).map(move |j| half(i) + half(j))).collect()
        };
        let finite = |theirs: &Matrix<Number>| {
            theirs.try_map(|entry| if let Number::Finite(value) = entry { Ok(value.clone()) } else { Err(()) }).ok()
        };
        let theirs = theirs.get(&quantity).filter(|theirs| theirs.shape() == exact.shape()).and_then(finite);
        Some(Self { quantity, exact, theirs, right, scale, units })
    }

    /// Whether a covariance has a variance that is nothing beside the exact one: less than a double of its size can hold.
    pub(super) fn vanishes(&self, claimed: &Matrix<Rational>) -> bool {
        let nothing = |i: usize| magnitude(&claimed[(i, i)]) < magnitude(&self.exact[(i, i)]) - HOLDS;
        self.quantity.is_covariance() && (0..self.exact.rows()).any(nothing)
    }

    /// The digits of one matrix against another in the units of the truth: those of [`digits`](crate::judge::digits) up to
    /// rounding, and faster.
    pub(super) fn digits(&self, a: &Matrix<Rational>, b: &Matrix<Rational>) -> f64 {
        let entry = |((a, b), unit): ((&Rational, &Rational), &f64)| {
            let error = a.numer() * b.denom() - b.numer() * a.denom();
            if error.sign() == num_bigint::Sign::NoSign {
                return Digits::EXACT.value();
            }
            let error = log2(&error) - log2(a.denom()) - log2(b.denom());
            // Where nothing sets a scale the exact value is the only one with a right digit.
            if unit.is_finite() { (unit - error) * std::f64::consts::LOG10_2 } else { 0.0 }
        };
        a.entries().iter().zip(b.entries()).zip(&self.units).map(entry).fold(Digits::EXACT.value(), f64::min)
    }
}

/// log₂|x|, −∞ for zero.
fn magnitude(value: &Rational) -> f64 {
    if value.numer().sign() == num_bigint::Sign::NoSign {
        return f64::NEG_INFINITY;
    }
    log2(value.numer()) - log2(value.denom())
}
