//! Why a step has no stabilising solution: what anybody can check.

use std::fmt;

use super::invariant::Invariant;
use super::spectrum::characteristic_polynomial;
use crate::matrix::Matrix;
use crate::scalar::{Rational, ratio};

/// Modes of a step because of which no symmetric S = φ(S) with a regular innovation covariance has a closed loop of spectral
/// radius below 1. All identities have been checked over the fractions.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Absence {
    /// EK-T7a: N of full column rank, `A N = N Λ`, `H N = 0`, ρ(Λ) ≥ 1. Then `(A − K H) N = N Λ` for every gain K.
    Unobservable {
        /// N, n×k.
        basis: Matrix<Rational>,
        /// Λ, k×k.
        map: Matrix<Rational>,
    },
    /// EK-T7b: M of full row rank, `M A − Y H = Λ M`, `[M −Y] [[Q, S], [Sᵀ, R]] = 0`, and Λ has an eigenvalue on the unit circle. Then
    /// every such S has `u M K = u Y` and `u M (A − K H) = λ u M` for the left eigenvector u of Λ.
    Unreachable {
        /// M, k×n.
        basis: Matrix<Rational>,
        /// Y, k×m.
        injection: Matrix<Rational>,
        /// Λ, k×k.
        map: Matrix<Rational>,
        /// Nothing if 1 or −1 is an eigenvalue. Otherwise the characteristic polynomial of Λ is `zᵈ h(z + 1/z)`, and these two
        /// fractions in [−2, 2] are a root of h, twice, or h has different signs there: in between it has a root 2 cos θ,
        /// and e^{±iθ} are eigenvalues.
        between: Option<(Rational, Rational)>,
    },
}

impl Absence {
    /// The unobservable rows, transposed.
    pub(super) fn unobservable(rows: &Invariant<Rational>) -> Self {
        Self::Unobservable { basis: rows.basis.transpose(), map: rows.map.transpose() }
    }

    /// The unreachable rows.
    pub(super) fn unreachable(rows: Invariant<Rational>, between: Option<(Rational, Rational)>) -> Self {
        Self::Unreachable { basis: rows.basis, injection: rows.injection, map: rows.map, between }
    }

    /// Λ
    pub fn map(&self) -> &Matrix<Rational> {
        match self {
            Self::Unobservable { map, .. } | Self::Unreachable { map, .. } => map,
        }
    }
}

impl fmt::Display for Absence {
    /// One sentence that names the eigenvalues as far as fractions can.
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Unobservable { map, .. } => {
                write!(f, "no gain moves ")?;
                eigenvalues(f, map)?;
                write!(f, ": unobservable, and not stable")
            }
            Self::Unreachable { between: Some((low, high)), .. } => {
                let half = |end: &Rational| decimals(&(end / ratio(2, 1)));
                write!(f, "no noise reaches the eigenvalues on the unit circle with real part {}", half(low))?;
                if half(low) != half(high) {
                    write!(f, " to {}", half(high))?;
                }
                Ok(())
            }
            Self::Unreachable { map, between: None, .. } => {
                write!(f, "no noise reaches ")?;
                eigenvalues(f, map)?;
                write!(f, ", on the unit circle")
            }
        }
    }
}

/// The eigenvalue of a 1×1 matrix, or the polynomial that has the eigenvalues as roots.
fn eigenvalues(f: &mut fmt::Formatter<'_>, map: &Matrix<Rational>) -> fmt::Result {
    if let [eigenvalue] = map.entries() {
        return write!(f, "the eigenvalue {eigenvalue}");
    }
    let Some(polynomial) = characteristic_polynomial(map).filter(|_| map.rows() <= LONGEST) else {
        return write!(f, "{} eigenvalues, some of modulus 1 or more", map.rows());
    };
    write!(f, "the roots of ")?;
    let mut is_first = true;
    for (power, coefficient) in polynomial.coefficients().iter().enumerate().rev() {
        if *coefficient == ratio(0, 1) {
            continue;
        }
        let size = if *coefficient < ratio(0, 1) { -coefficient } else { coefficient.clone() };
        let sign = match (is_first, size == *coefficient) {
            (true, true) => "",
            (true, false) => "-",
            (false, true) => " + ",
            (false, false) => " - ",
        };
        write!(f, "{sign}")?;
        if size != ratio(1, 1) || power == 0 {
            write!(f, "{size}{}", if power > 0 { " " } else { "" })?;
        }
        match power {
            0 => {}
            1 => write!(f, "z")?,
            _ => write!(f, "z^{power}")?,
        }
        is_first = false;
    }
    Ok(())
}

/// Polynomials of a higher degree are not written out.
const LONGEST: usize = 6;

/// Four decimals, rounded down.
fn decimals(value: &Rational) -> String {
    let scaled = (value * ratio(10_000, 1)).floor().to_integer();
    let (sign, size) = (if scaled.sign() == num_bigint::Sign::Minus { "-" } else { "" }, scaled.magnitude());
    format!("{sign}{}.{:0>4}", size / 10_000u32, (size % 10_000u32).to_string())
}
