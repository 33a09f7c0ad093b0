"""Pseudo-inverses (CKS), timings (HV), recursions from a start that is not Gaussian (SM), products of closed loops (WG)."""

from .language import Matrix, Statement, add, compared, identity, minus, times, zeros


def statements():
    s = Statement("pseudo-inverse/unique-from-rank-one", "CKS-L3-pinv", "PXP = P, X = UPᵀ = PᵀV ⇒ X is unique, for P of rank at most one, in coordinates where P = diag(p, 0).", "2×2 over the reals")
    x, y, u, v, m, n = (s.matrix(name) for name in "xyuvmn")
    p = s.real("p")
    big = Matrix([[p, "0"], ["0", "0"]])
    s.note("An orthogonal change of rows and one of columns bring every P of rank one there.")
    for label, z, left, right in [("X", x, u, v), ("Y", y, m, n)]:
        s.assume(f"P{label}P = P", (big @ z @ big).equals(big))
        s.assume(f"{label} = UPᵀ for some U", z.equals(left @ big.T))
        s.assume(f"{label} = PᵀV for some V", z.equals(big.T @ right))
    s.conclude(x.equals(y))
    s.mutated("X = P", x.equals(big))
    yield s

    s = Statement("timing/arriving-as-departing", "HV-X.ad", "C(Az + Bu + Dw) + Gv + Fw = CAz + CBu + Gv + (CD + F)w: the observation.", "2 states, 1 reading and 2 noises, over the reals")
    a, c, d, f = s.matrix("a"), s.matrix("c", 1, 2), s.matrix("d"), s.matrix("f", 1, 2)
    z, b, w, g = s.vector("z"), s.vector("b"), s.vector("w"), s.matrix("g", 1, 1)
    s.note("b is Bu, g is Gv.")
    left = c @ (a @ z + b + d @ w) + g + f @ w
    s.conclude(left.equals(c @ a @ z + c @ b + g + (c @ d + f) @ w))
    s.mutated("F in place of CD + F", left.equals(c @ a @ z + c @ b + g + f @ w))
    yield s

    s = Statement("sowers/response", "SM-4.6", "Q and Ψ of SM-2.3 and SM-1.7 make Q* = Q + Ψ obey SM-4.6.", "2 states and 1 reading, over the reals")
    a, h, p, cross = s.matrix("a"), s.matrix("h", 1, 2), s.symmetric("p"), s.vector("c")
    q, psi, v = s.matrix("q"), s.matrix("i"), s.real("v")
    j = s.let("j", add((h @ p @ h.T).rows[0][0], v))
    gain = s.let("k", a @ p @ h.T + cross)
    s.note("Multiplied by JΣᵛ.")
    both = times(j, v)
    following = both * (a @ q) - v * (gain @ h @ (q + psi)) + j * (cross @ h @ psi)
    transition = both * (a @ psi) - j * (cross @ h @ psi)
    s.conclude((following + transition).equals(both * (a @ (q + psi)) - v * (gain @ h @ (q + psi))))
    s.mutated("the sign of the gain", (following + transition).equals(both * (a @ (q + psi)) + v * (gain @ h @ (q + psi))))
    yield s

    s = Statement("sowers/precision", "SM-4.7", "M and R of SM-4.5 and SM-2.4 make R* = M − R obey SM-4.7.", "2 states and 1 reading, over the reals")
    h, star, psi, m, r = s.matrix("h", 1, 2), s.matrix("q"), s.matrix("i"), s.symmetric("m"), s.symmetric("r")
    j, v = s.real("j"), s.real("v")
    s.note("Multiplied by JΣᵛ.")
    both = times(j, v)
    informed = j * (psi.T @ h.T @ h @ psi)
    seen = v * (star.T @ h.T @ h @ star)
    left = (both * m + informed) - (both * r - seen + informed)
    s.conclude(left.equals(both * (m - r) + seen))
    s.mutated("the printed SM-2.4, without the inverse of Σᵛ", ((both * m + informed) - (both * r - seen + v * informed)).equals(both * (m - r) + seen))
    yield s

    s = Statement("wang/one-step", "WG-55", "One step of the bound: |F(1 − LH)|² ≤ (1 − 1/(1 + Q̄⁻¹P(k+1))) P(k+1) P⁻¹(k).", "scalar, over the reals")
    g, p, q = (s.real(name) for name in "gpq")
    following = s.let("n", add(times(g, g, p), q))
    s.note("g = F(1 − LH), n = P(k+1) = g²P + Q̄ (WG-52). Multiplied by P(Q̄ + n) > 0: 1 − 1/(1 + n/Q̄) = n/(Q̄ + n).")
    s.assume("P(k) > 0", compared(">", p, "0"))
    s.assume("Q̄ > 0", compared(">", q, "0"))
    s.conclude(compared("<=", times(g, g, p, add(q, following)), times(following, following)))
    s.also_without("P(k) > 0", "Q̄ > 0")
    s.mutated("the square of the factor", compared("<=", times(g, g, p, add(q, following), add(q, following)), times(following, following, following)))
    yield s

    s = Statement("wang/one-step-2", "WG-L2.2", "P(k+1) = GP(k)Gᵀ + Q̄, P(k+1) ≤ cQ̄, c > 0 ⇒ GP(k)Gᵀ ≤ (1 − 1/c)P(k+1): one step of the proof, G = F(I − LH).", "2×2 over the reals")
    gap, q, c = s.symmetric("g"), s.symmetric("q"), s.real("c")
    s.note("g is GP(k)Gᵀ, n is P(k+1).")
    n = s.let("n", gap + q)
    s.assume("P(k+1) ≤ cQ̄", (c * q - n).semidefinite())
    s.assume("c > 0", compared(">", c, "0"))
    s.conclude((minus(c, "1") * n - c * gap).semidefinite())
    s.also_without("c > 0")
    s.mutated("1 − 2/c", (minus(c, "2") * n - c * gap).semidefinite())
    yield s
