//! Modes that grow.

use super::draft::{Draft, scatter, thousandths};
use crate::protocol::Case;

pub(super) fn cases() -> Vec<Case> {
    vec![
        Draft::new("unstable/observed", "a mode that doubles at every step, and is read", &["unstable"])
            .transition("2")
            .noise("0.1", "1")
            .reading(scatter(61, 30, 4000).map(thousandths)),
        Draft::new("unstable/unobserved", "a mode that grows by a tenth and is never read", &["unstable"])
            .starting("0 0", "1 0; 0 1")
            .transition("0.9 0; 0 1.1")
            .observation("1 0")
            .noise("0.1 0; 0 0.1", "1")
            .reading(scatter(62, 30, 2000).map(thousandths)),
        Draft::new(
            "unstable/mixed",
            "an unobserved growing mode, hidden by a change of coordinates",
            &["unstable", "ill-conditioned"],
        )
        .starting("0 0", "1 0; 0 1")
        .transition("1.5 0.5; 0.5 1.5")
        .observation("1 -1")
        .noise("0.1 0; 0 0.1", "1")
        .reading(scatter(63, 25, 2000).map(thousandths)),
    ]
}
