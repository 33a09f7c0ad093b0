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
use super::document::{BeliefDocument, DyadicMatrix, MAXIMAL_ROWS};
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

/// That there are no more states and sensors than matrices of a certificate may have rows.
pub(super) fn check_order(states: usize, sensors: usize) -> Result<(), Rejection> {
    if states.max(sensors) <= MAXIMAL_ROWS {
        return Ok(());
    }
    let message = format!("{states} states and {sensors} sensors; {MAXIMAL_ROWS} of each are the most that is checked");
    Err(wrong(Condition::Size, message))
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
            let off = covariance.minus(&claim.covariance);
            check_covariance(&claim.gap.minus(&gap), &off, Condition::Covariance)?;
            let error = target.map.times(&belief.mean).plus(&target.input).minus(&claim.mean);
            let carried = target.map.around(&belief.ellipsoid);
            check_mean(&claim.ellipsoid, &carried, &error.square(), document.balance)?;
        }
    }
    Ok(claim)
}

/// What a gain does to what is enclosed.
pub(super) struct ClosedLoop {
    /// G
    matrix: Table,
    /// G W Gᵀ
    carried: Table,
    /// ρTᵀTρᵀ
    missed: Table,
    /// J
    joseph: Table,
}

impl Innovation {
    pub(super) fn closed(&self, belief: &Belief, law: &Unified, target: &Target, gain: &Table) -> ClosedLoop {
        let Target { map, noise, cross, .. } = target;
        let matrix = map.minus(&gain.times(&law.observation));
        let gamma = map.times(&belief.covariance).times(&law.observation.transposed()).plus(cross);
        let mixed = gain.times(&cross.transposed());
        let joseph = matrix
            .around(&belief.covariance)
            .plus(noise)
            .minus(&mixed)
            .minus(&mixed.transposed())
            .plus(&gain.around(&law.noise));
        ClosedLoop {
            carried: matrix.around(&belief.gap),
            missed: gain.times(&self.covariance).minus(&gamma).times(&self.whitening.transposed()).square(),
            matrix,
            joseph,
        }
    }

    /// `κ (gap ± (J − centre)) ≥ (κ + 2w) GWGᵀ + 2 ρTᵀTρᵀ`
    pub(super) fn check_gap(
        &self,
        closed: &ClosedLoop,
        (gap, centre): (&Table, &Table),
        condition: Condition,
    ) -> Result<(), Rejection> {
        let two = Table::number(2);
        let first = closed.carried.scaled(&self.kappa.plus(&self.spread.scaled(&two)));
        let local = first.plus(&closed.missed.scaled(&two));
        let off = closed.joseph.minus(centre).scaled(&self.kappa);
        check_covariance(&gap.scaled(&self.kappa).minus(&local), &off, condition)
    }

    /// `κ² r² X ≥ κ² (1 + β) GXGᵀ + 2 (1 + 1/β) v (w GWGᵀ + ρTᵀTρᵀ)`, v = tr(THXHᵀTᵀ)
    pub(super) fn check_contraction(
        &self,
        closed: &ClosedLoop,
        law: &Unified,
        (shape, rate): (&Table, &Table),
        balance: Option<i64>,
    ) -> Result<(), Rejection> {
        let weight = self.whitening.times(&law.observation).around(shape).trace().above(NUMBER_BITS);
        let missed = closed.carried.scaled(&self.spread).plus(&closed.missed);
        let missed = missed.scaled(&weight).scaled(&Table::number(2));
        let square = self.kappa.square();
        let sum = balanced(&closed.matrix.around(shape).scaled(&square), &missed, balance)?;
        let side = shape.scaled(rate).scaled(&square).minus(&sum);
        nonnegative(&side).map_err(|found| indefinite(Condition::Contraction, "G X Gᵀ ≤ r² X", &found))
    }
}

fn read(
    belief: &Belief,
    law: &Unified,
    target: &Target,
    innovation: &Innovation,
    document: &BeliefDocument,
    claim: &Belief,
) -> Result<(), Rejection> {
    let gain = gain_of(document, target.map.rows, law.observation.rows)?;
    check_size(gain.magnitude(), target.map.rows, law.observation.rows)?;
    let closed = innovation.closed(belief, law, target, &gain);
    innovation.check_gap(&closed, (&claim.gap, &claim.covariance), Condition::Covariance)?;
    let moved = target.map.times(&belief.mean).plus(&target.input).plus(&gain.times(&innovation.value));
    let error = moved.minus(&claim.mean);
    let square = innovation.kappa.square();
    let local = closed
        .carried
        .scaled(&innovation.spread)
        .plus(&closed.missed)
        .scaled(&innovation.square)
        .plus(&error.square().scaled(&square))
        .scaled(&Table::number(3));
    let shrunk = closed.matrix.around(&belief.ellipsoid).scaled(&square);
    check_mean(&claim.ellipsoid.scaled(&square), &shrunk, &local, document.balance)
}

/// `slack ± off ≥ 0`
fn check_covariance(slack: &Table, off: &Table, condition: Condition) -> Result<(), Rejection> {
    for (what, side) in [("−W₊ ≤ φ(P) − P̃₊", slack.plus(off)), ("φ(P) − P̃₊ ≤ W₊", slack.minus(off))]
    {
        nonnegative(&side).map_err(|found| indefinite(condition, what, &found))?;
    }
    Ok(())
}

fn check_mean(ellipsoid: &Table, carried: &Table, local: &Table, balance: Option<i64>) -> Result<(), Rejection> {
    let sum = balanced(carried, local, balance)?;
    nonnegative(&ellipsoid.minus(&sum)).map_err(|found| indefinite(Condition::Mean, "e₊e₊ᵀ ≤ E₊", &found))
}

/// `(1 + 2⁻ᵏ) carried + (1 + 2ᵏ) local`, or their sum where one is zero.
fn balanced(carried: &Table, local: &Table, balance: Option<i64>) -> Result<Table, Rejection> {
    match balance {
        None if carried.is_zero() || local.is_zero() => Ok(carried.plus(local)),
        None => Err(wrong(Condition::Members, "`balance` is missing, and two errors are added")),
        Some(k) if k.unsigned_abs() <= MOST_BALANCE => {
            let one_and = |exponent| Table::number(1).plus(&Table::power(exponent));
            Ok(carried.scaled(&one_and(-k)).plus(&local.scaled(&one_and(k))))
        }
        Some(_) => Err(wrong(Condition::Size, format!("`balance` lies between ±{MOST_BALANCE}"))),
    }
}
