"""The map of Riccati φ(S) = A(S:W)Aᵀ + V (AK), and its fixed points."""

from .language import Matrix, Statement, add, compared, minus, times, zeros

SIZE = "2×2 over the reals"


def statement(name, identifiers, text, size=SIZE):
    return Statement(f"riccati/{name}", identifiers, text, size)


def model(s):
    a, w, v = s.matrix("a"), s.symmetric("w"), s.symmetric("v")
    return a, w, v


def image(a, w, v, s, d):
    """det(S + W) φ(S)"""
    return a @ (s @ (s + w).adjugate @ w) @ a.T + d * v


def statements():
    s = statement("subtractive", "AK-4.1, AK-4.2", "A[S − S(S + W)⁻¹S]Aᵀ + V = A(S:W)Aᵀ + V = A[W − W(S + W)⁻¹W]Aᵀ + V.")
    (a, w, v), p = model(s), s.symmetric("s")
    s.note("Multiplied by d = det(S + W).")
    d = s.let("d", (p + w).determinant)
    adjugate = (p + w).adjugate
    phi = image(a, w, v, p, d)
    s.conclude(
        phi.equals(a @ (d * p - p @ adjugate @ p) @ a.T + d * v), phi.equals(a @ (d * w - w @ adjugate @ w) @ a.T + d * v)
    )
    s.mutated("W in place of S", phi.equals(a @ (d * p - p @ adjugate @ w) @ a.T + d * v))
    yield s

    s = statement("bounds", "AK-4.2", "0 ≤ S:W ≤ W for S, W ≥ 0 with S + W > 0: the bounds V ≤ φ(S) ≤ AWAᵀ + V before A(·)Aᵀ + V is made of them.")
    p, w = s.symmetric("s"), s.symmetric("w")
    s.note("Multiplied by d = det(S + W) > 0: what A(·)Aᵀ + V is made of.")
    d = s.let("d", (p + w).determinant)
    n = s.let("n", p @ (p + w).adjugate @ w)
    s.assume("S ≥ 0", p.semidefinite())
    s.assume("W ≥ 0", w.semidefinite())
    s.conclude(n.semidefinite(), (d * w - n).semidefinite())
    s.mutated("φ(S) ≤ V", (zeros(2, 2) - n).semidefinite())
    yield s

    s = statement("difference", "AK-T2.3-diff", "φ(T₁) − φ(T₂) = D₁(T₁ − T₂)D₂ᵀ with Dᵢ = AW(Tᵢ + W)⁻¹: the middle equality.")
    a, w, one, two = s.matrix("a"), s.symmetric("w"), s.symmetric("t"), s.symmetric("u")
    d, k = s.let("d", (one + w).determinant), s.let("k", (two + w).determinant)
    s.note("Multiplied by d = det(T₁ + W) and k = det(T₂ + W). T₂ + W is symmetric, so D₂ᵀ = (T₂ + W)⁻¹WAᵀ.")
    sums = k * (one @ (one + w).adjugate @ w) - d * (two @ (two + w).adjugate @ w)
    left = a @ sums @ a.T
    right = a @ w @ (one + w).adjugate @ (one - two) @ (two + w).adjugate @ w @ a.T
    s.conclude(left.equals(right))
    s.mutated("D₁ on both sides", left.equals(a @ w @ (one + w).adjugate @ (one - two) @ (one + w).adjugate @ w @ a.T))
    yield s

    s = statement("closed-loop-equation", "AK-L4.3-id", "T = φ(T) ⇒ T − DTDᵀ = AT(T + W)⁻¹W(T + W)⁻¹TAᵀ + V with D = AW(T + W)⁻¹.")
    a, w, t = s.matrix("a"), s.symmetric("w"), s.symmetric("t")
    d = s.let("d", (t + w).determinant)
    s.note("Multiplied by d² = det(T + W)². V is T − A(T:W)Aᵀ, as T is fixed.")
    i = (t + w).adjugate
    square = times(d, d)
    v = square * t - d * (a @ (t @ i @ w) @ a.T)
    left = square * t - a @ w @ i @ t @ i @ w @ a.T
    s.conclude(left.equals(a @ t @ i @ w @ i @ t @ a.T + v))
    s.mutated("W at the ends", left.equals(a @ w @ i @ t @ i @ w @ a.T + v))
    yield s

    s = statement("closed-loop-stable", "AK-L4.3", "V > 0, T = φ(T) ⇒ |λ| < 1 for the eigenvalues of D = AW(T + W)⁻¹; scalar.", "scalar, over the reals")
    a, w, v, t, lam = (s.real(name) for name in ["a", "w", "v", "t", "l"])
    s.note("n = 1: λ = D, and D(T + W) = AW.")
    s.assume("V > 0", compared(">", v, "0"))
    s.assume("W ≥ 0", compared(">=", w, "0"))
    s.assume("T > 0", compared(">", t, "0"))
    s.assume("T = φ(T)", compared("=", times(minus(t, v), add(t, w)), times(a, a, t, w)))
    s.assume("D(T + W) = AW", compared("=", times(lam, add(t, w)), times(a, w)))
    s.conclude(compared("<", times(lam, lam), "1"))
    s.mutated("|λ| < 1/2", compared("<", times("4", lam, lam), "1"))
    yield s

    s = statement("fixed-point-unique", "AK-T2.3", "V > 0, W ≥ 0 ⇒ φ has at most one fixed point S > 0: the uniqueness; scalar.", "scalar, over the reals")
    a, w, v, one, two = (s.real(name) for name in ["a", "w", "v", "s", "t"])
    s.assume("V > 0", compared(">", v, "0"))
    s.assume("W ≥ 0", compared(">=", w, "0"))
    for label, p in {"S": one, "T": two}.items():
        s.assume(f"{label} > 0", compared(">", p, "0"))
        s.assume(f"{label} = φ({label})", compared("=", times(minus(p, v), add(p, w)), times(a, a, p, w)))
    s.conclude(compared("=", one, two))
    s.mutated("two different ones", compared("distinct", one, two))
    yield s

    s = statement("two-fixed-points", "AK-Ex4", "A = 2I, V = diag(0, 1), W = diag(1, 0): every S ≥ 0 with S + W > 0 and S = φ(S) is V + tW with t = 0 or t = 3.")
    p = s.symmetric("s")
    w, v = Matrix([["1", "0"], ["0", "0"]]), Matrix([["0", "0"], ["0", "1"]])
    d = s.let("d", (p + w).determinant)
    s.assume("S ≥ 0", p.semidefinite())
    s.assume("S + W is regular", compared("distinct", d, "0"))
    s.also_without("S ≥ 0")
    s.assume("S = φ(S)", (d * p).equals("4" * (p @ (p + w).adjugate @ w) + d * v))
    (s1, s12), (_, s2) = p.rows
    s.conclude(compared("=", s2, "1"), compared("=", s12, "0"), f"(or (= {s1} 0) (= {s1} 3))")
    s.mutated("t = 0 alone", compared("=", s1, "0"))
    yield s
