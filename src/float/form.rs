//! The forms by name.

use std::fmt;

use super::ahead::{self, Predict};
use super::error::FloatError;
use super::information::Information;
use super::joseph::Joseph;
use super::pseudo_inverse::PseudoInverse;
use super::recursion::{self, Recursion};
use super::sequential::Sequential;
use super::square_root::SquareRoot;
use super::svd::Svd;
use super::symmetrised::Symmetrised;
use super::textbook::Textbook;
use super::ud::Ud;
use crate::model::{Path, PathAhead};
use crate::trace::{Moments, Values};

/// A form of the recursion: the same numbers on paper, others in `f64`.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
#[non_exhaustive]
pub enum Form {
    /// The inverse of S, and (I − KC)P.
    Textbook,
    /// The gain by solving, and (I − KC)P(I − KC)ᵀ + KRKᵀ.
    Joseph,
    /// The pseudo-inverse of S, and (I − KC)P.
    PseudoInverse,
    /// The inverse of S, and (I − KC)P, of which the symmetric part is kept.
    Symmetrised,
    /// One scalar reading after the other.
    Sequential,
    /// A square root of P, by reflections.
    SquareRoot,
    /// P = U D Uᵀ, by weighted Gram–Schmidt.
    Ud,
    /// P = V D² Vᵀ, by rotations.
    Svd,
    /// P⁻¹.
    Information,
}

/// A filter: the values of each step, or where it stopped.
type Run = fn(&Path<f64>) -> Result<Vec<Values<f64>>, FloatError>;

/// What is known of a form, in one place.
struct Card {
    name: &'static str,
    description: &'static str,
    run: Run,
    predict: Predict,
}

impl Card {
    const fn of<R: Recursion>() -> Self {
        Self { name: R::NAME, description: R::DESCRIPTION, run: recursion::run::<R>, predict: ahead::run::<R> }
    }
}

impl Form {
    /// Every form, in order.
    pub const ALL: [Self; 9] = [
        Self::Textbook,
        Self::Joseph,
        Self::PseudoInverse,
        Self::Symmetrised,
        Self::Sequential,
        Self::SquareRoot,
        Self::Ud,
        Self::Svd,
        Self::Information,
    ];

    /// The name: words, joined by hyphens.
    pub const fn name(self) -> &'static str {
        self.card().name
    }

    /// What it does, in one line.
    pub const fn description(self) -> &'static str {
        self.card().description
    }

    const fn card(self) -> Card {
        match self {
            Self::Textbook => Card::of::<Textbook>(),
            Self::Joseph => Card::of::<Joseph>(),
            Self::PseudoInverse => Card::of::<PseudoInverse>(),
            Self::Symmetrised => Card::of::<Symmetrised>(),
            Self::Sequential => Card::of::<Sequential>(),
            Self::SquareRoot => Card::of::<SquareRoot>(),
            Self::Ud => Card::of::<Ud>(),
            Self::Svd => Card::of::<Svd>(),
            Self::Information => Card::of::<Information>(),
        }
    }
}

impl fmt::Display for Form {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.pad(self.name())
    }
}

/// The filter along a path in the given form: one entry per observation, each with the predicted and the
/// filtered moments and, if anything was observed, the innovation, its covariance and the gain.
///
/// # Errors
///
/// [`FloatError`] with the step, and what was computed before it.
///
/// # Examples
///
/// Half the variance is left after one reading as noisy as the prior:
///
/// ```
/// use exact_kalman::float::{filter, Form};
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
/// let path = walk.realised(&[Observation::complete([ratio(3, 1)])])?;
/// // Three integers: their nearest doubles are themselves.
/// let path = path.try_map(|value| value.to_string().parse::<f64>())?;
/// let values = filter(Form::Joseph, &path)?;
/// assert_eq!(values[0][&Quantity::FilteredMean], Matrix::column(vec![1.5]));
/// assert_eq!(values[0][&Quantity::FilteredCovariance], Matrix::column(vec![0.5]));
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
pub fn filter(form: Form, path: &Path<f64>) -> Result<Vec<Values<f64>>, FloatError> {
    (form.card().run)(path)
}

/// The laws of the next d states given the readings so far, for each reading, in the given form: the belief of the filter,
/// moved on by the transitions that follow, as far as there are any.
///
/// # Errors
///
/// [`FloatError`] with the step, and the values of the filter before it.
///
/// # Examples
///
/// A random walk is expected where it is, and its variance grows by one a step:
///
/// ```
/// use std::num::NonZero;
/// use exact_kalman::float::{predict_ahead, Form};
/// use exact_kalman::matrix::Matrix;
/// use exact_kalman::model::{Before, Initial, Noise, Observation, System, Timing};
/// use exact_kalman::scalar::{ratio, Rational};
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
/// let path = walk.realised_ahead(&[Observation::complete([ratio(3, 1)])], NonZero::new(2).ok_or("zero")?)?;
/// let path = path.try_map(|value| value.to_string().parse::<f64>())?;
/// let laws = &predict_ahead(Form::Joseph, &path)?[0];
/// assert_eq!([&laws[0].covariance, &laws[1].covariance], [1.5, 2.5].map(|v| Matrix::column(vec![v])).each_ref());
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
pub fn predict_ahead(form: Form, path: &PathAhead<f64>) -> Result<Vec<Vec<Moments<f64>>>, FloatError> {
    (form.card().predict)(path)
}
