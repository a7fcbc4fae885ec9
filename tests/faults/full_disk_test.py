"""A full disk: of the whole data folder (database, WAL, logs, outputs), and of the outputs alone. Nothing acknowledged is
lost, /readyz says so, and everything goes on when there is space again. Needs to mount a small file system (root)."""
import os
import pathlib
import subprocess
import sys
import tempfile
import unittest

from service import Service, study, until


class Small:
    """A file system of this size, in MB, in a folder."""

    def __init__(self, folder, megabytes):
        self.folder = pathlib.Path(folder)
        self.folder.mkdir(parents=True)
        self.ok = subprocess.run(["mount", "-t", "tmpfs", "-o", f"size={megabytes}m", "tmpfs", folder],
                                 capture_output=True).returncode == 0
        self.filler = self.folder / "filler"

    def __enter__(self):
        return self

    def __exit__(self, *_):
        if self.ok:
            subprocess.run(["umount", "-l", self.folder], check=True)

    def fill(self, leave=0):
        with self.filler.open("ab") as file:
            try:
                while os.statvfs(self.folder).f_bavail * 4096 > leave:
                    file.write(b"x" * 4096)
                    file.flush()
            except OSError:
                pass

    def free(self):
        self.filler.unlink()


class FullDisk(unittest.TestCase):
    def setUp(self):
        self.folder = tempfile.TemporaryDirectory()
        self.here = pathlib.Path(self.folder.name)

    def tearDown(self):
        self.folder.cleanup()

    def test_of_everything(self):
        with Small(self.here / "data", 40) as disk, Service(self.here, "--tries", "100") as service:
            before = service.submit(study(title="fem_steps=40"))
            disk.fill(leave=8 << 20)
            self.assertEqual(service.ask("/readyz")[0], 503)  # soon full
            disk.fill()
            acknowledged = []
            refused = 0
            for _ in range(40):
                status, _, body = service.ask("/v1/runs", study())
                if status == 202:
                    acknowledged.append(body["id"])
                else:
                    self.assertEqual((status, body["type"]), (503, "/problems/storage"), body)
                    self.assertIn("the disk of the data folder is full", body["detail"])
                    refused += 1
            self.assertGreater(refused, 0)
            self.assertEqual(service.ask("/healthz")[0], 200)
            self.assertEqual(service.ask("/v1/runs")[0], 200)  # reading still works
            disk.free()
            until(lambda: service.ask("/readyz")[0] == 200)
            after = service.submit(study())
            for run in (before, *acknowledged, after):
                end = service.wait_for_end(run)
                if end["state"] in ("failed", "partial"):  # a phase that found the disk full reported it; a later request may retry it
                    faults = [each["fault"] for each in end["tasks"] if each["state"] == "failed"]
                    self.assertEqual({each["exit_code"] for each in faults}, {74}, faults)
                    for each in faults:
                        self.assertRegex(each["summary"], "disk of .* is full|No space left on device", faults)
                    self.assertEqual(service.ask(f"/v1/runs/{run}/retry", {})[0], 202)
                    until(lambda: service.ask(f"/v1/runs/{run}")[2]["state"] == "succeeded", 60)
                else:
                    self.assertEqual(end["state"], "succeeded", end["message"])

    def test_of_the_outputs_alone(self):
        with Small(self.here / "data/runs", 2) as disk, Service(self.here, "--tries", "2") as service:
            disk.fill()
            run = service.submit(study())
            end = service.wait_for_end(run)
            self.assertEqual(end["state"], "failed")
            self.assertRegex(end["message"], "disk of .* is full|No space left on device")
            disk.free()
            self.assertEqual(service.ask(f"/v1/runs/{run}/retry", {})[0], 202)
            until(lambda: service.ask(f"/v1/runs/{run}")[2]["state"] == "succeeded", 60)


if __name__ == "__main__":
    with tempfile.TemporaryDirectory() as probe, Small(pathlib.Path(probe, "x"), 1) as disk:
        if not disk.ok:
            print("skipped: this user cannot mount a small file system")
            sys.exit(77)
    unittest.main(argv=sys.argv[:1])
