"""breach-verify: the catalogue refuses uncheckable entries, a failing program is a row, numbers are found in the outputs of programs."""
import copy
import json
import os
import pathlib
import shutil
import subprocess
import tempfile
import unittest

program = pathlib.Path(os.environ["BREACH_ROOT"]) / "services/verify/breach-verify"
quantity = {"what": "answer", "at": "/answer", "right": 1.0, "relative": 0.01, "because": "three digits"}
topic = {"title": "T", "cases": [{"id": "one", "question": "q", "source": "s", "kind": "closed form",
                                  "commands": [["program", "{output}"]], "quantities": [quantity]}]}
answer = "echo '{\"answer\": 1.005}' > \"$1/result.json\""


def with_case(**entries):
    made = copy.deepcopy(topic)
    made["cases"][0].update(entries)
    made["cases"][0] = {key: each for key, each in made["cases"][0].items() if each is not None}
    return made


class Verify(unittest.TestCase):
    def setUp(self):
        self.here = pathlib.Path(tempfile.mkdtemp())
        self.addCleanup(shutil.rmtree, self.here)
        (self.here / "bin").mkdir()
        (self.here / "catalogue").mkdir()
        (self.here / "lib/breachline").mkdir(parents=True)
        shutil.copy(program, self.here / "lib/breachline")
        for phase in ("lem_tool", "fem_solver", "transfer_tool", "mpm_solver"):
            self.write(phase, "printf 'phase 1\\nnumerics 2\\n'")

    def write(self, name, script):
        file = self.here / "bin" / name
        file.write_text(f"#!/bin/sh\n{script}\n")
        file.chmod(0o755)

    def verify(self, file, script=answer):
        """(exit code, standard error, quantities of the first case)"""
        self.write("program", script)
        (self.here / "catalogue/topic.json").write_text(json.dumps(file))
        done = subprocess.run([self.here / "lib/breachline/breach-verify", "--catalogue", self.here / "catalogue", "--output", self.here / "out"],
                              capture_output=True, text=True)
        results = self.here / "out/results.json"
        return done.returncode, done.stderr, json.loads(results.read_text())["cases"][0]["quantities"] if results.exists() else []

    def test_an_entry_without_tolerance_reason_or_right_value_is_refused(self):
        for key in ("right", "relative", "because", "what", "at"):
            code, said, _ = self.verify(with_case(quantities=[{name: each for name, each in quantity.items() if name != key}]))
            self.assertEqual(code, 65, key)
            self.assertIn("/cases/0/quantities/0/" + key.replace("relative", "absolute"), said)

    def test_a_case_without_source_a_key_that_is_not_known_and_a_second_id_are_refused(self):
        for file, place in ((with_case(source=None), "/cases/0/source"), (with_case(tolerence=1), "/cases/0/tolerence"),
                            ({"title": "T", "cases": topic["cases"] * 2}, "/cases: has a second"), (with_case(scene="none.json"), "/cases/0/scene"),
                            (with_case(levels=[{"size": 1}] * 2, quantities=[{**quantity, "limit": 0}]), "/cases/0/levels"),
                            (with_case(quantities=[{**quantity, "limit": 0}]), "/quantities/0/limit"), (with_case(quantities=[]), "/cases/0/quantities")):
            code, said, _ = self.verify(file)
            self.assertEqual((code, place in said), (65, True), said)

    def test_a_comparison_is_within_or_beyond_its_tolerance(self):
        code, _, (near, far) = self.verify(with_case(quantities=[quantity, {**quantity, "right": 1.02}]))
        self.assertEqual((code, near["passed"], far["passed"]), (70, True, False))
        self.assertAlmostEqual(near["used"], 0.5, 12)
        self.assertIn("| one | answer | 1 | 1.005 | +0.5 % | 1 % | passed |", (self.here / "out" / "index.md").read_text())
        self.assertEqual(self.verify(topic)[0], 0)

    def test_a_program_that_fails_is_a_row(self):
        code, _, (found,) = self.verify(topic, "exit 70")
        self.assertEqual((code, found["passed"]), (70, False))
        self.assertIn("exit code 70", found["problem"])
        self.assertIn("**failed**", (self.here / "out" / "index.md").read_text())
        self.assertEqual(self.verify(with_case(quantities=[{**quantity, "at": "/none"}]))[2][0]["problem"], "no number at /none in result.json")

    def test_a_refusal_is_right_by_its_exit_code_and_its_words(self):
        file = with_case(quantities=None, refused={"exit": 65, "says": ["/mpm/duration"]})
        for script, passed in (("echo /mpm/duration: is 0 >&2; exit 65", True), ("echo /mpm/cell_size >&2; exit 65", False),
                               ("echo /mpm/duration >&2; exit 70", False), ("echo /mpm/duration; exit 0", False)):
            self.assertEqual(self.verify(file, script)[2][0]["passed"], passed, script)
        self.assertEqual(self.verify(with_case(refused={"exit": 65, "says": ["x"]}))[0], 65)

    def test_numbers_are_found_in_tables_and_lines(self):
        for file, text in (("table.csv", "# note\\nx,answer\\n0,0\\n2,2.01\\n"), ("lines.jsonl", '{"x": 0, "answer": 0}\\n{"x": 2, "answer": 2.01}\\n')):
            slash = "/" if file.endswith("jsonl") else ""
            asked = {**quantity, "file": file, "at": f"{slash}answer"}
            between = {**asked, "where": {f"{slash}x": 1}}
            _, _, found = self.verify(with_case(quantities=[{**asked, "right": 2.0}, between]), f"printf '{text}' > \"$1/{file}\"")
            self.assertEqual([each["passed"] for each in found], [True, True], found)

    def test_levels_give_the_order_of_convergence(self):
        file = with_case(levels=[{"size": h, "set": [str(h * h)]} for h in (4, 2, 1)], quantities=[{**quantity, "right": 2, "limit": 1}])
        _, _, (found,) = self.verify(file, "echo \"{\\\"answer\\\": $((1 + $3))}\" > \"$1/result.json\"")
        self.assertAlmostEqual(found["value"], 2.0, 12)

    def test_a_case_runs_its_own_program_else_the_files_commands(self):
        file = with_case(commands=None, set=["/a=1"])
        file["commands"] = [["program", "{output}", "of the file"]]
        echo = "echo \"$@\" >&2; " + answer
        self.assertEqual(self.verify(file, echo)[0], 0)
        self.assertIn("of the file --set /a=1", (self.here / "out/cases/one/log.txt").read_text())
        file["cases"][0]["program"] = "lem_tool"
        self.verify(file)
        self.assertIn("numerics 2", (self.here / "out/cases/one/log.txt").read_text())


if __name__ == "__main__":
    unittest.main()
