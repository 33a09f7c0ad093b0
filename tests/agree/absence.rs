//! Modes planted in models: those that forbid a stabilising solution are found with a proof, and without them the iteration of
//! Riccati's equation arrives at one.

use exact_kalman::certify::{Absence, Existence, Unknown};
use exact_kalman::matrix::Matrix;
use exact_kalman::model::UnifiedStep;
use exact_kalman::scalar::{Rational, ratio};
use num_traits::{Signed, ToPrimitive, Zero};
use proptest::prelude::*;

type Exact = Matrix<Rational>;

/// A block with what is known of its eigenvalues.
struct Block {
    matrix: Exact,
    /// Whether one has modulus 1 or more.
    is_unstable: bool,
    /// Whether one has modulus 1.
    is_on_circle: bool,
}

/// The matrix with the characteristic polynomial z^d + a₍d₋₁₎ z^(d−1) + … + a₀, from a₀ upwards.
fn companion(coefficients: &[(i64, i64)]) -> Exact {
    let d = coefficients.len();
    Matrix::from_fn(d, d, |i, j| {
        if j + 1 == d { ratio(-coefficients[i].0, coefficients[i].1) } else { ratio(i64::from(i == j + 1), 1) }
    })
}

fn jordan(block: &Exact) -> Exact {
    let d = block.rows();
    block.beside(&Matrix::identity(d)).above(&Matrix::zeros(d, d).beside(block))
}

/// Blocks of every kind; where an eigenvalue lies is known by construction, or from the polynomial's theory.
fn blocks() -> Vec<Block> {
    let number = |a: i64, b: i64| companion(&[(-a, b)]);
    let rotation =
        Matrix::from_rows(vec![vec![ratio(3, 5), ratio(-4, 5)], vec![ratio(4, 5), ratio(3, 5)]]).expect("square");
    let irrational = companion(&[(1, 1), (-1, 2)]);
    let of = |matrix: Exact, is_unstable, is_on_circle| Block { matrix, is_unstable, is_on_circle };
    vec![
        of(number(1, 2), false, false),
        of(number(2, 1), true, false),
        of(number(1, 1), true, true),
        of(number(-1, 1), true, true),
        of(number(0, 1), false, false),
        of(rotation.clone(), true, true),
        of(rotation.scaled(&ratio(4, 5)), false, false),
        of(rotation.scaled(&ratio(5, 4)), true, false),
        // 2 cos θ = 1/2.
        of(irrational.clone(), true, true),
        of(jordan(&number(1, 1)), true, true),
        of(jordan(&number(1, 2)), false, false),
        of(jordan(&irrational), true, true),
        of(irrational.block_diagonal(&irrational), true, true),
        of(jordan(&rotation).block_diagonal(&rotation), true, true),
        // Pairs z and 1/z that are not on the circle, of fractions and of (3 ± √5)/2.
        of(number(2, 1).block_diagonal(&number(1, 2)), true, false),
        of(companion(&[(1, 1), (-3, 1)]), true, false),
        of(jordan(&companion(&[(1, 1), (-3, 1)])), true, false),
        // A polynomial of Salem: one root outside, one inside, two on the circle; it is irreducible.
        of(companion(&[(1, 1), (-1, 1), (-1, 1), (-1, 1)]), true, true),
        // The primitive fifth roots of one.
        of(companion(&[(1, 1), (1, 1), (1, 1), (1, 1)]), true, true),
        of(number(3, 2).block_diagonal(&irrational).block_diagonal(&number(2, 3)), true, true),
        // 4, 1/2, −1/2: the product is 1, yet no two are inverse to each other.
        of(companion(&[(1, 1), (-1, 4), (-4, 1)]), true, false),
        // z³ − z − 1 has the root 1.32…; (z/2)³ − z/2 − 1 scaled to be inside.
        of(companion(&[(-1, 1), (-1, 1), (0, 1)]), true, false),
        of(companion(&[(-1, 8), (-1, 4), (0, 1)]), false, false),
        of(jordan(&number(0, 1)), false, false),
    ]
}

/// A matrix of integers with determinant 1, and its inverse.
fn similarity(n: usize, shears: &[(usize, usize, i64)]) -> (Exact, Exact) {
    let (mut matrix, mut inverse) = (Matrix::identity(n), Matrix::identity(n));
    for &(i, j, factor) in shears {
        let (i, j) = (i % n, j % n);
        if i == j {
            continue;
        }
        let shear = |factor| {
            let mut shear: Exact = Matrix::identity(n);
            shear[(i, j)] = ratio(factor, 1);
            shear
        };
        matrix = shear(factor) * matrix;
        inverse = inverse * shear(-factor);
    }
    (matrix, inverse)
}

fn filled(rows: usize, columns: usize, entries: &[i64], denominator: i64) -> Exact {
    Matrix::from_fn(rows, columns, |i, j| ratio(entries[(i * columns + j) % entries.len()], denominator))
}

fn covariance(order: usize, entries: &[i64]) -> Exact {
    let factor = filled(order, order, entries, 2);
    &factor * factor.transpose() + Matrix::identity(order)
}

/// `z = T x` in place of x, and noise shared by the gain L: A + L H, Q + L R Lᵀ, S = L R.
fn disguised(step: UnifiedStep, (t, inverse): &(Exact, Exact), shared: &Exact) -> UnifiedStep {
    let r = step.observation_noise;
    let transition = step.transition + shared * &step.observation;
    UnifiedStep {
        transition: t * transition * inverse,
        observation: step.observation * inverse,
        process_noise: t.congruence(&(step.process_noise + shared.congruence(&r))),
        cross_noise: t * shared * &r,
        observation_noise: r,
    }
}

/// Every claim of a proof, by other means than the search: ranks, identities, Schur and Cohn, and signs.
fn is_proof(absence: &Absence, step: &UnifiedStep) -> bool {
    let one = ratio(1, 1);
    match absence {
        Absence::Unobservable { basis, map } => {
            basis.rank() == map.rows()
                && &step.transition * basis == basis * map
                && (&step.observation * basis).is_zero()
                && !map.spectral_radius_lt(&one)
        }
        Absence::Unreachable { basis, injection, map, between } => {
            let noise = step.process_noise.beside(&step.cross_noise);
            let noise = noise.above(&step.cross_noise.transpose().beside(&step.observation_noise));
            let identities = basis.rank() == map.rows()
                && (basis.beside(&-injection) * noise).is_zero()
                && basis * &step.transition - injection * &step.observation == map * basis;
            let is_singular = |shift: &Rational| {
                (map - Matrix::identity(map.rows()).scaled(shift)).determinant().is_ok_and(|d| d.is_zero())
            };
            identities
                && match between {
                    None => is_singular(&one) || is_singular(&-one),
                    Some((low, high)) => {
                        let h = unfolded(&map.characteristic_polynomial());
                        let value = |c: &Rational| h.iter().rev().fold(Rational::zero(), |sum, a| sum * c + a);
                        low.abs() <= ratio(2, 1)
                            && high.abs() <= ratio(2, 1)
                            && !(value(low) * value(high)).is_positive()
                    }
                }
        }
    }
}

/// h with `p(z) = Σ hⱼ (z² + 1)ʲ z^(d−j)`, from the highest j downwards; p has no other powers left in the end.
fn unfolded(p: &[Rational]) -> Vec<Rational> {
    let d = p.len() / 2;
    assert_eq!(p.len(), 2 * d + 1, "of even degree");
    let mut rest = p.to_vec();
    let mut h = vec![Rational::zero(); d + 1];
    for j in (0..=d).rev() {
        h[j] = rest[d + j].clone();
        let mut binomial = ratio(1, 1);
        for i in 0..=j {
            let power = d - j + 2 * i;
            rest[power] = &rest[power] - &h[j] * &binomial;
            binomial *= ratio(i64::try_from(j - i).expect("small"), i64::try_from(i + 1).expect("small"));
        }
    }
    assert!(rest.iter().all(Zero::is_zero), "self-reciprocal");
    h
}

/// Whether the iteration from a large start arrives where the closed loop contracts, in doubles.
fn arrives(step: &UnifiedStep) -> bool {
    let double = |matrix: &Exact| {
        nalgebra::DMatrix::from_fn(matrix.rows(), matrix.columns(), |i, j| matrix[(i, j)].to_f64().expect("a number"))
    };
    let (a, h) = (double(&step.transition), double(&step.observation));
    let (q, s, r) = (double(&step.process_noise), double(&step.cross_noise), double(&step.observation_noise));
    let mut p = nalgebra::DMatrix::identity(a.nrows(), a.nrows()) * 1000.0;
    let mut closed = a.clone();
    for _ in 0..2000 {
        let Some(inverse) = (&h * &p * h.transpose() + &r).try_inverse() else { return false };
        let gain = (&a * &p * h.transpose() + &s) * inverse;
        closed = &a - &gain * &h;
        let cross = &gain * s.transpose();
        p = &closed * &p * closed.transpose() + &q - &cross - cross.transpose() + &gain * &r * gain.transpose();
    }
    // ‖G^1024‖ < 1 proves ρ(G) < 1, up to rounding.
    for _ in 0..10 {
        closed = &closed * &closed;
    }
    closed.norm() < 1.0
}

fn shears() -> impl Strategy<Value = Vec<(usize, usize, i64)>> {
    proptest::collection::vec((0usize..12, 0usize..12, -2i64..=2), 0..8)
}

fn entries() -> impl Strategy<Value = Vec<i64>> {
    proptest::collection::vec(-3i64..=3, 7..23)
}

/// A planted block that no sensor sees, beside a part that is seen; all of the noise is regular.
fn unobserved(block: &Exact, seen: usize, entries: &[i64]) -> UnifiedStep {
    let (k, n) = (block.rows(), block.rows() + seen);
    // The shift and the first coordinate are observable whatever the last column is.
    let shift = Matrix::from_fn(seen, seen, |i, j| {
        if j == i + 1 {
            ratio(1, 1)
        } else if i + 1 == seen {
            ratio(entries[j % entries.len()], 3)
        } else {
            ratio(0, 1)
        }
    });
    let upper = shift.beside(&Matrix::zeros(seen, k));
    UnifiedStep {
        transition: upper.above(&filled(k, seen, entries, 1).beside(block)),
        observation: Matrix::from_fn(1, n, |_, j| ratio(i64::from(j == 0 && seen > 0), 1)),
        process_noise: covariance(n, entries),
        cross_noise: Matrix::zeros(n, 1),
        observation_noise: covariance(1, entries),
    }
}

/// A planted block that no noise reaches, beside a part that it reaches; all states are seen.
fn unreached(block: &Exact, reached: usize, entries: &[i64]) -> UnifiedStep {
    let (k, n) = (block.rows(), block.rows() + reached);
    let upper = filled(reached, reached, entries, 2).beside(&filled(reached, k, entries, 1));
    UnifiedStep {
        transition: upper.above(&Matrix::zeros(k, reached).beside(block)),
        observation: similarity(n, &[(0, 1, 2), (1, 2, -1), (2, 0, 1)]).0,
        process_noise: covariance(reached, entries).block_diagonal(&Matrix::zeros(k, k)),
        cross_noise: Matrix::zeros(n, n),
        observation_noise: covariance(n, &entries[1..]),
    }
}

fn judge(step: &UnifiedStep, is_absent: bool) -> Result<(), TestCaseError> {
    match Existence::of(step) {
        Existence::Absent(absence) => {
            prop_assert!(is_absent, "{absence}");
            prop_assert!(is_proof(&absence, step), "{absence:?}");
            prop_assert!(!absence.to_string().is_empty());
        }
        Existence::Present => {
            prop_assert!(!is_absent);
            prop_assert!(arrives(step));
        }
        Existence::Undecided(unknown) => prop_assert!(false, "{unknown}"),
    }
    Ok(())
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 200, ..ProptestConfig::default() })]

    /// EK-T7a: unobservable modes forbid a solution if and only if one has modulus 1 or more; coordinates and shared noise change nothing.
    #[test]
    fn unobservable_modes_are_found(
        place in 0..blocks().len(), seen in 0usize..4, entries in entries(), shears in shears(), share in -2i64..=2,
    ) {
        let block = &blocks()[place];
        let plain = unobserved(&block.matrix, seen, &entries);
        let n = plain.states();
        let step = disguised(plain, &similarity(n, &shears), &filled(n, 1, &entries, 1).scaled(&ratio(share, 2)));
        judge(&step, block.is_unstable)?;
    }

    /// EK-T7b: modes that no noise reaches forbid a solution if and only if one is on the circle; coordinates and shared noise change nothing.
    #[test]
    fn unreachable_modes_are_found(
        place in 0..blocks().len(), reached in 0usize..4, entries in entries(), shears in shears(), share in -2i64..=2,
    ) {
        let block = &blocks()[place];
        let plain = unreached(&block.matrix, reached, &entries);
        let n = plain.states();
        let step = disguised(plain, &similarity(n, &shears), &filled(n, n, &entries, 1).scaled(&ratio(share, 2)));
        judge(&step, block.is_on_circle)?;
    }
}

fn zeros(rows: usize, columns: usize) -> Exact {
    Matrix::zeros(rows, columns)
}

/// Eigenvalues that doubles cannot tell from 1 are told from it.
#[test]
fn eigenvalues_next_to_the_circle_are_told_from_it() {
    let tiny = Rational::new(1.into(), num_bigint::BigInt::from(10).pow(40));
    for (eigenvalue, is_absent) in [(ratio(1, 1) - &tiny, false), (ratio(1, 1) + &tiny, true)] {
        let unseen = unobserved(&Matrix::diagonal(std::slice::from_ref(&eigenvalue)), 2, &[1, 2, -1]);
        assert_eq!(matches!(Existence::of(&unseen), Existence::Absent(_)), is_absent);
        let still = unreached(&Matrix::diagonal(&[eigenvalue]), 2, &[1, 2, -1]);
        assert_eq!(Existence::of(&still), Existence::Present);
    }
    // e^{±iθ} with 2 cos θ = 2 − 10⁻⁴⁰: the bracket is as narrow as needed.
    let slow = ratio(2, 1) - tiny;
    let rotation = Matrix::from_rows(vec![vec![slow, ratio(-1, 1)], vec![ratio(1, 1), ratio(0, 1)]]).expect("square");
    let step = unreached(&rotation, 1, &[1, 2, -1]);
    let Existence::Absent(absence) = Existence::of(&step) else { panic!("no noise reaches it") };
    assert!(is_proof(&absence, &step));
}

/// Rows in which the row of squares (1, 4, 9, …) has no share of one mode of a pair: other rows are tried.
#[test]
fn a_mode_that_the_first_row_misses_is_found_with_others() {
    // (4, −1) is an eigenvector of 2, and (1, 4) (4, −1)ᵀ = 0.
    let vectors =
        Matrix::from_rows(vec![vec![ratio(4, 1), ratio(1, 1)], vec![ratio(-1, 1), ratio(0, 1)]]).expect("2×2");
    let values = Matrix::diagonal(&[ratio(2, 1), ratio(1, 2)]);
    let pair = &vectors * &values * vectors.inverse().expect("regular");
    assert_eq!(Existence::of(&unreached(&pair, 0, &[1, 2, -1])), Existence::Present);
    let unseen = unobserved(&pair.transpose(), 0, &[1, 2, -1]);
    let Existence::Absent(absence) = Existence::of(&unseen) else { panic!("2 is not seen") };
    assert!(is_proof(&absence, &unseen));
    // Beside a pair on the circle.
    let circle = companion(&[(1, 1), (-1, 2)]);
    let coordinates = similarity(4, &[(0, 3, 2), (2, 0, -2), (2, 3, 2)]);
    for block in [&pair.block_diagonal(&circle), &circle.block_diagonal(&pair), &blocks()[19].matrix] {
        let still = unreached(block, 0, &[0, 0, 0]);
        let still = disguised(still, &coordinates, &zeros(4, 4));
        let Existence::Absent(absence) = Existence::of(&still) else { panic!("no noise reaches it") };
        assert!(is_proof(&absence, &still));
    }
}

/// Where R is singular what is found is a proof, and nothing found is no proof.
#[test]
fn a_singular_covariance_of_the_observations_is_never_taken_for_a_proof() {
    let number = |value| Matrix::diagonal(&[ratio(value, 1)]);
    let step = |a: i64, h: i64, q: i64, r: i64| UnifiedStep {
        transition: number(a),
        observation: number(h),
        process_noise: number(q),
        cross_noise: number(0),
        observation_noise: number(r),
    };
    assert_eq!(Existence::of(&step(2, 1, 1, 0)), Existence::Undecided(Unknown::SingularNoise));
    assert_eq!(Existence::of(&step(2, 1, -1, 1)), Existence::Undecided(Unknown::IndefiniteNoise));
    // Exact readings of a state that no noise moves: every injection maps the state to another multiple of itself.
    assert_eq!(Existence::of(&step(2, 1, 0, 0)), Existence::Undecided(Unknown::SingularNoise));
    let nothing_seen = step(2, 0, 1, 0);
    let Existence::Absent(absence) = Existence::of(&nothing_seen) else { panic!("nothing is seen") };
    assert!(is_proof(&absence, &nothing_seen));
    assert_eq!(absence.to_string(), "no gain moves the eigenvalue 2: unobservable, and not stable");
    // No sensors at all.
    let blind = |a: i64| UnifiedStep {
        transition: number(a),
        observation: zeros(0, 1),
        process_noise: number(1),
        cross_noise: zeros(1, 0),
        observation_noise: zeros(0, 0),
    };
    assert!(matches!(Existence::of(&blind(-1)), Existence::Absent(_)));
    assert_eq!(Existence::of(&blind(0)), Existence::Present);

    // x₁₊ = x₂ + w, x₂₊ = a x₂, y = x₁ − x₂ without noise: the zero of the noise that y sees decides.
    // u = (u₁, u₂) with uQ = 0 is (0, 1); Y is free: (0, 1)A − Y(1, −1) = λ(0, 1) needs Y = 0, λ = a.
    let zero_at = |a: i64| UnifiedStep {
        transition: Matrix::from_integers(&[[0, 1], [0, a]]),
        observation: Matrix::from_integers(&[[1, -1]]),
        process_noise: Matrix::from_integers(&[[1, 0], [0, 0]]),
        cross_noise: zeros(2, 1),
        observation_noise: number(0),
    };
    let Existence::Absent(absence) = Existence::of(&zero_at(-1)) else { panic!("no noise reaches -1") };
    assert!(is_proof(&absence, &zero_at(-1)));
    assert_eq!(Existence::of(&zero_at(2)), Existence::Undecided(Unknown::SingularNoise));
    assert!(arrives(&zero_at(2)));

    // Noise enters both states, exact readings: the zero of (A, b; h, 0) at 1, which is no eigenvalue of A. With b = (1, 1):
    // u = (1, −1), uA − Y h = u with A = diag(2, 3): (2, −3) − Y h = (1, −1) for h = (1, −2), Y = 1.
    let with_zero = UnifiedStep {
        transition: Matrix::from_integers(&[[2, 0], [0, 3]]),
        observation: Matrix::from_integers(&[[1, -2]]),
        process_noise: Matrix::from_integers(&[[1, 1], [1, 1]]),
        cross_noise: zeros(2, 1),
        observation_noise: number(0),
    };
    let Existence::Absent(absence) = Existence::of(&with_zero) else { panic!("a zero at 1") };
    assert!(is_proof(&absence, &with_zero), "{absence:?}");
    assert_eq!(absence.to_string(), "no noise reaches the eigenvalue 1, on the unit circle");
}

/// A chain of a hundred integrators, with and without noise, and a hundred states of doubles: decided, and soon.
#[test]
fn a_hundred_states_are_decided() {
    let n = 100;
    let chain = |noise: i64| UnifiedStep {
        transition: Matrix::from_fn(n, n, |i, j| ratio(i64::from(i == j || j == i + 1), 1)),
        observation: Matrix::from_fn(1, n, |_, j| ratio(i64::from(j == 0), 1)),
        process_noise: Matrix::from_fn(n, n, |i, j| ratio(noise * i64::from(i == j && i + 1 == n), 1)),
        cross_noise: zeros(n, 1),
        observation_noise: Matrix::identity(1),
    };
    assert_eq!(Existence::of(&chain(1)), Existence::Present);
    let Existence::Absent(absence) = Existence::of(&chain(0)) else { panic!("no noise") };
    assert!(is_proof(&absence, &chain(0)));
    let mut state = 1u64;
    let mut double = || {
        state = state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        Rational::new(num_bigint::BigInt::from(state >> 11), num_bigint::BigInt::from(1u64 << 53)) - ratio(1, 2)
    };
    let dense = UnifiedStep {
        transition: Matrix::from_fn(n, n, |_, _| double()),
        observation: Matrix::from_fn(1, n, |_, j| ratio(i64::from(j == 0), 1)),
        process_noise: zeros(n, n),
        cross_noise: zeros(n, 1),
        observation_noise: Matrix::identity(1),
    };
    // Nothing is reached; no eigenvalue of such a matrix is on the circle.
    assert_eq!(Existence::of(&dense), Existence::Present);
}

/// Injections with long fractions are found in a longer field, and given up where they are too long for all.
#[test]
fn long_injections_are_read_back() {
    let plain = || unreached(&companion(&[(1, 1), (-1, 2)]), 2, &[1, 2, -1, 3]);
    let n = plain().states();
    for (digits, is_decided) in [(3, true), (40, true), (200, true), (1000, false)] {
        let unit = Rational::new(1.into(), num_bigint::BigInt::from(10).pow(digits));
        let step =
            disguised(plain(), &similarity(n, &[(0, 3, 1), (2, 1, -1)]), &filled(n, n, &[1, -7, 3], 1).scaled(&unit));
        match Existence::of(&step) {
            Existence::Absent(absence) => assert!(is_decided && is_proof(&absence, &step), "{digits}"),
            other => assert!(!is_decided && other == Existence::Undecided(Unknown::TooLong), "{digits}: {other:?}"),
        }
    }
}

/// Numbers that are zero modulo the first prime of the search lead to no false proof, and to no false existence.
#[test]
fn multiples_of_the_prime_deceive_nobody() {
    let prime = (1i64 << 61) - 1;
    let step = |[a, h, q, s, r]: [i64; 5]| {
        let number = |value| Matrix::diagonal(&[ratio(value, 1)]);
        UnifiedStep {
            transition: number(a),
            observation: number(h),
            process_noise: number(q),
            cross_noise: number(s),
            observation_noise: number(r),
        }
    };
    assert_eq!(Existence::of(&step([1, 1, prime, 0, 1])), Existence::Present);
    assert_eq!(Existence::of(&step([2, prime, 1, 0, 1])), Existence::Present);
    assert_eq!(Existence::of(&step([prime + 1, 1, 0, 0, 1])), Existence::Present);
    assert_eq!(Existence::of(&step([1, 1, 0, prime, 1])), Existence::Undecided(Unknown::IndefiniteNoise));
    // R is singular modulo the prime, so that nothing is concluded there.
    assert!(!matches!(Existence::of(&step([1, 1, 0, 0, prime])), Existence::Present));
    assert!(matches!(Existence::of(&step([prime, 0, 1, 0, 1])), Existence::Absent(_)));
}
