"""Checks a certificate of a filter: python3 verify.py FILE. Exact fractions only; docs/CERTIFICATES.md has the inequalities."""
import hashlib, json, sys
from fractions import Fraction as F


def number(text, numbers):
    text = str(text)
    if numbers == "exact":
        return F(text) if "0x" not in text.lower() else F(float.fromhex(text))
    assert numbers == "binary64", "binary32 is not read here"
    return F(float.fromhex(text) if "0x" in text.lower() else float(text))


def tr(a): return [list(row) for row in zip(*a)]
def mul(a, b): return [[sum((x * y for x, y in zip(row, column)), F(0)) for column in zip(*b)] for row in a]
def add(*ms): return [[sum(es, F(0)) for es in zip(*rows)] for rows in zip(*ms)]
def scale(f, a): return [[f * x for x in row] for row in a]
def sub(a, b): return add(a, scale(-1, b))
def around(a, m): return mul(mul(a, m), tr(a))
def square(a): return mul(a, tr(a))
def trace(a): return sum(a[i][i] for i in range(len(a)))
def zeros(n, m): return [[F(0)] * m for _ in range(n)]
def identity(n): return [[F(i == j) for j in range(n)] for i in range(n)]


def need(condition, message):
    if not condition:
        sys.exit(f"rejected: {message}")


def nonnegative(a, message):
    a = [row[:] for row in a]
    for k in range(len(a)):
        need(a[k][k] >= 0 and (a[k][k] > 0 or not any(a[k][k:])), message)
        for i in range(k + 1, len(a)) if a[k][k] else ():
            f = a[i][k] / a[k][k]
            a[i] = [x - f * y for x, y in zip(a[i], a[k])]


def rank(a):
    a, r = [row[:] for row in a], 0
    for c in range(len(a[0]) if a else 0):
        p = next((i for i in range(r, len(a)) if a[i][c]), None)
        if p is not None:
            a[r], a[p] = a[p], a[r]
            a[r + 1:] = [[x - row[c] / a[r][c] * y for x, y in zip(row, a[r])] for row in a[r + 1:]]
            r += 1
    return r


def full(d, rows, columns):
    need(len(d["rows"]) == rows and all(len(row) == columns for row in d["rows"]), "shape")
    return [[int(x, 16) * F(2) ** d["exponent"] for x in row] for row in d["rows"]]


def symmetric(d, n):
    need([len(row) for row in d["rows"]] == list(range(1, n + 1)), "shape")
    at = lambda i, j: int(d["rows"][max(i, j)][min(i, j)], 16) * F(2) ** d["exponent"]
    return [[at(i, j) for j in range(n)] for i in range(n)]


def belief(d, n):
    return symmetric(d["covariance"], n), symmetric(d["gap"], n), full(d["mean"], n, 1), symmetric(d["ellipsoid"], n)


def at(value, k, depth, read):
    """A coefficient at step k: constant, or a list with one for each step."""
    first = next((x for x in value if x is not None), None)
    for _ in range(depth - 1 if first is not None else 0):
        first = first[0] if first else ""
    value = value[k] if first is None or isinstance(first, list) else value
    return None if value is None else [[read(x) for x in row] for row in value] if depth == 2 else [[read(x)] for x in value]


def law(case, k, n, read):
    """C, R, c, y with gaps, and the transition (A, b, Q, X) if there is one."""
    noise, get = case["noise"], lambda value: at(value, k, 2, read)
    c = get(case["observation"])
    term = lambda t, rows: (zeros(rows, 1) if t is None else None if at(t["vector"], k, 1, read) is None or (t.get("matrix") and get(t["matrix"]) is None)
                            else mul(get(t["matrix"]), at(t["vector"], k, 1, read)) if t.get("matrix") else at(t["vector"], k, 1, read))
    if "process_factor" in noise:
        d, f = get(noise["process_factor"]), get(noise["observation_factor"])
        q, x, r = d and square(d), d and mul(d, tr(f)), square(f)
    else:
        q, r = get(noise["process"]), get(noise["observation"])
        x = get(noise["cross"]) if noise.get("cross") else zeros(n, len(c))
    a, b, y = get(case["transition"]), term(case.get("input"), n), case["observations"][k]
    y = [None] * len(c) if y is None else [None if e is None else read(e) for e in y]
    return c, r, term(case.get("observation_input"), len(c)), y, None if None in (a, b, q, x) else (a, b, q, x)


def check_mean(e_plus, carried, local, k, message):
    need(k is not None or not any(map(any, carried)) or not any(map(any, local)), message)
    f, g = (1, 1) if k is None else (1 + F(2) ** -k, 1 + F(2) ** k)
    nonnegative(sub(e_plus, add(scale(f, carried), scale(g, local))), message)


def check(state, target, document, reading, message):
    """What is claimed of a target follows from the state; with (H, R, ν, T) where something is read."""
    (p, w, x, e), (a, b, q, s), n = state, target, len(state[0])
    p1, w1, x1, e1 = belief(document, n)
    k = document.get("balance")
    if reading is None:
        need("gain" not in document, message)
        j, base, kappa, closed, mean, local = add(around(a, p), q), around(a, w), 1, a, add(mul(a, x), b), zeros(n, n)
    else:
        h, r, nu, t = reading
        gain, sigma = full(document["gain"], n, len(h)), add(around(h, p), r)
        th = mul(t, h)
        eta = max(sum(map(abs, row)) for row in sub(around(t, sigma), identity(len(h))))
        spread = trace(around(th, w))
        kappa = 1 - eta - spread
        need(kappa > 0, f"{message}: κ = {float(kappa)}")
        closed, mixed = sub(a, mul(gain, h)), mul(gain, tr(s))
        missed = square(mul(sub(mul(gain, sigma), add(mul(mul(a, p), tr(h)), s)), tr(t)))
        j = add(around(closed, p), q, scale(-1, mixed), scale(-1, tr(mixed)), around(gain, r))
        base = add(scale(1 + 2 * spread / kappa, around(closed, w)), scale(2 / kappa, missed))
        size = ((1 + F(1, 1024)) * trace(square(mul(t, nu))) + 1025 * trace(around(th, e))) / kappa
        local = scale(3 * size / kappa, add(scale(spread, around(closed, w)), missed))
        mean = add(mul(a, x), b, mul(gain, nu))
    for sign in (1, -1):
        nonnegative(add(w1, scale(-1, base), scale(sign, sub(j, p1))), f"{message}: covariance")
    error = square(sub(mean, x1))
    check_mean(e1, around(closed, e), add(local, scale(1 if reading is None else 3, error)), k, f"{message}: mean")
    return p1, w1, x1, e1


def main(file):
    lines = open(file, "rb").read().splitlines(keepends=True)
    header, *rest = map(json.loads, lines)
    need(header.get("certificate") == "exact-kalman filter 1" and rest, "not the certificate of a filter")
    *steps, end = rest
    case, count = header["case"], len(header["case"]["observations"])
    read = lambda x: number(x, case.get("numbers", "binary64"))
    need(end == {"steps": count, "sha256": hashlib.sha256(b"".join(lines[:-1])).hexdigest()}, "digest")
    need([step["step"] for step in steps] == list(range(count)), "order")
    mean, start = [[read(x)] for x in case["initial"]["mean"]], [[read(x) for x in row] for row in case["initial"]["covariance"]]
    need(not any(map(any, case["initial"].get("diffuse") or [])) or not any(read(x) for row in case["initial"]["diffuse"] for x in row), "diffuse")
    n, state = len(mean), belief(header["start"], len(mean))
    for sign in (1, -1):
        nonnegative(add(state[1], scale(sign, sub(start, state[0]))), "start: covariance")
    nonnegative(sub(state[3], square(sub(mean, state[2]))), "start: mean")
    for k, step in enumerate(steps):
        c, r, offset, y, transition = law(case, k, n, read)
        arrives = case["timing"] == "arriving" and (k > 0 or case["initial"]["before"] == "transition")
        seen = [i for i in range(len(c)) if y[i] is not None]
        c, r, y = [c[i] for i in seen], [[r[i][j] for j in seen] for i in seen], [[y[i] - offset[i][0]] for i in seen]
        still = identity(n), zeros(n, 1), zeros(n, n), zeros(n, len(seen))
        if transition is not None:
            a, b, q, x = *transition[:3], [[row[j] for j in seen] for row in transition[3]]
        filtered, ahead, predicted = still, None, None
        if arrives:
            mixed, predicted = mul(c, x), (a, b, q, None)
            filtered = a, b, q, add(mul(q, tr(c)), x) if seen else zeros(n, 0)
            c, r, y = mul(c, a), add(r, around(c, q), mixed, tr(mixed)) if seen else r, sub(y, mul(c, b))
        elif case["timing"] == "departing" and transition is not None:
            ahead = a, b, q, x
        if "kept" in step:
            places = [seen.index(i) for i in step["kept"]]
            need(places == sorted(set(places)), "kept")
            rows = [u + v + w + [f[i] for f in filtered[3]] + [f[i] for f in (ahead or still)[3]] for i, (u, v, w) in enumerate(zip(c, r, y))]
            need(rank(rows) == rank([rows[i] for i in places]), f"step {k}: kept")
            c, y, r = [c[i] for i in places], [y[i] for i in places], [[r[i][j] for j in places] for i in places]
            filtered, ahead = (t and (*t[:3], [[row[j] for j in places] for row in t[3]]) for t in (filtered, ahead))
        need((predicted is None, ahead is None, not c) == tuple(m not in step for m in ("predicted", "ahead", "whitening")), f"step {k}: members")
        reading = (c, r, sub(y, mul(c, state[2])), full(step["whitening"], len(c), len(c))) if c else None
        if predicted:
            check(state, predicted, step["predicted"], None, f"step {k}, predicted")
        after = check(state, filtered, step["filtered"], reading, f"step {k}, filtered")
        state = check(state, ahead, step["ahead"], reading, f"step {k}, ahead") if ahead else after
    print(f"verified: {count} steps")


if __name__ == "__main__":
    main(sys.argv[1])
