"""The parallel sum F:G = F(F + G)⁻¹G (AK)."""

from .language import Statement, compared, identity, times

SIZE = "2×2 over the reals"


def statement(name, identifiers, text):
    return Statement(f"parallel-sum/{name}", identifiers, text, SIZE)


def pair(s, scaled=True):
    f, g = s.symmetric("f"), s.symmetric("g")
    total = s.let("t", f + g)
    d = s.let("d", total.determinant)
    if scaled:
        s.note("d is det(F + G); n is d times F:G, so that nothing is divided.")
        return f, g, total, d, s.let("n", f @ total.adjugate @ g)
    return f, g, total, d


def forms(s, f, g, x, scale, name):
    """The vector (F + G)⁻¹G(scale · det(F + G) · x)."""
    return s.let(name, scale * ((f + g).adjugate @ g @ x))


def statements():
    s = statement("symmetric", "AK-L4.1ii", "F(F + G)⁻¹G is symmetric, and equal to G(F + G)⁻¹F.")
    f, g, t, d, n = pair(s)
    s.conclude(n.equals(n.T), n.equals(g @ t.adjugate @ f))
    s.mutated("F(F + G)⁻¹F in place of F:G", n.equals(f @ t.adjugate @ f))
    yield s

    s = statement("semidefinite", "AK-L4.1ii", "F:G ≥ 0 for F, G ≥ 0 with F + G > 0.")
    f, g, t, d, n = pair(s)
    s.assume("F ≥ 0", f.semidefinite())
    s.assume("G ≥ 0", g.semidefinite())
    s.assume("F + G is regular", compared("distinct", d, "0"))
    s.conclude(compared(">", d, "0"), n.semidefinite())
    s.mutated("F:G > 0", n.definite())
    yield s

    s = statement("subtractive", "AK-L4.1iv", "F(F + G)⁻¹G = F − F(F + G)⁻¹F, for all symmetric F and G with regular F + G.")
    f, g, t, d, n = pair(s)
    s.conclude(n.equals(d * f - f @ t.adjugate @ f))
    s.mutated("the sign of the second term", n.equals(d * f + f @ t.adjugate @ f))
    yield s

    s = statement("at-most-the-first", "AK-L4.1iv", "F:G ≤ F for F, G ≥ 0 with F + G > 0.")
    f, g, t, d, n = pair(s)
    s.assume("F ≥ 0", f.semidefinite())
    s.assume("G ≥ 0", g.semidefinite())
    s.assume("F + G is regular", compared("distinct", d, "0"))
    s.conclude((d * f - n).semidefinite())
    s.also_without("F + G is regular")
    s.mutated("F ≤ F:G", (n - d * f).semidefinite())
    yield s

    s = statement("inverses-add", "AK-Par-inverse", "(F:G)⁻¹ = F⁻¹ + G⁻¹ for F, G > 0: (F:G)(F⁻¹ + G⁻¹) = I.")
    f, g, t, d, n = pair(s)
    s.note("Multiplied by det F · det G · d.")
    s.assume("F > 0", f.definite())
    s.assume("G > 0", g.definite())
    inverses = s.let("i", g.determinant * f.adjugate + f.determinant * g.adjugate)
    whole = s.let("e", times(d, f.determinant, g.determinant))
    product = n @ inverses
    s.conclude(product.equals(whole * identity(2)), compared("distinct", whole, "0"))
    s.mutated("F⁻¹ − G⁻¹", (n @ (g.determinant * f.adjugate - f.determinant * g.adjugate)).equals(whole * identity(2)))
    yield s

    s = statement("least-value", "AK-Par", "xᵀ(F:G)x ≤ zᵀFz + (x − z)ᵀG(x − z) for every x and z and regular F + G ≥ 0, with equality at z = (F + G)⁻¹Gx.")
    f, g, u, z = s.symmetric("f"), s.symmetric("g"), s.vector("u"), s.vector("z")
    s.note("x = det(F + G) u for any u, so y = (F + G)⁻¹Gx needs no division; xᵀ(F:G)x is xᵀFy.")
    s.note("Semidefiniteness is used at one vector, y − z, which is less than is given.")
    x, y = s.let("x", (f + g).determinant * u), forms(s, f, g, u, "1", "y")
    s.assume("(y − z)ᵀ(F + G)(y − z) ≥ 0, as F + G ≥ 0", compared(">=", (f + g).form(y - z), "0"))
    value = s.let("least", (x.T @ f @ y).rows[0][0])
    at = {name: s.let(f"at-{name}", f"(+ {f.form(v)} {g.form(x - v)})") for name, v in {"y": y, "z": z}.items()}
    s.conclude(compared("<=", value, at["z"]), compared("=", value, at["y"]))
    s.mutated("the largest value", compared(">=", value, at["z"]))
    yield s

    s = statement("congruence", "AK-L4.1iii", "T(F:G)Tᵀ = (TFTᵀ):(TGTᵀ) for regular T: this carries monotony from G = I to all G = TTᵀ > 0.")
    f, g, t = s.symmetric("f"), s.symmetric("g"), s.matrix("t")
    s.note("Multiplied by det(F + G) det(T)², the determinant of TFTᵀ + TGTᵀ.")
    a, b = s.let("a", t @ f @ t.T), s.let("b", t @ g @ t.T)
    left = times(t.determinant, t.determinant) * (t @ (f @ (f + g).adjugate @ g) @ t.T)
    s.conclude(left.equals(a @ (a + b).adjugate @ b))
    s.mutated("a factor det T", (t.determinant * (t @ (f @ (f + g).adjugate @ g) @ t.T)).equals(a @ (a + b).adjugate @ b))
    yield s

    s = statement("monotone-beside-one", "AK-L4.1iii", "F ≤ H ⇒ F:I ≤ H:I for F ≥ 0: the case G = I, as matrices.")
    f, e = s.symmetric("f"), s.symmetric("e")
    h = s.let("h", f + e)
    one = identity(2)
    tf, th = s.let("t", f + one), s.let("u", h + one)
    df, dh = s.let("d", tf.determinant), s.let("k", th.determinant)
    s.note("h is H = F + E; n and m are det(F + I) F:I and det(H + I) H:I.")
    n, m = s.let("n", f @ tf.adjugate), s.let("m", h @ th.adjugate)
    s.assume("F ≥ 0", f.semidefinite())
    s.assume("E = H − F ≥ 0", e.semidefinite())
    s.conclude((df * m - dh * n).semidefinite())
    s.mutated("the order turned round", (dh * n - df * m).semidefinite())
    yield s
