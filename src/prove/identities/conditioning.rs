//! Conditioning a Gaussian vector.

use crate::gaussian::Gaussian;
use crate::matrix::Matrix;
use crate::prove::body::{Body, Failure, Numbers, Sides, no_value};
use crate::prove::entries::Entries;
use crate::scalar::Field;

/// Against the inverse of the joint covariance, whose blocks hold the conditional law.
pub(in crate::prove) struct Precision;

impl Body for Precision {
    const IDENTIFIERS: &'static [&'static str] = &["CKS-L3i", "HV-L3-mean", "HV-L3-cov"];
    const NAME: &'static str = "conditioning = the law read off the joint precision";
    const WHERE: &'static str = "the joint covariance is regular";
    const SLIP: &'static str = "the sign of the correction of the mean";
    const LETTERS: &'static [&'static str] = &["n", "m"];
    const SYMBOLIC: &'static [&'static [usize]] = &[&[1, 1], &[2, 1], &[1, 2], &[2, 2], &[3, 2], &[2, 3]];
    const HEAVY: &'static [&'static [usize]] = &[&[3, 3]];
    const RANDOM: &'static [&'static [usize]] = &[&[3, 2], &[4, 4], &[8, 3], &[5, 8]];

    fn sides<F: Field>([n, m, ..]: Numbers, twin: bool, entries: &mut Entries<'_, F>) -> Result<Sides<F>, Failure> {
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

/// A singular observed covariance: y − E y = Lz with fewer entries in z than in y, and x is not determined by z.
pub(in crate::prove) struct Singular;

impl Body for Singular {
    const IDENTIFIERS: &'static [&'static str] = &["CKS-L3i", "CKS-L3ii", "HV-L3-mean", "HV-L3-cov"];
    const NAME: &'static str = "conditioning on y, which repeats z = conditioning on z";
    const WHERE: &'static str = "cov y = L cov(z) Lᵀ has that rank";
    const SLIP: &'static str = "the mean of the reading is not subtracted";
    const LETTERS: &'static [&'static str] = &["n", "m", "rank"];
    const SYMBOLIC: &'static [&'static [usize]] = &[&[1, 2, 1], &[2, 2, 1], &[1, 3, 1], &[2, 3, 1]];
    const HEAVY: &'static [&'static [usize]] = &[&[1, 3, 2], &[2, 3, 2]];
    const RANDOM: &'static [&'static [usize]] = &[&[2, 3, 2], &[3, 4, 2], &[4, 6, 5], &[8, 8, 4]];

    fn sides<F: Field>(
        [n, m, rank, ..]: Numbers,
        twin: bool,
        entries: &mut Entries<'_, F>,
    ) -> Result<Sides<F>, Failure> {
        let (l, z) = (entries.matrix("L", m, rank), entries.column("z", rank));
        let joint = entries.symmetric("cov(x, z)", n + rank);
        let [prior, expected] = [entries.column("E x", n), entries.column("E y", m)];
        let values = &expected + &l * &z;
        // (x, y) of (x, z)
        let copies = Matrix::identity(n).block_diagonal(&l);
        let law = Gaussian::new(prior.above(&expected), copies.congruence(&joint)).map_err(no_value)?;
        let observed: Vec<usize> = (n..n + m).collect();
        let given = law.conditioned(&observed, &values).map_err(no_value)?;
        let mean = if twin { &prior + &given.gain * &values } else { given.law.mean().clone() };
        let cross = &given.cross_covariance;
        let unexplained = cross - cross * (&given.pseudo_inverse * &given.innovation_covariance);
        let with_z = joint.block(0..n, n..n + rank);
        let inverse = joint.block(n..n + rank, n..n + rank).inverse().map_err(no_value)?;
        Ok(vec![
            (mean, prior + &with_z * &inverse * z),
            (given.law.covariance().clone(), joint.block(0..n, 0..n) - with_z.congruence(&inverse)),
            (unexplained, Matrix::zeros(n, m)),
        ])
    }
}
