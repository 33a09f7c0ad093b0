//! The f64 filters of the house are accused of nothing where doubles are enough, and of what they cannot do where not.

use exact_kalman::float::Form;
use exact_kalman::judge::Verdict;

use crate::known::{known, known_case};

const HARMLESS: [&str; 8] =
    ["basic", "missing", "time-varying", "input", "adapted", "correlated", "arriving", "before-transition"];

#[test]
fn nothing_is_found_on_harmless_cases() {
    let mut seen = 0;
    for known in known().iter().filter(|known| known.case.flags.iter().all(|flag| HARMLESS.contains(&flag.as_str()))) {
        let id = &known.case.id;
        for (form, judgement) in &known.forms {
            if judgement.verdict == Verdict::Unsupported && *form == Form::Information {
                continue;
            }
            assert_eq!(judgement.verdict, Verdict::Agrees, "{form} on {id}: {:?}", judgement.remarks);
            assert!(judgement.scores.len() >= 6, "{form} on {id}");
            assert!(judgement.asymmetric.as_ref().is_none_or(|(.., found)| !found.beyond_rounding), "{form} on {id}");
        }
        seen += 1;
    }
    assert!(seen >= 25, "{seen}");
}

#[test]
fn what_doubles_cannot_do_is_found() {
    let verdict = |form: Form, id: &str| known_case(id).judgement(form).verdict;
    // (I − KC)P of a sensor with variance 10⁻¹⁶ beside one of 10 is rounded away.
    for form in [Form::Textbook, Form::Symmetrised, Form::Sequential] {
        assert_eq!(verdict(form, "units/nearly-exact-sensor"), Verdict::Wrong, "{form}");
    }
    // A prior variance of 10¹² leaves errors of 10¹² · 2⁻⁵³ beside variances near 1.
    for form in [Form::Textbook, Form::Joseph, Form::Symmetrised, Form::Sequential, Form::Information] {
        assert!(verdict(form, "units/nearly-flat-prior").is_finding(), "{form}");
    }
    // With factors it is 10⁶ · 2⁻⁵³ beside deviations near 1.
    for form in [Form::SquareRoot, Form::Ud, Form::Svd] {
        assert_eq!(verdict(form, "units/nearly-flat-prior"), Verdict::Agrees, "{form}");
        assert_eq!(verdict(form, "units/nearly-equal-sensors"), Verdict::Agrees, "{form}");
    }
    // Two units beside each other: a threshold relative to the largest singular value takes the small one for zero.
    assert_eq!(verdict(Form::PseudoInverse, "units/side-by-side"), Verdict::Wrong);
    for form in Form::ALL.into_iter().filter(|form| *form != Form::PseudoInverse) {
        assert_eq!(verdict(form, "units/side-by-side"), Verdict::Agrees, "{form}");
    }
    assert_eq!(verdict(Form::Textbook, "diffuse/trend"), Verdict::Unsupported);
    assert_eq!(verdict(Form::Textbook, "refuse/indefinite-prior"), Verdict::Agrees);
}

#[test]
fn only_reflections_keep_a_sensor_far_better_than_the_prior() {
    let agrees: Vec<Form> = Form::ALL
        .into_iter()
        .filter(|form| known_case("units/nearly-exact-sensor").judgement(*form).verdict == Verdict::Agrees)
        .collect();
    assert_eq!(agrees, [Form::SquareRoot]);
}

#[test]
fn singular_innovations_are_for_those_who_decide_on_ranks() {
    for id in ["singular/equal-sensors", "singular/proportional-sensors", "singular/blind-sensor"] {
        for form in [Form::Textbook, Form::Joseph, Form::Symmetrised] {
            assert_eq!(known_case(id).judgement(form).verdict, Verdict::Error, "{form} on {id}");
        }
        for form in [Form::PseudoInverse, Form::Sequential, Form::SquareRoot, Form::Ud, Form::Svd] {
            assert_eq!(known_case(id).judgement(form).verdict, Verdict::Agrees, "{form} on {id}");
        }
        assert_eq!(known_case(id).judgement(Form::Information).verdict, Verdict::Unsupported, "{id}");
    }
    let contradiction = known_case("singular/equal-sensors-disagree");
    assert_eq!(contradiction.judgement(Form::PseudoInverse).verdict, Verdict::AcceptedBadInput);
}
