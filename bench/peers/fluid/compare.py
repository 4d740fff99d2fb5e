#!/usr/bin/env python3
"""A step of the water in our solver beside FreeFEM and OpenFOAM, on one mesh (README.md).

  compare.py cost MACHINE    runs all, in turn: bench/peers/fluid/MACHINE/cost.csv
  compare.py table MACHINE   prints what is recorded

Runs follow one another on one core. Exit codes: 0 done, 1 a program failed, 2 bad options or a program that is not there,
130 interrupted; the table then holds the runs that were finished.
"""

import argparse
import os
import shutil
import signal
import sys
import tempfile
from pathlib import Path

from codes import CHECKED_STEPS, CHECKS, HERE, SETTINGS, PileBox, missing  # first: it adds the folder of the two below
from programs import ROOT, Failed, machine
from tables import print_table, read_csv, write_csv

COST = ["code", "version", "setting", "repeat", "vertices", "triangles", "unknowns", "dt", "steps", "cpu_per_step",
        "assembly_per_step", "solves", "factorisations", *CHECKS, "load"]
BASE = "ours", "water, 1e-8"  # of the ratios


def said(text):
    print(text, flush=True)


def cost(options, work):
    path = options.record / "cost.csv"
    box = PileBox(options.fluid_step, work, options.vertices, options.dt)
    kinds = [(code, setting) for code in options.codes for setting in SETTINGS[code]]
    checks = {kind: box.check(*kind) for kind in kinds}
    rows = []
    for repeat in range(1, options.repeat + 1):
        for code, setting in kinds:
            steps = options.steps if code != "freefem" else max(CHECKED_STEPS, options.steps // 5)
            row = box.run(code, setting, steps)
            rows.append(row | checks[code, setting] | {"repeat": repeat, "load": os.getloadavg()[0]})
            write_csv(path, COST, rows)
            said(f"{code}, {setting}: {row['cpu_per_step']:.3g} ms per step")


def print_recorded(options):
    path = options.record / "cost.csv"
    if not path.exists():
        sys.exit(f"compare.py: {options.record} has no cost.csv")
    rows = read_csv(path)
    kinds = list(dict.fromkeys((r["code"], r["setting"]) for r in rows))
    costs = {kind: sorted(r["cpu_per_step"] for r in rows if (r["code"], r["setting"]) == kind) for kind in kinds}
    median = lambda values: (values[(len(values) - 1) // 2] + values[len(values) // 2]) / 2
    base = costs.get(BASE)
    lines = []
    for kind in kinds:
        row = next(r for r in rows if (r["code"], r["setting"]) == kind)
        ratio = f"{median(costs[kind]) / median(base):.2f}" if base else "-"
        lines.append([*kind, f"{row['unknowns']:.0f}", f"{len(costs[kind])}", f"{costs[kind][0]:.3g}", f"{median(costs[kind]):.3g}", ratio,
                      f"{row['velocity_difference']:.1e}", f"{row['outflow']:.5f}", f"{row['kinetic_energy']:.4f}", f"{row['far_energy']:.4f}"])
    print_table(["code", "setting", "unknowns", "runs", "CPU ms / step, least", "median", "ratio of medians",
                 "velocity difference", "outflow", "energy J/m", "far energy J/m"], lines)
    loads = [r["load"] for r in rows]
    print(f"Load average while it was measured: {min(loads):.2f} to {max(loads):.2f}. "
          f"{rows[0]['vertices']:.0f} vertices, {rows[0]['triangles']:.0f} triangles, dt {rows[0]['dt']:g} s.")
    print("Versions: " + ", ".join(f"{code} {version}" for code, version in dict.fromkeys((r["code"], r["version"]) for r in rows)))


def arguments():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    commands = parser.add_subparsers(dest="command", required=True)
    for name, help_text in (("cost", "what a step costs"), ("table", "prints what is recorded")):
        p = commands.add_parser(name, help=help_text)
        p.add_argument("machine", help="name of the folder below bench/peers/fluid")
        if name == "table":
            continue
        p.add_argument("--fluid-step", default=ROOT / "build/release/bench/fluid_step", type=Path, help="the program")
        p.add_argument("--codes", type=lambda text: text.split(","), default=list(SETTINGS), help="with commas")
        p.add_argument("--vertices", type=int, default=1950, help="of the mesh, about")
        p.add_argument("--dt", type=float, default=1e-4, help="[s]")
        p.add_argument("--steps", type=int, default=1000, help="of a run; a fifth in FreeFEM")
        p.add_argument("--repeat", type=int, default=5, help="runs of each")
    options = parser.parse_args()
    options.record = HERE / options.machine
    if options.command == "cost":
        if unknown := set(options.codes) - set(SETTINGS):
            parser.error(f"--codes: {', '.join(sorted(unknown))} is not one of {', '.join(SETTINGS)}")
        if not 200 <= options.vertices <= 100_000:
            parser.error(f"--vertices: {options.vertices} is not between 200 and 100000")
        if not 1e-7 <= options.dt <= 0.1:
            parser.error(f"--dt: {options.dt} is not between 1e-7 and 0.1")
        if options.steps < CHECKED_STEPS or options.repeat < 1:
            parser.error(f"--steps is at least {CHECKED_STEPS}, --repeat at least 1")
    return options


def measure(options):
    def stop(*_):
        raise KeyboardInterrupt

    signal.signal(signal.SIGTERM, stop)
    work = Path(tempfile.mkdtemp(prefix="seapile-peers-"))
    try:
        machine(options.record / "cost_machine.txt")
        cost(options, work)
    except KeyboardInterrupt:
        print(f"compare.py: interrupted; {options.record} holds the runs that were finished", file=sys.stderr)
        sys.exit(130)
    finally:
        shutil.rmtree(work, ignore_errors=True)


def main():
    options = arguments()
    if options.command == "cost":
        lines = missing(options.codes, options.fluid_step)
        for line in lines:
            print(f"compare.py: {line}", file=sys.stderr)
        if lines:
            sys.exit(2)
    try:
        if options.command == "cost":
            measure(options)
        print_recorded(options)
    except Failed as failed:
        sys.exit(f"compare.py: {failed}")


if __name__ == "__main__":
    main()
