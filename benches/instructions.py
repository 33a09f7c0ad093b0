#!/usr/bin/env python3
"""Counts the instructions of one run of the exact filter with valgrind: the same number on a busy machine as on an idle one.

    benches/instructions.py                             # every cell with T = 10, 10, 5, 3
    benches/instructions.py --save before.json          # ... keeps the counts
    benches/instructions.py --against before.json       # ... and what has changed since
    benches/instructions.py --cells double:8:20 --route multimodular

Needs valgrind and a Rust toolchain. A program that runs the filter twice minus one that runs it once is one run, without reading the case
and starting up. Instructions are no seconds: memory and the cores' parallel work are not in them.
"""

import argparse
import json
import os
import re
import subprocess
import sys
import tempfile
from pathlib import Path

import problems
from compare import PLACE, our_program

STEPS = {2: 10, 4: 10, 8: 5, 16: 3}


def counted(program, case, runs, route):
    """All instructions of a program that runs the filter so many times."""
    with tempfile.NamedTemporaryFile() as out:
        command = ["valgrind", "--tool=callgrind", f"--callgrind-out-file={out.name}", program, str(case)]
        command += ["--seconds", "0", "--runs", str(runs), "--route", route]
        environment = {**os.environ, "RAYON_NUM_THREADS": "1"}
        ended = subprocess.run(command, env=environment, stdout=subprocess.DEVNULL, stderr=subprocess.PIPE, text=True)
    found = re.search(r"Collected : (\d+)", ended.stderr)
    if ended.returncode != 0 or not found:
        raise SystemExit(f"{' '.join(command)} failed:\n{ended.stderr}")
    return int(found[1])


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--cells", nargs="+", default=["all"])
    parser.add_argument("--route", default="fastest", choices=["fastest", "fraction-free", "multimodular"])
    parser.add_argument("--save", type=Path)
    parser.add_argument("--against", type=Path)
    options = parser.parse_args()
    before = json.loads(options.against.read_text()) if options.against else {}
    PLACE.mkdir(parents=True, exist_ok=True)
    program, counts = our_program(), {}
    for cell in problems.cells_of(options.cells, STEPS):
        name = f"{problems.cell_name(cell)} {options.route}"
        case = PLACE / f"{problems.cell_name(cell).replace(':', '-')}.json"
        case.write_text(json.dumps(problems.case(cell)), encoding="utf-8")
        counts[name] = counted(program, case, 2, options.route) - counted(program, case, 1, options.route)
        change = f"  {counts[name] / before[name] - 1:+.1%}" if name in before else ""
        print(f"{name:32} {counts[name]:>16,}{change}", flush=True)
    if options.save:
        options.save.write_text(json.dumps(counts, indent=1) + "\n")
    return 0


if __name__ == "__main__":
    sys.exit(main())
