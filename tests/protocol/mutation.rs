//! Whatever bytes arrive: an answer or an error, never a panic.

use exact_kalman::protocol::{Answer, Case};
use proptest::prelude::*;

use crate::samples::full;

const ANSWER: &str = r#"{"id":"a","outcome":"answered","numbers":"exact","step":1,"message":"é","steps":[
    {"filtered_mean":["1/3",2.5],"filtered_covariance":[["1","0x1p3"],["NaN",1e400]],"gain":null,"log_likelihood":-1.5}]}"#;

/// One change of the bytes: replace, delete, insert, duplicate a stretch.
fn mutated(mut bytes: Vec<u8>, changes: &[(u8, prop::sample::Index, u8)]) -> Vec<u8> {
    for (kind, index, byte) in changes {
        if bytes.is_empty() {
            break;
        }
        let place = index.index(bytes.len());
        match kind % 5 {
            0 => bytes[place] = *byte,
            1 => drop(bytes.remove(place)),
            2 => bytes.insert(place, *byte),
            3 => bytes.truncate(place),
            _ => {
                let end = (place + usize::from(*byte)).min(bytes.len());
                let stretch = bytes[place..end].to_vec();
                bytes.splice(place..place, stretch);
            }
        }
    }
    bytes
}

fn changes() -> impl Strategy<Value = Vec<(u8, prop::sample::Index, u8)>> {
    let structural = prop::sample::select(b"{}[]\",:0123456789-+.eExpnul/ ".to_vec());
    prop::collection::vec((any::<u8>(), any::<prop::sample::Index>(), prop_oneof![structural, any::<u8>()]), 1..6)
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(2000))]

    #[test]
    fn a_mutated_case_never_panics(changes in changes()) {
        let bytes = mutated(full().to_string().into_bytes(), &changes);
        if let Ok(case) = Case::parse(&String::from_utf8_lossy(&bytes)) {
            prop_assert_eq!(Case::parse(&case.to_line()).expect("a sound case"), case.clone());
            if let Ok(problem) = case.problem() {
                let _any = problem.realised().map_err(|error| error.to_string());
            }
        }
    }

    #[test]
    fn a_mutated_answer_never_panics(changes in changes()) {
        let bytes = mutated(ANSWER.as_bytes().to_vec(), &changes);
        if let Ok(answer) = Answer::parse(&String::from_utf8_lossy(&bytes)) {
            prop_assert_eq!(Answer::parse(&answer.to_line()).expect("a sound answer"), answer);
        }
    }
}

#[test]
fn the_unmutated_answer_is_read() {
    assert_eq!(Answer::parse(ANSWER).expect("a sound answer").steps.len(), 1);
}
