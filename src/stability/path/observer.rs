//! Least squares on one window of observations where that is safe, mere prediction where it is not.

use crate::matrix::Matrix;
use crate::scalar::OrderedField;
use crate::stability::{Mode, Window, excites, gramian, transition_matrix};

/// The observer x* of the paper: its window, the length h of the window, and the threshold δ of the Gramian.
///
/// Along a path it is an affine map of the readings that knows no noise covariance; its error covariance bounds that of
/// the filter wherever it uses no reading that the filter has not (WG-optimality: [`Window::Shifted`]).
///
/// The entry k of a path is the mode of time k; `x*(k)` is computed for k = 0, …, n along a path of n modes, or to n − 1 for
/// [`Window::Printed`], which needs the observation of the last time.
///
/// # Examples
///
/// A random walk read with noise of variance 1/10, h = 1: with the printed window x*(k) = y(k), whose error is smaller
/// than that of the prediction.
///
/// ```
/// use exact_kalman::{matrix::Matrix, scalar::{ratio, Rational}, stability::{Mode, Observer, Window}};
///
/// let scalar = |value| Matrix::<Rational>::diagonal(&[value]);
/// let one = || scalar(ratio(1, 1));
/// let path = vec![Mode::new(one(), one(), one(), scalar(ratio(1, 10)))?; 3];
/// let printed = Observer::new(Window::Printed, 1, ratio(1, 2))?;
/// assert_eq!(printed.covariances(&path, &one())[1], scalar(ratio(1, 10)));
/// let shifted = Observer::new(Window::Shifted, 1, ratio(1, 2))?;
/// assert_eq!(shifted.covariances(&path, &one())[1], scalar(ratio(11, 10)));
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Observer<S> {
    window: Window,
    length: usize,
    threshold: S,
}

/// Why there is no such observer.
#[derive(Clone, Copy, Debug, PartialEq, Eq, thiserror::Error)]
pub enum ObserverError {
    /// The window is empty.
    #[error("a window holds at least one observation")]
    EmptyWindow,
    /// The threshold is negative, so that a singular Gramian would count as good.
    #[error("the threshold of the Gramian is negative")]
    NegativeThreshold,
}

/// The error of the observer at the end of one window, as a linear map of what it comes from.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct ErrorMap<S> {
    /// The coefficient of x(k) − x*(k), d×d: zero in a good window.
    pub carried: Matrix<S>,
    /// Those of w(k+1), …, w(k+h), d×d.
    pub process: Vec<Matrix<S>>,
    /// Those of v(i), i in the window, d×m.
    pub observation: Vec<Matrix<S>>,
}

impl<S: OrderedField> Observer<S> {
    /// The observer with this window of h = `length` observations and this δ = `threshold`.
    ///
    /// # Errors
    ///
    /// [`ObserverError`] if h = 0 or δ < 0. δ = 0 is allowed: then every window with a regular Gramian is good.
    pub fn new(window: Window, length: usize, threshold: S) -> Result<Self, ObserverError> {
        if length == 0 {
            return Err(ObserverError::EmptyWindow);
        }
        if threshold < S::zero() {
            return Err(ObserverError::NegativeThreshold);
        }
        Ok(Self { window, length, threshold })
    }

    /// The window.
    pub fn window(&self) -> Window {
        self.window
    }

    /// h.
    pub fn length(&self) -> usize {
        self.length
    }

    /// δ.
    pub fn threshold(&self) -> &S {
        &self.threshold
    }

    /// `Φ(k+h,k)G⁻¹(k+h,k)Φᵀ(i,k)Hᵀ(i)` for each i of the window from k = `start`, by which its readings are weighed; nothing
    /// unless λ_min(G(k+h,k)) > δ.
    ///
    /// # Panics
    ///
    /// If the path is empty or ends before the window, or its modes differ in d.
    pub fn weights(&self, path: &[Mode<S>], start: usize) -> Option<Vec<Matrix<S>>> {
        let gramian = gramian(path, self.window, start, self.length);
        excites(&gramian, &self.threshold).ok()?;
        let inverse = gramian.inverse().unwrap_or_else(|error| unreachable!("G > δI ≥ 0: {error}"));
        let front = transition_matrix(path, start..start + self.length) * inverse;
        let weight =
            |time: usize| &front * (path[time].observation() * transition_matrix(path, start..time)).transpose();
        Some(self.window.times(start, self.length).map(weight).collect())
    }

    /// `x*(0), x*(1), …` along a path, from x̂(0) and a reading for each mode.
    ///
    /// WG-10: `x*(k+h) = Φ(k+h,k){G⁻¹(k+h,k) ∑[i=k..k+h−1] Φᵀ(i,k)Hᵀ(i)y(i) 1{A_δ(k)} + x*(k) 1{A_δ(k)ᶜ}}`
    ///
    /// WG-11: `x*(0) = x̂(0)`
    ///
    /// WG-12: `x*(m+1) = F(m)x*(m),  m = 0, …, h−2`
    ///
    /// Shapes: x̂(0) d×c and each reading m×c: c problems at once, or one map of c sources.
    ///
    /// # Panics
    ///
    /// If the path is empty, there is not one reading for each mode, or shapes do not fit.
    pub fn estimates(&self, path: &[Mode<S>], initial: &Matrix<S>, readings: &[Matrix<S>]) -> Vec<Matrix<S>> {
        assert!(path.len() == readings.len(), "{} readings along {} modes", readings.len(), path.len());
        self.recursion(
            path,
            initial.clone(),
            |mode, before| mode.transition() * before,
            |start, before| {
                let Some(weights) = self.weights(path, start) else {
                    return transition_matrix(path, start..start + self.length) * before;
                };
                let terms =
                    weights.iter().zip(&readings[self.window.times(start, self.length)]).map(|(weight, y)| weight * y);
                terms.reduce(|sum, term| sum + term).unwrap_or_else(|| unreachable!("h > 0"))
            },
        )
    }

    /// The error of the observer at time k+h by that at k = `start` and the noises.
    ///
    /// WG-20: `x(k+h) − x*(k+h) = Φ(k+h,k)(x(k) − x*(k)) 1{A_δ(k)ᶜ} + ∑[j=k+1..k+h] Φ(k+h,j)w(j) − Φ(k+h,k)G⁻¹(k+h,k) ∑[i=k..k+h−1] Φᵀ(i,k)Hᵀ(i)ξ(i) 1{A_δ(k)}`
    ///
    /// WG-19: `ξ(i) = H(i) ∑[j=k+1..i] Φ(i,j)w(j) + v(i)`
    ///
    /// # Panics
    ///
    /// As for [`Observer::weights`].
    pub fn error_map(&self, path: &[Mode<S>], start: usize) -> ErrorMap<S> {
        let (d, end) = (path[0].states(), start + self.length);
        let times = self.window.times(start, self.length);
        let mut process: Vec<_> = (start + 1..=end).map(|j| transition_matrix(path, j..end)).collect();
        let Some(weights) = self.weights(path, start) else {
            let observation = times.map(|time| Matrix::zeros(d, path[time].observation().rows())).collect();
            return ErrorMap { carried: transition_matrix(path, start..end), process, observation };
        };
        for (j, coefficient) in (start + 1..=end).zip(&mut process) {
            for (i, weight) in times.clone().zip(&weights).filter(|(i, _)| *i >= j) {
                *coefficient = &*coefficient - weight * path[i].observation() * transition_matrix(path, j..i);
            }
        }
        ErrorMap { carried: Matrix::zeros(d, d), process, observation: weights.iter().map(|weight| -weight).collect() }
    }

    /// The covariances of `x(k) − x*(k)`, k = 0, 1, …, given the path, from that of x(0) − x̂(0), d×d.
    ///
    /// Windows that follow each other share no noise, so the covariance of one time follows from that of h steps before.
    ///
    /// # Panics
    ///
    /// If the path is empty or shapes do not fit.
    pub fn covariances(&self, path: &[Mode<S>], initial: &Matrix<S>) -> Vec<Matrix<S>> {
        let predict = |mode: &Mode<S>, before: &Matrix<S>| mode.transition().congruence(before) + mode.process_noise();
        self.recursion(path, initial.clone(), predict, |start, before| {
            let map = self.error_map(path, start);
            let carried = map.carried.congruence(before);
            // The noise w(j) has the covariance Q(j−1).
            let process = map.process.iter().zip(&path[start..]).map(|(c, mode)| c.congruence(mode.process_noise()));
            let seen = &path[self.window.times(start, self.length)];
            let observation = map.observation.iter().zip(seen).map(|(c, mode)| c.congruence(mode.observation_noise()));
            process.chain(observation).fold(carried, |sum, term| sum + term)
        })
    }

    /// The values of the times 0, 1, …: the first h by steps, the others by windows.
    fn recursion(
        &self,
        path: &[Mode<S>],
        initial: Matrix<S>,
        step: impl Fn(&Mode<S>, &Matrix<S>) -> Matrix<S>,
        window: impl Fn(usize, &Matrix<S>) -> Matrix<S>,
    ) -> Vec<Matrix<S>> {
        let last = path.len() + 1 - self.window.times(1, 0).start;
        let mut values = vec![initial];
        for time in 1..=last {
            values.push(match time.checked_sub(self.length) {
                None => step(&path[time - 1], &values[time - 1]),
                Some(start) => window(start, &values[start]),
            });
        }
        values
    }
}
