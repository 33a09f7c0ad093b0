//! Which laws of a field doubles keep, and which they break: why `f64` is no scalar.

use quickcheck::{QuickCheck, TestResult};

/// A finite double of a moderate size; any bits would mostly be huge or tiny.
fn double(word: i64) -> f64 {
    #[expect(clippy::cast_precision_loss, reason = "rounded once is what is wanted")]
    let value = word as f64;
    let scale = i32::try_from(word.rem_euclid(41)).unwrap_or(0) - 20;
    value * 2_f64.powi(scale - 40)
}

fn same(a: f64, b: f64) -> bool {
    a.to_bits() == b.to_bits() || (a == 0.0 && b == 0.0)
}

type Law = fn(f64, f64, f64) -> bool;

/// How many of the triples keep a law.
fn passed(law: Law) -> Option<u64> {
    struct Triples(Law);
    impl quickcheck::Testable for Triples {
        fn result(&self, g: &mut quickcheck::Gen) -> TestResult {
            let mut draw = || double(<i64 as quickcheck::Arbitrary>::arbitrary(g));
            TestResult::from_bool((self.0)(draw(), draw(), draw()))
        }
    }
    QuickCheck::new().tests(3_000).quicktest(Triples(law)).ok()
}

/// Sums and products are the exact ones, rounded: what is symmetric before rounding is so after it.
#[test]
fn doubles_keep_what_rounding_cannot_break() {
    let laws: [(&str, Law); 9] = [
        ("addition commutes", |a, b, _| same(a + b, b + a)),
        ("multiplication commutes", |a, b, _| same(a * b, b * a)),
        ("zero is neutral", |a, _, _| same(a + 0.0, a)),
        ("one is neutral", |a, _, _| same(a * 1.0, a)),
        ("negation inverts addition", |a, _, _| same(a + -a, 0.0)),
        ("subtraction adds the negative", |a, b, _| same(a - b, a + -b)),
        ("zero absorbs", |a, _, _| same(a * 0.0, 0.0)),
        ("multiplication by two distributes", |a, b, _| same(2.0 * (a + b), 2.0 * a + 2.0 * b)),
        ("addition keeps the order", |a, b, c| a > b || a + c <= b + c),
    ];
    for (name, law) in laws {
        assert_eq!(passed(law), Some(3_000), "{name}");
    }
}

/// The others fail, and quickcheck finds where.
#[test]
fn doubles_break_the_other_laws() {
    let laws: [(&str, Law); 4] = [
        ("addition is associative", |a, b, c| same(a + (b + c), (a + b) + c)),
        ("multiplication is associative", |a, b, c| same(a * (b * c), (a * b) * c)),
        ("multiplication distributes", |a, b, c| same(a * (b + c), a * b + a * c)),
        ("division inverts multiplication", |a, b, _| b == 0.0 || same(a / b * b, a)),
    ];
    for (name, law) in laws {
        assert_eq!(passed(law), None, "{name} holds of 3000 triples");
    }
}
