"""A textbook Kalman filter with numpy as a subject: exact-kalman check -- python3 textbook_numpy.py"""

import json
import sys

import numpy as np


def number(text):
    return float.fromhex(text) if "x" in text.lower() else float(text)


def depth(value):
    return 1 + max(map(depth, value), default=0) if isinstance(value, list) else 0


def along(value, deep):
    """The function k -> array of a constant, or of a list with one value per observation."""
    array = lambda rows: np.vectorize(number, otypes=[float])(rows)
    per_step = None in value or depth(value) > deep
    return lambda k: array(value[k] if per_step else value)


def law(noise, n, m):
    """The functions k -> Q, k -> cov(process noise, observation noise), k -> R."""
    if "process_factor" in noise:
        d, f = along(noise["process_factor"], 2), along(noise["observation_factor"], 2)
        return lambda k: d(k) @ d(k).T, lambda k: d(k) @ f(k).T, lambda k: f(k) @ f(k).T
    cross = along(noise["cross"], 2) if "cross" in noise else lambda k: np.zeros((n, m))
    return along(noise["process"], 2), cross, along(noise["observation"], 2)


def added(term, size):
    """The function k -> B u."""
    if term is None:
        return lambda k: np.zeros(size)
    vector = along(term["vector"], 1)
    matrix = along(term["matrix"], 2) if "matrix" in term else lambda k: np.eye(size)
    return lambda k: matrix(k) @ vector(k)


def steps(case):
    initial, readings, arriving = case["initial"], case["observations"], case["timing"] == "arriving"
    a, c = along(case["transition"], 2), along(case["observation"], 2)
    x, p = along(initial["mean"], 1)(0), along(initial["covariance"], 2)(0)
    n, m = len(x), len(c(0))
    q, s, r = law(case["noise"], n, m)
    u, v = added(case.get("input"), n), added(case.get("observation_input"), m)
    for k, reading in enumerate(readings):
        leads_here = arriving and (k > 0 or initial["before"] == "transition")
        if leads_here:
            x, p = a(k) @ x + u(k), a(k) @ p @ a(k).T + q(k)
        step = {"predicted_mean": x, "predicted_covariance": p}
        seen = [i for i, y in enumerate(reading or []) if y is not None]
        h, noise = c(k)[seen], r(k)[np.ix_(seen, seen)]
        shared = s(k)[:, seen] if leads_here else np.zeros((n, len(seen)))  # cov(x_k, noise of y_k)
        cov = p @ h.T + shared
        var = h @ cov + noise + (h @ shared).T
        e = np.array([number(reading[i]) for i in seen]) - h @ x - v(k)[seen]
        gain = np.linalg.solve(var, cov.T).T
        x, p = x + gain @ e, p - gain @ cov.T
        p = (p + p.T) / 2
        yield step | {"filtered_mean": x, "filtered_covariance": p}
        if not arriving and k + 1 < len(readings):
            x, p = a(k) @ x + u(k), a(k) @ p @ a(k).T + q(k)
            if seen:  # what y_k tells about the noise of the transition that follows
                s_seen = s(k)[:, seen]
                weight = np.linalg.solve(var, s_seen.T).T
                mixed = a(k) @ gain @ s_seen.T
                x, p = x + weight @ e, p - mixed - mixed.T - weight @ s_seen.T
        p = (p + p.T) / 2


def text(value):
    return [text(entry) for entry in value] if isinstance(value, np.ndarray) else repr(float(value))


def answer(case):
    if case["numbers"] != "binary64":
        return {"id": case["id"], "outcome": "unsupported", "message": "doubles only"}
    done = []
    try:
        for step in steps(case):
            done.append({name: text(value) for name, value in step.items()})
    except Exception as reason:  # a singular matrix, say
        return {"id": case["id"], "outcome": "error", "step": len(done), "message": repr(reason), "steps": done}
    return {"id": case["id"], "outcome": "answered", "steps": done}


name = f"textbook, numpy {np.__version__}"
print(json.dumps({"format": "exact-kalman/subject/1", "name": name, "unsupported": ["diffuse"]}), flush=True)
for line in sys.stdin:
    print(json.dumps(answer(json.loads(line))), flush=True)
