#!/usr/bin/env python3
"""A batch against the library's own rate and a shell loop, on the same simulated devices in one run.

    cargo build --release -p stillpoint && cargo build --release -p stillpoint-imu --example rate
    python3 tests/batch_rate.py target/release [--short 2000] [--long 200] [--rounds 3]

Two populations: sessions of 30 s and of 10 min at 100 Hz. In each round the library calibrates all devices in one process and one
thread, then the batch does with a worker per core, then (in the first round) a shell loop calls `calibrate` for each device.
`of cores` is the batch's rate over cores times the library's; `work` is processor time per device over the library's, which a
loaded machine changes less. Memory is the largest resident set of the process.
"""

import argparse
import os
import statistics
import subprocess
import sys
import tempfile
import time
from pathlib import Path

from devices import linked_devices

SPEC = """seed = {seed}
rate = 100.0
[motion.hand_held]
placements = {placements}
initial_rest = {initial}
rest = {rest}
turn = {turn}
"""
SESSIONS = {
    "30 s": dict(placements=14, initial=3.0, rest=[1.0, 1.1], turn=[0.8, 1.0]),
    "10 min": dict(placements=57, initial=30.0, rest=[6.0, 8.0], turn=[2.0, 4.0]),
}
LOOP = 'for d in "$0"/*; do "$1" calibrate "$d" -o "$2/${d##*/}.json" --force >/dev/null 2>&1; done'


def spent(command, **more):
    """Seconds of the clock and of the processor, the largest resident set in MB, what it printed, and its status."""
    begin = time.perf_counter()
    child = subprocess.Popen([str(c) for c in command], stdout=subprocess.PIPE, text=True, **more)
    said = child.stdout.read()
    _, status, usage = os.wait4(child.pid, 0)
    clock = time.perf_counter() - begin
    child.returncode = os.waitstatus_to_exitcode(status)
    return clock, usage.ru_utime + usage.ru_stime, usage.ru_maxrss / 1024, said, child.returncode


def main():
    arguments = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    arguments.add_argument("binaries", type=Path)
    arguments.add_argument("--short", type=int, default=2000)
    arguments.add_argument("--long", type=int, default=200)
    arguments.add_argument("--rounds", type=int, default=3)
    arguments.add_argument("--without-loop", action="store_true")
    arguments = arguments.parse_args()
    program, rate = arguments.binaries.resolve() / "stillpoint", arguments.binaries.resolve() / "examples/rate"
    cores = len(os.sched_getaffinity(0))
    one = dict(os.environ, RAYON_NUM_THREADS="1")
    print(f"{cores} cores; load {os.getloadavg()[0]:.1f}")
    with tempfile.TemporaryDirectory() as folder:
        folder = Path(folder)
        for name, count in (("30 s", arguments.short), ("10 min", arguments.long)):
            devices, out = folder / name.replace(" ", ""), folder / f"out{count}"
            linked_devices(program, devices, SPEC, count, **SESSIONS[name])
            of_cores, work, memory = [], [], []
            for round_ in range(arguments.rounds):
                _, own, _, said, status = spent([rate, devices], env=one)
                if status:
                    sys.exit("the library refused a device")
                library = count / float(said.split()[1])
                clock, whole, peak, said, status = spent(
                    [program, "batch", devices, "-o", out, "--force"], stderr=subprocess.DEVNULL
                )
                if status not in (0, 1):
                    sys.exit(f"batch: status {status}")
                of_cores.append(count / clock / (cores * library))
                work.append(whole / own)
                memory.append(peak)
                print(
                    f"{name}: library {library:.1f} a second in one thread, batch {count / clock:.1f}: "
                    f"{of_cores[-1]:.3f} of cores, work {work[-1]:.3f}, {peak:.0f} MB",
                    flush=True,
                )
                if round_ == 0 and not arguments.without_loop:
                    loop = folder / "loop"
                    loop.mkdir(exist_ok=True)
                    seconds, ours, *_ = spent(["sh", "-c", LOOP, devices, program, loop])
                    print(f"{name}: shell loop {count / seconds:.1f} a second, batch {seconds / clock:.2f} times as fast")
            print(
                f"{name}, {count} devices: median {statistics.median(of_cores):.3f} of cores times the library's rate, "
                f"work {statistics.median(work):.3f}, at most {max(memory):.0f} MB"
            )


if __name__ == "__main__":
    main()
