//! What the conditions B1 say of a process of one state with finitely many modes, and the constants that follow.

use exact_kalman::scalar::{Rational, ratio};
use num_traits::One;

use super::window::{Setting, numbers};

/// Constants with κ = 8: powers of rational numbers, so that roots are rational.
pub struct Constants {
    /// N₂ = c¹⁶, so N₂^(2/(8+κ)) = c².
    pub c: Rational,
    /// N₁ = g⁸.
    pub g: Rational,
    /// √ε, a rational number: Pr(A_δᶜ | 𝒟(k−1)) < ε on every path.
    pub root: Rational,
    /// Upper bounds of Q and R.
    pub q: Rational,
    pub r: Rational,
}

impl Constants {
    /// For |F| ≤ 1: every Φ is at most 1, and Φ(i, i) = 1, so N₂ > 1.
    pub fn of(setting: &Setting, root: Rational) -> Self {
        let largest =
            |of: &dyn Fn(usize) -> Rational| (0..setting.process.modes().len()).map(of).max().expect("a mode");
        let mode = |i: usize| numbers(&setting.process.modes()[i]);
        assert!(largest(&|i| mode(i).f.pow(2)) <= Rational::one());
        Self {
            c: ratio(33, 32),
            g: largest(&|i| mode(i).h) + ratio(1, 100),
            root,
            q: largest(&|i| mode(i).q),
            r: largest(&|i| mode(i).r),
        }
    }

    /// C₁ = 2h + 1.
    pub fn c1(setting: &Setting) -> Rational {
        ratio(2 * i64::try_from(setting.h).expect("small") + 1, 1)
    }

    /// ρ₁ of WG-59.
    pub fn rho(&self, setting: &Setting) -> Rational {
        Self::c1(setting) * self.c.pow(2) * &self.root
    }

    /// The bound of WG-60: C₁ h N₂^(2/(8+κ)) √(E w⁴), E w⁴ = 3Q², √3 < 7/4.
    pub fn beta(&self, setting: &Setting) -> Rational {
        Self::c1(setting) * Self::h(setting) * self.c.pow(2) * ratio(7, 4) * &self.q
    }

    /// The bound of WG-62: 8 √N₁ √(h⁷ ∑ N₂^(8/(8+κ)) E w⁸) + 8 E v⁴, with at most h terms, E w⁸ = 105 Q⁴, √105 < 41/4, E v⁴ = 3R².
    pub fn fourth_moment(&self, setting: &Setting) -> Rational {
        let eight = ratio(8, 1);
        &eight * self.g.pow(4) * Self::h(setting).pow(4) * self.c.pow(4) * self.q.pow(2) * ratio(41, 4)
            + &eight * ratio(3, 1) * self.r.pow(2)
    }

    /// The square of the bound of WG-61 with that of WG-62 in it.
    pub fn squared_gamma(&self, setting: &Setting) -> Rational {
        let h = Self::h(setting);
        (Self::c1(setting) / &setting.delta * self.c.pow(2)).pow(2)
            * (&h + ratio(1, 1))
            * &h
            * self.fourth_moment(setting)
    }

    /// A rational number above the root of that.
    pub fn gamma(&self, setting: &Setting) -> Rational {
        let square = self.squared_gamma(setting);
        let mut bound = Rational::one();
        while bound.pow(2) < square {
            bound *= ratio(5, 4);
        }
        bound
    }

    pub fn h(setting: &Setting) -> Rational {
        ratio(i64::try_from(setting.h).expect("small"), 1)
    }
}
