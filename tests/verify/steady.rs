//! Certificates of steady states, made by hand.

use exact_kalman::matrix::Matrix;
use exact_kalman::model::{Observation, Step, Timing, Transition};
use exact_kalman::scalar::{Rational, ratio};
use exact_kalman::verify::{
    Condition, DyadicNumber, ProvedSteady, RationalRows, Stabilising, SteadyDocument, SteadyEvidence, check_steady,
};

use super::models::Q;
use super::tight::dyadic;

fn number(value: (i64, i64)) -> Q {
    Matrix::column(vec![ratio(value.0, value.1)])
}

/// A, H, Q, S, R in departing timing.
fn step(a: &Q, h: &Q, q: &Q, s: &Q, r: &Q) -> Step<Rational> {
    let (n, m) = (a.rows(), h.rows());
    Step {
        transition: Some(Transition {
            matrix: a.clone(),
            input: Matrix::zeros(n, 1),
            noise: q.clone(),
            cross_noise: s.clone(),
        }),
        observation: h.clone(),
        observation_input: Matrix::zeros(m, 1),
        observation_noise: r.clone(),
        reading: Observation::complete(vec![ratio(0, 1); m]),
    }
}

fn scalar(a: (i64, i64), h: (i64, i64), q: (i64, i64), r: (i64, i64)) -> Step<Rational> {
    step(&number(a), &number(h), &number(q), &number((0, 1)), &number(r))
}

/// x₊ = 2x, unit noise in what is read: S = 3, K = 3/2, G = 1/2 solve the equation exactly. P = 0 does as well, with G = 2.
fn doubling() -> Step<Rational> {
    scalar((2, 1), (1, 1), (0, 1), (1, 1))
}

fn claimed(
    solution: (i64, i64),
    gap: (i64, i64),
    gain: (i64, i64),
    rate: (i64, i64),
    balance: Option<i64>,
) -> Stabilising {
    let rate = dyadic(&number(rate), false);
    Stabilising {
        solution: dyadic(&number(solution), true),
        gap: dyadic(&number(gap), true),
        gain: dyadic(&number(gain), false),
        whitening: dyadic(&number((1, 2)), false),
        shape: dyadic(&number((1, 1)), true),
        rate_squared: DyadicNumber { exponent: rate.exponent, mantissa: rate.rows[0][0].clone() },
        balance,
        kept: None,
    }
}

fn checked(step: &Step<Rational>, claim: Stabilising) -> Result<ProvedSteady, Condition> {
    check_steady(step, Timing::Departing, &SteadyEvidence::Stabilising(claim)).map_err(|why| why.condition)
}

#[test]
fn a_scalar_solution_is_enclosed() {
    // Exactly, with no gap; and within 1/64, with S̃ off by 1/128 and a rough gain.
    let proved = checked(&doubling(), claimed((3, 1), (0, 1), (3, 2), (1, 4), None));
    assert!(matches!(proved, Ok(ProvedSteady::Stabilising { bits: None, is_covariance: true, .. })), "{proved:?}");
    let rough = claimed((385, 128), (1, 64), (97, 64), (1, 2), Some(1));
    let Ok(ProvedSteady::Stabilising { solution, rate_squared, bits, .. }) = checked(&doubling(), rough) else {
        panic!("not proved")
    };
    let [low, high] = solution.covariance(0, 0);
    assert!(
        low < ratio(3, 1) && ratio(3, 1) < high && rate_squared == ratio(1, 2) && bits.is_some_and(|bits| bits >= 5)
    );
}

#[test]
fn false_and_unproved_claims_are_rejected() {
    use Condition::{Contraction, Interior, Invariance, Regular};
    let step = doubling();
    // Another number; too narrow; the other solution, whose loop grows; a smaller rate; r ≥ 1; a gap below zero.
    for (claim, condition) in [
        (claimed((7, 2), (1, 64), (3, 2), (1, 2), Some(1)), Invariance),
        (claimed((385, 128), (1, 256), (97, 64), (1, 2), Some(1)), Invariance),
        (claimed((3, 1), (0, 1), (3, 2), (63, 256), None), Contraction),
        (claimed((3, 1), (0, 1), (3, 2), (1, 1), None), Contraction),
        (claimed((3, 1), (0, 1), (3, 2), (-1, 4), None), Contraction),
        (claimed((3, 1), (-1, 64), (3, 2), (1, 2), Some(1)), Interior),
        (claimed((385, 128), (1, 64), (97, 64), (1, 2), Some(40)), Contraction),
    ] {
        assert_eq!(checked(&step, claim.clone()).err(), Some(condition), "{claim:?}");
    }
    let mut other = claimed((0, 1), (0, 1), (0, 1), (1, 2), None);
    other.whitening = dyadic(&number((1, 1)), false);
    assert_eq!(checked(&step, other.clone()).err(), Some(Contraction));
    other.whitening = dyadic(&number((0, 1)), false);
    assert_eq!(checked(&step, other.clone()).err(), Some(Regular));
    other = claimed((3, 1), (0, 1), (3, 2), (1, 4), None);
    other.shape = dyadic(&number((0, 1)), true);
    assert_eq!(checked(&step, other.clone()).err(), Some(Contraction));
    // Where no loop is exact two terms are added.
    assert_eq!(checked(&step, claimed((385, 128), (1, 64), (97, 64), (1, 2), None)).err(), Some(Condition::Members));
}

/// EK-T5, EK-T6: one unit less on either side of the widest gap and of the least rate: the bounds are those that are derived by hand.
#[test]
fn both_inequalities_are_tight() {
    // S̃ = 3, K = 3/2 + d, T = 1/2: Σ̃ = 4, ρ = 4d, G = 1/2 − d, J = 3 + 4d², η = 0, w = E/4, κ = 1 − E/4.
    let (d, gap) = (ratio(1, 16), ratio(1, 8));
    let w = &gap / ratio(4, 1);
    let kappa = ratio(1, 1) - &w;
    let g = ratio(1, 2) - &d;
    let missed = ratio(4, 1) * &d * &d;
    let off = ratio(4, 1) * &d * &d;
    let needed = (ratio(1, 1) + ratio(2, 1) * &w / &kappa) * &g * &g * &gap + ratio(2, 1) / &kappa * &missed + off;
    assert!(needed < gap, "{needed}");
    // X = 1, v = 1/4.
    let beta = ratio(1, 4);
    let rate = (ratio(1, 1) + &beta) * &g * &g
        + (ratio(1, 1) + beta.recip()) * ratio(2, 4) / (&kappa * &kappa) * (&w * &g * &g * &gap + &missed);
    assert!(rate < ratio(1, 1), "{rate}");
    let bit = ratio(2, 1).pow(-80);
    for (rate, is_enough) in [(&rate + &bit, true), (&rate - &bit, false)] {
        let mut claim = claimed((3, 1), (1, 8), (25, 16), (1, 2), Some(2));
        let rate = dyadic(&Matrix::column(vec![rate]), false);
        claim.rate_squared = DyadicNumber { exponent: rate.exponent, mantissa: rate.rows[0][0].clone() };
        assert_eq!(checked(&doubling(), claim).is_ok(), is_enough);
    }
    // A solution that is moved until the gap is used up.
    let spare = &gap - &needed;
    for (sign, by) in [(1, &spare + &bit), (1, &spare - &bit), (-1, &spare + &bit), (-1, &spare - &bit)] {
        let sign = ratio(sign, 1);
        // With Q moved J moves, and nothing else.
        let step = step(
            &number((2, 1)),
            &number((1, 1)),
            &Matrix::column(vec![&sign * &by]),
            &number((0, 1)),
            &number((1, 1)),
        );
        let proved = checked(&step, claimed((3, 1), (1, 8), (25, 16), (1, 2), Some(2)));
        // From above J is off by 4d² already.
        let is_enough = if sign > ratio(0, 1) { by < spare } else { true };
        match proved {
            Ok(ProvedSteady::Stabilising { is_covariance, .. }) => {
                // Below zero Q is no covariance.
                assert!(is_enough && is_covariance == (sign > ratio(0, 1)), "{sign} {by}");
            }
            Ok(other) => panic!("{other:?}"),
            Err(why) => assert!(!is_enough && why == Condition::Invariance, "{sign} {by} {why}"),
        }
    }
}

/// More than a certificate could speak of is refused before anything is computed.
#[test]
fn there_may_be_too_many_states() {
    let large = |n: usize, m: usize| {
        let step = step(&Q::zeros(n, n), &Q::zeros(m, n), &Q::zeros(n, n), &Q::zeros(n, m), &Q::zeros(m, m));
        checked(&step, claimed((3, 1), (0, 1), (3, 2), (1, 4), None)).err()
    };
    assert_eq!([large(513, 1), large(1, 513)], [Some(Condition::Size); 2]);
    assert_eq!(large(1, 512), Some(Condition::Shape));
}

fn fractions(rows: &[&[&str]]) -> RationalRows {
    RationalRows(rows.iter().map(|row| row.iter().map(|entry| (*entry).to_owned()).collect()).collect())
}

fn matrix(rows: &[&[i64]]) -> Q {
    Matrix::from_rows(rows.iter().map(|row| row.iter().map(|&entry| ratio(entry, 1)).collect()).collect())
        .expect("rows")
}

/// EK-T7a: x₂ is not seen and is multiplied by −3/2; then by −1/2.
#[test]
fn unobservable_modes_forbid_a_solution() {
    let of = |half: i64, basis: &[&[&str]], map: &[&[&str]]| {
        let a =
            Matrix::from_rows(vec![vec![ratio(1, 2), ratio(0, 1)], vec![ratio(1, 1), ratio(half, 2)]]).expect("square");
        let step = step(&a, &matrix(&[&[1, 0]]), &Matrix::identity(2), &Matrix::zeros(2, 1), &Matrix::identity(1));
        let evidence = SteadyEvidence::Unobservable { basis: fractions(basis), map: fractions(map) };
        check_steady(&step, Timing::Departing, &evidence).map(|_| ()).map_err(|why| why.condition)
    };
    let down: &[&[&str]] = &[&["0"], &["-7/3"]];
    assert_eq!(of(-3, down, &[&["-3/2"]]), Ok(()));
    assert_eq!(of(2, down, &[&["1"]]), Ok(()));
    assert_eq!(of(-1, down, &[&["-1/2"]]), Err(Condition::Eigenvalue));
    assert_eq!(of(-3, down, &[&["3/2"]]), Err(Condition::Subspace));
    assert_eq!(of(-3, &[&["1"], &["0"]], &[&["-3/2"]]), Err(Condition::Subspace));
    assert_eq!(of(-3, &[&["0"], &["0"]], &[&["-3/2"]]), Err(Condition::Independent));
    assert_eq!(of(-3, &[&["0", "0"], &["1", "2"]], &[&["-3/2", "0"], &["0", "-3/2"]]), Err(Condition::Independent));
    assert_eq!(of(-3, &[&["1"]], &[&["-3/2"]]), Err(Condition::Shape));
    for wrong in ["1.5", "3/-2", "3/0", "", "/2", "--3", "3/2/1", " 3", "+3"] {
        assert_eq!(of(-3, &[&["0"], &[wrong]], &[&["-3/2"]]), Err(Condition::Document), "{wrong}");
    }
}

/// EK-T7b: a rotation by the angle of 3 + 4i over 5, with no noise of its own and seen with noise, beside a level that shrinks.
#[test]
fn unreachable_modes_on_the_circle_forbid_a_solution() {
    let of = |scale: i64, noise: i64, between: Option<[&str; 2]>| {
        let q = |a: i64| ratio(a * scale, 25);
        let zero = || ratio(0, 1);
        let a = Matrix::from_rows(vec![
            vec![q(3), q(-4), zero()],
            vec![q(4), q(3), zero()],
            vec![ratio(1, 1), zero(), ratio(1, 2)],
        ])
        .expect("square");
        let process = Matrix::diagonal(&[ratio(noise, 1), zero(), ratio(1, 1)]);
        let step = step(&a, &matrix(&[&[1, 1, 1]]), &process, &Matrix::zeros(3, 1), &Matrix::identity(1));
        let map = [[q(3), q(-4)], [q(4), q(3)]].map(|row| row.map(|entry| entry.to_string()).to_vec()).to_vec();
        let evidence = SteadyEvidence::Unreachable {
            basis: fractions(&[&["1", "0", "0"], &["0", "1", "0"]]),
            injection: fractions(&[&["0"], &["0"]]),
            map: RationalRows(map),
            between: between.map(|ends| ends.map(str::to_owned)),
        };
        check_steady(&step, Timing::Departing, &evidence).map(|_| ()).map_err(|why| why.condition)
    };
    // z² − (6/5) z + 1: h(c) = c − 6/5.
    assert_eq!(of(5, 0, Some(["1", "3/2"])), Ok(()));
    assert_eq!(of(5, 0, Some(["6/5", "6/5"])), Ok(()));
    assert_eq!(of(5, 0, Some(["3/2", "-2"])), Ok(()));
    for between in [None, Some(["13/10", "2"]), Some(["-2", "1"]), Some(["1", "3"])] {
        assert_eq!(of(5, 0, between), Err(Condition::Eigenvalue), "{between:?}");
    }
    assert_eq!(of(5, 1, Some(["1", "3/2"])), Err(Condition::Subspace));
    assert_eq!(of(4, 0, Some(["-2", "2"])), Err(Condition::Eigenvalue));
    // The eigenvalue 1, and the one of a mode that what is read is fed back to: A − L H with L = S R⁻¹.
    let one = SteadyEvidence::Unreachable {
        basis: fractions(&[&["1"]]),
        injection: fractions(&[&["1"]]),
        map: fractions(&[&["-1"]]),
        between: None,
    };
    let shared =
        |q: i64, a: i64| step(&number((a, 1)), &number((1, 1)), &number((q, 1)), &number((2, 1)), &number((2, 1)));
    let found = |q, a| check_steady(&shared(q, a), Timing::Departing, &one).map(|_| ()).map_err(|why| why.condition);
    assert_eq!((found(2, 0), found(3, 0), found(2, 1)), (Ok(()), Err(Condition::Subspace), Err(Condition::Subspace)));
}

/// In the arriving timing the noise of the transition is in what is read: x₊ = 2x, y = x₊ + v, v of unit variance: φ(P) = 4P/(4P + 1),
/// with the solution 3/4, K = 3/4, G = 1/2.
#[test]
fn a_transition_that_arrives_is_put_into_the_reading() {
    let mut claim = claimed((3, 4), (0, 1), (3, 4), (1, 4), None);
    claim.whitening = dyadic(&number((1, 2)), false);
    let evidence = SteadyEvidence::Stabilising(claim);
    assert!(check_steady(&doubling(), Timing::Arriving, &evidence).is_ok());
    assert!(check_steady(&doubling(), Timing::Departing, &evidence).is_err());
}

#[test]
fn documents_are_read_as_they_are_written_and_damage_is_seen() {
    let numbers = serde_json::json!([1, -1, 1.5, null, true]);
    let model = serde_json::json!({"transition": [["2"]], "about": "α \"quoted\"", "numbers": numbers});
    let evidence = SteadyEvidence::Stabilising(claimed((385, 128), (1, 64), (97, 64), (1, 2), Some(1)));
    let document = SteadyDocument { model, evidence };
    let line = document.to_line();
    assert_eq!(SteadyDocument::parse(&line).expect("its own line"), document);
    let mut rejected = 0;
    for (place, _) in line.char_indices() {
        for other in ["", "0", "1", "\"", "}"] {
            let changed = format!("{}{other}{}", &line[..place], line[place..].chars().skip(1).collect::<String>());
            match SteadyDocument::parse(&changed) {
                // Nothing was changed, or nothing that says anything.
                Ok(read) => assert_eq!(read, document, "{changed}"),
                Err(_) => rejected += 1,
            }
        }
    }
    assert!(rejected > 2000, "{rejected}");
    let extra = line.replacen('{', "{\"more\":1,", 1);
    assert!(SteadyDocument::parse(&extra).is_err());
    for (member, again) in [("\"transition\":", "[[\"7\"]]"), ("\"exponent\":", "7")] {
        let twice = line.replacen(member, &format!("{member}{again},{member}"), 1);
        assert_eq!(SteadyDocument::parse(&twice).map_err(|why| why.condition), Err(Condition::Document), "{member}");
    }
    let twice = line.replacen('{', "{\"balance\":1,", 1);
    assert!(SteadyDocument::parse(&twice).is_err());
}
