"""python3-breachline against an export and files written here: tables with holes, frames of both kinds, and what is said
when something is missing. The real ones are real_run.py's."""
import http.server
import json
import os
import pathlib
import sys
import tempfile
import threading
import unittest
import urllib.parse

sys.path.insert(0, os.path.join(os.environ["BREACH_ROOT"], "services/python"))
try:
    import h5py
    import numpy
    import breachline as breach
    from breachline import plot
except ImportError as missing:
    print(f"skipped: {missing}")
    sys.exit(77)

COLUMNS = [{"name": name, "kind": kind, "unit": unit, "title": "", "meaning": ""} for name, kind, unit in
           (("transfer_time", "number", "s"), ("state", "word", ""), ("runout", "number", "m"), ("variant", "word", ""))]


def rows(*places):
    return [dict(zip(("transfer_time", "state", "runout", "variant"), each)) for each in places]


class Files(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.here = pathlib.Path(folder.name)

    def export(self, name, table):
        folder = self.here / name
        task = folder / "tasks/mpm_0.5"
        task.mkdir(parents=True)
        (folder / "run.json").write_text(json.dumps({"id": name, "name": "column", "state": "succeeded", "headline": {"outcome": "not_known", "text": ""}, "verdict": {"usable": "yes", "words": "usable", "reasons": []}}))
        (folder / "study.json").write_text(json.dumps({"scene": {"name": "column"}}))
        (folder / "results.json").write_text(json.dumps({"columns": COLUMNS, "rows": table}))
        (task / "task.json").write_text(json.dumps(
            {"id": "t", "label": "mpm_0.5", "phase": "mpm_solver", "state": "succeeded", "transfer_time": 0.5, "variant": "",
             "result": None, "artifacts": [{"name": "particles_0.000000.vtkhdf"}, {"name": "particles_10.000000.vtkhdf"},
                                           {"name": "particles_2.000000.vtkhdf"}]}))
        for time in (0, 2, 10):
            self.frame(task / f"particles_{time}.000000.vtkhdf", time)
        return folder

    def frame(self, path, time):
        with h5py.File(path, "w") as file:
            file["VTKHDF/Points"] = numpy.array([[time, 1, 0], [time + 1, 2, 0]], dtype="f4")
            file["VTKHDF/Types"] = numpy.ones(2, dtype="u1")
            file["VTKHDF/PointData/stress"] = numpy.arange(12.0).reshape(2, 6)
            file["VTKHDF/PointData/stress"].attrs["unit"] = numpy.bytes_("Pa")
            file.create_group("VTKHDF/CellData")
            file["breachline/regions"] = numpy.array([b"tailings"])
            file["breachline/materials_of_regions"] = numpy.array([b"silt"])
            file["breachline"].attrs["time"] = float(time)

    def test_tables_know_their_units_and_their_holes(self):
        table = breach.run(self.export("a", rows((0.5, "succeeded", 12.5, None), (1.0, "failed", None, None)))).results
        self.assertEqual(len(table), 2)
        self.assertEqual(table["runout"][0], 12.5)
        self.assertTrue(numpy.isnan(table["runout"][1]))
        self.assertEqual(list(table["state"]), ["succeeded", "failed"])
        self.assertEqual(table.column("runout").unit, "m")
        self.assertIn("runout [m]", repr(table))
        with self.assertRaisesRegex(breach.BreachlineError, "no column runnout; there are transfer_time, state, runout"):
            table["runnout"]

    def test_rows_are_compared_by_variant_and_time(self):
        one = breach.run(self.export("a", rows((0.5, "succeeded", 10.0, "x"), (1.0, "succeeded", 20.0, "x"), (2.0, "failed", None, "x"))))
        other = breach.run(self.export("b", rows((1.0, "succeeded", 23.0, "x"), (0.5, "succeeded", 9.0, "x"), (0.5, "succeeded", 1.0, "y"))))
        comparison = one.compare(other)
        numpy.testing.assert_array_equal(comparison.difference("runout"), [-1.0, 3.0])
        self.assertEqual((comparison.only_here, comparison.only_there), ([("x", 2.0)], [("y", 0.5)]))
        self.assertIn("2 rows in both, 1 only here, 1 only there", repr(comparison))
        with self.assertRaisesRegex(breach.BreachlineError, "state holds no numbers"):
            comparison.difference("state")

    def test_a_variant_without_a_common_time_is_compared_by_its_largest_runout(self):
        one = breach.run(self.export("a", rows((0.5, "succeeded", 10.0, "x"), (1.0, "succeeded", 20.0, "x"), (2.0, "failed", None, "x"),
                                               (1.0, "succeeded", 5.0, "y"))))
        other = breach.run(self.export("b", rows((0.7, "succeeded", 23.0, "x"), (0.9, "succeeded", 9.0, "x"), (1.0, "succeeded", 6.0, "y"))))
        comparison = one.compare(other)
        self.assertEqual(sorted(comparison.difference("runout")), [1.0, 3.0])
        self.assertEqual((comparison.only_here, comparison.only_there), ([("x", 0.5), ("x", 2.0)], [("x", 0.9)]))
        self.assertIn("x 1 and 0.7 s: runout 20 m, 23 m, difference +3 m", repr(comparison))

    def test_variants_in_no_row_are_listed(self):
        folder = self.export("a", rows((0.5, "succeeded", 12.5, "loose")))
        (folder / "results.json").write_text(json.dumps({"columns": COLUMNS, "rows": rows((0.5, "succeeded", 12.5, "loose")),
                                                         "without_transfer": [{"variant": "dense", "reason": "its trigger expired"}]}))
        table = breach.run(folder).results
        self.assertEqual((len(table), [each["variant"] for each in table.without_transfer]), (1, ["dense"]))
        self.assertIn("no transfer of dense: its trigger expired", repr(table))

    def test_tasks_are_in_the_studys_order_and_sound_ones_come_first(self):
        folder = self.export("a", [])
        for label, name, time, state, variant in (("mpm_10", "r-00009", 10.0, "succeeded", "dense"), ("mpm_3_loose", "r-00003", 3.0, "failed", "loose"),
                                                  ("mpm_3_dense", "r-00004", 3.0, "cached", "dense")):
            task = folder / "tasks" / label
            task.mkdir()
            (task / "task.json").write_text(json.dumps(
                {"id": name, "label": label, "phase": "mpm_solver", "state": state, "transfer_time": time, "variant": variant, "result": None,
                 "artifacts": [{"name": "particles_0.000000.vtkhdf"}]}))
        run = breach.run(folder)
        self.assertEqual([each.label for each in run.tasks], ["mpm_3_loose", "mpm_3_dense", "mpm_10", "mpm_0.5"])
        self.assertEqual(run.task("mpm_solver").label, "mpm_3_dense")
        self.assertEqual(run.task("mpm_solver", 3.0).label, "mpm_3_dense")
        self.assertEqual(run.task("mpm_solver", 3.0, "loose").label, "mpm_3_loose")
        self.assertIn("of mpm_3_loose (failed)", repr(run.frames(3.0, "loose")))

    def test_frames_are_in_the_order_of_time(self):
        frames = breach.run(str(self.export("a", [])) + os.sep).frames(transfer_time=0.5)
        self.assertEqual(list(frames.times), [0.0, 2.0, 10.0])
        last = frames[-1]
        self.assertEqual((last.time, last.regions, last.units["stress"], last.quads), (10.0, ["tailings"], "Pa", None))
        numpy.testing.assert_array_equal(last.position, [[10, 1], [11, 2]])
        numpy.testing.assert_array_equal(last["stress"], [[0, 1, 2, 3], [6, 7, 8, 9]])
        self.assertEqual(frames.at(3.0).time, 2.0)
        self.assertEqual([each.time for each in frames[1:]], [2.0, 10.0])
        with self.assertRaises(IndexError):
            frames[3]
        with self.assertRaisesRegex(breach.BreachlineError, "has no velocity; it has stress"):
            last["velocity"]

    def test_what_is_not_there_is_said(self):
        run = breach.run(self.export("a", []))
        with self.assertRaisesRegex(breach.BreachlineError, r"no such task of mpm_solver with files; it has: mpm_0.5 \(succeeded\)"):
            run.frames(transfer_time=0.75)
        with self.assertRaisesRegex(breach.BreachlineError, "no such task of fem_solver with files; it has: none"):
            run.frames(phase="fem_solver")
        with self.assertRaisesRegex(breach.BreachlineError, "no exported run"):
            breach.run(self.here)
        (self.here / "a/tasks/mpm_0.5/particles_0.000000.vtkhdf").write_bytes(b"cut")
        with self.assertRaisesRegex(breach.BreachlineError, "not a whole frame"):
            run.frames()[0]
        (self.here / "a/tasks/mpm_0.5/particles_2.000000.vtkhdf").unlink()
        with self.assertRaisesRegex(breach.BreachlineError, "missing; repeat the export"):
            run.frames()[1]

    def served(self, *about):
        """The address of a service with these runs, (id, name), the newest first."""
        runs = [{"id": each, "name": name, "title": "", "created": "2026-11-21T02:00:00Z", "state": "questionable", "study": {}, "tasks": [],
                 "headline": {"outcome": "flows", "text": "flows 10.4 m"},
                 "verdict": {"usable": "questionable", "words": "questionable", "reasons": [{"text": "Thin deposit."}]}} for each, name in about]

        class Handler(http.server.BaseHTTPRequestHandler):
            def do_GET(self):
                path, _, query = self.path.partition("?")
                asked = urllib.parse.parse_qs(query)
                found = [each for each in runs if asked.get("search", [""])[0] in each["id"] + each["name"]]
                body = {"runs": found[:int(asked["limit"][0])]} if path == "/v1/runs" else next(each for each in runs if path.endswith(each["id"]))
                self.send_response(200)
                self.end_headers()
                self.wfile.write(json.dumps(body).encode())

            def log_message(self, *_):
                pass

        server = http.server.ThreadingHTTPServer(("127.0.0.1", 0), Handler)
        self.addCleanup(server.server_close)
        self.addCleanup(server.shutdown)
        threading.Thread(target=server.serve_forever, daemon=True).start()
        return f"http://127.0.0.1:{server.server_port}"

    def test_a_run_has_the_names_of_the_command_line_and_comes_before_a_folder(self):
        address = self.served(("01JD00000000000000000000BB", "slope"), ("01JC00000000000000000000AA", "slope"), ("01JB00000000000000000000AA", "dam"))
        for name, wanted in (("latest", "01JD"), ("slope", "01JD"), ("01JC", "01JC"), ("01JB00000000000000000000AA", "01JB")):
            self.assertEqual(breach.run(name, server=address).id[:4], wanted)
        with self.assertRaisesRegex(breach.BreachlineError, "several ids begin with \"01J\": 01JD"):
            breach.run("01J", server=address)
        with self.assertRaisesRegex(breach.BreachlineError, 'no run has the name or id "heap"'):
            breach.run("heap", server=address)
        for folder in ("slope", "heap"):
            self.export(folder, rows((0.5, "succeeded", 1.0, "x")))
        self.addCleanup(os.chdir, os.getcwd())
        os.chdir(self.here)
        self.assertEqual(breach.run("slope", server=address).id[:4], "01JD")
        self.assertEqual([breach.run(name, server=address).id for name in ("./slope", "heap")], ["slope", "heap"])

    def test_runs_are_a_table_and_a_run_shows_its_warnings(self):
        address = self.served(("01JD00000000000000000000BB", "slope"), ("01JC00000000000000000000AA", "dam"))
        table = breach.runs(server=address)
        self.assertEqual((list(table["name"]), table[1]["verdict"]), (["slope", "dam"], "questionable"))
        self.assertRegex(repr(table), "(?s)id +name +created +state +headline +verdict\n.*dam .* flows 10.4 m")
        self.assertRegex(repr(breach.run("dam", server=address)), "flows 10.4 m; questionable\\)\n  Thin deposit.$")

    def test_runouts_without_transfer_times_are_drawn_by_variant(self):
        figure = plot.runouts(breach.run(self.export("a", rows((None, "succeeded", 12.5, "loose"), (None, "succeeded", -1.0, "dense")))))
        self.assertEqual((figure.chart.x.names, list(figure.chart.series[0].y)), (["loose", "dense"], [12.5, -1.0]))
        self.assertIn("loose", figure.svg())

    def test_a_service_that_is_not_there(self):
        with self.assertRaisesRegex(breach.Unreachable, "does not answer"):
            breach.run("latest", server="http://127.0.0.1:9")
        with self.assertRaisesRegex(breach.BreachlineError, "no http or https address"):
            breach.run("latest", server="file:///etc/passwd")
        with self.assertRaisesRegex(breach.BreachlineError, "BREACH_TOKEN_FILE"):
            breach.run("latest", token_file=self.here / "none")


if __name__ == "__main__":
    unittest.main()
