"""The command ``stillpoint``: the same program as the one that cargo builds."""

from __future__ import annotations

import sys

from ._native import run_command


def main() -> None:
    """Runs the command with the arguments of the process and ends it with the command's status."""
    sys.exit(run_command(sys.argv))


if __name__ == "__main__":
    main()
