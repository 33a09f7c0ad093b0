//! What an entry rests on.

use std::fmt;

/// A kind of evidence, the strongest first.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum Backing {
    /// A theorem for matrices of every size, checked by Rocq (Coq).
    AllSizes,
    /// An identity of rational functions, computed by the code of this crate at a stated size.
    Symbolic,
    /// A statement about reals or floating-point numbers of a stated size, decided by an SMT solver.
    Solver,
    /// An identity that holds at random points modulo a large prime, with a stated probability of error.
    RandomPoints,
    /// Every case of a stated finite domain.
    Exhaustive,
    /// Tests on examples, chosen or random.
    Tested,
}

impl Backing {
    /// Every kind, the strongest first.
    pub const ALL: [Self; 6] =
        [Self::AllSizes, Self::Symbolic, Self::Solver, Self::RandomPoints, Self::Exhaustive, Self::Tested];

    /// The words that stand in the page.
    pub const fn name(self) -> &'static str {
        match self {
            Self::AllSizes => "proved for all sizes",
            Self::Symbolic => "proved symbolically",
            Self::Solver => "proved by SMT",
            Self::RandomPoints => "zero at random points",
            Self::Exhaustive => "exhaustive",
            Self::Tested => "tested",
        }
    }

    /// One word for it.
    pub const fn word(self) -> &'static str {
        match self {
            Self::AllSizes => "theorem",
            Self::Symbolic => "symbolic",
            Self::Solver => "smt",
            Self::RandomPoints => "points",
            Self::Exhaustive => "exhaustive",
            Self::Tested => "tested",
        }
    }
}

impl fmt::Display for Backing {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.pad(self.name())
    }
}

/// One piece of evidence.
#[derive(Clone, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub struct Evidence<'a> {
    /// What kind it is of.
    pub backing: Backing,
    /// Which theorem, identity, file or test.
    pub name: &'a str,
    /// In which words, for which sizes, or on which domain; empty for tests.
    pub extent: &'a str,
}

/// Reads the line: ``proved by SMT `stein/unique` (2×2 over the reals); tested`` in the order of [`Backing::ALL`].
pub(super) fn evidence(line: &str) -> Result<Vec<Evidence<'_>>, String> {
    let mut found = Vec::new();
    for part in line.trim().trim_end_matches('.').split("; ") {
        let known = Backing::ALL.into_iter().find_map(|backing| Some((backing, part.strip_prefix(backing.name())?)));
        let (backing, rest) = known.ok_or_else(|| format!("has the unknown backing {part:?}"))?;
        let rest = rest.trim_start();
        let Some((name, extent)) = rest.strip_prefix('`').and_then(|rest| rest.split_once('`')) else {
            if rest.is_empty() && backing == Backing::Tested {
                found.push(Evidence { backing, name: "", extent: "" });
                continue;
            }
            return Err(format!("has a backing without a name: {part:?}"));
        };
        let extent = extent.trim();
        let extent = extent.strip_prefix('(').and_then(|inner| inner.strip_suffix(')')).unwrap_or(extent);
        found.push(Evidence { backing, name, extent });
    }
    Ok(found)
}
