//! Those who answer cases: programs, and the built-in f64 filters.

use crate::float::{Form, filter};
use crate::protocol::{Answer, Case, Number, Outcome, Reply, Subject};
use crate::scalar::{exact_value, nearest_double};
use crate::trace::Values;

/// Somebody who answers cases.
pub trait Examinee {
    /// The name under which the answers are shown.
    fn name(&self) -> String;

    /// The reply to a case.
    fn reply(&mut self, case: &Case) -> Reply;
}

impl Examinee for Subject {
    fn name(&self) -> String {
        self.to_string()
    }

    fn reply(&mut self, case: &Case) -> Reply {
        self.ask(&case.id, &case.to_line())
    }
}

impl Examinee for Form {
    fn name(&self) -> String {
        Self::name(*self).to_owned()
    }

    /// The filter of this form behind the checks of this crate, so bad input is refused before it is filtered.
    fn reply(&mut self, case: &Case) -> Reply {
        let answer = |outcome, step, message: String, steps: &[Values<f64>]| {
            let steps = steps.iter().map(numbers).collect();
            Reply::Answer(Answer {
                id: case.id.clone(),
                outcome,
                step,
                message: Some(message),
                steps,
                ahead: Vec::new(),
            })
        };
        let path = match case.problem().and_then(|problem| problem.realised()) {
            Ok(path) => path,
            Err(why) => return answer(Outcome::Refused, None, why.to_string(), &[]),
        };
        let path = path.try_map(|value| Ok::<_, std::convert::Infallible>(nearest_double(value)));
        let path = match path {
            Ok(path) => path,
            Err(never) => match never {},
        };
        match filter(*self, &path) {
            Ok(steps) => answer(Outcome::Answered, None, String::new(), &steps),
            Err(error) if error.is_unsupported() => answer(Outcome::Unsupported, None, error.to_string(), &[]),
            Err(error) => answer(Outcome::Error, error.step(), error.to_string(), error.computed()),
        }
    }
}

fn numbers(values: &Values<f64>) -> Values<Number> {
    let number = |value: &f64| match exact_value(*value) {
        Some(value) => Number::Finite(value),
        None if value.is_nan() => Number::NotANumber,
        None => Number::Infinite { negative: *value < 0.0 },
    };
    values.iter().map(|(&quantity, matrix)| (quantity, matrix.map(number))).collect()
}
