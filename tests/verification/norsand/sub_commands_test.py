"""fem_solver element-test with NorSand from the outside: results, files, refusals and flags."""
import json
import os
import pathlib
import subprocess
import sys
import tempfile

root, bin_folder = pathlib.Path(os.environ["BREACH_ROOT"]), pathlib.Path(os.environ["BREACH_BIN"])
document = root / "workflows" / "element_tests" / "loose_silt.json"
CJ1 = {"type": "norsand", "Gamma": 0.9, "lambda": 0.02, "M_tc": 1.2, "N": 0.3, "chi_tc": 3.5, "H_0": 300, "G_ref_MPa": 30, "m": 1,
       "nu": 0.15, "psi_0": 0.05}


def element_test(file, out, *arguments):
    return subprocess.run([bin_folder / "fem_solver", "element-test", str(file), "--output", str(out), "--progress", "none", *arguments],
                          capture_output=True, text=True)


def test(**entries):
    return {"type": "monotonic", "sigma_v_kPa": [100], "K0": 1, "boundary": "undrained_compression", "strain": 0.01, **entries}


def main():
    with tempfile.TemporaryDirectory() as folder:
        out = pathlib.Path(folder)
        done = element_test(document, out / "silt")
        assert done.returncode == 0, done.stderr
        result = json.loads((out / "silt" / "result.json").read_text())
        assert not result.get("flags"), result["flags"]
        for name in ("undrained_compression", "undrained_extension", "undrained_shear"):
            for row in result["tests"][name]:
                assert row["complete"] and row["S"] == 1
                assert abs(row["response_kPa"] / row["critical_response_kPa"] - 1) < 1e-3, (name, row)
        # Of the reference's convergence.csv: CJ2, DSS, 100 kPa, psi_0 0.08, K0 0.7, S 1.
        shear = result["tests"]["undrained_shear"][0]
        print("DSS peak", shear["peak_kPa"], "of 21.76443 kPa; last", shear["response_kPa"], "of 15.23753 kPa")
        assert abs(shear["peak_kPa"] / 21.764426 - 1) < 2e-4 and abs(shear["response_kPa"] / 15.2375325 - 1) < 2e-4
        completed = json.loads((out / "silt" / "scene.completed.json").read_text())
        assert completed["law"]["flow"] == "js" and completed["tests"]["drained_compression"]["S"] == 0

        def run(name, law, **tests):
            file = out / f"{name}.json"
            file.write_text(json.dumps({"format": "breachline-element-test/1", "name": name, "law": law, "tests": tests}))
            return element_test(file, out / name)

        def refused(name, pointer, words, law, **tests):
            bad = run(name, law, **tests)
            print(name + ":", next((line for line in bad.stderr.splitlines() if pointer in line), bad.stderr))
            assert bad.returncode == 65, (name, bad.returncode, bad.stderr)
            assert pointer in bad.stderr and words in bad.stderr, (name, bad.stderr)
            assert not (out / name).exists()

        loose = {key: value for key, value in CJ1.items() if key != "psi_0"}
        refused("no-state", "/tests/a/psi_0", "is missing", loose, a=test())
        refused("two-states", "/tests/a/e_0", "together", CJ1, a=test(psi_0=0, e_0=0.8))
        refused("no-line", "/law/Gamma", "no critical state line", {k: v for k, v in CJ1.items() if k not in ("Gamma", "lambda")}, a=test())
        refused("two-lines", "/law/Gamma", "two critical state lines", {**CJ1, "C_a": 1, "C_b": 0.1, "C_c": 0.4}, a=test())
        refused("singular", "/law/chi_tc", "singular", {**CJ1, "lambda": 0.07, "Gamma": 1.2, "chi_tc": 16}, a=test())
        refused("unit-of-gamma", "/law/Gamma", "1 kPa", {**CJ1, "lambda": 0.06, "Gamma": 1.614}, a=test())
        refused("too-loose", "/tests/a/psi_0", "no stable stress ratio", CJ1, a=test(psi_0=0.3))
        refused("too-dense", "/tests/a/psi_0", "void ratio", CJ1, a=test(psi_0=-0.9))
        refused("outside", "/tests/a/K0", "give K0 above", CJ1, a=test(K0=0.176, boundary="undrained_shear"))
        refused("tiny", "/tests/a/sigma_v_kPa/0", "p_min", CJ1, a=test(sigma_v_kPa=[0.1]))
        refused("cyclic", "/tests/a/type", "monotonic", CJ1, a={"type": "cyclic_strength", "sigma_v_kPa": [100], "CSR": [0.1]})
        refused("triaxial-sand", "/tests/a/boundary", "plane strain", {"type": "pm4sand", "D_R": 0.35, "G_0": 476}, a=test())
        refused("not-norsand", "/tests/a/psi_0", "NorSand alone", {"type": "linear_elastic", "E_MPa": 1, "nu": 0.3}, a=test(psi_0=0))

        doubted = run("drained-softening", CJ1, a=test(boundary="drained_compression", S=1))
        assert doubted.returncode == 0, doubted.stderr
        flags = json.loads((out / "drained-softening" / "result.json").read_text())["flags"]
        assert [each["code"] for each in flags] == ["drained_softening"], flags
        floor = run("floor", CJ1, a=test(psi_0=0.12))
        assert floor.returncode == 0, floor.stderr
        flags = json.loads((out / "floor" / "result.json").read_text())["flags"]
        assert [each["code"] for each in flags] == ["strength_of_floor"], flags
        over = run("over", CJ1, a=test(R=9))
        assert over.returncode == 0, over.stderr
        flags = json.loads((out / "over" / "result.json").read_text())["flags"]
        assert [each["code"] for each in flags] == ["clipped_overconsolidation"], flags
        low = run("low", {**CJ1, "p_min_kPa": 0.001}, a=test(sigma_v_kPa=[0.1], step=2e-5))
        assert low.returncode == 0, low.stderr
        row = json.loads((out / "low" / "result.json").read_text())["tests"]["a"][0]
        assert abs(row["peak_kPa"] / 0.1 / 0.289930 - 1) < 2e-4, row


sys.exit(main())
