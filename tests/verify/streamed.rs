//! One step of the case at a time: nothing is accepted for that.

use std::sync::Arc;
use std::sync::atomic::{AtomicUsize, Ordering};

use exact_kalman::matrix::Matrix;
use exact_kalman::model::{Coefficient, ModelError, Observation, Step};
use exact_kalman::protocol::{Case, Problem};
use exact_kalman::scalar::{Rational, ratio};
use exact_kalman::verify::{
    BeliefDocument, CertificateWriter, Condition, FilterCertificate, FilterCheck, StepDocument, VerifyError,
};

use super::models::certified;

/// A walk whose sensor has these variances, with one unit reading for each but the last, which is missing.
fn walk(variances: &[&str]) -> Problem {
    let noise: Vec<_> = variances.iter().map(|variance| format!("[[\"{variance}\"]]")).collect();
    let readings = "[\"1\"],".repeat(variances.len() - 1);
    let case = format!(
        r#"{{"format":"exact-kalman/case/1","id":"walk","timing":"departing","initial":{{"before":"observation",
        "mean":["0"],"covariance":[["1/3"]]}},"numbers":"exact","transition":[["1"]],"observation":[["1"]],
        "noise":{{"process":[["1"]],"observation":[{}]}},"observations":[{readings}null]}}"#,
        noise.join(",")
    );
    Case::parse(&case).expect("a case").problem().expect("numbers")
}

fn documents(problem: &Problem) -> (BeliefDocument, Vec<StepDocument>) {
    certified(&problem.realised().expect("a model"), 64)
}

/// A file with these steps, whose digest is right.
fn file((start, steps): &(BeliefDocument, Vec<StepDocument>)) -> Vec<u8> {
    let mut writer = CertificateWriter::begin(Vec::new(), "{}", start).expect("memory");
    for step in steps {
        writer.step(step).expect("memory");
    }
    writer.end().expect("memory")
}

/// Whether such a file certifies a problem, and how many steps were proved.
fn verified(problem: &Problem, documents: &(BeliefDocument, Vec<StepDocument>)) -> (Result<(), VerifyError>, usize) {
    let file = file(documents);
    let certificate = FilterCertificate::open(file.as_slice()).expect("a first line");
    let mut proved = 0;
    (certificate.verify(&problem.system, &problem.observations, |_| proved += 1), proved)
}

fn rejected(verdict: Result<(), VerifyError>) -> (Option<usize>, Condition) {
    match verdict {
        Err(VerifyError::Rejected(rejection)) => (rejection.line, rejection.condition),
        other => panic!("{other:?}"),
    }
}

/// The last reading is missing, so its variance is in no inequality; yet there is no law with a negative one.
#[test]
fn a_later_step_that_is_no_model_is_rejected() {
    let sound = walk(&["1", "2", "3", "0"]);
    let certificate = documents(&sound);
    assert!(matches!(verified(&sound, &certificate), (Ok(()), 4)));
    let (verdict, proved) = verified(&walk(&["1", "2", "3", "-1"]), &certificate);
    assert_eq!(proved, 3);
    let Err(VerifyError::Case(error)) = verdict else { panic!("{verdict:?}") };
    assert!(matches!(*error, ModelError::Indefinite { place, .. } if place.step == Some(3)), "{error}");
}

/// A file that is whole in itself, for a case with the same first steps.
#[test]
fn neither_more_steps_nor_fewer_are_accepted() {
    let all = walk(&["1"; 6]).observations;
    let first = |count| Problem { observations: all[..count].to_vec(), ..walk(&["1"; 6][..count]) };
    let certificate = documents(&first(4));
    assert!(matches!(verified(&first(4), &certificate), (Ok(()), 4)));
    for (steps, line) in [(3, 5), (5, 6)] {
        let (verdict, proved) = verified(&first(steps), &certificate);
        assert_eq!((rejected(verdict), proved), ((Some(line), Condition::Document), steps.min(4)), "{steps} steps");
    }
    let none = (certificate.0, Vec::new());
    assert_eq!(rejected(verified(&first(4), &none).0), (Some(2), Condition::Document));
}

/// A step of the case is looked at when all before it are proved, and once.
#[test]
fn steps_are_evaluated_one_at_a_time() {
    let mut problem = walk(&["1"; 6]);
    let certificate = documents(&problem);
    let asked = Arc::new(AtomicUsize::new(0));
    let counter = Arc::clone(&asked);
    problem.system.observation = Coefficient::adapted(move |past| {
        assert_eq!(counter.fetch_add(1, Ordering::Relaxed), past.step());
        Ok(Matrix::identity(1))
    });
    let file = file(&certificate);
    let read = FilterCertificate::open(file.as_slice()).expect("a first line");
    let mut proved = 0;
    let verdict = read.verify(&problem.system, &problem.observations, |_| {
        proved += 1;
        assert_eq!(asked.load(Ordering::Relaxed), proved);
    });
    assert!(verdict.is_ok() && proved == 6, "{verdict:?} {proved}");
}

/// A step from elsewhere is refused, whatever its shapes are.
#[test]
fn steps_that_do_not_fit_are_rejected() {
    let path = walk(&["1", "1"]).realised().expect("a model");
    let (start, steps) = certified(&path, 64);
    let right = &path.steps()[0];
    let wide = Matrix::from_fn(2, 2, |_, _| ratio(1, 1));
    let found = |change: &dyn Fn(&mut Step<Rational>)| {
        let mut step = right.clone();
        change(&mut step);
        let mut check = FilterCheck::begin(path.timing(), path.initial(), &start).expect("a start");
        check.step(&step, &steps[0]).map(|_| ()).map_err(|why| why.condition)
    };
    assert_eq!(found(&|_| {}), Ok(()));
    let no = Err(Condition::Shape);
    assert_eq!(found(&|step| step.observation = wide.clone()), no);
    assert_eq!(found(&|step| step.observation_input = Matrix::zeros(0, 1)), no);
    assert_eq!(found(&|step| step.observation_noise = wide.clone()), no);
    assert_eq!(found(&|step| step.reading = Observation::missing(2)), no);
    for place in 0..4 {
        let change = |step: &mut Step<Rational>| {
            let transition = step.transition.as_mut().expect("it departs");
            let all =
                [&mut transition.matrix, &mut transition.input, &mut transition.noise, &mut transition.cross_noise];
            *all.into_iter().nth(place).expect("four") = wide.clone();
        };
        assert_eq!(found(&change), no, "{place}");
    }
    let mut initial = path.initial().clone();
    initial.covariance = wide;
    assert_eq!(FilterCheck::begin(path.timing(), &initial, &start).err().map(|why| why.condition), no.err());
    let check = FilterCheck::begin(path.timing(), path.initial(), &start).expect("a start");
    assert_eq!(check.end(2).map_err(|why| why.condition), Err(Condition::Order));
}
