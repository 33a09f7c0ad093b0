"""Reads cases of exact-kalman and writes answers: what the subjects in this folder share.

A subject calls `serve(answer, name, unsupported)`, which declares its name and the flags of cases that are not for it;
`answer(case)` gets a `Case`, appends one dictionary per observation to
`case.steps` and raises `Unsupported` where its package has no such thing. Any other exception is an outcome
"error" at the step where it was raised; what was computed before stays in the answer.
"""

import json
import os
import sys
from fractions import Fraction
from functools import cached_property

# Native libraries print to file descriptor 1, some when they are loaded: import this module before them. The
# descriptor becomes stderr, and the answers go to a copy of their own.
ANSWERS = os.fdopen(os.dup(1), "w", encoding="utf-8")
os.dup2(2, 1)

import numpy as np


class Unsupported(Exception):
    """The package cannot express this case."""


def number(text):
    """The nearest double of a decimal or hexadecimal string; NaN and Infinity too."""
    text = str(text)
    return float.fromhex(text) if "0x" in text.lower() else float(text)


def array(rows):
    return None if rows is None else np.array([[number(entry) for entry in row] for row in rows], dtype=float)


def product(left, right):
    """The product of two matrices of doubles, each entry rounded once."""
    left, right = ([[Fraction(entry) for entry in row] for row in matrix.tolist()] for matrix in (left, right.T))
    return np.array([[float(sum(a * b for a, b in zip(row, column))) for column in right] for row in left])


class Case:
    """One case, its numbers read, every coefficient as a function of the index k."""

    def __init__(self, case):
        if case.get("numbers") != "binary64":
            raise Unsupported("numbers other than binary64")
        self.case, self.steps = case, []
        self.stepwise = True  # a package that filters all at once cannot say where it failed
        self.count = len(case["observations"])
        self.arriving = case["timing"] == "arriving"
        initial = case["initial"]
        self.before_transition = initial["before"] == "transition"
        self.mean = np.array([number(entry) for entry in initial["mean"]])
        self.covariance = array(initial["covariance"])
        self.diffuse = array(initial.get("diffuse"))
        if self.diffuse is not None and not self.diffuse.any():
            self.diffuse = None
        self.states, self.sensors = len(self.mean), len(self.matrix(case["observation"], 0))

    @staticmethod
    def varies(value, depth):
        """Whether a coefficient is a list of one value per observation; a matrix is 2 deep, a vector 1."""
        first = next((entry for entry in value if entry is not None), None)
        for _ in range(depth - 1 if first is not None else 0):
            first = first[0] if first else ""  # a matrix without columns is a matrix
        return first is None or isinstance(first, list)

    def matrix(self, value, k):
        return array(value[k] if self.varies(value, 2) else value)

    def transition(self, k):
        return self.matrix(self.case["transition"], k)

    def observation(self, k):
        return self.matrix(self.case["observation"], k)

    def noise(self, k):
        """Q, the cross covariance and R; Q and the cross covariance are None where the case has none."""
        noise = self.case["noise"]
        if "process_factor" in noise:
            d, f = (self.matrix(noise[name], k) for name in ("process_factor", "observation_factor"))
            return None if d is None else product(d, d.T), None if d is None else product(d, f.T), product(f, f.T)
        cross = noise.get("cross")
        return (self.matrix(noise["process"], k), None if cross is None else self.matrix(cross, k),
                self.matrix(noise["observation"], k))

    @cached_property
    def shares_noise(self):
        """Whether some transition shares noise with its observation."""
        crosses = (self.noise(k)[1] for k in range(self.count))
        return any(cross is not None and cross.any() for cross in crosses)

    def vector(self, name, k, rows):
        """B u or G v, of so many rows."""
        given = self.case.get(name)
        if given is None:
            return np.zeros(rows)
        vector = given["vector"][k] if self.varies(given["vector"], 1) else given["vector"]
        if vector is None:
            return np.zeros(rows)
        column = np.array([[number(entry)] for entry in vector])
        matrix = given.get("matrix")
        return (column if matrix is None else product(self.matrix(matrix, k), column))[:, 0]

    def input(self, k):
        return self.vector("input", k, self.states)

    def offset(self, k):
        return self.vector("observation_input", k, self.sensors)

    def has_transition(self, k):
        """Whether transition k is needed by some observation."""
        return k < self.count - 1 if not self.arriving else k > 0 or self.before_transition

    def is_constant(self):
        """Whether no coefficient is a list of one value per observation."""
        matrices = [self.case["transition"], self.case["observation"], *self.case["noise"].values()]
        inputs = [self.case[name] for name in ("input", "observation_input") if self.case.get(name)]
        matrices += [given["matrix"] for given in inputs if given.get("matrix") is not None]
        return not (any(self.varies(given["vector"], 1) for given in inputs)
                    or any(self.varies(matrix, 2) for matrix in matrices if matrix is not None))

    def reading(self, k):
        """One entry per sensor: a double, or None if it is missing."""
        reading = self.case["observations"][k]
        entries = [None] * self.sensors if reading is None else reading
        return [None if entry is None else number(entry) for entry in entries]


def strings(values):
    """The shortest decimals of an array, nested as it is; Infinity and NaN by their names."""
    if isinstance(values, np.ndarray):
        return [strings(entry) for entry in values]
    return {"inf": "Infinity", "-inf": "-Infinity", "nan": "NaN"}.get(repr(float(values)), repr(float(values)))


def answered(line, answer):
    given, case = {}, None
    try:
        given = json.loads(line)
        case = Case(given)
        answer(case)
        outcome = {"outcome": "answered"}
    except Unsupported as reason:
        return {"id": given.get("id"), "outcome": "unsupported", "message": str(reason)}
    except Exception as error:  # whatever the package throws is what it says of this case
        outcome = {"outcome": "error", "message": f"{type(error).__name__}: {error}"}
        if case is not None and case.stepwise:
            outcome["step"] = len(case.steps)
    steps = [] if case is None else case.steps
    steps = [{name: strings(values) for name, values in step.items()} for step in steps]
    return {"id": given.get("id"), **outcome, "steps": steps}


def serve(answer, name, unsupported=()):
    """Says what the subject is, then answers every line of stdin, one line each, until it ends."""
    declaration = {"format": "exact-kalman/subject/1", "name": name, "unsupported": list(unsupported)}
    print(json.dumps(declaration), file=ANSWERS, flush=True)
    for line in sys.stdin:
        if line.strip():
            print(json.dumps(answered(line, answer)), file=ANSWERS, flush=True)
