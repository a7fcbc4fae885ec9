"""Ends of the model that nature does not have are named where they act: walls, the end of the ground, an upstream end too
near, a support below the section. Banks that stand, stand, and what a flag advises works on the scene that raised it."""
import json, os, subprocess, sys, tempfile

BIN = os.environ["BREACH_BIN"]
SOLVER = os.path.join(BIN, "mpm_solver")


def soil(c, phi, nu=0.3, E=20.0, **more):
    return {"density": 1800, "law": {"type": "mohr_coulomb", "E_MPa": E, "nu": nu, "c_kPa": c, "phi_deg": phi, **more}}


def column(**mpm):
    """10 m wide, 20 m high; runs 30.8 m."""
    return {"format": "breachline-scene/1", "name": "column", "materials": {"s": soil(1, 30)},
            "section": {"element_size": 1, "regions": [{"name": "s", "material": "s",
                        "polygon": [[0, 0], [10, 0], [10, 20], [0, 20], [0, 0]]}]},
            "mpm": {"cell_size": 1, "domain_x": [0, 60], "domain_y": [0, 24],
                    "floor": {"level": 0, "friction": [{"from": 0, "to": 60, "coefficient": 0.5}]}, "duration": "until_rest",
                    "runout": {"toe": [10, 0]}, "fill_stress": "overburden", **mpm}}


def bank(c, face, nu=0.45, E=10.0, width=10.0, height=5.0, **law):
    """Bank with undrained strength c [kPa], without tension; its face is `face` metres long in plan."""
    foot = width + face
    return {"format": "breachline-scene/1", "name": "bank",
            "materials": {"s": soil(c, 0, nu, E, **{"tension_cutoff_kPa": 0, **law})},
            "section": {"element_size": 0.5, "regions": [{"name": "s", "material": "s", "polygon": [
                [0, 0], [foot, 0], [width, height], [0, height], [0, 0]]}]},
            "mpm": {"cell_size": 0.5, "domain_x": [0, 40], "domain_y": [-1, 2 * height], "left": "roller", "right": "roller",
                    "floor": {"level": 0}, "duration": "until_rest", "runout": {"toe": [foot, 0]},
                    "fill_stress": "overburden", "fill_points": 2}}


class Run:
    def __init__(self, scratch, scene, *more):
        name = tempfile.mkdtemp(dir=scratch)
        file = os.path.join(name, "scene.json")
        json.dump(scene, open(file, "w"))
        ended = subprocess.run([SOLVER, file, "--output", os.path.join(name, "out"), "--progress", "none", *more],
                               capture_output=True, text=True)
        self.code, self.log = ended.returncode, ended.stderr
        self.result = json.load(open(os.path.join(name, "out/result.json"))) if self.code == 0 else None

    def flag(self, code):
        return next((each for each in self.result["flags"] if each["code"] == code), None)


def test_walls(scratch):
    free = Run(scratch, column())
    runout = free.result["runout"]
    assert abs(runout / 30.8 - 1) < 0.05, runout
    assert free.flag("reached_wall") is None and not free.result["questionable"], free.result["flags"]
    assert free.flag("upstream_wall")["severity"] == "warning", "a column at a wall may be meant: a warning"
    walled = Run(scratch, column(domain_x=[0, 25], right="roller"))
    flag = walled.flag("reached_wall")
    assert walled.result["runout"] < 0.6 * runout and flag["severity"] == "questionable" and "x = 25 m" in flag["message"], flag
    # The advice, copied from the message.
    wider = json.loads(flag["message"].split("/mpm/domain_x=")[1].split("'")[0])
    again = Run(scratch, column(domain_x=wider, right="roller"))
    assert again.flag("reached_wall") is None and abs(again.result["runout"] / runout - 1) < 0.05, (wider, again.result["runout"])
    print(f"roller at 25 m: {walled.result['runout']:.1f} m, flagged; with the domain that the flag advises {again.result['runout']:.1f} m of {runout:.1f} m")


def test_end_of_the_ground(scratch):
    """A column on 3 m of firm ground that ends in a step 15 m beyond its toe, half as far as the column runs."""
    def on_ground(end, **mpm):
        friction = [{"from": 0, "to": 100, "coefficient": 0.5}]
        scene = column(**{"domain_x": [0, 100], "domain_y": [-5, 24], "floor": {"level": -3, "friction": friction},
                          "runout": {"toe": [10, 0], "regions": ["s"]}, **mpm})
        scene["materials"]["firm"] = {"density": 2000, "law": {"type": "linear_elastic", "E_MPa": 100, "nu": 0.3}}
        scene["section"]["regions"].append({"name": "ground", "material": "firm",
                                            "polygon": [[0, -3], [end, -3], [end, 0], [10, 0], [0, 0], [0, -3]]})
        return scene

    whole = Run(scratch, on_ground(100))
    assert whole.flag("reached_wall") is None, whole.result["flags"]
    short = Run(scratch, on_ground(25))
    flag = short.flag("reached_wall")
    assert flag and flag["severity"] == "questionable" and flag["pointer"] == "/section/regions", short.result["flags"]
    assert "end of the section's ground (x = 25 m), where the model drops by 3 m" in flag["message"], flag
    # The advice, copied from the message.
    beyond = json.loads("[" + flag["message"].split("[..., ")[1].split("]]")[0] + "]]")
    floor = {"level": -5, "friction": [{"from": 0, "to": 100, "coefficient": 0.5}]}
    advised = Run(scratch, on_ground(25, floor=floor, terrain=[[0, -3], *beyond]))
    runouts = [each.result["runout"] for each in (whole, short, advised)]
    print("ground to 100 m: {:.1f} m; to 25 m: {:.1f} m, flagged; with the terrain that the flag advises {:.1f} m".format(*runouts))
    assert advised.flag("reached_wall") is None and abs(runouts[2] / runouts[0] - 1) < 0.1, advised.result["flags"]


def test_support_below_the_section(scratch):
    for gap, more in ((5, {"domain_y": [-8, 24], "floor": {"level": -7, "friction": [{"from": 0, "to": 60, "coefficient": 0.5}]},
                           "terrain": [[0, -5], [60, -5]]}),
                      (1, {"domain_y": [-2, 24], "floor": {"level": -1, "friction": [{"from": 0, "to": 60, "coefficient": 0.5}]}})):
        run = Run(scratch, column(duration=0.5, **more))
        flag = run.flag("implausible")
        assert flag and f"lies up to {gap} m above" in flag["message"] and "from x = 0 to 10 m" in flag["message"], flag
    assert Run(scratch, column(duration=0.5)).flag("implausible") is None
    print("a floor 1 m and a terrain 5 m below the section: flagged with size and place")


def test_breakdown_repeats_warnings(scratch):
    short = column(floor={"level": 0, "friction": [{"from": 0, "to": 20, "coefficient": 0.5}]})
    run = Run(scratch, short)
    assert run.code == 70 and "no zone covers x = 20 to 60 m" in run.log.split("breakdown")[-1], run.log
    print("friction that ends at x = 20: the breakdown repeats the warning")


def test_banks(scratch):
    """Undrained banks at a factor of safety of 1.6 and more stand, and rest within seconds; below 1 they do not stand."""
    # Vertical, 5 m: F = 3.83 c / (gamma H) (Taylor 1937), gamma H = 88.3 kPa.
    for name, scene in (("vertical, c 300 kPa", bank(300, 0)), ("vertical, nu 0.3", bank(300, 0, nu=0.3)),
                        ("vertical, F 1.6", bank(37, 0)), ("vertical, stiff", bank(100, 0, E=100)),
                        ("45 degrees, c 60 kPa", bank(60, 5)), ("45 degrees, nu 0.49", bank(60, 5, nu=0.49))):
        run = Run(scratch, scene)
        print(f"{name}: runout {run.result['runout']:+.3f} m, at rest after {run.result['end_time']:.1f} s, {[each['code'] for each in run.result['flags']]}")
        assert run.result["at_rest"] and run.result["end_time"] < 10 and not run.result["questionable"], run.result["flags"]
        assert run.result["runout"] < 0.1 and abs(run.result["volume_ratio"] - 1) < 0.02, (run.result["runout"], run.result["volume_ratio"])
    failing = Run(scratch, bank(12, 0))
    print(f"vertical, F 0.52: runout {failing.result['runout']:+.2f} m")
    assert failing.result["runout"] > 0.5, failing.result["runout"]


def test_advice(scratch):
    """Applies the advice to the scenes that raise the flags."""
    torn = Run(scratch, bank(300, 0), "--set", "/mpm/tension_share=0", "--set", "/mpm/damping_ratio=0")
    assert torn.flag("volume_ratio") and torn.result["runout"] > 3, torn.result["flags"]
    for code in ("volume_ratio", "numerical_share"):
        assert "/mpm/tension_share=0.03" in torn.flag(code)["message"], torn.flag(code)
    mended = Run(scratch, bank(300, 0), "--set", "/mpm/tension_share=0.03", "--set", "/mpm/damping_ratio=0")
    assert not mended.flag("volume_ratio") and mended.result["runout"] < 0.1, mended.result["runout"]
    ringing = Run(scratch, bank(60, 5), "--set", "/mpm/damping_ratio=0", "--set", "/mpm/longest_duration=20")
    assert "/mpm/damping_ratio=0.1" in ringing.flag("still_moving")["message"], ringing.result["flags"]
    rests = Run(scratch, bank(60, 5), "--set", "/mpm/damping_ratio=0.1", "--set", "/mpm/longest_duration=20")
    assert rests.result["at_rest"] and not rests.flag("still_moving"), rests.result["flags"]
    print("advised tension: stands; advised damping: rests")


if __name__ == "__main__":
    if not os.path.exists(SOLVER):
        print("mpm_solver is not built")
        sys.exit(77)
    with tempfile.TemporaryDirectory() as scratch:
        test_walls(scratch)
        test_end_of_the_ground(scratch)
        test_banks(scratch)
        test_advice(scratch)
        test_support_below_the_section(scratch)
        test_breakdown_repeats_warnings(scratch)
