//! Commuting squares: a map φ of scalars and a generic algorithm f have f∘φ = φ∘f wherever no pivot and no denominator
//! vanishes under φ.
//!
//! One helper, [`commuting::commutes`], runs them all and counts what it ran; `cargo test --test squares -- --nocapture` shows
//! the counts. A new map is one `impl Map` and one line in `over_fields`; a new generic function of the library without a
//! square fails `listed`.

mod algebra;
mod ball;
mod commuting;
#[path = "../agree/draws.rs"]
#[expect(dead_code, reason = "shared with tests/agree, which draws through a strategy")]
mod draws;
mod fast;
mod filters;
mod gaussian;
mod inputs;
mod listed;
mod maps;
mod ordered;
mod surd;
#[path = "../agree/systems.rs"]
#[expect(dead_code, reason = "shared with tests/agree, which uses more of it")]
mod systems;
mod watched;
