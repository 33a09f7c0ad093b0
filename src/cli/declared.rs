//! What becomes of a subject's declaration.

use crate::judge::{Judgement, meaning};
use crate::protocol::{Case, Declaration};

/// The judgement on a case that is declared to be none for the subject; nothing if it is one.
pub(super) fn judgement(declaration: Option<&Declaration>, case: &Case) -> Option<Judgement> {
    let flag = declaration?.unsupported_flag(case)?;
    Some(Judgement::unsupported(format!("the subject declares that «{flag}» is not for it")))
}

/// A remark on declared flags that are those of no case.
pub(super) fn remark<'a>(declaration: &Declaration, cases: impl Iterator<Item = &'a Case>) -> Option<String> {
    let mut unknown: Vec<&str> = declaration.unsupported.iter().map(String::as_str).collect();
    unknown.retain(|flag| meaning(flag).is_none());
    for case in cases {
        unknown.retain(|flag| !case.flags.iter().any(|known| known == flag));
    }
    let first: Vec<String> = unknown.iter().take(5).map(|flag| format!("{flag:.80?}")).collect();
    let more = if unknown.len() > first.len() { ", …" } else { "" };
    (!first.is_empty()).then(|| {
        format!("declared unsupported, but no flag of any case, and so without effect: {}{more}", first.join(", "))
    })
}
