//! The bodies of the identities, by subject.

pub(super) mod conditioning;
pub(super) mod filter;
pub(super) mod gains;
pub(super) mod moments;
pub(super) mod parallel_sum;
mod path;
pub(super) mod pseudo_inverse;
pub(super) mod riccati;
pub(super) mod start;
pub(super) mod timing;
