//! Readers of text never panic: every string of a few characters.

use exact_kalman::protocol::{
    Case, Declaration, EstimateCase, Identification, Number, Numbers, StabilityModel, SteadyModel,
};
use exact_kalman::scalar::{nearest_double, nearest_single};

use crate::harness::{Replays, below, cover, harness};

/// Any string of at most `longest` of these characters.
fn text(alphabet: &[u8], longest: u64) -> String {
    let length = below(longest + 1);
    let count = u64::try_from(alphabet.len()).unwrap_or(1);
    let character = |_| char::from(alphabet[usize::try_from(below(count)).unwrap_or(0)]);
    (0..length).map(character).collect()
}

/// How many strings of at most `longest` characters there are.
const fn strings(alphabet: u64, longest: u32) -> u64 {
    let (mut sum, mut length) = (0, 0);
    while length <= longest {
        sum += alphabet.pow(length);
        length += 1;
    }
    sum
}

harness! {
    /// Number literals: no reader panics; as doubles exactly those are read that the standard library reads, or that are
    /// hexadecimal; the value in exact documents, rounded once, is the one in documents of doubles, and is written so that it is
    /// read back.
    ///
    /// Domain: all strings of at most five characters over `0`, `1`, `9`, `.`, `/`, `e`, `E`, `+`, `-`, `x`, `p`, `n`, `a`, `_`.
    literals_never_panic, unwind 132, Replays::All(strings(14, 5)),
    covers ["a decimal", "a hexadecimal", "a fraction", "over zero", "an overflow", "NaN", "refused"], {
        let text = text(b"019./eE+-xpna_", 5);
        let [exact, double, single] = [Numbers::Exact, Numbers::Binary64, Numbers::Binary32].map(|numbers| numbers.read(&text));
        let is_hexadecimal = text.contains("0x");
        if !is_hexadecimal {
            assert!(double.is_ok() == text.parse::<f64>().is_ok(), "{text}");
        }
        assert!(double.is_ok() == single.is_ok());
        match (&exact, &double, &single) {
            (Ok(Number::Finite(value)), Ok(double), Ok(single)) => {
                assert!(*double == exact_or_infinite(nearest_double(value)) && *single == exact_or_infinite(nearest_single(value).into()));
                assert!(Numbers::Exact.read(&Numbers::Exact.write(value)) == exact);
                cover!(!is_hexadecimal, "a decimal");
                cover!(is_hexadecimal, "a hexadecimal");
                cover!(matches!(double, Number::Infinite { .. }), "an overflow");
            }
            (Ok(Number::Finite(value)), Err(_), Err(_)) => {
                cover!(text.contains('/'), "a fraction");
                assert!(text.contains('/') && Numbers::Exact.read(&Numbers::Exact.write(value)) == exact);
            }
            (Ok(Number::NotANumber), Ok(Number::NotANumber), Ok(Number::NotANumber)) => cover!(true, "NaN"),
            (Err(_), Err(_), Err(_)) => {
                cover!(text.contains("1/0"), "over zero");
                cover!(text == "1e", "refused");
            }
            found => panic!("{text}: {found:?}"),
        }
        for numbers in [Numbers::Exact, Numbers::Binary64, Numbers::Binary32] {
            let finite = numbers.read_finite(&text);
            assert!(finite.ok() == numbers.read(&text).ok().and_then(|number| match number {
                Number::Finite(value) => Some(value),
                Number::Infinite { .. } | Number::NotANumber => None,
            }));
        }
    }
}

/// A double as a number of the protocol, zeros alike.
fn exact_or_infinite(value: f64) -> Number {
    exact_kalman::scalar::exact_value(value).map_or(Number::Infinite { negative: value < 0.0 }, Number::Finite)
}

harness! {
    /// Documents: none is that short, so every reader refuses them, and says so without a panic.
    ///
    /// Domain: all strings of at most five characters over `{`, `}`, `[`, `]`, `"`, `:`, `,`, `0`, `a`, `\`.
    documents_never_panic, unwind 132, Replays::All(strings(10, 5)), covers ["a value of JSON", "a string", "an object"], {
        let text = text(b"{}[]\":,0a\\", 5);
        assert!(Case::parse(&text).is_err());
        assert!(EstimateCase::parse(&text).is_err());
        assert!(Identification::parse(&text).is_err());
        assert!(StabilityModel::parse(&text).is_err());
        assert!(SteadyModel::parse(&text).is_err());
        assert!(Declaration::parse(&text).is_err());
        cover!(text == "[0,0]", "a value of JSON");
        cover!(text == "\"a\"", "a string");
        cover!(text == "{}", "an object");
    }
}
