//! The noise from the residuals.

use crate::identify::{ResidualCovariances, noise_covariances};
use crate::prove::body::{Body, Failure, Sides, no_value};
use crate::prove::entries::Entries;
use crate::scalar::Field;

/// (A, V, W) → (B(1), B(2)) → (V, W), and back.
pub(in crate::prove) struct Recovered;

impl Body for Recovered {
    const IDENTIFIERS: &'static [&'static str] = &["AK-B.1", "AK-B.2", "AK-B.V", "AK-B.W"];
    const NAME: &'static str = "V and W from the covariances of residuals";
    const SLIP: &'static str = "B(1) and B(2) are interchanged";
    const LETTERS: &'static [&'static str] = &["n"];
    const SYMBOLIC: &'static [[usize; 3]] = &[[1, 0, 0], [2, 0, 0], [3, 0, 0], [4, 0, 0]];
    const RANDOM: &'static [[usize; 3]] = &[[3, 0, 0], [4, 0, 0], [8, 0, 0]];

    fn sides<F: Field>([n, ..]: [usize; 3], twin: bool, entries: &mut Entries<'_, F>) -> Result<Sides<F>, Failure> {
        let (a, v, w) = (entries.matrix("A", n, n), entries.symmetric("V", n), entries.symmetric("W", n));
        let mut residuals = ResidualCovariances::of_system(&a, &v, &w);
        let written = (&v + &w + a.congruence(&w), &v + &w + a.congruence(&v) + (&a * &a).congruence(&w));
        let mut sides = vec![(residuals.one_step.clone(), written.0), (residuals.two_step.clone(), written.1)];
        if twin {
            std::mem::swap(&mut residuals.one_step, &mut residuals.two_step);
        }
        let noise = noise_covariances(&a, &residuals).map_err(no_value)?;
        sides.extend([(noise.process, v), (noise.observation, w)]);
        Ok(sides)
    }
}
