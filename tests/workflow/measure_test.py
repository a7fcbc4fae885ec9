"""--plan --measure says how many unknowns and bytes a scene has and where ten steps' time goes, and leaves nothing behind."""
import os
import pathlib
import re
import subprocess
import tempfile

from phases import check, coarse_column, programs, root

scene = root / "workflows/scenes/column.json"


def asked(phase, folder, *arguments):
    return subprocess.run([str(programs / phase), str(scene), *coarse_column, *arguments], capture_output=True, text=True,
                          timeout=120, env=os.environ | {"TMPDIR": str(folder)})


def costs(done):
    return {what.strip(): float(number) for what, number in re.findall(r"^cost      (.{34})\s*([-+.e\d]+)", done.stdout, re.M)}


def main(folder):
    for phase, counts in (("fem_solver", {"elements": 50, "nodes": 66, "unknowns": 2 * 66 - 2 * 6 - 10, "pressure_unknowns": 0}),
                          ("mpm_solver", {"points": 10 * 20 / 2**2 * 4})):
        done = asked(phase, folder, "--plan", "--measure")
        check(f"{phase} --plan --measure ends with 0", done.returncode == 0, done.stderr)
        found = costs(done)
        for what, number in counts.items():
            check(f"{phase} has {number:.0f} {what}", found[what] == number, found)
        check(f"{phase} took ten steps", "one step, of 10 tried" in found, found)
        shares = [float(share) for share in re.findall(r"([\d.]+) %$", done.stdout, re.M)]
        check(f"{phase}'s shares make a whole", len(shares) >= 5 and abs(sum(shares) - 100) < 0.5, shares)
        plain = asked(phase, folder, "--plan")
        check(f"{phase} --plan alone takes no steps", plain.returncode == 0 and not costs(plain) and done.stdout.startswith(plain.stdout.split("warning")[0]))
        check(f"{phase} --measure alone is wrong usage", asked(phase, folder, "--measure").returncode == 2)
    check("the program's memory is told", "memory: the program at its most" in costs(asked("fem_solver", folder, "--plan", "--measure")))
    check("lem_tool has no steps to measure", asked("lem_tool", folder, "--plan", "--measure").returncode == 2)
    check("nothing is left", not list(folder.iterdir()), list(folder.iterdir()))


if __name__ == "__main__":
    with tempfile.TemporaryDirectory() as name:
        main(pathlib.Path(name))
