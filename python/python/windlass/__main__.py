"""The program `windlass`: `python -m windlass job.cif`, `python -m windlass --help`."""

import sys

from ._core import run_program


def main() -> int:
    """Runs the program with the arguments of this process; returns its exit code."""
    return run_program(["windlass", *sys.argv[1:]], sys.executable)


if __name__ == "__main__":
    sys.exit(main())
