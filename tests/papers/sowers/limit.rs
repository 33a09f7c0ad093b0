//! The remark at the end of section III: whether the measures of all horizons have a limit with a density.

use exact_kalman::gaussian::Gaussian;
use exact_kalman::matrix::Matrix;
use exact_kalman::model::{Before, Coefficient, Field, Initial, Noise, Observation, System, Timing};
use exact_kalman::nongaussian::{
    Component, HorizonError, InfiniteHorizon, InitialLaw, LimitMeasure, StatisticsError, statistics,
};
use exact_kalman::scalar::{Rational, ratio};
use num_traits::{Signed, ToPrimitive};

use super::world::Dice;
use super::{Q, number};

fn system(a: Q, h: Q, w: Q, wv: Q, v: Q) -> System<Rational> {
    let n = a.rows();
    System {
        timing: Timing::Departing,
        initial: Initial::new(Before::Observation, Matrix::zeros(n, 1), Matrix::zeros(n, n)),
        transition: a.into(),
        observation: h.into(),
        noise: Noise::Covariances { process: w.into(), cross: Some(wv.into()), observation: v.into() },
        input: None,
        observation_input: None,
    }
}

/// A and H with unit noises that are not shared.
fn plain(a: Q, h: Q) -> System<Rational> {
    let (n, k) = (a.rows(), h.rows());
    system(a, h, Matrix::identity(n), Matrix::zeros(n, k), Matrix::identity(k))
}

/// zᵀM(t)z for t = 0, 1, …, by the statistics along readings.
fn sums(system: &System<Rational>, z: &Q, count: usize) -> Vec<Rational> {
    let Coefficient::Constant(h) = &system.observation else { panic!("not constant") };
    let readings = vec![Observation::complete(vec![ratio(0, 1); h.rows()]); count];
    let all = statistics(&system.realised(&readings).expect("a model")).expect("noisy");
    all.iter().map(|now| now.likelihood_ratio().quadratic(z)).collect()
}

fn column(entries: &[i64]) -> Q {
    Matrix::column(entries.iter().map(|&entry| ratio(entry, 1)).collect())
}

fn limit(system: &System<Rational>, z: &Q) -> Option<Rational> {
    InfiniteHorizon::of(system).expect("constant").information(z)
}

/// SM-horizon: scalar systems: D = a − ch/v, and the sum is z²h²/v · (1 + D² + D⁴ + …), a geometric series: finite exactly if |D| < 1, or zh = 0.
#[test]
fn the_geometric_series() {
    let mut kinds = [0; 2];
    for a in [-3, -2, -1, 0, 1, 2, 3] {
        for (c, h, v) in [(0, 1, 1), (1, 1, 2), (-1, 2, 3), (1, 0, 1), (3, 2, 2), (1, -1, 4)] {
            let (a, c, h, v) = (ratio(a, 2), ratio(c, 1), ratio(h, 1), ratio(v, 1));
            let w = &c * &c / &v + ratio(1, 3);
            let system = system(number(a.clone()), number(h.clone()), number(w), number(c.clone()), number(v.clone()));
            let d = &a - &c * &h / &v;
            for z in [ratio(0, 1), ratio(3, 2)] {
                let first = &z * &z * &h * &h / &v;
                let expected = if first == ratio(0, 1) {
                    Some(first)
                } else {
                    (d.abs() < ratio(1, 1)).then(|| first / (ratio(1, 1) - &d * &d))
                };
                kinds[usize::from(expected.is_some())] += 1;
                assert_eq!(limit(&system, &number(z)), expected, "D = {d}");
            }
        }
    }
    assert!(kinds.iter().all(|&count| count > 5), "{kinds:?}");
}

/// SM-horizon: Jordan blocks at 1 and −1, a rotation by the angle of 3-4-5, nilpotent blocks, and what is not observed: values by hand.
#[test]
fn blocks_by_hand() {
    let row = |entries: &[i64]| column(entries).transpose();
    // [1 1; 0 1]: HDᵗz = z₀ + t z₁: constant, or growing; seen through the second state only z₁.
    for sign in [1, -1] {
        let jordan = Matrix::from_integers(&[[sign, 1], [0, sign]]);
        let first = plain(jordan.clone(), row(&[1, 0]));
        assert_eq!(limit(&first, &column(&[1, 0])), None);
        assert_eq!(limit(&first, &column(&[0, 1])), None);
        assert_eq!(limit(&first, &column(&[0, 0])), Some(ratio(0, 1)));
        let second = plain(jordan, row(&[0, 1]));
        assert_eq!(limit(&second, &column(&[7, 0])), Some(ratio(0, 1)));
        assert_eq!(limit(&second, &column(&[7, 1])), None);
    }
    // Eigenvalues (3 ± 4i)/5, of modulus 1 and no roots of unity; halved, the sum with both sensors is |z|²/(1 − ¼).
    let rotation = Matrix::from_integers(&[[3, -4], [4, 3]]).scaled(&ratio(1, 5));
    assert_eq!(limit(&plain(rotation.clone(), row(&[1, 0])), &column(&[2, 1])), None);
    let halved = plain(rotation.scaled(&ratio(1, 2)), Matrix::identity(2));
    assert_eq!(limit(&halved, &column(&[2, 1])), Some(ratio(20, 3)));
    // Moduli just off the circle.
    for (factor, bounded) in [(ratio(999_999, 1_000_000), true), (ratio(1_000_001, 1_000_000), false)] {
        let near = plain(rotation.scaled(&factor), row(&[0, 1]));
        assert_eq!(limit(&near, &column(&[1, 0])).is_some(), bounded);
    }
    // Nilpotent: finitely many terms, here 4 + 9 + 25.
    let nilpotent = Matrix::from_integers(&[[0, 1, 0], [0, 0, 1], [0, 0, 0]]);
    assert_eq!(limit(&plain(nilpotent, row(&[1, 0, 0])), &column(&[2, 3, 5])), Some(ratio(38, 1)));
    // A stable and an unstable state, both seen by one sensor: bounded exactly on the stable eigenvector (1, 0) and for no other z.
    let both = plain(Matrix::diagonal(&[ratio(1, 2), ratio(2, 1)]), row(&[1, 1]));
    assert_eq!(limit(&both, &column(&[3, 0])), Some(ratio(12, 1)));
    assert_eq!(limit(&both, &column(&[3, 1])), None);
    // H = 0 sees nothing.
    assert_eq!(
        limit(&plain(Matrix::identity(2).scaled(&ratio(5, 1)), row(&[0, 0])), &column(&[1, 1])),
        Some(ratio(0, 1))
    );
    // D and not A decides: A = 2 with D = 2 − 1 · 2 = 0, and A = 0 with D = −2.
    let shared = |a: i64, h: i64| {
        system(number(ratio(a, 1)), number(ratio(h, 1)), number(ratio(1, 1)), number(ratio(1, 1)), number(ratio(1, 1)))
    };
    assert_eq!(limit(&shared(2, 2), &column(&[1])), Some(ratio(4, 1)));
    assert_eq!(limit(&shared(0, 2), &column(&[1])), None);
}

/// An invertible matrix of small integers.
fn change_of_basis(n: usize, dice: &mut Dice) -> Q {
    loop {
        let found = dice.matrix(n, n);
        if found.rank() == n {
            return found;
        }
    }
}

/// SM-horizon: D is put together from blocks in a random basis, with and without a share of the noise, so that it is known which coordinates fade and which
/// are seen: the decision is that of the coordinates, sums over a finite horizon by the statistics stay below the limit and come
/// near it, or exceed any bound.
#[test]
fn random_systems_by_their_blocks() {
    let mut dice = Dice(11);
    let mut kinds = [0; 2];
    for _ in 0..60 {
        // Blocks: two that fade, one on the circle, one outside; each is seen or not.
        let one = |p: i64, q: i64| number(ratio(p, q));
        let blocks = [
            (one(1, 2), true),
            (Matrix::from_integers(&[[3, -4], [4, 3]]).scaled(&ratio(1, 10)), true),
            (one(-1, 1), false),
            (one(3, 2), false),
        ];
        let chosen: Vec<&(Q, bool)> = blocks.iter().filter(|_| dice.below(2) == 0).collect();
        let seen: Vec<bool> = chosen.iter().map(|_| dice.below(3) > 0).collect();
        let n: usize = chosen.iter().map(|(block, _)| block.rows()).sum();
        if n == 0 || n > 4 {
            continue;
        }
        let d = chosen.iter().fold(Matrix::zeros(0, 0), |all, (block, _)| all.block_diagonal(block));
        let basis = change_of_basis(n, &mut dice);
        let inverse = basis.inverse().expect("regular");
        // The eigenvalues differ, so a sensor with no zero on a block observes it.
        let of_block: Vec<usize> =
            chosen.iter().enumerate().flat_map(|(i, (block, _))| vec![i; block.rows()]).collect();
        let h = Matrix::from_fn(1, n, |_, j| ratio(i64::from(seen[of_block[j]]), 1)) * &inverse;
        let (v, wv) = (number(ratio(2, 1)), dice.matrix(n, 1));
        // A = D + ΣʷᵛΣᵛ⁻¹H
        let a = &basis * &d * &inverse + (&wv * &h).scaled(&ratio(1, 2));
        // ΣʷᵛΣᵛ⁻¹Σᵛʷ, the least there is: numbers stay short.
        let w = (&wv * wv.transpose()).scaled(&ratio(1, 2));
        let system = system(a, h, w, wv, v);
        for _ in 0..3 {
            let coordinates = dice.matrix(n, 1);
            let kept: Vec<bool> = chosen.iter().map(|_| dice.below(2) == 0).collect();
            let coordinates =
                Matrix::from_fn(n, 1, |i, _| if kept[of_block[i]] { coordinates[(i, 0)].clone() } else { ratio(0, 1) });
            let z = &basis * &coordinates;
            let bounded =
                (0..n).all(|i| coordinates[(i, 0)] == ratio(0, 1) || !seen[of_block[i]] || chosen[of_block[i]].1);
            let found = limit(&system, &z);
            assert_eq!(found.is_some(), bounded);
            let partial = sums(&system, &z, 24);
            assert!(partial.windows(2).all(|pair| pair[0] <= pair[1]));
            let last = &partial[24];
            match found {
                // All moduli are at most 1/2, so the rest is a geometric series with the ratio 1/4.
                Some(limit) => {
                    let rest = (&limit - last).to_f64().expect("finite");
                    assert!(last <= &limit && rest <= 1e-9 * (1.0 + limit.to_f64().expect("finite")), "{rest:e}");
                }
                None => assert!(last > &(&partial[12] + ratio(1, 1)), "{last} after {}", partial[12]),
            }
            kinds[usize::from(bounded)] += 1;
        }
    }
    assert!(kinds.iter().all(|&count| count > 20), "{kinds:?}");
}

fn mixture(parts: &[(Rational, Q, Q)]) -> InitialLaw<Rational> {
    let component = |(weight, mean, covariance): &(Rational, Q, Q)| Component {
        weight: weight.clone(),
        law: Gaussian::new(mean.clone(), covariance.clone()).expect("symmetric"),
    };
    InitialLaw::mixture(parts.iter().map(component)).expect("a law")
}

/// SM-horizon: the verdict for atoms and for Gaussian components, degenerate ones too, with a value of ξ that shows it; D = diag(1/2, 2), both seen.
#[test]
fn verdicts() {
    let horizon = InfiniteHorizon::of(&plain(Matrix::diagonal(&[ratio(1, 2), ratio(2, 1)]), Matrix::identity(2)))
        .expect("constant");
    let of = |parts: &[(Rational, Q, Q)]| horizon.limit_measure(&mixture(parts));
    let none = Matrix::zeros(2, 2);
    let (along, across) = (Matrix::from_integers(&[[3, 0], [0, 0]]), Matrix::from_integers(&[[0, 0], [0, 5]]));
    let (fades, grows) = (column(&[2, 0]), column(&[2, 1]));
    let (half, whole) = (ratio(1, 2), ratio(1, 1));
    assert_eq!(of(&[(whole.clone(), fades.clone(), none.clone())]), LimitMeasure::Equivalent);
    assert_eq!(of(&[(whole.clone(), fades.clone(), along.clone())]), LimitMeasure::Equivalent);
    let singular = LimitMeasure::Singular { witness: grows.clone() };
    assert_eq!(of(&[(whole.clone(), grows.clone(), none.clone())]), singular);
    // Its mean fades, and almost no other value does.
    let spread = of(&[(whole.clone(), fades.clone(), across.clone())]);
    assert_eq!(spread, LimitMeasure::Singular { witness: column(&[2, 5]) });
    // Some values are as (0, 0), but almost none.
    assert_eq!(of(&[(whole, grows.clone(), across.clone())]), singular);
    let mixed = of(&[(ratio(1, 3), fades.clone(), along), (ratio(1, 6), fades, none), (half.clone(), grows, across)]);
    assert_eq!(mixed, LimitMeasure::Mixed { with_density: half, witness: column(&[2, 1]) });
}

/// SM-horizon: what the equivalence rests on, for the log-normal L(T) given ξ = z with v = zᵀM(T)z: E L² = exp(v), so that bounded v make L(T)
/// converge in the mean; and E exp(s log L) = exp(½(s² − s)v), Ē exp(s log L) = E L^(s+1) = exp(½(s² + s)v), so that log L is N(−½v, v) under
/// ℙ and N(½v, v) under ℙ̄: for v → ∞ the event log L > 0 separates them. For a fading system v is bounded by the limit, for another it
/// is not.
#[test]
fn the_law_of_the_log_likelihood_ratio() {
    let mut dice = Dice(5);
    let fades = plain(Matrix::from_integers(&[[1, 1], [0, -1]]).scaled(&ratio(1, 2)), Matrix::identity(2));
    let stays = plain(Matrix::from_integers(&[[1, 1], [0, -1]]), Matrix::identity(2));
    for _ in 0..8 {
        let z = dice.matrix(2, 1) + column(&[0, 4]);
        let bound = limit(&fades, &z).expect("bounded");
        let readings = vec![Observation::complete([ratio(0, 1), ratio(0, 1)]); 8];
        for (system, is_bounded) in [(&fades, true), (&stays, false)] {
            let path = system.realised(&readings).expect("a model");
            let choice = exact_kalman::nongaussian::Choice::of_the_paper(2, 8);
            let log = exact_kalman::nongaussian::Decomposition::new(&path, choice).expect("noisy").log_density(&z);
            let v = sums(system, &z, 8).pop().expect("some");
            assert_eq!(log.variance(), v);
            assert_eq!(log.log_moment(&ratio(2, 1)), v);
            for s in [ratio(1, 1), ratio(-1, 2), ratio(3, 1)] {
                let square = &s * &s;
                assert_eq!(log.log_moment(&s), (&square - &s) * &v * ratio(1, 2));
                assert_eq!(log.log_moment(&(&s + ratio(1, 1))), (&square + &s) * &v * ratio(1, 2));
            }
            assert_eq!(is_bounded, v <= bound);
        }
    }
}

/// SM-horizon: what is not decided is refused with the reason.
#[test]
fn what_is_not_constant_is_refused() {
    let one = Matrix::<Rational>::identity(1);
    let changing = System { transition: Coefficient::per_step([one.clone()]), ..plain(one.clone(), one.clone()) };
    assert_eq!(InfiniteHorizon::of(&changing), Err(HorizonError::NotConstant(Field::Transition)));
    let arriving = System { timing: Timing::Arriving, ..plain(one.clone(), one.clone()) };
    assert_eq!(InfiniteHorizon::of(&arriving), Err(HorizonError::Statistics(StatisticsError::Arriving)));
    let zero = Matrix::zeros(1, 1);
    let noiseless = system(one.clone(), one.clone(), one.clone(), zero.clone(), zero.clone());
    assert_eq!(
        InfiniteHorizon::of(&noiseless),
        Err(HorizonError::Statistics(StatisticsError::Noiseless { step: 0, witness: one.clone() }))
    );
    let two = Matrix::<Rational>::identity(2);
    assert!(matches!(InfiniteHorizon::of(&plain(two, one.clone())), Err(HorizonError::Model(_))));
    let indefinite = system(one.clone(), one.clone(), zero, one.clone(), one);
    assert!(matches!(InfiniteHorizon::of(&indefinite), Err(HorizonError::Model(_))));
}
