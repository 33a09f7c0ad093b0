//! States that are independent of each other, known from the zeros of the matrices alone.
//!
//! Where a step links no state of one group with a state of another, by a transition, a sensor or a noise, their joint covariance with
//! the reading falls into blocks, and so does what follows from it. Their covariances are exactly zero, which no enclosure of
//! other numbers can say.

use super::Derived;
use crate::matrix::Matrix;
use crate::model::{Step, Timing, Transition};
use crate::scalar::{Interval, Rational, Scalar as _};
use crate::trace::{Quantity, Values};

/// For each state the number of its group: states with different ones are independent.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(super) struct Groups(Vec<usize>);

/// The groups at a step.
pub(super) struct Linked {
    /// Before the reading.
    predicted: Groups,
    /// After it.
    filtered: Groups,
    /// With which the next step begins.
    pub(super) next: Groups,
    /// Those of the entries of the reading, as numbered for the filtered state.
    sensors: Groups,
}

/// Sets that are joined, by representatives.
struct Sets(Vec<usize>);

impl Sets {
    fn find(&mut self, mut node: usize) -> usize {
        while self.0[node] != node {
            self.0[node] = self.0[self.0[node]];
            node = self.0[node];
        }
        node
    }

    fn join(&mut self, one: usize, other: usize) {
        let (one, other) = (self.find(one), self.find(other));
        self.0[one] = other;
    }

    /// Joins a row with a column, each counted from an offset, wherever a matrix is not zero.
    fn link(&mut self, matrix: &Matrix<Rational>, rows: usize, columns: usize) {
        self.link_some(matrix, (0..matrix.rows(), rows), (0..matrix.columns(), columns));
    }

    /// The same for some rows and some columns, which are counted as they come.
    fn link_some(
        &mut self,
        matrix: &Matrix<Rational>,
        (some_rows, rows): (impl Iterator<Item = usize>, usize),
        (some_columns, columns): (impl Iterator<Item = usize> + Clone, usize),
    ) {
        for (i, row) in some_rows.enumerate() {
            for (j, column) in some_columns.clone().enumerate() {
                if matrix[(row, column)] != Rational::zero() {
                    self.join(rows + i, columns + j);
                }
            }
        }
    }

    fn groups(&mut self, from: usize, count: usize) -> Groups {
        Groups((from..from + count).map(|node| self.find(node)).collect())
    }
}

impl Groups {
    /// The groups of a state with this covariance.
    pub(super) fn of(covariance: &Matrix<Rational>) -> Self {
        let mut sets = Sets((0..covariance.rows()).collect());
        sets.link(covariance, 0, 0);
        sets.groups(0, covariance.rows())
    }

    /// The groups at a step that begins with these; `arrives` if its transition leads to the state that is read.
    pub(super) fn linked(&self, step: &Step<Rational>, timing: Timing, arrives: bool) -> Linked {
        let observed = &step.reading.present();
        let seen = || observed.iter().copied();
        let (n, m) = (self.0.len(), observed.len());
        let transition = step.transition.as_ref();
        // The state before, the state that is read, the one after it, the reading.
        let (read, after, sensors) = (n, 2 * n, 3 * n);
        let mut sets = self.sets(3 * n + m);
        match transition.filter(|_| arrives) {
            Some(transition) => {
                sets.link(&transition.matrix, read, 0);
                sets.link(&transition.noise, read, read);
            }
            None => (0..n).for_each(|i| sets.join(read + i, i)),
        }
        let predicted = sets.groups(read, n);
        sets.link_some(&step.observation, (seen(), sensors), (0..n, read));
        sets.link_some(&step.observation_noise, (seen(), sensors), (seen(), sensors));
        if let Some(transition) = transition.filter(|_| timing == Timing::Arriving) {
            sets.link_some(&transition.cross_noise, (0..n, read), (seen(), sensors));
        }
        let (filtered, of_sensors) = (sets.groups(read, n), sets.groups(sensors, m));
        let next = match transition.filter(|_| timing == Timing::Departing) {
            Some(transition) => {
                sets.link(&transition.matrix, after, read);
                sets.link(&transition.noise, after, after);
                sets.link_some(&transition.cross_noise, (0..n, after), (seen(), sensors));
                sets.groups(after, n)
            }
            None => filtered.clone(),
        };
        Linked { predicted, filtered, next, sensors: of_sensors }
    }

    /// The groups after a transition.
    pub(super) fn moved(&self, transition: &Transition<Rational>) -> Self {
        let n = self.0.len();
        let mut sets = self.sets(2 * n);
        sets.link(&transition.matrix, n, 0);
        sets.link(&transition.noise, n, n);
        sets.groups(n, n)
    }

    /// These groups as sets, with room for more nodes.
    fn sets(&self, count: usize) -> Sets {
        let mut sets = Sets((0..count).collect());
        for (i, group) in self.0.iter().enumerate() {
            if let Some(j) = self.0[..i].iter().position(|other| other == group) {
                sets.join(i, j);
            }
        }
        sets
    }

    /// Puts exact zeros between groups.
    pub(super) fn apart(&self, covariance: &mut Matrix<Interval>) {
        self.apart_from(self, covariance);
    }

    fn apart_from(&self, columns: &Self, covariance: &mut Matrix<Interval>) {
        let pairs = (0..self.0.len()).flat_map(|i| (0..columns.0.len()).map(move |j| (i, j)));
        for (i, j) in pairs.filter(|&(i, j)| self.0[i] != columns.0[j]) {
            covariance[(i, j)] = Interval::zero();
        }
    }
}

impl Linked {
    /// Exact zeros in what was enclosed of the step.
    pub(super) fn put_zeros(&self, values: &mut Values<Interval>, derived: &mut Derived) {
        let mut replace = |quantity, rows: &Groups, columns: &Groups| {
            if let Some(matrix) = values.get_mut(&quantity) {
                rows.apart_from(columns, matrix);
            }
        };
        replace(Quantity::PredictedCovariance, &self.predicted, &self.predicted);
        replace(Quantity::FilteredCovariance, &self.filtered, &self.filtered);
        replace(Quantity::InnovationCovariance, &self.sensors, &self.sensors);
        replace(Quantity::Gain, &self.filtered, &self.sensors);
        for matrix in [&mut derived.gain, &mut derived.cross_covariance].into_iter().flatten() {
            self.filtered.apart_from(&self.sensors, matrix);
        }
    }
}
