"""Rows of the LEM: factors of safety have no length, no gravity and no unit."""
import functools
import pathlib
import tempfile

from rows import Outcome, case, done_well, refused, run, within
from scenes import G, elastic, region, slope


@functools.lru_cache
def usual():
    """The 10 m slope under g."""
    with tempfile.TemporaryDirectory() as name:
        return done_well("lem_tool", slope(), pathlib.Path(name) / "usual")["factor_of_safety"]


def same_as_usual(folder, **scaled):
    found = done_well("lem_tool", slope(**scaled), folder / "out")["factor_of_safety"]
    return within("F against that of 10 m under g", abs(found / usual() - 1), 1e-3)


for name, scaled, extreme in (("a slope of 1 m", {"L": 1.0}, "L 1 m"), ("a slope of 1 km", {"L": 1000.0}, "L 1000 m"),
                              ("a slope under 10 g", {"g": 10 * G}, "10 g"),
                              ("a slope under 1e-3 g", {"g": 1e-3 * G}, "1e-3 g")):
    case("LEM", name, extreme, "the F of 10 m under g: c is in proportion to rho g L")(
        functools.partial(same_as_usual, **scaled))


@case("LEM", "soil without any strength", "c = 0 and phi = 0", "F = 0")
def no_strength(folder):
    result = done_well("lem_tool", slope(c=0, phi=0, base_c=0), folder / "out")
    return within("F", abs(result["factor_of_safety"]), 0.0)


@case("LEM", "both layers liquefied to nothing", "s_r = 0 in all soil at once", "F = 0 at that stage, and a critical depth")
def all_liquefied(folder):
    scene = slope()
    scene["lem"]["liquefaction"] = [{"region": "fill"}, {"region": "base"}]
    result = done_well("lem_tool", scene, folder / "out")
    last = result["stages"][-1]
    return within(f"critical depth {result['critical_depth']:.3g} m; F", abs(last["factor_of_safety"]), 0.0)


@case("LEM", "a base two thousand times stronger than the fill", "c ratio 2000: the largest that a scene may have",
      "the F over a base that cannot fail: no surface goes into it")
def strong_base(folder):
    scene = slope()
    scene["materials"]["base"] = elastic(1e8)
    rigid = done_well("lem_tool", scene, folder / "rigid")["factor_of_safety"]
    strong = done_well("lem_tool", slope(base_c=1.99e7 / (2000 * G * 10)), folder / "strong")["factor_of_safety"]
    return within("F against that over rock", abs(strong / rigid - 1), 2e-3)


@case("LEM", "a scene without gravity", "g = 0", "refused: nothing drives")
def weightless(folder):
    done = run("lem_tool", slope(g=0.0), folder / "out")
    return refused(done, "/lem/search")


@case("LEM", "a seam one micrometre thick", "thickness 1e-7 of the slope's height", "the F without it")
def seam(folder):
    scene = slope()
    scene["materials"]["seam"] = scene["materials"]["fill"]
    scene["section"]["regions"].append(region("seam", "seam", [[0, 10], [20, 10], [20, 10 + 1e-6], [0, 10 + 1e-6], [0, 10]]))
    done = run("lem_tool", scene, folder / "out")
    if done.returncode == 65:
        return Outcome(refused(done, "seam").text, "seam" in done.stderr, "refusal")
    found = done_well("lem_tool", scene, folder / "again")["factor_of_safety"]
    return within("F against that without", abs(found / usual() - 1), 2e-3)
