"""Rows of the exchange files: one number that is not a number, in each dataset of each file in turn."""
import atexit
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

from rows import Outcome, case, done_well, longest, programs, run
from scenes import dam_break, last_snapshot, sand


@functools.lru_cache
def files():
    """A small chain, kept as long as the table is being made: folder, scene."""
    folder = pathlib.Path(tempfile.mkdtemp(prefix="breach_stiff_"))
    atexit.register(shutil.rmtree, folder)
    scene = dam_break(sand(c=0.005), cells=4, until=0.5)
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
    return found


def poison(file, copy, dataset):
    shutil.copy(file, copy)
    with h5py.File(copy, "r+") as opened:
        data = opened[dataset][()]
        data.flat[data.size // 2] = numpy.nan
        opened[dataset][...] = data


def told(datasets, wrong):
    said = f"{len(datasets) - len(wrong)} of {len(datasets)} refused by name" + (": not " + ", ".join(wrong) if wrong else "")
    return Outcome(said, bool(datasets) and not wrong, "refusal")


def each_refused(folder, file, program, *settings):
    """Every dataset of reals in turn: exit 65 and the dataset's path in the message."""
    scene = files()[1]
    datasets, wrong = real_datasets(file), []
    for dataset in datasets:
        poison(file, folder / "poisoned.vtkhdf", dataset)
        done = run(program, scene, folder / "out", "--input", folder / "poisoned.vtkhdf", *settings)
        if done.returncode != 65 or dataset not in done.stderr:
            wrong.append(f"{dataset} (exit {done.returncode})")
    return told(datasets, wrong)


@case("files", "NaN in the FEM's snapshot", "one NaN in each dataset in turn", "transfer_tool refuses with 65, naming the dataset")
def snapshot(folder):
    return each_refused(folder, last_snapshot(files()[0] / "fem"), "transfer_tool")


@case("files", "NaN in the transferred points", "one NaN in each dataset in turn", "mpm_solver refuses with 65, naming the dataset")
def particles(folder):
    return each_refused(folder, files()[0] / "points/particles.vtkhdf", "mpm_solver")


@case("files", "NaN in the MPM's own last frame", "one NaN in each dataset in turn", "mpm_solver refuses it as an input, naming the dataset")
def last_frame(folder):
    return each_refused(folder, files()[0] / "mpm/final.vtkhdf", "mpm_solver")


def checkpoint_of(folder, program, *arguments):
    """A run that is asked to stop as soon as it has begun to write its telemetry; it saves a checkpoint first."""
    running = subprocess.Popen([str(programs / program), *map(str, arguments), "--output", str(folder), "--progress", "none"],
                               stderr=subprocess.DEVNULL)
    while running.poll() is None and not (folder / "telemetry.jsonl").exists():
        time.sleep(0.01)
    running.send_signal(signal.SIGTERM)
    return running.wait(), folder / "checkpoint.h5"


def checkpoint_refused(folder, program, *arguments):
    """The run taken up again from its checkpoint, one of whose reals is not a number."""
    code, file = checkpoint_of(folder / "stopped", program, *arguments)
    if not file.exists():
        return Outcome(f"no checkpoint (exit {code})", False)
    wrong, datasets = [], real_datasets(file)
    for dataset in datasets:
        shutil.copytree(folder / "stopped", folder / "poisoned", dirs_exist_ok=True)
        poison(file, folder / "poisoned/checkpoint.h5", dataset)
        again = subprocess.run([str(programs / program), *map(str, arguments), "--output", str(folder / "poisoned"), "--resume",
                                "--progress", "none"], capture_output=True, text=True, timeout=longest)
        if again.returncode != 65 or dataset not in again.stderr:
            wrong.append(f"{dataset} (exit {again.returncode})")
    return told(datasets, wrong)


@case("files", "NaN in the FEM's checkpoint", "one NaN in each dataset in turn", "fem_solver --resume refuses with 65, naming the dataset")
def fem_checkpoint(folder):
    scene = dam_break(sand(c=0.005), cells=20)
    scene["fem"]["stages"][1]["duration"] = 100
    (folder / "scene.json").write_text(json.dumps(scene))
    return checkpoint_refused(folder, "fem_solver", folder / "scene.json")


@case("files", "NaN in the MPM's checkpoint", "one NaN in each dataset in turn", "mpm_solver --resume refuses with 65, naming the dataset")
def mpm_checkpoint(folder):
    (folder / "scene.json").write_text(json.dumps(dam_break(sand(c=0.005), cells=20, until=100)))
    return checkpoint_refused(folder, "mpm_solver", folder / "scene.json")


def refused_line(done, *words):
    clear = done.returncode == 65 and all(word in done.stderr for word in words)
    lines = [line for line in done.stderr.splitlines() if any(word in line for word in words)]
    return Outcome(f"exit {done.returncode}: {(lines or ['nothing said'])[0].strip().split('] ')[-1][:140]}", clear, "refusal")


@case("files", "NaN in a motion's record", "one NaN among the accelerations", "refused with 65, naming file and line")
def motion(folder):
    scene = dam_break(sand(c=0.005), cells=4)
    lines = ["time_s,acceleration_g"] + [f"{0.01 * k},{0.1 * (k % 3)}" for k in range(100)]
    lines[51] = "0.5,nan"
    (folder / "record.csv").write_text("\n".join(lines) + "\n")
    scene["fem"] |= {"motion": {"file": str(folder / "record.csv")}, "base": {"density": 2300, "V_s": 760}}
    return refused_line(run("fem_solver", scene, folder / "out"), "record.csv")


@case("files", "NaN in a scene", "a density of NaN", "refused with 65: no JSON")
def scene_file(folder):
    scene = dam_break(sand(c=0.005), cells=4)
    scene["materials"]["soil"]["density"] = float("nan")  # Python writes NaN, which JSON does not know
    return refused_line(run("fem_solver", scene, folder / "out"), "out.json")


@case("files", "NaN in the FEM's telemetry", "one NaN in a line", "transfer_tool advise refuses with 65, naming the file")
def telemetry(folder):
    scene = dam_break(sand(c=0.005), cells=4)
    scene["transfer"]["window"] = {"lower": "failure_surfaces >= 1"}
    lines = (files()[0] / "fem/telemetry.jsonl").read_text().splitlines()
    key = "epsilon_q_avg"
    head, _, tail = lines[1].partition(f'"{key}":')
    lines[1] = f'{head}"{key}":NaN{tail[tail.index(","):]}' if "," in tail else f'{head}"{key}":NaN}}'
    (folder / "telemetry.jsonl").write_text("\n".join(lines) + "\n")
    (folder / "scene.json").write_text(json.dumps(scene))
    done = subprocess.run([str(programs / "transfer_tool"), "advise", str(folder / "scene.json"), "--output", str(folder / "out"),
                           "--input", str(folder / "telemetry.jsonl")], capture_output=True, text=True)
    return refused_line(done, "telemetry.jsonl")
