//! The values of lists and matrices of numbers, with the place of what is wrong.

use super::{Datum, InputError, Numbers};
use crate::matrix::{LdlError, Matrix};
use crate::scalar::Rational;

impl Numbers {
    /// The value of one number.
    ///
    /// # Errors
    ///
    /// [`InputError::Number`] with this path.
    pub fn value(self, path: &str, datum: &Datum) -> Result<Rational, InputError> {
        datum.value(self).map_err(|source| InputError::Number { path: path.to_owned(), source })
    }

    /// The values of a list.
    ///
    /// # Errors
    ///
    /// [`InputError::Number`] with the place.
    pub fn list(self, path: &str, list: &[Datum]) -> Result<Vec<Rational>, InputError> {
        list.iter().enumerate().map(|(i, datum)| self.value(&format!("{path}[{i}]"), datum)).collect()
    }

    /// The values of a list of rows.
    ///
    /// # Errors
    ///
    /// [`InputError::Number`] with the place.
    pub fn rows(self, path: &str, rows: &[Vec<Datum>]) -> Result<Vec<Vec<Rational>>, InputError> {
        rows.iter().enumerate().map(|(i, row)| self.list(&format!("{path}[{i}]"), row)).collect()
    }

    /// A column of the given length.
    ///
    /// # Errors
    ///
    /// [`InputError`] with the place.
    pub fn column(self, path: &str, list: &[Datum], n: usize) -> Result<Matrix<Rational>, InputError> {
        if list.len() != n {
            return Err(InputError::at(path, format!("{} numbers where {n} are needed", list.len())));
        }
        Ok(Matrix::column(self.list(path, list)?))
    }

    /// A matrix with so many columns.
    ///
    /// # Errors
    ///
    /// [`InputError`] with the place.
    pub fn matrix(self, path: &str, rows: &[Vec<Datum>], columns: usize) -> Result<Matrix<Rational>, InputError> {
        if let Some(row) = rows.iter().position(|row| row.len() != columns) {
            let message = format!("{} numbers where {columns} are needed", rows[row].len());
            return Err(InputError::at(format!("{path}[{row}]"), message));
        }
        let values = self.rows(path, rows)?;
        Ok(Matrix::from_fn(rows.len(), columns, |i, j| values[i][j].clone()))
    }

    /// A square matrix of the given order.
    ///
    /// # Errors
    ///
    /// [`InputError`] with the place.
    pub fn square(self, path: &str, rows: &[Vec<Datum>], n: usize) -> Result<Matrix<Rational>, InputError> {
        if rows.len() != n {
            return Err(InputError::at(path, format!("{} rows where {n} are needed", rows.len())));
        }
        self.matrix(path, rows, n)
    }

    /// A covariance of the given order: symmetric and positive semidefinite.
    ///
    /// # Errors
    ///
    /// [`InputError`] with the place, and a witness if it is indefinite.
    pub fn covariance(self, path: &str, rows: &[Vec<Datum>], n: usize) -> Result<Matrix<Rational>, InputError> {
        let matrix = self.square(path, rows, n)?;
        match matrix.ldl() {
            Ok(_) => Ok(matrix),
            Err(LdlError::Indefinite(proof)) => {
                let proof = super::witness::described(&matrix, &proof);
                Err(InputError::at(path, format!("not positive semidefinite: {proof}")))
            }
            Err(asymmetric) => Err(InputError::at(path, asymmetric.to_string())),
        }
    }
}
