"""What every phase promises: exit codes, faults, plan, progress lines, checkpoint on a signal, resume."""
import json
import os
import pathlib
import signal
import subprocess
import tempfile
import time

root = pathlib.Path(os.environ["BREACH_ROOT"])
toy = str(pathlib.Path(os.environ["BREACH_BIN"]) / "toy_phase")
scene = str(root / "workflows/scenes/column.json")


def run(*arguments):
    return subprocess.run([toy, *map(str, arguments)], capture_output=True, text=True, timeout=60)


def check(what, condition, detail=""):
    assert condition, f"{what}: {detail}"
    print(f"ok: {what}")


def main(folder):
    out = folder / "out"
    for arguments, code in ((["--help"], 0), (["--version"], 0), ([], 2), ([scene], 2), ([scene, "--nonsense"], 2),
                            ([scene, "--output", out, "--threads", "0"], 2),
                            ([scene, "--output", out, "--input", scene, "--input", scene], 2),
                            (["/no/such.json", "--output", out], 74),
                            ([scene, "--output", "/proc/no/such"], 74),
                            ([scene, "--output", out, "--input", "/no/such"], 74),
                            ([scene, "--check"], 0), ([scene, "--plan"], 0)):
        done = run(*arguments)
        check(f"exit {code} for {[str(a)[-20:] for a in arguments]}", done.returncode == code, done)

    plan = run(scene, "--plan").stdout
    check("the plan says what is left out, why and where", "left out  pore pressure  column has no water  (/section/regions)" in plan, plan)

    done = run(scene, "--output", out, "--set", "/gravity=-1", "--set", "/mpm/cel_size=2", "--set", "/materials/sand/law/nu=0.5")
    check("bad input is 65", done.returncode == 65, done)
    for pointer in ("/gravity", "/mpm/cel_size", "/materials/sand/law/nu"):
        check(f"all faults are named at once: {pointer}", pointer in done.stderr, done.stderr)

    for title, code in (("breakdown", 70), ("io", 74), ("bug", 70)):
        done = run(scene, "--output", out, "--set", f"/title={title}", "--progress", "json")
        check(f"{title} ends with {code}", done.returncode == code, done)
        fault = json.loads((out / "fault.json").read_text())
        check("fault.json has code and summary", fault["exit_code"] == code and fault["summary"], fault)
        known = fault["provenance"]
        check("fault.json says which version, scene and settings gave up", known["phase"] == "toy_phase" and
              known["version"] and known["overrides"] == [f"/title={title}"] and known["scene"]["title"] == title and
              fault["plan"][0]["feature"] == "counting", fault)
        check("the last line says it too", json.loads(done.stdout.splitlines()[-1])["event"] == "fault")
        check("no result is left", not (out / "result.json").exists())

    done = run(scene, "--output", out, "--progress", "json", "--set", "/title=fine")
    lines = [json.loads(line) for line in done.stdout.splitlines()]
    check("every line of --progress json is JSON; the last is the result", lines[-1]["event"] == "result" and lines[-1]["result"]["count"] == 20, lines)
    result = json.loads((out / "result.json").read_text())
    check("result.json carries provenance", result["provenance"]["scene"]["title"] == "fine" and result["provenance"]["overrides"] == ["/title=fine"], result)
    check("the old fault is gone", not (out / "fault.json").exists())
    check("the completed scene is stored", json.loads((out / "scene.completed.json").read_text())["mpm"]["cfl"] == 0.4)
    check("without --progress json stdout stays empty", run(scene, "--output", out).stdout == "")

    for number, code in ((signal.SIGTERM, 143), (signal.SIGINT, 130)):
        process = subprocess.Popen([toy, scene, "--output", str(out), "--set", "/title=slow"], stderr=subprocess.DEVNULL)
        while not (out / "telemetry.jsonl").exists() or len((out / "telemetry.jsonl").read_text().splitlines()) not in range(3, 15):
            time.sleep(0.01)
        process.send_signal(number)
        check(f"signal {number} ends with {code}", process.wait(timeout=30) == code)
        with open(out / "telemetry.jsonl", "a") as file:
            file.write('{"n": 9')  # an incomplete last line is normal after a kill
        done = run(scene, "--output", out, "--resume")
        counted = [json.loads(line)["n"] for line in (out / "telemetry.jsonl").read_text().splitlines()]
        check("resume goes on without a gap or a repeat", done.returncode == 0 and counted == list(range(20)), counted)

    (out / "checkpoint.h5").touch()
    before = {name: (out / name).read_bytes() for name in ("result.json", "scene.completed.json", "telemetry.jsonl", "checkpoint.h5")}
    done = run(scene, "--output", out, "--resume", "--set", "/gravity=9", "--set", "/mpm/cfl=0.3")
    check("another scene is not resumed with", done.returncode == 65, done)
    for told in ("/gravity: was 9.81 when this run began and is 9 now", "resume with --set /mpm/cfl=0.4, or start afresh"):
        check(f"what is another is told: {told}", told in done.stderr, done.stderr)
    check("and nothing is touched", before == {name: (out / name).read_bytes() for name in before})
    check("the same scene, written otherwise, is", run(scene, "--output", out, "--resume", "--set", "/gravity=981e-2").returncode == 0)
    (out / "checkpoint.h5").unlink()

    leftovers = [p.name for p in out.iterdir() if "tmp" in p.name or p.name.startswith(".")]
    check("nothing half-written is left", not leftovers, leftovers)


if __name__ == "__main__":
    with tempfile.TemporaryDirectory() as folder:
        main(pathlib.Path(folder))
