//! How long the integers of a step can be, before they are known.
//!
//! With `Q = w u S` for the innovation covariance S, the next divisor is `d′ = d det Q_B`, B the rows with pivots, and
//! the next integers are `N′ = w u d′ P₊` and `X′ = z uₓ d′ x₊`. A positive semidefinite matrix has
//! `det Q_B ≤ ∏ Q_ii` (Hadamard), conditioning shrinks covariances, so `|P₊_ij| ≤ max P_ii`, and
//!
//! > `x₊ = x + W S_B⁻¹ ν`, `|W_i| ≤ √(P S_ii)`, `|det(S_B) (S_B⁻¹)_ij| ≤ √(∏_{l≠i} S_ll ∏_{l≠j} S_ll)`
//!
//! All bounds are exponents of two, rounded upwards.

use num_bigint::BigInt;
use num_traits::Zero;

use super::super::law::Law;
use super::super::laws::StepLaws;
use super::super::state::State;

/// The b of a bound 2^b; nothing for zero.
type Exponent = Option<i64>;

/// The length of an integer as a bound.
fn exponent(value: &BigInt) -> Exponent {
    (!value.is_zero()).then(|| bits(value))
}

fn bits(value: &BigInt) -> i64 {
    // Lengths in bits are far below 2⁶².
    i64::try_from(value.bits()).unwrap_or(i64::MAX / 4)
}

/// A bound of a quotient; the divisor is at least `2^(bits − 1)`.
fn quotient(numerator: &BigInt, denominator: &BigInt) -> Exponent {
    exponent(numerator).map(|exponent| exponent - bits(denominator) + 1)
}

/// A bound of the sum of so many numbers with these bounds.
fn sum(bounds: impl Iterator<Item = Exponent>) -> Exponent {
    let (mut count, mut largest) = (0u64, None);
    for bound in bounds.flatten() {
        count += 1;
        largest = largest.max(Some(bound));
    }
    largest.map(|largest| largest + count_bits(count))
}

/// The least b with `count ≤ 2^b`.
fn count_bits(count: u64) -> i64 {
    i64::from(count.next_power_of_two().trailing_zeros())
}

fn product(left: Exponent, right: Exponent) -> Exponent {
    Some(left? + right?)
}

/// Bounds of the variances and of the mean of a state.
struct Magnitudes {
    variances: Vec<Exponent>,
    mean: Vec<Exponent>,
}

impl Magnitudes {
    fn of(state: &State) -> Self {
        let (denominator, mean_denominator) = (&state.scale * &state.divisor, &state.mean_scale * &state.divisor);
        let states = 0..state.numerators.rows();
        Self {
            variances: states.map(|i| quotient(&state.numerators[(i, i)], &denominator)).collect(),
            mean: state.mean_numerators.entries().iter().map(|entry| quotient(entry, &mean_denominator)).collect(),
        }
    }

    /// The image under an affine map with noise. Where the noise is correlated with the state, twice that covariance is
    /// in the noise's, of either sign: its magnitude is added.
    ///
    /// `m P mᵀ ≤ (∑ |m_a| √P_aa)² ≤ 2^(2c) max m_a² P_aa` for at most 2^c summands.
    fn image(&self, law: &Law) -> Self {
        let Law { map, noise, constant, .. } = law;
        let entry = |i: usize, a: usize| quotient(&map.numerators[(i, a)], &map.denominator);
        let rows = 0..map.numerators.rows();
        let variance = |i: usize| {
            let terms =
                self.variances.iter().enumerate().filter_map(|(a, variance)| Some(2 * entry(i, a)? + (*variance)?));
            let (count, largest) = terms.fold((0, None), |(count, largest), term| (count + 1, largest.max(Some(term))));
            let of_state = largest.map(|largest| largest + 2 * count_bits(count));
            sum([of_state, quotient(&noise.numerators[(i, i)], &noise.denominator)].into_iter())
        };
        let mean = |i: usize| {
            let of_state = sum(self.mean.iter().enumerate().map(|(a, mean)| product(entry(i, a), *mean)));
            sum([of_state, quotient(&constant.numerators[(i, 0)], &constant.denominator)].into_iter())
        };
        Self { variances: rows.clone().map(variance).collect(), mean: rows.map(mean).collect() }
    }
}

/// A b such that all integers of a step, those that turn out to be zero included, are below 2^b in magnitude.
pub(super) fn length(state: &State, laws: StepLaws<'_>, [scale, mean_scale]: &[BigInt; 2]) -> u64 {
    let law = laws.observation;
    let before = Magnitudes::of(state);
    let predicted = laws.transition.map(|transition| before.image(transition));
    let joint = predicted.unwrap_or(before).image(law);
    let (scale, mean_scale, divisor) = (bits(scale), bits(mean_scale), bits(&state.divisor));
    // A row without a pivot is no factor of the determinant: each factor counts as one at least.
    let factors: Vec<i64> =
        joint.variances[..law.observed].iter().map(|variance| variance.map_or(0, |s| (s + scale).max(0))).collect();
    let determinant: i64 = factors.iter().sum();
    let target = joint.variances[law.observed..].iter().copied().max().flatten();
    let divisor_after = divisor + determinant;
    let covariance = target.map(|variance| divisor_after + scale + variance);
    // A row of the column, at any stage of the elimination; an observed entry's innovation may have to vanish there.
    let column = |row: usize| {
        let shift = (joint.mean.iter().zip(&factors)).filter_map(|(innovation, factor)| {
            let half = (joint.variances[row]? + scale + 2 * determinant - factor + 1).div_euclid(2);
            Some(divisor + mean_scale + half + (*innovation)?)
        });
        let shift = shift.max().map(|shift| shift + 2 * count_bits(law.observed as u64));
        sum([joint.mean[row].map(|mean| divisor_after + mean_scale + mean), shift].into_iter())
    };
    let columns = (0..joint.mean.len()).filter_map(column);
    let longest = columns.chain(covariance).max().unwrap_or(0).max(divisor_after);
    // The divisor is positive, so its length is, too.
    longest.unsigned_abs()
}

#[cfg(test)]
mod tests {
    use super::super::super::fraction_free;
    use super::super::super::laws::Laws;
    use super::super::scales;
    use super::*;
    use crate::filter::Wanted;
    use crate::matrix::Matrix;
    use crate::model::{Before, Initial, Noise, Observation, Path, System, Timing};
    use crate::scalar::{Precision, Rational, ratio};
    use crate::trace::Moments;

    /// A linear congruence.
    struct Draw {
        state: u64,
        /// Whether sizes differ much.
        is_wild: bool,
    }

    impl Draw {
        fn below(&mut self, bound: u64) -> u64 {
            self.state = self.state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
            (self.state >> 33) % bound
        }

        fn of<T: Copy>(&mut self, from: &[T]) -> T {
            from[usize::try_from(self.below(from.len() as u64)).expect("a place")]
        }

        fn exponent(&mut self, from: &[i32]) -> i32 {
            let drawn = self.of(from);
            if self.is_wild { drawn } else { 0 }
        }

        fn up_to(&mut self, last: u64) -> usize {
            usize::try_from(self.below(last + 1)).expect("a small number")
        }

        /// Small fractions and zeros times a power of two, some of them times a further one.
        fn matrix(&mut self, rows: usize, columns: usize, exponent: i32) -> Matrix<Rational> {
            let further = self.exponent(&[0, 0, 200, -200]);
            Matrix::from_fn(rows, columns, |_, _| {
                let exponent = exponent + self.exponent(&[0, 0, 1, further]);
                let numerator = self.of(&[0, 0, 1, 1, -1, 2, 7, -12]);
                ratio(numerator, self.of(&[1, 1, 2, 3])) * ratio(2, 1).pow(exponent)
            })
        }

        /// A path of four steps; half of them with a sensor that repeats the first one.
        fn path(&mut self, timing: Timing) -> Path<Rational> {
            let (n, sensors) = (1 + self.up_to(2), 1 + self.up_to(2));
            let repeats = sensors > 1 && self.below(2) == 0;
            let repeated = |matrix: Matrix<Rational>| {
                if repeats {
                    matrix.block(0..sensors - 1, 0..matrix.columns()).above(&matrix.select_rows(&[0]))
                } else {
                    matrix
                }
            };
            let before = self.of(&[Before::Observation, Before::Transition]);
            let before = if timing == Timing::Departing { Before::Observation } else { before };
            let mean = self.exponent(&[0, 300, -300]);
            let scale = self.exponent(&[0, 60, -150]);
            let factor = self.matrix(n, n, scale);
            let reading = self.exponent(&[0, 0, 300, -300]);
            let (process, noise) = (self.exponent(&[0, 200, -200]), self.exponent(&[0, 200, -200]));
            let system = System {
                timing,
                initial: Initial::new(before, self.matrix(n, 1, mean), factor.congruence(&Matrix::identity(n))),
                transition: self.matrix(n, n, 0).into(),
                observation: repeated(self.matrix(sensors, n, 0)).into(),
                noise: Noise::Factors {
                    process: self.matrix(n, 2, process).into(),
                    observation: repeated(self.matrix(sensors, 2, noise)).into(),
                },
                input: None,
                observation_input: None,
            };
            let readings: Vec<_> = (0..4)
                .map(|_| {
                    // One time in eight the sensor that repeats contradicts.
                    let all = self.matrix(sensors, 1, reading);
                    let all = if self.below(8) > 0 { repeated(all) } else { all };
                    Observation::new(all.entries().iter().map(|y| (self.below(8) > 0).then(|| y.clone())).collect())
                })
                .collect();
            system.realised(&readings).expect("shapes that fit")
        }
    }

    /// `M P Mᵀ + Q` and `M x − c`
    fn image(law: &Law, [x, p]: &[Matrix<Rational>; 2]) -> [Matrix<Rational>; 2] {
        let [map, noise, constant] = [&law.map, &law.noise, &law.constant].map(|all| all.entrywise(Precision::Exact));
        [&map * x - constant, map.congruence(p) + noise]
    }

    /// The integers that the primes must tell apart, by elimination on fractions: pivots, innovations beside them, and the
    /// next state. Whether a pivot is zero, and whether data contradict each other.
    fn integers(state: &State, laws: StepLaws<'_>, scales: &[BigInt; 2]) -> (Vec<Rational>, bool, bool) {
        let law = laws.observation;
        let [scale, mean_scale] = scales.each_ref().map(|scale| Rational::from(scale.clone()));
        let before = state.fractions().map(|all| all.entrywise(Precision::Exact));
        let predicted = laws.transition.map_or_else(|| before.clone(), |transition| image(transition, &before));
        let [mut x, mut p] = image(law, &predicted);
        let mut divisor = Rational::from(state.divisor.clone());
        let mut found = Vec::new();
        let mut singular = false;
        for row in 0..law.observed {
            found.extend((row..law.observed).map(|i| &divisor * &mean_scale * &x[(i, 0)]));
            let pivot = p[(row, row)].clone();
            found.push(&divisor * &scale * &pivot);
            if pivot.is_zero() {
                singular = true;
                if !x[(row, 0)].is_zero() {
                    return (found, singular, true);
                }
                continue;
            }
            let column = p.select_columns(&[row]).scaled(&pivot.recip());
            divisor = &divisor * &scale * &pivot;
            x = &x - column.scaled(&x[(row, 0)]);
            p = &p - &column * p.select_rows(&[row]);
        }
        for target in 0..law.targets {
            let rows = law.target(target);
            found.extend(rows.clone().map(|i| &divisor * &mean_scale * &x[(i, 0)]));
            found.extend(
                rows.clone().flat_map(|i| rows.clone().map(move |j| (i, j))).map(|place| &divisor * &scale * &p[place]),
            );
        }
        found.push(divisor);
        (found, singular, false)
    }

    /// Lengths of the very integers, in states and noises of the most different sizes and of similar ones, where the bound is
    /// near.
    #[test]
    fn no_integer_is_longer_than_its_bound() {
        let mut draw = Draw { state: 1, is_wild: true };
        let (mut steps, mut singular, mut contradictions, mut nearest) = (0, 0, 0, u64::MAX);
        for timing in [Timing::Arriving, Timing::Departing].repeat(200) {
            draw.is_wild = draw.below(4) == 0;
            let path = draw.path(timing);
            let Initial { before, mean, covariance, .. } = path.initial().clone();
            let mut state = State::of(&Moments { mean, covariance, diffuse: None });
            let mut is_predicted = before == Before::Observation;
            let mut laws = Laws::default();
            for step in path.steps() {
                let transition = step.transition.as_ref().filter(|_| !is_predicted);
                is_predicted = timing == Timing::Departing;
                let laws = laws.of(step, transition, timing);
                let scales = scales(&state, laws);
                let length = length(&state, laws, &scales);
                let (integers, is_singular, contradicts) = integers(&state, laws, &scales);
                assert!(integers.iter().all(Rational::is_integer));
                let longest = integers.iter().map(|integer| integer.numer().bits()).max().unwrap_or(0);
                assert!(longest <= length, "{longest} bits instead of {length} in {path:?}");
                nearest = nearest.min(length - longest);
                steps += 1;
                singular += u32::from(is_singular);
                contradictions += u32::from(contradicts);
                let next = match (contradicts, fraction_free(&state, laws, timing, Wanted::Filtered)) {
                    (false, Ok((_, next))) => next,
                    (true, Err(_)) => None,
                    _ => panic!("the elimination on integers differs"),
                };
                let Some(next) = next else { break };
                state = next;
            }
        }
        assert!(
            steps > 1000 && singular > 200 && contradictions > 40 && nearest <= 2,
            "{steps}, {singular}, {contradictions}, {nearest}"
        );
    }
}
