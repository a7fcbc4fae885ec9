"""Named tokens: each has the rights that it was given, gets an answer that names the missing right, is stored with its requests, and
may be created and removed while the service runs."""
import json
import os
import pathlib
import subprocess
import sys
import tempfile
import unittest

from service import Service, programs, refusal_to_start, study, until


class Tokens(unittest.TestCase):
    def setUp(self):
        self.folder = tempfile.TemporaryDirectory()
        self.here = pathlib.Path(self.folder.name)
        self.file = self.here / "tokens.json"
        self.secrets = {each: self.token("new", each, "--rights", each.split("-")[0]).stdout.strip()
                        for each in ("read-er", "submit-ter", "admin-istrator")}

    def tearDown(self):
        self.folder.cleanup()

    def token(self, *arguments, code=0):
        done = subprocess.run([programs / "breachline", "token", *arguments, "--file", self.file], text=True,
                              capture_output=True)
        self.assertEqual(done.returncode, code, done.stderr)
        return done

    def ask(self, service, name, path, body=None, method=None):
        header = {"Authorization": "Bearer " + self.secrets.get(name, name)} if name else {}
        return service.ask(path, body, method=method, **header)

    def test_1_the_file_keeps_no_secret_and_is_private(self):
        text = self.file.read_text()
        for secret in self.secrets.values():
            self.assertEqual(len(secret), 64)
            self.assertNotIn(secret, text)
        self.assertEqual(self.file.stat().st_mode & 0o777, 0o600)
        self.assertEqual(self.token("list").stdout.split(), ["read-er", "read", "submit-ter", "submit", "admin-istrator", "admin"])
        for wrong in (("new", "read-er", "--rights", "read"), ("new", "admin", "--rights", "read"),
                      ("new", "a b", "--rights", "read"), ("new", "x", "--rights", "root"), ("rm", "nobody")):
            self.assertIn("breachline:", self.token(*wrong, code=2).stderr)
        self.file.chmod(0o604)
        self.assertIn("chmod 600", self.token("list", code=74).stderr)

    def test_2_a_file_that_cannot_be_used_keeps_the_service_from_starting(self):
        def refusal():
            code, told = refusal_to_start(self.here, "--tokens", self.file)
            self.assertIn(code, (2, 74))
            return told
        good = self.file.read_text()
        for change, said in (("{}", "is no file of tokens"), (good.replace('"read"', '"all"'), "/tokens/0/rights"),
                             (good.replace("read-er", "submit-ter"), "there twice"),
                             (good.replace("read-er", "admin"), "--token-file")):
            self.file.write_text(change)
            self.assertIn(said, refusal())
        self.file.write_text(good)
        self.file.chmod(0o644)
        self.assertIn("others on this machine", refusal())

    def test_3_rights_history_and_change_while_it_runs(self):
        with Service(self.here, "--tokens", self.file) as service:
            for who, want in ((None, 401), ("0" * 64, 401), ("", 401), ("read-er", 200)):
                self.assertEqual(self.ask(service, who, "/v1/runs")[0], want, who)
            self.assertEqual(service.ask("/")[0], 200)
            self.assertEqual(service.ask("/healthz")[0], 200)
            self.check_every_operation(service, service.ask("/openapi.json")[2])

            status, _, run = self.ask(service, "submit-ter", "/v1/runs", study())
            self.assertEqual((status, run["submitted_by"]), (202, "submit-ter"))
            path = f"/v1/runs/{run['id']}"
            until(lambda: self.ask(service, "read-er", path)[2]["finished"])
            self.assertEqual(self.ask(service, "submit-ter", path + "/title", {"title": "x"})[0], 202)
            self.assertEqual(self.ask(service, "admin-istrator", path, method="DELETE")[0], 202)
            events = self.ask(service, "read-er", "/v1/events")[2]["events"]
            self.assertIn(("remove", "admin-istrator"), [(each["detail"].get("event"), each["detail"].get("by")) for each in events])

            self.secrets["late"] = self.token("new", "late", "--rights", "read").stdout.strip()
            until(lambda: self.ask(service, "late", "/v1/runs")[0] == 200)
            self.token("rm", "late")
            until(lambda: self.ask(service, "late", "/v1/runs")[0] == 401)
            self.file.write_text("torn")
            self.assertEqual(self.ask(service, "read-er", "/v1/runs")[0], 200)

    def check_every_operation(self, service, document):
        """A token that lacks one right gets 403 with that right; a token with the documented rights never gets 403."""
        seen = 0
        for path, operations in document["paths"].items():
            for method, operation in operations.items():
                if not operation["security"]:
                    continue
                self.assertEqual(operation["security"][0], {})
                need = operation["security"][1]["bearer"][0]
                seen += 1
                address = path.replace("{", "").replace("}", "").replace("...", "")
                lesser = {"read": None, "submit": "read-er", "admin": "submit-ter"}[need]
                body = b"{}" if method == "post" else None
                status, _, answer = self.ask(service, lesser, address, body, method.upper())
                self.assertEqual(status, 403 if lesser else 401, f"{method} {path}")
                if lesser:
                    self.assertEqual(answer["type"], "/problems/missing-right")
                    self.assertIn(f'"{need}"', answer["detail"])
                holder = next(each for each in self.secrets if each.startswith(need))
                self.assertNotIn(self.ask(service, holder, address, body, method.upper())[0], (401, 403), f"{method} {path}")
        self.assertGreater(seen, 40)

    def test_4_the_single_token_is_the_admin_beside_them(self):
        (self.here / "single").write_text("correct-horse-battery\n")
        with Service(self.here, "--tokens", self.file, "--token-file", self.here / "single") as service:
            status, _, run = self.ask(service, "correct-horse-battery", "/v1/runs", study())
            self.assertEqual((status, run["submitted_by"]), (202, "admin"))
            self.assertEqual(self.ask(service, "read-er", "/v1/runs")[0], 200)
            self.assertEqual(self.ask(service, "submit-ter", f"/v1/runs/{run['id']}/cancel", b"")[0], 202)
            events = self.ask(service, "read-er", f"/v1/events?run={run['id']}")[2]["events"]
            # An attempt has an event of this name too: the executor's, which may come before the cancellation.
            self.assertEqual([each["detail"].get("by") for each in events
                              if each["kind"] == "run" and each["detail"].get("event") == "submit"], ["admin"])

    def test_5_files_are_read_only_where_they_are_allowed(self):
        (self.here / "allowed").mkdir()
        record = "".join(f"{0.01 * i:.2f} 0.1\n" for i in range(50))
        for folder in ("allowed", "."):
            (self.here / folder / "record.txt").write_text(record)
        (self.here / "allowed/out.txt").symlink_to(self.here / "record.txt")
        (self.here / "allowed/up").symlink_to(self.here)

        def asked(service, path, variant=False):
            """Causes of the faults about the file; [] if none."""
            wanted = study()
            motion = "/fem/motion=" + json.dumps({"file": str(path)})
            if variant:
                wanted["variants"] = [{"name": "v", "overrides": [motion]}]
            else:
                wanted["overrides"] = [motion]
            answer = self.ask(service, "submit-ter", "/v1/runs", wanted)[2]
            return [each["cause"] for each in answer.get("faults", []) if "motion/file" in each["pointer"] + each["cause"]]

        with Service(self.here, "--tokens", self.file, "--allow-folder", self.here / "allowed") as service:
            outside = ("record.txt", "allowed/../record.txt", "allowed/out.txt", "allowed/up/record.txt", "none.txt", "allowedx")
            for path in outside:
                for variant in (False, True):
                    causes = asked(service, self.here / path, variant)
                    self.assertTrue(causes, path)
                    self.assertTrue(all("may not read" in each for each in causes), causes)
            self.assertFalse([each for each in asked(service, self.here / "allowed/record.txt") if "may not" in each])
        with Service(self.here, "--tokens", self.file) as service:
            self.assertIn("may not read", asked(service, self.here / "allowed/record.txt")[0])
        with Service(self.here) as service:
            self.secrets["submit-ter"] = ""
            self.assertFalse([each for each in asked(service, self.here / "record.txt") if "may not" in each])

    def test_6_named_files_are_as_limited_as_sent_ones(self):
        with (self.here / "large.csv").open("wb") as large:
            large.truncate(3 << 30)
        os.mkfifo(self.here / "pipe")
        (self.here / "link.msh").symlink_to(self.here / "large.csv")
        refused = {"large.csv": "has 3221225472 bytes, and this service reads files of at most 1048576", "link.msh": "has 3221225472 bytes",
                   "pipe": "is no ordinary file", "/dev/zero": "is no ordinary file", "/proc/self/status": "is empty"}
        with Service(self.here, "--largest-file", "1") as service:
            for name, cause in refused.items():
                for entry in ("/fem/motion/file", "/fem/msh_file"):
                    change = f"{entry}={self.here / name}"
                    for wanted in ({"overrides": [change]}, {"variants": [{"name": "v", "overrides": [change]}]}):
                        faults = service.ask("/v1/runs", {**study(), **wanted})[2]["faults"]
                        self.assertTrue([each for each in faults if cause in each["cause"]], faults)
            status = pathlib.Path(f"/proc/{service.process.pid}/status").read_text()
            peak_kB = int(next(line for line in status.splitlines() if line.startswith("VmHWM")).split()[1])
            self.assertLess(peak_kB, 1 << 20)


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
