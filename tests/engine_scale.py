#!/usr/bin/env python3
"""Many simulated devices through an engine: what is lost beside the devices' own time, and what a million would take.

    pip install hyperqueue
    python3 tests/engine_scale.py target/release/stillpoint [--devices 100000] [--shards 100] [--engine wheel|parallel]

Sessions of 28 s at 25 Hz; forty are simulated and the other devices are links to them. A shard runs on one core, as many at a time
as there are cores. The overhead is the share of the workers' time that no device was calibrated in: starting, reading the manifest,
writing the part, the engine. Both are times of the clock, so that a loaded machine lengthens both.
"""

import argparse
import json
import os
import shlex
import shutil
import subprocess
import sys
import tempfile
import time
from pathlib import Path

from devices import linked_devices
from engine import in_cluster, shard_command, status

SPEC = """seed = {seed}
rate = 25.0
[motion.hand_held]
placements = 14
initial_rest = 3.0
rest = [1.0, 1.1]
turn = [0.8, 1.0]
"""


def by_parallel(commands, cores, folder):
    jobs = folder / "jobs"
    jobs.write_text("".join(f"{shlex.join(command)}\n" for command in commands))
    call = [shutil.which("parallel"), "--jobs", str(cores), "--arg-file", jobs]
    return subprocess.run(call, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL).returncode


def main():
    arguments = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    arguments.add_argument("program", type=Path)
    arguments.add_argument("--devices", type=int, default=100_000)
    arguments.add_argument("--shards", type=int, default=100)
    arguments.add_argument("--engine", choices=["wheel", "parallel"], default="wheel")
    arguments = arguments.parse_args()
    program, cores = arguments.program.resolve(), 2
    with tempfile.TemporaryDirectory() as folder:
        folder = Path(folder)
        devices, out = folder / "devices", folder / "out"
        begin = time.monotonic()
        linked_devices(program, devices, SPEC, arguments.devices)
        made = time.monotonic() - begin
        n = arguments.shards
        commands = [shard_command(program, devices, out, k, n) for k in range(1, n + 1)]
        begin = time.monotonic()
        failed = by_parallel(commands, cores, folder) if arguments.engine == "parallel" else status(in_cluster(commands))
        clock = time.monotonic() - begin
        if failed:
            sys.exit(f"{arguments.engine}: status {failed}")
        own = 0.0
        for path in out.glob("timings-*.jsonl"):
            own += sum(json.loads(line)["seconds"] for line in path.read_text().splitlines())
        begin = time.monotonic()
        merged = subprocess.run([program, "batch", "merge", out, "-o", folder / "all", "--jsonl", "--json"], capture_output=True)
        merging = time.monotonic() - begin
        if merged.returncode not in (0, 1):
            sys.exit(merged.stderr.decode())
        lines = sum(1 for _ in open(folder / "all.jsonl"))
        again = time.monotonic()
        subprocess.run(commands[0], check=True)
        again = time.monotonic() - again
        size = sum(path.stat().st_size for path in out.glob("part-*"))
    each = cores * clock / arguments.devices
    print(f"{lines} records of {arguments.devices} devices in {n} shards ({made:.0f} s to make them); load {os.getloadavg()[0]:.1f}")
    print(f"{arguments.engine}: {clock:.0f} s with {cores} workers, {1e3 * each:.2f} ms of a core per device, of which {1e3 * own / arguments.devices:.2f} its own")
    print(f"overhead {100 * (1 - own / (cores * clock)):.1f} %; merge {merging:.1f} s; a shard that is complete {again:.2f} s; parts {size / 1e6:.0f} MB")
    print(f"10^6 devices: {1e6 * each / 3600:.2f} core hours, merge {merging * 1e6 / arguments.devices:.0f} s, parts {size / arguments.devices / 1e3:.1f} GB")


if __name__ == "__main__":
    main()
