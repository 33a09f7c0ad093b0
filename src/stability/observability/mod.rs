//! Stochastic observability, decided.

mod bound;
mod margin;
mod search;
mod subspace;
mod unobservable;

pub use bound::{BoundError, UniformBound, WindowBound};
pub use margin::MarginError;
pub use unobservable::{UnobservableLoop, UnobservablePath};

use crate::scalar::OrderedField;
use crate::stability::{ModeProcess, Window};
use search::Search;

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

impl<S: OrderedField> ModeProcess<S> {
    /// Whether A1 holds with windows of h steps.
    ///
    /// WG-A1: `for every ε > 0 there is δ > 0 with Pr{λ_min(G(k+h,k)) > δ | 𝒢(k−1)} > 1 − ε for all k`
    ///
    /// With finitely many modes: along no path of positive probability is G singular. Paths are not enumerated. What the
    /// path i, j, … does not see is `{v : H(i)v = 0, F(i)v ∈ V}`, V being what j, … does not see; so it is enough to keep, for
    /// each mode, the different subspaces V, and of these those that lie in no other. A subspace costs one elimination of d
    /// columns, and comparisons with the others of its mode; `most` is the number of subspaces that may be formed, at most
    /// (number of steps)·(number of pairs of modes that follow each other)·(most subspaces kept for one mode).
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
        Ok(Observability { window, length, failures: search.failures(window, length) })
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
    ///
    /// # Examples
    ///
    /// A sensor that works every second time needs h = 2; one that may fail at any time sees nothing on the path of all failures:
    ///
    /// ```
    /// use exact_kalman::{matrix::Matrix, scalar::{ratio, Rational}, stability::{Mode, ModeProcess, Start, Window}};
    ///
    /// let scalar = |value| Matrix::<Rational>::diagonal(&[ratio(value, 1)]);
    /// let modes = vec![Mode::new(scalar(2), scalar(0), scalar(1), scalar(1))?, Mode::new(scalar(2), scalar(1), scalar(1), scalar(1))?];
    /// let half = || vec![ratio(1, 2), ratio(1, 2)];
    /// let second = ModeProcess::markov(modes.clone(), half(), Matrix::from_integers(&[[0, 1], [1, 0]]))?;
    /// assert_eq!(second.smallest_window(Window::Shifted, 1000)?.length(), Some(2));
    ///
    /// let verdict = ModeProcess::independent(modes, half())?.smallest_window(Window::Shifted, 1000)?;
    /// let Start::Never(proof) = &verdict.starts[0].1 else { panic!("no h will do") };
    /// assert_eq!((proof.modes.as_slice(), proof.back_to), ([0].as_slice(), 0));
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    pub fn smallest_window(&self, window: Window, most: usize) -> Result<SmallestWindow<S>, TooManySubspaces> {
        let mut search = Search::new(self, most);
        search.extend()?;
        while !search.is_settled() {
            search.extend()?;
        }
        Ok(SmallestWindow { window, starts: search.verdicts(window) })
    }
}
