//! The price of linearity against digits of an outside program (`price_digits.py` beside this file), laws that add, and simulation.

use exact_kalman::gaussian::Gaussian;
use exact_kalman::matrix::Matrix;
use exact_kalman::model::{Before, Initial, Noise, Observation, System, Timing};
use exact_kalman::nongaussian::{Component, Enclosed, InitialLaw, PriceError, Statistics, statistics};
use exact_kalman::reproduce::{NotSimulated, SimulatedPrice, simulated_price};
use exact_kalman::scalar::{Interval, Rational, exact_value, ratio};
use num_bigint::BigInt;

use super::world::{Noises, World};
use super::{Q, number, scalar};

/// A state that does not move by itself: X°(1) = Aξ after one reading Hξ + V, V ~ N(0, I). So R* = HᵀH and Q* = A.
fn seen(a: Q, h: Q) -> Statistics<Rational> {
    let n = a.rows();
    let (zero, unit) = (Matrix::zeros(n, n), Matrix::identity(h.rows()));
    let reading = Observation::complete(vec![ratio(0, 1); h.rows()]);
    let system = System {
        timing: Timing::Departing,
        initial: Initial::new(Before::Observation, Matrix::zeros(n, 1), zero.clone()),
        transition: a.into(),
        observation: h.into(),
        noise: Noise::Covariances { process: zero.into(), cross: None, observation: unit.into() },
        input: None,
        observation_input: None,
    };
    let path = system.realised(&[reading]).expect("a model");
    statistics(&path).expect("noisy").pop().expect("some")
}

fn mixture(parts: Vec<(Rational, Q, Q)>) -> InitialLaw<Rational> {
    let component =
        |(weight, mean, covariance)| Component { weight, law: Gaussian::new(mean, covariance).expect("symmetric") };
    InitialLaw::mixture(parts.into_iter().map(component)).expect("a law")
}

fn column(entries: &[i64]) -> Q {
    Matrix::column(entries.iter().map(|&x| ratio(x, 1)).collect())
}

/// R* = HᵀH = [[2, 1], [1, 1]], Q* = [[1, 0], [1, 1]].
fn plane() -> Statistics<Rational> {
    let factor = Matrix::from_integers(&[[1, 0], [1, 1]]);
    seen(factor.clone(), factor)
}

fn on_a_line() -> [(Statistics<Rational>, InitialLaw<Rational>); 2] {
    let last = |readings: &[i64]| statistics(&scalar([1, 1, 0, 0, 2], readings)).expect("noisy").pop().expect("some");
    let part = |weight, mean, variance| (weight, number(ratio(mean, 1)), number(ratio(variance, 1)));
    let two = mixture(vec![part(ratio(1, 3), 0, 3), part(ratio(2, 3), 1, 0)]);
    let three = mixture(vec![part(ratio(1, 4), -2, 5), part(ratio(1, 2), 1, 1), part(ratio(1, 4), 3, 0)]);
    [(last(&[0]), two), (last(&[0, 0, 0]), three)]
}

fn in_a_plane() -> [(Statistics<Rational>, InitialLaw<Rational>); 2] {
    let nothing = Matrix::zeros(2, 2);
    let atoms = [[0, 0], [1, 0], [0, 3]].map(|z| (ratio(1, 3), column(&z), nothing.clone()));
    let slab = [nothing.clone(), Matrix::identity(2)].map(|covariance| (ratio(1, 2), column(&[0, 0]), covariance));
    [(plane(), mixture(atoms.to_vec())), (plane(), mixture(slab.to_vec()))]
}

fn interval(found: &Enclosed) -> Interval {
    match found {
        Enclosed::Exact(value) => Interval::of(value, 64),
        Enclosed::Between(interval) => interval.clone(),
    }
}

fn price(now: &Statistics<Rational>, law: &InitialLaw<Rational>, bits: u64) -> Interval {
    interval(&now.price_of_linearity(law, bits).expect("narrow"))
}

fn simulated(now: &Statistics<Rational>, law: &InitialLaw<Rational>, draws: u32, seed: u64) -> SimulatedPrice {
    simulated_price(now, law, draws, seed).expect("doubles hold it")
}

fn ends(found: &Interval) -> [Rational; 2] {
    [found.lower(), found.upper()].map(|end| end.value().expect("short"))
}

/// A decimal, of which the last digit may be one off.
fn decimal(text: &str) -> [Rational; 2] {
    let digits = text.strip_prefix("0.").expect("below one");
    let value = Rational::new(
        digits.parse::<BigInt>().expect("digits"),
        BigInt::from(10).pow(u32::try_from(digits.len()).expect("small")),
    );
    let unit = Rational::new(BigInt::from(1), BigInt::from(10).pow(u32::try_from(digits.len()).expect("small")));
    [&value - &unit, value + unit]
}

fn within(found: &Interval, [least, most]: &[Rational; 2]) -> bool {
    let [lower, upper] = ends(found);
    *least < lower && upper < *most
}

/// ε and E‖X − X̂‖² by `price_digits.py`.
const LINE: [[&str; 2]; 2] =
    [["0.10226606333042748410", "0.65635462632474492969"], ["0.06914213438927504357", "0.51821846040626398989"]];
const PLANE: [[&str; 2]; 2] =
    [["0.14727483740667908488", "0.63843944830760662941"], ["0.05695028130703522798", "0.67032244596569204474"]];

/// SM-epsilon, SM-4.30: mixtures on a line (R* = 1/2, and 3/2 after three readings) and in a plane, to the digits of the outside program, which
/// integrates over the readings and knows neither R* nor B̄; with a relative width as asked for. And on average the theorem of
/// Pythagoras holds: E‖X − X̂ᴷ‖² = E‖X − X̂‖² + ε, where the left side is exact and the first term is the mean conditional variance by
/// the outside program.
#[test]
fn digits_of_an_outside_program() {
    for ((now, law), [digits, error]) in on_a_line().iter().zip(LINE).chain(in_a_plane().iter().zip(PLANE)) {
        let found = price(now, law, 70);
        assert!(within(&found, &decimal(digits)), "{digits}: {found:?}");
        let [lower, upper] = ends(&found);
        assert!(&upper - &lower <= lower / Rational::from(BigInt::from(1) << 70));
        let covariance = now.linear(law).covariance;
        let whole = (0..covariance.rows()).fold(ratio(0, 1), |sum, i| sum + &covariance[(i, i)]);
        let rest = Interval::of(&whole, 100).minus(&found, 100);
        assert!(within(&rest, &decimal(error)), "{error}: {rest:?}");
    }
}

/// SM-4.30: a spike and a slab a thousand times as wide; the strip is narrow only where they meet.
#[test]
fn a_spike_and_a_wide_slab() {
    let now = statistics(&scalar([1, 1, 0, 0, 2], &[0])).expect("noisy").pop().expect("some");
    let part = |variance| (ratio(1, 2), number(ratio(0, 1)), number(ratio(variance, 1)));
    let law = mixture(vec![part(0), part(1_000_000)]);
    let found = price(&now, &law, 70);
    assert!(within(&found, &decimal("0.9815892099915880106")), "{found:?}");
}

/// SM-4.30: enclosures that stop early, where the errors of the rule and the tails are all there is, hold the value. Atoms near and far,
/// components of like and of unlike width, short and long lattices.
#[test]
fn wide_enclosures_hold_the_value() {
    let now = seen(Matrix::identity(1), Matrix::identity(1));
    let part = |mean, variance| (ratio(1, 2), column(&[mean]), Matrix::diagonal(&[ratio(variance, 1)]));
    let laws = [
        [(0, 0), (1, 0)],
        [(0, 0), (9, 0)],
        [(0, 0), (40, 0)],
        [(0, 0), (0, 30)],
        [(2, 1), (-5, 9)],
        [(0, 0), (25, 400)],
    ];
    for law in laws.map(|parts| mixture(parts.map(|(mean, variance)| part(mean, variance)).to_vec())) {
        let sharp = price(&now, &law, 150);
        let mut widths = std::collections::BTreeSet::new();
        for bits in [1, 20, 40, 60] {
            let found = price(&now, &law, bits);
            assert!(found.lower() <= sharp.lower() && sharp.upper() <= found.upper(), "{bits}: {found:?}");
            let [lower, upper] = ends(&found);
            widths.insert(upper - lower);
        }
        assert!(widths.len() >= 3, "some stop early: {widths:?}");
    }
}

/// SM-4.30: two independent coins seen apart cost twice what one costs, three of them three times: so the plane agrees with the line, and the
/// simulation with both. Five standard errors are exceeded less than once in a million draws of a seed.
#[test]
fn independent_coins_add() {
    let coin = InitialLaw::atoms([-1, 1].map(|x| (ratio(1, 2), column(&[x])))).expect("a law");
    let [lower, upper] = ends(&price(&seen(Matrix::identity(1), Matrix::identity(1)), &coin, 60));
    for n in [2_usize, 3] {
        let now = seen(Matrix::identity(n), Matrix::identity(n));
        let sides = 1_i64 << n;
        let corner = |i: i64| (ratio(1, sides), Matrix::from_fn(n, 1, |row, _| ratio(2 * (i >> row & 1) - 1, 1)));
        let law = InitialLaw::atoms((0..sides).map(corner)).expect("a law");
        let times = ratio(i64::try_from(n).expect("small"), 1);
        let expected = [&lower * &times, &upper * &times];
        let found = now.price_of_linearity(&law, 40);
        if n == 2 {
            let [low, high] = ends(&interval(&found.expect("narrow")));
            assert!(low <= expected[1] && expected[0] <= high);
        } else {
            assert_eq!(found, Err(PriceError::Dimension { rank: 3 }));
        }
        let drawn = simulated(&now, &law, 20_000, 7);
        let away = exact_value(drawn.mean).expect("finite") - &expected[0];
        let allowed = exact_value(5.0 * drawn.standard_error).expect("finite");
        assert!(-&allowed < away && away < allowed, "{drawn}");
        assert!(drawn.standard_error < 0.01 * drawn.mean);
        assert_eq!(drawn, simulated(&now, &law, 20_000, 7));
        assert!(drawn.to_string().contains("simulated") && drawn.to_string().contains("no proof"));
    }
}

/// SM-epsilon: the law moved by 10⁹, or by 10²⁰⁰, is the same law around its mean, and simulated by the same numbers; twice the law through
/// half the sensors costs four times as much. What no double can hold is not simulated.
#[test]
fn a_simulation_does_not_see_where_the_law_is() {
    let corner = |i: i64| (ratio(1, 8), Matrix::from_fn(3, 1, |row, _| ratio(2 * (i >> row & 1) - 1, 1)));
    let moved = |shift: u32, times: u32| {
        let [shift, times] = [shift, times].map(|power| Rational::from(BigInt::from(10).pow(power)));
        let place = |(weight, z): (Rational, Q)| (weight, z.map(|x| x * &times + &shift));
        InitialLaw::atoms((0..8).map(corner).map(place)).expect("a law")
    };
    let now = seen(Matrix::identity(3), Matrix::identity(3));
    let there = simulated(&now, &InitialLaw::atoms((0..8).map(corner)).expect("a law"), 1000, 5);
    for shift in [9, 200] {
        assert_eq!(simulated(&now, &moved(shift, 0), 1000, 5), there);
    }
    let half = seen(Matrix::identity(3), Matrix::identity(3).scaled(&ratio(1, 2)));
    let twice =
        InitialLaw::atoms((0..8).map(corner).map(|(weight, z)| (weight, z.scaled(&ratio(2, 1))))).expect("a law");
    let large = simulated(&half, &twice, 1000, 5);
    assert_eq!((large.mean, large.standard_error), (4.0 * there.mean, 4.0 * there.standard_error));
    let small = |(weight, z): (Rational, Q)| (weight, z.map(|x| x / Rational::from(BigInt::from(10).pow(200))));
    let small = InitialLaw::atoms((0..8).map(corner).map(small)).expect("a law");
    for law in [moved(0, 200), small] {
        assert_eq!(simulated_price(&now, &law, 1000, 5), Err(NotSimulated));
    }
}

/// SM-4.30: forty components have a price, or what the work allowed tells of it: a simulation agrees.
#[test]
fn many_components_have_an_enclosure() {
    let now = statistics(&scalar([1, 1, 0, 0, 2], &[0])).expect("noisy").pop().expect("some");
    let part = |i: i64| (ratio(1, 40), number(ratio(i % 37, 3)), number(ratio(1 + i % 11, 2 + i % 3)));
    let law = mixture((0..40).map(part).collect());
    let [lower, upper] = match now.price_of_linearity(&law, 70) {
        Ok(found) => ends(&interval(&found)),
        Err(PriceError::TooWide { found, .. }) => ends(&found),
        Err(other) => panic!("{other}"),
    };
    let drawn = simulated(&now, &law, 2000, 3);
    let [mean, error] = [drawn.mean, drawn.standard_error].map(|x| exact_value(x).expect("finite"));
    let five = error * ratio(5, 1);
    assert!(lower < &mean + &five && &mean - &five < upper, "{drawn}: {lower} {upper}");
}

/// tr(Q*(I + ΔR*)⁻¹ΔQ*ᵀ)
fn bound(now: &Statistics<Rational>, law: &InitialLaw<Rational>) -> Rational {
    let (response, spread) = (now.response(), law.covariance());
    let inverse = (Matrix::identity(spread.rows()) + &spread * now.precision()).inverse().expect("at least I");
    (&response * inverse * spread * response.transpose()).trace()
}

/// SM-T3: 0 < ε < tr(Q*(I + ΔR*)⁻¹ΔQ*ᵀ) by the digits of the outside program, which knows no bound; on a line and in a plane.
#[test]
fn the_digits_are_below_the_bound() {
    for ((now, law), [digits, _]) in on_a_line().iter().zip(LINE).chain(in_a_plane().iter().zip(PLANE)) {
        let [least, most] = decimal(digits);
        assert!(ratio(0, 1) < least && most < bound(now, law), "{digits}");
    }
}

/// SM-T3, SM-4.30: for random systems that see one direction or two, and a mixture of a slab and atoms, the simulation lies in the enclosure, and
/// below tr(Q*(I + ΔR*)⁻¹ΔQ*ᵀ), both but for five standard errors.
#[test]
fn the_price_is_bounded() {
    let mut ranks = [0; 3];
    for (world, mut dice) in World::all(&[Noises::Correlated]) {
        let now = world.statistics(&vec![Matrix::zeros(world.k, 1); world.steps.len()]).remove(1);
        let rank = now.precision().rank();
        if rank == 0 || rank > 2 || ranks[rank] == 3 {
            continue;
        }
        ranks[rank] += 1;
        let atom = |dice: &mut super::world::Dice| dice.matrix(world.n, 1);
        let parts = [ratio(1, 2), ratio(1, 4), ratio(1, 4)]
            .map(|weight| (weight, atom(&mut dice), Matrix::zeros(world.n, world.n)));
        let mut parts = parts.to_vec();
        parts[0].2 = Matrix::identity(world.n);
        let law = mixture(parts);
        let [lower, upper] = match now.price_of_linearity(&law, 12) {
            Ok(found) => ends(&interval(&found)),
            Err(PriceError::TooWide { found, .. }) => ends(&found),
            Err(other) => panic!("{other}"),
        };
        assert!(ratio(0, 1) <= lower && lower <= upper);
        let drawn = simulated(&now, &law, 20_000, 3);
        let [mean, error] = [drawn.mean, drawn.standard_error].map(|x| exact_value(x).expect("finite"));
        let five = error * ratio(5, 1);
        assert!(lower < &mean + &five && &mean - &five < upper, "{drawn}: {lower} {upper}");
        assert!(&mean - &five < bound(&now, &law), "{drawn}");
    }
    assert_eq!(ranks, [0, 3, 3]);
}

/// SM-4.30: where more is asked than a few seconds can do, the error says between which numbers the price lies.
#[test]
fn what_is_too_much_says_what_is_known() {
    let nothing = Matrix::zeros(2, 2);
    let crossed = [[4, 0], [0, 4]]
        .map(|diagonal| (ratio(1, 2), column(&[0, 0]), Matrix::diagonal(&diagonal.map(|x| ratio(x, 1)))));
    let law = mixture(crossed.to_vec());
    let Err(PriceError::TooWide { found, bits: 1000, .. }) = plane().price_of_linearity(&law, 1000) else {
        panic!("narrow")
    };
    let [lower, upper] = ends(&found);
    assert!(ratio(0, 1) < lower && lower < upper);
    let far =
        mixture(vec![(ratio(1, 2), column(&[0, 0]), nothing.clone()), (ratio(1, 2), column(&[1_000_000, 0]), nothing)]);
    // So far apart the readings tell the atoms: the affine estimate errs by what it makes of the noise alone.
    assert!(plane().price_of_linearity(&far, 30).is_ok());
}
