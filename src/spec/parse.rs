//! Reads entries from the page.

use super::{Entry, Erratum, Paper, Status};

/// An entry that does not have the form which the page promises.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[error("{id}: {problem}")]
pub struct MalformedEntry {
    /// Its identifier, or what stands in its place.
    pub id: String,
    /// What is wrong with it.
    pub problem: String,
}

/// The entries of a page: headings `### ID Title`, a quoted line, a paragraph that begins with the status, and the
/// lines of evidence and of tests.
///
/// # Errors
///
/// [`MalformedEntry`] with the first entry that lacks one of its parts, or stands twice.
pub fn parse(page: &str) -> Result<Vec<Entry<'_>>, MalformedEntry> {
    let mut entries: Vec<Entry<'_>> = Vec::new();
    for section in page.split("\n### ").skip(1) {
        // The next chapter is not part of the entry before it.
        let section = section.split("\n## ").next().unwrap_or_default();
        let (heading, body) = section.split_once('\n').unwrap_or((section, ""));
        let (id, title) = heading.split_once(' ').unwrap_or((heading, ""));
        let malformed = |problem| MalformedEntry { id: id.to_owned(), problem };
        if entries.iter().any(|other| other.id == id) {
            return Err(malformed("stands twice".to_owned()));
        }
        entries.push(entry(id, title.trim(), body).map_err(malformed)?);
    }
    Ok(entries)
}

fn entry<'a>(id: &'a str, title: &'a str, body: &'a str) -> Result<Entry<'a>, String> {
    let paper = Paper::of(id).ok_or("belongs to no paper")?;
    let quoted = body.lines().find_map(|line| line.strip_prefix("> `")?.strip_suffix('`'));
    let equation = quoted.ok_or("lacks its quoted line")?;
    let rest = body.split_once("\n*").ok_or("lacks its status")?.1;
    let (word, rest) = rest.split_once('*').ok_or("lacks its status")?;
    let status = Status::ALL.into_iter().find(|status| status.name() == word);
    let status = status.ok_or_else(|| format!("has the unknown status {word:?}"))?;
    let (text, tests) = rest.split_once(super::TESTS).unwrap_or((rest, ""));
    let tests = tests.split('`').skip(1).step_by(2).collect();
    let (text, evidence) = match text.split_once(super::BACKING) {
        Some((text, line)) => (text, super::backing::evidence(line)?),
        None => (text, Vec::new()),
    };
    let (flowed, errata) = Erratum::taken_out(&flowing(without_first_links(text)))?;
    Ok(Entry { id, paper, title, equation, status, code: links(text), evidence, tests, text: flowed, errata })
}

/// The paths of links such as ``[`trace::Record`]``.
fn links(text: &str) -> Vec<&str> {
    text.split("[`").skip(1).filter_map(|rest| rest.split_once("`]")).map(|(path, _)| path).collect()
}

/// What follows the links to the code at the beginning: ``: [`a`], [`b`]. Text``.
fn without_first_links(text: &str) -> &str {
    let mut rest = text.trim_start_matches([':', '.', ' ']);
    while let Some((_, after)) = rest.strip_prefix("[`").and_then(|link| link.split_once("`]")) {
        match after.strip_prefix([',', '.', ';']) {
            Some(next) => rest = next.trim_start(),
            // The link is part of a sentence.
            None => break,
        }
    }
    rest
}

/// Paragraphs on one line each; what is laid out by lines (tables, lists) stays so.
fn flowing(text: &str) -> String {
    let mut out = String::new();
    let is_laid_out = |line: &str| line.starts_with(['|', '*', '-']);
    for line in text.trim().lines() {
        let separator = match (out.is_empty() || out.ends_with('\n'), line.is_empty() || is_laid_out(line)) {
            (true, _) => "",
            (false, true) => "\n",
            (false, false) => " ",
        };
        out += separator;
        out += line;
        if line.is_empty() || is_laid_out(line) {
            out.push('\n');
        }
    }
    out.trim_end().to_owned()
}
