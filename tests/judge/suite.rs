//! The suite: what every case promises.

use std::collections::{BTreeMap, BTreeSet};

use exact_kalman::filter::one_shot;
use exact_kalman::judge::{Truth, categories, flag, flags, meaning, suite, suite_seeded};
use exact_kalman::protocol::{Case, Expect};
use exact_kalman::trace::Quantity;

use crate::samples::{TRUTHS, path};

#[test]
fn ids_are_unique_relative_paths_in_order_of_the_categories() {
    let mut ids = BTreeSet::new();
    let mut names = Vec::new();
    for case in suite() {
        let plain = |part: &str| {
            !part.is_empty()
                && part.bytes().all(|byte| byte.is_ascii_lowercase() || byte.is_ascii_digit() || byte == b'-')
        };
        assert!(case.id.split('/').count() == 2 && case.id.split('/').all(plain), "{}", case.id);
        assert!(case.about.len() > 10 && !case.about.ends_with('.'), "{}", case.id);
        assert!(ids.insert(case.id.clone()), "{} twice", case.id);
        let name = case.id.split('/').next().unwrap_or_default().to_owned();
        if names.last() != Some(&name) {
            names.push(name);
        }
    }
    let categories = categories();
    assert!(categories.iter().map(|category| category.name).eq(names.iter().map(String::as_str)), "{names:?}");
    assert!(categories.iter().all(|category| category.about.len() > 20 && !category.about.ends_with('.')));
    assert_eq!((ids.len(), categories.len()), (378, 28), "tell SUITE_VERSION's rule what changed");
}

#[test]
fn no_two_cases_have_the_same_problem() {
    let mut seen = BTreeMap::new();
    for case in suite() {
        let problem = Case { id: "x".into(), about: String::new(), flags: Vec::new(), ..case.clone() };
        if let Some(other) = seen.insert(problem.to_line(), case.id.clone()) {
            panic!("{other} and {}", case.id);
        }
    }
}

#[test]
fn every_flag_is_explained_and_every_explanation_used() {
    let used: BTreeSet<String> = suite().into_iter().flat_map(|case| case.flags).collect();
    let known: BTreeSet<String> = flags().iter().map(|flag| flag.name.to_owned()).collect();
    assert_eq!((&used, used.len()), (&known, flags().len()));
    for found in flags() {
        for text in [found.exercises, found.failing, found.concerns] {
            assert!(text.len() > 8 && !text.ends_with('.') && !text.contains("  "), "{}: {text}", found.name);
        }
        assert_eq!(flag(found.name), Some(found));
        assert_eq!(meaning(found.name), Some(format!("{}: {}", found.exercises, found.failing)));
    }
    assert_eq!((flag("no-such-flag"), meaning("no-such-flag")), (None, None));
    for case in suite() {
        let different: BTreeSet<&String> = case.flags.iter().collect();
        assert!(!case.flags.is_empty() && different.len() == case.flags.len(), "{}: {:?}", case.id, case.flags);
    }
}

#[test]
fn flags_say_what_the_model_has() {
    for case in suite().iter().filter(|case| case.expect != Expect::Refuse) {
        let (text, path) = (case.to_line(), path(case));
        let has = |flag: &str| case.flags.iter().any(|known| known == flag);
        assert_eq!(has("arriving"), text.contains(r#""timing":"arriving""#), "{}", case.id);
        assert_eq!(has("before-transition"), text.contains(r#""before":"transition""#), "{}", case.id);
        assert_eq!(has("diffuse"), text.contains(r#""diffuse":"#), "{}", case.id);
        assert_eq!(has("adapted"), text.contains(r#""rules":"#) && !has("real-data"), "{}", case.id);
        assert_eq!(has("binary32"), text.contains(r#""numbers":"binary32""#), "{}", case.id);
        let gap = |step: &exact_kalman::model::Step<_>| step.reading.present().len() < step.observation.rows();
        assert_eq!(has("missing"), path.steps().iter().any(gap), "{}", case.id);
        let ahead = path.steps().iter().rev().take_while(|step| step.reading.present().is_empty()).count();
        assert!(!has("ahead") || ahead >= 5, "{}", case.id);
        assert_eq!(has("contradiction"), case.expect == Expect::Flag, "{}", case.id);
        let shared = path
            .steps()
            .iter()
            .any(|step| step.transition.as_ref().is_some_and(|transition| !transition.cross_noise.is_zero()));
        assert_eq!(has("correlated"), shared, "{}", case.id);
        let by_feedback = case.id == "adapted/regression-with-feedback";
        assert_eq!(has("input"), text.contains(r#"input":{"#) || by_feedback, "{}", case.id);
        assert_eq!(has("real-data"), case.id.starts_with("nile/") || case.id.starts_with("real/"), "{}", case.id);
        if !text.contains("null") && path.steps().windows(2).any(|pair| pair[0].observation != pair[1].observation) {
            assert!(has("time-varying"), "{}", case.id);
        }
        assert_eq!(has("large"), path.states() >= 12 || case.id == "large/six-sensors", "{}", case.id);
        assert_eq!(has("long"), path.steps().len() > 100, "{}", case.id);
    }
}

/// No truth is unknown; what is expected is what the exact filter finds.
#[test]
fn every_truth_is_known_and_is_what_the_case_expects() {
    for (case, truth) in TRUTHS.iter() {
        match (truth, case.expect) {
            (Truth::BadInput(why), Expect::Refuse) => assert!(why.len() > 20, "{}: {why}", case.id),
            (Truth::Known(reference), Expect::Estimate) => {
                assert!(reference.contradiction.is_none(), "{}", case.id);
                assert_eq!(reference.values.len(), case.observations.len(), "{}", case.id);
                let last = reference.values.last().expect("there are steps");
                assert!(last.contains_key(&Quantity::FilteredCovariance), "{}", case.id);
                assert_eq!(reference.attainable.len(), reference.values.len(), "{}", case.id);
            }
            (Truth::Known(reference), Expect::Flag) => assert!(reference.contradiction.is_some(), "{}", case.id),
            (truth, expect) => panic!("{}: {expect:?}, but {truth:?}", case.id),
        }
    }
}

#[test]
fn contradictions_are_where_the_text_says() {
    let mut seen = 0;
    for (case, truth) in TRUTHS.iter().filter(|(case, _)| case.expect == Expect::Flag) {
        let said = case.about.split("step ").nth(1).expect("the sentence names the step");
        let said: usize = said.chars().take_while(char::is_ascii_digit).collect::<String>().parse().expect("a step");
        let error = one_shot(&path(case)).expect_err(&case.id);
        assert_eq!(error.step, said, "{}", case.id);
        let Truth::Known(reference) = truth else { panic!("{}", case.id) };
        assert_eq!(reference.contradiction.as_ref().map(|found| found.0), Some(said), "{}", case.id);
        seen += 1;
    }
    assert_eq!(seen, 12);
}

#[test]
fn singular_cases_are_singular() {
    for (case, truth) in TRUTHS.iter() {
        let Truth::Known(reference) = truth else { continue };
        let deficient = reference.ranks.iter().zip(&reference.observed).any(|(rank, observed)| *rank < observed.len());
        let singular = deficient || reference.contradiction.is_some();
        assert_eq!(case.flags.iter().any(|flag| flag == "singular"), singular, "{}", case.id);
    }
}

#[test]
fn the_suite_is_the_same_twice_and_survives_the_stream() {
    let lines = || suite().iter().map(Case::to_line).collect::<Vec<_>>();
    assert_eq!(lines(), lines());
    for case in suite() {
        assert_eq!(Case::parse(&case.to_line()).as_ref(), Ok(&case));
        assert_eq!(Case::parse(&case.to_pretty()).as_ref(), Ok(&case));
        // Half of what a pipe holds.
        assert!(case.to_line().len() < 1 << 15, "{}: {} bytes", case.id, case.to_line().len());
    }
}

/// Another seed draws other readings, and changes nothing else. What must fit together stays.
#[test]
fn a_seed_redraws_made_up_readings_only() {
    let published = suite();
    assert_eq!(published, suite_seeded(0));
    let mut redrawn = 0;
    for seed in [1, 2, u64::MAX] {
        let drawn = suite_seeded(seed);
        assert_eq!(drawn, suite_seeded(seed));
        assert_eq!(drawn.len(), published.len());
        for (old, new) in published.iter().zip(&drawn) {
            let has = |flag: &str| old.flags.iter().any(|known| known == flag);
            let kept = ["real-data", "singular", "contradiction", "bad-input"].into_iter().any(has);
            assert!(!kept || old == new, "{}", old.id);
            if has("adapted") {
                // Their coefficients follow the readings.
                assert_ne!(old, new, "{}", old.id);
                assert_eq!((&old.id, &old.flags), (&new.id, &new.flags));
                continue;
            }
            let readings = new.observations.clone();
            assert_eq!(&Case { observations: readings, ..old.clone() }, new, "{}", old.id);
            redrawn += usize::from(old != new);
            // What is missing is missing with every seed.
            let shape = |case: &Case| -> Vec<Option<Vec<bool>>> {
                let entries = |reading: &Vec<Option<_>>| reading.iter().map(Option::is_some).collect();
                case.observations.iter().map(|reading| reading.as_ref().map(entries)).collect()
            };
            assert_eq!(shape(old), shape(new), "{}", old.id);
            assert!(old.expect == Expect::Refuse || path(new).steps().len() == old.observations.len(), "{}", old.id);
        }
    }
    assert!(redrawn > 3 * 190, "{redrawn}");
    assert_ne!(suite_seeded(1), suite_seeded(2));
}
