//! The shipped suite below `suite/`: it is what this program writes, and what a second route computes.
//!
//! `UPDATE_SUITE=1 cargo test --release --test judge references` writes it anew.

use std::collections::BTreeMap;
use std::fs;
use std::path::{Path, PathBuf};
use std::sync::LazyLock;

use exact_kalman::filter::one_shot;
use exact_kalman::judge::{Judgement, SUITE_VERSION, Verdict};
use exact_kalman::protocol::{Answer, Case, Decimal, Expect, Reply};
use exact_kalman::report::reference;
use exact_kalman::scalar::Rational;
use serde_json::{Value, json};
use sha2::{Digest as _, Sha256};

use crate::samples::{TRUTHS, exact_values, path};

fn directory() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("suite")
}

fn checksum(content: &str) -> String {
    let nibbles = Sha256::digest(content.as_bytes()).into_iter().flat_map(|byte| [byte / 16, byte % 16]);
    nibbles.filter_map(|nibble| char::from_digit(nibble.into(), 16)).collect()
}

/// All files of the suite as they are to be, by their paths.
static FILES: LazyLock<BTreeMap<String, String>> = LazyLock::new(|| {
    let mut files = BTreeMap::new();
    for (case, truth) in TRUTHS.iter() {
        files.insert(format!("cases/{}.json", case.id), case.to_pretty());
        files.insert(format!("references/{}.json", case.id), reference(case, truth).expect("a truth that is known"));
    }
    let checksums: BTreeMap<&String, String> = files.iter().map(|(path, text)| (path, checksum(text))).collect();
    let manifest = format!(
        "{{\n  \"format\": \"exact-kalman/manifest/1\",\n  \"suite\": {SUITE_VERSION},\n  \"seed\": 0,\n  \"cases\": {},\n  \"files\": {{\n{}\n  }}\n}}\n",
        TRUTHS.len(),
        checksums.iter().map(|(path, sum)| format!("    \"{path}\": \"{sum}\"")).collect::<Vec<_>>().join(",\n"),
    );
    files.insert("MANIFEST.json".into(), manifest);
    files
});

/// The files that are there, but for the page that explains them.
fn shipped() -> BTreeMap<String, String> {
    fn collect(directory: &Path, name: &str, files: &mut BTreeMap<String, String>) {
        for entry in fs::read_dir(directory).expect("the shipped suite") {
            let path = entry.expect("an entry").path();
            let name = format!("{name}{}", path.file_name().and_then(|name| name.to_str()).expect("a name"));
            if path.is_dir() {
                collect(&path, &format!("{name}/"), files);
            } else if name != "README.md" {
                files.insert(name, fs::read_to_string(&path).expect("text"));
            }
        }
    }
    let mut files = BTreeMap::new();
    collect(&directory(), "", &mut files);
    files
}

/// A package from a registry comes without the suite, which is larger than the program.
fn is_packaged_without() -> bool {
    let root = Path::new(env!("CARGO_MANIFEST_DIR"));
    !directory().exists() && root.join(".cargo_vcs_info.json").exists()
}

#[test]
fn the_shipped_suite_is_what_is_generated() {
    if is_packaged_without() {
        return;
    }
    if std::env::var_os("UPDATE_SUITE").is_some() {
        for kind in ["cases", "references"] {
            let _ = fs::remove_dir_all(directory().join(kind));
        }
        for (name, text) in FILES.iter() {
            let path = directory().join(name);
            fs::create_dir_all(path.parent().expect("a directory")).expect("a directory");
            fs::write(path, text).expect("a file");
        }
    }
    let shipped = shipped();
    let remedy = "see suite/README.md: UPDATE_SUITE=1 writes the files anew";
    for (name, text) in FILES.iter() {
        let found = shipped.get(name).unwrap_or_else(|| panic!("suite/{name} is not there; {remedy}"));
        assert!(found == text, "suite/{name} differs; {remedy}");
    }
    for name in shipped.keys() {
        assert!(FILES.contains_key(name), "suite/{name} is left over; {remedy}");
    }
}

fn shipped_references() -> impl Iterator<Item = (&'static Case, Value, Answer)> {
    TRUTHS.iter().filter(|_| !is_packaged_without()).map(|(case, _)| {
        let path = directory().join(format!("references/{}.json", case.id));
        let text = fs::read_to_string(&path).unwrap_or_else(|error| panic!("{}: {error}", path.display()));
        let document: Value = serde_json::from_str(&text).expect("JSON");
        let answer = Answer::parse(&document["answer"].to_string()).expect("an answer");
        (case, document, answer)
    })
}

/// The numbers of a matrix or vector, and the strings that are shipped for them.
fn flat(value: &Value) -> Vec<&str> {
    match value {
        Value::Array(items) => items.iter().flat_map(flat).collect(),
        other => vec![other.as_str().expect("a string")],
    }
}

/// The numbers again, by conditioning everything at once or by the readable recursion: each decimal is the correct one.
#[test]
fn a_second_route_finds_the_same_decimals() {
    let mut compared = 0;
    for (case, document, _) in shipped_references() {
        // The second routes take long for long cases; the shipped answers to those are judged below.
        let short = case.observations.len() <= 25 && case.initial.mean.len() <= 6;
        if case.expect != Expect::Estimate || !short {
            continue;
        }
        let steps = document["answer"]["steps"].as_array().expect("steps");
        assert_eq!(steps.len(), case.observations.len(), "{}", case.id);
        for (k, (values, step)) in exact_values(case).iter().zip(steps).enumerate() {
            for (quantity, matrix) in values {
                let Some(shipped) = step.get(quantity.name()) else {
                    assert_eq!(quantity.name(), "gain", "{} at step {k}", case.id);
                    continue;
                };
                let decimals: Vec<String> =
                    matrix.entries().iter().map(|value: &Rational| Decimal::rounded(value, 25).to_string()).collect();
                assert_eq!(flat(shipped), decimals, "{}: {quantity} at step {k}", case.id);
                compared += decimals.len();
            }
        }
    }
    assert!(is_packaged_without() || compared > 20_000, "{compared}");
}

/// Whoever sends the references as answers agrees everywhere, with all digits.
#[test]
fn the_references_agree_as_answers() {
    for ((case, document, answer), (_, truth)) in shipped_references().zip(TRUTHS.iter()) {
        assert_eq!((&document["id"], &answer.id), (&json!(case.id), &case.id));
        let judgement = Judgement::of(case.expect, truth, &Reply::Answer(answer));
        assert_eq!(judgement.verdict, Verdict::Agrees, "{}: {:?}", case.id, judgement.remarks);
        for score in &judgement.scores {
            assert!(score.fewest.value() >= 17.0, "{}: {} {}", case.id, score.quantity, score.fewest.value());
        }
    }
}

#[test]
fn contradictions_and_refusals_are_told_with_step_and_reason() {
    let mut seen = (0, 0);
    for (case, document, answer) in shipped_references() {
        let message = document["answer"]["message"].as_str();
        match case.expect {
            Expect::Estimate => assert_eq!((message, answer.step), (None, None), "{}", case.id),
            Expect::Flag => {
                let error = one_shot(&path(case)).expect_err(&case.id);
                assert_eq!(answer.step, Some(error.step), "{}", case.id);
                assert_eq!(answer.steps.len(), error.step, "{}", case.id);
                assert!(message.is_some_and(|text| text.contains("probability zero")), "{}", case.id);
                seen.0 += 1;
            }
            Expect::Refuse => {
                let error = case.problem().and_then(|problem| problem.realised()).expect_err(&case.id);
                assert_eq!(message, Some(error.to_string().as_str()), "{}", case.id);
                assert!(document.get("attainable").is_none() && answer.steps.is_empty(), "{}", case.id);
                seen.1 += 1;
            }
        }
    }
    assert!(is_packaged_without() || seen == (12, 47), "{seen:?}");
}

/// Every key of the documents, and nothing else, is in their schema.
#[test]
fn the_documents_have_their_schema() {
    let schema: Value = serde_json::from_str(include_str!("../../schema/references.schema.json")).expect("JSON");
    let conforms = |value: &Value, rules: &Value| {
        let object = value.as_object().expect("an object");
        let required = rules["required"].as_array().expect("a list");
        assert!(required.iter().all(|key| object.contains_key(key.as_str().expect("a key"))), "{value}");
        for (key, item) in object {
            let rule = &rules["properties"][key];
            assert!(!rule.is_null(), "{key}");
            assert!(rule.get("const").is_none_or(|constant| constant == item), "{key}: {item}");
            assert!(rule["enum"].as_array().is_none_or(|values| values.contains(item)), "{key}: {item}");
            let right = match rule["type"].as_str() {
                Some("string") => item.is_string(),
                Some("integer") => item.is_u64(),
                Some("array") => item.is_array(),
                Some("object") => item.is_object(),
                _ => true,
            };
            assert!(right, "{key}: {item}");
        }
    };
    for (_, document, _) in shipped_references() {
        let rules = &schema["$defs"]["reference"];
        conforms(&document, rules);
        conforms(&document["answer"], &rules["properties"]["answer"]);
    }
    conforms(&serde_json::from_str(&FILES["MANIFEST.json"]).expect("JSON"), &schema["$defs"]["manifest"]);
}

/// What the page says of the suite is so.
#[test]
fn the_page_counts_right() {
    if is_packaged_without() {
        return;
    }
    let page = fs::read_to_string(directory().join("README.md")).expect("the page");
    let words = page.split_whitespace().collect::<Vec<_>>().join(" ");
    assert!(words.contains(&format!("In version {SUITE_VERSION} the suite has {} cases", TRUTHS.len())), "{words}");
    for category in exact_kalman::judge::categories() {
        let row = format!("| `{}` | {} |", category.name, category.about);
        let count = TRUTHS.iter().filter(|(case, _)| case.id.split('/').next() == Some(category.name)).count();
        assert!(page.contains(&format!("{row} {count} |")), "{row} {count} |");
    }
    for flag in exact_kalman::judge::flags() {
        let row = format!("| `{}` | {} | {} | {} |", flag.name, flag.exercises, flag.failing, flag.concerns);
        assert!(page.contains(&row), "{row}");
    }
}
