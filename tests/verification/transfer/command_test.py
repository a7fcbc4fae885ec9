"""transfer_tool and report as programs: what they write, what they say, and with which exit code they refuse."""
import json
import os
import pathlib
import subprocess
import sys
import tempfile

root = pathlib.Path(os.environ["BREACH_ROOT"])
programs = pathlib.Path(os.environ["BREACH_BIN"])
scene = root / "workflows/scenes/mochikoshi.json"
failures = []


def run(name, *arguments):
    return subprocess.run([programs / name, *map(str, arguments)], capture_output=True, text=True, timeout=120)


def expect(what, holds, done):
    if not holds:
        failures.append(what)
        print(f"FAILED: {what}\n  exit {done.returncode}\n  {done.stdout[-500:]}\n  {done.stderr[-2000:]}")


def transfer(folder):
    snapshot, output = folder / "snapshot_15.000000.vtkhdf", folder / "points"
    run("write_mochikoshi_shaped", scene, root / "tests/verification/transfer/mochikoshi_mesh24.json", snapshot)
    done = run("transfer_tool", scene, "--input", snapshot, "--output", output)
    expect("a transfer ends with 0 and nothing on stdout", done.returncode == 0 and done.stdout == "", done)
    expect("its ledger is on the terminal", "out-of-balance force" in done.stderr, done)
    result = json.loads((output / "result.json").read_text())
    expect("result.json states soils, stress, softening, cells and ledger",
           {each["stress"] for each in result["soils"]} == {"total"} and result["softening"] and
           result["cells"]["short"] == 0 and len(result["ledger"]) > 30, done)
    done = run("report", "transfer", output, "--output", folder / "figures")
    expect("report draws before and after", done.returncode == 0 and
           (folder / "figures/before_and_after.svg").stat().st_size > 10000, done)

    elsewhere = run("transfer_tool", scene, "--input", snapshot, "--output", folder / "elsewhere",
                    "--set", "/fem/motion/file=/nowhere/motion.csv")
    expect("the motion of the FEM need not be on this machine", elsewhere.returncode == 0, elsewhere)

    lossy = run("transfer_tool", scene, "--input", snapshot, "--output", folder / "lossy",
                "--set", "/transfer/largest_kinetic_energy_loss=1e-30")
    expect("a loss beyond the scene's limit ends with 70, named, without points",
           lossy.returncode == 70 and "kinetic energy of region" in lossy.stderr and
           not (folder / "lossy/particles.vtkhdf").exists(), lossy)


def advise(folder):
    telemetry = folder / "telemetry.jsonl"
    with telemetry.open("w") as lines:
        for i in range(400):
            t = 0.05 * i
            lines.write(json.dumps({"time": t, "step": i, "liquefaction_depth": 1.3 * t, "failure_surfaces": 2,
                                    "epsilon_q_avg": 0.0125 * t, "jacobian_least_avg": 1.0}) + "\n")
    done = run("transfer_tool", "advise", scene, "--input", telemetry, "--output", folder / "advice")
    expect("advice ends with 0", done.returncode == 0, done)
    advice = json.loads((folder / "advice/result.json").read_text())["advice"][0]
    expect("the window is between depth and strain, and the snapshot in it is taken",
           abs(advice["lower"]["time"] - 14.25) < 1e-9 and abs(advice["upper"]["time"] - 16.05) < 1e-9 and
           advice["take"] == 15.0, done)
    for override, pointer in (("/transfer/window/lower=depth >", "/transfer/window/lower"),
                              ("/transfer/window/pick=last", "/transfer/window/pick")):
        done = run("transfer_tool", "advise", scene, "--input", telemetry, "--output", folder / "no",
                   "--set", override)
        expect(f"{override} is refused with 65 at {pointer}", done.returncode == 65 and pointer in done.stderr, done)
    done = run("transfer_tool", "advise", root / "workflows/scenes/slope.json", "--input", telemetry,
               "--output", folder / "no")
    expect("a scene without a window is refused with 65",
           done.returncode == 65 and "/transfer/window" in done.stderr, done)


with tempfile.TemporaryDirectory() as name:
    transfer(pathlib.Path(name))
    advise(pathlib.Path(name))
print(f"{len(failures)} failures")
sys.exit(1 if failures else 0)
