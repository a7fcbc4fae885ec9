"""Does the service keep its size? Studies run through it one after another, with readers and listeners, for a while:

    soak.py [SECONDS]      (default 300; an hour is 3600)

Prints its resident memory every tenth of the time. The exit code says whether it grew by more than a quarter, or by more
than 20 MB, from the end of the first third to the end; and whether anything failed.
"""
import pathlib
import sys
import tempfile
import threading
import time

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1] / "faults"))
from service import Service, study  # noqa: E402

seconds = float(sys.argv[1]) if len(sys.argv) > 1 else 300.0


def resident_megabytes(service):
    for line in pathlib.Path(f"/proc/{service.process.pid}/status").read_text().splitlines():
        if line.startswith("VmRSS"):
            return int(line.split()[1]) / 1024
    raise AssertionError("it is gone")


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
    stop, faults = threading.Event(), []
    with tempfile.TemporaryDirectory() as folder, Service(folder, "--slots", "2") as service:
        readers = [threading.Thread(target=read_on, args=(service, stop, faults)) for _ in range(4)]
        for each in readers:
            each.start()
        began, sizes, runs = time.monotonic(), [], 0
        while (elapsed := time.monotonic() - began) < seconds:
            end = service.wait_for_end(service.submit(study([0.5], "fem_steps=1 mpm_steps=1")))
            runs += 1
            if end["state"] != "succeeded":
                faults.append(end["message"])
            if elapsed >= len(sizes) * seconds / 10:
                sizes.append(resident_megabytes(service))
                print(f"{elapsed:7.0f} s   {runs:6} runs   {sizes[-1]:6.1f} MB", flush=True)
        stop.set()
        for each in readers:
            each.join()
    early, late = sizes[len(sizes) // 3], sizes[-1]
    steady = late <= 1.25 * early and late <= early + 20
    print(f"{early:.1f} MB after a third, {late:.1f} MB at the end: {'steady' if steady else 'GROWING'}; {len(faults)} faults")
    for each in faults[:10]:
        print(each)
    return 0 if steady and not faults else 1


sys.exit(main())
