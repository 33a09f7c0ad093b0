"""The answers of the solvers, in a table: see check.sh."""

import os
import re
import subprocess
import sys
import time
from concurrent.futures import ThreadPoolExecutor
from fractions import Fraction
from pathlib import Path

from make.catalogue import files

HERE = Path(__file__).resolve().parent
SPECIFICATION = HERE.parent.parent / "SPEC.md"
SECONDS = 60
HEADER = ["Identifiers", "Statement", "Size", "Expect"]

# One file in a process of its own, so that it can be stopped.
BITWUZLA = """
import bitwuzla, sys
terms, options = bitwuzla.TermManager(), bitwuzla.Options()
options.set(bitwuzla.Option.PRODUCE_MODELS, True)
parser = bitwuzla.Parser(terms, options)
parser.parse(sys.argv[1], True, True)
solver = parser.bitwuzla()
answer = str(solver.check_sat()).split(".")[-1].lower()
print(answer)
if answer == "sat":
    for symbol in parser.get_declared_funs():
        print(symbol, "".join(solver.get_value(symbol).value(2)))
"""


def headers(text):
    """The lines `; Word: …` before the first command."""
    found = {}
    for line in text.splitlines():
        if not line.startswith(";"):
            break
        if match := re.match(r"; ([A-Z][a-z]+): (.+)$", line):
            found.setdefault(match[1], match[2])
    return found


def faults(name, text, known):
    """What is wrong with a file before anything is asked."""
    found = headers(text)
    for word in HEADER:
        if word not in found:
            yield f"{name}: no line '; {word}: …'"
    for identifier in found.get("Identifiers", "none").split(", "):
        if identifier != "none" and identifier not in known:
            yield f"{name}: {identifier} is no entry of SPEC.md"
    if found.get("Expect") not in ("sat", "unsat"):
        yield f"{name}: expects neither sat nor unsat"
    if (found.get("Expect") == "sat") and "Control" not in found:
        yield f"{name}: only a control may expect sat"
    if text.count("(check-sat)") != 1:
        yield f"{name}: one statement a file"


def decimal(bits):
    """A binary16 number, exactly."""
    sign, exponent, fraction = bits[0], int(bits[1:6], 2), int(bits[6:], 2)
    if exponent == 31:
        return ("-" if sign == "1" else "") + ("NaN" if fraction else "infinity")
    value = Fraction(fraction + 1024 * (exponent > 0), 1024) * Fraction(2) ** (max(exponent, 1) - 15)
    return repr(float(-value if sign == "1" else value))


def ask(path):
    """The answer, how long it took, and the counter-example in decimal if there is one in floating point."""
    floating = "(set-logic QF_FP)" in path.read_text(encoding="utf-8")
    bin_directory = Path(sys.executable).parent
    command = [sys.executable, "-c", BITWUZLA, str(path)] if floating else [str(bin_directory / "z3"), str(path)]
    start = time.monotonic()
    try:
        done = subprocess.run(command, capture_output=True, text=True, timeout=SECONDS, check=False)
        lines = done.stdout.split("\n")
        answer = lines[0] if lines[0] in ("sat", "unsat", "unknown") else f"error: {(done.stdout + done.stderr).strip()[-200:]}"
    except subprocess.TimeoutExpired:
        return "time out", time.monotonic() - start, ""
    model = ", ".join(f"{word} = {decimal(bits)}" for word, bits in (line.split() for line in lines[1:] if line)) if floating else ""
    return answer, time.monotonic() - start, model


def main(words):
    known = set(re.findall(r"^### (\S+)", SPECIFICATION.read_text(encoding="utf-8"), re.MULTILINE))
    texts = {str(path.relative_to(HERE)): path.read_text(encoding="utf-8") for path in sorted(HERE.glob("**/*.smt2"))}
    wrong = [fault for name, text in texts.items() for fault in faults(name, text, known)]
    written = files()
    wrong += [f"{name}: differs from what 'python3 -m make' writes" for name in sorted(texts.keys() | written.keys()) if texts.get(name) != written.get(name)]
    chosen = [name for name in texts if not words or any(word in name for word in words)]
    width = max(map(len, chosen), default=0)
    print(f"{'statement':{width}}  {'size':44}  expected  found   seconds")
    start = time.monotonic()
    with ThreadPoolExecutor(os.cpu_count()) as pool:
        for name, (answer, seconds, model) in zip(chosen, pool.map(lambda name: ask(HERE / name), chosen)):
            found = headers(texts[name])
            expected = found.get("Expect", "")
            print(f"{name:{width}}  {found.get('Size', ''):44}  {expected:8}  {answer:6}  {seconds:7.2f}  {model}".rstrip(), flush=True)
            if answer != expected:
                wrong.append(f"{name}: {answer} instead of {expected}")
    statements = sum("Control" not in headers(texts[name]) for name in chosen)
    print(f"{statements} statements, {len(chosen) - statements} controls, {time.monotonic() - start:.0f} s")
    for fault in wrong:
        print(f"check.sh: {fault}", file=sys.stderr)
    return 1 if wrong or not chosen else 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
