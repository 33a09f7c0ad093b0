"""Writes the report of compare.py from what was measured."""

import datetime
import math
import os
import platform
import statistics
import subprocess
from collections import defaultdict

# Goals: how many times the CPU seconds of `ours` a peer takes.
CANONICAL_GOAL = 3
SLOW = {"sympy-flint": "sympy, flint", "sympy-python": "sympy, python", "fraction": "Fraction"}
ROUTES = {"ours-fraction-free": "fraction-free", "ours-multimodular": "multi-modular"}


def fmpq_goal(n):
    return 20 if n >= 8 else 10


def fmpz_goal(n):
    return 2 if n >= 8 else 1


def output_of(command, place):
    try:
        return subprocess.run(command, cwd=place, stdout=subprocess.PIPE, stderr=subprocess.DEVNULL, text=True).stdout.strip()
    except OSError:
        return ""


def processor():
    try:
        with open("/proc/cpuinfo", encoding="utf-8") as file:
            return next(line.split(":", 1)[1].strip() for line in file if line.startswith("model name"))
    except (OSError, StopIteration):
        return platform.processor() or platform.machine()


def memory():
    try:
        return f"{os.sysconf('SC_PAGE_SIZE') * os.sysconf('SC_PHYS_PAGES') / 2**30:.0f} GiB"
    except (ValueError, OSError):
        return "memory unknown"


def heading(root, command, rows, options):
    changed = output_of(["git", "status", "--porcelain", "--untracked-files=no"], root)
    commit = output_of(["git", "rev-parse", "--short", "HEAD"], root) or "unknown"
    loads = sorted(row["load"] for row in rows)
    versions = sorted({row["version"] for row in rows if "version" in row})
    return [
        "# What exactness costs",
        "",
        "Written by `benches/compare.py`; `benches/README.md` says what each number means. Do not edit.",
        "",
        f"* {datetime.date.today().isoformat()}, `{command}`, commit {commit}{' with changes' if changed else ''}",
        f"* {processor()}, {os.cpu_count()} cores, {memory()}, {platform.system()} {platform.release()}; load before a run: median"
        f" {statistics.median(loads):.1f}, at most {loads[-1]:.1f} (the run itself is about 1)",
        f"* {output_of(['rustc', '-V'], root)}, release, default features; Python {platform.python_version()}",
        *(f"* {version}" for version in versions),
    ]


class Measured:
    """What was measured, by cell and name."""

    def __init__(self, rows):
        self.rows = defaultdict(lambda: defaultdict(dict))
        for row in rows:
            kind, n, steps = row["cell"].split(":")
            self.rows[kind, int(n), int(steps)][row["name"]][row["round"]] = row

    def cells(self, *names):
        """The cells in which all of these were measured, short runs first."""
        return [cell for cell in sorted(self.rows, key=order) if all(self.time(cell, name) is not None for name in names)]

    def values(self, cell, name, field):
        rounds = self.rows[cell][name] if name in self.rows[cell] else {}
        return {number: row[field] for number, row in rounds.items() if row.get(field) is not None}

    def time(self, cell, name, field="cpu"):
        values = self.values(cell, name, field)
        return statistics.median(values.values()) if values else None

    def given_up(self, cell, name):
        return any("given_up" in row for row in self.rows[cell].get(name, {}).values())

    def ratios(self, cell, name, other="ours", field="cpu"):
        """name / other in each round in which both ran."""
        left, right = self.values(cell, name, field), self.values(cell, other, field)
        return sorted(left[number] / right[number] for number in left.keys() & right.keys())

    def one(self, cell, name, field):
        values = self.values(cell, name, field)
        return values[min(values)] if values else None

    def added_memory(self, cell, name):
        """KiB above what the process held before its first step."""
        rounds = self.rows[cell].get(name, {}).values()
        added = [row["memory"] - row["memory_before"] for row in rounds if row.get("memory") and row.get("memory_before")]
        return statistics.median(added) if added else None


def order(cell):
    kind, n, steps = cell
    return kind != "small", n, steps


def label(cell):
    return f"{cell[0]}, n = {cell[1]}, T = {cell[2]}"


def seconds(value):
    return "–" if value is None else f"{value:.2f}" if value >= 10 else f"{value:.3g}" if value >= 1 else f"{value:.4f}"


def times(value):
    return f"{value:.2f}" if value < 10 else f"{value:.1f}" if value < 100 else f"{value:.0f}"


def ratio(values, goal=None):
    if not values:
        return "–"
    middle = statistics.median(values)
    text = times(middle)
    if len(values) > 1:
        text += f" ({times(values[0])}–{times(values[-1])})"
    return text if goal is None else f"{text} {'✓' if middle >= goal else '✗'}"


def table(head, rows):
    if not rows:
        return ["Not measured."]
    return ["| " + " | ".join(head) + " |", "|" + " --- |" * len(head), *("| " + " | ".join(row) + " |" for row in rows)]


def speed(measured):
    rows, missed, count = [], [], 0
    for cell in measured.cells("fmpq", "ours", "ours-lowest"):
        n = cell[1]
        goals = [
            ("fmpq_mat", measured.ratios(cell, "fmpq"), fmpq_goal(n)),
            ("fmpz", measured.ratios(cell, "fmpz"), fmpz_goal(n)),
            ("fmpq_mat in lowest terms", measured.ratios(cell, "fmpq", "ours-lowest"), CANONICAL_GOAL),
        ]
        for name, values, goal in goals:
            count += bool(values)
            if values and statistics.median(values) < goal:
                missed.append(f"* {label(cell)}: {statistics.median(values):.2f} times {name}, wanted {goal}")
        rows.append(
            [
                label(cell),
                *(seconds(measured.time(cell, name)) for name in ("fmpq", "fmpz", "ours")),
                seconds(measured.time(cell, "ours-cores", "wall")),
                seconds(measured.time(cell, "ours-lowest")),
                *(ratio(values, goal) for _, values, goal in goals),
                ratio(measured.ratios(cell, "fmpq", "ours-cores", "wall")),
            ]
        )
    head = ["problem", "fmpq_mat, s", "fmpz, s", "ours, s", "ours on all cores, wall s", "ours in lowest terms, s"]
    head += ["fmpq_mat / ours", "fmpz / ours", "fmpq_mat / ours in lowest terms", "fmpq_mat / ours on all cores, wall"]
    text = [
        "Medians of CPU seconds of one thread, but where it says wall; medians of the ratio of each round, with the least and the"
        " largest. Goals: fmpq_mat / ours ≥ 10, and ≥ 20 for n ≥ 8; fmpz / ours ≥ 1, and ≥ 2 for n ≥ 8; with our results in lowest"
        " terms, as fmpq_mat's are, ≥ 3. The goals are for these horizons; at shorter ones what does not depend on the length of the"
        " numbers weighs more, and all ratios are smaller (see *Growth with T*).",
        "",
        *table(head, rows),
        "",
        f"{count - len(missed)} of {count} goals are reached." + (" Missed:" if missed else ""),
    ]
    return text + ([""] + missed if missed else [])


def routes(measured):
    present = [name for name in ROUTES if measured.cells(name)]
    rows = [
        [label(cell), seconds(measured.time(cell, "ours")), *(seconds(measured.time(cell, name)) for name in present)]
        for cell in measured.cells("ours", *present)
    ]
    return table(["problem", "fastest, s", *(f"{ROUTES[name]}, s" for name in present)], rows) if present else []


def others(measured):
    rows = []
    for cell in measured.cells("ours", "sympy-flint"):
        texts = []
        for name in SLOW:
            ours, theirs = measured.time(cell, "ours"), measured.time(cell, name)
            if measured.given_up(cell, name):
                texts.append("given up")
            elif theirs is None:
                texts.append("not run")
            else:
                texts.append(f"{seconds(theirs)} ({times(theirs / ours)}×)")
        rows.append([label(cell), seconds(measured.time(cell, "ours")), *texts])
    return table(["problem", "ours, s", *(f"{text}, s" for text in SLOW.values())], rows)


def size(measured):
    rows = []
    for cell in measured.cells("ours", "fmpq"):
        steps, n = cell[2], cell[1]
        ours, lowest = measured.one(cell, "ours", "bits") or {}, measured.one(cell, "fmpq", "lowest_bits") or {}
        end, half = str(steps), str(max(steps // 2, 1))
        slope = (ours[end] - ours[half]) / (steps - steps // 2) if end in ours and steps > 1 else None
        # The common denominator cannot be shorter.
        excess = f"{ours[end] / lowest[end]:.2f}" if end in ours and end in lowest else "–"
        memories = [measured.added_memory(cell, name) for name in ("ours", "ours-cores", "fmpq", "fmpz")]
        output = measured.one(cell, "ours", "output")
        rows.append(
            [
                label(cell),
                *(f"{found[end]:,}" if end in found else "–" for found in (ours, lowest)),
                excess,
                "–" if slope is None else f"{slope:.0f}",
                "–" if slope is None else f"{slope / n:.0f}",
                "–" if output is None else f"{output / 8e6:.2f}",
                *("–" if value is None else f"{value / 1024:.1f}" for value in memories),
            ]
        )
    head = ["problem", "bits of our denominator at T", "in lowest terms", "ours / lowest", "bits per step, from T/2 to T", "per step and n"]
    head += ["our output, MB", "memory added, MiB: ours", "ours on all cores", "fmpq_mat", "fmpz"]
    return table(head, rows)


def exponent(small, large, from_, to):
    return "–" if not small or not large else f"{math.log(large / small) / math.log(to / from_):.2f}"


def last_bits(measured, cell):
    return (measured.one(cell, "ours", "bits") or {}).get(str(cell[2]))


def growth(measured, axis):
    """Rows of cells that differ in T (axis 2) or n (axis 1) alone, with the exponent from one to the next."""
    families = defaultdict(list)
    for cell in measured.cells("ours", "fmpq"):
        families[cell[0], cell[3 - axis]].append(cell)
    rows = []
    for (_, fixed), cells in sorted(families.items(), key=lambda item: (item[0][0] != "small", item[0][1])):
        for before, cell in zip([None, *cells], cells):
            if len(cells) < 3 or (axis == 1 and fixed != 10):
                continue
            texts = []
            for name in ("fmpq", "fmpz", "ours"):
                now = measured.time(cell, name)
                step = exponent(measured.time(before, name), now, before[axis], cell[axis]) if before else ""
                texts += [seconds(now), step]
            now, past = (last_bits(measured, each) if each else None for each in (cell, before))
            texts += ["–" if now is None else f"{now:,}", exponent(past, now, before[axis], cell[axis]) if before else ""]
            rows.append([label(cell), *texts])
    return table(["problem", "fmpq_mat, s", "exponent", "fmpz, s", "exponent", "ours, s", "exponent", "bits of our denominator at T", "exponent"], rows)


def limit(measured):
    rows = []
    for cell in measured.cells("ours", "limit"):
        products = measured.time(cell, "limit")
        cores = measured.time(cell, "ours-cores", "wall")
        both = "–" if cores is None else f"{cores / products:.1f}"
        rows.append([label(cell), seconds(products), seconds(measured.time(cell, "ours")), f"{measured.time(cell, 'ours') / products:.1f}", both])
    return table(["problem", "products, s", "ours, s", "ours / products", "ours on all cores, wall / products"], rows)


def digits(measured):
    rows = [
        [
            label(cell),
            *(seconds(measured.time(cell, name)) for name in ("fmpq", "ours", "ours-digits")),
            seconds(measured.time(cell, "ours-digits", "wall")),
        ]
        for cell in measured.cells("ours", "ours-digits")
    ]
    return table(["problem", "fmpq_mat, s", "ours, s", "ours, 17 digits of all results as text, s", "the same, wall s"], rows)


def report(rows, head):
    measured = Measured(rows)
    hashed = [row for row in rows if "hash_all" in row]
    compared = {(row["cell"], row["name"]) for row in hashed}
    cells = {row["cell"] for row in hashed}
    parts = [
        ("Are the results equal?", [
            f"Yes: {len(hashed)} runs of {len({name for _, name in compared})} programs on {len(cells)} problems. In each problem all give the same P"
            " and x̂, entry by entry modulo 2⁶¹ − 1, at the last step and over all steps. Else this page would not have been written.",
        ]),
        ("Speed", speed(measured)),
        ("Our routes", routes(measured)),
        ("Digits", ["Every entry of P (one triangle) and x̂ of every step as a decimal.", "", *digits(measured)]),
        ("Other peers", ["CPU seconds of one run; in brackets, times ours.", "", *others(measured)]),
        ("Bits and memory", size(measured)),
        ("Growth with T", [
            "Where the bits of the denominator grow linearly with t (exponent 1), T steps cost the sum of M(c t), t up to T: T² if products"
            " were linear, T^2.58 by Karatsuba's, T³ by those of the school.", "", *growth(measured, 2),
        ]),
        ("Growth with n", [
            "Elimination does some (n + m)³ products; where the bits are proportional to n (exponent 1), that is n⁴ if products were linear,"
            " n^4.58 by Karatsuba's, n⁵ by those of the school; less while n is so small that other work counts.", "", *growth(measured, 1),
        ]),
        ("The limit", [
            "One FLINT product for each entry of P and x̂ of every step, both factors as long as the entry: nothing is computed by it.", "", *limit(measured),
        ]),
    ]
    text = list(head)
    for title, lines in parts:
        if lines:
            text += ["", f"## {title}", "", *lines]
    return "\n".join(text) + "\n"
