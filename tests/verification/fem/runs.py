"""One run of fem_solver from Python: the scene's folder, overrides, and what came out."""
import json
import subprocess


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
