//! The pages, and the wrong filters that belong to them.

mod answers;
mod conventions;
mod covariances;
mod data;
mod gains;
mod numerics;
mod start;
mod steps;

use super::fault::Fault;
use super::problem::Change;
use super::rearrangement::Rearrangement;
use super::{Kind, Mistake, Wrong};

/// A page, and each way to make the mistake.
pub(super) type Entry = (Mistake, Vec<Way>);

/// A way to make a mistake.
pub(super) struct Way {
    /// What tells it from the others.
    pub(super) label: String,
    /// Whether it does less than the way before it.
    pub(super) fades: bool,
    /// What comes of it.
    pub(super) wrong: Wrong,
}

/// All entries, in order.
pub(super) fn entries() -> Vec<Entry> {
    let chapters: [fn() -> Vec<Entry>; 8] = [
        answers::entries,
        conventions::entries,
        steps::entries,
        data::entries,
        start::entries,
        covariances::entries,
        gains::entries,
        numerics::entries,
    ];
    chapters.iter().flat_map(|chapter| chapter()).collect()
}

/// An entry: its sentence, cause, effect and remedy, and the ways.
fn entry(name: &'static str, kind: Kind, [sentence, cause, effect, remedy]: [&'static str; 4], ways: Ways) -> Entry {
    (Mistake { name, kind, sentence, cause, effect, remedy }, ways.0)
}

/// Ways to make one mistake.
struct Ways(Vec<Way>);

impl Ways {
    fn one(wrong: impl Into<Wrong>) -> Self {
        Self(vec![Way { label: String::new(), fades: false, wrong: wrong.into() }])
    }

    fn named<W: Into<Wrong>>(ways: impl IntoIterator<Item = (impl Into<String>, W)>) -> Self {
        let way = |(label, wrong): (_, W)| Way { label: Into::into(label), fades: false, wrong: wrong.into() };
        Self(ways.into_iter().map(way).collect())
    }

    /// Ways of which each does less than the one before it.
    fn fading<W: Into<Wrong>>(ways: impl IntoIterator<Item = (impl Into<String>, W)>) -> Self {
        let mut ways = Self::named(ways);
        ways.0.iter_mut().skip(1).for_each(|way| way.fades = true);
        ways
    }

    fn and(mut self, other: Self) -> Self {
        self.0.extend(other.0);
        self
    }
}

impl From<Rearrangement> for Wrong {
    fn from(rearrangement: Rearrangement) -> Self {
        Self::Answer(rearrangement)
    }
}

impl From<Change> for Wrong {
    fn from(change: Change) -> Self {
        Self::Problem(change)
    }
}

impl From<Fault> for Wrong {
    fn from(fault: Fault) -> Self {
        Self::Recursion(fault)
    }
}
