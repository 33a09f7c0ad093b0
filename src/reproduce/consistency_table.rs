//! Table 1 of Anderson et al.: means and variances of the estimates over fifty runs.

use nalgebra::{SMatrix, SVector};

use super::Stream;
use crate::float::{AdaptiveFilter, Estimator};
use crate::model::{Reading, Repair};

/// What is estimated.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Estimate {
    /// Â(n)
    Transition,
    /// V̂(n)
    Process,
    /// Ŵ(n)
    Observation,
    /// Δ̂(n)
    Gain,
}

/// How fifty runs are summed up.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Statistic {
    /// Their mean.
    Mean,
    /// Their variance, divisor one less than their number.
    Variance,
}

impl Estimate {
    /// All of them, in the order of the table.
    pub const ALL: [Self; 4] = [Self::Transition, Self::Process, Self::Observation, Self::Gain];

    /// Its word.
    pub const fn name(self) -> &'static str {
        match self {
            Self::Transition => "transition",
            Self::Process => "process noise",
            Self::Observation => "observation noise",
            Self::Gain => "gain",
        }
    }
}

impl Statistic {
    /// Both, in the order of the table.
    pub const ALL: [Self; 2] = [Self::Mean, Self::Variance];

    /// Its word.
    pub const fn name(self) -> &'static str {
        match self {
            Self::Mean => "mean",
            Self::Variance => "variance",
        }
    }
}

/// The table as printed: n, then mean and variance of Â, V̂, Ŵ, Δ̂ (AK-Tab1).
const PRINTED: [(usize, [f64; 8]); 6] = [
    (20, [0.899, 0.000_152, 2.74, 4.81, 1.74, 2.89, 0.639, 0.0961]),
    (40, [0.899, 0.000_110, 3.31, 2.64, 1.43, 0.903, 0.730, 0.0320]),
    (60, [0.900, 0.000_141, 3.48, 1.70, 1.40, 0.722, 0.748, 0.0212]),
    (80, [0.899, 0.000_054_7, 3.44, 1.26, 1.28, 0.569, 0.762, 0.0214]),
    (100, [0.900, 0.000_138, 3.62, 1.70, 1.24, 0.815, 0.780, 0.0223]),
    (200, [0.901, 0.000_076_8, 3.78, 0.624, 1.10, 0.232, 0.802, 0.00669]),
];

/// What the paper gives, and what it leaves open.
///
/// AK-Sim: `p = 1, A = 9/10, V = 4, W = 1, x(0) = 100, normal noise, n = 20, 40, 60, 80, 100, 200, 50 runs for each n`
///
/// Left open, and chosen here: P̂(2) = 0 and x̂(2|2) = y(2), the recursion (2.3) from k = 3 on, V̂ and Ŵ repaired inside
/// (2.3) only, the divisor 49 of the variances (50 would not be told apart), the generator.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Setting {
    /// Which estimate of A stands in (2.2).
    pub reading: Reading,
    /// What (2.3) does with V̂ or Ŵ below zero.
    pub repair: Repair,
    /// x(0); 100 in the paper, and 0 in its remark on what happens then (AK-Sens).
    pub start: f64,
    /// How often the experiment of fifty runs is repeated.
    pub batches: usize,
    /// The seed of the streams.
    pub seed: u64,
}

/// Runs in one batch.
const RUNS: usize = 50;

/// One number of the table.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Cell {
    /// What is estimated.
    pub estimate: Estimate,
    /// Mean or variance over fifty runs.
    pub statistic: Statistic,
    /// The printed number.
    pub printed: f64,
    /// The median over the batches.
    pub median: f64,
    /// The bounds of the central 95 % of the batches.
    pub central: [f64; 2],
}

impl Cell {
    /// Whether the printed number lies in the central 95 % of the batches.
    pub fn is_inside(&self) -> bool {
        (self.central[0]..=self.central[1]).contains(&self.printed)
    }
}

/// The eight numbers for one n.
#[derive(Clone, Debug, PartialEq)]
pub struct Row {
    /// n
    pub count: usize,
    /// The cells, in the order of the paper.
    pub cells: Vec<Cell>,
}

/// The table beside the distribution of its numbers.
///
/// AK-Tab1: `means and variances of Â(n), V̂(n), Ŵ(n), Δ̂(n) over 50 runs for n = 20, 40, 60, 80, 100, 200`
///
/// # Examples
///
/// ```
/// use exact_kalman::model::{Reading, Repair};
/// use exact_kalman::reproduce::{ConsistencyTable, Setting};
///
/// let setting = Setting { reading: Reading::Printed, repair: Repair::Zero, start: 100.0, batches: 20, seed: 1 };
/// let table = ConsistencyTable::simulated(&setting);
/// assert_eq!(table, ConsistencyTable::simulated(&setting));
/// assert!(table.inside() < 48);
/// ```
#[derive(Clone, Debug, PartialEq)]
pub struct ConsistencyTable {
    /// What was simulated.
    pub setting: Setting,
    /// One row for each n.
    pub rows: Vec<Row>,
}

impl ConsistencyTable {
    /// Simulates the table.
    ///
    /// Every n has runs of its own, as the paper says; the noise is the same for all readings and repairs.
    ///
    /// # Panics
    ///
    /// If there is no batch.
    pub fn simulated(setting: &Setting) -> Self {
        assert!(setting.batches > 0, "a distribution needs a batch");
        let row = |&(count, printed): &(usize, [f64; 8])| {
            let batches: Vec<[f64; 8]> = (0..setting.batches).map(|batch| statistics(setting, count, batch)).collect();
            let places = Estimate::ALL.iter().flat_map(|estimate| Statistic::ALL.iter().map(move |s| (*estimate, *s)));
            let cells = places.enumerate().map(|(place, (estimate, statistic))| {
                let mut values: Vec<f64> = batches.iter().map(|batch| batch[place]).collect();
                values.sort_by(f64::total_cmp);
                let central = [quantile(&values, 0.025), quantile(&values, 0.975)];
                Cell { estimate, statistic, printed: printed[place], median: quantile(&values, 0.5), central }
            });
            Row { count, cells: cells.collect() }
        };
        Self { setting: *setting, rows: PRINTED.iter().map(row).collect() }
    }

    /// How many of the 48 printed numbers lie in the central 95 % of their batches.
    pub fn inside(&self) -> usize {
        self.rows.iter().flat_map(|row| &row.cells).filter(|cell| cell.is_inside()).count()
    }
}

/// The value below which the given share of the sorted values lies, the nearest one in rank.
fn quantile(sorted: &[f64], share: f64) -> f64 {
    #[expect(clippy::cast_precision_loss, clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "a rank")]
    let rank = (share * (sorted.len() - 1) as f64).round() as usize;
    sorted[rank]
}

/// Means and variances of the four estimates over one batch.
fn statistics(setting: &Setting, count: usize, batch: usize) -> [f64; 8] {
    let mut stream = Stream::named(&format!("AK-Tab1/n={count}/batch={batch}"), setting.seed);
    let runs: Vec<[f64; 4]> = (0..RUNS).map(|_| run(setting, count, &mut stream)).collect();
    let mut statistics = [0.0; 8];
    #[expect(clippy::cast_precision_loss, reason = "fifty")]
    let number = RUNS as f64;
    for place in 0..4 {
        let mean = runs.iter().map(|run| run[place]).sum::<f64>() / number;
        let squares: f64 = runs.iter().map(|run| (run[place] - mean) * (run[place] - mean)).sum();
        statistics[2 * place] = mean;
        statistics[2 * place + 1] = squares / (number - 1.0);
    }
    statistics
}

/// Â(n), V̂(n), Ŵ(n) and Δ̂(n) of one run.
fn run(setting: &Setting, count: usize, stream: &mut Stream) -> [f64; 4] {
    let mut state = setting.start;
    let mut estimator = Estimator::<1>::new(setting.reading);
    let mut filter = None;
    let (mut last, mut gain) = ([f64::NAN; 3], f64::NAN);
    for k in 1..=count {
        state = 0.9 * state + 2.0 * stream.normal();
        let y = SVector::<f64, 1>::new(state + stream.normal());
        // No product of continuous random numbers is zero but by underflow; then NaN says so.
        if estimator.observe(y).is_err() {
            return [f64::NAN; 4];
        }
        match &mut filter {
            None if k == 2 => filter = Some(AdaptiveFilter::new(y, SMatrix::zeros(), setting.repair)),
            None => {}
            Some(filter) => {
                let Some(estimates) = estimator.estimates() else { continue };
                let Some((v, w)) = estimates.noise() else { return [f64::NAN; 4] };
                gain = filter.observe(&estimates, y).map_or(f64::NAN, |gained| gained.gain[(0, 0)]);
                last = [estimates.transition[(0, 0)], v[(0, 0)], w[(0, 0)]];
            }
        }
    }
    [last[0], last[1], last[2], gain]
}
