//! The part of Kani's interface that the harnesses use, with types and without meaning.
//!
//! It exists so that `proofs/check-kani.sh` can type-check the harnesses where Kani cannot be installed. Nothing here
//! is ever run, and nothing is proved with it.

pub use kani_attributes::{proof, unwind};

/// A type that Kani can give any value to.
pub trait Arbitrary {}

impl Arbitrary for u64 {}

/// Any value.
pub fn any<T: Arbitrary>() -> T {
    unimplemented!("this stub is for type checks")
}

/// Restricts what follows to inputs with `condition`.
pub fn assume(condition: bool) {
    let _ = condition;
}

/// Asks whether `condition` can be met.
pub fn cover(condition: bool, message: &'static str) {
    let _ = (condition, message);
}

/// Asks whether a condition can be met.
#[macro_export]
macro_rules! cover {
    ($condition:expr, $message:literal) => {
        $crate::cover($condition, $message)
    };
}
