//! What an examinee says of itself, for people.

use super::Report;
use super::printable::printable;

/// How many characters of a name or a flag are shown.
const SHOWN: usize = 80;

/// The beginning of a text from outside.
pub(super) fn short(text: &str) -> String {
    let text = printable(text);
    if text.chars().count() <= SHOWN { text } else { text.chars().take(SHOWN).chain(['…']).collect() }
}

/// The flags that are declared unsupported.
pub(super) fn unsupported(report: &Report) -> Option<String> {
    let flags: Vec<String> = report.declaration.iter().flat_map(|it| &it.unsupported).map(|flag| short(flag)).collect();
    (!flags.is_empty()).then(|| short(&flags.join(", ")))
}

/// A line with the declaration; nothing if there is none.
pub(super) fn declared(report: &Report) -> String {
    let Some(declaration) = &report.declaration else { return String::new() };
    let name = declaration.name.as_deref().map_or_else(|| "no name".to_owned(), short);
    let unsupported = unsupported(report).map_or_else(String::new, |flags| format!("; unsupported: {flags}"));
    format!("declares: {name}{unsupported}\n")
}
