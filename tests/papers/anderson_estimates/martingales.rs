//! The martingales behind (3.1), on a law with finitely many outcomes: every source is ±1 with probability 1/2.

use exact_kalman::matrix::Matrix;
use exact_kalman::scalar::{Rational, ratio};

use super::numbers::{Draws, Q, count, integers};
use super::world::{World, moment};

/// One source in each of x(0), v(0), …, v(5), w(1), …, w(5): 2¹² outcomes.
fn world(seed: u64) -> World {
    let mut draws = Draws::seeded(seed);
    let small = |draws: &mut Draws, columns: usize| Matrix::from_fn(2, columns, |_, _| ratio(draws.integer(2), 1));
    World {
        a: small(&mut draws, 2),
        v_root: integers(&[[1], [2]]),
        w_root: integers(&[[1], [-1]]),
        x_root: integers(&[[2], [1]]),
        x_mean: small(&mut draws, 1),
        past: 0,
        last: 5,
    }
}

/// The places of the sources: 1 is x(0), then v(0), …, v(5), then w(1), …, w(5).
fn place_of_v(k: usize) -> usize {
    2 + k
}

fn place_of_w(k: usize) -> usize {
    7 + k
}

const SOURCES: usize = 13;

/// The value of a vector of variables in an outcome; bit s − 1 is the sign of source s.
fn value(variables: &Q, outcome: u32) -> Q {
    let sign = |source: usize| if source == 0 || outcome >> (source - 1) & 1 == 0 { 1 } else { -1 };
    variables * Matrix::from_fn(SOURCES, 1, |source, _| ratio(sign(source), 1))
}

/// aᵀS(n,i)b, with S(n,1) and S(n,2) as printed.
struct Sums {
    /// w(k), v(k−1) − Aw(k−1) and y(k−2), for k = 3, 4, 5.
    terms: Vec<(usize, [Q; 2], Q)>,
    a: Q,
    b: Q,
}

impl Sums {
    fn of(world: &World, a: Q, b: Q) -> Self {
        let term = |k: i64| {
            let delayed = world.noise(k - 1) - &world.a * world.observation_noise(k - 1);
            (usize::try_from(k).unwrap_or(0), [world.observation_noise(k), delayed], world.y(k - 2))
        };
        Self { terms: (3..=5).map(term).collect(), a, b }
    }

    fn at(&self, n: usize, i: usize, outcome: u32) -> Rational {
        let of = |(k, noise, y): &(usize, [Q; 2], Q)| {
            let left = (self.a.transpose() * value(&noise[i - 1], outcome))[(0, 0)].clone();
            let right = (value(y, outcome).transpose() * &self.b)[(0, 0)].clone();
            left * right / count(*k)
        };
        self.terms.iter().filter(|(k, ..)| *k <= n).map(of).sum()
    }
}

/// The mean over all outcomes that agree with this one on the known sources.
fn given(known: &dyn Fn(usize) -> bool, outcome: u32, f: &dyn Fn(u32) -> Rational) -> Rational {
    let unknown: Vec<usize> = (1..SOURCES).filter(|&source| !known(source)).collect();
    let outcomes = (0..1_u32 << unknown.len()).map(|choice| {
        unknown.iter().enumerate().fold(outcome, |outcome, (place, &source)| {
            let bit = 1 << (source - 1);
            if choice >> place & 1 == 1 { outcome | bit } else { outcome & !bit }
        })
    });
    outcomes.map(f).sum::<Rational>() / count(1 << unknown.len())
}

/// The σ-algebra of x(0), v(0), …, v(n), w(1), …, w(n).
fn known_at(n: usize) -> impl Fn(usize) -> bool {
    move |source| {
        source == 1
            || (place_of_v(0)..=place_of_v(n)).contains(&source)
            || (place_of_w(1)..=place_of_w(n)).contains(&source)
    }
}

/// AK-S.n1, AK-S.n2, AK-Mart.1, AK-Mart.2: conditional means over all outcomes. The second martingale runs one index
/// behind: given ℱ(n) its next increment is not of mean zero.
#[test]
fn increments_have_conditional_mean_zero() {
    let world = world(31);
    let sums = Sums::of(&world, integers(&[[1], [2]]), integers(&[[3], [1]]));
    let mut surprised = false;
    // A sample of outcomes to condition at; the conditional means themselves are complete.
    for outcome in (0..1 << 12).step_by(41) {
        for n in [3, 4] {
            let next = |known: &dyn Fn(usize) -> bool, i: usize| given(known, outcome, &|o| sums.at(n + 1, i, o));
            assert_eq!(next(&known_at(n), 1), sums.at(n, 1, outcome));
            // S(n, 2) is known one step earlier.
            assert_eq!(next(&known_at(n - 1), 2), sums.at(n, 2, outcome));
            surprised |= next(&known_at(n), 2) != sums.at(n, 2, outcome);
        }
    }
    assert!(surprised);
}

/// AK-Var.1, AK-Var.2: second moments over all 2¹² outcomes, against the formulas with E[y yᵀ] from the sources.
#[test]
fn second_moments_of_the_martingales() {
    let world = world(32);
    let (a, b) = (integers(&[[1], [2]]), integers(&[[3], [1]]));
    let sums = Sums::of(&world, a.clone(), b.clone());
    let (v, w) = (world.v_covariance(), world.w_covariance());
    let quadratic = |x: &Q, m: &Q| x.transpose().congruence(m)[(0, 0)].clone();
    let spread = [quadratic(&a, &w), quadratic(&a, &(v + world.a.congruence(&w)))];
    for n in 3..=5 {
        for i in [1, 2] {
            let second = (0..1 << 12).map(|outcome| sums.at(n, i, outcome)).map(|s| &s * &s).sum::<Rational>();
            let term = |k: i64| {
                let y = world.y(k - 2);
                &spread[i - 1] * quadratic(&b, &moment(&y, &y)) / ratio(k * k, 1)
            };
            let formula: Rational = (3..=i64::try_from(n).unwrap_or(0)).map(term).sum();
            assert_eq!(second / count(1 << 12), formula, "n = {n}, i = {i}");
        }
    }
}

/// `b(n)⁻¹ Σ_{k=1..n} b(k)a(k)` with a(k) = 1/k².
fn average(b: impl Fn(i64) -> i64, n: i64) -> Rational {
    (1..=n).map(|k| ratio(b(k), k * k)).sum::<Rational>() / ratio(b(n), 1)
}

/// Erratum AK-Kron: a(n) = 1/n² is summable. With b(2j−1) = j⁴, b(2j) = j, which tends to infinity, the averages grow:
/// 3.9, 11.3, 38.8 at n = 10, 20, 40, and more than n/2 from n = 20 on. With increasing b they fall, by the rate 1/n at
/// b(n) = n (its sum is the harmonic one) and likewise for b(n) = n² and n³.
#[test]
fn weights_must_increase() {
    let wild = |n: i64| if n % 2 == 0 { n / 2 } else { ((n + 1) / 2).pow(4) };
    let tenths = |n: i64| (average(wild, n) * ratio(10, 1)).round();
    assert_eq!([10, 20, 40].map(tenths), [39, 113, 388].map(|tenths| ratio(tenths, 1)));
    assert!((10..=60).step_by(2).all(|n| average(wild, 2 * n) > ratio(n, 1)));
    // Σ_{k≤n} b(k)/k² is below 1 + log₂ n, 1 + … = n and n(n+1)/2, so the averages are below:
    for n in [8_i64, 64, 512] {
        let steps = ratio(1 + i64::from(n.ilog2()), 1);
        assert!(average(|k| k, n) <= steps / ratio(n, 1));
        assert_eq!(average(|k| k * k, n), ratio(n, n * n));
        assert_eq!(average(|k| k * k * k, n), ratio(n * (n + 1), 2 * n * n * n));
    }
}
