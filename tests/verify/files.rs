//! Certificates as files.

use exact_kalman::certify::CertifiedFilter;
use exact_kalman::protocol::Case;
use exact_kalman::verify::{CertificateWriter, Condition, FilterCertificate, VerifyError};

const CASE: &str = r#"{"format":"exact-kalman/case/1","id":"walk","timing":"departing",
    "initial":{"before":"observation","mean":["0"],"covariance":[["1/3"]]},"numbers":"exact",
    "transition":[["1"]],"observation":[["1"]],
    "noise":{"process":[["1"]],"observation":[["1"]]},"observations":[["1"],["1/3"],null,["2"]]}"#;

fn certificate() -> String {
    let case = Case::parse(CASE).expect("a case");
    let path = case.problem().expect("numbers").realised().expect("a model");
    let mut filter = CertifiedFilter::new(&path, 64).with_witness();
    let start = filter.belief_document().expect("a start");
    let mut writer = CertificateWriter::begin(Vec::new(), &case.to_line(), &start).expect("memory");
    while let Some(step) = filter.next() {
        step.expect("decided");
        writer.step(&filter.step_document().expect("a witness")).expect("memory");
    }
    String::from_utf8(writer.end().expect("memory")).expect("UTF-8")
}

fn verified(text: &str) -> Result<usize, (Option<usize>, Condition)> {
    let rejected = |error| match error {
        VerifyError::Rejected(rejection) => (rejection.line, rejection.condition),
        VerifyError::Case(_) => (None, Condition::Case),
        VerifyError::Input(error) => panic!("{error}"),
    };
    let certificate = FilterCertificate::open(text.as_bytes()).map_err(rejected)?;
    let case = |_| (Some(1), Condition::Case);
    let problem = Case::parse(certificate.case()).map_err(case)?.problem().map_err(case)?;
    let mut steps = 0;
    certificate.verify(&problem.system, &problem.observations, |_| steps += 1).map_err(rejected)?;
    Ok(steps)
}

#[test]
fn lines_are_checked_one_by_one() {
    let text = certificate();
    assert_eq!(verified(&text), Ok(4));
    assert_eq!(verified(text.trim_end()), Ok(4));
    let lines: Vec<&str> = text.lines().collect();
    assert_eq!(lines.len(), 6);
    let joined = |lines: &[&str]| lines.join("\n") + "\n";
    let changed = |change: &dyn Fn(&mut Vec<&str>)| {
        let mut lines = lines.clone();
        change(&mut lines);
        verified(&joined(&lines)).expect_err("something was changed")
    };
    assert_eq!(changed(&|lines| lines.swap(2, 3)), (Some(3), Condition::Order));
    assert_eq!(
        changed(&|lines| lines.retain(|line| *line != text.lines().nth(2).unwrap_or_default())),
        (Some(3), Condition::Order)
    );
    assert_eq!(changed(&|lines| lines.insert(2, lines[2])), (Some(4), Condition::Order));
    assert_eq!(changed(&|lines| lines.truncate(5)), (Some(6), Condition::Document));
    assert_eq!(changed(&|lines| lines.truncate(4)), (Some(5), Condition::Document));
    assert_eq!(changed(&|lines| lines.push("")), (Some(7), Condition::Document));
    assert_eq!(changed(&|lines| lines.push(lines[5])), (Some(7), Condition::Document));
    assert_eq!(changed(&|lines| lines.insert(1, "")), (Some(2), Condition::Document));
    assert_eq!(changed(&|lines| lines.clear()), (Some(1), Condition::Document));
    assert_eq!(changed(&|lines| lines.rotate_left(1)), (Some(1), Condition::Document));
}

/// Every byte replaced by some others: rejected, but for what JSON does not mind, which the digest sees.
#[test]
fn no_byte_may_be_changed() {
    let text = certificate();
    let mut by_digest = 0;
    for place in 0..text.len() - 1 {
        for other in [b'0', b'7', b'a', b'-', b' ', b'"', b'}'] {
            let mut bytes = text.clone().into_bytes();
            if bytes[place] == other {
                continue;
            }
            bytes[place] = other;
            let Ok(changed) = String::from_utf8(bytes) else { continue };
            let found = verified(&changed).expect_err("a byte was changed");
            by_digest += usize::from(found.1 == Condition::Digest);
        }
    }
    assert!(by_digest > 100, "{by_digest}");
}

#[test]
fn members_are_those_of_the_format() {
    let text = certificate();
    let line = |from: &str, to: &str| verified(&text.replacen(from, to, 1)).expect_err("something was changed");
    let document = |line| (Some(line), Condition::Document);
    assert_eq!(line("filter 1", "filter 2"), document(1));
    assert_eq!(line("{\"certificate\"", "{\"more\":1,\"certificate\""), document(1));
    assert_eq!(line("\"step\":0", "\"step\":0,\"step\":0"), document(2));
    assert_eq!(line("\"step\":0", "\"step\":-1"), document(2));
    assert_eq!(line("\"step\":0", "\"step\":0,\"kept\":null"), document(2));
    assert_eq!(line("\"exponent\":", "\"exponent\":1048577,\"rest\":"), document(1));
    assert_eq!(line("{\"step\":0", "[{\"step\":0"), document(2));
    let far = verified(&text.replacen("\"exponent\":-", "\"exponent\":-99999999", 1)).expect_err("far");
    assert_eq!(far, document(1));
}
