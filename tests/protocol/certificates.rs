//! Certificates are of the form that their schema says.

use exact_kalman::certify::CertifiedFilter;
use exact_kalman::protocol::Case;
use exact_kalman::verify::{CertificateWriter, RationalRows, SteadyDocument, SteadyEvidence};
use serde_json::{Value, json};

use crate::samples::walk;
use crate::schema::valid;

const SCHEMA: &str = include_str!("../../schema/certificate.schema.json");

fn is_valid(value: &Value) -> bool {
    let schema: Value = serde_json::from_str(SCHEMA).expect("JSON");
    valid(&schema, &schema, value)
}

#[test]
fn lines_of_certificates_agree_with_the_schema() {
    let case = Case::parse(&walk().to_string()).expect("a case");
    let path = case.problem().expect("numbers").realised().expect("a model");
    let mut filter = CertifiedFilter::new(&path, 100).with_witness();
    let start = filter.belief_document().expect("a start");
    let mut writer = CertificateWriter::begin(Vec::new(), &case.to_line(), &start).expect("memory");
    while let Some(Ok(_)) = filter.next() {
        writer.step(&filter.step_document().expect("a witness")).expect("memory");
    }
    let text = String::from_utf8(writer.end().expect("memory")).expect("UTF-8");
    assert!(text.lines().count() > 2);
    for line in text.lines() {
        let value: Value = serde_json::from_str(line).expect("JSON");
        assert!(is_valid(&value), "{line}");
        for key in value
            .as_object()
            .expect("an object")
            .keys()
            .filter(|key| !["kept", "predicted", "ahead", "whitening"].contains(&key.as_str()))
        {
            let mut less = value.clone();
            less.as_object_mut().expect("an object").remove(key);
            assert!(!is_valid(&less), "{line} without {key}");
        }
        let mut more = value.clone();
        more["more"] = json!(1);
        assert!(!is_valid(&more), "{line} with more");
    }
}

#[test]
fn steady_certificates_agree_with_the_schema() {
    let rows = || RationalRows(vec![vec!["-3/2".to_owned()]]);
    let between = Some(["1".to_owned(), "3/2".to_owned()]);
    for evidence in [
        SteadyEvidence::Unobservable { basis: rows(), map: rows() },
        SteadyEvidence::Unreachable { basis: rows(), injection: rows(), map: rows(), between },
        SteadyEvidence::Unreachable { basis: rows(), injection: rows(), map: rows(), between: None },
    ] {
        let line = SteadyDocument { model: json!({}), evidence }.to_line();
        let value: Value = serde_json::from_str(&line).expect("JSON");
        assert!(is_valid(&value), "{line}");
        let mut other = value.clone();
        other["verdict"] = json!("stabilising");
        assert!(!is_valid(&other), "{line}");
    }
}
