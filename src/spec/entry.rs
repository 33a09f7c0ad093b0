//! An entry, and what is known of it.

use std::fmt;

use super::{Backing, Erratum, Evidence};

/// What has become of an item of a paper.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum Status {
    /// Code computes it exactly.
    Implemented,
    /// A test checks what it claims.
    Checked,
    /// Nothing in it can be computed; the entry says why.
    Prose,
    /// Not done; the entry says what is missing.
    Open,
}

impl Status {
    /// Every status, in order.
    pub const ALL: [Self; 4] = [Self::Implemented, Self::Checked, Self::Prose, Self::Open];

    /// The word that stands in the page.
    pub const fn name(self) -> &'static str {
        match self {
            Self::Implemented => "implemented",
            Self::Checked => "checked",
            Self::Prose => "prose",
            Self::Open => "open",
        }
    }
}

impl fmt::Display for Status {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.pad(self.name())
    }
}

/// A paper that the specification covers, or this project.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum Paper {
    /// Chen, Kumar, van Schuppen 1989.
    ChenKumarVanSchuppen,
    /// Hilgert, Vila 1999.
    HilgertVila,
    /// Anderson, Kleindorfer, Kleindorfer, Woodroofe 1969.
    Anderson,
    /// Sowers, Makowski 1988.
    SowersMakowski,
    /// Wang, Guo 1999.
    WangGuo,
    /// None: statements of this project.
    Own,
}

impl Paper {
    /// Every paper, in the order of the page.
    pub const ALL: [Self; 6] =
        [Self::ChenKumarVanSchuppen, Self::HilgertVila, Self::Anderson, Self::SowersMakowski, Self::WangGuo, Self::Own];

    /// The letters with which its identifiers begin.
    pub const fn prefix(self) -> &'static str {
        match self {
            Self::ChenKumarVanSchuppen => "CKS",
            Self::HilgertVila => "HV",
            Self::Anderson => "AK",
            Self::SowersMakowski => "SM",
            Self::WangGuo => "WG",
            Self::Own => "EK",
        }
    }

    /// Authors and year.
    pub const fn name(self) -> &'static str {
        match self {
            Self::ChenKumarVanSchuppen => "Chen, Kumar, van Schuppen 1989",
            Self::HilgertVila => "Hilgert, Vila 1999",
            Self::Anderson => "Anderson, Kleindorfer, Kleindorfer, Woodroofe 1969",
            Self::SowersMakowski => "Sowers, Makowski 1988",
            Self::WangGuo => "Wang, Guo 1999",
            Self::Own => "of this project",
        }
    }

    /// The paper to which an identifier belongs.
    pub fn of(id: &str) -> Option<Self> {
        let (prefix, rest) = id.split_once('-')?;
        Self::ALL.into_iter().find(|paper| paper.prefix() == prefix && !rest.is_empty())
    }
}

/// One item of a paper.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Entry<'a> {
    /// The identifier, which never changes.
    pub id: &'a str,
    /// The paper it belongs to.
    pub paper: Paper,
    /// What it is called.
    pub title: &'a str,
    /// The equation or the claim, in our notation.
    pub equation: &'a str,
    /// What has become of it.
    pub status: Status,
    /// The items of this crate that the entry links, as paths from its root.
    pub code: Vec<&'a str>,
    /// What it rests on, the strongest first.
    pub evidence: Vec<Evidence<'a>>,
    /// The tests that name the entry, as `cargo test` calls them, the test program first.
    pub tests: Vec<&'a str>,
    /// What else is said about it: hypotheses, what fails without them.
    pub text: String,
    /// The slips of the paper that were found there.
    pub errata: Vec<Erratum>,
}

impl Entry<'_> {
    /// The strongest kind of evidence; nothing for what cannot be computed or is open.
    pub fn backing(&self) -> Option<Backing> {
        self.evidence.iter().map(|evidence| evidence.backing).min()
    }
}
