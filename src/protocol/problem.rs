//! From literals to the exact model they mean.

use std::num::NonZero;

use super::fault::{Fault, indexed};
use super::{Along, Case, CaseError, Entry, InputTerm, Matrices, NoiseLaw, Numbers, Rows, Vectors};
use crate::matrix::Matrix;
use crate::model::{Coefficient, Initial, Input, Noise, Observation, Path, PathAhead, System};
use crate::scalar::Rational;

/// The exact model and observations that a case means; nothing about them is checked yet.
#[derive(Clone, Debug)]
pub struct Problem {
    /// The system.
    pub system: System<Rational>,
    /// The observations.
    pub observations: Vec<Observation<Rational>>,
}

impl Problem {
    /// The checked path that filters work on.
    ///
    /// # Errors
    ///
    /// [`CaseError::Model`].
    pub fn realised(&self) -> Result<Path<Rational>, CaseError> {
        Ok(self.system.realised(&self.observations)?)
    }

    /// The checked path that predictors work on; its lists of transitions may go on beyond the last observation.
    ///
    /// # Errors
    ///
    /// [`CaseError::Model`].
    pub fn realised_ahead(&self, steps_ahead: NonZero<usize>) -> Result<PathAhead<Rational>, CaseError> {
        Ok(self.system.realised_ahead(&self.observations, steps_ahead)?)
    }
}

impl Case {
    /// The exact model and observations that the literals mean.
    ///
    /// # Errors
    ///
    /// [`CaseError::Number`] or [`CaseError::Ragged`], with the path.
    pub fn problem(&self) -> Result<Problem, CaseError> {
        let reader = Reader(self.numbers);
        let law = &self.initial;
        let initial = Initial {
            before: law.before,
            mean: reader.vector(&law.mean).map_err(|fault| fault.in_field("initial.mean"))?,
            covariance: reader.matrix(&law.covariance).map_err(|fault| fault.in_field("initial.covariance"))?,
            diffuse: (law.diffuse.as_ref())
                .map(|part| reader.matrix(part).map_err(|fault| fault.in_field("initial.diffuse")))
                .transpose()?,
            allow_indefinite: law.allow_indefinite,
        };
        let system = System {
            timing: self.timing,
            initial,
            transition: reader.matrices("transition", &self.transition)?,
            observation: reader.matrices("observation", &self.observation)?,
            noise: reader.noise(&self.noise)?,
            input: reader.input("input", self.input.as_ref())?,
            observation_input: reader.input("observation_input", self.observation_input.as_ref())?,
        };
        Ok(Problem { system, observations: self.readings(reader)? })
    }

    fn readings(&self, reader: Reader) -> Result<Vec<Observation<Rational>>, CaseError> {
        let sensors = self.sensors();
        let reading = |reading: &Option<Vec<Option<Entry>>>| match reading {
            None => Ok(Observation::missing(sensors)),
            Some(entries) => {
                let value = |entry: &Option<Entry>| entry.as_ref().map(|entry| reader.number(entry)).transpose();
                indexed(entries, value).map(Observation::new)
            }
        };
        indexed(&self.observations, reading).map_err(|fault| fault.in_field("observations"))
    }

    /// The dimension of a reading that is wholly missing: that of the first which is not, else the rows of the
    /// observation matrix.
    pub(crate) fn sensors(&self) -> usize {
        let rows = match &self.observation {
            Along::Constant(rows) => Some(rows.len()),
            Along::PerStep(steps) => steps.iter().flatten().map(Vec::len).next(),
        };
        self.observations.iter().flatten().map(Vec::len).next().or(rows).unwrap_or(0)
    }
}

/// Reads literals by one meaning.
#[derive(Clone, Copy)]
struct Reader(Numbers);

impl Reader {
    fn number(self, entry: &Entry) -> Result<Rational, Fault> {
        self.0.read_finite(entry.as_str()).map_err(Fault::number)
    }

    fn vector(self, entries: &[Entry]) -> Result<Matrix<Rational>, Fault> {
        indexed(entries, |entry| self.number(entry)).map(Matrix::column)
    }

    fn matrix(self, rows: &Rows) -> Result<Matrix<Rational>, Fault> {
        let rows = indexed(rows, |row| indexed(row, |entry| self.number(entry)))?;
        Matrix::from_rows(rows).map_err(Fault::ragged)
    }

    fn along<T>(
        name: &str,
        values: &Along<T>,
        value: impl Fn(&T) -> Result<Matrix<Rational>, Fault>,
    ) -> Result<Coefficient<Rational>, CaseError> {
        let coefficient = match values {
            Along::Constant(constant) => value(constant).map(Coefficient::Constant),
            Along::PerStep(steps) => {
                indexed(steps, |step| step.as_ref().map(&value).transpose()).map(Coefficient::PerStep)
            }
        };
        coefficient.map_err(|fault| fault.in_field(name))
    }

    fn matrices(self, name: &str, matrices: &Matrices) -> Result<Coefficient<Rational>, CaseError> {
        Self::along(name, matrices, |rows| self.matrix(rows))
    }

    fn vectors(self, name: &str, vectors: &Vectors) -> Result<Coefficient<Rational>, CaseError> {
        Self::along(name, vectors, |entries| self.vector(entries))
    }

    fn noise(self, noise: &NoiseLaw) -> Result<Noise<Rational>, CaseError> {
        Ok(match noise {
            NoiseLaw::Covariances { process, cross, observation } => Noise::Covariances {
                process: self.matrices("noise.process", process)?,
                cross: cross.as_ref().map(|cross| self.matrices("noise.cross", cross)).transpose()?,
                observation: self.matrices("noise.observation", observation)?,
            },
            NoiseLaw::Factors { process, observation } => Noise::Factors {
                process: self.matrices("noise.process_factor", process)?,
                observation: self.matrices("noise.observation_factor", observation)?,
            },
        })
    }

    fn input(self, name: &str, term: Option<&InputTerm>) -> Result<Option<Input<Rational>>, CaseError> {
        let Some(InputTerm { matrix, vector }) = term else { return Ok(None) };
        let matrix = matrix.as_ref().map(|matrix| self.matrices(&format!("{name}.matrix"), matrix)).transpose()?;
        Ok(Some(Input { matrix, vector: self.vectors(&format!("{name}.vector"), vector)? }))
    }
}
