//! All paths of a process, and moments along them.

use exact_kalman::gaussian::{Gaussian, Polynomial};
use exact_kalman::matrix::Matrix;
use exact_kalman::scalar::{Rational, ratio};
use exact_kalman::stability::{Mode, ModeProcess};
use num_bigint::BigInt;

use super::Q;

/// Every path of positive probability, as modes by their numbers.
pub fn paths(process: &ModeProcess<Rational>, length: usize) -> Vec<(Rational, Vec<usize>)> {
    let mut all = vec![(ratio(1, 1), Vec::new())];
    for _ in 0..length {
        let longer = |(probability, path): &(Rational, Vec<usize>)| {
            let (probability, path) = (probability.clone(), path.clone());
            (0..process.modes().len()).map(move |mode| {
                let step = match path.last() {
                    Some(&last) => process.transition()[(last, mode)].clone(),
                    None => process.initial()[mode].clone(),
                };
                (&probability * step, path.iter().copied().chain([mode]).collect())
            })
        };
        all = all.iter().flat_map(longer).filter(|(probability, _)| *probability > ratio(0, 1)).collect();
    }
    all
}

/// The modes of a path.
pub fn along(process: &ModeProcess<Rational>, path: &[usize]) -> Vec<Mode<Rational>> {
    path.iter().map(|&mode| process.modes()[mode].clone()).collect()
}

/// E of a function of the path.
pub fn mean(paths: &[(Rational, Vec<usize>)], of: impl Fn(&[usize]) -> Rational) -> Rational {
    paths.iter().map(|(probability, path)| probability * of(path)).sum()
}

pub fn trace(matrix: &Q) -> Rational {
    (0..matrix.rows()).map(|i| matrix[(i, i)].clone()).sum()
}

pub fn power(base: &Rational, exponent: usize) -> Rational {
    num_traits::pow(base.clone(), exponent)
}

/// E‖e‖²ʳ for e ~ N(0, C).
pub fn gaussian_moment(covariance: &Q, r: usize) -> Rational {
    let d = covariance.rows();
    let square = (0..d).map(|i| Polynomial::variable(d, i)).fold(Polynomial::zero(d), |sum, x| sum.plus(&x.times(&x)));
    let power = (0..r).fold(Polynomial::constant(d, ratio(1, 1)), |product, _| product.times(&square));
    let law = Gaussian::new(Matrix::zeros(d, 1), covariance.clone()).expect("symmetric");
    law.expectation(&power).expect("a covariance")
}

/// Just below the root of a number that is not negative: the root itself cut off after 80 binary digits.
pub fn root(value: &Rational, degree: u32) -> Rational {
    let scale: BigInt = BigInt::from(1) << 80;
    let whole = (value * Rational::from(num_traits::pow(scale.clone(), degree as usize))).to_integer();
    Rational::new(whole.nth_root(degree), scale)
}
