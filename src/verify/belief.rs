//! A belief that a certificate claims.

use num_bigint::BigInt;
use num_traits::Signed;

use super::definite::nonnegative;
use super::document::BeliefDocument;
use super::rejection::{Condition, Rejection, indefinite, wrong};
use super::table::Table;
use crate::scalar::Rational;

/// `−W ≤ P − P̃ ≤ W` and `(x̂ − x̃)(x̂ − x̃)ᵀ ≤ E` for the exact covariance P and mean x̂.
#[derive(Clone, Debug)]
pub struct Belief {
    /// P̃
    pub(super) covariance: Table,
    /// W
    pub(super) gap: Table,
    /// x̃
    pub(super) mean: Table,
    /// E
    pub(super) ellipsoid: Table,
}

impl Belief {
    pub(super) fn of(document: &BeliefDocument, n: usize) -> Result<Self, Rejection> {
        let shaped = |name: &str, table: Option<Table>, shape: &str| {
            table.ok_or_else(|| wrong(Condition::Shape, format!("`{name}` is not {shape} with n = {n}")))
        };
        let triangle = "the lower triangle of an n×n matrix";
        Ok(Self {
            covariance: shaped("covariance", Table::symmetric(&document.covariance, n), triangle)?,
            gap: shaped("gap", Table::symmetric(&document.gap, n), triangle)?,
            mean: shaped("mean", Table::full(&document.mean, n, 1), "n×1")?,
            ellipsoid: shaped("ellipsoid", Table::symmetric(&document.ellipsoid, n), triangle)?,
        })
    }

    pub(super) fn magnitude(&self) -> u64 {
        let Self { covariance, gap, mean, ellipsoid } = self;
        [covariance, gap, mean, ellipsoid].map(Table::magnitude).into_iter().max().unwrap_or(0)
    }

    /// That it encloses a belief that is known exactly.
    pub(super) fn encloses(&self, mean: &Table, covariance: &Table) -> Result<(), Rejection> {
        let off = covariance.minus(&self.covariance);
        for (sign, side) in [("−W ≤ P − P̃", self.gap.plus(&off)), ("P − P̃ ≤ W", self.gap.minus(&off))] {
            nonnegative(&side).map_err(|found| indefinite(Condition::StartCovariance, sign, &found))?;
        }
        let side = self.ellipsoid.minus(&mean.minus(&self.mean).square());
        nonnegative(&side).map_err(|found| indefinite(Condition::StartMean, "(x̂ − x̃)(x̂ − x̃)ᵀ ≤ E", &found))
    }

    /// n
    pub fn states(&self) -> usize {
        self.mean.rows
    }

    /// Between which numbers entry (i, j) of the covariance lies.
    ///
    /// # Panics
    ///
    /// If there is no such entry.
    pub fn covariance(&self, i: usize, j: usize) -> [Rational; 2] {
        let radius = if i == j {
            value(&self.gap.entry(i, i))
        } else {
            root(&self.gap.entry(i, i).times(&self.gap.entry(j, j)))
        };
        around(&value(&self.covariance.entry(i, j)), &radius)
    }

    /// Between which numbers entry i of the mean lies.
    ///
    /// # Panics
    ///
    /// If there is no such entry.
    pub fn mean(&self, i: usize) -> [Rational; 2] {
        around(&value(&self.mean.entry(i, 0)), &root(&self.ellipsoid.entry(i, i)))
    }

    /// The bits to which all entries are known: those of covariances in units of √(pᵢᵢ pⱼⱼ), those of means in the larger of |xᵢ| and
    /// √pᵢᵢ; nothing where all are known exactly. Where a variance may be zero, its unit is that of the same state in the
    /// other belief, from which this one came.
    pub(super) fn bits(&self, before: &Self) -> Option<u64> {
        let variance = |belief: &Self, i: usize| {
            // Indefinite weights may have a solution with negative entries there.
            let entry = belief.covariance.entry(i, i);
            let size = if entry.at(0, 0).is_negative() { Table::zero(1, 1).minus(&entry) } else { entry };
            let least = size.minus(&belief.gap.entry(i, i));
            least.is_positive().then_some(least)
        };
        let of = |i: usize| {
            let unit = variance(self, i).or_else(|| variance(before, i)).unwrap_or_else(|| Table::zero(1, 1));
            let mean = self.mean.entry(i, 0);
            // Half of it at least, if the ellipsoid is that much smaller.
            let square = mean.square().scaled(&Table::power(-2));
            let far = square.minus(&self.ellipsoid.entry(i, i)).is_positive();
            let mean_unit = if far && square.minus(&unit).is_positive() { &square } else { &unit };
            let covariance = quotient_bits(&unit, &self.gap.entry(i, i));
            let mean = quotient_bits(mean_unit, &self.ellipsoid.entry(i, i)).map(|bits| bits / 2);
            [covariance, mean].into_iter().flatten().min()
        };
        (0..self.states()).filter_map(of).min()
    }
}

/// b with `unit ≥ 2ᵇ error`, or 0; nothing where there is no error.
fn quotient_bits(unit: &Table, error: &Table) -> Option<u64> {
    if error.is_zero() {
        return None;
    }
    let size = |number: &Table| {
        i64::try_from(number.at(0, 0).bits()).unwrap_or(i64::MAX) + number.exponent
            - i64::try_from(number.denominator.bits()).unwrap_or(i64::MAX)
    };
    if !unit.is_positive() {
        return Some(0);
    }
    // unit ≥ 2^(size − 1), error < 2^(size + 1), denominators apart.
    Some(u64::try_from(size(unit) - size(error) - 2).unwrap_or(0))
}

/// A number as a fraction.
pub(super) fn value(number: &Table) -> Rational {
    let shift = number.exponent.unsigned_abs();
    let (over, under) = (number.at(0, 0), &number.denominator);
    if number.exponent >= 0 {
        Rational::new(over << shift, under.clone())
    } else {
        Rational::new(over.clone(), under << shift)
    }
}

/// Not less than the root of a dyadic number that is not negative.
fn root(square: &Table) -> Rational {
    let odd = square.exponent.rem_euclid(2);
    // 64 bits more, so that the root has some.
    let mantissa: BigInt = square.at(0, 0).abs() << (128 + odd);
    let root = mantissa.sqrt() + 1_u8;
    let root = if square.is_zero() { BigInt::default() } else { root };
    value(&Table { entries: vec![root], exponent: (square.exponent - odd - 128) / 2, ..Table::number(0) })
}

fn around(middle: &Rational, radius: &Rational) -> [Rational; 2] {
    [middle - radius, middle + radius]
}
