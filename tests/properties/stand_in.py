"""A phase with the standard interface (docs/reference/architecture.md) that computes known.py. Run under the phases' names."""
import json
import os
import sys

import known


def changed(scene, overrides):
    """The scene with changes, each "/json/pointer=value"."""
    for each in overrides:
        pointer, text = each.split("=", 1)
        *path, last = pointer.strip("/").split("/")
        place = scene
        for key in path:
            place = (
                place[int(key)] if isinstance(place, list) else place.setdefault(key, [] if last == "-" and key == path[-1] else {})
            )
        try:
            value = json.loads(text)
        except ValueError:
            value = text
        if not isinstance(place, list):
            place[last] = value
        elif last == "-":
            place.append(value)
        else:
            place[int(last)] = value
    return scene


def publish(folder, name, text):
    with open(f"{folder}/{name}.part", "w") as file:
        file.write(text)
    os.rename(f"{folder}/{name}.part", f"{folder}/{name}")


def end_with(folder, code, summary):
    publish(folder, "fault.json", json.dumps({"exit_code": code, "summary": summary}))
    sys.exit(code)


def fem(scene, folder, has_memory):
    if has_memory:
        scene["fem"]["has_memory"] = True
    whole, how, when = known.fem(scene)
    times, interval = scene["fem"].get("snapshot_times", []), scene["fem"].get("snapshot_interval", 0)
    regular = [round(k * interval, 6) for k in range(1, int(known.end / interval + 1.000001))] if interval else []
    for time in sorted({*times, *regular}):
        if time <= when:
            publish(folder, f"snapshot_{time:.6f}.vtkhdf", json.dumps([time, whole]))
    with open(f"{folder}/telemetry.jsonl", "a") as lines:
        for k in range(1, round(when / known.step) + 1):
            time = round(k * known.step, 6)
            lines.write(
                json.dumps(
                    {
                        "step": k,
                        "time": time,
                        "dt": known.step,
                        "crest_displacement": known.crest(whole, time),
                        "kinetic_energy": known.energy(whole, time),
                    }
                )
                + "\n"
            )
    if when == 0:
        end_with(folder, 75, "not enough memory")
    if how == "breakdown":
        end_with(folder, 70, f"no convergence at {when:g} s")
    flags = [known.flag("entangled", "warning")] if how == "entangled" else []
    return {"ended": how, "end_time": when, "flags": flags, "questionable": False}


def mpm(scene, folder, source, resumed):
    if source:
        with open(source) as file:
            time, whole, added, shift = json.load(file)
    else:
        time, whole, added, shift = None, 0, 0, scene["mpm"].get("fill_shift", [0, 0])[0]
    if float(known.at(scene, "/mpm/cfl", 0.4)) == 0.6 and not resumed:
        end_with(folder, 75, "not enough memory")
    result = known.mpm(scene, time, whole, added, shift)
    return result or end_with(folder, 70, "the points have left the grid")


def transfer(scene, folder, source):
    with open(source) as file:
        time, whole = json.load(file)
    added = known.transfer(scene)
    if added is None:
        end_with(folder, 70, "no neighbours")
    publish(folder, "particles.vtkhdf", json.dumps([time, whole, added, scene["transfer"].get("point_shift", [0, 0])[0]]))
    return {"flags": [], "questionable": False}


def lem(scene, folder):
    factor = known.lem(scene)
    if factor is None:
        end_with(folder, 70, "no surface")
    return {"factor_of_safety": factor, "flags": [], "questionable": False}


def main(words):
    name = os.path.basename(words[0])
    if "--version" in words:
        return print(f"{name} 0\nnumerics 1")
    if "--plan" in words:
        return print("nothing")
    given = {word: words[k + 1] for k, word in enumerate(words[:-1]) if word in ("--input", "--output")}
    folder, source = given["--output"], given.get("--input")
    os.makedirs(folder, exist_ok=True)
    with open(words[1]) as file:
        text = file.read()
    scene = changed(json.loads(text), [words[k + 1] for k, word in enumerate(words) if word == "--set"])
    publish(folder, "scene.completed.json", json.dumps(scene))
    result = {
        "lem_tool": lambda: lem(scene, folder),
        "fem_solver": lambda: fem(scene, folder, os.path.exists(f"{os.path.dirname(words[0])}/memory")),
        "transfer_tool": lambda: transfer(scene, folder, source),
        "mpm_solver": lambda: mpm(scene, folder, source, "--resume" in words),
    }[name]()
    result = {"phase": name, "cpu_seconds": 0.5, **result}
    publish(folder, "result.json", json.dumps(result))
    print(json.dumps({"event": "result", "result": result}), flush=True)
