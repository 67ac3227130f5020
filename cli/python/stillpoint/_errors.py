"""What is wrong, where, and what to do."""

from __future__ import annotations

from typing import Optional


class StillpointError(Exception):
    """What is wrong with a recording, a file or a call.

    Attributes:
        kind: ``usage``, ``input``, ``not_enough_information``, ``not_converged``, ``output``, ``cancelled`` or ``bug``.
        message: what was found and what is expected.
        file: the file, or None.
        line: line of the file or row of the arrays, from 1, or None.
        column: byte of that line, or column of the arrays (t, ax, ay, az, gx, gy, gz, temperature), from 1, or None.
        next: what to do about it, or None.
    """

    def __init__(
        self,
        message: str,
        kind: str = "bug",
        file: Optional[str] = None,
        line: Optional[int] = None,
        column: Optional[int] = None,
        next: Optional[str] = None,
    ) -> None:
        super().__init__(message)
        self.kind = kind
        self.message = message
        self.file = file
        self.line = line
        self.column = column
        self.next = next

    def __reduce__(self):
        fields = (self.message, self.kind, self.file, self.line, self.column, self.next)
        return (type(self), fields)


class UsageError(StillpointError, ValueError):
    """A call that contradicts itself or lacks something."""


class InputError(StillpointError, ValueError):
    """A file or an array that is unreadable or no recording."""


class NotEnoughInformation(StillpointError):
    """Recordings that do not determine what was asked for."""


class NotConverged(StillpointError):
    """A fit that did not reach a minimum."""


class OutputError(StillpointError, OSError):
    """A file that could not be written."""


class Cancelled(StillpointError):
    """Work that was ended."""


_CLASSES = {
    "usage": UsageError,
    "input": InputError,
    "not_enough_information": NotEnoughInformation,
    "not_converged": NotConverged,
    "output": OutputError,
    "cancelled": Cancelled,
}


def exception(kind, message, file, line, column, next) -> StillpointError:
    """The exception of a kind; called by the compiled part."""
    made = _CLASSES.get(kind, StillpointError)
    return made(message, kind, file, line, column, next)
