#!/usr/bin/env python3
"""Times the exact filter against other exact arithmetic, interleaved, and checks that all results are equal.

    benches/compare.py                                  # the standard run; writes benches/RESULTS.md
    benches/compare.py --quick                          # one round of short cells, to see that all of it works
    benches/compare.py --cells small:2 double:8 --rounds 9
    benches/compare.py --report-only                    # writes RESULTS.md again from what was measured

Needs Python 3.9 or newer and a Rust toolchain. The peers (benches/requirements.txt) are installed into a virtual environment under
target/compare; `--python` names another one that has them. What was measured is kept in target/compare, a line of JSON for each run: an
interrupted run goes on where it stopped, and what a changed program or peer would measure anew is measured anew. `--fresh` forgets all.
"""

import argparse
import hashlib
import json
import os
import subprocess
import sys
import time
from pathlib import Path

import problems
import results

BENCHES = Path(__file__).resolve().parent
ROOT = BENCHES.parent
PLACE = Path(os.environ.get("CARGO_TARGET_DIR", ROOT / "target")) / "compare"

# Options of examples/throughput.rs, and whether all cores may be used.
OURS = {
    "ours": ([], False),
    "ours-cores": ([], True),
    "ours-lowest": (["--output", "lowest-terms"], False),
    "ours-digits": (["--output", "digits"], False),
    "ours-fraction-free": (["--route", "fraction-free"], False),
    "ours-multimodular": (["--route", "multimodular"], False),
}
ROUTES = ["ours-fraction-free", "ours-multimodular"]
EVERY_ROUND = ["fmpq", "fmpz", "ours", "ours-cores", "ours-lowest"]
ONCE = ["limit", "ours-digits", "sympy-flint", "sympy-python", "fraction"]
# Where these would take minutes.
TOO_SLOW = {(peer, "double", n) for peer in ("fraction", "sympy-python") for n in (8, 16)}
# Growth with T at n = 4, and with n at T = 10.
GROWTH = [(kind, 4, steps) for kind in problems.KINDS for steps in (25, 50, 100)]
GROWTH += [(kind, n, 10) for kind in problems.KINDS for n in (2, 4, 8, 16)]
# A problem of which the price is asked most often.
EXAMPLE = ("double", 4, 100)


def arguments():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--cells", nargs="+", default=["all"], help="`all`, `small`, `double:8`, `small:4:200` (n, T)")
    parser.add_argument("--rounds", type=int, default=5, help="rounds of the interleaved runs (5)")
    parser.add_argument("--seconds", type=float, default=0.2, help="a short run is repeated for this long (0.2)")
    parser.add_argument("--timeout", type=float, default=120, help="seconds after which one run is given up (120)")
    parser.add_argument("--long", action="store_true", help="the long horizons T = 400, 200, 60, 24 too, one round: an hour")
    parser.add_argument("--routes", action="store_true", help="each of our routes by itself too")
    parser.add_argument("--only", nargs="+", metavar="NAME", help=f"only these: {' '.join([*EVERY_ROUND, *ONCE, *ROUTES])}")
    parser.add_argument("--skip-growth", action="store_true", help="without the growth with T and n")
    parser.add_argument("--quick", action="store_true", help="one round, T = 10, n = 2 and 4, no growth")
    parser.add_argument("--fresh", action="store_true", help="forget what was measured before")
    parser.add_argument("--report-only", action="store_true", help="measure nothing")
    parser.add_argument("--python", help="a Python that has the peers")
    parser.add_argument("--output", type=Path, help="the report (benches/RESULTS.md; with --quick standard output)")
    return parser.parse_args()


def plan(options):
    """(name, cell, round, rounds) in the order of running: in a round and cell all take turns, in each round in another order."""
    allowed = options.only or [*EVERY_ROUND, *ONCE, *(ROUTES if options.routes else [])]
    if options.quick:
        cells, growth, rounds = problems.cells_of(["all"], {2: 10, 4: 10}), [], 1
    else:
        cells, rounds = problems.cells_of(options.cells), options.rounds
        growth = [] if options.skip_growth or options.cells != ["all"] else [*GROWTH, EXAMPLE]
    runs = []

    def add(names, cell, number, of):
        names = [name for name in names if name in allowed and (name, *cell[:2]) not in TOO_SLOW]
        turn = number % max(len(names), 1)
        runs.extend((name, cell, number, of) for name in names[turn:] + names[:turn])

    for number in range(rounds):
        for cell in cells:
            add(EVERY_ROUND + ROUTES, cell, number, rounds)
    for cell in cells:
        add(ONCE, cell, 0, 1)
    for number in range(min(rounds, 3)):
        for cell in growth:
            add(["fmpq", "fmpz", "ours", "ours-cores"] + ROUTES, cell, number, min(rounds, 3))
    if growth:
        add(["ours-digits"], EXAMPLE, 0, 1)
    if options.long:
        for cell in problems.cells_of(options.cells, problems.LONG_STEPS):
            add(EVERY_ROUND + ROUTES, cell, 0, 1)
    return list(dict.fromkeys(run[:3] for run in runs))


def peers_python(options):
    """A Python that has the peers."""
    if options.python:
        return options.python
    python, wanted = PLACE / "venv/bin/python", (BENCHES / "requirements.txt").read_text()
    stamp = PLACE / "venv/requirements.txt"
    if not stamp.exists() or stamp.read_text() != wanted:
        print("installing the peers", file=sys.stderr)
        subprocess.run([sys.executable, "-m", "venv", PLACE / "venv"], check=True)
        subprocess.run([python, "-m", "pip", "install", "--quiet", "-r", BENCHES / "requirements.txt"], check=True)
        stamp.write_text(wanted)
    return str(python)


def our_program():
    """The path of examples/throughput.rs, built."""
    command = ["cargo", "build", "--locked", "--release", "--example", "throughput", "--message-format", "json"]
    built = subprocess.run(command, cwd=ROOT, check=True, stdout=subprocess.PIPE, text=True)
    messages = (json.loads(line) for line in built.stdout.splitlines())
    return next(m["executable"] for m in messages if m.get("target", {}).get("name") == "throughput" and m.get("executable"))


def fingerprint(*files):
    return hashlib.sha256(b"".join(Path(file).read_bytes() for file in files)).hexdigest()[:16]


class Runner:
    def __init__(self, options):
        self.options = options
        self.ours, self.python = our_program(), peers_python(options)
        # The bytes of the built program stand for our sources, the toolchain and the options of the build.
        self.prints = {
            True: fingerprint(self.ours, BENCHES / "problems.py"),
            False: fingerprint(*(BENCHES / name for name in ("problems.py", "peers.py", "peer.py", "requirements.txt"))),
        }
        self.file = PLACE / "measured.jsonl"
        if options.fresh:
            self.file.unlink(missing_ok=True)
        self.known = {}
        if self.file.exists():
            text = self.file.read_text(encoding="utf-8")
            whole = text[: text.rfind("\n") + 1]
            if whole != text:  # A line was interrupted.
                self.file.write_text(whole, encoding="utf-8")
            self.known = {row["key"]: row for row in map(json.loads, whole.splitlines())}

    def key(self, name, cell, number):
        print_ = self.prints[name in OURS]
        return f"{name} {problems.cell_name(cell)} {number} {self.options.seconds:g} {print_}"

    def measured(self, name, cell, number):
        """The row of a run, from the file or by running."""
        key = self.key(name, cell, number)
        if key not in self.known and not self.options.report_only:
            row = {"key": key, "name": name, "cell": problems.cell_name(cell), "round": number, "load": os.getloadavg()[0]}
            row |= self.run(name, cell)
            self.known[key] = row
            with self.file.open("a", encoding="utf-8") as file:
                file.write(json.dumps(row) + "\n")
        return self.known.get(key)

    def run(self, name, cell):
        case = PLACE / f"{problems.cell_name(cell).replace(':', '-')}.json"
        case.write_text(json.dumps(problems.case(cell)), encoding="utf-8")
        environment = {**os.environ, "PYTHONHASHSEED": "0"}
        if name in OURS:
            extra, cores = OURS[name]
            command = [self.ours, str(case), "--seconds", str(self.options.seconds), *extra]
            if not cores:
                environment["RAYON_NUM_THREADS"] = "1"
        else:
            command = [self.python, str(BENCHES / "peer.py"), name, str(case), str(self.options.seconds)]
        try:
            ended = subprocess.run(
                command, env=environment, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True, timeout=self.options.timeout
            )
        except subprocess.TimeoutExpired:
            return {"given_up": self.options.timeout}
        if ended.returncode != 0:
            raise SystemExit(f"\n{' '.join(command)} failed:\n{ended.stderr}")
        return json.loads(ended.stdout)


def unequal(rows):
    """The cells in which results differ, with who found what."""
    found = {}
    for row in rows:
        if "hash_all" in row:
            found.setdefault(row["cell"], {}).setdefault((row["hash_last"], row["hash_all"]), set()).add(row["name"])
    return {cell: hashes for cell, hashes in found.items() if len(hashes) > 1}


def main():
    options = arguments()
    PLACE.mkdir(parents=True, exist_ok=True)
    runner, runs = Runner(options), plan(options)
    rows, start, given_up = [], time.monotonic(), set()
    for count, (name, cell, number) in enumerate(runs, 1):
        if (name, cell) in given_up:
            continue
        line = f"{count}/{len(runs)} {time.monotonic() - start:.0f} s  {name} {problems.cell_name(cell)} round {number + 1}"
        if sys.stderr.isatty():
            print(f"\r\033[K{line}", end="", file=sys.stderr, flush=True)
        elif count % 25 == 0:
            print(line, file=sys.stderr, flush=True)
        row = runner.measured(name, cell, number)
        if row is None:
            continue
        if "given_up" in row:
            given_up.add((name, cell))
        rows.append(row)
    print(f"\n{len(rows)} runs, {time.monotonic() - start:.0f} s", file=sys.stderr)
    if different := unequal(rows):
        raise SystemExit(f"results differ, nothing is written: {different}")
    if not rows:
        raise SystemExit("nothing was measured")
    text = results.report(rows, results.heading(ROOT, " ".join(["benches/compare.py", *sys.argv[1:]]), rows, options))
    target = options.output or (None if options.quick else BENCHES / "RESULTS.md")
    if target is None:
        print(text, end="")
    else:
        target.write_text(text, encoding="utf-8")
        print(f"wrote {target}", file=sys.stderr)


if __name__ == "__main__":
    try:
        main()
    except KeyboardInterrupt:
        raise SystemExit("\ninterrupted; the same command goes on from here") from None
