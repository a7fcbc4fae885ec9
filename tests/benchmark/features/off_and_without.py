#!/usr/bin/python3
"""What being off costs: instructions per step of a scene with every feature off, in the program as it is and in one built without
the code that asks for them.

    off_and_without.py [FOLDER] [--program fem_solver|mpm_solver] [--most PER_CENT]
    off_and_without.py --check      builds nothing: are all the texts that are taken out there?

Copies the sources to FOLDER, takes out what EDITS says, builds as the release is built, and counts this program and that of BREACH_BIN by
valgrind as what_is_left_out.py does; fails where off costs more than --most. Both programs must give the same result, to the last digit: what was taken out did nothing. An edit whose text is not in the
source stops the script: the source has changed, and so must the edit."""
import argparse
import copy
import json
import os
import pathlib
import shutil
import subprocess
import tempfile

import what_is_left_out as features

root = features.root

# Feature, file, what stands there, what would stand there in a program that has not got the feature.
MPM_STEP, MPM_RUN = "mpm_solver/step.cpp", "mpm_solver/simulation.cpp"
NEWTON, STEP = "fem_solver/solve/newton.cpp", "fem_solver/solve/step.cpp"
MATRIX = "fem_solver/solve/linear_system.cpp"
EDITS = {
    "mpm_solver": [
        ("viscosity and damping", MPM_STEP, "    body.tally.viscous += for_all_points(body, &Loops::dissipate, Writes::own_points, dt).viscous;\n", ""),
        ("nonlocal softening", MPM_STEP, "    if (body.softening.is_on()) body.softening.follow(body.points, body.zones, body.grid);\n", ""),
        ("anti-locking", MPM_STEP, "    average(body, &CellSum::trD);\n", ""),
        ("anti-locking", MPM_STEP, "    average(body, &CellSum::sigma_m);\n", ""),
        ("anti-locking", MPM_STEP, "    forget_averages(body);\n", ""),
        ("anti-locking", MPM_STEP, "/// Totals of one kind in the cells become averages over their volume.\n"
         "void average(", "[[maybe_unused]] void average("),
        ("friction zones", MPM_STEP, "    if (must & condition::floor) work += rub(m, grid.friction[node / grid.rows], v_before, v);\n", ""),
        ("friction zones", MPM_STEP, "double rub(double m, double mu,", "[[maybe_unused]] double rub(double m, double mu,"),
        ("terrain", MPM_STEP, "    if (must & condition::terrain) {\n        if (must & condition::hold_x) {\n            v.y() = std::max(v.y(), 0.0);\n        } else {\n"
         "            work += rub(grid.contacts[grid.contact_of[node]], m, v_before, v);\n        }\n    }\n    if (must & condition::hold_y) v.y() = 0.0;\n    return work;\n", ""),
        ("terrain", MPM_STEP, "    const double m = grid.mass[node];\n    double work = 0.0;\n", ""),
        ("terrain", MPM_STEP, "double bear(const Grid& grid, std::int32_t node, const Vec2& v_before, Vec2& v) {", "void bear(const Grid& grid, std::int32_t node, const Vec2&, Vec2& v) {"),
        ("terrain", MPM_STEP, "friction_work += bear(grid, node, v_before, v);", "bear(grid, node, v_before, v);"),
        ("terrain", MPM_STEP, "    double friction_work = 0.0;\n", ""),
        ("terrain", MPM_STEP, "    body.tally.friction += friction_work;\n", ""),
        ("overlap correction", MPM_RUN, "    if (mpm_.overlap_correction.rate > 0.0 && clock_.step % steps_between_marks == 0) {\n"
         "        overlap_.mark(body_, mpm_.overlap_correction.tolerance);\n    }\n", ""),
        ("gaps held to their room", MPM_RUN, "    if (mpm_.gap_closure && mpm_.gap_room && clock_.step % steps_between_marks == 0) {\n"
         "        overlap_.hold_gaps_to_room(body_);\n    }\n", ""),
    ],
    "fem_solver": [
        ("water", NEWTON, "    matrix_.add_water(rule);\n", ""),
        ("water", NEWTON, "    if (unknowns().pressures() > 0) add_water(problem, trial);\n", ""),
        ("water", NEWTON, "    const double c_v = problem.rule.c_v;\n    for (std::size_t i = 0; i < n.of_pressure.size(); ++i) {\n"
         "        const std::int32_t row = n.of_pressure[i];\n"
         "        if (row >= 0) residual_[row] -= R_p_[static_cast<Eigen::Index>(i)] / c_v;\n    }\n", ""),
        ("water", NEWTON, "void Newton::gather_residual(const StepProblem& problem) {", "void Newton::gather_residual(const StepProblem&) {"),
        ("water", NEWTON, "    for (std::size_t i = 0; i < n.of_pressure.size(); ++i) {\n        const std::int32_t row = n.of_pressure[i];\n"
         "        if (row >= 0) trial.p[static_cast<Eigen::Index>(i)] += correction_[row];\n    }\n", ""),
        ("water", NEWTON, "    const std::int32_t n_u = unknowns().displacements, n_p = unknowns().pressures();\n",
         "    const std::int32_t n_u = unknowns().displacements;\n"),
        ("water", NEWTON, "    const double of_force = reference > 0.0 ? force / reference : force;\n    if (n_p == 0) return of_force;\n"
         "    const double exchange = std::max(exchanged_.norm(), water_rounding_ / settings_.tolerance);\n    const double volume =\n"
         "        problem.rule.c_v * residual_.tail(n_p).cwiseProduct(share_.tail(n_p)).norm();\n"
         "    return std::max(of_force, exchange > 0.0 ? volume / exchange : 0.0);\n",
         "    return reference > 0.0 ? force / reference : force;\n"),
        ("dashpots", NEWTON, "    if (model_.base.any()) matrix_.add_diagonal(rule.c_v, model_.base.dashpot);\n", ""),
        ("dashpots", NEWTON, "        if (model_.base.any()) R_u_.array() -= model_.base.dashpot.array() * trial.v.array();\n", ""),
        ("dashpots", STEP, "    if (model.base.any()) model.base.add_force(time, force);\n", ""),
        ("Rayleigh damping", NEWTON, "        if (elastic_) {\n"
         "            internal_force_.add_elastic_stiffness(rule.c_v * model_.rayleigh.stiffness, matrix_);\n        }\n", ""),
        ("Rayleigh damping", NEWTON, "rule.c_a + rule.c_v * model_.rayleigh.mass, model_.mass", "rule.c_a, model_.mass"),
        ("Rayleigh damping", NEWTON, "        if (model_.rayleigh.mass > 0.0) {\n            R_u_.array() -=\n"
         "                model_.mass.array() * (trial.a.array() + model_.rayleigh.mass * trial.v.array());\n"
         "        } else {\n            R_u_.array() -= model_.mass.array() * trial.a.array();\n        }\n"
         "        if (elastic_) elastic_->add_product(-model_.rayleigh.stiffness, trial.v, R_u_);\n",
         "        R_u_.array() -= model_.mass.array() * trial.a.array();\n"),
        ("free field", NEWTON, "    if (share_of_dof_.size() == 0) return per_dof.norm();\n"
         "    return (share_of_dof_.array() * per_dof.array()).matrix().norm();\n", "    return per_dof.norm();\n"),
        ("free field", NEWTON, "    if (model_.row_weight.size() > 0) R_u_.array() *= model_.row_weight.array();\n", ""),
        ("viscosity", NEWTON, "    if (viscous_.size() > 0) internal_force_.add_viscous_damping(rule.c_v, matrix_);\n", ""),
        ("viscosity", NEWTON, "        if (viscous_.size() > 0) {\n            viscous_.setZero();\n"
         "            internal_force_.add_viscous_force(1.0, trial.v, viscous_);\n            R_u_ -= viscous_;\n        }\n", ""),
        ("laws with memory", NEWTON, "    const bool of_ends = !problem.old.memory.empty();\n", "    constexpr bool of_ends = false;\n"),
    ],
}


def mpm_off(folder):
    """The scene of what_is_left_out.py with every feature off."""
    scene = features.mpm_scene(folder)
    for switch_off, _ in features.MPM.values():
        switch_off(scene)
    scene["section"]["regions"][0]["polygon"] = features.rectangle(5, 4, 15, 14)  # on the floor, where the terrain was
    return scene


def fem_off(folder):
    scene = features.fem_scene(folder)
    for name, (switch_off, _) in features.FEM.items():
        if name == "plasticity":  # the law stays: without it there would be nothing to iterate on
            continue
        if name == "watch of liquefaction" and "liquefaction" not in scene["fem"]:
            continue
        switch_off(scene)
    return scene


SCENES = {"mpm_solver": mpm_off, "fem_solver": fem_off}
NOT_COPIED = ("build", ".git")


def build(folder, program):
    launcher = [f"-DCMAKE_{language}_COMPILER_LAUNCHER=ccache" for language in ("C", "CXX")] if shutil.which("ccache") else []
    subprocess.run(["cmake", "--preset", "release", "-DBREACH_TESTS=OFF", *launcher], cwd=folder, check=True, stdout=subprocess.DEVNULL)
    subprocess.run(["cmake", "--build", folder / "build/release", "--target", program], check=True, stdout=subprocess.DEVNULL)
    return folder / "build/release/bin"


def copy_sources(folder):
    for name in (each.name for each in root.iterdir() if each.name not in NOT_COPIED):
        if (root / name).is_dir():
            shutil.copytree(root / name, folder / name, dirs_exist_ok=True)
        else:
            folder.mkdir(parents=True, exist_ok=True)
            shutil.copy2(root / name, folder / name)


def stripped_texts(folder, program):
    texts = {}
    for feature, name, old, new in EDITS[program]:
        text = texts.get(name) or (folder / name).read_text()
        if text.count(old) != 1:
            raise SystemExit(f"{name} has not this text once, which is {feature}'s:\n{old}")
        texts[name] = text.replace(old, new)
    return texts


def answer(program, programs, scene, folder):
    """Instructions per step, and the results but for what tells time and place."""
    features.programs = programs
    count = features.per_step(program, copy.deepcopy(scene), folder)
    result = json.loads((folder / "out/result.json").read_text())
    return count, {key: value for key, value in result.items() if "second" not in key and key not in ("peak_memory_MB", "provenance")}


def row_of(program, folder):
    whole, folder = features.programs, folder / program
    copy_sources(folder)
    for name, text in stripped_texts(folder, program).items():
        (folder / name).write_text(text)
    stripped = build(folder, program)
    with tempfile.TemporaryDirectory() as name:
        scene = SCENES[program](pathlib.Path(name))
        off, result = answer(program, whole, scene, pathlib.Path(name))
        without, same = answer(program, stripped, scene, pathlib.Path(name))
    features.programs = whole
    if result != same:
        different = "\n".join(f"{key}: {value} and {same.get(key)}" for key, value in result.items() if value != same.get(key))
        raise SystemExit(f"{program}: the results differ, so what was taken out was at work\n{different}")
    named = ", ".join(dict.fromkeys(edit[0] for edit in EDITS[program]))
    cost = 100 * (off / without - 1)
    return f"| {program} | {off:,.0f} | {without:,.0f} | {cost:.2f} % | {named} |", cost


def main():
    options = argparse.ArgumentParser()
    options.add_argument("folder", type=pathlib.Path, nargs="?")
    options.add_argument("--program", choices=list(EDITS))
    options.add_argument("--most", type=float, default=float("inf"), metavar="PER_CENT")
    options.add_argument("--check", action="store_true")
    asked = options.parse_args()
    chosen = [asked.program] if asked.program else list(EDITS)
    if asked.check:
        for program in chosen:
            stripped_texts(root, program)
        return
    with tempfile.TemporaryDirectory() as name:
        rows = []
        for program in chosen:
            rows.append(row_of(program, asked.folder or pathlib.Path(name)))
            print(rows[-1][0], flush=True)
    if any(cost > asked.most for _, cost in rows):
        raise SystemExit(f"off costs more than {asked.most} %")


if __name__ == "__main__":
    main()
