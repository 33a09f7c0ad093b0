//! The filter whose results are enclosed.

use super::ahead::Ahead;
use super::derived::{Asked, Derived};
use super::enclosed::Enclosed;
use super::grid::BOUND_BITS;
use super::groups::Groups;
use super::innovation::Innovation;
use super::law::Law;
use super::{NotEnclosed, Undecided, target};
use crate::filter::StepValues;
use crate::matrix::Matrix;
use crate::model::{Before, Path, PathAhead, Step, Timing};
use crate::scalar::{Dyadic, Interval, Rational, Scalar as _, Toward};
use crate::trace::{Quantity, Values};

/// The results of one step: each entry lies in its interval.
#[derive(Clone, Debug)]
pub struct CertifiedStep {
    /// The named values; the gain and the log likelihood only if they are [asked for](CertifiedFilter::everything).
    pub values: Values<Interval>,
    /// The rank of the innovation covariance, exactly.
    pub innovation_rank: usize,
    /// What else is asked for.
    pub derived: Derived,
}

impl CertifiedStep {
    /// The largest power of two, up or down, of an entry that is not zero.
    pub(super) fn magnitude(&self) -> Option<u64> {
        let of = |interval: &Interval| {
            let (lower, upper) = (interval.lower(), interval.upper());
            let sizes = [lower, upper].map(|end| end.magnitude().unwrap_or(0));
            let may_be_zero = lower.is_negative() != upper.is_negative() || lower.is_zero() || upper.is_zero();
            // What may be zero has ends that are small for no reason but the bits.
            sizes
                .into_iter()
                .map(|size| if may_be_zero { size.max(0).unsigned_abs() } else { size.unsigned_abs() })
                .max()
        };
        self.values.values().flat_map(Matrix::entries).filter_map(of).max()
    }

    /// The middle of each interval, in fractions of so many bits; zero where a variance [vanishes](Self::accuracy).
    pub fn middles(&self, bits: u64) -> StepValues {
        let half = Dyadic::new(1.into(), -1);
        let middle = |interval: &Interval| {
            let twice = interval.lower().plus(interval.upper(), bits, Toward::Below);
            // A number that long has no place in a filter's answer.
            twice.times(&half, bits, Toward::Below).value().unwrap_or_else(Rational::zero)
        };
        let mut values: Values<Rational> =
            self.values.iter().map(|(&quantity, entries)| (quantity, entries.map(middle))).collect();
        if let Some(covariance) = values.get_mut(&Quantity::FilteredCovariance) {
            let vanishing = self.vanishing();
            let gone: Vec<bool> = vanishing.iter().map(Option::is_some).collect();
            for (i, j) in (0..gone.len()).flat_map(|i| (0..gone.len()).map(move |j| (i, j))) {
                if gone[i] || gone[j] {
                    covariance[(i, j)] = Rational::zero();
                }
            }
        }
        StepValues { values, innovation_rank: self.innovation_rank }
    }
}

/// The filter along a path, one step at a time, with a fixed number of bits.
///
/// It ends with the path, or where a step is [not enclosed](NotEnclosed).
///
/// # Examples
///
/// ```
/// use exact_kalman::certify::CertifiedFilter;
/// use exact_kalman::matrix::Matrix;
/// use exact_kalman::model::{Before, Initial, Noise, Observation, System, Timing};
/// use exact_kalman::scalar::{ratio, Rational};
/// use exact_kalman::trace::Quantity;
///
/// let one = Matrix::<Rational>::identity(1);
/// let walk = System {
///     timing: Timing::Departing,
///     initial: Initial::new(Before::Observation, Matrix::zeros(1, 1), one.clone()),
///     transition: one.clone().into(),
///     observation: one.clone().into(),
///     noise: Noise::Covariances { process: one.clone().into(), cross: None, observation: one.into() },
///     input: None,
///     observation_input: None,
/// };
/// let path = walk.realised(&vec![Observation::complete([ratio(1, 1)]); 1000])?;
/// let last = CertifiedFilter::new(&path, 128).last().ok_or("no step")??;
/// let variance = &last.values[&Quantity::FilteredCovariance][(0, 0)];
/// // The variance tends to the golden section: p = (√5 − 1)/2 solves p = (p + 1)/(p + 2).
/// let p = variance.lower().value().ok_or("long")?;
/// let defect = &p * &p + &p - ratio(1, 1);
/// assert!(defect < ratio(1, 1 << 62).pow(2) && defect > -ratio(1, 1 << 62).pow(2));
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Debug)]
pub struct CertifiedFilter<'a> {
    path: &'a Path<Rational>,
    bits: u64,
    pub(super) belief: Option<Enclosed>,
    law: Option<(&'a Step<Rational>, bool, Law)>,
    done: usize,
    /// Which states are independent.
    groups: Groups,
    asked: Option<Asked>,
    ahead: Option<Ahead<'a>>,
    #[cfg(feature = "judge")]
    pub(super) witness: super::certificate::Witness,
}

impl<'a> CertifiedFilter<'a> {
    /// The filter before the first step of a path. A diffuse start is undecided.
    pub fn new(path: &'a Path<Rational>, bits: u64) -> Self {
        let initial = path.initial();
        let is_diffuse = initial.diffuse.iter().any(|part| !part.is_zero());
        let belief = (!is_diffuse).then(|| Enclosed::of(&initial.mean, &initial.covariance, bits));
        let groups = Groups::of(&initial.covariance);
        Self {
            path,
            bits,
            belief,
            law: None,
            done: 0,
            groups,
            asked: None,
            ahead: None,
            #[cfg(feature = "judge")]
            witness: super::certificate::Witness::default(),
        }
    }

    /// The filter in the middle of a path, before the step with this number, from the exact law of the state with which that
    /// step begins: predicted where transitions depart, else filtered.
    pub(crate) fn resumed(
        path: &'a Path<Rational>,
        done: usize,
        (mean, covariance): (&Matrix<Rational>, &Matrix<Rational>),
        bits: u64,
    ) -> Self {
        let belief = Some(Enclosed::of(mean, covariance, bits));
        Self { belief, done, groups: Groups::of(covariance), ..Self::new(path, bits) }
    }

    /// The same filter, of whose steps everything is wanted: also the gain, the covariance of state and reading, and the
    /// likelihood.
    #[must_use]
    pub fn everything(self) -> Self {
        Self { asked: Asked::new(self.bits), ..self }
    }

    /// The same filter along the path of a predictor, which encloses the laws of the next states too.
    #[must_use]
    pub fn ahead(self, path: &'a PathAhead<Rational>) -> Self {
        Self { ahead: Some(Ahead::new(path)), ..self }
    }

    fn advance(
        &mut self,
        step: &'a Step<Rational>,
        belief: &Enclosed,
    ) -> Result<(CertifiedStep, Enclosed), NotEnclosed> {
        let timing = self.path.timing();
        let arrives = timing == Timing::Arriving
            && step.transition.is_some()
            && (self.done > 0 || self.path.initial().before == Before::Transition);
        let law = match self.law.take() {
            Some((last, alike, law)) if alike == arrives && last.differs_in_data_alone(step) => law,
            _ => Law::of(step, timing, arrives),
        };
        let law = &self.law.insert((step, arrives, law)).2;
        let (data, bits) = (law.data(step, arrives), self.bits);
        let mut values = Values::new();
        let mut insert = |mean, covariance, belief: &Enclosed| {
            values.insert(mean, belief.mean_intervals(bits));
            values.insert(covariance, belief.covariance_intervals(bits));
        };
        let prior = |target| target::prior(belief, law, target);
        let moved = |target, exact: &_| target::moved(belief, law, &data, (target, exact), bits);
        // The state before the reading and the one given it are one image of the state before.
        let exact = prior(&law.filtered);
        let predicted = law.predicted.as_ref().map(|arriving| moved(arriving, &exact));
        insert(Quantity::PredictedMean, Quantity::PredictedCovariance, predicted.as_ref().unwrap_or(belief));
        let is_read = law.observation.rows() > 0;
        let innovation = is_read.then(|| Innovation::of(belief, law, &data, bits)).transpose()?;
        if let Some(proof) = law.readings.contradiction(step) {
            return Err(NotEnclosed::Contradiction(proof));
        }
        let mut derived = Derived::default();
        let (filtered, ahead) = if let Some(innovation) = innovation {
            let updated = |target, exact: &_| target::updated(belief, law, &data, (target, exact), &innovation, bits);
            let targets =
                (updated(&law.filtered, &exact), law.ahead.as_ref().map(|target| updated(target, &prior(target))));
            let value = innovation.value_intervals(belief, law, &data, bits);
            let covariance = innovation.covariance_intervals(belief, law, bits);
            let (value, covariance) = law.readings.all(value, covariance, bits + BOUND_BITS);
            if let Some(asked) = &mut self.asked {
                derived = asked.of(belief, law, &data, &innovation, step, &value);
            }
            insert(Quantity::FilteredMean, Quantity::FilteredCovariance, &targets.0);
            values.insert(Quantity::Innovation, value);
            values.insert(Quantity::InnovationCovariance, covariance);
            #[cfg(feature = "judge")]
            self.witness.whiten(innovation.whitening);
            targets
        } else {
            let targets =
                (moved(&law.filtered, &exact), law.ahead.as_ref().map(|target| moved(target, &prior(target))));
            insert(Quantity::FilteredMean, Quantity::FilteredCovariance, &targets.0);
            if !step.reading.present().is_empty() {
                // Zeros without noise are read.
                let none = |columns| Matrix::from_fn(0, columns, |_, _| Interval::zero());
                let (value, covariance) = law.readings.all(none(1), none(0), bits);
                values.insert(Quantity::Innovation, value);
                values.insert(Quantity::InnovationCovariance, covariance);
            }
            if let Some(asked) = &mut self.asked {
                derived = asked.of_nothing(step);
            }
            targets
        };
        let linked = self.groups.linked(step, timing, arrives);
        if let Some(predictor) = &mut self.ahead {
            derived.ahead = predictor.laws(self.done + 1, &filtered, ahead.as_ref(), &linked.next, bits);
        }
        derived.name_into(&mut values);
        #[cfg(feature = "judge")]
        self.witness.hold(self.done, &law.readings, predicted.as_ref(), &filtered, ahead.as_ref());
        linked.put_zeros(&mut values, &mut derived);
        self.groups = linked.next;
        let step = CertifiedStep { values, innovation_rank: law.readings.kept.len(), derived };
        Ok((step, ahead.unwrap_or(filtered)))
    }
}

impl Iterator for CertifiedFilter<'_> {
    type Item = Result<CertifiedStep, NotEnclosed>;

    fn next(&mut self) -> Option<Self::Item> {
        let path = self.path;
        let step = path.steps().get(self.done)?;
        let Some(belief) = self.belief.take() else {
            // A diffuse start; afterwards the end.
            let is_first = self.done == 0;
            self.done = path.steps().len();
            return is_first.then_some(Err(Undecided.into()));
        };
        match self.advance(step, &belief) {
            Ok((results, next)) => {
                self.belief = Some(next);
                self.done += 1;
                Some(Ok(results))
            }
            Err(reason) => {
                self.done = path.steps().len();
                Some(Err(reason))
            }
        }
    }
}

#[cfg(all(test, feature = "judge"))]
mod tests {
    use rand_core::{Rng, SeedableRng};
    use rand_pcg::Pcg64Mcg;

    use super::*;
    use crate::certify::packed::Packed;
    use crate::filter::filter;
    use crate::model::{Initial, Noise, Observation, System};
    use crate::scalar::ratio;

    /// Small fractions, coordinates in units that lie far apart, noise that may be singular or absent.
    struct Draw(Pcg64Mcg);

    impl Draw {
        fn below(&mut self, count: u64) -> u64 {
            self.0.next_u64() % count
        }

        fn entry(&mut self) -> Rational {
            let numerator = i64::try_from(self.below(13)).expect("small") - 6;
            ratio(numerator, i64::try_from(1 + self.below(4)).expect("small"))
        }

        fn matrix(&mut self, rows: usize, columns: usize) -> Matrix<Rational> {
            Matrix::from_fn(rows, columns, |_, _| self.entry())
        }

        fn units(&mut self, n: usize) -> Matrix<Rational> {
            let mut unit = || ratio(2, 1).pow(i32::try_from(self.below(61)).expect("small") - 30);
            Matrix::diagonal(&(0..n).map(|_| unit()).collect::<Vec<_>>())
        }

        fn path(&mut self) -> Path<Rational> {
            let n = usize::try_from(1 + self.below(3)).expect("small");
            let m = usize::try_from(1 + self.below(2)).expect("small");
            let (units, sensor_units) = (self.units(n), self.units(m));
            let back = Matrix::from_fn(n, n, |i, j| if i == j { units[(i, i)].recip() } else { Rational::zero() });
            let is_known = self.below(3) == 0;
            let initial = if is_known { Matrix::zeros(n, n) } else { &units * self.matrix(n, n) };
            let d = &units * self.matrix(n, 2);
            let f = if self.below(3) == 0 { Matrix::zeros(m, 2) } else { &sensor_units * self.matrix(m, 2) };
            let timing = if self.below(2) == 0 { Timing::Arriving } else { Timing::Departing };
            let before =
                if timing == Timing::Arriving && self.below(2) == 0 { Before::Transition } else { Before::Observation };
            let system = System {
                timing,
                initial: Initial::new(before, &units * self.matrix(n, 1), &initial * initial.transpose()),
                transition: (&units * self.matrix(n, n) * &back).into(),
                observation: (&sensor_units * self.matrix(m, n) * &back).into(),
                noise: Noise::Factors { process: d.into(), observation: f.into() },
                input: None,
                observation_input: None,
            };
            let readings: Vec<_> = (0..7)
                .map(|_| match self.below(6) {
                    0 => Observation::missing(m),
                    _ => Observation::complete((&sensor_units * self.matrix(m, 1)).entries().to_vec()),
                })
                .collect();
            system.realised(&readings).expect("a sound system")
        }
    }

    fn fractions(dyadics: &Packed) -> Matrix<Rational> {
        Matrix::from_fn(dyadics.rows(), dyadics.columns(), |i, j| dyadics.entry(i, j).value().expect("short"))
    }

    /// How many steps were enclosed, and whether the run ended before its path, each step compared with the exact one.
    fn compared(path: &Path<Rational>, mut steps: CertifiedFilter<'_>) -> Result<(usize, bool), String> {
        let records = match filter(path) {
            Ok(trace) => trace.records,
            Err(error) => error.computed,
        };
        let mut seen = 0;
        for k in 0..records.len() {
            let Some(Ok(_)) = steps.next() else { return Ok((seen, true)) };
            let exact = match path.timing() {
                Timing::Arriving => &records[k].filtered,
                Timing::Departing => match records.get(k + 1) {
                    Some(record) => &record.predicted,
                    None => break,
                },
            };
            let belief = steps.belief.as_ref().ok_or("no belief")?;
            let [covariance, gap, mean, ellipsoid] =
                [&belief.covariance, &belief.gap, &belief.mean, &belief.ellipsoid].map(fractions);
            let off = &exact.covariance - covariance;
            let error = &exact.mean - mean;
            let holds = off.loewner_le(&gap).is_ok()
                && (-&off).loewner_le(&gap).is_ok()
                && (&error * error.transpose()).loewner_le(&ellipsoid).is_ok();
            if !holds {
                return Err(format!("step {k}"));
            }
            seen += 1;
        }
        Ok((seen, false))
    }

    /// −W ≤ P − P̃ ≤ W and (x̂ − x̃)(x̂ − x̃)ᵀ ≤ E in the order of Loewner, decided exactly, along paths of all kinds and with
    /// bits that are far too few.
    #[test]
    fn beliefs_are_enclosed_in_the_order_of_loewner() {
        let (mut seen, mut undecided) = (0, 0);
        for seed in 0..400 {
            let mut draw = Draw(Pcg64Mcg::seed_from_u64(seed));
            let path = draw.path();
            let bits = [8, 14, 24, 53, 128][usize::try_from(draw.below(5)).expect("small")];
            let (steps, ended) =
                compared(&path, CertifiedFilter::new(&path, bits)).unwrap_or_else(|why| panic!("seed {seed}, {why}"));
            seen += steps;
            undecided += usize::from(ended);
        }
        assert!(seen > 1000 && undecided < 200, "{seen} enclosed, {undecided} undecided");
    }

    /// The same from a start of which little is known: P̃ is P₀ and a quarter, or less a quarter, where terms of second order
    /// count.
    #[test]
    fn wide_starts_are_enclosed() {
        let mut seen = 0;
        for seed in 0..400 {
            let mut draw = Draw(Pcg64Mcg::seed_from_u64(1000 + seed));
            let path = draw.path();
            let initial = path.initial();
            let gap = initial.covariance.scaled(&ratio(1, i64::from(4 << draw.below(4))));
            let middle = if draw.below(4) == 0 { &initial.covariance - &gap } else { &initial.covariance + &gap };
            let mut belief = Enclosed::of(&initial.mean, &middle, 53);
            let gap = Enclosed::of(&initial.mean, &gap, 53);
            belief.gap = belief.gap.plus(&gap.covariance).plus(&gap.gap);
            let start = CertifiedFilter { belief: Some(belief), ..CertifiedFilter::new(&path, 53) };
            seen += compared(&path, start).unwrap_or_else(|why| panic!("seed {seed}, {why}")).0;
        }
        assert!(seen > 500, "{seen}");
    }
}
