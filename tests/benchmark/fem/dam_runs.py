"""Runs of workflows/scenes/mochikoshi.json with a bound on CPU seconds, kept in folders so that a study can be stopped and
taken up again; and what is read out of them. Cost is CPU seconds of the solver and what it starts, from wait4."""
import json
import os
import pathlib
import signal
import subprocess
import time

import h5py
import numpy

ROOT = pathlib.Path(__file__).resolve().parents[3]
SCENE = ROOT / "workflows/scenes/mochikoshi.json"
SHARED = pathlib.Path(os.environ.get("BREACH_SHARED", ROOT.parent / "shared"))
STAND_IN = SHARED / "motions/SFERN1971_LA_Hollywood_Stor_180_P695-121512.txt"
MOTIONS = {"synthetic": ROOT / "workflows/motions/synthetic.csv", "stand-in": STAND_IN}
ENTANGLED, STOPPED, DURATION, NO_CONVERGENCE = "entangled", "stopped", "whole duration", "no convergence"
INTERRUPTED = (130, 143)  # the solver has heard SIGINT, SIGTERM and left a checkpoint


def overrides_of(settings):
    """fem__element="ssp" becomes --set /fem/element="ssp"."""
    words = []
    for key, value in settings.items():
        words += ["--set", "/" + key.replace("__", "/") + "=" + json.dumps(value)]
    return words


def cpu_of(pid):
    """CPU seconds of a running process, its ended children included."""
    fields = pathlib.Path(f"/proc/{pid}/stat").read_text().rsplit(")", 1)[1].split()
    return sum(int(each) for each in fields[11:15]) / os.sysconf("SC_CLK_TCK")


def wait_within(child, limit):
    """Exit status and resource usage; beyond `limit` CPU seconds the solver is asked to stop, which leaves a checkpoint."""
    while True:
        pid, status, usage = os.wait4(child.pid, os.WNOHANG)
        if pid:
            child.returncode = os.waitstatus_to_exitcode(status)
            return child.returncode, usage
        if cpu_of(child.pid) > limit:
            child.send_signal(signal.SIGTERM)
            _, status, usage = os.wait4(child.pid, 0)
            child.returncode = os.waitstatus_to_exitcode(status)
            return None, usage
        time.sleep(0.2)


def record_of(folder):
    """CPU seconds so far and how the run ended; None when it has not been run to an end."""
    record = folder / "run.json"
    return json.loads(record.read_text()) if record.exists() else {"cpu_seconds": 0.0, "ended": None}


def run_dam(program, folder, settings, limit=2400.0):
    """The facts of the run in `folder`; starts it, or goes on with one that was stopped or met a smaller limit."""
    done = record_of(folder)
    if done["ended"] not in (None, STOPPED) or done["cpu_seconds"] >= limit:
        return done
    folder.mkdir(parents=True, exist_ok=True)
    command = [str(program), str(SCENE), "--output", str(folder), "--progress", "none"] + overrides_of(settings)
    if done["ended"] == STOPPED:
        command.append("--resume")
    with open(folder / "log.txt", "a") as log:
        child = subprocess.Popen(command, stdout=log, stderr=log, preexec_fn=lambda: os.nice(5))
        code, usage = wait_within(child, limit - done["cpu_seconds"])
    last = (folder / "log.txt").read_text().strip().splitlines()[-1]
    if code is None or code in INTERRUPTED:
        ended = STOPPED
    elif code == 0:
        result = json.loads((folder / "result.json").read_text())
        ended = ENTANGLED if result["ended"] == "entangled" else DURATION
    elif code == 70:
        ended = NO_CONVERGENCE
    else:
        raise SystemExit(f"{folder}: exit {code}: {last}")
    done = {"ended": ended, "message": last if code else "", "settings": settings,
            "cpu_seconds": done["cpu_seconds"] + usage.ru_utime + usage.ru_stime,
            "memory_MB": usage.ru_maxrss / 1024}
    (folder / "run.json").write_text(json.dumps(done, indent=1))
    return done


def telemetry_of(folder):
    """Columns of telemetry.jsonl by name."""
    lines = [json.loads(line) for line in (folder / "telemetry.jsonl").read_text().splitlines()]
    return {name: numpy.array([line[name] for line in lines]) for name in lines[-1] if name != "phase"}


def first_time(telemetry, reached):
    """Time of the first line where `reached` holds, or None."""
    k = numpy.flatnonzero(reached)
    return float(telemetry["time"][k[0]]) if k.size else None


def at(telemetry, name, time):
    """A column at a time, or None when the run ended before."""
    t = telemetry["time"]
    return float(numpy.interp(time, t, telemetry[name])) if t[-1] >= time - 1e-9 else None


def snapshot_at(folder, time):
    """Time and file of the first snapshot at or after a time, the last one otherwise."""
    snapshots = snapshots_of(folder)
    return next((each for each in snapshots if each[0] >= time - 1e-6), snapshots[-1])


def snapshots_of(folder):
    """(time, file) in the order of time."""
    files = [(float(file.stem.split("_")[1]), file) for file in folder.glob("snapshot_*.vtkhdf")]
    return sorted(files)


class Snapshot:
    """Corners [m], epsilon_q and region of the elements; r_u of the nodes."""

    def __init__(self, file):
        with h5py.File(file) as h5:
            ours, nodes = h5["breachline"], h5["VTKHDF/PointData"]
            self.quads = ours["quads"][:]
            self.position_0 = ours["position_0"][:]
            self.displacement = nodes["displacement"][:, :2]
            self.region = h5["VTKHDF/CellData/region"][:]
            self.regions = [name.decode() for name in ours["regions"][:]]
            self.epsilon_q = ours["gauss/epsilon_q"][:].reshape(len(self.quads), -1).mean(axis=1)
            p, self.p_0, sigma = (nodes[name][:] for name in ("pore_pressure", "pore_pressure_0", "sigma_v0"))
        self.excess = p - self.p_0
        self.r_u = numpy.where(sigma > 5e3, self.excess / numpy.maximum(sigma, 5e3), 0.0)
        x, y = self.position_0[self.quads].transpose(2, 0, 1)
        self.area = 0.5 * numpy.abs((x[:, 0] - x[:, 2]) * (y[:, 1] - y[:, 3]) - (x[:, 1] - x[:, 3]) * (y[:, 0] - y[:, 2]))

    def average_octahedral(self, threshold=0.03):
        """Mean of the octahedral shear strain sqrt(2) epsilon_q over the volume where it is above the threshold."""
        strain = numpy.sqrt(2) * self.epsilon_q
        above = strain > threshold
        return float(numpy.average(strain[above], weights=self.area[above])) if above.any() else 0.0

    def wet_tailings(self, left, right):
        """Elements of the tailings below the phreatic line whose centre lies between two x."""
        x = self.position_0[self.quads, 0].mean(axis=1)
        wet = (self.p_0[self.quads] > 1e3).all(axis=1) & (self.region == self.regions.index("tailings"))
        return wet & (x > left) & (x < right)

    def checkerboard(self):
        """Root mean square of the alternating part of the pressure in the elements below the dam [Pa]."""
        part = self.excess[self.quads] @ numpy.array([0.25, -0.25, 0.25, -0.25])
        return float(numpy.sqrt(numpy.mean(part[self.wet_tailings(100, 150)] ** 2)))

    def liquefied_below_crest(self):
        """Of the tailings below the crest: share of the area where the element's mean r_u is above 0.7, and its depth [m]."""
        window = self.wet_tailings(105, 120)
        liquid = window & (self.r_u[self.quads].mean(axis=1) > 0.7)
        lowest = self.position_0[self.quads, 1].mean(axis=1)[liquid]
        return float(self.area[liquid].sum() / self.area[window].sum()), float(29.4 - lowest.min()) if lowest.size else 0.0


def hourglass_stress(folder, snapshot):
    """What the stabilisation carries in each element, |gamma|_max |Q| / h [Pa], at the last checkpoint; None without one."""
    with h5py.File(folder / "checkpoint.h5") as h5:
        found = []
        h5.visititems(lambda name, what: found.append(what[:]) if name.endswith("hourglass") else None)
    if not found:
        return None
    force = found[0].reshape(-1, 4)[: len(snapshot.quads), :2]
    return 0.25 * numpy.hypot(*force.T) / numpy.sqrt(snapshot.area)
