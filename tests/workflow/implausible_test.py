"""What is possible and hardly meant is said everywhere: in the plan, in the log, in result.json. What is impossible ends
with exit code 65, and both name the slip of the unit. The warning about a motion states the motion's own numbers."""
import math
import pathlib
import tempfile

from phases import check, coarse_column, result, root, run

column = root / "workflows/scenes/column.json"
short = [*coarse_column, "--set", "/fem/stages/1/duration=0.1"]


def flagged(folder, pointer):
    return [each["message"] for each in result(folder)["flags"]
            if (each["code"], each["severity"], each["pointer"]) == ("implausible", "warning", pointer)]


def soil_in_pascal(folder):
    law = "/materials/sand/law/c_kPa"
    slip = "5000 looks like Pa: write 5 kPa"
    for phase in ("fem_solver", "mpm_solver"):
        plan = run(phase, column, folder / "none", "--set", f"{law}=5000", "--plan")
        check(f"{phase}'s plan names the slip", law in plan.stdout and slip in plan.stdout, plan.stdout + plan.stderr)
    done = run("fem_solver", column, folder / "pascal", *short, "--set", f"{law}=5000")
    check("the run ends well", done.returncode == 0, done.stderr[-2000:])
    check("its log names the slip", f"{law}: 5000 kPa lies outside" in done.stderr and slip in done.stderr, done.stderr[-2000:])
    check("its result names the slip", any(slip in each for each in flagged(folder / "pascal", law)))
    for phase in ("fem_solver", "mpm_solver"):
        done = run(phase, column, folder / "none", "--set", "/materials/sand/density=19")
        check(f"{phase} refuses 19 kg/m3", done.returncode == 65 and "19 looks like kN/m3: write 1937 kg/m3" in done.stderr,
              done.stderr)
    check("and leaves nothing", not (folder / "none").exists())


def shaken(folder, name, pga, header="acceleration_g"):
    """0.4 s of a sine with this peak in the header's unit."""
    file = folder / f"{name}.csv"
    wave = [pga * math.sin(2 * math.pi * k / 20) for k in range(41)]
    file.write_text(f"time_s,{header}\n" + "".join(f"{0.01 * k:.2f},{a:.6f}\n" for k, a in enumerate(wave)))
    return run("fem_solver", column, folder / name, *short, "--set", '/fem/base={"density": 2300, "V_s": 760}',
               "--set", '/fem/motion={"file": "%s"}' % file)


def motion_in_metres(folder):
    done = shaken(folder, "right", 1.962, "acceleration_m_s2")
    check("0.2 g in m/s2 are taken", done.returncode == 0, done.stderr[-2000:])
    check("the log gives the PGA", "as applied: PGA 0.2001 g" in done.stderr, done.stderr[-2000:])
    motion = result(folder / "right")["motion"]
    check("so does the result", abs(motion["pga_g"] - 1.962 / 9.80665) < 1e-6 and motion["time_step"] == 0.01, motion)
    check("nothing is said against its peak", not any("PGA" in each for each in flagged(folder / "right", "/fem/motion/file")))

    done = shaken(folder, "as_g", 1.962)
    check("1.96 g are taken", done.returncode == 0, done.stderr[-2000:])
    slip = "looks like m/s2 given as g: divide by 9.81"
    check("the log names the slip", slip in done.stderr, done.stderr[-2000:])
    check("the result names the slip", any(slip in each for each in flagged(folder / "as_g", "/fem/motion/file")))

    done = shaken(folder, "too_strong", 4.905)
    check("4.9 g are refused", done.returncode == 65 and "/fem/motion/file" in done.stderr and slip in done.stderr, done.stderr[-2000:])
    check("and leave no result", not (folder / "too_strong/result.json").exists())


if __name__ == "__main__":
    with tempfile.TemporaryDirectory() as name:
        soil_in_pascal(pathlib.Path(name))
        motion_in_metres(pathlib.Path(name))
