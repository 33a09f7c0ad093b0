//! The map of Riccati and the filter on it, with singular matrices in every place, against minors and adjugates.

use exact_kalman::matrix::Matrix;
use exact_kalman::riccati::RiccatiMap;
use exact_kalman::scalar::Rational;

use crate::minors::{is_semidefinite, pseudo_inverse, rank, schur_complement};
use crate::worlds::{covariances, matrices, signs};

type Q = Matrix<Rational>;

/// S − S(S + W)⁺S as a Schur complement, entry by entry a quotient of minors.
fn filtered(s: &Q, w: &Q) -> Q {
    let total = s + w;
    schur_complement(&s.beside(s).above(&s.beside(&total)), &[0, 1], &[2, 3])
}

/// AK-2.5, AK-4.1, AK-4.2, AK-1.4a, AK-1.4b, AK-1.4c: image, bounds, gain and covariances, V, W and S singular or not.
///
/// Domain: all 2×2 matrices A over {−1, 0, 1}, all positive semidefinite 2×2 matrices V, W and S (or P) over {−1, 0, 1}.
#[test]
fn images_and_steps_of_all_small_models() {
    let world = covariances(2, 1);
    let (mut count, mut singular) = (0, 0);
    for a in matrices(2, 2, &signs()) {
        let moved = |p: &Q| &a * p * a.transpose();
        for (v, w) in world.iter().flat_map(|v| world.iter().map(move |w| (v, w))) {
            let map = RiccatiMap::new(a.clone(), v.clone(), w.clone()).unwrap_or_else(|error| panic!("{error}"));
            let upper = moved(w) + v;
            assert_eq!(map.upper_bound(), upper);
            for s in &world {
                let image = map.image(s);
                assert_eq!(image, moved(&filtered(s, w)) + v, "A = {a}, V = {v}, W = {w}, S = {s}");
                assert!(is_semidefinite(&(&image - v)) && is_semidefinite(&(&upper - &image)));
                let step = map.step(s);
                let predicted = moved(s) + v;
                assert_eq!(step.filtered, filtered(&predicted, w), "A = {a}, V = {v}, W = {w}, P = {s}");
                assert_eq!(step.gain, &predicted * pseudo_inverse(&(&predicted + w)));
                assert_eq!(step.predicted, predicted);
                singular += usize::from(rank(&(s + w)) < 2);
                count += 1;
            }
        }
    }
    assert_eq!((world.len(), count), (6, 81 * 6 * 6 * 6));
    assert!(singular > 5000, "{singular}");
}
