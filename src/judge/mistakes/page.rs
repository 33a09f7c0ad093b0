//! The catalogue as a page.

use std::fmt::Write as _;

use super::{Kind, mistakes};

const HEAD: &str = "\
# Known mistakes

What wrong Kalman filters are known to do. `exact-kalman check` names a mistake when an answer is what the mistake makes
of the case; `exact-kalman explain NAME` prints a page. A *reading* is no fault: the answer is right if the case, or the
answer, is read by another convention.

This page is generated from the catalogue: `UPDATE_DOCS=1 cargo test --test judge mistakes` writes it.
";

/// The catalogue, for docs/MISTAKES.md.
pub fn mistakes_page() -> String {
    let mut out = HEAD.to_owned();
    for (kind, title) in [(Kind::Mistake, "Mistakes"), (Kind::Reading, "Readings")] {
        let _ = write!(out, "\n## {title}\n");
        for mistake in mistakes().iter().filter(|mistake| mistake.kind == kind) {
            let _ = write!(
                out,
                "\n### {}\n\n{}.\n\n* **Cause.** {}\n* **Effect.** {}\n* **Remedy.** {}\n",
                mistake.name,
                capitalised(mistake.sentence),
                mistake.cause,
                mistake.effect,
                mistake.remedy
            );
        }
    }
    out
}

fn capitalised(text: &str) -> String {
    let mut letters = text.chars();
    letters.next().map(|first| first.to_uppercase().chain(letters).collect()).unwrap_or_default()
}
