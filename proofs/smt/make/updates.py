"""What a reading makes of a covariance: Joseph's form, the completed square, order (CKS, WG, EK)."""

from .language import Matrix, Statement, add, compared, identity, minus, times, zeros

SIZE = "2 states and 1 reading, over the reals"
FULL = "2 states and 2 readings, over the reals"


def statement(folder, name, identifiers, text, size=SIZE):
    return Statement(f"{folder}/{name}", identifiers, text, size)


def system(s, readings=1, states=2):
    """A, H, Q, S, R of EK."""
    a, h = s.matrix("a", states, states), s.matrix("h", readings, states)
    q, cross, r = s.symmetric("q", states), s.matrix("c", states, readings), s.symmetric("r", readings)
    return a, h, q, cross, r


def parts(p, a, h, cross, r):
    """Γ and Σ"""
    return a @ p @ h.T + cross, h @ p @ h.T + r


def joseph(p, k, a, h, q, cross, r):
    closed = a - k @ h
    return closed @ p @ closed.T + q - k @ cross.T - cross @ k.T + k @ r @ k.T


def statements():
    for readings, size in [(1, SIZE), (2, FULL)]:
        s = statement("joseph", f"two-forms-{readings}", "EK-L1", "J(P, K) = APAᵀ + Q − KΓᵀ − ΓKᵀ + KΣKᵀ for every symmetric P and every K.", size)
        a, h, q, cross, r = system(s, readings)
        p, k = s.symmetric("p"), s.matrix("k", 2, readings)
        gamma, sigma = parts(p, a, h, cross, r)
        form = joseph(p, k, a, h, q, cross, r)
        s.conclude(form.equals(a @ p @ a.T + q - k @ gamma.T - gamma @ k.T + k @ sigma @ k.T))
        s.mutated("the sign of KΣKᵀ", form.equals(a @ p @ a.T + q - k @ gamma.T - gamma @ k.T - k @ sigma @ k.T))
        yield s

        s = statement("joseph", f"square-completed-{readings}", "EK-L3", "J(P, K) − φ(P) = (KΣ − Γ)Σ⁻¹(KΣ − Γ)ᵀ for regular Σ: the identity.", size)
        a, h, q, cross, r = system(s, readings)
        p, k = s.symmetric("p"), s.matrix("k", 2, readings)
        s.note("Multiplied by e = det Σ.")
        gamma, sigma = parts(p, a, h, cross, r)
        gamma, sigma = s.let("g", gamma), s.let("s", sigma)
        e = s.let("e", sigma.determinant)
        left = e * (joseph(p, k, a, h, q, cross, r) - a @ p @ a.T - q) + gamma @ sigma.adjugate @ gamma.T
        miss = k @ sigma - gamma
        s.conclude(left.equals(miss @ sigma.adjugate @ miss.T))
        s.mutated("KΣ + Γ", left.equals((k @ sigma + gamma) @ sigma.adjugate @ (k @ sigma + gamma).T))
        yield s

        s = statement("joseph", f"square-semidefinite-{readings}", "EK-L3" if readings > 1 else "none", "(KΣ − Γ)Σ⁻¹(KΣ − Γ)ᵀ ≥ 0 for Σ > 0, so that no gain does better: the inequality.", size)
        miss, sigma, x = s.matrix("m", 2, readings), s.symmetric("s", readings), s.vector("x")
        s.note("For M = KΣ − Γ, any matrix, and every x. Multiplied by det Σ > 0.")
        s.assume("Σ > 0", sigma.definite())
        s.conclude(compared(">=", (miss @ sigma.adjugate @ miss.T).form(x), "0"))
        s.also_without(*(["Σ > 0"] if readings == 1 else []))
        s.mutated("a positive square for every x", compared(">", (miss @ sigma.adjugate @ miss.T).form(x), "0"))
        yield s

    s = statement("update", "semidefinite", "none", "P − PCᵀ(CPCᵀ + R)⁻¹CP is positive semidefinite and at most P, for P ≥ 0, R ≥ 0 and CPCᵀ + R > 0 (no shared noise).")
    p, c, r = s.symmetric("p"), s.matrix("c", 1, 2), s.real("r")
    s.note("n is S(P − PCᵀS⁻¹CP), S = CPCᵀ + R.")
    v = s.let("s", add((c @ p @ c.T).rows[0][0], r))
    n = s.let("n", v * p - p @ c.T @ c @ p)
    s.assume("P ≥ 0", p.semidefinite())
    s.assume("R ≥ 0", compared(">=", r, "0"))
    s.assume("S is regular", compared("distinct", v, "0"))
    s.also_without("S is regular")
    s.conclude(n.semidefinite(), (v * p - n).semidefinite())
    s.mutated("positive definite", n.definite())
    yield s

    s = statement("update", "monotone", "EK-L4", "P ≤ P′ ⇒ P − PCᵀ(CPCᵀ + R)⁻¹CP ≤ P′ − P′Cᵀ(CP′Cᵀ + R)⁻¹CP′, for P ≥ 0, R > 0: the first line, with A = I and S = 0.")
    p, e, r = s.symmetric("p"), s.symmetric("e"), s.real("r")
    c = Matrix([["1", "0"]])
    s.note("C = [1 0], which any nonzero C is in a suitable basis. E = P′ − P.")
    high = p + e
    v, w = s.let("s", add((c @ p @ c.T).rows[0][0], r)), s.let("t", add((c @ high @ c.T).rows[0][0], r))
    n, m = s.let("n", v * p - p @ c.T @ c @ p), s.let("m", w * high - high @ c.T @ c @ high)
    s.assume("P ≥ 0", p.semidefinite())
    s.assume("P′ − P ≥ 0", e.semidefinite())
    s.assume("R > 0", compared(">", r, "0"))
    s.conclude((v * m - w * n).semidefinite())
    s.mutated("the order turned round", (w * n - v * m).semidefinite())
    yield s

    s = statement("update", "order", "EK-L4", "φ(P′) − φ(P) ≤ (A − KH)(P′ − P)(A − KH)ᵀ, K the gain at P: one half of the second line.")
    a, h, q, cross, r = system(s, 1)
    p, high, x = s.symmetric("p"), s.symmetric("o"), s.vector("x")
    gamma, sigma = parts(p, a, h, cross, r)
    other, tau = parts(high, a, h, cross, r)
    gamma, sigma, other, tau = s.let("g", gamma), s.let("s", sigma), s.let("f", other), s.let("t", tau)
    (v,), (w,) = sigma.rows[0], tau.rows[0]
    s.note("Multiplied by Σ²Σ′ > 0, for every x. The difference is (KΣ′ − Γ′)Σ′⁻¹(KΣ′ − Γ′)ᵀ.")
    low = v * (v * (w * (a @ p @ a.T + q))) - times(v, w) * (gamma @ gamma.T)
    top = v * (v * (w * (a @ high @ a.T + q))) - times(v, v) * (other @ other.T)
    closed = v * a - gamma @ h
    s.assume("Σ′ > 0", compared(">", w, "0"))
    s.conclude(compared("<=", (top - low).form(x), (w * (closed @ (high - p) @ closed.T)).form(x)))
    s.also_without("Σ′ > 0")
    s.mutated("the order turned round", compared(">=", (top - low).form(x), (w * (closed @ (high - p) @ closed.T)).form(x)))
    yield s

    s = statement("update", "lyapunov-form", "WG-52", "F(I − LH)P(I − LH)ᵀFᵀ + FLRLᵀFᵀ + Q is WG-1, for L = PHᵀ(HPHᵀ + R)⁻¹.")
    f, h, q, r, p = s.matrix("f"), s.matrix("h", 1, 2), s.symmetric("q"), s.real("r"), s.symmetric("p")
    v = s.let("s", add((h @ p @ h.T).rows[0][0], r))
    s.note("Multiplied by s² = (HPHᵀ + R)².")
    gain = s.let("l", p @ h.T)
    closed = v * identity(2) - gain @ h
    left = f @ closed @ p @ closed.T @ f.T + f @ (r * (gain @ gain.T)) @ f.T
    right = v * (v * (f @ p @ f.T) - f @ p @ h.T @ h @ p @ f.T)
    s.conclude(left.equals(right))
    s.mutated("without the noise of the reading", (f @ closed @ p @ closed.T @ f.T).equals(right))
    yield s

    s = statement("update", "two-forms", "CKS-10.form", "APAᵀCᵀ + D(F + CD)ᵀ = RCᵀ + DFᵀ with R = APAᵀ + DDᵀ.", "2 states, 1 reading and 2 noises, over the reals")
    a, c, d, f, p = s.matrix("a"), s.matrix("c", 1, 2), s.matrix("d"), s.matrix("f", 1, 2), s.symmetric("p")
    left = a @ p @ a.T @ c.T + d @ (f + c @ d).T
    s.conclude(left.equals((a @ p @ a.T + d @ d.T) @ c.T + d @ f.T))
    s.mutated("without the second noise term", left.equals((a @ p @ a.T + d @ d.T) @ c.T))
    yield s

    s = statement("update", "innovation-forms", "CKS-11", "CAPAᵀCᵀ + (F + CD)(F + CD)ᵀ = CRCᵀ + FFᵀ + CDFᵀ + FDᵀCᵀ with R = APAᵀ + DDᵀ.", "2 states, 1 reading and 2 noises, over the reals")
    a, c, d, f, p = s.matrix("a"), s.matrix("c", 1, 2), s.matrix("d"), s.matrix("f", 1, 2), s.symmetric("p")
    left = c @ a @ p @ a.T @ c.T + (f + c @ d) @ (f + c @ d).T
    right = c @ (a @ p @ a.T + d @ d.T) @ c.T + f @ f.T
    s.conclude(left.equals(right + c @ d @ f.T + f @ d.T @ c.T))
    s.mutated("without the cross terms", left.equals(right))
    yield s

    s = statement("conditioning", "covariance", "none", "P_xx − P_xy P_yy⁻¹ P_yx is positive semidefinite and at most P_xx, for a joint covariance ≥ 0 of 2 + 1 with P_yy > 0.")
    x, c, y = s.symmetric("x"), s.vector("c"), s.real("y")
    n = s.let("n", y * x - c @ c.T)
    (x1, x12), (_, x2) = x.rows
    c1, c2 = c.entries()
    s.note("n is P_yy(P_xx − P_xy P_yy⁻¹ P_yx). The joint covariance is ≥ 0: all its principal minors are.")
    whole = add(times(x1, minus(times(x2, y), times(c2, c2))), minus("0", times(x12, minus(times(x12, y), times(c1, c2)))), times(c1, minus(times(x12, c2), times(x2, c1))))
    s.assume("minors of order 1", f"(and (>= {x1} 0) (>= {x2} 0) (>= {y} 0))")
    s.assume("minors of order 2", f"(and (>= {x.determinant} 0) (>= {n.rows[0][0]} 0) (>= {n.rows[1][1]} 0))")
    s.assume("the determinant", compared(">=", whole, "0"))
    s.assume("P_yy is regular", compared("distinct", y, "0"))
    s.also_without("P_yy is regular")
    s.conclude(n.semidefinite(), (y * x - n).semidefinite())
    s.mutated("the sign of the correction", (zeros(2, 2) - c @ c.T).semidefinite())
    yield s

    s = statement("conditioning", "residual", "none", "cov(X − P_xy P_yy⁻¹ Y, Y) = P_xy − P_xy P_yy⁻¹ P_yy = 0 for 2 + 2 with regular P_yy.", "2 + 2 over the reals")
    c, y = s.matrix("c"), s.symmetric("y")
    s.note("Multiplied by det P_yy.")
    s.conclude((y.determinant * c - c @ y.adjugate @ y).equals(zeros(2, 2)))
    s.mutated("the sign of the correction", (y.determinant * c + c @ y.adjugate @ y).equals(zeros(2, 2)))
    yield s
