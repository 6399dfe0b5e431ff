#!/usr/bin/env python3
"""A study of 200 cases as a job array of Slurm on one node: some cases fail, a task is killed, the same command goes on.

    check.py WINDLASS

The end is the same as of a study in one piece on this machine: rows, kept answers. Needs root, and slurm-wlm and munge of Debian (.ci/peers
installs them).
"""
import csv
import os
import re
import subprocess
import sys
import tempfile
import time
from pathlib import Path

HERE = Path(__file__).resolve().parent
CASES = 200
# a body on a spring for some minutes: a tenth of a second or so of a development build; every fortieth case fails
MODEL = """&DIMEN -DIMEN METERS KN
MEDIT
*G 0 0 0
&DESCRIBE BODY CART -IGNORE X Y RX RY RZ
*C 0 0 0
#WEIGHT *C %W% 1 1 1
~S GSPR BOTH Z 50 1E6 -LEN 0
CONNECTOR K ~S *C *G
END
&ENV -TIME 300 0.1
TDOM
&EQUI
&SET Z = &TOKEN(3 &BODY(LOCATION CART))
&RESULT Z %Z% -UNIT m
&RESULT SEED_USED %SEED%
&IF %FAILS% .EQ. 1 &THEN
&NO_SUCH_RECORD
&ENDIF
"""


def table(path):
    with open(path) as file:
        return [{key: value for key, value in row.items() if key != "seconds (s)"} for row in csv.DictReader(file)]


def call(*words, code=0):
    made = subprocess.run(words, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True)
    assert made.returncode == code, f"{' '.join(map(str, words))}: {made.returncode}: {made.stdout[-2000:]}"
    return made.stdout


def wait_for(what, condition, seconds=300):
    end = time.monotonic() + seconds
    while not condition():
        assert time.monotonic() < end, f"{what} takes more than {seconds} s"
        time.sleep(0.2)


def queue():
    return call("squeue", "-h", "-r", "-o", "%i %T").split("\n")[:-1]


def check(windlass, folder):
    model, cases, study = folder / "model.cif", folder / "cases.csv", folder / "S"
    model.write_text(MODEL)
    rows = "".join(f"C{n},{100 + n},{int(n % 40 == 13)}\n" for n in range(CASES))
    cases.write_text("case,W,FAILS\n" + rows)
    call(windlass, "study", cases, model, "--out", folder / "whole", code=1)
    with open(folder / "whole" / "results.csv") as file:
        seconds = sum(float(row["seconds (s)"]) for row in csv.DictReader(file))
    # a dozen tasks
    command = [windlass, "study", cases, model, "--out", study, "--sample", "4", "--pack", f"{seconds / 60 / 12:.5f}"]
    command += ["--slurm", "--time=10", "--mem=200M"]
    said = call(*command)
    print(said, end="")
    array = re.search(r"job array (\d+)", said)[1]
    # the first task that is under way is killed
    wait_for("the first record", lambda: any(study.glob("results-1-*.jsonl")))
    victim = min(study.glob("results-1-*.jsonl")).stem.rsplit("-", 1)[1]
    call("scancel", "--signal=KILL", "--full", f"{array}_{victim}")
    call(*command, code=2)  # the jobs are not over
    wait_for("the array and what collects it", lambda: not queue())
    log = (study / "parts/1-collect.log").read_text()
    left = re.search(r"(\d+) left: the same command goes on", log)
    assert left, f"nothing is left by the killed task: {log}"
    rows = table(study / "results.csv")
    assert len(rows) == CASES - int(left[1]), f"{len(rows)} rows, {left[1]} left"
    print(f"task {victim} is killed, {left[1]} cases are left")
    said = call(*command)
    assert f"{CASES - int(left[1])} were done before" in said, said
    wait_for("the second array", lambda: not queue())
    log = (study / "parts/2-collect.log").read_text()
    assert log.startswith("200 cases: 195 done, 0 overloaded, 5 failed\n"), log
    assert table(study / "results.csv") == table(folder / "whole" / "results.csv"), "the tables differ"
    kept = lambda name: sorted(path.name for path in (folder / name / "cases").iterdir())
    assert kept("S") == kept("whole"), f"{kept('S')} for {kept('whole')}"
    files = sum(len(files) for _, _, files in os.walk(study)) - sum(len(files) for _, _, files in os.walk(study / "cases"))
    print(f"{CASES} cases, {files} files beside the kept answers")
    assert files < 60, f"{files} files"


def main():
    windlass = Path(sys.argv[1]).resolve()
    with tempfile.TemporaryDirectory() as folder:
        folder = Path(folder)
        # munge wants its socket within reach of all
        folder.chmod(0o755)
        os.environ["SLURM_CONF"] = str(folder / "slurm/slurm.conf")
        try:
            call(HERE / "one_node.sh", "start", folder / "slurm")
            check(windlass, folder)
        finally:
            subprocess.run([HERE / "one_node.sh", "stop", folder / "slurm"], check=False)


if __name__ == "__main__":
    try:
        main()
    except AssertionError as wrong:
        sys.exit(f"{wrong}")
