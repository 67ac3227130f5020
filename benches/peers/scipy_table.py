"""scipy's least_squares beside the default variant on the same published problems.

    cargo build --release -p stillpoint-benches
    python3 benches/peers/scipy_table.py [target/release]

Residuals and exact Jacobians come from `problem-server`, so both solve the same functions. scipy runs
`trf` and `lm` (unconstrained problems only) with x_scale="jac" and with its default scale, tolerances
at 1e-15 and at most 5000 evaluations; a problem counts as solved if any of them solves it. Starts
outside the bounds are clipped. least_squares has no linear constraints.
"""
import json
import subprocess
import sys
from pathlib import Path

import numpy as np
from scipy.optimize import least_squares

OPTIMALITY, VALUE = 1e-8, 1e-6
root = Path(__file__).resolve().parents[2]
binaries = Path(sys.argv[1]) if len(sys.argv) > 1 else root / "target" / "release"
server = subprocess.Popen([binaries / "problem-server"], stdin=subprocess.PIPE, stdout=subprocess.PIPE, text=True)


def ask(request):
    server.stdin.write(json.dumps(request) + "\n")
    server.stdin.flush()
    return json.loads(server.stdout.readline())


def numbers(values, missing):
    return np.array([missing if v is None else v for v in values], dtype=float)


def evaluate(case, x):
    answer = ask({"case": case, "x": [float(v) for v in x]})
    jacobian = np.array([numbers(row, np.nan) for row in answer["jacobian"]])
    return numbers(answer["r"], np.nan), jacobian, answer["optimality"]


def is_minimum(value, minima):
    return any(abs(value - m) <= VALUE * (m if m > 0 else 1.0) for m in minima)


def run(case, problem, method, scale):
    start = np.array(problem["start"])
    options = dict(method=method, x_scale=scale, xtol=1e-15, ftol=1e-15, gtol=1e-15, max_nfev=5000)
    if problem["lower"]:
        lower, upper = numbers(problem["lower"], -np.inf), numbers(problem["upper"], np.inf)
        start = np.clip(start, lower, upper)
        options["bounds"] = (lower, upper)
    try:
        found = least_squares(lambda x: evaluate(case, x)[0], start, jac=lambda x: evaluate(case, x)[1], **options)
    except Exception as error:  # scipy raises on NaN and on m < n with lm
        return None, str(error)
    residuals, _, optimality = evaluate(case, found.x)
    value = float(residuals @ residuals)
    solved = is_minimum(value, problem["minima"]) and optimality is not None and optimality <= OPTIMALITY
    return solved, f"{value:.6e} ({optimality:.0e})"


ours = {(o["group"], o["problem"]): o for o in json.loads(subprocess.check_output([binaries / "problem-table", "--json"]))}
columns = [("trf", "jac"), ("trf", 1.0), ("lm", "jac"), ("lm", 1.0)]
counts = {}
print("| group | problem | stillpoint | " + " | ".join(f"{m} x_scale={s}" for m, s in columns) + " |")
print("|---|---|---|" + "---|" * len(columns))
for case, problem in enumerate(ask({"list": True})):
    group = problem["group"]
    mine = ours[(group, problem["name"])]
    cells, outcomes = [], []
    for method, scale in columns:
        if problem["linear"] or (method == "lm" and group != "unconstrained"):
            cells.append("-")
            outcomes.append(None)
            continue
        solved, text = run(case, problem, method, scale)
        outcomes.append(bool(solved))
        cells.append("yes" if solved else f"NO {text}")
    tally = counts.setdefault(group, [0] * (len(columns) + 3))
    tally[0] += 1
    tally[1] += mine["solved"]
    for k, solved in enumerate(outcomes):
        tally[2 + k] += bool(solved)
    tally[-1] += any(outcomes)
    own = "yes" if mine["solved"] else f"NO {mine['sum_of_squares']:.6e} ({mine['optimality']:.0e})"
    print(f"| {group} | {problem['name']} | {own} | " + " | ".join(cells) + " |")
print()
print("| group | problems | stillpoint | " + " | ".join(f"{m} x_scale={s}" for m, s in columns) + " | any of scipy's |")
print("|---|---|---|" + "---|" * (len(columns) + 1))
for group, tally in counts.items():
    print(f"| {group} | " + " | ".join(str(v) for v in tally) + " |")
