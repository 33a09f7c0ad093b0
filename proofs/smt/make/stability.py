"""Lyapunov's and Stein's statements, and the eigenvectors that decide."""

from .language import Statement, add, compared, identity, minus, times, zeros

SIZE = "2×2 over the reals"


def statement(name, identifiers, text):
    return Statement(f"stein/{name}", identifiers, text, SIZE)


def jury(d):
    """The criterion of Jury for |λ| < 1."""
    det, trace = d.determinant, d.trace
    return compared("<", det, "1"), compared("<", trace, add("1", det)), compared("<", minus("0", trace), add("1", det))


def statements():
    s = statement("eigenvector", "AK-L4.2-eigen", "Dx = λx ⇒ x*(F − DᵀFD)x = (1 − |λ|²)x*Fx, for complex λ = a + ib and x = u + iv.")
    f, u, v, a, b = s.symmetric("f"), s.vector("u"), s.vector("v"), s.real("re"), s.real("im")
    s.note("Dx = λx put in: real and imaginary part of Dx are au − bv and bu + av, and x*Fx = uᵀFu + vᵀFv.")
    real, imaginary = s.let("r", a * u - b * v), s.let("i", b * u + a * v)
    square = add(times(a, a), times(b, b))
    left = minus(add(f.form(u), f.form(v)), add(f.form(real), f.form(imaginary)))
    s.conclude(compared("=", left, times(minus("1", square), add(f.form(u), f.form(v)))))
    printed = minus(minus(f.form(u), f.form(v)), minus(f.form(real), f.form(imaginary)))
    s.mutated("as printed, with the transpose of x", compared("=", printed, times(minus("1", square), minus(f.form(u), f.form(v)))))
    yield s

    for part, what in enumerate(["det D < 1", "tr D < 1 + det D", "−tr D < 1 + det D"]):
        s = statement(f"lyapunov-{part + 1}", "AK-L4.2", f"F > 0, F − DᵀFD > 0 ⇒ {what}: one of three parts of Jury's criterion for ρ(D) < 1.")
        d, f = s.matrix("d"), s.symmetric("f")
        rest = s.let("r", f - d.T @ f @ d)
        s.assume("F > 0", f.definite())
        s.assume("F − DᵀFD > 0", rest.definite())
        s.conclude(jury(d)[part])
        s.mutated("half the bound", [compared("<", times("2", d.determinant), "1"), compared("<", times("2", d.trace), add("1", d.determinant)), compared("<", times("-2", d.trace), add("1", d.determinant))][part].replace("-2", "(- 2)"))
        yield s

    s = statement("jury", "none", "Jury's criterion: det D < 1 and |tr D| < 1 + det D ⇒ |λ| < 1 for every eigenvalue λ = a + ib.")
    t, q, a, b = (s.real(name) for name in ["trace", "det", "re", "im"])
    s.note("λ² − tr(D) λ + det D = 0, real and imaginary part.")
    s.assume("det D < 1", compared("<", q, "1"))
    s.assume("tr D < 1 + det D", compared("<", t, add("1", q)))
    s.assume("−tr D < 1 + det D", compared("<", minus("0", t), add("1", q)))
    s.assume("the real part of the characteristic equation", f"(= (+ (- (* {a} {a}) (* {b} {b})) (- (* {t} {a})) {q}) 0)")
    s.assume("the imaginary part of the characteristic equation", f"(= (- (* 2 {a} {b}) (* {t} {b})) 0)")
    s.conclude(compared("<", add(times(a, a), times(b, b)), "1"))
    s.mutated("|λ| < 1/2", compared("<", times("4", add(times(a, a), times(b, b))), "1"))
    yield s

    s = statement("unique", "none", "ρ(D) < 1 and X = DXDᵀ ⇒ X = 0, for symmetric X: a solution of Stein's equation is the only one.")
    d, x = s.matrix("d"), s.symmetric("x")
    for label, condition in zip(["det D < 1", "tr D < 1 + det D", "−tr D < 1 + det D"], jury(d)):
        s.assume(label, condition)
    s.assume("X = DXDᵀ", x.equals(d @ x @ d.T))
    s.conclude(x.equals(zeros(2, 2)))
    s.mutated("X = I", x.equals(identity(2)))
    yield s
