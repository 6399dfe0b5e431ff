"""Studies: a table of cases, a process each, and their results as tables.

    >>> made = windlass.study.run("cases.csv", "model.cif", "out")
    >>> made.results.to_pandas()
    >>> made.ensembles.to_pandas()       # MPM and fractiles over seeds, with their intervals
"""

from __future__ import annotations

import os
import subprocess
import sys
from typing import NamedTuple

from ._core import Table, read_study
from .errors import Error

__all__ = ["Study", "read", "run"]

Path = str | os.PathLike[str]

#: Exit codes of `windlass study` behind which the tables stand: done, and done but for failed cases.
_WRITTEN = (0, 1)


class Study(NamedTuple):
    """A study as it stands in its folder."""

    #: A row a case: its columns, seed, status, reason, and what the script kept by `&RESULT` and `-RESULT`.
    results: Table
    #: A row a line of each case, where the script has lines.
    lines: Table
    #: Extremes over seeds: a row a result of each ensemble, cases that differ in their seeds alone. No column where no two cases do.
    ensembles: Table
    #: Checks of lines over seeds: a row a segment of each ensemble whose script ends in CODE_CHECK. No column where there is none.
    seed_checks: Table
    #: What the program said at the end.
    summary: str


def read(folder: Path) -> Study:
    """The tables of a study, done or under way."""
    return Study(*read_study(folder), "")


def run(
    table: Path,
    model: Path,
    out: Path,
    *,
    jobs: int | None = None,
    seed: int = 1,
    keep: str = "governing",
    retry_failed: bool = False,
) -> Study:
    """Runs the cases of `table` (CSV, or a grid in TOML) with the script `model`, and reads what came of them.

    Cases that are done in the folder `out` and have not changed are not run again. `keep` says which cases keep their answers: none, failed,
    governing, all. A failed case is a row of the results with its reason, not an exception; a wrong table is `windlass.Error`. Ctrl-C stops
    the study: the same call goes on where it was.
    """
    command = [sys.executable, "-m", "windlass", "study", os.fspath(table), os.fspath(model)]
    command += ["--out", os.fspath(out), "--seed", str(seed), "--keep", keep]
    if jobs is not None:
        command += ["--jobs", str(jobs)]
    if retry_failed:
        command.append("--retry-failed")
    done = subprocess.run(command, stdin=subprocess.DEVNULL, capture_output=True, text=True, check=False)
    if done.returncode not in _WRITTEN or not os.path.isfile(os.path.join(out, "results.csv")):
        raise Error((done.stderr or done.stdout).strip() or f"the study ended with exit code {done.returncode}")
    return read(out)._replace(summary=done.stdout)
