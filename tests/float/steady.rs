//! Parallel sum, fixed point and Stein solution in `f64`, judged by the digits that the data allow.
//!
//! A problem of doubles is solved exactly; then again with every datum moved by a relative 2⁻⁵³, up or down, twenty times:
//! the worst of these answers has the digits that are attainable. Two digits less are allowed, as in the judge's verdicts.

use exact_kalman::float;
use exact_kalman::matrix::Matrix;
use exact_kalman::riccati::RiccatiMap;
use exact_kalman::scalar::{Rational, ratio};
use num_traits::ToPrimitive;
use proptest::collection::vec;
use proptest::prelude::*;

pub(crate) type Q = Matrix<Rational>;

const PERTURBATIONS: u64 = 20;
pub(crate) const ALLOWED: f64 = 2.0;
/// What stands for exact.
const ALL: f64 = 17.0;

/// −log₁₀ of the greatest error, in units of the standard deviations that the exact covariance has: √(xᵢᵢxⱼⱼ).
pub(crate) fn digits(found: &Q, exact: &Q) -> f64 {
    let places = (0..exact.rows()).flat_map(|i| (0..exact.columns()).map(move |j| (i, j)));
    let of = |(i, j): (usize, usize)| {
        let error = (&found[(i, j)] - &exact[(i, j)]).to_f64().unwrap_or(f64::NAN).abs();
        let scale = (&exact[(i, i)] * &exact[(j, j)]).to_f64().unwrap_or(f64::NAN).sqrt();
        if error == 0.0 { ALL } else { (-(error / scale).log10()).min(ALL) }
    };
    places.map(of).fold(ALL, f64::min)
}

pub(crate) fn rational(matrix: &Matrix<f64>) -> Q {
    matrix.try_map(|&entry| Rational::from_float(entry).ok_or(())).expect("finite results")
}

pub(crate) fn doubles(matrix: &Q) -> Matrix<f64> {
    let double =
        |entry: &Rational| entry.to_f64().filter(|double| Rational::from_float(*double).as_ref() == Some(entry));
    matrix.try_map(|entry| double(entry).ok_or(())).expect("dyadic data")
}

/// A seeded stream of signs: the top bits of Knuth's linear congruential generator.
pub(crate) struct Signs(u64);

impl Signs {
    fn next(&mut self) -> bool {
        self.0 = self.0.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        self.0 >> 63 == 0
    }

    pub(crate) fn moved(&mut self, matrix: &Q) -> Q {
        let unit = ratio(1, 1 << 53);
        matrix.map(|entry| if self.next() { entry * (ratio(1, 1) + &unit) } else { entry * (ratio(1, 1) - &unit) })
    }

    /// Symmetric entries alike.
    pub(crate) fn moved_symmetric(&mut self, matrix: &Q) -> Q {
        let moved = self.moved(matrix);
        Matrix::from_fn(matrix.rows(), matrix.rows(), |i, j| moved[(i.max(j), i.min(j))].clone())
    }
}

/// The digits of the worst of the nearby problems' answers.
pub(crate) fn attainable(exact: &Q, mut nearby: impl FnMut(&mut Signs) -> Option<Q>) -> f64 {
    let worst = (0..PERTURBATIONS).filter_map(|seed| nearby(&mut Signs(seed))).map(|answer| digits(&answer, exact));
    worst.fold(16.0, f64::min)
}

pub(crate) fn matrices(rows: usize, columns: usize) -> impl Strategy<Value = Q> {
    vec(-8i64..=8, rows * columns)
        .prop_map(move |entries| Matrix::from_fn(rows, columns, |i, j| ratio(entries[i * columns + j], 4)))
}

/// Positive definite, with entries that are doubles; the floor is at times small.
pub(crate) fn definite(n: usize) -> impl Strategy<Value = Q> {
    (matrices(n, n), 0u32..12)
        .prop_map(move |(root, floor)| &root * root.transpose() + Matrix::identity(n).scaled(&ratio(1, 1 << floor)))
}

fn semidefinite(n: usize) -> impl Strategy<Value = Q> {
    (0..=n).prop_flat_map(move |rank| matrices(n, rank)).prop_map(|root| &root * root.transpose())
}

fn parallel_sum(f: &Q, g: &Q) -> Q {
    f.parallel_sum(g).expect("a rational matrix has a pseudo-inverse")
}

/// The fixed point to twenty digits: more than any double has.
fn fixed_point(a: &Q, v: &Q, w: &Q) -> Option<Q> {
    let map = RiccatiMap::new(a.clone(), v.clone(), w.clone()).ok()?;
    let smallest = (0..v.rows()).map(|i| v[(i, i)].clone()).min()?;
    let gap = smallest / Rational::from_integer(num_bigint::BigInt::from(10).pow(20));
    let found = map.fixed_point(&gap, 300).ok()?;
    Some((found.lower + found.upper).scaled(&ratio(1, 2)))
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 64, failure_persistence: None, ..ProptestConfig::default() })]

    /// AK-Par: two covariances, the sum regular.
    #[test]
    fn parallel_sums_keep_their_digits((f, g) in (1usize..=3).prop_flat_map(|n| (definite(n), definite(n)))) {
        let exact = parallel_sum(&f, &g);
        let found = float::parallel_sum(&doubles(&f), &doubles(&g)).expect("finite data");
        prop_assert_eq!(found.asymmetry(), None);
        let attainable = attainable(&exact, |signs| Some(parallel_sum(&signs.moved_symmetric(&f), &signs.moved_symmetric(&g))));
        let digits = digits(&rational(&found), &exact);
        prop_assert!(digits >= attainable - ALLOWED, "{digits:.1} digits of {attainable:.1}");
    }

    /// AK-Par: a singular sum: F = KF₀Kᵀ and G = KG₀Kᵀ, whose parallel sum is K(F₀:G₀)Kᵀ; factors are moved, so the rank stays.
    #[test]
    fn singular_parallel_sums_keep_their_digits(
        (f, g) in (1usize..=2).prop_flat_map(|n| (definite(n), definite(n))), rows in vec(vec(-2i64..=2, 2), 1)
    ) {
        let n = f.rows();
        // The identity, and below it a row: full column rank.
        let k = Matrix::<Rational>::identity(n).above(&Matrix::from_fn(1, n, |_, j| ratio(rows[0][j], 2)));
        let (whole_f, whole_g) = (k.congruence(&f), k.congruence(&g));
        let exact = parallel_sum(&whole_f, &whole_g);
        prop_assert_eq!(&exact, &k.congruence(&parallel_sum(&f, &g)));
        let found = float::parallel_sum(&doubles(&whole_f), &doubles(&whole_g)).expect("finite data");
        // A row of zeros in K has no deviation to scale by.
        prop_assume!((0..=n).all(|i| exact[(i, i)] > ratio(0, 1)));
        let attainable = attainable(&exact, |signs| {
            let k = signs.moved(&k);
            Some(k.congruence(&parallel_sum(&signs.moved_symmetric(&f), &signs.moved_symmetric(&g))))
        });
        let digits = digits(&rational(&found), &exact);
        prop_assert!(digits >= attainable - ALLOWED, "{digits:.1} digits of {attainable:.1}");
    }
}

proptest! {
    // Each case takes twenty-one exact solutions.
    #![proptest_config(ProptestConfig { cases: 16, failure_persistence: None, ..ProptestConfig::default() })]

    /// AK-T2.3: the fixed point by doubling, for stable and unstable A and singular W.
    #[test]
    fn fixed_points_keep_their_digits((a, v, w) in (1usize..=3).prop_flat_map(|n| (matrices(n, n), definite(n), semidefinite(n)))) {
        let Some(exact) = fixed_point(&a, &v, &w) else { return Err(TestCaseError::reject("slow")) };
        let found = float::riccati_fixed_point(&doubles(&a), &doubles(&v), &doubles(&w)).expect("V > 0");
        prop_assert_eq!(found.asymmetry(), None);
        let singular = w.rank() < w.rows();
        let attainable = attainable(&exact, |signs| {
            // A singular W keeps its rank.
            let w = if singular { w.clone() } else { signs.moved_symmetric(&w) };
            fixed_point(&signs.moved(&a), &signs.moved_symmetric(&v), &w)
        });
        let digits = digits(&rational(&found), &exact);
        prop_assert!(digits >= attainable - ALLOWED, "{digits:.1} digits of {attainable:.1}");
    }
    /// AK-L4.2: Stein's equation by doubling, with ρ(D) below 1 by the exact test.
    #[test]
    fn stein_solutions_keep_their_digits((d, q) in (1usize..=3).prop_flat_map(|n| (matrices(n, n), definite(n))), scale in 0u32..3) {
        let d = d.scaled(&ratio(1, 1 << scale));
        prop_assume!(d.spectral_radius_lt(&ratio(1, 1)));
        let solution = |d: &Q, q: &Q| d.stein_solution(q).ok();
        let exact = solution(&d, &q).expect("ρ(D) < 1");
        let found = float::stein_solution(&doubles(&d), &doubles(&q)).expect("ρ(D) < 1");
        prop_assert_eq!(found.asymmetry(), None);
        let attainable = attainable(&exact, |signs| solution(&signs.moved(&d), &signs.moved_symmetric(&q)));
        let digits = digits(&rational(&found), &exact);
        prop_assert!(digits >= attainable - ALLOWED, "{digits:.1} digits of {attainable:.1}");
    }
}

#[test]
fn what_has_no_solution_is_an_error() {
    use exact_kalman::float::FloatMatrixError;
    let number = |value: f64| Matrix::column(vec![value]);
    assert_eq!(float::stein_solution(&number(2.0), &number(1.0)), Err(FloatMatrixError::NotFinite));
    // Terms that neither shrink nor overflow within the doublings.
    assert_eq!(float::stein_solution(&number(1.0), &number(1.0)), Err(FloatMatrixError::Unconverged));
    assert_eq!(float::riccati_fixed_point(&number(2.0), &number(0.0), &number(0.0)), Err(FloatMatrixError::Singular));
    assert_eq!(float::parallel_sum(&number(f64::NAN), &number(1.0)), Err(FloatMatrixError::NotFinite));
}
