//! Roots on the unit circle of a polynomial with the roots 1/z of its roots z, through c = z + 1/z.

use num_traits::Signed;

use super::polynomial::Polynomial;
use crate::scalar::{Field, Rational, Scalar, ratio};

/// Whether the polynomial is ± its own reciprocal: then zero is no root, and z is a root as often as 1/z.
pub(super) fn is_self_reciprocal(p: &Polynomial<Rational>) -> bool {
    let reciprocal = p.reciprocal().monic();
    !p.is_zero() && p.degree() == reciprocal.degree() && p.monic() == reciprocal
}

/// h with `p(z) = zᵈ h(z + 1/z)`, for a self-reciprocal p of degree 2d that has neither of the roots ±1 an odd number of times.
///
/// `z^j + z^−j = t_j(c)`, with `t₀ = 2`, `t₁ = c`, `t_{j+1} = c t_j − t_{j−1}`.
pub(super) fn folded(p: &Polynomial<Rational>) -> Polynomial<Rational> {
    let d = p.degree() / 2;
    let mut h = vec![Rational::zero(); d + 1];
    let (mut before, mut now) = (vec![ratio(2, 1)], vec![Rational::zero(), Rational::one()]);
    if let (Some(constant), Some(middle)) = (h.first_mut(), p.coefficients().get(d)) {
        *constant = middle.clone();
    }
    for factor in p.coefficients().iter().skip(d + 1) {
        for (sum, coefficient) in h.iter_mut().zip(&now) {
            *sum = sum.plus(&factor.times(coefficient));
        }
        let mut next: Vec<Rational> = std::iter::once(Rational::zero()).chain(now.iter().cloned()).collect();
        for (sum, coefficient) in next.iter_mut().zip(&before) {
            *sum = sum.minus(coefficient);
        }
        (before, now) = (now, next);
    }
    Polynomial::new(h)
}

/// Two fractions in [−2, 2], less than 2⁻²⁰ apart, at which h has different signs or one of which is a root; nothing if h has no root in
/// [−2, 2]. Both ends of [−2, 2] are no roots, and no root is repeated.
pub(super) fn bracket(h: &Polynomial<Rational>) -> Option<(Rational, Rational)> {
    let chain = sturm_chain(h);
    let (mut low, mut high) = (ratio(-2, 1), ratio(2, 1));
    let mut changes = sign_changes(&chain, &low);
    if changes == sign_changes(&chain, &high) {
        return None;
    }
    // Always at least one root in (low, high]; halved until it is one, whose place is known.
    let narrow = ratio(1, 1 << 20);
    loop {
        let middle = low.plus(&high).times(&ratio(1, 2));
        if h.at(&middle).is_zero() {
            return Some((middle.clone(), middle));
        }
        let there = sign_changes(&chain, &middle);
        let is_single = changes == sign_changes(&chain, &high) + 1;
        if is_single && high.minus(&low) < narrow {
            return Some((low, high));
        }
        if changes == there {
            (low, changes) = (middle, there);
        } else {
            high = middle;
        }
    }
}

/// Whether h has a root in [−2, 2] (Sturm; repeated roots count once); neither end is a root.
pub(super) fn has_root(h: &Polynomial<Rational>) -> bool {
    let chain = sturm_chain(h);
    sign_changes(&chain, &ratio(-2, 1)) != sign_changes(&chain, &ratio(2, 1))
}

/// h, its derivative, and the negative of each remainder, up to positive factors.
fn sturm_chain(h: &Polynomial<Rational>) -> Vec<Polynomial<Rational>> {
    let mut chain = vec![h.clone(), h.derivative()];
    while let [.., before, last] = chain.as_slice() {
        let rest = before.divided(last).1;
        let Some(leading) = rest.coefficients().last().map(Signed::abs) else { break };
        let scaled = rest.coefficients().iter().map(|c| (c / &leading).negated()).collect();
        chain.push(Polynomial::new(scaled));
    }
    chain
}

fn sign_changes(chain: &[Polynomial<Rational>], at: &Rational) -> usize {
    let signs = chain.iter().map(|p| p.at(at)).filter(|value| !value.is_zero()).map(|value| value.is_negative());
    let signs: Vec<bool> = signs.collect();
    signs.windows(2).filter(|pair| pair[0] != pair[1]).count()
}
