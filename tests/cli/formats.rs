//! The forms of a report say the same, and nothing from outside is obeyed in any of them.

use std::fs;

use serde_json::Value;

use crate::program::{Directory, Ran, run, walk};

/// A second reader: the XML of a report, read by another library than the one that writes it.
fn read(xml: &str) -> roxmltree::Document<'_> {
    roxmltree::Document::parse(xml).unwrap_or_else(|error| panic!("{error}: {xml}"))
}

fn elements<'a>(document: &'a roxmltree::Document<'a>, name: &'a str) -> Vec<roxmltree::Node<'a, 'a>> {
    document.descendants().filter(|node| node.has_tag_name(name)).collect()
}

fn number(node: roxmltree::Node, name: &str) -> usize {
    node.attribute(name).and_then(|text| text.parse().ok()).unwrap_or_else(|| panic!("{name} of {node:?}"))
}

/// Four walks of two categories, one of them agreed upon, one wrong, one unsupported, one undecided.
const IDS: [&str; 4] = ["one/good", "one/bad", "two/foreign", "undecided"];

fn judged(directory: &Directory, more: &[&str]) -> Ran {
    let cases: Vec<String> = IDS.iter().map(|id| walk(id, &[if *id == "undecided" { "NaN" } else { "1" }])).collect();
    let answers = r#"{"format":"exact-kalman/subject/1","name":"sampler 2.0"}
{"id":"one/good","outcome":"answered","steps":[{"filtered_mean":["0.5"]}]}
{"id":"one/bad","outcome":"answered","steps":[{"filtered_mean":["0.6"]}]}
{"id":"two/foreign","outcome":"unsupported","message":"not for me"}
{"id":"undecided","outcome":"answered"}
{"id":"nobody","outcome":"answered"}"#;
    let cases = directory.file("cases.jsonl", cases.join("\n"));
    let answers = directory.file("answers.jsonl", answers);
    run(&[&["judge", &cases, &answers], more].concat())
}

const FINDING: &str = "filtered mean at step 0, entry [0]: 0 digits where 15 are attainable: 0.6 answered, 0.5 exact";
const NOTE: &str = "\"nobody\" is answered, but it is no case that was asked";

#[test]
fn junit_is_read_by_another_reader() {
    let xml = judged(&Directory::new(), &["--format", "junit"]).quietly(1);
    let document = read(&xml);
    let root = document.root_element();
    assert_eq!(root.tag_name().name(), "testsuites");
    let counts = |node| ["tests", "failures", "errors", "skipped", "time"].map(|name| number(node, name));
    assert_eq!(counts(root), [4, 1, 0, 2, 0]);
    let suites = elements(&document, "testsuite");
    let named: Vec<_> = suites.iter().map(|suite| (suite.attribute("name").expect("a name"), counts(*suite))).collect();
    assert_eq!(named, [("one", [2, 1, 0, 0, 0]), ("two", [1, 0, 0, 1, 0]), ("cases", [1, 0, 0, 1, 0])]);
    let tests = elements(&document, "testcase");
    let of = |name| tests.iter().map(|test| test.attribute(name).expect("it is there")).collect::<Vec<_>>();
    assert_eq!((of("name"), of("classname")), (IDS.to_vec(), vec!["one", "one", "two", "cases"]));
    let inside: Vec<Vec<&str>> = tests
        .iter()
        .map(|test| test.children().filter(roxmltree::Node::is_element).map(|node| node.tag_name().name()).collect())
        .collect();
    assert_eq!(inside, [vec![], vec!["failure"], vec!["skipped"], vec!["skipped"]]);
    let failure = elements(&document, "failure")[0];
    assert_eq!((failure.attribute("type"), failure.attribute("message")), (Some("wrong"), Some("wrong")));
    assert!(failure.text().expect("words").contains(FINDING), "{xml}");
    assert!(elements(&document, "skipped")[0].attribute("message").expect("why").contains("not for me"), "{xml}");
    let property = |name| {
        let found = elements(&document, "property").into_iter().find(|node| node.attribute("name") == Some(name));
        found.and_then(|node| node.attribute("value").map(str::to_owned))
    };
    assert_eq!(property("name").as_deref(), Some("sampler 2.0"));
    let said: Vec<_> = elements(&document, "system-out").iter().filter_map(roxmltree::Node::text).collect();
    assert!(said.len() == 1 && said[0].contains(NOTE), "once for the whole run: {said:?}");
}

#[test]
fn markdown_says_what_the_text_says() {
    let directory = Directory::new();
    let out = judged(&directory, &["--format", "markdown"]).quietly(1);
    assert!(out.starts_with("### exact-kalman: 1 finding in 4 cases\n"), "{out}");
    assert!(out.contains("declares `sampler 2.0`") && out.contains(NOTE), "{out}");
    for row in ["| agrees | 1 |", "| unsupported | 1 |", "| undecided | 1 |", "| wrong | 1 |"] {
        assert!(out.contains(row), "{row}: {out}");
    }
    assert!(out.contains("| 1 | `one/bad` | wrong | filtered mean at step 0 | 0 | 15 |"), "{out}");
    assert!(out.contains("| `one/good` | agrees | 17 / 15 |"), "{out}");
    // Long lines are broken; the words are those of the text.
    let words = |text: &str| text.split_whitespace().collect::<Vec<_>>().join(" ");
    assert!(words(&out).contains(&words(FINDING)), "{out}");
    assert_eq!(out.matches("<details>").count(), out.matches("</details>").count());
    for start in ["| verdict", "| | finding", "| case"] {
        let rows = out.lines().skip_while(|line| !line.starts_with(start)).take_while(|line| !line.is_empty());
        let bars: Vec<usize> = rows.map(|row| row.matches('|').count()).collect();
        assert!(bars.len() > 2 && bars.iter().all(|count| *count == bars[0]), "{start}: {bars:?}");
    }
}

#[test]
fn files_are_what_would_be_printed() {
    let directory = Directory::new();
    let names = ["judged.txt", "judged.json", "judged.xml", "judged.md"];
    let paths = names.map(|name| directory.path().join(name).to_str().expect("UTF-8").to_owned());
    let files: Vec<&str> = paths.iter().flat_map(|path| ["--report", path]).collect();
    let printed = judged(&directory, &files).quietly(1);
    for (path, format) in paths.iter().zip(["text", "json", "junit", "markdown"]) {
        let expected = judged(&directory, &["--format", format]).quietly(1);
        assert_eq!(fs::read_to_string(path).expect("it was written"), expected, "{format}");
    }
    assert_eq!(fs::read_to_string(&paths[0]).expect("it was written"), printed);
}

#[test]
fn files_that_cannot_be_meant_are_told_before_anything_is_asked() {
    let directory = Directory::new();
    for (file, why) in
        [("judged.html", ".txt, .json, .xml or .md"), ("judged", ".md"), ("no/such/place.md", "no directory")]
    {
        let path = directory.path().join(file);
        let ran = run(&["check", "--report", path.to_str().expect("UTF-8"), "--", "sh", "-c", "exit 9"]);
        assert_eq!((ran.code, ran.stdout.as_str()), (2, ""), "{file}");
        assert!(ran.stderr.contains(why), "{}", ran.stderr);
    }
    // What is only found out in the end loses no report.
    let folder = directory.path().join("folder.md");
    fs::create_dir(&folder).expect("it can be made");
    let ran = judged(&directory, &["--report", folder.to_str().expect("UTF-8")]);
    assert_eq!(ran.code, 2);
    assert!(ran.stdout.contains(FINDING) && ran.stderr.contains("folder.md"), "{}", ran.stderr);
}

#[test]
fn the_built_in_filters_in_every_form() {
    let cases = ["check", "--only", "basic/constant-velocity", "--format"];
    let xml = run(&[&cases[..], &["junit"]].concat()).quietly(0);
    let suites = elements(&read(&xml), "testsuite").iter().map(|node| number(*node, "tests")).collect::<Vec<_>>();
    let json = run(&[&cases[..], &["json"]].concat()).quietly(0);
    assert_eq!(suites, vec![1; json.lines().count()]);
    let markdown = run(&[&cases[..], &["markdown"]].concat()).quietly(0);
    assert_eq!(markdown.matches("### exact-kalman: ").count(), json.lines().count());
}

/// What a terminal, XML, HTML and Markdown would each obey.
const HOSTILE: &str =
    "\u{1b}[2J\u{9b}31m]]>&amp;<b>\"'`|x`` \\| @all <!-- </details> ```\n\u{202e}\u{0}\u{feff}\u{ffff}";

#[test]
fn nothing_from_outside_is_obeyed() {
    let directory = Directory::new();
    let id = Value::from(HOSTILE).to_string();
    let case = walk("walk", &["1"]).replace("\"id\":\"walk\"", &format!("\"id\":{id},\"about\":{id}"));
    let answer = format!(r#"{{"id":{id},"outcome":"error","message":{id}}}"#);
    let declaration = format!(r#"{{"format":"exact-kalman/subject/1","name":{id},"unsupported":[{id}]}}"#);
    let cases = directory.file("cases.jsonl", case);
    let answers =
        directory.file("answers.jsonl", format!("{declaration}\n{answer}\n{}", answer.replace("all", "none")));
    let harmless = |text: &str| {
        let bad = |c: char| (c.is_control() && c != '\n') || "\u{202e}\u{feff}\u{ffff}".contains(c);
        assert!(!text.contains(bad), "{text:?}");
    };
    for format in ["text", "junit", "markdown", "json"] {
        let out = run(&["judge", &cases, &answers, "--format", format]).quietly(1);
        match format {
            // JSON has escapes of its own for what a terminal obeys.
            "json" => assert!(!out.contains('\u{1b}') && serde_json::from_str::<Value>(&out).is_ok()),
            "junit" => {
                harmless(&out);
                let document = read(&out);
                let name = elements(&document, "testcase")[0].attribute("name").expect("a name").to_owned();
                assert!(name.contains("]]>&amp;<b>\"'`|x`` \\| @all <!-- </details> ```"), "{name:?}");
                assert!(document.descendants().all(|node| !node.is_comment() && !node.has_tag_name("b")), "{out}");
            }
            "markdown" => {
                harmless(&out);
                // Outside of fences it is all entities; the fence is longer than what it holds.
                let fence = "````text\n";
                let (before, rest) = out.split_once(fence).expect("a fence");
                let (_, after) = rest.split_once("\n````\n").expect("its end");
                for outside in [before, after] {
                    assert!(
                        !outside.contains("<b>") && !outside.contains("@all") && !outside.contains("<!--"),
                        "{out}"
                    );
                    assert!(!outside.contains("``") && !outside.contains("`|"), "{outside}");
                }
                assert_eq!(before.matches("</details>").count() + after.matches("</details>").count(), 2, "{out}");
            }
            _ => harmless(&out),
        }
    }
}

#[test]
fn stopping_at_the_first_finding() {
    let directory = Directory::new();
    let out = judged(&directory, &["--fail-fast"]).quietly(1);
    assert!(
        out.ends_with(
            "2 cases: 1 agrees, 1 wrong\nincomplete: stopped at the first finding, and 2 more cases not asked\n"
        ),
        "{out}"
    );
    let report: Value =
        serde_json::from_str(&judged(&directory, &["--fail-fast", "--format", "json"]).quietly(1)).expect("JSON");
    assert_eq!((&report["unjudged"], &report["at_first_finding"]), (&Value::from(2), &Value::from(true)));
    for format in ["markdown", "junit"] {
        let out = judged(&directory, &["--fail-fast", "--format", format]).quietly(1);
        assert!(out.contains("stopped at the first finding, and 2 more cases not asked"), "{out}");
    }
    // Without a finding nothing is left out.
    let good = directory.file("good.jsonl", walk("one/good", &["1"]));
    let answers = directory.path().join("answers.jsonl");
    let out = run(&["judge", "--fail-fast", &good, answers.to_str().expect("UTF-8")]).quietly(0);
    assert!(!out.contains("incomplete"), "{out}");
    // A program is not asked any more.
    let asked = directory.path().join("asked");
    let script = format!("while read -r line; do echo asked >> {}; echo '{{'; done", asked.display());
    let cases = directory.path().join("cases.jsonl");
    let cases = cases.to_str().expect("UTF-8");
    let out = run(&["check", "--fail-fast", "--cases", cases, "--", "sh", "-c", &script]).quietly(1);
    assert!(out.contains("3 more cases not asked"), "{out}");
    assert_eq!(fs::read_to_string(asked).expect("it was asked").lines().count(), 1);
    assert_eq!(run(&["check", "--fail-fast"]).code, 2, "there is nothing to stop");
}
