//! Cases: what they mean, and that printing and reading are inverse.

use std::collections::BTreeMap;

use exact_kalman::matrix::Matrix;
use exact_kalman::model::{Before, Coefficient, Noise, Timing};
use exact_kalman::protocol::{
    Along, Case, CaseFormat, Entry, Expect, InitialLaw, InputTerm, Matrices, NoiseLaw, Numbers, Rows, Vectors,
};
use exact_kalman::scalar::ratio;
use proptest::collection::vec;
use proptest::option;
use proptest::prelude::*;

use crate::samples::{full, walk, with};

fn entry() -> impl Strategy<Value = Entry> {
    prop_oneof![
        any::<f64>().prop_map(Entry::from),
        Just(Entry::from("1e999")),
        Just(Entry::from("NaN")),
        "[ -~é\"\\\\]{0,6}".prop_map(Entry::from)
    ]
}

fn rows() -> impl Strategy<Value = Rows> {
    // Ragged ones are among them: documents carry them.
    vec(vec(entry(), 1..3), 1..3)
}

fn matrices() -> impl Strategy<Value = Matrices> {
    prop_oneof![rows().prop_map(Along::Constant), vec(option::of(rows()), 1..4).prop_map(Along::PerStep)]
}

fn vectors() -> impl Strategy<Value = Vectors> {
    let vector = || vec(entry(), 1..3);
    prop_oneof![vector().prop_map(Along::Constant), vec(option::of(vector()), 1..4).prop_map(Along::PerStep)]
}

fn noise() -> impl Strategy<Value = NoiseLaw> {
    prop_oneof![
        (matrices(), option::of(matrices()), matrices())
            .prop_map(|(process, cross, observation)| NoiseLaw::Covariances { process, cross, observation }),
        (matrices(), matrices()).prop_map(|(process, observation)| NoiseLaw::Factors { process, observation }),
    ]
}

fn input() -> impl Strategy<Value = Option<InputTerm>> {
    option::of((option::of(matrices()), vectors()).prop_map(|(matrix, vector)| InputTerm { matrix, vector }))
}

prop_compose! {
    fn any_case()(
        (id, about, flags) in (".{1,12}", ".{0,12}", vec("[a-z-]{1,8}", 0..3)),
        numbers in prop_oneof![Just(Numbers::Binary64), Just(Numbers::Binary32), Just(Numbers::Exact)],
        expect in prop_oneof![Just(Expect::Estimate), Just(Expect::Refuse), Just(Expect::Flag)],
        (arriving, before, allow_indefinite) in any::<(bool, bool, bool)>(),
        (mean, covariance, diffuse) in (vec(entry(), 0..3), rows(), option::of(rows())),
        (transition, observation, noise) in (matrices(), matrices(), noise()),
        (input, observation_input) in (input(), input()),
        rules in proptest::collection::btree_map("[a-z_]{1,8}", ".{0,8}", 0..3),
        observations in vec(option::of(vec(option::of(entry()), 0..3)), 0..4),
    ) -> Case {
        let timing = if arriving { Timing::Arriving } else { Timing::Departing };
        let before = if before { Before::Observation } else { Before::Transition };
        Case {
            format: CaseFormat::One, id, about, numbers, expect, flags, timing,
            initial: InitialLaw { before, mean, covariance, diffuse, allow_indefinite },
            transition, observation, noise, input, observation_input, rules, observations,
        }
    }
}

proptest! {
    #[test]
    fn reading_inverts_printing(case in any_case()) {
        let line = case.to_line();
        prop_assert!(!line.contains('\n'));
        prop_assert_eq!(Case::parse(&line), Ok(case.clone()));
        let pretty = case.to_pretty();
        prop_assert_eq!(Case::parse(&pretty), Ok(case));
        // Pretty printing adds nothing but white space: another reader sees the same value.
        let values = |text: &str| serde_json::from_str::<serde_json::Value>(text).expect("JSON");
        prop_assert_eq!(values(&pretty), values(&line));
    }

    #[test]
    fn meaning_never_panics(case in any_case()) {
        if let Ok(problem) = case.problem() {
            let _any = problem.realised();
        }
    }
}

#[test]
fn fields_stand_in_the_order_of_the_format() {
    let line = Case::parse(&full().to_string()).expect("a sound case").to_line();
    let keys = [
        "format",
        "id",
        "about",
        "numbers",
        "expect",
        "flags",
        "timing",
        "initial",
        "before",
        "mean",
        "covariance",
        "diffuse",
        "transition",
        "observation",
        "noise",
        "process",
        "cross",
        "observation",
        "input",
        "matrix",
        "vector",
        "observation_input",
        "vector",
        "rules",
        "observations",
    ];
    let mut rest = line.as_str();
    for key in keys {
        let place = rest.find(&format!("\"{key}\":")).unwrap_or_else(|| panic!("{key} in {rest}"));
        rest = &rest[place + 1..];
    }
    // And nothing is lost.
    assert_eq!(serde_json::from_str::<serde_json::Value>(&line).expect("JSON"), full());
}

#[test]
fn a_case_means_its_numbers() {
    let problem = Case::parse(&full().to_string()).expect("a sound case").problem().expect("a sound case");
    assert_eq!(problem.system.timing, Timing::Departing);
    assert_eq!(problem.system.initial.covariance[(0, 1)], ratio(1, 2));
    let Coefficient::PerStep(transitions) = &problem.system.transition else { panic!("one per step") };
    assert_eq!(transitions[1].as_ref().expect("present")[(0, 1)], ratio(1, 2));
    assert_eq!(transitions[2], None);
    let Noise::Covariances { cross: Some(Coefficient::Constant(cross)), .. } = &problem.system.noise else {
        panic!("covariances")
    };
    assert_eq!(*cross, Matrix::column(vec![ratio(1, 2), ratio(0, 1)]));
    assert_eq!(problem.observations[1].entries(), [None]);
    assert_eq!(problem.observations[2].entries(), [Some(ratio(-350, 1))]);
    assert_eq!(
        problem.realised().expect("a sound system").steps()[0].transition.as_ref().expect("present").input[(1, 0)],
        ratio(6, 1)
    );
}

#[test]
fn optional_fields_have_their_defaults() {
    let case = Case::parse(&walk().to_string()).expect("a sound case");
    assert_eq!((case.numbers, case.expect), (Numbers::Binary64, Expect::Estimate));
    assert_eq!((case.about.as_str(), case.flags.len(), case.rules), ("", 0, BTreeMap::new()));
}

#[test]
fn readings_that_are_all_missing_have_the_rows_of_the_observation_matrix() {
    let sample = with(walk(), "/observations", serde_json::json!([null, null]));
    let problem = Case::parse(&sample.to_string()).expect("a sound case").problem().expect("a sound case");
    assert_eq!(problem.realised().expect("a sound system").sensors(), 1);
}

#[test]
fn the_three_meanings_of_a_literal() {
    for (numbers, tenth) in [
        ("binary64", ratio(3_602_879_701_896_397, 1 << 55)),
        ("binary32", ratio(13_421_773, 1 << 27)),
        ("exact", ratio(1, 10)),
    ] {
        let sample = with(with(walk(), "/numbers", numbers.into()), "/initial/mean/0", "0.1".into());
        let problem = Case::parse(&sample.to_string()).expect("a sound case").problem().expect("a sound case");
        assert_eq!(problem.system.initial.mean[(0, 0)], tenth);
    }
}

#[test]
fn builders_write_the_shortest_text() {
    let matrix = Matrix::from_rows(vec![vec![0.1, -2.0]]).expect("rows of one length");
    let text = |value: &Matrices| serde_json::to_string(value).expect("JSON");
    assert_eq!(text(&Matrices::constant(&matrix)), r#"[["0.1","-2"]]"#);
    assert_eq!(text(&Matrices::per_step([Some(&matrix), None])), r#"[[["0.1","-2"]],null]"#);
    assert_eq!(text(&Matrices::exact(&Matrix::column(vec![ratio(1, 3)]))), r#"[["1/3"]]"#);
    let vector = serde_json::to_string(&Vectors::per_step([Some(&[1e300][..]), None])).expect("JSON");
    assert_eq!(vector, r#"[["1e300"],null]"#);
    assert_eq!(serde_json::to_string(&Vectors::constant(&[0.5])).expect("JSON"), r#"["0.5"]"#);
}

#[test]
fn a_pretty_case_keeps_rows_on_one_line() {
    let pretty = Case::parse(&full().to_string()).expect("a sound case").to_pretty();
    assert!(pretty.contains("\n  \"observation\": [[\"1\", \"0\"]],\n"), "{pretty}");
    assert!(pretty.ends_with("}\n"));
}
