"""The files of runs as other programs see them: every step of every .xdmf in ParaView, and series in pandas.

Usage: files_in_paraview.py RUNNER RESULTS_SCHEMA_README. A pile is driven into 200 grains under water, and a wave runs
down a basin. What ParaView's readers show is compared with what h5py reads of the same run.
"""

import csv
import io
import json
import pathlib
import shutil
import subprocess
import sys
import tempfile
import unittest
import warnings

import h5py
import numpy

DUMP = pathlib.Path(__file__).with_name("dump_steps.py")
READERS = ("XDMFReader", "Xdmf3ReaderS", "Xdmf3ReaderT")
STUDIES = {
    "drive": {
        "study": "drive",
        "question": "Do others read what a saturated drive wrote?",
        "base": {
            "bed": {"domain": {"width": "0.8 m", "height": "1.5 m"},
                    "grains": {"count": 200, "radius": {"min": "0.02 m", "max": "0.03 m"}}},
            "pile": {"radius": "0.05 m", "depth": "0.15 m", "driving": {"constant": {"speed": "0.4 m/s"}}},
            "fluid": {"depth": "1 m", "mesh": {"size": "0.1 m", "pile_size": "0.05 m"}},
        },
        "record": {"frames": ["0 m", "0.05 m", "0.15 m"]},
    },
    "wave": {
        "study": "wave",
        "question": "Do others read what a basin wrote?",
        "base": {"basin": {
            "width": 1, "depth": 0.5, "gravity": 9.81, "density": 1000, "viscosity": 0.1,
            "surface": {"initial": {"cosine": {"amplitude": 5e-2, "mode": 1}}},
            "mesh": {"pattern": {"structured": {"columns": 16, "rows": 12, "bottom_row": 0.05}}},
            "time": {"step": 2e-3, "duration": 0.4}}},
        "record": {"interval": 0.02, "times": [0, 0.2, 0.4]},
    },
}
# Arrays by the file that has them: what stands in a step besides its points and cells.
ARRAYS = {
    "grains": ("point", {"id", "radius", "velocity", "spin", "displacement"}),
    "contacts": ("point", {"grain", "normal", "force"}),
    "fields": ("cell", {"porosity", "stress", "principal_stress", "principal_direction"}),
    "flow": ("point", {"velocity", "pressure", "porosity", "mesh_velocity"}),
}
RUNNER, README = "", ""


def difference(file, shown):
    """What a reader shows otherwise than the HDF5 file has it, in a sentence; "" when nothing."""
    place, names = ARRAYS[file.stem]
    with h5py.File(file) as f:
        if file.stem == "flow" and "porosity" not in f["steps/00000"]:
            names = names - {"porosity"}  # water alone
        if not numpy.array_equal(shown["times"], f["frames/time"][:]):
            return f"times {shown['times']}"
        for step, time in enumerate(shown["times"]):
            truth = f[f"steps/{step:05d}"]
            points = truth["position"][:] if "position" in truth else f["VTKHDF/Points"][:]
            cells = {"fields": lambda: f["grid/corners"][:], "flow": lambda: truth["corner"][:]}.get(
                file.stem, lambda: numpy.arange(len(points)).reshape(-1, 1))()
            if not numpy.array_equal(shown[f"{step}/points"], points):
                return f"points at {time} s"
            if not numpy.array_equal(shown[f"{step}/cells"], cells):
                return f"cells at {time} s"
            found = {key.split("/", 2)[2] for key in shown if key.startswith(f"{step}/{place}/")}
            if found != names:
                return f"arrays {found} at {time} s"
            for name in names:
                if not numpy.array_equal(shown[f"{step}/{place}/{name}"], truth[name][:]):
                    return f"{name} at {time} s"
    return ""


class Files(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.folder = tempfile.TemporaryDirectory()
        cls.place = pathlib.Path(cls.folder.name)
        cls.runs = {}
        for name, study in STUDIES.items():
            (cls.place / f"{name}.json").write_text(json.dumps(study))
            subprocess.run([RUNNER, f"{name}.json"], cwd=cls.place, check=True, capture_output=True)
            case = json.loads(cls.answer("query", name, "--format", "json"))["rows"][0]["case"]
            (cls.runs[name],) = (cls.place / "results/cases").glob(f"{case}*/0001")

    @classmethod
    def tearDownClass(cls):
        cls.folder.cleanup()

    @classmethod
    def answer(cls, *words):
        return subprocess.run([RUNNER, *words], cwd=cls.place, check=True, capture_output=True, text=True).stdout

    def shown(self, xdmf):
        """By each reader, what pvbatch shows of a file that is named by its full path."""
        with tempfile.TemporaryDirectory() as folder:
            done = subprocess.run(["pvbatch", str(DUMP), str(xdmf), folder], capture_output=True, text=True)
            self.assertEqual((done.returncode, done.stderr), (0, ""))
            return {name: dict(numpy.load(pathlib.Path(folder, f"{name}.npz"))) for name in READERS}

    def check(self, run, files):
        self.assertEqual({file.stem for file in run.glob("*.xdmf")}, set(files))
        for name in files:
            with h5py.File(run / f"{name}.vtkhdf") as f:
                self.assertEqual(len(f["frames/time"]), 3)
            for reader, shown in self.shown(run / f"{name}.xdmf").items():
                with self.subTest(file=name, reader=reader):
                    self.assertEqual(difference(run / f"{name}.vtkhdf", shown), "")

    def test_every_step_of_a_saturated_drive_is_shown_as_it_was_written(self):
        self.check(self.runs["drive"], ["grains", "contacts", "fields", "flow"])

    def test_every_step_of_a_basin_is_shown_as_it_was_written(self):
        self.check(self.runs["wave"], ["flow"])

    def test_what_is_shown_moves_from_step_to_step(self):
        for file, array in (("grains", "velocity"), ("flow", "pressure")):
            with h5py.File(self.runs["drive"] / f"{file}.vtkhdf") as f:
                first, last = f["steps/00000"][array][:], f["steps/00002"][array][:]
            self.assertTrue(first.shape != last.shape or not numpy.array_equal(first, last), array)

    def test_a_step_that_points_to_another_is_noticed(self):
        copy = self.place / "shifted"
        shutil.copytree(self.runs["drive"], copy)
        text = (copy / "grains.xdmf").read_text()
        (copy / "grains.xdmf").write_text(text.replace("steps/00001/velocity", "steps/00002/velocity"))
        for shown in self.shown(copy / "grains.xdmf").values():
            self.assertRegex(difference(copy / "grains.vtkhdf", shown), "^velocity at ")

    def test_the_readme_reads_a_run_with_h5py_and_pandas(self):
        block = README.read_text().split("```python\n")[1].split("```")[0]
        run = f"{self.runs['drive']}/"
        code = block.replace('"results/cases/<case id>/0001/"', repr(run))
        self.assertNotEqual(code, block)
        names = {}
        with warnings.catch_warnings():
            warnings.simplefilter("ignore", ResourceWarning)  # a line that opens a file and reads it is short
            exec(code, names)
        series = names["series"]
        case = self.runs["drive"].parent.name[:10]
        table = list(csv.DictReader(io.StringIO(self.answer("curve", "drive", "--of", "tip_resistance"))))
        self.assertEqual(len(table), len(series))
        for name, heading in (("depth", "depth[m]"), ("tip_resistance", "tip_resistance[Pa]")):
            numpy.testing.assert_array_equal(series[name], [float(row[heading]) for row in table])
        self.assertEqual(names["units"]["depth"], "m")
        self.assertEqual(names["manifest"]["case"][:10], case)
        self.assertEqual(len(names["depth"]), 3)
        self.assertEqual(names["last"]["position"].shape[1], 3)


if __name__ == "__main__":
    RUNNER, README = sys.argv.pop(1), pathlib.Path(sys.argv.pop(1))
    unittest.main(verbosity=2)
