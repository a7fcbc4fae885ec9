"""Runs fem_solver from Python: the scene's folder, overrides, outputs, and differences between two runs."""
import json
import subprocess

import h5py
import numpy


def run(program, scene, output, **overrides):
    """Result, telemetry lines. overrides: fem__force_tolerance=1e-5 sets /fem/force_tolerance."""
    command = [str(program), str(scene), "--output", str(output), "--progress", "none"]
    for key, value in overrides.items():
        command += ["--set", "/" + key.replace("__", "/") + "=" + json.dumps(value)]
    done = subprocess.run(command, stderr=subprocess.PIPE, text=True)
    if done.returncode != 0:
        raise SystemExit(done.stderr.strip().splitlines()[-1])
    lines = [json.loads(line) for line in (output / "telemetry.jsonl").read_text().splitlines()]
    return json.loads((output / "result.json").read_text()), lines


def judge(what, reached, allowed):
    print(f"    {what:<66} reached {reached:.3e}, allowed {allowed:.1e}")
    return reached <= allowed


def datasets(file):
    found = {}
    with h5py.File(file) as opened:
        opened.visititems(lambda name, each: found.update({name: each[()]}) if isinstance(each, h5py.Dataset) else None)
    return found


def differences(one, two, files):
    """Datasets of these files that differ between two outputs, and the telemetry if it does."""
    wrong = []
    for name in files:
        a, b = datasets(one / name), datasets(two / name)
        assert a.keys() == b.keys() and len(a) > 5, name
        wrong += [f"{name}:{key}" for key in a if not numpy.array_equal(a[key], b[key])]
        print(f"    {len(a)} datasets of {name}, {len(wrong)} differ {wrong}")
    if (one / "telemetry.jsonl").read_bytes() != (two / "telemetry.jsonl").read_bytes():
        wrong.append("telemetry.jsonl")
    return wrong
