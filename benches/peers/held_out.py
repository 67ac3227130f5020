"""scipy's least_squares beside the default variant on the held-out problems, from the same starts.

    cargo build -p stillpoint-benches
    python3 benches/peers/held_out.py [target/debug]

Residuals and exact Jacobians come from `problem-server`. The least cost known is the lowest of scipy's (trf, lm
and dogbox, each with x_scale="jac" and 1, tolerances 1e-15, at most 3000 evaluations) and ours. Printed
are the endings that are false: at the least cost without saying so, or above it with "converged".
"""
import json
import subprocess
import sys
from pathlib import Path

import numpy as np
from scipy.optimize import least_squares

root = Path(__file__).resolve().parents[2]
command = [sys.argv[1], *sys.argv[2:]] if len(sys.argv) > 2 else [
    (Path(sys.argv[1]) if len(sys.argv) > 1 else root / "target" / "debug") / "problem-server", "--held-out"]
server = subprocess.Popen(command, stdin=subprocess.PIPE, stdout=subprocess.PIPE, text=True)


def ask(request):
    server.stdin.write(json.dumps(request) + "\n")
    server.stdin.flush()
    return json.loads(server.stdout.readline())


def numbers(values, missing):
    return np.array([missing if v is None else v for v in values], dtype=float)


def evaluate(case, x):
    answer = ask({"case": case, "x": [float(v) for v in x]})
    return numbers(answer["r"], np.nan), np.array([numbers(row, np.nan) for row in answer["jacobian"]])


def run(case, problem, method, scale):
    start = np.array(problem["start"], dtype=float)
    options = dict(method=method, x_scale=scale, xtol=1e-15, ftol=1e-15, gtol=1e-15, max_nfev=3000)
    if problem["lower"]:
        if method == "lm":
            return np.inf
        lower, upper = numbers(problem["lower"], -np.inf), numbers(problem["upper"], np.inf)
        options["bounds"] = (lower, upper)
        start = np.clip(start, lower, upper)
    try:
        found = least_squares(lambda x: evaluate(case, x)[0], start, jac=lambda x: evaluate(case, x)[1], **options)
        return 2 * found.cost
    except Exception:  # NaN, or m < n with lm
        return np.inf


false, lower_ours, lower_theirs = 0, 0, 0
for case, problem in enumerate(ask({"list": True})):
    theirs = [run(case, problem, m, s) for m in ("trf", "lm", "dogbox") for s in ("jac", 1.0)]
    first = float(np.sum(evaluate(case, problem["start"])[0] ** 2))
    ours, best = problem["cost"], min(theirs + [problem["cost"]])
    room = max(1e-6 * best, 1e-12 * min(first, 1.0))
    at_best = ours <= best + room
    note = ""
    if at_best and not problem["converged"]:
        note = "FALSE: at the least cost, says " + problem["reason"]
    elif not at_best and problem["converged"]:
        note = f"ABOVE: {ours:.9e} with " + problem["reason"]
    elif not at_best:
        note = f"above, says so: {ours:.6e} {problem['reason']}"
    false += note.startswith(("FALSE", "ABOVE"))
    lower_theirs += not at_best
    lower_ours += ours < min(theirs) - room
    print(f"{problem['name']:22} best {best:.12e}  ours {ours:.6e} {problem['reason']:12} "
          f"scipy {min(theirs):.6e} ({sum(t <= best + room for t in theirs)} of 6)  {note}", flush=True)
print(f"{false} false endings; ours alone at the least cost {lower_ours}, scipy alone {lower_theirs}")
