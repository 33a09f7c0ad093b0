//! The map of Riccati.

use crate::prove::body::{Body, Failure, Sides, no_value};
use crate::prove::entries::Entries;
use crate::riccati::RiccatiMap;
use crate::scalar::Field;

/// The forms of φ, and one step of the filter.
pub(in crate::prove) struct Forms;

impl Body for Forms {
    const IDENTIFIERS: &'static [&'static str] = &["AK-2.5", "AK-4.1", "AK-4.2", "AK-1.4a", "AK-1.4b", "AK-1.4c"];
    const NAME: &'static str = "the forms of the map of Riccati (equalities)";
    const SLIP: &'static str = "S stands for the second W in W − W(S + W)⁻¹W";
    const LETTERS: &'static [&'static str] = &["n"];
    const SYMBOLIC: &'static [[usize; 3]] = &[[1, 0, 0], [2, 0, 0]];
    const RANDOM: &'static [[usize; 3]] = &[[3, 0, 0], [4, 0, 0], [8, 0, 0]];

    fn sides<F: Field>([n, ..]: [usize; 3], twin: bool, entries: &mut Entries<'_, F>) -> Result<Sides<F>, Failure> {
        let (a, v, w) = (entries.matrix("A", n, n), entries.symmetric("V", n), entries.symmetric("W", n));
        let s = entries.symmetric("S", n);
        let map = RiccatiMap::from_parts(a.clone(), v.clone(), w.clone());
        let image = map.image(&s);
        let inverse = (&s + &w).inverse().map_err(no_value)?;
        let second = if twin { &s } else { &w };
        let by_s = a.congruence(&(&s - &s * &inverse * &s)) + &v;
        let by_w = a.congruence(&(&w - &w * &inverse * second)) + &v;
        let step = map.step(&map.filtered_covariance(&s));
        Ok(vec![
            (image.clone(), by_s),
            (image.clone(), by_w),
            (step.predicted, image.clone()),
            (map.filtered_covariance(&image), step.filtered),
        ])
    }
}

/// The difference of two images, by the two closed loops.
pub(in crate::prove) struct Difference;

impl Body for Difference {
    const IDENTIFIERS: &'static [&'static str] = &["AK-T2.3-diff", "AK-D"];
    const NAME: &'static str = "φ(T₁) − φ(T₂) = D₁(T₁ − T₂)D₂ᵀ";
    const SLIP: &'static str = "D₂ is not transposed";
    const LETTERS: &'static [&'static str] = &["n"];
    const SYMBOLIC: &'static [[usize; 3]] = &[[1, 0, 0], [2, 0, 0]];
    const RANDOM: &'static [[usize; 3]] = &[[3, 0, 0], [4, 0, 0], [8, 0, 0]];

    fn sides<F: Field>([n, ..]: [usize; 3], twin: bool, entries: &mut Entries<'_, F>) -> Result<Sides<F>, Failure> {
        let n = if twin { n.max(2) } else { n };
        let (a, v, w) = (entries.matrix("A", n, n), entries.symmetric("V", n), entries.symmetric("W", n));
        let (t1, t2) = (entries.symmetric("T₁", n), entries.symmetric("T₂", n));
        let map = RiccatiMap::from_parts(a, v, w);
        let (d1, d2) = (map.closed_loop(&t1), map.closed_loop(&t2));
        let right = d1 * (&t1 - &t2) * if twin { d2 } else { d2.transpose() };
        Ok(vec![(map.image(&t1) - map.image(&t2), right)])
    }
}

/// Stein's equation of the closed loop at a fixed point; V is what makes T one.
pub(in crate::prove) struct Stein;

impl Body for Stein {
    const IDENTIFIERS: &'static [&'static str] = &["AK-L4.3-id", "AK-D"];
    const NAME: &'static str = "Stein's equation of the closed loop";
    const SLIP: &'static str = "W is left out between the inverses";
    const LETTERS: &'static [&'static str] = &["n"];
    const SYMBOLIC: &'static [[usize; 3]] = &[[1, 0, 0], [2, 0, 0]];
    const RANDOM: &'static [[usize; 3]] = &[[3, 0, 0], [4, 0, 0], [8, 0, 0]];

    fn sides<F: Field>([n, ..]: [usize; 3], twin: bool, entries: &mut Entries<'_, F>) -> Result<Sides<F>, Failure> {
        let (a, w, t) = (entries.matrix("A", n, n), entries.symmetric("W", n), entries.symmetric("T", n));
        let v = &t - a.congruence(&t.parallel_sum(&w).map_err(no_value)?);
        let map = RiccatiMap::from_parts(a.clone(), v.clone(), w.clone());
        let inverse = (&t + &w).inverse().map_err(no_value)?;
        let middle = if twin { &inverse * &inverse } else { inverse.congruence(&w) };
        let right = (&a * &t).congruence(&middle) + v;
        Ok(vec![(map.image(&t), t.clone()), (&t - map.closed_loop(&t).congruence(&t), right)])
    }
}
