"""workflows/verification/write: measured pages equal their templates with their results; the command names results of other inputs or
numerics, and measures again only what rests on them."""
import importlib.machinery
import importlib.util
import os
import pathlib
import subprocess
import sys
import tempfile

root = pathlib.Path(os.environ["BREACH_ROOT"])
programs = pathlib.Path(os.environ["BREACH_BIN"])
loader = importlib.machinery.SourceFileLoader("write", str(root / "workflows/verification/write"))
sys.dont_write_bytecode = True
write = importlib.util.module_from_spec(importlib.util.spec_from_loader("write", loader))
loader.exec_module(write)


now = write.numerics(programs)


def result_of(measurement, *phases, **more):
    entries = {phase: {"numerics": now[phase], "commit": "12345678", "machine": "one", "cpu_seconds": 60.0} for phase in phases}
    return {"measured": {"key": write.key_of(measurement), "phases": entries}, **more}


def told(result, measurement, numerics=now, cached=False):
    return " ".join(write.inconsistencies({"one": result}, {"one": measurement}, numerics, cached))


def results_name_what_changed():
    measurement = {"study": "workflows/studies/column_sweep.json"}
    sound = result_of(measurement, "FEM", "MPM")
    assert told(sound, measurement) == ""
    raised = now | {"MPM": now["MPM"] + 1}
    assert f"is of MPM {now['MPM']}, the program is of {raised['MPM']}" in told(sound, measurement, raised)
    assert told(sound, measurement, now | {"LEM": now["LEM"] + 1}) == "", "it does not rest on the LEM"
    assert "has changed since" in told({"measured": sound["measured"] | {"key": "0"}}, measurement)
    sound["measured"]["phases"]["MPM"] |= {"same_in": raised["MPM"], "machine": "another"}
    assert told(sound, measurement, raised) == ""
    assert "one and another" in write.measured_by({"one": sound}, {"one": measurement}, now)
    later, kept = raised | {"MPM": raised["MPM"] + 1}, measurement | {"earlier_numerics": "it agrees"}
    assert told(sound, kept, later) == "" and "is of MPM" in told(sound, measurement, later)
    assert f"`one` is of earlier numerics than MPM {later['MPM']}: it agrees." in write.measured_by({"one": sound}, {"one": kept}, later)
    sound["measured"]["phases"]["MPM"]["commit"] = "12345678+"
    assert "in no commit" in told(sound, measurement)


def costs_are_of_the_stale_phases():
    chain = {"study": "workflows/studies/mochikoshi.json", "phases": {"lem_tool": ["critical_depth"]}}
    stored = result_of(chain, "LEM", "FEM", "transfer", "MPM", same_transfers=[3.0, 22.0])

    def cost(phase, result=stored, measurement=chain, cached=False):
        return list(write.cost_of(result, measurement, now | {phase: now[phase] + 1}, cached))

    every = ["LEM", "FEM", "transfer", "MPM"]
    assert cost("LEM") == ["LEM"] and write.cost_of(stored, chain, now, False) == {}
    assert cost("transfer") == every and cost("transfer", cached=True) == ["transfer", "MPM"]
    assert cost("MPM", cached=True) == ["MPM"] and cost("FEM", cached=True) == ["FEM", "transfer", "MPM"]
    assert cost("LEM", result_of(chain, *every)) == every, "whether its transfers stay is not known"
    command = {"command": ["tests/benchmark/features/what_is_left_out.py"]}
    assert cost("FEM", result_of(command, "FEM", "MPM"), command, True) == ["FEM", "MPM"]
    catalogue = {"catalogue": "workflows/verification/catalogue"}
    assert cost("LEM", result_of(catalogue, *every), catalogue) == ["LEM"]


def new_analyses_leave_the_rest():
    old, new, other = ({"variant": each, "factor_of_safety": 1.0, "runout": 5.0} for each in ("loose", "loose_d2", "dense"))
    phases = [{"phase": "lem_tool", "variant": "", "critical_depth": 1.0}, {"phase": "fem_solver", "variant": "loose", "ended": "complete"}]
    said = {"quantities": {"runout": 1, "factor_of_safety": 2}, "sentences": ["a", "Probability of failure: 0 %", "b"]}
    known = {"rows": [old, new, other], "phases": phases, "uncertainty": said, "failed": []}
    rows = [{"variant": "loose", "factor_of_safety": 1.5}, {"variant": "dense", "factor_of_safety": 2.5}]
    merged = write.stale.with_stability(known, rows, [{"phase": "lem_tool", "variant": "loose", "critical_depth": 1.25}],
                                        {"quantities": {"factor_of_safety": 3}, "sentences": ["c", "Probability of failure: 9 %"]})
    assert [each["factor_of_safety"] for each in merged["rows"]] == [1.5, 1.5, 2.5] and {each["runout"] for each in merged["rows"]} == {5.0}
    assert merged["phases"] == [phases[0] | {"critical_depth": 1.25}, phases[1]]
    assert merged["uncertainty"] == {"quantities": {"runout": 1, "factor_of_safety": 3}, "sentences": ["a", "Probability of failure: 9 %", "b"]}
    page = "## A\n\nold\n\n## B\n\nkept\n"
    assert write.stale.with_sections(page, "## A\n\nnew\n") == page.replace("old", "new")


def transfers_stay_within_a_range_of_critical_depths():
    lines = [{"time": 0.1 * k, "liquefaction_depth": 5.0 * k, "failure_surfaces": int(k > 3)} for k in range(6)]
    criterion = "liquefaction_depth >= critical_depth and failure_surfaces >= 1"
    of = write.stale.same_transfers
    assert of([criterion], [lines], [12.0]) == [0.0, 20.0], "the failure surface comes last"
    assert of([criterion], [lines], [22.0]) == [20.0, 25.0] and of([criterion], [lines], [12.0, 22.0]) is None
    assert of([criterion], [lines], [30.0]) == [25.0, None], "it never opens"
    keeps = write.stale.keeps_transfers
    assert keeps({"same_transfers": [0.0, 20.0]}, [12.0, 20.0]) and not keeps({"same_transfers": [20.0, None]}, [20.0])
    assert not keeps({"same_transfers": None}, [12.0])


def times_are_of_the_reference_machine():
    document = {"rows": [{"cpu_seconds": 4.0, "runout": 4.0}]}
    assert write.stale.at_reference_speed(document, write.stale.REFERENCE) == document
    assert write.stale.at_reference_speed(document, 2 * write.stale.REFERENCE) == {"rows": [{"cpu_seconds": 2.0, "runout": 4.0}]}


def main():
    results_name_what_changed()
    costs_are_of_the_stale_phases()
    new_analyses_leave_the_rest()
    transfers_stay_within_a_range_of_critical_depths()
    times_are_of_the_reference_machine()

    with tempfile.TemporaryDirectory() as folder:
        keys, of_measurement = [], write.inputs_of
        for text in ("docs/stiff", "docs/verification/stiff", "docs/verification/other"):
            (pathlib.Path(folder) / "input").write_text(text)
            write.inputs_of = lambda _: [pathlib.Path(folder) / "input"]
            keys.append(write.key_of({}))
        write.inputs_of = of_measurement
    assert keys[0] == keys[1] != keys[2], "where a page lies is no input, which page it is"

    rows = write.Rows([{"variant": "a", "time": 1.0, "x": 2.0}, {"variant": "a", "time": 2.0, "x": None}, {"variant": "b", "time": 1.0, "x": 3.0}])
    assert rows.of(variant="a").all("x") == [2.0] and rows.of(time=1).value("x") == 2.0 and rows.of(variant="c").value("x") is None
    repeats = write.Rows([{"variant": each} for each in ("wall", "wall_d2", "wall_d10", "wall_deep", "other")])
    assert [each["variant"] for each in repeats.draws("wall")] == ["wall", "wall_d2", "wall_d10"]
    assert write.number(-0.001, 1) == "0.0" and write.number(None) == "-" and write.number(12.345, 1) == "12.3"

    done = subprocess.run([root / "workflows/verification/write", "--check", "--bin", programs])
    assert done.returncode == 0
    print("ok")


if __name__ == "__main__":
    main()
