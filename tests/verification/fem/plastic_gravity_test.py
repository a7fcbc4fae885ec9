"""A plastic gravity stage ends with stresses that PM4Sand can carry, in equilibrium: what elastic gravity leaves outside
its surfaces is found a place by friction before the law begins."""
import json
import os
import pathlib
import sys
import tempfile

sys.path.insert(0, str(pathlib.Path(__file__).parent))
import coarse_slope
from runs import judge, run

PLASTIC = {"type": "static", "name": "plastic gravity", "laws": "scene", "permeability": "free_drainage"}


def main():
    solver = f"{os.environ['BREACH_BIN']}/fem_solver"
    with tempfile.TemporaryDirectory() as name:
        folder = pathlib.Path(name)
        file = coarse_slope.write(folder, duration=1.0)
        elastic, before = run(solver, file, folder / "elastic")
        scene = json.loads(file.read_text())
        scene["fem"]["stages"].insert(1, PLASTIC)
        file.write_text(json.dumps(scene))
        plastic, after = run(solver, file, folder / "plastic")
    facts = plastic["geostatic"]["plastic gravity"]
    rest, balance = facts["friction"], facts["out_of_balance"]
    print(f"    friction alone: cohesion down to {rest['cohesion'] / 1e3} kPa in {rest['iterations']} iterations")
    print(f"    stress outside the surfaces: {elastic['stress_bias']} after elastic gravity, {plastic['stress_bias']} after plastic")
    print(f"    crest after 1 s: {before[-1]['crest_dx']:.4f} m, {after[-1]['crest_dx']:.4f} m")
    passed = judge("out of balance when PM4Sand has begun, over the weight", balance, 1e-3)
    passed &= judge("largest stress outside, over that of elastic gravity",
                    plastic["stress_bias"]["largest"] / elastic["stress_bias"]["largest"], 0.25)
    return 0 if passed else 1


sys.exit(main())
