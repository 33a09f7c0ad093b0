//! Whether a polynomial has a root outside the open unit disc, decided with intervals where fractions would be long.

use num_traits::Signed;

use super::polynomial::Polynomial;
use crate::scalar::{Dyadic, Interval, Rational, Scalar};

/// Bits of one trial after the other.
const BITS: [u64; 4] = [128, 512, 2048, 8192];

/// Whether some root has modulus 1 or more; nothing where 8192 bits do not tell. The polynomial is monic.
pub(super) fn reaches_circle(p: &Polynomial<Rational>) -> Option<bool> {
    // The product of the roots, up to its sign.
    if p.degree() > 0 && p.coefficients().first().is_some_and(|constant| constant.abs() >= Rational::one()) {
        return Some(true);
    }
    BITS.iter().find_map(|&bits| {
        let enclosed = p.coefficients().iter().map(|coefficient| Interval::of(coefficient, bits)).collect();
        all_inside(enclosed, bits).map(|inside| !inside)
    })
}

/// Whether all roots have modulus below 1 (Schur, Cohn; `Matrix::spectral_radius_lt` has the argument); nothing where the intervals
/// are too wide.
fn all_inside(mut p: Vec<Interval>, bits: u64) -> Option<bool> {
    let zero = Dyadic::zero();
    while let [constant, .., leading] = p.as_slice() {
        let squares = |value: &Interval| value.times(value, bits);
        let difference = squares(leading).minus(&squares(constant), bits);
        if *difference.upper() < zero {
            return Some(false);
        }
        if *difference.lower() <= zero {
            return None;
        }
        let degree = p.len() - 1;
        let reduced = (0..degree).map(|i| {
            let kept = leading.times(&p[i + 1], bits);
            kept.minus(&constant.times(&p[degree - 1 - i], bits), bits).over(&difference, bits).ok()
        });
        p = reduced.collect::<Option<_>>()?;
    }
    Some(true)
}
