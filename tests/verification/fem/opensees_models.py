"""The models of ../shared/reference/opensees*/ as scenes of ours: same mesh, soils, water, base, motion, Newmark rule.
Units of the scenes: m, kg, kPa; a caller writes the files into a folder of its own."""
import csv
import json
import math

TAILINGS = {"density": 18300 / 9.81, "void_ratio": 0.99, "permeability": [7.1e-6, 7.1e-9],
            "law": {"type": "pm4sand", "D_R": 0.35, "G_0": 476, "h_po": 2.70, "Q": 11.998, "R": 3.75}}
EMBANKMENT = {"density": 16600 / 9.81, "void_ratio": 1.20, "permeability": [1e-6, 1e-6],
              "law": {"type": "pm4sand", "D_R": 0.55, "G_0": 677, "h_po": 0.40}}
FOUNDATION = {"density": 18600 / 9.81, "void_ratio": 0.80, "permeability": [1e-5, 1e-5],
              "law": {"type": "pm4sand", "D_R": 0.75, "G_0": 890, "h_po": 0.63}}
STAGES = [{"type": "static", "name": "elastic gravity", "laws": "elastic", "permeability": "free_drainage"}]


def write_motion(file, dt, velocity):
    with open(file, "w", newline="") as out:
        rows = csv.writer(out)
        rows.writerow(["time_s", "velocity_m_s"])
        rows.writerows([f"{k * dt:.6g}", f"{v:.9g}"] for k, v in enumerate(velocity))


def sine(duration, ramp, dt=2e-3):
    """0.3 g at 2 Hz as velocity, growing evenly over `ramp`."""
    v_0 = 0.3 * 9.81 / (2 * math.pi * 2)

    return [min(1.0, k * dt / ramp) * v_0 * math.sin(4 * math.pi * k * dt) for k in range(round(duration / dt) + 1)]


def scene(name, materials, regions, supports, line, motion, crest, duration, **fem):
    """Without a plastic gravity stage: where elastic gravity leaves soil outside its surfaces (pond, faces) there is no
    static equilibrium nearby, and 0.7 % of the weight goes into the quiet beginning of the motion."""
    dt = fem.pop("time_step", 2e-3)
    return {"format": "breachline-scene/1", "name": name, "gravity": 9.81, "materials": materials,
            "section": {"regions": regions},
            "fem": {"element": "ssp", "supports": supports, "crest": crest,
                    "water": {"line": line, "bulk_modulus_MPa": 2200, "pressure_integration": "one_point"},
                    "base": {"density": 2243, "V_s": 760},
                    "motion": {"file": motion},
                    "newmark_beta": 4 / 9, "newmark_gamma": 5 / 6,
                    "stages": STAGES + [{"type": "dynamic", "name": "shaking", "duration": duration,
                                         "time_step": dt, "least_time_step": dt / 64}], **fem}}


def block(name, material, corners, divisions):
    return {"name": name, "material": material, "polygon": corners + corners[:1],
            "mesh": {"type": "block", "divisions": divisions}}


def slope(folder, **fem):
    """tcl/slope2d.tcl: the speed anchor, 4,400 elements with the columns."""
    write_motion(folder / "motion.csv", 2e-3, sine(5.0, 0.5))
    top, foot = 1.0, 269 / 169  # width of a column at the pond's level and at the foundation

    def x(i, y):
        return 1 + (i - 1) * (top + (foot - top) * (20 - y) / 20 if y >= 0 else foot)
    a, b, end = 145, 170, 299.0
    regions = [
        block("foundation", "foundation", [[1, -5], [x(b, 0), -5], [x(b, 0), 0], [1, 0]], [169, 5]),
        block("beyond", "foundation", [[x(b, 0), -5], [end, -5], [end, 0], [x(b, 0), 0]], [29, 5]),
        block("tailings", "tailings", [[1, 0], [x(a, 0), 0], [x(a, 20), 20], [1, 20]], [144, 20]),
        block("embankment", "embankment", [[x(a, 0), 0], [x(b, 0), 0], [x(b, 20), 20], [x(a, 20), 20]], [25, 20])]
    # A mapped block needs its neighbour's nodes on a shared side as vertices only where regions end.
    regions[0]["polygon"] = [[1, -5], [x(b, 0), -5], [x(b, 0), 0], [x(a, 0), 0], [1, 0], [1, -5]]
    regions[0]["mesh"]["corners"] = [[1, -5], [x(b, 0), -5], [x(b, 0), 0], [1, 0]]
    supports = [{"name": "base", "from": [1, -5], "to": [end, -5], "fixes": "xy"}]
    result = scene("slope2d", {"tailings": TAILINGS, "embankment": EMBANKMENT, "foundation": FOUNDATION}, regions,
                   supports, [[1, 20], [x(b, 20), 20], [x(b, 0), 0], [end, 0]], "motion.csv", [x(b, 20), 20],
                   fem.pop("duration", 0.8), free_field={"width": 1, "thickness_factor": 1e6}, **fem)
    (folder / "scene.json").write_text(json.dumps(result, indent=1))
    return result


def write_msh(file, nodes, quads, region_of_quad, names):
    """gmsh 2.2 text."""
    with open(file, "w") as out:
        print("$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$PhysicalNames", file=out)
        print(len(names), *(f'2 {k + 1} "{name}"' for k, name in enumerate(names)), sep="\n", file=out)
        print("$EndPhysicalNames\n$Nodes", len(nodes), sep="\n", file=out)
        for k, (x, y) in enumerate(nodes):
            print(k + 1, repr(x), repr(y), 0, file=out)
        print("$EndNodes\n$Elements", len(quads), sep="\n", file=out)
        for k, quad in enumerate(quads):
            tag = region_of_quad[k] + 1
            print(k + 1, 3, 2, tag, tag, *(n + 1 for n in quad), file=out)
        print("$EndElements", file=out)


def mochikoshi(folder, reference, mesh="mesh24", size=2.4, **fem):
    """mochi.tcl on one of its meshes, with elements of about `size` [m]: its free-field columns are ours, the rest is its mesh."""
    file = f"{mesh}.msh"
    mesh = json.loads((reference / f"{mesh}.json").read_text())
    kept = [k for k, t in enumerate(mesh["thickness"]) if t == 1.0]
    used = sorted({n for k in kept for n in mesh["elements"][k]})
    new = {n: i for i, n in enumerate(used)}
    kept.sort(key=lambda k: mesh["material"][k])
    write_msh(folder / file, [mesh["nodes"][n] for n in used],
              [[new[n] for n in mesh["elements"][k]] for k in kept], [mesh["material"][k] - 1 for k in kept],
              ["tailings", "embankment", "foundation"])
    with open(reference / "input_velocity.csv") as rows:
        velocity = [float(row["outcrop_velocity_m_s"]) for row in csv.DictReader(rows)]
    write_motion(folder / "motion.csv", 0.01, velocity)
    dam = [[133, 0], [220, 0], [175.9, 12.4], [168.9, 12.4], [115, 30], [110, 30], [109, 29.4], [124.3, 21], [151.9, 12.4]]
    regions = [block("foundation", "foundation", [[-55, -5], [275, -5], [275, 0], [-55, 0]], [1, 1])]
    regions += [{"name": name, "material": name, "polygon": ring + ring[:1], "mesh": {"type": "unstructured", "element_size": size}}
                for name, ring in (("tailings", [[-55, 0], [133, 0], [151.9, 12.4], [124.3, 21], [109, 29.4], [-55, 29.4]]),
                                   ("embankment", dam))]
    supports = [{"name": "base", "from": [-55, -5], "to": [275, -5], "fixes": "xy"}]
    result = scene("mochikoshi24", {"tailings": TAILINGS, "embankment": EMBANKMENT, "foundation": FOUNDATION}, regions,
                   supports, mesh["phreatic_line"], "motion.csv", [115, 30], fem.pop("duration", 5.0),
                   msh_file=file, free_field={"width": 5, "thickness_factor": 1e6}, **fem)
    (folder / "scene.json").write_text(json.dumps(result, indent=1))
    return result
