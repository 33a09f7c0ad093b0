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
    u64::try_from(longest).unwrap_or(0)
}
