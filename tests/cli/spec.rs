//! `spec` prints what stands in SPEC.md.

use crate::program::run;

/// Identifiers and status as a reader of the page counts them.
fn listed() -> Vec<(String, String)> {
    let page = include_str!("../../SPEC.md");
    let sections = page.split("\n### ").skip(1);
    let status =
        |section: &str| section.lines().find_map(|line| line.strip_prefix('*')?.split('*').next().map(str::to_owned));
    sections
        .map(|section| (section.split(' ').next().unwrap_or_default().to_owned(), status(section).expect("a status")))
        .collect()
}

#[test]
fn every_item_of_a_paper_is_listed() {
    for paper in ["CKS", "HV", "AK", "SM", "WG", "EK"] {
        let printed = run(&["spec", paper]).quietly(0);
        let expected = listed().into_iter().filter(|(id, _)| id.starts_with(&format!("{paper}-")));
        let found = printed.lines().map(|line| {
            let mut words = line.split_whitespace().map(str::to_owned);
            (words.next().expect("at least one"), words.next().expect("at least one"))
        });
        assert!(found.eq(expected), "{printed}");
    }
}

/// A line names status, strongest evidence, number of tests, title and code.
#[test]
fn a_line_tells_how_an_item_is_held() {
    let printed = run(&["spec", "CKS"]).quietly(0);
    let line = printed.lines().find(|line| line.starts_with("CKS-R ")).expect("an item");
    let page = include_str!("../../SPEC.md")
        .split("\n### CKS-R ")
        .nth(1)
        .expect("there")
        .split("\n### ")
        .next()
        .expect("there");
    assert!(page.contains("[`trace::Record`]"));
    let words: Vec<&str> = line.split_whitespace().collect();
    assert_eq!(words[1], "implemented");
    // The strongest evidence comes first.
    let strongest = page.split("\nBacking: ").nth(1).expect("there");
    let word = [("proved for all sizes", "theorem"), ("proved symbolically", "symbolic"), ("proved by SMT", "smt")]
        .into_iter()
        .chain([("zero at random points", "points"), ("exhaustive", "exhaustive"), ("tested", "tested")])
        .find_map(|(begins, word)| strongest.starts_with(begins).then_some(word));
    assert_eq!(Some(words[2]), word);
    let named = page.split("\nTests: ").nth(1).expect("there").matches('`').count() / 2;
    assert_eq!(words[3], named.to_string());
    assert!(line.ends_with("Predicted covariance · trace::Record"), "{line}");
}

#[test]
fn the_overview_counts() {
    let printed = run(&["spec"]).quietly(0);
    for (line, paper) in printed.lines().skip(1).zip(["CKS", "HV", "AK", "SM", "WG", "EK"]) {
        let of_paper: Vec<_> = listed().into_iter().filter(|(id, _)| id.starts_with(&format!("{paper}-"))).collect();
        let with = |status: &str| of_paper.iter().filter(|(_, own)| own == status).count();
        let counts = [of_paper.len(), with("implemented"), with("checked"), with("prose"), with("open")];
        let numbers: Vec<usize> = line[56..].split_whitespace().map(|word| word.parse().expect("a number")).collect();
        assert_eq!(numbers[..5], counts, "{line}");
    }
    // Each item that a test names is counted once by its strongest evidence.
    let page = include_str!("../../SPEC.md");
    for (line, paper) in printed.lines().skip(9).zip(["CKS", "HV", "AK", "SM", "WG", "EK"]) {
        let numbers: Vec<usize> = line[56..].split_whitespace().map(|word| word.parse().expect("a number")).collect();
        let sections = page.split("\n### ").filter(|section| section.starts_with(&format!("{paper}-")));
        let backed = sections.filter(|section| section.contains("\nBacking: ")).count();
        assert_eq!((numbers.len(), numbers.iter().sum::<usize>()), (6, backed), "{line}");
    }
    assert_eq!(printed.lines().count(), 15, "{printed}");
}

#[test]
fn an_item_is_printed_with_its_code_and_tests() {
    let printed = run(&["spec", "CKS-11"]).quietly(0);
    let lines: Vec<&str> = printed.lines().collect();
    assert_eq!(lines[0], "CKS-11 · Innovation covariance, written out (Chen, Kumar, van Schuppen 1989)");
    assert_eq!(lines[2].trim(), "P_yy|z = C A P Aᵀ Cᵀ + (F + C D)(F + C D)ᵀ");
    assert!(lines.contains(&"code   filter::filter"), "{printed}");
    assert!(printed.contains(" papers::chen::errata::the_innovation_covariance_has_no_third_term\n"), "{printed}");
}

#[test]
fn json_is_one_item_on_each_line() {
    let printed = run(&["spec", "CKS-12", "--format", "json"]).quietly(0);
    let document: serde_json::Value = serde_json::from_str(printed.trim()).expect("JSON");
    assert_eq!((&document["id"], &document["status"]), (&"CKS-12".into(), &"implemented".into()));
    assert_eq!(document["errata"][0]["right"], "the last factor is P_yx|z");
}

#[test]
fn errata_are_selected() {
    let printed = run(&["spec", "CKS", "--errata", "--format", "json"]).quietly(0);
    assert!(printed.lines().count() >= 8);
    assert!(printed.lines().all(|line| line.contains("\"printed\"")), "{printed}");
}

#[test]
fn unknown_identifiers_are_refused_with_those_that_begin_alike() {
    // Put together, as it is no identifier.
    let said = run(&["spec", concat!("CKS", "-1")]).trouble();
    assert!(said.contains("CKS-1a, CKS-1b") && said.trim_end().ends_with(", …"), "{said}");
    assert_eq!(run(&["spec", "cks-11"]).quietly(0), run(&["spec", "CKS-11"]).quietly(0));
    assert!(run(&["spec", "XYZ"]).trouble().contains("CKS, HV, AK, SM, WG, EK"));
}
