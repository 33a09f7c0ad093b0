//! Starts of which nothing, or only a part, is known.

use super::basic::velocity;
use super::draft::{Draft, scatter, thousandths};
use crate::protocol::Case;

pub(super) fn cases() -> Vec<Case> {
    vec![
        Draft::new("diffuse/random-walk", "a random walk that may start anywhere", &["diffuse"])
            .starting("0", "0")
            .diffuse("1")
            .noise("0.5", "1")
            .reading(scatter(51, 10, 4000).map(thousandths)),
        velocity("diffuse/trend", "position and velocity are both unknown: two readings resolve them", &["diffuse"])
            .starting("0 0", "0 0; 0 0")
            .diffuse("1 0; 0 1")
            .reading(scatter(52, 12, 4000).map(thousandths)),
        velocity("diffuse/velocity-only", "the position is known, the velocity is not", &["diffuse"])
            .starting("1 0", "0.25 0; 0 0")
            .diffuse("0 0; 0 1")
            .reading(scatter(53, 12, 4000).map(thousandths)),
        velocity("diffuse/one-direction", "only the combination (1, 2) is unknown", &["diffuse"])
            .starting("0 0", "1 0; 0 1")
            .diffuse("1 2; 2 4")
            .reading(scatter(54, 12, 4000).map(thousandths)),
    ]
}
