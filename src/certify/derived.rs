//! What follows from an enclosed step and is computed only if it is asked for.

use super::enclosed::Enclosed;
use super::gain::Weights;
use super::grid::BOUND_BITS;
use super::innovation::Innovation;
use super::law::{Data, Law};
use super::likelihood::{EnclosedLikelihood, Likelihoods};
use crate::matrix::Matrix;
use crate::model::Step;
use crate::scalar::{Interval, Rational};
use crate::trace::{Moments, Quantity, Values};

/// What is asked for beside the values of a step; each entry lies in its interval.
#[derive(Clone, Debug, Default)]
pub struct Derived {
    /// E(y_k | y_0, …, y_{k−1})
    pub predicted_observation: Option<Matrix<Interval>>,
    /// cov(x_k, y_k | y_0, …, y_{k−1})
    pub cross_covariance: Option<Matrix<Interval>>,
    /// K = cov(x_k, y_k) S⁺
    pub gain: Option<Matrix<Interval>>,
    /// The parts of the log likelihood of y_k.
    pub likelihood: Option<EnclosedLikelihood>,
    /// The laws of the next states given y_0, …, y_k, as far as there are transitions.
    pub ahead: Vec<Moments<Interval>>,
}

/// What is kept from step to step where everything is asked for.
#[derive(Debug)]
pub(super) struct Asked {
    likelihoods: Likelihoods,
    bits: u64,
}

impl Asked {
    pub(super) fn new(bits: u64) -> Option<Self> {
        Some(Self { likelihoods: Likelihoods::new(bits)?, bits })
    }

    /// What follows from a reading with this innovation.
    pub(super) fn of(
        &mut self,
        belief: &Enclosed,
        law: &Law,
        data: &Data,
        innovation: &Innovation,
        step: &Step<Rational>,
        value: &Matrix<Interval>,
    ) -> Derived {
        let weights = Weights::of(belief, law, &law.filtered, innovation, self.bits);
        Derived {
            predicted_observation: Some(self.expected(step, value)),
            cross_covariance: Some(weights.cross_covariance),
            gain: Some(weights.gain),
            likelihood: self.likelihoods.of(belief, law, data, innovation),
            ahead: Vec::new(),
        }
    }

    /// What follows where nothing is read, or nothing but zeros without noise.
    pub(super) fn of_nothing(&mut self, step: &Step<Rational>) -> Derived {
        let (n, m) = (step.observation.columns(), step.reading.present().len());
        let likelihood = Some(self.likelihoods.of_nothing(m > 0));
        if m == 0 {
            return Derived { likelihood, ..Derived::default() };
        }
        let zeros = |rows, columns| Matrix::from_fn(rows, columns, |_, _| Interval::zero());
        Derived {
            predicted_observation: Some(self.expected(step, &zeros(m, 1))),
            cross_covariance: Some(zeros(n, m)),
            gain: Some(zeros(n, m)),
            likelihood,
            ahead: Vec::new(),
        }
    }

    /// y − ν
    fn expected(&self, step: &Step<Rational>, innovation: &Matrix<Interval>) -> Matrix<Interval> {
        let (values, bits) = (step.reading.values(), self.bits + BOUND_BITS);
        Matrix::from_fn(innovation.rows(), 1, |i, _| {
            Interval::of(&values[(i, 0)], bits).minus(&innovation[(i, 0)], bits)
        })
    }
}

impl Derived {
    /// Puts what has a name among the values.
    pub(super) fn name_into(&self, values: &mut Values<Interval>) {
        values.extend(self.gain.clone().map(|gain| (Quantity::Gain, gain)));
        let log = self.likelihood.as_ref().and_then(|likelihood| likelihood.log_likelihood.clone());
        values.extend(log.map(|log| (Quantity::LogLikelihood, Matrix::column(vec![log]))));
    }
}
