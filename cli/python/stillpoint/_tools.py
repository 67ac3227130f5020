"""Commands that work on files: plan, batch, export and report, with their JSON as a dictionary."""

from __future__ import annotations

import json
import os
import subprocess
import sys
import tempfile
from typing import Any, Optional, Sequence, Union

from ._errors import exception
from ._results import Calibration, Findings

_Path = Union[str, "os.PathLike[str]"]


def _flags(options: dict[str, Any]) -> list[str]:
    """``placements=12`` as ``--placements 12``; True is a flag alone, a list gives the option once for each."""
    words: list[str] = []
    for name, value in options.items():
        flag = "--" + name.replace("_", "-")
        if value is None or value is False:
            continue
        for one in value if isinstance(value, (list, tuple)) else [value]:
            words += [flag] if one is True else [flag, os.fspath(one) if isinstance(one, os.PathLike) else str(one)]
    return words


def _run(words: Sequence[str]) -> dict[str, Any]:
    """Runs the command with ``--json`` in a process of its own, so that its output is its own."""
    call = [sys.executable, "-m", "stillpoint._command", *words, "--json"]
    done = subprocess.run(call, capture_output=True, text=True, check=False)
    try:
        document = json.loads(done.stdout or "{}")
    except ValueError:
        raise exception("bug", done.stdout + done.stderr, None, None, None, None) from None
    error = document.get("error") if isinstance(document, dict) else None
    if error:
        place = [error.get(key) for key in ("file", "line", "column", "next")]
        raise exception(error["kind"], error["message"], *place)
    return document


def plan(known: Optional[Union[Calibration, Findings]] = None, **options: Any) -> dict[str, Any]:
    """Placements and turns to record next: what ``stillpoint plan --json`` prints.

    Args:
        known: a calibration to improve, or findings whose names are to be told apart; None plans a first session.
        options: those of the command, such as ``placements=12``.
    """
    with tempfile.TemporaryDirectory() as folder:
        words = ["plan"]
        if known is not None:
            words.append(os.path.join(folder, "known.json"))
            with open(words[-1], "w", encoding="utf-8", newline="\n") as out:
                out.write(known.to_json())
        return _run(words + _flags(options))


def batch(devices: Union[_Path, Sequence[_Path]], out: _Path, **options: Any) -> dict[str, Any]:
    """Calibrates many devices into a folder: what ``stillpoint batch --json`` prints.

    Args:
        devices: a folder with a recording for each device, or manifest files.
        out: the folder for results.
        options: those of the command, such as ``gravity=9.81``.
    """
    given = [devices] if isinstance(devices, (str, os.PathLike)) else list(devices)
    return _run(["batch", *map(os.fspath, given), "-o", os.fspath(out), *_flags(options)])


def export(calibration: Calibration, to: str, out: _Path, **options: Any) -> dict[str, Any]:
    """Writes a calibration in another tool's form: what ``stillpoint export --json`` prints of what is lost.

    Args:
        to: the tool, such as ``kalibr``, ``px4``, ``ardupilot``, ``c-header``.
        out: the file to write.
        options: those of the command, such as ``force=True``.
    """
    with tempfile.TemporaryDirectory() as folder:
        own = os.path.join(folder, "cal.json")
        calibration.save(own)
        return _run(["export", own, "--to", to, "-o", os.fspath(out), *_flags(options)])


def report(recordings: Union[_Path, Sequence[_Path]], out: _Path, **options: Any) -> dict[str, Any]:
    """Calibrates recordings and writes the report, one HTML file: what ``stillpoint calibrate --json`` prints.

    Args:
        recordings: files or folders.
        out: the file to write.
        options: those of the command, such as ``latitude=48.1``.
    """
    given = [recordings] if isinstance(recordings, (str, os.PathLike)) else list(recordings)
    return _run(["calibrate", *map(os.fspath, given), "--report", os.fspath(out), *_flags(options)])
