//! Stochastic observability, decided.

use super::subspace::Subspace;
use super::{ModeProcess, UnobservableLoop, UnobservablePath, Window};
use crate::scalar::OrderedField;

/// Whether A1 holds with a given h.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Observability<S> {
    /// The window.
    pub window: Window,
    /// h.
    pub length: usize,
    /// For each mode at which a window that fails can begin, a path and a direction that it does not see. A1 holds with this h
    /// if there is none.
    pub failures: Vec<UnobservablePath<S>>,
}

impl<S> Observability<S> {
    /// Whether A1 holds with this h.
    pub fn holds(&self) -> bool {
        self.failures.is_empty()
    }
}

/// What can be said of the windows that begin at one mode.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Start<S> {
    /// From this length on all windows see everything; if it is more than 1, a path one shorter that does not.
    Observable {
        /// The smallest h.
        length: usize,
        /// A path of h − 1 steps that fails.
        shorter: Option<UnobservablePath<S>>,
    },
    /// No h will do: modes can follow each other for ever and not see a direction.
    Never(UnobservableLoop<S>),
}

/// The smallest h with which A1 holds.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct SmallestWindow<S> {
    /// The window.
    pub window: Window,
    /// For each mode that occurs with positive probability, in ascending order, what can be said of windows that begin there.
    pub starts: Vec<(usize, Start<S>)>,
}

impl<S> SmallestWindow<S> {
    /// The smallest h for all modes; nothing if A1 holds with no h.
    pub fn length(&self) -> Option<usize> {
        let lengths = self.starts.iter().map(|(_, start)| match start {
            Start::Observable { length, .. } => Some(*length),
            Start::Never(_) => None,
        });
        lengths.collect::<Option<Vec<_>>>()?.into_iter().max()
    }
}

/// The search was given up.
#[derive(Clone, Copy, Debug, PartialEq, Eq, thiserror::Error)]
#[error("undecided after {limit} subspaces, with all windows up to {length} steps searched")]
pub struct TooManySubspaces {
    /// How many were allowed.
    pub limit: usize,
    /// The longest window that was searched to the end.
    pub length: usize,
}

/// A largest subspace that some path of n modes does not see, and what follows its first mode: a mode and the place of the
/// subspace there, one level below.
type Member<S> = (Subspace<S>, Option<(usize, usize)>);

/// For each mode the largest subspaces that paths of n modes from there do not see.
type Level<S> = Vec<Vec<Member<S>>>;

/// The levels from n = 0 on.
struct Search<'p, S> {
    process: &'p ModeProcess<S>,
    reachable: Vec<usize>,
    levels: Vec<Level<S>>,
    formed: usize,
    limit: usize,
}

impl<S: OrderedField> ModeProcess<S> {
    /// Whether A1 holds with windows of h steps.
    ///
    /// WG-A1: `for every ε > 0 there is δ > 0 with Pr{λ_min(G(k+h,k)) > δ | 𝒢(k−1)} > 1 − ε for all k`
    ///
    /// With finitely many modes: along no path of positive probability is G singular. Paths are not enumerated. What the
    /// path i, j, … does not see is `{v : H(i)v = 0, F(i)v ∈ V}`, V being what j, … does not see; so it is enough to keep, for
    /// each mode, the different subspaces V, and of these those that lie in no other. `most` is the number of subspaces that
    /// may be formed.
    ///
    /// # Errors
    ///
    /// [`TooManySubspaces`] if it is reached.
    ///
    /// # Examples
    ///
    /// ```
    /// use exact_kalman::{matrix::Matrix, scalar::{ratio, Rational}, stability::{Mode, ModeProcess, Window}};
    ///
    /// let q = Matrix::<Rational>::from_integers;
    /// let read = |h| Mode::new(q(&[[1, 1], [0, 1]]), q(&[h]), Matrix::identity(2), Matrix::identity(1));
    /// // Place and speed: two places tell the speed, two speeds do not tell the place.
    /// let sensors = ModeProcess::independent(vec![read([1, 0])?, read([0, 1])?], vec![ratio(1, 2), ratio(1, 2)])?;
    /// let verdict = sensors.observability(Window::Shifted, 2, 1000)?;
    /// assert!(!verdict.holds());
    /// assert_eq!(verdict.failures[0].modes, [1, 1]);
    /// assert_eq!(verdict.failures[0].vector, q(&[[1, 0]]).transpose());
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    pub fn observability(
        &self,
        window: Window,
        length: usize,
        most: usize,
    ) -> Result<Observability<S>, TooManySubspaces> {
        let mut search = Search::new(self, most);
        while search.length() < length {
            search.extend()?;
        }
        let starts = search.reachable.iter();
        let failures = starts.filter_map(|&mode| search.unseen_from(window, mode, length)).collect();
        Ok(Observability { window, length, failures })
    }

    /// The smallest h with which A1 holds, for windows that begin at each mode and so for all; or the proof that there is
    /// none.
    ///
    /// What paths of n modes do not see is, for each mode, a union of subspaces, and shrinks with n. Such a sequence comes to
    /// an end (unions of subspaces are algebraic sets), and once no union changes, none ever will. So there always is an
    /// answer; `most` bounds the number of subspaces that may be formed on the way.
    ///
    /// # Errors
    ///
    /// [`TooManySubspaces`] if it is reached.
    pub fn smallest_window(&self, window: Window, most: usize) -> Result<SmallestWindow<S>, TooManySubspaces> {
        let mut search = Search::new(self, most);
        search.extend()?;
        while !search.is_settled() {
            search.extend()?;
        }
        let starts = search.reachable.iter().map(|&mode| (mode, search.verdict(window, mode))).collect();
        Ok(SmallestWindow { window, starts })
    }
}

impl<'p, S: OrderedField> Search<'p, S> {
    fn new(process: &'p ModeProcess<S>, limit: usize) -> Self {
        let nothing_seen = vec![(Subspace::whole(process.states()), None)];
        let levels = vec![vec![nothing_seen; process.modes().len()]];
        Self { process, reachable: process.reachable(), levels, formed: 0, limit }
    }

    /// The longest window so far.
    fn length(&self) -> usize {
        self.levels.len() - 1
    }

    fn last(&self) -> &Level<S> {
        &self.levels[self.length()]
    }

    fn extend(&mut self) -> Result<(), TooManySubspaces> {
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

    /// What is not seen from a mode on, if it is followed by a path of `length` modes.
    fn before(
        &self,
        mode: usize,
        step: impl Fn(&Subspace<S>, &super::Mode<S>) -> Subspace<S>,
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
    fn is_settled(&self) -> bool {
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

    fn unseen_from(&self, window: Window, mode: usize, length: usize) -> Option<UnobservablePath<S>> {
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
        let fails = |length| self.unseen_from(window, mode, length);
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
