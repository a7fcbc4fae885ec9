"""Small random scenes as hypothesis strategies: a slope, a dam or a column of one to four layers for one phase.

Coordinates are multiples of 1/8 m, so that a shift or a cut of them is exact in double precision. Entries whose default is a
length or a time are written out, so that a scaled scene scales them, too."""
import json

from hypothesis import strategies as st


def eighths(low, high, step=2):
    """Multiples of step / 8 from low to high."""
    return st.integers(round(8 * low / step), round(8 * high / step)).map(lambda n: n * step / 8)


def rectangle(x0, y0, x1, y1):
    return [[x0, y0], [x1, y0], [x1, y1], [x0, y1], [x0, y0]]


@st.composite
def soils(draw, stiffness=(5, 60), most_c=40):
    """Mohr-Coulomb soil; without friction it has at least 10 kPa."""
    phi = draw(st.sampled_from([0, 18, 22, 26, 30, 35]))
    c = draw(st.integers(2, most_c)) + (0 if phi else 10)
    law = {"type": "mohr_coulomb", "E_MPa": draw(st.integers(*stiffness)), "nu": draw(st.sampled_from([0.25, 0.3, 0.4])),
           "c_kPa": c, "phi_deg": phi}
    return {"density": draw(st.sampled_from([1600, 1750, 1800, 1900, 2000, 2100])), "law": law}


def document(name, materials, regions, **parts):
    return unshared({"format": "breachline-scene/1", "name": name, "materials": materials, "section": {"regions": regions}} | parts)


def unshared(value):
    """Copies every list: a shared point would change in both entries."""
    return json.loads(json.dumps(value))


def region(name, material, polygon):
    return {"name": name, "material": material, "polygon": polygon}


def levels_between(draw, low, high, step=2):
    """low, high and at most one level between them."""
    between = draw(st.one_of(st.none(), eighths(low + step / 8, high - step / 8, step))) if high - low >= 2 * step / 8 else None
    return [low, high] if between is None else [low, between, high]


# -------------------------------------------------------------------------------------------------------------- LEM

@st.composite
def lem_scenes(draw):
    """A slope or a dam that slides to the right, on a base of one or two layers."""
    x0, height = draw(st.integers(-20, 20)), draw(eighths(4, 12))
    ratio = draw(st.sampled_from([1, 1.5, 2, 2.5, 3]))  # horizontal to vertical
    back = draw(st.sampled_from([0, 1.5, 2]))           # of the dam's upstream slope; 0: a slope from the left side on
    ahead = draw(st.integers(6, 20)) if back else 0
    crest, front, base = draw(st.integers(4, 20)), draw(st.integers(6, 20)), draw(eighths(2, 8))
    heel = x0 + ahead
    crest_left = heel + back * height
    crest_right = crest_left + crest
    toe = crest_right + ratio * height
    x1 = toe + front

    materials = {f"soil_{k}": draw(soils()) for k in range(draw(st.integers(1, 3)))}
    soil = st.sampled_from(sorted(materials))
    levels = levels_between(draw, -base, 0)
    if draw(st.booleans()):  # a seam of weak soil, a quarter of a metre thick
        materials["weak"] = {"density": 1750, "law": {"type": "mohr_coulomb", "E_MPa": 5, "nu": 0.3, "c_kPa": 2, "phi_deg": 10}}
        top = draw(eighths(-base + 0.5, -0.5)) if base > 1 else -0.5
        levels = [-base, top - 0.25, top, 0]
    regions = []
    for low, high in zip(levels, levels[1:]):
        material = "weak" if "weak" in materials and high == levels[2] and high < 0 else draw(soil)
        polygon = rectangle(x0, low, x1, high)
        if high == 0:  # the body stands on it
            polygon = [[x0, low], [x1, low], [x1, 0], [toe, 0], *([[heel, 0]] if back else []), [x0, 0], [x0, low]]
        regions.append(region(f"base_{len(regions)}", material, polygon))
    body = levels_between(draw, 0, height)
    for low, high in zip(body, body[1:]):
        a, b = crest_right + ratio * (height - low), crest_right + ratio * (height - high)
        c, d = heel + back * low, heel + back * high
        regions.append(region(f"body_{len(regions)}", draw(soil), [[c, low], [a, low], [b, high], [d, high], [c, low]]))

    lem = {"search": {"entry": [crest_left + 0.25, crest_right - 0.25], "exit": [crest_right + ratio * height / 2, x1 - 0.25],
                      "entry_points": draw(st.integers(7, 9)), "exit_points": draw(st.integers(7, 9)),
                      "depths": draw(st.integers(6, 8)), "minimum_depth": draw(st.sampled_from([0.5, 1]))}}
    if draw(st.booleans()):
        lem["search"]["lowest_level"] = -base if draw(st.booleans()) else -base / 2
    if draw(st.booleans()):
        lem["water"] = {"line": water_line(draw, x0, x1, toe, height, ratio, heel, back),
                        "correction": draw(st.sampled_from(["none", "cos2"]))}
    if draw(st.integers(0, 3)) == 0:
        lem["seismic_coefficient"] = draw(st.sampled_from([0.05, 0.1, 0.2]))
    if draw(st.integers(0, 3)) == 0:
        lem["surcharge"] = [{"from": crest_left + 0.5, "to": crest_right - 0.5,
                             "pressure_kPa": draw(st.sampled_from([10, 25, 50]))}]
    if draw(st.integers(0, 3)) == 0:
        lem["tension_crack"] = {"depth": draw(st.sampled_from([0.5, 1, 2])), "filled": draw(st.sampled_from([0, 0.5, 1]))}
    if draw(st.integers(0, 3)) == 0:
        lem["undrained"] = [{"region": draw(st.sampled_from([each["name"] for each in regions])),
                             "strength_kPa": draw(st.integers(5, 40)), "coefficient_kPa": draw(st.sampled_from([0, 20, 30]))}]
    return document("random-lem", materials, regions, lem=lem)


def water_line(draw, x0, x1, toe, height, ratio, heel, back):
    """From a level in the body down to the toe; at most 1 m of water on the ground in front of it."""
    high = draw(eighths(0, height))
    ahead = min(high, draw(st.sampled_from([-1, 0, 1])))
    pond = [[x0, high], [heel + back * high, high]] if back else [[x0, high]]
    return [*pond, [toe - ratio * max(ahead, 0), ahead], [x1, ahead]]


# -------------------------------------------------------------------------------------------------------------- MPM

@st.composite
def mpm_scenes(draw):
    """A column at the wall, a slope on ground or a heap, of 100 to 500 points in cells of 1 m."""
    x0 = draw(st.integers(-20, 20))
    kind = draw(st.sampled_from(["column", "slope", "heap"]))
    ground = draw(st.integers(0, 2)) if kind != "column" else 0
    height, width = draw(st.integers(4, 8)), draw(st.integers(4, 8))
    run = {"column": 0, "slope": draw(st.sampled_from([1, 1.5])) * height, "heap": height}[kind]
    left = x0 + (5 if kind == "heap" else 0)
    toe = left + width + run + (height if kind == "heap" else 0)
    x1 = x0 + 16 * ((toe - x0 + 8) // 16 + 1)
    materials = {f"soil_{k}": draw(soils((2, 10))) for k in range(draw(st.integers(1, 2)))}
    for each in materials.values():
        each["viscosity"] = draw(st.sampled_from([0, 0, 100, 1000]))
    if draw(st.booleans()):
        law = materials["soil_0"]["law"]
        law["softening"] = {"epsilon_q_start": 0.02, "epsilon_q_end": 0.5, "c_residual_kPa": law["c_kPa"] / 4,
                            "phi_residual_deg": law["phi_deg"] / 2}
    soil = st.sampled_from(sorted(materials))
    regions = []
    if ground:
        materials["ground"] = {"density": 2000, "viscosity": 0,
                               "law": {"type": "mohr_coulomb", "E_MPa": 10, "nu": 0.3, "c_kPa": 50, "phi_deg": 35}}
        regions.append(region("ground", "ground", [[x0, -ground], [x1, -ground], [x1, 0], [toe, 0], [x0, 0], [x0, -ground]]))
    body = levels_between(draw, 0, height, 8)
    for low, high in zip(body, body[1:]):
        share_low, share_high = low / height, high / height
        back = height if kind == "heap" else 0
        polygon = [[left + back * share_low, low], [toe - run * share_low, low], [toe - run * share_high, high],
                   [left + back * share_high, high]]
        regions.append(region(f"body_{len(regions)}", draw(soil), [*polygon, polygon[0]]))
    duration = draw(st.sampled_from([0.5, 0.75, 1.0]))
    friction = draw(st.sampled_from([None, 0.3, 0.5]))
    mpm = {"cell_size": 1, "allow_coarse_cells": True, "domain_x": [x0, x1], "domain_y": [-ground, height + 4], "left": "roller",
           "right": draw(st.sampled_from(["open", "roller"])), "floor": {"level": -ground},
           "fill_stress": draw(st.sampled_from(["none", "overburden"])),
           "duration": duration, "snapshot_interval": duration,
           "telemetry_interval": 0.125, "rest_earliest": 100, "envelope": {"arrival_depth": 0.125},
           "runout": {"toe": [toe, 0], "front_depth": 1, "regions": [each["name"] for each in regions if each["name"] != "ground"]},
           "gauges": [{"name": "toe", "x": toe, "arrival_depth": 0.5}]}
    if friction:
        mpm["floor"]["friction"] = [{"from": x0, "to": x1, "coefficient": friction}]
    if draw(st.booleans()):
        mpm["time_step"] = 1 / 512
    return document("random-mpm", materials, regions, mpm=mpm)


# -------------------------------------------------------------------------------------------------------------- FEM

def block(corners, divisions):
    return {"type": "block", "corners": corners, "divisions": divisions}


@st.composite
def fem_scenes(draw):
    """A column or a slope on a base, of 20 to 100 elements: gravity, then some steps in time."""
    x0, size = draw(st.integers(-20, 20)), draw(st.sampled_from([1, 2]))
    columns, rows = draw(st.integers(3, 7)), draw(st.integers(3, 5))
    ahead, deep = draw(st.integers(2, 5)), draw(st.integers(1, 2))
    cut = draw(st.integers(0, columns - 1))  # number of elements by which the top is shorter than the bottom
    height, bottom = rows * size, -deep * size
    toe, x1 = x0 + columns * size, x0 + (columns + ahead) * size
    crest = toe - cut * size
    materials = {f"soil_{k}": draw(soils((10, 60), most_c=15)) for k in range(draw(st.integers(1, 2)))}
    soil = st.sampled_from(sorted(materials))
    low = [[x0, bottom], [x1, bottom], [x1, 0], [x0, 0]]
    high = [[x0, 0], [toe, 0], [crest, height], [x0, height]]
    regions = [region("base", draw(soil), [*low[:3], [toe, 0], low[3], low[0]]), region("body", draw(soil), [*high, high[0]])]
    regions[0]["mesh"] = block(low, [columns + ahead, deep])
    regions[1]["mesh"] = block(high, [columns, rows])
    step = draw(st.sampled_from([1 / 64, 1 / 128]))
    fem = {"element": draw(st.sampled_from(["bbar", "ssp"])),
           "supports": [{"name": "left", "from": [x0, bottom], "to": [x0, height], "fixes": "x"},
                        {"name": "right", "from": [x1, bottom], "to": [x1, 0], "fixes": "x"},
                        {"name": "bottom", "from": [x0, bottom], "to": [x1, bottom], "fixes": "xy"}],
           "stages": [{"type": "static", "name": "gravity", "laws": "elastic"},
                      {"type": "dynamic", "name": "failure", "duration": draw(st.integers(8, 24)) * step, "time_step": step}],
           "crest": [crest, height], "force_tolerance": 1e-9, "telemetry_interval": step,
           "failure_surfaces": {"separation": 5}}
    if draw(st.booleans()):
        fem["stages"][1] |= {"seismic_coefficient": draw(st.sampled_from([0.1, 0.3])), "ramp": 4 * step}
    if draw(st.booleans()):
        level = draw(st.integers(bottom + 1, height - 1))
        fem["water"] = {"line": [[x0, level], [toe, min(level, 0)], [x1, min(level, 0)]], "bulk_modulus_MPa": 2200,
                        "pressure_integration": draw(st.sampled_from(["full", "one_point"]))}
        for each in materials.values():
            each["void_ratio"] = 0.7
            each["permeability"] = [draw(st.sampled_from([1e-5, 1e-7]))] * 2
    return document("random-fem", materials, regions, fem=fem)


@st.composite
def chain_scenes(draw):
    """A FEM scene with the transfer's requirements: the MPM's grid, in which elements are half a cell or a whole one."""
    scene = draw(fem_scenes())
    low, high = scene["section"]["regions"][0]["mesh"]["corners"], scene["section"]["regions"][1]["mesh"]["corners"]
    (x0, bottom), (x1, _) = low[0], low[1]
    size = (x1 - x0) / scene["section"]["regions"][0]["mesh"]["divisions"][0]
    cells = -(-(high[2][1] - bottom) // size) + 2
    # With few points per element, coarser elements lose more momentum and kinetic energy.
    scene["transfer"] = {"points_per_direction": draw(st.sampled_from([1, 2, 3])), "largest_momentum_loss": 1,
                         "largest_kinetic_energy_loss": 1}
    scene["mpm"] = {"cell_size": size, "allow_coarse_cells": True,
                    "domain_x": [x0, x1], "domain_y": [bottom, bottom + cells * size], "left": "roller", "right": "roller",
                    "floor": {"level": bottom}, "duration": 0.25, "snapshot_interval": 0.25,
                    "telemetry_interval": 0.125, "rest_earliest": 100, "envelope": {"arrival_depth": 0.125},
                    "runout": {"toe": high[1], "front_depth": 1, "regions": ["body"]}}
    return unshared(scene)
