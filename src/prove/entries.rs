//! Where the matrices of an identity come from.

use crate::matrix::Matrix;
use crate::scalar::Field;

/// Hands out matrices of fresh entries: variables, random residues or small integers.
pub(super) struct Entries<'a, F> {
    next: &'a mut dyn FnMut() -> F,
    /// What was handed out.
    pub(super) named: Vec<(String, Matrix<F>)>,
}

impl<'a, F: Field> Entries<'a, F> {
    pub(super) fn new(next: &'a mut dyn FnMut() -> F) -> Self {
        Self { next, named: Vec::new() }
    }

    pub(super) fn matrix(&mut self, name: &str, rows: usize, columns: usize) -> Matrix<F> {
        let matrix = Matrix::from_fn(rows, columns, |_, _| (self.next)());
        self.kept(name, matrix)
    }

    pub(super) fn column(&mut self, name: &str, rows: usize) -> Matrix<F> {
        self.matrix(name, rows, 1)
    }

    /// Any symmetric matrix; nothing says that it is semidefinite.
    pub(super) fn symmetric(&mut self, name: &str, n: usize) -> Matrix<F> {
        let mut matrix = Matrix::zeros(n, n);
        for i in 0..n {
            for j in i..n {
                let entry = (self.next)();
                matrix[(i, j)] = entry.clone();
                matrix[(j, i)] = entry;
            }
        }
        self.kept(name, matrix)
    }

    fn kept(&mut self, name: &str, matrix: Matrix<F>) -> Matrix<F> {
        if !matrix.entries().is_empty() {
            self.named.push((name.to_owned(), matrix.clone()));
        }
        matrix
    }
}
