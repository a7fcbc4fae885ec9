"""fem_solver element-test and calibrate from the outside: results, files, refusals."""
import json
import os
import pathlib
import subprocess
import sys
import tempfile

root, bin_folder = pathlib.Path(os.environ["BREACH_ROOT"]), pathlib.Path(os.environ["BREACH_BIN"])
documents = root / "workflows" / "element_tests"


def fem_solver(*arguments):
    return subprocess.run([bin_folder / "fem_solver", *map(str, arguments)], capture_output=True, text=True)


def main():
    with tempfile.TemporaryDirectory() as folder:
        out = pathlib.Path(folder)
        done = fem_solver("element-test", documents / "tailings.json", "--output", out / "tests", "--progress", "none")
        assert done.returncode == 0, done.stderr
        result = json.loads((out / "tests" / "result.json").read_text())
        strengths = [test["response_kPa"] for test in result["tests"]["undrained"]]
        limits = [4.196, 5.827, 9.929]  # for vanishing steps
        print("s_u computed", strengths, "limits", limits)
        assert all(abs(s / limit - 1) < 1e-3 for s, limit in zip(strengths, limits))
        completed = json.loads((out / "tests" / "scene.completed.json").read_text())
        assert completed["law"]["C_Kaf"] > 4 and completed["law"]["compat"] == "corrected"  # defaults are visible
        assert (out / "tests" / "element_tests.h5").stat().st_size > 10000

        document = out / "cohesive.json"
        document.write_text(json.dumps({
            "format": "breachline-element-test/1", "name": "cohesive", "title": "Drucker-Prager without friction",
            "law": {"type": "drucker_prager", "E_MPa": 20, "nu": 0.3, "c_kPa": 10, "phi_deg": 0},
            "tests": {"undrained": {"type": "monotonic", "sigma_v_kPa": [100], "strain": 0.05}}}))
        done = fem_solver("element-test", document, "--output", out / "cohesive", "--progress", "none")
        assert done.returncode == 0, done.stderr
        strength = json.loads((out / "cohesive" / "result.json").read_text())["tests"]["undrained"][0]["response_kPa"]
        print("Drucker-Prager without friction: s_u", strength, "kPa, c 10 kPa")
        assert abs(strength / 10 - 1) < 1e-9

        assert not result.get("flags"), result["flags"]
        assert all(row["complete"] and row["damping"] is not None for row in result["tests"]["modulus_reduction"])

        def run(name, law, **tests):
            file = out / f"{name}.json"
            file.write_text(json.dumps({"format": "breachline-element-test/1", "name": name, "law": law, "tests": tests}))
            return fem_solver("element-test", file, "--output", out / name, "--progress", "none")

        sand = {"type": "pm4sand", "D_R": 0.35, "G_0": 476, "h_po": 2.7}
        loops = {"type": "modulus_reduction", "boundary": "drained_biaxial", "sigma_v_kPa": [100], "cycles": 5, "steps": 20}
        done = run("stopped", sand, a={**loops, "amplitudes": [0.001, 0.05, 0.2]}, b={**loops, "amplitudes": [0.2]})
        assert done.returncode == 0, done.stderr
        rows = json.loads((out / "stopped" / "result.json").read_text())["tests"]["a"]
        print("loops that do and do not end:", rows)
        assert [row["complete"] for row in rows] == [True, False, False]
        assert all((row["G_secant_kPa"] is None) == (row["damping"] is None) == (not row["complete"]) for row in rows)

        cycles = {"type": "cyclic_strength", "boundary": "undrained_biaxial", "sigma_v_kPa": [100], "CSR": [0.05]}
        bad = run("two-shears", sand, a={**cycles, "K0": 1, "static_shear": 0.1})
        assert bad.returncode == 65 and "/tests/a/static_shear" in bad.stderr and "biaxial" in bad.stderr, bad.stderr
        friction = {"E_MPa": 20, "nu": 0.3, "c_kPa": 0, "phi_deg": 30}
        shear = {"type": "monotonic", "boundary": "drained_shear", "sigma_v_kPa": [100], "strain": 0.01}
        for kind in ("mohr_coulomb", "drucker_prager"):
            bad = run("energy", {"type": kind, **friction, "psi_deg": 31}, a=shear)
            assert bad.returncode == 65 and "/law/psi_deg" in bad.stderr, bad.stderr
            for law in ({"type": kind, **friction, "psi_deg": 30}, sand):
                name = f"starts-{kind}-{law['type']}"
                done = run(name, law, inside=shear, sheared={**shear, "static_shear": 0.6}, narrow={**shear, "K0": 0.05})
                assert done.returncode == 0, done.stderr
                flags = json.loads((out / name / "result.json").read_text())["flags"]
                print(name + ":", flags)
                assert [each["code"] for each in flags] == ["starts_outside"] and flags[0]["severity"] == "warning", flags
                assert "in narrow, sheared the" in flags[0]["message"], flags

        done = fem_solver("calibrate", documents / "calibrate_tailings.json", "--output", out / "calibration",
                          "--set", "/calibration/most_evaluations=60", "--progress", "none")
        assert done.returncode == 0, done.stderr
        fit = json.loads((out / "calibration" / "result.json").read_text())["calibration"]
        print("misfit", fit["first"]["misfit"], "->", fit["best"]["misfit"])
        assert fit["best"]["misfit"] < fit["first"]["misfit"]

        bad = fem_solver("element-test", documents / "tailings.json", "--output", out / "bad", "--set", "/law/nu=0.5",
                         "--set", "/law/Dr=1", "--set", "/tests/undrained/strain=-1")
        assert bad.returncode == 65, bad.returncode
        for pointer in ("/law/nu", "/law/Dr", "/tests/undrained/strain"):
            assert pointer in bad.stderr, bad.stderr
        assert not (out / "bad").exists()
        bad = fem_solver("calibrate", documents / "calibrate_tailings.json", "--output", out / "bad", "--set",
                         '/calibration/free={"q":{"least":2,"most":1}}')
        assert bad.returncode == 65 and "/calibration/free/q" in bad.stderr, bad.stderr
        bad = fem_solver("calibrate", documents / "tailings.json", "--output", out / "bad")
        assert bad.returncode == 65 and "/calibration" in bad.stderr, bad.stderr


sys.exit(main())
