"""Runs the fault tests on the fake Slurm many times: repeat.py TIMES [--jobs N] [--only FILTER] [--keep FOLDER]. TIMES
counts single tests, in rounds of all of them. Of one that fails, its folder (data, service.log, the fake's jobs) and what
it printed are kept. Ends with 1 when one has failed. BREACH_ROOT and BREACH_BIN as for ctest."""
import argparse
import collections
import concurrent.futures
import os
import pathlib
import shutil
import subprocess
import sys
import time

program = pathlib.Path(os.environ["BREACH_BIN"]) / "slurm_faults"
longest = 240  # longest test [s] on a busy machine


def tests(only):
    listed = subprocess.run([program, "--gtest_list_tests", f"--gtest_filter={only}"], text=True, capture_output=True,
                            check=True).stdout
    found, suite = [], ""
    for line in listed.splitlines():
        if not line.startswith(" "):
            suite = line.split()[0]
        else:
            found.append(suite + line.split()[0])
    return found


def run(number, test, keep):
    folder = keep / f"{number:05}_{test}"
    folder.mkdir(parents=True)
    begin = time.monotonic()
    with (folder / "log.txt").open("w") as log:
        try:
            code = subprocess.run([program, f"--gtest_filter={test}"], stdout=log, stderr=subprocess.STDOUT, timeout=longest,
                                  env={**os.environ, "TMPDIR": str(folder), "BREACH_KEEP_SANDBOX": "1"}).returncode
        except subprocess.TimeoutExpired:
            code = "no end"
    if code == 0:
        shutil.rmtree(folder, ignore_errors=True)
    return test, code, folder, time.monotonic() - begin


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("times", type=int)
    parser.add_argument("--jobs", type=int, default=2)
    parser.add_argument("--only", default="SlurmFaults.*")
    parser.add_argument("--keep", type=pathlib.Path, default=pathlib.Path("slurm_failures"))
    options = parser.parse_args()
    wanted = tests(options.only)
    count, failed, seconds = collections.Counter(), collections.Counter(), collections.Counter()
    begin = time.monotonic()
    with concurrent.futures.ThreadPoolExecutor(options.jobs) as pool:
        asked = [pool.submit(run, k, wanted[k % len(wanted)], options.keep.absolute()) for k in range(options.times)]
        for each in concurrent.futures.as_completed(asked):
            test, code, folder, lasted = each.result()
            count[test] += 1
            seconds[test] += lasted
            if code != 0:
                failed[test] += 1
                print(f"FAILED ({code}) {test}: {folder}", flush=True)
    for test in wanted:
        print(f"{count[test]:5} runs {failed[test]:3} failed {seconds[test] / max(1, count[test]):6.1f} s  {test}")
    print(f"{sum(count.values())} runs, {sum(failed.values())} failed, {time.monotonic() - begin:.0f} s, "
          f"{options.jobs} at a time, load {os.getloadavg()[0]:.1f}")
    return 1 if failed else 0


if __name__ == "__main__":
    sys.exit(main())
