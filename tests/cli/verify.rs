//! `solve --certificate` and `verify`: what is written is accepted, here and by the checker in Python; what was changed is not.

use std::fs;
use std::process::Command;

use serde_json::{Value, json};

use crate::program::{Directory, PROGRAM, Ran, feed, run, walk};

const NILE: &str = "examples/certificates/nile.json";

/// The certificate of a case, to so many digits.
fn certified(directory: &Directory, case: &str, digits: &str) -> String {
    let file = directory.path().join("certificate").to_str().expect("UTF-8").to_owned();
    let ran = run(&["solve", case, "--certificate", &file, "--digits", digits]);
    assert_eq!((ran.code, ran.stdout.as_str()), (0, ""), "{}", ran.stderr);
    assert!(ran.stderr.contains("steps certified with"), "{}", ran.stderr);
    file
}

fn object(ran: Ran, code: i32) -> Value {
    serde_json::from_str(&ran.quietly(code)).expect("an object")
}

#[test]
fn digits_that_are_asked_for_are_proved() {
    let directory = Directory::new();
    let file = certified(&directory, NILE, "30");
    let found = object(run(&["verify", &file, "--case", NILE, "--last", "--digits", "20", "--format", "json"]), 0);
    assert_eq!((&found["verified"], &found["steps"], &found["kind"]), (&json!(true), &json!(100), &json!("filter")));
    assert!(found["digits"].as_u64().is_some_and(|digits| digits >= 30), "{found}");
    // The same numbers as the exact filter's.
    let exact = run(&["solve", NILE, "--last", "--digits", "20"]).quietly(0);
    for name in ["filtered_mean", "filtered_covariance", "predicted_mean"] {
        let entry = &found["last"][name];
        let entry = entry[0].as_str().or(entry[0][0].as_str()).expect("a number");
        assert!(
            exact.lines().any(|line| line.contains(&name.replace('_', " ")) && line.ends_with(entry)),
            "{name} {entry}\n{exact}"
        );
    }
    let text = run(&["verify", &file, "--last"]).quietly(0);
    assert!(text.starts_with("nile/wide: verified\n"), "{text}");
    assert!(text.contains("digits proved, at least") && text.contains("filtered covariance"), "{text}");
}

#[test]
fn a_changed_certificate_is_rejected_with_its_place() {
    let directory = Directory::new();
    let file = certified(&directory, NILE, "17");
    let text = fs::read_to_string(&file).expect("written");
    let mut lines: Vec<&str> = text.lines().collect();
    lines.swap(5, 6);
    let swapped = format!("{}\n", lines.join("\n"));
    let found = object(feed(&["verify", "-", "--format", "json"], &swapped), 1);
    assert_eq!((&found["verified"], &found["line"], &found["step"]), (&json!(false), &json!(6), &json!(4)));
    let found = feed(&["verify", "-"], &text.replacen("\"exponent\":-", "\"exponent\": -", 1)).quietly(1);
    assert!(found.starts_with("rejected: line 102, digest: "), "{found}");
    let other = directory.file("other.json", walk("other", &["1", "2"]));
    let found = run(&["verify", &file, "--case", &other]).quietly(1);
    assert!(found.starts_with("rejected: case: the case inside is not the one that is given"), "{found}");
    for text in ["", "{}", "[]", "nothing", "{\"certificate\":\"exact-kalman filter 1\"}\n", "\u{feff}{}"] {
        let found = feed(&["verify", "-"], text).quietly(1);
        assert!(found.starts_with("rejected: "), "{found}");
    }
    run(&["verify", "no such file"]).trouble();
    run(&["verify", &file, "--case", "no such file"]).trouble();
}

/// `--most-bits` is the bound of a certificate's bits, too: below what the digits need nothing is written, and above the default it is used.
#[test]
fn the_most_bits_bound_certificates() {
    let directory = Directory::new();
    let to = directory.path().join("some").to_str().expect("UTF-8").to_owned();
    let ran = run(&["solve", NILE, "--certificate", &to, "--digits", "30", "--most-bits", "64"]);
    assert_eq!(ran.code, 3, "{}", ran.stderr);
    assert!(ran.stderr.contains("with 64 bits; give a higher --most-bits, or fewer --digits"), "{}", ran.stderr);
    assert!(!fs::exists(&to).expect("a directory"), "nothing is written");
    // Numbers of 10^±4000 lie 8000 digits apart.
    let sharp = walk("sharp", &["1e4000", "1e4000"]).replace("\"timing\"", "\"numbers\":\"exact\",\"timing\"");
    let sharp = sharp.replace("\"transition\":[[\"1\"]]", "\"transition\":[[\"1e4000\"]]");
    let sharp = sharp.replace("\"process\":[[\"1\"]]", "\"process\":[[\"1e-4000\"]]");
    let case = directory.file("case.json", &sharp);
    let words = ["solve", &case, "--certificate", &to, "--digits", "5"];
    assert_eq!(run(&words).code, 3);
    let ran = run(&[&words[..], &["--most-bits", "200000"]].concat());
    assert_eq!(ran.code, 0, "{}", ran.stderr);
    run(&["verify", &to]).quietly(0);
    assert!(run(&["solve", NILE, "--certificate", &to, "--tier", "exact"]).trouble().contains("enclosures"));
}

/// A certificate written over the file it speaks of would lose it; one of a steady state has no place among what is printed.
#[test]
fn a_certificate_replaces_no_model() {
    let directory = Directory::new();
    for (verb, text) in [("solve", NILE), ("steady", "examples/steady/radar.json")] {
        let text = fs::read_to_string(text).expect("an example");
        let file = directory.file("model.json", &text);
        assert!(run(&[verb, &file, "--certificate", &file]).trouble().contains("would be replaced"));
        assert_eq!(fs::read_to_string(&file).expect("still there"), text);
    }
    assert!(
        run(&["steady", "examples/steady/radar.json", "--certificate", "-"]).trouble().contains("a file of its own")
    );
}

#[test]
fn cases_that_are_not_decided_get_no_certificate() {
    let directory = Directory::new();
    let to = directory.path().join("none").to_str().expect("UTF-8").to_owned();
    let refused = |case: &str, words: &str| {
        let case = directory.file("case.json", case);
        let ran = run(&["solve", &case, "--certificate", &to]);
        assert_eq!((ran.code, ran.stdout.as_str()), (3, ""), "{}", ran.stderr);
        assert!(ran.stderr.contains(words), "{}", ran.stderr);
        assert!(!fs::exists(&to).expect("a directory"), "nothing is written");
    };
    let walk = walk("walk", &["1", "2"]);
    refused(
        &walk.replace("\"covariance\":[[\"1\"]]", "\"covariance\":[[\"1\"]],\"diffuse\":[[\"1\"]]"),
        "the start is diffuse",
    );
    // A known start read without noise: its innovation has no variance, though no sensor repeats another.
    let known = walk.replace("\"covariance\":[[\"1\"]]", "\"covariance\":[[\"0\"]]");
    refused(&known.replace("\"observation\":[[\"1\"]]}", "\"observation\":[[\"0\"]]}"), "at step 0");
    let two = directory.file("two.jsonl", format!("{walk}\n{}\n", walk.replace("walk", "other")));
    assert!(run(&["solve", &two, "--certificate", &to]).trouble().contains("one case"));
    for option in ["--exact", "--last", "--trace"] {
        run(&["solve", NILE, "--certificate", &to, option]).code.eq(&2).then_some(()).expect("usage");
    }
}

/// A steady state as it may be written by hand: x₊ = 2x read with unit noise, S = 3.
#[test]
fn steady_states_are_verified() {
    use exact_kalman::verify::{Stabilising, SteadyDocument, SteadyEvidence};
    let matrix = |exponent: i64, entry: &str| {
        serde_json::from_value(json!({"exponent": exponent, "rows": [[entry]]})).expect("a matrix")
    };
    let model = json!({"format": "exact-kalman/steady/1", "id": "doubling", "timing": "departing", "transition": [["2"]],
        "observation": [["1"]], "noise": {"process": [["0"]], "observation": [["1"]]}});
    let rate = |rate: &str| serde_json::from_value(json!({"exponent": -2, "mantissa": rate})).expect("a number");
    let document = |rate_squared| SteadyDocument {
        model: model.clone(),
        evidence: SteadyEvidence::Stabilising(Stabilising {
            solution: matrix(0, "3"),
            gap: matrix(0, "0"),
            gain: matrix(-1, "3"),
            whitening: matrix(-1, "1"),
            shape: matrix(0, "1"),
            rate_squared,
            balance: None,
            kept: None,
        }),
    };
    let directory = Directory::new();
    let good = directory.file("good.json", document(rate("1")).to_line());
    let text = run(&["verify", &good]).quietly(0);
    for words in ["doubling: verified", "all: it is exact", "0.5", "positive semidefinite", "solution"] {
        assert!(text.contains(words), "{text}");
    }
    let same = directory.file("same.json", model.to_string());
    assert_eq!(object(run(&["verify", &good, "--case", &same, "--format", "json"]), 0)["solution"], json!([["3"]]));
    let other = directory.file("other.json", model.to_string().replace("\"2\"", "\"3\""));
    assert!(run(&["verify", &good, "--case", &other]).quietly(1).starts_with("rejected: case"));
    let control = json!({"format": "exact-kalman/steady/1", "id": "doubling",
        "control": {"a": [["2"]], "b": [["1"]], "q": [["0"]], "r": [["1"]]}});
    let mut dual = document(rate("1"));
    dual.model = control;
    run(&["verify", &directory.file("dual.json", dual.to_line())]).quietly(0);
    let line = document(rate("4")).to_line();
    assert!(run(&["verify", &directory.file("slow.json", line)]).quietly(1).starts_with("rejected: contraction"));
    let damaged = document(rate("1")).to_line().replace("\"rows\":[[\"3\"]]", "\"rows\":[[\"5\"]]");
    assert!(feed(&["verify", "-"], &damaged).quietly(1).starts_with("rejected: digest"));
}

/// The commands of the page print what stands there.
#[test]
fn the_page_is_true() {
    let page = include_str!("../../docs/CERTIFICATES.md");
    let directory = Directory::new();
    std::os::unix::fs::symlink(concat!(env!("CARGO_MANIFEST_DIR"), "/examples"), directory.path().join("examples"))
        .expect("a link");
    let block = page.split("```console\n").nth(1).and_then(|rest| rest.split("```").next()).expect("a session");
    let mut count = 0;
    for session in block.split("$ exact-kalman ").skip(1) {
        let (command, expected) = session.split_once('\n').expect("a command");
        let output = Command::new(PROGRAM).args(command.split_whitespace()).current_dir(directory.path()).output();
        assert_eq!(String::from_utf8_lossy(&output.expect("it runs").stdout), expected, "{command}");
        count += 1;
    }
    assert_eq!(count, 2);
}

fn python(file: &str) -> Option<(bool, String)> {
    let mut command = Command::new("python3");
    let output =
        command.args(["examples/certificates/verify.py", file]).current_dir(env!("CARGO_MANIFEST_DIR")).output();
    let Ok(output) = output else {
        eprintln!("not run: there is no python3 here");
        return None;
    };
    let said = String::from_utf8_lossy(&output.stdout).into_owned() + &String::from_utf8_lossy(&output.stderr);
    assert!(!said.contains("Traceback"), "{said}");
    Some((output.status.success(), said))
}

/// The checker in Python and this one agree, on cases of the suite and on changed certificates.
#[test]
fn the_checker_in_python_agrees() {
    let directory = Directory::new();
    let cases = run(&["cases", "--format", "json"]).quietly(0);
    let (mut accepted, mut rejected) = (0, 0);
    for (place, line) in cases.lines().enumerate() {
        // Some of all kinds, short ones.
        if place % 17 > 0 || line.len() > 3000 || line.contains("binary32") {
            continue;
        }
        let case = directory.file("case.json", line);
        let file = directory.path().join("certificate").to_str().expect("UTF-8").to_owned();
        if run(&["solve", &case, "--certificate", &file]).code != 0 {
            continue;
        }
        run(&["verify", &file, "--case", &case]).quietly(0);
        let Some((is_accepted, said)) = python(&file) else { return };
        assert!(is_accepted, "{said}: {line}");
        accepted += 1;
        // Some matrices of the last step made far smaller, one at a time, with the digest made right.
        let text = fs::read_to_string(&file).expect("written");
        let count = text.lines().count();
        let at = text.lines().nth(count - 2).expect("a step");
        for (number, (place, _)) in at.match_indices("\"exponent\":-").enumerate().filter(|(number, _)| number % 4 == 0)
        {
            let changed = format!("{}\"exponent\":-1{}", &at[..place], &at[place + 12..]);
            let body = text.lines().take(count - 2).chain([&*changed]).collect::<Vec<_>>().join("\n") + "\n";
            let end = json!({"steps": count - 2, "sha256": digest(body.as_bytes())});
            let changed = directory.file("changed", format!("{body}{end}\n"));
            let ours = run(&["verify", &changed]);
            let Some((theirs, said)) = python(&changed) else { return };
            // A tiny whitening gives a κ that is positive, and lost where κ is rounded down: then this one rejects more.
            let is_lost = ours.stdout.contains("regular innovation");
            assert!((ours.code == 0) == theirs || (is_lost && theirs), "{number}: {} {said}", ours.stdout);
            rejected += usize::from(!theirs);
        }
    }
    assert!(accepted >= 10 && rejected >= 10, "{accepted} accepted, {rejected} rejected");
}

fn digest(bytes: &[u8]) -> String {
    use std::fmt::Write as _;

    use sha2::{Digest as _, Sha256};
    Sha256::digest(bytes).iter().fold(String::new(), |mut digits, byte| {
        let _ = write!(digits, "{byte:02x}");
        digits
    })
}

/// What `steady` writes of every example, proofs that there is no solution included, is accepted.
#[test]
fn certificates_of_steady_states_are_accepted() {
    let directory = Directory::new();
    let file = directory.path().join("certificate").to_str().expect("UTF-8").to_owned();
    let (mut proved, mut absent) = (0, 0);
    let folders = ["examples/steady", "examples/steady/dare", "examples/steady/hard"];
    let files = folders.into_iter().flat_map(|folder| fs::read_dir(folder).expect("a folder"));
    let models = files.map(|file| file.expect("a file").path()).filter(|path| path.is_file());
    // Those of a hundred states take a minute each.
    for model in models.filter(|model| !model.to_string_lossy().contains("100")) {
        let model = model.to_str().expect("UTF-8");
        let ran = run(&["steady", model, "--digits", "30", "--certificate", &file]);
        assert!(ran.code <= 1, "{model}: {}", ran.stderr);
        let found = object(run(&["verify", &file, "--case", model, "--format", "json"]), 0);
        let verdict = found["verdict"].as_str().expect("a verdict");
        assert_eq!(verdict == "stabilising", ran.code == 0, "{model}: {verdict}");
        *(if ran.code == 0 { &mut proved } else { &mut absent }) += 1;
        if ran.code == 0 {
            let radius: f64 = found["spectral_radius_at_most"].as_str().and_then(|text| text.parse().ok()).expect("r");
            assert_ne!(found["spectral_radius_at_most"], "1", "{model}");
            assert!(radius <= 1.0, "{model}");
        }
    }
    assert!(proved >= 25 && absent >= 3, "{proved} proved, {absent} absent");
}

/// A name cannot write lines of its own.
#[test]
fn names_are_printed_on_one_line() {
    let directory = Directory::new();
    let radar = fs::read_to_string("examples/steady/radar.json").expect("an example");
    let model = directory.file("model.json", radar.replace("\"radar\"", "\"a\\u001b[31m\\nb: verified\""));
    let file = directory.path().join("certificate").to_str().expect("UTF-8").to_owned();
    let _ = run(&["steady", &model, "--certificate", &file]);
    let out = run(&["verify", &file]).quietly(0);
    let first = out.lines().next().unwrap_or_default();
    assert!(first.contains("b: verified") && !out.contains('\u{1b}'), "{out}");
}

/// The case inside is compared with the given one to its last step, however both are written.
#[test]
fn a_case_that_differs_somewhere_is_told() {
    let directory = Directory::new();
    let case = walk("walk", &["1", "2", "3"]);
    let inside = directory.file("inside.json", &case);
    let file = certified(&directory, &inside, "17");
    let given = |text: String| {
        let given = directory.file("given.json", text);
        run(&["verify", &file, "--case", &given])
    };
    let observed =
        |variances: &str| case.replace("\"observation\":[[\"1\"]]}", &format!("\"observation\":[{variances}]}}"));
    let same = [
        case.replace("\"3\"", "\"3.0\""),
        observed(r#"[["1"]],[["1"]],[["1"]]"#),
        case.replace("\"walk\"", "\"other\""),
    ];
    for text in same {
        assert!(text != case && given(text.clone()).quietly(0).starts_with("walk: verified"), "{text}");
    }
    let moved = case.replace("departing", "arriving");
    let others = [
        case.replace("[\"3\"]", "[\"4\"]"),
        case.replace("[\"3\"]", "null"),
        case.replace("[\"3\"]", "[\"3\"],[\"3\"]"),
        case.replace("[\"3\"]", "[\"3\"],null"),
        case.replace(",[\"3\"]", ""),
        observed(r#"[["1"]],[["1"]],[["2"]]"#),
        case.replace("\"mean\":[\"0\"]", "\"mean\":[\"1\"]"),
        case.replace("\"covariance\":[[\"1\"]]", "\"covariance\":[[\"2\"]]"),
        case.replace("\"covariance\":[[\"1\"]]", "\"covariance\":[[\"1\"]],\"allow_indefinite\":true"),
        case.replace("\"covariance\":[[\"1\"]]", "\"covariance\":[[\"1\"]],\"diffuse\":[[\"1\"]]"),
        moved.replace("\"before\":\"observation\"", "\"before\":\"transition\""),
        moved,
        format!("{}\n{}", case.replace("\"walk\"", "\"one\""), case.replace("\"walk\"", "\"two\"")),
    ];
    for text in others {
        let found = given(text.clone()).quietly(1);
        assert_eq!(found, "rejected: case: the case inside is not the one that is given\n", "{text}");
    }
    given(observed(r#"[["1"]],[["1"]],[["-1"]]"#)).trouble();
}

/// A variance that no inequality looks at, since its reading is missing: it is found when its step comes, and nothing is verified.
#[test]
fn a_case_that_is_none_at_its_last_step_is_rejected() {
    let directory = Directory::new();
    let case = walk("walk", &["1", "2"]).replace("[\"2\"]", "null");
    let variances = |last: &str| {
        case.replace("\"observation\":[[\"1\"]]}", &format!("\"observation\":[[[\"1\"]],[[\"{last}\"]]]}}"))
    };
    let file = certified(&directory, &directory.file("case.json", variances("1")), "17");
    let text = fs::read_to_string(&file).expect("written");
    let from = "\"observation\":[[[\"1\"]],[[\"1\"]]]";
    assert!(text.contains(from), "{text}");
    let lines: Vec<_> =
        text.lines().map(|line| line.replace(from, &from.replace("[[\"1\"]]]", "[[\"-1\"]]]"))).collect();
    let body = lines[..lines.len() - 1].join("\n") + "\n";
    let end = json!({"steps": 2, "sha256": digest(body.as_bytes())});
    for option in [&["--last"][..], &["--format", "json"]] {
        let found = feed(&[&["verify", "-"], option].concat(), &format!("{body}{end}\n")).quietly(1);
        let words = "case inside: noise.observation: observation noise at step 1 is not positive semidefinite";
        assert!(found.contains(words) && found.contains("case") && found.lines().count() == 1, "{found}");
        assert!(found.starts_with("rejected: case: the case") || found.contains("\"verified\":false"), "{found}");
    }
}

/// A short text that would take gigabytes, or hours, is refused before it does.
#[test]
fn a_case_that_asks_for_too_much_is_refused() {
    let verdict = |n: usize, m: usize, steps: usize| {
        let unit = |n: usize| -> Vec<Vec<&str>> {
            (0..n).map(|i| (0..n).map(|j| if i == j { "1" } else { "0" }).collect()).collect()
        };
        let case = json!({"format": "exact-kalman/case/1", "id": "long", "timing": "departing",
            "initial": {"before": "observation", "mean": vec!["0"; n], "covariance": unit(n)}, "transition": unit(n),
            "observation": vec![vec!["1"; n]; m], "noise": {"process": unit(n), "observation": unit(m)},
            "observations": vec![[(); 0]; 0]});
        let case = case
            .to_string()
            .replace("\"observations\":[]", &format!("\"observations\":[{}null]", "null,".repeat(steps - 1)));
        let nothing = json!({"exponent": 0, "rows": [["0"]]});
        let start = json!({"covariance": nothing, "gap": nothing, "mean": nothing, "ellipsoid": nothing});
        let header = format!("{{\"certificate\":\"exact-kalman filter 1\",\"case\":{case},\"start\":{start}}}\n");
        feed(&["verify", "-"], &header).quietly(1)
    };
    let readings = verdict(1, 500, 70_000);
    assert!(readings.starts_with("rejected: size: the case inside has 70000 readings of 500 sensors"), "{readings}");
    for (n, m) in [(513, 1), (1, 513)] {
        let found = verdict(n, m, 1);
        assert!(found.starts_with(&format!("rejected: line 1, size: {n} states and {m} sensors")), "{found}");
    }
    // Many steps of large matrices that stand there once are no trouble: the belief is what is wrong.
    let long = verdict(60, 1, 100_000);
    assert!(long.starts_with("rejected: line 1, shape: "), "{long}");
}
