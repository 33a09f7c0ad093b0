//! Holds a reply against the truth.

use super::invariants::{asymmetry, indefiniteness};
use super::mistakes::{Outcome as Stand, outcomes};
use super::{Asymmetry, Digits, EntryDigits, Indefiniteness, Reference, Scale, Truth, Verdict, digits};
use crate::matrix::Matrix;
use crate::protocol::{Answer, Expect, Number, Outcome, Reply};
use crate::scalar::Rational;
use crate::trace::{Quantity, Values};

/// The digits of one quantity at the step where it does worst.
#[derive(Clone, Debug, PartialEq)]
pub struct Score {
    /// The quantity.
    pub quantity: Quantity,
    /// The step where digits fall furthest behind the attainable ones, counted from 0.
    pub step: usize,
    /// Its worst entry there.
    pub worst: EntryDigits,
    /// What was attainable there.
    pub attainable: Digits,
    /// The fewest digits at any step.
    pub fewest: Digits,
    /// The fewest attainable digits at any step.
    pub fewest_attainable: Digits,
    /// The worst entry as it was answered.
    pub theirs: Rational,
    /// The worst entry as it is, to more digits than a double has.
    pub exact: Rational,
    /// The verdict on it.
    pub verdict: Verdict,
}

/// The judgement on one case.
#[derive(Clone, Debug)]
pub struct Judgement {
    /// The worst of everything below.
    pub verdict: Verdict,
    /// Whether 15 digits count as attainable because moving the data would destroy the structure of the case.
    pub structural: bool,
    /// One score per quantity that was answered and judged.
    pub scores: Vec<Score>,
    /// The first covariance that is not positive semidefinite, with its step: one beyond rounding, or else one where
    /// only rounding is to blame.
    pub indefinite: Option<(Quantity, usize, Indefiniteness)>,
    /// The first covariance that is not symmetric to the last bit, likewise.
    pub asymmetric: Option<(Quantity, usize, Asymmetry)>,
    /// What there is to say in words: why, and where.
    pub remarks: Vec<String>,
    /// How each known mistake stands to the answer.
    pub(super) mistakes: Vec<Stand>,
}

impl Judgement {
    fn plain(verdict: Verdict, remark: impl Into<String>) -> Self {
        Self { remarks: vec![remark.into()], ..Self::empty(verdict) }
    }

    fn empty(verdict: Verdict) -> Self {
        Self {
            verdict,
            structural: false,
            scores: Vec::new(),
            indefinite: None,
            asymmetric: None,
            remarks: Vec::new(),
            mistakes: Vec::new(),
        }
    }

    /// The judgement on a case to which there is no answer that can be read.
    pub fn unanswered(why: impl Into<String>) -> Self {
        Self::plain(Verdict::Malformed, why)
    }

    /// The judgement on a case that the subject declared to be none for it.
    pub fn unsupported(why: impl Into<String>) -> Self {
        Self::plain(Verdict::Unsupported, why)
    }

    /// The judgement on a reply.
    pub fn of(expect: Expect, truth: &Truth, reply: &Reply) -> Self {
        let answer = match reply {
            Reply::Answer(answer) => answer,
            Reply::TimedOut { .. } => return Self::plain(Verdict::TimedOut, reply.to_string()),
            Reply::Died { .. } | Reply::NotStarted { .. } => return Self::plain(Verdict::Died, reply.to_string()),
            _ => return Self::plain(Verdict::Malformed, reply.to_string()),
        };
        match (truth, expect) {
            (Truth::BadInput(why), Expect::Refuse) => of_bad_input(answer, why),
            (Truth::BadInput(why), _) => {
                Self::plain(Verdict::Undecided, format!("the case is no valid problem: {why}"))
            }
            (Truth::Unknown(why), _) => Self::plain(Verdict::Undecided, format!("the truth is not known: {why}")),
            (Truth::Known(_), Expect::Refuse) => {
                Self::plain(Verdict::Undecided, "the case is to be refused, but it is a valid problem")
            }
            (Truth::Known(reference), Expect::Estimate | Expect::Flag) => of_problem(answer, reference),
        }
    }

    /// How many digits are missing where most are; zero if nothing was scored.
    pub fn shortfall(&self) -> f64 {
        self.scores.iter().map(|score| score.attainable.value() - score.worst.digits.value()).fold(0.0, f64::max)
    }

    fn note(&mut self, verdict: Verdict, remark: impl Into<String>) {
        self.verdict = self.verdict.max(verdict);
        self.remarks.push(remark.into());
    }

    /// Keeps the first violation of each invariant, and the first that rounding does not excuse in its place.
    fn look_at_invariants(
        &mut self,
        quantity: Quantity,
        step: usize,
        theirs: &Matrix<Rational>,
        scale: &Scale,
        attainable: Digits,
    ) {
        let allowed = Verdict::allowed_error(attainable);
        if self.asymmetric.as_ref().is_none_or(|(.., found)| !found.beyond_rounding)
            && let Some(found) = asymmetry(theirs, scale, allowed.as_ref())
            && (found.beyond_rounding || self.asymmetric.is_none())
        {
            if found.beyond_rounding {
                self.verdict = self.verdict.max(Verdict::Asymmetric);
            }
            self.asymmetric = Some((quantity, step, found));
        }
        if self.indefinite.as_ref().is_none_or(|(.., found)| !found.beyond_rounding)
            && let Some(found) = indefiniteness(theirs, scale, allowed.as_ref())
            && (found.beyond_rounding || self.indefinite.is_none())
        {
            if found.beyond_rounding {
                self.verdict = self.verdict.max(Verdict::NotPositiveSemidefinite);
            }
            self.indefinite = Some((quantity, step, found));
        }
    }
}

fn said(answer: &Answer) -> String {
    let step = answer.step.map_or_else(String::new, |step| format!(" at step {step}"));
    let message = answer.message.as_deref().map_or_else(String::new, |text| format!(": {}", excerpt(text)));
    format!("the subject says «{}»{step}{message}", answer.outcome)
}

/// The beginning of a text that came from outside, on one line.
fn excerpt(text: &str) -> String {
    const LENGTH: usize = 200;
    let line: String = text.chars().map(|c| if c.is_control() { ' ' } else { c }).take(LENGTH + 1).collect();
    if line.chars().count() > LENGTH { line.chars().take(LENGTH).chain(['…']).collect() } else { line }
}

fn of_bad_input(answer: &Answer, why: &str) -> Judgement {
    match answer.outcome {
        Outcome::Refused | Outcome::Error | Outcome::Flagged => Judgement::plain(Verdict::Agrees, said(answer)),
        Outcome::Unsupported => Judgement::plain(Verdict::Unsupported, said(answer)),
        Outcome::Answered => {
            Judgement::plain(Verdict::AcceptedBadInput, format!("this should have been refused: {why}"))
        }
    }
}

fn of_problem(answer: &Answer, reference: &Reference) -> Judgement {
    let steps = reference.observed.len();
    let mut judgement = Judgement { structural: reference.structural, ..Judgement::empty(Verdict::Agrees) };
    match (answer.outcome, &reference.contradiction) {
        (Outcome::Unsupported, _) => return Judgement::plain(Verdict::Unsupported, said(answer)),
        (Outcome::Answered, None) => {}
        (Outcome::Answered, Some((step, reason))) => {
            judgement.note(Verdict::AcceptedBadInput, format!("at step {step} {reason}; this was not reported"));
        }
        (outcome, Some((step, _)))
            if answer.step == Some(*step) || (answer.step.is_none() && outcome != Outcome::Error) =>
        {
            judgement.note(Verdict::Agrees, said(answer));
        }
        (Outcome::Error, Some((step, reason))) => {
            judgement.note(Verdict::Error, format!("{}, but it is at step {step} that {reason}", said(answer)));
        }
        (_, Some((step, reason))) => {
            judgement.note(Verdict::Wrong, format!("{}, but it is at step {step} that {reason}", said(answer)));
        }
        (Outcome::Refused | Outcome::Flagged, None) => judgement.note(Verdict::RefusedValidInput, said(answer)),
        (Outcome::Error, None) => judgement.note(Verdict::Error, said(answer)),
    }
    if answer.outcome == Outcome::Answered && answer.steps.len() != steps {
        judgement
            .note(Verdict::Wrong, format!("{} steps are answered, there are {steps} observations", answer.steps.len()));
    }
    for quantity in Quantity::ALL {
        if let Some(score) = score(quantity, &answer.steps, reference, &mut judgement) {
            judgement.verdict = judgement.verdict.max(score.verdict);
            judgement.scores.push(score);
        }
    }
    if answer.outcome == Outcome::Answered && judgement.scores.is_empty() && judgement.verdict == Verdict::Agrees {
        judgement
            .note(Verdict::Wrong, "nothing that is judged was answered: give filtered_mean and filtered_covariance");
    }
    if !judgement.scores.is_empty() {
        judgement.mistakes = outcomes(&answer.steps, reference, judgement.verdict == Verdict::Agrees);
    }
    judgement
}

/// Scores one quantity over all steps, and looks at its invariants.
fn score(
    quantity: Quantity,
    answered: &[Values<Number>],
    reference: &Reference,
    judgement: &mut Judgement,
) -> Option<Score> {
    // A subject that gives a quantity at all is expected to give it at every step where it exists.
    answered.iter().find(|values| values.contains_key(&quantity))?;
    let mut worst: Option<Score> = None;
    let (mut fewest, mut fewest_attainable) = (Digits::EXACT, Digits::EXACT);
    for (step, (theirs, truth)) in answered.iter().zip(&reference.values).enumerate() {
        let (Some(exact), Some(scale)) = (truth.get(&quantity), reference.scale(step, quantity)) else { continue };
        // What is said of a step without a reading must be right, but need not be said.
        if quantity.is_number() && !theirs.contains_key(&quantity) && reference.observed[step].is_empty() {
            continue;
        }
        let attainable = reference.attainable[step].get(&quantity).copied().unwrap_or(Digits::EXACT);
        let finite = match finite(theirs.get(&quantity), exact) {
            Ok(finite) => finite,
            Err(why) => {
                judgement.note(Verdict::Wrong, format!("{quantity} at step {step} {why}"));
                break;
            }
        };
        let entry = digits::digits(quantity, &finite, exact, &scale);
        let verdict = Verdict::on(entry.digits, attainable);
        fewest = fewest.min(entry.digits);
        fewest_attainable = fewest_attainable.min(attainable);
        let place = (entry.row, entry.column);
        let (theirs, exact) = (finite[place].clone(), exact[place].clone());
        let score =
            Score { quantity, step, worst: entry, attainable, fewest, fewest_attainable, theirs, exact, verdict };
        let behind = |score: &Score| score.attainable.value() - score.worst.digits.value();
        if worst.as_ref().is_none_or(|worst| (verdict, behind(&score)) > (worst.verdict, behind(worst))) {
            worst = Some(score);
        }
        if quantity.is_covariance() {
            judgement.look_at_invariants(quantity, step, &finite, &scale, attainable);
        }
    }
    worst.map(|score| Score { fewest, fewest_attainable, ..score })
}

/// The answered matrix as exact numbers, or why it has none.
fn finite(theirs: Option<&Matrix<Number>>, exact: &Matrix<Rational>) -> Result<Matrix<Rational>, String> {
    let Some(theirs) = theirs else { return Err("is missing".into()) };
    if theirs.shape() != exact.shape() {
        return Err(format!("is {} where {} is needed", theirs.shape(), exact.shape()));
    }
    theirs.try_map(|entry| match entry {
        Number::Finite(value) => Ok(value.clone()),
        other => Err(format!("has an entry {other}")),
    })
}
