//! The maps of scalars.

use exact_kalman::scalar::{Rational, Residue, Scalar, laws, ratio};
use proptest::prelude::*;

use super::commuting::{Drawn, Map};
use super::surd::Surd;

/// ℚ → 𝔽ₚ
#[derive(Clone, Copy, Debug)]
pub struct Modulo<const P: u64>;

impl<const P: u64> Map for Modulo<P> {
    const NAME: &'static str = match P {
        7 => "fractions modulo 7",
        101 => "fractions modulo 101",
        _ => "fractions modulo a large prime",
    };
    type Source = Rational;
    type Image = Residue<P>;

    fn image(value: &Rational) -> Option<Residue<P>> {
        Residue::image(value)
    }
}

/// ℚ → ℚ(√2), which keeps the order.
#[derive(Clone, Copy, Debug)]
pub struct Included;

impl Map for Included {
    const NAME: &'static str = "inclusion in ℚ(√2)";
    type Source = Rational;
    type Image = Surd;

    fn image(value: &Rational) -> Option<Surd> {
        Some(Surd::new(value.clone(), Rational::zero()))
    }
}

/// √2 ↦ −√2
#[derive(Clone, Copy, Debug)]
pub struct Conjugated;

impl Map for Conjugated {
    const NAME: &'static str = "√2 ↦ −√2";
    type Source = Surd;
    type Image = Surd;

    fn image(value: &Surd) -> Option<Surd> {
        Some(value.conjugated())
    }
}

/// ℚ(√2) → 𝔽ₚ, `√2 ↦ ROOT` with ROOT² = 2 modulo P.
#[derive(Clone, Copy, Debug)]
pub struct Reduced<const P: u64, const ROOT: u64>;

impl<const P: u64, const ROOT: u64> Map for Reduced<P, ROOT> {
    const NAME: &'static str = if P == 7 { "√2 ↦ 3 modulo 7" } else { "√2 ↦ 2³¹ modulo 2⁶¹ − 1" };
    type Source = Surd;
    type Image = Residue<P>;

    fn image(value: &Surd) -> Option<Residue<P>> {
        let plain = |value: &Surd| {
            let (rational, root) = (Residue::image(&value.rational)?, Residue::<P>::image(&value.root)?);
            Some(rational.plus(&root.times(&Residue::new(ROOT))))
        };
        if P != 7 {
            return plain(value);
        }
        // 7 = (3 + √2)(3 − √2), and only the second factor vanishes: quotients by the first have an image, though both their
        // parts have 7 in the denominator. Multiplying by 3 + √2 takes it out.
        let unit = Surd::new(ratio(3, 1), ratio(1, 1));
        let (mut multiple, mut divisor) = (value.clone(), Residue::one());
        for _ in 0..40 {
            if let Some(image) = plain(&multiple) {
                return image.over(&divisor).ok();
            }
            (multiple, divisor) = (multiple.times(&unit), divisor.times(&plain(&unit)?));
        }
        None
    }
}

/// Runs the squares of algorithms over every map between fields.
///
/// A map that is added here is added to every algorithm.
macro_rules! over_fields {
    ($($algorithm:ident),+ $(,)?) => {$(
        $crate::commuting::commutes::<$crate::maps::Modulo<7>, $algorithm>();
        $crate::commuting::commutes::<$crate::maps::Modulo<101>, $algorithm>();
        $crate::commuting::commutes::<$crate::maps::Modulo<{ (1 << 61) - 1 }>, $algorithm>();
        $crate::commuting::commutes::<$crate::maps::Included, $algorithm>();
        $crate::commuting::commutes::<$crate::maps::Conjugated, $algorithm>();
        $crate::commuting::commutes::<$crate::maps::Reduced<7, 3>, $algorithm>();
        $crate::commuting::commutes::<$crate::maps::Reduced<{ (1 << 61) - 1 }, { 1 << 31 }>, $algorithm>();
    )+};
}
pub(crate) use over_fields;

/// The same over every map between ordered fields. √2 ↦ −√2 does not keep the order, so it counts where no comparison that
/// is asked for comes out otherwise.
macro_rules! over_ordered_fields {
    ($($algorithm:ident),+ $(,)?) => {$(
        $crate::commuting::commutes::<$crate::maps::Included, $algorithm>();
        $crate::commuting::commutes::<$crate::maps::Conjugated, $algorithm>();
    )+};
}
pub(crate) use over_ordered_fields;

/// Sums, products and quotients are kept: what makes a map one.
fn is_kept<M: Map>(a: &M::Source, b: &M::Source) -> bool {
    let (Some(x), Some(y)) = (M::image(a), M::image(b)) else { return true };
    let ring = M::image(&a.plus(b)) == Some(x.plus(&y))
        && M::image(&a.minus(b)) == Some(x.minus(&y))
        && M::image(&a.times(b)) == Some(x.times(&y));
    let quotient = match x.over(&y) {
        Ok(quotient) => a.over(b).ok().and_then(|value| M::image(&value)) == Some(quotient),
        Err(_) => true,
    };
    let units =
        M::image(&M::Source::zero()) == Some(M::Image::zero()) && M::image(&M::Source::one()) == Some(M::Image::one());
    ring && quotient && units && laws::field(&x, &y, &x) == Ok(())
}

proptest! {
    #[test]
    fn maps_keep_the_arithmetic(words in [(-40_i64..40, 1_i64..9), (-40_i64..40, 1_i64..9), (-40_i64..40, 1_i64..9), (-40_i64..40, 1_i64..9)]) {
        let [a, b, c, d] = words.map(|(numerator, denominator)| ratio(numerator, denominator));
        macro_rules! kept {
            ($($map:ty),+) => {$(
                prop_assert!(is_kept::<$map>(&Drawn::drawn(&a, &b), &Drawn::drawn(&c, &d)), "{}", <$map>::NAME);
            )+};
        }
        kept!(Modulo<7>, Modulo<101>, Modulo<{ (1 << 61) - 1 }>, Included, Conjugated, Reduced<7, 3>, Reduced<{ (1 << 61) - 1 }, { 1 << 31 }>);
    }
}
