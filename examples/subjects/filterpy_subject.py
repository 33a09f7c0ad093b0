"""filterpy as a subject of exact-kalman (tried with filterpy 2.0.0 and 1.4.5, numpy 2.4, Python 3.11).

    pip install filterpy && exact-kalman check -- python3 examples/subjects/filterpy_subject.py

`--pinv` puts numpy.linalg.pinv in the place of the inverse, as the documentation of the attribute `inv` offers;
`--square-root` is SquareRootKalmanFilter, which has no noise that is shared and takes its factors by Cholesky.

Conventions mapped:
* departing timing: update(y_k), then predict with F[k], Q[k]; the initial law is that of x_0.
* arriving timing: predict with F[k], Q[k], then update(y_k); the first predict is left out if the initial law is
  that of x_0.
* R[k], H[k] go to update, B u to predict (as u, with B = I); the observation input is subtracted from y_k.
* arriving with cross noise: update_correlated with M[k], which is this timing although its documentation shows w_k
  with z_k of the departing one. Departing with cross noise: unsupported.
* missing: update(None). Partly missing: unsupported. Diffuse: unsupported.
* NaN readings are handed over as they are.
"""

import argparse

from kalman_case import Unsupported, serve  # first: it moves stdout away

import filterpy
import numpy as np
from filterpy.kalman import KalmanFilter, SquareRootKalmanFilter

OPTIONS = argparse.Namespace()


def predict(kalman, case, k):
    given, transition, noise = case.input(k).reshape(-1, 1), case.transition(k), case.noise(k)[0]
    if OPTIONS.square_root:
        kalman.F, kalman.Q, kalman.B = transition, noise, np.eye(case.states)
        kalman.predict(u=given)
    else:
        kalman.predict(u=given, B=np.eye(case.states), F=transition, Q=noise)


def update(kalman, case, k):
    reading = case.reading(k)
    if any(entry is None for entry in reading):
        kalman.update(None)
        return
    value = (np.array(reading) - case.offset(k)).reshape(-1, 1)
    _, cross, noise = case.noise(k)
    if OPTIONS.square_root:
        kalman.H, kalman.R = case.observation(k), noise
        kalman.update(value)
    elif case.shares_noise and case.has_transition(k):
        kalman.M = np.zeros((case.states, case.sensors)) if cross is None else cross
        kalman.update_correlated(value, R=noise, H=case.observation(k))
    else:
        kalman.update(value, R=noise, H=case.observation(k))


def new(case):
    if OPTIONS.square_root:
        return SquareRootKalmanFilter(dim_x=case.states, dim_z=case.sensors)
    kalman = KalmanFilter(dim_x=case.states, dim_z=case.sensors)
    if OPTIONS.pinv:
        kalman.inv = np.linalg.pinv
    return kalman


def answer(case):
    if case.diffuse is not None:
        raise Unsupported("a diffuse start")
    if case.shares_noise and OPTIONS.square_root:
        raise Unsupported("cross noise")
    if case.shares_noise and not case.arriving:
        raise Unsupported("cross noise with departing timing")
    readings = [case.reading(k) for k in range(case.count)]
    if any(None in reading and set(reading) != {None} for reading in readings):
        raise Unsupported("partly missing observations")
    kalman = new(case)
    kalman.x, kalman.P = case.mean.reshape(-1, 1), case.covariance
    for k in range(case.count):
        if case.arriving and case.has_transition(k):
            predict(kalman, case, k)
        step = {"predicted_mean": kalman.x[:, 0].copy(), "predicted_covariance": kalman.P.copy()}
        update(kalman, case, k)
        case.steps.append({"filtered_mean": kalman.x[:, 0].copy(), "filtered_covariance": kalman.P.copy(), **step})
        if not case.arriving and case.has_transition(k):
            predict(kalman, case, k)


if __name__ == "__main__":
    parser = argparse.ArgumentParser()
    form = parser.add_mutually_exclusive_group()
    form.add_argument("--pinv", action="store_true", help="the pseudo-inverse of the innovation covariance")
    form.add_argument("--square-root", action="store_true", help="the class SquareRootKalmanFilter")
    OPTIONS = parser.parse_args()
    chosen = [" " + name for name, value in (("pinv", OPTIONS.pinv), ("square-root", OPTIONS.square_root)) if value]
    serve(answer, f"filterpy {filterpy.__version__}{''.join(chosen)}",
          ["diffuse", "correlated"] if OPTIONS.square_root else ["diffuse"])
