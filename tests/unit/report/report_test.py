"""The chapters of a report, of runs written here: what they show, mark as a bound, leave out and refuse."""
import json
import os
import subprocess
import unittest

from wet_run import IMPLAUSIBLE, LATE, MOVING, SCENE, SOFT, STRONG, STUDY, WetRun, cell, figures, marks, row, shaking, tables
from breachline.plot import Axis, Chart, Figure
from breachline_report.chapters.variants import changes_of
from breachline_report.clauses import index_of
from breachline_report.document import Chapter, Document, Table, as_file_name
from breachline_report.ended import how_it_ended
from breachline_report.page import as_html
from breachline_report.program import guarded, write_report
from breachline_report.run import read_run
from breachline_report.words import at_least

report = os.path.join(os.environ["BREACH_BIN"], "report")


class Front(WetRun):
    def test_it_opens_with_the_question_the_result_and_the_verdict(self):
        self.edit("run.json", verdict={"usable": "questionable", "words": "questionable", "reasons": [
            {"usable": "questionable", "code": "still_moving", "text": "It moves."}, {"usable": "with_remarks", "code": "a", "text": "A remark."},
            {"usable": "yes", "code": "entangled", "text": "said with its place instead"}]})
        front, verdict = self.document().front, self.document().verdict
        self.assertIn("shaken by shake.csv scaled to 0.3 g", front.asked[0])
        self.assertIn("t_T = 14 s (triggers: window)", front.asked[0])
        self.assertEqual(front.headline, "Flows 210 m beyond the toe (error not known); governing case: t_T = 16 s, softened.")
        self.assertEqual(front.identity, "Run 01, wet. Scene mochikoshi-small, finished 2026-11-22 13:15 UTC.")
        self.assertEqual((verdict.words, verdict.cautions, verdict.notes), ("questionable", ["It moves."], ["A remark."]))
        self.assertEqual(row(self.document(), "front_gauges", "arrival"), ["arrival [s]", "0.5"])

    def test_results_of_the_table_have_a_verdict_with_equal_results(self):
        self.write("results.json", {"rows": [], "verdict": {"usable": "with_remarks", "words": "usable, with remarks", "reasons": [
            {"usable": "with_remarks", "code": "same_results", "text": "The same."}]}})
        self.assertEqual(self.document().verdict.notes, ["The same."])

    def test_the_headline_counts_missing_runouts(self):
        self.task("mpm_17", "mpm_solver", SCENE, variant="softened", time=17.0, state="failed")
        self.assertTrue(self.document().front.headline.endswith("; 1 of 4 runouts without a result."))

    def test_ends_of_many_fems_are_one_row(self):
        for k in range(7):
            self.task(f"fem_{k}", "fem_solver", SCENE, {"end_time": 10.0 + k, "largest_displacement": 1.0}, f"v{k}")
        found = row(self.document(), "found", "Finite elements end")
        self.assertEqual(found[0], "Finite elements end [s], 8 of them")
        self.assertIn("10 to 16 (7 of 8)", found[2])

    def test_runouts_that_are_shaken_on_are_counted(self):
        self.assertIn("Nothing liquefies after the transfer, and the shaking ends with it.", self.document().front.limits)
        self.edit(f"tasks/{SOFT}/scene.completed.json", mpm={**SCENE["mpm"], "shaking": "on"})
        self.assertTrue(any("shakes on in 1 of 3 runouts" in each for each in self.document().front.limits))

    def test_each_case_has_its_least_factor_beside_its_criterion(self):
        for label, factor, liquefied, k_h in (("lem_softened", 1.5, 0.75, 0.0), ("lem_not_softened", 1.25, 0.5, 0.0),
                                              ("lem_tilted", 1.125, 0.25, 0.1)):
            self.task(label, "lem_tool", {**SCENE, "lem": {"seismic_coefficient": k_h}}, {
                "factor_of_safety": factor, "critical_depth": 5.0, "stages": [
                    {"factor_of_safety": factor, "liquefied_depth": 0.0}, {"factor_of_safety": liquefied, "liquefied_depth": 6.0}]}, label[4:])
        self.task("lem_lost", "lem_tool", SCENE, variant="lost", state="failed")
        self.write("study.json", {**STUDY, "report": {"criteria": {"as_built": 1.5, "pseudo_static": 1.125, "post_seismic": 1.1, "liquefied": 1.1,
                                                                   "source": "the code"}}})
        self.assertEqual([each[:4] for each in tables(self.document())["stability"].rows], [
            ["as built", "1.25", "1.5", "no"], ["pseudo-static", "1.12", "1.12", "yes"], ["after the shaking", "-", "1.1", "-"],
            ["liquefied, every layer that may", "0.5", "1.1", "no"]])
        self.assertEqual(row(self.document(), "stability", "as built")[4], "not_softened; up to 1.5 in softened")
        self.assertIn("k_h = 0.1", row(self.document(), "stability", "pseudo-static")[4])
        self.assertEqual(row(self.document(), "stability", "after the shaking")[4], 'not analysed: needs "post_seismic" of the study')
        self.assertIn("the code", tables(self.document())["stability"].caption)

    def test_volume_and_discharge_are_those_of_the_result_times_the_width(self):
        self.assertIn("at the toe (/mpm/sections)", row(self.document(), "found", "Peak discharge")[3])
        self.result(LATE, area_beyond_toe=246.25, sections={"far": {"x": 90.0, "largest_discharge": 1.0},
                                                            "toe": {"x": 2.5, "largest_discharge": 36.5}})
        self.assertEqual(row(self.document(), "found", "Released")[1::2],
                         ["739", "246 per m, 3 m wide (2 to 4 m: 492 to 985 m3), assumed: 3 (2 to 4) heights of 1 m (Wahl 1998); "
                          "set /mpm/breach_width"])
        self.assertEqual(row(self.document(), "found", "Peak discharge")[:2], ["Peak discharge past x = 2.5 m [m3/s]", "110"])
        self.edit(f"tasks/{LATE}/scene.completed.json", mpm={**SCENE["mpm"], "breach_width": 60})
        self.write("study.json", {**STUDY, "scene": {**SCENE, "mpm": {**SCENE["mpm"], "breach_width": [40, 60, 80]}}})
        self.assertEqual(row(self.document(), "found", "Released")[1::2],
                         ["14800", "246 per m, 60 m wide (40 to 80 m: 9850 to 19700 m3), /mpm/breach_width of the scene"])

    def test_before_and_after_are_of_one_scale(self):
        before, after = self.document().front.pictures
        self.assertEqual(before.chart.x.shown, after.chart.x.shown)
        self.assertEqual(marks(after), {"toe": 2, "reach 210 m": 212})

    def test_a_distance_has_the_digits_that_its_error_allows(self):
        self.write("results.json", {"rows": [{"variant": "softened", "transfer_time": 16.0, "runout_error": 12.3, "runout_error_from": "repeats"}]})
        self.result(LATE, runout=210.4567, runout_beyond_toe=220.6)
        self.assertEqual(row(self.document(), "found", "Runout: 99")[1], "210")
        self.assertEqual(row(self.document(), "found", "Reach: 99")[1::2], ["221", "\u00b1 12 m: repeats"])
        self.assertEqual(cell(self.document(), "numbers_mpm_solver", LATE, "runout [m]"), "210")


class Bounds(WetRun):
    def setUp(self):
        super().setUp()
        self.result(LATE, at_rest=False, flags=[MOVING], kinetic_share=0.12, runout_beyond_toe=200.0,
                    sections={"dam": {"x": 2, "volume": 30.0, "largest_discharge": 4.0}})

    def test_lower_bounds_are_marked_wherever_they_are(self):
        document = self.document()
        for table, begin, column in (("found", "Runout: 99", "governing case"), ("numbers_mpm_solver", LATE, "runout [m]"),
                                     ("front_gauges", "largest depth", "toe, x = 2 m"), ("sections", LATE, "passed [m2]"),
                                     ("variants", "softened", "runout [m]"), ("comparison", "plateau runout (t_T 15.25 to 20 s), softened", "here")):
            self.assertTrue(cell(document, table, begin, column).startswith("\u2265 "), (table, cell(document, table, begin, column)))
        self.assertEqual([each[5] for each in tables(document)["gauges"].rows], ["0.75", "0.75", "\u2265 0.75"])
        self.assertEqual(cell(document, "numbers_mpm_solver", SOFT, "runout [m]"), "90")
        self.assertEqual(cell(document, "numbers_mpm_solver", LATE, "how it ended"), "questionable: still moving")
        self.assertIn("lower bound", figures(document)["runout_against_transfer_time"].chart.series[0].certainty)
        self.assertIn("lower bound: the soil still moved", figures(document)["final_geometry_16s"].caption)

    def test_no_largest_runout_is_certain_while_another_still_moves(self):
        self.result(SOFT, flags=[MOVING])
        self.result(LATE, at_rest=True, flags=[])
        found = row(self.document(), "found", "Runout: 99")
        self.assertEqual(found[1:3], ["210", "30 to \u2265 210 (3 of 3)"])
        self.assertIn("would have gone farther", tables(self.document())["found"].caption)

    def test_a_mean_is_a_lower_bound_where_soil_of_a_repeat_moved(self):
        self.write("study.json", {**STUDY, "draws": 2, "variants": [
            {"name": "softened_d1", "made_by": "draws"}, {"name": "softened_d2", "made_by": "draws"}]})
        for k, flags in ((1, []), (2, [MOVING])):
            self.runout(f"mpm_16.000000_softened_d{k}", 16.0, f"softened_d{k}", 100.0 + k, flags=flags)
        self.write("results.json", {"rows": [], "means": [{
            "variant": "softened", "transfer_time": 16.0, "runout": 101.5, "runout_deviation": 0.7, "runout_beyond_toe": None, "runout_largest": None,
            "runout_error": 2.0, "draws": 2, "draws_done": 2, "missing_draws": "", "questionable_draws": "d2"}]})
        document = self.document()
        self.assertEqual(row(document, "numbers_means", "16")[3:6], ["\u2265 101.50 +- 0.7", "-", "-"])
        curve = figures(document)["runout_against_transfer_time"].chart.series[0]
        self.assertEqual((curve.name, curve.y, curve.error, curve.certainty), ("softened", [101.5], [0.7], ["lower bound"]))
        self.assertEqual("\u2265 101.5", row(document, "found", "Runout, mean of 2 repeats, softened")[1])


class Course(WetRun):
    def test_it_is_measured_where_its_telemetry_crosses_and_beside_the_paper(self):
        document = self.document()
        for what, paper, here in (("time at which liquefaction has reached 12 m", "11", "11"), ("time of the second failure surface", "14.75", "15"),
                                  ("time at which epsilon_q,avg exceeds 20 %", "17.5", "17"), ("window of transfer times opens", "14.75", "15"),
                                  ("window of transfer times closes", "17.5", "20"), ("time at which the mesh entangles", "23", "21"),
                                  ("runout at t_T = 13 s, softened", "100", "90"), ("plateau runout (t_T 15.25 to 20 s), softened", "215", "210")):
            self.assertEqual(row(document, "comparison", what)[2:4], [paper, here], what)
        self.assertEqual(row(document, "comparison", "factor of safety, nothing liquefied")[3:6], ["-", "-", "not in this run"])
        self.assertEqual(marks(figures(document)["liquefaction_depth"]), {"window opens": 15, "window closes": 20, "threshold 18.5": 18.5})
        self.assertIn("opens at 15 s and closes at 20 s", next(each.text for each in document.chapters if each.title == "Runout"))
        self.assertEqual(len(figures(document)["timeline"].chart.series), 10)

    def test_there_is_no_window_where_the_mesh_is_distorted_first(self):
        lines = [{**line, "jacobian_least_avg": 0.9} for line in shaking()]
        self.telemetry("fem", lines)
        self.assertIn("there is no window", next(each.text for each in self.document().chapters if each.title == "Runout"))
        self.assertIn("mesh too distorted", marks(figures(self.document())["kinetic_energy"]))

    def test_a_trigger_may_ask_for_the_critical_depth(self):
        self.task("lem", "lem_tool", SCENE, {"critical_depth": 12.25, "factor_of_safety": 1.5})
        self.write("study.json", {**STUDY, "triggers": [
            {"kind": "window", "lower": "liquefaction_depth >= critical_depth", "upper": "failure_surfaces >= 2"}]})
        self.assertEqual(row(self.document(), "comparison", "window of transfer times opens")[3], "11")

    def test_only_telemetry_that_its_scene_gives_a_meaning_is_drawn(self):
        self.edit("tasks/fem/scene.completed.json", fem={})
        document = self.document()
        self.assertNotIn("liquefaction_depth", figures(document))
        self.assertIn("Liquefaction depth", [what for what, _ in document.left_out])

    def test_an_entangled_mesh_is_a_regular_end_and_a_bad_corner_is_not(self):
        self.entangle(time=20.5, element=7, region="sand", x=1.5, kind="band", mean_epsilon_q=0.4)
        self.assertEqual(how_it_ended(read_run(self.folder).of("fem_solver")[0]),
                         "entangled at 20.5 s in element 7 (region sand, x = 1.5 m), in the failure's band")
        self.assertIn("it is no fault", self.document().verdict.notes[0])
        self.entangle(kind="corner")
        self.assertIn("refine it there", self.document().verdict.cautions[0])

    def test_the_motion_is_shown_with_its_share_before_the_end(self):
        (self.folder / "tasks/fem/motion.csv").write_text("# of the FEM\ntime_s,acceleration_g\n" + "".join(
            f"{0.5 * k},{a}\n" for k, a in enumerate([0, 0.1, -0.2, 0.1, 0, 0.3, 0])))
        self.entangle(time=1.5)
        text = next(each.text for each in self.document().chapters if each.title == "Motion")
        self.assertIn("PGA 0.3 g", text)
        self.assertIn("ended at 1.5 s: until then PGA 0.2 g and 36.7 % of the Arias intensity", text)
        self.assertEqual(marks(figures(self.document())["motion_acceleration"]), {"finite elements end": 1.5})

    def test_the_fem_behind_the_farthest_runout_is_shown(self):
        self.write("tasks/fem/task.json", {"id": "fem", "label": "fem", "phase": "fem_solver", "variant": "not_softened", "state": "failed"})
        self.task("fem_late", "fem_solver", SCENE, {"end_time": 5.0}, "softened")
        self.telemetry("fem_late", shaking()[:6])
        chapter = next(each for each in self.document().chapters if each.title == "Motion and failure")
        self.assertTrue(chapter.text.startswith("Of 2 finite element analyses the one behind the farthest runout: softened."))
        self.assertEqual(cell(self.document(), "variants", "not_softened", "window opens [s]"), "15")
        self.assertEqual(cell(self.document(), "variants", "softened", "window opens [s]"), "-")


class Variants(WetRun):
    def test_their_changes_are_listed_once_for_several_materials(self):
        self.assertEqual(cell(self.document(), "variants", "not_softened", "changed"),
                         "/materials/{a, b}/viscosity=0; /mpm/terrain=[[0,0],[2,0],[102,-20]]")
        self.assertEqual(changes_of(["/materials/a/c=1", "/materials/b/c=2", "/materials/a/d=3"]), "/materials/{a, b}/c=1, 2; /materials/a/d=3")
        self.assertEqual(cell(self.document(), "variants", "not_softened", "against the first [%]"), "-85.7")

    def test_variants_of_the_same_entries_are_one_bar_and_the_longest_is_on_top(self):
        self.write("study.json", {"variants": [{"name": "base", "overrides": []}] + [{"name": name, "overrides": [change]} for name, change in (
            ("weak", "/c=1"), ("strong", "/c=3"), ("thick", "/viscosity=9"))]})
        for name, reach in (("base", 100.0), ("weak", 150.0), ("strong", 90.0), ("thick", 80.0)):
            self.runout(f"mpm_16.000000_{name}", 16.0, name, reach)
        chart = figures(self.document())["sensitivity"].chart
        self.assertEqual(chart.y.names, ["thick", "weak, strong"])
        self.assertEqual([each.x for each in chart.series], [[100, 80, 100, 90], [100, 100, 100, 150]])
        self.assertEqual(marks(figures(self.document())["sensitivity"]), {"base": 100})

    def test_grounds_are_shown_on_one_scale_with_the_longest_runout_of_each(self):
        document = self.document()
        self.assertEqual(row(document, "ground", "runout"), ["runout [m]", "210", "30", "> 800"])
        ground = {each.name: each for each in figures(document)["ground_softened"].chart.series}
        self.assertEqual(ground["ground, softened"].y, [-30, -30])
        self.assertAlmostEqual(ground["ground, not_softened"].y[-1], -20 * (2 + 1.15 * 210 - 2) / 100)

    def test_a_ratio_of_runouts_that_says_nothing_says_so(self):
        self.result(STRONG, runout=2.5)
        self.runout("mpm_17", 17.0, "not_softened", 0.5)
        self.runout("mpm_17_softened", 17.0, "softened", 200.0)
        self.assertIn("says nothing", row(self.document(), "comparison", "ratio of the two plateaus")[6])

    def test_settings_are_those_of_the_study_and_not_of_the_run_that_a_result_came_from(self):
        self.assertEqual(cell(self.document(), "numbers_mpm_solver", LATE, "settings"), "as in the scene")
        self.write("study.json", {})
        self.assertEqual(cell(self.document(), "numbers_mpm_solver", LATE, "settings"), "/mpm/cell_size=1")

    def test_the_scene_is_that_of_the_study(self):
        self.write("study.json", {**STUDY, "scene": {**SCENE, "title": "asked", "name": "other"}})
        document = self.document()
        self.assertEqual(read_run(self.folder).scene["name"], "other")
        self.assertNotIn("comparison", tables(document))

    def test_a_companion_brings_its_variants_and_runouts(self):
        other = Variants("test_the_scene_is_that_of_the_study")
        other.setUp()
        self.addCleanup(other.doCleanups)
        other.edit("run.json", name="other")
        document = self.document(companions=[other.folder])
        self.assertIn("variants_other", tables(document))
        self.assertIn("other, softened", [each.name for each in figures(document)["runout_against_transfer_time"].chart.series])


class Inputs(WetRun):
    def test_the_annex_has_every_entry_and_marks_defaults(self):
        self.write("study.json", {**STUDY, "scene": {**SCENE, "mpm": {**SCENE["mpm"], "anti_locking": "auto"}}, "overrides": []})
        self.assertEqual(row(self.document(), "settings_mpm", "/mpm/anti_locking"), [
            "/mpm/anti_locking", "cell-averaged volumetric strain increment and mean stress", "auto *"])
        self.assertEqual(row(self.document(), "settings_mpm", "/mpm/cell_size"), ["/mpm/cell_size", "edge of the square cells [m]", "1.0"])
        self.edit("study.json", overrides=["/mpm/anti_locking=auto"])
        self.assertEqual(row(self.document(), "settings_mpm", "/mpm/anti_locking")[2], "auto")

    def test_the_reviewer_is_answered_from_the_run(self):
        self.result(LATE, flags=[{**IMPLAUSIBLE, "code": "coarse_cells"}], particles=4)
        found = row(self.document(), "checklist", "How fine is the runout")[1]
        self.assertIn("cells of 1.0 m, 4 points", found)
        self.assertIn("flagged: coarse_cells", found)
        self.assertIn("Does limit equilibrium", row(self.document(), "checklist", "Not modelled")[1])


class Release(WetRun):
    def test_volumes_add_up_and_each_soil_has_its_own(self):
        found = tables(self.document())["volume_balance"].rows
        self.assertEqual(found, [["liquefied_1", "3", "3", "0", "3"], ["all soils", "3.75", "3", "0", "3"],
                                 ["all soils, through a breach of 3 m [m3]", "11.2", "9", "0", "9"]])
        self.result(LATE, flags=[MOVING])
        self.assertEqual(row(self.document(), "volume_balance", "all soils")[1:3], ["3.75", "\u2265 3"])

    def test_the_crest_is_lost_and_the_freeboard_with_it(self):
        self.assertEqual(row(self.document(), "crest", "crest"), ["crest", "1", "0.5", "0.5"])
        self.assertIn("no pond", row(self.document(), "crest", "freeboard")[3])
        self.edit(f"tasks/{LATE}/scene.completed.json", lem={"water": {"line": [[0, 0.95], [2, 0]]}})
        self.assertEqual(row(self.document(), "crest", "freeboard above the pond at 0.95")[1:], ["0.05", "-0.45", "0.5"])

    def test_without_frames_it_says_what_would_give_it(self):
        (self.folder / f"tasks/{LATE}/particles_0.000000.vtkhdf").unlink()
        self.assertIn(("volume balance", "the governing runout has no frames (/mpm/snapshot_interval)"), self.document().left_out)


class Risks(WetRun):
    BRITTLE = {**SCENE, "materials": {"tailings": {"law": {"type": "mohr_coulomb", "c_kPa": 8.0, "phi_deg": 0}, "limit_strength": {"phi_deg": 31}}},
               "section": {"regions": [{"name": "beach", "material": "tailings", "polygon": [[0, 0], [2, 0], [2, 1], [0, 1]]}]},
               "lem": {"liquefaction": [{"region": "beach", "residual_strength_kPa": 8.0}], "undrained": []}}

    def test_a_brittle_soil_names_the_runs_that_begin_with_its_residual_strength(self):
        peak = {**self.BRITTLE, "lem": {**self.BRITTLE["lem"], "undrained": [{"region": "beach", "strength_kPa": 32.0}]},
                "materials": {"tailings": {"law": {"type": "mohr_coulomb", "c_kPa": 32.0, "phi_deg": 0}}}}
        self.write("study.json", {**STUDY, "scene": self.BRITTLE})
        self.task("lem_softened", "lem_tool", self.BRITTLE, {"factor_of_safety": 1.5}, "softened")
        self.assertEqual(row(self.document(), "brittle_soils", "tailings"),
                         ["tailings", "c' = 0 kPa, phi' = 31 deg", "s_u = 8 kPa", "-", "no runout"])
        self.task("lem_not_softened", "lem_tool", peak, {"factor_of_safety": 1.25}, "not_softened")
        for label, scene in ((SOFT, self.BRITTLE), (LATE, peak)):
            self.write(f"tasks/{label}/scene.completed.json", scene)
        self.assertEqual(row(self.document(), "brittle_soils", "tailings"), ["tailings", "s_u = 32 kPa", "s_u = 8 kPa", "0.75", "softened"])

    def test_a_mode_is_analysed_only_where_the_run_has_an_answer(self):
        self.assertEqual(row(self.document(), "failure_modes", "sliding of")[1:], ["not analysed", 'needs "stability" of the study'])
        self.task("lem", "lem_tool", SCENE, {"factor_of_safety": 1.25})
        self.assertEqual(row(self.document(), "failure_modes", "sliding of")[1:], ["analysed", "least factor of safety 1.25"])
        self.assertEqual(row(self.document(), "failure_modes", "liquefaction by an earthquake")[1], "analysed")
        self.assertEqual(row(self.document(), "failure_modes", "internal erosion")[1], "not analysed")

    def test_each_clause_leads_to_a_place_of_the_page_or_says_that_there_is_none(self):
        html, places = as_html(self.document(), ""), {clause: found for clause, _, found in index_of(self.document())}
        self.assertEqual(places["CDA (2021), uncertainty"], [])
        self.assertIn("not in this report", html)
        self.assertIn(("failure_modes", "Credible failure modes"), places["GISTM (2020) 5.4"])
        for name, _ in sum(places.values(), []):
            self.assertIn(f'id="{name}"', html)


class Pages(WetRun):
    def page(self, **choice):
        return as_html(self.document(**choice), "")

    def test_no_reason_of_a_long_verdict_is_lost(self):
        texts = [f"Reason {k}: " + "x" * 300 + "." for k in range(3)]
        self.edit("run.json", verdict={"usable": "questionable", "words": "questionable", "reasons": [
            {"usable": "questionable", "code": "a", "text": text} for text in texts]})
        front, _, rest = self.page().partition("<nav>")
        self.assertEqual([text in front for text in texts], [True, False, False])
        self.assertIn("2 more after the contents", front)
        self.assertEqual([text in rest for text in texts], [False, True, True])

    def test_the_annex_sets_defaults_in_one_paragraph(self):
        self.write("study.json", {**STUDY, "scene": {**SCENE, "mpm": {**SCENE["mpm"], "anti_locking": "auto"}}, "overrides": []})
        html = self.page()
        self.assertIn("Defaults: /mpm/anti_locking = auto", html)
        self.assertIn(">/mpm/cell_size<", html.replace('<span class="short">', "").replace("</span>", ""))

    def test_names_in_chinese_and_long_ones_fit(self):
        long = "\u5c3e\u77ff\u5e93" * 40
        self.edit("run.json", title=long, name="n" * 120)
        self.task(f"mpm_{'v' * 120}", "mpm_solver", SCENE, {"runout": 220.0, "runout_largest": 220.0}, long, 16.0)
        self.edit("run.json", governing={"task": f"mpm_{'v' * 120}"})
        write_report(self.document(), self.folder / "page.html", alone=False)
        self.assertIn(long, (self.folder / "page.html").read_text(encoding="utf-8"))

    def test_texts_are_escaped_and_wide_tables_put_long_texts_below_their_rows(self):
        self.edit("run.json", title="<b>A & B</b>")
        html = self.page()
        self.assertIn("&lt;b&gt;A &amp; B&lt;/b&gt;", html)
        self.assertIn('<tr class="below">', html[html.index('id="numbers_mpm_solver"'):])

    def test_columns_of_numbers_are_right_aligned_and_words_stay_whole(self):
        document = self.document()
        document.front.tables = [Table("t", "", ["speed [m/s]", "what", "name"], [["1.5", "30", "undrained_peak"], [f"{at_least}2", "-", "v" * 30],
                                                                               ["-", "set /mpm/cell_size", "(1, -2.5) c' = 3"]])]
        html = as_html(document, "")
        self.assertIn('<th class="n">speed <span class="short">[m/s]</span></th><th>what</th>', html)
        self.assertIn('<td class="n short">1.5</td><td class="short">30</td><td>undrained_peak</td>', html)
        self.assertIn(f'<td class="n b short">\u2265 2</td><td class="short">-</td><td class="long">{"v" * 30}</td>', html)
        self.assertIn('set <span class="short">/mpm</span>/cell_size</td><td>(1,\u00a0-2.5) c&#39;\u00a0=\u00a03</td>', html)

    def test_two_hundred_variants_are_one_table(self):
        self.write("study.json", {"variants": [{"name": f"v{k:03}", "overrides": [f"/mpm/cell_size={k + 1}"]} for k in range(200)]})
        for k in range(200):
            self.task(f"mpm_v{k:03}", "mpm_solver", SCENE, {"runout": float(k), "runout_largest": float(k)}, f"v{k:03}", 16.0)
        self.edit("run.json", governing={"task": "mpm_v199"})
        document = self.document()
        self.assertEqual(len(tables(document)["variants"].rows), 200)
        self.assertIn("200 variants.", document.front.asked[1])
        as_html(document, "")

    def test_file_names_are_short_and_apart(self):
        names = [as_file_name("\u5c3e" * 100 + end) for end in ("a", "b")]
        self.assertNotEqual(*names)
        self.assertLess(max(len(each.encode()) for each in names), 200)
        self.assertEqual(as_file_name("a/b"), "a_b")

    def test_a_name_is_given_once(self):
        document = Document("")
        document.front.pictures = [Figure("overview", Chart("", Axis(""), Axis("")))]
        document.add(Chapter("", tables=[Table("empty", "", ["a"]), Table("a/b", "", ["a"], [["1"]])]))
        document.add(Chapter("", tables=[Table("empty", "", ["a"], [["1"]])]))
        for name in ("overview", "a_b"):
            with self.assertRaisesRegex(ValueError, f'"{name}" names two'):
                document.add(Chapter("", tables=[Table(name, "", ["a"], [["1"]])]))

    def test_tables_quote_text_and_keep_numbers(self):
        self.assertEqual(Table("t", "", ["a", "b [m]"], [['x "y"', "1e-5"], ["12 m", "\u2265 3"]]).csv(),
                         '"a","b [m]"\n"x ""y""",1e-5\n"12 m","\u2265 3"\n')
        self.assertRaises(ValueError, Table("t", "", ["a"], [["1", "2"]]).csv)


class Refusals(WetRun):
    def run_report(self, folder, *more, environment=None):
        return subprocess.run([report, str(folder), "--output", str(self.folder / "page.html"), *more], capture_output=True, text=True,
                              env=environment)

    def test_a_folder_without_phases_or_of_another_kind_is_refused(self):
        empty = self.folder / "empty"
        empty.mkdir()
        for folder, code, words in ((empty, 65, "no phase's folder is in it"), (self.folder / "nowhere", 74, "is no folder")):
            done = self.run_report(folder)
            self.assertEqual(done.returncode, code, done.stderr)
            self.assertIn(words, done.stderr)
        self.assertEqual(subprocess.run([report], capture_output=True).returncode, 2)

    def test_a_pdf_as_page_is_refused_with_the_way_to_one(self):
        done = self.run_report(self.folder, "--output", str(self.folder / "page.pdf"))
        self.assertEqual(done.returncode, 2)
        self.assertIn(f"weasyprint {self.folder / 'page.html'} {self.folder / 'page.pdf'}", done.stderr)
        self.assertFalse((self.folder / "page.pdf").exists())

    def test_damaged_files_are_named(self):
        (self.folder / "results.json").write_text("{")
        done = self.run_report(self.folder)
        self.assertEqual(done.returncode, 65)
        self.assertIn("results.json", done.stderr)
        (self.folder / "results.json").unlink()
        (self.folder / "tasks/fem/telemetry.jsonl").write_text('{"time": 1}\n{"no": 2}\n')
        self.assertEqual(self.run_report(self.folder).returncode, 65)

    def test_an_export_of_another_version_is_to_be_exported_again(self):
        self.edit("run.json", verdict=None)
        done = self.run_report(self.folder)
        self.assertEqual((done.returncode, "export the run again" in done.stderr), (65, True))

    def test_an_unfinished_run_says_what_is_missing(self):
        for label in (SOFT, LATE, STRONG):
            self.task(label, "mpm_solver", variant=label.split("_", 2)[2], time=16.0, state="running")
            (self.folder / f"tasks/{label}/result.json").unlink()
        self.edit("run.json", state="running", finished=None, governing=None, headline={"outcome": "not_known", "text": ""})
        document = self.document()
        self.assertEqual(row(document, "found", "Runout [m]"), ["Runout [m]", "no result", "0 of 3", "it has not ended (running)"])
        self.assertIn(("runout against transfer time, final geometries", "no runout ended well: it has not ended (running)"), document.left_out)
        as_html(document, "")

    def test_a_missing_package_is_named(self):
        fake = self.folder / "bare"
        fake.mkdir()
        (fake / "sitecustomize.py").write_text("import importlib.util as u\nfind = u.find_spec\n"
                                               "u.find_spec = lambda name, *more: None if name == 'jinja2' else find(name, *more)\n")
        done = self.run_report(self.folder, environment={**os.environ, "PYTHONPATH": str(fake)})
        self.assertEqual(done.returncode, 69)
        self.assertEqual(done.stderr, "report: Python's package jinja2 is missing; install it: apt-get install python3-jinja2\n")

    def test_another_fault_is_our_own(self):
        self.assertEqual(guarded(self.folder, lambda: [][1]), 70)


class ByHand(WetRun):
    """Without run.json and task.json: the service's program reads the folders."""

    def setUp(self):
        super().setUp()
        for file in (self.folder / "run.json", self.folder / "study.json", *self.folder.glob("tasks/*/task.json")):
            file.unlink()

    def test_labels_tell_phase_time_and_variant_and_findings_the_rest(self):
        self.result(LATE, flags=[MOVING], at_rest=False)
        run = read_run(self.folder)
        self.assertEqual([(each.label, each.time, each.variant) for each in run.of("mpm_solver")],
                         [(SOFT, 13.0, "softened"), (STRONG, 16.0, "not_softened"), (LATE, 16.0, "softened")])
        self.assertIs(run.farthest, run.of("mpm_solver")[2])
        document = self.document()
        self.assertEqual(document.verdict.words, "questionable")
        self.assertTrue(any("The FEM left no result: the mesh is entangled at 21 s." in each for each in document.verdict.cautions))
        self.assertEqual(document.front.identity, "Scene mochikoshi-small.")

    def test_a_variants_name_is_not_mistaken_for_a_time(self):
        (self.folder / "tasks" / SOFT).rename(self.folder / "tasks/mpm_20_kpa")
        self.assertEqual([(each.time, each.variant) for each in read_run(self.folder).of("mpm_solver")][0], (None, "20_kpa"))

    def test_two_runs_in_one_folder_are_refused(self):
        (self.folder / "again").mkdir()
        (self.folder / "tasks" / SOFT).rename(self.folder / "again" / LATE)
        self.assertEqual(guarded(self.folder, lambda: read_run(self.folder) and None), 65)


if __name__ == "__main__":
    unittest.main()
