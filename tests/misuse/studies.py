"""Wrong studies, as (name, study, regular expression for the refusal)."""
import copy


def studies(bases):
    def study(base="slope", **entries):
        whole = {"format": "breachline-study/1", "name": "wrong", "title": "A wrong study", "scene": copy.deepcopy(bases[base]),
                 "transfer_times": [0.5]}
        whole.update(entries)
        return {key: value for key, value in whole.items() if value is not None}

    broken = copy.deepcopy(bases["slope"])
    broken["materials"]["slope_soil"]["density"] = -5
    return [
        ("a scene sent as a study", copy.deepcopy(bases["slope"]), r"scene, not a study|is a scene"),
        ("a study without a scene", study(scene=None), r"scene"),
        ("a transfer after the FEM's end", study(transfer_times=[50]), r"transfer_times|end"),
        ("a transfer time in ms", study(transfer_times=[500]), r"transfer_times[\s\S]*for 500 ms, write 0\.5"),
        ("a step of zero", study(transfer_times={"from": 0.1, "to": 0.7, "step": 0}), r"step"),
        ("an override of nothing", study(overrides=["/mpm/no_such=3"]), r"no_such"),
        ("an override that is no pointer", study(overrides=["cell_size=3"]), r"cell_size"),
        ("an override of a misspelt material", study(overrides=["/materials/slope_soli/law/c_kPa=5"]),
         r"no material \"slope_soli\"[\s\S]*did you mean \"slope_soil\""),
        ("an override of a stage that is not there", study(overrides=["/fem/stages/7/duration=2"]), r"has \d+ stages, 0 to \d"),
        ("a factor on a misspelt material", study(uncertainty={"samples": 4, "parameters": [
            {"name": "c", "factor_on": ["/materials/slope_soli/law/c_kPa"], "distribution": {"type": "lognormal", "median": 1, "cov": 0.3}}]}),
         r"did you mean \"slope_soil\""),
        ("two variants of one name", study(variants=[{"name": "a", "overrides": ["/mpm/cfl=0.5"]},
                                                     {"name": "a", "overrides": ["/mpm/cfl=0.3"]}]), r"\ba\b|twice|unique"),
        ("a later variant's material", study(variants=[{"name": "a", "overrides": ["/mpm/cfl=0.5"]},
                                                       {"name": "b", "overrides": ["/section/regions/1/material=\"clay\""]}]), r"clay"),
        ("a later variant's motion", study("mochikoshi", transfer_times=[4], variants=[
            {"name": "a", "overrides": ["/mpm/cfl=0.3"]},
            {"name": "b", "overrides": ["/fem/motion/file=\"/nowhere/record.csv\""]}]), r"record\.csv"),
        ("a trigger of a field that is not there", study(triggers=[{"kind": "criterion", "name": "t", "when": "pore_joy > 1"}]), r"pore_joy"),
        ("a trigger that is never true", study(triggers=[{"kind": "criterion", "name": "t", "when": "strained_share > 5"}]),
         r"strained_share > 5[\s\S]*from 0 to 1"),
        ("a displacement in mm in a trigger", study(triggers=[{"kind": "criterion", "name": "t", "when": "crest_displacement > 1000"}]),
         r"crest_displacement > 1000[\s\S]*from 0 to 500"),
        ("a strength in the place of a factor", study(uncertainty={"samples": 4, "parameters": [
            {"name": "c", "factor_on": ["/materials/slope_soil/law/c_kPa"], "distribution": {"type": "lognormal", "median": 12, "cov": 0.2}}]}),
         r"19 of 20 samples[\s\S]*sets"),
        ("a breach width in mm", study(overrides=["/mpm/breach_width=72000"]), r"breach_width[\s\S]*5000"),
        ("a coefficient of variation of 30 for 0.30", study(uncertainty={"samples": 4, "parameters": [
            {"name": "c", "factor_on": ["/materials/slope_soil/law/c_kPa"], "distribution": {"type": "lognormal", "median": 1, "cov": 30}}]}),
         r"cov[\s\S]*%[\s\S]*0\.3"),
        ("a line of a transfer that is not asked for", study("mochikoshi", transfer_times=[4], overrides=[
            "/transfer/liquefied/line=[{\"transfer_time\":4,\"points\":[[60,5],[100,2]]},{\"transfer_time\":5,\"points\":[[60,5],[100,2]]}]"]),
         r"line/1/transfer_time"),
        ("no draws", study(draws=0), r"draws"),
        ("draws by halves", study(draws=2.5), r"draws"),
        ("more draws than anyone waits for", study(draws=5000), r"draws"),
        ("draws of one point per element", study(draws=3, overrides=["/transfer/points_per_direction=1"]), r"/draws[\s\S]*points_per_direction 2"),
        ("faults of study and scene at once", study(scene=broken, transfer_times=[-1]), r"density[\s\S]*transfer_times|transfer_times[\s\S]*density"),
    ]
