"""Runs one program at a time and says what it cost: ours, LAMMPS or LIGGGHTS."""

import csv
import io
import json
import math
import os
import platform
import re
import shutil
import subprocess
from pathlib import Path

from tables import write_text

HERE = Path(__file__).resolve().parent
ROOT = HERE.parent.parent
REFERENCE_STIFFNESS = 1e8  # [N/m]
REFERENCE_DAMPING = 1.1e4  # gamma_n at that stiffness [1/s]: 0.3 of critical for the smallest grains
OUR_USUAL = 10  # sub-steps
FORCE_WINDOW = 1e-3  # [s] over which peers average the pile's force

# What was found fastest (README.md).
SETTINGS = {
    "lammps": {"newton": "off", "skin": 0.003, "sort": 1000, "style": "hooke", "reach": 0.6},
    "liggghts": {"newton": "off", "skin": 0.003, "sort": 1000},
}
PROGRAM = {"lammps": "lmp", "liggghts": "liggghts"}


class Failed(Exception):
    """A program ended with an error; the text is one line."""


def missing(codes, ranks, ours):
    """One line for each program that is not there."""
    lines = []
    for code in codes:
        if code in PROGRAM and not shutil.which(PROGRAM[code]):
            lines.append(f"{PROGRAM[code]} is not installed (Debian package {code}; bench/peers/packages.txt)")
    if any(n > 1 for n in ranks) and not shutil.which("mpirun"):
        lines.append("mpirun is not installed (Debian package openmpi-bin; bench/peers/packages.txt)")
    for program in ours:
        if not os.access(program, os.X_OK):
            lines.append(f"{program} is not built (cmake --build --preset release --target {program.name})")
    return lines


def execute(command, log):
    """Runs a command to its end, output into the file `log`. Returns CPU seconds, user and system, of it and its children.
    A program that is still running when this is left, by Ctrl-C too, is ended."""
    environment = dict(os.environ, OMP_NUM_THREADS="1")
    if os.geteuid() == 0:
        environment |= {"OMPI_ALLOW_RUN_AS_ROOT": "1", "OMPI_ALLOW_RUN_AS_ROOT_CONFIRM": "1"}
    with open(log, "wb") as output:
        child = subprocess.Popen(command, stdin=subprocess.DEVNULL, stdout=output, stderr=subprocess.STDOUT,
                                 cwd=log.parent, env=environment, start_new_session=True)
        try:
            _, status, usage = os.wait4(child.pid, 0)
            child.returncode = os.waitstatus_to_exitcode(status)
        finally:
            if child.returncode is None:
                child.terminate()
                try:
                    child.wait(10)
                except subprocess.TimeoutExpired:
                    child.kill()
                    child.wait()
    if child.returncode != 0:
        lines = log.read_text(errors="replace").splitlines()
        why = [l for l in lines if "ERROR" in l and "ORTE" not in l] or [l for l in lines if l.strip()] or ["no output"]
        raise Failed(f"{Path(command[0]).name} ended with {child.returncode}: {why[-1 if 'ERROR' not in why[0] else 0].strip()}")
    return usage.ru_utime + usage.ru_stime


def equivalence(peer_pairs, pairs, margin):
    """What peer_pairs says of pairs (a, b): whether b / a is 1 within the margin."""
    text = "".join(f"{a!r} {b!r}\n" for a, b in pairs)
    done = subprocess.run([str(Path(peer_pairs).resolve()), f"--margin={margin!r}"], input=text, capture_output=True, text=True)
    if done.returncode != 0:
        raise Failed(done.stderr.strip() or f"{peer_pairs} ended with {done.returncode}")
    return json.loads(done.stdout)


def rows_of(text):
    return [{k: v if k == "method" else float(v) for k, v in row.items()} for row in csv.DictReader(io.StringIO(text))]


class Scene:
    """The state that all start from, in `folder`, and our runs from it."""

    def __init__(self, peer_scene, folder, options):
        self.peer_scene, self.folder = Path(peer_scene).resolve(), folder
        folder.mkdir(parents=True, exist_ok=True)
        arguments = [f"--{name}={value}" for name, value in options.items() if value is not None]
        execute([str(self.peer_scene), "ours", f"--out={folder}", *arguments], folder / "ours.log")
        self.facts = json.loads((folder / "state.json").read_text())
        self.ours = rows_of((folder / "ours.csv").read_text())
        for row in self.ours:
            name = f"{row['method']}_{row['solves']:.0f}"
            series = rows_of((folder / f"force_{name}.csv").read_text())
            # Of the non-smooth method next to nothing overlaps: there is nothing to compare.
            if row["method"] == "soft" and not 0.75 < row["overlap_p999"] / row["recorded_p999"] < 1.33:
                raise Failed(f"the overlaps of {name}, {row['overlap_p999']}, contradict our records, {row['recorded_p999']}")
            row["forces"] = [(r["depth"], r["span"], r["force"]) for r in series]

    def overlaps(self, dump, dt):
        log = dump.with_suffix(".overlaps")
        execute([str(self.peer_scene), "overlaps", f"--state={self.folder / 'state.json'}", f"--dt={dt!r}", str(dump)], log)
        return rows_of(log.read_text())[0]

    def run(self, code, kn, dt, *, ranks=1, seconds=None, moments=25, sample=10, settings=None):
        """Runs a peer from the state for `seconds`, or to the scene's end. Returns its row: cost without set-up and output,
        overlaps and forces (depth, weight, force)."""
        f = self.facts
        to_end = (f["end"] - f["start"]) / f["speed"]
        steps = round((to_end if seconds is None else seconds) / dt)
        window = max(1, round(FORCE_WINDOW / (dt * sample))) * sample
        damping = REFERENCE_DAMPING * (kn / REFERENCE_STIFFNESS) ** 0.5
        name = f"{code}_{kn:g}_{dt:g}_{ranks}"
        dump, force = self.folder / f"{name}.dump", self.folder / f"{name}.force"
        variables = SETTINGS[code] | (settings or {}) | {
            "data": self.folder / "state.data", "mesh": self.folder / "pile.stl",
            "kn": kn, "kt": kn / 2, "gamma": damping, "dt": dt, "speed": f["speed"], "gravity": f["gravity"],
            "friction_grain": f["friction_grain"], "friction_wall": f["friction_wall"], "friction_pile": f["friction_pile"],
            "half_width": f["width"] / 2, "tip_y": f["pile_y"], "tip_height": f["tip_height"], "pile_radius": f["pile_radius"],
            "pile_length": f["pile_length"], "travel": f["end"] - f["start"], "ranks": ranks,
            "sample": sample, "repeat": window // sample, "window": window, "force_file": force, "dump_file": dump}
        setup = self._command(code, ranks, variables | {"steps": 0, "thermo": 1, "sample": 0, "dump_every": 0})
        cpu_setup = execute(setup, self.folder / f"{name}.setup")
        dump_every = round((f["end"] - f["from"]) / f["speed"] / dt / moments) if moments else 0
        log = self.folder / f"{name}.log"
        command = self._command(code, ranks, variables | {"steps": steps, "thermo": max(1, steps // 50), "dump_every": dump_every})
        cpu = execute(command, log) - cpu_setup

        text = log.read_text()
        loop = float(re.search(r"Loop time of (\S+)", text)[1])
        written = re.search(r"^Output +\| *\S+ *\| *(\S+)|^Outpt time \(%\) = (\S+)", text, re.MULTILINE)
        share = float(written[1] or written[2]) / loop
        energies = [(float(m[1]), float(m[2])) for m in re.finditer(r"^ *\d+ +(\S+) +(\S+) *$", text, re.MULTILINE)]
        row = {"version": version(text), "kn": kn, "dt": dt, "ranks": ranks, "steps": steps, "simulated": steps * dt,
               "cpu": cpu * (1 - share), "wall": loop * (1 - share), "kinetic_energy": energies[-1][0],
               "kinetic_energy_max": max(e if math.isfinite(e) else math.inf for e, _ in energies),
               "kinetic_energy_far": sum(far for _, far in energies) / len(energies)}
        if moments:
            row |= self.overlaps(dump, dt)
            dump.unlink()
        values = [line.split() for line in force.read_text().splitlines() if not line.startswith("#")]
        row["forces"] = [(f["start"] + f["speed"] * dt * (float(step) - window / 2), 1.0, float(value)) for step, value in values]
        return row

    @staticmethod
    def _command(code, ranks, variables):
        launch = ["mpirun", "-np", str(ranks), "--bind-to", "none"] if ranks > 1 else []
        words = [word for name, value in variables.items() for word in ("-var", name, f"{value}")]
        return [*launch, PROGRAM[code], "-nocite", "-log", "none" if code == "lammps" else "/dev/null",
                "-in", str(HERE / f"{code}.in"), *words]


def version(text):
    found = re.search(r"LAMMPS \((.+?)\)|LIGGGHTS-PUBLIC (\S+?),", text)
    return (found[1] or found[2]).replace(" - ", " ") if found else "unknown"


def our_version():
    git = subprocess.run(["git", "-C", str(ROOT), "describe", "--always", "--dirty"], capture_output=True, text=True)
    return git.stdout.strip() or "unknown"


def machine(path):
    """What the figures were measured on."""
    model = re.search(r"model name\s*: (.+)", Path("/proc/cpuinfo").read_text())
    load = " ".join(f"{v:.2f}" for v in os.getloadavg())
    write_text(path, f"{model[1] if model else platform.processor()}, {os.cpu_count()} cores; {platform.system()} "
                     f"{platform.release()}; load at the start {load}; seapile {our_version()}\n")
