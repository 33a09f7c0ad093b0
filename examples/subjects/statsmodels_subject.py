"""statsmodels' state space filter as a subject of exact-kalman (tried with statsmodels 0.15.0, Python 3.11).

    pip install statsmodels && exact-kalman check -- python3 examples/subjects/statsmodels_subject.py

`--tolerance 0` switches off the test for a steady state, which compares squared covariances with an absolute 1e-19.
`--univariate` takes the sensors one after the other (filter_univariate).

Conventions mapped:
* y_t = Z_t a_t + d_t + e_t, a_{t+1} = T_t a_t + c_t + w_t: departing timing as it is, with the initial law that of a_0.
* arriving timing: T_t, c_t, Q_t are those of transition t + 1; an initial law before transition 0 is that of a state
  before the first, with an observation that is missing.
* constant models are handed over as constant, so that the steady state is looked for, as users have it.
* missing entries are NaN; so are NaN readings, which statsmodels therefore cannot tell from missing ones.
* diffuse: the exact diffuse start, for a diagonal of zeros and ones with zero covariance in the diffuse places. The
  mean there is zero in statsmodels; others are unsupported. What is still diffuse is left out of the answer.
* cross noise: unsupported.
"""

import argparse

from kalman_case import Unsupported, serve  # first: it moves stdout away

import numpy as np
import statsmodels
from statsmodels.tsa.statespace.initialization import Initialization
from statsmodels.tsa.statespace.kalman_filter import KalmanFilter


OPTIONS = argparse.Namespace(tolerance=None, univariate=False)


def initialization(case):
    if case.diffuse is None:
        return Initialization(case.states, "known", constant=case.mean, stationary_cov=case.covariance)
    ones = np.diagonal(case.diffuse) == 1
    if not np.array_equal(case.diffuse, np.diag(ones.astype(float))):
        raise Unsupported("a diffuse part that is no diagonal of zeros and ones")
    if case.covariance[ones].any() or case.mean[ones].any():
        raise Unsupported("a mean or a covariance in a diffuse place")
    return Initialization.from_components(case.states, a=case.mean, Pstar=case.covariance, Pinf=case.diffuse)


def stacked(values):
    """Time last, as statsmodels has it."""
    return np.ascontiguousarray(np.stack(values, axis=-1))


def model(case, early):
    """The model, after so many observations that are put before the first."""
    times = range(-early, case.count)
    seen = [max(t, 0) for t in times]
    leaving = [t + 1 if case.arriving else t for t in times]
    # No observation depends on a transition that is not there: any will do, and the identity always exists.
    there = [k < case.count and case.has_transition(k) for k in leaving]
    states = np.eye(case.states)
    series = {
        "design": [case.observation(k) for k in seen],
        "obs_cov": [case.noise(k)[2] for k in seen],
        "obs_intercept": [case.offset(k) for k in seen],
        "transition": [case.transition(k) if has else states for k, has in zip(leaving, there)],
        "state_cov": [case.noise(k)[0] if has else 0 * states for k, has in zip(leaving, there)],
        "state_intercept": [case.input(k) if has else 0 * case.mean for k, has in zip(leaving, there)],
    }
    endog = [[np.nan if entry is None else entry for entry in case.reading(k)] for k in range(case.count)]
    endog = np.vstack([np.full((early, case.sensors), np.nan), np.array(endog)])
    # To the constructor: `filter(tolerance=…)` of 0.15.0 hands it on in the place of filter_timing.
    tolerance = {} if OPTIONS.tolerance is None else {"tolerance": OPTIONS.tolerance}
    kalman = KalmanFilter(k_endog=case.sensors, k_states=case.states, **tolerance)
    if OPTIONS.univariate:
        kalman.filter_univariate = True
    kalman.bind(np.ascontiguousarray(endog))
    kalman["selection"] = states
    constant = case.is_constant() and any(there)
    for name, values in series.items():
        # One of those that are there: at the end of the data an identity stands in.
        kalman[name] = stacked([values[there.index(True)]]) if constant else stacked(values)
    kalman.initialization = initialization(case)
    return kalman


def answer(case):
    if case.shares_noise:
        raise Unsupported("cross noise")
    case.stepwise = False
    early = 1 if case.before_transition else 0
    kalman = model(case, early)
    result = kalman.filter()
    # What statsmodels itself counts as diffuse; its diffuse covariances keep rounding errors of 1e-18.
    diffuse = result.nobs_diffuse
    for t in range(early, early + case.count):
        step = {}
        if t >= diffuse - 1:
            step["filtered_mean"] = result.filtered_state[:, t]
            step["filtered_covariance"] = result.filtered_state_cov[:, :, t]
        if t >= diffuse:
            step["predicted_mean"] = result.predicted_state[:, t]
            step["predicted_covariance"] = result.predicted_state_cov[:, :, t]
        case.steps.append(step)


if __name__ == "__main__":
    parser = argparse.ArgumentParser()
    parser.add_argument("--tolerance", type=float, help="of the test for a steady state; 0 switches it off")
    parser.add_argument("--univariate", action="store_true", help="one sensor after the other")
    OPTIONS = parser.parse_args()
    tolerance = "" if OPTIONS.tolerance is None else f" tolerance={OPTIONS.tolerance:g}"
    univariate = " univariate" if OPTIONS.univariate else ""
    serve(answer, f"statsmodels {statsmodels.__version__}{tolerance}{univariate}", ["correlated"])
