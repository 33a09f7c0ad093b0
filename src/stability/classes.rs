//! Which modes lead to which.

use super::ModeProcess;
use crate::scalar::OrderedField;

impl<S: OrderedField> ModeProcess<S> {
    /// Whether each of the modes leads to each, itself too, in one step or more and without leaving them.
    ///
    /// # Panics
    ///
    /// If there is no such mode.
    pub fn communicate(&self, modes: &[usize]) -> bool {
        self.classes(modes).iter().any(|class| class.len() == modes.len())
    }

    /// The classes into which modes fall that lead to each other without leaving the given ones; those that do not come back to themselves
    /// are in none.
    ///
    /// # Panics
    ///
    /// If there is no such mode.
    pub fn classes(&self, modes: &[usize]) -> Vec<Vec<usize>> {
        classes(modes, |from, to| self.transition()[(from, to)] > S::zero())
    }

    /// Whether modes that communicate come back for ever, with probability one: nothing leads away from them for good.
    ///
    /// # Panics
    ///
    /// If there is no such mode.
    pub fn recurrent(&self, modes: &[usize]) -> bool {
        let all: Vec<usize> = (0..self.modes().len()).collect();
        let home = self.classes(&all).into_iter().find(|class| modes.iter().all(|mode| class.contains(mode)));
        home.is_some_and(|home| home.iter().all(|&mode| self.successors(mode).all(|to| home.contains(&to))))
    }
}

/// The classes of places that lead to each other along edges between the given places.
pub(super) fn classes(places: &[usize], edge: impl Fn(usize, usize) -> bool) -> Vec<Vec<usize>> {
    let led_to = |from: usize| {
        let (mut found, mut pending) = (vec![false; places.len()], vec![from]);
        while let Some(place) = pending.pop() {
            for to in 0..places.len() {
                if edge(places[place], places[to]) && !std::mem::replace(&mut found[to], true) {
                    pending.push(to);
                }
            }
        }
        found
    };
    let found: Vec<Vec<bool>> = (0..places.len()).map(led_to).collect();
    let class = |i: usize| (0..places.len()).filter(|&j| found[i][j] && found[j][i]).map(|j| places[j]).collect();
    let mut classes: Vec<Vec<usize>> =
        (0..places.len()).map(class).filter(|class: &Vec<usize>| !class.is_empty()).collect();
    classes.sort();
    classes.dedup();
    classes
}
