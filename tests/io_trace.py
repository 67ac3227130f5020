"""Commands run under strace, and what their system calls are to the user, for `io_failures.py`."""

import os
import re
import resource
import shutil
import subprocess
import threading
from dataclasses import dataclass
from pathlib import Path

from io_calls import OLD

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


@dataclass
class Traced:
    """A system call on a file of the user: the how many-th of its name in its thread, and what the file is to the command."""

    name: str
    nth: int
    path: str
    role: str
    creates: bool
    injected: bool = False
    # The how many-th of its name at its file in its thread.
    nth_there: int = 0

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
        # Files that a run has made or changed, once that is known.
        self.written = set()

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

    def run(self, inject=None, only=(), traced=True, limit=None, piped=False):
        """Status, standard output, standard error, files and traced calls of one run; `only` paths are traced where some are named."""
        words = [str(self.program), *self.call.words.split()]
        if traced:
            chosen = ["-e", f"inject={inject}"] if inject else []
            chosen += [word for path in only for word in ("-P", path)]
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
        said = (said if said is not None else err.read_bytes()).decode(errors="replace")
        said = "".join(line for line in said.splitlines(True) if not line.startswith("strace: "))
        return Run(status, out.read_bytes(), said, files, calls)

    def traced_calls(self):
        """Calls on files of the user, thread by thread."""
        calls = []
        for trace in sorted(self.traces.iterdir(), key=lambda path: int(path.suffix[1:])):
            counts, there = {}, {}
            for line in trace.read_text(errors="replace").splitlines():
                match = LINE.match(line)
                if not match:
                    continue
                name, arguments, result = match.groups()
                counts[name] = counts.get(name, 0) + 1
                path = self.path_of(arguments)
                if path is not None:
                    there[name, path] = there.get((name, path), 0) + 1
                    hit = "(INJECTED)" in result
                    calls.append(Traced(name, counts[name], path, self.role_of(path), "O_CREAT" in arguments, hit, there[name, path]))
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
        words = ["", *self.call.words.split()]
        if any(word == path and not before.startswith("-") for before, word in zip(words, words[1:])):
            return "input"
        if path == "." or path in {str(Path(name).parent) for name in self.written}:
            return "folder"
        return "input" if path in self.before and path not in self.written | set(self.call.old.split()) else "output"


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
