//! One scalar reading after the other.

use nalgebra::{DMatrix, DVector};

use super::error::Obstacle;
use super::moments::Moments;
use super::observed::Observed;
use super::rank::{is_rounding, product_of_terms, rounded_off, settled};
use super::recursion::{MomentRecursion, Update};
use super::symmetric::{congruence, with_transpose};
use super::transition::{Departure, Transition};

/// Readings made independent by `R = L D Lᵀ`, then taken one by one: no matrix is inverted.
///
/// Carries mean and covariance. While a reading is taken it carries those of `z = (x − x̂, w, L⁻¹v)` jointly, so noise that is shared
/// with the state (arriving) or with the transition (departing) needs no formula of its own. With h = (row of L⁻¹C, 0, unit row)
///
/// ```text
/// s = h J hᵀ,   k = J hᵀ / s,   ẑ ← ẑ + k (y' − h ẑ),   J ← J − k s kᵀ,      then x̂₊ = A x̂ + B u + ŵ
/// ```
///
/// Source: Anderson and Moore, *Optimal Filtering*, 6.4. It is cheap, and indifferent to the units of the sensors; a reading whose
/// scalar variance is nothing but rounding is passed over, also where R is singular. The update is (I − kh)J, symmetric to the
/// last bit, and loses what (I − KC)P loses where a sensor is far better than the prior.
pub(super) struct Sequential;

impl MomentRecursion for Sequential {
    const NAME: &'static str = "sequential";
    const DESCRIPTION: &'static str = "scalar readings one by one after R = LDL', covariance (I - kh)P";

    fn predicted(belief: &Moments, transition: &Transition) -> Result<Moments, Obstacle> {
        let Transition { matrix: a, input, noise: q } = transition;
        let covariance = image(a, &belief.covariance) + q;
        Ok(Moments { mean: a * &belief.mean + input, covariance })
    }

    fn updated(
        belief: &Moments,
        observed: &Observed,
        departure: Option<&Departure<'_>>,
    ) -> Result<Update<Moments>, Obstacle> {
        let Moments { mean, covariance: p } = belief;
        let Observed { matrix: c, value, noise: r, state_noise } = observed;
        let (n, m) = (mean.len(), value.len());
        let innovation = value - c * mean;
        let innovation_covariance = congruence(c, p) + with_transpose(&(c * state_noise)) + r;
        // L⁻¹, and the variances D.
        let Decorrelation { whitening, variances, terms: of_variances } = Decorrelation::of(r);
        let noise_at = if departure.is_some() { 2 * n } else { n };
        let all = noise_at + m;
        let (mut joint, mut terms) = (DMatrix::zeros(all, all), DMatrix::zeros(all, all));
        joint.view_mut((0, 0), (n, n)).copy_from(p);
        let mut share = |first: usize, cross: &DMatrix<f64>| {
            let (cross, of_cross) = product_of_terms(cross, &whitening.transpose());
            for (matrix, cross) in [(&mut joint, cross), (&mut terms, of_cross)] {
                matrix.view_mut((first, noise_at), (n, m)).copy_from(&cross);
                matrix.view_mut((noise_at, first), (m, n)).copy_from(&cross.transpose());
            }
        };
        share(0, state_noise);
        if let Some(Departure { transition, cross_noise }) = departure {
            share(n, cross_noise);
            joint.view_mut((n, n), (n, n)).copy_from(&transition.noise);
        }
        terms.view_mut((0, 0), (noise_at, noise_at)).copy_from(&joint.view((0, 0), (noise_at, noise_at)).abs());
        for i in 0..m {
            joint[(noise_at + i, noise_at + i)] = variances[i];
            terms[(noise_at + i, noise_at + i)] = of_variances[i];
        }
        let mut reader =
            Reader { shift: DVector::zeros(all), gain: DMatrix::zeros(all, m), joint, terms, regular: true };
        let (rows, of_rows) = product_of_terms(&whitening, c);
        for i in 0..m {
            let mut h = DVector::zeros(all);
            h.rows_mut(0, n).copy_from(&rows.row(i).transpose());
            let mut of_h = DVector::zeros(all);
            of_h.rows_mut(0, n).copy_from(&of_rows.row(i).transpose());
            (h[noise_at + i], of_h[noise_at + i]) = (1.0, 1.0);
            let own = whitening.row(i).transpose();
            reader.take(&h, &of_h, own.dot(&innovation), &own);
        }
        let Reader { shift, gain, joint, regular, .. } = reader;
        let filtered = Moments { mean: mean + shift.rows(0, n), covariance: joint.view((0, 0), (n, n)).into_owned() };
        let ahead = departure.map(|Departure { transition, .. }| {
            let Transition { matrix: a, input, .. } = transition;
            let onward =
                DMatrix::from_fn(n, 2 * n, |i, j| if j < n { a[(i, j)] } else { f64::from(u8::from(i + n == j)) });
            Moments {
                mean: a * &filtered.mean + input + shift.rows(n, n),
                covariance: image(&onward, &joint.view((0, 0), (2 * n, 2 * n)).into_owned()),
            }
        });
        let gain = regular.then(|| gain.rows(0, n).into_owned());
        Ok(Update { innovation, innovation_covariance, gain, filtered, ahead })
    }
}

/// The joint law of what a reading is made of, while its entries are taken.
struct Reader {
    /// ẑ
    shift: DVector<f64>,
    /// ẑ as a function of the innovations.
    gain: DMatrix<f64>,
    /// J
    joint: DMatrix<f64>,
    /// The magnitudes of what its entries were computed from.
    terms: DMatrix<f64>,
    /// Whether no entry was passed over.
    regular: bool,
}

impl Reader {
    /// Takes the reading `h z = value`, which is the combination `own` of the innovations; `of_h` is what h was computed from.
    fn take(&mut self, h: &DVector<f64>, of_h: &DVector<f64>, value: f64, own: &DVector<f64>) {
        let cross = &self.joint * h;
        let of_cross = &self.terms * h.abs() + self.joint.abs() * of_h;
        let variance = h.dot(&cross);
        let of_variance = h.abs().dot(&of_cross) + of_h.dot(&cross.abs());
        if is_rounding(variance, of_variance, h.len()) {
            self.regular = false;
            return;
        }
        let k = &cross / variance;
        self.shift += &k * (value - h.dot(&self.shift));
        self.gain = &self.gain + &k * (own.transpose() - h.transpose() * &self.gain);
        // Entries above the diagonal are copies of those below.
        let taken = DMatrix::from_fn(h.len(), h.len(), |i, j| k[i.max(j)] * cross[i.min(j)]);
        self.terms += (&of_cross / variance.abs()) * cross.abs().transpose()
            + k.abs() * of_cross.transpose()
            + k.abs() * k.abs().transpose() * of_variance;
        self.joint = settled(&self.joint - taken, &self.terms.diagonal(), h.len());
    }
}

/// `a p aᵀ`, where states that it leaves without variance are known.
fn image(a: &DMatrix<f64>, p: &DMatrix<f64>) -> DMatrix<f64> {
    let deviations = p.diagonal().map(|variance| variance.max(0.0).sqrt());
    let terms = (a.abs() * deviations).map(|deviation| deviation * deviation);
    settled(congruence(a, p), &terms, 2 * p.nrows())
}

/// `R = L D Lᵀ`, where a variance of which nothing is left but rounding is zero.
struct Decorrelation {
    /// L⁻¹
    whitening: DMatrix<f64>,
    /// D
    variances: DVector<f64>,
    /// The magnitudes of what D was computed from.
    terms: DVector<f64>,
}

impl Decorrelation {
    fn of(r: &DMatrix<f64>) -> Self {
        let m = r.nrows();
        let (mut schur, mut of_schur, mut whitening) = (r.clone(), r.abs(), DMatrix::identity(m, m));
        let mut variances = DVector::zeros(m);
        for k in 0..m {
            let (variance, of_variance) = (schur[(k, k)], of_schur[(k, k)]);
            variances[k] = rounded_off(variance, of_variance, m);
            if variances[k] == 0.0 {
                continue;
            }
            for i in k + 1..m {
                let factor = schur[(i, k)] / variance;
                let row = whitening.row(i) - whitening.row(k) * factor;
                whitening.set_row(i, &row);
                for j in k + 1..=i {
                    let other = schur[(j, k)].abs() / variance.abs();
                    of_schur[(i, j)] +=
                        factor.abs() * of_schur[(j, k)] + other * of_schur[(i, k)] + factor.abs() * other * of_variance;
                    schur[(i, j)] -= factor * schur[(j, k)];
                }
            }
        }
        let terms = of_schur.diagonal();
        Self { whitening, variances, terms }
    }
}
