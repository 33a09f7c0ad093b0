"""Scalar updates as `src/float` computes them, operation by operation, rounded to nearest (IEEE 754).

Inputs are finite and not negative: the variance p of the prior and r of the noise, and for some a sensor c.
"""

from .language import Statement

ZERO, ONE = "zero", "one"


def statement(name, text):
    s = Statement(f"float/{name}", "none", text, "scalar, binary16", "QF_FP")
    s.lines += [
        "(define-sort Number () Float16)",
        "(define-fun zero () Number (_ +zero 5 11))",
        "(define-fun one () Number ((_ to_fp 5 11) RNE 1.0))",
    ]
    return s


def op(name):
    return lambda a, b: f"(fp.{name} RNE {a} {b})"


plus, less, by, over = op("add"), op("sub"), op("mul"), op("div")


def number(s, name):
    s.lines.append(f"(declare-const {name} Number)")
    return name


def let(s, name, term):
    s.lines.append(f"(define-fun {name} () Number {term})")
    return name


def finite(x):
    return f"(and (not (fp.isNaN {x})) (not (fp.isInfinite {x})))"


def at_most(x, y):
    return f"(fp.leq {x} {y})"


def inputs(s, sensor=False):
    p, r = number(s, "p"), number(s, "r")
    for x in (p, r):
        s.assume(f"{x} is finite and not negative", f"(and {finite(x)} (fp.leq zero {x}))")
    if not sensor:
        return p, r, None
    c = number(s, "c")
    s.assume("c is finite", finite(c))
    return p, r, c


def short(s, p, r, c):
    """Forms textbook, symmetrised and pseudo-inverse: K = (PC)(1/S), (1 − KC)P."""
    v = let(s, "s", plus(by(by(c, p), c), r) if c else plus(p, r))
    w = let(s, "w", over(ONE, v))
    k = let(s, "k", by(by(p, c), w) if c else by(p, w))
    return v, w, let(s, "q", by(less(ONE, by(k, c) if c else k), p))


def joseph(s, p, r, c):
    """K = (PC)/S, ((1 − KC)P)(1 − KC) + (KR)K."""
    v = let(s, "s", plus(by(by(c, p), c), r) if c else plus(p, r))
    k = let(s, "k", over(by(p, c) if c else p, v))
    f = let(s, "f", less(ONE, by(k, c) if c else k))
    return v, k, let(s, "q", plus(by(by(f, p), f), by(by(k, r), k)))


def ud(s, p, r, c):
    """P(R/(R + C(PC)))."""
    v = let(s, "s", plus(r, by(c, by(p, c)) if c else p))
    return v, let(s, "q", by(p, over(r, v)))


def between_one_and_two(s):
    s.assume("1 ≤ P ≤ 2", "(and (fp.leq one p) (fp.leq p (fp.add RNE one one)))")


def normal_noise(s):
    s.assume("R > 0 is normal", "(and (fp.isNormal r) (fp.isPositive r))")


def between(q, p):
    return f"(and (fp.leq zero {q}) (fp.leq {q} {p}))"


def statements():
    s = statement("short-unit-sensor", "(1 − K)P with K = P(1/S), S = P + R and C = 1 lies between 0 and P: forms textbook, symmetrised and pseudo-inverse.")
    p, r, _ = inputs(s)
    v, w, q = short(s, p, r, None)
    s.assume("S is finite and normal", f"(fp.isNormal {v})")
    s.assume("1/S is normal", f"(fp.isNormal {w})")
    s.conclude(between(q, p))
    s.also_without("S is finite and normal")
    s.mutated("always below P", f"(fp.lt {q} {p})")
    yield s

    s = statement("short-negative-variance", "(1 − KC)P with K = (PC)(1/S) is not negative for C ≤ 2 where nothing is subnormal or overflows. It is refuted: forms textbook, symmetrised and pseudo-inverse.")
    p, r, c = inputs(s, True)
    v, w, q = short(s, p, r, c)
    s.assume("1 ≤ P, C ≤ 2", "(and (fp.leq one p) (fp.leq one c) (fp.leq p (fp.add RNE one one)) (fp.leq c (fp.add RNE one one)))")
    normal_noise(s)
    s.refuted = True
    s.conclude(at_most(ZERO, q))
    yield s

    s = statement("ahead-negative-variance", "P − (KS)K with K = P(1/S) and S = P + R is not negative where nothing is subnormal or overflows. It is refuted: what is predicted of the next state (A = 1, Q = 0) by the forms textbook, symmetrised and pseudo-inverse.")
    p, r, _ = inputs(s)
    v, w, _ = short(s, p, r, None)
    q = let(s, "n", less(p, by(by("k", v), "k")))
    between_one_and_two(s)
    normal_noise(s)
    s.refuted = True
    s.conclude(at_most(ZERO, q))
    yield s

    s = statement("joseph-semidefinite", "Joseph's form is a number that is not negative, for every sensor, where S is normal and K, KC and (1 − KC)P are finite.")
    p, r, c = inputs(s, True)
    v, k, q = joseph(s, p, r, c)
    s.assume("S is normal, K finite", f"(and (fp.isNormal {v}) {finite(k)} {finite(by(k, c))})")
    s.assume("the first product is finite", finite(by("f", p)))
    s.conclude(f"(fp.leq zero {q})")
    s.also_without("c is finite", "S is normal, K finite", "the first product is finite")
    s.mutated("KRK taken off", f"(fp.leq zero {less(by(by('f', p), 'f'), by(by(k, r), k))})")
    yield s

    s = statement("joseph-at-most-the-prior", "Joseph's form with C = 1 is at most P, where 1 ≤ P ≤ 2 and R is normal.")
    p, r = number(s, "p"), number(s, "r")
    v, k, q = joseph(s, p, r, None)
    between_one_and_two(s)
    s.assume("R > 0 is normal, S finite", f"(and (fp.isNormal r) (fp.isPositive r) {finite(v)})")
    s.mutated("always below P", f"(fp.lt {q} {p})")
    s.conclude(at_most(q, p))
    yield s

    s = statement("ud-between", "P(R/S) with S = R + C(PC) lies between 0 and P, for every sensor, where S is finite and not zero: form ud, in all of the range, subnormal numbers included.")
    p, r, c = inputs(s, True)
    v, q = ud(s, p, r, c)
    s.assume("S is finite", finite(v))
    s.assume("S is not zero", f"(not (fp.isZero {v}))")
    s.conclude(between(q, p))
    s.also_without("c is finite", "S is finite")
    s.mutated("always below P", f"(fp.lt {q} {p})")
    yield s

    s = statement("information-above-the-prior", "1/(1/P) is at most P, where 1 ≤ P ≤ 2. It is refuted: what the information form hands out before it has read anything.")
    p = number(s, "p")
    between_one_and_two(s)
    s.refuted = True
    s.conclude(at_most(over(ONE, over(ONE, p)), p))
    yield s

    s = statement("information-shrinks", "1/(Y + (CW)C) with W = 1/R lies between 0 and 1/Y, for a belief Y > 0 of the information form: no reading makes its own variance larger.")
    y, r, c = number(s, "y"), number(s, "r"), number(s, "c")
    s.assume("Y > 0 is finite", f"(and {finite(y)} (fp.lt zero {y}))")
    s.assume("R > 0", f"(fp.lt zero {r})")
    s.assume("c is finite", finite(c))
    w = let(s, "w", over(ONE, r))
    total = let(s, "t", plus(y, by(by(c, w), c)))
    s.assume("(CW)C is a number", f"(not (fp.isNaN {total}))")
    s.conclude(between(over(ONE, total), over(ONE, y)))
    s.also_without("c is finite")
    s.mutated("always smaller", f"(fp.lt {over(ONE, total)} {over(ONE, y)})")
    yield s

    s = statement("clamped-between", "max(0, min(P, (1 − KC)P)) lies between 0 and P where (1 − KC)P is a number: the short form, mended by a clamp.")
    p, r, c = inputs(s, True)
    v, w, q = short(s, p, r, c)
    clamped = f"(ite (fp.lt {q} zero) zero (ite (fp.lt p {q}) p {q}))"
    s.assume("(1 − KC)P is a number", f"(not (fp.isNaN {q}))")
    s.conclude(between(clamped, p))
    s.also_without("r is finite and not negative", "c is finite")
    s.mutated("without the clamp", between(q, p))
    yield s
