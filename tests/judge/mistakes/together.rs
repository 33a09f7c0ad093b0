//! Several mistakes, and such as cannot be told apart.

use exact_kalman::judge::{Diagnosis, Judgement};
use exact_kalman::protocol::Case;
use exact_kalman::report::Report;

use super::filter::Filter;
use super::subject::{TRUTHS, diagnosis, judgements, right_steps, steps};

fn names(diagnosis: &Diagnosis) -> Vec<&'static str> {
    diagnosis.explanations.iter().map(|one| one.mistake.name).collect()
}

/// The judgements on the cases of one state and one sensor.
fn of_scalars(habit: &str) -> Vec<Judgement> {
    let filter = Filter { habit, way: 0.0 };
    let judgements = judgements(|case| steps(&filter, case)).into_iter().zip(TRUTHS.iter());
    let is_scalar = |case: &Case| {
        case.initial.mean.len() == 1 && case.observations.iter().flatten().all(|reading| reading.len() == 1)
    };
    judgements.filter(|(_, (case, _))| is_scalar(case)).map(|(judgement, _)| judgement).collect()
}

/// Of one variance the root is the factor. Scalars do not tell them apart, and that is said; matrices do.
#[test]
fn what_scalars_do_not_tell_apart_the_suite_does() {
    let habit = "standard-deviations-for-variances";
    let on_scalars = Diagnosis::of(&of_scalars(habit));
    let first = &on_scalars.explanations[0];
    assert_eq!(first.mistake.name, habit);
    assert_eq!(first.alike.iter().map(|one| one.name).collect::<Vec<_>>(), ["factor-for-covariance"]);
    let filter = Filter { habit, way: 0.0 };
    let (_, on_all) = diagnosis(|case| steps(&filter, case));
    assert_eq!(names(&on_all), [habit]);
    assert!(on_all.explanations[0].alike.is_empty());
}

/// The other way round: the factor of a matrix is no matrix of roots.
#[test]
fn the_better_supported_of_two_is_named() {
    let filter = Filter { habit: "factor-for-covariance", way: 0.0 };
    let (_, on_all) = diagnosis(|case| steps(&filter, case));
    assert_eq!(names(&on_all), ["factor-for-covariance"]);
    assert_eq!(on_all.explanations[0].ways, ["lower"]);
}

#[test]
fn two_mistakes_in_different_cases_are_both_named() {
    let has = |case: &Case, flag: &str| case.flags.iter().any(|own| own == flag);
    let answers = |case: &Case| match () {
        () if has(case, "missing") => steps(&Filter { habit: "missing-as-zero", way: 0.0 }, case),
        () if has(case, "correlated") => steps(&Filter { habit: "cross-covariance-dropped", way: 0.0 }, case),
        () => right_steps(case),
    };
    let (judgements, diagnosis) = diagnosis(answers);
    let mut found = names(&diagnosis);
    found.sort_unstable();
    assert_eq!(found, ["cross-covariance-dropped", "missing-as-zero"]);
    for (place, judgement) in judgements.iter().enumerate() {
        let explained = diagnosis.explanations_of(place).count();
        assert!(explained <= 1 && (explained == 0 || judgement.verdict.is_finding()));
    }
}

/// Counts are those of the answers.
#[test]
fn counts_are_of_answers_that_show_it() {
    let filter = Filter { habit: "predicted-for-filtered", way: 0.0 };
    let (judgements, diagnosis) = diagnosis(|case| steps(&filter, case));
    let one = &diagnosis.explanations[0];
    let answered = judgements.iter().filter(|judgement| !judgement.scores.is_empty()).count();
    assert!(one.met <= one.shows && one.shows <= answered && one.met == one.explains.len());
    assert!(one.met + 4 >= one.shows, "{} of {}", one.met, one.shows);
    // Half of the answers right: then it is no longer what the program does, though it is what some answers are.
    let mixed = |case: &Case| if case.id.len().is_multiple_of(3) { steps(&filter, case) } else { right_steps(case) };
    assert_eq!(super::subject::diagnosis(mixed).1, Diagnosis::default());
}

#[test]
fn reports_say_it_in_words_and_in_json() {
    let said = |habit: &str| {
        let filter = Filter { habit, way: 0.0 };
        let mut report = Report::new("a program");
        let judged = judgements(|case| steps(&filter, case)).into_iter().zip(TRUTHS.iter());
        report.results = judged.map(|(judgement, (case, _))| (case.clone(), judgement)).collect();
        (exact_kalman::report::text(&report, false), exact_kalman::report::json(&report))
    };
    let (text, json) = said("predicted-for-filtered");
    assert!(text.contains("   this is the answer if you return the predicted moments"), "{text}");
    let (_, section) = text.split_once("What it looks like").expect("the section");
    assert!(section.contains("predicted-for-filtered: you return the predicted moments"), "{section}");
    assert!(section.contains("exact-kalman explain predicted-for-filtered"), "{section}");
    assert_eq!(json["diagnosis"][0]["mistake"], "predicted-for-filtered");
    assert_eq!(json["diagnosis"][0]["kind"], "mistake");
    let (text, json) = said("innovation-of-the-other-sign");
    assert!(text.contains("this is a convention, not a fault"), "{text}");
    assert_eq!(json["diagnosis"][0]["kind"], "reading");
    let (text, json) = said("");
    assert!(!text.contains("What it looks like") && json["diagnosis"].as_array().is_some_and(Vec::is_empty));
}
