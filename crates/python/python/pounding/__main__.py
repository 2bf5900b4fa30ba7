"""The command line: ``python -m pounding`` and the script ``pounding``."""

from __future__ import annotations

import sys

from . import _native


def main() -> None:
    """Does what the arguments of this process ask for, and ends it with the exit code."""
    sys.exit(_native.command_line(sys.argv[1:]))


if __name__ == "__main__":
    main()
