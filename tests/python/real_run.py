"""python3-breachline against `breachline serve`, the real phases and an export of theirs; then docs/notebook.ipynb, executed
against the same service. Outputs that the notebook keeps are those of such an execution:

    real_run.py --keep     executes it and writes them into the file
"""
import json
import os
import pathlib
import re
import subprocess
import sys
import tempfile
import unittest

root, programs = pathlib.Path(os.environ["BREACH_ROOT"]), pathlib.Path(os.environ["BREACH_BIN"])
package = root / "services/python"
sys.path.insert(0, str(package))
try:
    import h5py
    import numpy
    import breachline as breach
except ImportError as missing:
    print(f"skipped: {missing}")
    sys.exit(77)

notebook = root / "docs/notebook.ipynb"
small = ["/fem/stages/1/duration=0.25", "/mpm/duration=3", "/mpm/snapshot_interval=0.5"]
TOKEN = "of-this-test-and-no-other"


class Service:
    """`breachline serve` with two runs of the column: cells of 2 m, then of 1 m."""

    def __init__(self, here):
        self.here = here
        (here / "token").write_text(TOKEN + "\n")
        self.process = subprocess.Popen([programs / "breachline", "serve", "--data", here / "data", "--port", "0", "--token-file", here / "token"],
                                        stdout=subprocess.PIPE, stderr=subprocess.DEVNULL, text=True)
        url = json.loads(self.process.stdout.readline())["url"]
        self.environment = {"BREACH_SERVER": url, "BREACH_TOKEN_FILE": str(here / "token")}
        os.environ.update(self.environment, XDG_CACHE_HOME=str(here / "cache"))
        self.runs = [self.submitted(cell) for cell in (2, 1)]

    def breach(self, *words):
        done = subprocess.run([programs / "breach", *map(str, words)], text=True, capture_output=True, timeout=180)
        assert done.returncode == 0, done.stdout + done.stderr
        return done.stdout.strip()

    def submitted(self, cell):
        study = json.loads((root / "workflows/scenes/column.json").read_text())
        (self.here / "column.json").write_text(json.dumps(study))
        (self.here / "study.json").write_text(json.dumps(
            {"format": "breachline-study/1", "name": f"column_{cell}_m", "scene": "column.json",
             "overrides": small + [f"/mpm/cell_size={cell}"], "transfer_times": [0.1, 0.2]}))
        run = self.breach("submit", self.here / "study.json")
        self.breach("watch", run)
        return run

    def close(self):
        self.process.terminate()
        self.process.wait(30)
        self.process.stdout.close()


def executed(file):
    """The notebook as it is after its cells ran, in their order; None where there is no nbclient."""
    try:
        import nbformat
        from nbclient import NotebookClient
    except ImportError:
        return None
    content = nbformat.read(file, as_version=4)
    os.environ["PYTHONPATH"] = os.pathsep.join(filter(None, [str(package), os.environ.get("PYTHONPATH")]))
    NotebookClient(content, timeout=600, kernel_name="python3").execute()
    for cell in content.cells:
        cell.metadata.pop("execution", None)  # when it ran
    content.metadata = {"kernelspec": content.metadata["kernelspec"]}
    return content


def outputs(content):
    """The text that each cell gave, with # for every number and id: those are of the machine and the day. What a cell prints comes
    in one message or, on a busy machine, in several."""
    texts = []
    for cell in content["cells"]:
        if cell["cell_type"] != "code":
            continue
        text = "".join("".join(each.get("text") or each.get("data", {}).get("text/plain", "")) for each in cell["outputs"])
        texts.append(re.sub(r"\s+", " ", re.sub(r"[0-9a-f-]{12,}|[-+]?\d+(\.\d+)?(e[-+]?\d+)?", "#", text)))
    return texts


class RealRun(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.folder = tempfile.TemporaryDirectory()
        cls.here = pathlib.Path(cls.folder.name)
        cls.service = Service(cls.here)

    @classmethod
    def tearDownClass(cls):
        cls.service.close()
        cls.folder.cleanup()

    def test_results_are_those_of_the_command_line(self):
        run = breach.run("latest")
        self.assertEqual(run.id, self.service.runs[1])
        told = json.loads(self.service.breach("results", run.id, "--json"))["rows"]
        self.assertEqual(list(run.results["runout"]), [each["runout"] for each in told])
        self.assertEqual(list(run.results["transfer_time"]), [0.1, 0.2])
        self.assertEqual({each.unit for each in run.results.columns if each.name.startswith("runout") and each.kind == "number"}, {"m"})
        self.assertEqual(run.scene["mpm"]["cell_size"], 1)
        self.assertEqual([each["id"] for each in breach.runs()], self.service.runs[::-1])

    def test_frames_move(self):
        run = breach.run("latest")
        frames = run.frames(transfer_time=0.2)
        self.assertEqual(list(frames.times), [0.5 * k for k in range(len(frames))])
        first, last = frames[0], frames[-1]
        self.assertEqual(first.position.shape, last.position.shape)
        self.assertGreater((last.position - first.position)[:, 0].max(), 1.0, "the soil runs out")
        self.assertGreater(last["epsilon_q"].max(), first["epsilon_q"].max())
        self.assertEqual(last.units["velocity"], "m/s")
        telemetry = run.telemetry(run.task("mpm_solver", 0.2))
        self.assertEqual(telemetry[0]["time"], 0.0)
        mesh = run.frames(phase="fem_solver")[-1]
        self.assertEqual(mesh.quads.shape[1], 4)
        self.assertEqual(len(mesh["stress"]), len(mesh.quads))
        # What another program finds in the same file.
        with h5py.File(run.file(run.task("mpm_solver", 0.2), "particles_0.500000.vtkhdf")) as file:
            numpy.testing.assert_array_equal(frames[1].position, file["VTKHDF/Points"][:, :2])

    def test_an_export_says_the_same(self):
        self.service.breach("export", "latest", self.here / "exported")
        served, exported = breach.run("latest"), breach.run(self.here / "exported")
        for task in ("fem", "mpm_0.100000"):
            self.assertTrue((self.here / "exported/tasks" / task / "frames.vtkhdf.series").is_file(), "what ParaView opens")
        self.assertEqual(exported.results.rows, served.results.rows)
        self.assertEqual((exported.id, exported.scene), (served.id, served.scene))
        self.assertEqual({each.label for each in exported.tasks}, {each.label for each in served.tasks})
        numpy.testing.assert_array_equal(exported.frames(0.1)[-1]["velocity"], served.frames(0.1)[-1]["velocity"])
        numpy.testing.assert_array_equal(served.compare(exported).difference("runout"), [0.0, 0.0])

    def test_two_runs_are_compared(self):
        coarse, fine = (breach.run(each) for each in self.service.runs)
        comparison = coarse.compare(fine)
        self.assertEqual((len(comparison), comparison.only_here, comparison.only_there), (2, [], []))
        difference = comparison.difference("runout")
        self.assertTrue(numpy.all(difference != 0.0), "other cells, another runout")
        numpy.testing.assert_array_equal(difference, fine.results["runout"] - coarse.results["runout"])

    def test_refusals_are_the_services(self):
        with self.assertRaisesRegex(breach.BreachlineError, "no run has the name or id"):
            breach.run("no-such-run")
        (self.here / "wrong").write_text("wrong")
        with self.assertRaisesRegex(breach.BreachlineError, "401"):
            breach.run("latest", token_file=self.here / "wrong")

    def test_a_run_is_submitted_awaited_extended_and_cancelled(self):
        study = breach.run("latest").study
        study = {**study, "name": "from_python", "transfer_times": [0.1]}
        run = breach.submit(study).wait(every=0.2)
        self.assertEqual((run.name, list(run.results["transfer_time"])), ("from_python", [0.1]))
        self.assertIn(run.state, ("succeeded", "questionable"))
        self.assertEqual(run.about["governing"]["runout"], run.results["runout"][0])
        self.assertIn("<h1>", run.report())
        more = run.extend(transfer_times=[0.2]).wait(every=0.2)
        self.assertEqual(list(more.results["transfer_time"]), [0.1, 0.2])
        with self.assertRaisesRegex(breach.BreachlineError, r"422[\s\S]*cell_size"):
            breach.submit({**study, "overrides": ["/mpm/cell_size=-1"]})
        self.assertEqual(breach.submit({**study, "reuse": False, "overrides": []}).cancel().wait(every=0.2).state, "cancelled")
        made = [each["id"] for each in breach.runs() if each["id"] not in self.service.runs]
        self.service.breach("rm", "--yes", *made)  # the other tests' newest run is the finer one
        dam = breach.template("upstream_dam", height=20, clay_thickness=1.5)
        self.assertEqual(dam["scene"]["mpm"]["runout"]["toe"], [0, 0])

    def test_an_artifact_is_fetched_once_and_compared(self):
        run = breach.run("latest")
        task = run.task("mpm_solver", 0.1)
        kept = run.file(task, "profile.csv")
        whole = kept.read_bytes()
        kept.write_bytes(whole[:10])
        self.assertEqual(run.file(task, "profile.csv").read_bytes(), whole)

    def test_other_libraries_take_it(self):
        run = breach.run("latest")
        for name, use in (("pandas", lambda: len(run.results.pandas()) == 2),
                          ("xarray", lambda: run.frames().xarray()["position"].shape[2] == 2),
                          ("pyvista", lambda: run.frames()[0].pyvista().n_points == len(run.frames()[0].position))):
            with self.subTest(name):
                try:
                    __import__(name)
                except ImportError:
                    self.skipTest(f"no {name}")
                self.assertTrue(use())

    def test_the_notebook_runs_and_keeps_what_it_gave(self):
        now = executed(notebook)
        if now is None:
            self.skipTest("no nbclient")
        kept = json.loads(notebook.read_text())
        counts = [cell["execution_count"] for cell in kept["cells"] if cell["cell_type"] == "code"]
        self.assertEqual(counts, list(range(1, len(counts) + 1)), "kept outputs are of one execution, from top to bottom")
        self.assertEqual(outputs(kept), outputs(now), "execute it again: real_run.py --keep")
        self.assertGreater(len(outputs(kept)), 4)


def keep():
    import nbformat

    with tempfile.TemporaryDirectory() as folder:
        service = Service(pathlib.Path(folder))
        try:
            nbformat.write(executed(notebook), notebook)
        finally:
            service.close()


if __name__ == "__main__":
    keep() if sys.argv[1:] == ["--keep"] else unittest.main()
