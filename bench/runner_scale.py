#!/usr/bin/env python3
"""What the runner itself costs where there are many cases: a plan of 10,000, a catalogue of 100,000 runs, 2,000 short
cases on 8 workers, and two runners on one store.

    python3 bench/runner_scale.py build/release/bin/runner [FOLDER] > bench/<machine>/runner_scale.csv

The runs of the catalogue are copies of two real ones under other ids, with parameters and metrics of their own, put in
by SQL; everything else is computed. Prints a row per measurement. Ends with 1 when a count is not what it has to be.
"""
import collections
import hashlib
import json
import pathlib
import resource
import shutil
import sqlite3
import subprocess
import sys
import tempfile
import time

RUNNER = str(pathlib.Path(sys.argv[1]).resolve())
PLACE = pathlib.Path(sys.argv[2] if len(sys.argv) > 2 else tempfile.mkdtemp()).resolve()
SMALL = {"domain": {"width": "0.8 m", "height": "1.5 m"}, "grains": {"count": 200, "radius": {"min": "0.02 m", "max": "0.03 m"}}}
failed = []


def say(what, seconds, memory_mb, count):
    print(f"{what},{seconds:.3f},{memory_mb:.0f},{count}", flush=True)


def expect(what, found, wanted):
    if found != wanted:
        failed.append(f"{what}: {found}, not {wanted}")
        print(failed[-1], file=sys.stderr)


def run(*words):
    """Seconds, peak memory [MB] of all children so far, and the finished program."""
    start = time.perf_counter()
    done = subprocess.run([RUNNER, *words], cwd=PLACE, capture_output=True, text=True)
    peak = resource.getrusage(resource.RUSAGE_CHILDREN).ru_maxrss / 1024
    return time.perf_counter() - start, peak, done


def write(name, study):
    (PLACE / f"{name}.json").write_text(json.dumps({"study": name, "question": "How long does the runner take?", **study}))
    return f"{name}.json"


def identity(i):
    """A case id as they are: of no order."""
    return hashlib.sha256(str(i).encode()).hexdigest()


def planned():
    study = write("many", {"base": {"bed": SMALL, "pile": {"radius": "0.05 m", "depth": "0.3 m"}},
                           "axes": {"pile.tip": ["flat", "conical"],
                                    "pile.driving.constant.speed": [0.1, 0.15, 0.2, 0.3, 0.4],
                                    "bed.grains.friction.grain": [0.1, 0.2, 0.3, 0.4, 0.5]},
                           "replicates": {"seeds": 200}})
    seconds, memory, done = run("plan", study, "--store", "nothing")
    expect("plan", done.returncode, 0)
    say("plan of 10000 cases", seconds, memory, 10000)


def copied():
    """A store of two drives, whose rows are copied until there are 100,000 runs."""
    study = write("pair", {"base": {"bed": SMALL, "pile": {"radius": "0.05 m", "depth": "0.3 m",
                                                           "driving": {"constant": {"speed": 0.4}}}},
                           "axes": {"pile.tip": ["flat", "conical"]}})
    _, _, done = run("run", study, "--store", "large")
    expect("pair", done.returncode, 0)
    db = sqlite3.connect(PLACE / "large" / "catalogue.sqlite")
    db.execute("PRAGMA synchronous=OFF")
    drives = [row[0] for row in db.execute("SELECT run_id FROM run JOIN kase USING (case_id) WHERE kind = 'drive'")]
    tables = {t: [r[1] for r in db.execute(f"PRAGMA table_info({t})")]
              for t in ("kase", "run", "param", "metric", "artifact", "part", "numerics", "cost")}
    rows = {}
    for drive in drives:
        case = db.execute("SELECT case_id FROM run WHERE run_id = ?", (drive,)).fetchone()[0]
        for table in tables:
            key, value = ("case_id", case) if table in ("kase", "param") else ("run_id", drive)
            rows[drive, table] = db.execute(f"SELECT * FROM {table} WHERE {key} = ?", (value,)).fetchall()
    put = {t: f"INSERT INTO {t} VALUES ({','.join('?' * len(columns))})" for t, columns in tables.items()}
    for i in range(100_000 - 3):
        drive, case, run_id = drives[i % 2], identity(i), 1000 + i
        for table, columns in tables.items():
            new = []
            for row in rows[drive, table]:
                row = dict(zip(columns, row))
                if "case_id" in row:
                    row["case_id"] = case
                if "run_id" in row:
                    row["run_id"] = run_id
                if table == "run":
                    row["newest"] = 0
                if table == "param" and row["path"] == "bed.seed":
                    row["num"] = i
                if table == "metric" and row["name"] == "tip_resistance_mean":
                    row["value"] *= 1 + (i % 1000) / 1000
                new.append(tuple(row.values()))
            db.executemany(put[table], new)
    study_id = db.execute("INSERT INTO study (name, question, file_sha256) VALUES ('part', 'A hundred of them?', '')").lastrowid
    db.executemany("INSERT INTO study_case VALUES (?, ?, ?, '[]')", [(study_id, k, identity(k * 997)) for k in range(100)])
    db.commit()
    total = db.execute("SELECT count(*) FROM run").fetchone()[0]
    top = sorted(r[0] for r in db.execute("SELECT value FROM metric WHERE name = 'tip_resistance_mean'"))[-50]
    db.close()
    expect("runs in the catalogue", total, 100_000)
    size = (PLACE / "large" / "catalogue.sqlite").stat().st_size / 1e6
    print(f"# catalogue of 100000 runs: {size:.0f} MB", flush=True)
    for what, words in (("query of the largest resistances", ("query", f"kind = drive and tip_resistance_mean >= {top!r}")),
                        ("the same of flat tips", ("query", f"tip = flat and tip_resistance_mean >= {top!r}")),
                        ("query of a study of 100 cases", ("query", "part")),
                        ("the same by SQL", ("query", "--sql", "SELECT run.case_id, value FROM metric JOIN run USING (run_id) "
                                             f"WHERE name = 'tip_resistance_mean' AND value >= {top!r}"))):
        seconds, memory, done = run(*words, "--store", "large", "--format", "csv")
        expect(what, done.returncode, 0)
        say(what, seconds, memory, done.stdout.count("\n") - 1)
    seconds, memory, done = run("plan", study, "--seeds", "100", "--store", "large")
    expect("plan beside them", done.returncode, 0)
    say("plan of 200 cases with prices from 100000 runs", seconds, memory, 200)


def sealed(store):
    """How many runs each case has."""
    return collections.Counter(m.parent.parent.name for m in (PLACE / store / "cases").glob("*/*/manifest.json"))


def short_cases():
    bed = {"domain": {"width": "0.2 m", "height": "0.5 m"}, "grains": {"count": 3, "radius": {"min": "0.02 m", "max": "0.03 m"}}}
    study = write("short", {"base": {"bed": bed, "pile": None}, "replicates": {"seeds": 2000}})
    seconds, memory, done = run("run", study, "--jobs", "8", "--oversubscribe", "--store", "short")
    expect("2000 cases", done.returncode, 0)
    expect("cases done", len(sealed("short")), 2000)
    expect("cases done twice", [c for c, n in sealed("short").items() if n != 1], [])
    say("2000 short cases on 8 workers", seconds, memory, 2000)
    seconds, memory, done = run("run", study, "--store", "short")
    say("the same again: all fresh", seconds, memory, 2000)

    start = time.perf_counter()
    both = [subprocess.Popen([RUNNER, "run", study, "--seeds", "400", "--jobs", "4", "--oversubscribe", "--store", "both"], cwd=PLACE,
                             stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL) for _ in range(2)]
    expect("two runners", [one.wait() for one in both], [0, 0])
    expect("cases of two runners", sorted(sealed("both").values()), [1] * 400)
    say("400 short cases by two runners on one store", time.perf_counter() - start, memory, 400)


print("what,seconds,peak_mb,count")
planned()
copied()
short_cases()
if len(sys.argv) <= 2:
    shutil.rmtree(PLACE)
sys.exit(1 if failed else 0)
