"""Changes of a scene that cannot matter, and similarity: each makes another document of the same problem.

A change gets the scene and a random generator, and returns the other scene, or None where it does not apply. EXACT says by phase
which answers must be equal to the last bit, ALLOWED how far the numbers of the others (answers.numbers_of) may lie apart."""
import copy
import json

POINT_LISTS = ["section/regions/*/polygon", "section/regions/*/mesh/corners", "lem/water/line", "lem/floor", "fem/water/line",
               "fem/stages/*/phreatic_line", "transfer/phreatic_line", "mpm/terrain"]
POINTS = ["fem/supports/*/from", "fem/supports/*/to", "fem/crest", "mpm/runout/toe"]
ABSCISSAE = ["lem/search/entry/*", "lem/search/exit/*", "lem/surcharge/*/from", "lem/surcharge/*/to", "mpm/domain_x/*",
             "mpm/floor/friction/*/from", "mpm/floor/friction/*/to", "mpm/gauges/*/x"]
LEVELS = ["lem/search/lowest_level", "mpm/domain_y/*", "mpm/floor/level"]
LENGTHS = ["lem/search/minimum_depth", "lem/tension_crack/depth", "mpm/cell_size", "mpm/envelope/arrival_depth",
           "mpm/runout/front_depth", "mpm/gauges/*/arrival_depth", "fem/failure_surfaces/separation"]
TIMES = ["mpm/duration", "mpm/time_step", "mpm/snapshot_interval", "mpm/telemetry_interval", "mpm/rest_earliest",
         "fem/stages/*/duration", "fem/stages/*/time_step", "fem/stages/*/ramp", "fem/telemetry_interval", "fem/snapshot_times/*"]
STRESSES = ["materials/*/law/E_MPa", "materials/*/law/c_kPa", "materials/*/law/softening/c_residual_kPa",
            "lem/surcharge/*/pressure_kPa", "lem/undrained/*/strength_kPa", "fem/water/bulk_modulus_MPa"]
REGION_LISTS = ["mpm/runout/regions"]
NAMES = ["fem/supports/*/name", "fem/stages/*/name", "mpm/gauges/*/name"]


def change(document, path, function):
    """Applies function(value) at every place of the path, whose * is any key."""
    *parents, last = path.split("/")
    places = [document]
    for step in parents:
        places = [each for place in places for each in below(place, step)]
    for place in places:
        keys = (list(place) if isinstance(place, dict) else range(len(place))) if last == "*" else [last] if last in place else []
        for key in keys:
            place[key] = function(place[key])


def below(place, step):
    if step == "*":
        return list(place.values()) if isinstance(place, dict) else place
    return [place[step]] if step in place else []


def with_places(scene, x, y):
    """Maps every coordinate by x or y."""
    made = copy.deepcopy(scene)
    for path in POINT_LISTS:
        change(made, path, lambda line: [[x(p[0]), y(p[1])] for p in line])
    for path in POINTS:
        change(made, path, lambda p: [x(p[0]), y(p[1])])
    for path in ABSCISSAE:
        change(made, path, x)
    for path in LEVELS:
        change(made, path, y)
    return made


def regions_of(scene):
    return scene["section"]["regions"]


def has_block(scene):
    return any("mesh" in each for each in regions_of(scene))


# ----------------------------------------------------------------------------------------------------- what cannot matter

def shifted(scene, random):
    dx, dy = random.choice([3e6, -3e6, 2.0 ** 21]), random.choice([0, 0, 1500, -64])
    return with_places(scene, lambda x: x + dx, lambda y: y + dy)


def mirrored(scene, random):
    """Mirrored. The MPM measures its runout to the right, so numbers_of reads the points, and the toe is that of the other side."""
    made = with_places(scene, lambda x: -x, lambda y: y)
    for path in ["lem/water/line", "lem/floor", "fem/water/line", "lem/search/entry", "lem/search/exit", "mpm/domain_x",
                 "mpm/floor/friction"]:
        change(made, path, lambda those: those[::-1])
    for path in ["lem/surcharge/*", "mpm/floor/friction/*"]:
        change(made, path, lambda load: load | {"from": load["to"], "to": load["from"]})
    change(made, "fem/stages/*/seismic_coefficient", lambda k: -k)
    if "mpm" in made:
        made["mpm"] |= {"left": scene["mpm"]["right"], "right": scene["mpm"]["left"]}
        mobile = made["mpm"]["runout"]["regions"]
        made["mpm"]["runout"]["toe"][0] = max(x for each in regions_of(made) if each["name"] in mobile for x, _ in each["polygon"])
    return made


def renamed(scene, random):
    """Regions, materials, supports, stages, gauges. Materials go by the alphabet, which stays as it was."""
    return with_names(scene, sorted(scene["materials"]), random)


def with_names(scene, soils_in_order, random):
    made = copy.deepcopy(scene)
    soils = {name: f"m{k}-{random.randrange(1000)}" for k, name in enumerate(soils_in_order)}
    names = {each["name"]: f"R{random.randrange(1000)}_{k}" for k, each in enumerate(regions_of(made))}
    made["materials"] = {soils[name]: each for name, each in made["materials"].items()}
    for each in regions_of(made):
        each["name"], each["material"] = names[each["name"]], soils[each["material"]]
    for path in REGION_LISTS:
        change(made, path, lambda those: [names[each] for each in those])
    change(made, "lem/undrained/*/region", names.get)
    for path in NAMES:
        change(made, path, lambda name: f"{name}-{random.randrange(1000)}")
    return made


def reordered(scene, random):
    made = with_names(scene, random.sample(sorted(scene["materials"]), len(scene["materials"])), random)
    for path in ["section/regions", "fem/supports", "mpm/runout/regions"]:
        change(made, path, lambda those: random.sample(those, len(those)))
    return made


def written_otherwise(scene, random):
    """The same numbers in other forms: 18 as 18.0, 1.8e1 or 180e-1."""
    def words(value):
        if isinstance(value, dict):
            keys = random.sample(list(value), len(value))
            return "{" + ", ".join(f"{json.dumps(key)}: {words(value[key])}" for key in keys) + "}"
        if isinstance(value, list):
            return "[" + ",\n".join(map(words, value)) + "]"
        if isinstance(value, float):
            digits = repr(value)
            whole = value == int(value) and abs(value) < 1e6
            ways = [digits] if "e" in digits else [digits, f"{digits}0"]
            return random.choice(ways + [f"{int(value)}e0", f"{10 * int(value)}E-1"] * whole)
        return json.dumps(value)
    return words(scene)


def begun_elsewhere(scene, random):
    """Polygons from another vertex, or in the other orientation."""
    made = copy.deepcopy(scene)
    for each in regions_of(made):
        ring = each["polygon"][:-1]
        k = random.randrange(len(ring))
        ring = ring[k:] + ring[:k]
        if random.random() < 0.5:
            ring.reverse()
        each["polygon"] = [*ring, ring[0]]
    return made if made != scene else None


def with_extra_vertices(scene, random):
    """On straight sides; in a mesh at existing nodes, so that it stays the same."""
    made = copy.deepcopy(scene)
    for each in regions_of(made)[:1] if has_block(made) else regions_of(made):
        ring = each["polygon"]
        parts = [1 / 2, 1 / 4, 3 / 4]
        longer = ring[:1]
        for (ax, ay), (bx, by) in zip(ring, ring[1:]):
            if has_block(made):
                corners, (columns, _) = each["mesh"]["corners"], each["mesh"]["divisions"]
                size = (corners[1][0] - corners[0][0]) / columns
                count = round(abs(bx - ax) / size)
                parts = [k / count for k in range(1, count)]
            if parts and random.random() < 0.5:
                t = random.choice(parts)
                longer.append([ax + t * (bx - ax), ay + t * (by - ay)])
            longer.append([bx, by])
        each["polygon"] = longer
    return made if made != scene else None


def clipped(ring, axis, at, sign):
    """The part of a closed convex ring where sign * (coordinate - at) >= 0."""
    kept = []
    for a, b in zip(ring, ring[1:]):
        inside, next_inside = sign * (a[axis] - at), sign * (b[axis] - at)
        if inside >= 0:
            kept.append(a)
        if inside * next_inside < 0:
            t = inside / (inside - next_inside)
            kept.append([a[0] + t * (b[0] - a[0]), a[1] + t * (b[1] - a[1])])
    return [*kept, kept[0]]


def split(scene, random):
    """Splits a region into two of one material: on a line of the MPM's cells, between elements of the FEM."""
    made = copy.deepcopy(scene)
    regions = regions_of(made)
    k = 0 if has_block(made) else random.randrange(len(regions))
    region = regions[k]
    ring = region["polygon"]
    axis = 0 if has_block(made) else random.randrange(2)
    low, high = min(p[axis] for p in ring), max(p[axis] for p in ring)
    step = made["mpm"]["cell_size"] if "mpm" in made else 0.25
    if has_block(made):
        corners, (columns, rows) = region["mesh"]["corners"], region["mesh"]["divisions"]
        step = (corners[1][0] - corners[0][0]) / columns
    places = [low + n * step for n in range(1, round((high - low) / step)) if low + n * step < high]
    if not places:
        return None
    at = random.choice(places)
    halves = [region | {"polygon": clipped(ring, axis, at, sign)} for sign in (-1, 1)]
    name, second = region["name"], region["name"] + "_b"
    halves[1]["name"] = second
    if has_block(made):
        before = round((at - low) / step)
        (ax, ay), (bx, by) = corners[0], corners[2]
        halves[0]["mesh"] = region["mesh"] | {"corners": [[ax, ay], [at, ay], [at, by], [ax, by]], "divisions": [before, rows]}
        halves[1]["mesh"] = region["mesh"] | {"corners": [[at, ay], [bx, ay], [bx, by], [at, by]],
                                              "divisions": [columns - before, rows]}
    regions[k:k + 1] = halves
    for path in REGION_LISTS:
        change(made, path, lambda those: those + [second] * (name in those))
    for entry in made.get("lem", {}).get("undrained", []):
        if entry["region"] == name:
            made["lem"]["undrained"].append(entry | {"region": second})
            break
    return made


def with_unused_material(scene, random):
    made = copy.deepcopy(scene)
    name = random.choice(["a-first", "zz-last"])
    made["materials"][name] = {"density": 2600, "law": {"type": "mohr_coulomb", "E_MPa": 60, "nu": 0.2, "c_kPa": 3, "phi_deg": 12}}
    return made


def with_untouched_layer(scene, random):
    """Below the lowest level of the LEM's surfaces; outside the MPM's flow, and not in its runout."""
    made = copy.deepcopy(scene)
    xs = [x for each in regions_of(made) for x, _ in each["polygon"]]
    lowest = min(y for each in regions_of(made) for _, y in each["polygon"])
    if "lem" in made:
        if "lowest_level" not in made["lem"]["search"]:
            return None
        law = {"type": "mohr_coulomb", "E_MPa": 30, "nu": 0.3, "c_kPa": 4, "phi_deg": 15}
        made["materials"]["deep"] = {"density": 2200, "law": law}
        x0, x1, y0, y1 = min(xs), max(xs), lowest - 4, lowest
    elif "mpm" in made:
        if scene["mpm"]["right"] != "open" or scene["mpm"].get("time_step") is None:
            return None  # a longer grid has its right wall elsewhere; a step by the fastest point is another step
        made["mpm"]["domain_x"][1] += 64
        change(made, "mpm/floor/friction/*/to", lambda x: x + 64)
        law = {"type": "linear_elastic", "E_MPa": 2, "nu": 0.3}
        made["materials"]["deep"] = {"density": 2000, "law": law}
        end = made["mpm"]["domain_x"][1]
        x0, x1, y0, y1 = end - 8, end - 4, lowest, lowest + 1
    else:
        return None
    ring = [[x0, y0], [x1, y0], [x1, y1], [x0, y1], [x0, y0]]
    regions_of(made).append({"name": "untouched", "material": "deep", "polygon": ring})
    return made


def with_longer_water_line(scene, random):
    """More points on the water's straight parts."""
    made = copy.deepcopy(scene)
    found = False

    def longer(line):
        nonlocal found
        found = True
        points = line[:1]
        for (ax, ay), (bx, by) in zip(line, line[1:]):
            points += [[(ax + bx) / 2, (ay + by) / 2], [bx, by]]
        return points
    for path in ["lem/water/line", "fem/water/line"]:
        change(made, path, longer)
    return made if found else None


def similar(scene, random):
    """Lengths x L, times x sqrt(L), stresses and stiffness x L; permeability as a speed, viscosity as stress times time.

    L is a power of four, so that the scaled numbers have the same digits."""
    L = random.choice([4.0, 0.25])
    time = L ** 0.5
    made = with_places(scene, lambda x: L * x, lambda y: L * y)
    for paths, factor in ((LENGTHS, L), (STRESSES, L), (TIMES, time)):
        for path in paths:
            change(made, path, lambda value: factor * value)
    change(made, "materials/*/viscosity", lambda eta: L * time * eta)
    change(made, "materials/*/permeability", lambda k: [time * each for each in k])
    return made


# Same arithmetic, same bits. Rings are brought to one orientation, and the LEM's strips go by place, not by the regions' order; the
# MPM and the FEM sum points and nodes in the order of regions and materials.
EXACT = {
    "lem_tool": {"renamed", "reordered", "written_otherwise", "begun_elsewhere", "with_unused_material"},
    "mpm_solver": {"renamed", "written_otherwise", "with_unused_material"},
    "fem_solver": {"renamed", "written_otherwise", "with_unused_material", "begun_elsewhere"},
    "transfer_tool": {"renamed", "written_otherwise", "with_unused_material", "begun_elsewhere"},
}

CHANGES = [shifted, mirrored, renamed, reordered, written_otherwise, begun_elsewhere, with_extra_vertices, split,
           with_unused_material, with_untouched_layer, with_longer_water_line, similar]

# Other round-off or another order sends a search elsewhere: its factor is known to this (docs/reference/methods/lem.md), besides the
# search_error that both results give.
SEARCH = 3e-3
# A vertex more is a strip more, and a slice's border: at a vertical entry into cohesive soil 50 slices leave 0.32 %.
SLICES = 5e-3
# Sums in another order (1e-15), grown by some hundred steps of plastic flow or by the tolerance of the iteration (1e-9).
ORDER = 1e-7
# Coordinates of 3e6 m have steps of 5e-10 m, each time step rounds them, and soil in failure amplifies it.
FAR_AWAY = 1e-5

# ssp with water stabilises the pressure with a time of 0.02 s that no entry scales (fem_solver/model/porous_element.hpp).
# Measured among 1,200 scenes of the FEM and 500 of the chain: at most 9.6 % in displacements and 4.6 % in velocities.
ALTERNATION = 0.2

ALLOWED = {
    "lem_tool": {"similar": 0.0, "shifted": SEARCH, "mirrored": SEARCH, "with_untouched_layer": SEARCH, "split": SLICES,
                 "with_extra_vertices": SLICES, "with_longer_water_line": SLICES},
    "mpm_solver": {"shifted": FAR_AWAY, "mirrored": ORDER, "reordered": ORDER, "begun_elsewhere": ORDER,
                   "with_extra_vertices": ORDER, "split": ORDER, "with_untouched_layer": ORDER, "similar": ORDER},
    "fem_solver": {"shifted": FAR_AWAY, "mirrored": ORDER, "reordered": ORDER, "with_extra_vertices": ORDER, "split": ORDER,
                   "with_longer_water_line": ORDER, "similar": ORDER},
}
ALLOWED["transfer_tool"] = ALLOWED["fem_solver"]


def allowed(phase, name, scene):
    fem = scene.get("fem", {})
    alternates = fem.get("element") == "ssp" and fem.get("water", {}).get("pressure_integration", "full") == "full"
    if name == "similar" and "water" in fem and alternates:
        return ALTERNATION
    return ALLOWED[phase][name]


def changes_of(phase):
    return [each for each in CHANGES if each.__name__ in EXACT[phase] or each.__name__ in ALLOWED[phase]]


# -------------------------------------------------------------------------------------------- another way to ask the same

def set_by_flag(scene, random):
    """(scene with other entries, --set arguments that restore them)."""
    made, arguments = copy.deepcopy(scene), []
    places = [pointer for pointer, value in leaves(scene) if isinstance(value, (int, float)) and not isinstance(value, bool)]
    for pointer in random.sample(places, min(3, len(places))):
        *path, last = pointer.split("/")[1:]
        inner = made
        for step in path:
            inner = inner[int(step)] if isinstance(inner, list) else inner[step]
        key = int(last) if isinstance(inner, list) else last
        arguments += ["--set", f"{pointer}={json.dumps(inner[key])}"]
        inner[key] = inner[key] * 2 + 1
    return made, arguments


def leaves(value, pointer=""):
    if isinstance(value, (dict, list)):
        for key, each in value.items() if isinstance(value, dict) else enumerate(value):
            yield from leaves(each, f"{pointer}/{key}")
    else:
        yield pointer, value


# ------------------------------------------------------------------------------------------------------------- monotony

def stronger(scene, random):
    """More cohesion or more friction in one soil."""
    made = copy.deepcopy(scene)
    law = made["materials"][random.choice(sorted(made["materials"]))]["law"]
    if law["phi_deg"] and random.random() < 0.5:
        law["phi_deg"] += 4
    else:
        law["c_kPa"] = 1.25 * law["c_kPa"] + 1
    return made


def drier(scene, random):
    """The line is lower in the soil, except where it is the level of free water."""
    if "water" not in scene.get("lem", {}):
        return None
    made = copy.deepcopy(scene)
    line = made["lem"]["water"]["line"]
    if line[-1][1] > 0 or len(line) == 4:
        return None  # free water also supports the slope
    made["lem"]["water"]["line"] = [[x, y - 0.5] for x, y in line]
    return made


def less_shaken(scene, random):
    if not scene.get("lem", {}).get("seismic_coefficient"):
        return None
    made = copy.deepcopy(scene)
    made["lem"]["seismic_coefficient"] /= 2
    return made
