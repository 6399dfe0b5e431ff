#!/usr/bin/env python3
"""Figures of studies: cases a second on one core and two, what a case costs beside its work, memory over 10,000 cases, a million rows collected.

    python3 benches/study.py [speed] [overhead] [memory] [rows[=NUMBER]]

Needs a release build (cargo build --release). Prints seconds of the clock and of the processors: on a machine that others load the latter say what
a case costs, and the former what is left of two cores.
"""
import json
import os
import statistics
import subprocess
import sys
import tempfile
import time
import zlib
from pathlib import Path

PROGRAM = Path(__file__).resolve().parent.parent / "target/release/windlass"
CART = """&DIMEN -DIMEN METERS KN
MEDIT
*G 0 0 0
&DESCRIBE BODY CART -IGNORE X Y RX RY RZ
*C 0 0 0
#WEIGHT *C %W% 1 1 1
~S GSPR BOTH Z 50 1E6 -LEN 0
CONNECTOR K ~S *C *G
END
&EQUI
&ENV -TIME {seconds} 0.1
TDOM
&SET Z = &TOKEN(3 &BODY(LOCATION CART))
&RESULT Z %Z% -UNIT m
"""
TRIVIAL = "&SET S = &NUMBER(REAL 2*%W%)\n&RESULT TWICE %S%\n"


def timed(*words):
    """Seconds of the clock, of the processors, and the largest memory of the process itself or one of its own (MB)."""
    begun = time.perf_counter()
    running = subprocess.Popen([PROGRAM, *words], stdout=subprocess.PIPE)
    said = running.stdout.read().decode()
    _, status, used = os.wait4(running.pid, 0)
    assert os.waitstatus_to_exitcode(status) == 0, said
    return time.perf_counter() - begun, used.ru_utime + used.ru_stime, used.ru_maxrss / 1024


def cases(folder, number):
    path = folder / f"cases{number}.csv"
    path.write_text("case,W\n" + "".join(f"C{n},{100 + n / 1000}\n" for n in range(number)))
    return path


def load():
    return f"load {os.getloadavg()[0]:.1f}"


def speed(folder):
    """200 cases of a second and more on one core and on two."""
    model = folder / "cart.cif"
    one = folder / "one.cif"
    seconds = 2000
    while True:
        one.write_text(CART.format(seconds=seconds).replace("%W%", "100"))
        took = timed("run", one, "--out", folder / "answers")[1]
        if took >= 1.1:
            break
        seconds = int(seconds * max(1.2, 1.2 / took))
    model.write_text(CART.format(seconds=seconds))
    made = {jobs: timed("study", cases(folder, 200), model, "--out", folder / f"S{jobs}", "--jobs", str(jobs)) for jobs in (1, 2)}
    (clock1, cpu1, _), (clock2, cpu2, _) = made[1], made[2]
    print(f"speed: a case alone {took:.3f} s of the processor; 200 cases: one core {clock1:.1f} s ({cpu1 / 200:.3f} s of the processor a case), "
          f"two cores {clock2:.1f} s ({cpu2 / 200:.3f} s); {100 * clock1 / clock2 / 2:.1f} % of twice one core by the clock, "
          f"{100 * cpu2 / clock2 / 2:.1f} % of two processors kept busy; {load()}")


def overhead(folder):
    """A case of two records: all of it is what a study costs."""
    model = folder / "trivial.cif"
    model.write_text(TRIVIAL)
    table = cases(folder, 200)
    made = [timed("study", table, model, "--out", folder / f"O{n}", "--jobs", "1") for n in range(5)]
    clock, cpu = (statistics.median(row[k] for row in made) / 200 * 1000 for k in (0, 1))
    print(f"overhead: {clock:.1f} ms a case by the clock, {cpu:.1f} ms of the processor (median of five, one case at a time); {load()}")


def memory(folder):
    """What the study itself holds, while 10,000 cases run."""
    model = folder / "trivial.cif"
    model.write_text(TRIVIAL)
    words = [PROGRAM, "study", cases(folder, 10000), model, "--out", folder / "M"]
    running = subprocess.Popen(words, stdout=subprocess.DEVNULL)
    held = []
    while running.poll() is None:
        done = sum(path.stat().st_size for path in (folder / "M").glob("results-*.jsonl"))
        try:
            status = Path(f"/proc/{running.pid}/status").read_text()
        except OSError:
            break
        fields = dict(line.split(":", 1) for line in status.splitlines() if line.startswith("Vm"))
        if "VmRSS" in fields:
            held.append((done, int(fields["VmRSS"].split()[0]) / 1024, int(fields["VmHWM"].split()[0]) / 1024))
        time.sleep(0.1)
    assert running.returncode == 0
    whole = max(done for done, _, _ in held)
    at = lambda share: next(rss for done, rss, _ in held if done >= share * whole)
    print(f"memory: {at(0.1):.1f} MB after 1,000 cases, {at(0.98):.1f} MB after 9,800, {held[-1][2]:.1f} MB at most, with the table; {load()}")


def record(n, kept):
    text = json.dumps({
        "case": f"C{n:07d}", "values": [["HEADING", str(n // 10 % 12 * 30)], ["HS", str(n // 120 / 1000)], ["TP", "12.5"], ["LOST", "NONE"], ["member", str(n % 10)]],
        "seed": n, "status": "done", "reason": "", "title": "A semi", "units": ["m", "kN"], "seconds": 9.8, "messages": [], "caveats": [],
        "results": [{"name": name, "value": n * 0.001 + k, "unit": "m"} for k, name in enumerate(kept)], "lines": [],
        "read": [{"path": f"scripts/study/{name}", "size": 1000, "hash": "ab" * 32} for name in ("storm.cif", "semi.cif", "data/semi.1", "data/semi.3")],
        "version": VERSION, "start": 1}, separators=(",", ":")).encode()
    return b"%08x %s\n" % (zlib.crc32(text), text)


def rows(folder, number=1_000_000):
    """A million rows of five inputs and ten results, of a hundred parts, into results.csv and results.parquet; with the extremes over ten seeds."""
    parts, study = 100, folder / "R"
    (study / "parts").mkdir(parents=True)
    names = [f"C{n:07d}" for n in range(number)]
    info = {"model": "storm.cif", "begun_in": "", "table": "cases.csv", "seed": 1, "version": VERSION, "start": 1, "cases": names}
    (study / "study.json").write_text(json.dumps(info))
    division = {"start": 1, "parts": parts, "model": "storm.cif", "begun_in": "", "columns": [], "keep": "nothing", "version": VERSION}
    (study / "parts/1.jsonl").write_text(json.dumps(division) + "\n")
    kept = [f"RESULT_{k}" for k in range(10)]
    for part in range(parts):
        with open(study / f"results-1-{part + 1}.jsonl", "wb") as file:
            file.writelines(record(n, kept) for n in range(part, number, parts))
    size = sum(path.stat().st_size for path in study.glob("results-*.jsonl")) / 1e6
    clock, cpu, most = timed("study", "collect", study)
    csv, parquet = ((study / name).stat().st_size / 1e6 for name in ("results.csv", "results.parquet"))
    print(f"rows: {number:,} rows of 10 results ({size:.0f} MB of records) collected in {clock:.1f} s, {cpu:.1f} s of the processor, "
          f"{most:.0f} MB of memory; CSV {csv:.0f} MB, Parquet {parquet:.0f} MB; {load()}")


VERSION = subprocess.run([PROGRAM, "--version"], stdout=subprocess.PIPE, text=True).stdout.split()[1]
if __name__ == "__main__":
    checks = {check.__name__: check for check in (speed, overhead, memory, rows)}
    for word in sys.argv[1:] or checks:
        name, _, number = word.partition("=")
        with tempfile.TemporaryDirectory() as folder:
            checks[name](Path(folder), *([int(number)] if number else []))
