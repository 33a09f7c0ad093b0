"""The exact Kalman filter as it is written with other exact arithmetic.

Every peer takes a `Problem` and gives two functions: `prepared()` turns the numbers into the library's own, not timed;
`run(prepared)` computes (P, x) of all steps, timed. `entries(step)` lists a step's P row by row, then x, as pairs of a
numerator and a denominator.
"""

import math
import random
from fractions import Fraction


def textbook(A, C, D, F, P, x, readings, solved):
    """The recursion as one finds it in books, over any matrices with + - * and `transpose`."""
    At, Ct = A.transpose(), C.transpose()
    process, shared = D * D.transpose(), D * F.transpose()
    noise = F * F.transpose() + (C * shared).transpose()
    steps = []
    for y in readings:
        predicted = A * P * At + process
        cross = predicted * Ct + shared
        innovation = C * cross + noise
        gain_transposed = solved(innovation, cross.transpose())
        gain = gain_transposed.transpose()
        P = predicted - cross * gain_transposed
        moved = A * x
        x = moved + gain * (y - C * moved)
        steps.append((P, x))
    return steps


class Textbook:
    """A peer that runs the textbook recursion on matrices of its own."""

    def prepared(self, problem):
        of = self.matrix
        fixed = [of(each) for each in (problem.A, problem.C, problem.D, problem.F, problem.P, problem.x)]
        return fixed + [[of(reading) for reading in problem.readings]]

    def run(self, prepared):
        return textbook(*prepared, self.solved)

    def entries(self, step):
        for matrix in step:
            for entry in self.listed(matrix):
                yield entry.numerator, entry.denominator


class FlintRationals(Textbook):
    """python-flint's fmpq_mat: every entry in lowest terms at every step."""

    def __init__(self):
        import flint

        self.flint = flint
        self.version = f"python-flint {flint.__version__} (FLINT {flint.__FLINT_VERSION__}) fmpq_mat"

    def matrix(self, rows):
        fmpq = self.flint.fmpq
        return self.flint.fmpq_mat([[fmpq(entry.numerator, entry.denominator) for entry in row] for row in rows])

    def solved(self, matrix, right):
        return matrix.solve(right)

    def entries(self, step):
        for matrix in step:
            for entry in matrix.entries():
                yield entry.p, entry.q


class FlintIntegers:
    """The fraction-free elimination of `filter_rational` on FLINT's integers, its loops in Python."""

    def __init__(self):
        import flint

        self.flint = flint
        self.version = f"python-flint {flint.__version__} (FLINT {flint.__FLINT_VERSION__}) fmpz"

    def prepared(self, problem):
        fmpz, fmpz_mat = self.flint.fmpz, self.flint.fmpz_mat
        plain = Rows.of
        A, C, D, F = (plain(each) for each in (problem.A, problem.C, problem.D, problem.F))
        joint = Rows((C * A).rows + A.rows)
        noise = Rows((C * D + F).rows + D.rows)
        covariance = noise * noise.transpose()
        e = math.lcm(*(entry.denominator for row in joint.rows for entry in row))
        needed = math.lcm(*(entry.denominator for row in covariance.rows for entry in row))
        w = math.lcm(e * e, needed)
        # Of the mean and the readings, and of the initial covariance.
        every = [problem.x] + problem.readings
        z = math.lcm(*(entry.denominator for column in every for row in column for entry in row))
        u = math.lcm(*(entry.denominator for row in problem.P for entry in row))

        def integers(rows, factor):
            return fmpz_mat([[int(entry * factor) for entry in row] for row in rows])

        primes = radical(e * needed * z * u)
        return {
            "E": integers(joint.rows, e),
            "Q": integers(covariance.rows, w),
            "N": integers(problem.P, u),
            "X": integers(problem.x, z),
            "readings": [[fmpz(int(entry * z)) for (entry,) in reading] for reading in problem.readings],
            "e": fmpz(e),
            "w": fmpz(w),
            "u": fmpz(u),
            "z": fmpz(z),
            "smooth": fmpz(primes) ** 64,
            "m": len(problem.C),
            "n": len(problem.A),
        }

    def run(self, given):
        """P = N/(u d), x = X/(v d), z | v; d, the last pivot, is kept coprime to the denominators of the model."""
        E, Q, N, X, m, n = (given[name] for name in "EQNXmn")
        e, w, u, z, smooth = (given[name] for name in ("e", "w", "u", "z", "smooth"))
        fmpz_mat, transposed, size = self.flint.fmpz_mat, E.transpose(), m + n
        factor, d, v = w // (e * e), self.flint.fmpz(1), z
        steps = []
        for y in given["readings"]:
            joint = E * N * transposed
            if factor != 1:
                joint = joint * factor
            rows = (joint + Q * (u * d)).tolist()
            moved, weight = (E * X).entries(), e * v // z * d
            for i, row in enumerate(rows):
                row.append(weight * y[i] - moved[i] if i < m else -moved[i])
            previous = d
            for k in range(m):
                top = rows[k]
                pivot = top[k]
                for i in range(k + 1, size):
                    row, left = rows[i], top[i]
                    for j in range(i, size + 1):
                        row[j] = (pivot * row[j] - left * top[j]) // previous
                previous = pivot
            d, u, v = previous, u * w, v * e
            while (shared := d.gcd(smooth)) != 1:
                d, u, v = d // shared, u * shared, v * shared
            upper = [rows[m + i][m + j] for i in range(n) for j in range(i, n)]
            means = [-rows[m + i][size] for i in range(n)]
            content = common(upper, u)
            if content != 1:
                upper, u = [entry // content for entry in upper], u // content
            # The scale of the mean stays a multiple of the readings' denominator.
            content = common(means, v // z)
            if content != 1:
                means, v = [entry // content for entry in means], v // content
            full, entries = [[None] * n for _ in range(n)], iter(upper)
            for i in range(n):
                for j in range(i, n):
                    full[i][j] = full[j][i] = next(entries)
            N, X = fmpz_mat(full), fmpz_mat([[entry] for entry in means])
            steps.append((N, u * d, X, v * d))
        return steps

    def entries(self, step):
        N, scale, X, mean_scale = step
        for entry in N.entries():
            yield entry, scale
        for entry in X.entries():
            yield entry, mean_scale


def radical(number):
    """The product of the primes of a smooth number."""
    product, prime = 1, 2
    while number > 1:
        if number % prime == 0:
            product *= prime
            while number % prime == 0:
                number //= prime
        prime += 1
    return product


def common(entries, limit):
    """The greatest common divisor of a smooth number and of integers, of which the shortest come first."""
    for entry in sorted(entries, key=lambda entry: entry.height_bits()):
        if limit == 1:
            break
        limit = limit.gcd(entry)
    return limit


class Limit:
    """One FLINT product for every entry of P (its lower triangle) and x of every step, factors as long as the entry.

    It computes nothing: no program that forms its results by products of numbers of that length can be faster.
    """

    def __init__(self):
        self.kernel = FlintIntegers()
        self.version = self.kernel.version

    def prepared(self, problem):
        fmpz, source = self.kernel.flint.fmpz, random.Random(1)
        pairs = []
        for N, _, X, _ in self.kernel.run(self.kernel.prepared(problem)):
            lower = [N[i, j] for i in range(N.nrows()) for j in range(i + 1)]
            for entry in lower + X.entries():
                bits = max(entry.height_bits(), 1)
                pairs.append((fmpz(source.getrandbits(bits)), fmpz(source.getrandbits(bits))))
        return pairs

    def run(self, pairs):
        for left, right in pairs:
            left * right
        return None


class Rows:
    """A matrix as a list of rows, for Python's own fractions."""

    __slots__ = ("rows",)

    def __init__(self, rows):
        self.rows = rows

    @classmethod
    def of(cls, rows):
        return cls([list(row) for row in rows])

    def transpose(self):
        return Rows([list(column) for column in zip(*self.rows)])

    def __add__(self, other):
        return Rows([[a + b for a, b in zip(r, s)] for r, s in zip(self.rows, other.rows)])

    def __sub__(self, other):
        return Rows([[a - b for a, b in zip(r, s)] for r, s in zip(self.rows, other.rows)])

    def __mul__(self, other):
        columns = list(zip(*other.rows))
        return Rows([[sum(a * b for a, b in zip(row, column)) for column in columns] for row in self.rows])


class Fractions(Textbook):
    """Python's fractions.Fraction on lists."""

    def __init__(self):
        import platform

        self.version = f"fractions.Fraction of Python {platform.python_version()}"

    matrix = staticmethod(Rows.of)

    def solved(self, matrix, right):
        """Elimination of Gauss and Jordan."""
        m, rows = len(matrix.rows), [a + b for a, b in zip(matrix.rows, right.rows)]
        for k in range(m):
            chosen = next(i for i in range(k, m) if rows[i][k] != 0)
            rows[k], rows[chosen] = rows[chosen], rows[k]
            inverse = 1 / rows[k][k]
            rows[k] = [entry * inverse for entry in rows[k]]
            for i in range(m):
                factor = rows[i][k]
                if i != k and factor != 0:
                    rows[i] = [a - factor * b for a, b in zip(rows[i], rows[k])]
        return Rows([row[m:] for row in rows])

    def listed(self, matrix):
        return (Fraction(entry) for row in matrix.rows for entry in row)


class Sympy(Textbook):
    """sympy's DomainMatrix over QQ, with the ground types that SYMPY_GROUND_TYPES names."""

    def __init__(self):
        import sympy
        from sympy.external.gmpy import GROUND_TYPES
        from sympy.polys.matrices import DomainMatrix

        self.of, self.QQ = DomainMatrix, sympy.QQ
        self.version = f"sympy {sympy.__version__} DomainMatrix over QQ, ground types {GROUND_TYPES}"

    def matrix(self, rows):
        entries = [[self.QQ(entry.numerator, entry.denominator) for entry in row] for row in rows]
        return self.of(entries, (len(rows), len(rows[0])), self.QQ)

    def solved(self, matrix, right):
        return matrix.lu_solve(right)

    def listed(self, matrix):
        return (entry for row in matrix.to_list() for entry in row)


PEERS = {
    "fmpq": FlintRationals,
    "fmpz": FlintIntegers,
    "limit": Limit,
    "fraction": Fractions,
    "sympy-flint": Sympy,
    "sympy-python": Sympy,
}
