//! `reproduce AK-Tab1`: the estimates of Anderson et al. over fifty runs.

use std::io::Write as _;

use clap::ValueEnum;
use serde_json::json;

use crate::cli::Format;
use crate::cli::exit::{Exit, Trouble};
use crate::model::{Reading, Repair};
use crate::reproduce::{ConsistencyTable, Setting};

const EXAMPLES: &str = "\
Examples:
  exact-kalman reproduce AK-Tab1
  exact-kalman reproduce AK-Tab1 --batches 50           quickly, with unsure bounds
  exact-kalman reproduce AK-Tab1 --batches 50 --reading last --seed 2 --format json

Each experiment of the paper is repeated many times, and each printed number compared with the
central 95 % of what comes out.";

/// Table 1 of Anderson et al. 1969: estimates over fifty runs
#[derive(clap::Args, Debug)]
#[command(after_help = EXAMPLES)]
pub(super) struct Consistency {
    /// How often the published experiment is repeated.
    #[arg(long, default_value_t = 400, value_parser = clap::value_parser!(u32).range(1..=100_000))]
    batches: u32,
    /// Which estimate of A stands in the residuals; given several times, each of them [default: printed and
    /// predictive].
    #[arg(long, value_enum)]
    reading: Vec<ReadingName>,
    /// The seed of the random streams.
    #[arg(long, default_value_t = 1969)]
    seed: u64,
    /// How to print the table.
    #[arg(long, value_enum, default_value_t)]
    format: Format,
}

/// The readings of (2.2) by name.
#[derive(Clone, Copy, Debug, ValueEnum)]
enum ReadingName {
    /// The formula to the letter.
    Printed,
    /// The last estimate throughout, as the paper's remark allows.
    Last,
    /// Residuals of predictions.
    Predictive,
}

impl From<ReadingName> for Reading {
    fn from(name: ReadingName) -> Self {
        match name {
            ReadingName::Printed => Self::Printed,
            ReadingName::Last => Self::Last,
            ReadingName::Predictive => Self::Predictive,
        }
    }
}

impl Consistency {
    pub(super) fn run(self) -> Result<Exit, Trouble> {
        let mut readings: Vec<Reading> = self.reading.iter().copied().map(Reading::from).collect();
        if readings.is_empty() {
            readings = vec![Reading::Printed, Reading::Predictive];
        }
        let mut out = std::io::stdout().lock();
        for reading in readings {
            let batches = usize::try_from(self.batches).unwrap_or(usize::MAX);
            let setting = Setting { reading, repair: Repair::Zero, start: 100.0, batches, seed: self.seed };
            let table = ConsistencyTable::simulated(&setting);
            match self.format {
                Format::Text => write!(out, "{}", text(&table))?,
                Format::Json => writeln!(out, "{}", document(&table))?,
            }
        }
        Ok(Exit::Clean)
    }
}

/// What a reading is, in words.
fn described(reading: Reading) -> &'static str {
    match reading {
        Reading::Printed => "(2.2) to the letter",
        Reading::Last => "the last estimate throughout, as the remark after (2.2) allows",
        Reading::Predictive => "residuals of predictions; found by search, not what (2.2) says",
    }
}

fn text(table: &ConsistencyTable) -> String {
    let Setting { reading, batches, seed, .. } = table.setting;
    let mut lines = vec![
        format!("AK-Tab1 · reading {} · {}", reading.name(), described(reading)),
        format!("{batches} batches of 50 runs, seed {seed}; * is a printed number outside the central 95 %"),
        format!("{:>4}  {:18} {:9} {:>11}  {:>11} {:>11} {:>11}", "n", "", "", "printed", "2.5 %", "median", "97.5 %"),
    ];
    for row in &table.rows {
        for cell in &row.cells {
            let mark = if cell.is_inside() { ' ' } else { '*' };
            let [low, high] = cell.central;
            lines.push(format!(
                "{:4}  {:18} {:9} {:>11}{mark} {:>11} {:>11} {:>11}",
                row.count,
                cell.estimate.name(),
                cell.statistic.name(),
                short(cell.printed),
                short(low),
                short(cell.median),
                short(high)
            ));
        }
    }
    lines.push(format!("{} of 48 printed numbers inside\n", table.inside()));
    lines.join("\n") + "\n"
}

/// Four digits.
fn short(value: f64) -> String {
    if value != 0.0 && value.abs() < 0.01 { format!("{value:.3e}") } else { format!("{value:.4}") }
}

fn document(table: &ConsistencyTable) -> serde_json::Value {
    let cell = |count: usize, cell: &crate::reproduce::Cell| {
        json!({
            "count": count,
            "estimate": cell.estimate.name(),
            "statistic": cell.statistic.name(),
            "printed": cell.printed,
            "median": cell.median,
            "central": cell.central,
            "inside": cell.is_inside(),
        })
    };
    let cells: Vec<_> = table.rows.iter().flat_map(|row| row.cells.iter().map(|one| cell(row.count, one))).collect();
    json!({
        "table": "AK-Tab1",
        "reading": table.setting.reading.name(),
        "batches": table.setting.batches,
        "seed": table.setting.seed,
        "inside": table.inside(),
        "cells": cells,
    })
}
