//! What a judgement comes to.

use std::fmt;

use super::Digits;
use crate::scalar::{Rational, exact_value};

/// Losing up to this many digits against the attainable ones is agreement.
pub(super) const ALLOWED_LOSS: f64 = 2.0;
/// Fewer digits than this are wrong …
pub(super) const WRONG_BELOW: f64 = 4.0;
/// … where at least this many are attainable.
pub(super) const FAIR_FROM: f64 = 6.0;

/// What a judgement comes to, from best to worst.
///
/// | verdict | when |
/// |---|---|
/// | agrees | every judged quantity has at most 2 digits fewer than attainable, at every step; a case that must be refused was, in whatever words, errors included; a contradiction was reported at its step, or as such without a step |
/// | unsupported | the subject says that it does not know this kind of model |
/// | undecided | the truth is not known to the judge |
/// | loses N digits | some quantity has more than 2 digits fewer than attainable; N is their number, rounded up |
/// | asymmetric | two mirrored entries of a covariance differ by more than the digits allowed |
/// | not psd | a covariance stays indefinite when its variances are raised by n times a relative error of the digits allowed |
/// | refused valid input | the subject blames valid input, or data that the model can produce |
/// | error | the subject says that it failed |
/// | accepted bad input | an answer to a case that must be refused, or no word about data of probability zero |
/// | wrong | fewer than 4 digits where 6 or more are attainable; a value that is not finite, missing or of another shape; a contradiction reported at another step than its own |
/// | timed out, died, malformed | no answer, or none that can be read |
///
/// The digits allowed are the attainable ones less 2. The first three are no findings.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
#[non_exhaustive]
#[expect(missing_docs, reason = "the table above says it")]
pub enum Verdict {
    Agrees,
    Unsupported,
    Undecided,
    Loses { digits: u32 },
    Asymmetric,
    NotPositiveSemidefinite,
    RefusedValidInput,
    Error,
    AcceptedBadInput,
    Wrong,
    TimedOut,
    Died,
    Malformed,
}

impl Verdict {
    /// The verdict on a number of digits.
    pub fn on(digits: Digits, attainable: Digits) -> Self {
        let loss = attainable.value() - digits.value();
        if digits.value() < WRONG_BELOW && attainable.value() >= FAIR_FROM {
            Self::Wrong
        } else if loss > ALLOWED_LOSS {
            #[expect(
                clippy::cast_possible_truncation,
                clippy::cast_sign_loss,
                reason = "more than 2, at most some thousand"
            )]
            Self::Loses { digits: loss.ceil() as u32 }
        } else {
            Self::Agrees
        }
    }

    /// The relative error that agreement allows: 10 to the power of minus the attainable digits, plus 2; nothing if that
    /// is more than any number.
    pub(super) fn allowed_error(attainable: Digits) -> Option<Rational> {
        exact_value(libm::exp10(ALLOWED_LOSS - attainable.value()))
    }

    /// Whether it is a finding: neither agreement nor something that was not judged.
    pub const fn is_finding(self) -> bool {
        !matches!(self, Self::Agrees | Self::Unsupported | Self::Undecided)
    }

    /// The name without its number.
    pub const fn name(self) -> &'static str {
        match self {
            Self::Agrees => "agrees",
            Self::Loses { .. } => "loses digits",
            Self::Asymmetric => "asymmetric",
            Self::NotPositiveSemidefinite => "not psd",
            Self::Wrong => "wrong",
            Self::AcceptedBadInput => "accepted bad input",
            Self::RefusedValidInput => "refused valid input",
            Self::Unsupported => "unsupported",
            Self::Error => "error",
            Self::TimedOut => "timed out",
            Self::Died => "died",
            Self::Malformed => "malformed",
            Self::Undecided => "undecided",
        }
    }
}

impl fmt::Display for Verdict {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Loses { digits } => f.pad(&format!("loses {digits} digits")),
            other => f.pad(other.name()),
        }
    }
}
