//! The suite: what every case promises.

use std::collections::BTreeSet;

use exact_kalman::filter::one_shot;
use exact_kalman::judge::{meaning, suite};
use exact_kalman::protocol::{Case, Expect};

use crate::samples::path;

const NILE: &str = include_str!("../../data/nile.csv");

#[test]
fn ids_are_unique_relative_paths() {
    let mut ids = BTreeSet::new();
    for case in suite() {
        let plain = |part: &str| {
            !part.is_empty()
                && part.bytes().all(|byte| byte.is_ascii_lowercase() || byte.is_ascii_digit() || byte == b'-')
        };
        assert!(case.id.split('/').count() == 2 && case.id.split('/').all(plain), "{}", case.id);
        assert!(!case.about.is_empty(), "{}", case.id);
        assert!(ids.insert(case.id.clone()), "{} twice", case.id);
    }
}

#[test]
fn every_flag_is_explained_and_every_explanation_used() {
    let used: BTreeSet<String> = suite().into_iter().flat_map(|case| case.flags).collect();
    for flag in &used {
        assert!(meaning(flag).is_some_and(|text| text.len() > 20), "{flag}");
    }
    let all = [
        "adapted",
        "arriving",
        "bad-input",
        "basic",
        "before-transition",
        "contradiction",
        "correlated",
        "diffuse",
        "ill-conditioned",
        "input",
        "missing",
        "real-data",
        "singular",
        "time-varying",
        "units",
        "unstable",
    ];
    assert!(used.iter().eq(all), "{used:?}");
    assert_eq!(meaning("no-such-flag"), None);
}

#[test]
fn flags_say_what_the_model_has() {
    for case in suite().iter().filter(|case| case.expect != Expect::Refuse) {
        let text = case.to_line();
        let has = |flag: &str| case.flags.iter().any(|known| known == flag);
        assert_eq!(has("arriving"), text.contains(r#""timing":"arriving""#), "{}", case.id);
        assert_eq!(has("before-transition"), text.contains(r#""before":"transition""#), "{}", case.id);
        assert_eq!(has("diffuse"), text.contains(r#""diffuse":"#), "{}", case.id);
        assert_eq!(has("adapted"), text.contains(r#""rules":"#), "{}", case.id);
        let gap =
            case.observations.iter().any(|reading| reading.as_ref().is_none_or(|y| y.iter().any(Option::is_none)));
        assert_eq!(has("missing"), gap, "{}", case.id);
        assert_eq!(has("contradiction"), case.expect == Expect::Flag, "{}", case.id);
        let shared = path(case)
            .steps()
            .iter()
            .any(|step| step.transition.as_ref().is_some_and(|transition| !transition.cross_noise.is_zero()));
        assert_eq!(has("correlated"), shared, "{}", case.id);
        assert_eq!(
            has("input"),
            text.contains(r#"input":{"#) || case.id == "adapted/regression-with-feedback",
            "{}",
            case.id
        );
    }
}

#[test]
fn estimates_exist() {
    for case in suite().iter().filter(|case| case.expect == Expect::Estimate) {
        // The recursion, since conditioning at once takes long for long cases.
        let trace = exact_kalman::filter::filter(&path(case)).unwrap_or_else(|error| panic!("{}: {error}", case.id));
        assert_eq!(trace.records.len(), case.observations.len(), "{}", case.id);
    }
}

#[test]
fn contradictions_are_where_the_text_says() {
    let mut seen = 0;
    for case in suite().iter().filter(|case| case.expect == Expect::Flag) {
        let said: usize = case.about.split("step ").nth(1).unwrap()[..1].parse().unwrap();
        let error = one_shot(&path(case)).expect_err(&case.id);
        assert_eq!(error.step, said, "{}", case.id);
        seen += 1;
    }
    assert_eq!(seen, 2);
}

#[test]
fn singular_cases_are_singular() {
    for case in suite().iter().filter(|case| case.expect == Expect::Estimate) {
        let trace = exact_kalman::filter::filter(&path(case)).unwrap();
        let deficient = trace.records.iter().any(|record| record.innovation_rank < record.observed.len());
        assert_eq!(case.flags.iter().any(|flag| flag == "singular"), deficient, "{}", case.id);
    }
}

#[test]
fn every_category_is_there() {
    let categories: BTreeSet<String> =
        suite().iter().map(|case| case.id.split('/').next().unwrap_or_default().to_owned()).collect();
    let expected = [
        "adapted",
        "arriving",
        "basic",
        "correlated",
        "diffuse",
        "missing",
        "nile",
        "refuse",
        "singular",
        "units",
        "unstable",
        "varying",
    ];
    assert!(categories.iter().eq(expected), "{categories:?}");
}

#[test]
fn the_suite_is_the_same_twice_and_survives_the_stream() {
    let lines = || suite().iter().map(Case::to_line).collect::<Vec<_>>();
    assert_eq!(lines(), lines());
    for case in suite() {
        assert_eq!(Case::parse(&case.to_line()).unwrap(), case);
        assert_eq!(Case::parse(&case.to_pretty()).unwrap(), case);
    }
}

#[test]
fn the_nile_is_the_nile() {
    let flows: Vec<&str> = NILE.lines().skip(1).map(|line| line.split_once(',').unwrap().1).collect();
    // The mean of the hundred years is 919.35.
    assert_eq!(flows.iter().map(|flow| flow.parse::<u32>().unwrap()).sum::<u32>(), 91_935);
    let years: Vec<u32> = NILE.lines().skip(1).map(|line| line.split_once(',').unwrap().0.parse().unwrap()).collect();
    assert!(years.iter().copied().eq(1871..=1970));
    for case in suite().iter().filter(|case| case.id.starts_with("nile/")) {
        assert_eq!(case.observations.len(), 100);
        for ((year, flow), reading) in years.iter().zip(&flows).zip(&case.observations) {
            let gap = case.id.contains("missing") && matches!(year, 1891..=1910 | 1931..=1950);
            let texts: Option<Vec<&str>> = reading
                .as_ref()
                .map(|entries| entries.iter().map(|entry| entry.as_ref().map_or("", |entry| entry.as_str())).collect());
            assert_eq!(texts, (!gap).then(|| vec![*flow]), "{} {year}", case.id);
        }
    }
}

/// The double nearest to 1469.1 is meant, and each subject reads it as that.
#[test]
fn numbers_are_doubles_and_short() {
    for case in suite() {
        assert_eq!(case.numbers.name(), "binary64", "{}", case.id);
        assert!(case.to_line().len() < 4000, "{}", case.id);
    }
}
