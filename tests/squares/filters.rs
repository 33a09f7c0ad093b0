//! The rooms `filter` and `model`: recursion, one shot, prediction ahead, timings.

use exact_kalman::filter::{FilterError, Predictions, Records, filter, one_shot, one_shot_ahead, predict_ahead};
use exact_kalman::gaussian::{ConditionError, Gaussian};
use exact_kalman::matrix::{Matrix, PseudoInverseError};
use exact_kalman::model::Path;
use exact_kalman::scalar::{Field, Scalar, ZeroTest};
use exact_kalman::trace::{Moments, Record};

use super::algebra::algorithm;
use super::ball::enclosed;
use super::commuting::{Answer, Drawn, Named};
use super::inputs::Input;
use super::maps::over_fields;

fn with_diffuse<S: Scalar>(answer: Answer<S>, diffuse: Option<&Matrix<S>>) -> Answer<S> {
    match diffuse {
        None => answer.says(false),
        // It is kept where it may be zero.
        Some(part) if part.entries().iter().all(|entry| entry.zero_test() != ZeroTest::Nonzero) => answer.undecided(),
        Some(part) => answer.says(true).matrix(part),
    }
}

fn with_moments<S: Scalar>(answer: Answer<S>, moments: &Moments<S>) -> Answer<S> {
    with_diffuse(answer.matrix(&moments.mean).matrix(&moments.covariance), moments.diffuse.as_ref())
}

/// Every number of a step.
fn with_record<S: Scalar>(answer: Answer<S>, record: &Record<S>) -> Answer<S> {
    let answer = record.observed.iter().fold(answer, |answer, &i| answer.count(i)).count(record.innovation_rank);
    let answer = with_moments(with_moments(answer, &record.predicted), &record.filtered);
    let answer = answer
        .matrix(&record.predicted_observation)
        .matrix(&record.innovation)
        .matrix(&record.innovation_covariance)
        .matrix(&record.cross_covariance)
        .matrix(&record.gain);
    let answer = with_diffuse(answer, record.innovation_diffuse.as_ref());
    match &record.likelihood {
        None => answer.says(false),
        Some(parts) => answer.count(parts.rank).number(&parts.quadratic).number(&parts.pseudo_determinant),
    }
}

fn with_law<S: Scalar>(answer: Answer<S>, law: &Gaussian<S>) -> Answer<S> {
    answer.matrix(law.mean()).matrix(law.covariance())
}

fn refused<S: Scalar, C>(error: &FilterError<S, C>) -> Answer<S> {
    match &error.source {
        ConditionError::PseudoInverse(PseudoInverseError::Undecided(_)) => Answer::new().undecided(),
        _ => Answer::new().refused().count(error.step),
    }
}

algorithm!(Recursion, Scalar, ["filter::filter", "filter::Records::new"], |input| {
    let trace = match filter(input.path()) {
        Ok(trace) => trace,
        Err(error) => return refused(&error),
    };
    let one_by_one = Records::new(input.path()).map_while(Result::ok).count();
    let answer = trace.records.iter().fold(Answer::new().count(one_by_one), with_record);
    trace.ahead.iter().fold(answer, with_moments)
});

algorithm!(Ahead, Scalar, ["filter::predict_ahead", "filter::Predictions::new"], |input| {
    let trace = match predict_ahead(&input.ahead) {
        Ok(trace) => trace,
        Err(error) => return refused(&error),
    };
    let one_by_one = Predictions::new(&input.ahead).map_while(Result::ok).count();
    let answer = trace.start.iter().fold(Answer::new().count(one_by_one), with_moments);
    trace
        .steps
        .iter()
        .fold(answer, |answer, step| step.ahead.iter().fold(with_record(answer, &step.record), with_moments))
});

algorithm!(OneShot, Field, ["filter::one_shot"], |input| {
    match one_shot(input.path()) {
        Ok(laws) => {
            laws.iter().fold(Answer::new(), |answer, laws| with_law(with_law(answer, &laws.predicted), &laws.filtered))
        }
        Err(error) => refused(&error),
    }
});

algorithm!(OneShotAhead, Field, ["filter::one_shot_ahead"], |input| {
    match one_shot_ahead(&input.ahead) {
        Ok(laws) => laws.iter().flatten().fold(Answer::new(), with_law),
        Err(error) => refused(&error),
    }
});

fn with_path<S: Scalar>(answer: Answer<S>, path: &Path<S>) -> Answer<S> {
    let initial = path.initial();
    let start = answer.matrix(&initial.mean).matrix(&initial.covariance);
    let start = initial.diffuse.iter().fold(start, Answer::matrix);
    path.steps().iter().fold(start, |answer, step| {
        let answer = answer.matrix(&step.observation).matrix(&step.observation_input).matrix(&step.observation_noise);
        let answer = answer.matrix(&step.reading.values());
        step.transition.iter().fold(answer, |answer, transition| {
            answer
                .matrix(&transition.matrix)
                .matrix(&transition.input)
                .matrix(&transition.noise)
                .matrix(&transition.cross_noise)
        })
    })
}

algorithm!(Timings, Scalar, ["model::Path::to_departing", "model::Path::to_arriving"], |input| {
    let answer = with_path(Answer::new(), &input.path().to_departing());
    match input.path().to_arriving() {
        Ok(path) => with_path(answer, &path),
        Err(PseudoInverseError::DoesNotExist { rank, order }) => answer.refused().count(rank).count(order),
        Err(PseudoInverseError::Undecided(_)) => answer.undecided(),
    }
});

pub const COVERED: &[&[&str]] =
    &[Recursion::COVERS, Ahead::COVERS, OneShot::COVERS, OneShotAhead::COVERS, Timings::COVERS];

/// CKS-T: the recursion, in both timings, with gaps, feedback and starts that are diffuse in part.
#[test]
fn recursion_commutes() {
    over_fields!(Recursion);
    enclosed!(Recursion);
}

/// HV-T1: predictions d steps ahead.
#[test]
fn predictions_commute() {
    over_fields!(Ahead);
    enclosed!(Ahead);
}

/// One conditioning of everything.
#[test]
fn one_shot_conditioning_commutes() {
    over_fields!(OneShot, OneShotAhead);
}

/// HV-X.ad, HV-X.da: the changes of timing.
#[test]
fn timings_commute() {
    over_fields!(Timings);
    enclosed!(Timings);
}

/// Both timings and both kinds of start are among the inputs.
#[test]
fn inputs_are_of_every_kind() {
    use exact_kalman::model::Timing;
    let share = |what: &str, is: &dyn Fn(&Input<exact_kalman::scalar::Rational>) -> bool| {
        let counts = super::commuting::counted(what, |tape| Ok(is(&Input::drawn(&tape, Drawn::drawn))));
        assert!(counts.equal > 4 && counts.vanished > 4, "{what}: {counts:?}");
    };
    share("arriving", &|input| input.path().timing() == Timing::Arriving);
    share("diffuse", &|input| input.path().initial().diffuse.is_some());
    share("several steps", &|input| input.path().steps().len() > 1);
}
