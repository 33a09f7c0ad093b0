//! The catalogue as people read it.

use std::collections::BTreeSet;

use exact_kalman::judge::{Kind, mistake, mistakes, mistakes_page};

#[test]
fn the_page_is_that_of_the_catalogue() {
    let path = concat!(env!("CARGO_MANIFEST_DIR"), "/docs/MISTAKES.md");
    if std::env::var_os("UPDATE_DOCS").is_some() {
        std::fs::write(path, mistakes_page()).expect("docs/ can be written");
    }
    let written = std::fs::read_to_string(path).expect("docs/MISTAKES.md is there");
    assert_eq!(written, mistakes_page(), "UPDATE_DOCS=1 cargo test --test judge mistakes writes it");
}

#[test]
fn names_are_unique_and_texts_are_sentences() {
    let mut names = BTreeSet::new();
    for one in mistakes() {
        assert!(names.insert(one.name), "{} twice", one.name);
        assert!(one.name.split('-').all(|word| !word.is_empty() && word.bytes().all(|byte| byte.is_ascii_lowercase())));
        assert!(one.sentence.starts_with("you ") && !one.sentence.ends_with('.'), "{}", one.sentence);
        for text in [one.cause, one.effect, one.remedy] {
            assert!(text.ends_with('.') && text.len() > 10, "{text}");
        }
        assert_eq!(mistake(one.name), Some(one));
    }
    assert!(names.len() >= 40, "{}", names.len());
    assert!(mistakes().iter().filter(|one| one.kind == Kind::Reading).count() >= 5);
    assert_eq!(mistake("no-such-mistake"), None);
}
