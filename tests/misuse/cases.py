"""What people get wrong: scenes, studies and motions, as a table. A case changes one thing of a shipped scene and says what must
come of it: `refused` before anything has run, `warned` in the plan, or a result that is flagged.

`text` must be found in the message: the thing that is wrong, and for slips of units the unit that was probably meant."""
import copy
import json
import math
from dataclasses import dataclass, field
from pathlib import Path


def at(document, pointer):
    """(parent, key) of a JSON pointer."""
    *path, last = pointer.strip("/").split("/")
    for step in path:
        document = document[int(step)] if isinstance(document, list) else document[step]
    return document, int(last) if isinstance(document, list) else last


def put(document, pointer, value):
    parent, key = at(document, pointer)
    if isinstance(parent, list) and key == len(parent):
        parent.append(value)
    else:
        parent[key] = value


def drop(document, pointer):
    parent, key = at(document, pointer)
    del parent[key]


@dataclass
class Case:
    name: str
    base: str  # a shipped scene
    outcome: str  # refused | warned | flagged
    text: str  # regular expression
    sets: dict = field(default_factory=dict)
    drops: list = field(default_factory=list)
    motion: str = None  # text of the motion file
    run: str = None  # flagged: the phase that must run
    code: str = None  # flagged: the flag's code

    def scene(self, bases):
        document = copy.deepcopy(bases[self.base])
        for pointer in self.drops:
            drop(document, pointer)
        for pointer, value in self.sets.items():
            put(document, pointer, value)
        return document


def record(dt=0.01, n=1200, amplitude=2.0, head="time_s,acceleration_m_per_s2\n", row="{t},{a}\n", period=0.7):
    rows = []
    for i in range(n):
        t = i * dt
        rows.append(row.format(t=round(t, 6), a=round(amplitude * math.sin(2 * math.pi * t / period), 6)))
    return head + "".join(rows)


def peer(unit, amplitude=1.0, n=1200, dt=0.01):
    values = [f"{amplitude * math.sin(2 * math.pi * i * dt / 0.7):.6f}" for i in range(n)]
    return f"PEER\nA quake\nACCELERATION TIME SERIES IN UNITS OF {unit}\nNPTS= {n}, DT= {dt} SEC\n" + "\n".join(values) + "\n"


M = "mochikoshi"
slope_polygon = [[0, 0], [30, 0], [20, 10], [0, 10], [0, 0]]
upper_dam = [[109, 29.4], [124.3, 21], [151.9, 12.4], [168.9, 12.4], [115, 30], [110, 30], [109, 29.4]]


def moved(polygon, dx=0.0, dy=0.0):
    return [[x + dx, y + dy] for x, y in polygon]


def drawn(change):
    """The regions of the slope, with every vertex changed."""
    polygons = [[[0, -5], [30, -5], [60, -5], [60, 0], [30, 0], [0, 0], [0, -5]], slope_polygon]
    return {f"/section/regions/{i}/polygon": [list(change(x, y)) for x, y in polygon] for i, polygon in enumerate(polygons)}


block = json.loads((Path(__file__).parents[1] / "verification/mpm/block_near_critical.json").read_text())
foot = block["section"]["regions"][0]["polygon"]

cases = [
    # ------------------------------------------------ wrong units
    Case("density in lb/ft3", "slope", "refused", r"density[\s\S]*lb/ft3: write 1922 kg/m3", {"/materials/slope_soil/density": 120}),
    Case("unit weight in N/m3 as density", "slope", "refused", r"density[\s\S]*N/m3: write 1886 kg/m3", {"/materials/slope_soil/density": 18500}),
    Case("gravity in ft/s2", "slope", "warned", r"gravity.*ft/s2: write 9\.815", {"/gravity": 32.2}),
    Case("Poisson's ratio in per cent", "slope", "refused", r"nu[\s\S]*%: write 0\.3", {"/materials/slope_soil/law/nu": 30}),
    Case("peak acceleration in % of g", M, "refused", r"scale_to_pga_g[\s\S]*%: write 0\.25 g", {"/fem/motion/scale_to_pga_g": 25}),
    Case("section in ft", "slope", "refused", r"polygon[\s\S]*ft: multiply its coordinates by 0\.3048", drawn(lambda x, y: (x / 0.3048, y / 0.3048))),
    Case("damping of 12 %", "mochikoshi", "refused", r"damping/ratio", {"/fem/damping": {"ratio": 0.12, "frequency_Hz": 3}}),
    Case("negative damping", "mochikoshi", "refused", r"damping/ratio", {"/fem/damping": {"ratio": -0.005, "frequency_Hz": 3}}),
    Case("damping beside the motion's frequencies", "mochikoshi", "refused", r"damping/frequency_Hz[\s\S]*motion", {"/fem/damping": {"ratio": 0.005, "frequency_Hz": 45}}),
    Case("a stiffness too low for the flow", "mochikoshi", "refused", r"stiffness_scale[\s\S]*0\.", {"/mpm/stiffness_scale": 1e-5}),
    Case("sigma_zz zero without the paper's transfer", "mochikoshi", "refused", r"sigma_zz[\s\S]*paper", {"/transfer/sigma_zz": "zero"}),
    Case("density in kN/m3", "slope", "refused", r"kN/m3", {"/materials/slope_soil/density": 19}),
    Case("density in g/cm3", "slope", "refused", r"(g/cm3|t/m3)", {"/materials/slope_soil/density": 1.9}),
    Case("density of steel", "slope", "warned", r"density", {"/materials/slope_soil/density": 7800}),
    Case("cohesion in Pa", "slope", "warned|refused", r"c_kPa.*Pa|Pa.*c_kPa", {"/materials/slope_soil/law/c_kPa": 12000}),
    Case("E in kPa", "slope", "warned|refused", r"E_MPa.*kPa|kPa.*E_MPa", {"/materials/slope_soil/law/E_MPa": 20000}),
    Case("E in GPa", "slope", "warned", r"E_MPa", {"/materials/slope_soil/law/E_MPa": 0.02}),
    Case("friction angle in radians", "slope", "warned|refused", r"phi_deg.*rad", {"/materials/slope_soil/law/phi_deg": 0.35}),
    Case("friction angle of 85 degrees", "slope", "warned|refused", r"phi_deg", {"/materials/slope_soil/law/phi_deg": 85}),
    Case("c and phi swapped", "slope", "warned", r"c_kPa 33 and phi_deg 5 look swapped: write \"c_kPa\": 5, \"phi_deg\": 33",
         {"/materials/slope_soil/law/c_kPa": 33, "/materials/slope_soil/law/phi_deg": 5}, drops=["/materials/slope_soil/law/softening"]),
    Case("cells of 0.2 m", M, "warned", r"cell_size.*0\.2 m fills the section with \d+ cells", {"/mpm/cell_size": 0.2}),
    Case("gravity of the moon, or in km/s2", "slope", "warned|refused", r"gravity", {"/gravity": 0.00981}),
    Case("gravity negative", "slope", "refused", r"gravity", {"/gravity": -9.81}),
    Case("strain in per cent", "slope", "warned|refused", r"epsilon_q", {"/materials/slope_soil/law/softening/epsilon_q_start": 1,
                                                                       "/materials/slope_soil/law/softening/epsilon_q_end": 100}),
    Case("permeability of 1e-7 m/s in m/day", M, "warned", r"permeability.*m/day", {"/materials/tailings/permeability": [0.00864, 0.00864]}),
    Case("permeability in cm/day", M, "warned|refused", r"permeability", {"/materials/tailings/permeability": [60, 60]}),
    Case("relative density in per cent", M, "refused", r"D_R", {"/materials/tailings/law/D_R": 35}),
    Case("void ratio in per cent", M, "refused|warned", r"void_ratio", {"/materials/tailings/void_ratio": 99}),
    Case("rock's V_s in km/s", M, "warned|refused", r"V_s", {"/fem/base/V_s": 0.76}),
    Case("water's bulk modulus in kPa", M, "warned|refused", r"bulk_modulus", {"/fem/water/bulk_modulus_MPa": 2.2e6}),
    Case("time step of 5 s", M, "refused|warned", r"time_step", {"/fem/stages/2/time_step": 5}),
    Case("duration in ms", M, "refused|warned", r"duration", {"/fem/stages/2/duration": 12000}),
    Case("viscosity of a rock", M, "warned|refused", r"viscosity", {"/materials/liquefied_1/viscosity": 1e9}),
    Case("r_u threshold in per cent", M, "refused|warned", r"r_u", {"/transfer/liquefied/r_u": 70}),
    Case("floor friction as an angle", M, "refused|warned", r"coefficient", {"/mpm/floor/friction/0/coefficient": 35}),
    Case("residual strengths of LEM and MPM that differ", M, "warned", r"two residual strengths.*layers", {"/lem/liquefaction/0/residual_strength_kPa": 40}),
    Case("strengths of LEM and MPM that differ", M, "warned", r"two peak strengths.*law", {"/materials/embankment/limit_strength/c_kPa": 75}),
    Case("a coefficient of variation of 30 for 0.30", M, "refused", r"coefficient_of_variation[\s\S]*%.*0\.3", {"/lem/probability": {"variables": [
        {"parameter": "friction_angle", "of": "embankment", "distribution": "normal", "coefficient_of_variation": 30}]}}),
    Case("a coefficient of variation of 3 for 0.03", M, "warned", r"coefficient_of_variation.*%.*0\.03", {"/lem/probability": {"variables": [
        {"parameter": "friction_angle", "of": "embankment", "distribution": "normal", "coefficient_of_variation": 3}]}}),
    Case("residual strength above the peak", M, "warned", r"residual strength of .* is above its peak", {"/lem/liquefaction/0/residual_strength_kPa": 400}),
    Case("residual strength in Pa", M, "warned|refused", r"residual_strength_kPa", {"/lem/liquefaction/0/residual_strength_kPa": 3000}),
    Case("standing water over the crest", "slope", "refused", r"water/line.*out of scope[\s\S]*overtopping", {"/mpm/water": {"line": [[0, 10.5]]}}),
    Case("standing water below all soil", "slope", "refused", r"water/line.*outside the grid", {"/mpm/water": {"line": [[0, -5.5]]}}),
    Case("standing water beside the grid", "slope", "refused", r"water/line.*outside the grid", {"/mpm/water": {"line": [[100, 5], [200, 4]]}}),
    Case("standing water without density", "slope", "refused", r"water/density", {"/mpm/water": {"line": [[0, 5]], "density": 0}}),
    Case("section in mm", "slope", "warned|refused", r"(polygon|cell_size|element|section)", {
        "/section/regions/1/polygon": [[x * 1000, y * 1000] for x, y in slope_polygon],
        "/section/regions/0/polygon": [[x * 1000, y * 1000] for x, y in [[0, -5], [30, -5], [60, -5], [60, 0], [30, 0], [0, 0], [0, -5]]]}),
    # ------------------------------------------------ geometry
    Case("a mirrored section", "slope", "refused", r"toe[\s\S]*breach mirror", drawn(lambda x, y: (60 - x, y))),
    Case("x and y swapped", "slope", "refused", r"polygon[\s\S]*x and y look swapped", drawn(lambda x, y: (y, x))),
    Case("depths positive downwards", "slope", "refused", r"polygon[\s\S]*every y with the other sign", drawn(lambda x, y: (x, -y))),
    Case("a gap of 0.3 m between regions", M, "refused", r"gap", {"/section/regions/3/polygon": moved(upper_dam, dx=0.3)}),
    Case("a gap of 1 cm between regions", M, "refused", r"(gap|overlap)", {"/section/regions/3/polygon": moved(upper_dam, dx=0.01)}),
    Case("regions that overlap", "slope", "refused", r"overlap",
         {"/section/regions/1/polygon": moved(slope_polygon, dy=-0.5)}),
    Case("a polygon that crosses itself", "slope", "refused", r"(cross|intersect)",
         {"/section/regions/1/polygon": [[0, 0], [30, 0], [0, 10], [20, 10], [0, 0]]}),
    Case("a polygon that is not closed", "slope", "refused", r"open", {"/section/regions/1/polygon": slope_polygon[:-1]}),
    Case("a region of no area", "slope", "refused", r"area",
         {"/section/regions/1/polygon": [[0, 0], [10, 0], [20, 0], [0, 0]]}),
    Case("a toe at the crest", M, "warned|refused", r"toe", {"/mpm/runout/toe": [115, 30]}),
    Case("shaking in steps of 0.5 s", M, "warned|refused", r"time_step", {"/fem/stages/2/time_step": 0.5}),
    Case("a toe upstream of the crest", M, "warned|refused", r"toe", {"/mpm/runout/toe": [-20, 0]}),
    Case("a crest 500 m away", M, "refused|warned", r"crest", {"/fem/crest": [615, 30]}),
    Case("supports that touch nothing", M, "refused", r"(support|/fem/supports)", {"/fem/supports/0/from": [-40, -8], "/fem/supports/0/to": [280, -8]}),
    Case("terrain through the dam", M, "refused", r"terrain", {"/mpm/terrain": [[-40.5, 10], [659.5, 10]]}, drops=["/mpm/floor/friction"]),
    Case("terrain 2 m below the dam", M, "warned", r"section lies up to 2 m above the terrain \(from x = -207\.5 to 280 m",
         {"/mpm/terrain": [[-212, -7], [280.5, -7], [281, 0], [692, 0]]}),
    Case("a floor 1 m below the section", "slope", "warned", r"section lies up to 1 m above the floor.*/mpm/floor/level=-5",
         {"/mpm/domain_y": [-6, 15], "/mpm/floor/level": -6}),
    Case("friction that ends where the dam does", M, "warned", r"no zone covers x = 220 to 692 m",
         {"/mpm/floor/friction": [{"from": -208, "to": 220, "coefficient": 0.7}]}),
    Case("floor above the section's foot", M, "refused", r"floor", {"/mpm/floor/level": 5}),
    Case("the grid ends inside the dam", M, "refused", r"domain_x", {"/mpm/domain_x": [-40.5, 200]}),
    Case("the grid is lower than the crest", M, "refused", r"domain_y", {"/mpm/domain_y": [-5, 20]}),
    Case("shaking on without columns that tell the ground's motion", M, "refused", r"free_field", {"/mpm/shaking": "on"}, drops=["/fem/free_field"]),
    Case("a gauge outside the grid", M, "refused", r"gauge", {"/mpm/gauges/0/x": 5000}),
    Case("cells wider than the dam", "slope", "refused", r"cell", {"/mpm/cell_size": 10}),
    Case("cells of which three span the slope", "slope", "warned", r"cell", {"/mpm/cell_size": 2.5}),
    # ------------------------------------------------ water
    Case("water 50 m above the ground", M, "warned|refused", r"(water|phreatic|line)", {"/fem/water/line": [[-40, 79.4], [280, 79.4]]}),
    Case("water below all soil", M, "refused|warned", r"(water|line)", {"/fem/water/line": [[-40, -30], [280, -30]]}),
    Case("no void ratio where water needs it", M, "refused", r"void_ratio", drops=["/materials/tailings/void_ratio"]),
    Case("no permeability where water needs it", M, "refused", r"permeability", drops=["/materials/tailings/permeability"]),
    Case("a pressure boundary inside the soil", M, "refused", r"(boundar|segment)",
         {"/fem/water/boundaries": [{"name": "lost", "from": [50, 10], "to": [60, 10]}]}),
    # ------------------------------------------------ forgotten
    Case("no water in the LEM, with layers that liquefy", M, "refused", r"/lem/water[\s\S]*is missing[\s\S]*\"water\": \{\"line\": \[\[-207\.5, 29\.4\]",
         drops=["/lem/water"]),
    Case("no water in the LEM, with water in the FEM", M, "warned", r"/lem/water: is missing.*\"tailings\".*too high.*\"r_u\": 0\}", drops=["/lem/water", "/lem/liquefaction"]),
    Case("no water in the FEM, with water in the LEM", "static_lift", "warned", r"/fem/water: is missing.*\"dike\".*/lem/water.*\"line\"",
         drops=["/fem/water", "/transfer/liquefied"]),
    Case("residual strengths ten times too large in the runout", M, "warned", r"two residual strengths.*3 kPa here.*31\.2 kPa.*layers",
         {f"/materials/liquefied_{i}/law/c_kPa": c for i, c in enumerate([30, 56, 74, 91, 106], 1)}),
    Case("residual strengths ten times too small at large strains", M, "warned", r"two residual strengths.*falling to 0\.2 kPa",
         {f"/materials/liquefied_{i}/law/softening/c_residual_kPa": c / 20 for i, c in enumerate([3, 5.6, 7.4, 9.1, 10.6], 1)}),
    Case("a liquefied layer missing in the LEM", M, "warned", r"leaves out a part of \"tailings\".*\"levels\": \[11\.76, 17\.64\], \"residual_strength_kPa\": 7\.\d",
         drops=["/lem/liquefaction/2"]),
    Case("no liquefied layers in the LEM", M, "warned", r"has no layer, and soil of \"tailings\"", drops=["/lem/liquefaction"]),
    Case("a liquefied layer missing in the runout", M, "warned", r"/transfer/liquefied: does not liquefy \"tailings\"", drops=["/transfer/liquefied"]),
    Case("a runout of 0.5 s", M, "warned", r"mpm/duration: is 0\.5 s.*--set /mpm/duration=until_rest", {"/mpm/duration": 0.5}),
    Case("a time limit of 1 s", M, "warned", r"mpm/longest_duration: is 1 s", {"/mpm/longest_duration": 1}),
    Case("a dynamic stage of 0.15 s", "slope", "warned", r"stages/1/duration: .*0\.15 s.*shear wave.*\"duration\": 0\.9", {"/fem/stages/1/duration": 0.15}),
    Case("80 s of FEM on a motion of 8 s", M, "warned", r"stages/2/duration: .*80 s, and the motion at 7\.99 s.*--set /fem/stages/2/duration=7\.99", {"/fem/stages/2/duration": 80, "/fem/motion": {"file": "record.csv"}},
         motion=record(n=800, head="time_s,acceleration_m_s2\n")),
    Case("a floor as slippery as ice", M, "warned", r"coefficient: 0\.05 lies outside.*0\.2 to 0\.7", {"/mpm/floor/friction/1/coefficient": 0.05}),
    Case("a floor friction of 3", M, "warned", r"coefficient: 3 lies outside", {"/mpm/floor/friction/1/coefficient": 3}),
    Case("a flow section in the pond", M, "warned", r"sections/0/x: is 20 m, upstream of the crest.*--set /mpm/sections/0/x=220", {"/mpm/sections": [{"name": "out", "x": 20}]}),
    Case("a friction angle in the runout twice that of the LEM", M, "warned", r"two peak strengths.*tailings_not_liquefied", {"/materials/tailings_not_liquefied/law/phi_deg": 50}),
    # ------------------------------------------------ references
    Case("a material that is not there", "slope", "refused", r"clay", {"/section/regions/1/material": "clay"}),
    Case("soil that the MPM cannot have", M, "refused", r"(mapping|pm4sand)", drops=["/transfer/mapping/1"]),
    Case("a mapping to a material that is not there", M, "refused", r"honey", {"/transfer/mapping/1/to": "honey"}),
    Case("LEM exits with no ground below them", "slope", "refused", r"exit", {"/lem/search/exit": [200, 300]}),
    Case("a tension crack deeper than the section", "slope", "refused", r"tension_crack/depth[\s\S]*30 m[\s\S]*15 m high", {"/lem/tension_crack": {"depth": 30}}),
    Case("a tension crack to a level above all ground", "slope", "refused", r"tension_crack/level[\s\S]*no crack", {"/lem/tension_crack": {"level": 12}}),
    Case("a snapshot after the end", "slope", "refused|warned", r"snapshot", {"/fem/snapshot_times": [50]}),
    Case("an entry that nobody reads", "slope", "refused", r"cell_sise", {"/mpm/cell_sise": 1}),
    Case("a mesh file that is not there", "slope", "refused", r"nowhere\.msh", {"/fem/msh_file": "nowhere.msh"}),
    # ------------------------------------------------ motions
    Case("a motion file that is not there", M, "refused", r"nowhere", {"/fem/motion/file": "nowhere.csv"}),
    Case("m/s2 given as g", M, "refused|warned", r"(m/s2|9\.81|PGA)", {"/fem/motion": {"file": "record.csv"}},
         motion=record(amplitude=1.96, head="time_s,acceleration_g\n")),
    Case("a motion without its header", M, "refused", r"header", {"/fem/motion": {"file": "record.csv"}}, motion=record(head="")),
    Case("a motion with the time in ms", M, "refused|warned", r"(time|step|duration)", {"/fem/motion": {"file": "record.csv"}},
         motion=record(dt=10.0, n=1200, head="time_s,acceleration_g\n", amplitude=0.2, period=700)),
    Case("a motion that is not a motion", M, "refused", r"record", {"/fem/motion": {"file": "record.csv"}}, motion="Dear colleague,\nthe record follows.\n"),
    Case("a motion of zeros", M, "refused|warned", r"(zero|PGA|acceleration)", {"/fem/motion": {"file": "record.csv"}},
         motion=record(amplitude=0.0, head="time_s,acceleration_g\n")),
    Case("a motion that goes back in time", M, "refused", r"(time|ascend|step)", {"/fem/motion": {"file": "record.csv"}},
         motion="time_s,acceleration_g\n0,0.1\n0.01,0.2\n0.005,0.1\n0.02,0.0\n"),
    Case("an empty motion", M, "refused", r"(empty|sample|line|column|header)", {"/fem/motion": {"file": "record.csv"}}, motion=""),
    Case("a PEER record whose unit is none of the list", M, "refused", r"UNITS OF MG", {"/fem/motion": {"file": "record.csv"}}, motion=peer("MG")),
    Case("a PEER record in gal, of 0.85 gal", M, "warned", r"PGA of 0\.00086", {"/fem/motion": {"file": "record.csv"}}, motion=peer("GAL", 0.85)),
    Case("a PEER record in tenths of g, of 20 g", M, "refused", r"PGA of 19\.98", {"/fem/motion": {"file": "record.csv"}}, motion=peer("G/10", 200)),
    Case("a motion with a sample left out", M, "refused", r"line 203.*step of 0\.02 s", {"/fem/motion": {"file": "record.csv"}},
         motion="\n".join(line for i, line in enumerate(record(head="time_s,acceleration_m_s2\n").split("\n")) if i != 202)),
    Case("shaking scaled to 30 g", M, "refused|warned", r"scale_to_pga_g", {"/fem/motion/scale_to_pga_g": 30}),
    # ------------------------------------------------ found only in a result
    Case("a runout cut off on its way", "column", "flagged", r"lower bound", {"/mpm/duration": 1.0, "/section/regions/0/mesh/divisions": [5, 10]},
         run="mpm_solver", code="still_moving"),
    Case("cells nearly as wide as the soil, allowed", "column", "flagged|warned", r"cells", {"/mpm/cell_size": 8, "/mpm/allow_coarse_cells": True,
                                                                              "/mpm/domain_x": [0, 64], "/mpm/duration": 0.5},
         run="mpm_solver", code="coarse_cells"),
    Case("a block just able to stand, hardly damped", "column", "flagged", r"slid 1\.1 m as one body.*viscosity=17000",
         {**{f"/{part}": block[part] for part in ("materials", "section", "mpm")}, "/section/regions/0/mesh": {"type": "unstructured"},
          "/fem": {"supports": [{"name": "base", "from": foot[0], "to": foot[1], "fixes": "xy"}], "crest": foot[3],
                   "stages": [{"type": "static", "name": "gravity"}]}},
         drops=["/transfer"], run="mpm_solver", code="carried_slide"),
    Case("cohesion in MPa", "slope", "warned|refused", r"c_kPa", {"/materials/slope_soil/law/c_kPa": 0.012,
                                                                  "/materials/slope_soil/law/softening/c_residual_kPa": 0.002}),
]
