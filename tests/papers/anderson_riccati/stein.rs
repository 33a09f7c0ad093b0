//! Lemma 4.2, its converse, and the spectral radius.

use exact_kalman::matrix::Matrix;
use exact_kalman::scalar::{Rational, ratio};
use proptest::collection::vec;
use proptest::prelude::*;

use super::draws::{Q, definite, integers, inverse, is_definite, matrices, power};

/// A part of a spectrum: a real eigenvalue, or a pair α ± iβ.
#[derive(Clone, Debug)]
enum Part {
    Real(Rational),
    Pair(Rational, Rational),
}

impl Part {
    fn block(&self) -> Q {
        let (rows, size) = match self {
            Self::Real(value) => (vec![value.clone()], 1),
            Self::Pair(re, im) => (vec![re.clone(), im.clone(), -im.clone(), re.clone()], 2),
        };
        Matrix::from_fn(size, size, |i, j| rows[i * size + j].clone())
    }

    fn squared_modulus(&self) -> Rational {
        match self {
            Self::Real(value) => value * value,
            Self::Pair(re, im) => re * re + im * im,
        }
    }
}

/// Eigenvalues on the unit circle and a little off it are as likely as others.
fn parts() -> impl Strategy<Value = Part> {
    let near = prop_oneof![
        Just(ratio(1, 1)),
        Just(ratio(999, 1000)),
        Just(ratio(1001, 1000)),
        Just(ratio(1, 2)),
        Just(ratio(0, 1))
    ];
    prop_oneof![
        (-12i64..=12, 1i64..=12).prop_map(|(a, b)| Part::Real(ratio(a, b))),
        (near.clone(), any::<bool>()).prop_map(|(scale, sign)| Part::Real(if sign { -scale } else { scale })),
        // Points of the circle, (3 + 4i)/5 and others by Pythagoras, times a factor.
        (near, 0i64..4, 1i64..4).prop_map(|(scale, m, n)| {
            let radius = ratio(m * m + n * n, 1);
            Part::Pair(ratio(m * m - n * n, 1) / &radius * &scale, ratio(2 * m * n, 1) / radius * scale)
        }),
        (-9i64..=9, -9i64..=9, 1i64..=9).prop_map(|(a, b, c)| Part::Pair(ratio(a, c), ratio(b, c))),
    ]
}

/// A matrix with a known spectrum: blocks, ones above the diagonal where both blocks are real (Jordan blocks, if they
/// are equal), seen in another basis.
fn spectra(most: usize) -> impl Strategy<Value = (Vec<Part>, Q)> {
    (vec(parts(), 1..=most), any::<bool>()).prop_flat_map(|(mut list, repeat)| {
        if let (true, [first, second, ..]) = (repeat, list.as_mut_slice()) {
            *second = first.clone();
        }
        let blocks = list.iter().fold(Matrix::zeros(0, 0), |all: Q, part| all.block_diagonal(&part.block()));
        let n = blocks.rows();
        matrices(n, n, 3).prop_map(move |basis| {
            let mut coupled = blocks.clone();
            for (i, pair) in list.windows(2).enumerate() {
                if let (true, [Part::Real(_), Part::Real(_)]) =
                    (list[..i].iter().all(|p| matches!(p, Part::Real(_))), pair)
                {
                    coupled[(i, i + 1)] = ratio(1, 1);
                }
            }
            let basis = if basis.rank() == n { basis } else { Matrix::identity(n) };
            (list.clone(), &basis * coupled * inverse(&basis))
        })
    })
}

fn is_stable(matrix: &Q) -> bool {
    matrix.spectral_radius_lt(&ratio(1, 1))
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 400, failure_persistence: None, ..ProptestConfig::default() })]

    /// AK-A.rho: the test finds ρ where the spectrum is known, on the circle and a thousandth off it, eigenvalues repeated.
    #[test]
    fn known_spectra_are_judged_rightly((list, a) in spectra(3), bound in (1i64..30, 1i64..20)) {
        let bound = ratio(bound.0, bound.1);
        let largest = list.iter().map(Part::squared_modulus).max().unwrap_or_else(|| ratio(0, 1));
        prop_assert_eq!(is_stable(&a), largest < ratio(1, 1));
        prop_assert_eq!(a.spectral_radius_lt(&bound), largest < &bound * &bound);
        prop_assert_eq!(a.transpose().spectral_radius_lt(&bound), largest < &bound * &bound);
    }

    /// AK-A.rho: the spectrum of a companion matrix is the roots of its polynomial.
    #[test]
    fn companion_matrices_are_judged_rightly(list in vec(parts(), 1..=3)) {
        let mut polynomial = vec![ratio(1, 1)];
        for part in &list {
            let factor = match part {
                Part::Real(root) => vec![-root.clone(), ratio(1, 1)],
                Part::Pair(re, _) => vec![part.squared_modulus(), re * ratio(-2, 1), ratio(1, 1)],
            };
            let mut product = vec![ratio(0, 1); polynomial.len() + factor.len() - 1];
            for (i, a) in polynomial.iter().enumerate() {
                for (j, b) in factor.iter().enumerate() {
                    product[i + j] += a * b;
                }
            }
            polynomial = product;
        }
        let n = polynomial.len() - 1;
        let companion = Matrix::from_fn(n, n, |i, j| match () {
            () if j + 1 == n => -polynomial[i].clone(),
            () => ratio(i64::from(i == j + 1), 1),
        });
        prop_assert_eq!(companion.characteristic_polynomial(), polynomial);
        let inside = list.iter().all(|part| part.squared_modulus() < ratio(1, 1));
        prop_assert_eq!(is_stable(&companion), inside);
    }

    /// AK-L4.2: and Stein's theorem, the hard half too: X − DXDᵀ = I has a positive definite solution iff ρ(D) < 1; and then
    /// F = X for Dᵀ is what the lemma asks for.
    #[test]
    fn stein_has_a_definite_solution_iff_stable((list, d) in spectra(2)) {
        let stable = list.iter().all(|part| part.squared_modulus() < ratio(1, 1));
        let n = d.rows();
        match d.stein_solution(&Matrix::identity(n)) {
            Ok(x) => {
                prop_assert_eq!(&x - d.congruence(&x), Matrix::identity(n));
                prop_assert_eq!(is_definite(&x), stable);
            }
            Err(error) => {
                prop_assert!(!stable);
                prop_assert!(!error.homogeneous.is_zero());
                prop_assert_eq!(d.congruence(&error.homogeneous), error.homogeneous);
            }
        }
    }

    /// AK-L4.2: whenever F > 0 and F − DᵀFD > 0, the test of the characteristic polynomial says ρ(D) < 1.
    #[test]
    fn a_decreasing_form_proves_stability(f in definite(3), d in matrices(3, 3, 2), scale in 1i64..6) {
        let d = d.scaled(&ratio(1, scale));
        if is_definite(&(&f - d.transpose().congruence(&f))) {
            prop_assert!(is_stable(&d));
            prop_assert!(is_stable(&d.transpose()), "ρ(D) = ρ(Dᵀ)");
        }
    }

    /// AK-L4.2-eigen: `Dx = λx  ⇒  x*(F − DᵀFD)x = (1 − |λ|²)x*Fx` with x = u + iv and λ = α + iβ, in real and imaginary parts.
    #[test]
    fn eigenvectors_carry_the_identity(
        f in definite(3), basis in matrices(3, 3, 3), re in -5i64..=5, im in -5i64..=5, real in -5i64..=5, scale in 1i64..=5
    ) {
        prop_assume!(basis.rank() == 3);
        let [alpha, beta, real] = [re, im, real].map(|entry| ratio(entry, scale));
        let blocks = Part::Pair(alpha.clone(), beta.clone()).block().block_diagonal(&Part::Real(real).block());
        let d = &basis * blocks * inverse(&basis);
        let (u, v) = (basis.select_columns(&[0]), basis.select_columns(&[1]));
        prop_assert_eq!(&d * &u, u.scaled(&alpha) - v.scaled(&beta));
        prop_assert_eq!(&d * &v, v.scaled(&alpha) + u.scaled(&beta));
        let form = |p: &Q| (u.transpose().congruence(p) + v.transpose().congruence(p))[(0, 0)].clone();
        let left = form(&(&f - d.transpose().congruence(&f)));
        prop_assert_eq!(left, (ratio(1, 1) - &alpha * &alpha - &beta * &beta) * form(&f));
    }
}

proptest! {
    // Thousands of powers each.
    #![proptest_config(ProptestConfig { cases: 60, failure_persistence: None, ..ProptestConfig::default() })]

    /// AK-Root: ρⁿ ≤ ‖Aⁿ‖ for every n (powers have powers of eigenvalues), and for any r > ρ some ‖Aⁿ‖ < rⁿ; so the n-th
    /// roots tend to ρ. Both sides are compared as squares of fractions, with r within a hundredth of ρ.
    #[test]
    fn roots_of_norms_tend_to_the_spectral_radius((list, a) in spectra(3)) {
        let largest = list.iter().map(Part::squared_modulus).max().unwrap_or_else(|| ratio(0, 1));
        prop_assume!(largest > ratio(0, 1));
        let above = &largest * ratio(101 * 101, 100 * 100);
        let (mut norm_power, mut lower, mut upper) = (a, largest, above);
        let mut below = false;
        // n = 1, 2, 4, …, 4096: enough for Jordan blocks of order 3 with entries of this size, with room to spare. Powers are
        // rounded: their norm only has to be above or below by a factor, never equal.
        for _ in 0..13 {
            let norm = norm_power.squared_norm();
            prop_assert!(norm >= &lower * ratio(999, 1000), "‖Aⁿ‖² = {norm} < ρ²ⁿ");
            below = norm < upper;
            norm_power = shortened(&(&norm_power * &norm_power));
            (lower, upper) = (short(&(&lower * &lower)), short(&(&upper * &upper)));
        }
        prop_assert!(below);
    }
}

/// A fraction to 400 significant bits: relative errors of 2⁻⁴⁰⁰, doubled in each of 13 squarings.
fn short(value: &Rational) -> Rational {
    exact_kalman::scalar::Precision::Rounded { bits: 400 }.of(value)
}

fn shortened(matrix: &Q) -> Q {
    matrix.map(short)
}

/// Erratum AK-Root: printed, ‖Aⁿ‖/n tends to ρ(A). For A = 1/2 the n-th root of ‖Aⁿ‖ is 1/2 at every n; the quotient tends to
/// zero.
#[test]
fn it_is_the_root_that_tends_to_the_radius() {
    let a = integers(&[[1]]).scaled(&ratio(1, 2));
    let radius = ratio(1, 2);
    for n in 1..60_u8 {
        let norm = power(&a, usize::from(n)).squared_norm();
        let expected = (0..n).fold(ratio(1, 1), |power, _| power * &radius * &radius);
        assert_eq!(norm, expected, "the n-th root of ‖Aⁿ‖ is ρ(A)");
        // (‖Aⁿ‖/n)² against (1/(2n))²
        let quotient = norm / ratio(i64::from(n) * i64::from(n), 1);
        assert!(quotient <= ratio(1, 4 * i64::from(n) * i64::from(n)), "‖Aⁿ‖/n is not near ρ(A) = 1/2");
        assert_eq!(quotient == &radius * &radius, n == 1);
    }
    assert!(!a.spectral_radius_lt(&radius) && a.spectral_radius_lt(&ratio(51, 100)));
}

/// AK-L4.2: strictness is needed: F − DᵀFD = 0 for D = I and any F, and ρ(I) = 1.
#[test]
fn the_lemma_needs_strictness() {
    let (d, f) = (Matrix::identity(2), integers(&[[2, 1], [1, 3]]));
    assert!((&f - d.transpose().congruence(&f)).is_zero());
    assert!(!is_stable(&d));
    // F > 0 is needed as well: −1 − 2·(−1)·2 = 3 > 0 and ρ(2) = 2.
    let (d, f) = (integers(&[[2]]), integers(&[[-1]]));
    assert!(is_definite(&(&f - d.transpose().congruence(&f))));
    assert!(!is_stable(&d));
}

/// Erratum AK-L4.2-eigen: printed with a transposed real x, where λ may be complex. D = [[0, c], [−c, 0]] with F = I has
/// x = (1, i) and λ = ci: the printed left side is 0 for every c, and says nothing of |λ|; with x* it is 2(1 − c²).
#[test]
fn complex_eigenvectors_need_the_conjugate_transpose() {
    for c in -3..=3 {
        let d = integers(&[[0, c], [-c, 0]]);
        let (u, v) = (integers(&[[1], [0]]), integers(&[[0], [1]]));
        // D(u + iv) = ci(u + iv)
        assert_eq!((&d * &u, &d * &v), (v.scaled(&ratio(-c, 1)), u.scaled(&ratio(c, 1))));
        let m = Matrix::identity(2) - d.transpose() * &d;
        let form = |left: &Q, right: &Q| (left.transpose() * &m * right)[(0, 0)].clone();
        let conjugate = form(&u, &u) + form(&v, &v);
        let printed = (form(&u, &u) - form(&v, &v), form(&u, &v) + form(&v, &u));
        assert_eq!(conjugate, ratio(2 * (1 - c * c), 1));
        assert_eq!(printed, (ratio(0, 1), ratio(0, 1)));
        assert_eq!(conjugate > ratio(0, 1), is_stable(&d));
    }
}
