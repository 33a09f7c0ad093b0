//! Averages enclosed with more and more bits of work, and compared with fractions.

use std::cmp::Ordering;
use std::collections::BTreeMap;
use std::collections::btree_map::Entry;

use num_bigint::BigInt;

use super::average::{Average, Enclosed, Form, TooWide};
use super::classes::{Class, Classes};
use super::pairs::{Central, Pairs};
use super::{Evidence, Posterior};
use crate::scalar::{Dyadic, Exponentials, Interval, Overflow, Rational, Scalar, Toward, Undefined, ratio};

/// No number is worked on with more bits.
pub(super) const MOST_BITS: u64 = 1 << 18;

/// Bits of work times classes beyond which work stops, unless that is too little for what is asked.
const MOST_WORK: u64 = 1 << 22;

/// No more pairs of classes are gone through for digits.
const MOST_PAIRS: usize = 1 << 13;

/// Bits of work for what is told where too many are asked for.
const FEW_BITS: u64 = 64;

/// The numbers of a posterior. Components whose probabilities are rational multiples of each other are taken together, and
/// exponentials are computed once for each number of bits, for all numbers that are asked for.
///
/// # Examples
///
/// 0 or 1 with odds of 1 : exp(−1).
///
/// ```
/// use std::cmp::Ordering;
/// use exact_kalman::gaussian::Gaussian;
/// use exact_kalman::matrix::Matrix;
/// use exact_kalman::nongaussian::{Enclosed, Evidence, Posterior, PosteriorComponent};
/// use exact_kalman::scalar::ratio;
///
/// let component = |x: i64| {
///     let law = Gaussian::new(Matrix::from_integers(&[[x]]), Matrix::from_integers(&[[0]])).expect("a law");
///     let evidence = Evidence { weight: ratio(1, 2), determinant: ratio(1, 1), exponent: ratio(-x, 1) };
///     PosteriorComponent { evidence, initial: law.clone(), state: law }
/// };
/// let posterior = Posterior { components: vec![component(0), component(1)] };
/// let mut averages = posterior.averages();
/// let mean = &averages.mean()[0];
/// // 1/(1 + e) = 0.2689…
/// assert_eq!(averages.compared(mean, &ratio(2689, 10_000))?, Ordering::Greater);
/// assert_eq!(averages.compared(mean, &ratio(2690, 10_000))?, Ordering::Less);
/// # Ok::<(), exact_kalman::nongaussian::TooWide>(())
/// ```
#[derive(Clone, Debug)]
pub struct Averages<'a> {
    pub(super) posterior: &'a Posterior<Rational>,
    pub(super) classes: Classes,
    weights: Weights,
    /// The pairs of classes, once an entry of the covariance has needed them.
    pairs: Option<(Pairs, Weights)>,
}

impl Posterior<Rational> {
    /// Its probabilities, moments and differences, to be enclosed.
    pub fn averages(&self) -> Averages<'_> {
        let classes = Classes::of(self.components.iter().map(|part| &part.evidence));
        let weights = Weights::new(&classes);
        Averages { posterior: self, classes, weights, pairs: None }
    }
}

/// What of a number is enclosed.
#[derive(Clone, Copy)]
enum Wanted<'a> {
    Value,
    /// A positive multiple of its difference to a fraction.
    Distance(&'a Rational),
}

impl Averages<'_> {
    /// The number: itself, or with a relative width of at most 2^−bits.
    ///
    /// # Errors
    ///
    /// [`TooWide`] with what is known.
    pub fn enclosed(&mut self, number: &Average, bits: u64) -> Result<Enclosed, TooWide> {
        match &number.exact {
            Some(value) => Ok(Enclosed::Exact(value.clone())),
            None => self.narrowed(number, Wanted::Value, bits).map(Enclosed::Between),
        }
    }

    /// On which side of a fraction the number lies, or that it is this fraction.
    ///
    /// # Errors
    ///
    /// [`TooWide`] where it is too close to the fraction.
    pub fn compared(&mut self, number: &Average, with: &Rational) -> Result<Ordering, TooWide> {
        if let Some(value) = &number.exact {
            return Ok(value.cmp(with));
        }
        // One bit of the difference tells its sign.
        let found = self.narrowed(number, Wanted::Distance(with), 1);
        let found = found.map_err(|wide| TooWide { known: None, ..wide })?;
        Ok(if found.lower().is_negative() { Ordering::Less } else { Ordering::Greater })
    }

    fn narrowed(&mut self, number: &Average, wanted: Wanted<'_>, bits: u64) -> Result<Interval, TooWide> {
        let work = FirstAndMost::new(bits, self.classes.all.len());
        let Form::Central(entry) = &number.form else {
            return self.weights.narrowed(number, &number.form, wanted, &work);
        };
        if Pairs::count(&self.classes) > MOST_PAIRS {
            return self.weights.narrowed(number, &number.form, wanted, &work);
        }
        // Where terms of the covariance cancel that are no squares, pairs of classes are the better way: of these no sum
        // vanishes without being seen.
        let soon = FirstAndMost { most: work.most.min(work.first.saturating_mul(4)), ..work };
        let found = self.weights.narrowed(number, &number.form, wanted, &soon);
        found.or_else(|_| {
            let (pairs, weights) = self.pairs.get_or_insert_with(|| {
                let pairs = Pairs::new(&self.classes);
                let weights = Weights::new(&pairs.joint);
                (pairs, weights)
            });
            let values = Form::Values(pairs.averages(entry));
            weights.narrowed(number, &values, wanted, &FirstAndMost::new(bits, pairs.joint.all.len()))
        })
    }
}

/// How many bits of work are tried.
#[derive(Clone, Copy)]
struct FirstAndMost {
    bits: u64,
    first: u64,
    most: u64,
}

impl FirstAndMost {
    fn new(bits: u64, classes: usize) -> Self {
        let classes = u64::try_from(classes).unwrap_or(u64::MAX).max(1);
        let first = bits.saturating_add(32);
        Self { bits, first, most: (MOST_WORK / classes).max(first.saturating_mul(2)).min(MOST_BITS) }
    }
}

/// The sizes of classes, as far as they were asked for.
#[derive(Clone, Debug)]
struct Weights {
    all: Vec<Class>,
    /// By class of reference and bits of work.
    sizes: BTreeMap<(usize, u64), Vec<Interval>>,
}

impl Weights {
    fn new(classes: &Classes) -> Self {
        Self { all: classes.all.clone(), sizes: BTreeMap::new() }
    }

    /// What is computed with more and more bits of work, until it is narrow.
    fn narrowed(
        &mut self,
        number: &Average,
        form: &Form,
        wanted: Wanted<'_>,
        work: &FirstAndMost,
    ) -> Result<Interval, TooWide> {
        let &FirstAndMost { bits, first, most } = work;
        let failed = |known| TooWide { quantity: number.quantity, bits, most, known };
        if first > most {
            return Err(failed(self.computed(form, wanted, FEW_BITS)));
        }
        let (mut work, mut known): (u64, Option<Interval>) = (first, None);
        while work <= most {
            let Some(found) = self.computed(form, wanted, work) else { break };
            if is_narrow(&found, bits) {
                return Ok(found);
            }
            // Exponents that are out of reach remain so: the width stays as it is.
            let now = width(&found);
            let stays = known.as_ref().is_some_and(|before| now.plus(&now, 64, Toward::Above) > width(before));
            known = Some(found);
            if stays {
                break;
            }
            work *= 2;
        }
        Err(failed(known))
    }

    fn computed(&mut self, form: &Form, wanted: Wanted<'_>, work: u64) -> Option<Interval> {
        let zero = ratio(0, 1);
        // What does not differ from a fraction need not be kept within reach.
        let reference = match (wanted, form) {
            (Wanted::Distance(from), Form::Values(values)) => self.largest(|class| values[class] != *from),
            _ => self.largest(|_| true),
        }?;
        let sizes = self.sizes(reference, work)?;
        let from = if let Wanted::Distance(from) = wanted { from } else { &zero };
        let distance = match form {
            Form::Values(values) => weighted(sizes, values.iter().map(|value| value.minus(from)), work),
            Form::Indicator(class, value) => {
                let values = (0..sizes.len()).map(|i| if i == *class { value.minus(from) } else { from.negated() });
                weighted(sizes, values, work)
            }
            Form::Central(entry) => central(sizes, entry, from, work),
        };
        if let Wanted::Distance(_) = wanted {
            return Some(distance);
        }
        let whole = sum(sizes, work);
        let scale = if let Form::Central(_) = form { whole.times(&whole, work) } else { whole };
        distance.over(&scale, work).ok()
    }

    /// The class with the largest exponent of some.
    fn largest(&self, of: impl Fn(usize) -> bool) -> Option<usize> {
        (0..self.all.len()).filter(|&class| of(class)).max_by_key(|&class| &self.all[class].exponent)
    }

    /// The sizes of the classes over that of the exponential of one; only of those whose exponent is not larger.
    fn sizes(&mut self, reference: usize, work: u64) -> Option<&[Interval]> {
        if let Entry::Vacant(place) = self.sizes.entry((reference, work)) {
            place.insert(sizes(&self.all, &self.all[reference].exponent, work).ok()?);
        }
        self.sizes.get(&(reference, work)).map(Vec::as_slice)
    }
}

/// The sizes of evidence over one exponential, with so many bits of work; 0 for those whose exponent is larger.
pub(super) fn sizes(all: &[Evidence<Rational>], largest: &Rational, work: u64) -> Result<Vec<Interval>, Undefined> {
    let exponentials = Exponentials::new(work);
    let size = |evidence: &Evidence<Rational>| {
        if evidence.exponent > *largest {
            return Ok(Interval::zero());
        }
        let size = exponentials.of(&evidence.exponent.minus(largest)).map_err(|Overflow| Undefined::Undecided)?;
        let root = Interval::square_root(&evidence.determinant, work)?;
        size.times(&Interval::of(&evidence.weight, work), work).over(&root, work)
    };
    all.iter().map(size).collect()
}

fn sum(all: &[Interval], work: u64) -> Interval {
    all.iter().fold(Interval::zero(), |sum, one| sum.plus(one, work))
}

fn weighted(sizes: &[Interval], values: impl Iterator<Item = Rational>, work: u64) -> Interval {
    sizes.iter().zip(values).fold(Interval::zero(), |sum, (size, value)| {
        let is_zero = value == ratio(0, 1);
        if is_zero { sum } else { sum.plus(&size.times(&Interval::of(&value, work), work), work) }
    })
}

/// `Σ SᵢSⱼ (vᵢ − from) + Σ SᵢSⱼ lᵢrᵢ − Σ Sᵢlᵢ Σ Sᵢrᵢ`, l and r being centred at the class z of the largest size.
///
/// Of a variance no more than log₂ of the number of classes plus one bits cancel: it is at least p_z (l_z − mean)², and that
/// square is what is subtracted.
fn central(sizes: &[Interval], entry: &Central, from: &Rational, work: u64) -> Interval {
    let centre = (0..sizes.len()).max_by_key(|&class| sizes[class].upper());
    let away = |of: &[Rational], i: usize| centre.map_or_else(|| of[i].clone(), |centre| of[i].minus(&of[centre]));
    let places = 0..sizes.len();
    let square = |i: usize| {
        let product = away(&entry.left, i).times(&away(&entry.right, i));
        entry.inner[i].minus(from).plus(&product)
    };
    let squares = weighted(sizes, places.clone().map(square), work);
    let [left, right] =
        [&entry.left, &entry.right].map(|of| weighted(sizes, places.clone().map(|i| away(of, i)), work));
    squares.times(&sum(sizes, work), work).minus(&left.times(&right, work), work)
}

/// Whether upper − lower ≤ 2^−bits · |x| for all x of the interval.
fn is_narrow(found: &Interval, bits: u64) -> bool {
    let (lower, upper) = (found.lower(), found.upper());
    if lower.is_negative() != upper.is_negative() || lower.is_zero() || upper.is_zero() {
        return false;
    }
    let least = if lower.is_negative() { upper.negated() } else { lower.clone() };
    let part = Dyadic::new(BigInt::from(1), -i64::try_from(bits).unwrap_or(i64::MAX));
    width(found) <= least.times(&part, 64, Toward::Below)
}

pub(super) fn width(of: &Interval) -> Dyadic {
    of.upper().plus(&of.lower().negated(), 64, Toward::Above)
}
