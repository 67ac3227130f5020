#!/usr/bin/env python3
"""Every read and write of every command fails in turn: no panic, no half file, the right exit status, a message that says which and why.

    cargo build --release
    python3 tests/io_failures.py target/release/stillpoint [--quick] [--jobs 2] [--only 'calibrate good'] [--verbose]

Each command of `io_calls.py` runs once under strace, which lists its system calls on files of the user and on the standard streams; then
once for each of these calls and each error that the system may give there (EIO, ENOSPC, EACCES, EPIPE, EINTR), injected at that call.
A run that is told of an error ends with status 3 (input) or 6 (output), names the file and the reason, and leaves what was there or what
the undisturbed run writes; one that ends as if nothing had been has the undisturbed run's bytes, for a reason in `SHRUGGED`. EINTR is
always retried. Short reads come from a pipe that gives seven bytes at a time, short writes from a limit on the size of files; injected
ones would tell of bytes that no call has moved. Threads: calls are counted by thread, one of each kind works (RAYON_NUM_THREADS=1), and
a run counts only where the trace shows the injection at the file meant. Needs Linux and strace; exit status 77 without, 1 with a violation.
"""

import argparse
import errno
import os
import shlex
import shutil
import signal
import sys
import tempfile
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path

from io_calls import CALLS, furnish
from io_trace import ERRORS, PARTIAL, REMOVALS, Bench, Traced

# A call that may fail without a word, and why; the result is that of the undisturbed run all the same.
SHRUGGED = [
    (lambda c: c.role == "input" and c.name == "getdents64", "whether an output is an input shows by its name, and the folder is read again"),
    (lambda c: c.path.startswith("out/devices/"), "a device whose record cannot be read is calibrated again"),
    (lambda c: c.role == "stderr", "standard error is for people, and may be closed"),
    (lambda c: c.name == "close", "outputs are on the disk before they are closed, inputs are read"),
    (lambda c: c.role == "folder" and c.name in ("openat", "fsync"), "not every file system locks or syncs a folder"),
    (lambda c: c.path.endswith("~") and c.kind == "openat", "a claim that cannot be looked at costs the message about a second run"),
    (lambda c: c.role == "folder" and c.name == "getdents64", "leftovers of killed runs wait for the next run"),
    (lambda c: c.kind == "stat" or c.name in ("readlink", "lseek"), "what is asked here shows in what follows"),
    (lambda c: c.name in REMOVALS, "what cannot be removed stays, and is not the result"),
    (lambda c: c.role == "input" and c.kind in ("openat", "read"), "it was a first look; the file is read again from its beginning"),
]


class Study:
    """One command: the undisturbed run, and all disturbed ones judged by it."""

    def __init__(self, program, store, place, call):
        self.bench = Bench(program, store, place, call)
        self.call, self.before = call, self.bench.before
        self.violations, self.shrugged, self.missed, self.failed = [], {}, [], 0

    def carry_out(self):
        bench = self.bench
        first = bench.run()
        bench.written = {name for name, held in first.files.items() if self.before.get(name, "none") != held}
        self.calm, again = bench.run(), bench.run(traced=False)
        # Times of a run differ from run to run, and what a live session says between what comes.
        others = (first, again)
        self.volatile = {name for name, held in self.calm.files.items() if any(held != run.files.get(name) for run in others)}
        self.volatile |= {name for name in self.calm.files if "/timings-" in name or name == "events.jsonl"}
        if not again.same_as(self.calm, self.volatile):
            self.violations.append(("-", f"two undisturbed runs differ: {self.calm.status} {again.status} {again.stderr}"))
            return
        for call in self.calm.calls:
            # No system fails to close a folder, and the standard library panics there.
            if call.name == "close" and (call.role == "folder" or self.is_folder(call.path)):
                continue
            for error in ERRORS[call.kind] + (["EPIPE"] if call.role == "stdout" and call.kind == "write" else []):
                self.disturb(call, error)
        self.cut_short()

    def is_folder(self, path):
        return path in self.calm.files and self.calm.files[path] is None

    def disturb(self, call, error):
        for inject, only in self.ways(call, error):
            run = self.bench.run(inject, only)
            hit = [c for c in run.calls if c.injected]
            # Partial files have random names, which a folder lists in another order each time.
            if any(c.name == call.name and (c.path == call.path or c.path[-1] == call.path[-1] == "~") for c in hit):
                break
        else:
            self.missed.append(f"{inject} {call.path}")
            return
        self.failed += 1
        if wrong := self.judged(run, hit, error):
            self.violations.append((shlex.join(["strace", "-f", "-o", "/dev/null", *(f"-P{path}" for path in only[:1]), "-e", f"inject={inject}"]), f"{call.name} of {call.path}: {'; '.join(wrong)}"))

    def ways(self, call, error):
        """How to meet the call again: by its file, for the first calls of a thread may be others than the loader's; else by its number."""
        folder, name = self.bench.folder, call.path
        paths = (str(self.bench.streams / name.removeprefix("std")),) if name.startswith("std") else (name, str(folder / name))
        by_file = f"{call.name}:error={error}:when={call.nth_there}", paths
        by_number = f"{call.name}:error={error}:when={call.nth}", ()
        return [by_number] * 3 if name.endswith("~") or name == "." else [by_file, by_file, by_number, by_number]

    def cut_short(self):
        """Reads and writes that move fewer bytes than asked."""
        if self.call.stdin:
            self.failed += 1
            if not self.bench.run(traced=False, piped=True).same_as(self.calm, self.volatile):
                self.violations.append(("pv -qL 7 FILE |", "seven bytes at a time on standard input give another result"))
        written = {name: held for name, held in self.calm.files.items() if held and self.before.get(name) != held}
        sizes = {size for held in [*written.values(), self.calm.stdout] for size in (len(held) // 2, len(held) - 1) if size > 0}
        for size in sorted(sizes):
            self.failed += 1
            run = self.bench.run(traced=False, limit=size)
            hit = [Traced("write", 0, name, "output", False) for name, held in written.items() if len(held) > size]
            if len(self.calm.stdout) > size:
                hit.append(Traced("write", 0, "stdout", "stdout", False))
            if wrong := self.judged(run, hit, "EFBIG"):
                self.violations.append((f"prlimit --fsize={size}", "; ".join(wrong)))

    def judged(self, run, hit, error):
        """What is wrong with a run in which the calls `hit` failed."""
        calm, wrong = self.calm, []
        if run.status == "hangs":
            return ["hangs for two minutes"]
        if "panicked at" in run.stderr or run.status in (7, 101):
            wrong.append(f"panic, status {run.status}")
        if run.status < 0 or run.status > 128 and run.status != calm.status:
            wrong.append(f"ended by signal {signal.Signals(-run.status if run.status < 0 else run.status - 128).name}")
        names = {c.name for c in hit}
        wrong += self.half_files(run, hit, removal_failed=bool(names & REMOVALS))
        if names & REMOVALS:
            run.files = {name: held for name, held in run.files.items() if not PARTIAL.search(name)}
        if run.same_as(calm, self.volatile):
            return wrong + self.ignored(hit, error)
        if error == "EINTR":
            return wrong + [f"an interrupted call is not retried: status {run.status}, {run.stderr.strip()[:300]}"]
        if error == "EPIPE" or calm.status != 0 and all(c.role == "stdout" for c in hit):
            cut = calm.stdout.startswith(run.stdout) and run.status == calm.status
            return wrong if cut else wrong + [f"status {run.status} instead of {calm.status}"]
        return wrong + self.told(run, hit, error)

    def ignored(self, hit, error):
        """The result is that of the undisturbed run."""
        if error == "EINTR":
            return []
        for c in hit:
            reason = next((reason for holds, reason in SHRUGGED if holds(c)), None)
            if c.role == "stdout" and (error == "EPIPE" or self.calm.status != 0):
                reason = "a reader that went is no error, and no second one after another"
            if reason is None:
                return [f"{error} is ignored: status {self.calm.status} as if nothing had been"]
            self.shrugged[reason] = self.shrugged.get(reason, 0) + 1
        return []

    def told(self, run, hit, error):
        """Status and message of a run that ended otherwise than the undisturbed one."""
        wrong = []
        wanted = set()
        for c in hit:
            wanted |= {"input": {3}, "folder": {3, 6}}.get(c.role, {6})
            if self.call.words.startswith("live"):
                # What a session has recorded is its input in the end; a source that fails ends it with what has come.
                wanted |= {3} if c.path.startswith("made/") else {self.calm.status} if c.role == "input" else set()
            if self.call.words.startswith("batch"):
                # A device that fails stops no other; with --resume results are inputs too.
                wanted |= {1, 3} if c.role == "input" else set()
                wanted |= {6} if c.path.startswith("out") else set()
        said = run.stderr + (run.stdout.decode(errors="replace") if "--json" in self.call.words else "")
        if self.call.words.startswith("batch") and run.status == 1:
            said += "".join(held.decode(errors="replace") for name, held in run.files.items() if name.endswith(".jsonl") and held)
        if run.status not in wanted:
            wrong.append(f"status {run.status} instead of {sorted(wanted)}: {run.stderr.strip()[:400]}")
        # A file beside a recording that is closed to the user is none of its; the message says what is missing.
        beside = error == "EACCES" and "the table" in said
        if os.strerror(getattr(errno, error)) not in said and not beside:
            wrong.append(f"the message lacks the reason ({error}): {said.strip()[:400]}")
        known = [c for c in hit if c.path != "."]
        if error == "EFBIG":
            known += [Traced("write", 0, name, "output", False) for name in self.calm.files]
        if known and not any(Path(c.shown.rstrip("~")).name in said for c in known):
            wrong.append(f"the message lacks the name {known[0].shown}: {said.strip()[:400]}")
        return wrong

    def half_files(self, run, hit, removal_failed):
        """Files that are neither as they were nor as the undisturbed run writes them, and what is left over."""
        wrong = []
        is_batch = self.call.words.startswith("batch ")
        for name, held in run.files.items():
            if name in self.before and held == self.before[name] or held == self.calm.files.get(name, b"?") or name in self.volatile:
                continue
            if held is None:
                if not removal_failed and not any(other.startswith(name + "/") for other in run.files):
                    wrong.append(f"leaves the empty folder {name}")
            elif PARTIAL.search(name):
                if not removal_failed:
                    wrong.append(f"leaves {name}")
            elif name.endswith(".html") and is_refusal(held, run.stderr):
                continue
            elif self.call.words.startswith("live") and held.endswith(b"\n") and grown(name, held, self.calm.files):
                continue
            elif is_batch and run.status == 1 and any(c.role == "input" for c in hit) and held.endswith(b"\n"):
                continue
            else:
                wrong.append(f"half a file: {name} has {len(held)} of {len(self.calm.files.get(name) or b'')} bytes")
        gone = [name for name in self.before if name not in run.files]
        return wrong + [f"{name} is gone" for name in gone]


def is_refusal(page, said):
    """Whether a report is whole and says why there is no calibration, as `calibrate` writes it then."""
    text = page.decode(errors="replace")
    reasons = [os.strerror(code) for code in (errno.EIO, errno.EACCES)]
    return text.rstrip().endswith("</html>") and any(reason in text and reason in said for reason in reasons)


def grown(name, held, calm):
    """Whether a file of a live session holds whole lines of what the undisturbed session records."""
    return bool(calm.get(name)) and calm[name].startswith(held) or name.endswith(".jsonl")


def parsed():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("program", type=Path)
    parser.add_argument("--quick", action="store_true", help="three commands: one that reads, one that writes a file, one that prints")
    parser.add_argument("--jobs", type=int, default=1)
    parser.add_argument("--only", nargs="+", default=[""], help="commands that contain one of these")
    parser.add_argument("--furnish", type=Path, help="only make the inputs in this new folder, to reproduce a violation by hand")
    parser.add_argument("--verbose", action="store_true", help="show which failures were without consequence, and why")
    return parser.parse_args()


def main():
    arguments = parsed()
    if not shutil.which("strace"):
        print("SKIPPED: strace is not here; apt install strace", file=sys.stderr)
        sys.exit(77)
    program = arguments.program.resolve()
    if arguments.furnish:
        arguments.furnish.mkdir()
        return furnish(program, arguments.furnish, quick=False)
    calls = [c for c in CALLS if any(part in c.name for part in arguments.only) and (c.quick or not arguments.quick)]
    with tempfile.TemporaryDirectory() as folder:
        folder = Path(folder).resolve()
        store = folder / "store"
        store.mkdir()
        furnish(program, store, arguments.quick)
        studies = [Study(program, store, folder / str(k), call) for k, call in enumerate(calls)]
        with ThreadPoolExecutor(arguments.jobs) as pool:
            for study in pool.map(lambda s: s.carry_out() or s, studies):
                report(study, arguments.verbose)
    summary(studies)


def report(study, verbose):
    print(f"{study.failed:5} failures, {len(study.violations):3} violations  {study.call.name}", flush=True)
    for how, wrong in study.violations:
        print(f"      VIOLATION  {wrong}\n        {how} stillpoint {shlex.join(study.call.words.split())}", flush=True)
    for missed in study.missed:
        print(f"      missed: {missed}")
    for reason, count in study.shrugged.items() if verbose else ():
        print(f"      {count:4} without consequence: {reason}")


def summary(studies):
    violations = sum(len(s.violations) for s in studies)
    missed = sum(len(s.missed) for s in studies)
    failed = sum(s.failed for s in studies)
    print(f"{len(studies)} commands, {failed} calls failed, {missed} not met again, {violations} violations")
    sys.exit(1 if violations or failed == 0 else 0)


if __name__ == "__main__":
    main()
