//! Certificates of steady states with sensors left out, changed in every member; and of models that are changed.

use exact_kalman::matrix::Matrix;
use exact_kalman::model::{Before, Initial, Noise, Observation, System, Timing};
use exact_kalman::scalar::ratio;
use exact_kalman::verify::{Condition, FilterCheck, ProvedSteady, Stabilising, SteadyEvidence, check_steady};

use super::models::{Draw, Q, certified};
use super::steady_models::{Steady, change, steady};

fn checked(model: &Steady, claim: &Stabilising) -> Result<ProvedSteady, Condition> {
    check_steady(&model.step, model.timing, &SteadyEvidence::Stabilising(claim.clone())).map_err(|why| why.condition)
}

/// EK-T5, EK-T6: whatever is changed, what is accepted leaves out what follows alone, and is true of the solution as it is known to
/// thirty digits.
#[test]
fn what_is_accepted_of_a_steady_state_is_true() {
    let [mut accepted, mut rejected, mut left_out] = [0; 3];
    for number in 0..250 {
        let model = steady(number);
        let (Some(rough), Some(known)) = (model.solved(3), model.solved(30)) else { continue };
        left_out += usize::from(rough.evidence.kept.is_some());
        assert!(checked(&model, &rough.evidence).is_ok() && model.agrees(&known, &rough.evidence), "model {number}");
        let mut draw = Draw(number);
        for _ in 0..40 {
            let mut claim = rough.evidence.clone();
            for _ in 0..=draw.index(2) {
                change(&mut || draw.index(256), &mut claim, model.sensors());
            }
            if checked(&model, &claim).is_err() {
                rejected += 1;
                continue;
            }
            accepted += 1;
            assert!(claim.kept.as_ref().is_none_or(|kept| model.follows(kept)), "model {number}: {:?}", claim.kept);
            assert!(model.agrees(&known, &claim), "model {number}: {claim:?}");
        }
    }
    assert!(accepted > 500 && rejected > 2000 && left_out > 60, "{accepted}, {rejected}, {left_out}");
}

/// All ways to name sensors: in any order, twice, none, one that there is not, too few, too many.
#[test]
fn only_what_follows_is_left_out() {
    let [mut right, mut wrong] = [0; 2];
    for number in 0..120 {
        let model = steady(number);
        let Some(rough) = model.solved(3) else { continue };
        let m = model.sensors();
        let mut ways: Vec<Vec<usize>> =
            (0..1_usize << m).map(|mask| (0..m).filter(|sensor| mask >> sensor & 1 == 1).collect()).collect();
        let of_all: Vec<Vec<usize>> = ways
            .iter()
            .flat_map(|way| {
                let first = way.first().copied().unwrap_or(0);
                [&[&way[..], &[first]], &[&[first], &way[..]], &[&way[..], &[m]], &[&way[..], &[usize::MAX]]]
                    .map(|parts: &[&[usize]; 2]| parts.concat())
            })
            .chain(ways.iter().map(|way| way.iter().rev().copied().collect()))
            .collect();
        ways.extend(of_all);
        for kept in ways {
            let claim = Stabilising { kept: Some(kept.clone()), ..rough.evidence.clone() };
            let found = checked(&model, &claim).err();
            if model.follows(&kept) {
                assert_ne!(found, Some(Condition::Kept), "model {number}: {kept:?}");
                right += 1;
            } else {
                assert_eq!(found, Some(Condition::Kept), "model {number}: {kept:?}");
                wrong += 1;
            }
        }
    }
    assert!(right > 100 && wrong > 1000, "{right}, {wrong}");
}

/// One number of a sensor that is left out is another: what it sees, its noise, what it shares with another's or with the state.
#[test]
fn a_sensor_that_is_left_out_repeats_all_its_numbers() {
    let mut seen = [0; 4];
    for number in 0..200 {
        let model = steady(number);
        let Some(rough) = model.solved(3) else { continue };
        let Some(kept) = &rough.evidence.kept else { continue };
        let (m, n) = (model.sensors(), model.step.observation.columns());
        for left in (0..m).filter(|sensor| !kept.contains(sensor)) {
            let mut others: Vec<(usize, Steady)> = Vec::new();
            let mut add = |what: usize, change: &dyn Fn(&mut Steady)| {
                let mut other = steady(number);
                change(&mut other);
                others.push((what, other));
            };
            let more = |matrix: &mut Q, i: usize, j: usize| matrix[(i, j)] = &matrix[(i, j)] + ratio(1, 7);
            for j in 0..n {
                add(0, &|other| more(&mut other.step.observation, left, j));
                add(1, &|other| {
                    more(&mut other.step.transition.as_mut().expect("a transition").cross_noise, j, left);
                });
            }
            add(2, &|other| more(&mut other.step.observation_noise, left, left));
            for j in (0..m).filter(|&j| j != left) {
                add(3, &|other| {
                    more(&mut other.step.observation_noise, left, j);
                    more(&mut other.step.observation_noise, j, left);
                });
            }
            for (what, other) in others {
                let found = checked(&other, &rough.evidence).err();
                if other.follows(kept) {
                    assert_ne!(found, Some(Condition::Kept), "model {number}: {what}");
                } else {
                    assert_eq!(found, Some(Condition::Kept), "model {number}: {what}");
                    seen[what] += 1;
                }
            }
        }
    }
    assert!(seen.iter().all(|count| *count > 20), "{seen:?}");
}

/// Two sensors with one noise read the same, or contradict their model: then neither may be left out.
#[test]
fn a_sensor_that_is_left_out_reads_what_follows() {
    let ones = Matrix::from_fn(2, 2, |_, _| ratio(1, 1));
    let one = Matrix::<exact_kalman::scalar::Rational>::identity(1);
    let system = System {
        timing: Timing::Departing,
        initial: Initial::new(Before::Observation, Matrix::zeros(1, 1), one.clone()),
        transition: one.clone().into(),
        observation: Matrix::from_fn(2, 1, |_, _| ratio(1, 1)).into(),
        noise: Noise::Covariances { process: one.into(), cross: None, observation: ones.into() },
        input: None,
        observation_input: None,
    };
    let path = |second| system.realised(&[Observation::complete([ratio(3, 1), ratio(second, 1)])]).expect("a path");
    let (start, steps) = certified(&path(3), 64);
    assert_eq!(steps[0].kept.as_deref(), Some(&[0][..]));
    let found = |second| {
        let path = path(second);
        let mut check = FilterCheck::begin(path.timing(), path.initial(), &start).expect("a start");
        check.step(&path.steps()[0], &steps[0]).map(|_| ()).map_err(|why| why.condition)
    };
    assert_eq!((found(3), found(4)), (Ok(()), Err(Condition::Kept)));
}

/// Nothing is read by a sensor of zeros: to keep none is right; where it has noise it is not.
#[test]
fn a_sensor_of_zeros_may_be_left_out() {
    let mut model = steady(0);
    let (n, zero) = (model.step.observation.columns(), Matrix::zeros(1, model.step.observation.columns()));
    let transition = model.step.transition.as_mut().expect("a transition");
    transition.matrix = Matrix::identity(n).scaled(&ratio(1, 2));
    transition.cross_noise = Matrix::zeros(n, 1);
    (model.step.observation, model.step.observation_noise) = (zero, Matrix::zeros(1, 1));
    model.step.observation_input = Matrix::zeros(1, 1);
    model.step.reading = Observation::complete([ratio(0, 1)]);
    let found = model.solved(20).expect("an equation of Lyapunov");
    assert_eq!(found.evidence.kept.as_deref(), Some(&[][..]));
    assert!(checked(&model, &found.evidence).is_ok());
    model.step.observation_noise = Matrix::identity(1);
    assert_eq!(checked(&model, &found.evidence).err(), Some(Condition::Kept));
}
