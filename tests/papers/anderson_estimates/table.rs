//! Table 1, simulated in small; `exact-kalman reproduce AK-Tab1` does it in full.

use exact_kalman::model::{Reading, Repair};
use exact_kalman::reproduce::{Cell, ConsistencyTable, Estimate, Setting, Statistic};

const PAPER: Setting = Setting { reading: Reading::Printed, repair: Repair::Zero, start: 100.0, batches: 200, seed: 6 };

fn cell(table: &ConsistencyTable, count: usize, estimate: Estimate, statistic: Statistic) -> Cell {
    let row = table.rows.iter().find(|row| row.count == count).expect("a printed row");
    *row.cells.iter().find(|cell| cell.estimate == estimate && cell.statistic == statistic).expect("a printed cell")
}

/// AK-Sim, AK-Tab1. Erratum AK-Tab1: (2.2) does not give the table. With 1000 batches (2.2) to the letter puts 36 of the 48 printed numbers inside the
/// central 95 %, and the reading with residuals of predictions 45. With 200 batches as here the bounds are a little
/// unsure, and a cell or two near a bound move: 40 and 43 lie between with room on both sides. The means of Ŵ decide:
/// to the letter, those for n = 20 to 100 are outside, all too small; as predictions none is.
#[test]
fn the_printed_formula_does_not_give_the_printed_table() {
    let printed = ConsistencyTable::simulated(&PAPER);
    let predictive = ConsistencyTable::simulated(&Setting { reading: Reading::Predictive, ..PAPER });
    assert!(printed.inside() <= 40, "{}", printed.inside());
    assert!(predictive.inside() >= 43, "{}", predictive.inside());
    for count in [20, 40, 60, 80, 100] {
        let [literal, other] =
            [&printed, &predictive].map(|table| cell(table, count, Estimate::Observation, Statistic::Mean));
        assert!(!literal.is_inside() && literal.central[1] < literal.printed, "{count}: {literal:?}");
        assert!(other.is_inside(), "{count}: {other:?}");
    }
    // No reading explains these two.
    for table in [&printed, &predictive] {
        assert!(!cell(table, 80, Estimate::Transition, Statistic::Variance).is_inside());
        assert!(!cell(table, 100, Estimate::Observation, Statistic::Variance).is_inside());
    }
}

/// AK-Tab1: the same name and seed give the same table, and another seed another one.
#[test]
fn tables_are_deterministic() {
    let small = Setting { batches: 3, ..PAPER };
    assert_eq!(ConsistencyTable::simulated(&small), ConsistencyTable::simulated(&small));
    let other = ConsistencyTable::simulated(&Setting { seed: 7, ..small });
    assert_ne!(ConsistencyTable::simulated(&small).rows, other.rows);
}

/// AK-Sens: from x(0) = 0 early Â(k) may be huge, and single runs then decide the variance of V̂ and Ŵ over fifty: at
/// n = 20 the median batch has more than a hundred times the variance it has from x(0) = 100. That of Δ̂, which lies
/// between 0 and 1, stays below 1.
#[test]
fn a_start_at_zero_is_dangerous() {
    let [far, near] = [100.0, 0.0].map(|start| ConsistencyTable::simulated(&Setting { start, batches: 60, ..PAPER }));
    for estimate in [Estimate::Process, Estimate::Observation] {
        let [far, near] = [&far, &near].map(|table| cell(table, 20, estimate, Statistic::Variance).median);
        assert!(near > 100.0 * far, "{near} {far}");
    }
    assert!(cell(&near, 20, Estimate::Gain, Statistic::Variance).central[1] < 1.0);
}
