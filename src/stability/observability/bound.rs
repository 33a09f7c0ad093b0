//! A bound of P(k) that holds on every path, whatever P(0).

use crate::matrix::Matrix;
use crate::scalar::OrderedField;
use crate::stability::{Mode, ModeProcess, TooManySubspaces, UnobservablePath, Window};

/// What the last h modes alone allow to say: P(k) ≤ `covariance` for k ≥ h if the modes of k−h, …, k−1 are these, whatever
/// came before.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct WindowBound<S> {
    /// The modes of the window, oldest first.
    pub modes: Vec<usize>,
    /// The covariance of the observer's error, d×d.
    pub covariance: Matrix<S>,
}

/// A bound of P(k) for each window of h modes that has positive probability.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct UniformBound<S> {
    /// h.
    pub length: usize,
    /// One for each path of h modes, in lexicographic order.
    pub windows: Vec<WindowBound<S>>,
}

/// Why there is no bound.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
pub enum BoundError<S> {
    /// A1 fails with this h.
    #[error("the modes {:?} leave a direction unseen", .0.modes)]
    Unobservable(UnobservablePath<S>),
    /// There are more paths of h modes than allowed.
    #[error("more than {limit} paths of {length} modes")]
    TooManyPaths {
        /// h.
        length: usize,
        /// How many were allowed.
        limit: usize,
    },
    /// Whether A1 holds was not decided.
    #[error(transparent)]
    TooManySubspaces(#[from] TooManySubspaces),
}

impl<S: OrderedField> UniformBound<S> {
    /// The window whose bound has the largest trace: `tr P(k) ≤ tr` of it for every k ≥ h, every path, every P(0).
    ///
    /// # Panics
    ///
    /// If there is no window; [`ModeProcess::uniform_bound`] yields one at least.
    pub fn worst(&self) -> &WindowBound<S> {
        // The last of several largest is taken, so they are turned round.
        let worst = self.windows.iter().rev().max_by_key(|window| window.covariance.trace());
        worst.expect("a process has a mode that occurs")
    }

    /// The bound of P(k) after these modes, the last one being that of k−1; nothing if they are fewer than h or have
    /// probability zero.
    pub fn after(&self, modes: &[usize]) -> Option<&Matrix<S>> {
        let last = &modes[modes.len().checked_sub(self.length)?..];
        self.windows.iter().find(|window| window.modes == last).map(|window| &window.covariance)
    }
}

impl<S: OrderedField> ModeProcess<S> {
    /// A bound of P(k), k ≥ h, on every path of positive probability and for every P(0) ≥ 0.
    ///
    /// WG-T1.1: `under A1, A2 and the standing assumption: sup_k E‖P(k)‖^r < ∞`
    ///
    /// With finitely many modes the bound holds path by path. The state h steps ago is estimated by least squares from the
    /// observations since, and carried forward; its error holds nothing of the state, only the noise of the window, and P(k) is
    /// the least covariance of all such estimates. With `T(s) = Φ(k,s+1) − Φ(k,k−h) G⁻¹ Φᵀ(s+1,k−h) G(k,s+1)`, G = G(k,k−h),
    /// it is `∑[s=k−h..k−1] T(s)Q(s)Tᵀ(s) + D(s)R(s)Dᵀ(s), D(s) = Φ(k,k−h) G⁻¹ Φᵀ(s,k−h)Hᵀ(s)`.
    ///
    /// Cost: one window for each path of h modes, at most (number of modes)ʰ, and 3h products each. `most` bounds the
    /// number of paths, and that of subspaces of [`ModeProcess::observability`].
    ///
    /// # Errors
    ///
    /// [`BoundError`]: with the path that fails if A1 does, or because a limit is reached.
    ///
    /// # Examples
    ///
    /// ```
    /// use exact_kalman::{matrix::Matrix, scalar::{ratio, Rational}, stability::{Mode, ModeProcess}};
    ///
    /// let scalar = |value| Matrix::<Rational>::diagonal(&[ratio(value, 1)]);
    /// // A good sensor or a bad one, of variance 1 or 5: f² r + q.
    /// let read = |r| Mode::new(scalar(2), scalar(1), scalar(1), scalar(r));
    /// let sensors = ModeProcess::independent(vec![read(1)?, read(5)?], vec![ratio(1, 2), ratio(1, 2)])?;
    /// let bound = sensors.uniform_bound(1, 1000)?;
    /// assert_eq!((bound.worst().modes.as_slice(), &bound.worst().covariance), ([1].as_slice(), &scalar(21)));
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    pub fn uniform_bound(&self, length: usize, most: usize) -> Result<UniformBound<S>, BoundError<S>> {
        let verdict = self.observability(Window::Shifted, length, most)?;
        if let Some(failure) = verdict.failures.into_iter().next() {
            return Err(BoundError::Unobservable(failure));
        }
        let mut paths: Vec<Vec<usize>> = self.reachable().into_iter().map(|mode| vec![mode]).collect();
        for _ in 1..length {
            let longer = |path: &Vec<usize>| self.followed(path);
            paths = paths.iter().flat_map(longer).take(most.saturating_add(1)).collect();
        }
        if paths.len() > most {
            return Err(BoundError::TooManyPaths { length, limit: most });
        }
        let windows = paths.into_iter().map(|modes| {
            let along: Vec<&Mode<S>> = modes.iter().map(|&mode| &self.modes()[mode]).collect();
            WindowBound { covariance: observer_covariance(&along), modes }
        });
        Ok(UniformBound { length, windows: windows.collect() })
    }

    fn followed(&self, path: &[usize]) -> Vec<Vec<usize>> {
        let next = path.last().map_or_else(Vec::new, |&last| self.successors(last).collect());
        next.into_iter().map(|mode| path.iter().copied().chain([mode]).collect()).collect()
    }
}

/// The covariance of the observer's error after these modes, which see everything.
fn observer_covariance<S: OrderedField>(modes: &[&Mode<S>]) -> Matrix<S> {
    let d = modes[0].states();
    // Φ(s,k−h) for s = k−h, …, k.
    let mut from_start = vec![Matrix::identity(d)];
    for mode in modes {
        from_start.push(mode.transition() * &from_start[from_start.len() - 1]);
    }
    // Φ(k,s+1) and G(k,s+1), newest first.
    let mut to_end = Matrix::identity(d);
    let mut gramian = Matrix::zeros(d, d);
    let mut later = Vec::with_capacity(modes.len());
    for mode in modes.iter().rev() {
        later.push((to_end.clone(), gramian.clone()));
        to_end = to_end * mode.transition();
        gramian =
            mode.transition().transpose().congruence(&gramian) + mode.observation().transpose() * mode.observation();
    }
    let Ok(inverse) = gramian.inverse() else { unreachable!("the window sees everything") };
    let estimate = to_end * inverse;
    let steps = modes.iter().zip(&from_start).zip(&from_start[1..]).zip(later.iter().rev());
    steps.fold(Matrix::zeros(d, d), |sum, (((mode, before), after), (to_end, gramian))| {
        let of_process = to_end - &estimate * after.transpose() * gramian;
        let of_observation = &estimate * before.transpose() * mode.observation().transpose();
        sum + of_process.congruence(mode.process_noise()) + of_observation.congruence(mode.observation_noise())
    })
}
