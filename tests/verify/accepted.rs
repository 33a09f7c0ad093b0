//! What the filter says of itself is accepted, and true.

use exact_kalman::model::Timing;
use exact_kalman::verify::FilterCheck;

use super::models::{certified, model};
use super::truth::Truth;

/// EK-T1, EK-T2: certificates of random models of all kinds are accepted to their last step, with bits that are far too few as well.
#[test]
fn certificates_of_the_filter_are_accepted() {
    let (mut steps, mut departing, mut kept, mut ended) = (0, 0, 0, 0);
    for number in 0..600 {
        let model = model(number);
        let bits = [128, 53, 200, 14, 24][usize::try_from(number % 5).expect("small")];
        let (start, certificate) = certified(&model.path, bits);
        let truth = Truth::of(&model.longer);
        let mut check = FilterCheck::begin(model.path.timing(), model.path.initial(), &start)
            .unwrap_or_else(|why| panic!("model {number}: {why}"));
        for (k, step) in certificate.iter().enumerate() {
            check.step(&model.path.steps()[k], step).unwrap_or_else(|why| panic!("model {number}, {bits} bits: {why}"));
            assert!(truth.agrees(k, step, model.path.timing()), "model {number}, step {k}");
            kept += usize::from(step.kept.is_some());
        }
        steps += certificate.len();
        departing += usize::from(model.path.timing() == Timing::Departing);
        ended += usize::from(check.end(model.path.steps().len()).is_err());
    }
    assert!(
        steps > 1500 && departing > 200 && kept > 50,
        "{steps} steps, {departing} departing, {kept} with sensors left out"
    );
    assert!(ended < 200, "{ended} ended early");
}

/// The bits that are said to be proved are those of the numbers that are handed out.
#[test]
fn proved_bits_are_those_of_the_intervals() {
    use exact_kalman::scalar::{Rational, ratio};
    let mut seen = 0;
    for number in 0..60 {
        let model = model(number);
        let (start, certificate) = certified(&model.path, 128);
        let mut check = FilterCheck::begin(model.path.timing(), model.path.initial(), &start).expect("a sound start");
        for (own, step) in model.path.steps().iter().zip(&certificate) {
            let proved = check.step(own, step).expect("a sound step");
            let Some(bits) = proved.bits else { continue };
            let power = ratio(2, 1).pow(2 * i32::try_from(bits).expect("small"));
            let belief = &proved.predicted;
            for i in 0..belief.states() {
                let [low, high] = belief.covariance(i, i);
                if low > ratio(0, 1) {
                    // W_ii 2^bits ≤ P_ii, and E_ii 4^bits ≤ max(P_ii, x_i²)
                    assert!(
                        (&high - &low) * ratio(2, 1).pow(i32::try_from(bits).expect("small")) <= &low * ratio(2, 1)
                    );
                    let [least, most] = belief.mean(i);
                    let radius = (&most - &least) * ratio(1, 2);
                    let size = if least > ratio(0, 1) { least.clone() } else { -&most };
                    let own = if size > ratio(0, 1) { &size * &size } else { Rational::from_integer(0.into()) };
                    assert!(&radius * &radius * &power <= low.clone().max(own) * ratio(2, 1), "model {number}");
                    seen += 1;
                }
            }
        }
    }
    assert!(seen > 100, "{seen}");
}
