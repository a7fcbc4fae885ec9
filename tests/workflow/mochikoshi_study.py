"""The whole Mochikoshi study by one request, and what must be true of it: a window of transfer times exists, softened
tailings run farther than others, no point is lost, memory stays below 4 GB, and the report is written.

    mochikoshi_study.py FOLDER STUDY [/json/pointer=value ...]

FOLDER keeps everything: progress.txt (a line a minute), data, report.html. The same study asked for again in the same
folder goes on where the last execution was stopped."""
import csv
import hashlib
import json
import os
import pathlib
import subprocess
import sys
import time

from phases import check, programs, result
from service import Service

most_memory = 4e9  # [bytes]


def key_of(study, overrides):
    """Another study, scene or override gives another run."""
    scene = study.parent / json.loads(study.read_text())["scene"]
    text = study.read_bytes() + scene.read_bytes() + "\n".join(overrides).encode()
    return "study-" + hashlib.sha256(text).hexdigest()[:32]


class Progress:
    """Reports the progress of the run, its expected end and the memory every minute."""

    def __init__(self, folder, service):
        self.file = open(folder / "progress.txt", "a")
        self.service, self.most, self.said = service, 0, 0.0

    def memory(self):
        pages = 0
        for process in [self.service.process.pid, *self.service.phases("")]:
            try:
                pages += int(pathlib.Path(f"/proc/{process}/statm").read_text().split()[1])
            except OSError:
                pass  # it has just ended
        return pages * os.sysconf("SC_PAGE_SIZE")

    def see(self, answer):
        used = self.memory()
        self.most = max(self.most, used)
        if time.monotonic() - self.said < 60 and not answer["finished"]:
            return
        self.said = time.monotonic()
        left = answer["seconds_left"]
        text = (f"{100 * answer['progress']:5.1f} %  {answer['tasks_done']} of {answer['tasks_total']} tasks  "
                f"{'-' if left is None else f'{left / 60:.0f} min'} left  {used / 1e6:.0f} MB")
        print(text, flush=True)
        print(time.strftime("%H:%M:%S ") + text, file=self.file, flush=True)


def report_of(service, run, folder):
    service.breach("export", run, folder / "run")
    done = subprocess.run([programs / "report", folder / "run", "--output", folder / "report.html"],
                          capture_output=True, text=True)
    check(f"the report is {folder}/report.html", done.returncode == 0, done.stderr)
    with open(folder / "report_files/variants.csv", newline="") as stream:
        return {row["variant"]: row for row in csv.DictReader(stream)}


def check_phases(ended):
    for task in ended["tasks"]:
        if task["phase"] == "fem_solver":
            result = task["result"] or {}
            how = task["fault"]["summary"] if task["fault"] else f"{result.get('ended')} at {result.get('end_time')} s"
            print(f"FEM: {task['state']}, {how}")
            continue
        # The FEM may end with an entangled mesh before the last of the transfer times.
        check(f"{task['label']} {task['state']}", task["state"] in ("succeeded", "cached", "skipped"), task["fault"])


def check_points(folder):
    runouts = list((folder / "run/tasks").glob("mpm_*/result.json"))
    for each in runouts:
        ended = result(each.parent)
        name = each.parent.name.replace("mpm_", "transfer_")
        transfers = [folder / "run/tasks" / name, folder / "run/tasks" / "_".join(name.split("_")[:2])]
        given = next(result(transfer)["points"] for transfer in transfers if (transfer / "result.json").exists())
        assert ended["particles"] == given, f"{each}: {ended['particles']} of {given} points"
    check(f"no point is lost in {len(runouts)} runouts", runouts)


def main(folder, study, *overrides):
    folder.mkdir(parents=True, exist_ok=True)
    service = Service(folder / "data", "--slots", str(os.cpu_count()))
    try:
        words = [word for each in overrides for word in ("--set", each)]
        run = service.breach("submit", study, "--key", key_of(study, overrides), *words)
        print(f"run {run}; dashboard {service.url}", flush=True)
        progress = Progress(folder, service)
        ended = service.finish(run, progress.see, every=2)
        check_phases(ended)
        window = next(t for t in service.call(f"/v1/runs/{run}/triggers")["triggers"] if t["kind"] == "window")
        check("a window of transfer times exists", window["state"] == "fired", window["reason"])
        variants = report_of(service, run, folder)
        softened, strong = (float(variants[name]["runout [m]"]) for name in ("softened", "not_softened"))
        check(f"softened tailings run farther: {softened:.1f} m, not softened {strong:.1f} m", softened > strong)
        check_points(folder)
        check(f"at most {progress.most / 1e6:.0f} MB were used, allowed {most_memory / 1e6:.0f}", progress.most < most_memory)
    finally:
        service.stop()


if __name__ == "__main__":
    main(pathlib.Path(sys.argv[1]).resolve(), pathlib.Path(sys.argv[2]).resolve(), *sys.argv[3:])
