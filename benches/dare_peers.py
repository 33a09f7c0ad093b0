"""Who solves discrete algebraic Riccati equations in doubles, and one who does so with as many digits as are wanted.

Every peer takes `X = A'XA - (A'XB + S)(R + B'XB)^-1 (B'XA + S') + Q` as arrays of doubles and gives X as an array, or raises. `version` says what
answered. A peer that is not installed raises `Missing` when it is made.
"""

import json
import shutil
import subprocess
import tempfile
import time
from pathlib import Path


class Missing(Exception):
    """The peer is not installed."""


class Scipy:
    name = "SciPy"

    def __init__(self):
        try:
            import scipy
            import scipy.linalg
        except ImportError as error:
            raise Missing("pip install scipy") from error
        self.linalg = scipy.linalg
        self.version = f"SciPy {scipy.__version__} solve_discrete_are"

    def solve(self, a, b, q, r, s):
        start = time.perf_counter()
        x = self.linalg.solve_discrete_are(a, b, q, r, s=s if s.any() else None)
        return x, time.perf_counter() - start


class Slycot:
    """SLICOT's SB02OD (generalised Schur vectors) or SB02MD (Schur vectors of the symplectic matrix, needs R to be regular)."""

    def __init__(self, routine):
        try:
            import slycot
        except ImportError as error:
            raise Missing("pip install slycot; needs gfortran and a BLAS") from error
        self.slycot = slycot
        self.routine = routine
        self.name = f"SLICOT {routine}"
        self.version = f"slycot {slycot.__version__} {routine}"

    def solve(self, a, b, q, r, s):
        n, m = b.shape
        start = time.perf_counter()
        if self.routine == "sb02od":
            x = self.slycot.sb02od(n, m, a, b, q, r, "D", L=s if s.any() else None)[0]
        else:
            import numpy

            gain = numpy.linalg.solve(r, numpy.hstack([b.T, s.T]))
            x = self.slycot.sb02md(n, a - b @ gain[:, n:], b @ gain[:, :n], q - s @ gain[:, n:], "D", hinv="I")[0]
        return x, time.perf_counter() - start


class Octave:
    """The `dare` of Octave's control package, in a process of its own; the time is taken inside of it."""

    name = "Octave"

    def __init__(self):
        if shutil.which("octave") is None:
            raise Missing("apt-get install octave octave-control")
        told = self.run("pkg load control; printf('%s %s', version, ver('control').Version);")
        if told.returncode != 0:
            raise Missing("apt-get install octave-control")
        octave, control = told.stdout.split()[-2:]
        self.version = f"Octave {octave}, control {control}, dare"

    @staticmethod
    def run(program):
        command = ["octave", "--no-gui", "--no-window-system", "-q", "--eval", program]
        return subprocess.run(command, capture_output=True, text=True, timeout=120)

    def solve(self, a, b, q, r, s):
        import numpy

        def written(matrix):
            return "[" + ";".join(" ".join(repr(float(entry)) for entry in row) for row in matrix) + "]"

        with tempfile.TemporaryDirectory() as place:
            script = Path(place) / "solve.m"
            cross = f",{written(s)}" if s.any() else ""
            script.write_text(
                f"pkg load control; a={written(a)}; b={written(b)}; q={written(q)}; r={written(r)};\n"
                f"dare(1,1,1,1); tic; x = dare(a,b,q,r{cross}); t = toc;\n"
                "printf('\\n@%.17g', t, x); printf('\\n');\n"
            )
            told = self.run(f"source('{script}')")
        numbers = [float(line[1:]) for line in told.stdout.splitlines() if line.startswith("@")]
        if len(numbers) != a.size + 1:
            errors = [line for line in told.stderr.splitlines() if line.startswith("error: ")]
            raise ValueError(errors[0] if errors else "no answer")
        return numpy.array(numbers[1:]).reshape(a.shape, order="F"), numbers[0]


def doubled(a, b, q, r, s, bits):
    """X by structure-preserving doubling (Chu, Fan, Lin, Wang, 2004) in FLINT's numbers of so many bits; R singular by plain iteration.

    Nothing here is proved; the program that is judged shares no line with it.
    """
    import flint

    flint.ctx.prec = bits
    n = len(a)

    def of(rows):
        return flint.arb_mat([[flint.arb(float(entry)) for entry in row] for row in rows])

    def middle(matrix):
        return flint.arb_mat([[entry.mid() for entry in row] for row in matrix.tolist()])

    def size(matrix):
        return max(abs(entry).mid() for row in matrix.tolist() for entry in row)

    a, b, q, r, s = of(a), of(b), of(q), of(r), of(s)
    one = flint.arb_mat(n, n, [int(i == j) for i in range(n) for j in range(n)])
    small = flint.arb(2) ** (60 - bits)
    try:
        gain = r.solve(b.transpose()), r.solve(s.transpose())
    except ZeroDivisionError:
        x = one * 1000
        for _ in range(20000):
            xb = middle(b.transpose() * x * a + s.transpose())
            following = a.transpose() * x * a + q - xb.transpose() * (r + b.transpose() * x * b).solve(xb)
            following = middle((following + following.transpose()) / 2)
            moved, x = size(following - x), following
            if moved <= small * size(x):
                return x
        raise ValueError("the iteration did not converge")
    a, g, h = middle(a - b * gain[1]), middle(b * gain[0]), middle(q - s * gain[1])
    for _ in range(200):
        w = one + g * h
        left = middle(w.solve(a))
        a, g, moved = (
            middle(a * left),
            middle(g + a * w.solve(g * a.transpose())),
            middle(a.transpose() * h * left),
        )
        h = h + moved
        h, g = middle((h + h.transpose()) / 2), middle((g + g.transpose()) / 2)
        if size(moved) <= small * size(h):
            return h
    raise ValueError("doubling did not converge")


if __name__ == "__main__":
    print(json.dumps([Scipy().version, Octave().version]))
