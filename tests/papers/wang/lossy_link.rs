//! Example 1.1: a scalar state that is observed or not.

use exact_kalman::matrix::Matrix;
use exact_kalman::scalar::{Rational, Scalar, ratio};
use exact_kalman::stability::{CovarianceLaw, ModeProcess, StartError, TooManyStates, Window};

use super::{scalar, scalar_mode};

/// f, q and r, and the law of h(k): values with their probabilities.
struct Link {
    f: Rational,
    q: Rational,
    r: Rational,
    law: Vec<(Rational, Rational)>,
}

impl Link {
    /// WG-49, with q = r = 1.
    fn lossy(f: Rational, a: &Rational) -> Self {
        let [zero, one] = [0, 1].map(|value| ratio(value, 1));
        let kept = one.minus(a);
        Self { f, q: one.clone(), r: one.clone(), law: vec![(zero, a.clone()), (one, kept)] }
    }

    fn process(&self) -> ModeProcess<Rational> {
        let mode = |h: &Rational| scalar_mode([self.f.clone(), h.clone(), self.q.clone(), self.r.clone()]);
        let (modes, law) = self.law.iter().map(|(h, probability)| (mode(h), probability.clone())).unzip();
        ModeProcess::independent(modes, law).expect("probabilities")
    }

    /// f² r p/(h² p + r) + q
    fn next(&self, h: &Rational, p: &Rational) -> Rational {
        &self.f * &self.f * &self.r * p / (h * h * p + &self.r) + &self.q
    }
}

/// The law of p(k) at k = 0, …, steps.
fn laws(process: &ModeProcess<Rational>, start: Rational, steps: usize) -> Vec<CovarianceLaw<'_, Rational>> {
    let mut law = CovarianceLaw::start(process, scalar(start), 100_000).expect("a variance");
    let mut laws = vec![law.clone()];
    for _ in 0..steps {
        law.advance().expect("few states");
        laws.push(law.clone());
    }
    laws
}

fn moment(law: &CovarianceLaw<'_, Rational>, exponent: u32) -> Rational {
    law.mean_power(exponent)[(0, 0)].clone()
}

/// WG-E1.1, WG-D1.1, WG-46: f = 3/2, a = 1/4, q = r = 1, p(0) = 2. The mean is 2, 13/4, … and stays below 43/7, as a f² = 9/16 < 1,
/// though A1 fails; second and third moments grow without bound, as a f⁴ = 81/64 > 1 and a f⁶ = 729/256 > 1: on each lossy step
/// a part a of the probability is multiplied by at least f²ˢ.
#[test]
fn the_mean_stays_bounded_and_the_square_does_not() {
    let a = ratio(1, 4);
    let link = Link::lossy(ratio(3, 2), &a);
    let process = link.process();
    assert_eq!(process.smallest_window(Window::Shifted, 100).expect("few subspaces").length(), None);
    let laws = laws(&process, ratio(2, 1), 10);
    let means: Vec<Rational> = laws.iter().map(|law| moment(law, 1)).collect();
    assert_eq!(means[..3], [ratio(2, 1), ratio(13, 4), ratio(23815, 5824)][..]);
    assert!(means.is_sorted() && means.iter().all(|mean| *mean < ratio(43, 7)));
    for pair in means.windows(2) {
        assert!(pair[1] <= ratio(9, 16) * &pair[0] + ratio(43, 16));
    }
    let squares: Vec<Rational> = laws.iter().map(|law| moment(law, 2)).collect();
    let cubes: Vec<Rational> = laws.iter().map(|law| moment(law, 3)).collect();
    assert_eq!(squares[..2], [ratio(4, 1), ratio(49, 4)]);
    for (moments, factor) in [(&squares, ratio(81, 64)), (&cubes, ratio(729, 256))] {
        assert!(factor > ratio(1, 1));
        assert!(moments.windows(2).all(|pair| pair[1] > &factor * &pair[0]));
    }
    // The worst path loses everything.
    assert_eq!(laws[10].worst().path, [0; 10]);
    assert_eq!(laws[10].states().len(), 1024);
}

/// WG-46, WG-50: with any finite law of h(k), state by state, by the formula of the example.
#[test]
fn the_scalar_equation_is_that_of_the_example() {
    let law = vec![(ratio(0, 1), ratio(1, 6)), (ratio(-1, 2), ratio(1, 3)), (ratio(3, 1), ratio(1, 2))];
    let link = Link { f: ratio(7, 5), q: ratio(2, 3), r: ratio(3, 4), law };
    let process = link.process();
    for pair in laws(&process, ratio(5, 1), 5).windows(2) {
        let mut expected = ratio(0, 1);
        for state in pair[0].states() {
            for (h, probability) in &link.law {
                expected += &state.probability * probability * link.next(h, &state.covariance[(0, 0)]);
            }
        }
        assert_eq!(moment(&pair[1], 1), expected);
    }
}

/// WG-50, WG-49, WG-E1.1-growth, WG-48: f = 2/√a with a = 1/4: the mean after one more step is the formula, at least 4 p + q, and
/// at most 4 p + (1 − a) f² r + q; so it grows like 4ᵏ, but for p(0) = q = 0.
#[test]
fn the_mean_grows_as_the_example_says() {
    let a = ratio(1, 4);
    let link = Link::lossy(ratio(4, 1), &a);
    let process = link.process();
    let laws = laws(&process, ratio(1, 2), 8);
    for (step, pair) in laws.windows(2).enumerate() {
        let (before, after) = (moment(&pair[0], 1), moment(&pair[1], 1));
        let seen = pair[0].expectation(|p| &p[(0, 0)] / (ratio(1, 1) + &p[(0, 0)]));
        let (kept, square) = (ratio(3, 4), ratio(16, 1));
        assert_eq!(after, &a * &square * &before + &kept * &square * seen + ratio(1, 1));
        assert!(after >= ratio(4, 1) * &before + ratio(1, 1));
        assert!(after <= ratio(4, 1) * &before + kept * square + ratio(1, 1));
        assert!(after >= ratio(4_i64.pow(u32::try_from(step).expect("few steps")), 1));
    }
    let still = Link { q: ratio(0, 1), ..Link::lossy(ratio(4, 1), &a) };
    let still = still.process();
    assert!(self::laws(&still, ratio(0, 1), 8).iter().all(|law| moment(law, 1) == ratio(0, 1)));
}

/// WG-48: the edge is a f² = 1: there the mean still grows by q at each step; just below, it stays under
/// max(p(0), ((1 − a) f² r + q)/(1 − a f²)).
#[test]
fn the_mean_is_unbounded_from_the_edge_on() {
    let a = ratio(1, 4);
    let edge = Link::lossy(ratio(2, 1), &a);
    let process = edge.process();
    for pair in laws(&process, ratio(0, 1), 9).windows(2) {
        assert!(moment(&pair[1], 1) >= moment(&pair[0], 1) + ratio(1, 1));
    }
    let below = Link::lossy(ratio(19, 10), &a);
    let square = ratio(361, 100);
    let most = (ratio(3, 4) * &square + ratio(1, 1)) / (ratio(1, 1) - &a * &square);
    let process = below.process();
    assert!(laws(&process, ratio(0, 1), 9).iter().all(|law| moment(law, 1) < most));
}

/// WG-E1.1, WG-D1.1: f = 5/4 and a = 1/4 have a f⁴ = 625/1024 < 1 and a f⁶ < 1: the second moment stays bounded, since
/// E p(k+1)² ≤ a (f⁴ E p(k)² + 2f² E p(k) + 1) + (1 − a)(f² + 1)².
#[test]
fn the_square_stays_bounded_where_it_should() {
    let (a, square) = (ratio(1, 4), ratio(25, 16));
    let link = Link::lossy(ratio(5, 4), &a);
    let process = link.process();
    let one = || ratio(1, 1);
    let observed = &square + one();
    let most_mean = (ratio(3, 4) * &square + one()) / (one() - &a * &square);
    let constant = &a * (ratio(2, 1) * &square * &most_mean + one()) + ratio(3, 4) * &observed * &observed;
    let most_square = &constant / (one() - &a * &square * &square);
    for pair in laws(&process, ratio(0, 1), 9).windows(2) {
        assert!(moment(&pair[0], 1) <= most_mean && moment(&pair[1], 2) <= most_square);
        assert!(moment(&pair[1], 2) <= &a * &square * &square * moment(&pair[0], 2) + &constant);
    }
}

/// Pr{∑ f^(2(i−k)) h²(i) = 0} over a window of h steps, by enumeration of the values of h(i).
fn probability_of_zero(link: &Link, length: usize) -> Rational {
    let all = (0..length).fold(vec![(ratio(0, 1), ratio(1, 1))], |sums, step| {
        let weight = (0..2 * step).fold(ratio(1, 1), |power, _| power * &link.f);
        let grown = |(sum, probability): &(Rational, Rational)| -> Vec<(Rational, Rational)> {
            link.law.iter().map(|(h, next)| (sum + &weight * h * h, probability * next)).collect()
        };
        sums.iter().flat_map(grown).collect()
    });
    all.into_iter().filter(|(sum, _)| *sum == ratio(0, 1)).map(|(_, probability)| probability).sum()
}

/// WG-47, WG-E1.1-zero, WG-E1.1-if, WG-E1.1-only-if, WG-E1.1-A1: for independent h(k) of any finite law, A1 holds with a window
/// exactly if Pr{h(1) = 0} = 0, in both windows; and the probability that a window sees nothing is Pr{h(1) = 0}ʰ.
#[test]
fn for_independent_observations_the_window_does_not_matter() {
    let laws: [&[[i64; 2]]; 4] = [&[[0, 1], [1, 3]], &[[2, 1], [1, 1]], &[[0, 2]], &[[-1, 1], [0, 1], [3, 5]]];
    for weights in laws {
        let all: i64 = weights.iter().map(|[_, weight]| weight).sum();
        let law: Vec<_> = weights.iter().map(|[h, weight]| (ratio(*h, 1), ratio(*weight, all))).collect();
        let zero: Rational = law.iter().filter(|(h, _)| *h == ratio(0, 1)).map(|(_, probability)| probability).sum();
        let link = Link { f: ratio(3, 2), q: ratio(1, 1), r: ratio(1, 1), law };
        let process = link.process();
        for length in 1..=4 {
            let unseen = probability_of_zero(&link, length);
            assert!(unseen <= zero);
            assert_eq!(unseen, (0..length).fold(ratio(1, 1), |power, _| power * &zero));
            for window in [Window::Shifted, Window::Printed] {
                let verdict = process.observability(window, length, 1000).expect("few subspaces");
                assert_eq!(verdict.holds(), zero == ratio(0, 1));
            }
        }
    }
}

/// WG-E1.1-only-if: without independence it fails: h(k) alternating between 0 and 1 with a random phase never misses twice,
/// so A1 holds with h = 2 while Pr{h(1) = 0} = 1/2.
#[test]
fn alternating_observations_need_no_independence() {
    let mode = |h| scalar_mode([3, h, 1, 1].map(|entry| ratio(entry, 1)));
    let alternate = Matrix::from_integers(&[[0, 1], [1, 0]]);
    let process =
        ModeProcess::markov(vec![mode(0), mode(1)], vec![ratio(1, 2), ratio(1, 2)], alternate).expect("probabilities");
    for window in [Window::Shifted, Window::Printed] {
        assert_eq!(process.smallest_window(window, 100).expect("few subspaces").length(), Some(2));
    }
}

/// WG-E1.1-A1: with < δ for ≤ δ the condition is weaker at one δ: with h(k) = 1 and h = 1 the sum is 1, so Pr{… < 1} = 0 but
/// Pr{… ≤ 1} = 1. Any smaller δ makes both hold, so that nothing follows from it.
#[test]
fn less_and_at_most_differ_at_one_delta() {
    let sum = ratio(1, 1);
    for (delta, less, at_most) in [(ratio(1, 1), false, true), (ratio(1, 2), false, false)] {
        assert_eq!((sum < delta, sum <= delta), (less, at_most));
    }
    let process =
        ModeProcess::independent(vec![scalar_mode([2, 1, 1, 1].map(|entry| ratio(entry, 1)))], vec![ratio(1, 1)])
            .expect("probabilities");
    assert_eq!(process.gramian_margin(Window::Shifted, 1, 10), Ok(ratio(1, 2)));
}

/// WG-weak: Markov's inequality, and that it has no converse: with f = 4, a = 1/4 the mean is at least 4^(k−1), and yet
/// p(k) > b(n) has a probability of at most a^(n+1) at every k, b(n) being what n losses after an observation lead to at most.
#[test]
fn bounded_in_probability_and_not_in_the_mean() {
    let a = ratio(1, 4);
    let link = Link::lossy(ratio(4, 1), &a);
    let process = link.process();
    // b(0) = f² r + q bounds p after an observation, and the start.
    let mut bounds = vec![ratio(17, 1)];
    for n in 0..5 {
        bounds.push(ratio(16, 1) * &bounds[n] + ratio(1, 1));
    }
    for (k, law) in laws(&process, ratio(1, 1), 8).iter().enumerate() {
        let exceeds = |c: &Rational| law.expectation(|p| ratio(i64::from(p[(0, 0)] > *c), 1));
        let mut most = ratio(1, 1);
        for bound in &bounds {
            most *= &a;
            let probability = exceeds(bound);
            assert!(probability <= most);
            for (power, exponent) in [(bound.clone(), 1), (bound * bound, 2)] {
                assert!(probability.times(&power) <= moment(law, exponent));
            }
        }
        let growth = (1..k).fold(ratio(1, 1), |power, _| power * ratio(4, 1));
        assert!(moment(law, 1) >= growth);
    }
}

/// WG-D1.1: no law has more states than allowed, one that would have more leaves the last one as it is; and P(0) must be a
/// covariance.
#[test]
fn a_law_of_too_many_states_says_so() {
    let process = Link::lossy(ratio(2, 1), &ratio(1, 2)).process();
    let mut law = CovarianceLaw::start(&process, scalar(ratio(1, 1)), 4).expect("a variance");
    law.advance().expect("two states");
    law.advance().expect("four states");
    let before = law.mean();
    assert_eq!(law.advance(), Err(TooManyStates { time: 3, limit: 4 }));
    assert_eq!((law.time(), law.states().len(), law.mean()), (2, 4, before));
    let negative = CovarianceLaw::start(&process, scalar(ratio(-1, 1)), 4);
    assert!(matches!(negative, Err(StartError::NotSemidefinite(_))));
    let wide = CovarianceLaw::start(&process, Matrix::identity(2), 4);
    assert!(matches!(wide, Err(StartError::Shape { .. })));
}

/// WG-46: without noise of the process a lost observation and one of nothing are the same: the paths to a state that is
/// known for certain are one, and modes with one law of the next are not told apart.
#[test]
fn paths_that_meet_are_one() {
    let process = Link { q: ratio(0, 1), ..Link::lossy(ratio(2, 1), &ratio(1, 4)) }.process();
    for law in laws(&process, ratio(0, 1), 5) {
        assert_eq!(law.states().len(), 1);
        assert_eq!(law.states()[0].probability, ratio(1, 1));
        assert_eq!(law.states()[0].path, vec![0; law.time()]);
    }
}
