//! Sections II.3 and III: under the new measure readings and initial condition are independent, and what follows.

use exact_kalman::matrix::Matrix;
use exact_kalman::nongaussian::as_printed::inverse_log_density;
use exact_kalman::nongaussian::{Choice, Decomposition, InitialLaw, Statistics};
use exact_kalman::scalar::{Dyadic, Interval, Rational, ratio};

use super::girsanov::log_ratios;
use super::world::{Dice, Noises, OfReadings, World, form, half, integrated, negated, product, stacked, value};
use super::{Q, scalar};

const BOTH: &[Noises] = &[Noises::Correlated, Noises::Standard];

/// The choice (3.10): the shift (0, −Σᵛ⁻¹HZ), the new noises, X, B and log L, all in the old sources.
pub struct Changed {
    pub world: World,
    pub dice: Dice,
    pub chi: Vec<Q>,
    /// The old sources in the new ones.
    new: Q,
    pub x: Vec<Q>,
    pub b: Vec<Q>,
    pub log: Vec<Q>,
}

impl Changed {
    pub fn of((world, dice): (World, Dice)) -> Self {
        let (psi, zero) = (world.psi(), Matrix::zeros(world.n, world.size()));
        let (mut chi, mut x, mut b) = (Vec::new(), vec![zero.clone()], vec![zero]);
        for (t, at) in world.steps.iter().enumerate() {
            let seen = &at.h * &psi[t] * world.z();
            let shift = (at.v_inverse() * &seen).scaled(&ratio(-1, 1));
            chi.push(Matrix::zeros(world.n, world.size()).above(&shift));
            let (w, v) = (world.plant_noise(t) + at.regression() * &seen, world.sensor_noise(t) + &seen);
            x.push(&at.a * &x[t] + w);
            b.push(&b[t] + (&at.h * &psi[t]).transpose() * at.v_inverse() * v);
        }
        let (new, log) = (world.substitution(&chi), log_ratios(&world, &chi));
        Self { world, dice, chi, new, x, b, log }
    }

    pub fn all(noises: &'static [Noises]) -> impl Iterator<Item = Self> {
        World::all(noises).map(Self::of)
    }

    /// M(t) by its sum.
    pub fn m(&self, t: usize) -> Q {
        let psi = self.world.psi();
        let terms = self.world.steps[..t].iter().enumerate().map(|(s, at)| form(&(&at.h * &psi[s]), &at.v_inverse()));
        terms.fold(Matrix::zeros(self.world.n, self.world.n), |sum, term| sum + term)
    }

    /// An affine vector in the new sources.
    pub fn anew(&self, rows: &Q) -> Q {
        rows * &self.new
    }

    pub fn exponent_anew(&self, exponent: &Q) -> Q {
        self.new.transpose().congruence(exponent)
    }

    /// Y(0), …, Y(t), one below the other, in the new sources.
    pub fn past(&self, t: usize) -> Q {
        self.anew(&stacked(&self.world.readings()[..=t]))
    }

    /// (X − X̄, B − B̄) at t + 1 in the new sources, for these means.
    pub fn errors(&self, t: usize, mean: &Q, b_mean: &Q, readings: &Q) -> Q {
        self.anew(&(&self.x[t + 1] - mean * readings).above(&(&self.b[t + 1] - b_mean * readings)))
    }

    /// (z, η, y) for the readings up to t: where they are among the variables of a conditional exponent.
    fn selectors(&self, t: usize) -> [Q; 3] {
        let (n, first, k) = (self.world.n, self.world.sources().start, self.world.k * (t + 1));
        [(1, n), (1 + n, n), (first, k)]
            .map(|(start, rows)| Matrix::from_fn(rows, first + k, |i, j| ratio(i64::from(start + i == j), 1)))
    }

    /// X̄ and B̄ at t + 1 as functions of the readings up to t.
    pub fn means(&self, linear: &OfReadings, t: usize) -> (Q, Q) {
        let columns = 0..self.world.k * (t + 1);
        let later = self.world.k * (t + 1)..linear.mean.columns();
        let of = |map: &Q| {
            assert!(map.block(0..self.world.n, later.clone()).is_zero(), "the future is not known");
            map.block(0..self.world.n, columns.clone())
        };
        (of(&linear.mean), of(&linear.linear))
    }

    /// log 𝒯φ[x, b; Σ] for φ(x) = exp(ηᵀx).
    fn log_functional(x: &Q, b: &Q, eta: &Q, linear: &OfReadings) -> Q {
        product(eta, x) + half(&form(&eta.above(b), &linear.now.joint_covariance()))
    }
}

/// SM-2.25, SM-2.26, SM-2.27, SM-3.18, SM-3.19, SM-3.20, SM-4.5, SM-4.11: L⁻¹ = exp(ξᵀB − ½ ξᵀMξ), with the M of the code.
///
/// SM-2.21, SM-2.22, SM-3.14, SM-3.17: the exponents of L and of its inverse in V°, and for Σʷᵛ = 0, Σᵛ = I in the shorter form.
#[test]
fn the_likelihood_ratio_by_b_and_m() {
    for noises in [&[Noises::Correlated][..], &[Noises::Standard]] {
        for changed in
            World::all(if noises[0] == Noises::Standard { &[Noises::Standard] } else { &[Noises::Correlated] })
                .map(Changed::of)
        {
            let world = &changed.world;
            let all = world.linear_statistics();
            let (psi, phi) = (world.psi(), world.transitions(0, false));
            let zero = Matrix::zeros(world.size(), world.size());
            let (mut linear, mut quadratic, mut short, mut short_b) =
                (zero.clone(), zero.clone(), zero, Matrix::zeros(world.n, world.size()));
            let mut short_m = Matrix::zeros(world.n, world.n);
            for (t, at) in world.steps.iter().enumerate() {
                let seen = &at.h * &psi[t] * world.z();
                linear = linear + product(&seen, &(at.v_inverse() * world.sensor_noise(t)));
                quadratic = quadratic + form(&seen, &at.v_inverse());
                assert_eq!(changed.log[t + 1], negated(&linear) - half(&quadratic));
                let inverse = product(&world.z(), &changed.b[t + 1]) - half(&form(&world.z(), &changed.m(t + 1)));
                assert_eq!(inverse, negated(&changed.log[t + 1]));
                assert_eq!(inverse, &linear + half(&quadratic));
                assert_eq!(all[t].now.information, changed.m(t + 1));
                let step = form(&(&at.h * &psi[t]), &at.v_inverse());
                assert_eq!(changed.m(t + 1), changed.m(t) + step);
                if noises[0] == Noises::Standard {
                    // (2.21), (2.22), (2.25), (2.26), without any covariance
                    let seen = &at.h * &phi[t];
                    let z = &seen * world.z();
                    short = short - product(&z, &world.sensor_noise(t)) - half(&product(&z, &z));
                    assert_eq!(short, changed.log[t + 1]);
                    short_b = short_b + seen.transpose() * (world.sensor_noise(t) + z);
                    short_m = short_m + seen.transpose() * &seen;
                    assert_eq!((&short_b, &short_m), (&changed.b[t + 1], &changed.m(t + 1)));
                }
            }
        }
    }
}

/// Erratum SM-3.14: E[dℙ̄/dℙ | ξ = z] is 1 with −½, and exp(zᵀM(T+1)z) with +½ as printed; for any s log E[(dℙ̄/dℙ)ˢ | z] is
/// ½(s² − s) zᵀMz.
///
/// Erratum SM-3.17: with V° the inverse has +½; with −½ as printed it is no inverse: H = 1, Σᵛ = 2, ξ = 1, V°(1) = 0: exp(1/4)
/// against exp(−1/4). With V in place of V° the printed sign is right.
///
/// SM-horizon: E√L(T) = exp(−zᵀM(T)z/8). SM-P1: with the sign as printed ℙ̄ is no probability measure.
#[test]
fn signs_of_the_quadratic_term() {
    for changed in Changed::all(BOTH) {
        let world = &changed.world;
        let end = world.steps.len();
        let in_z = form(&world.z(), &changed.m(end));
        let mean = |log: &Q| integrated(log, world.sources());
        for s in [ratio(1, 1), ratio(1, 2), ratio(-3, 2), ratio(0, 1)] {
            let curvature = (&s * &s - &s) * ratio(1, 2);
            assert_eq!(mean(&changed.log[end].scaled(&s)), Some((in_z.scaled(&curvature), ratio(1, 1))));
        }
        let printed = &changed.log[end] + &in_z;
        assert_eq!(mean(&printed), Some((in_z.clone(), ratio(1, 1))));
        // Printed inverse: the linear part with −½.
        let linear = half(&in_z) + &changed.log[end];
        let printed_inverse = negated(&linear) - half(&in_z);
        assert_eq!(negated(&linear) + half(&in_z), negated(&changed.log[end]));
        assert_eq!(printed_inverse == negated(&changed.log[end]), in_z.is_zero());
    }
    // −z V°/Σᵛ − ½ z²/Σᵛ at V° = 0, Σᵛ = 2.
    let parts = Decomposition::new(&scalar([1, 1, 1, 0, 2], &[0]), Choice::of_the_paper(1, 1)).expect("noisy");
    let (z, quiet) = (Matrix::identity(1), [Matrix::zeros(2, 1)]);
    let (log, printed) = (parts.log_density(&z), inverse_log_density(&parts, &z));
    assert_eq!(
        (log.at(&quiet), log.inverse().at(&quiet), printed.at(&quiet)),
        (ratio(-1, 4), ratio(1, 4), ratio(-1, 4))
    );
}

/// SM-3.17, SM-3.18: the inverse of the crate is that of its density, it is exp(ξᵀB − ½ ξᵀMξ), and the printed one is this too once V
/// stands for V°.
#[test]
fn the_inverse_density_in_either_noise() {
    for mut changed in Changed::all(BOTH) {
        let point = changed.world.point(&mut changed.dice);
        let world = &changed.world;
        let end = world.steps.len();
        let data = vec![Matrix::zeros(world.k, 1); end];
        let parts = Decomposition::new(&world.path(&data), Choice::of_the_paper(world.n, end)).expect("noisy");
        let z = world.z() * &point;
        let old: Vec<Q> = (0..end).map(|s| world.noise(s) * &point).collect();
        let inverse = parts.log_density(&z).inverse();
        let by_b = product(&world.z(), &changed.b[end]) - half(&form(&world.z(), &changed.m(end)));
        assert_eq!(inverse.at(&old), value(&by_b, &point));
        assert_eq!(inverse_log_density(&parts, &z).at(&parts.new_noise(&z, &old)), inverse.at(&old));
    }
}

/// SM-P1, SM-B2, SM-joint: the density of the sources times L is that of the new sources, whatever ξ is. In these the noises are
/// white with the same covariances, and X, B and the readings are linear in them and do not contain ξ.
#[test]
fn under_the_new_measure_the_readings_forget_the_start() {
    for changed in Changed::all(BOTH) {
        let world = &changed.world;
        let square = |rows: &Q| half(&product(rows, rows));
        let zero = Matrix::zeros(world.size(), world.size());
        let (mut old, mut new) = (zero.clone(), zero);
        for (s, at) in world.steps.iter().enumerate() {
            old = old + square(&world.g(s));
            new = new + square(&(world.g(s) - at.both().transpose() * &changed.chi[s]));
            let shifted = world.noise(s) - at.gamma() * &changed.chi[s];
            assert_eq!(changed.anew(&shifted), world.noise(s));
        }
        assert_eq!(&changed.log[world.steps.len()] - old, negated(&new));
        let until = 0..world.sources().start;
        for rows in changed.x.iter().chain(&changed.b).chain(&world.readings()) {
            assert!(changed.anew(rows).block(0..rows.rows(), until.clone()).is_zero());
        }
    }
}

/// SM-2.29, SM-2.30, SM-2.31, SM-2.32, SM-errors, SM-2.5: the errors X − X̄ and B − B̄, with the means of the code, are uncorrelated with
/// the readings, free of ξ and have the covariance Σ of the code. Under ℙ they have the mean (Q z, R z) instead.
#[test]
fn errors_are_independent_of_the_past() {
    for changed in Changed::all(BOTH) {
        let world = &changed.world;
        for (t, linear) in world.linear_statistics().iter().enumerate() {
            let (mean, b_mean) = changed.means(linear, t);
            let readings = stacked(&world.readings()[..=t]);
            let error = (&changed.x[t + 1] - mean * &readings).above(&(&changed.b[t + 1] - b_mean * &readings));
            let new = changed.anew(&error);
            assert!((&new * changed.past(t).transpose()).is_zero());
            assert_eq!(&new * new.transpose(), linear.now.joint_covariance());
            let of_z = |rows: &Q| rows.block(0..rows.rows(), 1..1 + world.n);
            assert!(of_z(&new).is_zero());
            assert_eq!(of_z(&error), linear.now.cross.above(&linear.now.error));
        }
    }
}

/// SM-2.23, SM-2.24, SM-3.16, SM-2.28, SM-2.33, SM-3.21, SM-1.4: for φ(x) = exp(ηᵀx), given ξ = z and the readings, as functions of (z, η, y):
/// the conditional expectation under the new measure does not depend on the horizon and is the 𝒯 of the code's statistics;
/// times the density of the readings under ℙ̄ it is the expectation under ℙ times their density there.
#[test]
fn numerators() {
    for changed in Changed::all(BOTH) {
        let world = &changed.world;
        let end = world.steps.len();
        for (t, linear) in world.linear_statistics().iter().enumerate() {
            let past = changed.past(t);
            let state = product(&world.eta(), &world.states()[t + 1]);
            let numerator =
                |horizon: usize| world.conditional(&changed.exponent_anew(&(&state - &changed.log[horizon])), &past);
            let found = numerator(t + 1);
            assert_eq!(numerator(end), found);
            // (2.28): the same with X and B, ξ being a parameter
            let [z, eta, y] = changed.selectors(t);
            let own = &changed.x[t + 1] + &world.psi()[t + 1] * world.z();
            let by_parts = product(&world.eta(), &own) + product(&world.z(), &changed.b[t + 1]);
            let by_parts = world.conditional(&changed.exponent_anew(&by_parts), &past);
            assert_eq!(by_parts - half(&form(&z, &changed.m(t + 1))), found);
            // (2.33), (3.21)
            let (mean, b_mean) = changed.means(linear, t);
            let (x, b) = (mean * &y + &world.psi()[t + 1] * &z, b_mean * &y);
            let right = product(&z, &b) - half(&form(&z, &linear.now.information))
                + Changed::log_functional(&x, &z, &eta, linear);
            assert_eq!(found, right);
            // (2.23): −½ (y − Dz)ᵀJ⁻¹(y − Dz) + log E[φ | y, z] = −½ yᵀJ⁻¹y + log Ē[φ L⁻¹ | y, z]
            let readings = stacked(&world.readings()[..=t]);
            let of_z = readings.block(0..readings.rows(), 1..1 + world.n);
            let around = &y - of_z * &z;
            let slope = readings.block(0..readings.rows(), world.sources());
            let precision = (&slope * slope.transpose()).inverse().expect("regular");
            let centred = world.states()[t + 1].clone();
            let of_noise = |rows: &Q| {
                Matrix::from_fn(rows.rows(), rows.columns(), |i, j| {
                    if world.sources().contains(&j) { rows[(i, j)].clone() } else { ratio(0, 1) }
                })
            };
            let noise_part = of_noise(&centred);
            let gain = &noise_part * of_noise(&readings).transpose() * &precision;
            let rest = &noise_part - &gain * of_noise(&readings);
            let old = product(&eta, &(&world.transitions(0, false)[t + 1] * &z + gain * &around))
                + half(&form(&eta, &(&rest * rest.transpose())));
            assert_eq!(old - half(&form(&around, &precision)), found - half(&form(&y, &precision)));
        }
    }
}

/// SM-2.34, SM-3.22, SM-1.5, SM-2.9: with ξ integrated over a law of three atoms: each term of 𝒰φ, φ(x) = exp(ηᵀx), is what the code makes of
/// it, up to the factor exp(−½ …) that it leaves out: weight, evidence, and the transform of the law of the state.
#[test]
fn numerators_over_atoms() {
    for mut changed in Changed::all(BOTH) {
        let n = changed.world.n;
        let data: Vec<Q> = changed.world.steps.iter().map(|_| changed.dice.matrix(changed.world.k, 1)).collect();
        let atoms = [(1, 2), (1, 3), (1, 6)].map(|(p, q)| (ratio(p, q), changed.dice.matrix(n, 1)));
        let eta_value = changed.dice.matrix(n, 1);
        let law = InitialLaw::atoms(atoms.clone()).expect("a law");
        let all = changed.world.statistics(&data);
        for (t, now) in all.iter().enumerate().skip(1).map(|(t, now)| (t - 1, now)) {
            let posterior = now.posterior(&law);
            let exponent = product(&changed.world.eta(), &changed.world.states()[t + 1]) - &changed.log[t + 1];
            let truth = changed.world.conditional(&changed.exponent_anew(&exponent), &changed.past(t));
            for ((weight, z), part) in atoms.iter().zip(&posterior.components) {
                let rest = Matrix::zeros(changed.world.sources().start - 1 - 2 * n, 1);
                let u = Matrix::identity(1).above(z).above(&eta_value).above(&rest).above(&stacked(&data[..=t]));
                let (mean, covariance) = (part.state.mean(), part.state.covariance());
                let transform = (eta_value.transpose() * mean)[(0, 0)].clone()
                    + eta_value.transpose().congruence(covariance)[(0, 0)].clone() * ratio(1, 2);
                assert_eq!(form(&u, &truth)[(0, 0)], &part.evidence.exponent + transform);
                assert_eq!((&part.evidence.weight, &part.evidence.determinant), (weight, &ratio(1, 1)));
            }
        }
    }
}

/// Erratum SM-2.24, and likewise SM-3.16, SM-4.17: φ = 1, t = T = 0, H = Σᵛ = 1: given ξ = z and Y(0) = y the right side is exp(zy − z²/2), and so is
/// the left one with dℙ/dℙ̄; with dℙ̄/dℙ as printed it is exp(−zy + z²/2).
#[test]
fn the_density_of_the_old_measure() {
    let world = || World {
        n: 1,
        k: 1,
        q: 2,
        steps: vec![super::world::At {
            a: Matrix::identity(1),
            h: Matrix::identity(1),
            plant: Matrix::from_integers(&[[1, 0]]),
            sensors: Matrix::from_integers(&[[0, 1]]),
        }],
    };
    let changed = Changed::of((world(), Dice(1)));
    let given = |exponent: &Q| changed.world.conditional(&changed.exponent_anew(exponent), &changed.past(0));
    let [z, _, y] = changed.selectors(0);
    let expected = product(&z, &y) - half(&product(&z, &z));
    assert_eq!(given(&negated(&changed.log[1])), expected);
    assert_eq!(given(&changed.log[1]), negated(&expected));
    assert_ne!(given(&changed.log[1]), expected);
}

/// Erratum SM-3.21: φ = 1, t = 0, A = H = Σᵛ = 1, Σʷᵛ = 0, ξ = Y(0) = 1: exp(1/2); the third and fourth member, without exp(ξᵀB̄),
/// exp(−1/2), where R(1) = 0.
#[test]
fn the_mean_of_b_stays_in_the_numerator() {
    let after = &exact_kalman::nongaussian::statistics(&scalar([1, 1, 1, 0, 1], &[1])).expect("noisy")[1];
    let [m, r, b] = [&after.information, &after.error, &after.linear].map(|matrix| matrix[(0, 0)].clone());
    let z = ratio(1, 1);
    // By hand: Ē[exp(zB − ½Mz²) | Y(0)] with B = V = Y(0) = 1, M = 1.
    let direct = ratio(1, 1) - ratio(1, 2);
    let without = -(&m * &z * &z) * ratio(1, 2) + &r * &z * &z * ratio(1, 2);
    assert_eq!(&without + &z * &b, direct);
    // The third member sets the argument of 𝒯 to B̄ where ξ belongs: ½ B̄ᵀRB̄, which is 0 here too.
    let third = -(&m * &z * &z) * ratio(1, 2) + &r * &b * &b * ratio(1, 2);
    assert_eq!((&without, &third), (&ratio(-1, 2), &ratio(-1, 2)));
    assert_ne!(without, direct);
}

/// Erratum SM-1.5: ξ is integrated too. For Σ = 0, Λ = 0, b = 1, φ = 1 and ξ = 0 or 1 with a fair coin the expectation over the Gaussian pair
/// alone, as printed, leaves exp(ξ), which is 1 or e and no number; over ξ too it is (1 + e)/2. And the value may be +∞ on the stated
/// domain: Λ = 1, R = 2, ξ ~ N(0, 1), b = 0, φ = 1 is E exp(½ξ²).
#[test]
fn the_functional_integrates_the_start() {
    // The statistics with Σ = 0, Λ = 0, b = 1, as values of the type of the crate.
    let of = |information: i64, error: i64, linear: i64| Statistics {
        information: Matrix::from_integers(&[[information]]),
        error: Matrix::from_integers(&[[error]]),
        linear: Matrix::from_integers(&[[linear]]),
        ..exact_kalman::nongaussian::statistics(&scalar([1, 1, 1, 0, 1], &[0])).expect("noisy")[0].clone()
    };
    let coin = InitialLaw::atoms([0, 1].map(|xi| (ratio(1, 2), Matrix::from_integers(&[[xi]])))).expect("a law");
    let terms = of(0, 0, 1).posterior(&coin).components;
    // Over the pair alone, for one ξ: bξ + ½(R − Λ)ξ², two values; over ξ too: their mean.
    let over_the_pair = |xi: i64| {
        let b = integrated(&product(&Matrix::from_integers(&[[xi, 0]]), &Matrix::from_integers(&[[1, 0]])), 1..2);
        b.expect("finite").0[(0, 0)].clone()
    };
    let printed = [0, 1].map(over_the_pair);
    assert_ne!(printed[0], printed[1]);
    assert_eq!(terms.iter().map(|part| part.evidence.exponent.clone()).collect::<Vec<_>>(), printed);
    let end = |end: &Dyadic| end.value().expect("short");
    let sum = terms.iter().map(|part| Interval::exponential(&part.evidence.exponent, 30).expect("small"));
    let (lower, upper) = sum.fold((ratio(0, 1), ratio(0, 1)), |(lower, upper), value| {
        (lower + end(value.lower()) * ratio(1, 2), upper + end(value.upper()) * ratio(1, 2))
    });
    assert!(ratio(185, 100) < lower && upper < ratio(186, 100));
    // ½(R − Λ)ξ² with ξ = g ~ N(0, 1): infinite for R = 2, Λ = 1.
    let exponent =
        |now: &Statistics<Rational>| Matrix::diagonal(&[ratio(0, 1), -half(&now.precision())[(0, 0)].clone()]);
    assert_eq!(integrated(&exponent(&of(1, 2, 0)), 1..2), None);
    assert_eq!(integrated(&exponent(&of(1, 1, 0)), 1..2), Some((Matrix::zeros(2, 2), ratio(1, 1))));
    // The condition holds where SM-T1 uses it.
    for (world, mut dice) in World::all(BOTH) {
        let data: Vec<Q> = world.steps.iter().map(|_| dice.matrix(world.k, 1)).collect();
        for now in world.statistics(&data) {
            let precision = now.precision();
            assert!(precision.ldl().is_ok());
            assert_eq!(precision.beside(&now.linear).rank(), precision.rank());
        }
    }
}
