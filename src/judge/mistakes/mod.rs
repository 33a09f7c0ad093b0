//! Known mistakes: what wrong filters answer, and whether an answer is that.
//!
//! A mistake is a page for people and one or more wrong filters. These are evaluated in three ways: as the right
//! answer, rearranged; as the right filter of another problem; as a recursion with one wrong line. The last two run on
//! numbers of 512 bits, which is exact as far as 17 digits can tell. Whether an answer meets a mistake is decided in
//! `meeting`, and nowhere else.

mod catalogue;
mod comparison;
mod fault;
mod inverse;
mod meeting;
mod own_scale;
mod page;
mod problem;
mod real;
mod rearrangement;
mod recursion;

use std::ops::ControlFlow;
use std::sync::{LazyLock, OnceLock};

pub(super) use meeting::Outcome;
pub use page::mistakes_page;

use super::Reference;
use crate::model::Path;
use crate::protocol::Number;
use crate::scalar::Rational;
use crate::trace::{Quantity, Values};
use comparison::Comparison;
use fault::Fault;
use rearrangement::Rearrangement;
use recursion::Recursion;

/// Whether something is wrong, or read in another way than the case says.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum Kind {
    /// The answer belongs to no problem that anybody meant.
    Mistake,
    /// The answer is right if the case, or the answer, is read by another convention: of start, timing, index or sign.
    Reading,
}

impl Kind {
    /// The name.
    pub const fn name(self) -> &'static str {
        match self {
            Self::Mistake => "mistake",
            Self::Reading => "reading",
        }
    }
}

/// A mistake that filters are known to make, or a convention that they are known to follow.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Mistake {
    /// The name: words joined by hyphens.
    pub name: &'static str,
    /// Whether it is a mistake or a reading.
    pub kind: Kind,
    /// What is done, said to whoever does it: "you return …", without a full stop.
    pub sentence: &'static str,
    /// How it typically comes about.
    pub cause: &'static str,
    /// What comes of it.
    pub effect: &'static str,
    /// What to do.
    pub remedy: &'static str,
}

/// The catalogue, in order: what is done to answers, how cases are read, what is done to the model, what goes wrong in
/// the recursion.
///
/// # Examples
///
/// ```
/// use exact_kalman::judge::{mistake, mistakes};
///
/// assert!(mistakes().len() >= 30);
/// let page = mistake("predicted-for-filtered").expect("a mistake of the catalogue");
/// assert_eq!(page.sentence, "you return the predicted moments where the filtered ones are asked");
/// ```
pub fn mistakes() -> &'static [Mistake] {
    &CATALOGUE.mistakes
}

/// The mistake of a name.
pub fn mistake(name: &str) -> Option<&'static Mistake> {
    mistakes().iter().find(|mistake| mistake.name == name)
}

/// A wrong filter.
enum Wrong {
    /// The right answer, rearranged.
    Answer(Rearrangement),
    /// The right filter of another problem.
    Problem(problem::Change),
    /// A recursion with one wrong line.
    Recursion(Fault),
    /// Everything computed in single precision.
    SinglePrecision,
}

/// One way to make a mistake.
pub(super) struct Hypothesis {
    /// The place of the mistake in the catalogue.
    pub(super) mistake: usize,
    /// Which of its ways this is, if it has several.
    pub(super) label: String,
    /// Whether it does less than the way before it: where that does not show, this does not.
    fades: bool,
    wrong: Wrong,
}

impl Hypothesis {
    fn is_rounding(&self) -> bool {
        matches!(self.wrong, Wrong::Answer(rearrangement) if rearrangement.is_rounding())
    }

    /// Shows what the mistake makes of a case, step by step, until it was seen enough of; nothing at all where the mistake
    /// changes nothing, or makes no sense.
    fn show(&self, reference: &Reference, see: &mut dyn FnMut(&Values<Rational>) -> ControlFlow<()>) {
        match &self.wrong {
            Wrong::Answer(rearrangement) => {
                let _ = (0..).map_while(|step| rearrangement.of(reference, step)).try_for_each(|values| see(&values));
            }
            Wrong::Problem(change) => {
                if let Some(other) = change(&reference.path).filter(|other| *other != reference.path) {
                    follow(&other, &Fault::None, see);
                }
            }
            Wrong::Recursion(fault) => follow(&reference.path, fault, see),
            Wrong::SinglePrecision => {}
        }
    }
}

fn follow(path: &Path<Rational>, fault: &Fault, see: &mut dyn FnMut(&Values<Rational>) -> ControlFlow<()>) {
    let _ = Recursion::new(path, fault).into_iter().flatten().try_for_each(|values| see(&values));
}

struct Catalogue {
    mistakes: Vec<Mistake>,
    hypotheses: Vec<Hypothesis>,
}

static CATALOGUE: LazyLock<Catalogue> = LazyLock::new(|| {
    let mut catalogue = Catalogue { mistakes: Vec::new(), hypotheses: Vec::new() };
    for (page, ways) in catalogue::entries() {
        let mistake = catalogue.mistakes.len();
        catalogue.mistakes.push(page);
        let way = |catalogue::Way { label, fades, wrong }| Hypothesis { mistake, label, fades, wrong };
        catalogue.hypotheses.extend(ways.into_iter().map(way));
    }
    catalogue
});

/// Every way to make every mistake, in the order of the catalogue.
pub(super) fn hypotheses() -> &'static [Hypothesis] {
    &CATALOGUE.hypotheses
}

/// What shows in answers that give certain quantities at so many steps, where a right one is among them: it shows in each.
#[derive(Clone, Debug, Default)]
pub(super) struct Shown(OnceLock<(Vec<Vec<Quantity>>, Vec<Outcome>)>);

/// How each hypothesis stands to an answer; nothing where nothing can be compared.
///
/// A right answer meets none (`meeting` has the reason), so what shows in it is worked out once for a case.
pub(super) fn outcomes(steps: &[Values<Number>], reference: &Reference, is_right: bool) -> Vec<Outcome> {
    let comparison = Comparison::of(steps, reference);
    if comparison.is_empty() {
        return Vec::new();
    }
    if !is_right {
        return against_all(&comparison);
    }
    let given = comparison.quantities();
    let (of, outcomes) = reference.shown.0.get_or_init(|| (given.clone(), against_all(&comparison)));
    if *of == given { outcomes.clone() } else { against_all(&comparison) }
}

fn against_all(comparison: &Comparison) -> Vec<Outcome> {
    let mut outcomes: Vec<Outcome> = Vec::with_capacity(hypotheses().len());
    for hypothesis in hypotheses() {
        outcomes.push(match (outcomes.last(), &hypothesis.wrong) {
            (Some(Outcome::Silent), _) if hypothesis.fades => Outcome::Silent,
            (_, Wrong::SinglePrecision) => meeting::in_single_precision(comparison),
            _ => meeting::outcome(hypothesis, comparison),
        });
    }
    outcomes
}

#[cfg(test)]
mod tests;
