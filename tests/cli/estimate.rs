//! `estimate`: proved digits, and refusals with their place.

use std::collections::BTreeSet;

use serde_json::Value;

use crate::program::{feed, run};

const COIN: &str = "examples/estimate/coin.json";
const SLAB: &str = "examples/estimate/slab.json";
const OUTPUT: &str = include_str!("../../schema/estimates.schema.json");

fn value<'a>(text: &'a str, quantity: &str) -> &'a str {
    let line = text.lines().find_map(|line| line.trim_start().strip_prefix(&format!("{quantity}  "))).expect(quantity);
    line.trim()
}

#[test]
fn the_coin_in_proved_digits() {
    // 1/(1 + exp(−1/4)), computed without this crate; the affine estimate by hand: 5/9.
    let out = run(&["estimate", COIN, "--digits", "50"]).quietly(0);
    assert!(out.starts_with("coin · after step 0\n"), "{out}");
    let mean = "0.56217650088579810402732363790294635383795939625767";
    assert_eq!(value(&out, "best estimate"), mean);
    assert!(value(&out, "probabilities").ends_with(&format!("{mean}]")));
    assert_eq!(value(&out, "best affine estimate"), format!("0.{}6", "5".repeat(49)));
    let last = run(&["estimate", COIN, "--last"]).quietly(0);
    assert!(last.starts_with("coin · after step 1\n") && last.lines().count() == 7, "{last}");
    assert_eq!(run(&["estimate", COIN, "--digits", "3", "--exact"]).code, 2);
}

#[test]
fn fractions_where_there_are_any() {
    // A Gaussian start: 0 and 1 as the filter has them in docs/PROTOCOL.md: mean 1/2 and variance 3/2 ahead of step 1.
    let gaussian = std::fs::read_to_string(COIN)
        .expect("JSON")
        .replace(r#"{"weight": "1/2", "mean": ["0"]},"#, "")
        .replace(r#"{"weight": "1/2", "mean": ["1"]}"#, r#"{"weight": "1", "mean": ["0"], "covariance": [["1"]]}"#)
        .replace(r#""observation": [["2"]]"#, r#""observation": [["1"]]"#);
    let out = feed(&["estimate", "-", "--exact"], &gaussian).quietly(0);
    for (quantity, expected) in [
        ("best estimate", "1/2"),
        ("best affine estimate", "1/2"),
        ("difference", "0"),
        ("probabilities", "1"),
        ("covariance", "3/2"),
        ("covariance of the affine error", "3/2"),
    ] {
        assert_eq!(value(&out, quantity), expected);
    }
    let out = run(&["estimate", SLAB, "--exact", "--last"]).quietly(0);
    assert!(value(&out, "best estimate").contains('…') && value(&out, "best affine estimate") == "[952/229, 411/458]");
}

#[test]
fn the_price() {
    // ξ = ±1 through noise of variance 1: E(tanh Y − Y/2)² = 0.0504004907933….
    let coin = std::fs::read_to_string(COIN)
        .expect("JSON")
        .replace(r#""mean": ["0"]"#, r#""mean": ["-1"]"#)
        .replace(r#""observation": [["2"]]"#, r#""observation": [["1"]]"#);
    let out = feed(&["estimate", "-", "--price", "--digits", "12"], &coin).quietly(0);
    assert_eq!(value(&out, "price of linearity"), "0.0504004907933", "{out}");
    // Two directions; the digits of three and of ten agree.
    let slab = |digits| run(&["estimate", SLAB, "--price", "--last", "--digits", digits]).quietly(0);
    let (few, many) = (slab("3"), slab("10"));
    let [few, many] = [&few, &many].map(|out| value(out, "price of linearity"));
    assert!(many.len() > few.len() && few.len() > 3, "{few} {many}");
    assert!(
        (few.parse::<f64>().expect("a number") / many.parse::<f64>().expect("a number") - 1.0).abs() < 0.005,
        "{few} {many}"
    );
}

#[test]
fn three_directions_are_simulated_and_say_so() {
    let corner = |x: &str| format!(r#"{{"weight": "1/2", "mean": ["{x}", "{x}", "{x}"]}}"#);
    let slab = r#"{"weight": "1/2", "mean": ["0", "0", "0"], "covariance": [["1", "0", "0"], ["0", "1", "0"], ["0", "0", "1"]]}"#;
    let unit = r#"[["1", "0", "0"], ["0", "1", "0"], ["0", "0", "1"]]"#;
    let case = format!(
        r#"{{"format": "exact-kalman/estimate/1", "id": "cube", "initial_law": [{}, {slab}], "transition": {unit},
        "observation": {unit}, "noise": {{"process": {unit}, "observation": {unit}}}, "observations": [["1", "2", "3"]]}}"#,
        corner("1")
    );
    let of = |seed| feed(&["estimate", "-", "--price", "--price-draws", "1000", "--seed", seed], &case).quietly(0);
    let (one, same, other) = (of("1"), of("1"), of("2"));
    let text = value(&one, "price of linearity").to_owned();
    assert!(text.starts_with("unsupported (the readings see 3 directions"), "{text}");
    assert!(text.contains("simulated") && text.ends_with("of 1000 draws, seed 1; no proof"), "{text}");
    assert!(one == same && one != other);
    assert_eq!(feed(&["estimate", "-", "--price-draws", "1000"], &case).code, 2);
}

#[test]
fn json_has_the_same_texts() {
    let out = run(&["estimate", SLAB, "--format", "json", "--digits", "20"]).quietly(0);
    let answer: Value = serde_json::from_str(&out).expect("JSON");
    let text = run(&["estimate", SLAB, "--digits", "20", "--last"]).quietly(0);
    let last = &answer["steps"][2];
    assert_eq!((answer["id"].as_str(), last["step"].as_i64()), (Some("slab"), Some(2)));
    let row = |value: &Value| {
        let entries: Vec<&str> =
            value.as_array().expect("a list").iter().map(|entry| entry.as_str().expect("a string")).collect();
        format!("[{}]", entries.join(", "))
    };
    for (key, quantity) in [("mmse", "best estimate"), ("lmmse", "best affine estimate"), ("weights", "probabilities")]
    {
        assert_eq!(row(&last[key]), value(&text, quantity));
    }
    assert!(value(&text, "covariance").contains(&row(&last["covariance"][1])));
}

#[test]
fn refusals_name_the_place() {
    let coin = std::fs::read_to_string(COIN).expect("an example");
    let refusal = |from: &str, to: &str| {
        assert!(coin.contains(from));
        feed(&["estimate", "-"], &coin.replacen(from, to, 1)).trouble()
    };
    for (from, to, expected) in [
        (r#"[["2"]]"#, r#"[["0"]]"#, "noise.observation: at step 0 it is singular: v = [1] has Rv = 0"),
        (r#""weight": "1/2""#, r#""weight": "1/3""#, "initial_law: the weights do not add up to one, but to 5/6"),
        (
            r#""weight": "1/2""#,
            r#""weight": "-1/2""#,
            "initial_law[0].weight: the weight of component 0 is not positive",
        ),
        (r#""weight": "1/2""#, r#""weight": "half""#, "initial_law[0].weight: "),
        (
            r#"["1"]}"#,
            r#"["1"], "covariance": [["-3"]]}"#,
            "initial_law[1].covariance: initial covariance is not positive semidefinite: v = [1] has vᵀPv = -3",
        ),
        (r#"["1"]}"#, r#"["1", "2"]}"#, "initial_law[1].mean: has 2 entries; that of the first component has 1"),
        (r#"["1"]}"#, r#"["x"]}"#, "initial_law[1].mean[0]: "),
        (r#""weight": "1/2","#, r#""weight": 0.5,"#, "initial_law[0].weight"),
        (r#""weight": "1/2","#, "", "missing field `weight`"),
        (r#""id""#, r#""name""#, "name: unknown field `name`"),
        ("estimate/1", "case/1", "format"),
    ] {
        let message = refusal(from, to);
        assert!(message.contains(expected), "{message}");
    }
    assert!(run(&["estimate", "no-such-file"]).trouble().contains("no-such-file"));
    assert!(
        feed(
            &["estimate", "-"],
            &coin
                .replace('\n', "")
                .replace(r#"{"weight": "1/2", "mean": ["0"]},"#, "")
                .replace(r#"{"weight": "1/2", "mean": ["1"]}"#, "")
        )
        .trouble()
        .contains("initial_law")
    );
}

/// The coin with other values than 0 and 1, and no noise of the process, so that the state remains one of them.
fn still_coin(values: &[&str]) -> String {
    let component = |value: &&str| format!(r#"{{"weight": "1/{}", "mean": ["{value}"]}}"#, values.len());
    let components: Vec<String> = values.iter().map(component).collect();
    let mut case: Value = serde_json::from_str(&std::fs::read_to_string(COIN).expect("an example")).expect("JSON");
    case["initial_law"] = serde_json::from_str(&format!("[{}]", components.join(", "))).expect("JSON");
    case["noise"]["process"] = serde_json::json!([["0"]]);
    case.to_string()
}

#[test]
fn digits_of_any_size() {
    // exp(−(10⁶ − 1)²/4 + 1/4), by mpmath.
    let far = std::fs::read_to_string(COIN).expect("an example").replace(r#""mean": ["1"]"#, r#""mean": ["1000000"]"#);
    let out = feed(&["estimate", "-", "--digits", "30"], &far).quietly(0);
    assert_eq!(value(&out, "best estimate"), "2.67913571025738870778588971739e-108573403323");
    assert_eq!(value(&out, "probabilities"), "[1, 2.67913571025738870778588971739e-108573403329]");
    // Exponents beyond 2⁶² are only bounded; the other entries are as they are: μ = 5·10⁹ and Δ = μ² make the affine estimate
    // 1 + 2(μ − 1)/(Δ + 2).
    let out = feed(&["estimate", "-"], &far.replace("1000000", "10000000000")).quietly(0);
    assert_eq!(value(&out, "probabilities"), "[1, <2^-4611686018427387903]");
    assert!(value(&out, "best estimate").starts_with("<2^-46116860184273878"), "{out}");
    assert_eq!((value(&out, "covariance"), value(&out, "best affine estimate")), ("1", "1.0000000004"));
}

#[test]
fn ties_are_decided_however_near() {
    // 3/2, and a little more or less: exp(−10¹⁰/4), and beyond all exponents.
    for (other, expected) in [("100001", "2"), ("-100001", "1"), ("100000000001", "2"), ("-100000000001", "1")] {
        let out = feed(&["estimate", "-", "--digits", "1"], &still_coin(&["3/2", other])).quietly(0);
        assert_eq!((value(&out, "best estimate"), out.lines().count()), (expected, 14), "{out}");
    }
}

#[test]
fn what_is_unknown_is_told_in_its_place() {
    let out = feed(&["estimate", "-"], &still_coin(&["0", "10000000000", "-10000000000"])).quietly(0);
    let reason = "unknown (entry 0 of the best estimate, after step 0: its absolute value is below 2^-46116860184";
    assert!(value(&out, "best estimate").starts_with(reason), "{out}");
    assert!(value(&out, "probabilities").starts_with("[1, <2^-46116860184"), "{out}");
    assert!(
        out.lines().count() == 14 && out.contains("unknown (entry 0 of the best estimate, after step 1: "),
        "{out}"
    );
}

#[test]
fn exact_marks_what_is_rounded() {
    // By mpmath from the joint law of the readings: 3.815789627135379203478…, 0.642456254927749805263….
    let out = run(&["estimate", SLAB, "--exact", "--last"]).quietly(0);
    assert_eq!(value(&out, "best estimate"), "[3.8157896271353792…, 0.64245625492774981…]");
    assert_eq!(value(&out, "best affine estimate"), "[952/229, 411/458]");
    let json = run(&["estimate", SLAB, "--exact", "--last", "--format", "json"]).quietly(0);
    let answer: Value = serde_json::from_str(&json).expect("JSON");
    assert_eq!(answer["steps"][0]["mmse"], serde_json::json!(["3.8157896271353792…", "0.64245625492774981…"]));
    let help = run(&["estimate", "--help"]).quietly(0);
    assert!(help.contains("followed by `…`") && help.contains("unknown (…)"), "{help}");
    let schema: Value = serde_json::from_str(OUTPUT).expect("JSON");
    assert!(schema["$defs"]["number"]["description"].as_str().expect("a string").contains('…'));
}

#[test]
fn digits_of_another_program() {
    // By mpmath from the joint law of the readings.
    let out = run(&["estimate", SLAB, "--digits", "40", "--last"]).quietly(0);
    assert!(!out.contains('…'), "{out}");
    for digits in [
        "[3.815789627135379203478403040255092155588, 0.6424562549277498052638742700571354761726]",
        "[[2.229946318702349009563131106560897858259, 1.018359917964420593807137892898803734167]",
        "[0.5466853675692276313223271573806100046471, 0.4533146324307723686776728426193899953529]",
    ] {
        assert!(out.contains(digits), "{digits}: {out}");
    }
    // 300 atoms, which must not take the square of their number.
    let mut case: Value = serde_json::from_str(&std::fs::read_to_string(COIN).expect("an example")).expect("JSON");
    let atom = |i: u32| serde_json::json!({"weight": "1/300", "mean": [(i * 7 % 300).to_string()]});
    case["initial_law"] = (0..300).map(atom).collect();
    case["observations"] = serde_json::json!([["3"]]);
    let out = feed(&["estimate", "-", "--digits", "24"], &case.to_string()).quietly(0);
    assert_eq!(value(&out, "best estimate"), "3.02374490141924747699494");
    assert_eq!(value(&out, "covariance"), "2.91282972630840649346271");
}

/// Help, schema and page name the forms that a price can have.
#[test]
fn the_forms_of_a_price_are_told() {
    let help = run(&["estimate", "--help"]).quietly(0);
    let schema: Value = serde_json::from_str(OUTPUT).expect("JSON");
    let price = &schema["properties"]["steps"]["items"]["properties"]["price"]["description"];
    for text in [&help, price.as_str().expect("a string"), include_str!("../../docs/ESTIMATE.md")] {
        assert!(text.contains("from … to …") && text.contains("unsupported (") && text.contains("simulat"), "{text}");
    }
    assert!(!help.contains("Every digit is proved"));
}

/// Every key of the output, and nothing else, is in its schema; required are all but the price.
#[test]
fn the_output_has_its_schema() {
    let schema: Value = serde_json::from_str(OUTPUT).expect("JSON");
    let keys = |value: &Value| value.as_object().expect("an object").keys().cloned().collect::<BTreeSet<_>>();
    let required = |schema: &Value| {
        let names = schema["required"].as_array().expect("a list").iter();
        names.map(|name| name.as_str().expect("a string").to_owned()).collect::<BTreeSet<_>>()
    };
    let answer = |arguments: &[&str]| -> Value {
        serde_json::from_str(&run(&[&["estimate", COIN, "--format", "json"], arguments].concat()).quietly(0))
            .expect("JSON")
    };
    let step = &schema["properties"]["steps"]["items"];
    let plain = answer(&[]);
    assert_eq!((keys(&plain), keys(&plain["steps"][0])), (required(&schema), required(step)));
    assert_eq!(keys(&answer(&["--price"])["steps"][1]), keys(&step["properties"]));
}
