//! The noise from the residuals.

use crate::identify::{ResidualCovariances, noise_covariances};
use crate::prove::body::{Body, Failure, Numbers, Sides, no_value};
use crate::prove::entries::Entries;
use crate::scalar::Field;

/// (A, V, W) → (B(1), B(2)) → (V, W), and back.
pub(in crate::prove) struct Recovered;

impl Body for Recovered {
    const IDENTIFIERS: &'static [&'static str] = &["AK-B.1", "AK-B.2", "AK-B.V", "AK-B.W"];
    const NAME: &'static str = "V and W from the covariances of residuals";
    const WHERE: &'static str = "A is regular";
    const SLIP: &'static str = "B(1) and B(2) are interchanged";
    const LETTERS: &'static [&'static str] = &["n"];
    const SYMBOLIC: &'static [&'static [usize]] = &[&[1], &[2], &[3], &[4]];
    const RANDOM: &'static [&'static [usize]] = &[&[3], &[4], &[8]];

    fn sides<F: Field>([n, ..]: Numbers, twin: bool, entries: &mut Entries<'_, F>) -> Result<Sides<F>, Failure> {
        let (a, v, w) = (entries.matrix("A", n, n), entries.symmetric("V", n), entries.symmetric("W", n));
        let mut residuals = ResidualCovariances::of_system(&a, &v, &w);
        let written = (&v + &w + a.congruence(&w), &v + &w + a.congruence(&v) + (&a * &a).congruence(&w));
        let mut sides = vec![(residuals.one_step.clone(), written.0), (residuals.two_step.clone(), written.1)];
        if twin {
            std::mem::swap(&mut residuals.one_step, &mut residuals.two_step);
        }
        // An A whose inverse is unknown is none of the errors of the next line.
        a.inverse().map_err(no_value)?;
        let noise = noise_covariances(&a, &residuals).map_err(no_value)?;
        sides.extend([(noise.process, v), (noise.observation, w)]);
        Ok(sides)
    }
}
