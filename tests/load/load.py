"""The load that one `breachline serve` can carry: a table of rates and latencies, all on loopback, over in less than a minute.

    load.py [--brief] [--clients N] [--seconds S] [--data DIR]

The phases are stand-ins that only wait, so that everything submitted stays queued and the service itself is measured.
The exit code says whether anything was refused or lost, never whether it was fast. DIR should be on the disk that is
to be used (default: a temporary folder); "durable" means what this disk's fsync means.
"""
import argparse
import asyncio
import json
import os
import pathlib
import signal
import sqlite3
import subprocess
import sys
import tempfile
import time

import client

programs = pathlib.Path(os.environ.get("BREACH_BIN", "build/release/bin"))
root = pathlib.Path(__file__).resolve().parents[2]


def options():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--brief", action="store_true", help="a few seconds in all, for the tests")
    parser.add_argument("--clients", type=int, default=32)
    parser.add_argument("--seconds", type=float, default=8.0, help="of submitting")
    parser.add_argument("--data", help="parent of the data folder")
    chosen = parser.parse_args()
    if chosen.brief:
        chosen.seconds = min(chosen.seconds, 2.0)
    return chosen


def study(times):
    scene = json.loads((root / "workflows/scenes/column.json").read_text())
    return json.dumps({"format": "breachline-study/1", "name": "load", "scene": scene, "stability": False,
                       "overrides": ["/fem/stages/1/duration=2"], "transfer_times": times}).encode()


def phases_that_wait(folder):
    folder.mkdir()
    for name in ("fem_solver", "lem_tool", "transfer_tool", "mpm_solver"):
        (folder / name).write_text("#!/bin/sh\n[ \"$1\" = --version ] && echo numerics 1 && exit\nexec sleep 600\n")
        (folder / name).chmod(0o755)
    return folder


def kill_supervisors(data):
    """Supervisors outlive a killed service, by design; here no service will continue them."""
    for cmdline in pathlib.Path("/proc").glob("[0-9]*/cmdline"):
        try:
            if str(data).encode() in cmdline.read_bytes():
                os.kill(int(cmdline.parent.name), signal.SIGKILL)
        except (FileNotFoundError, ProcessLookupError):
            continue


class Service:
    def __init__(self, data, phases):
        self.log = (data.parent / "service.log").open("a")
        self.process = subprocess.Popen(
            [programs / "breachline", "serve", "--data", data, "--port", "0", "--bin", phases, "--slots", "1", "--grace", "0"],
            stdout=subprocess.PIPE, stderr=self.log, text=True)
        self.port = json.loads(self.process.stdout.readline())["port"]

    def resident_megabytes(self):
        for line in pathlib.Path(f"/proc/{self.process.pid}/status").read_text().splitlines():
            if line.startswith("VmRSS"):
                return int(line.split()[1]) / 1024
        return 0.0

    def cpu_seconds(self):
        fields = pathlib.Path(f"/proc/{self.process.pid}/stat").read_text().rpartition(")")[2].split()
        return (int(fields[11]) + int(fields[12])) / os.sysconf("SC_CLK_TCK")

    def end(self, how):
        began = time.perf_counter()
        self.process.send_signal(how)
        try:
            self.process.wait(10)
        except subprocess.TimeoutExpired:
            self.process.kill()
            self.process.wait()
            print("-- asked to stop, it had not done so after 10 s and was killed")
        else:
            print(f"-- gone {time.perf_counter() - began:.2f} s after signal {how}")
        self.process.stdout.close()
        self.log.close()

    def __enter__(self):
        return self

    def __exit__(self, *_):
        if self.process.poll() is None:
            self.end(signal.SIGTERM)


class Table:
    """The last column does not depend on other load of the machine: CPU time of the service since the row before, per
    request."""

    def __init__(self, service):
        self.service, self.spent, self.faults = service, service.cpu_seconds(), []
        print(f"{'':46} {'count':>7} {'1/s':>8} {'p50 ms':>8} {'p99 ms':>8} {'max ms':>8} {'faults':>6} {'CPU ms':>8}")

    def row(self, what, seconds, faults, duration=None):
        self.faults += [f"{what}: {each}" for each in faults]
        ordered = sorted(seconds)
        rate = f"{len(ordered) / duration:8.0f}" if duration else f"{'-':>8}"
        figures = [1000 * ordered[min(int(part * len(ordered)), len(ordered) - 1)] for part in (0.5, 0.99, 1.0)] if ordered else []
        spent, before = self.service.cpu_seconds(), self.spent
        self.spent = spent
        cpu = f"{1000 * (spent - before) / len(ordered):8.2f}" if ordered else f"{'-':>8}"
        print(f"{what:46} {len(ordered):7} {rate} " + " ".join(f"{each:8.2f}" for each in figures)
              + f" {len(faults):6} {cpu}", flush=True)

    def loop(self, what, loop):
        seconds, answers, faults = loop.result()
        self.row(what, seconds, faults, loop.duration if len(seconds) > 1 else None)
        return answers


def get(port, path):
    return client.request_bytes(port, "GET", path)


async def listen(port, count, submit):
    """Seconds from the sending of a submission to its event at each of `count` listeners."""
    listeners = []
    for _ in range(count):
        reader, writer = await asyncio.open_connection("127.0.0.1", port)
        writer.write(client.request_bytes(port, "GET", "/v1/events", accept="text/event-stream"))
        listeners.append((reader, writer))
    for reader, _ in listeners:
        status = await asyncio.wait_for(reader.readuntil(b"\r\n\r\n"), 10)
        if b" 200 " not in status.split(b"\r\n")[0]:
            raise RuntimeError(f"a listener got {status.splitlines()[0]!r}")
    await asyncio.sleep(0.5)  # the streams start with the first event after their headers

    async def first_event(reader):
        await asyncio.wait_for(reader.readuntil(b"data:"), 10)
        return time.perf_counter()

    waiting = [asyncio.create_task(first_event(reader)) for reader, _ in listeners]
    reader, writer = await asyncio.open_connection("127.0.0.1", port)
    began = time.perf_counter()
    writer.write(submit)
    arrived = await asyncio.gather(*waiting, return_exceptions=True)
    for _, each in [*listeners, (reader, writer)]:
        each.close()
    seconds = [each - began for each in arrived if isinstance(each, float)]
    return seconds, [repr(each) for each in arrived if not isinstance(each, float)]


def acknowledged_runs(answers):
    return {json.loads(each)["id"] for each in answers}


def measure(chosen, service):
    """All faults, and the ids of the acknowledged runs."""
    port, short = service.port, 1.0 if chosen.brief else 3.0
    table = Table(service)
    submit = client.request_bytes(port, "POST", "/v1/runs", study([0.5]))
    memory = [service.resident_megabytes()]
    kept = set()

    kept |= acknowledged_runs(table.loop("submit, 1 client", client.Loop(port, submit, 1, short, keep=True)))
    what = f"submit, {chosen.clients} clients"
    kept |= acknowledged_runs(table.loop(what, client.Loop(port, submit, chosen.clients, chosen.seconds, keep=True)))
    memory.append(service.resident_megabytes())
    run = max(kept)
    print(f"-- load average {os.getloadavg()[0]:.1f}")
    print(f"-- {len(kept)} runs and {3 * len(kept)} tasks queued")
    table.loop("list of 100 runs, 1 client", client.Loop(port, get(port, "/v1/runs"), 1, short))
    table.loop("one run with its tasks, 1 client", client.Loop(port, get(port, f"/v1/runs/{run}"), 1, short))

    writers = client.Loop(port, submit, 8, short, keep=True, processes=1)
    readers = client.Loop(port, get(port, f"/v1/runs/{run}"), 32, short, processes=1)
    table.loop("32 readers of one run while 8 clients submit", readers)
    kept |= acknowledged_runs(table.loop("   those submissions", writers))

    print("-- a sweep over 5,000 transfer times")
    wide = client.request_bytes(port, "POST", "/v1/runs", study([round(0.0004 * i, 4) for i in range(1, 5001)]))
    sweeps = acknowledged_runs(table.loop("submit the sweep", client.Loop(port, wide, 1, 0.001, keep=True)))
    kept |= sweeps
    sweep_id = min(sweeps, default="none")
    table.loop("its table of results, 1 client", client.Loop(port, get(port, f"/v1/runs/{sweep_id}/results"), 1, short))
    table.loop("   100 rows of it", client.Loop(port, get(port, f"/v1/runs/{sweep_id}/results?limit=100&from=2000"), 1, short))
    table.loop("   100 of its tasks", client.Loop(port, get(port, f"/v1/runs/{sweep_id}/tasks?limit=100"), 1, short))
    table.loop("its page with 10,001 tasks, 1 client", client.Loop(port, get(port, f"/v1/runs/{sweep_id}"), 1, short))
    table.loop("list of 100 runs, 1 client", client.Loop(port, get(port, "/v1/runs"), 1, short))

    print("-- 200 listeners (server-sent events)")
    table.row("submission sent -> event received", *asyncio.run(listen(port, 200, submit)))

    memory.append(service.resident_megabytes())
    print(f"-- resident memory: {memory[0]:.0f} MB at first, {memory[1]:.0f} MB after the submissions, {memory[2]:.0f} MB at last")
    return table.faults, kept


def lost(kept, data, phases):
    """After kill -9: acknowledged runs that the database lacks, and the time of a start and a stop."""
    began = time.perf_counter()
    with Service(data, phases):
        print(f"-- listening again {time.perf_counter() - began:.2f} s after the start")
        database = sqlite3.connect(f"file:{data / 'breachline.sqlite'}?mode=ro", uri=True)
        stored = {row[0] for row in database.execute("SELECT id FROM runs")}
        database.close()
    missing = kept - stored
    print(f"-- {len(kept)} acknowledged, {len(missing)} of them lost")
    return [f"acknowledged and lost: {each}" for each in sorted(missing)]


def main():
    chosen = options()
    with tempfile.TemporaryDirectory(prefix="breach-load-", dir=chosen.data) as name:
        data, phases = pathlib.Path(name, "data"), phases_that_wait(pathlib.Path(name, "bin"))
        try:
            with Service(data, phases) as service:
                faults, kept = measure(chosen, service)
                service.end(signal.SIGKILL)
            faults += lost(kept, data, phases)
        finally:
            kill_supervisors(data)
    for each in faults[:20]:
        print(each, file=sys.stderr)
    return 1 if faults else 0


if __name__ == "__main__":
    sys.exit(main())
