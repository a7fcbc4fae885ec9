"""Every shipped study is accepted by the service, and every variant of it has a plan in every phase: nothing is
computed. A study of variants says in each what it changes, and no two are the same."""
import json
import pathlib
import subprocess
import tempfile

from phases import check, programs, root
from service import Service

phases = {"lem": "lem_tool", "fem": "fem_solver", "transfer": "transfer_tool", "mpm": "mpm_solver"}


def plan(phase, scene, overrides):
    sets = [word for each in overrides for word in ("--set", each)]
    done = subprocess.run([programs / phase, scene, *sets, "--plan"], capture_output=True, text=True, timeout=60)
    return done.returncode, done.stdout, done.stderr


def main(folder):
    service = Service(folder, "--slots", "1")
    try:
        for file in sorted((root / "workflows/studies").glob("*.json")):
            study = json.loads(file.read_text())
            run = service.submit(file)
            service.call(f"/v1/runs/{run}/cancel", {})  # tests only that it could run
            tasks = service.call(f"/v1/runs/{run}")["tasks_total"]
            scene = (file.parent / study["scene"]).resolve()
            variants = study.get("variants", [{"name": "", "overrides": []}])
            changes = [tuple(each.get("overrides", [])) for each in variants]
            check(f"{file.name}: {len(variants)} different variants", len(set(changes)) == len(changes), changes)
            for each in variants:
                overrides = study.get("overrides", []) + each.get("overrides", [])
                for part, phase in phases.items():
                    if part not in json.loads(scene.read_text()):
                        continue
                    code, out, error = plan(phase, scene, overrides)
                    check(f"{file.name} {each['name']}: {phase} has a plan", code == 0 and out, error)
            check(f"{file.name}: {tasks} tasks are planned", tasks >= 2)
        for file in sorted((root / "workflows/accuracy").glob("*.json")):
            run = service.submit(file)
            service.call(f"/v1/runs/{run}/cancel", {})
            table = service.call(f"/v1/runs/{run}/accuracy")
            rungs = sum(len(each["steps"]) for each in json.loads(file.read_text())["accuracy"]["ladders"])
            check(f"accuracy/{file.name}: {rungs} rungs", len(table["rows"]) == rungs, table)
    finally:
        service.stop()


if __name__ == "__main__":
    with tempfile.TemporaryDirectory() as name:
        main(pathlib.Path(name))
