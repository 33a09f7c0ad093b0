//! Reports for continuous integration, in the XML of JUnit.

use std::io;

use quick_xml::Writer;
use quick_xml::events::{BytesDecl, BytesText, Event};

use super::declared::{short, unsupported};
use super::text::{finding, incomplete, printable};
use super::{Report, diagnosis};
use crate::judge::{Diagnosis, Judgement, Verdict};
use crate::protocol::Case;

type Xml = Writer<Vec<u8>>;
type Result = (Case, Judgement);

/// A result with its place in the report.
type Placed<'r> = (usize, &'r Result);

/// One document on all reports: a suite for each category of each examinee, a test for each case.
///
/// A finding is a failure with the words of the report; what is unsupported or undecided is skipped. There is no clock: all
/// times are 0.
///
/// # Errors
///
/// Those of the writer.
pub fn junit(reports: &[Report]) -> io::Result<String> {
    let mut xml = Writer::new_with_indent(Vec::new(), b' ', 2);
    xml.write_event(Event::Decl(BytesDecl::new("1.0", Some("UTF-8"), None)))?;
    let all: Vec<Placed> = reports.iter().flat_map(|report| report.results.iter().enumerate()).collect();
    let element = xml.create_element("testsuites").with_attribute(("name", "exact-kalman"));
    let element = element.with_attributes(counts(&all).iter().map(|(name, count)| (*name, count.as_str())));
    element.write_inner_content(|xml| {
        for report in reports {
            let looks = report.diagnosis();
            let several = reports.len() > 1;
            for (place, (category, results)) in categories(report).into_iter().enumerate() {
                let name = if several { format!("{} · {category}", report.examinee) } else { category };
                // What is said of the whole run is said once.
                suite(xml, &name, &results, (report, &looks), place == 0)?;
            }
        }
        Ok(())
    })?;
    let mut bytes = xml.into_inner();
    bytes.push(b'\n');
    String::from_utf8(bytes).map_err(io::Error::other)
}

/// The cases by what their ids begin with, in the order in which the categories come first.
fn categories(report: &Report) -> Vec<(String, Vec<Placed<'_>>)> {
    let mut categories: Vec<(String, Vec<Placed>)> = Vec::new();
    for result in report.results.iter().enumerate() {
        let name = result.1.0.id.split_once('/').map_or("cases", |(category, _)| category);
        match categories.iter_mut().find(|(known, _)| known == name) {
            Some((_, results)) => results.push(result),
            None => categories.push((name.to_owned(), vec![result])),
        }
    }
    if categories.is_empty() {
        categories.push(("cases".to_owned(), Vec::new()));
    }
    categories
}

fn counts(results: &[Placed]) -> Vec<(&'static str, String)> {
    let failures = results.iter().filter(|(_, (_, judgement))| judgement.verdict.is_finding()).count();
    let skipped = results.iter().filter(|(_, (_, judgement))| is_skipped(judgement)).count();
    [("tests", results.len()), ("failures", failures), ("errors", 0), ("skipped", skipped), ("time", 0)]
        .map(|(name, count)| (name, count.to_string()))
        .to_vec()
}

fn is_skipped(judgement: &Judgement) -> bool {
    !judgement.verdict.is_finding() && judgement.verdict != Verdict::Agrees
}

fn suite(
    xml: &mut Xml,
    name: &str,
    results: &[Placed],
    (report, looks): (&Report, &Diagnosis),
    first: bool,
) -> io::Result<()> {
    let element = xml.create_element("testsuite").with_attribute(("name", printable(name).as_str()));
    let element = element.with_attributes(counts(results).iter().map(|(name, count)| (*name, count.as_str())));
    let name = report.declaration.as_ref().and_then(|declaration| declaration.name.as_deref());
    let examinee = printable(&report.examinee);
    let properties = [("examinee", Some(examinee)), ("name", name.map(short)), ("unsupported", unsupported(report))];
    element.write_inner_content(|xml| {
        xml.create_element("properties").write_inner_content(|xml| {
            for (name, value) in &properties {
                if let Some(value) = value {
                    let property = xml.create_element("property").with_attribute(("name", *name));
                    property.with_attribute(("value", value.as_str())).write_empty()?;
                }
            }
            Ok(())
        })?;
        results.iter().try_for_each(|result| test(xml, result, looks))?;
        let notes: Vec<String> = report.remarks.iter().map(|remark| format!("note: {}\n", printable(remark))).collect();
        let said = notes.concat() + &incomplete(report) + &diagnosis::section(looks);
        if first && !said.is_empty() {
            xml.create_element("system-out").write_text_content(BytesText::new(&said))?;
        }
        Ok(())
    })?;
    Ok(())
}

fn test(xml: &mut Xml, (place, (case, judgement)): &Placed, looks: &Diagnosis) -> io::Result<()> {
    let id = printable(&case.id);
    let class = id.split_once('/').map_or("cases", |(category, _)| category).to_owned();
    let element = xml.create_element("testcase").with_attribute(("classname", class.as_str()));
    let element = element.with_attribute(("name", id.as_str())).with_attribute(("time", "0"));
    if judgement.verdict == Verdict::Agrees {
        element.write_empty()?;
        return Ok(());
    }
    element.write_inner_content(|xml| {
        let verdict = judgement.verdict.to_string();
        if is_skipped(judgement) {
            let why = judgement.remarks.first().map_or_else(String::new, |why| format!(": {}", printable(why)));
            xml.create_element("skipped")
                .with_attribute(("message", format!("{verdict}{why}").as_str()))
                .write_empty()?;
            return Ok(());
        }
        let said = finding(case, judgement, *place, looks);
        let element = xml.create_element("failure").with_attribute(("type", judgement.verdict.name()));
        element.with_attribute(("message", verdict.as_str())).write_text_content(BytesText::new(&said))?;
        Ok(())
    })?;
    Ok(())
}
