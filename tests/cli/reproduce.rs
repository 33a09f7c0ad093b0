//! `reproduce`: a published table beside its distribution, the same bytes for the same seed.

use serde_json::Value;

use crate::program::run;

const SMALL: [&str; 4] = ["reproduce", "AK-Tab1", "--batches", "20"];

#[test]
fn same_seed_same_bytes() {
    let text = run(&SMALL).quietly(0);
    assert_eq!(text, run(&SMALL).quietly(0));
    assert_ne!(text, run(&[&SMALL[..], &["--seed", "7"]].concat()).quietly(0));
    assert!(text.contains("reading printed · (2.2) to the letter"), "{text}");
    assert!(text.contains("reading predictive · ") && text.contains("not what (2.2) says"), "{text}");
    assert_eq!(text.matches("20 batches of 50 runs, seed 1969").count(), 2);
    assert_eq!(text.lines().filter(|line| line.contains("of 48 printed numbers inside")).count(), 2);
    // Each line with a star is a number outside.
    for table in text.split("of 48 printed numbers inside").take(2) {
        let outside = table.lines().filter(|line| line.contains('*') && !line.contains("batches")).count();
        let inside: usize = table.lines().last().and_then(|line| line.trim().parse().ok()).expect("a count");
        assert_eq!(inside + outside, 48);
    }
}

#[test]
fn the_table_as_json() {
    let out = run(&[&SMALL[..], &["--reading", "last", "--format", "json"]].concat()).quietly(0);
    let table: Value = serde_json::from_str(&out).unwrap();
    let cells = table["cells"].as_array().unwrap();
    assert_eq!((&table["reading"], &table["seed"], cells.len()), (&"last".into(), &1969.into(), 48));
    let inside = cells.iter().filter(|cell| cell["inside"] == Value::Bool(true)).count();
    assert_eq!(table["inside"], inside);
    // The first printed number of the table.
    assert_eq!((&cells[0]["count"], &cells[0]["printed"].to_string()), (&20.into(), &"0.899".to_owned()));
}

#[test]
fn unknown_tables_are_refused() {
    for arguments in [&["reproduce", "Table-2"][..], &["reproduce"], &["reproduce", "AK-Tab1", "--batches", "0"]] {
        assert_eq!(run(arguments).code, 2);
    }
}
