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
import re
import resource
import shlex
import shutil
import signal
import subprocess
import sys
import tempfile
import threading
from concurrent.futures import ThreadPoolExecutor
from dataclasses import dataclass
from pathlib import Path

from io_calls import CALLS, OLD, furnish

ERRORS = {
    "openat": ["EIO", "EACCES", "EINTR"],
    "create": ["ENOSPC", "EACCES", "EINTR"],
    "read": ["EIO", "EINTR"],
    "write": ["EIO", "ENOSPC", "EINTR"],
    "fsync": ["EIO", "ENOSPC", "EINTR"],
    "rename": ["EIO", "EACCES"],
    "mkdir": ["EACCES", "ENOSPC"],
    "ftruncate": ["EIO", "EINTR"],
    "stat": ["EIO", "EACCES"],
    "other": ["EIO"],
}
KINDS = {
    "pread64": "read", "readv": "read", "preadv": "read", "pwrite64": "write", "writev": "write", "fdatasync": "fsync",
    "renameat": "rename", "renameat2": "rename", "link": "rename", "linkat": "rename", "mkdirat": "mkdir", "statx": "stat",
    "newfstatat": "stat", "fstat": "stat", "lstat": "stat", "fchmod": "rename", "copy_file_range": "write", "sendfile": "write",
}
TRACED = sorted({"openat", "read", "write", "fsync", "rename", "mkdir", "ftruncate", "stat", "close", "unlink", "unlinkat", "rmdir",
                 "lseek", "getdents64", "readlink", "mmap"} | set(KINDS))
REMOVALS = {"unlink", "unlinkat", "rmdir"}
LINE = re.compile(r"^(\w+)\((.*)\)\s+= (.*)$")
PARTIAL = re.compile(r"\.([^/]*)\.stillpoint-\d+-\w{10}\.partial")

# A call that may fail without a word, and why; the result is that of the undisturbed run all the same.
SHRUGGED = [
    (lambda c: c.role == "input" and c.name == "getdents64", "whether an output is an input shows by its name, and the folder is read again"),
    (lambda c: c.role == "stderr", "standard error is for people, and may be closed"),
    (lambda c: c.name == "close", "outputs are on the disk before they are closed, inputs are read"),
    (lambda c: c.role == "folder" and c.name in ("openat", "fsync"), "not every file system locks or syncs a folder"),
    (lambda c: c.path.endswith("~") and c.kind == "openat", "a claim that cannot be looked at costs the message about a second run"),
    (lambda c: c.role == "folder" and c.name == "getdents64", "leftovers of killed runs wait for the next run"),
    (lambda c: c.kind == "stat" or c.name in ("readlink", "lseek"), "what is asked here shows in what follows"),
    (lambda c: c.name in REMOVALS, "what cannot be removed stays, and is not the result"),
    (lambda c: c.role == "input" and c.kind in ("openat", "read"), "it was a first look; the file is read again from its beginning"),
]


@dataclass
class Traced:
    """A system call on a file of the user: the how many-th of its name in its thread, and what the file is to the command."""

    name: str
    nth: int
    path: str
    role: str
    creates: bool
    injected: bool = False

    @property
    def kind(self):
        kind = KINDS.get(self.name, self.name)
        return "create" if self.creates else kind if kind in ERRORS else "other"

    @property
    def shown(self):
        """The path as a message has it."""
        return {"stdout": "standard output", "stdin": "<stdin>"}.get(self.path, self.path)


class Bench:
    """A folder in which a command runs again and again, furnished anew before each run."""

    def __init__(self, program, store, place, call):
        self.program, self.store, self.call = program, store, call
        self.folder, self.streams, self.traces = place / "w", place / "streams", place / "traces"
        for folder in (self.folder, self.streams, self.traces):
            folder.mkdir(parents=True)
        for name in call.reads.split():
            source = store / name
            (shutil.copytree if source.is_dir() else shutil.copy2)(source, self.folder / name)
        for name in call.old.split():
            (self.folder / name).parent.mkdir(exist_ok=True)
            (self.folder / name).write_bytes(OLD)
        self.before = self.snapshot()

    def snapshot(self):
        """Files with their bytes; folders with nothing."""
        found = {}
        for path in sorted(self.folder.rglob("*")):
            found[str(path.relative_to(self.folder))] = None if path.is_dir() else path.read_bytes()
        return found

    def restore(self, after):
        for name in sorted(set(after) - set(self.before), reverse=True):
            path = self.folder / name
            path.rmdir() if path.is_dir() else path.unlink()
        for name, held in self.before.items():
            if held is None:
                (self.folder / name).mkdir(exist_ok=True)
            elif after.get(name) != held:
                (self.folder / name).write_bytes(held)

    def run(self, inject=None, traced=True, limit=None, piped=False):
        """Status, standard output, standard error, files and traced calls of one run."""
        words = [str(self.program), *self.call.words.split()]
        if traced:
            chosen = ["-e", f"inject={inject}"] if inject else []
            words = ["strace", "--seccomp-bpf", "-f", "-ff", "-qq", "-y", "-s", "0", "-o", str(self.traces / "t"), "-e", f"trace={','.join(TRACED)}",
                     "-e", "signal=none", *chosen, *words]
        env = dict(os.environ, RAYON_NUM_THREADS="1", NO_COLOR="1")
        limited = (lambda: resource.setrlimit(resource.RLIMIT_FSIZE, (limit, limit))) if limit is not None else None
        source = self.store / self.call.stdin if self.call.stdin else None
        given = self.streams / "in"
        given.write_bytes(source.read_bytes() if source else b"")
        out, err = self.streams / "out", self.streams / "err"
        try:
            with open(given, "rb") as stdin, open(out, "wb") as stdout, open(err, "wb") as stderr:
                process = subprocess.Popen(words, cwd=self.folder, env=env, stdin=subprocess.PIPE if piped else stdin, stdout=stdout,
                                           stderr=subprocess.PIPE if limited else stderr, preexec_fn=limited)
                if piped:
                    threading.Thread(target=trickle, args=(process.stdin, given.read_bytes()), daemon=True).start()
                    status = process.wait(timeout=120)
                    said = None
                else:
                    said = process.communicate(timeout=120)[1]
                    status = process.returncode
        except subprocess.TimeoutExpired:
            process.kill()
            process.wait()
            status, said = "hangs", None
        files = self.snapshot()
        self.restore(files)
        calls = self.traced_calls() if traced else []
        return Run(status, out.read_bytes(), (said if said is not None else err.read_bytes()).decode(errors="replace"), files, calls)

    def traced_calls(self):
        """Calls on files of the user, thread by thread."""
        calls = []
        for trace in sorted(self.traces.iterdir(), key=lambda path: int(path.suffix[1:])):
            counts = {}
            for line in trace.read_text(errors="replace").splitlines():
                match = LINE.match(line)
                if not match:
                    continue
                name, arguments, result = match.groups()
                counts[name] = counts.get(name, 0) + 1
                path = self.path_of(arguments)
                if path is not None:
                    role = self.role_of(path)
                    calls.append(Traced(name, counts[name], path, role, "O_CREAT" in arguments, "(INJECTED)" in result))
            trace.unlink()
        return calls

    def path_of(self, arguments):
        """The file of a call, relative to the folder of the run; `None` for libraries, the system's files and pipes."""
        found = None
        base = self.folder
        for fd, opened, text in re.findall(r'(\d+|AT_FDCWD)<([^<>]*)>|"([^"]*)"', arguments):
            path = (base / text) if text else Path(opened.removesuffix(" (deleted)"))
            if fd:
                base = path
            if fd == "AT_FDCWD" or not (fd or text):
                continue
            path = Path(os.path.normpath(path))
            if path.parent == self.streams:
                found = f"std{path.name}"
            elif path == self.folder or self.folder in path.parents:
                found = PARTIAL.sub(r"\1", str(path.relative_to(self.folder)))
                found = found if not PARTIAL.search(str(path)) else found + "~"
        return found

    def role_of(self, path):
        """What a file is to the command."""
        if path in ("stdin", "stdout", "stderr"):
            return {"stdin": "input"}.get(path, path)
        if path.endswith("~"):
            return "output"
        if path == "." or path in {str(Path(name).parent) for name in self.outputs()}:
            return "folder"
        return "input" if path in self.before and path not in self.call.old.split() else "output"

    def outputs(self):
        return getattr(self, "written", set())


def trickle(pipe, data):
    """Seven bytes at a time, so that each read is short."""
    try:
        for at in range(0, len(data), 7):
            os.write(pipe.fileno(), data[at:at + 7])
        pipe.close()
    except OSError:
        pass


@dataclass
class Run:
    """What a run has left."""

    status: object
    stdout: bytes
    stderr: str
    files: dict
    calls: list

    def same_as(self, other, volatile):
        alike = {name: held for name, held in self.files.items() if name not in volatile}
        return (self.status, self.stdout) == (other.status, other.stdout) and alike == {
            name: held for name, held in other.files.items() if name not in volatile}


class Study:
    """One command: the undisturbed run, and all disturbed ones judged by it."""

    def __init__(self, program, store, place, call):
        self.bench = Bench(program, store, place, call)
        self.call, self.before = call, self.bench.before
        self.violations, self.shrugged, self.missed, self.failed = [], {}, [], 0

    def carry_out(self):
        bench = self.bench
        first = bench.run()
        bench.written = set(first.files) - set(self.before)
        self.calm, again = bench.run(), bench.run(traced=False)
        # Times of a run differ from run to run.
        self.volatile = {name for name in self.calm.files if self.calm.files[name] != first.files.get(name)}
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
        inject = f"{call.name}:error={error}:when={call.nth}"
        for _ in range(3):
            run = self.bench.run(inject)
            hit = [c for c in run.calls if c.injected]
            # Partial files have random names, which a folder lists in another order each time.
            if any(c.name == call.name and (c.path == call.path or c.path[-1] == call.path[-1] == "~") for c in hit):
                break
        else:
            self.missed.append(f"{inject} {call.path}")
            return
        self.failed += 1
        if wrong := self.judged(run, hit, error):
            self.violations.append((f"strace -f -o /dev/null -e inject={inject}", f"{call.name} of {call.path}: {'; '.join(wrong)}"))

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
            if self.call.words.startswith("batch") and c.role == "input":
                wanted |= {1}
        said = run.stderr + (run.stdout.decode(errors="replace") if "--json" in self.call.words else "")
        if self.call.words.startswith("batch") and run.status == 1:
            said += "".join(held.decode(errors="replace") for name, held in run.files.items() if name.endswith(".jsonl") and held)
        if run.status not in wanted:
            wrong.append(f"status {run.status} instead of {sorted(wanted)}: {run.stderr.strip()[:400]}")
        if os.strerror(getattr(errno, error)) not in said:
            wrong.append(f"the message lacks the reason ({error}): {said.strip()[:400]}")
        known = [c for c in hit if c.path != "."]
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
    parser.add_argument("--quick", action="store_true", help="four commands: a reader, a file replaced, a folder, standard output")
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
