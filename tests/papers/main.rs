//! Published numbers, and the claims of the papers, one module each.

mod chen;
mod hilgert_vila;
mod nile;
mod sowers;
