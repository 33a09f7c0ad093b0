//! The order theory on which enclosures stand, on random exact models: singular S, singular P and R = 0 among them.

use exact_kalman::matrix::Matrix;
use exact_kalman::scalar::{Rational, Scalar as _, ratio};
use proptest::collection::vec;
use proptest::prelude::*;

type Rationals = Matrix<Rational>;

/// Numbers off a tape, in small fractions.
struct Tape<I>(I);

impl<I: Iterator<Item = i8>> Tape<I> {
    fn next(&mut self) -> i8 {
        self.0.next().unwrap_or(0)
    }

    fn matrix(&mut self, rows: usize, columns: usize) -> Rationals {
        Matrix::from_fn(rows, columns, |_, _| ratio(i64::from(self.next() % 5), 1 + i64::from(self.next() & 3)))
    }

    /// Of any rank up to n.
    fn semidefinite(&mut self, n: usize) -> Rationals {
        let rank = usize::from(self.next().unsigned_abs()) % (n + 1);
        let factor = self.matrix(n, rank);
        &factor * factor.transpose()
    }
}

/// x₊ = A x + w, y = H x + v with cov(w; v) = ((Q, S), (Sᵀ, R)).
struct Step {
    a: Rationals,
    h: Rationals,
    noise: Rationals,
}

impl Step {
    fn drawn<I: Iterator<Item = i8>>(tape: &mut Tape<I>, n: usize, m: usize) -> Self {
        Self { a: tape.matrix(n, n), h: tape.matrix(m, n), noise: tape.semidefinite(n + m) }
    }

    fn parts(&self) -> [Rationals; 3] {
        let (n, all) = (self.a.rows(), self.noise.rows());
        [self.noise.block(0..n, 0..n), self.noise.block(0..n, n..all), self.noise.block(n..all, n..all)]
    }

    /// Γ = A P Hᵀ + S and Σ = H P Hᵀ + R.
    fn covariances(&self, p: &Rationals) -> [Rationals; 2] {
        let [_, s, r] = self.parts();
        [&self.a * p * self.h.transpose() + s, self.h.congruence(p) + r]
    }

    /// φ(P) = A P Aᵀ + Q − Γ Σ⁺ Γᵀ
    fn map(&self, p: &Rationals) -> Rationals {
        let [q, _, _] = self.parts();
        let [gamma, sigma] = self.covariances(p);
        self.a.congruence(p) + q - gamma.congruence(&sigma.pseudo_inverse().expect("symmetric"))
    }

    fn gain(&self, p: &Rationals) -> Rationals {
        let [gamma, sigma] = self.covariances(p);
        gamma * sigma.pseudo_inverse().expect("symmetric")
    }

    fn closed(&self, gain: &Rationals) -> Rationals {
        &self.a - gain * &self.h
    }

    /// J(P, K) as the covariance of an error: G P Gᵀ + (I −K) M (I −K)ᵀ.
    fn joseph(&self, p: &Rationals, gain: &Rationals) -> Rationals {
        let weights = Matrix::identity(self.a.rows()).beside(&-gain);
        self.closed(gain).congruence(p) + weights.congruence(&self.noise)
    }
}

fn drawn() -> impl Strategy<Value = (usize, usize, Vec<i8>)> {
    (1..4_usize, 1..4_usize, vec(any::<i8>(), 300))
}

/// Not more than the other, in the order of Loewner.
fn le(a: &Rationals, b: &Rationals) -> bool {
    a.loewner_le(b).is_ok()
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(400))]

    /// EK-L1, EK-L2, EK-L3: any gain is an upper bound, and what it costs is the square of what it misses.
    #[test]
    fn squares_are_completed((n, m, tape) in drawn()) {
        let mut tape = Tape(tape.into_iter());
        let step = Step::drawn(&mut tape, n, m);
        let (p, gain) = (tape.semidefinite(n), tape.matrix(n, m));
        let [q, _, _] = step.parts();
        let [gamma, sigma] = step.covariances(&p);
        let pseudo_inverse = sigma.pseudo_inverse().expect("symmetric");
        // Γ Σ⁺ Σ = Γ
        prop_assert_eq!(&gamma * &pseudo_inverse * &sigma, gamma.clone());
        // P need not be semidefinite for the identity.
        let any = tape.matrix(n, n);
        for p in [p.clone(), &any + any.transpose()] {
            let [gamma, sigma] = step.covariances(&p);
            let mixed = &gain * gamma.transpose();
            let expanded = step.a.congruence(&p) + &q - &mixed - mixed.transpose() + gain.congruence(&sigma);
            prop_assert_eq!(step.joseph(&p, &gain), expanded);
        }
        let missed = &gain * &sigma - &gamma;
        prop_assert_eq!(step.joseph(&p, &gain), step.map(&p) + missed.congruence(&pseudo_inverse));
        prop_assert!(le(&step.map(&p), &step.joseph(&p, &gain)));
        let is_optimal = missed.is_zero();
        prop_assert_eq!(step.joseph(&p, &gain) == step.map(&p), is_optimal);
    }

    /// EK-L4: φ is monotone and concave, and its differences lie between two closed loops.
    #[test]
    fn the_map_is_monotone_and_concave((n, m, tape) in drawn()) {
        let mut tape = Tape(tape.into_iter());
        let step = Step::drawn(&mut tape, n, m);
        let (p, more) = (tape.semidefinite(n), tape.semidefinite(n));
        let other = tape.semidefinite(n);
        prop_assert!(le(&step.map(&p), &step.map(&(&p + &more))));
        let difference = step.map(&other) - step.map(&p);
        let moved = |at: &Rationals| step.closed(&step.gain(at)).congruence(&(&other - &p));
        prop_assert!(le(&moved(&other), &difference) && le(&difference, &moved(&p)));
        let half = |a: &Rationals, b: &Rationals| (a + b).scaled(&ratio(1, 2));
        prop_assert!(le(&half(&step.map(&p), &step.map(&other)), &step.map(&half(&p, &other))));
    }

    /// EK-L5, EK-L6: what lies between ± W, and what rounding of entries leaves.
    #[test]
    fn gaps_bound_what_is_made_of_them((n, _, tape) in drawn()) {
        let mut tape = Tape(tape.into_iter());
        // Z = F D Fᵀ with |dᵢ| ≤ 1 lies between ± F Fᵀ.
        let factor = tape.matrix(n, n);
        let shares: Vec<Rational> = (0..n).map(|_| ratio(i64::from(tape.next()), 128)).collect();
        let (z, w) = (factor.congruence(&Matrix::diagonal(&shares)), &factor * factor.transpose());
        prop_assert!(le(&z, &w) && le(&-&z, &w));
        let (u, v) = (tape.matrix(n, 1), tape.matrix(n, 1));
        let square = |x: &Rationals, y: &Rationals, of: &Rationals| (x.transpose() * of * y)[(0, 0)].clone();
        let through = square(&u, &v, &z);
        prop_assert!(&through * &through <= square(&u, &u, &w) * square(&v, &v, &w));
        let x = tape.semidefinite(n);
        prop_assert!(le(&z.congruence(&x), &w.scaled(&(&x * &w).trace())));
        // |eᵢⱼ| ≤ cᵢⱼ sᵢ sⱼ lies between ± diag(sᵢ² Σⱼ cᵢⱼ).
        let units: Vec<Rational> = (0..n).map(|_| ratio(1 + i64::from(tape.next() & 63), 8)).collect();
        let bounds = tape.semidefinite(n).map(|entry| if *entry < Rational::zero() { -entry } else { entry.clone() });
        let below = Matrix::from_fn(n, n, |_, _| ratio(i64::from(tape.next()), 128));
        let error = Matrix::from_fn(n, n, |i, j| {
            &below[(i.max(j), i.min(j))] * &bounds[(i, j)] * &units[i] * &units[j]
        });
        let pad = |i: usize| &units[i] * &units[i] * (0..n).map(|j| bounds[(i, j)].clone()).sum::<Rational>();
        let pad = Matrix::diagonal(&(0..n).map(pad).collect::<Vec<_>>());
        prop_assert!(le(&error, &pad) && le(&-&error, &pad));
    }
}

/// EK-L3: a gap between the bound and the map that is linear in what the gain misses would be too wide: halving it quarters
/// the cost.
#[test]
fn half_the_defect_costs_a_quarter() {
    let one = Matrix::identity(1);
    let step = Step { a: one.clone(), h: one.clone(), noise: Matrix::identity(2) };
    let cost = |missed: Rational| {
        let gain = step.gain(&one) + one.scaled(&missed);
        (step.joseph(&one, &gain) - step.map(&one))[(0, 0)].clone()
    };
    assert_eq!(cost(ratio(1, 8)), cost(ratio(1, 16)) * ratio(4, 1));
    assert_eq!(cost(ratio(1, 8)), ratio(2, 64));
}
