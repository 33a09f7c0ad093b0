//! `explain`: the known mistakes.

use crate::program::run;

#[test]
fn all_are_listed() {
    let out = run(&["explain"]).quietly(0);
    assert!(out.starts_with("Mistakes\n\npredicted-for-filtered: you return the predicted moments"), "{out}");
    let (_, readings) = out.split_once("\nReadings, which are no faults\n\n").expect("two chapters");
    assert!(readings.contains("innovation-of-the-other-sign: "), "{readings}");
    // Two titles, each with a blank line below, and one above the second.
    assert!(out.lines().filter(|line| line.contains(": you ")).count() == out.lines().count() - 5, "{out}");
}

#[test]
fn each_has_a_page() {
    let list = run(&["explain"]).quietly(0);
    for line in list.lines().filter(|line| line.contains(": you ")).take(5) {
        let (name, sentence) = line.split_once(": ").expect("a name");
        let page = run(&["explain", name]).quietly(0);
        assert!(page.starts_with(&format!("{name} (")) && page.contains(sentence), "{page}");
        for part in ["\nCause:  ", "\nEffect: ", "\nRemedy: "] {
            assert!(page.contains(part), "{page}");
        }
    }
}

#[test]
fn an_unknown_name_is_trouble() {
    let trouble = run(&["explain", "everything"]).trouble();
    assert!(trouble.contains("everything") && trouble.contains("exact-kalman explain lists them all"), "{trouble}");
}
