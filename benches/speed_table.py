#!/usr/bin/env python3
"""How long commands take, as whole processes: processor time, and its ratio to a plain read of the same files.

    cargo build --release
    python3 benches/speed_table.py target/release/stillpoint [--phone FOLDER] [--repeat 5] [--most 16] [--placements 1000] [--check README.md]

A plain read is Python's csv module over the files, every cell a float. Figures are medians of rounds in which the commands take turns, user
and system time of the process. `--phone` is a folder with recordings rec_1, rec_2, rec_3 of a phone; without it those rows are left out.
Growth is the slope of the logarithm of the time against that of the number, over the larger half of the numbers. `--check` compares the
ratios that a text states as `NAME: 5 times` with those of this run, and ends with 1 where one is off by more than a factor of 1.5.
"""

import argparse
import json
import math
import re
import resource
import statistics
import subprocess
import sys
import tempfile
from pathlib import Path

FACTOR = 1.5
# One device in all simulated sessions.
SCALES = {"s_x": 1.004, "s_y": 0.997, "s_z": 1.002, "b_x": 0.01, "b_y": -0.02, "b_z": 0.005}
DEVICE = {
    "accel": SCALES | {"alpha_yz": 0.003, "alpha_zy": -0.002, "alpha_zx": 0.001},
    "gyro": SCALES | {"beta_yz": 0.002, "beta_zy": 0.001, "beta_xz": -0.003, "beta_zx": 0.002, "beta_xy": 0.001, "beta_yx": -0.001},
}


def processor_time(command):
    """User and system time of a process, s."""
    before = resource.getrusage(resource.RUSAGE_CHILDREN)
    ended = subprocess.run([str(word) for word in command], capture_output=True, text=True, check=False)
    after = resource.getrusage(resource.RUSAGE_CHILDREN)
    # 1 is a gate that failed: the work was done.
    if ended.returncode not in (0, 1):
        sys.exit(f"{' '.join(map(str, command))}: exit status {ended.returncode}\n{ended.stderr[-1000:]}")
    return (after.ru_utime - before.ru_utime) + (after.ru_stime - before.ru_stime)


def plain_read(folders):
    """The same of a plain read of the readings in some folders."""
    script = (
        "import csv, sys\n"
        "for name in sys.argv[1:]:\n"
        "    with open(name, newline='') as file:\n"
        "        for row in csv.reader(file):\n"
        "            try:\n"
        "                [float(cell) for cell in row]\n"
        "            except ValueError:\n"
        "                pass\n"
    )
    names = [name for folder in folders for name in sorted(Path(folder).glob("*.csv")) if is_readings(name)]
    return processor_time([sys.executable, "-c", script, *names]) - processor_time([sys.executable, "-c", "import csv"])


def is_readings(path):
    """Whether a table is a sensor's: a phone's folder holds marks and summaries too."""
    return path.stem in ("acc", "gyro", "mag")


def slope(numbers, times):
    """The slope of `ln times` against `ln numbers`."""
    x, y = [math.log(n) for n in numbers], [math.log(t) for t in times]
    mx, my = statistics.fmean(x), statistics.fmean(y)
    return sum((a - mx) * (b - my) for a, b in zip(x, y)) / sum((a - mx) ** 2 for a in x)


def row(name, seconds, ratio=None, growth=None):
    """Prints a row as it comes."""
    ratio = "" if ratio is None else f"{ratio:.1f}"
    growth = "" if growth is None else f"{growth:.2f}"
    print(f"{name:44} {seconds:9.3f} {ratio:>8} {growth:>7}", flush=True)


def simulated(program, folder, number, placements, hidden):
    """A simulated session, made once."""
    session = folder / f"session_{placements}_{number}"
    if not session.exists():
        spec = folder / f"{session.name}.toml"
        effects = "[effects.gyro_g_sensitivity]\nxx = 1e-4\nyy = -1.5e-4\nzz = 2e-4\n" if hidden else ""
        device = "\n".join(f'"{sensor}.{name}" = {value}' for sensor, names in DEVICE.items() for name, value in names.items())
        motion = f"[motion.hand_held]\nplacements = {placements}\n"
        spec.write_text(f'seed = {number + 1}\ngrade = "consumer"\n{motion}[parameters]\n{device}\n{effects}')
        processor_time([program, "simulate", spec, "-o", session])
    return session


def of_the_phone(program, folder, repeat, out):
    """Commands on recordings of a phone; the ratios by name."""
    one, three = [folder / "rec_1"], [folder / f"rec_{k}" for k in (1, 2, 3)]
    calls = {
        "calibrate --method stepwise, one recording": (["calibrate", "--method", "stepwise"], one),
        "calibrate, one recording": (["calibrate"], one),
        "calibrate, three recordings": (["calibrate"], three),
        "discover, one recording": (["discover"], one),
        "discover, three recordings": (["discover"], three),
    }
    times = {name: [] for name in calls}
    reads = {1: [], 3: []}
    for _ in range(repeat):
        reads[1].append(plain_read(one))
        reads[3].append(plain_read(three))
        for name, (words, files) in calls.items():
            times[name].append(processor_time([program, *words, *files, "-o", out / "out.json", "--force"]))
    ratios = {}
    for name, (_, files) in calls.items():
        read = statistics.median(reads[len(files)])
        ratios[name] = statistics.median(times[name]) / read
        row(name, statistics.median(times[name]), ratios[name])
    return ratios


def growth(program, command, numbers, files_of, repeat, out, what):
    """One command on more and more."""
    times = []
    for number in numbers:
        files = files_of(number)
        taken = [processor_time([program, command, *files, "-o", out / "out.json", "--force"]) for _ in range(repeat)]
        times.append(statistics.median(taken))
        half = len(times) // 2
        slopes = slope(numbers[half - 1 : len(times)], times[half - 1 :]) if len(times) >= 3 else None
        used = placements_used(out / "out.json")
        row(f"{command}, {number} {what}{used}", times[-1], growth=slopes)


def placements_used(path):
    """How many placements a calibration is from."""
    count = json.loads(path.read_text(encoding="utf-8")).get("accelerometer", {}).get("static_intervals")
    return "" if count is None else f" ({count} used)"


def check(text, ratios):
    """Whether a text states the ratios that were measured; `calibrate, one recording: 5 times`."""
    stated = {name: re.search(re.escape(name) + r": ([\d.]+) times", text) for name in ratios}
    off = 0
    for name, found in stated.items():
        if found is None:
            continue
        said, measured = float(found.group(1)), ratios[name]
        if not 1 / FACTOR <= measured / said <= FACTOR:
            print(f"{name}: the text says {said}, measured {measured:.1f}", file=sys.stderr)
            off += 1
    if not any(stated.values()):
        print("the text states none of these ratios", file=sys.stderr)
        off += 1
    return off


def main():
    """Prints the table."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("program", type=Path)
    parser.add_argument("--phone", type=Path)
    parser.add_argument("--repeat", type=int, default=5)
    parser.add_argument("--most", type=int, default=16, help="recordings at most; 0 leaves these rows out")
    parser.add_argument("--placements", type=int, default=1000, help="placements of one recording at most; 0 leaves these rows out")
    parser.add_argument("--check", type=Path)
    given = parser.parse_args()
    program, ratios = given.program.resolve(), {}
    print(f"{'':44} {'seconds':>9} {'a read':>8} {'growth':>7}")
    with tempfile.TemporaryDirectory() as made:
        folder = Path(made)
        if given.phone:
            ratios = of_the_phone(program, given.phone, given.repeat, folder)
        recordings = [n for n in (1, 2, 4, 8, 16, 32) if n <= given.most]
        for command in ("calibrate", "discover"):
            sessions = lambda n: [simulated(program, folder, k, 37, True) for k in range(n)]
            growth(program, command, recordings, sessions, min(given.repeat, 3), folder, "recordings, one effect missing")
        placements = [n for n in (40, 100, 320, 1000) if n <= given.placements]
        one = lambda n: [simulated(program, folder, 1, n, False)]
        growth(program, "calibrate", placements, one, min(given.repeat, 3), folder, "placements")
    return min(check(given.check.read_text(encoding="utf-8"), ratios), 1) if given.check else 0


if __name__ == "__main__":
    sys.exit(main())
