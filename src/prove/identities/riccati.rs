//! The map of Riccati.

use crate::filter::filter;
use crate::matrix::Matrix;
use crate::model::{Before, Initial, Observation, Path, Step, Timing, Transition};
use crate::prove::body::{Body, Failure, Numbers, Sides, no_value, paired};
use crate::prove::entries::Entries;
use crate::riccati::{CovarianceStep, RiccatiMap};
use crate::scalar::Field;

/// The forms of φ, and its steps.
pub(in crate::prove) struct Forms;

impl Body for Forms {
    const IDENTIFIERS: &'static [&'static str] = &["AK-2.5", "AK-4.1", "AK-4.2", "AK-1.4a", "AK-1.4b", "AK-1.4c"];
    const NAME: &'static str = "the forms of the map of Riccati (equalities)";
    const WHERE: &'static str = "S + W and φ(S) + W are regular";
    const SLIP: &'static str = "S stands for the second W in W − W(S + W)⁻¹W";
    const LETTERS: &'static [&'static str] = &["n"];
    const SYMBOLIC: &'static [&'static [usize]] = &[&[1], &[2]];
    const RANDOM: &'static [&'static [usize]] = &[&[3], &[4], &[8]];

    fn sides<F: Field>([n, ..]: Numbers, twin: bool, entries: &mut Entries<'_, F>) -> Result<Sides<F>, Failure> {
        let (a, v, w) = (entries.matrix("A", n, n), entries.symmetric("V", n), entries.symmetric("W", n));
        let s = entries.symmetric("S", n);
        let map = RiccatiMap::from_parts(a.clone(), v.clone(), w.clone());
        let image = map.try_image(&s).map_err(no_value)?;
        let inverse = (&s + &w).inverse().map_err(no_value)?;
        let second = if twin { &s } else { &w };
        let by_s = a.congruence(&(&s - &s * &inverse * &s)) + &v;
        let by_w = a.congruence(&(&w - &w * &inverse * second)) + &v;
        let updated = map.try_filtered_covariance(&s).map_err(no_value)?;
        let step = map.try_step(&updated).map_err(no_value)?;
        let after = map.try_filtered_covariance(&image).map_err(no_value)?;
        Ok(vec![(image.clone(), by_s), (image.clone(), by_w), (step.predicted, image), (step.filtered, after)])
    }
}

/// The steps of the map against those of the filter of all models.
pub(in crate::prove) struct Filtered;

impl Body for Filtered {
    const IDENTIFIERS: &'static [&'static str] = &["AK-4.1", "AK-1.4a", "AK-1.4b", "AK-1.4c"];
    const NAME: &'static str = "the steps of the map of Riccati = the steps of the filter";
    const WHERE: &'static str = "every S(k) + W is regular";
    const SLIP: &'static str = "the gain is (S + W)⁺S";
    const LETTERS: &'static [&'static str] = &["n", "steps"];
    const SYMBOLIC: &'static [&'static [usize]] = &[&[1, 1], &[2, 1], &[1, 2]];
    const HEAVY: &'static [&'static [usize]] = &[&[1, 3], &[2, 2]];
    const RANDOM: &'static [&'static [usize]] = &[&[3, 2], &[4, 2], &[8, 1]];

    fn sides<F: Field>([n, steps, ..]: Numbers, twin: bool, entries: &mut Entries<'_, F>) -> Result<Sides<F>, Failure> {
        let (a, v, w) = (entries.matrix("A", n, n), entries.symmetric("V", n), entries.symmetric("W", n));
        let s = entries.symmetric("S", n);
        let map = RiccatiMap::from_parts(a, v, w);
        let first = CovarianceStep {
            gain: map.try_gain(&s).map_err(no_value)?,
            filtered: map.try_filtered_covariance(&s).map_err(no_value)?,
            predicted: s.clone(),
        };
        let mut computed = vec![first];
        while let (true, Some(last)) = (computed.len() < steps, computed.last()) {
            computed.push(map.try_step(&last.filtered).map_err(no_value)?);
        }
        let trace = filter(&observed(&map, s, steps)).map_err(|error| no_value(error.source))?;
        let mut sides = Vec::new();
        for (own, record) in paired(computed, trace.records)? {
            sides.push((own.predicted, record.predicted.covariance));
            sides.push((if twin { own.gain.transpose() } else { own.gain }, record.gain));
            sides.push((own.filtered, record.filtered.covariance));
        }
        Ok(sides)
    }
}

/// Observations of x + w that are zero, of a state that has the mean zero and the covariance S before the first.
fn observed<F: Field>(map: &RiccatiMap<F>, s: Matrix<F>, steps: usize) -> Path<F> {
    let n = map.states();
    let transition = Transition {
        matrix: map.transition().clone(),
        input: Matrix::zeros(n, 1),
        noise: map.state_noise().clone(),
        cross_noise: Matrix::zeros(n, n),
    };
    let steps = (1..=steps).map(|step| Step {
        // Nothing is asked of the state after the last.
        transition: (step < steps).then(|| transition.clone()),
        observation: Matrix::identity(n),
        observation_input: Matrix::zeros(n, 1),
        observation_noise: map.observation_noise().clone(),
        reading: Observation::complete(vec![F::zero(); n]),
    });
    let initial = Initial::new(Before::Observation, Matrix::zeros(n, 1), s);
    Path::from_parts(Timing::Departing, initial, steps.collect())
}

/// The difference of two images, by the two closed loops.
pub(in crate::prove) struct Difference;

impl Body for Difference {
    const IDENTIFIERS: &'static [&'static str] = &["AK-T2.3-diff", "AK-D"];
    const NAME: &'static str = "φ(T₁) − φ(T₂) = D₁(T₁ − T₂)D₂ᵀ";
    const WHERE: &'static str = "T₁ + W and T₂ + W are regular";
    const SLIP: &'static str = "D₂ is not transposed";
    const LETTERS: &'static [&'static str] = &["n"];
    const SYMBOLIC: &'static [&'static [usize]] = &[&[1], &[2]];
    const RANDOM: &'static [&'static [usize]] = &[&[3], &[4], &[8]];

    fn sides<F: Field>([n, ..]: Numbers, twin: bool, entries: &mut Entries<'_, F>) -> Result<Sides<F>, Failure> {
        let n = if twin { n.max(2) } else { n };
        let (a, v, w) = (entries.matrix("A", n, n), entries.symmetric("V", n), entries.symmetric("W", n));
        let (t1, t2) = (entries.symmetric("T₁", n), entries.symmetric("T₂", n));
        let map = RiccatiMap::from_parts(a, v, w);
        let [d1, d2] = [&t1, &t2].map(|t| map.try_closed_loop(t).map_err(no_value));
        let [first, second] = [&t1, &t2].map(|t| map.try_image(t).map_err(no_value));
        let (d1, d2) = (d1?, d2?);
        let right = d1 * (&t1 - &t2) * if twin { d2 } else { d2.transpose() };
        Ok(vec![(first? - second?, right)])
    }
}

/// Stein's equation of the closed loop at a fixed point; V is what makes T one.
pub(in crate::prove) struct Stein;

impl Body for Stein {
    const IDENTIFIERS: &'static [&'static str] = &["AK-L4.3-id", "AK-D"];
    const NAME: &'static str = "Stein's equation of the closed loop";
    const WHERE: &'static str = "T = φ(T) and T + W is regular";
    const SLIP: &'static str = "W is left out between the inverses";
    const LETTERS: &'static [&'static str] = &["n"];
    const SYMBOLIC: &'static [&'static [usize]] = &[&[1], &[2]];
    const RANDOM: &'static [&'static [usize]] = &[&[3], &[4], &[8]];

    fn sides<F: Field>([n, ..]: Numbers, twin: bool, entries: &mut Entries<'_, F>) -> Result<Sides<F>, Failure> {
        let (a, w, t) = (entries.matrix("A", n, n), entries.symmetric("W", n), entries.symmetric("T", n));
        let v = &t - a.congruence(&t.parallel_sum(&w).map_err(no_value)?);
        let map = RiccatiMap::from_parts(a.clone(), v.clone(), w.clone());
        let inverse = (&t + &w).inverse().map_err(no_value)?;
        let middle = if twin { &inverse * &inverse } else { inverse.congruence(&w) };
        let right = (&a * &t).congruence(&middle) + v;
        let (image, closed) = (map.try_image(&t).map_err(no_value)?, map.try_closed_loop(&t).map_err(no_value)?);
        Ok(vec![(image, t.clone()), (&t - closed.congruence(&t), right)])
    }
}
