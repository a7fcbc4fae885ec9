"""Runs the commands of a page in docs/tutorials or docs/how-to as they stand, against a real service:
tutorials_test.py PAGE [--show] [--coarse].

Blocks fenced with sh are commands. They run in one shell, in a folder that looks like the source tree. A block fenced with text shows
what the commands before it print: the words of its first line must be in their output. Exits with 77 where the page needs a program
that is not installed. --coarse: with a template's dam on cells of twice the size, a tenth of the CPU time. Prints the number of commands from nothing to the report, and their time."""
import csv
import json
import os
import pathlib
import re
import shutil
import signal
import subprocess
import sys
import tempfile

from phases import check, programs, root
from service import Service

block = re.compile(r"^```(sh|text)\n(.*?)^```$", re.MULTILINE | re.DOTALL)
mark = "@@ commands"
# Installing, building and serving: tests/workflow/quickstart_test runs the first, this test serves by itself.
run_elsewhere = {"./deploy/quickstart", "build/release/bin/breachline serve --data var/quickstart"}
needed = {"cluster": ("slurmctld", "slurmd", "sbatch", "munged")}
coarsen = """jq '.mpm |= (.cell_size *= 2 | .allow_coarse_cells = true | .floor.level -= 2 | .domain_y[0] -= 2)' my_dam/scene.json >coarse.json
mv coarse.json my_dam/scene.json
"""
most_commands = {"own_dam": 8, "import_drawing": 5}  # to the report


def blocks_of(page):
    [file] = [each for kind in ("tutorials", "how-to") for each in (root / "docs" / kind).glob(f"{page}.md")]
    text = file.read_text()
    return [(kind, body) for kind, body in block.findall(text) if not set(body.strip().splitlines()) <= run_elsewhere]


def looks_like_the_source_tree(here):
    for name in ("workflows", "deploy", "docs"):
        (here / name).symlink_to(root / name)
    (here / "build/release").mkdir(parents=True)
    (here / "build/release/bin").symlink_to(programs)


def outputs_of(page, blocks, here, url):
    """What each block of commands printed, both streams together, nothing for a block of text; and when each began and the last ended."""
    stamp = f'echo "{mark} $EPOCHREALTIME"\n'
    script = "".join(stamp + (body if kind == "sh" else "") for kind, body in blocks) + stamp
    if "--coarse" in sys.argv:
        script = re.sub(r"^breach new .*--output my_dam\n", lambda line: line[0] + coarsen, script, count=1, flags=re.MULTILINE)
    environment = {**os.environ, "PATH": f"{programs}:{os.environ['PATH']}:/usr/sbin:/sbin", "BREACH_SERVER": url}
    shell = subprocess.Popen(["bash", "-e", "-c", script], cwd=here, env=environment, stdin=subprocess.DEVNULL, stdout=subprocess.PIPE,
                             stderr=subprocess.STDOUT, text=True, start_new_session=True)
    try:
        printed, _ = shell.communicate()
    finally:
        try:
            os.killpg(shell.pid, signal.SIGTERM)  # started by a page and not stopped
        except ProcessLookupError:
            pass
    _, *parts = re.split(rf"{mark} (\d+[.,]\d+)\n", printed)
    times, outputs = [float(each.replace(",", ".")) for each in parts[::2]], parts[1::2]
    if "--show" in sys.argv:
        print(printed)
    _, reached = blocks[min(len(outputs), len(blocks)) - 1]
    check(f"the commands of {page}.md run", shell.returncode == 0, f"{shell.returncode} in\n{reached}\n{printed[-3000:]}")
    return outputs, times


def check_report(page, blocks, times):
    """Checks that a page needs at most its number of commands for a report."""
    last = next((place for place, (kind, body) in enumerate(blocks) if kind == "sh" and re.search("^report ", body, re.MULTILINE)), None)
    if last is None:
        check("the page may go without a report", page not in most_commands, page)
        return
    lines = [line for kind, body in blocks[:last + 1] if kind == "sh" for line in body.replace("\\\n", "").splitlines()]
    count = sum(1 for line in lines if line and not line.startswith("#"))
    check(f"{count} commands and {times[last + 1] - times[0]:.0f} s from nothing to the report", count <= most_commands.get(page, count), lines)


def check_shown(blocks, outputs):
    printed = ""
    for (kind, body), output in zip(blocks, outputs):
        if kind == "sh":
            printed = output
            continue
        first = body.splitlines()[0]
        missing = [word for word in re.findall(r"[A-Za-z_]{2,}", first) if word not in printed]
        check(f"the page shows what is printed: {first.strip()}", not missing, (missing, printed[-2000:]))


def draw_own_dam(here):
    """dam.dxf and materials.json: the dam of docs/tutorials/own_dam.md with its water and terrain, as from a CAD program."""
    own = next(line.split() for _, body in blocks_of("own_dam") for line in body.splitlines() if line.startswith("breach new upstream_dam"))
    subprocess.run([programs / own[0], *own[1:-1], here / "drawn"], check=True, capture_output=True)
    scene = json.loads((here / "drawn/scene.json").read_text())
    drawn = [(each["material"], each["polygon"][:-1], 1) for each in scene["section"]["regions"]]
    drawn += [("PHREATIC", scene["lem"]["water"]["line"], 0), ("TERRAIN", scene["mpm"]["terrain"], 0)]
    metres = 6
    groups = [(0, "SECTION"), (2, "HEADER"), (9, "$INSUNITS"), (70, metres), (0, "ENDSEC"), (0, "SECTION"), (2, "ENTITIES")]
    for layer, line, closed in drawn:
        groups += [(0, "LWPOLYLINE"), (8, layer), (90, len(line)), (70, closed)]
        groups += [group for x, y in line for group in ((10, x), (20, y))]
    (here / "dam.dxf").write_text("".join(f"{code}\n{value}\n" for code, value in [*groups, (0, "ENDSEC"), (0, "EOF")]))
    shutil.copy(here / "drawn/scene.json", here / "materials.json")


def rows(service, run):
    return {(each["variant"], each["transfer_time"]): each for each in service.rows(run["id"])}


def check_own_dam(service, here):
    runs = service.call("/v1/runs")["runs"]
    check("each submission is a run of the folder's name", [each["name"] for each in runs] == ["my_dam", "my_dam"], runs)
    found = {variant: row for (variant, _), row in rows(service, runs[-1]).items()}
    check("both variants have a factor of safety above 1", all(each["factor_of_safety"] > 1 for each in found.values()), found)
    check("and below 1 once their layers liquefy", all(0 < each["factor_of_safety_liquefied"] < 1 for each in found.values()), found)
    check("the liquefied dam flows past its toe", found["liquefied"]["runout"] > 0, found)
    check("the other one does not", found["undrained_peak"]["runout"] < 0, found)
    scene = json.loads((here / "my_dam/scene.json").read_text())
    section = (here / "my_dam/section.svg").read_text()
    for region in scene["section"]["regions"]:
        check(f"the picture has {region['name']}", f'data-region="{region["name"]}"' in section)
    check("it stands on clay, above ground that falls", scene["materials"]["clay"] and scene["mpm"]["terrain"][-1][1] < 0)
    report = (here / "my_dam/report.html").read_text()
    check("the report says what is assumed", "assumed: drained strength" in report.replace("&#39;", "'"))
    check_first_page(here / "my_dam")
    if "--coarse" not in sys.argv and shutil.which("weasyprint") and shutil.which("pdfinfo"):  # coarse cells raise more flags
        subprocess.run(["weasyprint", here / "my_dam/report.html", here / "my_dam/report.pdf"], check=True, capture_output=True)
        said = subprocess.run(["pdfinfo", here / "my_dam/report.pdf"], check=True, capture_output=True, text=True).stdout
        check("the report has at most 12 pages", int(said.split("Pages:")[1].split()[0]) <= 12, said)


def check_first_page(dam):
    """Its numbers are those of the results."""
    result = json.loads((dam / "run/tasks/mpm_liquefied/result.json").read_text())
    factors = [json.loads(file.read_text())["factor_of_safety"] for file in (dam / "run/tasks").glob("lem_*/result.json")]
    width = 3 * 20  # of the assumed breach: three heights [m]

    def shown(table, begin):
        with open(dam / f"report_files/{table}.csv", newline="") as stream:
            return next(row[1] for row in csv.reader(stream) if row[0].startswith(begin))

    for table, begin, value in (("found", "Reach", result["runout_beyond_toe"]), ("found", "Released", width * result["area_beyond_toe"]),
                                ("found", "Peak discharge", width * result["sections"]["toe"]["largest_discharge"]),
                                ("stability", "as built", min(factors))):
        check(f"page 1 has the result's {begin}", abs(float(shown(table, begin)) - value) <= 0.005 * value, (shown(table, begin), value))


def check_earthquake(service, here):
    weak, strong = service.call("/v1/runs")["runs"]
    runouts = [row["runout_beyond_toe"] for (_, time), row in sorted(rows(service, strong).items()) if time < 7]
    check("the first transfer is too early, the last are on a plateau", len(runouts) == 4 and runouts[0] < 0.5 * runouts[1] and
          min(runouts[2:]) > 0.75 * max(runouts), runouts)
    check("the section is long enough for its runouts", all(row["state"] == "succeeded" for (_, time), row in
          rows(service, strong).items() if time < 7), rows(service, strong))
    check("a third of the shaking does not fail the dam", all(row["runout_beyond_toe"] == 0 for row in rows(service, weak).values()))
    check("the report is of the strong earthquake", "scaled to 0.1" not in (report := (here / "quake/report.html").read_text()) and
          "shaken by motion.csv" in report)


def check_static_liquefaction(service, here):
    found = rows(service, service.call("/v1/runs")["runs"][0])
    check("loose tailings flow", all(row["runout_beyond_toe"] > 20 for (variant, _), row in found.items() if variant == "loose"), found)
    check("dense ones stay", all(row["runout_beyond_toe"] == 0 for (variant, _), row in found.items() if variant == "dense"), found)


def check_nine_times_in_ten(service, here):
    found = service.call(f"/v1/runs/{service.call('/v1/runs')['runs'][0]['id']}/uncertainty")
    check("all samples ended with a result", found["samples"]["done"] == found["samples"]["planned"] == 36, found["samples"])


def check_import_drawing(service, here):
    [run] = service.call("/v1/runs")["runs"]
    [row] = service.rows(run["id"])
    check("the drawn dam stands as built", row["factor_of_safety"] > 1, row)
    check("and flows past its toe", row["runout_beyond_toe"] > 0, row)
    check("the grid's wall is where the section ends", "reached_wall" not in run["flag_counts"], run["flag_counts"])
    report = (here / "my_run.html").read_text()
    check("the report lists the clay", ">clay<" in report)


prepare = {"import_drawing": draw_own_dam}
checks = {"own_dam": check_own_dam, "import_drawing": check_import_drawing, "earthquake": check_earthquake,
          "static_liquefaction": check_static_liquefaction, "nine_times_in_ten": check_nine_times_in_ten}


def main(page):
    missing = [name for name in needed.get(page, ()) if not shutil.which(name, path=f"{os.environ['PATH']}:/usr/sbin:/sbin")]
    if missing:
        print("skipped:", ", ".join(missing), "not installed")
        return 77
    blocks = blocks_of(page)
    check("the page has commands", any(kind == "sh" for kind, _ in blocks), page)
    with tempfile.TemporaryDirectory(prefix="breach-") as folder:
        here = pathlib.Path(folder)
        here.chmod(0o755)  # Slurm enters it as any user
        looks_like_the_source_tree(here)
        prepare.get(page, lambda _: None)(here)
        service = Service(here / "var/quickstart")
        try:
            outputs, times = outputs_of(page, blocks, here, service.url)
            check_shown(blocks, outputs)
            check_report(page, blocks, times)
            checks.get(page, lambda *_: None)(service, here)
        finally:
            service.stop()
            if (here / "lab").exists():
                subprocess.run([root / "deploy/slurm/stop-one-machine", here / "lab"], capture_output=True)
    return 0


sys.exit(main(sys.argv[1]))
