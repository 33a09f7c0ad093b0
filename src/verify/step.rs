//! The conditions of one step.
//!
//! For any gain K, with `G = A − K H`, `Σ̃ = H P̃ Hᵀ + R`, `ρ = K Σ̃ − (A P̃ Hᵀ + S)` and `J = G P̃ Gᵀ + Q − S Kᵀ − K Sᵀ + K R Kᵀ`, and any T with
//! `η = ‖T Σ̃ Tᵀ − I‖∞`, `w = tr(T H W Hᵀ Tᵀ)`, κ = 1 − η − w > 0:
//!
//! > `κ (W₊ ± (J − P̃₊)) ≥ (κ + 2w) G W Gᵀ + 2 ρTᵀTρᵀ`
//!
//! proves `−W₊ ≤ φ(P) − P̃₊ ≤ W₊` for every P between P̃ ± W; and with `ν̃ = y − c − H x̃`, `ε = A x̃ + b + K ν̃ − x̃₊` and
//! `t = (1 + a) ‖T ν̃‖² + (1 + 1/a) tr(T H E Hᵀ Tᵀ)`, a = 2⁻¹⁰,
//!
//! > `κ² E₊ ≥ κ² (1 + α) G E Gᵀ + 3 (1 + 1/α) (t w G W Gᵀ + t ρTᵀTρᵀ + κ² εεᵀ)`
//!
//! proves `e₊e₊ᵀ ≤ E₊`. κ is rounded down, w and t up: so both sides stay short.

use super::belief::Belief;
use super::definite::nonnegative;
use super::document::{BeliefDocument, DyadicMatrix};
use super::rejection::{Condition, Rejection, indefinite, wrong};
use super::table::Table;
use super::unified::{Target, Unified};

/// Bits of κ, w and t.
const NUMBER_BITS: u64 = 128;

/// a = 2^−10 of t.
const SLIGHT: i64 = 10;

/// The largest exponent of α.
const MOST_BALANCE: u64 = 1 << 10;

/// The most bits that numbers of a certificate, or of its case, may have or be away from one.
const MOST_BITS: u64 = 1 << 19;

/// The most bits that all numbers of a matrix may have.
const MOST_MATRIX_BITS: u64 = 1 << 27;

/// What is known of an innovation: T, κ, w, t, and what they are made of.
pub(super) struct Innovation {
    whitening: Table,
    pub(super) covariance: Table,
    value: Table,
    kappa: Table,
    spread: Table,
    square: Table,
}

/// That numbers are not too long for so many states and sensors.
pub(super) fn check_size(magnitude: u64, states: usize, sensors: usize) -> Result<(), Rejection> {
    let side = u64::try_from(states + sensors).unwrap_or(u64::MAX);
    let most = (MOST_MATRIX_BITS / side.saturating_mul(side).max(1)).min(MOST_BITS);
    if magnitude <= most {
        return Ok(());
    }
    Err(wrong(Condition::Size, format!("numbers of 2^±{magnitude}; {most} is the most that is checked")))
}

impl Innovation {
    pub(super) fn of(belief: &Belief, law: &Unified, whitening: &DyadicMatrix) -> Result<Self, Rejection> {
        let m = law.observation.rows;
        let t = Table::full(whitening, m, m)
            .ok_or_else(|| wrong(Condition::Shape, format!("`whitening` is not {m}×{m}")))?;
        check_size(t.magnitude(), law.observation.columns, m)?;
        let h = &law.observation;
        let covariance = h.around(&belief.covariance).plus(&law.noise);
        let eta = t.around(&covariance).minus(&Table::identity(m)).row_norm().above(NUMBER_BITS);
        let through = t.times(h);
        let spread = through.around(&belief.gap).trace().above(NUMBER_BITS);
        let kappa = Table::number(1).minus(&eta).minus(&spread).below(NUMBER_BITS);
        if !kappa.is_positive() {
            let size = |number: &Table| number.exponent + i64::try_from(number.at(0, 0).bits()).unwrap_or(i64::MAX);
            let of = |name, number: &Table| {
                if number.is_zero() { format!("{name} = 0") } else { format!("{name} < 2^{}", size(number)) }
            };
            let message = format!("κ = 1 − η − w is not positive: {}, {}", of("η", &eta), of("w", &spread));
            return Err(wrong(Condition::Regular, message));
        }
        let value = law.seen.minus(&h.times(&belief.mean));
        let known = t.times(&value).transposed().square();
        let unknown = through.around(&belief.ellipsoid).trace();
        let one_and = |exponent| Table::number(1).plus(&Table::power(exponent));
        let square = known.scaled(&one_and(-SLIGHT)).plus(&unknown.scaled(&one_and(SLIGHT))).above(NUMBER_BITS);
        Ok(Self { whitening: t, covariance, value, kappa, spread, square })
    }
}

/// The gain of a target.
pub(super) fn gain_of(document: &BeliefDocument, rows: usize, columns: usize) -> Result<Table, Rejection> {
    let gain = document.gain.as_ref().ok_or_else(|| wrong(Condition::Members, "`gain` is missing"))?;
    Table::full(gain, rows, columns).ok_or_else(|| wrong(Condition::Shape, format!("`gain` is not {rows}×{columns}")))
}

/// The belief about a target, proved; with the innovation where something is read.
pub(super) fn proved(
    belief: &Belief,
    law: &Unified,
    target: &Target,
    innovation: Option<&Innovation>,
    document: &BeliefDocument,
) -> Result<Belief, Rejection> {
    let n = target.map.rows;
    let claim = Belief::of(document, n)?;
    check_size(claim.magnitude(), n, law.observation.rows)?;
    match innovation {
        Some(innovation) => read(belief, law, target, innovation, document, &claim)?,
        None if document.gain.is_some() => {
            return Err(wrong(Condition::Members, "a `gain` where nothing is read"));
        }
        None => {
            let covariance = target.map.around(&belief.covariance).plus(&target.noise);
            let gap = target.map.around(&belief.gap);
            check_covariance(&claim.gap.minus(&gap), &covariance.minus(&claim.covariance))?;
            let error = target.map.times(&belief.mean).plus(&target.input).minus(&claim.mean);
            let carried = target.map.around(&belief.ellipsoid);
            check_mean(&claim.ellipsoid, &carried, &error.square(), document.balance)?;
        }
    }
    Ok(claim)
}

fn read(
    belief: &Belief,
    law: &Unified,
    target: &Target,
    innovation: &Innovation,
    document: &BeliefDocument,
    claim: &Belief,
) -> Result<(), Rejection> {
    let Target { map, input, noise, cross } = target;
    let Innovation { whitening, covariance, value, kappa, spread, square } = innovation;
    let gain = gain_of(document, map.rows, law.observation.rows)?;
    check_size(gain.magnitude(), map.rows, law.observation.rows)?;
    let closed = map.minus(&gain.times(&law.observation));
    let gamma = map.times(&belief.covariance).times(&law.observation.transposed()).plus(cross);
    let missed = gain.times(covariance).minus(&gamma).times(&whitening.transposed()).square();
    let carried = closed.around(&belief.gap);
    let mixed = gain.times(&cross.transposed());
    let joseph = closed
        .around(&belief.covariance)
        .plus(noise)
        .minus(&mixed)
        .minus(&mixed.transposed())
        .plus(&gain.around(&law.noise));
    let two = Table::number(2);
    let local = carried.scaled(&kappa.plus(&spread.scaled(&two))).plus(&missed.scaled(&two));
    let off = joseph.minus(&claim.covariance).scaled(kappa);
    check_covariance(&claim.gap.scaled(kappa).minus(&local), &off)?;

    let error = map.times(&belief.mean).plus(input).plus(&gain.times(value)).minus(&claim.mean);
    let kappa_squared = kappa.square();
    let local = carried
        .scaled(spread)
        .plus(&missed)
        .scaled(square)
        .plus(&error.square().scaled(&kappa_squared))
        .scaled(&Table::number(3));
    let shrunk = closed.around(&belief.ellipsoid).scaled(&kappa_squared);
    check_mean(&claim.ellipsoid.scaled(&kappa_squared), &shrunk, &local, document.balance)
}

/// `slack ± off ≥ 0`
fn check_covariance(slack: &Table, off: &Table) -> Result<(), Rejection> {
    for (what, side) in [("−W₊ ≤ φ(P) − P̃₊", slack.plus(off)), ("φ(P) − P̃₊ ≤ W₊", slack.minus(off))]
    {
        nonnegative(&side).map_err(|found| indefinite(Condition::Covariance, what, &found))?;
    }
    Ok(())
}

/// `ellipsoid ≥ (1 + α) carried + (1 + 1/α) local`, or their sum where one is zero.
fn check_mean(ellipsoid: &Table, carried: &Table, local: &Table, balance: Option<i64>) -> Result<(), Rejection> {
    let sum = match balance {
        None if carried.is_zero() || local.is_zero() => carried.plus(local),
        None => return Err(wrong(Condition::Members, "`balance` is missing, and two errors of the mean are added")),
        Some(k) if k.unsigned_abs() <= MOST_BALANCE => {
            let one_and = |exponent| Table::number(1).plus(&Table::power(exponent));
            carried.scaled(&one_and(-k)).plus(&local.scaled(&one_and(k)))
        }
        Some(_) => return Err(wrong(Condition::Size, format!("`balance` lies between ±{MOST_BALANCE}"))),
    };
    nonnegative(&ellipsoid.minus(&sum)).map_err(|found| indefinite(Condition::Mean, "e₊e₊ᵀ ≤ E₊", &found))
}
