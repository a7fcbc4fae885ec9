"""What of a stored result is stale, what measuring it again costs, and how newly measured parts join the rest of it. For `write`.

"measured" of a stored result has, for each phase that the result rests on: numerics, commit, machine, date, CPU seconds at the reference
speed and the calibration that gave them. "same_in" of a phase: later numerics that give these scenes the same numbers; the commit that
adds it says what was compared."""
import re
import time

PHASES = {"LEM": "lem_tool", "FEM": "fem_solver", "transfer": "transfer_tool", "MPM": "mpm_solver"}
CHAIN = ["FEM", "transfer", "MPM"]
REFERENCE = 1.75  # calibration() of the reference machine (AMD EPYC, 2 cores) [s]


def phase_of(program):
    """The stability analysis after the shaking is lem_tool's under another name."""
    return next((phase for phase, each in PHASES.items() if each == program), "LEM")


def calibration():
    """CPU seconds of a fixed workload: the lesser of two, because other programs share the cores."""
    def once():
        began = time.process_time()
        total = 0
        for k in range(40_000_000):
            total += k * k % 7
        return time.process_time() - began
    return round(min(once() for _ in range(2)), 2)


def at_reference_speed(document, calibrated):
    """Every "cpu_seconds" in the document as the reference machine would need them. Differences below 20 % are the
    noise of shared cores."""
    factor = REFERENCE / calibrated
    if abs(factor - 1) < 0.2:
        return document
    if isinstance(document, list):
        return [at_reference_speed(each, calibrated) for each in document]
    if not isinstance(document, dict):
        return document
    return {name: value * factor if name == "cpu_seconds" and isinstance(value, float) else at_reference_speed(value, calibrated)
            for name, value in document.items()}


def seconds_of(result):
    return sum(each["cpu_seconds"] for each in result["measured"]["phases"].values())


def stale_phases(about, now):
    """Phases whose numerics have risen since."""
    return [phase for phase, each in about["phases"].items() if now[phase] not in (each["numerics"], each.get("same_in"))]


def reads_depth(study):
    """Whether a trigger compares with the LEM's critical depth."""
    return any("critical_depth" in str(value) for trigger in study.get("triggers", []) for value in trigger.values())


def reads_stability(measurement, study):
    """Whether anything that is stored of the study comes from the LEM."""
    return bool(measurement.get("uncertainty") or "lem_tool" in measurement.get("phases", {}) or reads_depth(study)
                or any(each.startswith("factor_of_safety") for each in measurement.get("columns", [])))


def only_stability(measurement, study, known, stale):
    """Whether new stability analyses may be all that the result needs. Those after the shaking need the FEM."""
    if "study" not in measurement or stale != ["LEM"] or "post_seismic" in f"{measurement} {known.get('uncertainty')}":
        return False
    return bool(known.get("same_transfers") or not reads_depth(study))


def cost(measurement, study, known, stale, cached):
    """{phase: CPU seconds} of measuring the result again. cached: the service still has the run, or the command its folders."""
    there = {phase: each["cpu_seconds"] for phase, each in known["measured"]["phases"].items()}
    if only_stability(measurement, study, known, stale) or "catalogue" in measurement:
        return {phase: there[phase] for phase in stale}
    if not cached:
        return there
    # A new critical depth may move the transfers of a study.
    first = min((CHAIN.index(each) for each in stale if each in CHAIN), default=len(CHAIN) if "command" in measurement else 0)
    return {phase: seconds for phase, seconds in there.items() if phase in stale or phase in CHAIN[first:]}


def in_minutes(seconds):
    return ", ".join(f"{phase} {each / 60:.2f}" for phase, each in seconds.items()) or "none"


def stability_study(study, scene):
    """The stability analyses of a study alone, with the same samples. scene: the study's, as a document."""
    parts = ("/fem/", "/transfer/", "/mpm/")
    read = re.compile(r"/lem/|/section/|/materials/[^/]+/(law|density)")

    def kept(overrides):
        return [each for each in overrides if not each.startswith(parts)]

    made = {name: value for name, value in study.items() if name not in ("transfer_times", "triggers", "draws")}
    made |= {"scene": {name: value for name, value in scene.items() if name not in ("fem", "transfer", "mpm")},
             "overrides": kept(study.get("overrides", []))}
    if "variants" in study:
        made["variants"] = [each | {"overrides": kept(each["overrides"])} for each in study["variants"]]
    if asked := study.get("uncertainty"):
        parameters = [each for each in asked["parameters"] if read.search(str(each))]
        names = {each["name"] for each in parameters}
        made["uncertainty"] = {name: value for name, value in asked.items() if name not in ("transfer", "correlation")} | {
            "quantity": "factor_of_safety", "parameters": parameters}
        if pairs := [each for each in asked.get("correlation", []) if set(each[:2]) <= names]:
            made["uncertainty"]["correlation"] = pairs
    return made


def opening(lines, criterion, depth):
    """The time of the first line of a FEM's telemetry that meets the criterion with this critical depth; infinite: none does."""
    def met(line):
        try:
            return eval(criterion, {"__builtins__": {}}, line | {"critical_depth": depth})
        except (NameError, TypeError):  # a column that the line lacks
            return False
    return next((line["time"] for line in lines if met(line)), float("inf"))


def same_transfers(criteria, fems, depths):
    """[above, up to]: with critical depths in this range every criterion opens when it did with `depths`; null: no bound, None: there is
    no such range. fems: lines of telemetry of each."""
    above, up_to = 0.0, float("inf")
    for lines in fems:
        steps = sorted({line["liquefaction_depth"] for line in lines if line.get("liquefaction_depth") is not None})
        for criterion in criteria:
            opens = opening(lines, criterion, max(depths))
            if opening(lines, criterion, min(depths)) != opens:
                return None
            # A deeper critical depth opens no earlier; between two steps nothing changes.
            above = max([above, *(each for each in steps if opening(lines, criterion, each) < opens)])
            if opens < float("inf"):
                up_to = min(up_to, max(each for each in steps if opening(lines, criterion, each) == opens))
    return [above, up_to if up_to < float("inf") else None]


def keeps_transfers(known, depths):
    if not known["same_transfers"]:
        return False
    above, up_to = known["same_transfers"]
    return all(above < each <= (up_to or float("inf")) for each in depths)


def with_stability(known, rows, phases, uncertainty):
    """A stored result of a study with its stability analyses replaced: rows and phases of the new analyses, one for each variant."""
    def of(those, variant):
        """A repeat has its variant's analysis, a shared task that of any variant."""
        named = {each["variant"]: each for each in those}
        return named.get(variant) or named.get(re.sub(r"_d\d+$", "", variant)) or those[0]

    def replaced(row):
        return row | {name: of(rows, row["variant"]).get(name) for name in row if name.startswith("factor_of_safety")}

    result = known | {"rows": [replaced(row) for row in known["rows"]]}
    if phases:
        result["phases"] = [of(phases, each["variant"]) | {"variant": each["variant"]} if each["phase"] == "lem_tool" else each
                            for each in known["phases"]]
    if uncertainty:
        new = [each for each in uncertainty["sentences"] if each.startswith("Probability of failure")]
        old = known["uncertainty"]["sentences"]
        first = next((k for k, each in enumerate(old) if each.startswith("Probability of failure")), len(old))
        others = [each for each in old if not each.startswith("Probability of failure")]
        result["uncertainty"] = known["uncertainty"] | {
            "quantities": known["uncertainty"]["quantities"] | {
                name: each for name, each in uncertainty["quantities"].items() if name.startswith("factor_of_safety")},
            "sentences": others[:first] + new + others[first:]}
    return result


def programs_of(topic):
    """The programs that a topic of the catalogue runs, by case."""
    def words(entry):
        return [each[0] for each in entry.get("commands", [])] or ([entry["program"]] if "program" in entry else [])
    return {case["id"]: [each for each in words(case) or words(topic) if each in PHASES.values()] for case in topic["cases"]}


def with_sections(text, newer):
    """The page with the sections of the same title taken from `newer`."""
    def sections(of):
        return {each.split("\n", 1)[0]: each.rstrip("\n") + "\n" for each in re.split(r"(?m)^(?=## )", of) if each}
    return "\n".join((sections(text) | sections(newer)).values())
