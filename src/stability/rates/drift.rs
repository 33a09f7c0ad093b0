//! Processes that drift back: Lemma 2.1 with its constants.

use num_traits::{One, Signed, Zero};

use crate::scalar::{Rational, ratio};

/// `E[a(k) | 𝒟(k−1)] ≤ αa(k−1) + β` with a(k) ≥ 1, 0 ≤ α < 1 and β > 0.
///
/// # Examples
///
/// ```
/// use exact_kalman::{scalar::ratio, stability::Drift};
///
/// let drift = Drift::new(ratio(1, 2), ratio(1, 1)).expect("α < 1");
/// let contraction = drift.contraction();
/// assert!(drift.contracts(&contraction));
/// assert_eq!(contraction.rate, ratio(3, 4));
/// ```
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Drift {
    slope: Rational,
    offset: Rational,
}

/// λ and c with `E[(a(k) + c)(1 − 1/a(k)) | 𝒟(k−1)] ≤ λ(a(k−1) + c)`.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Contraction {
    /// λ in [0, 1).
    pub rate: Rational,
    /// c ≥ 0.
    pub offset: Rational,
}

impl Drift {
    /// The drift with α and β: nothing unless 0 ≤ α < 1 and β > 0.
    pub fn new(slope: Rational, offset: Rational) -> Option<Self> {
        let fits = !slope.is_negative() && slope < Rational::one() && offset.is_positive();
        fits.then_some(Self { slope, offset })
    }

    /// Constants in closed form: with α′ = max(α, ½), `c = max(2, β²)/(1 − α′)` and `λ = 1 − 1/c`.
    ///
    /// WG-L2.1: `a(k) ≥ 1 adapted to 𝒟(k), E a(0) < ∞, E[a(k) | 𝒟(k−1)] ≤ αa(k−1) + β for k ≥ 1, 0 ≤ α < 1, 0 < β < ∞  ⇒  {1/a(k)} ∈ S⁰(λ) for some λ ∈ [0,1)`
    ///
    /// Let m = E[a(k) | 𝒟(k−1)] ≤ M = αa + β, a = a(k−1). As −1/a is concave, the left side is at most m − 1 + c − c/m ≤ M − 1 + c − c/M. This is at
    /// most λ(a + c) if (u − νa)(αa + β) ≤ c with ν = λ − α, u = β − 1 + (1 − λ)c = β, and that product is nowhere above (αu + νβ)²/(4αν) =
    /// (βλ)²/(4αν) ≤ β²/(1 − α) ≤ c, since ν ≥ (1 − α)/2 and α ≥ ½. A smaller α may be replaced by ½.
    pub fn contraction(&self) -> Contraction {
        let slope = self.slope.clone().max(ratio(1, 2));
        let squared = (&self.offset * &self.offset).max(ratio(2, 1));
        let offset = squared / (Rational::one() - slope);
        Contraction { rate: Rational::one() - offset.recip(), offset }
    }

    /// Whether such a contraction is proved for every process with this drift: whether `M − 1 + c − c/M ≤ λ(a + c)`, M = αa + β, for all a ≥ 1
    /// with M ≥ 1.
    ///
    /// Exact: multiplied by M the inequality is one of second degree in a, so at most three points are to be looked at.
    pub fn contracts(&self, contraction: &Contraction) -> bool {
        let Contraction { rate, offset } = contraction;
        if offset.is_negative() || rate.is_negative() || *rate >= Rational::one() {
            return false;
        }
        let (alpha, beta, one) = (&self.slope, &self.offset, Rational::one());
        // (M − 1 + c)M − c − λ(a + c)M = q₂a² + q₁a + q₀
        let q2 = alpha * (alpha - rate);
        let constant = beta - &one + offset - rate * offset;
        let q1 = alpha * &constant + beta * (alpha - rate);
        let q0 = beta * &constant - offset;
        let value = |a: &Rational| (&q2 * a + &q1) * a + &q0;
        // The least a ≥ 1 with M ≥ 1; there is none if α = 0 and β < 1.
        let least = if alpha.is_zero() {
            if *beta < one {
                return true;
            }
            one
        } else {
            ((&one - beta) / alpha).max(one)
        };
        if value(&least).is_positive() || q2.is_positive() || (q2.is_zero() && q1.is_positive()) {
            return false;
        }
        if q2.is_zero() {
            return true;
        }
        let vertex = -&q1 / (&q2 * ratio(2, 1));
        vertex <= least || !value(&vertex).is_positive()
    }

    /// M with `E ∏[j=i+1..k] (1 − 1/a(j)) ≤ M λ^(k−i)`, for a bound of E a(0): `(E a(0) + β/(1 − α) + c)/(1 + c)`.
    ///
    /// V(k) = (a(k) + c) ∏ (1 − 1/a(j)) has E V(k) ≤ λ^(k−i) (E a(i) + c), and V(k) ≥ (1 + c) ∏ (1 − 1/a(j)).
    pub fn constant(&self, contraction: &Contraction, first_mean: &Rational) -> Rational {
        let one = Rational::one();
        let mean = first_mean + &self.offset / (&one - &self.slope);
        (mean + &contraction.offset) / (one + &contraction.offset)
    }
}
