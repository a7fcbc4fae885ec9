"""Does the service keep its size? Studies run through it one after another, with readers and listeners, for a while:

    soak.py [SECONDS]      (default 300; an hour is 3600)

Runs beyond 20 MB are removed by the service itself (--keep-gb). Prints every tenth of the time resident memory, open files,
threads, the database with its log, and the folders of runs. The exit code says whether one of them grew by more than a
quarter and more than its slack from the end of the first third to the end; and whether anything failed.
"""
import os
import pathlib
import sys
import tempfile
import threading
import time

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1] / "faults"))
from service import Service, study  # noqa: E402

seconds = float(sys.argv[1]) if len(sys.argv) > 1 else 300.0
# A reconnected listener temporarily has one more file and thread; the retention finds the runs of one minute.
slack = {"memory_MB": 20, "files": 12, "threads": 12, "database_MB": 10, "runs": 200}


def sizes_of(service):
    process = pathlib.Path(f"/proc/{service.process.pid}")
    status = dict(line.split(":", 1) for line in (process / "status").read_text().splitlines())
    database = sum(each.stat().st_size for each in service.data.glob("breachline.sqlite*"))
    return {"memory_MB": int(status["VmRSS"].split()[0]) / 1024, "files": len(os.listdir(process / "fd")),
            "threads": int(status["Threads"]), "database_MB": database / 1e6, "runs": len(os.listdir(service.data / "runs"))}


def read_on(service, stop, faults):
    last = 0
    while not stop.is_set():
        try:
            answer = service.ask(f"/v1/events?after={last}&wait=1")[2]
            last = answer["next"]
            service.ask("/v1/runs")
            service.ask("/metrics")
        except OSError as error:
            faults.append(repr(error))


def main():
    stop, faults, sizes, runs = threading.Event(), [], [], 0
    with tempfile.TemporaryDirectory() as folder, Service(folder, "--slots", "2", "--keep-gb", "0.02") as service:
        readers = [threading.Thread(target=read_on, args=(service, stop, faults)) for _ in range(4)]
        for each in readers:
            each.start()
        began = time.monotonic()
        print(f"{'seconds':>8} {'runs made':>9} " + " ".join(f"{each:>11}" for each in slack))
        while (elapsed := time.monotonic() - began) < seconds:
            end = service.wait_for_end(service.submit(study([0.5], "fem_steps=1 mpm_steps=1")))
            runs += 1
            if end["state"] != "succeeded":
                faults.append(end["message"])
            if elapsed >= len(sizes) * seconds / 10:
                sizes.append(sizes_of(service))
                print(f"{elapsed:8.0f} {runs:9} " + " ".join(f"{each:11.1f}" for each in sizes[-1].values()), flush=True)
        sizes.append(sizes_of(service))
        print(f"{elapsed:8.0f} {runs:9} " + " ".join(f"{each:11.1f}" for each in sizes[-1].values()), flush=True)
        stop.set()
        for each in readers:
            each.join()
    early, late = sizes[len(sizes) // 3], sizes[-1]
    growing = [each for each in slack if late[each] > max(1.25 * early[each], early[each] + slack[each])]
    print(f"{'GROWING: ' + ', '.join(growing) if growing else 'steady'}; {len(faults)} faults")
    for each in faults[:10]:
        print(each)
    return 0 if not growing and not faults else 1


sys.exit(main())
