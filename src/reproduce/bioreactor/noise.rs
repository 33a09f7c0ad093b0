//! Streams of random numbers, by name.

use rand_core::{Rng, SeedableRng};
use rand_pcg::Pcg64Mcg;

/// Independent standard normal numbers. Name and seed decide them, on every machine alike.
///
/// # Examples
///
/// ```
/// use exact_kalman::reproduce::bioreactor::Stream;
///
/// let mut stream = Stream::named("HV-Sim", 1);
/// let first = stream.normal();
/// assert_eq!(Stream::named("HV-Sim", 1).normal(), first);
/// assert_ne!(Stream::named("HV-Fig1", 1).normal(), first);
/// ```
#[derive(Clone, Debug)]
pub struct Stream(Pcg64Mcg);

impl Stream {
    /// The stream of that name and seed.
    pub fn named(name: &str, seed: u64) -> Self {
        // FNV-1a over the name and the seed.
        let bytes = name.bytes().chain(seed.to_le_bytes());
        let hash = bytes
            .fold(0xcbf2_9ce4_8422_2325_u64, |hash, byte| (hash ^ u64::from(byte)).wrapping_mul(0x0000_0100_0000_01b3));
        Self(Pcg64Mcg::seed_from_u64(hash))
    }

    /// Uniform on (0, 1), both ends left out.
    pub fn uniform(&mut self) -> f64 {
        #[expect(clippy::cast_precision_loss, reason = "53 bits")]
        let bits = (self.0.next_u64() >> 11) as f64;
        (bits + 0.5) / 9_007_199_254_740_992.0
    }

    /// Standard normal, by Box and Muller.
    pub fn normal(&mut self) -> f64 {
        let radius = (-2.0 * libm::log(self.uniform())).sqrt();
        radius * libm::cos(std::f64::consts::TAU * self.uniform())
    }

    /// Pairs of them.
    pub fn pairs(&mut self, count: usize) -> Vec<[f64; 2]> {
        (0..count).map(|_| [self.normal(), self.normal()]).collect()
    }
}
