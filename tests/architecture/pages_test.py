"""workflows/verification/write: measured pages equal their templates with their results; the command names results of other inputs,
numerics, commit or machine."""
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


def told(result, measurements):
    return " ".join(write.inconsistencies({"sweep": result, "other": result | {"measured": result["measured"] | {"machine": "another"}}},
                                          measurements, write.numerics(programs)))


def main():
    measurement = {"study": "workflows/studies/column_sweep.json"}
    measurements = {"sweep": measurement, "other": measurement}
    sound = {"measured": {"key": write.key_of(measurement), "numerics": write.numerics(programs), "commit": "12345678", "machine": "one",
                          "cpu_seconds": 1.0}}
    assert told(sound, measurements) == "its results are of more than one machine: another; one", told(sound, measurements)
    for change, words in (({"key": "0"}, "has changed since"), ({"numerics": {"MPM": 1}}, "is of numerics"), ({"commit": "12345678+"}, "in no commit")):
        assert words in told({"measured": sound["measured"] | change}, measurements), change

    raised = {phase: version + 1 for phase, version in write.numerics(programs).items()}
    assert not write.holds_in(sound["measured"], raised)
    assert write.holds_in(sound["measured"] | {"same_in": raised}, raised)

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
