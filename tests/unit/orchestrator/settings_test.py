"""The settings files that are shipped: every setting they show is one that `breachline serve` knows, with the default that
it has, and a misspelt one is refused."""
import os
import pathlib
import re
import signal
import subprocess
import sys
import tempfile
import unittest

root = pathlib.Path(os.environ["BREACH_ROOT"])
breachline = pathlib.Path(os.environ["BREACH_BIN"]) / "breachline"
shipped = sorted((root / "deploy/settings").glob("*.toml"))


def serve(folder, text):
    """(exit code after TERM, standard error)"""
    (folder / "settings.toml").write_text(text)
    with subprocess.Popen([breachline, "serve", "--config", "settings.toml", "--port", "0"], cwd=folder, text=True,
                          stdout=subprocess.PIPE, stderr=subprocess.PIPE) as service:
        if service.stdout.readline():
            service.send_signal(signal.SIGTERM)
        return service.wait(30), service.stderr.read()


class Settings(unittest.TestCase):
    def test_each_file_is_read_with_everything_it_shows_switched_on(self):
        self.assertEqual([each.name for each in shipped], ["local.toml", "slurm.toml"])
        for file in shipped:
            switched_on = re.sub(r"^#([a-z-]+ = )", r"\1", file.read_text(), flags=re.M)
            self.assertNotEqual(switched_on, file.read_text())
            with tempfile.TemporaryDirectory() as folder:
                code, said = serve(pathlib.Path(folder), switched_on)
                self.assertEqual(code, 0, said)

    def test_what_is_shown_as_default_is_the_default(self):
        shown = subprocess.run([breachline, "serve", "--help"], capture_output=True, text=True).stdout
        for file in shipped:
            for name, value in re.findall(r'^#([a-z-]+) = "?([\w./:-]+)"?$', file.read_text(), re.M):
                if name in ("slots", "slurm-option"):
                    continue  # as many as the machine has; an example
                self.assertRegex(shown, rf"--{name} \S+=?.*={re.escape(value)}\b|--{name} \S*={re.escape(value)}", name)

    def test_a_slip_is_refused_with_its_line(self):
        for text, told in (("[serve]\nslotz = 3\n", '2: unknown key "slotz"; did you mean slots?'),
                           ("[serve]\n# cores\n slots = abc\n", "3: slots: Value abc not in range 1 to 100000"),
                           ("[serve]\nslots = 3\nexecutor = pbs\n", "3: executor: Check pbs value in"),
                           ("slots = 3\n", "1: put the line [serve] before the first key"),
                           ("\n[serv]\nslots = 3\n", "2: write the section as [serve]"),
                           ("[serve]\nslots: 3\n", "2: write the entry as KEY=VALUE")):
            with tempfile.TemporaryDirectory() as folder:
                code, said = serve(pathlib.Path(folder), text)
                self.assertNotEqual(code, 0)
                self.assertIn(f"breachline: settings.toml:{told}", said)


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
