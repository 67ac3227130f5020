"""Instructions per iteration beside the crate levenberg-marquardt: they repeat where times do not.

    cargo build --release --bin fits
    python3 instructions.py [PROBLEM ...]

Needs valgrind. Each count is the difference of two and twelve fits, so that reading the files and
the first allocations drop out.
"""

import re
import statistics
import subprocess
import sys
from pathlib import Path

FITS = Path(__file__).parent / "target" / "release" / "fits"
OURS, PEER = "stillpoint", "levenberg-marquardt"


def run(*words):
    return subprocess.run(words, check=True, capture_output=True, text=True)


def instructions(solver, problem, rounds):
    tool = ["valgrind", "--tool=callgrind", "--callgrind-out-file=/dev/null"]
    done = run(*tool, FITS, solver, problem, str(rounds))
    return int(re.search(r"Collected : (\d+)", done.stderr)[1])


def per_iteration(solver, problem):
    jacobians = int(run(FITS, solver, problem, "1").stdout)
    spent = instructions(solver, problem, 12) - instructions(solver, problem, 2)
    return jacobians, spent / 10 / jacobians


def main():
    problems = sys.argv[1:] or run(FITS, "list").stdout.split()
    print(f"{'problem':14}{'Jacobians':>12}{'instructions per iteration':>28}{'ratio':>8}")
    totals, ratios = {OURS: [0, 0.0], PEER: [0, 0.0]}, []
    for problem in problems:
        found = {solver: per_iteration(solver, problem) for solver in (OURS, PEER)}
        (a, x), (b, y) = found[OURS], found[PEER]
        print(f"{problem:14}{a:6}{b:6}{x:14.0f}{y:14.0f}{x / y:8.2f}", flush=True)
        if problem == "accelerometer":
            continue
        ratios.append(x / y)
        for solver, (jacobians, each) in found.items():
            totals[solver][0] += jacobians
            totals[solver][1] += jacobians * each
    if ratios:
        (a, x), (b, y) = totals[OURS], totals[PEER]
        print(f"{'NIST, sum':14}{a:6}{b:6}{x / a:14.0f}{y / b:14.0f}{x / a / (y / b):8.2f}")
        print(f"NIST, median of the ratios {statistics.median(ratios):.2f}, whole fits {x / y:.2f}")


main()
