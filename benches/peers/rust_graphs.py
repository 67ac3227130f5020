"""Bundle adjustments and pose graphs: this solver beside the crates apex-solver and factrs, one thread each.

    cargo build --release -p stillpoint-benches --bin graph-table
    (cd benches/peers/rust && cargo build --release)
    target/release/graph-table make FOLDER
    python3 benches/peers/rust_graphs.py FOLDER [ROUNDS] [NAME ...]

Every solver is started anew for every run, in turns; its time is that of the processor from the problem in
memory to the solution. All end where a step changes the cost by 1e-10 of itself; bundle adjustments are
gauge free. The table shows medians of the times, and the time of this solver by that of the faster peer.
Pose graphs have the logarithm of the whole error, as the peers have, and begin at the file's poses.
STILLPOINT_BINARIES=OURS:PEERS names the two binaries, if they are elsewhere.
"""

import os
import statistics
import subprocess
import sys
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
BINARIES = os.environ.get("STILLPOINT_BINARIES", "").split(":")
OURS, PEERS = BINARIES if len(BINARIES) == 2 else (
    ROOT / "target/release/graph-table",
    ROOT / "benches/peers/rust/target/release/stillpoint-rust-peers",
)
LIMIT = 120


def run(command):
    """Cost, steps and seconds; nothing if it failed or took too long."""
    environment = {**os.environ, "RAYON_NUM_THREADS": "1"}
    try:
        done = subprocess.run(command, capture_output=True, text=True, timeout=LIMIT, env=environment)
    except subprocess.TimeoutExpired:
        return None
    words = done.stdout.strip().splitlines()[-1:]
    words = words[0].split() if words else []
    return [float(w) for w in words[2:5]] if done.returncode == 0 and len(words) > 4 else None


def solvers(file):
    if file.suffix == ".bal":
        yield "ours, own Jacobian", [OURS, "bal", file, "analytic", "free"]
        yield "ours, duals", [OURS, "bal", file, "auto", "free"]
        for method in ("sparse", "dense", "implicit"):
            yield f"apex {method}, own Jacobian", [PEERS, "apex", "bal", file, "free", method]
        yield "factrs, duals", [PEERS, "factrs", "bal", file, "free"]
    else:
        yield "ours, duals", [OURS, "g2o", file, "logarithm", "file"]
        yield "apex, own Jacobian", [PEERS, "apex", "g2o", file]
        yield "factrs, duals", [PEERS, "factrs", "g2o", file]


def main():
    folder = Path(sys.argv[1])
    rounds = int(sys.argv[2]) if len(sys.argv) > 2 else 3
    names = sys.argv[3:]
    print("| problem | solver | cost | steps | ms | time / faster peer |")
    print("|---|---|---|---|---|---|")
    for file in sorted(folder.iterdir()):
        if file.suffix not in (".bal", ".g2o") or names and not any(n in file.name for n in names):
            continue
        found = {name: [] for name, _ in solvers(file)}
        for _ in range(rounds):
            for name, command in solvers(file):
                if None not in found[name]:
                    found[name].append(run(command))
        middle = {
            name: None if None in runs else [statistics.median(r[k] for r in runs) for k in range(3)]
            for name, runs in found.items()
        }
        least = min((m[2] for name, m in middle.items() if m and not name.startswith("ours")), default=float("nan"))
        for name, m in middle.items():
            if m is None:
                print(f"| {file.stem} | {name} | failed, or over {LIMIT} s | | | |")
                continue
            ratio = f"{m[2] / least:.2f}" if name.startswith("ours") else ""
            print(f"| {file.stem} | {name} | {m[0]:.7g} | {m[1]:.0f} | {1e3 * m[2]:.1f} | {ratio} |", flush=True)


if __name__ == "__main__":
    main()
