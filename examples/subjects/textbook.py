"""A textbook Kalman filter as a subject: python3 textbook.py, standard library only, doubles throughout.

    exact-kalman check -- python3 textbook.py

It says "unsupported" to diffuse starts, and "error" with the step where a singular innovation stops it.
"""

import json
import sys


class Unsupported(Exception):
    pass


def number(text):
    if text is None:
        return None
    if "x" in text or "X" in text:
        return float.fromhex(text)
    if "/" in text:
        numerator, denominator = text.split("/")
        return int(numerator) / int(denominator)
    return float(text)


def numbers(lists):
    return [numbers(item) for item in lists] if isinstance(lists, list) else number(lists)


def depth(lists):
    return 1 + max((depth(item) for item in lists), default=0) if isinstance(lists, list) else 0


def along(lists, constant_depth):
    """The function k -> value of a constant, or of a list with one value per observation."""
    per_step = None in lists or depth(lists) > constant_depth
    values = numbers(lists)
    return (lambda k: values[k]) if per_step else (lambda k: values)


def transpose(a):
    return [list(column) for column in zip(*a)]


def times(a, b):
    return [[sum(x * y for x, y in zip(row, column)) for column in transpose(b)] for row in a]


def plus(a, b, sign=1):
    return [[x + sign * y for x, y in zip(row, other)] for row, other in zip(a, b)]


def symmetric(a):
    return [[(x + y) / 2 for x, y in zip(row, column)] for row, column in zip(a, transpose(a))]


def solve(a, b):
    """The solution X of A X = B, by Gaussian elimination with row exchanges."""
    n, rows = len(a), [left + right for left, right in zip(a, b)]
    for k in range(n):
        pivot = max(range(k, n), key=lambda i: abs(rows[i][k]))
        if rows[pivot][k] == 0:
            raise ZeroDivisionError("the innovation covariance is singular")
        rows[k], rows[pivot] = rows[pivot], rows[k]
        for i in range(n):
            if i != k:
                factor = rows[i][k] / rows[k][k]
                rows[i] = [x - factor * y for x, y in zip(rows[i], rows[k])]
    return [[x / rows[k][k] for x in rows[k][n:]] for k in range(n)]


def input_at(case, name, size):
    term = case.get(name)
    if term is None:
        return lambda k: [[0.0]] * size
    vector, matrix = along(term["vector"], 1), term.get("matrix")
    if matrix is None:
        return lambda k: [[u] for u in vector(k)]
    matrix = along(matrix, 2)
    return lambda k: times(matrix(k), [[u] for u in vector(k)])


def noise_at(noise, n, m):
    """The functions k -> Q, k -> cov(process, observation), k -> R."""
    if "process_factor" in noise:
        d, f = along(noise["process_factor"], 2), along(noise["observation_factor"], 2)
        gram = lambda a, b: lambda k: times(a(k), transpose(b(k)))
        return gram(d, d), gram(d, f), gram(f, f)
    cross = noise.get("cross")
    none = lambda k: [[0.0] * m] * n
    return along(noise["process"], 2), along(cross, 2) if cross else none, along(noise["observation"], 2)


def steps(case):
    """One step after the other, so that what was computed before an error is not lost."""
    initial, readings, arriving = case["initial"], case["observations"], case["timing"] == "arriving"
    if "diffuse" in initial:
        raise Unsupported("diffuse initial belief")
    a, c = along(case["transition"], 2), along(case["observation"], 2)
    n, m = len(initial["mean"]), len(c(0))
    q, s, r = noise_at(case["noise"], n, m)
    u, v = input_at(case, "input", n), input_at(case, "observation_input", m)
    x, p = [[value] for value in numbers(initial["mean"])], numbers(initial["covariance"])
    for k, reading in enumerate(readings):
        reading = [None] * m if reading is None else numbers(reading)
        seen = [i for i, y in enumerate(reading) if y is not None]
        pick = lambda rows: [rows[i] for i in seen]
        shared = [[0.0] * len(seen)] * n  # the covariance of x_k with the noise of y_k
        if arriving and (k > 0 or initial["before"] == "transition"):
            x, p = plus(times(a(k), x), u(k)), symmetric(plus(times(times(a(k), p), transpose(a(k))), q(k)))
            shared = [pick(row) for row in s(k)]
        step = {"predicted_mean": [row[0] for row in x], "predicted_covariance": p}
        x_now, p_now, e, big_s = x, p, [], []
        if seen:
            h, noise = pick(c(k)), [pick(row) for row in pick(r(k))]
            e = plus([[reading[i]] for i in seen], plus(times(h, x), pick(v(k))), -1)
            h_shared = times(h, shared)
            cov_xy = plus(times(p, transpose(h)), shared)
            big_s = plus(plus(times(times(h, p), transpose(h)), noise), plus(h_shared, transpose(h_shared)))
            gain = transpose(solve(big_s, transpose(cov_xy)))
            x_now, p_now = plus(x, times(gain, e)), symmetric(plus(p, times(gain, transpose(cov_xy)), -1))
        yield step | {"filtered_mean": [row[0] for row in x_now], "filtered_covariance": p_now}
        if arriving:
            x, p = x_now, p_now
        elif k + 1 < len(readings):
            x = plus(times(a(k), x_now), u(k))
            p = plus(times(times(a(k), p_now), transpose(a(k))), q(k))
            if seen:  # the noise of the transition, seen through the noise of y_k
                s_seen = [pick(row) for row in s(k)]
                weight = transpose(solve(big_s, transpose(s_seen)))
                mixed = times(times(a(k), gain), transpose(s_seen))
                x = plus(x, times(weight, e))
                p = plus(p, plus(plus(mixed, transpose(mixed)), times(weight, transpose(s_seen))), -1)
            p = symmetric(p)


def text(value):
    return [text(item) for item in value] if isinstance(value, list) else repr(value)


def answer(case):
    done = []
    try:
        for step in steps(case):
            done.append({name: text(value) for name, value in step.items()})
    except Unsupported as reason:
        return {"id": case["id"], "outcome": "unsupported", "message": str(reason), "steps": []}
    except Exception as reason:
        return {"id": case["id"], "outcome": "error", "step": len(done), "message": repr(reason), "steps": done}
    return {"id": case["id"], "outcome": "answered", "steps": done}


# What a subject may say of itself, once: cases with this flag are not asked.
DECLARATION = {"format": "exact-kalman/subject/1", "name": "textbook, Python", "unsupported": ["diffuse"]}

print(json.dumps(DECLARATION), flush=True)
for line in sys.stdin:
    print(json.dumps(answer(json.loads(line))), flush=True)
