"""The pose graphs that everybody measures: this solver beside GTSAM, Ceres and apex-solver, from the same start, one thread each.

    cargo build --release -p stillpoint-benches --bin graph-table
    sh benches/peers/ceres/build.sh                              (optional; apt-get install libceres-dev)
    (cd benches/peers/rust && cargo build --release)             (optional; apex-solver)
    PYTHON=python3 (with gtsam installed; optional)
    python3 benches/peers/standard_graphs.py FOLDER [ROUNDS] [NAME ...]

FOLDER holds the sets as `.g2o.gz` or `.g2o`. For each a file is written with the poses at which all begin: those that
`PoseGraph::better_start` chooses (manhattan, which has no poses, and cubicle, torus3D and sphere_bignoise by the
chordal start), and cubicle's 5,021 indefinite information matrices mended (`Indefinite::PlanarTermsMoved`).
GTSAM and apex-solver minimise the error of the SE(3) logarithm; beside them runs `graph-table g2o … logarithm`. Ceres' peer
minimises translation and rotation apart; beside it runs `… apart`. Of GTSAM the fastest of four methods counts that ends within
1e-6 of the lowest cost. All end with the step that changes the cost by 1e-10 of itself. Seconds of the processor from the problem
in memory to the solution, medians of turns. "start" is the time of our start, in which the peers have no part; "ours with it" adds it.
Costs are those that the programs say; of the same poses GTSAM and `graph-table cost … logarithm` say the same to ten digits.
PYTHON, STILLPOINT_GRAPH_TABLE and STILLPOINT_RUST_PEERS name the programs, if they are elsewhere.
"""

import gzip
import os
import statistics
import subprocess
import sys
import tempfile
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
HERE = Path(__file__).resolve().parent
OURS = os.environ.get("STILLPOINT_GRAPH_TABLE", ROOT / "target/release/graph-table")
CERES = HERE / "ceres/peer"
RUST = os.environ.get("STILLPOINT_RUST_PEERS", HERE / "rust/target/release/stillpoint-rust-peers")
PYTHON = os.environ.get("PYTHON", sys.executable)
METHODS = ("lm", "lm-small", "gauss-newton", "dogleg")
LIMIT = 120
SAME = 1e-6


def words(command):
    """What a program prints, split; nothing where it failed, took too long or is not there."""
    alone = {**os.environ, "OPENBLAS_NUM_THREADS": "1", "OMP_NUM_THREADS": "1", "RAYON_NUM_THREADS": "1"}
    alone["CERES_RADIUS"] = os.environ.get("CERES_RADIUS", "1e8")
    try:
        done = subprocess.run([str(w) for w in command], capture_output=True, text=True, timeout=LIMIT, env=alone)
    except (subprocess.TimeoutExpired, FileNotFoundError):
        return []
    lines = [line.split() for line in done.stdout.strip().splitlines()]
    return lines[-1] if done.returncode == 0 and lines else []


def run(command):
    """Cost, steps and seconds."""
    found = words(command)
    return [float(w) for w in found[2:5]] if len(found) > 4 else None


def solvers(file):
    yield "ours, logarithm", lambda: run([OURS, "g2o", file, "logarithm", "file"])
    for method in METHODS:
        yield f"GTSAM {method}", lambda method=method: run([PYTHON, HERE / "gtsam_graph.py", file, method])
    yield "apex-solver", lambda: run([RUST, "apex", "g2o", file])
    yield "ours, apart", lambda: run([OURS, "g2o", file, "apart", "file"])
    yield "Ceres", lambda: run([CERES, "g2o", file])


def plain(file, folder):
    if file.suffix != ".gz":
        return file
    out = folder / file.stem
    out.write_bytes(gzip.decompress(file.read_bytes()))
    return out


def row(name, file, rounds, folder):
    start = folder / "start.g2o"
    more = ["moved"] if name == "cubicle" else []
    seconds = words([OURS, "start", file, start, *more])
    if not seconds:
        print(f"| {name} | no start |", flush=True)
        return
    begin = float(seconds[0])
    found = {kind: [] for kind, _ in solvers(start)}
    for _ in range(rounds):
        for kind, solve in solvers(start):
            if None not in found[kind]:
                found[kind].append(solve())
    middle = {
        kind: None if None in runs or not runs else [statistics.median(r[k] for r in runs) for k in range(3)]
        for kind, runs in found.items()
    }

    def beside(ours, peers):
        mine = middle[ours]
        lowest = min(m[0] for m in [mine, *(middle[p] for p in peers)] if m)
        ended = [p for p in peers if middle[p] and middle[p][0] <= lowest * (1 + SAME)]
        for kind in (ours, *peers):
            m = middle[kind]
            if m is None:
                print(f"| {name} | {kind} | failed, or over {LIMIT} s | | | |", flush=True)
                continue
            high = m[0] / lowest - 1
            text = "" if high <= SAME else f" ({high:+.1e})"
            ratio = ""
            if kind == ours and ended:
                fastest = min(ended, key=lambda p: middle[p][2])
                pairs = [a[2] / b[2] for a, b in zip(found[ours], found[fastest])]
                ratio = f"{statistics.median(pairs):.2f} of {fastest}; with the start {statistics.median(pairs) * (1 + begin / m[2]):.2f}"
            print(f"| {name} | {kind} | {m[0]:.9g}{text} | {m[1]:.0f} | {1e3 * m[2]:.1f} | {ratio} |", flush=True)

    print(f"| {name} | start | | | {1e3 * begin:.1f} | |", flush=True)
    beside("ours, logarithm", [f"GTSAM {m}" for m in METHODS] + ["apex-solver"])
    beside("ours, apart", ["Ceres"])


def main():
    folder = Path(sys.argv[1])
    rounds = int(sys.argv[2]) if len(sys.argv) > 2 else 3
    names = sys.argv[3:]
    print("| set | solver | cost | steps | ms | ours / fastest peer at the lowest cost |")
    print("|---|---|---|---|---|---|")
    with tempfile.TemporaryDirectory() as scratch:
        scratch = Path(scratch)
        for file in sorted(folder.iterdir()):
            name = file.name.split(".")[0]
            if ".g2o" not in file.name or names and not any(n in name for n in names):
                continue
            row(name, plain(file, scratch), rounds, scratch)


if __name__ == "__main__":
    main()
