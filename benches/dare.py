#!/usr/bin/env python3
"""Judges solvers of discrete algebraic Riccati equations in doubles by proved solutions.

    benches/dare.py                          # the table of docs/DARE.md, on standard output
    benches/dare.py --only darex-12 rod-30   # some models
    benches/dare.py --solutions FILE         # the solutions by other means too, as tests/agree/dare.json has them; needs python-flint

Needs Python 3.9 or newer with numpy, and a Rust toolchain, or `--program`. Judged is what is installed of SciPy (pip install scipy), SLICOT (pip install
slycot; needs gfortran, cmake and a BLAS) and Octave (apt-get install octave octave-control); what is missing is named and left out.

The models are those of examples/steady/dare and examples/steady/hard; their numbers are doubles, so that all solve the same equation. Digits are
-log10 of the largest |error| of an entry in the unit sqrt(|x_ii x_jj|); entries whose unit is zero are left out.
"""

import argparse
import json
import math
import subprocess
import sys
import time
import warnings
from fractions import Fraction
from pathlib import Path

import numpy

import dare_peers

ROOT = Path(__file__).resolve().parent.parent
FOLDERS = [ROOT / "examples/steady/dare", ROOT / "examples/steady/hard"]
PEERS = [
    dare_peers.Scipy,
    lambda: dare_peers.Slycot("sb02od"),
    lambda: dare_peers.Slycot("sb02md"),
    dare_peers.Octave,
]
# Bits of the solutions by other means, and the digits of them that are kept.
BITS = 1000
KEPT = 40


def arguments():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--only", nargs="+", metavar="ID", help="only these models")
    parser.add_argument("--digits", type=int, default=30, help="digits that are to be proved (30)")
    parser.add_argument("--timeout", type=float, default=600, help="seconds after which a proof is given up (600)")
    parser.add_argument("--program", help="exact-kalman; built with --release if not given")
    parser.add_argument("--solutions", metavar="FILE", help="write the solutions by doubling in FLINT's numbers, and judge nobody")
    return parser.parse_args()


def program(given):
    if given:
        return given
    subprocess.run(["cargo", "build", "--release", "--locked", "--quiet"], cwd=ROOT, check=True)
    return str(ROOT / "target/release/exact-kalman")


def models(only):
    paths = sorted(path for folder in FOLDERS for path in folder.glob("*.json"))
    for path in paths:
        model = json.loads(path.read_text(encoding="utf-8"))
        if not only or model["id"] in only:
            yield path, model


def equation(model):
    """a, b, q, r, s of X = A'XA - (A'XB + S)(R + B'XB)^-1 (B'XA + S') + Q, as doubles."""

    def of(rows):
        return numpy.array([[float(entry) for entry in row] for row in rows])

    if "control" in model:
        control = model["control"]
        a, b, q, r = (of(control[name]) for name in "abqr")
        cross = control.get("s")
    else:
        if model["timing"] != "departing":
            raise SystemExit(f"{model['id']}: only departing models are judged")
        noise = model["noise"]
        a, b = of(model["transition"]).T, of(model["observation"]).T
        q, r, cross = of(noise["process"]), of(noise["observation"]), noise.get("cross")
    return a, b, q, r, of(cross) if cross else numpy.zeros(b.shape)


def proved(command, path, digits, timeout):
    """The verdict, the seconds, and the solution as fractions, which are right to the digits."""
    start = time.perf_counter()
    # More digits than are judged, so that the rounding of what is printed does not count.
    line = [command, "steady", "--format", "json", "--digits", str(digits), str(path)]
    try:
        told = subprocess.run(line, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True, timeout=timeout)
    except subprocess.TimeoutExpired:
        return {"verdict": f"more than {timeout:.0f} s"}, timeout, None
    seconds = time.perf_counter() - start
    if not told.stdout:
        raise SystemExit(f"{path}: {told.stderr}")
    answer = json.loads(told.stdout)
    if answer["verdict"] != "stabilising":
        return answer, seconds, None
    matrices = answer["matrices"]
    name = next(name for name in ("solution_X", "predicted_covariance") if name in matrices)
    return answer, seconds, [[Fraction(entry) for entry in row] for row in matrices[name]["value"]]


def digits_of(answer, truth):
    """Digits of doubles; infinite where all are right."""
    worst = 0.0
    for i, row in enumerate(truth):
        for j, entry in enumerate(row):
            unit = math.sqrt(abs(truth[i][i] * truth[j][j]))
            found = float(answer[i][j])
            if not math.isfinite(found):
                return -math.inf
            if unit > 0:
                worst = max(worst, abs(float(Fraction(found) - entry)) / unit)
    return -math.log10(worst) if worst else math.inf


def judged(peer, model, truth):
    try:
        with warnings.catch_warnings():
            warnings.simplefilter("ignore")
            answer, seconds = peer.solve(*equation(model))
    except Exception as error:  # Whatever a solver raises is its answer.
        print(f"{model['id']}: {peer.name}: {error!r}", file=sys.stderr)
        return "error"
    if truth is None:
        return "answers"
    digits = digits_of(answer, truth)
    text = "≥ 17" if digits == math.inf else "none" if digits < 0.5 else f"{digits:.1f}"
    return f"{text} ({shown(seconds)})"


def shown(seconds):
    if seconds < 0.1:
        return f"{seconds * 1000:.2g} ms"
    return f"{seconds:.2g} s" if seconds < 100 else f"{seconds:.0f} s"


def solutions(chosen, place):
    """Decimals of the diagonal and of the first row of X."""
    found = {}
    for _, model in chosen:
        if model["id"].startswith("absent"):
            continue
        try:
            x = dare_peers.doubled(*equation(model), BITS)
        except ValueError as error:
            print(f"{model['id']}: {error}", file=sys.stderr)
            continue
        n = x.nrows()
        found[model["id"]] = {
            "diagonal": [x[i, i].mid().str(KEPT, radius=False) for i in range(n)],
            "first": [x[0, j].mid().str(KEPT, radius=False) for j in range(n)],
        }
        print(model["id"], file=sys.stderr)
    Path(place).write_text(json.dumps(found, indent=1) + "\n", encoding="utf-8")


def main():
    options = arguments()
    chosen = list(models(options.only))
    if options.solutions:
        return solutions(chosen, options.solutions)
    peers = []
    for make in PEERS:
        try:
            peers.append(make())
        except dare_peers.Missing as missing:
            print(f"left out: {missing}", file=sys.stderr)
    command = program(options.program)
    print("Judged: " + "; ".join(peer.version for peer in peers) + ".\n")
    print("| model | n | m | exact-kalman | " + " | ".join(peer.name for peer in peers) + " |")
    print("|---|--:|--:|---|" + "---|" * len(peers))
    for path, model in chosen:
        answer, seconds, truth = proved(command, path, options.digits, options.timeout)
        ours = answer["verdict"]
        if truth is not None:
            ours = "exact" if answer["digits"] is None else f"{answer['digits']} digits"
        a, b = equation(model)[:2]
        cells = [judged(peer, model, truth) for peer in peers]
        print(f"| {model['id']} | {len(a)} | {b.shape[1]} | {ours} ({shown(seconds)}) | " + " | ".join(cells) + " |", flush=True)
    return None


if __name__ == "__main__":
    sys.exit(main())
