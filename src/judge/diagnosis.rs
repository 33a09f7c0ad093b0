//! Which known mistakes explain the findings of a whole run.

use super::Judgement;
use super::mistakes::{Hypothesis, Mistake, Outcome, hypotheses, mistakes};

/// What a run looks like: as few known mistakes as explain as many findings as possible.
///
/// A mistake is named only if it is met by more of the answers in which it shows than not.
///
/// # Examples
///
/// A program that hands out its predictions:
///
/// ```
/// use exact_kalman::judge::{Diagnosis, Judgement, Truth, suite};
/// use exact_kalman::protocol::{Answer, Reply};
///
/// let case = suite().swap_remove(0);
/// let line = r#"{"id":"basic/constant","outcome":"answered","steps":[
///     {"filtered_mean":["0"],"filtered_covariance":[["1"]]},
///     {"filtered_mean":["0.5"],"filtered_covariance":[["0.5"]]}]}"#;
/// let reply = Reply::Answer(Answer::parse(line)?);
/// let judgement = Judgement::of(case.expect, &Truth::of(&case), &reply);
/// let diagnosis = Diagnosis::of([&judgement]);
/// assert_eq!(diagnosis.explanations[0].mistake.name, "predicted-for-filtered");
/// # Ok::<(), exact_kalman::protocol::AnswerError>(())
/// ```
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Diagnosis {
    /// Best supported first.
    pub explanations: Vec<Explanation>,
}

/// A mistake that explains findings.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Explanation {
    /// The mistake.
    pub mistake: &'static Mistake,
    /// The ways to make it that the answers do not tell apart; empty if it has only one.
    pub ways: Vec<&'static str>,
    /// The findings that it explains, by their places among the judgements; those of an explanation before it, too.
    pub explains: Vec<usize>,
    /// How many answers show it.
    pub shows: usize,
    /// How many of these are what it makes of their case.
    pub met: usize,
    /// Other mistakes that these answers do not tell apart from this one.
    pub alike: Vec<&'static Mistake>,
}

/// A hypothesis, and what speaks for it.
struct Support {
    hypothesis: &'static Hypothesis,
    met: Vec<usize>,
    shows: usize,
}

impl Support {
    fn mistake(&self) -> &'static Mistake {
        &mistakes()[self.hypothesis.mistake]
    }

    fn missed(&self) -> usize {
        self.shows - self.met.len()
    }

    fn newly_explained<'a>(&'a self, explained: &'a [usize]) -> impl Iterator<Item = usize> + 'a {
        self.met.iter().copied().filter(|place| !explained.contains(place))
    }
}

impl Diagnosis {
    /// What the judgements on one examinee look like together.
    pub fn of<'a>(judgements: impl IntoIterator<Item = &'a Judgement>) -> Self {
        let judgements: Vec<&Judgement> = judgements.into_iter().collect();
        let support = |(place, hypothesis): (usize, &'static Hypothesis)| {
            let stands = || judgements.iter().map(|judgement| judgement.mistakes.get(place));
            let met = stands().enumerate().filter(|(_, stand)| *stand == Some(&Outcome::Met)).map(|(case, _)| case);
            let shows = stands().filter(|stand| stand.is_some_and(|stand| *stand != Outcome::Silent)).count();
            Support { hypothesis, met: met.collect(), shows }
        };
        let mut candidates: Vec<Support> = hypotheses().iter().enumerate().map(support).collect();
        candidates.retain(|candidate| candidate.met.len() > candidate.missed());
        let (mut explained, mut explanations) = (Vec::new(), Vec::new());
        loop {
            let worth =
                |support: &Support| (support.newly_explained(&explained).count(), usize::MAX - support.missed());
            // Of equals the first, which is that of the catalogue's order.
            let best = candidates.iter().rev().max_by_key(|candidate| worth(candidate));
            let Some(best) = best.filter(|best| worth(best).0 > 0) else { break };
            let alike: Vec<&Support> = candidates
                .iter()
                .filter(|other| {
                    other.missed() == best.missed()
                        && other.newly_explained(&explained).eq(best.newly_explained(&explained))
                })
                .collect();
            explanations.push(explanation(best, &alike));
            let met = best.met.clone();
            explained.extend(met);
        }
        Self { explanations }
    }

    /// The explanations of one judgement, by its place.
    pub fn explanations_of(&self, place: usize) -> impl Iterator<Item = &Explanation> {
        self.explanations.iter().filter(move |explanation| explanation.explains.contains(&place))
    }
}

fn explanation(best: &Support, alike: &[&Support]) -> Explanation {
    let ways = alike.iter().filter(|other| other.hypothesis.mistake == best.hypothesis.mistake);
    let mut others: Vec<&'static Mistake> = Vec::new();
    for other in alike.iter().filter(|other| other.hypothesis.mistake != best.hypothesis.mistake) {
        if !others.contains(&other.mistake()) {
            others.push(other.mistake());
        }
    }
    Explanation {
        mistake: best.mistake(),
        ways: ways.map(|way| way.hypothesis.label.as_str()).filter(|label| !label.is_empty()).collect(),
        explains: best.met.clone(),
        shows: best.shows,
        met: best.met.len(),
        alike: others,
    }
}
