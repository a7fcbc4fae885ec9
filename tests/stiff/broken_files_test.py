#!/usr/bin/python3
"""A NaN in each dataset of each exchange file in turn: refused with 65 and the dataset's name."""
import functools
import json
import pathlib
import shutil
import signal
import subprocess
import tempfile
import time

import h5py
import numpy
from programs import done_well, last_snapshot, longest, programs, refused, run, run_tests, scene_of


@functools.lru_cache
def chain():
    """A small chain for all tests: folder, scene."""
    folder = files
    scene = scene_of("chain_dam")
    scene["section"]["regions"][0]["mesh"]["divisions"] = [2, 4]
    scene["mpm"] |= {"cell_size": 2.5, "duration": 0.5}
    done_well("fem_solver", scene, folder / "fem")
    done_well("transfer_tool", scene, folder / "points", "--input", last_snapshot(folder / "fem"))
    done_well("mpm_solver", scene, folder / "mpm", "--input", folder / "points/particles.vtkhdf")
    return folder, scene


def real_datasets(file):
    found = []
    with h5py.File(file) as opened:
        def keep(name, item):
            if isinstance(item, h5py.Dataset) and item.dtype.kind == "f" and item.size > 0 and "provenance" not in name:
                found.append(name)
        opened.visititems(keep)
    assert found, file
    return found


def poison(file, copy, dataset):
    shutil.copy(file, copy)
    with h5py.File(copy, "r+") as opened:
        data = opened[dataset][()]
        data.flat[data.size // 2] = numpy.nan
        opened[dataset][...] = data


def each_refused(folder, file, program):
    for dataset in real_datasets(file):
        poison(file, folder / "poisoned.vtkhdf", dataset)
        refused(run(program, chain()[1], folder / "out", "--input", folder / "poisoned.vtkhdf"), dataset)


def fem_snapshot(folder):
    each_refused(folder, last_snapshot(chain()[0] / "fem"), "transfer_tool")


def transferred_points(folder):
    each_refused(folder, chain()[0] / "points/particles.vtkhdf", "mpm_solver")


def last_frame_of_the_mpm(folder):
    each_refused(folder, chain()[0] / "mpm/final.vtkhdf", "mpm_solver")


def checkpoint_refused(folder, program, scene):
    """A run stopped at its first telemetry saves a checkpoint; it is resumed with one broken real."""
    (folder / "scene.json").write_text(json.dumps(scene))
    command = [programs / program, folder / "scene.json", "--progress", "none", "--output"]
    running = subprocess.Popen([*command, folder / "stopped"], stderr=subprocess.DEVNULL)
    while running.poll() is None and not (folder / "stopped/telemetry.jsonl").exists():
        time.sleep(0.01)
    running.send_signal(signal.SIGTERM)
    running.wait()
    file = folder / "stopped/checkpoint.h5"
    for dataset in real_datasets(file):
        shutil.copytree(folder / "stopped", folder / "poisoned", dirs_exist_ok=True)
        poison(file, folder / "poisoned/checkpoint.h5", dataset)
        refused(subprocess.run([*command, folder / "poisoned", "--resume"], capture_output=True, text=True, timeout=longest), dataset)


def fem_checkpoint(folder):
    scene = scene_of("chain_dam")
    scene["fem"]["stages"][1]["duration"] = 100
    checkpoint_refused(folder, "fem_solver", scene)


def mpm_checkpoint(folder):
    scene = scene_of("chain_dam")
    scene["mpm"] |= {"duration": 100, "rest_earliest": 200}
    checkpoint_refused(folder, "mpm_solver", scene)


def record_of_a_motion(folder):
    scene = scene_of("chain_dam")
    lines = ["time_s,acceleration_g"] + [f"{0.01 * k},{0.1 * (k % 3)}" for k in range(100)]
    lines[51] = "0.5,nan"
    (folder / "record.csv").write_text("\n".join(lines) + "\n")
    scene["fem"] |= {"motion": {"file": str(folder / "record.csv")}, "base": {"density": 2300, "V_s": 760}}
    refused(run("fem_solver", scene, folder / "out"), "record.csv", "52")


def scene(folder):
    broken = scene_of("chain_dam")
    broken["materials"]["soil"]["density"] = float("nan")  # Python writes NaN, which JSON does not allow
    refused(run("fem_solver", broken, folder / "out"), "out.json")


def telemetry(folder):
    asked = scene_of("chain_dam")
    asked["transfer"]["window"] = {"lower": "failure_surfaces >= 1"}
    lines = (chain()[0] / "fem/telemetry.jsonl").read_text().splitlines()
    lines[1] = json.dumps(json.loads(lines[1]) | {"epsilon_q_avg": float("nan")})
    (folder / "telemetry.jsonl").write_text("\n".join(lines) + "\n")
    (folder / "scene.json").write_text(json.dumps(asked))
    refused(subprocess.run([programs / "transfer_tool", "advise", folder / "scene.json", "--output", folder / "out", "--input",
                            folder / "telemetry.jsonl"], capture_output=True, text=True), "telemetry.jsonl")


if __name__ == "__main__":
    with tempfile.TemporaryDirectory() as name:
        files = pathlib.Path(name)
        run_tests((fem_snapshot, transferred_points, last_frame_of_the_mpm, fem_checkpoint, mpm_checkpoint, record_of_a_motion, scene,
                   telemetry))
