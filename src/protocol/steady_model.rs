//! The document of a question about a steady state: one time-invariant system, or one equation of control.

use serde::Deserialize;
use serde_json::{Value, json};

use super::document::{self, present};
use super::{Along, Case, Datum, Entry, InputError, Matrices, NoiseLaw, Numbers};
use crate::matrix::Matrix;
use crate::model::{Observation, Step, Timing, Transition, UnifiedStep};
use crate::scalar::Rational;

/// A model with constant matrices, whose numbers are exact.
///
/// A document of the format `exact-kalman/steady/1` has the names of a case (`timing`, `transition`, `observation`, `noise`),
/// or `control` with the matrices a, b, q, r and s of its equation; its decimals mean themselves unless `numbers` says otherwise. A
/// case is read as well, if its matrices are constant: what it knows beside them is left alone.
///
/// # Examples
///
/// ```
/// use exact_kalman::protocol::SteadyModel;
/// use exact_kalman::scalar::ratio;
///
/// let model = SteadyModel::parse(r#"{"format": "exact-kalman/steady/1", "id": "walk", "timing": "departing",
///     "transition": [[1]], "observation": [[1]], "noise": {"process": [["1e-30"]], "observation": [["0.1"]]}}"#)?;
/// assert_eq!(model.unified().observation_noise[(0, 0)], ratio(1, 10));
/// # Ok::<(), exact_kalman::protocol::InputError>(())
/// ```
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct SteadyModel {
    /// The name.
    pub id: String,
    /// One sentence.
    pub about: String,
    /// What is asked about.
    pub equation: SteadyEquation,
}

/// The matrices, of shapes that fit; those that ought to be symmetric are. Whether noise is positive semidefinite is not
/// asked here.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum SteadyEquation {
    /// Of a filter.
    Filter {
        /// Which transition shares noise with which observation.
        timing: Timing,
        /// A, n×n.
        transition: Matrix<Rational>,
        /// C, m×n.
        observation: Matrix<Rational>,
        /// Q, n×n.
        process_noise: Matrix<Rational>,
        /// S, n×m.
        cross_noise: Matrix<Rational>,
        /// R, m×m.
        observation_noise: Matrix<Rational>,
    },
    /// `X = AᵀXA − (AᵀXB + S)(R + BᵀXB)⁻¹(BᵀXA + Sᵀ) + Q`
    Control {
        /// A, n×n.
        a: Matrix<Rational>,
        /// B, n×m.
        b: Matrix<Rational>,
        /// Q, n×n.
        q: Matrix<Rational>,
        /// R, m×m.
        r: Matrix<Rational>,
        /// S, n×m.
        s: Matrix<Rational>,
    },
}

impl SteadyEquation {
    /// Which transition shares noise with which observation; nothing for control.
    pub const fn timing(&self) -> Option<Timing> {
        match self {
            Self::Filter { timing, .. } => Some(*timing),
            Self::Control { .. } => None,
        }
    }

    /// A, C, Q, S and R of the filter with this equation. That of control has Aᵀ and Bᵀ, and the transposed feedback for its gain.
    fn filter(&self) -> (Timing, [Matrix<Rational>; 5]) {
        let (timing, transition, observation, [process, cross, noise]) = match self {
            Self::Filter { timing, transition, observation, process_noise, cross_noise, observation_noise } => {
                (*timing, transition.clone(), observation.clone(), [process_noise, cross_noise, observation_noise])
            }
            Self::Control { a, b, q, r, s } => (Timing::Departing, a.transpose(), b.transpose(), [q, s, r]),
        };
        (timing, [transition, observation, process.clone(), cross.clone(), noise.clone()])
    }
}

const FORMAT: &str = "exact-kalman/steady/1";
const CASE: &str = "exact-kalman/case/1";

type Rows = Vec<Vec<Datum>>;

#[derive(Deserialize)]
struct Named {
    format: Option<Value>,
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct Document {
    #[serde(rename = "format")]
    _format: String,
    id: String,
    #[serde(default)]
    about: String,
    #[serde(default = "exactly")]
    numbers: Numbers,
    #[serde(default, deserialize_with = "present")]
    timing: Option<TimingName>,
    #[serde(default, deserialize_with = "present")]
    transition: Option<Rows>,
    #[serde(default, deserialize_with = "present")]
    observation: Option<Rows>,
    #[serde(default, deserialize_with = "present")]
    noise: Option<NoiseDocument>,
    #[serde(default, deserialize_with = "present")]
    control: Option<ControlDocument>,
}

#[derive(Clone, Copy, Deserialize)]
#[serde(rename_all = "lowercase")]
enum TimingName {
    Arriving,
    Departing,
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct NoiseDocument {
    #[serde(default, deserialize_with = "present")]
    process: Option<Rows>,
    #[serde(default, deserialize_with = "present")]
    cross: Option<Rows>,
    #[serde(default, deserialize_with = "present")]
    observation: Option<Rows>,
    #[serde(default, deserialize_with = "present")]
    process_factor: Option<Rows>,
    #[serde(default, deserialize_with = "present")]
    observation_factor: Option<Rows>,
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct ControlDocument {
    a: Rows,
    b: Rows,
    q: Rows,
    r: Rows,
    #[serde(default, deserialize_with = "present")]
    s: Option<Rows>,
}

fn exactly() -> Numbers {
    Numbers::Exact
}

impl SteadyModel {
    /// Reads one document, or one case.
    ///
    /// # Errors
    ///
    /// [`InputError`] with the place: also for shapes that do not fit, matrices that are not symmetric, and coefficients of a case
    /// that change with time.
    pub fn parse(text: &str) -> Result<Self, InputError> {
        match document::parse_object::<Named>(text)?.format {
            Some(Value::String(format)) if format == FORMAT => of_document(&document::parse_object(text)?),
            Some(Value::String(format)) if format == CASE => {
                of_case(&Case::parse(text).map_err(|error| InputError::at("", error.to_string()))?)
            }
            Some(_) => Err(InputError::at("format", format!("is neither {FORMAT:?} nor {CASE:?}"))),
            None => Err(InputError::at("format", format!("is missing: {FORMAT:?}, or {CASE:?} for a case"))),
        }
    }

    /// The step in the form for both timings.
    pub fn unified(&self) -> UnifiedStep {
        let (timing, [a, c, q, s, r]) = self.equation.filter();
        UnifiedStep::new(timing, a, &c, q, &s, r)
    }

    /// The step that is repeated for ever, and its timing; all is read, and is zero.
    pub fn step(&self) -> (Step<Rational>, Timing) {
        let (timing, [a, c, q, s, r]) = self.equation.filter();
        let (n, m) = (a.rows(), c.rows());
        let step = Step {
            transition: Some(Transition { matrix: a, input: Matrix::zeros(n, 1), noise: q, cross_noise: s }),
            observation: c,
            observation_input: Matrix::zeros(m, 1),
            observation_noise: r,
            reading: Observation::complete(vec![Rational::default(); m]),
        };
        (step, timing)
    }

    /// The document of the same model, every number a fraction.
    pub fn document(&self) -> Value {
        let mut document = json!({"format": FORMAT, "id": self.id, "about": self.about, "numbers": "exact"});
        let more = match &self.equation {
            SteadyEquation::Filter {
                timing,
                transition,
                observation,
                process_noise,
                cross_noise,
                observation_noise,
            } => json!({
                "timing": if *timing == Timing::Arriving { "arriving" } else { "departing" },
                "transition": written(transition),
                "observation": written(observation),
                "noise": {"process": written(process_noise), "cross": written(cross_noise), "observation": written(observation_noise)},
            }),
            SteadyEquation::Control { a, b, q, r, s } => json!({"control": {
                "a": written(a), "b": written(b), "q": written(q), "r": written(r), "s": written(s),
            }}),
        };
        if let (Value::Object(document), Value::Object(more)) = (&mut document, more) {
            document.extend(more);
        }
        document
    }
}

fn written(matrix: &Matrix<Rational>) -> Value {
    let row = |i| matrix.row(i).iter().map(|entry| Value::from(entry.to_string())).collect::<Value>();
    (0..matrix.rows()).map(row).collect()
}

fn of_document(document: &Document) -> Result<SteadyModel, InputError> {
    let Document { id, about, numbers, timing, transition, observation, noise, control, .. } = document;
    let equation = match (timing, transition, observation, noise, control) {
        (None, None, None, None, Some(control)) => of_control(*numbers, control)?,
        (Some(timing), Some(transition), Some(observation), Some(noise), None) => {
            let timing = match timing {
                TimingName::Arriving => Timing::Arriving,
                TimingName::Departing => Timing::Departing,
            };
            of_filter(*numbers, timing, transition, observation, noise)?
        }
        _ => {
            return Err(InputError::at(
                "",
                "give either `timing`, `transition`, `observation` and `noise`, or `control` alone",
            ));
        }
    };
    Ok(SteadyModel { id: id.clone(), about: about.clone(), equation })
}

fn of_filter(
    numbers: Numbers,
    timing: Timing,
    transition: &Rows,
    observation: &Rows,
    noise: &NoiseDocument,
) -> Result<SteadyEquation, InputError> {
    let n = order("transition", transition)?;
    let transition = numbers.square("transition", transition, n)?;
    let observation = numbers.matrix("observation", observation, n)?;
    let m = observation.rows();
    let (process_noise, cross_noise, observation_noise) = match noise {
        NoiseDocument {
            process: Some(process),
            cross,
            observation: Some(observation),
            process_factor: None,
            observation_factor: None,
        } => {
            let cross = cross.as_ref().map(|cross| rectangle(numbers, "noise.cross", cross, (n, m))).transpose()?;
            (
                symmetric(numbers, "noise.process", process, n)?,
                cross.unwrap_or_else(|| Matrix::zeros(n, m)),
                symmetric(numbers, "noise.observation", observation, m)?,
            )
        }
        NoiseDocument {
            process: None,
            cross: None,
            observation: None,
            process_factor: Some(process),
            observation_factor: Some(observation),
        } => {
            let q = process.first().map_or(0, Vec::len);
            let d = rectangle(numbers, "noise.process_factor", process, (n, q))?;
            let f = rectangle(numbers, "noise.observation_factor", observation, (m, q))?;
            (&d * d.transpose(), &d * f.transpose(), &f * f.transpose())
        }
        _ => {
            return Err(InputError::at(
                "noise",
                "give either `process` and `observation` (with `cross` if it is not zero), \
                 or `process_factor` and `observation_factor`",
            ));
        }
    };
    Ok(SteadyEquation::Filter { timing, transition, observation, process_noise, cross_noise, observation_noise })
}

fn of_control(numbers: Numbers, control: &ControlDocument) -> Result<SteadyEquation, InputError> {
    let n = order("control.a", &control.a)?;
    let m = control.b.first().map_or(0, Vec::len);
    let s = control.s.as_ref().map(|s| rectangle(numbers, "control.s", s, (n, m))).transpose()?;
    Ok(SteadyEquation::Control {
        a: numbers.square("control.a", &control.a, n)?,
        b: rectangle(numbers, "control.b", &control.b, (n, m))?,
        q: symmetric(numbers, "control.q", &control.q, n)?,
        r: symmetric(numbers, "control.r", &control.r, m)?,
        s: s.unwrap_or_else(|| Matrix::zeros(n, m)),
    })
}

/// The number of rows of a square matrix, at least one.
fn order(path: &str, rows: &Rows) -> Result<usize, InputError> {
    if rows.is_empty() { Err(InputError::at(path, "is empty")) } else { Ok(rows.len()) }
}

fn rectangle(
    numbers: Numbers,
    path: &str,
    rows: &Rows,
    (height, width): (usize, usize),
) -> Result<Matrix<Rational>, InputError> {
    if rows.len() != height {
        return Err(InputError::at(path, format!("{} rows where {height} are needed", rows.len())));
    }
    numbers.matrix(path, rows, width)
}

fn symmetric(numbers: Numbers, path: &str, rows: &Rows, n: usize) -> Result<Matrix<Rational>, InputError> {
    let matrix = numbers.square(path, rows, n)?;
    match matrix.asymmetry() {
        Some((i, j)) => Err(InputError::at(path, format!("not symmetric: entries ({i}, {j}) and ({j}, {i}) differ"))),
        None => Ok(matrix),
    }
}

fn of_case(case: &Case) -> Result<SteadyModel, InputError> {
    let noise = match &case.noise {
        NoiseLaw::Covariances { process, cross, observation } => NoiseDocument {
            process: Some(constant("noise.process", process)?),
            cross: cross.as_ref().map(|cross| constant("noise.cross", cross)).transpose()?,
            observation: Some(constant("noise.observation", observation)?),
            process_factor: None,
            observation_factor: None,
        },
        NoiseLaw::Factors { process, observation } => NoiseDocument {
            process: None,
            cross: None,
            observation: None,
            process_factor: Some(constant("noise.process_factor", process)?),
            observation_factor: Some(constant("noise.observation_factor", observation)?),
        },
    };
    let transition = constant("transition", &case.transition)?;
    let observation = constant("observation", &case.observation)?;
    let equation = of_filter(case.numbers, case.timing, &transition, &observation, &noise)?;
    Ok(SteadyModel { id: case.id.clone(), about: case.about.clone(), equation })
}

fn constant(path: &str, matrices: &Matrices) -> Result<Rows, InputError> {
    let Along::Constant(rows) = matrices else {
        return Err(InputError::at(path, "changes with time: a steady state is one of constant matrices"));
    };
    Ok(rows.iter().map(|row| row.iter().map(|entry: &Entry| Datum::from(entry.as_str())).collect()).collect())
}
