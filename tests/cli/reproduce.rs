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
    let table: Value = serde_json::from_str(&out).expect("JSON");
    let cells = table["cells"].as_array().expect("an array");
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

/// The printed covariances are none: refused with the vector that proves it, and run under the override.
#[test]
fn indefinite_starts_are_refused_and_may_be_run() {
    let said = run(&["reproduce", "HV-Tab1", "--start", "printed", "--runs", "2"]).trouble();
    assert!(said.contains("v'Pv = -3045") && said.contains("--allow-indefinite"), "{said}");
    let arguments =
        ["reproduce", "HV-Tab1", "--start", "printed", "--allow-indefinite", "--runs", "2", "--format", "json"];
    let rows: Vec<Value> =
        run(&arguments).quietly(0).lines().map(|line| serde_json::from_str(line).expect("a row")).collect();
    assert_eq!(rows.len(), 10);
    // The first printed row, and none of its errors is met.
    assert_eq!((rows[0]["beta"].as_str(), rows[0]["standard"]["printed"].as_f64()), (Some("2"), Some(65.38)));
    assert!(rows.iter().all(|row| row["standard"]["inside"] == Value::Bool(false)), "{rows:?}");
}

/// Two steps ahead the paper prints no numbers.
#[test]
fn two_steps_ahead_nothing_is_printed() {
    let text = run(&["reproduce", "HV-Tab1", "--two-steps", "--runs", "2"]).quietly(0);
    assert!(text.starts_with("HV-Tab1 · two steps ahead, start repaired, linear at the prediction; 2 runs"), "{text}");
    assert_eq!(text.lines().filter(|line| line.contains("MS_SKP") && line.trim_end().ends_with('-')).count(), 10);
}

#[test]
fn figures_are_columns() {
    for (figure, first) in [("HV-Fig1", "1,"), ("HV-Fig2", "2,")] {
        let text = run(&["reproduce", figure]).quietly(0);
        let lines: Vec<&str> = text.lines().collect();
        assert_eq!(lines[0], "k,biomass,standard,extended");
        assert!(lines[1].starts_with(first) && lines[lines.len() - 1].starts_with("150,"), "{figure}");
        assert_eq!(text, run(&["reproduce", figure]).quietly(0));
        assert_ne!(text, run(&["reproduce", figure, "--seed", "1"]).quietly(0));
    }
    assert_eq!(run(&["reproduce", "HV-Fig1", "--beta", "nan"]).code, 2);
    let negative = run(&["reproduce", "HV-Fig1", "--beta", "-1"]);
    assert_eq!(negative.code, 2);
    assert!(negative.stderr.contains("a number, at least 0"), "{}", negative.stderr);
}
