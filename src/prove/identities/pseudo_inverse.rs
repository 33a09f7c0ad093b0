//! The pseudo-inverse by full-rank factorisation.

use crate::matrix::Matrix;
use crate::prove::body::{Body, Failure, Numbers, Sides, no_value};
use crate::prove::entries::Entries;
use crate::scalar::Field;

/// `Vᵀ(VVᵀ)⁻¹(UᵀU)⁻¹Uᵀ`
fn of_factors<F: Field>(u: &Matrix<F>, v: &Matrix<F>, twin: bool) -> Result<Matrix<F>, Failure> {
    let (ut, vt) = (u.transpose(), v.transpose());
    let left = (&ut * u).inverse().map_err(no_value)?;
    let right = (v * &vt).inverse().map_err(no_value)?;
    Ok(if twin { vt * left * right * ut } else { vt * right * left * ut })
}

/// The equations of Penrose, for a matrix of given rank.
pub(in crate::prove) struct Penrose;

impl Body for Penrose {
    const IDENTIFIERS: &'static [&'static str] = &["CKS-L3-pinv", "HV-L3"];
    const NAME: &'static str = "Penrose's equations";
    const WHERE: &'static str = "the matrix is BC, with factors of that rank";
    const SLIP: &'static str = "the Gram matrix UᵀU is not inverted away";
    const LETTERS: &'static [&'static str] = &["rows", "columns", "rank"];
    const SYMBOLIC: &'static [&'static [usize]] =
        &[&[2, 2, 1], &[2, 2, 2], &[3, 2, 1], &[3, 2, 2], &[3, 3, 1], &[4, 4, 1]];
    const HEAVY: &'static [&'static [usize]] = &[&[3, 3, 2], &[4, 3, 2], &[3, 3, 3], &[4, 4, 2]];
    const RANDOM: &'static [&'static [usize]] = &[&[3, 3, 2], &[4, 4, 2], &[5, 7, 3], &[8, 8, 4], &[8, 8, 7]];

    fn sides<F: Field>(
        [rows, columns, rank, ..]: Numbers,
        twin: bool,
        entries: &mut Entries<'_, F>,
    ) -> Result<Sides<F>, Failure> {
        let p = entries.matrix("B", rows, rank) * entries.matrix("C", rank, columns);
        let x = if twin {
            let factors = p.full_rank_factorisation().map_err(no_value)?;
            let vt = factors.right.transpose();
            &vt * (&factors.right * &vt).inverse().map_err(no_value)? * factors.left.transpose()
        } else {
            p.pseudo_inverse().map_err(no_value)?
        };
        let (px, xp) = (&p * &x, &x * &p);
        Ok(vec![
            (&px * &p, p.clone()),
            (&xp * &x, x.clone()),
            (px.transpose(), px),
            (xp.transpose(), xp),
            ((&x * x.transpose()) * p.transpose(), x.clone()),
            (p.transpose() * (x.transpose() * &x), x),
        ])
    }
}

/// Any factors of full rank give the same matrix.
pub(in crate::prove) struct AnyFactors;

impl Body for AnyFactors {
    const IDENTIFIERS: &'static [&'static str] = &["HV-L3"];
    const NAME: &'static str = "the pseudo-inverse by any factors of full rank";
    const WHERE: &'static str = "U and V have that rank";
    const SLIP: &'static str = "the inverses of VVᵀ and UᵀU are interchanged";
    const LETTERS: &'static [&'static str] = &["rows", "columns", "rank"];
    const SYMBOLIC: &'static [&'static [usize]] =
        &[&[2, 2, 2], &[2, 2, 1], &[3, 2, 1], &[3, 2, 2], &[3, 3, 1], &[4, 4, 1]];
    const HEAVY: &'static [&'static [usize]] = &[&[3, 3, 2], &[4, 3, 2], &[3, 3, 3], &[4, 4, 2]];
    const RANDOM: &'static [&'static [usize]] = &[&[3, 3, 2], &[4, 4, 2], &[5, 7, 3], &[8, 8, 4]];

    fn sides<F: Field>(
        [rows, columns, rank, ..]: Numbers,
        twin: bool,
        entries: &mut Entries<'_, F>,
    ) -> Result<Sides<F>, Failure> {
        let (u, v) = (entries.matrix("U", rows, rank), entries.matrix("V", rank, columns));
        Ok(vec![((&u * &v).pseudo_inverse().map_err(no_value)?, of_factors(&u, &v, twin)?)])
    }
}
