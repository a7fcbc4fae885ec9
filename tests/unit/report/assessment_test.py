"""The assessment page of a study over distributions, with the answer of a known model (tests/browser/samples.mjs): 64 samples, 60 with a result."""
import json
import unittest

from wet_run import MOVING, RUN, Exported, figures, marks, root, row, tables

SCENE = {"name": "slope", "section": {"regions": [{"name": "a", "polygon": [[0, 0], [1, 0], [1, 1]]}]}, "materials": {},
         "mpm": {"gauges": [{"name": "road", "x": 50.0}], "sections": [{"name": "toe", "x": 0.0}], "runout": {"toe": [0, 0]}}}
BEYOND = "Of what passed the toe"


class Sampled(Exported):
    def setUp(self):
        super().setUp()
        both = json.loads((root / "tests/unit/report/uncertainty.json").read_text())
        self.answer = {**both["uncertainty"], "cautions": ["2 samples of 64 left no result and are in no number here."], "inverse": None}
        self.write("envelopes.json", both["envelopes"])
        self.write("run.json", {**RUN, "title": "A slope", "governing": None})
        self.write("study.json", {"scene": SCENE, "uncertainty": {}, "variants": []})
        for sample in self.answer["rows"]:
            self.sample(sample, moving=sample["state"] == "questionable")

    def sample(self, each, moving):
        length = each["results"]["runout_beyond_toe"]  # the flow is at 50 m when its runout is longer
        self.task(f"mpm_{each['sample']}", "mpm_solver", SCENE, None if length is None else {
            **each["results"], "at_rest": not moving, "flags": [MOVING] if moving else [], "cpu_seconds": 2.5,
            "provenance": {"version": "0.9.0", "overrides": [], "inputs": []}, "sections": {"toe": {"volume": 30.0, "largest_discharge": 4.0}},
            "gauges": {"road": {"arrival_time": 50 / length if length > 50 else None, "largest_depth": max(0.0, length - 50) / 10,
                                "largest_velocity": 0.0}}}, each["sample"], state=each["state"])

    def document(self, **choice):
        self.write("uncertainty.json", self.answer)
        return super().document(**choice)

    def test_it_opens_with_what_a_regulator_asks(self):
        document = self.document()
        self.assertEqual([each.title for each in document.chapters[:2]], ["Dam-breach assessment", "Basis of the assessment"])
        self.assertEqual(row(document, "assessment", BEYOND)[1:],
                         ["38.5 (32.7 to 43.7)", "24.1 (22.5 to 25.2)", "71 (62.6 to 78.7)", "60 of 64 samples"])
        self.assertEqual(document.front.tables[0].rows[0][1], "p50: 38.5 (32.7 to 43.7)")
        self.assertTrue(document.front.limits[0].startswith("Plane strain"), "uncertainty was computed")
        self.assertTrue(row(document, "assessment_what", "When")[1].startswith("Not applicable"))
        self.assertIn("2 samples of 64 left no result", document.chapters[0].cautions[0])
        self.assertEqual(row(document, "assessment_origin", "mpm_solver")[1], "0.9.0")
        self.assertEqual(row(document, "assessment_error", "CPU seconds of all")[1], "150")
        self.assertEqual(row(document, "assessment_left_out", "s0005")[2], "exit 70: a point left the grid at 3.2 s")
        self.assertIn("tornado", figures(document))

    def test_a_search_for_one_value_has_a_chapter_of_its_own_and_no_distribution(self):
        self.answer |= {"quantities": {}, "sentences": ["A strength of at least 0.484 gives it."], "inverse": {
            "quantity": "runout_beyond_toe", "unit": "m", "target": 215.0, "vary": "residual strength", "value": 0.484, "bound": "at_least", 
            "low": 0.465, "high": 0.504, "steps": [{"value": 0.4, "results": [232.0, 236.0], "lower_bounds": 1, "result": 234.0, "state": "done"},
                                     {"value": 2.5, "results": [], "lower_bounds": 0, "result": None, "state": "failed"}]}}
        document = self.document()
        self.assertEqual(row(document, "back_analysis_steps", "0.4"), ["0.4", "\u2265 234", "232; 236", "1 of 2", "done"])
        figure = figures(document)["back_analysis"]
        self.assertEqual((figure.chart.series[0].certainty, marks(figure)), (["lower bound"], {"asked": 215.0, "\u2265 0.484": 0.484}))
        self.assertEqual(document.front.tables[0].rows[0][1:3], ["\u2265 0.484", "0.465 to 0.504"])
        self.assertTrue(document.front.asked[1].startswith("Which residual strength gives a runout_beyond_toe of 215 m?"))

    def test_it_says_which_cases_it_covers(self):
        self.assertEqual([each[3] for each in tables(self.document())["assessment_cases"].rows], ["no", "no", "yes", "yes"])
        self.edit("study.json", scene={**SCENE, "transfer": {"liquefied": {"regions": ["pond"]}}})
        document = self.document()
        self.assertEqual(row(document, "assessment_cases", "2A")[3], "yes: this run")
        self.assertEqual(row(document, "assessment_what", "What fails")[1], "A slope; soil liquefies in pond.")

    def test_many_meshes_and_analyses_are_a_number_and_a_range(self):
        for label, factor in (("lem_a", 1.25), ("lem_b", 0.875)):
            self.task(label, "lem_tool", SCENE, {"factor_of_safety": factor}, label)
        self.task("lem_c", "lem_tool", SCENE, variant="lem_c", state="failed")
        self.assertEqual(row(self.document(), "assessment_what", "What fails")[1], "A slope; factor of safety 0.875 to 1.25 (2 of 3 analyses).")
        for label, time, kind in (("fem_a", 9.75, "band"), ("fem_b", 4.25, "corner")):
            self.task(label, "fem_solver", SCENE, {"ended": "entangled", "end_time": time, "entanglement": {"time": time, "kind": kind}}, label)
        self.assertTrue(row(self.document(), "assessment_what", "What fails")[1].startswith(
            "A slope. 2 of 2 meshes entangled, from 4.25 to 9.75 s; 1 of them at one bad corner"))

    def test_percentiles_above_soil_that_still_moved_are_lower_bounds(self):
        self.answer["quantities"]["runout_beyond_toe"]["bound_from"] = 24.86  # of s0001: below p50, above p10
        self.sample(next(each for each in self.answer["rows"] if each["sample"] == "s0001"), moving=True)
        document = self.document()
        self.assertEqual([each[:4] for each in row(document, "assessment", BEYOND)[1:3]], ["\u2265 38", "24.1"])
        self.assertEqual(row(document, "assessment_samples", "s0001")[-1], "\u2265 24.86")
        self.assertEqual(list(marks(figures(document)["exceedance"]).values()), [24.86])

    def test_a_gauge_that_the_flow_seldom_reaches_has_no_median_arrival(self):
        came = sum((each["results"]["runout_beyond_toe"] or 0) > 50 for each in self.answer["rows"])
        arrival = row(self.document(), "assessment", "Gauge road (x = 50 m): arrival")
        self.assertEqual((arrival[1], arrival[4]), ("not by the end", f"{came} of 64 samples: there the flow came"))
        self.assertNotEqual(arrival[2], "not by the end", "one in ten comes")
        self.assertEqual(row(self.document(), "assessment", "Gauge road (x = 50 m): largest depth")[1], "0")

    def test_what_needs_more_samples_says_so(self):
        self.answer["quantities"]["runout_beyond_toe"] |= {
            "count": 3, "percentiles": {"refused": "3 samples are not enough for the 50th percentile: 5 are needed"},
            "tornado": {"refused": "Q2 is 0.4; 0.7 is needed", "q2": 0.4}}
        document = self.document()
        self.assertEqual(row(document, "assessment", BEYOND)[1], "3 samples are not enough for the 50th percentile: 5 are needed")
        self.assertIn(("tornado: one parameter at a time", "Q2 is 0.4; 0.7 is needed"), document.left_out)

    def test_a_gauge_has_the_percentiles_that_the_runout_has(self):
        few, depth = self.answer["quantities"]["runout"], "Gauge road (x = 50 m): largest depth"
        few |= {"count": 28, "percentiles": [each for each in few["percentiles"] if each["p"] == 50], "percentiles_lacking": [{"p": 90, "needs": 29}]}
        self.sample(next(each for each in self.answer["rows"] if each["sample"] == "s0001"), moving=True)
        self.assertEqual(row(self.document(), "assessment", depth)[1:4:2], ["\u2265 0", "28 samples are not enough, 29 are needed"])
        del self.answer["quantities"]["runout"]
        self.assertEqual(row(self.document(), "assessment", depth)[1], "no sample has a runout")

    def test_without_its_answer_it_is_left_out_and_that_is_said(self):
        document = Exported.document(self)
        self.assertIn(("dam-breach assessment", "the folder has no uncertainty.json: export the run again"), document.left_out)


if __name__ == "__main__":
    unittest.main()
