//! The nearby problems whose answers a backward-stable method could have given.
//!
//! Every nonzero datum is moved by a relative 2⁻⁵³ (or 2⁻²⁴, where data are single-precision numbers), up or down; zeros stay zero, equal matrices stay equal, and so do
//! equal rows of an observation matrix. Covariances stay symmetric, positive semidefinite and of the same rank: a
//! positive definite one is moved entry by entry, as rounding would move it; a singular one through its factors LDLᵀ.

use std::collections::HashMap;

use rand_core::{Rng, SeedableRng};
use rand_pcg::Pcg64Mcg;

use super::data_kind::{DataKind, Moved};
use crate::matrix::{Ldl, Matrix, Shape};
use crate::model::{Initial, Observation, Path, Step, Transition};
use crate::scalar::{Field as _, Precision, Rational, Scalar, ratio};

/// Bits kept of a moved datum: enough to hold the move, few enough to keep exact work cheap.
const BITS: u32 = 64;

/// Which kind of datum a matrix is; equal matrices of one kind are moved alike.
#[derive(Clone, Copy, PartialEq, Eq, Hash)]
enum Kind {
    Transition,
    Observation,
    Input,
    ObservationInput,
    Noise,
}

/// One seeded perturbation of a problem.
pub(super) struct Perturbation {
    signs: Pcg64Mcg,
    /// What is moved. Where an innovation covariance is singular, moved readings may be such as the moved system cannot produce.
    what: Moved,
    /// The relative move.
    unit: Rational,
    /// What is at hand.
    present: DataKind,
    moved: HashMap<(Kind, Matrix<Rational>), Matrix<Rational>>,
}

impl Perturbation {
    pub(super) fn seeded(seed: u64, what: Moved) -> Self {
        let signs = Pcg64Mcg::seed_from_u64(seed);
        let unit = ratio(1, 1_i64 << what.bits);
        Self { signs, what, unit, present: DataKind::Start, moved: HashMap::new() }
    }

    /// The problem, every datum moved.
    pub(super) fn of(mut self, path: &Path<Rational>) -> Path<Rational> {
        let initial = path.initial();
        let initial = Initial {
            mean: self.matrix(&initial.mean),
            covariance: self.covariance(&initial.covariance),
            diffuse: initial.diffuse.as_ref().map(|part| self.covariance(part)),
            ..initial.clone()
        };
        let steps = path.steps().iter().map(|step| self.step(step)).collect();
        Path::from_parts(path.timing(), initial, steps)
    }

    fn step(&mut self, step: &Step<Rational>) -> Step<Rational> {
        self.present = DataKind::Reading;
        let reading = self.reading(step);
        let observation = self.once(Kind::Observation, &step.observation, Self::rows);
        let observation_input = self.once(Kind::ObservationInput, &step.observation_input, Self::rows);
        let (transition, observation_noise) = match &step.transition {
            None => (None, self.once(Kind::Noise, &step.observation_noise, Self::covariance)),
            Some(transition) => {
                let (transition, noise) = self.transition(transition, &step.observation_noise);
                (Some(transition), noise)
            }
        };
        Step { transition, observation, observation_input, observation_noise, reading }
    }

    /// Moves the entries of a reading, equal ones of equal rows alike.
    fn reading(&mut self, step: &Step<Rational>) -> Observation<Rational> {
        if !self.what.moves(DataKind::Reading) {
            return step.reading.clone();
        }
        let entries = step.reading.entries();
        let mut moved: Vec<Option<Rational>> = Vec::with_capacity(entries.len());
        for (i, entry) in entries.iter().enumerate() {
            let twin = (0..i).find(|&k| entries[k] == *entry && step.observation.row(k) == step.observation.row(i));
            moved.push(match twin {
                Some(k) => moved[k].clone(),
                None => entry.as_ref().map(|y| self.datum(y)),
            });
        }
        Observation::new(moved)
    }

    fn transition(
        &mut self,
        transition: &Transition<Rational>,
        observation_noise: &Matrix<Rational>,
    ) -> (Transition<Rational>, Matrix<Rational>) {
        let n = transition.noise.rows();
        let cross = &transition.cross_noise;
        let matrix = self.once(Kind::Transition, &transition.matrix, Self::matrix);
        let input = self.once(Kind::Input, &transition.input, Self::matrix);
        if cross.is_zero() {
            let noise = self.once(Kind::Noise, &transition.noise, Self::covariance);
            let observation_noise = self.once(Kind::Noise, observation_noise, Self::covariance);
            return (Transition { matrix, input, noise, cross_noise: cross.clone() }, observation_noise);
        }
        let joint = transition.noise.beside(cross).above(&cross.transpose().beside(observation_noise));
        let joint = self.once(Kind::Noise, &joint, Self::covariance);
        let all = joint.rows();
        let (noise, cross_noise) = (joint.block(0..n, 0..n), joint.block(0..n, n..all));
        (Transition { matrix, input, noise, cross_noise }, joint.block(n..all, n..all))
    }

    fn once(
        &mut self,
        kind: Kind,
        matrix: &Matrix<Rational>,
        mut move_it: impl FnMut(&mut Self, &Matrix<Rational>) -> Matrix<Rational>,
    ) -> Matrix<Rational> {
        self.present = match kind {
            Kind::Transition => DataKind::Transition,
            Kind::Observation => DataKind::Observation,
            Kind::Input | Kind::ObservationInput => DataKind::Input,
            Kind::Noise => DataKind::Noise,
        };
        let key = (kind, matrix.clone());
        if let Some(moved) = self.moved.get(&key) {
            return moved.clone();
        }
        let moved = move_it(self, matrix);
        self.moved.insert(key, moved.clone());
        moved
    }

    fn datum(&mut self, value: &Rational) -> Rational {
        if value.is_zero() {
            return value.clone();
        }
        let unit = &self.unit;
        let factor =
            if self.signs.next_u64() >> 63 == 0 { Rational::one().plus(unit) } else { Rational::one().minus(unit) };
        if !self.what.moves(self.present) {
            return value.clone();
        }
        Precision::Rounded { bits: BITS }.of(&value.times(&factor))
    }

    fn matrix(&mut self, matrix: &Matrix<Rational>) -> Matrix<Rational> {
        matrix.map(|entry| self.datum(entry))
    }

    /// Moves a matrix row by row, equal rows alike.
    fn rows(&mut self, matrix: &Matrix<Rational>) -> Matrix<Rational> {
        let mut moved: Vec<Vec<Rational>> = Vec::new();
        for i in 0..matrix.rows() {
            let twin = (0..i).find(|&k| matrix.row(k) == matrix.row(i));
            let row = match twin {
                Some(k) => moved[k].clone(),
                None => matrix.row(i).iter().map(|entry| self.datum(entry)).collect(),
            };
            moved.push(row);
        }
        let Shape { rows, columns } = matrix.shape();
        Matrix::from_fn(rows, columns, |i, j| moved[i][j].clone())
    }

    /// Moves a symmetric matrix, mirrored entries alike.
    fn symmetric(&mut self, matrix: &Matrix<Rational>) -> Matrix<Rational> {
        let n = matrix.rows();
        let moved = self.matrix(matrix);
        Matrix::from_fn(n, n, |i, j| moved[(i.max(j), i.min(j))].clone())
    }

    /// Moves a covariance: entry by entry if it is positive definite and stays so, else through its factors. One that
    /// is not positive semidefinite is moved entry by entry.
    fn covariance(&mut self, matrix: &Matrix<Rational>) -> Matrix<Rational> {
        let Ok(ldl) = matrix.ldl() else { return self.symmetric(matrix) };
        if ldl.is_positive_definite() {
            let moved = self.symmetric(matrix);
            if moved.ldl().is_ok_and(|ldl| ldl.is_positive_definite()) {
                return moved;
            }
        }
        self.through_factors(matrix, &ldl)
    }

    /// Moves the factors of `P = LDLᵀ`, which keeps the rank. Where zeros of P are sums that cancel they would be lost:
    /// then P is multiplied from both sides by a diagonal matrix near the identity, which keeps zeros and rank.
    fn through_factors(&mut self, matrix: &Matrix<Rational>, ldl: &Ldl<Rational>) -> Matrix<Rational> {
        let n = matrix.rows();
        let lower = Matrix::from_fn(n, n, |i, j| if i == j { Rational::one() } else { self.datum(&ldl.lower[(i, j)]) });
        let pivots: Vec<Rational> = ldl.pivots.iter().map(|pivot| self.datum(pivot)).collect();
        let moved = lower.congruence(&Matrix::diagonal(&pivots));
        let lost = |(before, after): (&Rational, &Rational)| before.is_zero() && !after.is_zero();
        if matrix.entries().iter().zip(moved.entries()).any(lost) {
            let near_one: Vec<Rational> = (0..n).map(|_| self.datum(&Rational::one())).collect();
            return Matrix::diagonal(&near_one).congruence(matrix);
        }
        moved
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::judge::suite;
    use crate::protocol::Expect;

    /// |moved − value| = 2⁻⁵³ |value|, but for the 64 bits that are kept of it.
    fn is_moved(value: &Rational, moved: &Rational) -> bool {
        let unit = value.times(&ratio(1, 1 << 53));
        let error = moved.minus(value);
        let (least, most) = (ratio(1023, 1024), ratio(1025, 1024));
        let square = error.times(&error);
        square >= unit.times(&unit).times(&least) && square <= unit.times(&unit).times(&most)
    }

    fn moved(rows: &[Vec<Rational>], seed: u64) -> (Matrix<Rational>, Matrix<Rational>) {
        let matrix = Matrix::from_rows(rows.to_vec()).expect("rows of one length");
        let moved = Perturbation::seeded(seed, Moved::all(53)).covariance(&matrix);
        (matrix, moved)
    }

    fn integers<const N: usize>(rows: [[i64; N]; N], over: i64) -> Vec<Vec<Rational>> {
        rows.iter().map(|row| row.iter().map(|&entry| ratio(entry, over)).collect()).collect()
    }

    /// By the leading minors of all selections of rows: slow, and without any factorisation.
    fn rank(matrix: &Matrix<Rational>) -> usize {
        let n = matrix.rows();
        let subsets = |size: u32| (0_u32..1 << n).filter(move |set| set.count_ones() == size);
        let members = |set: u32| (0..n).filter(|i| set >> i & 1 == 1).collect::<Vec<_>>();
        (0..=n)
            .rev()
            .find(|&size| {
                let size = u32::try_from(size).expect("a small size");
                subsets(size).any(|set| minor(&matrix.select(&members(set), &members(set))) != ratio(0, 1))
            })
            .expect("the empty minor is one")
    }

    /// The determinant, by expansion.
    fn minor(matrix: &Matrix<Rational>) -> Rational {
        let n = matrix.rows();
        if n == 0 {
            return Rational::one();
        }
        let rest: Vec<usize> = (1..n).collect();
        (0..n).fold(Rational::zero(), |sum, column| {
            let others: Vec<usize> = (0..n).filter(|&other| other != column).collect();
            let term = matrix[(0, column)].times(&minor(&matrix.select(&rest, &others)));
            if column % 2 == 0 { sum.plus(&term) } else { sum.minus(&term) }
        })
    }

    fn keeps_its_nature(matrix: &Matrix<Rational>, moved: &Matrix<Rational>) {
        assert_eq!(moved.asymmetry(), None);
        assert_eq!(rank(moved), rank(matrix), "{matrix} to {moved}");
        let n = matrix.rows();
        // Every principal minor is nonnegative.
        for set in 0_u32..1 << n {
            let members: Vec<usize> = (0..n).filter(|i| set >> i & 1 == 1).collect();
            assert!(minor(&moved.select(&members, &members)) >= Rational::zero(), "{moved}");
        }
        for (before, after) in matrix.entries().iter().zip(moved.entries()) {
            assert_eq!(before.is_zero(), after.is_zero(), "{matrix} to {moved}");
        }
        assert!(matrix.is_zero() || matrix != moved);
    }

    #[test]
    fn positive_definite_covariances_are_moved_entry_by_entry() {
        let close =
            vec![vec![ratio(1, 1), ratio((1 << 30) - 1, 1 << 30)], vec![ratio((1 << 30) - 1, 1 << 30), ratio(1, 1)]];
        for rows in [integers([[2, 0], [0, 3]], 1), integers([[10, 3, 0], [3, 7, -2], [0, -2, 5]], 7), close] {
            for seed in 0..20 {
                let (matrix, moved) = moved(&rows, seed);
                keeps_its_nature(&matrix, &moved);
                for (before, after) in matrix.entries().iter().zip(moved.entries()) {
                    assert!(is_moved(before, after), "{before} to {after}");
                }
            }
        }
    }

    #[test]
    fn what_rounding_could_make_indefinite_stays_definite() {
        // det = 2⁻⁶⁰ − …: smaller than any move of the entries.
        let close =
            vec![vec![ratio(1, 1), ratio((1 << 60) - 1, 1 << 60)], vec![ratio((1 << 60) - 1, 1 << 60), ratio(1, 1)]];
        for seed in 0..20 {
            let (matrix, moved) = moved(&close, seed);
            keeps_its_nature(&matrix, &moved);
        }
    }

    #[test]
    fn singular_covariances_keep_their_rank_and_their_zeros() {
        // In the last one, L₁ = (1, 1, 1), L₂ = (0, 1, −1): the zero is 1 − 1.
        for rows in [
            integers([[0, 0], [0, 0]], 1),
            integers([[1, 2], [2, 4]], 3),
            integers([[0, 0, 0], [0, 4, 2], [0, 2, 1]], 1),
            integers([[1, 1, 2], [1, 2, 3], [2, 3, 5]], 1),
            integers([[1, 1, 1, 0], [1, 2, 0, 0], [1, 0, 2, 0], [0, 0, 0, 0]], 1),
        ] {
            for seed in 0..20 {
                let (matrix, moved) = moved(&rows, seed);
                keeps_its_nature(&matrix, &moved);
                // No entry moves by more than a few units of √(pᵢᵢ pⱼⱼ).
                let n = matrix.rows();
                for (i, j) in (0..n).flat_map(|i| (0..n).map(move |j| (i, j))) {
                    let error = moved[(i, j)].minus(&matrix[(i, j)]);
                    let unit = matrix[(i, i)]
                        .times(&matrix[(j, j)])
                        .times(&ratio(16, 1))
                        .over(&ratio(1 << 53, 1))
                        .expect("no division by zero");
                    assert!(error.times(&error) <= unit.times(&ratio(1, 1 << 53)), "{matrix} to {moved}");
                }
            }
        }
    }

    #[test]
    fn an_indefinite_matrix_stays_symmetric() {
        let (matrix, moved) = moved(&integers([[80, 500], [500, 80]], 1), 3);
        assert_eq!(moved.asymmetry(), None);
        assert!(matrix.entries().iter().zip(moved.entries()).all(|(before, after)| is_moved(before, after)));
    }

    #[test]
    fn equal_rows_and_equal_matrices_stay_equal() {
        let rows = [[1, 2], [3, 0], [1, 2]].map(|row| row.map(|entry| ratio(entry, 1)).to_vec());
        let matrix = Matrix::from_rows(rows.to_vec()).expect("rows of one length");
        let mut perturbation = Perturbation::seeded(5, Moved::all(53));
        let moved = perturbation.once(Kind::Observation, &matrix, Perturbation::rows);
        assert_eq!(moved.row(0), moved.row(2));
        for (before, after) in matrix.entries().iter().zip(moved.entries()).filter(|(before, _)| !before.is_zero()) {
            assert!(is_moved(before, after));
        }
        assert_eq!(moved[(1, 1)], Rational::zero());
        assert_eq!(perturbation.once(Kind::Observation, &matrix, Perturbation::rows), moved);
        assert_ne!(perturbation.once(Kind::Transition, &matrix, Perturbation::matrix), moved);
    }

    #[test]
    fn every_datum_of_every_case_is_moved() {
        for case in suite().iter().filter(|case| case.expect != Expect::Refuse) {
            let path = case.problem().and_then(|problem| problem.realised()).expect("a case of the suite");
            let moved = Perturbation::seeded(1, Moved::all(53)).of(&path);
            let all = |before: &Matrix<Rational>, after: &Matrix<Rational>| {
                let mut pairs = before.entries().iter().zip(after.entries());
                assert_eq!(before.shape(), after.shape());
                assert!(
                    pairs.all(|(a, b)| if a.is_zero() { b.is_zero() } else { is_moved(a, b) }),
                    "{}: {before} to {after}",
                    case.id
                );
            };
            all(&path.initial().mean, &moved.initial().mean);
            assert_eq!(path.steps().len(), moved.steps().len());
            for (before, after) in path.steps().iter().zip(moved.steps()) {
                all(&before.reading.values(), &after.reading.values());
                assert_eq!(before.reading.present(), after.reading.present());
                all(&before.observation, &after.observation);
                all(&before.observation_input, &after.observation_input);
                assert_eq!(before.transition.is_some(), after.transition.is_some());
                if let (Some(before), Some(after)) = (&before.transition, &after.transition) {
                    all(&before.matrix, &after.matrix);
                    all(&before.input, &after.input);
                    assert_eq!(after.noise.asymmetry(), None);
                    assert_eq!(before.cross_noise.is_zero(), after.cross_noise.is_zero());
                }
            }
            // Constant matrices stay constant.
            let first = &moved.steps()[0];
            for (before, after) in path.steps().iter().zip(moved.steps()) {
                assert_eq!(before.observation == path.steps()[0].observation, after.observation == first.observation);
            }
        }
    }
}
