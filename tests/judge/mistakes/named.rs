//! Each mistake of the catalogue, made by a program of its own, is named first.

use std::collections::BTreeSet;

use exact_kalman::judge::{Verdict, mistakes};
use rayon::prelude::*;

use super::filter::Filter;
use super::subject::{diagnosis, steps};

/// Mistakes that are made in several ways: the number that the filter of the tests is given, and what is said of it.
const WAYS: [(&str, f64, &str); 33] = [
    ("factor-for-covariance", 0.0, "lower"),
    ("factor-for-covariance", 1.0, "upper"),
    ("few-digits", 6.0, "6 significant digits"),
    ("few-digits", 4.0, "4 significant digits"),
    ("few-digits", 9.0, "9 significant digits"),
    ("few-digits", -6.0, "6 decimals"),
    ("few-digits", -3.0, "3 decimals"),
    ("initial-law-before-a-transition", 0.0, "the first transition twice"),
    ("initial-law-before-a-transition", 1.0, "without its input"),
    ("initial-law-before-a-transition", 2.0, "transition k into k"),
    ("transition-of-another-step", 0.0, "of the step before"),
    ("transition-of-another-step", 1.0, "of the next step"),
    ("observation-matrix-of-another-step", 0.0, "of the step before"),
    ("observation-matrix-of-another-step", 1.0, "of the next step"),
    ("process-noise-of-another-step", 0.0, "of the step before"),
    ("observation-noise-of-another-step", 1.0, "of the next step"),
    ("input-of-another-step", 1.0, "of the next step"),
    ("transition-frozen", 0.0, "the first"),
    ("transition-frozen", 1.0, "the last"),
    ("observation-noise-frozen", 1.0, "the last"),
    ("large-number-for-diffuse", 1e4, "10^4 times it"),
    ("large-number-for-diffuse", 1e6, "10^6 times it"),
    ("process-noise-in-other-units", 0.0, "squared"),
    ("process-noise-in-other-units", 1.0, "its root"),
    ("observation-noise-in-other-units", 1.0, "its root"),
    ("predictor-gain-for-filtered", 0.0, "for the mean"),
    ("predictor-gain-for-filtered", 1.0, "for mean and covariance"),
    ("innovation-covariance-raised", 1e-6, "10^-6"),
    ("process-noise-raised", 1e-6, "10^-6"),
    ("filtered-covariance-raised", 1e-8, "10^-8"),
    ("covariance-rests-too-early", 1e-6, "10^-6"),
    ("covariance-rests-too-early", 1e-4, "10^-4"),
    ("small-variances-ignored", 1e-8, "10^-8"),
];

/// Each mistake of the catalogue, by a filter in doubles that shares nothing with it.
#[test]
fn each_mistake_is_named_first() {
    let several: BTreeSet<&str> = WAYS.iter().map(|(name, ..)| *name).collect();
    let single = mistakes().iter().map(|mistake| mistake.name).filter(|name| !several.contains(name));
    let subjects: Vec<(&str, f64, &str)> = single.map(|name| (name, 0.0, "")).chain(WAYS).collect();
    let failures: Vec<String> =
        subjects.into_par_iter().filter_map(|(name, way, label)| failure(name, way, label)).collect();
    assert!(failures.is_empty(), "\n{}", failures.join("\n"));
}

fn failure(name: &str, way: f64, label: &str) -> Option<String> {
    let filter = Filter { habit: name, way };
    let (judgements, diagnosis) = diagnosis(|case| steps(&filter, case));
    if !judgements.iter().any(|judgement| judgement.verdict.is_finding()) {
        return Some(format!("{name} {label}: nothing is found"));
    }
    let said: Vec<String> = diagnosis
        .explanations
        .iter()
        .map(|one| {
            let alike: Vec<&str> = one.alike.iter().map(|other| other.name).collect();
            format!("{} {:?} {}/{} alike {alike:?}", one.mistake.name, one.ways, one.met, one.shows)
        })
        .collect();
    let named = diagnosis.explanations.first().is_some_and(|first| {
        let is_meant = first.mistake.name == name && (label.is_empty() || first.ways.contains(&label));
        is_meant && first.explains.iter().all(|&place| judgements[place].verdict != Verdict::Agrees)
    });
    let alone =
        || judgements.iter().zip(super::subject::TRUTHS.iter()).filter(|(judgement, _)| judgement.verdict.is_finding());
    let alone = || {
        alone().map(|(judgement, (case, _))| {
            let names = exact_kalman::judge::Diagnosis::of([judgement]).explanations;
            format!("  {} {}: {:?}", case.id, judgement.verdict, names.first().map(|one| one.mistake.name))
        })
    };
    (!named).then(|| format!("{name} {label}: {}\n{}", said.join("; "), alone().collect::<Vec<_>>().join("\n")))
}
