//! Why so few digits are attainable: which data are to blame.

use std::fmt;

use super::data_kind::{DataKind, Moved};
use super::reference::moved_bits;
use super::{Digits, Reference};
use crate::model::Path;
use crate::protocol::Numbers;
use crate::scalar::Rational;
use crate::trace::Quantity;

/// A kind of data is to blame if moving it alone leaves at most this many digits more than moving all does.
const BLAME: f64 = 0.5;

/// The quantity of which the fewest digits are attainable, and what is left of it where data of one kind alone are moved.
///
/// It costs another twenty perturbed problems for each kind of data, so it is computed where somebody asks.
///
/// # Examples
///
/// Two readings near 10⁶ that differ by one: the difference keeps six digits less than they have.
///
/// ```
/// use exact_kalman::judge::{DataKind, Reference, Sensitivity};
/// use exact_kalman::protocol::{Case, Numbers};
///
/// let case = Case::parse(r#"{"format":"exact-kalman/case/1","id":"far","timing":"departing",
///     "initial":{"before":"observation","mean":["1048576"],"covariance":[["1"]]},
///     "transition":[["1"]],"observation":[["1"]],
///     "noise":{"process":[["0"]],"observation":[["1"]]},"observations":[["1048577"]]}"#)?;
/// let path = case.problem()?.realised()?;
/// let sensitivity = Sensitivity::of(&path, Numbers::Binary64, &Reference::of(&path)?).ok_or("nothing is lost")?;
/// assert!(sensitivity.attainable.value() < 10.0);
/// assert!(sensitivity.to_blame().contains(&DataKind::Reading));
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Clone, Debug, PartialEq)]
pub struct Sensitivity {
    /// The quantity.
    pub quantity: Quantity,
    /// The step, counted from 0.
    pub step: usize,
    /// What is attainable there.
    pub attainable: Digits,
    /// What is left where data of one kind alone are moved; nothing if no such problem kept the structure of the case.
    pub alone: Vec<(DataKind, Option<Digits>)>,
}

impl Sensitivity {
    /// Finds it; nothing if there is nothing of which any digit could be lost.
    pub fn of(path: &Path<Rational>, numbers: Numbers, reference: &Reference) -> Option<Self> {
        Self::among(&Quantity::ALL, path, numbers, reference)
    }

    /// The same for one quantity: at the step where the fewest digits of it are attainable.
    pub fn of_quantity(
        quantity: Quantity,
        path: &Path<Rational>,
        numbers: Numbers,
        reference: &Reference,
    ) -> Option<Self> {
        Self::among(&[quantity], path, numbers, reference)
    }

    fn among(quantities: &[Quantity], path: &Path<Rational>, numbers: Numbers, reference: &Reference) -> Option<Self> {
        let places =
            reference.attainable.iter().enumerate().flat_map(|(step, digits)| {
                digits.iter().map(move |(&quantity, &attainable)| (step, quantity, attainable))
            });
        // Of equal ones the first.
        let (step, quantity, attainable) = places
            .filter(|(step, quantity, _)| quantities.contains(quantity) && reference.scale(*step, *quantity).is_some())
            .min_by(|(.., one), (.., other)| one.value().total_cmp(&other.value()))?;
        if attainable == Digits::EXACT {
            return None;
        }
        let alone = DataKind::ALL.map(|kind| {
            let kept = reference.kept_where(path, Moved::only(kind, moved_bits(numbers)));
            (kind, kept.and_then(|kept| kept.get(step)?.get(&quantity).copied()))
        });
        Some(Self { quantity, step, attainable, alone: alone.to_vec() })
    }

    /// The kinds of data that take the digits by themselves, the worst first.
    pub fn to_blame(&self) -> Vec<DataKind> {
        let mut blamed: Vec<(f64, DataKind)> = (self.alone.iter())
            .filter_map(|(kind, digits)| Some((digits.as_ref()?.value(), *kind)))
            .filter(|(digits, _)| *digits <= self.attainable.value() + BLAME)
            .collect();
        blamed.sort_by(|(one, _), (other, _)| one.total_cmp(other));
        blamed.into_iter().map(|(_, kind)| kind).collect()
    }

    /// The fewest digits that data which are not to blame leave.
    fn otherwise(&self) -> Option<Digits> {
        let blamed = self.to_blame();
        let others = self.alone.iter().filter(|(kind, _)| !blamed.contains(kind)).filter_map(|(_, digits)| *digits);
        others.reduce(Digits::min)
    }
}

impl fmt::Display for Sensitivity {
    /// One sentence.
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Self { quantity, step, attainable, .. } = self;
        write!(f, "{quantity} at step {step}: {attainable} digits are attainable, ")?;
        let blamed: Vec<String> = self.to_blame().iter().map(|kind| format!("the {kind}")).collect();
        if blamed.is_empty() {
            return write!(f, "and no kind of data takes them by itself");
        }
        write!(f, "for {} alone leave{} no more", blamed.join(" or "), if blamed.len() == 1 { "s" } else { "" })?;
        match self.otherwise() {
            Some(digits) => write!(f, ", any other data {digits}"),
            None => Ok(()),
        }
    }
}
