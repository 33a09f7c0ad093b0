//! Rows that a step maps among themselves and that no noise reaches, searched in a prime field, checked over the fractions.

use super::polynomial::Polynomial;
use super::remainder::Remainder;
use super::span::{Combinations, Span};
use crate::matrix::Matrix;
use crate::model::UnifiedStep;
use crate::scalar::{Field, Rational};

/// M, Y and Λ with `M A − Y H = Λ M` and `[M −Y] [[Q, S], [Sᵀ, R]] = 0`.
///
/// Shapes: `basis` k×n, `injection` k×m, `map` k×k.
#[derive(Clone, Debug)]
pub(super) struct Invariant<F> {
    pub(super) basis: Matrix<F>,
    pub(super) injection: Matrix<F>,
    pub(super) map: Matrix<F>,
    /// The columns where the basis is the identity.
    pivots: Vec<usize>,
}

/// The matrices of a step.
pub(super) struct Images<F> {
    transition: Matrix<F>,
    observation: Matrix<F>,
    process: Matrix<F>,
    cross: Matrix<F>,
    noise: Matrix<F>,
}

impl<F: Remainder> Images<F> {
    /// The images of a step; nothing if the prime divides a denominator.
    pub(super) fn of(step: &UnifiedStep) -> Option<Self> {
        let image = |matrix: &Matrix<Rational>| matrix.try_map(|entry| F::image(entry).ok_or(())).ok();
        Some(Self {
            transition: image(&step.transition)?,
            observation: image(&step.observation)?,
            process: image(&step.process_noise)?,
            cross: image(&step.cross_noise)?,
            noise: image(&step.observation_noise)?,
        })
    }

    /// Whether R is regular here; then it is over the fractions.
    pub(super) fn is_noise_regular(&self) -> bool {
        Combinations::of(&self.noise).relations.is_empty()
    }

    /// All rows that no noise reaches; nothing where they are not determined (R singular and the step not invertible).
    ///
    /// With L R = S and V a basis of the rows with V R = 0: `A_s = A − L H`, `Q_s = Q − L Sᵀ`, `Y = M L + Z V`. So the rows M
    /// are those with `M Q_s = 0` and `M A_s = Λ M + Z V H`. What they annihilate is the least space that holds the columns of
    /// Q_s, and A_s x with every x of its own for which `V H x = 0`.
    ///
    /// Where R is singular the search takes n⁴ products, so more than `dimensions` states are refused.
    pub(super) fn unreachable(&self, dimensions: usize) -> Option<Invariant<F>> {
        let (n, m) = (self.transition.rows(), self.observation.rows());
        let noise = Combinations::of(&self.noise);
        if n > dimensions && !noise.relations.is_empty() {
            return None;
        }
        let lifted = noise.solve(&self.cross)?;
        let silent = Matrix::from_fn(noise.relations.len(), m, |i, j| noise.relations[i][j].clone());
        let transition = &self.transition - &lifted * &self.observation;
        let process = &self.process - &lifted * self.cross.transpose();
        let outputs = &silent * &self.observation;
        let reached = if silent.rows() == 0 {
            reached_freely(&transition, &process)
        } else {
            reached_silently(&transition, &process, &outputs)
        };
        let basis = reached.annihilator();
        // Rows of the outputs that depend on others come from sensors that repeat others: they may have any injection.
        let mut independent = Span::new(n);
        let chosen: Vec<usize> = (0..outputs.rows()).filter(|&i| independent.insert(outputs.row(i)).is_ok()).collect();
        let frame = Combinations::of(&outputs.select_rows(&chosen).above(&basis));
        if !frame.relations.is_empty() {
            return None;
        }
        let parts = frame.solve(&(&basis * &transition))?;
        let (k, c) = (basis.rows(), chosen.len());
        let injection = &basis * &lifted + parts.block(0..k, 0..c) * silent.select_rows(&chosen);
        Some(Invariant { basis, injection, map: parts.block(0..k, c..c + k), pivots: reached.free() })
    }

    /// All rows x with `x (H A^j)ᵀ = 0` for every j, with `x Aᵀ = Λ x`: the unobservable space, transposed.
    pub(super) fn unobservable(&self) -> Invariant<F> {
        let transposed = self.transition.transpose();
        let reached = reached_freely(&transposed, &self.observation.transpose());
        let (basis, pivots) = (reached.annihilator(), reached.free());
        let map = (&basis * &transposed).select_columns(&pivots);
        Invariant { injection: Matrix::zeros(basis.rows(), 0), basis, map, pivots }
    }
}

/// The least space with the columns of B that A maps into itself.
fn reached_freely<F: Field>(transition: &Matrix<F>, columns: &Matrix<F>) -> Span<F> {
    let n = transition.rows();
    let mut span = Span::new(n);
    let mut waiting: Vec<Vec<F>> = (0..columns.columns()).map(|j| column(columns, j)).collect();
    while let Some(vector) = waiting.pop() {
        if span.dimension() == n {
            break;
        }
        if let Ok(new) = span.insert(&vector) {
            let image = transition * Matrix::column(new.to_vec());
            waiting.push(image.entries().to_vec());
        }
    }
    span
}

/// The least space W with the columns of B such that A x is in W for every x in W with C x = 0.
fn reached_silently<F: Field>(transition: &Matrix<F>, columns: &Matrix<F>, outputs: &Matrix<F>) -> Span<F> {
    let mut span = Span::of(&columns.transpose(), transition.rows());
    loop {
        let basis = span.basis();
        // The combinations x of the basis with x · basis · Cᵀ = 0.
        let seen = (&basis * outputs.transpose()).transpose();
        let images = Span::of(&seen, basis.rows()).annihilator() * &basis * transition.transpose();
        let before = span.dimension();
        for i in 0..images.rows() {
            // What is not new is in the span already.
            let _ = span.insert(images.row(i));
        }
        if span.dimension() == before {
            return span;
        }
    }
}

fn column<F: Clone>(matrix: &Matrix<F>, j: usize) -> Vec<F> {
    (0..matrix.rows()).map(|i| matrix[(i, j)].clone()).collect()
}

impl<F: Field> Invariant<F> {
    /// The dimension k.
    pub(super) fn dimension(&self) -> usize {
        self.map.rows()
    }

    /// The part with the basis X M, for independent rows X that Λ maps among themselves; the new basis is in reduced echelon form,
    /// so that its entries are short.
    ///
    /// Shapes: `rows` d×k.
    pub(super) fn restricted(&self, rows: &Matrix<F>) -> Self {
        let (n, m) = (self.basis.columns(), self.injection.columns());
        let carried = (rows * &self.basis).beside(&(rows * &self.injection)).beside(rows);
        let span = Span::of(&carried, n);
        let (reduced, d) = (span.basis(), span.dimension());
        let combination = reduced.block(0..d, n + m..n + m + self.dimension());
        Self {
            map: combination * &self.map * self.basis.select_columns(span.pivots()),
            basis: reduced.block(0..d, 0..n),
            injection: reduced.block(0..d, n..n + m),
            pivots: span.pivots().to_vec(),
        }
    }

    /// The part of the rows that a polynomial in Λ makes zero.
    pub(super) fn annihilated(&self, polynomial: &Polynomial<F>) -> Self {
        let value = polynomial.at_matrix(&self.map);
        self.restricted(&Span::of(&value.transpose(), self.dimension()).annihilator())
    }

    /// The part of the first rows.
    pub(super) fn of_first(&self, count: usize) -> Self {
        self.restricted(&Matrix::identity(self.dimension()).block(0..count, 0..self.dimension()))
    }

    /// The part of x, xΛ, xΛ², … for the first row x at which it has the dimension `degree`, that of a minimal polynomial of Λ
    /// without repeated factors.
    ///
    /// The rows whose part is smaller lie in one proper subspace for each irreducible factor. A subspace holds fewer than k of the rows
    /// (1, t, t², …), so that a larger part is found among any `degree` · k of them.
    pub(super) fn cyclic(&self, degree: usize) -> Option<Self> {
        let k = self.dimension();
        let integer = |number: usize| F::from_integer(i64::try_from(number).unwrap_or(1));
        // Squares first: they are short, and no simple pattern among equal blocks is met.
        let squares: Vec<F> = (1..=k).map(|j| integer(j * j)).collect();
        let powers = (2..2 + degree * k).map(|t| {
            let t = integer(t);
            std::iter::successors(Some(F::one()), |power| Some(power.times(&t))).take(k).collect()
        });
        let mut parts = std::iter::once(squares).chain(powers).map(|row| self.generated(&row));
        parts.find(|part| part.dimension() == degree).map(|part| self.restricted(&part.basis()))
    }

    /// The span of x, xΛ, xΛ², ….
    fn generated(&self, row: &[F]) -> Span<F> {
        let mut row = Matrix::from_fn(1, self.dimension(), |_, j| row[j].clone());
        let mut span = Span::new(self.dimension());
        while span.insert(row.entries()).is_ok() {
            row = row * &self.map;
        }
        span
    }
}

impl<F: Remainder> Invariant<F> {
    /// The fractions that the entries of the basis and the injection stand for.
    fn fractions(&self) -> Option<(Matrix<Rational>, Matrix<Rational>)> {
        let read = |matrix: &Matrix<F>| matrix.try_map(|entry| entry.fraction().ok_or(())).ok();
        Some((read(&self.basis)?, read(&self.injection)?))
    }

    /// The same over the fractions, if all identities hold there.
    pub(super) fn unreached(&self, step: &UnifiedStep) -> Option<Invariant<Rational>> {
        let (basis, injection) = self.fractions()?;
        let image = &basis * &step.transition - &injection * &step.observation;
        let map = image.select_columns(&self.pivots);
        let holds = &basis * &step.process_noise == &injection * step.cross_noise.transpose()
            && &basis * &step.cross_noise == &injection * &step.observation_noise
            && &map * &basis == image;
        holds.then(|| Invariant { basis, injection, map, pivots: self.pivots.clone() })
    }

    /// The same over the fractions for rows x with `x Hᵀ = 0` and `x Aᵀ = Λ x`, if these hold.
    pub(super) fn unobserved(&self, step: &UnifiedStep) -> Option<Invariant<Rational>> {
        let (basis, injection) = self.fractions()?;
        let image = &basis * step.transition.transpose();
        let map = image.select_columns(&self.pivots);
        let holds = (&basis * step.observation.transpose()).is_zero() && &map * &basis == image;
        holds.then(|| Invariant { basis, injection, map, pivots: self.pivots.clone() })
    }
}
