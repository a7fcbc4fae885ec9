"""An exported run of Mochikoshi's name, written here: one FEM whose mesh entangles, one transfer, three runouts of two variants on two grounds.
Each of its numbers occurs once."""
import copy
import json
import os
import pathlib
import sys
import tempfile
import unittest

root = pathlib.Path(os.environ["BREACH_ROOT"])
sys.path[:0] = [str(root / "services/python"), str(root / "services/report")]
sys.argv[0] = os.path.join(os.environ["BREACH_BIN"], "report")  # beside the program that it asks
try:
    import h5py
    import jinja2
    import matplotlib
    import numpy
except ImportError as missing:
    print(f"skipped: {missing}")
    sys.exit(77)

from breachline_report.chapters import Choice  # noqa: E402
from breachline_report.program import document_of  # noqa: E402
from breachline_report.run import read_run  # noqa: E402

SOFT, STRONG, LATE = "mpm_13.000000_softened", "mpm_16.000000_not_softened", "mpm_16.000000_softened"
MOVING = {"code": "still_moving", "severity": "questionable", "message": "12 % of the released energy is left", "pointer": "/mpm/duration"}
IMPLAUSIBLE = {"code": "implausible", "severity": "warning", "message": "19 looks like kN/m3", "pointer": "/materials/sand/density"}
SCENE = {
    "name": "mochikoshi-small", "title": "Two wet elements", "materials": {},
    "section": {"regions": [{"name": "sand", "polygon": [[0, 0], [2, 0], [2, 1], [0, 1]]}]},
    "fem": {"motion": {"file": "shake.csv", "scale_to_pga_g": 0.3}, "liquefaction": {"level": 1}},
    "transfer": {"liquefied": {"r_u": 0.7, "regions": ["sand"]}},
    "mpm": {"cell_size": 1.0, "domain_x": [-1, 300], "floor": {"level": -30}, "runout": {"toe": [2, 0]}, "gauges": [{"name": "toe", "x": 2.0}]}}
SLOPING = copy.deepcopy(SCENE)
SLOPING["mpm"]["terrain"] = [[0, 0], [2, 0], [102, -20]]
RUN = {"id": "01", "name": "wet", "title": "A wet run", "state": "succeeded", "finished": "2026-11-22T13:15:02.123Z",
       "headline": {"outcome": "flows", "text": "flows 210 m beyond the toe (error not known)"}, "stability": None,
       "governing": {"task": LATE}, "verdict": {"usable": "yes", "words": "usable", "reasons": []}}
STUDY = {"variants": [{"name": "softened", "overrides": []},
                      {"name": "not_softened", "overrides": ["/materials/a/viscosity=0", "/materials/b/viscosity=0",
                                                             "/mpm/terrain=[[0,0],[2,0],[102,-20]]"]}],
         "triggers": [{"kind": "window", "lower": "liquefaction_depth >= 18.5 and failure_surfaces >= 2", "upper": "jacobian_least_avg < 0.97"}]}


def shaking():
    """Liquefaction reaches 12 m at 11 s and 20 m at 15 s; the mesh is too distorted at 20 s."""
    return [{"time": t, "crest_displacement": 0.1 * t, "kinetic_energy": 1e3 * t, "liquefaction_depth": 0.0 if t < 11 else 12.5 if t < 15 else 20.0,
             "failure_surfaces": 0 if t < 13 else 1 if t < 15 else 2, "r_u_max": 0.1 if t < 11 else 0.95, "jacobian_centre_avg": 1.0,
             "jacobian_least_avg": 0.99 if t < 20 else 0.96, "epsilon_q_avg": 0.0125 * t} for t in range(22)]


def points(file, moved):
    with h5py.File(file, "w") as out:
        out["VTKHDF/Points"] = numpy.array([[0.5, 0.25, 0], [0.5, 0.75, 0], [1.5 + moved, 0.25, 0], [1.5 + moved, 0.75, 0]], dtype="f4")
        out["VTKHDF/Types"] = numpy.ones(4, dtype="u1")
        out["VTKHDF/PointData/epsilon_q"] = numpy.array([0.01, 0.01, 0.5, 0.75])
        out["VTKHDF/PointData/volume_0"] = numpy.array([0.25, 0.5, 1.0, 2.0])
        out["VTKHDF/PointData/region"] = numpy.array([0, 0, 1, 1])
        out.create_group("VTKHDF/CellData")
        out["breachline/regions"] = numpy.array([b"sand", b"sand"])
        out["breachline/materials_of_regions"] = numpy.array([b"sand", b"liquefied_1"])
        out["breachline"].attrs["time"] = 14.0


class Exported(unittest.TestCase):
    """Writes and edits the folder of an export."""

    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = pathlib.Path(folder.name) / "run"
        self.folder.mkdir()

    def write(self, name, content):
        file = self.folder / name
        file.parent.mkdir(parents=True, exist_ok=True)
        file.write_text(json.dumps(content), encoding="utf-8")

    def read(self, name):
        return json.loads((self.folder / name).read_text(encoding="utf-8"))

    def edit(self, file, **entries):
        """None: without this entry."""
        changed = {**(self.read(file) if (self.folder / file).exists() else {}), **entries}
        self.write(file, {key: value for key, value in changed.items() if value is not None})

    def result(self, label, **entries):
        self.edit(f"tasks/{label}/result.json", **entries)

    def task(self, label, phase, scene=None, result=None, variant="", time=None, state="succeeded"):
        self.write(f"tasks/{label}/task.json", {"id": label, "label": label, "phase": phase, "variant": variant, "transfer_time": time,
                                                "state": state, "fault": None, "artifacts": []})
        if scene:
            self.write(f"tasks/{label}/scene.completed.json", scene)
        if result:
            self.write(f"tasks/{label}/result.json", result)

    def runout(self, label, time, variant, length, scene=SCENE, **entries):
        self.task(label, "mpm_solver", scene, {
            "runout": length, "runout_beyond_toe": max(length, 0.0), "runout_largest": length, "cpu_seconds": 2.5,
            "at_rest": True, "energy": {"numerical": {"share": 0.02}},
            "gauges": {"toe": {"x": 2.0, "arrival_time": 0.5, "largest_depth": 0.75}}, "flags": [],
            "provenance": {"overrides": ["/mpm/cell_size=1"], "inputs": []}, **entries}, variant, time)
        for name, moved in (("particles_0.000000", 0.0), ("final", length)):
            points(self.folder / f"tasks/{label}/{name}.vtkhdf", moved)
        (self.folder / f"tasks/{label}/profile.csv").write_text("x_m,ground_m,depth_m,surface_m\n0.5,0,0.5,0.5\n1.5,0,0.25,0.25\n")

    def document(self, **choice):
        return document_of(read_run(self.folder), Choice(**choice))


class WetRun(Exported):
    def setUp(self):
        super().setUp()
        self.write("run.json", RUN)
        self.write("study.json", STUDY)
        self.task("fem", "fem_solver", SCENE, state="failed")
        self.write("tasks/fem/fault.json", {"summary": "the mesh is entangled at 21 s"})
        self.telemetry("fem", shaking())
        self.task("transfer_14.000000", "transfer_tool", SCENE, {"phase": "transfer_tool"}, time=14.0)
        self.runout(SOFT, 13.0, "softened", 90.0)
        self.runout(LATE, 16.0, "softened", 210.0)
        self.runout(STRONG, 16.0, "not_softened", 30.0, SLOPING)

    def telemetry(self, label, lines):
        (self.folder / f"tasks/{label}/telemetry.jsonl").write_text("".join(json.dumps(line) + "\n" for line in lines))

    def entangle(self, label="fem", variant="", time=21.0, **entanglement):
        (self.folder / f"tasks/{label}/fault.json").unlink(missing_ok=True)
        self.task(label, "fem_solver", SCENE, {"ended": "entangled", "end_time": time, "entanglement": {"time": time, **entanglement}}, variant)


def tables(document):
    return {each.name: each for each in document.tables}


def figures(document):
    return {each.name: each for each in document.figures}


def row(document, table, begin):
    return next(cells for cells in tables(document)[table].rows if cells[0].startswith(begin))


def cell(document, table, begin, column):
    return row(document, table, begin)[tables(document)[table].columns.index(column)]


def marks(figure):
    return {each.label: each.value for each in figure.chart.marks}
