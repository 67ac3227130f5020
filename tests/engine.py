#!/usr/bin/env python3
"""Shards of a batch under HyperQueue: what is killed and run again gives the bytes of the undisturbed run.

    pip install hyperqueue
    python3 tests/engine.py target/release/stillpoint [--devices 24] [--shards 6] [--engine hq|wheel|parallel]

With the `hq` binary on the path a worker is killed, then the server, which goes on from its journal. The wheel (0.27) has neither
that binary nor a way to a journal: server and worker are threads of one Python process. There a running task is killed first, then the
whole process, and the shards are submitted to a new cluster. With GNU parallel a running task is killed, which is run again, then
parallel itself, which goes on from its log of jobs. Exit status 77: skipped, and why.
"""

import argparse
import importlib.util
import os
import shlex
import shutil
import signal
import subprocess
import sys
import tempfile
import time
from pathlib import Path

SPEC = """seed = {seed}
rate = 50.0
[motion.hand_held]
placements = 12
initial_rest = 5.0
"""


def make_devices(program, folder, count):
    """Recordings of `count` simulated devices, and one that is none."""
    devices = folder / "devices"
    devices.mkdir()
    for seed in range(count):
        spec = folder / f"{seed}.toml"
        spec.write_text(SPEC.format(seed=seed))
        subprocess.run([program, "simulate", spec, "-o", devices / f"d{seed:03}"], check=True, capture_output=True)
    (devices / "broken.csv").write_text("no recording\n")
    return devices


def shard_command(program, devices, out, k, n):
    """The command of a shard; status 1 says that a device failed, which is a result."""
    call = f'"{program}" batch "{devices}" -o "{out}" --shard {k}/{n} --resume --jobs 1 >/dev/null; test $? -le 1'
    return ["sh", "-c", call]


def merged(program, out, target):
    subprocess.run([program, "batch", "merge", out, "-o", target, "--jsonl", "--csv"], check=True, capture_output=True)
    return target.with_suffix(".jsonl").read_bytes(), target.with_suffix(".csv").read_bytes()


def running_tasks(out):
    """Processes of ours that compute a shard into `out`."""
    found = []
    for entry in Path("/proc").iterdir():
        if not entry.name.isdigit():
            continue
        try:
            call = (entry / "cmdline").read_bytes().split(b"\0")
        except OSError:
            continue
        if str(out).encode() in call and b"--shard" in call:
            found.append(int(entry.name))
    return found


def wait_for(what, seconds=120):
    end = time.monotonic() + seconds
    while time.monotonic() < end:
        found = what()
        if found:
            return found
        time.sleep(0.01)
    raise SystemExit("nothing happened within the time allowed")


def cluster(server, commands):
    """A server with a worker in this process; ends with status 1 where a task failed."""
    from hyperqueue import Job, LocalCluster
    from hyperqueue.cluster import WorkerConfig

    with LocalCluster(server, WorkerConfig(cores=2)) as local:
        job = Job(max_fails=None)
        for command in commands:
            job.program(command, stdout=None, stderr=None)
        client = local.client()
        submitted = client.submit(job)
        sys.exit(0 if client.wait_for_jobs([submitted], raise_on_error=False) else 1)


def in_cluster(commands):
    """`cluster` in a process that can be killed."""
    pid = os.fork()
    if pid:
        return pid
    os.setsid()
    null = os.open(os.devnull, os.O_WRONLY)
    os.dup2(null, 1)
    os.dup2(null, 2)
    try:
        with tempfile.TemporaryDirectory() as server:
            cluster(server, commands)
    except SystemExit as end:
        os._exit(end.code)
    os._exit(1)


def status(pid):
    return os.waitstatus_to_exitcode(os.waitpid(pid, 0)[1])


def by_wheel(commands, out):
    """Kills a task, then server and worker; returns how often the shards were submitted."""
    pid = in_cluster(commands)
    victim = wait_for(lambda: running_tasks(out))[0]
    os.kill(victim, signal.SIGKILL)
    print(f"killed the task {victim}")
    wait_for(lambda: [t for t in running_tasks(out) if t != victim])
    os.killpg(pid, signal.SIGKILL)
    print(f"killed server and worker {pid}: {status(pid)}")
    for task in running_tasks(out):
        os.kill(task, signal.SIGKILL)
    rounds = 1
    while True:
        rounds += 1
        if status(in_cluster(commands)) == 0:
            return rounds
        if rounds > 5:
            raise SystemExit("tasks fail again and again")


def by_parallel(parallel, commands, out, folder):
    """Kills a task, then parallel with all its tasks; returns how often it was started."""
    jobs = folder / "jobs"
    jobs.write_text("".join(f"{shlex.join(command)}\n" for command in commands))
    call = [parallel, "--jobs", "2", "--retries", "5", "--joblog", folder / "log", "--resume-failed", "--arg-file", jobs]
    quiet = dict(stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL, start_new_session=True)
    first = subprocess.Popen(call, **quiet)
    victim = wait_for(lambda: running_tasks(out))[0]
    os.kill(victim, signal.SIGKILL)
    print(f"killed the task {victim}")
    wait_for(lambda: [t for t in running_tasks(out) if t != victim])
    os.killpg(first.pid, signal.SIGKILL)
    print(f"killed parallel: {first.wait()}")
    for task in running_tasks(out):
        os.kill(task, signal.SIGKILL)
    subprocess.run(call, check=True, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
    return 2


def by_binary(hq, commands, out, folder):
    """Kills a worker, then the server, which restores the job from its journal."""
    env = dict(os.environ, HQ_SERVER_DIR=str(folder / "hq"))
    server_call = [hq, "server", "start", "--journal", str(folder / "journal")]
    worker_call = [hq, "worker", "start", "--cpus", "2"]
    quiet = dict(stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL, env=env, start_new_session=True)
    server = subprocess.Popen(server_call, **quiet)
    wait_for(lambda: subprocess.run([hq, "server", "info"], env=env, capture_output=True).returncode == 0)
    worker = subprocess.Popen(worker_call, **quiet)
    for command in commands:
        subprocess.run([hq, "submit", "--crash-limit", "unlimited", "--", *command], env=env, check=True, capture_output=True)
    wait_for(lambda: running_tasks(out))
    os.killpg(worker.pid, signal.SIGKILL)
    print("killed the worker")
    worker = subprocess.Popen(worker_call, **quiet)
    wait_for(lambda: running_tasks(out))
    os.killpg(server.pid, signal.SIGKILL)
    os.killpg(worker.pid, signal.SIGKILL)
    print("killed the server")
    server = subprocess.Popen(server_call, **quiet)
    wait_for(lambda: subprocess.run([hq, "server", "info"], env=env, capture_output=True).returncode == 0)
    worker = subprocess.Popen(worker_call, **quiet)
    subprocess.run([hq, "job", "wait", "all"], env=env, check=True, capture_output=True)
    for process in (worker, server):
        os.killpg(process.pid, signal.SIGTERM)
    return 1


NAMES = {"hq": "hq", "wheel": "the wheel's LocalCluster", "parallel": "GNU parallel"}


def engine_here(asked):
    """The engine asked for, or the first that is here; ends with status 77 where there is none."""
    here = {
        "hq": shutil.which("hq"),
        "wheel": importlib.util.find_spec("hyperqueue"),
        "parallel": shutil.which("parallel"),
    }
    found = [name for name in ([asked] if asked else here) if here[name]]
    if not found:
        wanted = NAMES[asked] if asked else "hq, the wheel or GNU parallel"
        print(f"SKIPPED: not here: {wanted}; pip install hyperqueue, or apt install parallel", file=sys.stderr)
        sys.exit(77)
    return found[0]


def main():
    arguments = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    arguments.add_argument("program", type=Path)
    arguments.add_argument("--devices", type=int, default=24)
    arguments.add_argument("--shards", type=int, default=6)
    arguments.add_argument("--engine", choices=["hq", "wheel", "parallel"], help="the first that is here")
    arguments = arguments.parse_args()
    program = arguments.program.resolve()
    engine = engine_here(arguments.engine)
    with tempfile.TemporaryDirectory() as folder:
        folder = Path(folder)
        devices = make_devices(program, folder, arguments.devices)
        n = arguments.shards
        calm, killed = folder / "calm", folder / "killed"
        begin = time.monotonic()
        for k in range(1, n + 1):
            subprocess.run(shard_command(program, devices, calm, k, n), check=True)
        alone = time.monotonic() - begin
        commands = [shard_command(program, devices, killed, k, n) for k in range(1, n + 1)]
        begin = time.monotonic()
        if engine == "wheel":
            rounds = by_wheel(commands, killed)
        elif engine == "hq":
            rounds = by_binary(shutil.which("hq"), commands, killed, folder)
        else:
            rounds = by_parallel(shutil.which("parallel"), commands, killed, folder)
        disturbed = time.monotonic() - begin
        same = merged(program, calm, folder / "a") == merged(program, killed, folder / "b")
    print(f"{NAMES[engine]}: {n} shards, {rounds} rounds, {disturbed:.1f} s disturbed, {alone:.1f} s one after the other alone")
    print("merged results are the same bytes" if same else "MERGED RESULTS DIFFER")
    sys.exit(0 if same else 1)


if __name__ == "__main__":
    main()
