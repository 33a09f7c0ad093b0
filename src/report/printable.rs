//! Text that came from outside.

/// Text that came from outside, on one line and without anything that a terminal obeys: no controls, nothing that turns the
/// direction of writing, and no character that XML forbids.
pub(crate) fn printable(text: &str) -> String {
    let is_harmful = |c: char| {
        c.is_control()
            || matches!(c, '\u{61c}' | '\u{200e}' | '\u{200f}' | '\u{2028}'..='\u{202e}' | '\u{2066}'..='\u{2069}')
            || matches!(c, '\u{feff}' | '\u{fffe}' | '\u{ffff}')
    };
    text.chars().map(|c| if is_harmful(c) { ' ' } else { c }).collect()
}
