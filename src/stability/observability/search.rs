//! The directions that paths of n modes do not see, for n = 0, 1, 2, …

use super::subspace::Subspace;
use crate::scalar::OrderedField;
use crate::stability::{Mode, ModeProcess, Start, TooManySubspaces, UnobservableLoop, UnobservablePath, Window};

/// A largest subspace that some path of n modes does not see, and what follows its first mode: a mode and the place of the
/// subspace there, one level below.
type Member<S> = (Subspace<S>, Option<(usize, usize)>);

/// For each mode the largest subspaces that paths of n modes from there do not see.
type Level<S> = Vec<Vec<Member<S>>>;

/// The levels from n = 0 on.
pub(super) struct Search<'p, S> {
    process: &'p ModeProcess<S>,
    reachable: Vec<usize>,
    levels: Vec<Level<S>>,
    formed: usize,
    limit: usize,
}

impl<'p, S: OrderedField> Search<'p, S> {
    pub(super) fn new(process: &'p ModeProcess<S>, limit: usize) -> Self {
        let nothing_seen = vec![(Subspace::whole(process.states()), None)];
        let levels = vec![vec![nothing_seen; process.modes().len()]];
        Self { process, reachable: process.reachable(), levels, formed: 0, limit }
    }

    /// The longest window so far.
    pub(super) fn length(&self) -> usize {
        self.levels.len() - 1
    }

    fn last(&self) -> &Level<S> {
        &self.levels[self.length()]
    }

    pub(super) fn extend(&mut self) -> Result<(), TooManySubspaces> {
        let mut level = vec![Vec::new(); self.process.modes().len()];
        for mode in self.reachable.clone() {
            let after: usize = self.process.successors(mode).map(|next| self.last()[next].len()).sum();
            self.formed += after;
            if self.formed > self.limit {
                return Err(TooManySubspaces { limit: self.limit, length: self.length() });
            }
            level[mode] = self.before(mode, Subspace::before, self.length());
        }
        self.levels.push(level);
        Ok(())
    }

    /// For each mode where a window of this length fails, how.
    pub(super) fn failures(&self, window: Window, length: usize) -> Vec<UnobservablePath<S>> {
        self.reachable.iter().filter_map(|&mode| self.failure(window, mode, length)).collect()
    }

    /// For each mode its smallest window; asked once the search is settled.
    pub(super) fn verdicts(&self, window: Window) -> Vec<(usize, Start<S>)> {
        self.reachable.iter().map(|&mode| (mode, self.verdict(window, mode))).collect()
    }

    /// What is not seen from a mode on, if it is followed by a path of `length` modes.
    fn before(
        &self,
        mode: usize,
        step: impl Fn(&Subspace<S>, &Mode<S>) -> Subspace<S>,
        length: usize,
    ) -> Vec<Member<S>> {
        let members = self.process.successors(mode).flat_map(|next| {
            let family = self.levels[length][next].iter().enumerate();
            family.map(move |(place, (space, _))| (space, (next, place)))
        });
        let own = &self.process.modes()[mode];
        Subspace::largest(members.map(|(space, link)| (step(space, own), Some(link))).collect())
    }

    /// Whether the last two levels hold the same subspaces.
    pub(super) fn is_settled(&self) -> bool {
        let [.., before, last] = self.levels.as_slice() else { return false };
        let same = |one: &[Member<S>], other: &[Member<S>]| {
            one.len() == other.len() && one.iter().zip(other).all(|(one, other)| one.0 == other.0)
        };
        self.reachable.iter().all(|&mode| same(&before[mode], &last[mode]))
    }

    /// The subspaces that windows of this length do not see.
    fn unseen(&self, window: Window, mode: usize, length: usize) -> Vec<Member<S>> {
        match window {
            Window::Shifted => self.levels[length][mode].clone(),
            Window::Printed => self.before(mode, Subspace::before_transition, length),
        }
    }

    fn failure(&self, window: Window, mode: usize, length: usize) -> Option<UnobservablePath<S>> {
        let unseen = self.unseen(window, mode, length);
        let (space, link) = unseen.first().filter(|(space, _)| !space.is_zero())?;
        let mut modes = vec![mode];
        let mut link = *link;
        let mut level = length - usize::from(window == Window::Shifted && length > 0);
        while let Some((next, place)) = link {
            modes.push(next);
            link = self.levels[level][next][place].1;
            level = level.saturating_sub(1);
        }
        // The last level has seen nothing yet.
        modes.pop();
        Some(UnobservablePath { window, modes, vector: space.basis().select_columns(&[0]) })
    }

    fn verdict(&self, window: Window, mode: usize) -> Start<S> {
        let fails = |length| self.failure(window, mode, length);
        match (1..=self.length()).find(|&length| fails(length).is_none()) {
            Some(length) => Start::Observable { length, shorter: if length > 1 { fails(length - 1) } else { None } },
            None => Start::Never(self.unobservable_loop(window, mode)),
        }
    }

    /// Follows the links of the last level within itself: both levels hold the same subspaces at the same places.
    fn unobservable_loop(&self, window: Window, mode: usize) -> UnobservableLoop<S> {
        let level = self.last();
        let mut modes = Vec::new();
        let mut subspaces = Vec::new();
        let mut link = (mode, 0);
        if window == Window::Printed {
            let unseen = self.unseen(window, mode, self.length());
            modes.push(mode);
            subspaces.push(unseen[0].0.basis());
            link = unseen[0].1.unwrap_or(link);
        }
        let mut visited = vec![None; modes.len()];
        loop {
            if let Some(back_to) = visited.iter().position(|known| *known == Some(link)) {
                return UnobservableLoop { window, modes, back_to, subspaces };
            }
            let (space, next) = &level[link.0][link.1];
            visited.push(Some(link));
            modes.push(link.0);
            subspaces.push(space.basis());
            link = next.unwrap_or(link);
        }
    }
}
