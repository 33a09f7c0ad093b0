//! `spec`: the equations, with the code that computes and the tests that check them.

use std::io::Write;

use serde::Serialize;

use super::Format;
use super::exit::{Exit, Trouble};
use crate::spec::{Backing, Entry, Erratum, Evidence, Paper, Status, entries};

const EXAMPLES: &str = "\
Examples:
  exact-kalman spec                        every paper: how many of its items are done
  exact-kalman spec CKS                    the items of a paper: CKS, HV, AK, SM or WG
  exact-kalman spec CKS-11                 one item: equation, code, tests, erratum
  exact-kalman spec HV --status checked    what tests check and no code computes
  exact-kalman spec --backing theorem      what is proved for matrices of every size
  exact-kalman spec --errata               what the papers misprint, with witnesses
  exact-kalman spec AK --format json       one item on each line, for programs";

/// Print the specification: each item of the papers with its code and its tests
#[derive(clap::Args, Debug)]
#[command(after_help = EXAMPLES)]
pub(super) struct Spec {
    /// Identifiers, or the letters of a paper. Without any: a count by paper.
    #[arg(value_name = "ID")]
    chosen: Vec<String>,
    /// Only items with this status.
    #[arg(long, value_name = "STATUS", value_parser = clap::builder::PossibleValuesParser::new(Status::ALL.map(Status::name)))]
    status: Option<String>,
    /// Only items with such evidence: a theorem for all sizes, a symbolic proof at some size, a proof by an SMT solver, an identity at
    /// random points, every case of a domain, tests.
    #[arg(long, value_name = "KIND", value_parser = clap::builder::PossibleValuesParser::new(Backing::ALL.map(Backing::word)))]
    backing: Option<String>,
    /// Only items whose print is wrong.
    #[arg(long)]
    errata: bool,
    /// How to print them.
    #[arg(long, value_enum, default_value_t)]
    format: Format,
}

impl Spec {
    pub(super) fn run(self) -> Result<Exit, Trouble> {
        let damaged = |error: crate::spec::MalformedEntry| other("SPEC.md", error.to_string());
        let all = entries().map_err(damaged)?;
        let chosen = self.select(&all)?;
        let mut out = std::io::stdout().lock();
        if chosen.is_empty() {
            eprintln!("none of the items chosen is such a one");
        }
        let is_overview = self.chosen.is_empty() && self.status.is_none() && self.backing.is_none() && !self.errata;
        match self.format {
            Format::Json => {
                for entry in chosen {
                    writeln!(out, "{}", json(entry)?)?;
                }
            }
            Format::Text if is_overview => overview(&mut out, &all)?,
            Format::Text if self.errata || self.names_items(&all) => {
                for (place, entry) in chosen.iter().enumerate() {
                    if place > 0 {
                        writeln!(out)?;
                    }
                    whole(&mut out, entry)?;
                }
            }
            Format::Text => {
                for entry in chosen {
                    writeln!(out, "{}", line(entry))?;
                }
            }
        }
        Ok(Exit::Clean)
    }

    /// Whether single items are asked for, not whole papers.
    fn names_items(&self, all: &[Entry<'_>]) -> bool {
        self.chosen.iter().any(|id| all.iter().any(|entry| entry.id.eq_ignore_ascii_case(id)))
    }

    fn select<'a, 'b>(&self, all: &'b [Entry<'a>]) -> Result<Vec<&'b Entry<'a>>, Trouble> {
        for id in &self.chosen {
            if !all.iter().any(|entry| is_meant(entry, id)) {
                return Err(other(id, unknown(id, all)));
            }
        }
        let is_chosen = |entry: &&Entry<'_>| {
            (self.chosen.is_empty() || self.chosen.iter().any(|id| is_meant(entry, id)))
                && self.status.as_ref().is_none_or(|status| status == entry.status.name())
                && self.backing.as_ref().is_none_or(|word| entry.evidence.iter().any(|it| it.backing.word() == word))
                && (!self.errata || !entry.errata.is_empty())
        };
        Ok(all.iter().filter(is_chosen).collect())
    }
}

/// Whether an entry is meant by an identifier or by the letters of its paper.
fn is_meant(entry: &Entry<'_>, id: &str) -> bool {
    entry.id.eq_ignore_ascii_case(id) || entry.paper.prefix().eq_ignore_ascii_case(id)
}

/// What to say about an identifier that does not exist: those that begin alike.
fn unknown(id: &str, all: &[Entry<'_>]) -> String {
    const SHOWN: usize = 6;
    let folded = id.to_lowercase();
    let close = |entry: &&Entry<'_>| {
        let own = entry.id.to_lowercase();
        own.starts_with(&folded) || folded.starts_with(&own)
    };
    let close: Vec<&str> = all.iter().filter(close).map(|entry| entry.id).collect();
    let near = &close[..close.len().min(SHOWN)];
    if near.is_empty() {
        let papers = Paper::ALL.map(Paper::prefix).join(", ");
        return format!("no item has this identifier; `exact-kalman spec PAPER` lists those of {papers}");
    }
    let more = if close.len() > SHOWN { ", …" } else { "" };
    format!("no item has this identifier; there are {}{more}", near.join(", "))
}

fn other(place: &str, message: String) -> Trouble {
    Trouble::Other { place: place.to_owned(), message }
}

fn overview(out: &mut impl Write, all: &[Entry<'_>]) -> Result<(), Trouble> {
    let header = Status::ALL.map(|status| format!("{status:>12}")).concat();
    writeln!(out, "{:56}{:>6}{header}{:>8}", "", "items", "errata")?;
    for paper in Paper::ALL {
        let of_paper: Vec<&Entry<'_>> = all.iter().filter(|entry| entry.paper == paper).collect();
        let with = |status| of_paper.iter().filter(|entry| entry.status == status).count();
        let counts = Status::ALL.map(|status| format!("{:>12}", with(status))).concat();
        let errata: usize = of_paper.iter().map(|entry| entry.errata.len()).sum();
        let name = format!("{:4}{}", paper.prefix(), paper.name());
        writeln!(out, "{name:56}{:>6}{counts}{errata:>8}", of_paper.len())?;
    }
    let header = Backing::ALL.map(|backing| format!("{:>12}", backing.word())).concat();
    writeln!(out, "\n{:56}{:>6}{header}", "The strongest evidence of each", "")?;
    for paper in Paper::ALL {
        let strongest: Vec<Backing> =
            all.iter().filter(|entry| entry.paper == paper).filter_map(Entry::backing).collect();
        let with = |backing| strongest.iter().filter(|strongest| **strongest == backing).count();
        let counts = Backing::ALL.map(|backing| format!("{:>12}", with(backing))).concat();
        let name = format!("{:4}{}", paper.prefix(), paper.name());
        writeln!(out, "{name:56}{:>6}{counts}", "")?;
    }
    Ok(())
}

/// An entry on one line: identifier, status, the strongest evidence, how many tests, title, and the code.
fn line(entry: &Entry<'_>) -> String {
    let tests = match entry.tests.len() {
        0 => String::new(),
        1 => "1 test".to_owned(),
        count => format!("{count} tests"),
    };
    let code = if entry.code.is_empty() { String::new() } else { format!(" · {}", entry.code.join(", ")) };
    let backing = entry.backing().map_or("", Backing::word);
    format!("{:22} {:12} {backing:11} {tests:>8}  {}{code}", entry.id, entry.status, entry.title)
}

fn whole(out: &mut impl Write, entry: &Entry<'_>) -> Result<(), Trouble> {
    writeln!(out, "{} · {} ({})", entry.id, entry.title, entry.paper.name())?;
    writeln!(out, "\n    {}\n", entry.equation)?;
    // Text that begins in lower case goes on where the status left off.
    match entry.text.chars().next() {
        None => writeln!(out, "{}", entry.status)?,
        Some(',') => writeln!(out, "{}{}", entry.status, plain(&entry.text))?,
        Some(first) if first.is_lowercase() => writeln!(out, "{}: {}", entry.status, plain(&entry.text))?,
        Some(_) => writeln!(out, "{}\n{}", entry.status, plain(&entry.text))?,
    }
    for Erratum { printed, right, witness, consequence } in &entry.errata {
        writeln!(out, "erratum")?;
        for (name, part) in [("printed", printed), ("right", right), ("witness", witness), ("consequence", consequence)]
        {
            writeln!(out, "   {:13}{}", format!("{name}:"), plain(part))?;
        }
    }
    for (place, Evidence { backing, name, extent }) in entry.evidence.iter().enumerate() {
        let extent = if extent.is_empty() { String::new() } else { format!(" ({extent})") };
        let line = format!("{backing} {name}{extent}");
        writeln!(out, "{:6} {}", if place == 0 { "basis" } else { "" }, line.trim_end())?;
    }
    for (name, items) in [("code", &entry.code), ("tests", &entry.tests)] {
        for (place, item) in items.iter().enumerate() {
            writeln!(out, "{:6} {item}", if place == 0 { name } else { "" })?;
        }
    }
    Ok(())
}

/// Text without the brackets of its links.
fn plain(text: &str) -> String {
    text.replace("[`", "`").replace("`]", "`")
}

/// An entry for programs.
#[derive(Serialize)]
struct Document<'a> {
    id: &'a str,
    paper: &'a str,
    title: &'a str,
    equation: &'a str,
    status: &'a str,
    code: &'a [&'a str],
    backing: Option<&'a str>,
    evidence: Vec<EvidenceDocument<'a>>,
    tests: &'a [&'a str],
    text: &'a str,
    errata: Vec<ErratumDocument<'a>>,
}

#[derive(Serialize)]
struct EvidenceDocument<'a> {
    backing: &'a str,
    name: &'a str,
    extent: &'a str,
}

#[derive(Serialize)]
struct ErratumDocument<'a> {
    printed: &'a str,
    right: &'a str,
    witness: &'a str,
    consequence: &'a str,
}

fn json(entry: &Entry<'_>) -> Result<String, Trouble> {
    let errata = entry.errata.iter().map(|erratum| ErratumDocument {
        printed: &erratum.printed,
        right: &erratum.right,
        witness: &erratum.witness,
        consequence: &erratum.consequence,
    });
    let evidence = entry.evidence.iter().map(|&Evidence { backing, name, extent }| EvidenceDocument {
        backing: backing.word(),
        name,
        extent,
    });
    let document = Document {
        id: entry.id,
        paper: entry.paper.name(),
        title: entry.title,
        equation: entry.equation,
        status: entry.status.name(),
        code: &entry.code,
        backing: entry.backing().map(Backing::word),
        evidence: evidence.collect(),
        tests: &entry.tests,
        text: &entry.text,
        errata: errata.collect(),
    };
    serde_json::to_string(&document).map_err(|error| Trouble::Output(error.into()))
}
