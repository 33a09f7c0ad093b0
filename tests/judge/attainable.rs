//! What is attainable: reproducible, and as one computes it by hand.

use exact_kalman::judge::{Reference, suite};
use exact_kalman::protocol::{Case, Expect};
use exact_kalman::trace::Quantity;
use serde_json::json;

use crate::samples::{belief, of_suite, path};

fn reference(case: &Case) -> Reference {
    Reference::of(&path(case)).expect("a solvable problem")
}

#[test]
fn a_constant_read_once_by_hand() {
    // x ~ N(0, 1), y = x + v = 1 with variance 1: mean C P y/(C²P + R) = 1/2, variance P R/(C²P + R) = 1/2.
    // Move each datum by ±u, u = 2⁻⁵³, and to first order
    //     mean      moves relatively by  p/2 − r/2 + y,   at most 2u: by 1/2 · 2u = u,   in units of √(1/2);
    //     variance  moves relatively by  p/2 + r/2 − c,   at most 2u: by 1/2 · 2u = u,   in units of 1/2.
    // Each extreme needs three signs of eight, or their opposites: among twenty draws it is there.
    let reference = reference(&of_suite("basic/constant"));
    let log2 = std::f64::consts::LOG10_2;
    let at = |quantity| reference.attainable[0][&quantity].value();
    assert!((at(Quantity::FilteredMean) - 52.5 * log2).abs() < 1e-12, "{}", at(Quantity::FilteredMean));
    assert!((at(Quantity::FilteredCovariance) - 52.0 * log2).abs() < 1e-12, "{}", at(Quantity::FilteredCovariance));
    // The prior mean is zero, so it is not moved; the prior variance moves by u, in units of 1.
    assert_eq!(at(Quantity::PredictedMean).to_bits(), 17.0_f64.to_bits());
    assert!((at(Quantity::PredictedCovariance) - 53.0 * log2).abs() < 1e-12);
}

#[test]
fn cancellation_costs_what_it_costs() {
    // The difference of two readings near 10⁶, each moved by u, is 1: the innovation of the second keeps 6 digits less.
    let text = json!({"format": "exact-kalman/case/1", "id": "far", "timing": "departing",
        "initial": {"before": "observation", "mean": ["1048576"], "covariance": [["1"]]},
        "transition": [["1"]], "observation": [["1"]],
        "noise": {"process": [["0"]], "observation": [["1"]]}, "observations": [["1048577"]]});
    let reference = reference(&Case::parse(&text.to_string()).expect("a sound case"));
    // ν = y − C m: three data of relative move u, of which y and C m reach 3·2²⁰u together; its unit is √2, S = 2.
    let expected = -(3.0 * 2.0_f64.powi(20 - 53) / 2.0_f64.sqrt()).log10();
    let found = reference.attainable[0][&Quantity::Innovation].value();
    assert!((found - expected).abs() < 1e-5, "{found} {expected}");
}

#[test]
fn a_nearly_singular_prior_is_moved_as_rounding_moves_it() {
    // P = [[1, c], [c, 1]], c = 1 − 2⁻³⁰, and the difference is read without noise: S = 2 − 2c = 2⁻²⁹. Moving the
    // entries by u moves S by up to 4u of that size: it keeps 53 − 2 − 29 bits at least.
    let close = 1.0 - 2.0_f64.powi(-30);
    let text = json!({"format": "exact-kalman/case/1", "id": "close", "timing": "departing",
        "initial": {"before": "observation", "mean": ["0", "0"],
            "covariance": [["1", close.to_string()], [close.to_string(), "1"]]},
        "transition": [["1", "0"], ["0", "1"]], "observation": [["1", "-1"]],
        "noise": {"process": [["0", "0"], ["0", "0"]], "observation": [["0"]]}, "observations": [["0.00001"]]});
    let reference = reference(&Case::parse(&text.to_string()).expect("a sound case"));
    let bits = reference.attainable[0][&Quantity::InnovationCovariance].value() / std::f64::consts::LOG10_2;
    assert!((22.0 - 0.01..=24.0).contains(&bits), "{bits}");
}

#[test]
fn the_same_twice() {
    for id in ["basic/two-sensors", "correlated/factors-arriving", "diffuse/trend", "varying/transition"] {
        let case = of_suite(id);
        assert_eq!(reference(&case).attainable, reference(&case).attainable, "{id}");
    }
}

#[test]
fn a_belief_that_nothing_changes_keeps_all_digits_but_those_of_its_data() {
    // Zeros are not moved, so nothing at all is.
    let reference = reference(&belief(&json!(["0"]), &json!([["0"]]), 3));
    assert!(reference.attainable.iter().all(|step| step.values().all(|digits| digits.value() >= 17.0)));
}

#[test]
fn singular_innovations_and_contradictions_have_at_most_fifteen() {
    let mut structural = 0;
    for case in
        suite().iter().filter(|case| case.id.starts_with("singular/") && case.flags.contains(&"singular".into()))
    {
        let reference = reference(case);
        assert!(reference.structural, "{}", case.id);
        assert!(!reference.attainable.is_empty(), "{}", case.id);
        for digits in reference.attainable.iter().flat_map(|step| step.values()) {
            // These cases are as well conditioned as they are singular.
            assert!((14.0..=15.0).contains(&digits.value()), "{}", case.id);
        }
        structural += 1;
    }
    assert_eq!(structural, 26);
}

/// Two sensors that say nearly the same, and a third that sees nothing: its innovation is zero with variance zero, which
/// makes the covariance singular and the problem no easier.
#[test]
fn a_blind_sensor_makes_nothing_attainable() {
    let case = |blind: bool| {
        let noise = "9.094947017729282379150390625e-13";
        let (mut rows, mut reading) = (vec![json!(["1", "1"]), json!(["1", "1.00000095367431640625"])], vec!["3", "3"]);
        let mut variances = vec![json!([noise, "0"]), json!(["0", noise])];
        if blind {
            rows.push(json!(["0", "0"]));
            reading.push("0");
            variances = vec![json!([noise, "0", "0"]), json!(["0", noise, "0"]), json!(["0", "0", "0"])];
        }
        let text = json!({"format": "exact-kalman/case/1", "id": "collinear", "timing": "departing",
            "initial": {"before": "observation", "mean": ["0", "0"], "covariance": [["1", "0"], ["0", "1"]]},
            "transition": [["1", "0"], ["0", "1"]], "observation": rows,
            "noise": {"process": [["0", "0"], ["0", "0"]], "observation": variances}, "observations": [reading]});
        reference(&Case::parse(&text.to_string()).expect("a sound case"))
    };
    let (regular, singular) = (case(false), case(true));
    assert!(!regular.structural && singular.structural);
    for quantity in [Quantity::FilteredMean, Quantity::FilteredCovariance] {
        let [regular, singular] = [&regular, &singular].map(|reference| reference.attainable[0][&quantity].value());
        assert!(regular < 11.0, "{quantity}: {regular}");
        assert!((regular - singular).abs() < 1.5, "{quantity}: {regular} and {singular}");
    }
}

#[test]
fn regular_cases_are_moved() {
    for case in
        suite().iter().filter(|case| case.expect == Expect::Estimate && !case.flags.contains(&"singular".into()))
    {
        // The long ones are like the short ones.
        if case.observations.len() <= 15 {
            assert!(!reference(case).structural, "{}", case.id);
        }
    }
}

#[test]
fn a_diffuse_start_that_moved_data_would_resolve_elsewhere_is_structure() {
    // The diffuse direction is (1, 2), and (2, −1) is read: it learns nothing of it until the transition turns it.
    let text = json!({"format": "exact-kalman/case/1", "id": "hidden", "timing": "departing",
        "initial": {"before": "observation", "mean": ["0", "0"], "covariance": [["1", "0"], ["0", "1"]],
            "diffuse": [["1", "2"], ["2", "4"]]},
        "transition": [["0.1", "0.3"], ["0.5", "0.7"]], "observation": [["0.2", "-0.1"]],
        "noise": {"process": [["0", "0"], ["0", "0"]], "observation": [["1"]]}, "observations": [["1"], ["2"], ["1"]]});
    let reference = reference(&Case::parse(&text.to_string()).expect("a sound case"));
    assert!(!reference.values[0].contains_key(&Quantity::FilteredMean), "y_0 does not resolve it");
    assert!(reference.values[1].contains_key(&Quantity::FilteredMean), "y_1 does");
    assert!(reference.structural);
}
