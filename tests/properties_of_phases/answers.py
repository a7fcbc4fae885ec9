"""Runs a phase on a document and reads what it answered: the facts that two runs of one problem share to the last bit, and numbers
without dimension and place that also scaled, shifted and mirrored problems share."""
import dataclasses
import json
import math
import os
import pathlib
import signal
import subprocess
import time

import h5py
import numpy

programs = pathlib.Path(os.environ["BREACH_BIN"])
root = pathlib.Path(os.environ["BREACH_ROOT"])
longest = 240  # longest run [s], with a large margin

# Differences between two runs of one problem: times, memory, and sentences with names and numbers of the scene.
OWN = {"plan", "provenance", "flags", "scene", "motion", "spencer_reason"}


@dataclasses.dataclass
class Answer:
    phase: str
    scene: dict
    folder: pathlib.Path
    code: int
    result: dict
    faults: list
    stderr: str

    def said(self):
        """Why it ended, in one line."""
        faults = "; ".join(f"{each['pointer']} {each['cause']}" for each in self.faults)
        return f"exit {self.code}: {faults or self.stderr[-300:].strip()}"


def command(phase, file, folder, arguments):
    return [str(programs / phase), str(file), "--output", str(folder), "--progress", "json", *map(str, arguments)]


def answer_of(phase, scene, folder, done):
    lines = [json.loads(line) for line in done.stdout.splitlines() if line.startswith('{"')]
    faults = next((line["faults"] for line in lines if line.get("event") == "fault"), [])
    result = json.loads((folder / "result.json").read_text()) if done.returncode == 0 else {}
    return Answer(phase, scene, folder, done.returncode, result, faults, done.stderr)


def run(phase, scene, folder, *arguments):
    folder.mkdir(parents=True, exist_ok=True)
    file = folder.with_suffix(".json")
    file.write_text(scene if isinstance(scene, str) else json.dumps(scene))
    done = subprocess.run(command(phase, file, folder, arguments), capture_output=True, text=True, timeout=longest)
    return answer_of(phase, json.loads(scene) if isinstance(scene, str) else scene, folder, done)


def run_with_stops(phase, scene, folder, waits):
    """Stops the run after each of the waits [s] that it outlasts, and resumes it.

    Returns the answer of the last process, and how often the run stopped."""
    folder.mkdir(parents=True, exist_ok=True)
    file = folder.with_suffix(".json")
    file.write_text(json.dumps(scene))
    for stops, wait in enumerate([*waits, None]):
        process = subprocess.Popen(command(phase, file, folder, ["--resume"] if stops else []), stdout=subprocess.PIPE,
                                   stderr=subprocess.PIPE, text=True)
        if wait is not None:
            # Signals end a phase without checkpoint until it handles them: after the first line of telemetry it does.
            before = lines_of(folder)
            while process.poll() is None and lines_of(folder) <= before:
                time.sleep(0.004)
            time.sleep(wait)
            process.send_signal(signal.SIGINT)
        stdout, stderr = process.communicate(timeout=longest)
        if process.returncode not in (130,):
            break
    return answer_of(phase, scene, folder, subprocess.CompletedProcess([], process.returncode, stdout, stderr)), stops


def lines_of(folder):
    file = folder / "telemetry.jsonl"
    return file.read_bytes().count(b"\n") if file.exists() else 0


# ------------------------------------------------------------------------------------------------- equal to the last bit

def facts(value):
    if isinstance(value, dict):
        return {key: facts(each) for key, each in value.items() if key not in OWN and "second" not in key and "memory" not in key}
    return [facts(each) for each in value] if isinstance(value, list) else value


def differences(one, other, place=""):
    """Places in which two documents differ, with both values."""
    if isinstance(one, dict) and isinstance(other, dict):
        for key in sorted(one.keys() | other.keys()):
            yield from differences(one.get(key), other.get(key), f"{place}/{key}")
    elif isinstance(one, list) and isinstance(other, list) and len(one) == len(other):
        for k, pair in enumerate(zip(one, other)):
            yield from differences(*pair, f"{place}/{k}")
    elif one != other and not (one != one and other != other):
        yield f"{place}: {one!r} and {other!r}"


def arrays(file):
    """All numbers of an HDF5 file by name."""
    found = {}

    def visit(name, item):
        if isinstance(item, h5py.Dataset) and item.dtype.kind in "fiu" and not ("seconds" in name or "provenance" in name):
            found[name] = item[()]
    with h5py.File(file) as opened:
        opened.visititems(visit)
    return found


def last_file(answer):
    """The final state: of the FEM, the transfer or the MPM."""
    pattern = {"fem_solver": "snapshot_*.vtkhdf", "mpm_solver": "final.vtkhdf", "transfer_tool": "particles.vtkhdf",
               "lem_tool": "surfaces.h5"}[answer.phase]
    return sorted(answer.folder.glob(pattern))[-1]


def bits_that_differ(one, other, names_differ=False):
    """Differences of result and last state. names_differ: result keys that are names in the scene are compared by their order."""
    first, second = facts(one.result), facts(other.result)
    if names_differ:
        first, second = nameless(first), nameless(second)
    yield from differences(first, second)
    a, b = arrays(last_file(one)), arrays(last_file(other))
    for name in sorted(a.keys() | b.keys()):
        if name not in a or name not in b or not numpy.array_equal(a[name], b[name], equal_nan=True):
            yield f"{last_file(one).name}: {name}"


def nameless(value):
    """Without texts; named entries (gauges, stages) by their place among the sorted values."""
    if isinstance(value, dict):
        if value and all(isinstance(each, dict) for each in value.values()):
            return sorted((nameless(each) for each in value.values()), key=json.dumps)
        return {key: nameless(each) for key, each in value.items()}
    if isinstance(value, list):
        return [nameless(each) for each in value]
    return "" if isinstance(value, str) else value


# ---------------------------------------------------------------------------------------------- without dimension and place

def moments(name, values, weights):
    """Mean and root mean square of a field, both over the reference."""
    total = weights.sum()
    square = float(numpy.sqrt((weights * values ** 2).sum() / total))
    return square, {f"mean {name}": float((weights * values).sum() / total) / square if square > 0 else 0.0}


def field_numbers(fields, weights, scales):
    """fields: name -> values; scales: name -> the scene's own measure of it.

    Root mean squares are given as logarithms, whose difference is relative."""
    numbers = {}
    for name, values in fields.items():
        square, found = moments(name, values, weights)
        if square < 1e-9 * scales[name]:  # only round-off
            square, found = 1e-9 * scales[name], {f"mean {name}": 0.0}
        numbers |= found
        numbers[f"log rms {name}"] = float(numpy.log(square / scales[name]))
    return numbers


def lem_numbers(answer):
    """Logarithms of the factors: their difference is relative."""
    result = answer.result
    return {"log F": math.log(result["factor_of_safety"]), "log F of Bishop": math.log(result["bishop"]["factor_of_safety"])}


def mpm_numbers(answer, mirrored=False):
    """Of the mobile points: places by the grid, speeds by sqrt(g h), stresses by 2000 kg/m3 g h, h the cell's size."""
    mpm = answer.scene["mpm"]
    mobile = set(mpm["runout"]["regions"])
    h, g = mpm["cell_size"], answer.scene.get("gravity", 9.81)
    with h5py.File(last_file(answer)) as opened:
        names = [each["name"] for each in answer.scene["section"]["regions"]]
        data = {name: opened["VTKHDF/PointData"][name][()] for name in ("velocity", "mass", "stress", "epsilon_q", "region")}
        place = opened["VTKHDF/Points"][:, :2]
    chosen = numpy.isin(data["region"], [k for k, name in enumerate(names) if name in mobile])
    data = {name: values[chosen] for name, values in data.items()}
    place = place[chosen]
    x = (mpm["domain_x"][1] - place[:, 0] if mirrored else place[:, 0] - mpm["domain_x"][0]) / h
    sign = -1 if mirrored else 1
    fields = {"x": x, "y": (place[:, 1] - mpm["floor"]["level"]) / h,
              "v_x": sign * data["velocity"][:, 0], "v_y": data["velocity"][:, 1],
              "sigma_x": data["stress"][:, 0], "sigma_y": data["stress"][:, 1],
              "tau": sign * data["stress"][:, 3], "epsilon_q": data["epsilon_q"]}
    speed, stress = (g * h) ** 0.5, 2000 * g * h
    scales = {"x": 1, "y": 1, "v_x": speed, "v_y": speed, "sigma_x": stress, "sigma_y": stress, "tau": stress, "epsilon_q": 1}
    numbers = field_numbers(fields, data["mass"], scales)
    numbers["farthest point [cells]"] = float(x.max())
    numbers["points"] = float(len(x))
    lift = float(data["mass"].sum()) * g * h
    return numbers if mirrored or answer.phase == "transfer_tool" else numbers | facts_of_mpm(answer.result, h, lift)


def facts_of_mpm(result, h, lift):
    """Lengths in cells, and energies by what lifts the points by a cell.

    For a stable slope the result's own shares are of a fall of 2.5 cm (docs/reference/methods/runout.md), which no similarity scales."""
    told = {"runout": result["runout"] / h, "volume_ratio": result["volume_ratio"],
            "deepest at the gauge": next(iter(result["gauges"].values()))["largest_depth"] / h if result.get("gauges") else 0.0}
    told |= {f"energy, {name}": result["energy"][name]["J"] / lift for name in ("kinetic", "plastic", "friction", "numerical")}
    return {name: float(value) for name, value in told.items()}


def fem_numbers(answer, mirrored=False):
    """Of all nodes and Gauss points: displacements by 2000 kg/m3 g H^2 / E of the first soil, stresses by 2000 kg/m3 g H."""
    scene = answer.scene
    levels = [y for each in scene["section"]["regions"] for _, y in each["polygon"]]
    H, g = max(levels) - min(levels), scene.get("gravity", 9.81)
    E = 1e6 * min(each["law"]["E_MPa"] for each in scene["materials"].values())
    sign = -1 if mirrored else 1
    with h5py.File(last_file(answer)) as opened:
        u = opened["VTKHDF/PointData/displacement"][()]
        sigma = opened["breachline/gauss/stress"][()]
    stress, way = 2000 * g * H, 2000 * g * H * H / E
    numbers = field_numbers({"u_x": sign * u[:, 0], "u_y": u[:, 1]}, numpy.ones(len(u)), {"u_x": way, "u_y": way})
    fields = {"sigma_x": sigma[:, 0], "sigma_y": sigma[:, 1], "tau": sign * sigma[:, 3]}
    return numbers | field_numbers(fields, numpy.ones(len(sigma)), dict.fromkeys(fields, stress))


NUMBERS = {"lem_tool": lem_numbers, "mpm_solver": mpm_numbers, "fem_solver": fem_numbers, "transfer_tool": mpm_numbers}


def numbers_of(answer, mirrored=False):
    measure = NUMBERS[answer.phase]
    return measure(answer) if answer.phase == "lem_tool" else measure(answer, mirrored)


def farthest_apart(one, other, names):
    """(difference, name, both values) of the number that differs most; a missing number counts as infinite."""
    rows = [(abs(one[name] - other[name]), name, one[name], other[name]) for name in names]
    return max((math.inf if math.isnan(row[0]) else row[0], *row[1:]) for row in rows)
