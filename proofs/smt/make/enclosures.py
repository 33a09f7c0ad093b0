"""What the enclosures rest on (EK)."""

from .language import Matrix, Statement, add, compared, minus, times

SIZE = "2×2 over the reals"


def statement(name, identifiers, text, size=SIZE):
    return Statement(f"enclosure/{name}", identifiers, text, size)


def square(term):
    return times(term, term)


def statements():
    s = statement("range", "EK-L2", "P ≥ 0 and M ≥ 0 ⇒ ΓΣ⁺Σ = Γ, that is: Σ = 0 ⇒ Γ = 0.", "1 state and 1 reading, over the reals")
    a, h, q, c, r, p = (s.real(name) for name in ["a", "h", "q", "c", "r", "p"])
    s.assume("P ≥ 0", compared(">=", p, "0"))
    s.assume("Q ≥ 0 and R ≥ 0", f"(and (>= {q} 0) (>= {r} 0))")
    s.assume("QR ≥ S²", compared(">=", times(q, r), square(c)))
    s.assume("Σ = 0", compared("=", add(times(h, p, h), r), "0"))
    s.conclude(compared("=", add(times(a, p, h), c), "0"))
    s.mutated("P = 0", compared("=", p, "0"))
    yield s

    s = statement("gaps-of-forms", "EK-L5", "−W ≤ Z ≤ W ⇒ (uᵀZv)² ≤ uᵀWu · vᵀWv: the first half.")
    z, w, u, v = s.symmetric("z"), s.symmetric("w"), s.vector("u"), s.vector("v")
    s.note("In the basis u, v, if they are independent: u = (1, 0), v = (0, 1). Dependent ones need |uᵀZu| ≤ uᵀWu alone.")
    s.lines = [line for line in s.lines if not line.startswith(("(declare-const u", "(declare-const v"))]
    s.assume("W − Z ≥ 0", (w - z).semidefinite())
    s.assume("W + Z ≥ 0", (w + z).semidefinite())
    bound = times(w.rows[0][0], w.rows[1][1])
    s.conclude(compared("<=", square(z.rows[0][1]), bound))
    s.mutated("half the bound", compared("<=", times("4", square(z.rows[0][1])), bound))
    yield s

    s = statement("gaps-squared", "EK-L5", "−W ≤ Z ≤ W ⇒ Zxxᵀ Z ≤ xᵀWx W: the second half for X = xxᵀ.")
    z, w = s.symmetric("z"), s.symmetric("w")
    s.note("x = (1, 0), in a suitable basis; every X ≥ 0 is a sum of such.")
    s.assume("W − Z ≥ 0", (w - z).semidefinite())
    s.assume("W + Z ≥ 0", (w + z).semidefinite())
    first = Matrix([[z.rows[0][0]], [z.rows[1][0]]])
    s.conclude((w.rows[0][0] * w - first @ first.T).semidefinite())
    s.mutated("half the bound", (w.rows[0][0] * w - "2" * (first @ first.T)).semidefinite())
    yield s

    s = statement("rounding", "EK-L6", "|eᵢⱼ| ≤ cᵢⱼsᵢsⱼ ⇒ −D ≤ e ≤ D, D = diag(sᵢ² Σⱼ cᵢⱼ).")
    e, c, t, u = s.symmetric("e"), s.symmetric("c"), s.real("s1"), s.real("s2")
    scales = [t, u]
    s.assume("scales are positive", f"(and (> {t} 0) (> {u} 0))")
    for i, j in [(0, 0), (0, 1), (1, 1)]:
        bound = times(c.rows[i][j], scales[i], scales[j])
        s.assume(f"|e{i + 1}{j + 1}| is bounded", f"(and (<= {e.rows[i][j]} {bound}) (<= (- {bound}) {e.rows[i][j]}))")
    d = Matrix([[times(square(scales[i]), add(*c.rows[i])) if i == j else "0" for j in range(2)] for i in range(2)])
    s.conclude((d - e).semidefinite(), (d + e).semidefinite())
    s.mutated("the diagonal of c alone", (Matrix([[times(square(t), c.rows[0][0]), "0"], ["0", times(square(u), c.rows[1][1])]]) - e).semidefinite())
    yield s

    s = statement("regular-innovation", "EK-L7", "−w ≤ P − P̃ ≤ w, |T²Σ̃ − 1| ≤ η, T²H²w ≤ ω, κ = 1 − η − ω > 0 ⇒ Σ > 0 and κΣ⁻¹ ≤ T².", "1 state and 1 reading, over the reals")
    p, q, h, r, t, eta, omega, w = (s.real(name) for name in ["p", "pt", "h", "r", "t", "eta", "omega", "w"])
    sigma, near = s.let("s", add(times(h, p, h), r)), s.let("st", add(times(h, q, h), r))
    s.assume("−w ≤ P − P̃ ≤ w", f"(and (<= (- {w}) (- {p} {q})) (<= (- {p} {q}) {w}))")
    s.assume("|T²Σ̃ − 1| ≤ η", f"(and (<= (- (* {t} {t} {near}) 1) {eta}) (<= (- 1 (* {t} {t} {near})) {eta}))")
    s.assume("T²H²w ≤ ω", compared("<=", times(t, t, h, h, w), omega))
    s.assume("κ > 0", compared("<", add(eta, omega), "1"))
    kappa = f"(- 1 {eta} {omega})"
    s.conclude(compared(">", sigma, "0"), compared("<=", kappa, times(t, t, sigma)))
    s.mutated("twice κ", compared("<=", times("2", kappa), times(t, t, sigma)))
    yield s
