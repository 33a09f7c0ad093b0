"""The problems of the comparison, as case files of the protocol.

x+ = A x + D w, y = C x+ + F w with n states, m = n/2 sensors, q = n + m noises, dense random matrices, P0 = I and random
readings. `small`: fractions p/q with |p| <= 10, 1 <= q <= 10. `double`: Gaussian doubles, each taken exactly.
"""

import json
import random
from fractions import Fraction

KINDS = ("small", "double")
# Steps by the number of states: a run of fmpq_mat takes from some hundredths of a second to some seconds.
STEPS = {2: 100, 4: 50, 8: 20, 16: 10}
LONG_STEPS = {2: 400, 4: 200, 8: 60, 16: 24}


def cell_name(cell):
    kind, n, steps = cell
    return f"{kind}:{n}:{steps}"


def cells_of(texts, steps=STEPS):
    """`small:4`, `double:8:60`, `small` or `all`, as (kind, n, steps)."""
    cells = []
    for text in texts:
        kind, *numbers = text.split(":")
        if kind != "all" and kind not in KINDS or len(numbers) > 2 or not all(number.isdigit() for number in numbers):
            raise SystemExit(f"`{text}` is no cell; cells are `small`, `double:8`, `small:4:200`, `all`")
        sizes = [int(numbers[0])] if numbers else list(steps)
        for each in KINDS if kind == "all" else (kind,):
            for n in sizes:
                cells.append((each, n, int(numbers[1]) if len(numbers) == 2 else steps.get(n, 10)))
    return list(dict.fromkeys(cells))


def case(cell):
    """The document of a cell; a shorter run is the beginning of a longer one."""
    kind, n, steps = cell
    m = max(n // 2, 1)
    source = random.Random(f"{kind} {n}")

    def number():
        if kind == "small":
            return str(Fraction(source.randint(-10, 10), source.randint(1, 10)))
        return repr(source.gauss(0, 1))

    def matrix(rows, columns):
        return [[number() for _ in range(columns)] for _ in range(rows)]

    model = {
        "transition": matrix(n, n),
        "observation": matrix(m, n),
        "noise": {"process_factor": matrix(n, n + m), "observation_factor": matrix(m, n + m)},
    }
    mean = [number() for _ in range(n)]
    identity = [[str(int(i == j)) for j in range(n)] for i in range(n)]
    return {
        "format": "exact-kalman/case/1",
        "id": cell_name(cell),
        "numbers": "exact" if kind == "small" else "binary64",
        "timing": "arriving",
        "initial": {"before": "transition", "mean": mean, "covariance": identity},
        **model,
        "observations": [[number() for _ in range(m)] for _ in range(steps)],
    }


class Problem:
    """A case file as fractions: A, C, D, F, P, x and the readings, matrices as lists of rows."""

    def __init__(self, path):
        with open(path, encoding="utf-8") as file:
            document = json.load(file)
        read = Fraction if document["numbers"] == "exact" else lambda text: Fraction(float(text))

        def matrix(rows):
            return [[read(text) for text in row] for row in rows]

        def column(entries):
            return [[read(text)] for text in entries]

        self.A, self.C = matrix(document["transition"]), matrix(document["observation"])
        self.D = matrix(document["noise"]["process_factor"])
        self.F = matrix(document["noise"]["observation_factor"])
        self.P, self.x = matrix(document["initial"]["covariance"]), column(document["initial"]["mean"])
        self.readings = [column(reading) for reading in document["observations"]]
