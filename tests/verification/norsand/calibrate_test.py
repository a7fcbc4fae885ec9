"""fem_solver calibrate with triaxial tests from the outside: the shipped example, its figures, and files that are no test."""
import json
import os
import pathlib
import shutil
import subprocess
import sys
import tempfile

root, bin_folder = pathlib.Path(os.environ["BREACH_ROOT"]), pathlib.Path(os.environ["BREACH_BIN"])
documents = root / "workflows" / "element_tests"
truth = {"Gamma": 1.2, "lambda": 0.06, "M_tc": 1.47, "N": 0.5, "chi_tc": 3.2, "H_0": 75}
band = {"Gamma": 0.02, "lambda": 0.009, "M_tc": 0.01, "N": 0.08, "chi_tc": 0.26, "H_0": 19}  # as in calibration_test.cpp


def fem_solver(*arguments):
    return subprocess.run([bin_folder / "fem_solver", *map(str, arguments), "--progress", "none"], capture_output=True, text=True)


def main():
    with tempfile.TemporaryDirectory() as folder:
        out = pathlib.Path(folder)
        done = fem_solver("calibrate", documents / "calibrate_norsand.json", "--output", out / "fit")
        assert done.returncode == 0, done.stderr
        result = json.loads((out / "fit" / "result.json").read_text())
        found = result["norsand_calibration"]
        assert result["flags"] == [], result["flags"]
        for name, value in truth.items():
            each = found["parameters"][name]
            print(f"{name} {each['value']:.5g} +- {each['standard_error']:.2g}, made with {value}")
            assert abs(each["value"] - value) < band[name] and each["origin"] == "fitted"
        short = [name for name, test in found["tests"].items() if not test["critical_state"]]
        assert short == ["cd1", "cd4"] and not set(short) & set(found["parameters"]["Gamma"]["tests"]), short
        assert all(test["misfit"]["q_over_peak"] < 0.08 for test in found["tests"].values())

        # The result is a law that element-test accepts.
        document = out / "found.json"
        document.write_text(json.dumps({
            "format": "breachline-element-test/1", "name": "found", "law": {**found["law"], "psi_0": 0.04},
            "tests": {"a": {"type": "monotonic", "sigma_v_kPa": [100], "strain": 0.05, "K0": 1, "boundary": "undrained_compression"}}}))
        done = fem_solver("element-test", document, "--output", out / "found")
        assert done.returncode == 0, done.stderr

        drawn = subprocess.run([bin_folder / "report", "element-test", out / "fit", "--output", out / "figures"], capture_output=True, text=True)
        assert drawn.returncode == 0, drawn.stderr
        figures = {file.stem for file in (out / "figures").glob("*.svg")}
        assert figures == {"drained_stress_strain", "drained_volume", "undrained_stress_strain", "undrained_pore_pressure", "stress_paths",
                           "critical_state_line", "dilatancy", "stress_dilatancy"}, figures
        table = (out / "figures" / "drained_volume.csv").read_text()
        assert "cd1, measured" in table and "cd1, computed" in table and "cu7" not in table

        # Every invalid file: place and words of the fault.
        good = (documents / "synthetic_silt" / "cd1.csv").read_text().splitlines()
        first = next(i for i, line in enumerate(good) if line.startswith("epsilon_1"))
        rows = good[first + 1:]
        spoilt = documents / "calibrate_norsand.json"

        def refused(what, text, words, line, boundary="drained_compression", **entries):
            shutil.copytree(documents / "synthetic_silt", out / what / "synthetic_silt")
            document = json.loads(spoilt.read_text())
            document["norsand_calibration"]["tests"]["cd1"].update(boundary=boundary, **entries)
            if text is not None:
                (out / what / "synthetic_silt" / "cd1.csv").write_bytes(text if isinstance(text, bytes) else text.encode())
            (out / what / "document.json").write_text(json.dumps(document))
            bad = fem_solver("calibrate", out / what / "document.json", "--output", out / what / "fit")
            said = next((each for each in bad.stderr.splitlines() if "/tests/cd1" in each), bad.stderr)
            print(what + ":", said)
            assert bad.returncode == 65, (what, bad.returncode, bad.stderr)
            assert words in bad.stderr and (line is None or f"cd1.csv, line {line}:" in bad.stderr), (what, bad.stderr)
            assert not (out / what / "fit").exists()

        def table_of(lines, names="epsilon_1,q_kPa,epsilon_v"):
            return "\n".join([names, *lines]) + "\n"

        def per_cent(*columns):
            return [",".join(str(100 * float(value)) if i in columns else value for i, value in enumerate(row.split(","))) for row in rows]

        refused("no-column", table_of(rows, "epsilon_1,q_kPa,volume"), "no column epsilon_v", 1)
        refused("no-names", table_of(rows[1:], rows[0]), "no column epsilon_1", 1)
        refused("twice", table_of(rows, "epsilon_1,q_kPa,q_kPa"), "occurs twice", 1)
        refused("both-per-cent", table_of(per_cent(0, 2)), "per cent?", None)
        refused("per-cent", table_of(per_cent(0)), "per cent?", next(i + 2 for i, row in enumerate(rows) if 100 * float(row.split(",")[0]) > 0.6))
        refused("volume-per-cent", table_of(per_cent(2)), "per cent?", None)
        refused("unsorted", table_of(rows[:10] + [rows[11], rows[10]] + rows[12:]), "does not ascend", 13)
        refused("nan", table_of(rows[:20] + ["0.02,nan,0.001"] + rows[21:]), "'nan', not a finite number", 22)
        refused("gap", table_of(rows[:20] + ["0.02,,0.001"] + rows[21:]), "'', not a finite number", 22)
        refused("short-row", table_of(rows[:20] + ["0.02,100"] + rows[21:]), "2 values under 3 columns", 22)
        refused("empty", "", "holds 0 rows", 1)
        refused("names-only", table_of([]), "holds 0 rows", 1)
        refused("few-rows", table_of(rows[:12]), "holds 12 rows", 13)
        refused("early-end", table_of(rows[:20]), "the test ends at epsilon_1", 21)
        refused("binary", b"\x89HDF\r\n\x1a\n\x00\x00\x00" * 20, "no column epsilon_1", 1)
        refused("no-text", table_of(rows[:5]).encode() + b"\x00\x01\x02" * 20, "is no text", 7)
        refused("another-table", (documents.parent / "motions" / "synthetic.csv").read_bytes(), "no column epsilon_1", None)
        refused("no-file", None, "cannot be read", None, file="synthetic_silt/cd0.csv")
        refused("a-folder", None, "cannot be read", None, file="synthetic_silt")
        refused("undrained", None, "no column u_kPa", None, boundary="undrained_compression")
        refused("pascals", None, "q reaches only", None, p_0_kPa=100000)

        bad = fem_solver("element-test", spoilt, "--output", out / "bad")
        assert bad.returncode == 65 and "run fem_solver calibrate" in bad.stderr, bad.stderr
        bad = fem_solver("calibrate", spoilt, "--output", out / "bad", "--set", "/norsand_calibration/given/Gamma=1.2")
        assert bad.returncode == 65 and "/norsand_calibration/given" in bad.stderr, bad.stderr
        bad = fem_solver("calibrate", spoilt, "--output", out / "bad", "--set", '/law={"type":"linear_elastic","E_MPa":1,"nu":0.3}')
        assert bad.returncode == 65 and "given together" in bad.stderr, bad.stderr


sys.exit(main())
