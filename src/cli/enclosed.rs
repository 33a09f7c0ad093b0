//! What `solve` shows of a step that is enclosed.

use super::shown::Shown;
use crate::certify::{CertifiedStep, Derived, Digits, EnclosedLikelihood};
use crate::matrix::Matrix;
use crate::protocol::Decimal;
use crate::scalar::{Interval, Rational};
use crate::trace::{Moments, Values};

impl Shown<Digits> {
    /// What is shown of an enclosed step, to so many digits.
    pub(super) fn enclosed(step: &CertifiedStep, digits: u32) -> Self {
        let matrix = |matrix: &Matrix<Interval>| matrix.map(|entry| Digits::of(entry, digits));
        let number = |number: &Interval| matrix(&Matrix::column(vec![number.clone()]));
        let Derived { predicted_observation, cross_covariance, likelihood, ahead, .. } = &step.derived;
        let mut more = Vec::new();
        let mut add = |name: &str, matrix: Matrix<Digits>| more.push((name.to_owned(), matrix));
        if let Some(observation) = predicted_observation {
            add("predicted observation", matrix(observation));
        }
        if let Some(cross) = cross_covariance {
            add("cross covariance", matrix(cross));
        }
        if let Some(EnclosedLikelihood { quadratic, pseudo_determinant, sum, .. }) = likelihood {
            if predicted_observation.is_some() {
                let rank = Rational::from_integer(step.innovation_rank.into());
                let rank = Digits::Proved(Decimal::rounded(&rank, digits.max(20)));
                add("rank of the innovation covariance", Matrix::column(vec![rank]));
                add("likelihood: quadratic form", number(quadratic));
                add("likelihood: pseudo-determinant", number(pseudo_determinant));
            }
            if let Some(sum) = sum {
                add("log likelihood, sum up to here", number(sum));
            }
        }
        let law = |law: &Moments<Interval>| Moments {
            mean: matrix(&law.mean),
            covariance: matrix(&law.covariance),
            diffuse: None,
        };
        Self {
            values: step.values.iter().map(|(&quantity, values)| (quantity, matrix(values))).collect(),
            more,
            ahead: ahead.iter().map(law).collect(),
        }
    }

    /// What is proved: quantities of which some entry is not are left out, and so are laws ahead from the first such one on.
    pub(super) fn proved(self) -> Shown<Decimal> {
        let values = self.values.iter().filter_map(|(&quantity, values)| Some((quantity, decimals(values)?)));
        let law = |law: &Moments<Digits>| {
            Some(Moments { mean: decimals(&law.mean)?, covariance: decimals(&law.covariance)?, diffuse: None })
        };
        Shown {
            values: values.collect::<Values<Decimal>>(),
            more: Vec::new(),
            ahead: self.ahead.iter().map_while(law).collect(),
        }
    }
}

fn decimals(matrix: &Matrix<Digits>) -> Option<Matrix<Decimal>> {
    let decimal = |digits: &Digits| match digits {
        Digits::Proved(decimal) => Ok(decimal.clone()),
        Digits::Within { .. } => Err(()),
    };
    matrix.try_map(decimal).ok()
}
