"""Every flag of a submission stands in the verdict of its run, also where no result can repeat it; the flags of that kind in the table
of docs/reference/flags.md are all raised. Scenes of remedies.py and cases.py, and the studies below; nothing is computed."""
import pathlib
import re
import sys
import tempfile

from cases import cases
from remedies import rows
from remedies_test import shipped

sys.path.insert(0, str(pathlib.Path(__file__).parent.parent / "workflow"))
from phases import root  # noqa: E402
from service import Service  # noqa: E402


def reservoir_without_seepage():
    """Water falls steeply in frictional soil, and no FEM says how it seeps."""
    scene = {key: part for key, part in shipped("slope").items() if key not in ("fem", "transfer")}
    return scene | {"mpm": scene["mpm"] | {"water": {"line": [[0, 9], [8, 9], [12, 3], [60, 3]]}}}


def studies():
    bases = {each.base: shipped(each.base) for each in [*rows, *cases] if isinstance(each.base, str)}
    for each in [*rows, *cases]:
        if not each.motion:
            scene = each.scene(bases)
            yield {"scene": scene, **({"transfer_times": [0.1]} if "fem" in scene else {})}
    yield {"scene": shipped("merriespruit")}
    yield {"scene": reservoir_without_seepage()}
    column = {"scene": shipped("column"), "transfer_times": [0.1]}
    yield column | {"overrides": ["/mpm/cfl=0.3", "/mpm/cfl=0.31"]}
    yield column | {"variants": [{"name": name, "overrides": ["/mpm/cfl=0.3"]} for name in "ab"]}
    yield {"scene": column["scene"], "triggers": [{"name": "late", "kind": "criterion", "condition": "time > 1000"}]}


def main(folder):
    service, raised, lost = Service(folder, "--slots", "1"), set(), []
    try:
        for study in studies():
            status, run = service.post("/v1/runs", {"format": "breachline-study/1", "name": "study", "title": "A study"} | study)
            if status != 202:
                continue
            service.post(f"/v1/runs/{run['id']}/cancel", {})
            reasons = service.call(f"/v1/runs/{run['id']}?tasks=0")["verdict"]["reasons"]
            for flag in run["warnings"]:
                raised.add(flag["code"])
                if not any(each["code"] == flag["code"] and flag["message"].rstrip(".") in each["text"] for each in reasons):
                    lost.append(f"{flag['code']}: {flag['message']}")
    finally:
        service.stop()
    table = (root / "docs/reference/flags.md").read_text().partition("## Flags that only a submission raises")[2].partition("\n## ")[0]
    listed = set(re.findall(r"`([a-z_]+)`", "".join(line.split("|")[1] for line in table.splitlines() if line.startswith("|"))))
    print("\n".join(lost) or f"{len(raised)} flags of submissions, all in their verdicts: {' '.join(sorted(raised))}")
    assert not lost
    assert listed and listed <= raised, f"no scene raises {listed - raised}"


if __name__ == "__main__":
    with tempfile.TemporaryDirectory() as name:
        main(pathlib.Path(name))
