"""A remedy can be followed: the scene with the value that a flag's message names passes, and the flag is gone or one level lower,
or its message says what is left. So does a refusal or warning of cases.py that names a value."""
import json
import pathlib
import re
import sys
import tempfile

from cases import cases
from remedies import remedy_of, rows, without

sys.path.insert(0, str(pathlib.Path(__file__).parent.parent / "workflow"))
from phases import result, root, run  # noqa: E402
from service import Service  # noqa: E402

levels = [None, "warning", "questionable"]


def shipped(name):
    file = root / f"workflows/scenes/{name}.json"
    scene = json.loads(file.read_text())
    if motion := scene.get("fem", {}).get("motion"):
        motion["file"] = str((file.parent / motion["file"]).resolve())
    return scene


def asked_of_service(scene, overrides, service):
    """(flags, faults) of a submission"""
    status, cost = service.post("/v1/cost", {
        "format": "breachline-study/1", "name": "study", "title": "A study", "scene": scene, "overrides": overrides,
        **({"transfer_times": [0.1]} if "fem" in scene else {})})
    return cost.get("warnings", []), [] if status == 200 else cost.get("faults") or [cost]


def flags_of(row, scene, overrides, folder, service):
    """(flags, reason of a refusal or failure)"""
    if row.run:
        file = folder / "scene.json"
        file.write_text(json.dumps(scene))
        ended = run(row.run, file, folder / "out", *[word for each in overrides for word in ("--set", each)])
        return (result(folder / "out")["flags"], None) if ended.returncode == 0 else ([], ended.stderr)
    flags, faults = asked_of_service(scene, overrides, service)
    return flags, json.dumps(faults) if faults else None


def judge_case(case, scene, service):
    """What is wrong with the value that a misuse's message names; none: it names none, or it passes."""
    def complaints(overrides):
        flags, faults = asked_of_service(scene, overrides, service)
        return [("fault", each["pointer"], f'{each["cause"]} {each["remedy"]}') for each in faults] + \
            [(each["code"], each["pointer"], each["message"]) for each in flags]

    left = [each for each in complaints([]) if re.search(case.text, f"{each[1]}: {each[2]}", re.I | re.S) and remedy_of(*each[1:])]
    known, followed = {each[:2] for each in left}, []
    while new := [each for _, pointer, message in left for each in remedy_of(pointer, message) if each not in followed][:9 - len(followed)]:
        followed += new  # a second wrong entry may be named only when the first is right
        left = [each for each in complaints(followed) if each[:2] in known]
    print(f"{case.name}: {' '.join(followed) or 'names no value'}", flush=True)
    return f"{followed} leaves {left}" if left else None


def level(flags, wanted):
    return max((levels.index(each["severity"]) for each in flags if (each["code"], each["pointer"]) == wanted), default=0)


def judge(row, bases, folder, service):
    """What is wrong with a row; none: its remedy can be followed."""
    scene = row.scene(bases)
    if row.motion:
        (folder / "record.csv").write_text(row.motion)
        scene["fem"]["motion"]["file"] = str(folder / "record.csv")
    before, fault = flags_of(row, scene, [], folder, service)
    flag = next((each for each in before if each["code"] == row.code), None)
    if not flag:
        return f"is not raised, but {[each['code'] for each in before]}: {fault}"
    overrides = remedy_of(flag["pointer"], flag["message"])
    if not overrides:
        return f"names no value: {flag['message']}"
    after, fault = flags_of(row, scene, overrides, folder, service)
    if fault:
        return f"{overrides} is refused: {fault}"
    this = flag["code"], flag["pointer"]
    print(f"{row.code}: {' '.join(overrides)}: {levels[level(before, this)]} -> {levels[level(after, this)]}", flush=True)
    if level(after, this) < level(before, this):
        return None
    stays = next(each["message"] for each in after if (each["code"], each["pointer"]) == this)
    return None if row.left and row.left in stays else f"{overrides} leaves it: {stays}"


def main(folder):
    bases = {each.base: shipped(each.base) for each in [*rows, *cases] if isinstance(each.base, str)}
    complaints = []
    service = Service(folder / "data")
    try:
        for row in rows:
            with tempfile.TemporaryDirectory(dir=folder) as place:
                if complaint := judge(row, bases, pathlib.Path(place), service):
                    complaints.append(f"{row.code}: {complaint}")
        for case in cases:
            if case.motion is None and (complaint := judge_case(case, case.scene(bases), service)):
                complaints.append(f"{case.name}: {complaint}")
    finally:
        service.stop()
    catalogue = set(re.findall(r"^### ([a-z_]+)$", (root / "docs/reference/flags.md").read_text(), re.M))
    followed = {row.code for row in rows}
    for code in sorted(catalogue - followed - set(without)):
        complaints.append(f"{code}: add a scene that raises it to remedies.py, or why its message names no value")
    for code in sorted((followed | set(without)) - catalogue) + sorted(followed & set(without)):
        complaints.append(f"{code}: is no flag, or in both lists of remedies.py")
    print("\n".join(complaints) or f"{len(rows)} remedies followed, {len(without)} flags without a value")
    return 1 if complaints else 0


if __name__ == "__main__":
    with tempfile.TemporaryDirectory() as name:
        sys.exit(main(pathlib.Path(name)))
