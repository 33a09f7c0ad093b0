//! Attainable digits against what is attained: never far below the best form, and never out of reach of all of them, but
//! for the cases that docs/FORMS.md lists with the reason.

use std::collections::BTreeSet;

use exact_kalman::judge::Verdict;
use exact_kalman::protocol::{Expect, Numbers};
use exact_kalman::trace::Quantity;

use crate::known::{Known, known};

const FORMS: &str = include_str!("../../docs/FORMS.md");

/// The first column of the table under a heading, cells in backquotes.
fn listed(heading: &str) -> BTreeSet<String> {
    let section = FORMS.split(heading).nth(1).unwrap_or_else(|| panic!("docs/FORMS.md has no {heading}"));
    let section = section.split("\n## ").next().unwrap_or_default();
    let cell = |line: &str| line.strip_prefix("| `")?.split('`').next().map(str::to_owned);
    section.lines().filter_map(cell).collect()
}

/// What a correctly rounded answer has: 53 bits. More is luck.
fn correctly_rounded() -> f64 {
    53.0 * std::f64::consts::LOG10_2
}

/// By how many digits the best form is better than attainable, for the quantity where it is by most.
fn excess(known: &Known) -> Option<(f64, Quantity, String)> {
    let scores =
        known.forms.iter().flat_map(|(form, judgement)| judgement.scores.iter().map(move |score| (form, score)));
    let excesses = scores.map(|(form, score)| {
        let digits = score.fewest.value().min(correctly_rounded());
        (digits - score.fewest_attainable.value(), score.quantity, form.to_string())
    });
    excesses.max_by(|one, other| one.0.total_cmp(&other.0))
}

/// The built-in forms compute in doubles, so of single-precision data they keep what nobody can ask for.
fn is_fair(known: &Known) -> bool {
    known.case.expect == Expect::Estimate && known.case.numbers != Numbers::Binary32
}

#[test]
fn no_form_is_better_by_more_than_a_digit_than_what_counts_as_attainable() {
    let better: Vec<_> = known()
        .iter()
        .filter(|known| is_fair(known))
        .filter_map(|known| {
            let (excess, quantity, form) = excess(known)?;
            (excess > 1.0).then(|| (known.case.id.clone(), format!("{form} has {excess:.1} more of the {quantity}")))
        })
        .collect();
    let found: BTreeSet<String> = better.iter().map(|(id, _)| id.clone()).collect();
    assert_eq!(found, listed("## Better than attainable"), "{better:#?}");
}

#[test]
fn some_form_comes_within_two_digits_of_what_counts_as_attainable() {
    let out_of_reach: BTreeSet<String> = known()
        .iter()
        .filter(|known| known.case.expect == Expect::Estimate)
        .filter(|known| {
            let supported = known.forms.iter().filter(|(_, judgement)| judgement.verdict != Verdict::Unsupported);
            let verdicts: Vec<Verdict> = supported.map(|(_, judgement)| judgement.verdict).collect();
            !verdicts.is_empty() && !verdicts.contains(&Verdict::Agrees)
        })
        .map(|known| known.case.id.clone())
        .collect();
    assert_eq!(out_of_reach, listed("## Out of reach"));
}
