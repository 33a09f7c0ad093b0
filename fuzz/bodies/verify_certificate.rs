//! Certificates from outside are verified or rejected, never a panic; and what is accepted is true.
//!
//! Bytes that begin with a brace are a certificate as it stands. Others are a tape: the number of a small model, of which the filter
//! makes a certificate, and what is changed in it; after an `s` the model is one that rests.

#[path = "../../tests/verify/models.rs"]
#[allow(dead_code, reason = "the tests use more of it")]
mod models;
#[path = "../../tests/verify/steady_models.rs"]
#[allow(dead_code, reason = "the tests use more of it")]
mod steady_models;
#[path = "../../tests/verify/truth.rs"]
#[allow(dead_code, reason = "the tests use more of it")]
mod truth;

use exact_kalman::protocol::{Case, SteadyModel};
use exact_kalman::verify::{
    BeliefDocument, FilterCertificate, FilterCheck, SteadyDocument, SteadyEvidence, StepDocument, VerifyError,
    check_steady,
};
use steady_models::change_matrix;

/// How far the bytes came.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Reached {
    /// No certificate, or none of a model.
    Nothing,
    /// A certificate that is rejected.
    Rejected,
    /// A certificate that is accepted.
    Accepted,
}

/// Longer texts take longer and show nothing new.
const MAXIMAL_BYTES: usize = 1 << 14;

/// Reads the bytes as a certificate, or makes one and changes it.
///
/// # Panics
///
/// If a step is accepted that is not true.
pub fn run(bytes: &[u8]) -> Reached {
    if bytes.len() > MAXIMAL_BYTES {
        return Reached::Nothing;
    }
    match bytes {
        [b'{', ..] => from_outside(bytes),
        [b's', tape @ ..] => changed_at_rest(tape),
        tape => changed(tape),
    }
}

fn from_outside(bytes: &[u8]) -> Reached {
    if let Some(document) = std::str::from_utf8(bytes).ok().and_then(|text| SteadyDocument::parse(text).ok()) {
        assert_eq!(SteadyDocument::parse(&document.to_line()).as_ref(), Ok(&document));
        let Ok(model) = SteadyModel::parse(&document.model.to_string()) else { return Reached::Nothing };
        let (step, timing) = model.step();
        let verdict = check_steady(&step, timing, &document.evidence);
        return if verdict.is_ok() { Reached::Accepted } else { Reached::Rejected };
    }
    let Ok(certificate) = FilterCertificate::open(bytes) else { return Reached::Nothing };
    let Ok(problem) = Case::parse(certificate.case()).and_then(|case| case.problem()) else { return Reached::Nothing };
    let verdict = certificate.verify(&problem.system, &problem.observations, |_| {});
    if matches!(verdict, Err(VerifyError::Case(_))) {
        return Reached::Nothing;
    }
    if verdict.is_ok() { Reached::Accepted } else { Reached::Rejected }
}

/// Numbers off the tape; zeros after its end.
struct Tape<'a>(std::slice::Iter<'a, u8>);

impl Tape<'_> {
    fn next(&mut self) -> usize {
        self.0.next().copied().map_or(0, |byte| usize::from(byte.wrapping_sub(b'0')))
    }
}

fn changed(bytes: &[u8]) -> Reached {
    let mut tape = Tape(bytes.iter());
    let model = models::model((tape.next() + 256 * tape.next()) as u64);
    let bits = [8, 12, 20, 53, 128][tape.next() % 5];
    let (mut start, mut steps) = models::certified(&model.path, bits);
    for _ in 0..tape.next() % 8 {
        change(&mut tape, &mut start, &mut steps);
    }
    let truth = truth::Truth::of(&model.longer);
    let Ok(mut check) = FilterCheck::begin(model.path.timing(), model.path.initial(), &start) else {
        return Reached::Rejected;
    };
    for step in &steps {
        let at = check.done();
        let is_right = model.path.steps().get(at).is_some_and(|own| check.step(own, step).is_ok());
        if !is_right {
            return Reached::Rejected;
        }
        assert!(truth.agrees(at, step, model.path.timing()), "step {at} is accepted and false: {step:?}");
    }
    if check.end(model.path.steps().len()).is_ok() { Reached::Accepted } else { Reached::Rejected }
}

fn changed_at_rest(bytes: &[u8]) -> Reached {
    let mut tape = Tape(bytes.iter());
    let model = steady_models::steady((tape.next() + 256 * tape.next()) as u64);
    let (Some(rough), Some(known)) = (model.solved(3), model.solved(30)) else { return Reached::Nothing };
    let mut claim = rough.evidence;
    for _ in 0..tape.next() % 8 {
        steady_models::change(&mut || tape.next(), &mut claim, model.sensors());
    }
    if check_steady(&model.step, model.timing, &SteadyEvidence::Stabilising(claim.clone())).is_err() {
        return Reached::Rejected;
    }
    let is_followed = claim.kept.as_ref().is_none_or(|kept| model.follows(kept));
    assert!(is_followed && model.agrees(&known, &claim), "accepted and false: {claim:?}");
    Reached::Accepted
}

fn change(tape: &mut Tape<'_>, start: &mut BeliefDocument, steps: &mut Vec<StepDocument>) {
    let (what, at) = (tape.next(), tape.next());
    if steps.is_empty() {
        return;
    }
    let at = at % (steps.len() + 1);
    if at == steps.len() {
        return change_belief(tape, what, start);
    }
    match what % 16 {
        0 => drop(steps.remove(at)),
        1 => {
            let other = tape.next() % steps.len();
            steps.swap(at, other);
        }
        2 => {
            let copy = steps[at].clone();
            steps.insert(at, copy);
        }
        3 => steps[at].step = tape.next(),
        4 => steps[at].kept = Some((0..tape.next() % 4).map(|_| tape.next() % 4).collect()),
        5 => steps[at].ahead = None,
        6 => steps[at].predicted = Some(steps[at].filtered.clone()),
        7 => {
            if let Some(whitening) = &mut steps[at].whitening {
                change_matrix(&mut || tape.next(), whitening);
            }
        }
        _ => {
            let StepDocument { predicted, filtered, ahead, .. } = &mut steps[at];
            let beliefs = [predicted.as_mut(), Some(filtered), ahead.as_mut()];
            let mut beliefs: Vec<_> = beliefs.into_iter().flatten().collect();
            let place = tape.next() % beliefs.len();
            change_belief(tape, what / 16, beliefs[place]);
        }
    }
}

fn change_belief(tape: &mut Tape<'_>, what: usize, belief: &mut BeliefDocument) {
    match what % 8 {
        0 => belief.balance = i64::try_from(tape.next()).ok().map(|k| k - 40),
        1 => belief.balance = None,
        2 => {
            if let Some(gain) = &mut belief.gain {
                change_matrix(&mut || tape.next(), gain);
            }
        }
        3 => change_matrix(&mut || tape.next(), &mut belief.covariance),
        4 | 5 => change_matrix(&mut || tape.next(), &mut belief.gap),
        6 => change_matrix(&mut || tape.next(), &mut belief.mean),
        _ => change_matrix(&mut || tape.next(), &mut belief.ellipsoid),
    }
}
