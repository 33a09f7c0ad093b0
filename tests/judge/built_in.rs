//! The f64 filters of the house are accused of nothing where doubles are enough.

use exact_kalman::float::Form;
use exact_kalman::judge::{Examinee as _, Judgement, Truth, Verdict, suite};

const HARMLESS: [&str; 8] =
    ["basic", "missing", "time-varying", "input", "adapted", "correlated", "arriving", "before-transition"];

#[test]
fn nothing_is_found_on_harmless_cases() {
    let mut seen = 0;
    for case in suite().iter().filter(|case| case.flags.iter().all(|flag| HARMLESS.contains(&flag.as_str()))) {
        let truth = Truth::of(case);
        for mut form in Form::ALL {
            let judgement = Judgement::of(case.expect, &truth, &form.reply(case));
            assert_eq!(judgement.verdict, Verdict::Agrees, "{form} on {}: {:?}", case.id, judgement.remarks);
            assert!(judgement.scores.len() >= 6, "{form} on {}", case.id);
            assert!(judgement.asymmetric.is_none_or(|(.., found)| !found.beyond_rounding), "{form} on {}", case.id);
        }
        seen += 1;
    }
    assert!(seen >= 25, "{seen}");
}

#[test]
fn what_doubles_cannot_do_is_found() {
    let verdict = |mut form: Form, id: &str| {
        let case = crate::samples::of_suite(id);
        Judgement::of(case.expect, &Truth::of(&case), &form.reply(&case)).verdict
    };
    // (I − KC)P of a sensor with variance 10⁻¹⁶ beside one of 10 is rounded away.
    assert_eq!(verdict(Form::Textbook, "units/nearly-exact-sensor"), Verdict::Wrong);
    // A prior variance of 10¹² leaves errors of 10¹² · 2⁻⁵³ beside variances near 1.
    assert!(verdict(Form::Textbook, "units/nearly-flat-prior").is_finding());
    assert_eq!(verdict(Form::Joseph, "singular/equal-sensors"), Verdict::Error);
    assert_eq!(verdict(Form::PseudoInverse, "singular/equal-sensors"), Verdict::Agrees);
    assert_eq!(verdict(Form::PseudoInverse, "singular/equal-sensors-disagree"), Verdict::AcceptedBadInput);
    assert_eq!(verdict(Form::Textbook, "diffuse/trend"), Verdict::Unsupported);
    assert_eq!(verdict(Form::Textbook, "refuse/indefinite-prior"), Verdict::Agrees);
}
