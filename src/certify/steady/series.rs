//! Σ Gᵏ Ω Gᵏᵀ by squaring, and the spectral radius of G, in fixed point: proposals.

use num_bigint::BigInt;

use super::fixed::{Rows, most_bits, plus, symmetric_product, times};

/// The sum, and minus the binary logarithm of the spectral radius of G; nothing if powers of G do not vanish.
pub(super) fn series(power: &Rows, first: &Rows, places: u64) -> Option<(Rows, f64)> {
    let n = power.len();
    let mut power = power.clone();
    let mut sum = first.clone();
    let (mut steps, mut decay) = (1.0_f64, f64::NEG_INFINITY);
    for _ in 0..MOST_SQUARINGS {
        let carried = times(&power, &sum, n, places);
        sum = plus(&sum, &symmetric_product(&carried, &power, places));
        power = times(&power, &power, n, places);
        steps *= 2.0;
        let bits = most_bits(&power);
        if most_bits(&sum).max(bits) > 4 * places {
            return None;
        }
        let size = if bits > 16 { logarithm(&power) } else { exact(bits) };
        decay = (exact(places) - size).max(decay * steps) / steps;
        if bits < places / 2 {
            // All further terms together lie below the last bits.
            return Some((sum, decay));
        }
    }
    None
}

/// Beyond, G is taken for one that does not contract.
const MOST_SQUARINGS: usize = 500;

fn exact(bits: u64) -> f64 {
    // Far below 2^52.
    u32::try_from(bits).map_or(f64::INFINITY, f64::from)
}

/// The binary logarithm of the norm of Frobenius, nearly.
fn logarithm(rows: &Rows) -> f64 {
    let squares = rows.iter().flatten().fold(BigInt::default(), |sum, entry| sum + entry * entry);
    let bits = squares.bits();
    let kept = &squares >> bits.saturating_sub(52);
    let mantissa = u64::try_from(kept).map_or(1.0, |kept| {
        let (high, low) = ((kept >> 32) as u32, (kept & 0xffff_ffff) as u32);
        f64::from(high) * 4_294_967_296.0 + f64::from(low)
    });
    f64::midpoint(mantissa.log2(), exact(bits.saturating_sub(52)))
}
