//! Starts that are not Gaussian: the statistics of the readings.

use super::path::path;
use crate::matrix::Matrix;
use crate::model::Timing;
use crate::nongaussian::statistics;
use crate::prove::body::{Body, Failure, Numbers, Sides, no_value, paired};
use crate::prove::entries::Entries;
use crate::scalar::Field;

/// Q* = Q + Ψ and R* = M − R have recursions of their own.
pub(in crate::prove) struct Starred;

impl Body for Starred {
    const IDENTIFIERS: &'static [&'static str] = &["SM-4.1", "SM-4.6", "SM-4.7"];
    const NAME: &'static str = "the recursions of Q* and R* follow from those of Q, Ψ, R and M";
    const WHERE: &'static str = "every Σᵛ and J is regular";
    const SLIP: &'static str = "the shared noise is left out of the gain of Q*";
    const LETTERS: &'static [&'static str] = &["n", "m", "steps"];
    const SYMBOLIC: &'static [&'static [usize]] = &[&[1, 1, 1], &[1, 1, 2], &[2, 1, 1], &[2, 1, 2], &[2, 2, 2]];
    const RANDOM: &'static [&'static [usize]] = &[&[2, 1, 2], &[3, 2, 3], &[4, 2, 3], &[8, 3, 2]];

    fn sides<F: Field>(numbers: Numbers, twin: bool, entries: &mut Entries<'_, F>) -> Result<Sides<F>, Failure> {
        let path = path(Timing::Departing, numbers, entries);
        let all = statistics(&path).map_err(no_value)?;
        let n = path.states();
        let mut sides = vec![(all[0].response(), Matrix::identity(n)), (all[0].precision(), Matrix::zeros(n, n))];
        for (pair, step) in paired(all.windows(2), path.steps())? {
            let [now, next] = pair else { return Err(no_value("no pair")) };
            let Some(transition) = &step.transition else { return Err(no_value("no transition")) };
            let (a, h) = (&transition.matrix, &step.observation);
            let seen = a * &now.covariance * h.transpose();
            let cross = if twin { seen } else { seen + &transition.cross_noise };
            let j = h.congruence(&now.covariance) + &step.observation_noise;
            let inverse = j.inverse().map_err(no_value)?;
            let slope = now.response();
            sides.push((next.response(), (a - cross * &inverse * h) * &slope));
            sides.push((next.precision(), now.precision() + (h * slope).transpose().congruence(&inverse)));
        }
        Ok(sides)
    }
}
