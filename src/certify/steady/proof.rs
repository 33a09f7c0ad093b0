//! The proof that a proposal is near the stabilising solution (EK-T5, EK-T6).
//!
//! At a point S̃ with a gain K̃, with G, J, κ, D̄ as in [`point`](super::point) and `W' = (1 + 2w/κ)GEGᵀ + (2/κ)ρTᵀTρᵀ`:
//!
//! > `E − W' ± (J − S̃) ≥ 0`
//!
//! makes φ map {P : −E ≤ P − S̃ ≤ E} into itself, since φ(P) − J lies between ±W'. It is monotone (EK-L4) and continuous there, so it has
//! fixed points in it. And with `w_X ≥ tr(THXHᵀTᵀ)`, X > 0, β > 0 and r < 1,
//!
//! > `r²X − (1 + β)GXGᵀ − (1 + 1/β)(w_X/κ)D̄ ≥ 0`
//!
//! gives every P in it a closed loop with `G_P X G_Pᵀ ≤ r²X`, so its spectral radius is at most r, and the fixed point is the only
//! stabilising one.

use num_bigint::BigInt;
use num_traits::One;

use super::doubling::Proposal;
use super::equation::{Equation, FACTOR, power_of_two};
use super::fixed::{Rows, identity, most_bits};
use super::known::Known;
use super::point::{Image, Reading, diagonal_bound, is_definite, missing, widened, without_zero_rows};
use super::series::series;
use super::{BOUND_BITS, Dyadics, Unproved, nearest, rounded, scale, symmetric, up};
use crate::matrix::Matrix;
use crate::scalar::{Dyadic, Toward, exact_value};

/// What proves it.
#[derive(Clone, Debug)]
pub(super) struct Proof {
    pub(super) reading: Reading,
    pub(super) image: Image,
    /// E
    pub(super) gap: Dyadics,
    /// w
    pub(super) spread: Dyadic,
    /// 1/κ, or more.
    pub(super) inverse_kappa: Dyadic,
    /// X
    #[cfg_attr(not(feature = "judge"), expect(dead_code, reason = "certificates alone need it"))]
    pub(super) shape: Dyadics,
    /// r²
    pub(super) rate_squared: Dyadic,
    /// k, with β = 2⁻ᵏ; nothing where G alone decides.
    #[cfg_attr(not(feature = "judge"), expect(dead_code, reason = "certificates alone need it"))]
    pub(super) balance: Option<i64>,
}

/// Bits of E and X beyond those that the slowness of the closed loop takes.
const SPARE: i64 = 64;

impl Proof {
    pub(super) fn of(proposal: &Proposal, equation: &Equation, bits: u64) -> Result<Self, Unproved> {
        let (point, scales) = proposal.on_grid(bits);
        let units: Vec<i64> = scales.iter().zip(&proposal.units).map(|(scale, unit)| scale.unwrap_or(*unit)).collect();
        let reading = Reading::at(&point, equation, bits).ok_or(Unproved::Singular { bits })?;
        let image = Image::of(&reading, equation, &equation.ahead, bits);
        let places = bits + BOUND_BITS;
        let closed = in_units(&image.closed, &equation.odd, &units, places);
        let (gap, residual, decay) = gap(&point, &image, equation, (&scales, &units), &closed, places)?;
        let spread = reading.spread(&gap, equation);
        let inverse_kappa = reading.inverse_kappa(&spread).ok_or(Unproved::Singular { bits })?;
        let (kept, missed) = image.parts(&gap, equation, &inverse_kappa);
        if !is_interior(&gap, &widened(&kept, &missed, &spread, &inverse_kappa), &residual, bits) {
            return Err(Unproved::Bracket { bits });
        }
        let missing = missing(&kept, &missed, &spread, &inverse_kappa);
        let contraction = Contraction {
            reading: &reading,
            image: &image,
            equation,
            missing: &missing,
            inverse_kappa: &inverse_kappa,
        };
        let (shape, rate_squared, balance) = CLOSENESS
            .iter()
            .find_map(|closeness| contraction.proved(&closed, &units, decay, *closeness, places))
            .ok_or(Unproved::Contraction { bits })?;
        Ok(Self { reading, image, gap, spread, inverse_kappa, shape, rate_squared, balance })
    }

    /// How well the solution is known, with the units of states whose variances may be zero.
    pub(super) fn known(&self, other: impl Fn(usize) -> Dyadic) -> Known {
        let variances = self.reading.point.diagonal().into_iter().zip(self.gap.diagonal());
        let least = |(variance, off): (Dyadic, Dyadic)| {
            // Indefinite weights may have a solution with negative entries there.
            let size = if variance.is_negative() { variance.negated() } else { variance };
            (size.plus(&off.negated(), BOUND_BITS, Toward::Below), off)
        };
        Known::of(variances.map(least), other)
    }

    /// D̄
    pub(super) fn missing(&self, image: &Image, equation: &Equation) -> Dyadics {
        let (kept, missed) = image.parts(&self.gap, equation, &self.inverse_kappa);
        missing(&kept, &missed, &self.spread, &self.inverse_kappa)
    }
}

/// Whether `E ≥ 0`, without which W' bounds nothing, and `E − W' − diag(d) > 0` for a bound d of J − S̃ from both sides.
pub(super) fn is_interior(gap: &Dyadics, widened: &Dyadics, residual: &[Dyadic], bits: u64) -> bool {
    is_definite(&without_zero_rows(&gap.minus(&up(widened, residual, 2 * bits))), 0)
        && is_definite(&without_zero_rows(gap), bits + BOUND_BITS)
}

/// How near to the spectral radius r is tried, as parts of 1 − ρ².
const CLOSENESS: [f64; 3] = [1.0 / 1024.0, 1.0 / 16.0, 0.5];

/// The closed loop in units, in fixed point.
fn in_units(closed: &Dyadics, odd: &BigInt, units: &[i64], places: u64) -> Rows {
    let shift = i64::try_from(places).unwrap_or(i64::MAX);
    let entry =
        |i: usize, j: usize| nearest(&closed.mantissas[(i, j)], closed.exponent + shift + units[j] - units[i], odd).0;
    (0..units.len()).map(|i| (0..units.len()).map(|j| entry(i, j)).collect()).collect()
}

/// What bounds J − S̃ from both sides, as a diagonal.
pub(super) fn residual(point: &Dyadics, image: &Image, equation: &Equation, units: &[i64]) -> Vec<Dyadic> {
    diagonal_bound(&image.joseph.minus(&point.scaled(&equation.noise_odd)), &equation.noise_odd, units)
}

/// E ≈ GEGᵀ + Ω with Ω about twice what the residual and the gain's defect take; the bound of the residual; the decay of G.
fn gap(
    point: &Dyadics,
    image: &Image,
    equation: &Equation,
    (scales, units): (&[Option<i64>], &[i64]),
    closed: &Rows,
    places: u64,
) -> Result<(Dyadics, Vec<Dyadic>, f64), Unproved> {
    let bits = places - BOUND_BITS;
    let n = units.len();
    let residual = residual(point, image, equation, units);
    let missed = diagonal_bound(&image.missed, &equation.noise_odd.pow(2), units);
    let parts = residual.iter().zip(&missed).zip(units).map(|((residual, missed), unit)| {
        let all = FACTOR.sum(residual, &FACTOR.product(missed, &power_of_two(4)));
        (all.magnitude().map(|size| size - 2 * unit), !all.is_zero())
    });
    let (sizes, moves): (Vec<_>, Vec<_>) = parts.unzip();
    let counts = |i: usize| scales[i].is_some() || moves[i];
    let mut first = identity(n, places);
    for (i, row) in first.iter_mut().enumerate() {
        if !counts(i) {
            row[i] = BigInt::default();
        }
    }
    let (total, decay) = series(closed, &first, places).ok_or(Unproved::Contraction { bits })?;
    let Some(size) = sizes.into_iter().flatten().max() else {
        let nothing = Dyadics { mantissas: Matrix::zeros(n, n), exponent: 0 };
        return Ok((nothing, residual, decay));
    };
    Ok((of_units(&total, units, (places, swing(closed, places)), size + 1), residual, decay))
}

/// A symmetric matrix in units times a power of two, to as many bits as its size asks for.
fn of_units(total: &Rows, units: &[i64], (places, swing): (u64, i64), exponent: i64) -> Dyadics {
    let places = i64::try_from(places).unwrap_or(i64::MAX);
    let least = units.iter().copied().min().unwrap_or(0);
    let mantissas = symmetric(units.len(), |i, j| &total[i][j] << (units[i] + units[j] - 2 * least));
    let exact = Dyadics { mantissas, exponent: 2 * least - places + exponent };
    let scales: Vec<Option<i64>> = exact.diagonal().iter().map(scale).collect();
    let growth = amplification(total, places);
    let bits = u64::try_from(SPARE + growth + swing + size_of(units.len())).unwrap_or(0);
    rounded(&exact, &BigInt::one(), &scales, bits).0
}

/// How many bits a closed loop may make of a rounding before it forgets it.
fn swing(closed: &Rows, places: u64) -> i64 {
    2 * i64::try_from(most_bits(closed).saturating_sub(places)).unwrap_or(0)
}

/// The binary logarithm of the largest entry of a matrix in fixed point, if it is above one.
fn amplification(total: &Rows, places: i64) -> i64 {
    let most = (0..total.len()).map(|i| i64::try_from(total[i][i].bits()).unwrap_or(i64::MAX)).max().unwrap_or(0);
    (most - places).max(0)
}

fn size_of(n: usize) -> i64 {
    i64::from(2 * n.next_power_of_two().trailing_zeros())
}

struct Contraction<'a> {
    reading: &'a Reading,
    image: &'a Image,
    equation: &'a Equation,
    /// D̄
    missing: &'a Dyadics,
    inverse_kappa: &'a Dyadic,
}

impl Contraction<'_> {
    /// X, r² and β = 2⁻ᵏ, where they prove that closed loops contract.
    fn proved(
        &self,
        closed: &Rows,
        units: &[i64],
        decay: f64,
        closeness: f64,
        places: u64,
    ) -> Option<(Dyadics, Dyadic, Option<i64>)> {
        // 1 − r²
        let margin = -(-2.0 * std::f64::consts::LN_2 * decay).exp_m1() * (1.0 - closeness);
        let margin = Dyadic::rounded(&exact_value(margin)?, 24, Toward::Below);
        if margin.is_negative() || margin.is_zero() {
            return None;
        }
        let rate_squared = Dyadic::one().plus(&margin.negated(), 2 * places, Toward::Above);
        if rate_squared >= Dyadic::one() {
            return None;
        }
        let shift = i64::try_from(places).unwrap_or(i64::MAX);
        let (mantissa, exponent) = rate_squared.parts();
        let square = nearest(mantissa, exponent + 2 * shift, &BigInt::one()).0;
        let inverse = (BigInt::one() << (2 * places)) / square.sqrt();
        let faster: Rows =
            closed.iter().map(|row| row.iter().map(|entry| (entry * &inverse) >> places).collect()).collect();
        let (total, _) = series(&faster, &identity(units.len(), places), places)?;
        let shape = of_units(&total, units, (places, swing(closed, places)), 0);
        let carried = self.image.closed.congruence(&shape);
        let carried = carried.multiple(&FACTOR.over(&Dyadic::one(), &self.equation.odd, 2));
        let through = FACTOR.product(&self.reading.spread(&shape, self.equation), self.inverse_kappa);
        let size = 1 - rate_squared.magnitude().unwrap_or(0);
        let k = 3 + amplification(&total, shift) + size + size_of(units.len());
        let balance = (!self.missing.is_zero()).then_some(k);
        let all = match balance {
            None => carried,
            Some(k) => {
                let of_missing = FACTOR.product(&FACTOR.sum(&Dyadic::one(), &power_of_two(k)), &through);
                carried
                    .multiple(&FACTOR.sum(&Dyadic::one(), &power_of_two(-k)))
                    .plus(&self.missing.multiple(&of_missing))
            }
        };
        is_shrunk(&shape, &rate_squared, &all, places).then_some((shape, rate_squared, balance))
    }
}

/// Whether `X > 0`, without which a loop that grows would pass as well, and `r²X` is above what becomes of X.
pub(super) fn is_shrunk(shape: &Dyadics, rate_squared: &Dyadic, carried: &Dyadics, places: u64) -> bool {
    let nothing = vec![Dyadic::zero(); shape.rows()];
    let slack = shape.multiple(rate_squared).minus(&up(carried, &nothing, places));
    is_definite(&slack, 0) && is_definite(shape, places)
}
