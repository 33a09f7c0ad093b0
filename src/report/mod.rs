//! Floor 6 · Judgements for people and for programs.
//!
//! A [`Report`] collects the judgements on one examinee. It is shown as text ([`text`]), several of them side by
//! side ([`side_by_side`]), as JSON ([`json`]), as JUnit's XML ([`junit`]), or as Markdown ([`markdown`]). Nothing is judged here, and the same judgements give the same
//! bytes: no clock, no order but that of the cases.

mod comparison;
mod declared;
mod diagnosis;
mod entry;
mod json;
mod junit;
mod markdown;
mod printable;
mod reference;
mod text;

use std::collections::BTreeMap;

pub use comparison::side_by_side;
pub use json::json;
pub use junit::junit;
pub use markdown::markdown;
pub(crate) use printable::printable;
pub use reference::reference;
pub use text::text;

use crate::judge::{Diagnosis, Judgement, Verdict};
use crate::protocol::{Case, Declaration};

/// The judgements on one examinee, in the order of the cases.
#[derive(Clone, Debug)]
pub struct Report {
    /// The name of the examinee.
    pub examinee: String,
    /// The cases with their judgements.
    pub results: Vec<(Case, Judgement)>,
    /// What the examinee declared of itself.
    pub declaration: Option<Declaration>,
    /// How many cases were to be judged and were not, since the run was stopped: the report is then incomplete.
    pub unjudged: usize,
    /// Whether it was stopped at the first finding, as asked, and not by an interruption.
    pub at_first_finding: bool,
    /// What is to be said of the whole run, such as stray lines.
    pub remarks: Vec<String>,
}

impl Report {
    /// A report without judgements.
    pub fn new(examinee: impl Into<String>) -> Self {
        Self {
            examinee: examinee.into(),
            results: Vec::new(),
            declaration: None,
            unjudged: 0,
            at_first_finding: false,
            remarks: Vec::new(),
        }
    }

    /// How many cases came to which verdict, best verdict first.
    pub fn counts(&self) -> Vec<(&'static str, usize)> {
        let mut counts: BTreeMap<Verdict, usize> = BTreeMap::new();
        for (_, judgement) in &self.results {
            // All losses count as one, however many digits.
            let verdict = match judgement.verdict {
                Verdict::Loses { .. } => Verdict::Loses { digits: 0 },
                other => other,
            };
            *counts.entry(verdict).or_default() += 1;
        }
        counts.into_iter().map(|(verdict, count)| (verdict.name(), count)).collect()
    }

    /// The results that are findings: the worst verdict first, and of one verdict the one that misses most digits.
    pub fn findings(&self) -> Vec<&(Case, Judgement)> {
        self.placed_findings().into_iter().map(|(_, finding)| finding).collect()
    }

    /// The same, each with its place among the results.
    pub(crate) fn placed_findings(&self) -> Vec<(usize, &(Case, Judgement))> {
        let results = self.results.iter().enumerate();
        let mut findings: Vec<_> = results.filter(|(_, (_, judgement))| judgement.verdict.is_finding()).collect();
        findings.sort_by(|(_, (_, one)), (_, (_, other))| {
            other.verdict.cmp(&one.verdict).then(other.shortfall().total_cmp(&one.shortfall()))
        });
        findings
    }

    /// Which known mistakes explain the findings.
    pub fn diagnosis(&self) -> Diagnosis {
        Diagnosis::of(self.results.iter().map(|(_, judgement)| judgement))
    }

    /// Whether the examinee says of every case that it does not know such models.
    pub fn is_unsupported(&self) -> bool {
        self.results.iter().all(|(_, judgement)| judgement.verdict == Verdict::Unsupported)
    }

    /// Whether some case could not be decided.
    pub fn is_undecided(&self) -> bool {
        self.results.iter().any(|(_, judgement)| judgement.verdict == Verdict::Undecided)
    }
}
