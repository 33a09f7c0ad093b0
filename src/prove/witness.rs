//! Small integers at which a twin fails.

use std::fmt;

use super::body::{Body, Failure, Numbers, compared};
use super::chance::Random;
use super::entries::Entries;
use crate::matrix::Matrix;
use crate::scalar::{Rational, ratio};

const MOST_POINTS: usize = 400;

/// A point of small integers at which the identity holds and its twin does not.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Witness {
    /// The matrices, with their names.
    pub point: Vec<(String, Matrix<Rational>)>,
    /// What fails there.
    pub failure: Failure,
}

impl fmt::Display for Witness {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let parts: Vec<String> = self.point.iter().map(|(name, matrix)| format!("{name} = {matrix}")).collect();
        f.write_str(&parts.join(", "))
    }
}

/// The first point found, entries between −1 and 1 first, then between −2 and 2, and so on.
pub(super) fn found<B: Body>(numbers: Numbers) -> Result<Witness, Failure> {
    let mut random = Random(1);
    for point in 0..MOST_POINTS {
        let most = 1 + point as u64 / 50;
        let values: Vec<i64> =
            (0..256).map(|_| (random.next() % (2 * most + 1)).cast_signed() - most.cast_signed()).collect();
        let run = |twin| {
            let mut place = 0;
            let mut next = || {
                place += 1;
                ratio(values[place % values.len()], 1)
            };
            let mut entries = Entries::new(&mut next);
            let outcome = B::sides(numbers, twin, &mut entries).map(|sides| compared(&sides));
            (outcome, entries.named)
        };
        if let (Ok(Ok(())), _) = run(false)
            && let (Ok(Err(failure)), point) = run(true)
        {
            return Ok(Witness { point, failure });
        }
    }
    Err(Failure::TwinSurvives(MOST_POINTS))
}
