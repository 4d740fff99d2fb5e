#!/usr/bin/env python3
"""Our solver beside LAMMPS and LIGGGHTS on the pile-driving scene, from the same state (README.md).

  compare.py cost MACHINE    what a simulated second costs, and the overlaps that it leaves: bench/peers/MACHINE/cost.csv
  compare.py force MACHINE   the mean pile force of slow piles in several beds: bench/peers/MACHINE/force.csv
  compare.py tune MACHINE    what the peers' own settings change: bench/peers/MACHINE/tune.csv
  compare.py table MACHINE   prints what is recorded

Runs follow one another, one core each. Exit codes: 0 done, 1 a program failed or a table contradicts itself, 2 bad options
or a program that is not there, 130 interrupted; the tables then hold the runs that were finished.
"""

import argparse
import shutil
import signal
import sys
import tempfile
from pathlib import Path

from programs import HERE, OUR_USUAL, REFERENCE_STIFFNESS, ROOT, Failed, Scene, machine, missing, our_version
from report import print_cost, print_force
from tables import block_mean, read_csv, recorded, write_csv

COST = ["code", "version", "setting", "ranks", "solves", "kn", "dt", "simulated", "steps", "cpu", "cpu_per_s",
        "wall_per_s", "overlap_p999", "overlap_mean", "overlap_max", "contacts", "force_mean", "force_se",
        "kinetic_energy", "kinetic_energy_far", "tip", "speed", "seed", "solid_fraction", "start", "from", "end"]
STABLE = ["code", "version", "kn", "dt", "stable", "sound", "kinetic_energy_max", "kinetic_energy_far", "cpu_per_s", "reason"]
FORCE = ["code", "version", "seed", "solid_fraction", "tip", "speed", "solves", "kn", "dt", "from", "end", "force_mean",
         "force_se", "overlap_p999", "residual", "cpu_per_s", "grains"]
TUNE = ["code", "version", "change", "kn", "dt", "steps", "cpu_per_s"]
# Steps of the search for the largest stable one, at the reference stiffness [s]. The first is the usual one: an eighth of
# the time that two of the smallest grains touch.
FIRST_STEP, STEP_RISE, TRIAL_TIME = 2e-5, 2.5e-6, 0.1
# A run has exploded when its kinetic energy passes this many times the largest one at FIRST_STEP. It is sound when what
# moves far from the pile is no more than this many times that at FIRST_STEP: a step beyond shakes the bed and halves the
# pile's force long before it explodes.
EXPLODED, SOUND = 10, 2


def said(text):
    print(text, flush=True)


def scene(options, folder, seed, substeps, sweeps=()):
    return Scene(options.peer_scene, folder, {
        "seed": seed, "solid-fraction": options.solid_fraction, "tip": options.tip, "speed": options.speed,
        "grains": options.grains, "start": options.start, "from": options.from_depth, "end": options.end,
        "substeps": ",".join(str(n) for n in substeps), "moments": options.moments,
        "sweeps": ",".join(str(n) for n in sweeps) or None})


def completed(row, code, options, facts):
    mean, error = block_mean(row.pop("forces"), facts["from"], facts["end"])
    return row | {"code": code, "force_mean": mean, "force_se": error, "cpu_per_s": row["cpu"] / row["simulated"],
                  "wall_per_s": row["wall"] / row["simulated"], "tip": options.tip, "speed": options.speed,
                  "seed": facts["seed"], "solid_fraction": facts["solid_fraction"], "grains": options.grains, "start": facts["start"],
                  "from": facts["from"], "end": facts["end"]}


def our_rows(state, options):
    return [completed(row | {"version": our_version(), "ranks": 1,
                             "setting": "usual" if row["solves"] == OUR_USUAL else "other"},
                      "ours" if row["method"] == "soft" else "nonsmooth", options, state.facts)
            for row in state.ours]


def largest_steps(state, code, trials, path):
    """Rises from FIRST_STEP until a run explodes; each trial is a row of stable.csv. Returns the last step before, the
    last one below the first that is not sound, and the kinetic energy that counts as an explosion."""
    limit = far = stable = sound = None
    for k in range(100):
        dt = FIRST_STEP + k * STEP_RISE
        row = {"code": code, "kn": REFERENCE_STIFFNESS, "dt": dt, "reason": ""}
        try:
            row |= state.run(code, REFERENCE_STIFFNESS, dt, seconds=TRIAL_TIME, moments=0)
            limit, far = limit or EXPLODED * row["kinetic_energy_max"], far or SOUND * row["kinetic_energy_far"]
            row |= {"stable": int(row["kinetic_energy_max"] <= limit), "sound": int(row["kinetic_energy_far"] <= far),
                    "cpu_per_s": row["cpu"] / row["simulated"]}
        except Failed as failed:
            row |= {"stable": 0, "sound": 0, "reason": str(failed)}
        trials.append(row)
        write_csv(path, STABLE, trials)
        said(f"{code}: dt {dt:g} s is {'sound' if row['sound'] else 'not sound'}, {'stable' if row['stable'] else 'not stable'} "
             f"{row['reason']}")
        if not row["stable"]:
            break
        stable = dt
        if all(t["sound"] for t in trials if t["code"] == code):
            sound = dt
    if stable is None:
        raise Failed(f"{code} is not stable at {FIRST_STEP:g} s")
    return stable, sound, limit


def not_exploded(state, code, kn, dt, ranks, limit):
    """Runs at dt, or at what is left of it after steps of 5 % down when it explodes late."""
    for _ in range(5):
        try:
            row = state.run(code, kn, dt, ranks=ranks)
            if row["kinetic_energy_max"] <= limit:
                return row
            why = f"kinetic energy {row['kinetic_energy_max']:.3g} J/m"
        except Failed as failed:
            why = str(failed)
        said(f"{code}: kn {kn:g} N/m, dt {dt:.4g} s: {why}; 5 % less")
        dt *= 0.95
    raise Failed(f"{code} explodes at kn {kn:g} N/m")


def cost(options, work):
    path = options.record / "cost.csv"
    state = scene(options, work / "state", options.seed, options.substeps)
    rows, trials = our_rows(state, options), []
    write_csv(path, COST, rows)
    for code in options.codes:
        stable, sound, limit = largest_steps(state, code, trials, options.record / "stable.csv")
        for ranks in options.ranks:
            for kn in options.stiffness if ranks == 1 else [REFERENCE_STIFFNESS]:
                for setting, at_reference in (("largest stable", stable), ("largest sound", sound), ("usual", FIRST_STEP)):
                    dt = at_reference * (REFERENCE_STIFFNESS / kn) ** 0.5
                    row = not_exploded(state, code, kn, dt, ranks, limit)
                    rows.append(completed(row | {"setting": setting}, code, options, state.facts))
                    write_csv(path, COST, rows)
                    said(f"{code}: kn {kn:g} N/m, dt {row['dt']:.4g} s, {ranks} ranks: {rows[-1]['cpu_per_s']:.1f} CPU s per s")


def force(options, work):
    path = options.record / "force.csv"
    rows = read_csv(path) if options.keep and path.exists() else []
    asked = {"tip": options.tip, "speed": options.speed, "grains": options.grains, "from": options.from_depth, "end": options.end}
    if any(r[name] != (value if name == "tip" else recorded(value)) for r in rows for name, value in asked.items()):
        raise Failed(f"{path} has rows of another tip, speed, number of grains or depth: give those, or leave --keep")
    peers_usual = options.stiffness[0], options.dt
    for seed in range(options.first, options.seeds + 1):
        kept = [r for r in rows if r["seed"] == seed]
        ours = {(r["code"], r["solves"]): r["force_mean"] for r in kept}
        peers = {(r["code"], r["kn"], r["dt"]) for r in kept}
        substeps = [n for n in options.substeps if ("ours", n) not in ours]
        sweeps = [n for n in options.sweeps if ("nonsmooth", n) not in ours]
        codes = [code for code in options.codes if (code, *map(recorded, peers_usual)) not in peers]
        if not (substeps or sweeps or codes):
            continue
        # There is no state without a run of ours. The usual one is cheap, and shows that the state is the one of the rows.
        state = scene(options, work / f"seed_{seed}", seed, substeps or [OUR_USUAL], sweeps)
        new = our_rows(state, options)
        if (any(r["solid_fraction"] != recorded(state.facts["solid_fraction"]) for r in kept)
                or any(ours.get((r["code"], r["solves"]), recorded(r["force_mean"])) != recorded(r["force_mean"]) for r in new)):
            raise Failed(f"{path} has another bed or run of seed {seed}: give its options and program, or leave --keep")

        def add(new):
            rows.extend(row | {"seed": seed} for row in new)
            write_csv(path, FORCE, rows)
            for row in new:
                said(f"seed {seed}, {row['code']}: {row['force_mean']:.0f} N/m (block s.e. {row['force_se']:.0f})")

        add([row for row in new if (row["code"], row["solves"]) not in ours])
        for code in codes:
            add([completed(state.run(code, *peers_usual, sample=1), code, options, state.facts)])
        shutil.rmtree(state.folder)


def tune(options, work):
    """Each change alone, and what is used before and after all, because machines drift."""
    changes = {"lammps": [{"newton": "on"}, {"sort": 0}, {"sort": 100}, *({"skin": s} for s in (0.001, 0.002, 0.006)),
                          {"style": "granular"}, {"reach": 4}],
               "liggghts": [{"sort": 0}, {"sort": 100}, *({"skin": s} for s in (0.001, 0.002, 0.006))]}
    state, rows = scene(options, work / "state", options.seed, [OUR_USUAL]), []
    for code in options.codes:
        for change in [{}, *changes[code], {}]:
            row = state.run(code, REFERENCE_STIFFNESS, FIRST_STEP, seconds=TRIAL_TIME, moments=0, settings=change)
            text = " ".join(f"{k} {v}" for k, v in change.items()) or "as used"
            rows.append(row | {"code": code, "change": text, "cpu_per_s": row["cpu"] / row["simulated"]})
            write_csv(options.record / "tune.csv", TUNE, rows)
            said(f"{code}, {text}: {rows[-1]['cpu_per_s']:.1f} CPU s per s")


def print_recorded(options):
    found = False
    for name, show in (("cost.csv", print_cost), ("force.csv", lambda rows: print_force(rows, options.peer_pairs))):
        if (options.record / name).exists():
            found = True
            show(read_csv(options.record / name))
    if not found:
        sys.exit(f"compare.py: {options.record} has no cost.csv and no force.csv")


def arguments():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    commands = parser.add_subparsers(dest="command", required=True)
    numbers = lambda kind: lambda text: [kind(word) for word in text.split(",")]
    speed = {"cost": 0.4, "force": 0.06, "tune": 0.4, "table": None}
    for name, help_text in (("cost", "cost against overlap"), ("force", "mean pile force"), ("tune", "the peers' settings"),
                            ("table", "prints what is recorded")):
        p = commands.add_parser(name, help=help_text)
        p.add_argument("machine", help="name of the folder below bench/peers")
        p.add_argument("--peer-pairs", default=ROOT / "build/release/bench/peer_pairs", type=Path, help="the program of verdicts")
        if name == "table":
            p.set_defaults(codes=[], ranks=[])
            continue
        p.add_argument("--peer-scene", default=ROOT / "build/release/bench/peer_scene", type=Path, help="the program")
        p.add_argument("--codes", type=lambda text: [w for w in text.split(",") if w != "none"], default=["lammps", "liggghts"], help="peers, with commas; none: ours alone")
        p.add_argument("--tip", choices=["conical", "flat"], default="conical")
        p.add_argument("--speed", type=float, default=speed[name], help="of the pile [m/s]")
        p.add_argument("--grains", type=int, default=11596, help="in a box of the thesis' shape; the pile stays as it is")
        p.add_argument("--solid-fraction", type=float, help="target of the bed's preparation [-]")
        p.add_argument("--start", type=float, default=0.55, help="depth of the state [m]")
        p.add_argument("--from", dest="from_depth", type=float, default=0.6, help="depth from which all is measured [m]")
        p.add_argument("--end", type=float, default=0.8, help="depth at the end [m]")
        p.add_argument("--moments", type=int, default=25, help="at which overlaps are taken")
        if name == "force":
            p.add_argument("--seeds", type=int, default=8, help="beds: seeds 1 to this")
            p.add_argument("--first", type=int, default=1, help="the first of the seeds")
            p.add_argument("--dt", type=float, default=2e-5, help="of the peers [s]")
            p.add_argument("--sweeps", type=numbers(int), default=[],
                           help="of our non-smooth method, a run for each; its residual is in the table")
            p.add_argument("--keep", action="store_true", help="keep the rows that force.csv has, and add those that it lacks")
        else:
            p.add_argument("--seed", type=int, default=1, help="of the bed")
        if name != "tune":
            p.add_argument("--substeps", type=numbers(int), default=[5, 10, 20, 40] if name == "cost" else [OUR_USUAL])
            p.add_argument("--stiffness", type=numbers(float), default=[2e7, 5e7, 1e8, 2e8, 5e8] if name == "cost" else [1e8],
                           help="kn of the peers [N/m]")
        p.add_argument("--ranks", type=numbers(int), default=[1], help="processes; other than 1 only at kn = 1e8 N/m") \
            if name == "cost" else p.set_defaults(ranks=[1])
    options = parser.parse_args()
    options.record = HERE / options.machine
    if options.command != "table":
        unknown = set(options.codes) - {"lammps", "liggghts"}
        if unknown:
            parser.error(f"--codes: {', '.join(sorted(unknown))} is not lammps or liggghts")
        if not 100 <= options.grains <= 10_000_000:
            parser.error(f"--grains: {options.grains} is not between 100 and 10000000")
        if not 0 < options.start < options.from_depth < options.end < 1.5:
            parser.error("--start, --from, --end must rise, above 0 and below 1.5")
    if options.command == "force" and not 0 < options.first <= options.seeds:
        parser.error("--first must be above 0 and not above --seeds")
    return options


def programs(options):
    """Ours that the command runs."""
    if options.command == "table":
        return [options.peer_pairs] if (options.record / "force.csv").exists() else []
    return [options.peer_scene] if options.command == "tune" else [options.peer_scene, options.peer_pairs]


def measure(options):
    def stop(*_):
        raise KeyboardInterrupt

    signal.signal(signal.SIGTERM, stop)
    work = Path(tempfile.mkdtemp(prefix="seapile-peers-"))
    try:
        machine(options.record / f"{options.command}_machine.txt")
        {"cost": cost, "force": force, "tune": tune}[options.command](options, work)
    except KeyboardInterrupt:
        print(f"compare.py: interrupted; {options.record} holds the runs that were finished", file=sys.stderr)
        sys.exit(130)
    finally:
        shutil.rmtree(work, ignore_errors=True)


def main():
    options = arguments()
    lines = missing(options.codes, options.ranks, programs(options))
    for line in lines:
        print(f"compare.py: {line}", file=sys.stderr)
    if lines:
        sys.exit(2)
    try:
        if options.command != "table":
            measure(options)
        if options.command != "tune":
            print_recorded(options)
    except Failed as failed:
        sys.exit(f"compare.py: {failed}")


if __name__ == "__main__":
    main()
