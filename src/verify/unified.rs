//! One step in one form for both timings.
//!
//! `x₊ = A x + b + w`, `y = H x + c + v`, cov(w; v) = [[Q, S], [Sᵀ, R]]. A transition that arrives in the state that is read is
//! put into the reading: `H = C A`, `S = Q Cᵀ + X`, `R + C Q Cᵀ + C X + XᵀCᵀ` for the noise, `c + C b`.

use super::definite::rank;
use super::rejection::{Condition, Rejection, wrong};
use super::table::Table;
use crate::model::{Step, Timing, Transition};
use crate::scalar::Rational;

/// Where a state goes.
#[derive(Clone, Debug)]
pub(super) struct Target {
    /// A
    pub(super) map: Table,
    /// b
    pub(super) input: Table,
    /// Q
    pub(super) noise: Table,
    /// S
    pub(super) cross: Table,
}

/// What is read, and the targets of a step.
#[derive(Clone, Debug)]
pub(super) struct Unified {
    /// H
    pub(super) observation: Table,
    /// R
    pub(super) noise: Table,
    /// y − c
    pub(super) seen: Table,
    pub(super) predicted: Option<Target>,
    pub(super) filtered: Target,
    pub(super) ahead: Option<Target>,
}

impl Target {
    /// The state stays.
    fn still(n: usize, m: usize) -> Self {
        Self { map: Table::identity(n), input: Table::zero(n, 1), noise: Table::zero(n, n), cross: Table::zero(n, m) }
    }

    fn of(transition: &Transition<Rational>, observed: &[usize], n: usize) -> Self {
        let Transition { matrix, input, noise, cross_noise } = transition;
        Self {
            map: Table::of(n, n, |i, j| &matrix[(i, j)]),
            input: Table::of(n, 1, |i, j| &input[(i, j)]),
            noise: Table::of(n, n, |i, j| &noise[(i, j)]),
            cross: Table::of(n, observed.len(), |i, j| &cross_noise[(i, observed[j])]),
        }
    }

    fn magnitude(&self) -> u64 {
        let Self { map, input, noise, cross } = self;
        [map, input, noise, cross].map(Table::magnitude).into_iter().max().unwrap_or(0)
    }
}

impl Unified {
    /// A step with all entries that are observed; `arrives` if its transition leads to the state that is read and is still to
    /// be made.
    pub(super) fn of(step: &Step<Rational>, timing: Timing, arrives: bool) -> Result<Self, Rejection> {
        let observed = step.reading.present();
        let (n, m) = (step.observation.columns(), observed.len());
        let c = Table::of(m, n, |i, j| &step.observation[(observed[i], j)]);
        let r = Table::of(m, m, |i, j| &step.observation_noise[(observed[i], observed[j])]);
        let values = step.reading.values();
        let seen = Table::of(m, 1, |i, _| &values[(i, 0)])
            .minus(&Table::of(m, 1, |i, _| &step.observation_input[(observed[i], 0)]));
        let still = Target::still(n, m);
        let of = |transition| Target::of(transition, &observed, n);
        match (&step.transition, timing) {
            (Some(transition), Timing::Arriving) if arrives => {
                let Target { map, input, noise, cross } = of(transition);
                let mixed = c.times(&cross);
                let filtered = Target { cross: noise.times(&c.transposed()).plus(&cross), map, input, noise };
                Ok(Self {
                    observation: c.times(&filtered.map),
                    noise: r.plus(&c.around(&filtered.noise)).plus(&mixed).plus(&mixed.transposed()),
                    seen: seen.minus(&c.times(&filtered.input)),
                    predicted: Some(Target { cross: Table::zero(n, m), ..filtered.clone() }),
                    filtered,
                    ahead: None,
                })
            }
            (Some(_), Timing::Arriving) => {
                Err(wrong(Condition::Case, "a transition arrives before the state with which the case begins"))
            }
            (transition, _) => Ok(Self {
                observation: c,
                noise: r,
                seen,
                predicted: None,
                filtered: still,
                ahead: transition.as_ref().map(of),
            }),
        }
    }

    /// The bits that its numbers have, or are away from one.
    pub(super) fn magnitude(&self) -> u64 {
        let Self { observation, noise, seen, predicted, filtered, ahead } = self;
        let tables = [observation, noise, seen].map(Table::magnitude).into_iter();
        let targets = predicted.iter().chain([filtered]).chain(ahead).map(Target::magnitude);
        tables.chain(targets).max().unwrap_or(0)
    }

    /// The step with some entries of the reading alone, from which the others follow: with their noise, what it shares with
    /// the state's, and what was read.
    pub(super) fn select(&self, places: &[usize]) -> Result<Self, Rejection> {
        let shared = [Some(&self.filtered), self.ahead.as_ref()];
        let shared = shared.into_iter().flatten().map(|target| target.cross.transposed());
        let blocks: Vec<Table> =
            [&self.observation, &self.noise, &self.seen].into_iter().cloned().chain(shared).collect();
        // Each block over its own denominator: columns may have any unit.
        let row =
            |i: usize| blocks.iter().flat_map(|block| (0..block.columns).map(|j| block.at(i, j).clone())).collect();
        let rows = |places: &mut dyn Iterator<Item = usize>| places.map(row).collect::<Vec<_>>();
        let ranks = [rank(rows(&mut (0..self.observation.rows))), rank(rows(&mut places.iter().copied()))];
        match ranks {
            [Some(all), Some(kept)] if all == kept => {}
            [Some(_), Some(_)] => {
                return Err(wrong(Condition::Kept, "they say something that the others do not, or contradict them"));
            }
            _ => {
                return Err(wrong(
                    Condition::Size,
                    "to decide whether they follow from the others would take too long",
                ));
            }
        }
        let target = |target: &Target| Target { cross: target.cross.select_columns(places), ..target.clone() };
        Ok(Self {
            observation: self.observation.select_rows(places),
            noise: self.noise.select_rows(places).select_columns(places),
            seen: self.seen.select_rows(places),
            predicted: self.predicted.as_ref().map(target),
            filtered: target(&self.filtered),
            ahead: self.ahead.as_ref().map(target),
        })
    }
}
