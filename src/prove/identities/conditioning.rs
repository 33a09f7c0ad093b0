//! Conditioning a Gaussian vector.

use crate::gaussian::Gaussian;
use crate::matrix::Matrix;
use crate::prove::body::{Body, Failure, Sides, no_value};
use crate::prove::entries::Entries;
use crate::scalar::Field;

/// Against the inverse of the joint covariance, whose blocks hold the conditional law.
pub(in crate::prove) struct Precision;

impl Body for Precision {
    const IDENTIFIERS: &'static [&'static str] = &["CKS-L3i", "HV-L3-mean", "HV-L3-cov"];
    const NAME: &'static str = "conditioning = the law read off the joint precision";
    const SLIP: &'static str = "the sign of the correction of the mean";
    const LETTERS: &'static [&'static str] = &["n", "m"];
    const SYMBOLIC: &'static [[usize; 3]] = &[[1, 1, 0], [2, 1, 0], [1, 2, 0], [2, 2, 0], [3, 2, 0], [2, 3, 0]];
    const HEAVY: &'static [[usize; 3]] = &[[3, 3, 0]];
    const RANDOM: &'static [[usize; 3]] = &[[3, 2, 0], [4, 4, 0], [8, 3, 0], [5, 8, 0]];

    fn sides<F: Field>([n, m, _]: [usize; 3], twin: bool, entries: &mut Entries<'_, F>) -> Result<Sides<F>, Failure> {
        let joint = entries.symmetric("cov(x, y)", n + m);
        let mean = entries.column("mean", n + m);
        let values = entries.column("y", m);
        let observed: Vec<usize> = (n..n + m).collect();
        let law = Gaussian::new(mean.clone(), joint.clone()).map_err(no_value)?;
        let given = law.conditioned(&observed, &values).map_err(no_value)?;
        let precision = joint.inverse().map_err(no_value)?;
        let covariance = precision.block(0..n, 0..n).inverse().map_err(no_value)?;
        let correction = &covariance * precision.block(0..n, n..n + m) * (values - mean.block(n..n + m, 0..1));
        let prior = mean.block(0..n, 0..1);
        let mean = if twin { prior + correction } else { prior - correction };
        Ok(vec![(given.law.mean().clone(), mean), (given.law.covariance().clone(), covariance)])
    }
}

/// A singular observed covariance: n hidden and m observed entries driven by r < m sources are known for certain.
pub(in crate::prove) struct Singular;

impl Body for Singular {
    const IDENTIFIERS: &'static [&'static str] = &["CKS-L3i", "CKS-L3ii"];
    const NAME: &'static str = "conditioning on more readings than there are sources";
    const SLIP: &'static str = "the mean of the reading is not subtracted";
    const LETTERS: &'static [&'static str] = &["n", "m", "sources"];
    const SYMBOLIC: &'static [[usize; 3]] = &[[1, 2, 1], [2, 2, 1], [1, 3, 1], [2, 3, 1], [2, 3, 2], [3, 3, 2]];
    const RANDOM: &'static [[usize; 3]] = &[[2, 3, 2], [3, 4, 2], [4, 6, 5], [8, 8, 4]];

    fn sides<F: Field>([n, m, r]: [usize; 3], twin: bool, entries: &mut Entries<'_, F>) -> Result<Sides<F>, Failure> {
        let factor = entries.matrix("F", n + m, r);
        let mean = entries.column("mean", n + m);
        let sources = entries.column("sources", r);
        let values = (&mean + &factor * &sources).block(n..n + m, 0..1);
        let observed: Vec<usize> = (n..n + m).collect();
        let law = Gaussian::new(mean.clone(), &factor * factor.transpose()).map_err(no_value)?;
        let given = law.conditioned(&observed, &values).map_err(no_value)?;
        let left = if twin { mean.block(0..n, 0..1) + &given.gain * &values } else { given.law.mean().clone() };
        let cross = &given.cross_covariance;
        let unexplained = cross - cross * (&given.pseudo_inverse * &given.innovation_covariance);
        Ok(vec![
            (left, (mean + &factor * sources).block(0..n, 0..1)),
            (given.law.covariance().clone(), Matrix::zeros(n, n)),
            (unexplained, Matrix::zeros(n, m)),
        ])
    }
}
