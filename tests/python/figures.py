"""breachline.plot: what a chart shows and its CSV says, and the figures of the phases; the page of accuracy studies."""
import json
import os
import pathlib
import re
import sys
import tempfile
import unittest

root = pathlib.Path(os.environ["BREACH_ROOT"])
sys.path[:0] = [str(root / "services/python"), str(root / "services/report")]
try:
    import h5py
    import numpy
    import matplotlib  # noqa: F401
except ImportError as missing:
    print(f"skipped: {missing}")
    sys.exit(77)
from breachline import BreachlineError, Frame, plot  # noqa: E402
from breachline.plot import Axis, Chart, Field, Figure, Mark, Series  # noqa: E402
from breachline.plot.mesh import largest_excess_pressure  # noqa: E402
from breachline_report.accuracy_page import accuracy_page, error_against_time  # noqa: E402

NAN = float("nan")


def cycles(**more):
    return Chart("a < b & c", Axis("N [-]", logarithmic=True), Axis("CSR [-]"),
                 [Series("one", [1, 10, 100], [0.3, 0.2, 0.1], "line_and_points", **more)])


def section(*series, **more):
    return Chart("section", Axis("x [m]"), Axis("y [m]"), list(series), equal=True, **more)


def two_quads():
    return section(field=Field("epsilon_q [%]", 4, [0, 1, 1, 0, 1, 2, 2, 1], [0, 0, 1, 1, 0, 0, 1, 1], [0.5, 7.25], 0, 8))


def texts(svg):
    """[(x, y, text), ...]"""
    return [(float(x), float(y), text) for x, y, text in re.findall(r'<text [^>]*x="([^"]*)" y="([^"]*)"[^>]*>([^<]*)<', svg)]


class Charts(unittest.TestCase):
    def test_text_stays_text_and_nothing_needs_a_style_sheet(self):
        chart = cycles()
        chart.series[0].name = "$尾矿_1$ 坝"  # no formula, and no glyph of matplotlib's
        svg = plot.as_svg(chart)
        self.assertTrue({"a &lt; b &amp; c", "$尾矿_1$ 坝", "CSR [-]", "10"} <= {text for _, _, text in texts(svg)})
        self.assertTrue(svg.startswith("<svg "))
        self.assertNotRegex(svg, r"style|paint-order|<image|xlink|font:")

    def test_the_same_chart_gives_the_same_picture(self):
        self.assertEqual(plot.as_svg(cycles()), plot.as_svg(cycles()))
        self.assertEqual(plot.as_png(cycles())[:4], b"\x89PNG")

    def test_points_are_drawn_by_their_certainty(self):
        def hollow(svg):
            return len(re.findall(r'<use [^>]*fill="#ffffff"', svg))

        plain, told = plot.as_svg(cycles()), plot.as_svg(cycles(certainty=["certain", "lower bound", "questionable"]))
        self.assertEqual((hollow(plain), hollow(told)), (0, 2))
        self.assertEqual({text for _, _, text in texts(told)} - {text for _, _, text in texts(plain)}, {"lower bound", "questionable"})
        self.assertEqual(plot.as_csv(cycles(certainty=["certain", "lower bound", "questionable"])),
                         'series,"N [-]","CSR [-]","certainty"\n"one",1,0.3,"certain"\n"one",10,0.2,"lower bound"\n"one",100,0.1,"questionable"\n')

    def test_known_errors_are_a_band(self):
        def bands(svg):
            return len(re.findall(r'fill-opacity="0.16"|opacity="0.16"', svg))

        chart = cycles(error=[0.05, 0.02, NAN])
        self.assertEqual((bands(plot.as_svg(cycles())) > 0, bands(plot.as_svg(chart)) > 0), (False, True))
        self.assertEqual(plot.as_csv(chart), 'series,"N [-]","CSR [-]","error"\n"one",1,0.3,0.05\n"one",10,0.2,0.02\n"one",100,0.1,\n')
        ranges = plot.as_csv(cycles(low=[0, NAN, 0], high=[1, NAN, 1]))
        self.assertEqual(ranges.splitlines()[1:], ['"one",1,0.3,0,1', '"one",10,0.2,,', '"one",100,0.1,0,1'])

    def test_what_has_no_place_or_no_partner_is_refused(self):
        for x in (0.0, NAN):
            chart = cycles()
            chart.series[0].x = [x, 1, 2]
            with self.assertRaisesRegex(ValueError, "no place on its axis x"):
                plot.as_svg(chart)
        field = two_quads()
        field.field.x = field.field.x[1:]
        for chart, message in ((field, "2 values and 7 corners"), (section(Series("short", [1, 2, 3], [1, 2])), "3 values of x and 2 of y"),
                               (cycles(error=[0.1]), "1 of error"), (cycles(certainty=["certain"]), "1 of certainty"),
                               (section(Series("mesh", [0, 1, 1], [0, 0, 0], "segments")), "3 ends of segments"), (section(), "without data")):
            with self.assertRaisesRegex(ValueError, message):
                plot.as_svg(chart)

    def test_labels_of_marks_cover_no_curve_and_no_other_label(self):
        chart = cycles()
        chart.marks = [Mark("x", 9 + k, f"mark {k}") for k in range(4)] + [Mark("y", 0.2 + 0.001 * k, f"level {k}") for k in range(3)]
        placed = {text: (x, y) for x, y, text in texts(plot.as_svg(chart))}
        top = min(y for text, (_, y) in placed.items() if text in ("0.3", "0.1"))
        self.assertTrue(all(placed[f"mark {k}"][1] < top for k in range(4)), "above the axes")
        self.assertTrue(all(placed[f"mark {k}"][1] < placed[f"mark {k + 1}"][1] - 8 for k in range(3)), "in rows")
        self.assertTrue(all(placed[f"level {k}"][0] > placed["100"][0] for k in range(3)), "right of the axes")
        self.assertTrue(all(placed[f"level {k + 1}"][1] < placed[f"level {k}"][1] - 8 for k in range(2)), "in rows")

    def test_a_field_is_one_path_per_colour_and_whole_in_its_data(self):
        svg = plot.as_svg(two_quads())
        self.assertEqual(len(re.findall(r'd="m[^"]*z" clip-path', svg)), 2)
        self.assertIn("epsilon_q [%]", svg)
        self.assertEqual(plot.as_csv(two_quads()), 'x1 [m],y1 [m],x2 [m],y2 [m],x3 [m],y3 [m],x4 [m],y4 [m],"epsilon_q [%]"\n'
                         "0,0,1,0,1,1,0,1,0.5\n1,0,2,0,2,1,1,1,7.25\n")
        many = numpy.random.default_rng(1).random((2, 15_000))
        cloud = section(field=Field("r_u [-]", 1, *many, many[0], 0, 1))
        self.assertLess(len(plot.as_svg(cloud)), 250_000)

    def test_a_flat_section_says_how_its_heights_are_exaggerated(self):
        self.assertIn("y [m], heights x 9", plot.as_svg(section(Series("ground", [0, 1000], [0, 20]))))
        self.assertNotIn("heights x", plot.as_svg(section(Series("ground", [0, 100], [0, 60]))))

    def test_two_hundred_variants_have_a_legend_that_fits_a_page(self):
        chart = cycles()
        chart.series = [Series(f"variant {k} " + "x" * 100, [1, 2], [k, k]) for k in range(200)]
        svg = plot.as_svg(chart)
        self.assertIn("and 176 more", svg)
        self.assertLess(float(re.search(r'height="([\d.]+)pt"', svg)[1]), 1000)

    def test_a_name_that_would_leave_the_folder_is_refused(self):
        with tempfile.TemporaryDirectory() as folder, self.assertRaisesRegex(BreachlineError, "rename the test"):
            plot.write_figures(pathlib.Path(folder), [Figure("../away", cycles())])


def mesh(water=True):
    """Four unit squares in a row, water in all, the left half liquefied."""
    x, y = (each.ravel() for each in numpy.meshgrid(numpy.arange(5.0), [0.0, 1.0]))
    nodes = {"displacement": numpy.zeros((10, 2)), "pore_pressure": numpy.where(x < 2.5, 55e3, 1e3), "pore_pressure_0": numpy.full(10, 1e3),
             "sigma_v0": numpy.full(10, 60e3)}
    return Frame(1.0, numpy.stack([x, y], axis=1), ["a", "b"], ["sand", "sand"], nodes if water else {}, {},
                 numpy.array([[k, k + 1, k + 6, k + 5] for k in range(4)]),
                 {"stress": numpy.tile([0.0, -50e3, 0, 0], (4, 1)), "region": numpy.array([0, 0, 1, 1])})


def points():
    fields = {"stress": numpy.tile([0.0, -50e3, 0, 0], (4, 1)), "pore_pressure": numpy.full(4, 20e3), "r_u": numpy.array([0.9, 0.9, 0, 0]),
              "region": numpy.array([1, 1, 0, 0]), "epsilon_q": numpy.array([0, 0.1, 0.2, 0.3])}
    return Frame(0.0, mesh().position[:4] + 0.5, ["tailings", "tailings"], ["sound", "liquefied_2"], fields, {},
                 stress_of_regions=["effective", "total"], inputs=[("/gone/snapshot_1.vtkhdf", "a" * 64)])


LAYERS = plot.LayerColours(0.7, False, [50e3, 100e3], ["liquefied_1", "liquefied_2"])


class Frames(unittest.TestCase):
    def test_a_mesh_has_borders_and_edges(self):
        self.assertEqual((len(plot.edges_of(mesh()).x), len(plot.borders_of(mesh()).x)), (2 * 13, 2 * 11), "13 edges, two of them inside a region")

    def test_r_u_is_of_the_present_or_of_the_largest_excess_pressure(self):
        numpy.testing.assert_allclose(plot.element_r_u(mesh()), [0.9, 0.9, 0.45, 0])
        self.assertIsNone(plot.element_r_u(mesh(water=False)))
        means_of_elements_around = [54e3, 54e3, 40.5e3, 13.5e3, 0]
        numpy.testing.assert_allclose(largest_excess_pressure(mesh())[:5], means_of_elements_around)
        shaken = mesh()
        shaken.fields["excess_pressure_max"] = numpy.full(10, 50e3)
        self.assertEqual(largest_excess_pressure(shaken)[4], 50e3)

    def test_colours_end_at_a_round_number(self):
        several = numpy.concatenate([numpy.linspace(0, 7.2, 200), [1e6]])
        numpy.testing.assert_allclose([plot.colour_range(each)[1] for each in ([], [0.0], [0.11], several)], [1, 1, 0.15, 8])

    def test_both_sides_of_a_transfer_show_one_quantity_in_one_scale(self):
        pairs = plot.compare(mesh(), points(), LAYERS)
        self.assertEqual([each.before.name for each in pairs], ["sigma_v_before", "r_u_before", "liquefied_before"])
        for pair in pairs:
            before, after = pair.before.chart.field, pair.after.chart.field
            self.assertEqual((before.label, before.low, before.high), (after.label, after.low, after.high))
        # 50 kPa effective, or 50 kPa total with 20 kPa of water in it
        numpy.testing.assert_allclose(pairs[0].after.chart.field.value, [30, 30, 50, 50])
        numpy.testing.assert_array_equal(pairs[1].after.chart.field.value, points()["r_u"])
        # sigma'_v0 = 60 kPa is in the second layer
        numpy.testing.assert_array_equal(pairs[2].before.chart.field.value, [2, 2, 0, 0])
        numpy.testing.assert_array_equal(pairs[2].after.chart.field.value, [2, 2, 0, 0])
        self.assertEqual(plot.side_by_side(pairs).count("<svg"), 7, "six and the page around them")
        self.assertEqual(len(plot.compare(mesh(water=False), points(), LAYERS)), 1, "without water only the stress")

    def test_points_are_coloured_by_material_or_strain(self):
        by_material = plot.points_by_material(points(), "name", "title")
        self.assertEqual([(each.name, len(each.x)) for each in by_material.chart.series], [("liquefied_2", 2), ("sound", 2)])
        self.assertEqual(by_material.caption, "4 material points.")
        numpy.testing.assert_allclose(plot.points_by_strain(points(), "name", "title").chart.field.value, [0, 10, 20, 30])

    def test_a_snapshot_that_is_gone_is_named(self):
        with tempfile.TemporaryDirectory() as name:
            folder, of = pathlib.Path(name), points()
            with h5py.File(folder / "particles.vtkhdf", "w") as file:
                file["VTKHDF/Points"], file["VTKHDF/Types"] = numpy.zeros((4, 3)), numpy.ones(4, "u1")
                file.create_group("VTKHDF/CellData"), file.create_group("VTKHDF/PointData")
                for name, words in (("regions", of.regions), ("materials_of_regions", of.materials), ("provenance/input_paths", of.inputs[0][:1]),
                                    ("provenance/input_sha256", of.inputs[0][1:])):
                    file[f"breachline/{name}"] = words
                file["breachline"].attrs["time"] = 0.0
            (folder / "scene.completed.json").write_text('{"transfer": {}}')
            with self.assertRaisesRegex(OSError, "/gone/snapshot_1.vtkhdf"):
                plot.write_transfer_figures(folder, folder / "figures")


class Stability(unittest.TestCase):
    CIRCLE = {"circle": {"center": [0, 10], "radius": 10}, "entry": [10, 10]}

    def surfaces(self, result, scene={}):
        with tempfile.TemporaryDirectory() as folder:
            (pathlib.Path(folder) / "scene.completed.json").write_text(json.dumps({"section": {"regions": []}, **scene}))
            (pathlib.Path(folder) / "result.json").write_text(json.dumps(result))
            return plot.stability_figures(pathlib.Path(folder))[0].chart.series

    def test_a_folder_without_files_is_said(self):
        for figures in (plot.stability_figures, plot.element_test_figures):
            with self.assertRaisesRegex(OSError, "/nonexistent/result.json: cannot be read"):
                figures(pathlib.Path("/nonexistent"))
        with self.assertRaisesRegex(BreachlineError, "give a folder of lem_tool"):
            self.surfaces({"stages": [{}]})

    def test_straight_pieces_are_drawn_beside_the_circle(self):
        drawn = self.surfaces({**self.CIRCLE, "exit": [0, 0], "non_circular": {"factor_of_safety": 1.25, "points": [[0, 0], [6, 2], [10, 10]]}})[-1]
        self.assertEqual((drawn.name, drawn.x, drawn.y), ("non-circular, FS 1.25", [0, 6, 10], [0, 2, 10]))

    def test_the_answer_along_a_weak_layer_follows_its_own_floor(self):
        answer, circle = self.surfaces({**self.CIRCLE, "exit": [-7, 3], "surface": "composite", "factor_of_safety": 0.75,
                                        "floor": [[-20, 3], [20, 3]], "bishop": {**self.CIRCLE, "exit": [0, 0], "factor_of_safety": 1.5}})
        self.assertEqual((answer.name, circle.name), ("critical", "circle, FS 1.5"))
        self.assertGreaterEqual(min(answer.y), 3 - 1e-12)
        self.assertLess(min(circle.y), 0.1)

    def test_a_composite_surface_follows_the_scenes_floor(self):
        drawn = self.surfaces({**self.CIRCLE, "exit": [-2, 2]}, {"lem": {"floor": [[0, 2], [3, 2], [7, 4]]}})[-1]
        x, y = numpy.array(drawn.x), numpy.array(drawn.y)
        numpy.testing.assert_allclose([x[0], y[0], x[-1], y[-1]], [10, 10, -2, 2], atol=1e-12, err_msg="it ends on the floor, above its circle")
        self.assertTrue(numpy.isclose(x, 3).any(), "the floor's kink")
        floor = numpy.where(x <= 3, 2, numpy.minimum(4, 2 + (x - 3) / 2))
        numpy.testing.assert_allclose(y, numpy.maximum(10 - numpy.sqrt(numpy.maximum(0, 100 - x * x)), floor), atol=0.01)


def row(step, error, cpu, on_front):
    return {"ladder": "cells", "setting": [f"/mpm/cell_size={4 // step}"], "value": 10.0, "standard_deviation": None, "draws": 1, "error": error,
            "error_of_a_run": error, "mean_within_asked": {"draws": 4, "error": 0.049, "cpu_seconds": 4 * cpu}, "below_noise": False,
            "on_pareto_front": on_front, "questionable": False, "cpu_seconds": cpu, "wall_seconds": cpu, "peak_memory_MB": None,
            "reason": "it is the reference" if error is None else ""}


def table(*rows):
    return {"quantity": "runout", "unit": "m", "time": None, "transfer_time": 0.4, "base": [], "reference": "the finest rung of each ladder",
            "asked_error": 0.05, "rows": list(rows), "ladders": [{"name": "cells", "message": "order 2"}], "recommendation": "No setting meets 5 %."}


class AccuracyPage(unittest.TestCase):
    def test_error_is_drawn_against_cpu_seconds_on_two_logarithms(self):
        chart = error_against_time("column", table(row(1, 0.2, 1.0, True), row(2, 0.1, 8.0, True), row(4, None, 64.0, False))).chart
        self.assertTrue(chart.x.logarithmic and chart.y.logarithmic)
        self.assertEqual([each.name for each in chart.series], ["cells", "Pareto front"])
        self.assertEqual((chart.series[0].x, chart.series[0].y), ([1, 8], [20, 10]), "the reference has no error")
        self.assertEqual(chart.marks[0].value, 5)

    def test_the_page_has_the_table_and_what_follows_from_it(self):
        page = accuracy_page({"column": table(row(1, 0.2, 1.0, True))}, "accuracy")
        self.assertIn("| cells | `/mpm/cell_size=4` | 10 | - | 1 | 20 % | 20 % | 1 | 1 | - | 4 | 4 | `*` |", page)
        self.assertIn("**No setting meets 5 %.**", page)
        self.assertIn("(accuracy/column.svg)", page)

    def test_without_any_error_there_is_no_figure(self):
        page = accuracy_page({"column": table(row(4, None, 64.0, False))}, "accuracy")
        self.assertNotIn(".svg", page)
        self.assertIn("it is the reference", page)


if __name__ == "__main__":
    unittest.main()
