//! A slip of a paper, with what proves it.

/// The word with which an erratum begins, and those between its parts.
const MARK: &str = "Erratum: ";
const PARTS: [&str; 3] = ["; right: ", "; witness: ", "; consequence: "];

/// Printed, right, witness, consequence: a chapter of such sentences can be read without the papers.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Erratum {
    /// What the paper prints.
    pub printed: String,
    /// What is right.
    pub right: String,
    /// Numbers that tell the two apart.
    pub witness: String,
    /// What goes wrong for somebody who takes the print for true.
    pub consequence: String,
}

impl Erratum {
    /// A text without its errata, and these; or what is wrong with a sentence that begins as one.
    pub(super) fn taken_out(text: &str) -> Result<(String, Vec<Self>), String> {
        let mut pieces = text.split(MARK);
        let mut left = pieces.next().unwrap_or_default().trim_end().to_owned();
        let mut errata = Vec::new();
        for piece in pieces {
            let (erratum, rest) = Self::first(piece)?;
            errata.push(erratum);
            if !rest.trim().is_empty() {
                left.push(' ');
                left += rest.trim();
            }
        }
        Ok((left.trim_start().to_owned(), errata))
    }

    /// The erratum with which a text begins, and what follows it.
    fn first(text: &str) -> Result<(Self, &str), String> {
        let mut parts = Vec::new();
        let mut rest = text.strip_prefix("printed ").ok_or("an erratum does not begin with what is printed")?;
        for mark in PARTS {
            let (part, after) = rest.split_once(mark).ok_or_else(|| format!("an erratum lacks “{}”", mark.trim()))?;
            parts.push(part.to_owned());
            rest = after;
        }
        let (consequence, rest) = sentence(rest).ok_or("an erratum does not end with a full stop")?;
        let [printed, right, witness] = parts.try_into().map_err(|_| "an erratum has four parts")?;
        Ok((Self { printed, right, witness, consequence: consequence.to_owned() }, rest))
    }
}

/// The first sentence of a text, without its full stop, and what follows it. A full stop stands before the end, or
/// before a blank and a capital letter.
fn sentence(text: &str) -> Option<(&str, &str)> {
    let ends = |place: usize| {
        let after = &text[place + 1..];
        let next = after.strip_prefix([' ', '\n']);
        after.trim().is_empty() || next.is_some_and(|next| next.trim_start().starts_with(char::is_uppercase))
    };
    let end = text.match_indices('.').map(|(place, _)| place).find(|&place| ends(place))?;
    Some((&text[..end], &text[end + 1..]))
}
