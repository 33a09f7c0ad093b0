//! Starts of which nothing, or only a part, is known.

use super::basic::velocity;
use super::draft::Draft;
use super::draw::Draw;
use super::table::{gaps, multiple, silenced, zeros};
use crate::protocol::Case;

pub(super) fn cases(draw: Draw) -> Vec<Case> {
    vec![
        Draft::new("diffuse/random-walk", "a random walk that may start anywhere", &["diffuse"])
            .starting("0", "0")
            .diffuse("1")
            .noise("0.5", "1")
            .reading(draw.singles(51, 10, 4000)),
        velocity("diffuse/trend", "position and velocity are both unknown: two readings resolve them", &["diffuse"])
            .starting("0 0", "0 0; 0 0")
            .diffuse("1 0; 0 1")
            .reading(draw.singles(52, 12, 4000)),
        velocity("diffuse/velocity-only", "the position is known, the velocity is not", &["diffuse"])
            .starting("1 0", "0.25 0; 0 0")
            .diffuse("0 0; 0 1")
            .reading(draw.singles(53, 12, 4000)),
        velocity("diffuse/one-direction", "only the combination (1, 2) is unknown", &["diffuse"])
            .starting("0 0", "1 0; 0 1")
            .diffuse("1 2; 2 4")
            .reading(draw.singles(54, 12, 4000)),
        velocity("diffuse/first-reading-missing", "both are unknown, and the first readings are missing", &["diffuse"])
            .starting("0 0", "0 0; 0 0")
            .diffuse("1 0; 0 1")
            .reading(gaps(draw.singles(55, 10, 4000), &[0, 2, 3])),
        Draft::new("diffuse/acceleration", "three unknowns: three readings resolve them", &["diffuse"])
            .starting("0 0 0", &multiple(3, "0"))
            .diffuse(&multiple(3, "1"))
            .transition("1 0.5 0.125; 0 1 0.5; 0 0 1")
            .observation("1 0 0")
            .noise(&multiple(3, "0.0625"), "0.5")
            .reading(draw.singles(56, 10, 4000)),
        Draft::new("diffuse/two-sensors", "two sensors resolve two unknowns at once", &["diffuse"])
            .starting("0 0", "0 0; 0 0")
            .diffuse("1 0; 0 1")
            .transition("0.75 0.25; 0 0.5")
            .observation("1 1; 1 -1")
            .noise("0.25 0; 0 0.5", "1 0.25; 0.25 0.5")
            .reading(draw.pairs(57, 8)),
        Draft::new("diffuse/one-sensor-silent", "of two sensors one is silent at first", &["diffuse"])
            .starting("0 0", "0 0; 0 0")
            .diffuse("1 0; 0 1")
            .transition("1 0; 0 1")
            .observation("1 0; 0 1")
            .noise("0.25 0; 0 0.5", "1 0; 0 0.5")
            .reading(silenced(draw.pairs(58, 8), |k, i| k < 3 && i == 1)),
        Draft::new("diffuse/season", "a level and a season of four quarters, all unknown", &["diffuse"])
            .starting(&zeros(4), &multiple(4, "0"))
            .diffuse(&multiple(4, "1"))
            .transition("1 0 0 0; 0 -1 -1 -1; 0 1 0 0; 0 0 1 0")
            .observation("1 1 0 0")
            .noise("0.25 0 0 0; 0 0.125 0 0; 0 0 0 0; 0 0 0 0", "0.5")
            .reading(draw.singles(59, 10, 4000)),
        Draft::new("diffuse/regression", "a regression without any prior: least squares", &["diffuse", "time-varying"])
            .starting("0 0", "0 0; 0 0")
            .diffuse("1 0; 0 1")
            .transition("1 0; 0 1")
            .observation_matrices((1..=8).map(|k| format!("1 {k}")))
            .noise("0 0; 0 0", "1")
            .reading(draw.singles(60, 8, 4000)),
    ]
}
