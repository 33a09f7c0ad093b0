//! The subjects in other languages: each agrees on every ordinary case, in one process, where its language is installed.

use std::path::{Path, PathBuf};
use std::process::{Command, Stdio};
use std::sync::LazyLock;
use std::time::Duration;

use exact_kalman::judge::{Judgement, Truth, Verdict, suite};
use exact_kalman::protocol::{Case, Limits, Outcome, Reply, Subject};

/// Whatever the machine does meanwhile.
const PATIENCE: Duration = Duration::from_secs(120);

/// The categories that `docs/PROTOCOL.md` names.
const CATEGORIES: [&str; 9] =
    ["basic", "missing", "varying", "correlated", "input", "ahead", "adapted", "arriving", "conventions"];

/// The cases that any textbook filter gets right, with what is right: those of the ordinary categories, but for the few that
/// are flagged for asking another form, or start without a law.
static ORDINARY: LazyLock<Vec<(Case, Truth)>> = LazyLock::new(|| {
    let is_ordinary = |case: &Case| {
        let category = case.id.split('/').next().expect("an id has a category");
        CATEGORIES.contains(&category)
            && !case.flags.iter().any(|flag| ["ill-conditioned", "diffuse"].contains(&flag.as_str()))
    };
    let cases: Vec<(Case, Truth)> = suite()
        .into_iter()
        .filter(is_ordinary)
        .map(|case| {
            let truth = Truth::of(&case);
            (case, truth)
        })
        .collect();
    assert!(cases.len() >= 110);
    cases
});

fn source(name: &str) -> String {
    format!("{}/examples/subjects/{name}", env!("CARGO_MANIFEST_DIR"))
}

/// Whether a program is there and does this without complaint; if not, standard error says so.
fn is_there(program: &str, arguments: &[&str]) -> bool {
    let mut command = Command::new(program);
    command.args(arguments).stdin(Stdio::null()).stdout(Stdio::null()).stderr(Stdio::null());
    let found = command.status().is_ok_and(|status| status.success());
    if !found {
        eprintln!("not run: there is no `{program} {}` here", arguments.join(" "));
    }
    found
}

/// The name of a program, which the environment may say.
fn named(variable: &str, default: &str) -> String {
    std::env::var(variable).unwrap_or_else(|_| default.to_owned())
}

/// A program compiled for this run of the tests.
fn compiled(name: &str, compiler: &str, arguments: &[&str]) -> PathBuf {
    let program = Path::new(env!("CARGO_TARGET_TMPDIR")).join(format!("{name}-{}", std::process::id()));
    let output = Command::new(compiler).args(arguments).arg("-o").arg(&program).output().expect("the compiler starts");
    assert!(output.status.success(), "{}", String::from_utf8_lossy(&output.stderr));
    program
}

fn answers_the_ordinary_cases(command: &[&str]) {
    let command: Vec<String> = command.iter().map(ToString::to_string).collect();
    let mut subject = Subject::new(&command, Limits { case_time: PATIENCE, ..Limits::default() });
    for (case, truth) in ORDINARY.iter() {
        let line = case.to_line();
        let reply = subject.ask(&case.id, &line);
        let judgement = Judgement::of(case.expect, truth, &reply);
        // Numbers that a language cannot read are not for it; nothing else is excused.
        let excused = line.contains("0x") || !line.contains(r#""numbers":"binary64""#);
        let allowed = judgement.verdict == Verdict::Agrees || excused && judgement.verdict == Verdict::Unsupported;
        assert!(allowed, "{subject}: {}: {} {:?}", case.id, judgement.verdict, judgement.remarks);
    }
    // What was found before an error is handed out.
    let settled =
        suite().into_iter().find(|case| case.id == "singular/settled-after-one").expect("a case of the suite");
    let reply = subject.ask(&settled.id, &settled.to_line());
    let Reply::Answer(answer) = reply else { panic!("{reply}") };
    assert_eq!((answer.outcome, answer.step, answer.steps.len()), (Outcome::Error, Some(1), 1), "{subject}");
    assert_eq!(subject.starts(), 1, "one process serves the whole run");
    assert_eq!(subject.strays().count, 0);
    let declaration = subject.declaration().expect("each of them declares what it is");
    assert!(declaration.name.as_ref().is_some_and(|name| name.starts_with("textbook, ")), "{declaration:?}");
    assert_eq!(declaration.unsupported, ["diffuse"]);
    assert!(subject.remarks().is_empty(), "{:?}", subject.remarks());
}

#[test]
fn python() {
    let python = named("EXACT_KALMAN_PYTHON", "python3");
    if is_there(&python, &["--version"]) {
        answers_the_ordinary_cases(&[&python, &source("textbook.py")]);
    }
}

#[test]
fn python_with_numpy() {
    let python = named("EXACT_KALMAN_PYTHON", "python3");
    if is_there(&python, &["-c", "import numpy"]) {
        answers_the_ordinary_cases(&[&python, &source("textbook_numpy.py")]);
    }
}

#[test]
fn r() {
    if is_there("Rscript", &["--version"]) {
        answers_the_ordinary_cases(&["Rscript", &source("textbook.R")]);
    }
}

#[test]
fn octave() {
    // Before version 7 there is no jsondecode.
    if is_there("octave", &["--quiet", "--eval", "jsondecode ('[]');"]) {
        answers_the_ordinary_cases(&["octave", "--quiet", &source("textbook.m")]);
    }
}

#[test]
fn c_plus_plus() {
    let compiler = named("CXX", "c++");
    if is_there(&compiler, &["--version"]) {
        let program = compiled("cpp", &compiler, &["-O1", "-std=c++17", "-Wall", "-Wextra", &source("textbook.cpp")]);
        answers_the_ordinary_cases(&[program.to_str().expect("UTF-8")]);
    }
}

#[test]
fn rust() {
    let compiler = named("RUSTC", "rustc");
    if is_there(&compiler, &["--version"]) {
        let arguments = ["-O", "--edition", "2024", "-D", "warnings", &source("textbook.rs")];
        let program = compiled("rust", &compiler, &arguments);
        answers_the_ordinary_cases(&[program.to_str().expect("UTF-8")]);
    }
}
