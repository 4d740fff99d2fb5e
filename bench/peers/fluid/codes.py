"""Runs one code at a time on the pile box and says what a step cost: ours, FreeFEM or OpenFOAM."""

import csv
import math
import os
import re
import shutil
import sys
from pathlib import Path

HERE = Path(__file__).resolve().parent
sys.path.append(str(HERE.parent))

from foam_mesh import THICKNESS, internal, numbers, patch_text, read_mesh, vectors, write_prisms  # noqa: E402
from programs import Failed, execute, our_version  # noqa: E402

PROGRAM = {"freefem": "FreeFem++", "openfoam": "pimpleFoam"}
PACKAGE = {"freefem": "freefem++", "openfoam": "openfoam"}
RADIUS, SPEED, DENSITY = 0.125, 0.2, 1000.0  # of bench/pile_box.h, which the case files of the peers repeat
SHOULDER = 0.5 - RADIUS / math.tan(math.radians(30))
CHECKED_STEPS = 20  # after which CHECKS are taken
CHECKS = ["velocity_difference", "outflow", "kinetic_energy", "far_energy", "tip_error", "largest_speed"]

# What is run. README.md says how it was found.
TIGHT = {"pressureTolerance": 1e-6, "velocityTolerance": 1e-8, "correctors": 3, "nonOrthogonal": 1}
LOOSE = {"pressureTolerance": 1e-6, "velocityTolerance": 1e-6, "correctors": 2, "nonOrthogonal": 0}
REFERENCE = {"pressureTolerance": 1e-13, "velocityTolerance": 1e-13, "correctors": 6, "nonOrthogonal": 3}
SETTINGS = {
    "ours": {"water, 1e-8": ["--water", "--tolerance=1e-8"], "water, 1e-10": ["--water", "--tolerance=1e-10"],
             "bed, 1e-8": ["--tolerance=1e-8"]},
    # Element, and the tolerance when factors are kept, such that velocities are as near as ours to those of direct solves.
    "freefem": {"P1-P1, factors of every step": ("P1", None), "P1-P1, factors kept": ("P1", 1e-8),
                "P2-P1, factors of every step": ("P2", None), "P2-P1, factors kept": ("P2", 1e-10)},
    "openfoam": {"moving": TIGHT | {"motion": "velocityLaplacian"}, "moving, loose": LOOSE | {"motion": "velocityLaplacian"},
                 "moving, displacementLaplacian": TIGHT | {"motion": "displacementLaplacian"},
                 "still": TIGHT, "still, loose": LOOSE},
}


def missing(codes, fluid_step):
    """One line for each program that is not there."""
    lines = [f"{PROGRAM[code]} is not installed (Debian package {PACKAGE[code]}; bench/peers/fluid/packages.txt)"
             for code in codes if code in PROGRAM and not shutil.which(PROGRAM[code])]
    if not os.access(fluid_step, os.X_OK):
        lines.append(f"{fluid_step} is not built (cmake --build --preset release --target fluid_step)")
    return lines


def largest_difference(a, b):
    return max(math.dist(p, q) for p, q in zip(a, b, strict=True)) / SPEED


class PileBox:
    """The mesh that all use, in `folder`, and runs on it. A run's row: cost in CPU ms per step, and what shows that it solved
    the problem."""

    def __init__(self, fluid_step, folder, vertices, dt):
        self.fluid_step, self.folder, self.vertices, self.dt = Path(fluid_step).resolve(), folder, vertices, dt
        self.version = our_version()  # of the whole table, whatever is edited meanwhile
        self._ours(["--water"], 1, "mesh", f"--mesh={folder / 'box.msh'}")
        self.mesh = read_mesh(folder / "box.msh")

    def run(self, code, setting, steps):
        values = SETTINGS[code][setting]
        row = {"ours": self.ours, "freefem": self.freefem, "openfoam": self.openfoam}[code](values, steps)
        row |= {"code": code, "setting": setting, "steps": steps, "dt": self.dt, "vertices": len(self.mesh[0]),
                "triangles": len(self.mesh[1])}
        if not (row["tip_error"] < 1e-6 and abs(row["outflow"] - 1) < 0.01 and row["largest_speed"] < 2):
            raise Failed(f"{code}, {setting}: not the flow asked for: outflow {row['outflow']}, "
                         f"error at the pile {row['tip_error']}, largest speed {row['largest_speed']}")
        return row

    def check(self, code, setting):
        """After CHECKED_STEPS steps: what shows that the problem was solved, and the largest difference of a velocity, by the
        pile's, from the same code's tighter solution."""
        values = SETTINGS[code][setting]
        row = self.run(code, setting, CHECKED_STEPS)
        if code == "freefem":
            mine = self._freefem_velocity()
            self.freefem((values[0], None), CHECKED_STEPS)
            row["velocity_difference"] = largest_difference(mine, self._freefem_velocity())
        if code == "openfoam":
            tight = self._foam_result(values | REFERENCE, CHECKED_STEPS)
            row["velocity_difference"] = largest_difference(row["velocity"], internal(tight / "U"))
        return {name: row[name] for name in CHECKS}

    def _ours(self, arguments, steps, name, *more):
        log = self.folder / f"{name}.csv"
        execute([str(self.fluid_step), f"--vertices={self.vertices}", f"--steps={steps}", f"--dt={self.dt!r}", *arguments,
                 *more], log)
        return next(csv.DictReader(log.read_text().splitlines()))

    def ours(self, arguments, steps):
        row = self._ours(arguments, steps, "ours")
        value = lambda name: float(row[name])
        return {"version": self.version, "unknowns": 3 * int(row["vertices"]), "cpu_per_step": value("cpu_per_step[ms]"),
                "solves": value("iterations"), "factorisations": value("refactorisations"), "outflow": value("outflow"),
                "kinetic_energy": value("kinetic_energy[J/m]"), "far_energy": value("far_energy[J/m]"),
                "tip_error": value("tip_error"), "largest_speed": value("largest_speed"),
                "velocity_difference": value("velocity_difference")}

    def freefem(self, values, steps):
        element, tolerance = values
        keep = tolerance is not None
        (self.folder / "settings.idp").write_text(
            f"macro velocity(){element}//\n"
            f"macro quadrature(){'qf5pT' if element == 'P2' else 'qf2pT'}//\n"
            f"bool stabilised = {'true' if element == 'P1' else 'false'}, keep = {'true' if keep else 'false'};\n"
            f"int steps = {steps};\n"
            f"real dt = {self.dt!r}, speed = {SPEED!r}, shoulder = {SHOULDER!r}, tolerance = {tolerance or 0!r};\n")
        log = self.folder / "freefem.log"
        execute([PROGRAM["freefem"], "-nw", "-v", "0", str(HERE / "pile_box.edp")], log)
        said = {words[0]: float(words[1]) for line in log.read_text().splitlines() if len(words := line.split()) == 2}
        return {"version": f"{said['version']:g}", "unknowns": int(said["unknowns"]),
                "cpu_per_step": 1e3 * said["cpu"] / steps, "assembly_per_step": 1e3 * said["assembly"] / steps,
                "solves": said["corrections"] / steps if keep else 1.0, "factorisations": said["factorisations"],
                **{name: said[name] for name in ("outflow", "kinetic_energy", "far_energy", "tip_error", "largest_speed")}}

    def _freefem_velocity(self):
        """At the nodes."""
        words = (self.folder / "velocity.txt").read_text().split()
        count = int(words[0])
        u, v = words[1:count + 1], words[count + 2:]
        return [(float(a), float(b)) for a, b in zip(u, v, strict=True)]

    def _foam_result(self, values, steps):
        """Runs pimpleFoam; the folder of the last time."""
        case = self.folder / "openfoam"
        shutil.rmtree(case, ignore_errors=True)
        shutil.copytree(HERE / "openfoam", case)
        write_prisms(self.mesh, case / "constant/polyMesh")
        moving = "motion" in values
        if not moving:
            (case / "constant/dynamicMeshDict").unlink()
        settings = {"motion": "none", "motionTolerance": 1e-5, "dt": self.dt, "steps": steps, "endTime": steps * self.dt,
                    "speed": SPEED, "down": -SPEED, "tipVelocity": "movingWallVelocity" if moving else "fixedValue"} | values
        (case / "settings").write_text("".join(f"{name} {value};\n" for name, value in settings.items()))
        os.environ.setdefault("WM_PROJECT_DIR", "/usr/share/openfoam")
        execute([PROGRAM["openfoam"], "-case", str(case)], case / "log")
        return max((f for f in case.iterdir() if re.fullmatch(r"[\d.e-]+", f.name)), key=lambda f: float(f.name))

    def openfoam(self, values, steps):
        result = self._foam_result(values, steps)
        text = (result.parent / "log").read_text()
        times = [float(t) for t in re.findall(r"ExecutionTime = (\S+) s", text)]
        if len(times) != steps:
            raise Failed(f"pimpleFoam did {len(times)} of {steps} steps")
        iterations = [int(n) for n in re.findall(r"Solving for p, .*No Iterations (\d+)", text)]

        points = result / "polyMesh/points"
        placed = vectors(points.read_text()) if points.exists() else [(*p, 0.0) for p in self.mesh[0]]
        velocity = internal(result / "U")
        energy = far = 0.0
        for (a, b, c), u in zip(self.mesh[1], velocity, strict=True):
            (ax, ay, _), (bx, by, _), (cx, cy, _) = placed[a], placed[b], placed[c]
            part = DENSITY / 2 * (u[0] ** 2 + u[1] ** 2) * ((bx - ax) * (cy - ay) - (cx - ax) * (by - ay)) / 2
            energy += part
            far += part if abs(ax + bx + cx) > 1.5 or ay + by + cy < -3 else 0
        tip = vectors(patch_text(result / "U", "tip"))
        return {"version": re.search(r"OPENFOAM=(\S+)", text)[1], "unknowns": 3 * len(velocity),
                "cpu_per_step": 1e3 * (times[-1] - times[0]) / (steps - 1), "solves": sum(iterations) / steps,
                "outflow": sum(numbers(patch_text(result / "phi", "top"))) / (2 * RADIUS * SPEED * THICKNESS),
                "kinetic_energy": energy, "far_energy": far,
                "tip_error": max(math.dist(u[:2], (0, -SPEED)) for u in tip) / SPEED,
                "largest_speed": max(math.hypot(*u[:2]) for u in velocity) / SPEED, "velocity": velocity}
