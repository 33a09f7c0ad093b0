//! The certificate of a steady state: S = φ(S) with a closed loop that shrinks, or why there is none.
//!
//! `φ(P) = A P Aᵀ + Q − Γ Σ⁻¹ Γᵀ` with `Γ = A P Hᵀ + S`, `Σ = H P Hᵀ + R`; J, G, ρ, η, w and κ are those of a step from S̃ with gap E.
//!
//! > `κ (E ± (J − S̃)) ≥ (κ + 2w) G E Gᵀ + 2 ρTᵀTρᵀ`, `E ≥ 0`, `κ > 0`
//!
//! proves that φ maps the P between S̃ ± E into themselves, so that there is a fixed point between them; and with
//! `v = tr(T H X Hᵀ Tᵀ)`, X > 0 and 0 < r < 1
//!
//! > `κ² r² X ≥ κ² (1 + β) G X Gᵀ + 2 (1 + 1/β) v (w G E Gᵀ + ρTᵀTρᵀ)`
//!
//! proves that every P among them has a closed loop of spectral radius r at most, so that there is only one fixed point, and no other
//! anywhere that has such a loop.

use num_bigint::{BigInt, Sign};
use num_traits::Signed;

use super::belief::Belief;
use super::definite::{nonnegative, positive, rank};
use super::document::DyadicMatrix;
use super::polynomial::{at_ends, characteristic, folded_at, reaches_circle};
use super::rejection::{Condition, Rejection, indefinite, wrong};
use super::steady_document::{RationalRows, Stabilising, SteadyEvidence};
use super::step::{Innovation, check_order, check_size};
use super::table::Table;
use super::unified::{Target, Unified};
use crate::model::{Step, Timing};
use crate::scalar::Rational;

/// What is proved of a steady state.
#[derive(Clone, Debug)]
pub enum ProvedSteady {
    /// There is exactly one solution whose closed loop is stable.
    Stabilising {
        /// Where it lies; the mean is zero.
        solution: Box<Belief>,
        /// The bits to which it is known in units of √(sᵢᵢ sⱼⱼ); nothing where it is known exactly.
        bits: Option<u64>,
        /// r²: the closed loop has a spectral radius of r at most.
        rate_squared: Rational,
        /// Whether the noise, of the sensors that are used, is positive semidefinite: then so is the solution, which no other exceeds.
        is_covariance: bool,
    },
    /// There is none: so many modes are not observed, and one of them does not shrink.
    Unobservable {
        /// k
        modes: usize,
    },
    /// There is none: so many modes are not reached by noise, and one of them neither shrinks nor grows.
    Unreachable {
        /// k
        modes: usize,
    },
}

/// The largest matrix Λ.
const MOST_MODES: usize = 64;

/// The most characters of a rational matrix.
const MOST_CHARACTERS: usize = 1 << 18;

/// The most products of words for a characteristic polynomial, about.
const MOST_WORK: u128 = 1 << 36;

/// Checks what is said of a step that is repeated for ever; of the reading, only its dimension counts.
///
/// Of a control problem `X = AᵀXA − (AᵀXB + S)(R + BᵀXB)⁻¹(BᵀXA + Sᵀ) + Q` the step has the transition Aᵀ and the observation Bᵀ, in
/// departing timing.
///
/// # Errors
///
/// [`Rejection`].
pub fn check_steady(
    step: &Step<Rational>,
    timing: Timing,
    evidence: &SteadyEvidence,
) -> Result<ProvedSteady, Rejection> {
    check_order(step.observation.columns(), step.observation.rows())?;
    let unified = Unified::of(step, timing, timing == Timing::Arriving)?;
    let all_read = step.reading.present().len() == step.reading.dimension();
    let Some(target) = target_of(&unified, timing).filter(|_| all_read && step.transition.is_some()) else {
        return Err(wrong(Condition::Case, "a whole step is needed, with a transition and nothing missing"));
    };
    check_size(unified.magnitude(), target.map.rows, unified.observation.rows)?;
    match evidence {
        SteadyEvidence::Stabilising(stabilising) => match &stabilising.kept {
            None => check_stabilising(&unified, target, stabilising),
            Some(kept) => {
                let all = unified.observation.rows;
                if !kept.is_sorted_by(|a, b| a < b) || kept.iter().any(|place| *place >= all) {
                    return Err(wrong(Condition::Kept, "`kept` is not in increasing order, or names no sensor"));
                }
                let less = unified.select(kept)?;
                let target =
                    target_of(&less, timing).ok_or_else(|| wrong(Condition::Case, "a transition is needed"))?;
                check_stabilising(&less, target, stabilising)
            }
        },
        SteadyEvidence::Unobservable { basis, map } => check_unobservable(&unified, target, basis, map),
        SteadyEvidence::Unreachable { basis, injection, map, between } => {
            check_unreachable(&unified, target, [basis, injection, map], between.as_ref())
        }
    }
}

/// Where a step leads that is repeated.
fn target_of(law: &Unified, timing: Timing) -> Option<&Target> {
    match timing {
        Timing::Arriving => Some(&law.filtered),
        Timing::Departing => law.ahead.as_ref(),
    }
}

fn check_stabilising(law: &Unified, target: &Target, claim: &Stabilising) -> Result<ProvedSteady, Rejection> {
    let (n, m) = (target.map.rows, law.observation.rows);
    let Stabilising { solution, gap, gain, whitening, shape, rate_squared, balance, kept: _ } = claim;
    let symmetric = |name: &str, matrix: &DyadicMatrix| {
        Table::symmetric(matrix, n).ok_or_else(|| {
            wrong(Condition::Shape, format!("`{name}` is not the lower triangle of an n×n matrix with n = {n}"))
        })
    };
    let (solution, gap, shape) = (symmetric("solution", solution)?, symmetric("gap", gap)?, symmetric("shape", shape)?);
    let gain = Table::full(gain, n, m).ok_or_else(|| wrong(Condition::Shape, format!("`gain` is not {n}×{m}")))?;
    let rate =
        Table { entries: vec![rate_squared.mantissa.0.clone()], exponent: rate_squared.exponent, ..Table::number(0) };
    let sizes = [&solution, &gap, &shape, &gain, &rate].map(Table::magnitude);
    check_size(sizes.into_iter().max().unwrap_or(0), n, m)?;
    nonnegative(&gap).map_err(|found| indefinite(Condition::Interior, "E ≥ 0", &found))?;
    positive(&shape).map_err(|found| indefinite(Condition::Contraction, "X > 0", &found))?;
    if !rate.is_positive() || !Table::number(1).minus(&rate).is_positive() {
        return Err(wrong(Condition::Contraction, "r² is not between 0 and 1"));
    }
    let centre = Belief { covariance: solution, gap, mean: Table::zero(n, 1), ellipsoid: Table::zero(n, n) };
    let innovation = Innovation::of(&centre, law, whitening)?;
    let closed = innovation.closed(&centre, law, target, &gain);
    innovation.check_gap(&closed, (&centre.gap, &centre.covariance), Condition::Invariance)?;
    innovation.check_contraction(&closed, law, (&shape, &rate), *balance)?;
    let joint = joint_noise(law, target);
    let bits = centre.bits(&centre);
    Ok(ProvedSteady::Stabilising {
        solution: Box::new(centre),
        bits,
        rate_squared: super::belief::value(&rate),
        is_covariance: nonnegative(&joint).is_ok(),
    })
}

/// `[[Q, S], [Sᵀ, R]]`
fn joint_noise(law: &Unified, target: &Target) -> Table {
    let upper = target.noise.beside(&target.cross);
    let lower = target.cross.transposed().beside(&law.noise);
    upper.transposed().beside(&lower.transposed()).transposed()
}

fn check_unobservable(
    law: &Unified,
    target: &Target,
    basis: &RationalRows,
    map: &RationalRows,
) -> Result<ProvedSteady, Rejection> {
    let modes = modes(map)?;
    let basis = read("basis", basis, target.map.rows, modes)?;
    let map = read("map", map, modes, modes)?;
    check_size(basis.magnitude().max(map.magnitude()), target.map.rows, modes)?;
    check_rank(&basis.transposed(), modes)?;
    check_zero(&law.observation.times(&basis), "H N = 0")?;
    check_zero(&target.map.times(&basis).minus(&basis.times(&map)), "A N = N Λ")?;
    if !reaches_circle(polynomial(&map)?) {
        return Err(wrong(Condition::Eigenvalue, "all eigenvalues of Λ have moduli below 1"));
    }
    Ok(ProvedSteady::Unobservable { modes })
}

fn check_unreachable(
    law: &Unified,
    target: &Target,
    [basis, injection, map]: [&RationalRows; 3],
    between: Option<&[String; 2]>,
) -> Result<ProvedSteady, Rejection> {
    let modes = modes(map)?;
    let basis = read("basis", basis, modes, target.map.rows)?;
    let injection = read("injection", injection, modes, law.observation.rows)?;
    let map = read("map", map, modes, modes)?;
    let size = basis.magnitude().max(map.magnitude()).max(injection.magnitude());
    check_size(size, target.map.rows + law.observation.rows, modes)?;
    check_rank(&basis, modes)?;
    let shared = basis.times(&target.noise).minus(&injection.times(&target.cross.transposed()));
    check_zero(&shared, "M Q = Y Sᵀ")?;
    check_zero(&basis.times(&target.cross).minus(&injection.times(&law.noise)), "M S = Y R")?;
    let moved = basis.times(&target.map).minus(&injection.times(&law.observation));
    check_zero(&moved.minus(&map.times(&basis)), "M A − Y H = Λ M")?;
    let polynomial = polynomial(&map)?;
    let is_on_circle = match between {
        None => at_ends(&polynomial).iter().any(|value| value.sign() == Sign::NoSign),
        Some(ends) => {
            let mut signs = Vec::with_capacity(2);
            for end in ends {
                let end = fraction("between", end)?;
                if end.abs() > Rational::from(BigInt::from(2)) {
                    return Err(wrong(Condition::Eigenvalue, "`between` does not lie in [−2, 2]"));
                }
                let value = folded_at(&polynomial, &end).ok_or_else(|| {
                    wrong(
                        Condition::Eigenvalue,
                        "the characteristic polynomial of Λ does not read the same in both directions",
                    )
                })?;
                signs.push(value.sign());
            }
            signs.contains(&Sign::NoSign) || signs.first() != signs.last()
        }
    };
    if !is_on_circle {
        return Err(wrong(Condition::Eigenvalue, "no eigenvalue of Λ is shown to lie on the unit circle"));
    }
    Ok(ProvedSteady::Unreachable { modes })
}

fn modes(map: &RationalRows) -> Result<usize, Rejection> {
    match map.0.len() {
        modes @ 1..=MOST_MODES => Ok(modes),
        modes => Err(wrong(Condition::Size, format!("Λ has {modes} rows; from 1 to {MOST_MODES} are checked"))),
    }
}

/// The characteristic polynomial of Λ, if that is not too much work.
fn polynomial(map: &Table) -> Result<Vec<BigInt>, Rejection> {
    let [modes, words] = [map.rows as u128, u128::from(map.magnitude() / 64 + 1)];
    if modes.pow(5) * words * words <= MOST_WORK {
        return Ok(characteristic(map));
    }
    Err(wrong(Condition::Size, "Λ is too large, or its entries too long, for its characteristic polynomial"))
}

fn check_rank(rows: &Table, modes: usize) -> Result<(), Rejection> {
    match rank(rows.entries.chunks(rows.columns.max(1)).map(<[_]>::to_vec).collect()) {
        Some(rank) if rank == modes => Ok(()),
        Some(_) => Err(wrong(Condition::Independent, format!("`basis` does not have the rank {modes}"))),
        None => Err(wrong(Condition::Size, "the rank of `basis` would take too long")),
    }
}

fn check_zero(table: &Table, what: &str) -> Result<(), Rejection> {
    if table.is_zero() { Ok(()) } else { Err(wrong(Condition::Subspace, format!("{what} does not hold"))) }
}

fn read(name: &str, matrix: &RationalRows, rows: usize, columns: usize) -> Result<Table, Rejection> {
    if matrix.0.len() != rows || matrix.0.iter().any(|row| row.len() != columns) {
        return Err(wrong(Condition::Shape, format!("`{name}` is not {rows}×{columns}")));
    }
    if matrix.0.iter().flatten().map(String::len).sum::<usize>() > MOST_CHARACTERS {
        return Err(wrong(Condition::Size, format!("`{name}` has more than {MOST_CHARACTERS} characters")));
    }
    let entries: Vec<Rational> =
        matrix.0.iter().flatten().map(|text| fraction(name, text)).collect::<Result<_, _>>()?;
    Ok(Table::of(rows, columns, |i, j| &entries[i * columns + j]))
}

/// A fraction, written as an integer or as one over a positive one.
fn fraction(name: &str, text: &str) -> Result<Rational, Rejection> {
    let integer = |text: &str, may_be_negative: bool| {
        let digits = if may_be_negative { text.strip_prefix('-').unwrap_or(text) } else { text };
        let is_plain =
            !digits.is_empty() && digits.len() <= MOST_CHARACTERS && digits.bytes().all(|it| it.is_ascii_digit());
        is_plain.then(|| text.parse::<BigInt>().ok()).flatten()
    };
    let (over, under) = text.split_once('/').unwrap_or((text, "1"));
    match (integer(over, true), integer(under, false)) {
        (Some(over), Some(under)) if under.is_positive() => Ok(Rational::new(over, under)),
        _ => Err(wrong(Condition::Document, format!("`{name}`: a fraction is expected, such as -3/7"))),
    }
}
