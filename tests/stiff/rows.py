"""What a row of the table of stiff and extreme cases is, and how the programs are run for it."""
import dataclasses
import json
import os
import pathlib
import subprocess
import tempfile
import resource

root = pathlib.Path(os.environ.get("BREACH_ROOT", pathlib.Path(__file__).resolve().parents[2]))
longest = 120  # seconds of a run, far beyond any of them: a run without end is a row that fails
programs = pathlib.Path(os.environ.get("BREACH_BIN", root / "build/release/bin"))


@dataclasses.dataclass
class Outcome:
    """What came out of a case. margin: allowed over reached, or words."""
    text: str
    holds: bool
    margin: str = ""


@dataclasses.dataclass
class Case:
    name: str
    phase: str     # LEM, FEM, transfer, MPM, chain, files
    extreme: str   # what is extreme: a ratio or a number
    right: str     # closed form, bound, refusal
    run: object    # folder -> Outcome
    slow: bool     # left out of the quick subset


cases = []


def case(phase, name, extreme, right, slow=False):
    """Makes a row of a function folder -> Outcome."""
    def add(function):
        cases.append(Case(name, phase, extreme, right, function, slow))
        return function
    return add


def within(what, reached, allowed):
    """An error (or another number that should be small) against what is allowed."""
    factor = allowed / reached if reached > 0 else float("inf")
    margin = "exact" if reached == 0 else f"{factor:.3g}" if factor < 1e4 else f"{factor:.0e}"
    return Outcome(f"{what} {reached:.2g} (allowed {allowed:.1g})", bool(reached <= allowed), margin)


def worst(*outcomes):
    """Several demands of one case: all texts, the smallest margin."""
    def size(outcome):
        try:
            return float(outcome.margin)
        except ValueError:
            return float("inf")
    least = min(outcomes, key=size)
    return Outcome("; ".join(each.text for each in outcomes), all(each.holds for each in outcomes), least.margin)


def refused(done, *words):
    """Exit 65 or 70 with all these words in the message."""
    lines = [line.strip() for line in done.stderr.splitlines() if line.strip()]
    begins = next((k for k, line in enumerate(lines) if line.startswith(done.args[0].rpartition("/")[2] + ":")), len(lines))
    message = " ".join(lines[begins:])  # what comes before is the plan
    said = message.partition(": 1 fault ")[2] or message.partition(": ")[2]
    clear = done.returncode in (65, 70) and all(word in message for word in words)
    return Outcome(f"exit {done.returncode}: {said[:170]}", clear, "refusal")


def cpu_of_children():
    used = resource.getrusage(resource.RUSAGE_CHILDREN)
    return used.ru_utime + used.ru_stime


def run(program, scene, output, *arguments):
    """scene: a document, written beside the output, or a file."""
    output.parent.mkdir(parents=True, exist_ok=True)
    if isinstance(scene, dict):
        file = output.with_suffix(".json")
        file.write_text(json.dumps(scene))
        scene = file
    return subprocess.run([str(programs / program), str(scene), "--output", str(output), "--progress", "none",
                           *map(str, arguments)], capture_output=True, text=True, timeout=longest)


def done_well(program, scene, output, *arguments):
    """The result of a run that must end with 0."""
    done = run(program, scene, output, *arguments)
    if done.returncode != 0:
        raise RuntimeError(f"{program} ended with {done.returncode}: {done.stderr[-600:]}")
    return json.loads((output / "result.json").read_text())


def judged(each):
    """A case's outcome and CPU seconds; an exception is an outcome, too."""
    before = cpu_of_children()
    with tempfile.TemporaryDirectory() as name:
        try:
            outcome = each.run(pathlib.Path(name))
        except Exception as failure:  # a program that broke down where it should not have
            outcome = Outcome(" ".join(str(failure).split())[:200], False)
    return outcome, cpu_of_children() - before
