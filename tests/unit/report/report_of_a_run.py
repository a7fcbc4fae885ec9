"""A run of the real phases, coarse and short, as a page: self-contained, every figure with its data, and the numbers
in the data are those in the phases' files."""
import csv
import json
import pathlib
import re
import subprocess
import sys
import tempfile

import h5py
import numpy

sys.path.insert(0, str(pathlib.Path(__file__).parents[2] / "workflow"))
from phases import check, programs, root, run

scene = root / "workflows/scenes/slope.json"
transfer_time = 2.0
coarse = ["--set", "/section/regions/0/mesh/divisions=[30,3]", "--set", "/section/regions/1/mesh/divisions=[15,5]",
          "--set", "/mpm/cell_size=2", "--set", "/mpm/domain_y=[-5,15]", "--set", "/mpm/duration=3",
          "--set", '/mpm/gauges=[{"name":"toe","x":30}]', "--set", "/fem/stages/1/duration=2.1"]


def phases(folder):
    def done(phase, label, *arguments):
        ended = run(phase, scene, folder / label, *coarse, *arguments)
        check(f"{phase} ends well", ended.returncode == 0, ended.stderr[-2000:])

    done("lem_tool", "lem")
    done("fem_solver", "fem", "--set", f"/fem/snapshot_times=[{transfer_time}]")
    time = f"{transfer_time:.6f}"
    done("transfer_tool", f"transfer_{time}", "--input", folder / f"fem/snapshot_{time}.vtkhdf")
    done("mpm_solver", f"mpm_{time}", "--input", folder / f"transfer_{time}/particles.vtkhdf")
    return folder / f"mpm_{time}"


def rows(file):
    with open(file, newline="") as stream:
        return list(csv.reader(stream))[1:]


def main(folder):
    mpm = phases(folder)
    page = folder / "page/report.html"
    done = subprocess.run([programs / "report", folder, "--output", page], capture_output=True, text=True, timeout=240)
    check("report ends well", done.returncode == 0, done.stderr)
    html = page.read_text()
    files = page.parent / "report_files"
    check("nothing of the page comes from elsewhere",
          not re.search(r'https?:|\ssrc=|<script|@import|url\((?!#)|<link', html))
    check("the section is drawn among the inputs", html.count('<figure class="drawing">') == 1 and 'class="region"' in html)
    check("the page is small", len(html) < 5_000_000, len(html))
    figures = re.findall(r'<figure id="([^"]+)"', html)
    check("there are figures", len(figures) >= 14, figures)
    for name in figures:
        check(f"{name} has its data", len(rows(files / f"{name}.csv")) > 0)
        check(f"{name} is a picture of its own", 'xmlns="http://www.w3.org/2000/svg"' in (files / f"{name}.svg").read_text())
    for href in re.findall(r'href="(?!#)([^"]+)"', html):
        check(f"{href} is there", (page.parent / href).is_file())

    runout = json.loads((mpm / "result.json").read_text())["runout"]
    shown = [float(row[2]) for row in rows(files / "runout_against_transfer_time.csv")]
    check("the runout is the one in result.json, to the last digit", shown == [runout], (shown, runout))

    lines = [json.loads(line) for line in (folder / "fem/telemetry.jsonl").read_text().splitlines()]
    shown = [(float(x), float(y)) for _, x, y in rows(files / "kinetic_energy.csv")]
    check("the kinetic energy is the telemetry's",
          shown == [(line["time"], line["kinetic_energy"] / 1e3) for line in lines])

    last = max(folder.glob("fem/snapshot_*.vtkhdf"))
    with h5py.File(last) as file:
        found = []
        file["breachline"].visit(lambda name: found.append(name) if name.endswith("epsilon_q") else None)
        epsilon_q = 100 * numpy.asarray(file["breachline"][found[0]]).reshape(-1, 4).mean(axis=1)
    time = f"{float(last.stem.split('_')[1]):g}"
    shown = numpy.array([float(row[-1]) for row in rows(files / f"epsilon_q_{time}s.csv")])
    off = numpy.abs(shown - epsilon_q).max()
    check(f"strains are the snapshot's: largest difference {off:.1e} %, allowed 1e-10 (rounding)", off < 1e-10)

    left_out = html[html.index("Left out"):]
    check("a dry scene says why it shows no r_u", "dry" in left_out and "contours of r_u" in left_out)
    check("no paper is compared with a slope", 'id="comparison"' not in html)
    done = subprocess.run([programs / "report", folder / "nowhere", "--output", page], capture_output=True)
    check("a run that is not there is a file fault", done.returncode == 74)


if __name__ == "__main__":
    with tempfile.TemporaryDirectory() as name:
        main(pathlib.Path(name))
