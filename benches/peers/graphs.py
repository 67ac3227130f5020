"""Bundle adjustments and pose graphs: this solver beside Ceres, one thread each, in turns.

    cargo build --release -p stillpoint-benches --bin graph-table
    sh benches/peers/ceres/build.sh
    target/release/graph-table make FOLDER
    python3 benches/peers/graphs.py FOLDER [ROUNDS] [NAME ...]

Every solver is started anew for every run and reads the same file; its time is from the problem in memory
to the solution, setting up included. Both end with the step that changes the cost by 1e-10 of itself.
The table shows medians; NAME picks the files whose name contains one of them.
"""

import statistics
import subprocess
import sys
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
OURS = ROOT / "target/release/graph-table"
CERES = ROOT / "benches/peers/ceres/peer"


def run(command):
    words = subprocess.run(command, capture_output=True, text=True, check=True).stdout.split()
    return [float(w) for w in words[1:6]]


def cases(folder, names):
    for file in sorted(folder.iterdir()):
        if names and not any(name in file.name for name in names):
            continue
        if file.suffix == ".bal":
            for jacobian in ("auto", "analytic"):
                for gauge in ("free", "fixed"):
                    yield f"{file.stem} {jacobian} {gauge}", ["bal", str(file), jacobian, gauge]
        elif file.suffix == ".g2o":
            yield file.stem, ["g2o", str(file)]


def main():
    folder = Path(sys.argv[1])
    rounds = int(sys.argv[2]) if len(sys.argv) > 2 else 5
    print("| problem | cost | relative difference | steps | ms | Ceres: steps | ms | time / Ceres | MB | Ceres: MB |")
    print("|---|---|---|---|---|---|---|---|---|---|")
    for name, words in cases(folder, sys.argv[3:]):
        ours, ceres = [], []
        for _ in range(rounds):
            start = ["file"] if words[0] == "g2o" else []
            ours.append(run([OURS, *words, *start]))
            ceres.append(run([CERES, *words]))
        middle = [statistics.median(r[k] for r in ours) for k in range(5)]
        other = [statistics.median(r[k] for r in ceres) for k in range(5)]
        ratio = statistics.median(a[3] / b[3] for a, b in zip(ours, ceres))
        print(
            f"| {name} | {middle[1]:.6g} | {middle[1] / other[1] - 1:.1e} | {middle[2]:.0f} | {1e3 * middle[3]:.1f} "
            f"| {other[2]:.0f} | {1e3 * other[3]:.1f} | {ratio:.2f} | {middle[4]:.0f} | {other[4]:.0f} |",
            flush=True,
        )


if __name__ == "__main__":
    main()
