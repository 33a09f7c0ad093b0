//! When an answer meets a mistake: the one place where that is decided.
//!
//! A *place* is a quantity at a step. The judge compares three matrices there: the truth T, what the mistake makes of
//! it, W, and what is answered, A. An answer is right there with a digits, the attainable ones less 2.
//!
//! * A mistake **shows** at a place if W has at least 4 digits fewer than a right answer, counted against T: so many
//!   that the answer of a program that makes this mistake can be told from a right one by 4 digits.
//! * It is **met** if it shows somewhere, and
//!   1. at *every* place A has 6 digits against W, or as many as a right answer has, if that is less;
//!   2. at every place where it shows, A is closer to W than T is by at least 2 digits;
//!   3. where it shows most, by at least 4.
//! * It is **missed** if it shows and is not met; it is **silent** if it does not show.
//!
//! 2, 4 and 6 are the constants of the [verdicts](crate::judge::Verdict); there is no other.
//!
//! *No right answer meets a mistake.* At a place where W shows, T has d digits against W; A would have d + 2 at least,
//! so d against T up to the third part of a unit: at least 3 fewer than a right answer.
//!
//! *No chance meets one.* A wrong answer must have 6 digits of a wrong number everywhere, and where these are nearly
//! right, be two digits nearer to it than the truth, at every quantity of every step at which it shows.
//!
//! Digits against W are counted in units of W itself in (1), so that what is very small is not met by zero, and in
//! units of T in (2) and (3), like all others.
//!
//! Zero is no evidence: a variance that a mistake makes zero is met by whatever cancels. So a mistake does not show in
//! covariances with a variance of W that is nothing beside that of T; (1) is asked of them all the same.
//!
//! Rounding to few digits is done by the last line of a program: what it prints is known to 15 digits whatever the case
//! makes attainable, so W shows by 4 fewer than that, and (1) asks for 13.

use std::ops::ControlFlow;

use super::Hypothesis;
use super::comparison::{Comparison, Place};
use super::own_scale::own_scale;
use super::rearrangement::Rearrangement;
use crate::judge::digits;
use crate::judge::verdict::{ALLOWED_LOSS, FAIR_FROM, WRONG_BELOW};
use crate::matrix::Matrix;
use crate::scalar::Rational;
use crate::trace::Values;

/// How a mistake stands to an answer.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(in crate::judge) enum Outcome {
    /// It does not show in what is answered.
    Silent,
    /// The answer is what this mistake makes of the case.
    Met,
    /// The mistake shows, and the answer is not what it makes of the case.
    Missed,
}

/// The digits of a number that was printed as a double.
const PRINTED: f64 = 15.0;

/// How a mistake stands to an answer; as few steps of it are computed as that takes.
pub(super) fn outcome(hypothesis: &Hypothesis, comparison: &Comparison) -> Outcome {
    let precision = if hypothesis.is_rounding() { Some(PRINTED) } else { None };
    let mut meeting = Meeting { comparison, precision, step: 0, shows: false, met: true, most: None };
    hypothesis.show(comparison.reference, &mut |wrong| meeting.see(wrong));
    match meeting.most {
        _ if !meeting.shows => Outcome::Silent,
        Some((_, closer)) if meeting.met && closer >= WRONG_BELOW => Outcome::Met,
        _ => Outcome::Missed,
    }
}

/// A mistake and an answer, held against each other step by step.
struct Meeting<'a> {
    comparison: &'a Comparison<'a>,
    precision: Option<f64>,
    step: usize,
    shows: bool,
    met: bool,
    /// Where the mistake shows most: by how many digits, and how much closer the answer is to it.
    most: Option<(f64, f64)>,
}

impl Meeting<'_> {
    fn see(&mut self, wrong: &Values<Rational>) -> ControlFlow<()> {
        let Some(places) = self.comparison.steps.get(self.step) else { return ControlFlow::Break(()) };
        for place in places {
            if let Some(claimed) = wrong.get(&place.quantity) {
                self.see_place(place, claimed, wrong);
            }
        }
        self.step += 1;
        if self.shows && !self.met { ControlFlow::Break(()) } else { ControlFlow::Continue(()) }
    }

    fn see_place(&mut self, place: &Place, claimed: &Matrix<Rational>, wrong: &Values<Rational>) {
        if claimed.shape() != place.exact.shape() {
            // Another number of sensors: no unit is known for what they say.
            return;
        }
        let apart = place.digits(claimed, place.exact);
        let least = self.precision.unwrap_or(place.right) - WRONG_BELOW;
        let shows = apart < place.right && apart <= least && !place.vanishes(claimed);
        self.shows |= shows;
        if !self.met {
            return;
        }
        let Some(theirs) = &place.theirs else {
            self.met = false;
            return;
        };
        let own = own_scale(place.quantity, wrong, &place.scale);
        let digits = digits::digits(place.quantity, theirs, claimed, &own).digits.value();
        // What is printed with few digits is those digits, everywhere.
        let enough = self.precision.map_or(place.right.min(FAIR_FROM), |printed| printed - ALLOWED_LOSS);
        self.met = digits >= enough;
        if self.met && shows {
            let closer = place.digits(theirs, claimed) - apart;
            self.met = closer >= ALLOWED_LOSS;
            let behind = place.right - apart;
            if self.most.is_none_or(|(most, _)| behind > most) {
                self.most = Some((behind, closer));
            }
        }
    }
}

/// How computing in single precision stands to an answer: all its numbers are singles, and none of the others would be.
///
/// No answer can be predicted, since rounding goes another way in each program. So (1) is that every place has the digits
/// that a right answer would keep of 24 bits instead of 53, and (2) and (3) that every number answered is a single,
/// where those nearest to the truth do not do.
pub(super) fn in_single_precision(comparison: &Comparison) -> Outcome {
    let lost = f64::from(f64::MANTISSA_DIGITS - f32::MANTISSA_DIGITS) * std::f64::consts::LOG10_2;
    let (mut shows, mut met) = (false, true);
    for (step, places) in comparison.steps.iter().enumerate() {
        let Some(nearest) = Rearrangement::Single.of(comparison.reference, step) else { break };
        for place in places {
            let Some(nearest) = nearest.get(&place.quantity) else { continue };
            let apart = place.digits(nearest, place.exact);
            shows |= apart < place.right && apart <= PRINTED - WRONG_BELOW;
            met = met
                && place.theirs.as_ref().is_some_and(|theirs| {
                    theirs.entries().iter().all(is_single) && place.digits(theirs, place.exact) >= place.right - lost
                });
        }
        if shows && !met {
            return Outcome::Missed;
        }
    }
    match (shows, met) {
        (false, _) => Outcome::Silent,
        (true, true) => Outcome::Met,
        (true, false) => Outcome::Missed,
    }
}

fn is_single(value: &Rational) -> bool {
    let nearest = f64::from(crate::scalar::nearest_single(value));
    crate::scalar::exact_value(nearest).as_ref() == Some(value)
}
