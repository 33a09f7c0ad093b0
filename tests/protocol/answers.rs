//! Answers: what their numbers mean, and what is refused.

use std::slice::from_ref;

use exact_kalman::matrix::Matrix;
use exact_kalman::protocol::{Answer, AnswerStream, LawAhead, Number, Outcome};
use exact_kalman::scalar::{Rational, exact_value, ratio};
use exact_kalman::trace::{Quantity, Values};
use proptest::prelude::*;

fn step(keys: &str) -> String {
    format!(r#"{{"id":"a","outcome":"answered","steps":[{{}},{{{keys}}}]}}"#)
}

fn first(text: &str) -> Number {
    Answer::parse(text).expect("a sound answer").steps[1][&Quantity::FilteredMean][(0, 0)].clone()
}

fn refusal(text: &str) -> String {
    Answer::parse(text).expect_err(text).to_string()
}

#[test]
fn numbers_and_strings() {
    let mean = |literal: &str| first(&step(&format!(r#""filtered_mean":[{literal}]"#)));
    let tenth = Number::Finite(ratio(3_602_879_701_896_397, 1 << 55));
    assert_eq!(mean("0.1"), tenth);
    assert_eq!(mean("\"0.1\""), tenth);
    assert_eq!(mean("0.1000000000000000055511151231257827021181583404541015625"), tenth);
    assert_eq!(mean("\"0x1.8p-3\""), Number::Finite(ratio(3, 16)));
    assert_eq!(mean("-7"), Number::Finite(ratio(-7, 1)));
    // Halfway between two doubles, plus a digit that a reader of 17 digits never sees.
    assert_eq!(mean("9007199254740993.00000000000000000001"), Number::Finite(ratio(9_007_199_254_740_994, 1)));
    assert_eq!(mean("9007199254740993"), Number::Finite(ratio(9_007_199_254_740_992, 1)));
    assert_eq!(mean("1e400"), Number::Infinite { negative: false });
    for text in ["\"Infinity\"", "\"inf\""] {
        assert_eq!(mean(text), Number::Infinite { negative: false });
    }
    assert_eq!(mean("\"-Infinity\""), Number::Infinite { negative: true });
    for text in ["\"NaN\"", "\"nan\""] {
        assert_eq!(mean(text), Number::NotANumber);
    }
}

#[test]
fn exact_strings_mean_themselves() {
    // The key may come last.
    let text = |literal: &str| {
        format!(r#"{{"id":"a","outcome":"answered","steps":[{{}},{{"filtered_mean":[{literal}]}}],"numbers":"exact"}}"#)
    };
    assert_eq!(first(&text("\"1/3\"")), Number::Finite(ratio(1, 3)));
    assert_eq!(first(&text("\"0.1\"")), Number::Finite(ratio(1, 10)));
    assert_eq!(first(&text("0.1")), Number::Finite(ratio(3_602_879_701_896_397, 1 << 55)));
    assert!(refusal(&text("\"1e5000\"")).starts_with("steps[1].filtered_mean[0]: "));
}

#[test]
fn every_quantity_has_its_key() {
    for quantity in Quantity::ALL.into_iter().filter(|quantity| !quantity.is_number()) {
        let value = if quantity.is_vector() { "[\"1\",\"2\"]" } else { "[[\"1\",\"2\"],[\"3\",\"4\"]]" };
        let answer = Answer::parse(&step(&format!("\"{}\":{value}", quantity.name()))).expect("a sound answer");
        let matrix = &answer.steps[1][&quantity];
        let column = usize::from(!quantity.is_vector());
        assert_eq!((matrix.rows(), &matrix[(0, 0)]), (2, &Number::Finite(ratio(1, 1))));
        let expected = if quantity.is_vector() { 2 } else { 4 };
        assert_eq!(matrix[(1, column)], Number::Finite(ratio(expected, 1)));
        let absent = Answer::parse(&step(&format!("\"{}\":null", quantity.name()))).expect("a sound answer");
        assert!(absent.steps[1].is_empty());
    }
    let number = Answer::parse(&step(r#""log_likelihood":-1.5"#)).expect("an answer");
    assert_eq!(number.steps[1][&Quantity::LogLikelihood], Matrix::column(vec![Number::Finite(ratio(-3, 2))]));
    assert!(Answer::parse(&step(r#""log_likelihood":null"#)).expect("an answer").steps[1].is_empty());
    for other in [r#"["1"]"#, r#"[["1"]]"#, "true"] {
        assert!(Answer::parse(&step(&format!(r#""log_likelihood":{other}"#))).is_err());
    }
}

#[test]
fn laws_ahead() {
    let answer = Answer::parse(&step(r#""ahead":[null,{"mean":["1",2],"covariance":[["1","2"],["3","4"]]}]"#))
        .expect("a sound answer");
    let finite = |value: i64| Number::Finite(ratio(value, 1));
    let law = LawAhead {
        mean: Matrix::column(vec![finite(1), finite(2)]),
        covariance: Matrix::from_fn(2, 2, |i, j| finite(1 + i64::try_from(2 * i + j).expect("small"))),
    };
    assert_eq!(answer.ahead, [vec![], vec![None, Some(law)]]);
    assert_eq!(Answer::parse(&answer.to_line()), Ok(answer));
    // None at all is no list of nothing for each step.
    for none in [r#""ahead":null"#, r#""ahead":[]"#, ""] {
        let answer = Answer::parse(&step(none)).expect("a sound answer");
        assert_eq!(answer.ahead, Vec::<Vec<_>>::new());
        assert!(!answer.to_line().contains("ahead"));
    }
}

#[test]
fn errors_have_paths() {
    let at = |keys: &str, path: &str, word: &str| {
        let message = refusal(&step(keys));
        assert!(message.starts_with(path) && message.contains(word), "{message}");
    };
    at(r#""filterd_mean":["1"]"#, "steps[1]", "unknown key `filterd_mean`");
    at(r#""gain":[["1"]],"gain":[["1"]]"#, "steps[1]", "duplicate key `gain`");
    at(r#""gain":[["1"],["1","2"]]"#, "steps[1].gain: ", "row 1 has 2 entries");
    at(r#""gain":["1"]"#, "steps[1].gain[0]: ", "sequence");
    at(r#""filtered_mean":[["1"]]"#, "steps[1].filtered_mean[0]: ", "sequence");
    at(r#""filtered_mean":"1""#, "steps[1].filtered_mean: ", "sequence");
    at(r#""filtered_mean":[null]"#, "steps[1].filtered_mean[0]: ", "null");
    at(r#""filtered_mean":[{"a":1}]"#, "steps[1].filtered_mean[0]", "map");
    at(r#""filtered_covariance":[["1","one"]]"#, "steps[1].filtered_covariance[0][1]: ", "\"one\" is not a number");
    let law = |mean: &str, covariance: &str| format!(r#""ahead":[null,{{"mean":{mean},"covariance":{covariance}}}]"#);
    at(&law(r#"["1","one"]"#, "[]"), "steps[1].ahead[1].mean[1]: ", "\"one\" is not a number");
    at(&law("[]", r#"[["1"],["1","2"]]"#), "steps[1].ahead[1].covariance: ", "row 1 has 2 entries");
    at(&law("[]", r#"[["1"],["1/0"]]"#), "steps[1].ahead[1].covariance[1][0]: ", "1/0");
    at(r#""ahead":[{"mean":[]}]"#, "steps[1].ahead[0]: ", "missing field `covariance`");
    at(r#""ahead":[{"mean":[],"covariance":[],"gain":[]}]"#, "steps[1].ahead[0]", "unknown field `gain`");
    at(r#""ahead":[],"ahead":[]"#, "steps[1]", "duplicate key `ahead`");
    at(r#""filtered_mean":[NaN]"#, "", "write \"NaN\", in quotes");
    assert!(refusal(r#"{"id":"a"}"#).contains("missing field `outcome`"));
    assert!(refusal(r#"{"id":"a","outcome":"fine"}"#).starts_with("outcome: "));
    assert!(refusal(r#"{"id":"a","outcome":"answered","stepz":[]}"#).contains("unknown field `stepz`"));
    let long = format!(r#""filtered_mean":[{}]"#, "1".repeat(5000));
    at(&long, "steps[1].filtered_mean[0]: ", "5000 characters");
}

#[test]
fn failures_say_where() {
    let answer =
        Answer::parse(r#"{"id":"a","outcome":"error","step":3,"message":"singular"}"#).expect("a sound answer");
    assert_eq!((answer.outcome, answer.step, answer.message.as_deref()), (Outcome::Error, Some(3), Some("singular")));
    assert_eq!(answer.steps.len(), 0);
}

fn values<T: Clone>(mean: &[T], covariance: &[T]) -> Values<T> {
    let n = mean.len();
    Values::from([
        (Quantity::FilteredMean, Matrix::column(mean.to_vec())),
        (Quantity::FilteredCovariance, Matrix::from_fn(n, n, |i, j| covariance[i * n + j].clone())),
    ])
}

proptest! {
    #[test]
    fn doubles_come_back(mean in prop::array::uniform2(any::<f64>()), covariance in prop::array::uniform4(any::<f64>())) {
        let line = Answer::answered("x", vec![values(&mean, &covariance), Values::new()]).to_line();
        let expected = |value: &f64| match exact_value(*value) {
            Some(value) => Number::Finite(value),
            None if value.is_nan() => Number::NotANumber,
            None => Number::Infinite { negative: *value < 0.0 },
        };
        let back = Answer::parse(&line).expect("a sound answer");
        prop_assert_eq!(&back.steps[0], &values(&mean.map(|v| expected(&v)), &covariance.map(|v| expected(&v))));
        prop_assert_eq!(back.steps.len(), 2);
        prop_assert_eq!(Answer::parse(&back.to_line()), Ok(back));
    }

    #[test]
    fn fractions_come_back(n in any::<i64>(), d in 1..=i64::MAX) {
        let value = Rational::new(n.into(), d.into());
        let line = Answer::answered("x", vec![values(from_ref(&value), from_ref(&value))]).to_line();
        prop_assert!(line.contains("\"numbers\":\"exact\""));
        let value = Number::Finite(value);
        prop_assert_eq!(&Answer::parse(&line).expect("a sound answer").steps[0], &values(from_ref(&value), from_ref(&value)));
    }
}

/// Step by step and in one piece an answer reads the same, whatever came of it.
#[test]
fn an_answer_that_is_written_while_it_is_found_reads_the_same() {
    let number = |value| Matrix::column(vec![ratio(value, 3)]);
    let step = |value| Values::from([(Quantity::FilteredMean, number(value))]);
    let law = LawAhead { mean: number(1), covariance: number(2) };
    let ahead = [vec![None, Some(law.clone())], vec![Some(law)], vec![]];
    for steps in 0..=3_usize {
        for (outcome, place, message) in
            [(Outcome::Answered, None, None), (Outcome::Error, Some(steps), Some("quoted \"so\"".to_owned()))]
        {
            let mut line = Vec::new();
            let mut stream = AnswerStream::begin::<Rational>(&mut line, "a \"b\"").expect("memory takes it");
            for (k, laws) in ahead.iter().enumerate().take(steps) {
                stream.step(&step(i64::try_from(k).expect("few steps")), laws).expect("memory takes it");
            }
            stream.end(outcome, place, message.clone()).expect("memory takes it");
            let mut whole = Answer::answered(
                "a \"b\"",
                (0..i64::try_from(steps).expect("few steps")).map(step).collect::<Vec<_>>(),
            );
            whole.ahead = ahead[..steps].to_vec();
            let whole = Answer { outcome, step: place, message, ..whole }.to_line();
            let line = String::from_utf8(line).expect("JSON is text");
            assert!(line.ends_with("}\n") && line.lines().count() == 1, "{line}");
            assert_eq!(Answer::parse(&line).expect("an answer"), Answer::parse(&whole).expect("an answer"));
        }
    }
}
