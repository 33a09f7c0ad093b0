//! The document of a question of stability: modes, how they follow each other, and a start.

use serde::{Deserialize, Serialize};

use super::document::{self, present};
use super::{Datum, InputError, Numbers};
use crate::matrix::Matrix;
use crate::scalar::Rational;

/// A system whose coefficients jump between finitely many modes.
///
/// What all modes share may stand beside them; a mode then says what it has of its own. Numbers are read exactly unless
/// the document says otherwise, so that probabilities such as 0.1 and 0.9 add up to one.
///
/// # Examples
///
/// ```
/// use exact_kalman::protocol::StabilityModel;
///
/// let model = StabilityModel::parse(r#"{"format": "exact-kalman/stability/1", "id": "link",
///     "transition": [["3/2"]], "process_noise": [["1"]], "observation_noise": [["1"]],
///     "modes": [{"name": "lost", "observation": [[0]]}, {"name": "received", "observation": [[1]]}],
///     "probabilities": ["0.25", "0.75"]}"#)?;
/// let lost = model.mode(0)?;
/// assert_eq!(lost.transition, model.mode(1)?.transition);
/// assert!(lost.observation.is_zero());
/// # Ok::<(), exact_kalman::protocol::InputError>(())
/// ```
#[derive(Clone, Debug, PartialEq, Eq, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct StabilityModel {
    /// The format and its version.
    pub format: StabilityFormat,
    /// The name.
    pub id: String,
    /// One sentence.
    #[serde(default)]
    pub about: String,
    /// What the number strings mean.
    #[serde(default = "exactly")]
    pub numbers: Numbers,
    /// F of the modes that give none.
    #[serde(default, deserialize_with = "present")]
    pub transition: Option<Vec<Vec<Datum>>>,
    /// H of the modes that give none.
    #[serde(default, deserialize_with = "present")]
    pub observation: Option<Vec<Vec<Datum>>>,
    /// Q of the modes that give none.
    #[serde(default, deserialize_with = "present")]
    pub process_noise: Option<Vec<Vec<Datum>>>,
    /// R of the modes that give none.
    #[serde(default, deserialize_with = "present")]
    pub observation_noise: Option<Vec<Vec<Datum>>>,
    /// The modes.
    pub modes: Vec<ModeDocument>,
    /// Their probabilities, if each is drawn anew.
    #[serde(default, deserialize_with = "present")]
    pub probabilities: Option<Vec<Datum>>,
    /// How one follows another, if they are a Markov chain.
    #[serde(default, deserialize_with = "present")]
    pub chain: Option<ChainDocument>,
    /// P(0); zero where none is given.
    #[serde(default, deserialize_with = "present")]
    pub initial_covariance: Option<Vec<Vec<Datum>>>,
}

/// The format of the document, with its version.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub enum StabilityFormat {
    /// The only version so far.
    #[serde(rename = "exact-kalman/stability/1")]
    One,
}

/// What a mode has of its own.
#[derive(Clone, Debug, PartialEq, Eq, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct ModeDocument {
    /// Its name.
    pub name: String,
    /// F, d×d.
    #[serde(default, deserialize_with = "present")]
    pub transition: Option<Vec<Vec<Datum>>>,
    /// H, m×d.
    #[serde(default, deserialize_with = "present")]
    pub observation: Option<Vec<Vec<Datum>>>,
    /// Q, d×d.
    #[serde(default, deserialize_with = "present")]
    pub process_noise: Option<Vec<Vec<Datum>>>,
    /// R, m×m.
    #[serde(default, deserialize_with = "present")]
    pub observation_noise: Option<Vec<Vec<Datum>>>,
}

/// A Markov chain.
#[derive(Clone, Debug, PartialEq, Eq, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct ChainDocument {
    /// The probabilities of the first mode.
    pub initial: Vec<Datum>,
    /// Row i holds the probabilities of the mode that follows mode i.
    pub transition: Vec<Vec<Datum>>,
}

/// The matrices of a mode, of shapes that fit; the covariances are some.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct ModeMatrices {
    /// F, d×d.
    pub transition: Matrix<Rational>,
    /// H, m×d.
    pub observation: Matrix<Rational>,
    /// Q, d×d.
    pub process_noise: Matrix<Rational>,
    /// R, m×m.
    pub observation_noise: Matrix<Rational>,
}

/// The probabilities of a process of modes.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct ChainMatrices {
    /// Of the first mode.
    pub initial: Vec<Rational>,
    /// Of the mode that follows each.
    pub transition: Matrix<Rational>,
}

fn exactly() -> Numbers {
    Numbers::Exact
}

impl StabilityModel {
    /// Reads one document.
    ///
    /// # Errors
    ///
    /// [`InputError`] with the place; also if there is no mode, or not exactly one way in which they follow each other.
    pub fn parse(text: &str) -> Result<Self, InputError> {
        let model: Self = document::parse_object(text)?;
        if model.modes.is_empty() {
            return Err(InputError::at("modes", "is empty: there is at least one"));
        }
        if model.probabilities.is_some() == model.chain.is_some() {
            return Err(InputError::at(
                "",
                "give either `probabilities` or `chain`; for a single mode, `probabilities` is [\"1\"]",
            ));
        }
        Ok(model)
    }

    /// The matrices of a mode.
    ///
    /// # Errors
    ///
    /// [`InputError`] with the place: a matrix that is neither its own nor shared, a shape that does not fit, a covariance
    /// that is none.
    ///
    /// # Panics
    ///
    /// If there is no such mode.
    pub fn mode(&self, index: usize) -> Result<ModeMatrices, InputError> {
        let own = &self.modes[index];
        let d = self.states()?;
        let (path, rows) = self.rows(index, "transition", own.transition.as_ref(), self.transition.as_ref())?;
        let transition = self.numbers.square(&path, rows, d)?;
        let (path, rows) = self.rows(index, "observation", own.observation.as_ref(), self.observation.as_ref())?;
        let observation = self.numbers.matrix(&path, rows, d)?;
        let (path, rows) =
            self.rows(index, "process_noise", own.process_noise.as_ref(), self.process_noise.as_ref())?;
        let process_noise = self.numbers.covariance(&path, rows, d)?;
        let noise = (own.observation_noise.as_ref(), self.observation_noise.as_ref());
        let (path, rows) = self.rows(index, "observation_noise", noise.0, noise.1)?;
        let observation_noise = self.numbers.covariance(&path, rows, observation.rows())?;
        Ok(ModeMatrices { transition, observation, process_noise, observation_noise })
    }

    /// d, as the first transition says.
    fn states(&self) -> Result<usize, InputError> {
        let (path, rows) = self.rows(0, "transition", self.modes[0].transition.as_ref(), self.transition.as_ref())?;
        if rows.is_empty() { Err(InputError::at(path, "is empty")) } else { Ok(rows.len()) }
    }

    fn rows<'a>(
        &self,
        index: usize,
        name: &str,
        own: Option<&'a Vec<Vec<Datum>>>,
        shared: Option<&'a Vec<Vec<Datum>>>,
    ) -> Result<(String, &'a Vec<Vec<Datum>>), InputError> {
        let place = format!("modes[{index}].{name}");
        let missing = || {
            let message =
                format!("is missing: give it in the mode {:?}, or beside the modes for all", self.modes[index].name);
            InputError::at(place.clone(), message)
        };
        own.map(|rows| (place.clone(), rows)).or(shared.map(|rows| (name.to_owned(), rows))).ok_or_else(missing)
    }

    /// How the modes follow each other; whether the numbers are probabilities is not checked here.
    ///
    /// # Errors
    ///
    /// [`InputError`] with the place.
    pub fn probabilities(&self) -> Result<ChainMatrices, InputError> {
        let count = self.modes.len();
        if let Some(chain) = &self.chain {
            let initial = self.numbers.column("chain.initial", &chain.initial, count)?.entries().to_vec();
            let transition = self.numbers.square("chain.transition", &chain.transition, count)?;
            return Ok(ChainMatrices { initial, transition });
        }
        let given = self.probabilities.as_deref().unwrap_or_default();
        let initial = self.numbers.column("probabilities", given, count)?.entries().to_vec();
        let transition = Matrix::from_fn(count, count, |_, mode| initial[mode].clone());
        Ok(ChainMatrices { initial, transition })
    }

    /// P(0), d×d.
    ///
    /// # Errors
    ///
    /// [`InputError`] with the place.
    pub fn initial_covariance(&self) -> Result<Matrix<Rational>, InputError> {
        let d = self.states()?;
        match &self.initial_covariance {
            Some(rows) => self.numbers.covariance("initial_covariance", rows, d),
            None => Ok(Matrix::zeros(d, d)),
        }
    }
}
