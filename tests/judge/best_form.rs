//! Attainable digits against what is attained: never far below the best form, and never out of reach of all of them, but
//! for the cases that docs/FORMS.md lists with the reason.

use std::collections::{BTreeMap, BTreeSet};
use std::path::Path;

use exact_kalman::float::Form;
use exact_kalman::judge::{Digits, Sensitivity, Truth, Verdict};
use exact_kalman::protocol::{Expect, Numbers};
use exact_kalman::trace::Quantity;
use rayon::prelude::*;

use crate::known::{Known, known};
use crate::samples::{TRUTHS, path};

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

/// The form that is furthest above what is attainable.
struct Better {
    form: Form,
    quantity: Quantity,
    /// The fewest digits that the form keeps of it.
    kept: Digits,
    /// By how many digits that is more than attainable.
    excess: f64,
}

/// The best form, for the quantity where it is better by most. Both numbers are the fewest at any step, so where the fewest are attainable
/// the form keeps at least as many more.
fn best(known: &Known) -> Option<Better> {
    let scores =
        known.forms.iter().flat_map(|(form, judgement)| judgement.scores.iter().map(move |score| (*form, score)));
    let excesses = scores.map(|(form, score)| Better {
        form,
        quantity: score.quantity,
        kept: score.fewest,
        excess: score.fewest.value().min(correctly_rounded()) - score.fewest_attainable.value(),
    });
    excesses.max_by(|one, other| one.excess.total_cmp(&other.excess))
}

/// The built-in forms compute in doubles, so of single-precision data they keep what nobody can ask for.
fn is_fair(known: &Known) -> bool {
    known.case.expect == Expect::Estimate && known.case.numbers != Numbers::Binary32
}

/// By how many digits a form may be better where nothing is said about it.
const BOUND: f64 = 1.0;

/// Digits differ a little between processors, so what is this near to the bound may be listed or not.
const SLACK: f64 = 0.3;

const HEADING: &str = "## Better than attainable";

fn fair() -> impl Iterator<Item = (&'static Known, Better)> {
    known().iter().filter(|known| is_fair(known)).filter_map(|known| Some((known, best(known)?)))
}

/// Why no more counts as attainable.
fn reason(id: &str, quantity: Quantity) -> Sensitivity {
    let (case, truth) = TRUTHS.iter().find(|(case, _)| case.id == id).unwrap_or_else(|| panic!("no case {id}"));
    let Truth::Known(reference) = truth else { panic!("{id} has no truth") };
    Sensitivity::of_quantity(quantity, &path(case), case.numbers, reference).expect("some digits are lost")
}

fn row(known: &Known, better: &Better) -> String {
    let id = &known.case.id;
    let Better { form, quantity, kept, excess } = better;
    format!("| `{id}` | {form} | {kept} | {excess:.1} | {} |\n", reason(id, *quantity))
}

/// The section of the page.
fn section() -> String {
    let rows: Vec<(&Known, Better)> = fair().filter(|(_, better)| better.excess > BOUND).collect();
    let rows: String = rows.par_iter().map(|(known, better)| row(known, better)).collect();
    format!(
        "{HEADING}\n\n\
         Where some form keeps over one digit more of a quantity than counts as attainable; written by\n\
         `UPDATE_DOCS=1 cargo test --release --test judge best_form`. Both are the fewest digits at any step. *More* is the difference, where what a\n\
         correctly rounded double has counts for the form at most. The reason is that of `judge::Sensitivity`: the step, and the data that take the digits when\n\
         they alone are moved. Nobody is accused wrongly: less is asked there than could be.\n\n\
         | case | form | digits | more | reason |\n|---|---|---|---|---|\n{rows}\n"
    )
}

#[test]
fn no_form_is_better_by_more_than_a_digit_than_what_counts_as_attainable() {
    if std::env::var_os("UPDATE_DOCS").is_some() {
        let (before, rest) = FORMS.split_once(HEADING).expect("the page has the section");
        let after = &rest[rest.find("## Out of reach").expect("the page has the next section")..];
        let page = Path::new(env!("CARGO_MANIFEST_DIR")).join("docs/FORMS.md");
        std::fs::write(page, format!("{before}{}{after}", section())).expect("the page can be written");
        return;
    }
    let listed = listed(HEADING);
    let excess: BTreeMap<&str, f64> = fair().map(|(known, better)| (known.case.id.as_str(), better.excess)).collect();
    let remedy = "UPDATE_DOCS=1 cargo test --release --test judge best_form writes the list";
    for (id, excess) in &excess {
        assert!(*excess <= BOUND + SLACK || listed.contains(*id), "{id}: {excess:.1} digits more; {remedy}");
    }
    for id in &listed {
        let excess = excess.get(id.as_str()).unwrap_or_else(|| panic!("no case {id}"));
        assert!(*excess > BOUND - SLACK, "{id} is listed, for {excess:.1} digits more; {remedy}");
    }
}

/// The reasons do not depend on the processor: exact numbers, seeded.
#[test]
fn reasons_are_those_of_the_judge() {
    for (id, quantity) in
        [("units/nearly-equal-sensors", Quantity::FilteredMean), ("prior/correlated-2-20", Quantity::FilteredMean)]
    {
        let sensitivity = reason(id, quantity);
        assert_eq!(sensitivity.quantity, quantity, "{id}");
        let reference = TRUTHS.iter().find_map(|(case, truth)| match truth {
            Truth::Known(reference) if case.id == id => Some(reference),
            _ => None,
        });
        let attainable = &reference.expect("a truth").attainable;
        assert_eq!(attainable[sensitivity.step].get(&quantity), Some(&sensitivity.attainable), "{id}");
        assert!(attainable.iter().all(|step| step[&quantity].value() >= sensitivity.attainable.value()), "{id}");
    }
}

#[test]
fn better_by_more_than_a_digit_is_rare() {
    let better = fair().filter(|(_, better)| better.excess > BOUND).count();
    assert!(better * 5 <= fair().count(), "{better} of {}", fair().count());
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
