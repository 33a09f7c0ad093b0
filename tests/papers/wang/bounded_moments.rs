//! Which moments stay bounded, and how often an observation must arrive.

use std::cmp::Ordering;

use exact_kalman::matrix::Matrix;
use exact_kalman::scalar::{Rational, ratio};
use exact_kalman::stability::{
    CovarianceLaw, LargestMoment, Mode, ModeProcess, MomentBound, MomentDoubt, MomentGrowth, MomentVerdict,
};
use num_traits::{One, Zero};

use super::{Q, scalar, scalar_mode};
use crate::dice::Dice;

/// One state; observations are lost with probability a, in a row with probability `again`.
fn link([f, lost, again]: &[Rational; 3]) -> ModeProcess<Rational> {
    let one = Rational::one();
    let mode = |h: i64| scalar_mode([f.clone(), ratio(h, 1), ratio(1, 1), ratio(1, 1)]);
    // The chain that is stationary with loss rate `lost`: from arrival to loss with p, p/(p + 1 − again) = lost.
    let p = lost * (&one - again) / (&one - lost);
    let chain = Matrix::from_rows(vec![vec![again.clone(), &one - again], vec![p.clone(), &one - &p]]).expect("square");
    ModeProcess::markov(vec![mode(0), mode(1)], vec![lost.clone(), &one - lost], chain).expect("a chain")
}

/// E P(k)ˢ for k = 0, …, n by walking all paths; one state.
fn means(process: &ModeProcess<Rational>, start: &Rational, power: i32, steps: usize) -> Vec<Rational> {
    let mut states: Vec<(Option<usize>, Rational, Rational)> = vec![(None, Rational::one(), start.clone())];
    let mut means = vec![start.pow(power)];
    for _ in 0..steps {
        let mut next = Vec::new();
        for (last, weight, p) in &states {
            for (mode, numbers) in process.modes().iter().enumerate() {
                let probability = last.map_or(&process.initial()[mode], |last| &process.transition()[(last, mode)]);
                let [f, h, q, r] =
                    [numbers.transition(), numbers.observation(), numbers.process_noise(), numbers.observation_noise()]
                        .map(|entry| entry[(0, 0)].clone());
                if !probability.is_zero() {
                    next.push((Some(mode), weight * probability, f.pow(2) * p * &r / (h.pow(2) * p + &r) + q));
                }
            }
        }
        states = next;
        means.push(states.iter().map(|(_, weight, p)| weight * p.pow(power)).sum());
    }
    means
}

/// Everything that a bound claims, checked by other means: for s = 1 by LDLᵀ, else by the Kronecker form of the operator.
fn assert_bound(process: &ModeProcess<Rational>, bound: &MomentBound) {
    let closed: Vec<Q> = process
        .modes()
        .iter()
        .zip(&bound.gains)
        .map(|(mode, gain)| mode.transition() * (Matrix::identity(process.states()) - gain * mode.observation()))
        .collect();
    if bound.order > 1 {
        assert!(
            kronecker_operator(process, &process.reachable(), &closed, 2 * bound.order)
                .spectral_radius_lt(&Rational::one())
        );
        return;
    }
    for &to in &process.reachable() {
        let carried = process
            .reachable()
            .into_iter()
            .map(|from| closed[from].congruence(&bound.lyapunov[from]).scaled(&process.transition()[(from, to)]));
        let sum = carried.reduce(|sum, term| sum + term).expect("a mode");
        assert_eq!(&bound.lyapunov[to] - sum, Matrix::identity(process.states()));
        assert!(bound.lyapunov[to].ldl().expect("a covariance").is_positive_definite());
    }
}

/// Everything that a proof of growth claims.
fn assert_growth(process: &ModeProcess<Rational>, growth: &MomentGrowth) {
    let v = &growth.subspace;
    assert_eq!(v.rank(), v.columns());
    let left = (v.transpose() * v).inverse().expect("a basis") * v.transpose();
    let mut restricted = vec![Matrix::zeros(v.columns(), v.columns()); process.modes().len()];
    for &mode in &growth.modes {
        let numbers = &process.modes()[mode];
        assert!((numbers.observation() * v).is_zero());
        assert!(numbers.process_noise().ldl().expect("a covariance").is_positive_definite());
        restricted[mode] = &left * numbers.transition() * v;
        assert_eq!(v * &restricted[mode], numbers.transition() * v);
    }
    let operator = kronecker_operator(process, &growth.modes, &restricted, 2 * growth.order);
    assert!(!operator.spectral_radius_lt(&growth.radius) && growth.radius >= Rational::one());
    assert!(growth.recurrent || growth.radius > Rational::one());
}

fn kronecker(a: &Q, b: &Q) -> Q {
    Matrix::from_fn(a.rows() * b.rows(), a.columns() * b.columns(), |i, j| {
        &a[(i / b.rows(), j / b.columns())] * &b[(i % b.rows(), j % b.columns())]
    })
}

/// Blocks T(i, j) A(i) ⊗ ⋯ ⊗ A(i): larger than the symmetric powers, with the same spectral radius.
pub fn kronecker_operator(process: &ModeProcess<Rational>, modes: &[usize], matrices: &[Q], degree: usize) -> Q {
    let power = |a: &Q| (1..degree).fold(a.clone(), |power, _| kronecker(&power, a));
    let powers: Vec<Q> = modes.iter().map(|&mode| power(&matrices[mode])).collect();
    let size = powers[0].rows();
    Matrix::from_fn(modes.len() * size, modes.len() * size, |row, column| {
        let (to, from) = (row / size, column / size);
        &process.transition()[(modes[from], modes[to])] * &powers[from][(row % size, column % size)]
    })
}

fn bounded(process: &ModeProcess<Rational>, order: usize, start: &Q) -> Option<MomentBound> {
    match process.moment(order, start) {
        MomentVerdict::Bounded(bound) => {
            assert_bound(process, &bound);
            Some(bound)
        }
        MomentVerdict::Unbounded(growth) => {
            assert_growth(process, &growth);
            None
        }
        MomentVerdict::Undecided(doubt) => panic!("{doubt:?}"),
    }
}

/// WG-D1.1, WG-E1.1, WG-48: one state, losses independent: E pˢ is bounded exactly if a f²ˢ < 1, and the bound is kept on all paths.
#[test]
fn a_moment_of_a_lossy_link_is_bounded_exactly_if_a_f_to_2s_is_below_one() {
    let mut seen = [0, 0, 0];
    for (f, a) in [(3, 2), (2, 1), (5, 4), (1, 1), (4, 3)]
        .into_iter()
        .flat_map(|f| [(1, 4), (1, 2), (9, 16), (1, 16), (16, 25)].map(|a| (f, a)))
    {
        let (f, a) = (ratio(f.0, f.1), ratio(a.0, a.1));
        let process = link(&[f.clone(), a.clone(), a.clone()]);
        for s in 1..=3 {
            let factor = &a * f.pow(2 * i32::try_from(s).expect("small"));
            let bound = bounded(&process, s, &scalar(ratio(2, 1)));
            assert_eq!(bound.is_some(), factor < Rational::one(), "{f} {a} {s}");
            seen[match factor.cmp(&Rational::one()) {
                Ordering::Less => 0,
                Ordering::Equal => 1,
                Ordering::Greater => 2,
            }] += 1;
            let means = means(&process, &ratio(2, 1), i32::try_from(s).expect("small"), 5);
            match bound {
                Some(bound) => assert!(means.iter().all(|mean| *mean <= bound.bound)),
                // E p(k+1)ˢ ≥ a f²ˢ E p(k)ˢ + qˢ.
                None => assert!(means.windows(2).all(|pair| pair[1] >= &factor * &pair[0] + Rational::one())),
            }
        }
    }
    assert!(seen.iter().all(|&count| count >= 2), "{seen:?}");
}

/// WG-E1.1: f = 3/2, a = 1/4: the mean is bounded, by 43/7, and the second moment is not.
#[test]
fn the_mean_may_be_bounded_and_the_variance_not() {
    let process = link(&[ratio(3, 2), ratio(1, 4), ratio(1, 4)]);
    let mean = bounded(&process, 1, &scalar(ratio(2, 1))).expect("9/16 < 1");
    // The bound from WG-50: E p⁺ ≤ (9/16) E p + (1/4) + (3/4)(9/4 + 1). A gain that is not the largest does better.
    assert!(mean.bound <= ratio(43, 7));
    let walked = means(&process, &ratio(2, 1), 1, 6);
    assert_eq!(walked[1], ratio(13, 4));
    assert!(walked.iter().all(|mean| *mean <= ratio(43, 7)) && walked[6] > ratio(5, 1));
    assert!(bounded(&process, 2, &scalar(ratio(2, 1))).is_none());
    assert!(bounded(&process, 3, &scalar(ratio(2, 1))).is_none());
}

/// WG-E1.1: with losses that follow each other the stationary rate of loss does not decide: f = 3/2 diverges at a rate of 3/13 and stays bounded
/// at a rate of 1/2.
#[test]
fn the_rate_of_loss_does_not_decide() {
    let seldom = link(&[ratio(3, 2), ratio(3, 13), ratio(1, 2)]);
    assert_eq!(seldom.transition()[(1, 0)], ratio(3, 20));
    assert!(bounded(&seldom, 1, &scalar(ratio(1, 1))).is_none());
    let often = link(&[ratio(3, 2), ratio(1, 2), ratio(1, 10)]);
    assert_eq!(often.transition()[(1, 0)], ratio(9, 10));
    let bound = bounded(&often, 1, &scalar(ratio(1, 1))).expect("(9/4)(1/10) < 1");
    assert!(means(&often, &ratio(1, 1), 1, 6).iter().all(|mean| *mean <= bound.bound));
    let walked = means(&seldom, &ratio(1, 1), 1, 6);
    // On paths of losses alone: E p(k+1)1{lost} ≥ (9/8) E p(k)1{lost}.
    assert!(walked.windows(2).all(|pair| pair[1] > pair[0]));
}

/// WG-D1.1: one state and random chains with several modes, some blind, each with its own F: bounded exactly if ρ(T(i, j)f(i)²ˢ) < 1 over blind
/// modes; the verdict carries a proof that is checked, and bounds are kept on all paths.
#[test]
fn one_state_is_decided() {
    let mut dice = Dice(11);
    let mut counts = [0, 0];
    for _ in 0..60 {
        let n = 2 + dice.size(1);
        let modes: Vec<Mode<Rational>> = (0..n)
            .map(|_| {
                let f = ratio(2 + i64::try_from(dice.below(7)).expect("small"), 4);
                scalar_mode([f, ratio(i64::try_from(dice.below(2)).expect("small"), 1), ratio(1, 2), ratio(1, 1)])
            })
            .collect();
        let law = |dice: &mut Dice| {
            let parts: Vec<i64> = (0..n).map(|_| 1 + i64::try_from(dice.below(3)).expect("small")).collect();
            parts.iter().map(|part| ratio(*part, parts.iter().sum())).collect::<Vec<_>>()
        };
        let chain = Matrix::from_rows((0..n).map(|_| law(&mut dice)).collect()).expect("square");
        let process = ModeProcess::markov(modes, law(&mut dice), chain).expect("a chain");
        let order = 1 + dice.size(1);
        let blind: Vec<usize> = (0..n).filter(|&i| process.modes()[i].observation().is_zero()).collect();
        let factors = Matrix::from_fn(blind.len(), blind.len(), |to, from| {
            let f = &process.modes()[blind[from]].transition()[(0, 0)];
            &process.transition()[(blind[from], blind[to])] * f.pow(2 * i32::try_from(order).expect("small"))
        });
        let bound = bounded(&process, order, &scalar(ratio(1, 1)));
        assert_eq!(bound.is_some(), factors.spectral_radius_lt(&Rational::one()));
        if let Some(bound) = &bound {
            let walked = means(&process, &ratio(1, 1), i32::try_from(order).expect("small"), 4);
            assert!(walked.iter().all(|mean| *mean <= bound.bound));
        }
        counts[usize::from(bound.is_some())] += 1;
    }
    assert!(counts.iter().all(|&count| count > 10), "{counts:?}");
}

/// WG-D1.1: two states. Verdicts carry proofs that are checked; means over all paths keep below the bound.
#[test]
fn verdicts_on_two_states_carry_their_proofs() {
    let mut dice = Dice(5);
    let mut counts = [0, 0, 0];
    for _ in 0..40 {
        let modes: Vec<Mode<Rational>> = (0..2)
            .map(|i| {
                let transition = dice.matrix(2, 2).scaled(&ratio(3, 4));
                let observation = if i == 0 && dice.below(2) == 0 { Matrix::zeros(1, 2) } else { dice.matrix(1, 2) };
                Mode::new(transition, observation, dice.positive_definite(2), dice.positive_definite(1))
                    .expect("a mode")
            })
            .collect();
        let process = ModeProcess::independent(modes, vec![ratio(1, 3), ratio(2, 3)]).expect("a law");
        let start = Matrix::identity(2);
        match process.moment(1, &start) {
            MomentVerdict::Bounded(bound) => {
                assert_bound(&process, &bound);
                let mut law: Vec<(Rational, Q)> = vec![(Rational::one(), start.clone())];
                for _ in 0..5 {
                    law = law
                        .iter()
                        .flat_map(|(weight, p)| {
                            process
                                .modes()
                                .iter()
                                .zip(process.initial())
                                .map(move |(mode, share)| (weight * share, mode.step(p).next))
                        })
                        .collect();
                    let mean: Rational = law.iter().map(|(weight, p)| weight * (&p[(0, 0)] + &p[(1, 1)])).sum();
                    assert!(mean <= bound.bound);
                }
                counts[0] += 1;
            }
            MomentVerdict::Unbounded(growth) => {
                assert_growth(&process, &growth);
                counts[1] += 1;
            }
            MomentVerdict::Undecided(doubt) => {
                assert_eq!(doubt, MomentDoubt::NoCertificate);
                counts[2] += 1;
            }
        }
    }
    assert!(counts[0] > 5 && counts[1] > 5, "{counts:?}");
}

/// WG-D1.1: a direction that neither of two sensors sees, though each sees something: unbounded, with the direction as proof.
#[test]
fn a_direction_that_no_mode_sees_is_found() {
    let f = Matrix::diagonal(&[ratio(1, 2), ratio(1, 2), ratio(11, 10)]);
    let mode = |h: [i64; 3]| {
        let h = Matrix::from_integers(&[h]);
        Mode::new(f.clone(), h, Matrix::identity(3), Matrix::identity(1)).expect("a mode")
    };
    let process =
        ModeProcess::independent(vec![mode([1, 0, 0]), mode([0, 1, 0])], vec![ratio(1, 2); 2]).expect("a law");
    let MomentVerdict::Unbounded(growth) = process.moment(1, &Matrix::zeros(3, 3)) else { panic!("121/100 > 1") };
    assert_growth(&process, &growth);
    assert_eq!(growth.modes, [0, 1]);
    assert!(growth.subspace[(2, 0)] != ratio(0, 1) && growth.subspace.columns() == 1);
    assert!(matches!(process.moment(3, &Matrix::zeros(3, 3)), MomentVerdict::Undecided(MomentDoubt::TooLarge { .. })));
}

/// WG-D1.1: a loss of spectral radius exactly one: it diverges where losses come back for ever, and is not decided where they end.
#[test]
fn a_radius_of_one_is_told_by_recurrence() {
    let modes = || vec![scalar_mode([2, 0, 1, 1].map(|n| ratio(n, 1))), scalar_mode([2, 1, 1, 1].map(|n| ratio(n, 1)))];
    let chain = |back: Rational| {
        let rows = vec![vec![ratio(1, 4), ratio(3, 4)], vec![back.clone(), Rational::one() - back]];
        ModeProcess::markov(modes(), vec![ratio(1, 1), ratio(0, 1)], Matrix::from_rows(rows).expect("square"))
            .expect("a chain")
    };
    let recurrent = chain(ratio(1, 2));
    let growth = recurrent.moment_growth(1).expect("1/4 · 4 = 1");
    assert!(growth.recurrent && growth.radius == Rational::one());
    let transient = chain(ratio(0, 1));
    assert_eq!(transient.moment_growth(1), None);
    assert_eq!(transient.moment(1, &scalar(ratio(1, 1))), MomentVerdict::Undecided(MomentDoubt::NoCertificate));
    // There E p stays bounded: after k losses in a row, of probability 4^(1−k), p is below (4/3)4ᵏ; after an arrival it is at most 5.
    let walked = means(&transient, &ratio(1, 1), 1, 9);
    assert!(walked.iter().all(|mean| *mean < ratio(16, 3) + ratio(5, 1)));
}

/// WG-E1.1: the order at which a f²ˢ = 1, where it is a fraction and where it is not.
#[test]
fn the_largest_moment_is_found() {
    // a = 1/8, f = 4: 8 = 16ˢ, s = 3/4. a = 1/64, f = 2: s = 3.
    let quarter = LargestMoment::new(&ratio(1, 8), &ratio(-4, 1)).expect("0 < a < 1 < |f|");
    assert_eq!(quarter.compared_with(3, 4), Some(Ordering::Equal));
    assert_eq!(quarter.decimals(2), Some((ratio(75, 100), ratio(76, 100))));
    let three = LargestMoment::new(&ratio(1, 64), &ratio(2, 1)).expect("0 < a < 1 < f");
    assert_eq!(three.decimals(1), Some((ratio(3, 1), ratio(31, 10))));
    assert_eq!(
        [(1, 4), (0, 1), (1, 1)].map(|(a, b)| LargestMoment::new(&ratio(a, b), &ratio(1, 1))),
        [None, None, None]
    );
    assert_eq!(LargestMoment::new(&ratio(1, 1), &ratio(2, 1)), None);
    // Too near to f = 1: powers that would be too long are not begun.
    let slow = LargestMoment::new(&ratio(1, 2), &ratio(1_000_001, 1_000_000)).expect("0 < a < 1 < f");
    assert_eq!(slow.decimals(6), None);
    // The same by logarithms in floating point, whose error is far below 10⁻⁴.
    for (a, f) in [((1, 3), (5, 4)), ((9, 10), (21, 20)), ((1, 100), (7, 2))] {
        let (lower, upper) =
            LargestMoment::new(&ratio(a.0, a.1), &ratio(f.0, f.1)).and_then(|s| s.decimals(4)).expect("short powers");
        let number = |(n, m): (i64, i64)| exact_kalman::scalar::nearest_double(&ratio(n, m));
        let s = -number(a).ln() / (2.0 * number(f).ln());
        let near = |bound: &Rational| (exact_kalman::scalar::nearest_double(bound) - s).abs() < 1.001e-4;
        assert!(near(&lower) && near(&upper) && upper > lower);
    }
}

/// WG-48: what grows need not be excited where it grows: the noise of another mode, of another direction, or P(0) is enough. The means
/// by hand: with f = 2, lost without noise or received with q = r = 1, a = 1/2, E p(1) = 1/2, and then p = 0 or 1 becomes 0, 4, 1 or 3.
#[test]
fn growth_begins_where_noise_or_the_start_reaches() {
    let mode = |h, q| scalar_mode([2, h, q, 1].map(|entry| ratio(entry, 1)));
    let half = ratio(1, 2);
    let quiet = ModeProcess::independent(vec![mode(0, 0), mode(1, 1)], vec![half.clone(), half]).expect("a process");
    let nothing = scalar(ratio(0, 1));
    let mut law = CovarianceLaw::start(&quiet, nothing.clone(), 100).expect("a start");
    let means = [1, 2].map(|_| {
        law.advance().expect("few");
        law.mean()[(0, 0)].clone()
    });
    assert_eq!(means, [ratio(1, 2), ratio(4 + 1 + 3, 4)]);
    assert!(matches!(quiet.moment(1, &nothing), MomentVerdict::Unbounded(_)));
    // P(k) = 4ᵏ P(0).
    let blind = ModeProcess::independent(vec![mode(0, 0)], vec![ratio(1, 1)]).expect("a process");
    assert!(matches!(blind.moment(1, &scalar(ratio(1, 1))), MomentVerdict::Unbounded(_)));
    assert_eq!(
        (blind.moment_growth(1), blind.moment(1, &nothing)),
        (None, MomentVerdict::Undecided(MomentDoubt::NoCertificate))
    );
    // The noise of the second state reaches the first.
    let chain = |noise: [Rational; 2]| {
        let (f, h) = (Matrix::from_integers(&[[2, 1], [0, 2]]), Matrix::from_integers(&[[0, 0]]));
        let mode = Mode::new(f, h, Matrix::diagonal(&noise), Matrix::identity(1)).expect("a mode");
        ModeProcess::independent(vec![mode], vec![ratio(1, 1)]).expect("a process")
    };
    assert!(chain([ratio(0, 1), ratio(1, 1)]).moment_growth(1).is_some());
    assert!(chain([ratio(0, 1), ratio(0, 1)]).moment_growth(1).is_none());
}
