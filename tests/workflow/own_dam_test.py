"""The lines of docs/tutorials/own_dam.md, run as they stand against a real service: from a template to a report."""
import json
import os
import pathlib
import re
import subprocess
import tempfile

from phases import check, programs, root
from service import Service


def lines_of_chapter():
    chapter = (root / "docs/tutorials/own_dam.md").read_text()
    return [line.split(" #")[0].strip() for line in chapter.splitlines() if re.match(r"    (breach|report) ", line)]


def main():
    lines = lines_of_chapter()
    words = {" ".join(line.split()[:2]) for line in lines}
    asked = {"breach new", "breach draw", "breach submit", "breach results", "breach export", "report my_dam/run"}
    check("the chapter goes from template to report", asked <= words, words)
    with tempfile.TemporaryDirectory() as folder:
        here = pathlib.Path(folder)
        service = Service(here / "data")
        try:
            environment = {**os.environ, "PATH": f"{programs}:{os.environ['PATH']}", "BREACH_SERVER": service.url}
            for line in lines:
                done = subprocess.run(["bash", "-c", line], cwd=here, env=environment, capture_output=True, text=True)
                check(line, done.returncode == 0, done.stdout + done.stderr)
            runs = service.call("/v1/runs")["runs"]
            check("each submission is a run of the folder's name", [each["name"] for each in runs] == ["my_dam", "my_dam"], runs)
            rows = {each["variant"]: each for each in service.rows(runs[-1]["id"])}
            check("both variants have a factor of safety", all(each["factor_of_safety"] > 1 for each in rows.values()), rows)
            check("and one below it once its layers liquefy", all(0 < each["factor_of_safety_liquefied"] < 1 for each in rows.values()), rows)
            check("the liquefied dam flows past its toe", rows["liquefied"]["runout"] > 0, rows)
            check("the other one stands", rows["undrained_peak"]["runout"] < 0, rows)
            scene = json.loads((here / "my_dam/scene.json").read_text())
            section = (here / "my_dam/section.svg").read_text()
            for region in scene["section"]["regions"]:
                check(f"the picture has {region['name']}", f'data-region="{region["name"]}"' in section)
            report = (here / "my_dam/report.html").read_text()
            check("the report says what is assumed", "assumed: drained strength" in report.replace("&#39;", "'"))
        finally:
            service.stop()


main()
