//! Modes that grow.

use super::draft::Draft;
use super::draw::Draw;
use super::table::gaps;
use crate::protocol::Case;

pub(super) fn cases(draw: Draw) -> Vec<Case> {
    vec![
        Draft::new("unstable/observed", "a mode that doubles at every step, and is read", &["unstable"])
            .transition("2")
            .noise("0.1", "1")
            .reading(draw.singles(61, 30, 4000)),
        Draft::new("unstable/unobserved", "a mode that grows by a tenth and is never read", &["unstable"])
            .starting("0 0", "1 0; 0 1")
            .transition("0.9 0; 0 1.1")
            .observation("1 0")
            .noise("0.1 0; 0 0.1", "1")
            .reading(draw.singles(62, 30, 2000)),
        Draft::new(
            "unstable/mixed",
            "an unobserved growing mode, hidden by a change of coordinates",
            &["unstable", "ill-conditioned"],
        )
        .starting("0 0", "1 0; 0 1")
        .transition("1.5 0.5; 0.5 1.5")
        .observation("1 -1")
        .noise("0.1 0; 0 0.1", "1")
        .reading(draw.singles(63, 25, 2000)),
        Draft::new(
            "unstable/observed-with-gaps",
            "a mode that doubles, with gaps in which nothing holds it",
            &["unstable"],
        )
        .transition("2")
        .noise("0.125", "1")
        .reading(gaps(draw.singles(64, 24, 4000), &[3, 4, 5, 6, 12, 13, 14, 20])),
        Draft::new("unstable/slow", "a mode that grows by a hundredth", &["unstable"])
            .starting("0 0", "1 0; 0 1")
            .transition("1.01 0.1; 0 1.01")
            .observation("1 0")
            .noise("0.01 0; 0 0.01", "1")
            .reading(draw.singles(65, 25, 4000)),
        Draft::new("unstable/spiral", "an oscillation that grows, read in one coordinate", &["unstable"])
            .starting("1 0", "1 0; 0 1")
            .transition("1 0.75; -0.75 1")
            .observation("1 0")
            .noise("0.25 0; 0 0.25", "1")
            .reading(draw.singles(66, 20, 4000)),
        Draft::new("unstable/beside-stable", "one mode doubles, one is halved, and their sum is read", &["unstable"])
            .starting("0 0", "1 0; 0 1")
            .transition("2 0; 0 0.5")
            .observation("1 1")
            .noise("0.25 0; 0 0.25", "1")
            .reading(draw.singles(67, 20, 4000)),
        Draft::new("unstable/through-a-chain", "a mode that grows is read only through two others", &["unstable"])
            .starting("0 0 0", "1 0 0; 0 1 0; 0 0 1")
            .transition("0.5 1 0; 0 0.75 1; 0 0 1.5")
            .observation("1 0 0")
            .noise("0.25 0 0; 0 0.25 0; 0 0 0.25", "1")
            .reading(draw.singles(68, 18, 4000)),
        Draft::new(
            "unstable/without-noise",
            "a mode that doubles without noise: only its start is unknown",
            &["unstable"],
        )
        .starting("0", "1")
        .transition("2")
        .noise("0", "1")
        .reading(draw.singles(69, 20, 4000)),
        Draft::new(
            "unstable/hardly-seen",
            "a mode that grows, seen with a weight of 10⁻⁶",
            &["unstable", "ill-conditioned"],
        )
        .starting("0 0", "1 0; 0 1")
        .transition("0.5 0; 0 1.25")
        .observation("1 1e-6")
        .noise("0.25 0; 0 0.25", "1")
        .reading(draw.singles(70, 24, 4000)),
        Draft::new(
            "unstable/mixed-with-gaps",
            "an unobserved growing mode, hidden by a change of coordinates, with gaps",
            &["unstable", "ill-conditioned"],
        )
        .starting("0 0", "1 0; 0 1")
        .transition("1.5 0.5; 0.5 1.5")
        .observation("2 -2")
        .noise("0.25 0; 0 0.125", "1")
        .reading(gaps(draw.singles(81, 20, 2000), &[4, 5, 6, 13])),
        Draft::new(
            "unstable/three-mixed",
            "an unobserved mode that grows, mixed into three states",
            &["unstable", "ill-conditioned"],
        )
        // The eigenvector (1, 1, 1) of 5/4 is not seen by (2, -1, -1).
        .starting("0 0 0", "1 0 0; 0 1 0; 0 0 1")
        .transition("0.75 0.25 0.25; 0.25 0.75 0.25; 0.25 0.25 0.75")
        .observation("2 -1 -1")
        .noise("0.25 0 0; 0 0.25 0; 0 0 0.25", "1")
        .reading(draw.singles(82, 15, 2000)),
    ]
}
