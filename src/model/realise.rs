//! Evaluates a system along observations and checks the result.

use super::error::Place;
use super::{
    Before, Coefficient, Field, Initial, Input, ModelError, Noise, Observation, Past, Path, Step, System, Timing,
    Transition,
};
use crate::matrix::{LdlError, Matrix, Shape};
use crate::scalar::OrderedField;

impl<S: OrderedField> System<S> {
    /// The system along the given observations, every matrix evaluated and checked.
    ///
    /// Assumptions: A1 (noise covariances positive semidefinite), A2 (so is the initial covariance), A3 (adapted
    /// coefficients see only the past), A4 (they are finite there).
    ///
    /// # Errors
    ///
    /// [`ModelError`] with the place, and a vector v with vᵀPv < 0 where a covariance is indefinite.
    pub fn realised(&self, observations: &[Observation<S>]) -> Result<Path<S>, ModelError<S>> {
        Realisation::of(self, observations, 1)?.path()
    }
}

/// A transition, if there is one, and the observation noise R of the same index.
type TransitionWithNoise<S> = (Option<Transition<S>>, Matrix<S>);

/// The blocks Q, DFᵀ and R of the joint noise covariance.
type JointNoise<S> = (Matrix<S>, Matrix<S>, Matrix<S>);

#[derive(Debug)]
pub(super) struct Realisation<'a, S> {
    system: &'a System<S>,
    observations: &'a [Observation<S>],
    states: usize,
    sensors: usize,
    /// d: the transition into x_s is shown y_0, …, y_{s−d}.
    ahead: usize,
}

impl<'a, S: OrderedField> Realisation<'a, S> {
    pub(super) fn of(
        system: &'a System<S>,
        observations: &'a [Observation<S>],
        ahead: usize,
    ) -> Result<Self, ModelError<S>> {
        let states = system.initial.mean.rows();
        let sensors = observations.first().map_or(0, Observation::dimension);
        if states == 0 {
            return Err(ModelError::Empty(Field::InitialMean));
        }
        if sensors == 0 {
            return Err(ModelError::Empty(Field::Observations));
        }
        if system.timing == Timing::Departing && system.initial.before == Before::Transition {
            return Err(ModelError::NoTransitionBefore);
        }
        let realisation = Self { system, observations, states, sensors, ahead };
        for (k, observation) in observations.iter().enumerate() {
            let found = Shape { rows: observation.dimension(), columns: 1 };
            realisation.check_shape(Field::Observations, Some(k), found, (sensors, 1))?;
        }
        realisation.check_lengths()?;
        Ok(realisation)
    }

    /// The checked path.
    pub(super) fn path(&self) -> Result<Path<S>, ModelError<S>> {
        self.check_initial()?;
        let steps = (0..self.observations.len()).map(|k| self.step(k)).collect::<Result<_, _>>()?;
        Ok(Path::semidefinite(self.system.timing, self.system.initial.clone(), steps))
    }

    fn check_lengths(&self) -> Result<(), ModelError<S>> {
        let expected = self.observations.len();
        for (field, coefficient) in self.system.coefficients() {
            let moves = matches!(
                field,
                Field::Transition | Field::ProcessFactor | Field::ProcessNoise | Field::InputMatrix | Field::Input
            );
            // What lies beyond the reach of a predictor is not evaluated.
            if let Coefficient::PerStep(values) = coefficient
                && (values.len() < expected || !moves && values.len() > expected)
            {
                return Err(ModelError::Length { field, expected, may_go_on: moves, found: values.len() });
            }
        }
        Ok(())
    }

    fn check_shape(
        &self,
        field: Field,
        step: Option<usize>,
        found: Shape,
        (rows, columns): (usize, usize),
    ) -> Result<(), ModelError<S>> {
        let expected = Shape { rows, columns };
        if found == expected {
            return Ok(());
        }
        let place = Place { field, step };
        Err(ModelError::Shape { place, expected, found, states: self.states, sensors: self.sensors })
    }

    pub(super) fn check_initial(&self) -> Result<(), ModelError<S>> {
        let Initial { mean, covariance, diffuse, allow_indefinite, .. } = &self.system.initial;
        let n = self.states;
        self.check_shape(Field::InitialMean, None, mean.shape(), (n, 1))?;
        self.check_shape(Field::InitialCovariance, None, covariance.shape(), (n, n))?;
        match check_covariance(Field::InitialCovariance, None, covariance) {
            // The series of a diffuse start rest on semidefiniteness.
            Err(ModelError::Indefinite { .. }) if *allow_indefinite && diffuse.is_some() => {
                return Err(ModelError::IndefiniteAndDiffuse);
            }
            Err(ModelError::Indefinite { .. }) if *allow_indefinite => {}
            outcome => outcome?,
        }
        if let Some(diffuse) = diffuse {
            self.check_shape(Field::InitialDiffuse, None, diffuse.shape(), (n, n))?;
            check_covariance(Field::InitialDiffuse, None, diffuse)?;
        }
        Ok(())
    }

    pub(super) fn step(&self, k: usize) -> Result<Step<S>, ModelError<S>> {
        let (n, m) = (self.states, self.sensors);
        let seen = self.past_of_observation(k);
        let observation = evaluated(Field::Observation, &self.system.observation, k, seen)?;
        self.check_shape(Field::Observation, Some(k), observation.shape(), (m, n))?;
        let fields = (Field::ObservationInputMatrix, Field::ObservationInput);
        let observation_input = self.input(fields, self.system.observation_input.as_ref(), k, seen, m)?;
        let (transition, observation_noise) = self.transition_with_noise(k)?;
        let reading = self.observations[k].clone();
        Ok(Step { transition, observation, observation_input, observation_noise, reading })
    }

    fn transition_with_noise(&self, k: usize) -> Result<TransitionWithNoise<S>, ModelError<S>> {
        if !self.has_transition(k) {
            let observation_noise = self.observation_noise(k)?;
            return Ok((None, observation_noise));
        }
        let (matrix, input) = self.motion(k)?;
        let (noise, cross_noise, observation_noise) = self.joint_noise(k)?;
        Ok((Some(Transition { matrix, input, noise, cross_noise }), observation_noise))
    }

    /// Transition k, beyond the last observation; nothing if a list has no entry for it.
    pub(super) fn transition_beyond(&self, k: usize) -> Result<Option<Transition<S>>, ModelError<S>> {
        // No reading shares its noise with this transition.
        let mut needed = self.system.transition_fields().filter(|(field, _)| *field != Field::CrossNoise);
        if !needed.all(|(_, coefficient)| coefficient.has(k)) {
            return Ok(None);
        }
        let (matrix, input) = self.motion(k)?;
        let noise = match &self.system.noise {
            Noise::Factors { process, .. } => {
                let d = evaluated(Field::ProcessFactor, process, k, self.past_of_transition(k))?;
                self.check_shape(Field::ProcessFactor, Some(k), d.shape(), (self.states, d.columns()))?;
                &d * d.transpose()
            }
            Noise::Covariances { process, .. } => self.process_noise(k, process)?,
        };
        Ok(Some(Transition { matrix, input, noise, cross_noise: Matrix::zeros(self.states, self.sensors) }))
    }

    /// A and B u.
    fn motion(&self, k: usize) -> Result<(Matrix<S>, Matrix<S>), ModelError<S>> {
        let (n, seen) = (self.states, self.past_of_transition(k));
        let matrix = evaluated(Field::Transition, &self.system.transition, k, seen)?;
        self.check_shape(Field::Transition, Some(k), matrix.shape(), (n, n))?;
        let fields = (Field::InputMatrix, Field::Input);
        let input = self.input(fields, self.system.input.as_ref(), k, seen, n)?;
        Ok((matrix, input))
    }

    /// Whether transition k exists. The one that no observation depends on may be left out.
    fn has_transition(&self, k: usize) -> bool {
        match self.system.timing {
            Timing::Arriving => k > 0 || self.system.initial.before == Before::Transition,
            Timing::Departing => {
                k + 1 < self.observations.len()
                    || self.system.transition_fields().all(|(_, coefficient)| coefficient.has(k))
            }
        }
    }

    fn past_of_observation(&self, k: usize) -> Past<'a, S> {
        Past::new(k, &self.observations[..k])
    }

    /// What the transition with index k is shown: y_0, …, y_{s−d} if it leads into x_s.
    fn past_of_transition(&self, k: usize) -> Past<'a, S> {
        let state = match self.system.timing {
            Timing::Arriving => k,
            Timing::Departing => k + 1,
        };
        Past::new(k, &self.observations[..(state + 1).saturating_sub(self.ahead)])
    }

    fn input(
        &self,
        (matrix_field, vector_field): (Field, Field),
        input: Option<&Input<S>>,
        k: usize,
        past: Past<'_, S>,
        rows: usize,
    ) -> Result<Matrix<S>, ModelError<S>> {
        let Some(Input { matrix, vector }) = input else {
            return Ok(Matrix::zeros(rows, 1));
        };
        let vector = evaluated(vector_field, vector, k, past)?;
        let Some(matrix) = matrix else {
            self.check_shape(vector_field, Some(k), vector.shape(), (rows, 1))?;
            return Ok(vector);
        };
        let matrix = evaluated(matrix_field, matrix, k, past)?;
        self.check_shape(matrix_field, Some(k), matrix.shape(), (rows, matrix.columns()))?;
        self.check_shape(vector_field, Some(k), vector.shape(), (matrix.columns(), 1))?;
        Ok(matrix * vector)
    }

    fn observation_noise(&self, k: usize) -> Result<Matrix<S>, ModelError<S>> {
        let m = self.sensors;
        let seen = self.past_of_observation(k);
        match &self.system.noise {
            Noise::Factors { observation, .. } => {
                let factor = self.observation_factor(k, observation)?;
                Ok(&factor * factor.transpose())
            }
            Noise::Covariances { observation, .. } => {
                let covariance = evaluated(Field::ObservationNoise, observation, k, seen)?;
                self.check_shape(Field::ObservationNoise, Some(k), covariance.shape(), (m, m))?;
                check_covariance(Field::ObservationNoise, Some(k), &covariance)?;
                Ok(covariance)
            }
        }
    }

    fn observation_factor(&self, k: usize, observation: &Coefficient<S>) -> Result<Matrix<S>, ModelError<S>> {
        let factor = evaluated(Field::ObservationFactor, observation, k, self.past_of_observation(k))?;
        self.check_shape(Field::ObservationFactor, Some(k), factor.shape(), (self.sensors, factor.columns()))?;
        Ok(factor)
    }

    fn process_noise(&self, k: usize, process: &Coefficient<S>) -> Result<Matrix<S>, ModelError<S>> {
        let (n, seen) = (self.states, self.past_of_transition(k));
        let process = evaluated(Field::ProcessNoise, process, k, seen)?;
        self.check_shape(Field::ProcessNoise, Some(k), process.shape(), (n, n))?;
        check_covariance(Field::ProcessNoise, Some(k), &process)?;
        Ok(process)
    }

    fn joint_noise(&self, k: usize) -> Result<JointNoise<S>, ModelError<S>> {
        let (n, m) = (self.states, self.sensors);
        let seen = self.past_of_transition(k);
        match &self.system.noise {
            Noise::Factors { process, observation } => {
                // One F for both products: a rule need not answer alike when it is asked twice.
                let f = self.observation_factor(k, observation)?;
                let d = evaluated(Field::ProcessFactor, process, k, seen)?;
                self.check_shape(Field::ProcessFactor, Some(k), d.shape(), (n, f.columns()))?;
                Ok((&d * d.transpose(), d * f.transpose(), &f * f.transpose()))
            }
            Noise::Covariances { process, cross, .. } => {
                let observation_noise = self.observation_noise(k)?;
                let process = self.process_noise(k, process)?;
                let Some(cross) = cross else {
                    return Ok((process, Matrix::zeros(n, m), observation_noise));
                };
                let cross = evaluated(Field::CrossNoise, cross, k, seen)?;
                self.check_shape(Field::CrossNoise, Some(k), cross.shape(), (n, m))?;
                let joint = process.beside(&cross).above(&cross.transpose().beside(&observation_noise));
                check_covariance(Field::JointNoise, Some(k), &joint)?;
                Ok((process, cross, observation_noise))
            }
        }
    }
}

fn evaluated<S: Clone>(
    field: Field,
    coefficient: &Coefficient<S>,
    k: usize,
    past: Past<'_, S>,
) -> Result<Matrix<S>, ModelError<S>> {
    let place = Place { field, step: Some(k) };
    match coefficient {
        Coefficient::Constant(matrix) => Ok(matrix.clone()),
        Coefficient::PerStep(values) => values[k].clone().ok_or(ModelError::Absent { place }),
        Coefficient::Adapted(rule) => rule(past).map_err(|source| ModelError::Infinite { place, source }),
    }
}

fn check_covariance<S: OrderedField>(
    field: Field,
    step: Option<usize>,
    matrix: &Matrix<S>,
) -> Result<(), ModelError<S>> {
    let place = Place { field, step };
    match matrix.ldl() {
        Ok(_) => Ok(()),
        Err(LdlError::Asymmetric { row, column }) => Err(ModelError::Asymmetric { place, row, column }),
        Err(LdlError::Indefinite(proof)) => Err(ModelError::Indefinite { place, matrix: matrix.clone(), proof }),
    }
}

impl<S> Coefficient<S> {
    fn has(&self, k: usize) -> bool {
        !matches!(self, Self::PerStep(values) if values.get(k).is_none_or(Option::is_none))
    }
}

impl<S> System<S> {
    /// The coefficients that make up a transition.
    fn transition_fields(&self) -> impl Iterator<Item = (Field, &Coefficient<S>)> {
        let (process, cross) = match &self.noise {
            Noise::Factors { process, .. } => ((Field::ProcessFactor, process), None),
            Noise::Covariances { process, cross, .. } => ((Field::ProcessNoise, process), cross.as_ref()),
        };
        [(Field::Transition, &self.transition), process]
            .into_iter()
            .chain(cross.map(|cross| (Field::CrossNoise, cross)))
            .chain(self.input.iter().flat_map(|input| {
                input.matrix.iter().map(|b| (Field::InputMatrix, b)).chain([(Field::Input, &input.vector)])
            }))
    }

    /// All coefficients, with their names.
    fn coefficients(&self) -> impl Iterator<Item = (Field, &Coefficient<S>)> {
        let observation = match &self.noise {
            Noise::Factors { observation, .. } => (Field::ObservationFactor, observation),
            Noise::Covariances { observation, .. } => (Field::ObservationNoise, observation),
        };
        self.transition_fields().chain([(Field::Observation, &self.observation), observation]).chain(
            self.observation_input.iter().flat_map(|input| {
                let matrix = input.matrix.iter().map(|g| (Field::ObservationInputMatrix, g));
                matrix.chain([(Field::ObservationInput, &input.vector)])
            }),
        )
    }
}
