//! Published numbers, and the claims of the papers, one module each.

mod anderson_estimates;
mod anderson_riccati;
#[cfg(feature = "judge")]
mod bioreactor;
mod chen;
mod dice;
mod hilgert_vila;
mod nile;
mod sowers;
mod wang;
