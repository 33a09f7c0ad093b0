"""Statements in SMT-LIB: matrices of named entries, hypotheses, and the files that follow from them."""

from dataclasses import dataclass, field


def add(*terms):
    terms = [term for term in terms if term != "0"]
    return "0" if not terms else terms[0] if len(terms) == 1 else f"(+ {' '.join(terms)})"


def minus(one, other):
    if other == "0":
        return one
    return f"(- {other})" if one == "0" else f"(- {one} {other})"


def times(*factors):
    if "0" in factors:
        return "0"
    factors = [factor for factor in factors if factor != "1"]
    return "1" if not factors else factors[0] if len(factors) == 1 else f"(* {' '.join(factors)})"


def conjunction(*parts):
    return parts[0] if len(parts) == 1 else "(and " + " ".join(parts) + ")"


def compared(relation, one, other):
    return f"({relation} {one} {other})"


@dataclass
class Matrix:
    """Terms in rows and columns."""

    rows: list

    @property
    def shape(self):
        return len(self.rows), len(self.rows[0])

    @property
    def T(self):
        return Matrix([list(column) for column in zip(*self.rows)])

    def entries(self):
        return [entry for row in self.rows for entry in row]

    def _with(self, other, combine):
        assert self.shape == other.shape
        return Matrix([[combine(a, b) for a, b in zip(*rows)] for rows in zip(self.rows, other.rows)])

    def __add__(self, other):
        return self._with(other, add)

    def __sub__(self, other):
        return self._with(other, minus)

    def __matmul__(self, other):
        assert self.shape[1] == other.shape[0]
        return Matrix([[add(*(times(a, b) for a, b in zip(row, column))) for column in other.T.rows] for row in self.rows])

    def __rmul__(self, scalar):
        return Matrix([[times(scalar, entry) for entry in row] for row in self.rows])

    def beside(self, other):
        return Matrix([a + b for a, b in zip(self.rows, other.rows)])

    def above(self, other):
        return Matrix(self.rows + other.rows)

    @property
    def determinant(self):
        if self.shape == (1, 1):
            return self.rows[0][0]
        (a, b), (c, d) = self.rows
        return minus(times(a, d), times(b, c))

    @property
    def adjugate(self):
        if self.shape == (1, 1):
            return Matrix([["1"]])
        (a, b), (c, d) = self.rows
        return Matrix([[d, minus("0", b)], [minus("0", c), a]])

    @property
    def trace(self):
        return add(*(self.rows[i][i] for i in range(len(self.rows))))

    def equals(self, other):
        return conjunction(*(compared("=", a, b) for a, b in zip(self.entries(), other.entries())))

    def form(self, vector):
        """xᵀ M x"""
        return (vector.T @ self @ vector).rows[0][0]

    def semidefinite(self):
        return self._definite(">=")

    def definite(self):
        return self._definite(">")

    def _definite(self, relation):
        if self.shape == (1, 1):
            return compared(relation, self.rows[0][0], "0")
        sign = [compared(relation, self.rows[i][i], "0") for i in range(2)] if relation == ">=" else [compared(">", self.rows[0][0], "0")]
        return conjunction(*sign, compared(relation, self.determinant, "0"))


def identity(n):
    return Matrix([["1" if i == j else "0" for j in range(n)] for i in range(n)])


def zeros(rows, columns):
    return Matrix([["0"] * columns for _ in range(rows)])


@dataclass
class Statement:
    """One statement: what is declared and defined, what is assumed, what follows."""

    name: str
    identifiers: str
    statement: str
    size: str
    logic: str = "QF_NRA"
    notes: list = field(default_factory=list)
    lines: list = field(default_factory=list)
    hypotheses: list = field(default_factory=list)
    conclusion: str = ""
    needless: set = field(default_factory=set)
    mutations: list = field(default_factory=list)
    refuted: bool = False

    # Declarations and definitions.
    def real(self, name):
        self.lines.append(f"(declare-const {name} Real)")
        return name

    def matrix(self, name, rows=2, columns=2):
        return Matrix([[self.real(self._entry(name, i, j, rows, columns)) for j in range(columns)] for i in range(rows)])

    def symmetric(self, name, n=2):
        lower = {(i, j): self.real(self._entry(name, i, j, n, n)) for i in range(n) for j in range(i, n)}
        return Matrix([[lower[min(i, j), max(i, j)] for j in range(n)] for i in range(n)])

    def vector(self, name, n=2):
        return self.matrix(name, n, 1)

    def let(self, name, value):
        """Names a term or the entries of a matrix."""
        if isinstance(value, str):
            self.lines.append(f"(define-fun {name} () Real {value})")
            return name
        rows, columns = value.shape
        return Matrix(
            [[self.let(self._entry(name, i, j, rows, columns), value.rows[i][j]) for j in range(columns)] for i in range(rows)]
        )

    @staticmethod
    def _entry(name, i, j, rows, columns):
        if (rows, columns) == (1, 1):
            return name
        return f"{name}{i + 1}" if columns == 1 else f"{name}{i + 1}{j + 1}"

    def note(self, text):
        self.notes.append(text)

    # What is said.
    def assume(self, label, condition):
        self.hypotheses.append((label, condition))

    def conclude(self, *conditions):
        self.conclusion = conjunction(*conditions)

    def also_without(self, *labels):
        """Hypotheses that were found to be needless: without them the statement is true, too."""
        self.needless |= set(labels)

    def mutated(self, what, *conditions):
        """A wrong conclusion; there must be a counter-example."""
        self.mutations.append((what, conjunction(*conditions)))

    # Files.
    def files(self):
        """Pairs of a name and a text."""
        if self.refuted:
            control = "what one would like to be true has a counter-example"
            yield f"{self.name}.smt2", self._text("sat", self.hypotheses, f"(not {self.conclusion})", control)
            return
        yield f"{self.name}.smt2", self._text("unsat", self.hypotheses, f"(not {self.conclusion})", None)
        if self.hypotheses:
            yield f"{self.name}.satisfiable.smt2", self._text(
                "sat", self.hypotheses, self.conclusion, "the hypotheses and the conclusion hold together somewhere"
            )
        for place, dropped in enumerate(self.hypotheses, 1):
            rest = [hypothesis for hypothesis in self.hypotheses if hypothesis is not dropped]
            needless = dropped[0] in self.needless
            word, expected, control = (
                ("needless", "unsat", f"the hypothesis {dropped[0]} is needless")
                if needless
                else ("without", "sat", f"without {dropped[0]} there is a counter-example")
            )
            yield f"{self.name}.{word}-{place}.smt2", self._text(expected, rest, f"(not {self.conclusion})", control)
        for place, (what, conclusion) in enumerate(self.mutations, 1):
            yield f"{self.name}.mutated-{place}.smt2", self._text(
                "sat", self.hypotheses, f"(not {conclusion})", f"a planted fault, {what}, is refuted"
            )

    def _text(self, expected, hypotheses, last, control):
        head = [f"; Identifiers: {self.identifiers}", f"; Statement: {self.statement}"]
        head += [f"; Control: {control}"] if control else []
        head += [f"; Size: {self.size}", f"; Expect: {expected}"]
        body = [f"; {note}" for note in self.notes] + [f"(set-logic {self.logic})"] + self.lines
        for label, condition in hypotheses:
            body += [f"; {label}", f"(assert {condition})"]
        body += ["; the conclusion" + ("" if not last.startswith("(not") else ", denied"), f"(assert {last})", "(check-sat)"]
        return "\n".join(head + body) + "\n"
