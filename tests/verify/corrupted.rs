//! Certificates that were changed: what is accepted is true.

use std::collections::BTreeMap;

use exact_kalman::model::Path;
use exact_kalman::scalar::Rational;
use exact_kalman::verify::{BeliefDocument, Condition, DyadicMatrix, FilterCheck, StepDocument};
use num_bigint::BigInt;

use super::models::{Draw, Model, certified, model};
use super::truth::Truth;

/// The steps that are accepted, each of which must be true; and why the next is not.
fn accepted(
    path: &Path<Rational>,
    truth: &Truth,
    start: &BeliefDocument,
    steps: &[StepDocument],
) -> Result<(), Condition> {
    let mut check = FilterCheck::begin(path.timing(), path.initial(), start).map_err(|why| why.condition)?;
    for step in steps {
        let at = check.done();
        let own = path.steps().get(at).ok_or(Condition::Order)?;
        check.step(own, step).map_err(|why| why.condition)?;
        assert!(truth.agrees(at, step, path.timing()), "a false step is accepted: {step:?}");
    }
    check.end(path.steps().len()).map_err(|why| why.condition)
}

/// The matrices of a step, by name.
fn matrices(step: &mut StepDocument) -> Vec<(&'static str, &mut DyadicMatrix)> {
    let mut all = Vec::new();
    let StepDocument { whitening, predicted, filtered, ahead, .. } = step;
    all.extend(whitening.as_mut().map(|t| ("whitening", t)));
    for belief in [predicted.as_mut(), Some(filtered), ahead.as_mut()].into_iter().flatten() {
        let BeliefDocument { gain, covariance, gap, mean, ellipsoid, .. } = belief;
        all.extend(gain.as_mut().map(|gain| ("gain", gain)));
        all.extend([("covariance", covariance), ("gap", gap), ("mean", mean), ("ellipsoid", ellipsoid)]);
    }
    all
}

/// Changes one number somehow; says what.
fn changed(step: &mut StepDocument, draw: &mut Draw) -> String {
    let mut all = matrices(step);
    let place = draw.index(all.len());
    let (name, matrix) = &mut all[place];
    let row = draw.index(matrix.rows.len());
    let column = draw.index(matrix.rows[row].len());
    let entry = &mut matrix.rows[row][column].0;
    let how = match draw.below(8) {
        0 => {
            *entry += 1;
            "one more"
        }
        1 => {
            *entry -= 1;
            "one less"
        }
        2 => {
            *entry = -&*entry;
            "other sign"
        }
        3 => {
            // One hexadecimal digit.
            let place = draw.below(entry.bits().max(1)) / 4 * 4;
            *entry ^= BigInt::from(1 + draw.below(15)) << place;
            "one digit"
        }
        4 => {
            *entry = BigInt::from(0);
            "zero"
        }
        5 => {
            *entry *= 1 + draw.below(15);
            *entry /= 8;
            "other size"
        }
        6 => {
            matrix.exponent += 1;
            "twice"
        }
        _ => {
            matrix.exponent -= 1;
            "half"
        }
    };
    format!("{name}, {how}")
}

/// EK-L1, EK-T1, EK-T2: numbers changed one by one, and more at a time: 12,000 certificates. Those that are accepted speak the truth, and those whose
/// covariance or mean was moved are mostly rejected.
#[test]
fn accepted_numbers_are_true() {
    let mut counts: BTreeMap<String, [usize; 2]> = BTreeMap::new();
    for number in 0..300 {
        let Model { path, longer } = model(number);
        let truth = Truth::of(&longer);
        let mut draw = Draw(number);
        let bits = [128, 53, 16, 10][draw.index(4)];
        let (start, steps) = certified(&path, bits);
        if steps.len() < path.steps().len() {
            continue;
        }
        for _ in 0..40 {
            let mut steps = steps.clone();
            let at = draw.index(steps.len());
            let before = steps[at].clone();
            let what = changed(&mut steps[at], &mut draw);
            for _ in 0..draw.below(3) {
                let other = draw.index(steps.len());
                changed(&mut steps[other], &mut draw);
            }
            if steps[at] == before {
                continue;
            }
            let count = counts.entry(what).or_default();
            match accepted(&path, &truth, &start, &steps) {
                Ok(()) => count[0] += 1,
                Err(_) => count[1] += 1,
            }
        }
    }
    let of = |name: &str| {
        let all = counts.iter().filter(|(what, _)| what.starts_with(name)).map(|(_, count)| count);
        all.fold([0, 0], |sum, count| [sum[0] + count[0], sum[1] + count[1]])
    };
    for name in ["covariance", "mean"] {
        let [accepted, rejected] = of(name);
        assert!(rejected > 8 * accepted && rejected > 500, "{name}: {accepted} accepted, {rejected} rejected");
    }
    let [accepted, rejected] = of("");
    assert!(rejected > accepted, "{accepted} accepted, {rejected} rejected: {counts:#?}");
    eprintln!("{accepted} accepted, {rejected} rejected: {counts:?}");
}

/// Gaps and ellipsoids made smaller step by step, until they are rejected: never too late.
#[test]
fn what_is_claimed_too_narrow_is_rejected() {
    let (mut seen, mut rejected) = (0, 0);
    for number in 0..200 {
        let Model { path, longer } = model(number);
        let truth = Truth::of(&longer);
        let (start, steps) = certified(&path, [128, 20, 9][usize::try_from(number % 3).expect("small")]);
        for (at, place) in (0..steps.len()).flat_map(|at| [(at, "gap"), (at, "ellipsoid")]) {
            for sixteenths in [15, 12, 8, 4, 1] {
                let mut steps = steps.clone();
                for (name, matrix) in matrices(&mut steps[at]) {
                    if name == place && matrix.rows.iter().flatten().any(|entry| entry.0.bits() > 0) {
                        matrix.exponent -= 4;
                        matrix.rows.iter_mut().flatten().for_each(|entry| entry.0 *= sixteenths);
                    }
                }
                seen += 1;
                let until = steps.len();
                rejected += usize::from(matches!(
                    accepted(&path, &truth, &start, &steps[..until]),
                    Err(Condition::Covariance | Condition::Mean)
                ));
            }
        }
    }
    assert!(seen > 4000 && 2 * rejected > seen, "{rejected} of {seen} rejected");
}

/// Steps left out, twice, in another order, called otherwise; members left out or added; other shapes.
#[test]
fn the_form_of_a_certificate_is_checked() {
    let mut seen: BTreeMap<&str, usize> = BTreeMap::new();
    for number in 0..150 {
        let Model { path, longer } = model(number);
        let truth = Truth::of(&longer);
        let (start, steps) = certified(&path, 128);
        if steps.len() < path.steps().len() {
            continue;
        }
        let mut expect =
            |name: &'static str, condition: &[Condition], start: &BeliefDocument, steps: &[StepDocument]| {
                let found = accepted(&path, &truth, start, steps);
                assert!(found.is_err_and(|found| condition.contains(&found)), "{name} of model {number}: {found:?}");
                *seen.entry(name).or_default() += 1;
            };
        let all = steps.len();
        expect("end", &[Condition::Order], &start, &steps[..all - 1]);
        expect("begin", &[Condition::Order], &start, &steps[1..]);
        let mut other = steps.clone();
        other.swap(0, all - 1);
        expect("swap", &[Condition::Order], &start, &other);
        let mut other = steps.clone();
        other.push(steps[0].clone());
        expect("more", &[Condition::Order], &start, &other);
        let members = [Condition::Members];
        for at in 0..all {
            let mut change = |name, condition: &[Condition], change: &dyn Fn(&mut StepDocument)| {
                let mut steps = steps.clone();
                change(&mut steps[at]);
                if steps[at] != other[at] {
                    expect(name, condition, &start, &steps);
                }
            };
            change("number", &[Condition::Order], &|step| step.step += 1);
            change("no whitening", &members, &|step| step.whitening = None);
            change("no predicted", &members, &|step| step.predicted = None);
            change("no ahead", &members, &|step| step.ahead = None);
            change("no gain", &members, &|step| step.filtered.gain = None);
            change("no balance", &members, &|step| step.filtered.balance = None);
            change("more ahead", &members, &|step| {
                if step.ahead.is_none() {
                    step.ahead = Some(step.filtered.clone());
                }
            });
            change("more gain", &members, &|step| {
                if step.whitening.is_none() {
                    step.filtered.gain = Some(DyadicMatrix::default());
                }
            });
            change("shape", &[Condition::Shape], &|step| step.filtered.covariance.rows.truncate(0));
            change("square", &[Condition::Shape], &|step| {
                step.filtered.gap.rows[0].push(exact_kalman::verify::Hexadecimal::default());
            });
            change("no sensor", &[Condition::Kept, Condition::Members, Condition::Shape], &|step| {
                if let Some(whitening) = &step.whitening {
                    step.kept = Some((1..whitening.rows.len()).collect());
                    if whitening.rows.len() == 1 {
                        step.whitening = None;
                        step.filtered.gain = None;
                    }
                }
            });
            change("far", &[Condition::Size], &|step| {
                step.filtered.mean.exponent = 1 << 20;
                step.filtered.mean.rows[0][0].0 = BigInt::from(1);
            });
        }
        let mut other = start.clone();
        other.covariance.exponent += 1;
        if model_has_start(&start) {
            expect("start", &[Condition::StartCovariance], &other, &steps);
        }
        let mut other = start.clone();
        other.balance = Some(0);
        expect("start with balance", &members, &other, &steps);
    }
    assert!(seen.len() == 18 && seen.values().all(|&count| count > 10), "{seen:?}");
}

fn model_has_start(start: &BeliefDocument) -> bool {
    start.covariance.rows.iter().flatten().any(|entry| entry.0.bits() > 0)
}

/// A certificate of another case: whatever is accepted is true of the case against which it is checked.
#[test]
fn certificates_of_other_cases_are_true_or_rejected() {
    let (mut rejected, mut all) = (0, 0);
    for number in 0..300 {
        let one = model(number);
        let (start, steps) = certified(&one.path, 64);
        for other in 0..12 {
            let other = model(other * 25 + number % 25);
            let (mine, others) = (one.path.steps(), other.path.steps());
            let is_alike = one.path.states() == other.path.states() && mine.len() == others.len();
            if one.path == other.path || !is_alike {
                continue;
            }
            all += 1;
            rejected += usize::from(accepted(&other.path, &Truth::of(&other.longer), &start, &steps).is_err());
        }
    }
    assert!(all > 100 && rejected == all, "{rejected} of {all}");
}
