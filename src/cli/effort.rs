//! How much work an identification may be: fractions lengthen with every reading, so it is bounded before it is begun.

use num_bigint::BigInt;
use num_integer::Integer as _;

use crate::model::Reading;
use crate::protocol::InputError;
use crate::scalar::Rational;

/// The largest work of a method that is begun: some seconds (in release mode), by measurement.
///
/// Written over their common denominator, let the numbers have N bits. The entries of an estimate of order p then have
/// about L = p(2N + log₂ n) bits; each sum of such fractions, over the readings, makes it n times as long. The work of
/// n steps is taken as n·p³·L².
#[derive(Clone, Copy, Debug)]
pub(super) struct Effort {
    /// What is counted, for messages.
    data: &'static str,
    /// The largest p.
    order: usize,
    /// The largest n·p^power.
    count: usize,
    power: u32,
    /// How many sums of fractions are nested.
    sums: u32,
    /// The largest n·p^power·L².
    work: f64,
    /// What may be chosen so that more is admitted.
    hint: &'static str,
}

impl Effort {
    pub(super) fn of_moments(reading: Reading, adaptive: bool) -> Self {
        let (sums, work, hint) = match (reading == Reading::Last, adaptive) {
            (true, false) => (0, 2e8, ""),
            (true, true) => (1, 5e9, ", or leave out the adaptive filter"),
            (false, false) => (1, 1e10, ", or choose `\"residuals\": \"last\"`"),
            (false, true) => (2, 1e12, ", or choose `\"residuals\": \"last\"`, or leave out the adaptive filter"),
        };
        Self { data: "readings", order: 4, count: 4000, power: 3, sums, work, hint }
    }

    pub(super) fn of_least_squares() -> Self {
        Self { data: "outputs", order: 32, count: 20_000, power: 2, sums: 0, work: 1e10, hint: "" }
    }

    /// Whether so many data of this order are few enough.
    pub(super) fn admits_count(self, path: &str, n: usize, p: usize) -> Result<(), InputError> {
        let Self { data, order, count, power, hint: _, .. } = self;
        if p > order {
            let what = if data == "outputs" { "coefficients; take fewer lags" } else { "components; leave some out" };
            return Err(InputError::at(path, format!("the order {p} is too large: at most {order} {what}")));
        }
        let most = count / p.max(1).pow(power);
        if n > most {
            let message = format!("{n} {data} are too many: at most {most} are taken with the order {p}; take fewer");
            return Err(InputError::at(path, message));
        }
        Ok(())
    }

    /// Whether numbers of this length are short enough.
    #[allow(clippy::cast_precision_loss, reason = "an estimate")]
    pub(super) fn admits_lengths<'a>(
        self,
        path: &str,
        n: usize,
        p: usize,
        numbers: impl IntoIterator<Item = &'a Rational>,
    ) -> Result<(), InputError> {
        let Self { data, power, sums, work, hint, .. } = self;
        let exponents = (i32::try_from(power).unwrap_or(3), i32::try_from(sums).unwrap_or(2));
        let (steps, order) = (n.max(1) as f64, p.max(1) as f64);
        let length = (work / (steps * order.powi(exponents.0))).sqrt() / (order * steps.powi(exponents.1));
        let most = ((length - steps.log2()) / 2.0).max(0.0);
        match common_length(numbers, most) {
            None => Ok(()),
            Some(bits) => {
                let message = format!(
                    "the numbers are too long for {n} {data} of order {p}: written over their common denominator they have \
                     {bits} bits or more, and at most {most:.0} are taken; take fewer {data}, or shorter numbers{hint}"
                );
                Err(InputError::at(path, message))
            }
        }
    }
}

/// The bits of the longest numerator or denominator over the common denominator, if they are more than `most`.
#[allow(clippy::cast_precision_loss, reason = "an estimate")]
fn common_length<'a>(numbers: impl IntoIterator<Item = &'a Rational>, most: f64) -> Option<u64> {
    let mut common = BigInt::from(1);
    // The largest excess of a numerator over its own denominator.
    let mut excess = 0_i64;
    for number in numbers {
        if !common.is_multiple_of(number.denom()) {
            common = common.lcm(number.denom());
        }
        let [above, below] =
            [number.numer(), number.denom()].map(|part| i64::try_from(part.bits()).unwrap_or(i64::MAX));
        excess = excess.max(above - below);
        let bits = common.bits().saturating_add(excess.unsigned_abs());
        if bits as f64 > most {
            return Some(bits);
        }
    }
    None
}
