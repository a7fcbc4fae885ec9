"""Scenes that the cases are made of: a slope, a column between smooth walls, a dam that breaks; each by its size L [m] and
its gravity g [m/s2], with stiffness and cohesion in proportion to rho g L, so that a scaled scene must give the scaled answer."""
import math

import h5py
import numpy

RHO = 2000.0
G = 9.81


def document(name, materials, regions, g=G, **sections):
    return {"format": "breachline-scene/1", "name": name, "gravity": g, "materials": materials,
            "section": {"regions": regions}, **sections}


def rectangle(x0, y0, x1, y1):
    return [[x0, y0], [x1, y0], [x1, y1], [x0, y1], [x0, y0]]


def region(name, material, polygon, divisions=None):
    made = {"name": name, "material": material, "polygon": polygon}
    if divisions:
        made["mesh"] = {"type": "block", "divisions": divisions}
    return made


def elastic(E, nu=0.3):
    return {"density": RHO, "law": {"type": "linear_elastic", "E_MPa": E / 1e6, "nu": nu}}


def frictional(E, c, phi, nu=0.3):
    return {"density": RHO, "law": {"type": "mohr_coulomb", "E_MPa": E / 1e6, "nu": nu, "c_kPa": c / 1e3, "phi_deg": phi}}


def constrained(E, nu):
    """E (1 - nu) / ((1 + nu)(1 - 2 nu)), the modulus of a column between walls [Pa]."""
    return E * (1 - nu) / ((1 + nu) * (1 - 2 * nu))


def slope(L=10.0, g=G, c=0.05, phi=20.0, base_c=0.5):
    """A slope of 1:2 and height L on a base; c over rho g L. For the LEM."""
    s = L / 10
    fill, base = frictional(1e8, c * RHO * g * L, phi), frictional(1e8, base_c * RHO * g * L, phi)
    polygons = [[[0, 0], [40, 0], [20, 10], [0, 10], [0, 0]], rectangle(0, -5, 60, 0)]
    scaled = [[[s * x, s * y] for x, y in polygon] for polygon in polygons]
    return document("slope", {"fill": fill, "base": base},
                    [region("base", "base", scaled[1]), region("fill", "fill", scaled[0])], g,
                    lem={"search": {"entry": [s, 19 * s], "exit": [25 * s, 50 * s], "minimum_depth": 0.5 * s}})


def smooth_box(W, H, low=0.0):
    """Supports: rollers at both sides, a fixed base."""
    return [{"name": "left", "from": [0, low], "to": [0, H], "fixes": "x"},
            {"name": "right", "from": [W, low], "to": [W, H], "fixes": "x"},
            {"name": "base", "from": [0, low], "to": [W, low], "fixes": "xy"}]


def column(soil, W=4.0, H=8.0, divisions=(4, 8), g=G, stages=None, cell=1.0, duration=1.0, **mpm):
    """Soil between smooth walls on a fixed base, from FEM to MPM. The MPM's floor slips, as rollers do."""
    stages = stages or [{"type": "static", "name": "gravity", "laws": "elastic"}]
    top = cell * math.ceil(1.25 * H / cell)
    return document("column", {"soil": soil}, [region("column", "soil", rectangle(0, 0, W, H), list(divisions))], g,
                    fem={"supports": smooth_box(W, H), "stages": stages, "crest": [W, H], "force_tolerance": 1e-10},
                    transfer={},
                    mpm={"cell_size": cell, "domain_x": [0, W], "domain_y": [0, top], "left": "roller", "right": "roller",
                         "floor": {"level": 0}, "duration": duration, "snapshot_interval": duration,
                         "allow_coarse_cells": True, "runout": {"toe": [W, 0]}, **mpm})


def dam_break(soil, L=10.0, g=G, cells=10, until=2.0, **mpm):
    """A block L/2 wide and L high, released beside a wall; until: in sqrt(L / g). Times and lengths all in proportion."""
    t = math.sqrt(L / g)
    h = L / cells
    return document("dam-break", {"soil": soil}, [region("dam", "soil", rectangle(0, 0, L / 2, L), [cells // 2, cells])], g,
                    fem={"supports": [{"name": "left", "from": [0, 0], "to": [0, L], "fixes": "x"},
                                      {"name": "base", "from": [0, 0], "to": [L / 2, 0], "fixes": "xy"}],
                         "stages": [{"type": "static", "name": "gravity", "laws": "elastic"},
                                    {"type": "dynamic", "name": "release", "duration": 0.2 * t, "time_step": 0.005 * t}],
                         "crest": [L / 2, L], "telemetry_interval": 0.01 * t},
                    transfer={},
                    mpm={"cell_size": h, "domain_x": [0, 6 * L], "domain_y": [0, 1.5 * L],
                         "floor": {"level": 0, "friction": [{"from": 0, "to": 6 * L, "coefficient": 0.5}]},
                         "blending_rate": 1 / t, "duration": until * t, "snapshot_interval": until * t,
                         "telemetry_interval": 0.05 * t, "rest_earliest": 10 * until * t,
                         "allow_coarse_cells": True, "runout": {"toe": [L / 2, 0], "front_depth": 0.1 * L}, **mpm})


def sand(L=10.0, g=G, nu=0.3, c=0.0, phi=30.0):
    """Mohr-Coulomb with E = 500 rho g L; c over rho g L."""
    return frictional(500 * RHO * g * L, c * RHO * g * L, phi, nu)


def points(file):
    """PointData of an exchange file, and the places."""
    with h5py.File(file) as opened:
        found = {name: data[()] for name, data in opened["VTKHDF/PointData"].items()}
        found["place"] = opened["VTKHDF/Points"][:, :2]
    return found


def last_snapshot(folder):
    return sorted(folder.glob("snapshot_*.vtkhdf"))[-1]


def farthest_move(before, after):
    """Of points in the same order [m]."""
    return float(numpy.abs(points(after)["place"] - points(before)["place"]).max())
