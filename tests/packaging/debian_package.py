"""The Debian package: cpack makes it and it holds what it should. Its programs have manual pages and say version and commit.
Its service starts with the command line of the unit from an unpacked copy and runs a study with the phases beside it. A backup
taken meanwhile can be restored and served. deploy/release tests the maintainer scripts; no test has a running systemd."""
import gzip
import json
import os
import pathlib
import re
import shlex
import shutil
import stat
import subprocess
import sys
import tempfile
import unittest
import urllib.request

build = pathlib.Path(sys.argv[1] if len(sys.argv) > 1 else ".")
source = pathlib.Path(os.environ["BREACH_ROOT"])
# Programs under sanitizers are not run for their help while they are built.
instrumented = re.search(r"^BREACH_SANITIZE:\w+=(address|thread)", (build / "CMakeCache.txt").read_text(), re.MULTILINE)
programs = {"breachline", "breach", "lem_tool", "fem_solver", "element_bench", "transfer_tool", "mpm_solver", "report",
            "breachline-backup", "breachline-restore"}


def call(*command, **options):
    return subprocess.run(list(map(str, command)), text=True, capture_output=True, timeout=120, **options)


def files_below(folder):
    return {str(each.relative_to(folder)) for each in folder.rglob("*") if each.is_file()}


class Unit:
    """The tested parts of a systemd unit and its settings."""

    def __init__(self, text):
        self.variables, self.command = {}, ""
        for line in text.splitlines():
            key, _, value = line.partition("=")
            if key == "Environment":
                self.variables.update(each.partition("=")[::2] for each in shlex.split(value))
            if key == "ExecStart":
                self.command = value

    def command_line(self, **changed):
        """As systemd expands it: ${X} is one word with any content, $X as many words as it contains."""
        words = []
        variables = {**self.variables, **changed}
        for word in self.command.split():
            if match := re.fullmatch(r"\$(\w+)", word):
                words += variables[match[1]].split()
            else:
                words.append(re.sub(r"\$\{(\w+)\}", lambda found: variables[found[1]], word))
        return words


class Service:
    def __init__(self, command):
        self.process = subprocess.Popen(list(map(str, command)), stdout=subprocess.PIPE, stderr=subprocess.DEVNULL,
                                        text=True)
        self.url = json.loads(self.process.stdout.readline())["url"]

    def __enter__(self):
        return self

    def __exit__(self, *_):
        self.process.terminate()
        self.process.wait(30)
        self.process.stdout.close()


class DebianPackage(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.folder = tempfile.TemporaryDirectory()
        cls.here = pathlib.Path(cls.folder.name)
        made = call("cpack", "--config", build / "CPackConfig.cmake", "-B", cls.here / "package", cwd=build)
        assert made.returncode == 0, made.stdout + made.stderr
        cls.package = next((cls.here / "package").glob("*.deb"))
        cls.root = cls.here / "root"
        assert call("dpkg-deb", "-R", cls.package, cls.root).returncode == 0
        cls.bin = cls.root / "usr/bin"
        cls.version = re.search(r"^CMAKE_PROJECT_VERSION:\w+=(.*)$", (build / "CMakeCache.txt").read_text(), re.M)[1]
        cls.unit = Unit((cls.root / "lib/systemd/system/breachline.service").read_text())

    @classmethod
    def tearDownClass(cls):
        cls.folder.cleanup()

    def breach(self, service, *arguments):
        done = call(self.bin / "breach", "--server", service.url, *arguments)
        self.assertEqual(done.returncode, 0, done.stdout + done.stderr)
        return done.stdout

    def served(self, data):
        command = self.unit.command_line(BREACHLINE_DATA=str(data), BREACHLINE_PORT="0",
                                         BREACHLINE_OPTIONS="--slots 1 --tries 2")
        self.assertEqual(command[0], "/usr/bin/breachline")
        return Service([self.root / command[0].lstrip("/"), *command[1:]])

    def test_it_holds_programs_workflows_dashboard_and_service(self):
        self.assertEqual({each.name for each in self.bin.iterdir()}, programs)
        for each in self.bin.iterdir():
            self.assertEqual(stat.S_IMODE(each.stat().st_mode), 0o755, each)
        share = self.root / "usr/share/breachline"
        self.assertEqual(files_below(share / "web"), files_below(source / "services/web/static"))
        for room in ("schema", "scenes", "studies"):
            self.assertEqual(files_below(share / room), files_below(source / "workflows" / room))
        completion = (self.root / "usr/share/bash-completion/completions/breach").read_text()
        self.assertIn("submit) options=", completion)
        self.assertEqual(files_below(self.root / "usr/lib/python3/dist-packages/breachline"),
                         {str(each.relative_to(source / "services/python/breachline"))
                          for pattern in ("*.py", "py.typed") for each in (source / "services/python/breachline").rglob(pattern)})
        pages = self.root / "usr/share/doc/breachline"
        for page in ("README.md", "docs/README.md", "docs/reference/methods/mpm.md", "docs/notebook.ipynb"):
            self.assertTrue((pages / page).is_file(), page)
        motions = self.root / "var/lib/breachline-motions"
        self.assertEqual((motions.is_dir(), stat.S_IMODE(motions.stat().st_mode)), (True, 0o755))
        self.assertIn(f"ReadOnlyPaths=-/{motions.relative_to(self.root)}", (self.root / "lib/systemd/system/breachline.service").read_text())
        control = (self.root / "DEBIAN/control").read_text()
        self.assertRegex(control, "(?m)^Provides: python3-breachline$")
        for library in ("libhdf5", "libcpp-httplib", "libsqlite3", "libssl3", "sqlite3", "adduser"):
            self.assertIn(library, control)
        self.assertNotIn("\n(", control)

    @unittest.skipIf(instrumented or not shutil.which("help2man"), "no manual pages are made")
    def test_each_program_has_a_manual_page_with_its_options(self):
        manuals = self.root / "usr/share/man/man1"
        self.assertEqual({each.name for each in manuals.iterdir()}, {f"{each}.1.gz" for each in programs})
        for program in programs:
            page = gzip.decompress((manuals / f"{program}.1.gz").read_bytes()).decode().replace("\\-", "-")
            self.assertIn(f"{program} {self.version}", page.splitlines()[1])
            for section in (".SH NAME", ".SH SYNOPSIS", ".SH OPTIONS", "--version"):
                self.assertIn(section, page, program)
            self.assertNotIn(str(build), page, "a default of this machine")
            for word in {"mpm_solver": ("--until-rest",), "breach": ("submit", "--server"), "breachline": ("serve",)}.get(program, ()):
                self.assertIn(word, page)

    def test_each_program_says_the_version_and_the_commit(self):
        said = {each: call(self.bin / each, "--version").stdout.splitlines()[0].split()[-1] for each in programs}
        self.assertEqual(set(said.values()), {said["breachline"]})
        self.assertRegex(said["breachline"], rf"^{re.escape(self.version)}(\+[0-9a-f]{{7,40}})?$")
        self.assertEqual(self.package.name.split("_")[1], self.version)

    def test_a_tree_without_git_has_the_version_and_an_archive_the_commit_too(self):
        """Configures the folder that provides the version."""
        def version_of(tree):
            (tree / "CMakeLists.txt").write_text(f"cmake_minimum_required(VERSION 3.25)\nproject(Tree VERSION {self.version} LANGUAGES NONE)\n"
                                                 "function(breach_room)\nendfunction()\nadd_subdirectory(core/version)\n")
            made = call("cmake", "-B", tree / "build", tree)
            self.assertEqual(made.returncode, 0, made.stderr)
            return re.search(r'commit = "(.*)";', (tree / "build/core/version/version.cpp").read_text())[1]
        exported = self.here / "exported_tree"
        shutil.copytree(source / "core/version", exported / "core/version")
        (exported / "core/version/archived_commit").write_text("$Format:%h$\n")
        self.assertEqual(version_of(exported), "")
        (exported / "core/version/archived_commit").write_text("1a2b3c4\n")
        self.assertEqual(version_of(exported), "1a2b3c4")

    def test_its_scripts_are_sound_and_its_settings_are_kept_on_upgrade(self):
        for name in ("postinst", "prerm", "postrm"):
            script = self.root / "DEBIAN" / name
            self.assertTrue(os.access(script, os.X_OK), name)
            self.assertEqual(call("sh", "-n", script).returncode, 0, name)
        self.assertEqual((self.root / "DEBIAN/conffiles").read_text(), "/etc/breachline/breachline.conf\n")
        settings = (self.root / "etc/breachline/breachline.conf").read_text()
        shown = dict(re.findall(r"^#(BREACHLINE_\w+)=(.*)$", settings, re.M))
        self.assertEqual(shown, self.unit.variables, "the settings file shows the unit's defaults")
        self.assertFalse([line for line in settings.splitlines() if line and not line.startswith("#")])

    def test_an_install_stays_below_its_prefix(self):
        prefix = self.here / "prefix"
        self.assertEqual(call("cmake", "--install", build, "--prefix", prefix).returncode, 0)
        self.assertEqual(files_below(prefix), files_below(self.root / "usr"))

    def test_its_service_runs_a_study_and_survives_as_a_backup(self):
        study = self.here / "study.json"
        study.write_text(json.dumps({
            "format": "breachline-study/1", "name": "column", "transfer_times": [0.1],
            "scene": str(self.root / "usr/share/breachline/scenes/column.json"),
            "overrides": ["/fem/stages/1/duration=0.2", "/mpm/duration=0.5", "/mpm/cell_size=2"]}))
        data, backup, restored = self.here / "data", self.here / "backup", self.here / "restored"
        with self.served(data) as service:
            page = urllib.request.urlopen(service.url + "/", timeout=10).read()
            self.assertEqual(page, (self.root / "usr/share/breachline/web/index.html").read_bytes())
            run = self.breach(service, "submit", study, "--watch").splitlines()[0]
            results = self.breach(service, "results", run, "--csv")
            saved = call(self.bin / "breachline-backup", data, backup)
            self.assertEqual((saved.returncode, saved.stdout), (0, f"{backup}: 1 runs\n"), saved.stderr)
            self.assertEqual(call(self.bin / "breachline-backup", data, backup).returncode, 74)
            self.breach(service, "submit", study)  # the backup does not contain later changes
        self.assertEqual(call(self.bin / "breachline-restore", backup, data).returncode, 74)
        brought = call(self.bin / "breachline-restore", backup, restored)
        self.assertEqual(brought.returncode, 0, brought.stderr)
        shutil.rmtree(data)  # nothing may depend on the old folder
        with self.served(restored) as service:
            self.assertEqual(len(json.loads(self.breach(service, "list", "--json"))), 1)
            self.assertEqual(self.breach(service, "results", run, "--csv"), results)
            self.breach(service, "export", run, self.here / "exported")


if __name__ == "__main__":
    for program in ("cpack", "dpkg-deb", "dpkg-shlibdeps", "file", "sqlite3"):
        if not shutil.which(program):
            print(f"skipped: {program} is not installed")
            sys.exit(77)
    unittest.main(argv=sys.argv[:1])
