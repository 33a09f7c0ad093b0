//! Characteristic polynomials of matrices of integers, and where their roots lie.

use num_bigint::BigInt;
use num_integer::Integer;
use num_traits::{One, Signed, Zero};

use super::table::Table;
use crate::scalar::Rational;

/// The coefficients of a positive multiple of det(zI − Λ), from the constant one to the leading one.
///
/// Faddeev and Leverrier: `M₁ = I`, `c_{n−k} = −tr(L M_k)/k`, `M_{k+1} = L M_k + c_{n−k} I`, all of integers for `L = d Λ` of integers;
/// then z stands for d z.
pub(super) fn characteristic(map: &Table) -> Vec<BigInt> {
    let n = map.rows;
    let up = u64::try_from(map.exponent).unwrap_or(0);
    let integers = Table {
        entries: map.entries.iter().map(|entry| entry << up).collect(),
        exponent: 0,
        denominator: BigInt::one(),
        ..*map
    };
    let denominator = &map.denominator << map.exponent.min(0).unsigned_abs();
    let mut coefficients = vec![BigInt::one(); n + 1];
    let mut power = Table::identity(n);
    for k in 1..=n {
        power = integers.times(&power);
        let trace = power.trace().entries.swap_remove(0);
        let coefficient: BigInt = -trace / BigInt::from(k);
        for i in 0..n {
            power.entries[i * n + i] += &coefficient;
        }
        coefficients[n - k] = coefficient;
    }
    let mut factor = BigInt::one();
    for coefficient in &mut coefficients {
        *coefficient *= &factor;
        factor *= &denominator;
    }
    coefficients
}

/// Whether some root has modulus one or more, for a polynomial whose leading coefficient is not zero.
///
/// Schur and Cohn: all roots of p lie inside the circle if and only if |p₀| < |pₖ| and all those of `(pₖ p − p₀ p*)/z` do, with the
/// reciprocal p*.
pub(super) fn reaches_circle(mut p: Vec<BigInt>) -> bool {
    while let ([first, .., last], true) = (&p[..], p.len() > 1) {
        if first.abs() >= last.abs() {
            return true;
        }
        let next: Vec<BigInt> = p.iter().zip(p.iter().rev()).skip(1).map(|(a, b)| last * a - first * b).collect();
        let common = next.iter().fold(BigInt::zero(), |common, coefficient| common.gcd(coefficient));
        p = if common.is_zero() { next } else { next.iter().map(|coefficient| coefficient / &common).collect() };
    }
    false
}

/// The value at 1, and at −1.
pub(super) fn at_ends(p: &[BigInt]) -> [BigInt; 2] {
    let at = |sign: &BigInt| p.iter().rev().fold(BigInt::zero(), |value, coefficient| value * sign + coefficient);
    [at(&BigInt::one()), at(&-BigInt::one())]
}

/// A positive multiple of h(c), where `p(z) = zᵈ h(z + 1/z)`; nothing where there is no such h.
///
/// `z^j + z^−j = t_j(c)`, with `t₀ = 2`, `t₁ = c`, `t_{j+1} = c t_j − t_{j−1}`.
pub(super) fn folded_at(p: &[BigInt], c: &Rational) -> Option<BigInt> {
    if p.len().is_multiple_of(2) || p.iter().ne(p.iter().rev()) {
        return None;
    }
    let d = p.len() / 2;
    let (over, under) = (c.numer(), c.denom());
    // t_j under^j, and sums times under^d.
    let (mut before, mut now, mut scale) = (BigInt::from(2), over.clone(), under.pow(u32::try_from(d).ok()?));
    let mut sum = &p[d] * &scale;
    for coefficient in &p[d + 1..] {
        scale /= under;
        sum += coefficient * &now * &scale;
        let next = over * &now - under * under * &before;
        (before, now) = (now, next);
    }
    Some(sum)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::scalar::ratio;

    /// The matrix with a given last row, ones above its diagonal, and thus a known polynomial.
    fn companion(row: &[Rational]) -> Table {
        let n = row.len();
        let [zero, one] = [ratio(0, 1), ratio(1, 1)];
        Table::of(n, n, |i, j| {
            if i + 1 == n {
                &row[j]
            } else if j == i + 1 {
                &one
            } else {
                &zero
            }
        })
    }

    #[test]
    fn the_polynomial_of_a_companion_matrix_is_known() {
        for row in [vec![ratio(1, 2), ratio(-3, 5), ratio(7, 1)], vec![ratio(6, 1), ratio(4, 1)], vec![ratio(-5, 8)]] {
            let p = characteristic(&companion(&row));
            let leading = Rational::from(p[row.len()].clone());
            for (coefficient, entry) in p.iter().zip(&row) {
                assert_eq!(Rational::from(coefficient.clone()) / &leading, -entry);
            }
        }
    }

    #[test]
    fn roots_inside_the_circle_are_told_from_others() {
        // Roots a/8, b/8, c/8.
        for a in -10..=10_i64 {
            for b in -10..=10_i64 {
                for c in [-9, -7, 0, 5, 8] {
                    let coefficients = [-a * b * c, 8 * (a * b + b * c + a * c), -64 * (a + b + c), 512];
                    let p = coefficients.map(BigInt::from).to_vec();
                    let expected = [a, b, c].iter().any(|root| root.abs() >= 8);
                    assert_eq!(reaches_circle(p.clone()), expected, "{a} {b} {c}");
                    let [one, minus] = at_ends(&p).map(|value| value.is_zero());
                    assert_eq!((one, minus), ([a, b, c].contains(&8), [a, b, c].contains(&-8)));
                }
            }
        }
        // z² − z + 1 and z² + 1: on the circle, in pairs.
        assert!(reaches_circle([1, -1, 1].map(BigInt::from).to_vec()));
        assert!(!reaches_circle([1, 0, 2].map(BigInt::from).to_vec()));
    }

    #[test]
    fn folded_polynomials_have_the_value_of_their_own() {
        // p(z) = 2z⁴ − 3z³ + 5z² − 3z + 2, at z = 3: c = 10/3, h = p/z².
        let p = [2, -3, 5, -3, 2].map(BigInt::from);
        let value = 2 * 81 - 3 * 27 + 5 * 9 - 9 + 2;
        let found = folded_at(&p, &ratio(10, 3)).map(|h| Rational::from(h) / ratio(9, 1));
        assert_eq!(found, Some(ratio(value, 9)));
        assert_eq!(folded_at(&[1, 2, 3].map(BigInt::from), &ratio(0, 1)), None);
        assert_eq!(folded_at(&[1, 1].map(BigInt::from), &ratio(0, 1)), None);
    }
}
