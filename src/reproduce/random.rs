//! Named, seeded streams of normal variates.

use rand_core::{Rng, SeedableRng};
use rand_pcg::Pcg64Mcg;

/// A stream of random numbers that depends on its name and seed alone.
///
/// Each part of an experiment has a stream of its own, named after it, so that a part added or left out does not
/// change the others.
///
/// # Examples
///
/// ```
/// use exact_kalman::reproduce::Stream;
///
/// let [mut one, mut same, mut other] = ["a", "a", "b"].map(|name| Stream::named(name, 7));
/// let first = one.normal();
/// assert_eq!(first, same.normal());
/// assert_ne!(first, other.normal());
/// ```
#[derive(Clone, Debug)]
pub struct Stream {
    generator: Pcg64Mcg,
    spare: Option<f64>,
}

impl Stream {
    /// The stream with this name and seed.
    pub fn named(name: &str, seed: u64) -> Self {
        // FNV-1a over the seed and the name.
        let bytes = seed.to_le_bytes().into_iter().chain(name.bytes());
        let hash = bytes
            .fold(0xcbf2_9ce4_8422_2325_u64, |hash, byte| (hash ^ u64::from(byte)).wrapping_mul(0x0000_0100_0000_01b3));
        Self { generator: Pcg64Mcg::seed_from_u64(hash), spare: None }
    }

    /// Uniform on [0, 1), a multiple of 2⁻⁵³.
    pub fn uniform(&mut self) -> f64 {
        #[expect(clippy::cast_precision_loss, reason = "53 bits fit")]
        let integer = (self.generator.next_u64() >> 11) as f64;
        integer / 9_007_199_254_740_992.0
    }

    /// Standard normal, by Marsaglia's polar method; libm makes it the same on every machine.
    pub fn normal(&mut self) -> f64 {
        if let Some(spare) = self.spare.take() {
            return spare;
        }
        loop {
            let (x, y) = (2.0 * self.uniform() - 1.0, 2.0 * self.uniform() - 1.0);
            let square = x * x + y * y;
            if square > 0.0 && square < 1.0 {
                let factor = libm::sqrt(-2.0 * libm::log(square) / square);
                self.spare = Some(y * factor);
                return x * factor;
            }
        }
    }

    /// So many pairs of standard normal numbers.
    pub fn pairs(&mut self, count: usize) -> Vec<[f64; 2]> {
        (0..count).map(|_| [self.normal(), self.normal()]).collect()
    }
}
