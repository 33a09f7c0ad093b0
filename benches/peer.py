"""Runs one peer on one case file: `peer.py NAME CASE SECONDS`. Prints what `examples/throughput.rs` prints, as JSON."""

import json
import math
import os
import statistics
import sys
import time

PRIME = 2**61 - 1


def peak_of_memory():
    """The most memory that this process has ever held, in KiB, where the system tells (Linux)."""
    try:
        with open("/proc/self/status", encoding="utf-8") as file:
            return next(int(line.split()[1]) for line in file if line.startswith("VmHWM:"))
    except (OSError, StopIteration):
        return None


def hashed(peer, steps):
    """The entries modulo 2^61 - 1, as the digits of one number."""
    value, inverse_of = 0, (None, None)
    for step in steps:
        for numerator, denominator in peer.entries(step):
            if inverse_of[0] is not denominator:
                inverse_of = denominator, pow(int(denominator % PRIME), -1, PRIME)
            value = (value * 1000003 + int(numerator % PRIME) * inverse_of[1]) % PRIME
    return value


def bits(peer, step, n):
    """The length of the least common denominator of P."""
    denominators = []
    for count, (numerator, denominator) in enumerate(peer.entries(step)):
        if count == n * n:
            break
        numerator, denominator = int(numerator), int(denominator)
        denominators.append(denominator // math.gcd(numerator, denominator))
    return math.lcm(*denominators).bit_length()


def main():
    name, case, seconds = sys.argv[1], sys.argv[2], float(sys.argv[3])
    if name.startswith("sympy-"):
        os.environ["SYMPY_GROUND_TYPES"] = name.removeprefix("sympy-")
    import peers
    import problems

    peer = peers.PEERS[name]()
    problem = problems.Problem(case)
    prepared = peer.prepared(problem)
    before, cpu, wall = peak_of_memory(), [], []
    steps = None
    while sum(wall) < seconds or not wall:
        # Let go of the last run's results before the clock starts: nobody holds two, and freeing is not timed.
        steps = None
        start = time.process_time(), time.perf_counter()
        steps = peer.run(prepared)
        wall.append(time.perf_counter() - start[1])
        cpu.append(time.process_time() - start[0])
    memory = peak_of_memory()
    # The first of several runs warms the machine up, and does not count.
    counted = slice(1, None) if len(wall) > 1 else slice(None)
    report = {
        "cpu": statistics.median(cpu[counted]),
        "wall": statistics.median(wall[counted]),
        "runs": len(wall),
        "memory_before": before,
        "memory": memory,
        "version": peer.version,
    }
    if steps is not None:
        count, n = len(steps), len(problem.A)
        report["hash_last"], report["hash_all"] = hashed(peer, steps[-1:]), hashed(peer, steps)
        if name == "fmpq":
            marks = sorted({count, max(count // 2, 1)})
            report["lowest_bits"] = {str(mark): bits(peer, steps[mark - 1], n) for mark in marks}
    print(json.dumps(report))


if __name__ == "__main__":
    main()
