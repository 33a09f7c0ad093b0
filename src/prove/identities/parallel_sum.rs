//! The parallel sum.

use crate::prove::body::{Body, Failure, Numbers, Sides, no_value};
use crate::prove::entries::Entries;
use crate::scalar::Field;

/// Its forms where F + G is regular.
pub(in crate::prove) struct Forms;

impl Body for Forms {
    const IDENTIFIERS: &'static [&'static str] = &["AK-L4.1ii", "AK-L4.1iv", "AK-Par-inverse"];
    const NAME: &'static str = "F:G = G:F = F − F(F + G)⁻¹F, and inverses add";
    const WHERE: &'static str = "F, G and F + G are regular";
    const SLIP: &'static str = "F − G(F + G)⁻¹F";
    const LETTERS: &'static [&'static str] = &["n"];
    const SYMBOLIC: &'static [&'static [usize]] = &[&[1], &[2], &[3]];
    const RANDOM: &'static [&'static [usize]] = &[&[3], &[4], &[8]];

    fn sides<F: Field>([n, ..]: Numbers, twin: bool, entries: &mut Entries<'_, F>) -> Result<Sides<F>, Failure> {
        let (f, g) = (entries.symmetric("F", n), entries.symmetric("G", n));
        let sum = f.parallel_sum(&g).map_err(no_value)?;
        let inverse = (&f + &g).inverse().map_err(no_value)?;
        let (first, second) = if twin { (&g, &g) } else { (&f, &g) };
        let inverses = f.inverse().map_err(no_value)? + g.inverse().map_err(no_value)?;
        Ok(vec![
            (sum.clone(), g.parallel_sum(&f).map_err(no_value)?),
            (sum.clone(), &f - first * &inverse * &f),
            (sum.clone(), &g - second * &inverse * &g),
            (sum.inverse().map_err(no_value)?, inverses),
        ])
    }
}

/// Sums of rank r < n, where the pseudo-inverse is needed: F = UXUᵀ and G = UYUᵀ with U n×r.
pub(in crate::prove) struct Singular;

impl Body for Singular {
    const IDENTIFIERS: &'static [&'static str] = &["AK-L4.1ii", "AK-L4.1iv"];
    const NAME: &'static str = "parallel sums of singular matrices";
    const WHERE: &'static str = "F = UXUᵀ and G = UYUᵀ, X + Y regular";
    const SLIP: &'static str = "F − G(F + G)⁺F";
    const LETTERS: &'static [&'static str] = &["n", "r"];
    const SYMBOLIC: &'static [&'static [usize]] = &[&[2, 1], &[3, 1], &[4, 1]];
    const HEAVY: &'static [&'static [usize]] = &[&[3, 2], &[4, 2]];
    const RANDOM: &'static [&'static [usize]] = &[&[3, 2], &[4, 2], &[6, 4], &[8, 3]];

    fn sides<F: Field>([n, r, ..]: Numbers, twin: bool, entries: &mut Entries<'_, F>) -> Result<Sides<F>, Failure> {
        let u = entries.matrix("U", n, r);
        let (x, y) = (entries.symmetric("X", r), entries.symmetric("Y", r));
        let (f, g) = (u.congruence(&x), u.congruence(&y));
        let sum = f.parallel_sum(&g).map_err(no_value)?;
        let inverse = (&f + &g).pseudo_inverse().map_err(no_value)?;
        let first = if twin { &g } else { &f };
        Ok(vec![
            (sum.clone(), g.parallel_sum(&f).map_err(no_value)?),
            (sum.clone(), &f - first * &inverse * &f),
            (sum, u.congruence(&x.parallel_sum(&y).map_err(no_value)?)),
        ])
    }
}
