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

/// What a verdict forgives, and a half: digits differ a little between processors.
const FORGIVEN: f64 = 2.5;

#[test]
fn no_form_is_better_by_more_than_verdicts_forgive_than_what_counts_as_attainable() {
    let excesses = || known().iter().filter(|known| is_fair(known)).filter_map(|known| Some((known, excess(known)?)));
    let listed = listed("## Better than attainable");
    for (known, (excess, quantity, form)) in excesses() {
        let id = &known.case.id;
        assert!(
            excess <= FORGIVEN || listed.contains(id),
            "{id}: {form} has {excess:.1} digits more of the {quantity}"
        );
    }
    for id in &listed {
        let (_, (excess, ..)) =
            excesses().find(|(known, _)| known.case.id == *id).unwrap_or_else(|| panic!("no case {id}"));
        assert!(excess > 1.0, "{id} is listed, and no form is better by more than {excess:.1} digits");
    }
}

#[test]
fn better_by_more_than_a_digit_is_rare() {
    let fair: Vec<_> = known().iter().filter(|known| is_fair(known)).collect();
    let better = fair.iter().filter_map(|known| excess(known)).filter(|(excess, ..)| *excess > 1.0).count();
    assert!(better * 5 <= fair.len(), "{better} of {}", fair.len());
}

#[test]
fn some_form_comes_within_two_digits_of_what_counts_as_attainable() {
    let listed = listed("## Out of reach");
    for known in known().iter().filter(|known| known.case.expect == Expect::Estimate) {
        let supported = known.forms.iter().filter(|(_, judgement)| judgement.verdict != Verdict::Unsupported);
        let verdicts: Vec<Verdict> = supported.map(|(_, judgement)| judgement.verdict).collect();
        let reached = verdicts.is_empty() || verdicts.contains(&Verdict::Agrees);
        assert!(reached || listed.contains(&known.case.id), "{}: {verdicts:?}", known.case.id);
    }
    assert!(listed.iter().all(|id| known().iter().any(|known| known.case.id == *id)), "{listed:?}");
}
